//! Prints the worst points of every term, and fails past the bounds: `--quick` for a short run.

use std::process::ExitCode;
use truth::stress::{Effort, Precision, search, subjects};

fn main() -> ExitCode {
    let quick = std::env::args().any(|arg| arg == "--quick");
    let mut ok = true;
    for precision in [Precision::Single, Precision::Double] {
        let effort = if quick {
            Effort::QUICK
        } else {
            Effort::thorough(precision)
        };
        for subject in subjects().iter().filter(|subject| subject.has(precision)) {
            let finding = search(subject, precision, effort, 1);
            ok &= finding.ok();
            println!(
                "{} {:26} {:8.2} of {:3} {:3} not finite  {:?}",
                precision.name(),
                finding.name,
                finding.worst_ulp,
                finding.bound,
                finding.nonfinite,
                finding.at
            );
        }
    }
    if ok {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
