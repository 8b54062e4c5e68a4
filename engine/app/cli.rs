//! What the command line accepts. Types only: `commands` does the work.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// A terminal tutor for microfacet shading: D, G and F, worked, explained and drawn.
///
/// Without a command it opens the list of lessons.
#[derive(Debug, Parser)]
#[command(name = "lobe", version, max_term_width = 90)]
pub struct Cli {
    #[command(flatten)]
    pub folders: Folders,
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// Where lessons come from and where answers go.
#[derive(Clone, Debug, Default, Args)]
pub struct Folders {
    /// Folder of lesson files (else LOBE_LESSONS, ./lessons, or the lessons built in)
    #[arg(long, global = true, value_name = "DIR")]
    pub lessons: Option<PathBuf>,
    /// Folder of your answers (else LOBE_PROGRESS, or your data folder)
    #[arg(long, global = true, value_name = "DIR")]
    pub progress: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Take one lesson
    Learn(Learn),
    /// List the lessons, how far you are, and what is due
    List(Json),
    /// Show your record: attempts, verdicts, slips
    Progress(Json),
    /// Print a lesson as taught, as Markdown
    Transcript(Transcript),
    /// Compute an expression with the core's functions
    Eval(Eval),
    /// Draw an exercise
    Exercise(Exercise),
    /// Mark an answer to an exercise
    Mark(Mark),
    /// Judge an explanation read from standard input
    Judge(Judge),
    /// Go through a class's unsure and disputed explanations, one key an answer
    Review(Review),
    /// Judge a class's logs with today's judge, and show every verdict that changed
    Regrade(Regrade),
    /// Check everything a lesson file can get wrong
    Check(Check),
    /// Turn roughness, light, F0 and exposure of a picture with the arrow keys
    Play(Play),
    /// Draw fingerprints and plots to files
    Render(Render),
    /// Measure run time against error, for every term and every way to compute it
    Bench(Bench),
    /// Look for the inputs at which each function is worst; exit 1 past a bound
    Stress(Stress),
    /// Say what this machine offers: adapter, terminal graphics, colours, folders
    Doctor(Json),
    /// Run a shader given on standard input; this program starts itself so
    #[command(hide = true, name = crate::shaders::COMMAND)]
    RunShader,
}

#[derive(Clone, Debug, Default, Args)]
pub struct Learn {
    /// Id or number of the lesson (`lobe list` names them)
    pub lesson: String,
    /// Linear text on standard input and output, for screen readers and pipes
    #[arg(long)]
    pub plain: bool,
    /// Start afresh even where an unfinished session could be resumed
    #[arg(long)]
    pub new: bool,
    /// Seed of the exercise numbers of a new session (else taken from the clock)
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Only the questions of the lesson that are due again
    #[arg(long, conflicts_with_all = ["new", "seed"])]
    pub due: bool,
}

#[derive(Clone, Debug, Args)]
pub struct Play {
    /// Id or number of the lesson (`lobe list` names them)
    pub lesson: String,
    /// Id of the picture (else the lesson's first)
    #[arg(value_name = "FINGERPRINT")]
    pub picture: Option<String>,
    /// Roughness to begin with, 0.02 to 1
    #[arg(long, value_name = "R", value_parser = within::<2, 100>)]
    pub roughness: Option<f64>,
    /// Angle between main light and eye in degrees, 0 to 175
    #[arg(long, value_name = "DEG", value_parser = within::<0, 17500>)]
    pub light: Option<f64>,
    /// Reflectance at normal incidence, 0 to 1
    #[arg(long, value_name = "F0", value_parser = within::<0, 100>)]
    pub f0: Option<f64>,
    /// No screen: the profile along the middle, in numbers
    #[arg(long)]
    pub plain: bool,
}

/// A number between two, given in hundredths.
fn within<const LEAST: u32, const MOST: u32>(text: &str) -> Result<f64, String> {
    let (least, most) = (f64::from(LEAST) / 100.0, f64::from(MOST) / 100.0);
    match text.parse::<f64>() {
        Ok(value) if (least..=most).contains(&value) => Ok(value),
        _ => Err(format!("a number from {least} to {most} is wanted")),
    }
}

#[derive(Clone, Copy, Debug, Default, Args)]
pub struct Json {
    /// Print JSON, one object a line
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Transcript {
    /// Id or number of the lesson
    pub lesson: String,
    /// The lesson itself, without your answers
    #[arg(long)]
    pub fresh: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    #[default]
    F64,
    F32,
}

#[derive(Debug, Args)]
pub struct Eval {
    /// For example 'd_ggx(n_dot_h = 0.95, roughness = 0.4)'
    #[arg(
        value_name = "EXPR",
        required_unless_present = "batch",
        value_parser = unmarked
    )]
    pub expressions: Vec<String>,
    /// Compute in this precision
    #[arg(long, value_enum, default_value_t)]
    pub precision: Precision,
    /// Print one JSON object per expression
    #[arg(long)]
    pub json: bool,
    /// Read one expression a line from FILE (`-`: standard input); prints JSON
    #[arg(long, value_name = "FILE", conflicts_with = "expressions")]
    pub batch: Option<PathBuf>,
}

/// Stands before an expression that begins with a minus sign, which clap would take for
/// options; no expression begins with it by itself.
const NO_OPTION: char = '\u{2060}';

fn unmarked(expression: &str) -> Result<String, std::convert::Infallible> {
    Ok(expression.trim_start_matches(NO_OPTION).to_owned())
}

/// The command line, with `-2^2` after `eval` marked as the expression that it is.
pub fn arguments(given: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut is_eval = false;
    given
        .map(|argument| {
            let text = argument.to_str().unwrap_or_default();
            let minus = text.len() > 1 && text.starts_with('-') && !text.starts_with("--");
            let marked = is_eval && minus && text != "-h";
            is_eval |= text == "eval";
            match marked {
                true => format!("{NO_OPTION}{text}").into(),
                false => argument,
            }
        })
        .collect()
}

#[derive(Debug, Args)]
pub struct Exercise {
    /// Id of the exercise, for example smith-g2/v
    #[arg(required_unless_present = "list")]
    pub id: Option<String>,
    /// List every exercise of every lesson
    #[arg(long, conflicts_with = "id")]
    pub list: bool,
    /// Seed of the draw
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Mark {
    /// Id of the exercise
    pub id: String,
    /// Seed of the draw
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// What the learner typed; of a shader the whole text, or @FILE
    #[arg(long, value_name = "TEXT", allow_hyphen_values = true)]
    pub answer: String,
    /// The step that was answered (else the result)
    #[arg(long, value_name = "NAME")]
    pub step: Option<String>,
    /// What was answered to an earlier step; may be given several times
    #[arg(long, value_name = "NAME=TEXT", allow_hyphen_values = true)]
    pub earlier: Vec<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Judge {
    /// Id of the question, for example smith-g2/explain-3
    #[arg(required_unless_present_any = ["batch", "evaluate", "learn"])]
    pub item: Option<String>,
    /// Ask the program named in the settings beside the built-in judge (`lobe doctor` says where
    /// they are)
    #[arg(long, conflicts_with_all = ["evaluate", "learn"])]
    pub second_opinion: bool,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Read JSONL `{"id","item","text"}` from FILE (`-`: standard input); prints JSON
    #[arg(long, value_name = "FILE", conflicts_with = "item")]
    pub batch: Option<PathBuf>,
    /// Compare the judge with a teacher's marks: JSONL `{"id","item","writer","text","met",
    /// "misconceptions","verdict"}`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["item", "batch"])]
    pub evaluate: Option<PathBuf>,
    /// Propose phrases from a teacher's marks (JSONL as for --evaluate), and show what each
    /// gains and costs on answers by other writers
    #[arg(long, value_name = "FILE", conflicts_with_all = ["item", "batch", "evaluate"])]
    pub learn: Option<PathBuf>,
    /// With --evaluate: the figures of each writer too
    #[arg(long, requires = "evaluate")]
    pub by_writer: bool,
}

#[derive(Debug, Args)]
pub struct Review {
    /// Folder of a class's logs: a folder for each learner, or the logs themselves
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Answers to this question only, for example smith-g2/explain-3
    #[arg(long, value_name = "ITEM")]
    pub item: Option<String>,
    /// Every answer, not only unsure and disputed ones
    #[arg(long)]
    pub all: bool,
    /// Answers that are marked already, too
    #[arg(long)]
    pub again: bool,
    /// List what waits, and mark nothing
    #[arg(long, conflicts_with = "plain")]
    pub list: bool,
    /// With --list: print JSON, one object a line
    #[arg(long, requires = "list")]
    pub json: bool,
    /// Linear text on standard input and output
    #[arg(long)]
    pub plain: bool,
    /// Print the marks made so far as examples for the lesson files
    #[arg(long, conflicts_with_all = ["list", "plain", "all", "again"])]
    pub examples: bool,
    /// With --examples: put them into the lesson files
    #[arg(long, requires = "examples")]
    pub write: bool,
}

#[derive(Debug, Args)]
pub struct Regrade {
    /// Folder of a class's logs: a folder for each learner, or the logs themselves
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Print JSON, one object a changed verdict
    #[arg(long)]
    pub json: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    #[default]
    Human,
    Json,
    Github,
    Junit,
}

#[derive(Debug, Args)]
pub struct Check {
    /// Lesson files or folders (else the lessons that `lobe` would teach)
    pub paths: Vec<PathBuf>,
    /// How to print what was found
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Backend {
    /// A hardware adapter where there is one, else the CPU
    #[default]
    Auto,
    /// Any adapter, software ones included; without one exit 2
    Gpu,
    Cpu,
}

/// A file of a picture's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Values {
    /// Linear, as an OpenEXR file of 32-bit floats
    Exr,
    /// Exposed as in the picture, through the sRGB curve, as a PNG of 16 bits
    Png16,
}

#[derive(Debug, Args)]
pub struct Render {
    /// Ids or numbers of lessons, or single pictures: smith-g2/double-division (else all)
    #[arg(value_name = "LESSON[/PICTURE]")]
    pub names: Vec<String>,
    /// Folder to write to (else renders/gallery where it exists, else ./lobe-pictures)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Width and height of one panel in pixels
    #[arg(long, value_name = "N", default_value_t = 384, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub size: u32,
    #[arg(long, value_enum, default_value_t)]
    pub backend: Backend,
    /// What the CPU computes in; a graphics processor computes in f32
    #[arg(long, value_enum, default_value_t)]
    pub precision: Precision,
    /// Write the values of both panels too, beside each fingerprint
    #[arg(long, value_enum, value_name = "FORMAT")]
    pub values: Option<Values>,
    /// Draw again what is already there
    #[arg(long)]
    pub force: bool,
    /// Compute everything, needed or not: the same picture, slower
    #[arg(long)]
    pub no_skip: bool,
    /// Say for each picture what was left out, and why
    #[arg(long)]
    pub explain: bool,
    /// Print one JSON object a picture
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Bench {
    /// A short run: seconds instead of minutes
    #[arg(long)]
    pub quick: bool,
    /// Print JSON, one object a line
    #[arg(long)]
    pub json: bool,
    /// Folder for the plots (else ./lobe-bench; with --json only where named)
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Stress {
    /// Functions to look at (else all)
    #[arg(value_name = "FN")]
    pub names: Vec<String>,
    /// A short search: seconds instead of minutes
    #[arg(long)]
    pub quick: bool,
    /// Other points: the same number finds the same
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Print JSON, one object a line
    #[arg(long)]
    pub json: bool,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_command_line_is_consistent() {
        super::Cli::command().debug_assert();
    }
}
