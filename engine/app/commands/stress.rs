//! `lobe stress`: where each function of the core is worst, and whether that is within its
//! bound.

use std::collections::BTreeMap;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use brdf::Term;
use serde::{Serialize, Serializer};
use truth::stress::{Effort, Finding, Precision, search, subjects};

use crate::cli::Stress;
use crate::exit::{Done, Failure};
use crate::{lessons, output, text};

/// The same points in every run: a finding can be looked at again.
const SEED: u64 = 1;

pub fn run(args: &Stress) -> Result<Done, Failure> {
    let effort = if args.quick {
        Effort::QUICK
    } else {
        Effort::THOROUGH
    };
    let terms = wanted(&args.names)?;
    let tasks: Vec<(Precision, &'static Term)> = [Precision::Single, Precision::Double]
        .into_iter()
        .flat_map(|precision| terms.iter().map(move |&term| (precision, term)))
        .collect();
    if !args.json {
        output::text(&heading())?;
    }
    let mut bad = 0;
    search_all(&tasks, effort, |finding| {
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

/// The terms of those names, or all.
fn wanted(names: &[String]) -> Result<Vec<&'static Term>, Failure> {
    let all: Vec<&'static Term> = subjects().collect();
    if names.is_empty() {
        return Ok(all);
    }
    let find = |name: &String| {
        let found = all.iter().copied().find(|term| term.name == name);
        found.ok_or_else(|| {
            let known = all.iter().map(|term| term.name);
            let hint = "`lobe stress --quick` names all that have a closed form";
            lessons::unknown("function", name, known, hint)
        })
    };
    names.iter().map(find).collect()
}

/// Searches on all cores and hands the findings over in the order of the tasks.
fn search_all(
    tasks: &[(Precision, &'static Term)],
    effort: Effort,
    mut found: impl FnMut(&Finding) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let next = AtomicUsize::new(0);
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..cores.min(tasks.len()) {
            let (sender, next) = (sender.clone(), &next);
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&(precision, term)) = tasks.get(index) else {
                        return;
                    };
                    let finding = search(term, precision, effort, SEED);
                    // Nobody listens any more where the output went away.
                    if sender.send((index, finding)).is_err() {
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
         textbook forms in high precision; alpha from 1e-4, cosines from 1e-6.\n\n  \
         {:<26} {:<4} {:>8} {:>6} {:>10}  at\n",
        "function", "", "ulp", "bound", "not finite"
    )
}

fn row(finding: &Finding) -> String {
    let at: Vec<String> = finding
        .at
        .iter()
        .map(|&(name, x)| format!("{name}={}", shortest(x, finding.precision)))
        .collect();
    let first = format!(
        "{} {:<26} {:<4} {:>8.2} {:>6} {:>10}  ",
        if finding.ok() { ' ' } else { '!' },
        finding.name,
        finding.precision.name(),
        finding.worst_ulp,
        finding.bound,
        finding.nonfinite,
    );
    let rest = " ".repeat(first.chars().count());
    let mut lines = text::wrap_plain(&at.join(", "), 120, &first, &rest).join("\n");
    lines.push('\n');
    lines
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
            nonfinite: finding.nonfinite,
            ok: finding.ok(),
        }
    }
}

/// The arguments by name, in their order.
fn object<S: Serializer>(at: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(at.iter().copied())
}
