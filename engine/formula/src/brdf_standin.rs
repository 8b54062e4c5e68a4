//! Stand-in until the core has landed.
#![allow(dead_code)]
use std::sync::LazyLock;
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Param {
    pub name: &'static str,
    pub range: (f64, f64),
    pub unit: &'static str,
    pub meaning: &'static str,
}
#[derive(Debug, Clone, Copy)]
pub struct Term {
    pub name: &'static str,
    pub params: &'static [Param],
    pub doc: &'static str,
    pub source: &'static str,
    pub symbol: &'static str,
    pub latex: &'static str,
    pub f64: fn(&[f64]) -> f64,
    pub f32: fn(&[f32]) -> f32,
    pub wgsl: Option<&'static str>,
    pub wgsl_needs: &'static [&'static str],
    pub cost: u32,
}
const fn p(name: &'static str) -> Param {
    Param {
        name,
        range: (0.01, 1.0),
        unit: "1",
        meaning: "",
    }
}
macro_rules! t {
    ($name:literal, [$($p:ident),*], $symbol:literal, $body:expr) => {
        Term { name: $name, params: const { &[$(p(stringify!($p))),*] }, doc: "", source: "", symbol: $symbol, latex: $symbol,
            f64: |a| match *a { [$($p),*] => { let f: fn($(t!(@f64 $p)),*) -> f64 = $body; f($($p),*) } _ => f64::NAN },
            f32: |a| match *a { [$($p),*] => { let f: fn($(t!(@f64 $p)),*) -> f64 = $body; f($(f64::from($p)),*) as f32 } _ => f32::NAN },
            wgsl: None, wgsl_needs: &[], cost: 1 }
    };
    (@f64 $p:ident) => { f64 };
}
fn d(c: f64, a: f64) -> f64 {
    let t = a / (a * a * c * c + 1.0 - c * c);
    t * t / std::f64::consts::PI
}
fn root(c: f64, a: f64) -> f64 {
    (a * a + (1.0 - a * a) * c * c).sqrt()
}
fn v(l: f64, v: f64, a: f64) -> f64 {
    0.5 / (l * root(v, a) + v * root(l, a))
}
fn lambda(c: f64, a: f64) -> f64 {
    (root(c, a) / c - 1.0) / 2.0
}
static TERMS: LazyLock<Vec<Term>> = LazyLock::new(|| {
    vec![
        t!("d_ggx", [n_dot_h, alpha], "D_GGX", d),
        t!("d_beckmann", [n_dot_h, alpha], "D_Beckmann", |c, a| {
            let t = 1.0 / (a * c * c);
            (-(1.0 - c * c) / (a * a * c * c)).exp() * t * t / std::f64::consts::PI
        }),
        t!("v_ggx", [n_dot_l, n_dot_v, alpha], "V_GGX", v),
        t!("g2_ggx", [n_dot_l, n_dot_v, alpha], "G₂", |l, w, a| v(
            l, w, a
        )
            * 4.0
            * l
            * w),
        t!(
            "v_ggx_separable",
            [n_dot_l, n_dot_v, alpha],
            "V_sep",
            |l, w, a| 1.0 / (1.0 + lambda(l, a)) / (1.0 + lambda(w, a)) / (4.0 * l * w)
        ),
        t!(
            "g2_ggx_separable",
            [n_dot_l, n_dot_v, alpha],
            "G₂_sep",
            |l, w, a| 1.0 / (1.0 + lambda(l, a)) / (1.0 + lambda(w, a))
        ),
        t!("g1_ggx", [n_dot_x, alpha], "G₁", |c, a| 1.0
            / (1.0 + lambda(c, a))),
        t!("lambda_ggx", [n_dot_x, alpha], "Λ", lambda),
        t!("f_schlick", [f0, v_dot_h], "F", |f0, c| f0
            + (1.0 - f0) * (1.0 - c).powi(5)),
        t!(
            "specular_ggx",
            [n_dot_l, n_dot_v, n_dot_h, roughness],
            "f",
            |l, w, h, r| d(h, r * r) * v(l, w, r * r)
        ),
        t!("integral_d_ggx", [alpha], "∫D", |a| 1.0 + a),
        t!("albedo_ggx", [n_dot_v, alpha], "E", |c, a| 1.0
            - c * a / 2.0),
    ]
});
pub fn terms() -> &'static [Term] {
    &TERMS
}
pub fn term(name: &str) -> Option<&'static Term> {
    terms().iter().find(|t| t.name == name)
}
