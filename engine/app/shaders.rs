//! A learner's shader runs in a process of its own: this program once more, with limits to its
//! time and its memory. Whatever it does there, here it is an outcome.

use std::env;
use std::io::{Read as _, Write as _};
use std::path::PathBuf;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use renders::ProfilePoint;
use serde::{Deserialize, Serialize};
use shader::{Outcome, Task};
use tutor::Lesson;
use tutor::exercise::shader::{CodePlace, Job, Ran};
use tutor::prose::TableView;

use crate::fingerprints::table_of;

/// So long may a process take, however little it computes.
const WALL: Duration = Duration::from_secs(5);
/// More than this is no answer.
const MOST_BYTES: u64 = 64 << 20;

/// The hidden command that the process is started with.
pub const COMMAND: &str = "run-shader";

/// What the process is told, as one JSON object on its standard input.
#[derive(Serialize, Deserialize, Debug)]
pub enum Order {
    /// Run a function at points; the answer is an [`Outcome`] as JSON.
    Run(Task),
    /// Draw the ball of a function beside the right one; the answer is [`Head`] as a line of
    /// JSON, then the pixels.
    Draw(Ball, u32),
    /// Compute the profile of that ball; the answer is [`Head`] alone.
    Profile(Ball),
}

/// The ball of a learner's function.
#[derive(Serialize, Deserialize, Debug)]
pub struct Ball {
    /// The lesson's file, by name and whole.
    pub file: String,
    /// Its text.
    pub lesson: String,
    /// Id of the exercise.
    pub exercise: String,
    /// The learner's text.
    pub source: String,
}

/// What comes before the pixels.
#[derive(Serialize, Deserialize, Debug)]
pub enum Head {
    /// Width and height of the picture whose pixels follow.
    Picture(u32, u32),
    /// Points along the equator, each as the bits of its numbers: JSON knows no infinity.
    Profile(Vec<[u64; 6]>),
    /// Why there is nothing to see, in one sentence.
    Nothing(String),
}

/// How a process ended that gave no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Broken {
    /// It took too long, and was ended.
    Late,
    /// It ended itself, or was ended: too deep, too large.
    Down,
    /// It could not be started, or not be heard.
    Unable(String),
}

/// Runs a job, and waits for what comes of it.
pub fn run(job: Job) -> Ran {
    let order = Order::Run(task(job));
    match ask(&order) {
        Ok(answer) => match serde_json::from_slice::<Outcome>(&answer) {
            Ok(outcome) => ran(outcome),
            Err(_) => Ran::Unable("what came back could not be read".to_owned()),
        },
        Err(Broken::Late) => Ran::Stopped {
            point: None,
            says: format!(
                "It had not come to an end after {} seconds.",
                WALL.as_secs()
            ),
        },
        Err(Broken::Down) => Ran::Stopped {
            point: None,
            says: "Running it broke down: it is nested too deep, or wants too much memory."
                .to_owned(),
        },
        Err(Broken::Unable(why)) => Ran::Unable(why),
    }
}

/// The ball that a learner's function draws: width, height, pixels.
pub fn picture(
    lesson: &Lesson,
    exercise: &str,
    source: &str,
    size: u32,
) -> Result<(u32, u32, Vec<u8>), String> {
    let (head, rest) = head(&Order::Draw(ball(lesson, exercise, source), size))?;
    match head {
        Head::Picture(width, height) => Ok((width, height, rest)),
        Head::Nothing(why) => Err(why),
        Head::Profile(_) => Err("what came back is no picture".to_owned()),
    }
}

/// The same along the equator, as a table; none where the function gives no values.
pub fn profile(lesson: &Lesson, exercise: &str, source: &str) -> Option<TableView> {
    let (head, _) = head(&Order::Profile(ball(lesson, exercise, source))).ok()?;
    let Head::Profile(points) = head else {
        return None;
    };
    let points: Vec<ProfilePoint> = points.into_iter().map(point).collect();
    table_of(&points, "yours")
}

/// Six numbers of a point, as bits.
pub fn bits(point: &ProfilePoint) -> [u64; 6] {
    [
        point.position,
        point.n_dot_l,
        point.n_dot_v,
        point.right,
        point.wrong,
        point.ratio,
    ]
    .map(f64::to_bits)
}

fn point(bits: [u64; 6]) -> ProfilePoint {
    let [position, n_dot_l, n_dot_v, right, wrong, ratio] = bits.map(f64::from_bits);
    ProfilePoint {
        position,
        n_dot_l,
        n_dot_v,
        right,
        wrong,
        ratio,
    }
}

fn ball(lesson: &Lesson, exercise: &str, source: &str) -> Ball {
    Ball {
        file: lesson.file.clone(),
        lesson: lesson.source.clone(),
        exercise: exercise.to_owned(),
        source: source.to_owned(),
    }
}

/// The head of an answer, and what follows it.
fn head(order: &Order) -> Result<(Head, Vec<u8>), String> {
    let mut answer = ask(order).map_err(|broken| match broken {
        Broken::Late => format!("it takes more than {} seconds to draw", WALL.as_secs()),
        Broken::Down => "drawing it broke down".to_owned(),
        Broken::Unable(why) => why,
    })?;
    let unreadable = || "what came back could not be read".to_owned();
    let end = answer.iter().position(|byte| *byte == b'\n');
    let rest = answer.split_off(end.ok_or_else(unreadable)? + 1);
    let head = serde_json::from_slice(&answer).map_err(|_| unreadable())?;
    Ok((head, rest))
}

/// What the crate that runs wants to know.
pub fn task(job: Job) -> Task {
    let Job {
        source,
        offered,
        function,
        params,
        points,
    } = job;
    Task {
        source,
        offered,
        function,
        params,
        points,
    }
}

fn ran(outcome: Outcome) -> Ran {
    match outcome {
        Outcome::Values(values) => Ran::Values(values),
        Outcome::Refused(complaint) => Ran::Refused {
            says: complaint.says,
            help: complaint.help,
            place: complaint.place.map(|place| CodePlace {
                line: place.line,
                column: place.column,
                width: place.width,
                text: place.text,
                mark: place.mark,
            }),
        },
        Outcome::Stopped(stop) => Ran::Stopped {
            point: Some(stop.point),
            says: stop.says,
        },
    }
}

/// Has an order carried out by a process of its own; its answer.
pub fn ask(order: &Order) -> Result<Vec<u8>, Broken> {
    let input = serde_json::to_vec(order).map_err(|error| Broken::Unable(error.to_string()))?;
    let program = program().map_err(|error| Broken::Unable(error.to_string()))?;
    let mut command = Command::new(program);
    command
        .arg(COMMAND)
        // Every thread reserves address space, which is limited there.
        .env("RAYON_NUM_THREADS", "2")
        .env("MALLOC_ARENA_MAX", "2")
        .env("RUST_BACKTRACE", "0");
    supervise(command, input, WALL)
}

/// This program, even where its file was replaced meanwhile.
fn program() -> std::io::Result<PathBuf> {
    let itself = PathBuf::from("/proc/self/exe");
    match cfg!(target_os = "linux") && itself.exists() {
        true => Ok(itself),
        false => env::current_exe(),
    }
}

/// Starts a process, gives it its input, and waits for its output, but not for long.
fn supervise(mut command: Command, input: Vec<u8>, limit: Duration) -> Result<Vec<u8>, Broken> {
    let started = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn();
    let mut child = started
        .map_err(|error| Broken::Unable(format!("no process could be started ({error})")))?;
    if let Some(mut stdin) = child.stdin.take() {
        // A process that ends early does not read on: its end says why.
        thread::spawn(move || stdin.write_all(&input));
    }
    let (send, answer) = mpsc::channel();
    if let Some(stdout) = child.stdout.take() {
        thread::spawn(move || {
            let mut bytes = Vec::new();
            let read = stdout.take(MOST_BYTES).read_to_end(&mut bytes);
            let _ = send.send(read.map(|_| bytes));
        });
    }
    match answer.recv_timeout(limit) {
        Ok(Ok(bytes)) => match end(&mut child, limit) {
            Some(status) if status.success() => Ok(bytes),
            Some(_) => Err(Broken::Down),
            None => Err(Broken::Late),
        },
        Ok(Err(error)) => {
            let _ = child.kill();
            let _ = child.wait();
            Err(Broken::Unable(error.to_string()))
        }
        Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
            let _ = child.kill();
            let _ = child.wait();
            Err(Broken::Late)
        }
    }
}

/// The end of a process that has said all it will; one that then lingers is ended.
fn end(child: &mut Child, limit: Duration) -> Option<ExitStatus> {
    const LOOK: Duration = Duration::from_millis(2);
    let mut waited = Duration::ZERO;
    while waited < limit {
        match child.try_wait() {
            Ok(Some(status)) => return Some(status),
            Ok(None) => {
                thread::sleep(LOOK);
                waited += LOOK;
            }
            Err(_) => break,
        }
    }
    let _ = child.kill();
    let _ = child.wait();
    None
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[track_caller]
    fn check(script: &str, limit: Duration, expected: Result<&[u8], Broken>) {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        let found = supervise(command, b"hello\n".to_vec(), limit);
        assert_eq!(found, expected.map(<[u8]>::to_vec), "{script}");
    }

    #[test]
    fn however_a_process_ends_it_is_an_outcome() {
        let long = Duration::from_secs(60);
        let short = Duration::from_millis(50);
        check("cat", long, Ok(b"hello\n"));
        check("exit 3", long, Err(Broken::Down));
        check("cat; kill -9 $$", long, Err(Broken::Down));
        check("kill -SEGV $$", long, Err(Broken::Down));
        check("exec sleep 60", short, Err(Broken::Late));
        check("exec 1>&-; exec sleep 60", short, Err(Broken::Late));
        check("while :; do :; done", short, Err(Broken::Late));
    }

    #[test]
    fn a_program_that_is_not_there_is_said_so() {
        let found = supervise(Command::new("/no/such/program"), Vec::new(), WALL);
        assert!(matches!(found, Err(Broken::Unable(why)) if why.contains("no process")));
    }
}
