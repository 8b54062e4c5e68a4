//! A second opinion: a program of the user's, asked beside the built-in judge.
//!
//! One process an answer, in a process group of its own. It gets one line of JSON on standard
//! input (the question, its rubric, the answer as data) and prints one line of JSON a criterion.
//! It may take its time, print what it likes or die: what comes back is findings or a reason,
//! and what they are worth is decided in `tutor`.

use std::io::{Read as _, Write as _};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use serde::Serialize;
use tutor::opinion::Finding;
use tutor::rubric::Rubric;

use crate::config::SecondJudge;
use crate::exit::plain_reason;

/// More than that is no list of findings.
const MOST_BYTES: u64 = 1 << 20;
/// How often a cancelled or silent program is looked at.
const TICK: Duration = Duration::from_millis(20);

/// Findings, or why there are none.
pub type Said = Result<Vec<Finding>, String>;

#[derive(Serialize)]
struct Request<'a> {
    format: u32,
    item: &'a str,
    rubric: Shown<'a>,
    /// With the replies, each on a line of its own.
    answer: &'a str,
    /// What was asked back, and what was replied.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    dialogue: Vec<Exchange<'a>>,
}

#[derive(Serialize)]
struct Exchange<'a> {
    asked: &'a str,
    reply: &'a str,
}

#[derive(Serialize)]
struct Shown<'a> {
    prompt: &'a str,
    expectation: Vec<Expected<'a>>,
    misconception: Vec<Mistaken<'a>>,
}

#[derive(Serialize)]
struct Expected<'a> {
    id: &'a str,
    says: &'a str,
    required: bool,
}

#[derive(Serialize)]
struct Mistaken<'a> {
    id: &'a str,
    says: &'a str,
    blocking: bool,
}

fn request(rubric: &Rubric, answer: &str, dialogue: &[(String, String)]) -> String {
    let expectation = rubric.expectation.iter().map(|it| Expected {
        id: &it.id,
        says: &it.says,
        required: it.required,
    });
    let misconception = rubric.misconception.iter().map(|it| Mistaken {
        id: &it.id,
        says: &it.says,
        blocking: it.blocking,
    });
    let request = Request {
        format: 1,
        item: &rubric.item,
        rubric: Shown {
            prompt: &rubric.prompt,
            expectation: expectation.collect(),
            misconception: misconception.collect(),
        },
        answer,
        dialogue: dialogue
            .iter()
            .map(|(asked, reply)| Exchange { asked, reply })
            .collect(),
    };
    // Strings and booleans: it has no way to fail.
    serde_json::to_string(&request).unwrap_or_default() + "\n"
}

/// A program being asked.
pub struct Asking {
    result: Receiver<Said>,
    cancelled: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Asking {
    /// Asks in the background.
    pub fn start(
        judge: &SecondJudge,
        rubric: &Rubric,
        answer: &str,
        dialogue: &[(String, String)],
    ) -> Asking {
        let (judge, request) = (judge.clone(), request(rubric, answer, dialogue));
        let cancelled = Arc::new(AtomicBool::new(false));
        let (send, result) = mpsc::channel();
        let flag = Arc::clone(&cancelled);
        let thread = thread::spawn(move || {
            // Nobody listens any more once the session is closed.
            let _ = send.send(ask(&judge, request, &flag));
        });
        Asking {
            result,
            cancelled,
            thread: Some(thread),
        }
    }

    /// What was said, once it is.
    pub fn answer(&self) -> Option<Said> {
        self.result.try_recv().ok()
    }

    /// Waits for it; its own patience is the limit.
    pub fn wait(&self) -> Said {
        let broken = || Err("it could not be asked".to_owned());
        self.result.recv().unwrap_or_else(|_| broken())
    }
}

impl Drop for Asking {
    /// Whoever is no longer asked is ended, and not left behind.
    fn drop(&mut self) {
        self.cancelled.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Asks, and waits for the end.
fn ask(judge: &SecondJudge, request: String, cancelled: &AtomicBool) -> Said {
    let until = Instant::now() + judge.patience();
    let mut child = Running::start(judge)?;
    let stdin = child.child.stdin.take();
    let stdout = child.child.stdout.take();
    thread::spawn(move || {
        if let Some(mut stdin) = stdin {
            // A program that does not read its input has closed it.
            let _ = stdin.write_all(request.as_bytes());
        }
    });
    let (send, received) = mpsc::channel();
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let read = stdout.map_or(Ok(0), |out| {
            out.take(MOST_BYTES + 1).read_to_end(&mut bytes)
        });
        let _ = send.send(read.map(|_| bytes));
    });
    let late = || {
        let seconds = judge.patience().as_secs_f64();
        format!("it took longer than {seconds} s")
    };
    let bytes = loop {
        match received.recv_timeout(TICK) {
            Ok(Ok(bytes)) => break bytes,
            Ok(Err(error)) => return Err(format!("it broke off: {}", plain_reason(&error))),
            Err(RecvTimeoutError::Disconnected) => return Err("it broke off".to_owned()),
            Err(RecvTimeoutError::Timeout) if cancelled.load(Ordering::Relaxed) => {
                return Err("it was not waited for".to_owned());
            }
            Err(RecvTimeoutError::Timeout) if Instant::now() >= until => return Err(late()),
            Err(RecvTimeoutError::Timeout) => {}
        }
    };
    if bytes.len() as u64 > MOST_BYTES {
        return Err(format!("it said more than {MOST_BYTES} bytes"));
    }
    loop {
        let status = child.child.try_wait();
        child.ended = matches!(status, Ok(Some(_)));
        match status {
            Ok(Some(status)) if status.success() => break,
            Ok(Some(status)) => {
                return Err(match status.code() {
                    Some(code) => format!("it ended with exit status {code}"),
                    None => "it crashed".to_owned(),
                });
            }
            Ok(None) if cancelled.load(Ordering::Relaxed) => {
                return Err("it was not waited for".to_owned());
            }
            Ok(None) if Instant::now() < until => thread::sleep(TICK),
            Ok(None) => return Err(late()),
            Err(error) => return Err(format!("it was lost: {}", plain_reason(&error))),
        }
    }
    findings(&bytes)
}

fn findings(bytes: &[u8]) -> Said {
    let text = std::str::from_utf8(bytes).map_err(|_| "what it said is not UTF-8".to_owned())?;
    let lines = text.lines().enumerate();
    let lines = lines.filter(|(_, line)| !line.trim().is_empty());
    let findings: Vec<Finding> = lines
        .map(|(at, line)| {
            serde_json::from_str(line)
                .map_err(|_| format!("line {} of what it said is no finding", at + 1))
        })
        .collect::<Result<_, _>>()?;
    if findings.is_empty() {
        return Err("it said nothing".to_owned());
    }
    Ok(findings)
}

/// A process that ends with this value, children and all.
struct Running {
    child: Child,
    /// Its end was seen: its number may be another's by now.
    ended: bool,
}

impl Running {
    fn start(judge: &SecondJudge) -> Result<Running, String> {
        let (program, args) = judge.command.split_first().ok_or("no program is named")?;
        let mut command = Command::new(program);
        command
            .args(args)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            // The screen is the learner's.
            .stderr(Stdio::null());
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        match command.spawn() {
            Ok(child) => Ok(Running {
                child,
                ended: false,
            }),
            Err(error) => Err(format!("{program} cannot be run: {}", plain_reason(&error))),
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if self.ended {
            return;
        }
        #[cfg(unix)]
        if let Some(group) = i32::try_from(self.child.id())
            .ok()
            .and_then(rustix::process::Pid::from_raw)
        {
            let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn judge(script: &str, timeout_s: f64) -> SecondJudge {
        let text =
            format!("[judge]\ncommand = [\"sh\", \"-c\", {script:?}]\ntimeout_s = {timeout_s}");
        crate::config::parse(&text)
            .expect("settings")
            .judge
            .expect("a judge")
    }

    fn rubric() -> Rubric {
        let text =
            "item = \"x/y\"\nprompt = \"Why?\"\nexpectation = [{ id = \"a\", says = \"A.\" }]";
        toml::from_str(text).expect("a rubric")
    }

    #[track_caller]
    fn check(script: &str, expected: Result<&[&str], &str>) {
        // Half a second is for those that would never end; a slow machine changes no outcome.
        let patience = if script.contains("sleep") { 0.5 } else { 60.0 };
        let said = Asking::start(&judge(script, patience), &rubric(), "Because.", &[]).wait();
        match (&said, expected) {
            (Ok(findings), Ok(ids)) => {
                let found: Vec<&str> = findings.iter().map(|it| it.id.as_str()).collect();
                assert_eq!(found, ids, "{script}");
            }
            (Err(why), Err(expected)) => assert!(why.contains(expected), "{script}: {why}"),
            _ => panic!("{script}: {said:?}"),
        }
    }

    const YES: &str = r#"echo '{"id":"a","verdict":"yes","quote":"Because","more":1}'"#;

    #[test]
    fn what_it_says_and_all_the_ways_to_say_nothing() {
        check(YES, Ok(&["a"]));
        check(
            &format!("cat >/dev/null; {YES}; echo; {YES}"),
            Ok(&["a", "a"]),
        );
        check(
            r#"grep -q '"answer":"Because."' && grep -q x </dev/null; echo '{"id":"b","verdict":"no"}'"#,
            Ok(&["b"]),
        );
        check("exit 0", Err("it said nothing"));
        check("echo hello", Err("line 1 of what it said is no finding"));
        check(r#"echo '{"id":"a","verdict":"maybe"}'"#, Err("line 1"));
        check(r#"echo '{"id":"a"}'"#, Err("line 1"));
        check(&format!("{YES}; exit 3"), Err("exit status 3"));
        check(&format!("{YES}; kill -SEGV $$"), Err("it crashed"));
        check("sleep 1000", Err("longer than 0.5 s"));
        check("sleep 1000 & sleep 1000", Err("longer than 0.5 s"));
        check(
            &format!("{YES}; exec >/dev/null; sleep 1000"),
            Err("longer than 0.5 s"),
        );
        check(
            "yes aaaaaaaaaaaaaaaaaaaaaaaaaaaaa",
            Err("more than 1048576 bytes"),
        );
        check(r"printf '\377\376'", Err("not UTF-8"));
    }

    #[test]
    fn a_program_that_is_not_there_is_named() {
        let mut judge = judge("", 1.0);
        judge.command = vec!["/nonexistent/judge".to_owned()];
        let said = Asking::start(&judge, &rubric(), "", &[]).wait();
        assert!(said.is_err_and(|why| why.starts_with("/nonexistent/judge cannot be run")));
    }

    #[test]
    fn whoever_is_not_waited_for_is_ended_with_his_children() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("child");
        let script = format!("sleep 1000 & echo $! > {}; wait", file.display());
        let asking = Asking::start(&judge(&script, 600.0), &rubric(), "", &[]);
        let child = loop {
            match std::fs::read_to_string(&file) {
                Ok(text) if text.ends_with('\n') => break text.trim().to_owned(),
                _ => thread::sleep(TICK),
            }
        };
        drop(asking);
        // Ended, though perhaps not yet collected by whoever inherits it.
        let gone = || match std::fs::read_to_string(format!("/proc/{child}/stat")) {
            Ok(stat) => stat.contains(") Z "),
            Err(_) => true,
        };
        while cfg!(target_os = "linux") && !gone() {
            thread::sleep(TICK);
        }
    }

    #[test]
    fn the_request_is_one_line_with_the_answer_as_data() {
        let line = request(&rubric(), "one\n\"two\"}", &[]);
        assert_eq!(line.matches('\n').count(), 1);
        let value: serde_json::Value = serde_json::from_str(&line).expect("JSON");
        assert_eq!(value["answer"], "one\n\"two\"}");
        assert_eq!(value["rubric"]["expectation"][0]["required"], true);
    }
}
