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
    let worst = |group: &str, variant: &str| {
        let row = rows
            .iter()
            .find(|row| row.group == group && row.variant == variant);
        row.unwrap_or_else(|| panic!("{group} {variant} is missing"))
            .max_ulp
    };
    // Wide bounds: what is wrong by more is not what it is called.
    for (group, variant, low, high) in [
        ("specular", "batch", 0.1, 100.0),
        ("specular", "hoisted", 0.1, 100.0),
        ("specular_rgb", "call", 0.1, 100.0),
        ("d_ggx", "batch", 0.1, 12.0),
        ("g2_ggx approximated", "g2_ggx_hammon", 0.05, 0.3),
        ("f_conductor approximated", "f_lazanyi", 1e-3, 0.2),
        ("walk approximated", "diffuse_hammon", 0.01, 0.3),
        ("albedo", "quadrature", 0.0, 1e-5),
        ("albedo", "bounded cap, 4096 samples", 1e-5, 0.05),
        ("albedo", "fit, MaterialX", 1e-3, 0.1),
        ("albedo_at_alpha_1", "quadrature", 0.0, 1e-10),
        ("weak_furnace", "integral_g1_d_ggx", 0.0, 1e-10),
        ("furnace", "single scattering", 0.5, 0.8),
        ("furnace", "f_multi_kulla_conty", 0.0, 1e-5),
        ("furnace_diffuse", "diffuse_eon", 0.0, 1e-3),
        ("reciprocity", "diffuse_hammon", 0.0, 1e-5),
        ("reciprocity", "gsf_modified_kelemen", 0.1, 1.0),
        ("walk_albedo", "100000 walks", 1e-5, 0.03),
        ("walk_energy", "walk", 0.0, 1e-12),
    ] {
        let worst = worst(group, variant);
        assert!((low..=high).contains(&worst), "{group} {variant}: {worst}");
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
        products_ratio: None,
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
