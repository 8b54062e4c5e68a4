//! Prints the worst points of every term, and fails past the bounds: `--quick` for a short run,
//! `--seed=N` for other points, names for some of them only.

use std::process::ExitCode;
use truth::stress::{Effort, Precision, search, subjects};

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let quick = args.iter().any(|arg| arg == "--quick");
    let seed = args.iter().find_map(|arg| arg.strip_prefix("--seed="));
    let seed = seed.map_or(Ok(1), str::parse).unwrap_or_else(|_| {
        eprintln!("--seed= wants a whole number");
        std::process::exit(2)
    });
    let names: Vec<&String> = args.iter().filter(|arg| !arg.starts_with("--")).collect();
    let wanted = |name: &str| names.is_empty() || names.iter().any(|wanted| *wanted == name);
    let mut ok = true;
    for precision in [Precision::Single, Precision::Double] {
        let effort = if quick {
            Effort::QUICK
        } else {
            Effort::thorough(precision)
        };
        for subject in subjects().iter().filter(|subject| subject.has(precision)) {
            if !wanted(subject.name) {
                continue;
            }
            let finding = search(subject, precision, effort, seed);
            ok &= finding.ok();
            let of_jitter = finding
                .of_jitter
                .map_or(String::new(), |ratio| format!("{ratio:.3} of the jitter, "));
            println!(
                "{} {:26} {:8.2} of {:3}, {of_jitter}{} not finite  {:?} {:?}",
                precision.name(),
                finding.name,
                finding.worst_ulp,
                finding.bound,
                finding.nonfinite,
                finding.at,
                finding.odd
            );
        }
    }
    if ok {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
