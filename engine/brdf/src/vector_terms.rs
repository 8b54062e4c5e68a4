//! The formulas from vectors as data.

use crate::d::{ALPHA_X, ALPHA_Y};
use crate::ggx::{Fresnel, Ggx, Specular, v_dot_h_and_rest};
use crate::real::Real;
use crate::sampling::Sampler;
use crate::term::{ALPHA, F0, Param, Term, entry};

/// The formulas from vectors as data, so that their errors can be measured like those of the
/// terms. Lessons do not call them, and they have no WGSL twin.
pub fn vector_terms() -> &'static [Term] {
    VECTOR_TERMS
}

const VECTOR_TERMS: &[Term] = &[
    VECTOR_D_GGX,
    VECTOR_V_GGX,
    VECTOR_LAMBDA_GGX,
    VECTOR_F_SCHLICK,
    VECTOR_SPECULAR,
    VECTOR_PDF,
    VECTOR_D_GGX_ANISO,
    VECTOR_V_GGX_ANISO,
    VECTOR_LAMBDA_GGX_ANISO,
    VECTOR_G1_GGX_ANISO,
    VECTOR_EVAL_GGX_ANISO,
    VECTOR_PDF_ANISO,
    VECTOR_PDF_BOUNDED_ANISO,
    VECTOR_WEIGHT_BOUNDED_ANISO,
    VECTOR_V_DOT_H,
    VECTOR_ONE_MINUS_V_DOT_H,
    D_GGX_WORLD,
    SPECULAR_GGX_WORLD,
];

const fn component(name: &'static str, meaning: &'static str) -> Param {
    let range = if matches!(name.as_bytes()[2], b'z') {
        (1e-6, 1.0)
    } else {
        (-1.0, 1.0)
    };
    Param {
        name,
        range,
        unit: "1",
        meaning,
    }
}

const L_X: Param = component("l_x", "light along the tangent");
const L_Y: Param = component("l_y", "light along the bitangent");
const L_Z: Param = component("l_z", "light along the normal");
const V_X: Param = component("v_x", "view along the tangent");
const V_Y: Param = component("v_y", "view along the bitangent");
const V_Z: Param = component("v_z", "view along the normal");

/// D of GGX from a light and a view, see [`Ggx::d_between`].
fn vector_d_ggx<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R, alpha: R) -> R {
    Ggx::new(alpha).d_between([l_x, l_y, l_z], [v_x, v_y, v_z])
}

const VECTOR_D_GGX: Term = entry!(
    vector_d_ggx(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha: ALPHA),
    symbol: "D", latex: "D", cost: 15,
    doc: "D of GGX from light and view in the tangent frame",
    source: "Walter et al. 2007, eq. 33",
    wgsl: None
);

/// Visibility of GGX from a light and a view, see [`Ggx::visibility`].
fn vector_v_ggx<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R, alpha: R) -> R {
    Ggx::new(alpha).visibility([l_x, l_y, l_z], [v_x, v_y, v_z])
}

const VECTOR_V_GGX: Term = entry!(
    vector_v_ggx(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha: ALPHA),
    symbol: "V", latex: "V", cost: 20,
    doc: "visibility of GGX from light and view in the tangent frame",
    source: "Heitz 2014, eq. 99",
    wgsl: None
);

/// Λ of GGX from a direction, see [`Ggx::lambda`].
fn vector_lambda_ggx<R: Real>(v_x: R, v_y: R, v_z: R, alpha: R) -> R {
    Ggx::new(alpha).lambda([v_x, v_y, v_z])
}

const VECTOR_LAMBDA_GGX: Term = entry!(
    vector_lambda_ggx(v_x: V_X, v_y: V_Y, v_z: V_Z, alpha: ALPHA),
    symbol: "Λ", latex: r"\Lambda", cost: 15,
    doc: "Lambda of GGX from a direction in the tangent frame",
    source: "Heitz 2014, eq. 72",
    wgsl: None
);

/// Schlick's reflectance from a light and a view, see [`Fresnel::eval`].
fn vector_f_schlick<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R, f0: R) -> R {
    Fresnel::Schlick { f0: [f0; 3] }.eval([l_x, l_y, l_z], [v_x, v_y, v_z])[0]
}

const VECTOR_F_SCHLICK: Term = entry!(
    vector_f_schlick(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, f0: F0),
    symbol: "F", latex: "F", cost: 25,
    doc: "Schlick's reflectance from light and view",
    source: "Schlick 1994",
    wgsl: None
);

/// D V F cos θ from a light and a view, see [`Specular::eval_cos`].
#[allow(clippy::too_many_arguments)]
fn vector_specular<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R, alpha: R, f0: R) -> R {
    let fresnel = Fresnel::Schlick { f0: [f0; 3] };
    Specular {
        ggx: Ggx::new(alpha),
        fresnel,
    }
    .eval_cos([l_x, l_y, l_z], [v_x, v_y, v_z])[0]
}

const VECTOR_SPECULAR: Term = entry!(
    vector_specular(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha: ALPHA, f0: F0),
    symbol: "D V F cos θ", latex: r"D V F \cos\theta", cost: 60,
    doc: "specular BRDF times cosine from light and view in the tangent frame",
    source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99",
    wgsl: None
);

/// Density of the visible normals' reflection, see [`Ggx::pdf`].
fn vector_pdf<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R, alpha: R) -> R {
    Ggx::new(alpha).pdf([l_x, l_y, l_z], [v_x, v_y, v_z], Sampler::SphericalCap)
}

const VECTOR_PDF: Term = entry!(
    vector_pdf(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha: ALPHA),
    symbol: "p", latex: "p", cost: 25,
    doc: "density of lights drawn by the visible normals",
    source: "Heitz 2018; Dupuy and Benyoub 2023",
    wgsl: None
);

/// D of a stretched surface, see [`Ggx::d_between`].
#[allow(clippy::too_many_arguments)]
fn vector_d_ggx_aniso<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    Ggx { alpha_x, alpha_y }.d_between([l_x, l_y, l_z], [v_x, v_y, v_z])
}

const VECTOR_D_GGX_ANISO: Term = entry!(
    vector_d_ggx_aniso(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "D", latex: "D", cost: 20,
    doc: "D of a stretched GGX surface from light and view in the tangent frame",
    source: "Burley 2012, eq. 13; Heitz 2018, eq. 1",
    wgsl: None
);

/// Visibility of a stretched surface, see [`Ggx::visibility`].
#[allow(clippy::too_many_arguments)]
fn vector_v_ggx_aniso<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    Ggx { alpha_x, alpha_y }.visibility([l_x, l_y, l_z], [v_x, v_y, v_z])
}

const VECTOR_V_GGX_ANISO: Term = entry!(
    vector_v_ggx_aniso(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "V", latex: "V", cost: 20,
    doc: "visibility of a stretched GGX surface from light and view in the tangent frame",
    source: "Heitz 2014, eq. 86 and 99",
    wgsl: None
);

/// Λ of a stretched surface, see [`Ggx::lambda`].
fn vector_lambda_ggx_aniso<R: Real>(v_x: R, v_y: R, v_z: R, alpha_x: R, alpha_y: R) -> R {
    Ggx { alpha_x, alpha_y }.lambda([v_x, v_y, v_z])
}

const VECTOR_LAMBDA_GGX_ANISO: Term = entry!(
    vector_lambda_ggx_aniso(v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "Λ", latex: r"\Lambda", cost: 15,
    doc: "Lambda of a stretched GGX surface from a direction in the tangent frame",
    source: "Heitz 2014, eq. 86",
    wgsl: None
);

/// G₁ of a stretched surface, see [`Ggx::g1`].
fn vector_g1_ggx_aniso<R: Real>(v_x: R, v_y: R, v_z: R, alpha_x: R, alpha_y: R) -> R {
    Ggx { alpha_x, alpha_y }.g1([v_x, v_y, v_z])
}

const VECTOR_G1_GGX_ANISO: Term = entry!(
    vector_g1_ggx_aniso(v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "G₁", latex: "G_1", cost: 15,
    doc: "masking of a stretched GGX surface from a direction in the tangent frame",
    source: "Heitz 2014, eq. 43 and 86",
    wgsl: None
);

/// D V of a stretched surface, see [`Ggx::eval`].
#[allow(clippy::too_many_arguments)]
fn vector_eval_ggx_aniso<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    Ggx { alpha_x, alpha_y }.eval([l_x, l_y, l_z], [v_x, v_y, v_z])
}

const VECTOR_EVAL_GGX_ANISO: Term = entry!(
    vector_eval_ggx_aniso(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "D V", latex: "D V", cost: 45,
    doc: "specular BRDF of a stretched GGX surface with F = 1",
    source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99",
    wgsl: None
);

/// Density of the visible normals, see [`Ggx::pdf`].
#[allow(clippy::too_many_arguments)]
fn vector_pdf_aniso<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    Ggx { alpha_x, alpha_y }.pdf([l_x, l_y, l_z], [v_x, v_y, v_z], Sampler::SphericalCap)
}

const VECTOR_PDF_ANISO: Term = entry!(
    vector_pdf_aniso(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "p", latex: "p", cost: 25,
    doc: "density of lights drawn by the visible normals of a stretched surface",
    source: "Heitz 2018; Dupuy and Benyoub 2023",
    wgsl: None
);

/// Density of bounded caps, see [`Ggx::pdf`].
#[allow(clippy::too_many_arguments)]
fn vector_pdf_bounded_aniso<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    Ggx { alpha_x, alpha_y }.pdf([l_x, l_y, l_z], [v_x, v_y, v_z], Sampler::BoundedCap)
}

const VECTOR_PDF_BOUNDED_ANISO: Term = entry!(
    vector_pdf_bounded_aniso(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "p", latex: "p", cost: 30,
    doc: "density of lights drawn by bounded caps of a stretched surface",
    source: "Eto and Tokuyoshi 2023",
    wgsl: None
);

/// Weight of bounded caps, see [`Ggx::weight`].
#[allow(clippy::too_many_arguments)]
fn vector_weight_bounded_aniso<R: Real>(
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha_x: R,
    alpha_y: R,
) -> R {
    Ggx { alpha_x, alpha_y }.weight([l_x, l_y, l_z], [v_x, v_y, v_z], Sampler::BoundedCap)
}

const VECTOR_WEIGHT_BOUNDED_ANISO: Term = entry!(
    vector_weight_bounded_aniso(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z, alpha_x: ALPHA_X, alpha_y: ALPHA_Y),
    symbol: "w", latex: "w", cost: 40,
    doc: "weight of lights drawn by bounded caps of a stretched surface",
    source: "Eto and Tokuyoshi 2023",
    wgsl: None
);

/// V·H, see [`v_dot_h_and_rest`].
fn vector_v_dot_h<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R) -> R {
    v_dot_h_and_rest([l_x, l_y, l_z], [v_x, v_y, v_z]).0
}

const VECTOR_V_DOT_H: Term = entry!(
    vector_v_dot_h(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z),
    symbol: "V·H", latex: r"V \cdot H", cost: 12,
    doc: "cosine between view and half vector, from vectors",
    source: "Hammon 2017",
    wgsl: None
);

/// 1 − V·H, see [`v_dot_h_and_rest`].
fn vector_one_minus_v_dot_h<R: Real>(l_x: R, l_y: R, l_z: R, v_x: R, v_y: R, v_z: R) -> R {
    v_dot_h_and_rest([l_x, l_y, l_z], [v_x, v_y, v_z]).1
}

const VECTOR_ONE_MINUS_V_DOT_H: Term = entry!(
    vector_one_minus_v_dot_h(l_x: L_X, l_y: L_Y, l_z: L_Z, v_x: V_X, v_y: V_Y, v_z: V_Z),
    symbol: "1 − V·H", latex: r"1 - V \cdot H", cost: 20,
    doc: "1 minus the cosine between view and half vector, from vectors",
    source: "Hammon 2017",
    wgsl: None
);

const fn world(name: &'static str, meaning: &'static str) -> Param {
    Param {
        name,
        range: (-1.0, 1.0),
        unit: "1",
        meaning,
    }
}

const N_X: Param = world("n_x", "normal in the world, first component");
const N_Y: Param = world("n_y", "normal in the world, second component");
const N_Z: Param = world("n_z", "normal in the world, third component");
const L_WORLD: Param = world("l_x", "light in the world, a component");
const V_WORLD: Param = world("v_x", "view in the world, a component");

/// D of GGX in world space, see [`d_ggx_world`](crate::d_ggx_world).
#[allow(clippy::too_many_arguments)]
fn d_ggx_world<R: Real>(
    n_x: R,
    n_y: R,
    n_z: R,
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha: R,
) -> R {
    crate::d_ggx_world([n_x, n_y, n_z], [l_x, l_y, l_z], [v_x, v_y, v_z], alpha)
}

const D_GGX_WORLD: Term = entry!(
    d_ggx_world(n_x: N_X, n_y: N_Y, n_z: N_Z, l_x: L_WORLD, l_y: L_WORLD, l_z: L_WORLD, v_x: V_WORLD, v_y: V_WORLD, v_z: V_WORLD, alpha: ALPHA),
    symbol: "D", latex: "D", cost: 60,
    doc: "D of GGX from normal, light and view in world space",
    source: "Walter et al. 2007, eq. 33",
    wgsl: None
);

/// D V F cos θ in world space, see [`specular_ggx_world`](crate::specular_ggx_world).
#[allow(clippy::too_many_arguments)]
fn specular_ggx_world<R: Real>(
    n_x: R,
    n_y: R,
    n_z: R,
    l_x: R,
    l_y: R,
    l_z: R,
    v_x: R,
    v_y: R,
    v_z: R,
    alpha: R,
    f0: R,
) -> R {
    let fresnel = Fresnel::Schlick { f0: [f0; 3] };
    let (n, l, v) = ([n_x, n_y, n_z], [l_x, l_y, l_z], [v_x, v_y, v_z]);
    crate::specular_ggx_world(n, l, v, alpha, &fresnel)[0]
}

const SPECULAR_GGX_WORLD: Term = entry!(
    specular_ggx_world(n_x: N_X, n_y: N_Y, n_z: N_Z, l_x: L_WORLD, l_y: L_WORLD, l_z: L_WORLD, v_x: V_WORLD, v_y: V_WORLD, v_z: V_WORLD, alpha: ALPHA, f0: F0),
    symbol: "D V F cos θ", latex: r"D V F \cos\theta", cost: 150,
    doc: "specular BRDF times cosine from normal, light and view in world space",
    source: "Walter et al. 2007, eq. 20; Heitz 2014, eq. 99",
    wgsl: None
);
