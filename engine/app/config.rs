//! The user's settings: `config.toml` in the folder for settings, or the file that `LOBE_CONFIG`
//! names. Without one everything is as it comes.

use std::path::{Path, PathBuf};
use std::time::Duration;
use std::{env, fs, io};

use etcetera::BaseStrategy as _;
use serde::Deserialize;

use crate::exit::{Failure, plain_reason};

/// What the file says.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Who gives a second opinion on explanations; nobody where it is missing.
    pub judge: Option<SecondJudge>,
}

/// `[judge]`: a program that is asked beside the built-in judge.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SecondJudge {
    /// The program and its arguments; no shell is between.
    pub command: Vec<String>,
    /// Seconds after which it is not waited for any longer.
    #[serde(default = "twenty")]
    timeout_s: f64,
}

fn twenty() -> f64 {
    20.0
}

impl SecondJudge {
    /// How long it may take.
    pub fn patience(&self) -> Duration {
        Duration::try_from_secs_f64(self.timeout_s).unwrap_or_default()
    }

    /// What people call it.
    pub fn name(&self) -> String {
        let program = self.command.first().map(Path::new);
        let name = program.and_then(Path::file_name).unwrap_or_default();
        name.to_string_lossy().into_owned()
    }
}

/// Where the settings are looked for; `None` without a home folder.
pub fn path() -> Option<PathBuf> {
    if let Some(path) = env::var_os("LOBE_CONFIG").filter(|value| !value.is_empty()) {
        return Some(path.into());
    }
    let strategy = etcetera::choose_base_strategy().ok()?;
    Some(strategy.config_dir().join("lobe").join("config.toml"))
}

/// Reads the settings; a file that is not there says nothing.
pub fn read() -> Result<Config, Failure> {
    let Some(path) = path() else {
        return Ok(Config::default());
    };
    match fs::read_to_string(&path) {
        Ok(text) => {
            parse(&text).map_err(|why| Failure::unusable(format!("{}:{why}", path.display())))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Config::default()),
        Err(error) => Err(Failure::unusable(format!(
            "cannot read {}: {}; mend or remove it",
            path.display(),
            plain_reason(&error)
        ))),
    }
}

/// The settings, or the line and what is wrong with it.
pub(crate) fn parse(text: &str) -> Result<Config, String> {
    let config: Config = toml::from_str(text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = text.get(..start).unwrap_or_default().matches('\n').count() + 1;
        let words: Vec<&str> = error.message().split_whitespace().collect();
        format!("{line}: {}; mend it or remove the file", words.join(" "))
    })?;
    if let Some(judge) = &config.judge {
        if judge.command.first().is_none_or(String::is_empty) {
            return Err("1: `command` of [judge] names no program: command = [\"program\"]".into());
        }
        let fits = judge.timeout_s > 0.0 && judge.timeout_s <= 600.0;
        if !fits {
            return Err("1: `timeout_s` of [judge] must be above 0, and at most 600".into());
        }
    }
    Ok(config)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: Result<Option<(&str, f64)>, &str>) {
        let found = parse(text);
        match (&found, expected) {
            (Ok(config), Ok(expected)) => {
                let judge = config.judge.as_ref();
                let judge = judge.map(|it| (it.command[0].as_str(), it.timeout_s));
                assert_eq!(judge, expected, "{text}");
            }
            (Err(why), Err(start)) => assert!(why.starts_with(start), "{text}: {why}"),
            _ => panic!("{text}: {found:?}"),
        }
    }

    #[test]
    fn settings() {
        check("", Ok(None));
        check("[judge]\ncommand = [\"x\", \"-y\"]", Ok(Some(("x", 20.0))));
        let quick = "[judge]\ncommand = [\"x\"]\ntimeout_s = 0.5";
        check(quick, Ok(Some(("x", 0.5))));
        check("[judge]\ncommand = []", Err("1: `command`"));
        check("[judge]\ncommand = [\"\"]", Err("1: `command`"));
        check("[judge]\ncommand = \"x\"", Err("2: "));
        check("[judge]", Err("1: "));
        check("\n[juge]\n", Err("2: unknown field"));
        for seconds in ["0", "-1", "nan", "inf", "1e9"] {
            let text = format!("[judge]\ncommand = [\"x\"]\ntimeout_s = {seconds}");
            assert!(parse(&text).is_err(), "{seconds}");
        }
    }
}
