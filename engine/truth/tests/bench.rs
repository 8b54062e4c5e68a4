//! The measurements run; their figures are nobody's promise here.

use std::time::Duration;
use truth::bench::{Effort, Row, limits, mark_pareto, run};

#[test]
fn everything_is_measured() {
    let effort = Effort {
        time: Duration::ZERO,
        points: 2,
    };
    let limits = limits(effort);
    let rows = run(effort, &limits, |_| {});
    for term in brdf::terms() {
        assert!(
            rows.iter().any(|row| row.group == term.name),
            "{}",
            term.name
        );
    }
    for (group, variant) in [
        ("specular", "batch"),
        ("specular", "hoisted"),
        ("specular_rgb", "call"),
        ("diffuse_hammon for walk", "20,000 walks"),
        ("albedo", "quadrature"),
    ] {
        assert!(
            rows.iter()
                .any(|row| row.group == group && row.variant == variant)
        );
    }
    assert!(
        rows.iter()
            .all(|row| row.ns > 0.0 && row.median_ulp <= row.max_ulp)
    );
}

#[test]
fn pareto_front() {
    let row = |ns, max_ulp| Row {
        group: String::new(),
        variant: String::new(),
        precision: "f32",
        isa: "baseline",
        ns,
        limit_ratio: None,
        needs: None,
        max_ulp,
        p999_ulp: 0.0,
        median_ulp: 0.0,
        error_unit: "ulp",
        pareto: false,
    };
    let mut rows = [row(1.0, 9.0), row(2.0, 3.0), row(3.0, 4.0), row(4.0, 1.0)];
    mark_pareto(&mut rows);
    assert_eq!(rows.map(|row| row.pareto), [true, true, false, true]);
}
