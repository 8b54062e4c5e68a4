//! The formulas from vectors as data.

use crate::d::{ALPHA_X, ALPHA_Y};
use crate::ggx::{Fresnel, Ggx, Specular, v_dot_h_and_rest};
use crate::real::Real;
use crate::sampling::Sampler;
use crate::term::{ALPHA, F0, Param, Term, entry};

/// The formulas from vectors as data, so that their errors can be measured like those of the terms.
///
/// Their arguments are the components of the vectors one by one, `l_x` to `v_z` in the tangent frame or
/// `n_x` to `v_z` in the world, then the widths and reflectances. They have no WGSL twin.
///
/// ```
/// let terms = brdf::vector_terms();
/// let d = terms.iter().find(|term| term.name == "vector_d_ggx").expect("a term of that name");
/// // Light, view and α: the peak, seen straight on.
/// assert!(((d.f64)(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.5]) - brdf::d_ggx(1.0, 0.5)).abs() < 1e-14);
/// ```
pub fn vector_terms() -> &'static [Term] {
    VECTOR_TERMS
}

/// Makes a [`Term`] of a formula of vectors: `[v]` is a view in the tangent frame, `[l v]` a light and a
/// view there, `[n l v]` a normal, a light and a view in the world.
macro_rules! term {
    ($name:ident[$v:ident]($($arg:ident: $param:expr),*) = $value:expr, $($fact:tt)*) => {{
        fn $name<R: Real>(v_x: R, v_y: R, v_z: R $(, $arg: R)*) -> R {
            let $v = [v_x, v_y, v_z];
            $value
        }
        entry!($name(v_x: V_X, v_y: V_Y, v_z: V_Z $(, $arg: $param)*), $($fact)*, wgsl: None)
    }};
    ($name:ident[$l:ident $v:ident]($($arg:ident: $param:expr),*) = $value:expr, $($fact:tt)*) => {{
        #[allow(clippy::too_many_arguments)]
        fn $name<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R $(, $arg: R)*) -> R {
            let ($l, $v) = ([l_x, l_y, l_z], [v_x, v_y, v_z]);
            $value
        }
        entry!(
            $name(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z $(, $arg: $param)*),
            $($fact)*, wgsl: None
        )
    }};
    ($name:ident[$n:ident $l:ident $v:ident]($($arg:ident: $param:expr),*) = $value:expr, $($fact:tt)*) => {{
        #[allow(clippy::too_many_arguments)]
        fn $name<R: Real>(
            n_x: R, n_y: R, n_z: R, l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R $(, $arg: R)*
        ) -> R {
            let ($n, $l, $v) = ([n_x, n_y, n_z], [l_x, l_y, l_z], [v_x, v_y, v_z]);
            $value
        }
        entry!(
            $name(
                n_x: NORMAL, n_y: NORMAL, n_z: NORMAL, l_x: LIGHT, l_y: LIGHT, l_z: LIGHT,
                v_x: VIEW, v_y: VIEW, v_z: VIEW $(, $arg: $param)*
            ),
            $($fact)*, wgsl: None
        )
    }};
}

const VECTOR_TERMS: &[Term] = &[
    term!(
        vector_d_ggx[l v](alpha: ALPHA) = Ggx::new(alpha).d_between(l, v),
        symbol: "D", latex: "D", cost: 15,
        doc: "D of GGX from light and view in the tangent frame",
        source: "Walter et al. 2007, eq. 33"
    ),
    term!(
        vector_v_ggx[l v](alpha: ALPHA) = Ggx::new(alpha).visibility(l, v),
        symbol: "V", latex: "V", cost: 20,
        doc: "visibility of GGX from light and view in the tangent frame",
        source: "Heitz 2014, eq. 99"
    ),
    term!(
        vector_lambda_ggx[v](alpha: ALPHA) = Ggx::new(alpha).lambda(v),
        symbol: "Λ", latex: r"\Lambda", cost: 15,
        doc: "Lambda of GGX from a direction in the tangent frame",
        source: "Heitz 2014, eq. 72"
    ),
    term!(
        vector_f_schlick[l v](f0: F0) = schlick(f0).eval(l, v)[0],
        symbol: "F", latex: "F", cost: 25,
        doc: "Schlick's reflectance from light and view",
        source: "Schlick 1994"
    ),
    term!(
        vector_specular[l v](alpha: ALPHA, f0: F0) = {
            let (ggx, fresnel) = (Ggx::new(alpha), schlick(f0));
            Specular { ggx, fresnel }.eval_cos(l, v)[0]
        },
        symbol: "D V F cos θ", latex: r"D V F \cos\theta", cost: 60,
        doc: "specular BRDF times cosine from light and view in the tangent frame",
        source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99"
    ),
    term!(
        vector_pdf[l v](alpha: ALPHA) = Ggx::new(alpha).pdf(l, v, Sampler::SphericalCap),
        symbol: "p", latex: "p", cost: 25,
        doc: "density of lights drawn by the visible normals",
        source: "Heitz 2018; Dupuy and Benyoub 2023"
    ),
    term!(
        vector_d_ggx_aniso[l v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.d_between(l, v),
        symbol: "D", latex: "D", cost: 20,
        doc: "D of a stretched GGX surface from light and view in the tangent frame",
        source: "Burley 2012, eq. 13; Heitz 2018, eq. 1"
    ),
    term!(
        vector_v_ggx_aniso[l v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.visibility(l, v),
        symbol: "V", latex: "V", cost: 20,
        doc: "visibility of a stretched GGX surface from light and view in the tangent frame",
        source: "Heitz 2014, eq. 86 and 99"
    ),
    term!(
        vector_lambda_ggx_aniso[v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.lambda(v),
        symbol: "Λ", latex: r"\Lambda", cost: 15,
        doc: "Lambda of a stretched GGX surface from a direction in the tangent frame",
        source: "Heitz 2014, eq. 86"
    ),
    term!(
        vector_g1_ggx_aniso[v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.g1(v),
        symbol: "G₁", latex: "G_1", cost: 15,
        doc: "masking of a stretched GGX surface from a direction in the tangent frame",
        source: "Heitz 2014, eq. 43 and 86"
    ),
    term!(
        vector_eval_ggx_aniso[l v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.eval(l, v),
        symbol: "D V", latex: "D V", cost: 45,
        doc: "specular BRDF of a stretched GGX surface with F = 1",
        source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99"
    ),
    term!(
        vector_pdf_aniso[l v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.pdf(l, v, Sampler::SphericalCap),
        symbol: "p", latex: "p", cost: 25,
        doc: "density of lights drawn by the visible normals of a stretched surface",
        source: "Heitz 2018; Dupuy and Benyoub 2023"
    ),
    term!(
        vector_pdf_bounded_aniso[l v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.pdf(l, v, Sampler::BoundedCap),
        symbol: "p", latex: "p", cost: 30,
        doc: "density of lights drawn by bounded caps of a stretched surface",
        source: "Eto and Tokuyoshi 2023"
    ),
    term!(
        vector_weight_bounded_aniso[l v](alpha_x: ALPHA_X, alpha_y: ALPHA_Y)
            = Ggx { alpha_x, alpha_y }.weight(l, v, Sampler::BoundedCap),
        symbol: "w", latex: "w", cost: 40,
        doc: "weight of lights drawn by bounded caps of a stretched surface",
        source: "Eto and Tokuyoshi 2023"
    ),
    term!(
        vector_v_dot_h[l v]() = v_dot_h_and_rest(l, v).0,
        symbol: "V·H", latex: r"V \cdot H", cost: 12,
        doc: "cosine between view and half vector, from vectors",
        source: "Hammon 2017"
    ),
    term!(
        vector_one_minus_v_dot_h[l v]() = v_dot_h_and_rest(l, v).1,
        symbol: "1 − V·H", latex: r"1 - V \cdot H", cost: 20,
        doc: "1 minus the cosine between view and half vector, from vectors",
        source: "Hammon 2017"
    ),
    term!(
        d_ggx_world[n l v](alpha: ALPHA) = crate::d_ggx_world(n, l, v, alpha),
        symbol: "D", latex: "D", cost: 60,
        doc: "D of GGX from normal, light and view in world space",
        source: "Walter et al. 2007, eq. 33"
    ),
    term!(
        specular_ggx_world[n l v](alpha: ALPHA, f0: F0)
            = crate::specular_ggx_world(n, l, v, alpha, &schlick(f0))[0],
        symbol: "D V F cos θ", latex: r"D V F \cos\theta", cost: 150,
        doc: "specular BRDF times cosine from normal, light and view in world space",
        source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99"
    ),
];

fn schlick<R: Real>(f0: R) -> Fresnel<R> {
    Fresnel::Schlick { f0: [f0; 3] }
}

/// A component of a vector; the name is that of the argument.
const fn component(lowest: f64, meaning: &'static str) -> Param {
    Param {
        name: "",
        range: (lowest, 1.0),
        unit: "1",
        meaning,
    }
}

const L_X: Param = component(-1.0, "light along the tangent");
const L_Y: Param = component(-1.0, "light along the bitangent");
const L_Z: Param = component(1e-6, "light along the normal");
const V_X: Param = component(-1.0, "view along the tangent");
const V_Y: Param = component(-1.0, "view along the bitangent");
const V_Z: Param = component(1e-6, "view along the normal");
const NORMAL: Param = component(-1.0, "normal in the world, a component");
const LIGHT: Param = component(-1.0, "light in the world, a component");
const VIEW: Param = component(-1.0, "view in the world, a component");
