//! Every subject at hard points and odd ones, within its bound.

use truth::stress::{Effort, Precision, bound, search, subjects};

#[track_caller]
fn check(precision: Precision, effort: Effort, seed: u64) {
    let mut bad = Vec::new();
    for subject in subjects().iter().filter(|subject| subject.has(precision)) {
        let finding = search(subject, precision, effort, seed);
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
    let effort = Effort {
        points: 5_000,
        climbs: 4,
        steps: 300,
        odd: 3_000,
    };
    for seed in [1, 2] {
        check(Precision::Single, effort, seed);
    }
}

#[test]
fn double_precision_is_close() {
    let effort = Effort {
        points: 60,
        climbs: 1,
        steps: 20,
        odd: 500,
    };
    check(Precision::Double, effort, 1);
}

/// What has to be measured, beside the terms.
#[test]
fn vectors_samplers_and_coordinates_are_searched() {
    for name in [
        "vector_specular",
        "vector_pdf",
        "sample_hemisphere",
        "sample_cap_pdf",
        "sample_bounded_weight",
        "d_ggx_world",
        "specular_ggx_world",
        "alpha_filtered",
        "albedo_ggx",
        "rusinkiewicz_and_back",
    ] {
        assert!(
            subjects().iter().any(|subject| subject.name == name),
            "{name}"
        );
    }
    for name in [
        "d_ggx",
        "v_ggx",
        "lambda_ggx",
        "vector_pdf",
        "f_dielectric",
        "t_conductor",
    ] {
        assert_eq!(bound(name), 12.0, "{name}");
    }
}
