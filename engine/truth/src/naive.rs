//! The printed forms in single precision, to show what the stable ones are for.
//!
//! These are what a shader has that follows its paper. They are measured, never used.

type Form = fn(&[f32]) -> f32;

/// The printed form of a term, where it differs from the stable one.
pub fn form(name: &str) -> Option<Form> {
    const PI: f32 = std::f32::consts::PI;
    let form: Form = match name {
        "d_ggx" => |x| {
            let (c2, a2) = (x[0] * x[0], x[1] * x[1]);
            let t = c2 * (a2 - 1.0) + 1.0;
            a2 / (PI * t * t)
        },
        "d_beckmann" => |x| {
            let (c2, a2) = (x[0] * x[0], x[1] * x[1]);
            (-(1.0 - c2) / (c2 * a2)).exp() / (PI * a2 * c2 * c2)
        },
        "d_blinn_phong" => |x| {
            let a2 = x[1] * x[1];
            x[0].powf(2.0 / a2 - 2.0) / (PI * a2)
        },
        "lambda_ggx" => |x| {
            let (c2, a2) = (x[0] * x[0], x[1] * x[1]);
            ((1.0 + a2 * (1.0 - c2) / c2).sqrt() - 1.0) / 2.0
        },
        "v_ggx" => |x| {
            let (l, v, a2) = (x[0], x[1], x[2] * x[2]);
            let s = |c: f32| (a2 + (1.0 - a2) * c * c).sqrt();
            0.5 / (l * s(v) + v * s(l))
        },
        "f_dielectric" => |x| {
            let (n, c) = (x[0], x[1]);
            let g2 = n * n - 1.0 + c * c;
            if g2 < 0.0 {
                return 1.0;
            }
            let g = g2.sqrt();
            let s = (g - c) / (g + c);
            let p = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
            0.5 * s * s * (1.0 + p * p)
        },
        "f_conductor" => |x| {
            let (n, k, c) = (x[0], x[1], x[2]);
            let s2 = 1.0 - c * c;
            let t = n * n - k * k - s2;
            let ab = (t * t + 4.0 * n * n * k * k).sqrt();
            let a = (0.5 * (ab + t)).sqrt();
            let s = (ab + c * c - 2.0 * a * c) / (ab + c * c + 2.0 * a * c);
            let (q, r) = (ab * c * c + s2 * s2, 2.0 * a * c * s2);
            0.5 * s * (1.0 + (q - r) / (q + r))
        },
        "f_schlick" => |x| x[0] + (1.0 - x[0]) * (1.0 - x[1]).powf(5.0),
        "diffuse_oren_nayar_full" => |x| {
            let (low, high) = (x[0].min(x[1]), x[0].max(x[1]));
            let (cos_phi, s2, rho) = (x[2], x[3] * x[3], x[4]);
            let (alpha, beta) = (low.acos(), high.acos());
            let b = 2.0 * beta / PI;
            let k = s2 / (s2 + 0.09);
            let c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
            let c2 = 0.45 * k * (alpha.sin() - if cos_phi < 0.0 { b * b * b } else { 0.0 });
            let ab = 4.0 * alpha * beta / (PI * PI);
            let c3 = 0.125 * k * ab * ab;
            let half = (0.5 * (alpha + beta)).tan();
            let direct = c1 + cos_phi * c2 * beta.tan() + (1.0 - cos_phi.abs()) * c3 * half;
            rho / PI * (direct + rho * 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * b * b))
        },
        _ => return None,
    };
    Some(form)
}
