//! The textbook forms of what depends on directions: in the tangent frame, in the world, and
//! drawn.
//!
//! Rounding leaves a vector a little longer or shorter than 1: for what depends on a direction
//! only, its length is divided out.

use crate::big::Big;
use crate::forms::{evaluate, sq};
use crate::stress::ALONG;

type Vector = [Big; 3];

/// The form of that name in `bits` bits; no value if there is none.
pub(crate) fn evaluate_vectors(name: &str, args: &[Big], bits: usize) -> Big {
    let form = |name: &str, args: &[&Big]| {
        let args: Vec<Big> = args.iter().map(|&x| x.clone()).collect();
        evaluate(name, &args, bits)
    };
    match (name, args) {
        ("vector_d_ggx", [l @ .., a]) => match half_vector(l) {
            Some((_, n_dot_h)) if n_dot_h.is_negative() => Big::new(0.0, bits),
            Some((_, n_dot_h)) => form("d_ggx", &[&n_dot_h, a]),
            None => Big::none(),
        },
        ("vector_d_ggx_aniso", [x, y, z, vx, vy, vz, ax, ay]) => {
            let h = normalize(&[x + vx, y + vy, z + vz]);
            if h[2].is_negative() {
                return Big::new(0.0, bits);
            }
            form("d_ggx_aniso", &[&h[0], &h[1], &h[2], ax, ay])
        }
        ("vector_lambda_ggx", [x, y, z, a]) => form("vector_lambda_ggx_aniso", &[x, y, z, a, a]),
        ("vector_lambda_ggx_aniso", [x, y, z, ax, ay]) => {
            ((1.0 + (sq(&(ax * x)) + sq(&(ay * y))) / sq(z)).sqrt() - 1.0) / 2.0
        }
        ("vector_g1_ggx_aniso", args) => {
            1.0 / (1.0 + evaluate("vector_lambda_ggx_aniso", args, bits))
        }
        ("vector_v_ggx", [x, y, z, vx, vy, vz, a]) => {
            form("vector_v_ggx_aniso", &[x, y, z, vx, vy, vz, a, a])
        }
        ("vector_v_ggx_aniso", [x, y, z, vx, vy, vz, ax, ay]) => {
            let sum = form("vector_lambda_ggx_aniso", &[x, y, z, ax, ay])
                + form("vector_lambda_ggx_aniso", &[vx, vy, vz, ax, ay]);
            1.0 / (1.0 + sum) / (4.0 * z * vz)
        }
        ("vector_eval_ggx_aniso", args) => {
            evaluate("vector_d_ggx_aniso", args, bits) * evaluate("vector_v_ggx_aniso", args, bits)
        }
        ("vector_v_dot_h", lv) => half_vector(lv).map_or(Big::none(), |(v_dot_h, _)| v_dot_h),
        ("vector_one_minus_v_dot_h", lv) => 1.0 - evaluate("vector_v_dot_h", lv, bits),
        ("vector_f_schlick", [lv @ .., f0]) => match half_vector(lv) {
            Some((v_dot_h, _)) => form("f_schlick", &[f0, &v_dot_h]),
            None => Big::none(),
        },
        ("vector_specular", [x, y, z, vx, vy, vz, a, f0]) => {
            form("vector_d_ggx", &[x, y, z, vx, vy, vz, a])
                * form("vector_v_ggx", &[x, y, z, vx, vy, vz, a])
                * form("vector_f_schlick", &[x, y, z, vx, vy, vz, f0])
                * z
        }
        ("cosines_specular", [l, v, h, u, f0, a]) => {
            form("d_ggx", &[h, a]) * form("v_ggx", &[l, v, a]) * form("f_schlick", &[f0, u]) * l
        }
        // G₁ D/(4 N·V).
        ("vector_pdf", [x, y, z, vx, vy, vz, a]) => {
            form("vector_pdf_aniso", &[x, y, z, vx, vy, vz, a, a])
        }
        ("vector_pdf_aniso", [x, y, z, vx, vy, vz, ax, ay]) => {
            let g1 = form("vector_g1_ggx_aniso", &[vx, vy, vz, ax, ay]);
            form("vector_d_ggx_aniso", &[x, y, z, vx, vy, vz, ax, ay]) * g1 / (4.0 * vz)
        }
        // Eto and Tokuyoshi 2023: D/(2 (k N·V + sqrt(…))).
        ("vector_pdf_bounded", [x, y, z, vx, vy, vz, a]) => {
            form("vector_pdf_bounded_aniso", &[x, y, z, vx, vy, vz, a, a])
        }
        ("vector_pdf_bounded_aniso", [x, y, z, vx, vy, vz, ax, ay]) => {
            let d = form("vector_d_ggx_aniso", &[x, y, z, vx, vy, vz, ax, ay]);
            let bound = cap_bound(vx, vy, vz, &ax.min(ay));
            d / (2.0 * (bound * vz + length(&(ax * vx), &(ay * vy), vz)))
        }
        // G₂/G₁.
        (
            "vector_weight" | "vector_weight_bounded" | "vector_weight_bounded_aniso",
            [_, _, z, ..],
        ) if !z.is_positive() => Big::new(0.0, bits),
        ("vector_weight", [x, y, z, vx, vy, vz, a]) => {
            let view = 1.0 + form("vector_lambda_ggx", &[vx, vy, vz, a]);
            &view / (&view + form("vector_lambda_ggx", &[x, y, z, a]))
        }
        // D V N·L over the density, D cancelled.
        ("vector_weight_bounded", [x, y, z, vx, vy, vz, a]) => {
            form("vector_weight_bounded_aniso", &[x, y, z, vx, vy, vz, a, a])
        }
        ("vector_weight_bounded_aniso", [x, y, z, vx, vy, vz, ax, ay]) => {
            let bound = cap_bound(vx, vy, vz, &ax.min(ay));
            let share = bound * vz + length(&(ax * vx), &(ay * vy), vz);
            form("vector_v_ggx_aniso", &[x, y, z, vx, vy, vz, ax, ay]) * z * 2.0 * share
        }

        ("sample_hemisphere", [x, y, z, a, u0, u1]) => {
            let v = [x.clone(), y.clone(), z.clone()];
            along(&reflect(&v, &hemisphere_normal(&v, a, u0, u1, bits)))
        }
        ("sample_cap", [x, y, z, a, u0, u1]) => {
            let v = [x.clone(), y.clone(), z.clone()];
            let k = Big::new(1.0, bits);
            along(&reflect(&v, &cap_normal(&v, a, u0, u1, &k, bits)))
        }
        ("sample_bounded", [x, y, z, a, u0, u1]) => {
            let v = [x.clone(), y.clone(), z.clone()];
            let k = cap_bound(x, y, z, a);
            along(&reflect(&v, &cap_normal(&v, a, u0, u1, &k, bits)))
        }
        // How far off something is.
        ("rusinkiewicz_and_back" | "walk" | "batch_walk", [..]) => Big::new(0.0, bits),

        ("d_ggx_world", [nx, ny, nz, x, y, z, vx, vy, vz, a]) => {
            let h = [x + vx, y + vy, z + vz];
            form("d_ggx", &[&cosine(&[nx, ny, nz], &h.each_ref()), a])
        }
        ("specular_ggx_world", [nx, ny, nz, x, y, z, vx, vy, vz, a, f0]) => {
            let n = [nx, ny, nz];
            let (l, v) = (cosine(&n, &[x, y, z]), cosine(&n, &[vx, vy, vz]));
            form("d_ggx_world", &[nx, ny, nz, x, y, z, vx, vy, vz, a])
                * form("v_ggx", &[&l, &v, a])
                * form("vector_f_schlick", &[x, y, z, vx, vy, vz, f0])
                * l
        }
        _ => Big::none(),
    }
}

fn length(x: &Big, y: &Big, z: &Big) -> Big {
    (sq(x) + sq(y) + sq(z)).sqrt()
}

fn dot(a: &[&Big; 3], b: &[&Big; 3]) -> Big {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Of the angle between two vectors.
fn cosine(a: &[&Big; 3], b: &[&Big; 3]) -> Big {
    dot(a, b) / (length(a[0], a[1], a[2]) * length(b[0], b[1], b[2]))
}

/// Of a light and a view: V·H and N·H.
fn half_vector(lv: &[Big]) -> Option<(Big, Big)> {
    let [x, y, z, vx, vy, vz] = lv else {
        return None;
    };
    let h = (x + vx, y + vy, z + vz);
    let n_dot_h = &h.2 / length(&h.0, &h.1, &h.2);
    // V·H is half the length of the sum of the directions, so these get length 1 first.
    let (l, v) = (length(x, y, z), length(vx, vy, vz));
    let v_dot_h = length(
        &(x / &l + vx / &v),
        &(y / &l + vy / &v),
        &(z / &l + vz / &v),
    ) / 2.0;
    Some((v_dot_h, n_dot_h))
}

/// Eto and Tokuyoshi 2023, k = (1 − α²) s²/(s² + α² z²), s = 1 + sqrt(x² + y²).
fn cap_bound(x: &Big, y: &Big, z: &Big, a: &Big) -> Big {
    let s2 = sq(&(1.0 + (sq(x) + sq(y)).sqrt()));
    (1.0 - sq(a)) * &s2 / (&s2 + sq(a) * sq(z))
}

fn normalize(v: &Vector) -> Vector {
    let length = length(&v[0], &v[1], &v[2]);
    v.each_ref().map(|x| x / &length)
}

/// `v` mirrored in a normal of length 1.
fn reflect(v: &Vector, m: &Vector) -> Vector {
    let twice = 2.0 * dot(&v.each_ref(), &m.each_ref());
    [0, 1, 2].map(|i| &twice * &m[i] - &v[i])
}

fn along(l: &Vector) -> Big {
    &l[0] * ALONG[0] + &l[1] * ALONG[1] + &l[2] * ALONG[2]
}

fn stretched(v: &Vector, a: &Big) -> Vector {
    normalize(&[a * &v[0], a * &v[1], v[2].clone()])
}

/// Heitz 2018, listing 1.
fn hemisphere_normal(v: &Vector, a: &Big, u0: &Big, u1: &Big, bits: usize) -> Vector {
    let view = stretched(v, a);
    let across2 = sq(&view[0]) + sq(&view[1]);
    let (zero, one) = (Big::new(0.0, bits), Big::new(1.0, bits));
    let t1 = if across2.is_positive() {
        let across = across2.sqrt();
        [-&view[1] / &across, &view[0] / &across, zero.clone()]
    } else {
        [one, zero.clone(), zero.clone()]
    };
    let t2 = [
        &view[1] * &t1[2] - &view[2] * &t1[1],
        &view[2] * &t1[0] - &view[0] * &t1[2],
        &view[0] * &t1[1] - &view[1] * &t1[0],
    ];
    let (r, phi) = (u0.sqrt(), 2.0 * Big::pi(bits) * u1);
    let p = &r * phi.cos();
    let s = (1.0 + &view[2]) / 2.0;
    let q = (1.0 - &s) * (1.0 - sq(&p)).sqrt() + s * r * phi.sin();
    let up = (1.0 - sq(&p) - sq(&q)).max(&zero).sqrt();
    let n = [0, 1, 2].map(|i| &p * &t1[i] + &q * &t2[i] + &up * &view[i]);
    normalize(&[a * &n[0], a * &n[1], n[2].max(&zero)])
}

/// Dupuy and Benyoub 2023, with Eto and Tokuyoshi's bound.
fn cap_normal(v: &Vector, a: &Big, u0: &Big, u1: &Big, k: &Big, bits: usize) -> Vector {
    let view = stretched(v, a);
    let low = k * &view[2];
    let z = (1.0 - u1) * (1.0 + &low) - low;
    let sin = (1.0 - sq(&z)).max(&Big::new(0.0, bits)).sqrt();
    let phi = 2.0 * Big::pi(bits) * u0;
    let m = [
        &sin * phi.cos() + &view[0],
        sin * phi.sin() + &view[1],
        z + &view[2],
    ];
    normalize(&[a * &m[0], a * &m[1], m[2].clone()])
}
