//! What must hold everywhere: reciprocity, ranges, limits and exact anchors.

use brdf::*;
use proptest::prelude::*;

fn cosine() -> impl Strategy<Value = f64> {
    prop_oneof![
        1e-6..1.0f64,
        (1e-6f64.ln()..0.0f64).prop_map(f64::exp),
        Just(1.0)
    ]
}

fn width() -> impl Strategy<Value = f64> {
    prop_oneof![
        1e-4..1.0f64,
        (1e-4f64.ln()..0.0f64).prop_map(f64::exp),
        Just(1.0)
    ]
}

#[track_caller]
fn close(a: f64, b: f64, relative: f64) {
    assert!(
        (a - b).abs() <= relative * (a.abs() + b.abs()),
        "{a} is not {b}"
    );
}

/// A light and a view as cosines that belong together: N·L, N·V, L·V.
fn pair() -> impl Strategy<Value = (f64, f64, f64)> {
    (cosine(), cosine(), -1.0..1.0f64).prop_map(|(l, v, cos_phi)| {
        let sines = ((1.0 - l * l) * (1.0 - v * v)).sqrt();
        (l, v, (l * v + sines * cos_phi).clamp(-1.0, 1.0))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn two_direction_terms_are_reciprocal((l, v, lv) in pair(), a in width(), cos_phi in -1.0..1.0f64) {
        let h = v_dot_h_from(l, v, lv);
        for (name, rest) in [
            ("g2_ggx", vec![a]), ("g2_ggx_separable", vec![a]), ("g2_ggx_hammon", vec![a]), ("g2_beckmann", vec![a]),
            ("v_ggx", vec![a]), ("v_ggx_separable", vec![a]), ("v_ggx_hammon", vec![a]),
            ("gsf_implicit", vec![]), ("gsf_ashikhmin_shirley", vec![h]), ("gsf_ashikhmin_premoze", vec![]),
            ("gsf_duer", vec![lv]), ("gsf_neumann", vec![]), ("gsf_kelemen", vec![h]), ("gsf_ward", vec![]),
            ("gsf_kurt", vec![h, a]), ("gsf_walter", vec![a]), ("gsf_smith_beckmann", vec![a]), ("gsf_ggx", vec![a]),
            ("gsf_schlick", vec![a]), ("gsf_schlick_beckmann", vec![a]), ("gsf_schlick_ggx", vec![a]),
            ("diffuse_disney", vec![h, a, 0.7]), ("diffuse_oren_nayar", vec![cos_phi, a, 0.7]),
            ("diffuse_oren_nayar_full", vec![cos_phi, a, 0.7]), ("diffuse_hammon", vec![lv, a, 0.7]),
            ("diffuse_eon", vec![lv, a, 0.7]),
        ] {
            let f = term(name).unwrap().f64;
            let (forth, back) = (f(&[&[l, v], &rest[..]].concat()), f(&[&[v, l], &rest[..]].concat()));
            prop_assert!((forth - back).abs() <= 4e-15 * forth.abs(), "{name}: {forth} and {back}");
        }
    }

    #[test]
    fn masking_is_a_share((l, v, _) in pair(), a in width()) {
        for name in ["g2_ggx", "g2_ggx_separable", "g2_ggx_hammon", "g2_beckmann",
            "gsf_walter", "gsf_schlick", "gsf_schlick_beckmann", "gsf_schlick_ggx"] {
            let g = (term(name).unwrap().f64)(&[l, v, a]);
            prop_assert!((0.0..=1.0 + 1e-15).contains(&g), "{name} = {g}");
        }
        prop_assert!(g2_ggx_separable(l, v, a) <= g2_ggx(l, v, a) * (1.0 + 1e-15));
        prop_assert!(g2_ggx_hammon(l, v, a) <= g2_ggx(l, v, a) * (1.0 + 1e-15));
    }

    #[test]
    fn smith_hangs_together((l, v, _) in pair(), a in width()) {
        close(g1_ggx(v, a), 1.0 / (1.0 + lambda_ggx(v, a)), 1e-15);
        close(one_minus_g1_ggx(v, a), 1.0 - g1_ggx(v, a), 1e-15 / one_minus_g1_ggx(v, a).max(1e-300));
        close(one_minus_g1_ggx(v, a), lambda_ggx(v, a) * g1_ggx(v, a), 1e-14);
        close(v_ggx(l, v, a), g2_ggx(l, v, a) / (4.0 * l * v), 1e-14);
        close(v_ggx_separable(l, v, a), g1_ggx(l, a) * g1_ggx(v, a) / (4.0 * l * v), 1e-14);
        close(v_ggx_hammon(l, v, a), g2_ggx_hammon(l, v, a) / (4.0 * l * v), 1e-14);
        let separable = 1.0 - (1.0 - g1_ggx(l, a)) * (1.0 - g1_ggx(v, a));
        close(g2_ggx_separable(l, v, a) / g2_ggx(l, v, a), separable, 1e-9);
        close(gsf_ggx(l, v, a), g2_ggx_separable(l, v, a), 1e-15);
        prop_assert!((g1_beckmann_rational(v, a) - g1_beckmann(v, a)).abs() < 0.0036);
    }

    #[test]
    fn rougher_masks_more(v in cosine(), a in width(), factor in 1.0..2.0f64) {
        prop_assert!(g1_ggx(v, a * factor) <= g1_ggx(v, a));
        prop_assert!(g1_beckmann(v, a * factor) <= g1_beckmann(v, a) * (1.0 + 1e-15));
    }

    #[test]
    fn reflectance_is_a_share(c in 0.0..=1.0f64, n in 0.05..4.0f64, k in 0.0..8.0f64) {
        for f in [f_dielectric(n, c), f_conductor(n, k, c), f_schlick_ior(n, c)] {
            prop_assert!((0.0..=1.0 + 1e-15).contains(&f), "{f}");
        }
        close(f_conductor(n, 0.0, c), f_dielectric(n, c), 1e-12);
        close(f_lazanyi(0.5, 0.0, c), f_schlick(0.5, c), 1e-15);
    }

    #[test]
    fn ends_of_fresnel(n in 1.0001..4.0f64, f0 in 0.0..1.0f64) {
        let normal = ((n - 1.0) / (n + 1.0)).powi(2);
        close(f_dielectric(n, 1.0), normal, 1e-14);
        close(f_schlick_ior(n, 1.0), normal, 1e-14);
        prop_assert_eq!(f_schlick(f0, 1.0), f0);
        close(f_schlick(f0, 0.0), 1.0, 1e-15);
        close(f_dielectric(n, 0.0), 1.0, 1e-14);
        // Brewster's angle: only one polarisation is reflected.
        let c = 1.0 / (1.0 + n * n).sqrt();
        close(f_dielectric(n, c), 0.5 * ((n * n - 1.0) / (n * n + 1.0)).powi(2), 1e-11);
    }

    #[test]
    fn isotropic_is_a_case_of_anisotropic(c in cosine(), phi in 0.0..6.3f64, a in width()) {
        let s = ((1.0 - c) * (1.0 + c)).sqrt();
        close(d_ggx_aniso(s * phi.cos(), s * phi.sin(), c, a, a), d_ggx(c, a), 1e-12);
    }

    #[test]
    fn eon_keeps_all_light_at_albedo_one(v in 0.05..1.0f64, r in 0.0..=1.0f64) {
        // ∫ f N·L dω by the midpoint rule.
        let (steps, turns) = (200, 100);
        let mut sum = 0.0;
        for i in 0..steps {
            let l = (i as f64 + 0.5) / steps as f64;
            let sines = ((1.0 - l * l) * (1.0 - v * v)).sqrt();
            for j in 0..turns {
                let phi = std::f64::consts::PI * (j as f64 + 0.5) / turns as f64;
                sum += diffuse_eon(l, v, l * v + sines * phi.cos(), r, 1.0) * l;
            }
        }
        close(sum * 2.0 * std::f64::consts::PI / (steps * turns) as f64, 1.0, 2e-4);
    }
}

#[test]
fn normalisation_of_distributions() {
    for name in ["d_ggx", "d_beckmann", "d_blinn_phong"] {
        for alpha in [0.1, 0.3, 0.7, 1.0] {
            let steps = 400_000;
            let d = term(name).unwrap().f64;
            let (mut cos, mut area) = (0.0, 0.0);
            for i in 0..steps {
                let c = (i as f64 + 0.5) / steps as f64;
                cos += d(&[c, alpha]) * c;
                area += d(&[c, alpha]);
            }
            let whole = 2.0 * std::f64::consts::PI / steps as f64;
            close(cos * whole, 1.0, 1e-6);
            if name == "d_ggx" {
                close(area * whole, integral_d_ggx(alpha), 1e-5);
            }
        }
    }
}

#[test]
fn visible_facets_cover_the_surface() {
    for mu in [0.05, 0.3, 0.7, 1.0f64] {
        for alpha in [0.05, 0.3, 1.0] {
            close(integral_g1_d_ggx(mu, alpha), 1.0, 1e-7);
        }
    }
}

#[test]
fn albedo_of_the_roughest_surface() {
    for mu in [1e-4, 0.01, 0.05, 0.2, 0.5, 0.9, 1.0f64] {
        close(albedo_ggx(mu, 1.0), 1.0 - mu * (1.0 / mu).ln_1p(), 1e-12);
    }
}

#[test]
fn figures_of_the_lessons() {
    for (value, expected) in [
        (d_ggx(0.95, 0.16), 0.560230396322),
        (d_ggx(0.95, 0.49), 0.774206618586),
        (d_beckmann(0.95, 0.16), 0.224373712648),
        (integral_d_ggx(0.16), 1.06533492660),
        (integral_d_ggx(0.49), 1.36913605113),
        (v_ggx(0.8, 0.6, 0.16), 0.513218039315),
        (g2_ggx(0.8, 0.6, 0.16), 0.985378635485),
        (g2_ggx_separable(0.8, 0.6, 0.16), 0.985339449134),
        (albedo_ggx(0.5, 0.16), 0.926437508815),
        (albedo_ggx_divided_twice(0.5, 0.16), 1.08152269305),
        (share_ratio_above(1.0, 60.0), 1.0 / 3.0),
        (n_dot_h_from(0.8, 0.6, 0.96), 1.4 / 3.92f64.sqrt()),
    ] {
        close(value, expected, 1e-11);
    }
    assert_eq!(integral_d_ggx(1.0), 2.0);
    assert_eq!(integral_d_ggx(0.0), 1.0);
    assert_eq!(d_ggx(1.0, 0.0), f64::INFINITY);
    assert_eq!(d_ggx(0.999, 0.0), 0.0);
}
