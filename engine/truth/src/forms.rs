//! The textbook forms, one arm a term, as their papers print them.
//!
//! They hold inside the domain of each term; outside it `brdf` documents what it returns.

use crate::big::Big;

/// The term of that name in `bits` bits; no value if there is no such closed form.
pub(crate) fn evaluate(name: &str, args: &[Big], bits: usize) -> Big {
    let pi = Big::pi(bits);
    // A decimal constant n/d, to all digits.
    let ratio = |n: f64, d: f64| Big::new(n, bits) / d;
    // sqrt(2/π) as the classic functions print it.
    let printed_root = || ratio(797_884_560_802_865.0, 1e15);
    let form = |name: &str, args: &[&Big]| {
        evaluate(
            name,
            &args.iter().map(|&x| x.clone()).collect::<Vec<_>>(),
            bits,
        )
    };
    match (name, args) {
        ("d_ggx", [c, a]) => sq(a) / (&pi * sq(&(sq(c) * (sq(a) - 1.0) + 1.0))),
        ("d_ggx_aniso", [x, y, z, ax, ay]) => {
            1.0 / (&pi * ax * ay * sq(&(sq(&(x / ax)) + sq(&(y / ay)) + sq(z))))
        }
        ("d_beckmann", [c, _]) if c.is_zero() => c.clone(),
        ("d_beckmann", [c, a]) => {
            let tan2 = (1.0 - sq(c)) / sq(c);
            (-(tan2 / sq(a))).exp() / (&pi * sq(a) * sq(&sq(c)))
        }
        ("d_blinn_phong", [c, a]) => c.pow(&(2.0 / sq(a) - 2.0)) / (&pi * sq(a)),

        ("lambda_ggx", [c, a]) => ((1.0 + sq(a) * tan2(c)).sqrt() - 1.0) / 2.0,
        ("lambda_beckmann", [c, _]) if (1.0 - c).is_zero() => c - 1.0,
        ("lambda_beckmann", [c, a]) => {
            let t = 1.0 / (a * tan2(c).sqrt());
            if t.to_f64() > 30.0 {
                // Less than 1e-390, and the digits to see it would be many.
                return ratio(0.0, 1.0);
            }
            // The terms agree in the first 3 t² bits: so many more are needed to see the rest.
            let more = bits + (3.0 * t.to_f64() * t.to_f64()) as usize + 64;
            let (c, a, pi) = (c.widened(more), a.widened(more), Big::pi(more));
            let t = 1.0 / (a * tan2(&c).sqrt());
            let gauss = (-sq(&t)).exp();
            (erf(&t, &pi) - 1.0) / 2.0 + gauss / (2.0 * &t * pi.sqrt())
        }
        ("g1_ggx", [c, a]) => 1.0 / (1.0 + form("lambda_ggx", &[c, a])),
        ("one_minus_g1_ggx", args) => 1.0 - evaluate("g1_ggx", args, bits),
        ("one_minus_g1_beckmann", args) => 1.0 - evaluate("g1_beckmann", args, bits),
        ("g1_beckmann", [c, a]) => 1.0 / (1.0 + form("lambda_beckmann", &[c, a])),
        ("g1_beckmann_rational", [c, _]) if (1.0 - c).is_zero() => c.clone(),
        ("g1_beckmann_rational", [c, a]) => {
            let t = 1.0 / (a * tan2(c).sqrt());
            if (&t - ratio(16.0, 10.0)).is_negative() {
                (ratio(3535.0, 1e3) * &t + ratio(2181.0, 1e3) * sq(&t))
                    / (1.0 + ratio(2276.0, 1e3) * &t + ratio(2577.0, 1e3) * sq(&t))
            } else {
                ratio(1.0, 1.0)
            }
        }
        ("g2_ggx", [l, v, a]) => {
            1.0 / (1.0 + form("lambda_ggx", &[l, a]) + form("lambda_ggx", &[v, a]))
        }
        ("g2_beckmann", [l, v, a]) => {
            1.0 / (1.0 + form("lambda_beckmann", &[l, a]) + form("lambda_beckmann", &[v, a]))
        }
        ("g2_ggx_separable", [l, v, a]) => form("g1_ggx", &[l, a]) * form("g1_ggx", &[v, a]),
        ("g2_ggx_hammon", [l, v, a]) => 2.0 * l * v / lerp(&(2.0 * l * v), &(l + v), a),
        ("v_ggx", [l, v, a]) => form("g2_ggx", &[l, v, a]) / (4.0 * l * v),
        ("v_ggx_separable", [l, v, a]) => form("g2_ggx_separable", &[l, v, a]) / (4.0 * l * v),
        ("v_ggx_hammon", [l, v, a]) => form("g2_ggx_hammon", &[l, v, a]) / (4.0 * l * v),

        ("gsf_implicit", [l, v]) => l * v,
        ("gsf_ashikhmin_shirley", [l, v, h]) => l * v / (h * l.max(v)),
        ("gsf_ashikhmin_premoze", [l, v]) => l * v / (l + v - l * v),
        ("gsf_duer", [l, v, lv]) => (2.0 + 2.0 * lv) / sq(&sq(&(l + v))),
        ("gsf_neumann", [l, v]) => l * v / l.max(v),
        ("gsf_kelemen", [l, v, h]) => l * v / sq(h),
        ("gsf_modified_kelemen", [l, v, r]) => {
            let k = sq(r) * printed_root();
            sq(&(v * &k + (1.0 - &k))) * l
        }
        ("gsf_cook_torrance", [l, v, h, n]) => {
            ratio(1.0, 1.0).min(&(2.0 * n * v / h).min(&(2.0 * n * l / h)))
        }
        ("gsf_ward", [l, v]) => (l * v).sqrt(),
        ("gsf_kurt", [l, v, h, r]) => l * v / (h * (l * v).pow(r)),
        ("gsf_walter" | "gsf_ggx", [l, v, r]) => form("g2_ggx_separable", &[l, v, r]),
        ("gsf_smith_beckmann", [l, v, r]) => {
            form("g1_beckmann_rational", &[l, &sq(r)]) * form("g1_beckmann_rational", &[v, &sq(r)])
        }
        ("gsf_schlick", [l, v, r]) => schlick_g1(l, &sq(r)) * schlick_g1(v, &sq(r)),
        ("gsf_schlick_beckmann", [l, v, r]) => {
            let k = sq(r) * printed_root();
            schlick_g1(l, &k) * schlick_g1(v, &k)
        }
        ("gsf_schlick_ggx", [l, v, r]) => schlick_g1(l, &(r / 2.0)) * schlick_g1(v, &(r / 2.0)),

        ("f_schlick", [f0, c]) => f0 + (1.0 - f0) * pow5(&(1.0 - c)),
        ("f_schlick_ior", [n, c]) => form("f_schlick", &[&sq(&((n - 1.0) / (n + 1.0))), c]),
        ("f_spherical_gaussian", [f0, c]) => {
            let power = (ratio(-555_473.0, 1e5) * c - ratio(698_316.0, 1e5)) * c;
            f0 + (1.0 - f0) * (ratio(2.0, 1.0).ln() * power).exp()
        }
        ("f_lazanyi", [f0, a, c]) => {
            let m = 1.0 - c;
            f0 + (1.0 - f0) * pow5(&m) - a * c * pow5(&m) * &m
        }
        ("f_dielectric", [n, c]) => {
            let g2 = sq(n) - 1.0 + sq(c);
            if g2.is_negative() {
                return ratio(1.0, 1.0);
            }
            let g = g2.sqrt();
            let s = sq(&((&g - c) / (&g + c)));
            let p = sq(&((c * (&g + c) - 1.0) / (c * (&g - c) + 1.0)));
            s * (1.0 + p) / 2.0
        }
        ("t_dielectric", [n, c]) => 1.0 - form("f_dielectric", &[n, c]),
        ("t_conductor", [n, k, c]) => 1.0 - form("f_conductor", &[n, k, c]),
        ("f_conductor", [n, k, c]) => {
            let s2 = 1.0 - sq(c);
            let t = sq(n) - sq(k) - &s2;
            let root = (sq(&t) + 4.0 * sq(n) * sq(k)).sqrt();
            let (a, b2) = (((&root + &t) / 2.0).sqrt(), (&root - &t) / 2.0);
            let s = (sq(&(&a - c)) + &b2) / (sq(&(&a + c)) + &b2);
            // a − sin tan and a + sin tan, multiplied by the cosine.
            let p = (sq(&(&a * c - &s2)) + &b2 * sq(c)) / (sq(&(&a * c + &s2)) + &b2 * sq(c));
            (&s + &s * p) / 2.0
        }

        ("diffuse_lambert", [rho]) => rho / &pi,
        ("diffuse_disney", [l, v, h, r, rho]) => {
            let fd90 = 0.5 + 2.0 * r * sq(h);
            let factor = |c: &Big| 1.0 + (&fd90 - 1.0) * pow5(&(1.0 - c));
            rho / &pi * factor(l) * factor(v)
        }
        ("diffuse_oren_nayar", [l, v, cos_phi, sigma, rho]) => {
            let s2 = sq(sigma);
            let a = 1.0 - &s2 / (&s2 + ratio(33.0, 100.0)) / 2.0;
            let b = ratio(45.0, 100.0) * &s2 / (&s2 + ratio(9.0, 100.0));
            let (low, high) = (l.min(v), l.max(v));
            let sin_tan = (1.0 - sq(&low)).sqrt() * tan2(&high).sqrt();
            rho / &pi * (a + b * cos_phi.max(&ratio(0.0, 1.0)) * sin_tan)
        }
        ("diffuse_oren_nayar_full", [l, v, cos_phi, sigma, rho]) => {
            let s2 = sq(sigma);
            let (alpha, beta) = (l.min(v).acos(), l.max(v).acos());
            let (sin_alpha, tan_beta) = ((1.0 - sq(&l.min(v))).sqrt(), tan2(&l.max(v)).sqrt());
            let half = ((&alpha + &beta) / 2.0).cos();
            let b_share = 2.0 * &beta / &pi;
            let k = &s2 / (&s2 + ratio(9.0, 100.0));
            let c1 = 1.0 - &s2 / (&s2 + ratio(33.0, 100.0)) / 2.0;
            let bracket = if cos_phi.is_negative() {
                &sin_alpha - sq(&b_share) * &b_share
            } else {
                sin_alpha
            };
            let c2 = ratio(45.0, 100.0) * &k * bracket;
            let c3 = 0.125 * &k * sq(&(4.0 * &alpha * &beta / sq(&pi)));
            let direct =
                c1 + cos_phi * c2 * tan_beta + (1.0 - cos_phi.abs()) * c3 * tan2(&half).sqrt();
            let indirect = ratio(17.0, 100.0) * &s2 / (&s2 + ratio(13.0, 100.0))
                * (1.0 - cos_phi * sq(&b_share));
            rho / &pi * direct + sq(rho) / &pi * indirect
        }
        ("diffuse_hammon", [l, v, lv, a, rho]) => {
            let facing = 0.5 + 0.5 * lv;
            if facing.is_zero() {
                return form("hammon_with", &[l, v, a, rho, &facing]);
            }
            let h = (l + v) / (2.0 + 2.0 * lv).sqrt();
            let rough = &facing * (ratio(9.0, 10.0) - ratio(4.0, 10.0) * &facing) * (0.5 + &h) / &h;
            form("hammon_with", &[l, v, a, rho, &rough])
        }
        ("hammon_with", [l, v, a, rho, rough]) => {
            let one_minus = |c: &Big| 1.0 - pow5(&(1.0 - c));
            let smooth = ratio(105.0, 100.0) * one_minus(l) * one_minus(v);
            let single = lerp(&smooth, rough, a) / &pi;
            rho * (single + rho * ratio(1159.0, 1e4) * a)
        }
        ("diffuse_eon", [l, v, lv, r, rho]) => {
            let c1 = 0.5 - 2.0 / (3.0 * &pi);
            let c2 = ratio(2.0, 3.0) - 28.0 / (15.0 * &pi);
            let s = lv - l * v;
            let s_over_t = if s.is_negative() { s } else { s / l.max(v) };
            let af = 1.0 / (1.0 + &c1 * r);
            let albedo = |mu: &Big| {
                let sin = (1.0 - sq(mu)).sqrt();
                let g = &sin * (mu.acos() - &sin * mu)
                    + ratio(2.0, 3.0) * ((&sin / mu) * (1.0 - sq(&sin) * &sin) - &sin);
                &af * (1.0 + r * g / &pi)
            };
            let average = &af * (1.0 + &c2 * r);
            let single = rho / &pi * &af * (1.0 + r * s_over_t);
            if r.is_zero() {
                return single;
            }
            let multi_rho = sq(rho) * &average / (1.0 - rho * (1.0 - &average));
            single + multi_rho / &pi * (1.0 - albedo(l)) * (1.0 - albedo(v)) / (1.0 - average)
        }

        ("specular_ggx", [l, v, h, r]) => {
            form("d_ggx", &[h, &sq(r)]) * form("v_ggx", &[l, v, &sq(r)])
        }

        ("f_schlick_average", [f0]) => (1.0 + 20.0 * f0) / 21.0,
        ("f0_from_ior", [n]) => sq(&((n - 1.0) / (n + 1.0))),
        ("f0_from_metallic", [base, m]) => ratio(4.0, 100.0) * (1.0 - m) + base * m,
        ("multi_scattering_tint", [f, e]) => sq(f) * e / (1.0 - f * (1.0 - e)),
        ("f_multi_kulla_conty", [l, v, average]) => (1.0 - l) * (1.0 - v) / (&pi * (1.0 - average)),
        ("compensation_turquin", [f0, e]) => 1.0 + f0 * (1.0 - e) / e,
        ("albedo_ggx_karis", [f0, mu, r]) => {
            // Decimals of at most four digits.
            let d = |x: f64| ratio((x * 1e4).round(), 1e4);
            let c = [
                [-1.0, 1.0],
                [-0.0275, 0.0425],
                [-0.572, 1.04],
                [0.022, -0.04],
            ];
            let [x, y, z, w] = c.map(|[c0, c1]| d(c0) * r + d(c1));
            let grazing = ratio(2.0, 1.0).pow(&(d(-9.28) * mu));
            let a004 = sq(&x).min(&grazing) * x + y;
            f0 * (d(-1.04) * &a004 + z) + (d(1.04) * a004 + w)
        }
        ("albedo_ggx_materialx", [f0, x, y]) => {
            let d = |x: f64| ratio((x * 1e4).round(), 1e4);
            let one = ratio(1.0, 1.0);
            let (x2, y2) = (sq(x), sq(y));
            let m = [
                one.clone(),
                x.clone(),
                y.clone(),
                x * y,
                x2.clone(),
                y2.clone(),
                &x2 * y,
                x * &y2,
                &x2 * &y2,
            ];
            let sum = |c: [f64; 9]| {
                let terms = m.iter().zip(c).map(|(m, c)| d(c) * m);
                terms.reduce(|sum, term| sum + term).unwrap_or(Big::none())
            };
            let r = [
                [
                    0.1003, -0.6303, 9.748, -2.038, 29.34, -8.245, -26.44, 19.99, -5.448,
                ],
                [
                    0.9345, -2.323, 2.229, -3.748, 1.424, -0.7684, 1.436, 0.2913, 0.6286,
                ],
                [
                    1.0, -1.765, 8.263, 11.53, 28.96, -7.507, -36.11, 15.86, 33.37,
                ],
                [
                    1.0, 0.2281, 15.94, -55.83, 13.08, 41.26, 54.9, 300.2, -285.1,
                ],
            ];
            let [rx, ry, rz, rw] = r.map(sum);
            let unit = |x: Big| x.max(&ratio(0.0, 1.0)).min(&one);
            f0 * unit(rx / rz) + unit(ry / rw)
        }
        ("alpha_filtered", [a, variance]) => {
            let kernel = (2.0 * variance).min(&ratio(18.0, 100.0));
            ratio(1.0, 1.0).min(&(sq(a) + kernel)).sqrt()
        }

        ("integral_d_ggx", [a]) => {
            let s2 = 1.0 - sq(a);
            let s = s2.abs().sqrt();
            if s2.is_zero() {
                ratio(2.0, 1.0)
            } else if s2.is_negative() {
                1.0 + sq(a) * s.atan() / &s
            } else {
                1.0 + sq(a) * ((1.0 + &s) / (1.0 - &s)).ln() / (2.0 * &s)
            }
        }
        ("integral_d_cos_ggx", [_]) => ratio(1.0, 1.0),
        ("share_ratio_above", [s, deg]) => {
            let c2 = sq(&(deg * &pi / 360.0).cos());
            ratio(1.0, 1.0).min(&(1.0 / (4.0 * s * c2)))
        }
        ("n_dot_h_from", [l, v, lv]) => ratio(1.0, 1.0).min(&((l + v) / (2.0 + 2.0 * lv).sqrt())),
        ("v_dot_h_from", [_, _, lv]) => ((1.0 + lv) / 2.0).sqrt(),
        _ => crate::directions::evaluate_vectors(name, args, bits),
    }
}

pub(crate) fn sq(x: &Big) -> Big {
    x * x
}

fn pow5(x: &Big) -> Big {
    sq(&sq(x)) * x
}

fn lerp(a: &Big, b: &Big, t: &Big) -> Big {
    a + t * (b - a)
}

/// tan² of the angle with this cosine.
fn tan2(c: &Big) -> Big {
    (1.0 - sq(c)) / sq(c)
}

fn schlick_g1(c: &Big, k: &Big) -> Big {
    c / (c * (1.0 - k) + k)
}

/// erf(x) = 2/sqrt(π) exp(−x²) Σ 2ⁿ x²ⁿ⁺¹/(2n + 1)!!, whose terms are all positive.
fn erf(x: &Big, pi: &Big) -> Big {
    let x2 = sq(x);
    let mut term = x.clone();
    let mut sum = x.clone();
    for n in 1.. {
        term = term * (2.0 * &x2) / f64::from(2 * n + 1);
        let next = &sum + &term;
        // Also where there is no value.
        if !(&next - &sum).is_positive() {
            break;
        }
        sum = next;
    }
    2.0 / pi.sqrt() * (-x2).exp() * sum
}
