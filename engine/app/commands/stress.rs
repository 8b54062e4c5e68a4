//! `lobe stress`: where each function of the core is worst, and whether that is within its
//! bound.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use serde::{Serialize, Serializer};
use truth::stress::{Effort, Finding, Precision, Subject, search, subjects};

use crate::cli::Stress;
use crate::exit::{Done, Failure};
use crate::{lessons, output, text};

pub fn run(args: &Stress) -> Result<Done, Failure> {
    let effort = |precision| {
        if args.quick {
            Effort::QUICK
        } else {
            Effort::thorough(precision)
        }
    };
    let subjects = wanted(&args.names)?;
    let tasks: Vec<(Precision, &'static Subject)> = [Precision::Single, Precision::Double]
        .into_iter()
        .flat_map(|precision| subjects.iter().map(move |&subject| (precision, subject)))
        .filter(|(precision, subject)| subject.has(*precision))
        .collect();
    if !args.json {
        output::text(&heading())?;
    }
    let mut bad = 0;
    let find = |&(precision, subject): &(Precision, &'static Subject)| {
        search(subject, precision, effort(precision), args.seed)
    };
    search_all(&tasks, find, |finding| {
        bad += usize::from(!finding.ok());
        if args.json {
            output::json(&Line::of(finding))
        } else {
            output::text(&row(finding))
        }
    })?;
    if !args.json {
        output::line(&format!(
            "\n{} searches, {bad} past their bounds. A point can be looked at again:\n  \
             lobe eval --precision f32 'd_ggx(n_dot_h = …, alpha = …)'",
            tasks.len()
        ))?;
    }
    Ok(Done::found(bad > 0))
}

/// The subjects of those names, or all.
fn wanted(names: &[String]) -> Result<Vec<&'static Subject>, Failure> {
    let all: Vec<&'static Subject> = subjects().iter().collect();
    if names.is_empty() {
        return Ok(all);
    }
    let find = |name: &String| {
        let found = all.iter().copied().find(|subject| subject.name == name);
        found.ok_or_else(|| {
            let known = all.iter().map(|subject| subject.name);
            let hint = "`lobe stress --quick` names all that can be searched";
            lessons::unknown("function", name, known, hint)
        })
    };
    names.iter().map(find).collect()
}

/// Searches on all cores and hands the findings over in the order of the tasks.
fn search_all(
    tasks: &[(Precision, &'static Subject)],
    find: impl Fn(&(Precision, &'static Subject)) -> Finding + Sync,
    mut found: impl FnMut(&Finding) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let next = AtomicUsize::new(0);
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..cores.min(tasks.len()) {
            let (sender, next, find) = (sender.clone(), &next, &find);
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(task) = tasks.get(index) else {
                        return;
                    };
                    // Nobody listens any more where the output went away.
                    if sender.send((index, find(task))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let mut early = BTreeMap::new();
        let mut shown = 0;
        for (count, (index, finding)) in receiver.iter().enumerate() {
            let name = finding.name;
            early.insert(index, finding);
            output::progress("");
            while let Some(finding) = early.remove(&shown) {
                found(&finding)?;
                shown += 1;
            }
            output::progress(&format!("{} of {}  {name}", count + 1, tasks.len()));
        }
        output::progress("");
        Ok(())
    })
}

fn heading() -> String {
    format!(
        "The worst error found, in units of the last place (ulp) of the true value, against the\n\
         textbook forms in high precision; alpha from 1e-4, cosines from 1e-6. Of world space and\n\
         of drawn directions the error is at most the bound or what half an ulp in each argument\n\
         changes, whichever is more: jitter is the largest share of that where it is more.\n\n  \
         {:<26} {:<4} {:>8} {:>6} {:>7} {:>10}  at\n",
        "function", "", "ulp", "bound", "jitter", "not finite"
    )
}

fn row(finding: &Finding) -> String {
    let point = |at: &[(&str, f64)]| {
        let at = at.iter();
        at.map(|&(name, x)| format!("{name}={}", shortest(x, finding.precision)))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let first = format!(
        "{} {:<26} {:<4} {:>8.2} {:>6} {:>7} {:>10}  ",
        if finding.ok() { ' ' } else { '!' },
        finding.name,
        finding.precision.name(),
        finding.worst_ulp,
        finding.bound,
        finding
            .of_jitter
            .map_or(String::new(), |share| format!("{share:.3}")),
        finding.nonfinite,
    );
    let rest = " ".repeat(first.chars().count());
    let mut lines = text::wrap_plain(&point(&finding.at), 120, &first, &rest);
    if let Some(odd) = &finding.odd {
        let says = format!("{}: {}", odd.fault.says(), point(&odd.at));
        lines.extend(text::wrap_plain(&says, 120, &rest, &rest));
    }
    lines.join("\n") + "\n"
}

/// The fewest digits that give the number back.
fn shortest(x: f64, precision: Precision) -> String {
    match precision {
        Precision::Single => format!("{:?}", x as f32),
        Precision::Double => format!("{x:?}"),
    }
}

/// A finding as JSON.
#[derive(Serialize)]
struct Line<'a> {
    #[serde(rename = "fn")]
    name: &'a str,
    precision: &'a str,
    /// null where it is infinite: the result is not finite, and should be.
    worst_ulp: Option<f64>,
    #[serde(serialize_with = "object")]
    at: &'a [(&'static str, f64)],
    bound: f64,
    /// Share of what the arguments' rounding changes; absent where that is no excuse.
    #[serde(skip_serializing_if = "Option::is_none")]
    of_jitter: Option<f64>,
    nonfinite: u32,
    ok: bool,
}

impl<'a> Line<'a> {
    fn of(finding: &'a Finding) -> Self {
        Self {
            name: finding.name,
            precision: finding.precision.name(),
            worst_ulp: Some(finding.worst_ulp).filter(|ulp| ulp.is_finite()),
            at: &finding.at,
            bound: finding.bound,
            of_jitter: finding.of_jitter.filter(|share| share.is_finite()),
            nonfinite: finding.nonfinite,
            ok: finding.ok(),
        }
    }
}

/// The arguments by name, in their order.
fn object<S: Serializer>(at: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(at.iter().copied())
}
