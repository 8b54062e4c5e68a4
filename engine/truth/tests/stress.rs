//! Every term at hard points, within its bound.

use truth::stress::{Effort, Precision, search, subjects};

#[track_caller]
fn check(precision: Precision, effort: Effort) {
    let mut bad = Vec::new();
    for term in subjects() {
        let finding = search(term, precision, effort, 1);
        println!(
            "{:26} {:9.2}  {:?}",
            finding.name, finding.worst_ulp, finding.at
        );
        if !finding.ok() {
            bad.push(finding);
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn single_precision_is_close() {
    check(
        Precision::Single,
        Effort {
            points: 20_000,
            climbs: 8,
            steps: 300,
        },
    );
}

#[test]
fn double_precision_is_close() {
    check(
        Precision::Double,
        Effort {
            points: 100,
            climbs: 1,
            steps: 30,
        },
    );
}
