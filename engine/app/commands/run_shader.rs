//! `lobe run-shader`, hidden: the process in which a learner's shader runs. It limits itself
//! before it reads a word.

use std::io::{Read as _, Write as _, stdin, stdout};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread;

use renders::{Fingerprint, Own, profile_own, render_own};
use shader::{Limits, Program};
use tutor::exercise::shader::call;

use crate::exit::{Done, Failure};
use crate::fingerprints::{PROFILE_ROWS, own_fingerprint};
use crate::shaders::{self, Ball, Head, Order};

/// Bytes of address space.
#[cfg(unix)]
const MEMORY: u64 = 1 << 30;
/// Seconds of processor time, for the case that nobody waits any more.
#[cfg(unix)]
const SECONDS: u64 = 10;
/// Bytes of stack: what reads WGSL recurses.
const STACK: usize = 64 << 20;
/// No order is longer.
const MOST_BYTES: u64 = 64 << 20;

pub fn run() -> Result<Done, Failure> {
    limit_itself();
    let broken = |what: &str| Failure::unusable(what.to_owned());
    let mut input = Vec::new();
    stdin()
        .lock()
        .take(MOST_BYTES)
        .read_to_end(&mut input)
        .map_err(|_| broken("the order could not be read"))?;
    let order: Order = serde_json::from_slice(&input)
        .map_err(|_| broken("this command is for the program itself"))?;
    let work = thread::Builder::new()
        .stack_size(STACK)
        .spawn(move || carry_out(order))
        .map_err(|_| broken("no thread could be started"))?;
    let answer = work.join().map_err(|_| broken("the run broke down"))?;
    let mut out = stdout().lock();
    out.write_all(&answer)
        .and_then(|()| out.flush())
        .map_err(|_| broken("nobody reads the answer"))?;
    Ok(Done::Fine)
}

fn carry_out(order: Order) -> Vec<u8> {
    match order {
        Order::Run(task) => {
            let outcome = shader::run(&task, Limits::default());
            serde_json::to_vec(&outcome).unwrap_or_default()
        }
        Order::Draw(ball, size) => {
            let drawn = with_ball(&ball, |fingerprint, own, cancel| {
                let options = renders::Options {
                    size,
                    compact: true,
                    ..renders::Options::default()
                };
                render_own(fingerprint, own, &options, cancel).map_err(|error| error.to_string())
            });
            match drawn {
                Ok(picture) => {
                    let mut answer = line(&Head::Picture(picture.width, picture.height));
                    answer.extend(picture.rgba);
                    answer
                }
                Err(why) => line(&Head::Nothing(why)),
            }
        }
        Order::Profile(ball) => {
            let points = with_ball(&ball, |fingerprint, own, _| {
                Ok(profile_own(fingerprint, own, PROFILE_ROWS))
            });
            line(&match points {
                Ok(points) => Head::Profile(points.iter().map(shaders::bits).collect()),
                Err(why) => Head::Nothing(why),
            })
        }
    }
}

fn line(head: &Head) -> Vec<u8> {
    let mut line = serde_json::to_vec(head).unwrap_or_default();
    line.push(b'\n');
    line
}

/// Does something with the ball of a learner's function. A call that gives no value ends it.
fn with_ball<T>(
    ball: &Ball,
    work: impl FnOnce(&Fingerprint<'_>, &Own, &AtomicBool) -> Result<T, String>,
) -> Result<T, String> {
    let (lesson, _) = tutor::load(&ball.file, &ball.lesson);
    let lesson = lesson.ok_or("the lesson cannot be read")?;
    let exercise = lesson.exercise(&ball.exercise);
    let job = exercise.and_then(|exercise| call(&lesson, exercise, &ball.source));
    let job = job.ok_or("the lesson has no such exercise")?;
    let fingerprint =
        own_fingerprint(&lesson, &ball.exercise).ok_or("the exercise has no scene")?;
    let task = shaders::task(job);
    let program = Program::read(&task, Limits::default()).map_err(|complaint| complaint.says)?;
    let (cancel, stopped) = (Arc::new(AtomicBool::new(false)), Arc::new(OnceLock::new()));
    let (cancelled, stop) = (Arc::clone(&cancel), Arc::clone(&stopped));
    let own = Own::new(task.params, move |points| {
        program.values(points).unwrap_or_else(|why| {
            let _ = stop.set(why.says);
            cancelled.store(true, Ordering::Relaxed);
            Vec::new()
        })
    });
    let done = work(&fingerprint, &own, &cancel);
    match stopped.get() {
        Some(says) => Err(says.clone()),
        None => done,
    }
}

#[cfg(unix)]
fn limit_itself() {
    use rustix::process::{Resource, Rlimit, setrlimit};
    let most = |limit: u64| Rlimit {
        current: Some(limit),
        maximum: Some(limit),
    };
    // A system that knows no such limit has the others, and the one who waits.
    let _ = setrlimit(Resource::As, most(MEMORY));
    let _ = setrlimit(Resource::Cpu, most(SECONDS));
    let _ = setrlimit(Resource::Core, most(0));
}

#[cfg(not(unix))]
fn limit_itself() {}
