//! Arguments nobody should pass: what comes out is still what the documentation says.

use brdf::batch::{self, Isa, Samples};
use brdf::glam::Vec3;
use brdf::{Term, terms, vector_terms};

const ODD: [f64; 16] = [
    f64::NEG_INFINITY,
    -1e30,
    -1.0,
    -1e-30,
    -0.0,
    0.0,
    1e-45,
    1e-30,
    1e-12,
    0.3,
    1.0,
    1.0000001,
    2.0,
    1e10,
    3e38,
    f64::INFINITY,
];

/// Every combination of odd values for a term's arguments, or 60,000 of them.
fn combinations(count: usize, values: &[f64], mut visit: impl FnMut(&[f64])) {
    let total = values.len().pow(count as u32);
    let mut args = vec![0.0; count];
    let mut seed = 1u64;
    for index in 0..total.min(60_000) {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        let mut rest = if total > 60_000 {
            (seed >> 16) as usize
        } else {
            index
        };
        for arg in &mut args {
            *arg = values[rest % values.len()];
            rest /= values.len();
        }
        visit(&args);
    }
}

fn cheap(term: &Term) -> bool {
    term.cost < 10_000
}

#[test]
fn no_finite_argument_gives_nan() {
    let finite: Vec<f64> = ODD.into_iter().filter(|x| x.is_finite()).collect();
    let mut bad = Vec::new();
    let cheap_terms = terms().iter().filter(|term| cheap(term));
    for term in cheap_terms.chain(vector_terms()) {
        let mut count = 0;
        let mut first = None;
        combinations(term.params.len(), &finite, |args| {
            let single: Vec<f32> = args.iter().map(|&x| x as f32).collect();
            for value in [(term.f64)(args), f64::from((term.f32)(&single))] {
                if value.is_nan() {
                    count += 1;
                    first.get_or_insert(args.to_vec());
                }
            }
        });
        if let Some(args) = first {
            bad.push(format!("{} {count} times, first at {args:?}", term.name));
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn nan_stays_nan() {
    for term in terms().iter().filter(|term| cheap(term)) {
        for index in 0..term.params.len() {
            let middle = |range: (f64, f64)| 0.4 * range.0 + 0.6 * range.1;
            let mut args: Vec<f64> = term
                .params
                .iter()
                .map(|param| middle(param.range))
                .collect();
            args[index] = f64::NAN;
            let single: Vec<f32> = args.iter().map(|&x| x as f32).collect();
            let name = term.params[index].name;
            assert!((term.f64)(&args).is_nan(), "{}: {name} = NaN", term.name);
            assert!(
                (term.f32)(&single).is_nan(),
                "{}: {name} = NaN in single precision",
                term.name
            );
        }
    }
}

#[test]
fn infinite_arguments_do_not_panic() {
    for term in terms().iter().filter(|term| cheap(term)) {
        combinations(term.params.len(), &ODD, |args| {
            let _ = (term.f64)(args);
        });
    }
}

#[test]
fn wrong_number_of_arguments_is_nan() {
    for term in terms() {
        assert!((term.f64)(&[]).is_nan(), "{}", term.name);
        assert!((term.f32)(&[0.5; 9]).is_nan(), "{}", term.name);
    }
}

#[test]
fn integrals_take_anything() {
    for term in terms().iter().filter(|term| !cheap(term)) {
        for mu in ODD {
            for alpha in [0.0, 1e-30, 0.3, 1.0, 2.0, 1e10] {
                let args = [mu, alpha];
                let value = (term.f64)(&args[args.len() - term.params.len()..]);
                assert!(
                    !value.is_nan() && value >= 0.0,
                    "{}({mu}, {alpha}) = {value}",
                    term.name
                );
            }
            if term.params.len() == 1 {
                break;
            }
        }
    }
}

/// Lights drawn by a batch: finite in its domain, and out of it at least no panic and no harm to the
/// neighbours.
#[test]
fn batches_draw_from_anything() {
    let u: Vec<f32> = [0.0, 1e-45, 1e-7, 0.25, 0.5, 0.75, 0.999_999_94].to_vec();
    let pairs: Vec<(f32, f32)> = u
        .iter()
        .flat_map(|&a| u.iter().map(move |&b| (a, b)))
        .collect();
    let (mut u0, mut u1): (Vec<f32>, Vec<f32>) = pairs.into_iter().unzip();
    let draw = |isa, v: Vec3, alpha: f32, u: [&[f32]; 2]| {
        let mut all = [0; 5].map(|_| vec![0.0f32; u[0].len()]);
        let [x, y, z, pdf, weight] = &mut all;
        let l = [x, y, z].map(|column| column.as_mut_slice());
        batch::sample(isa, v, alpha, u, Samples { l, pdf, weight });
        all
    };
    for isa in Isa::available() {
        for alpha in [1e-4f32, 0.01, 0.3, 1.0] {
            for z in [1e-6f32, 1e-3, 0.1, 0.7, 1.0] {
                let v = Vec3::new(((1.0 - z) * (1.0 + z)).sqrt(), 0.0, z);
                let all = draw(isa, v, alpha, [&u0, &u1]);
                for (column, values) in all.iter().enumerate() {
                    let bad = values.iter().position(|x| !x.is_finite());
                    let at = bad.map(|i| (u0[i], u1[i]));
                    assert_eq!(at, None, "{} {alpha} {z}: column {column}", isa.name());
                }
                assert!(all[3..].iter().flatten().all(|&x| x >= 0.0), "{alpha} {z}");
            }
        }
        let odd = ODD.map(|x| x as f32);
        for x in odd {
            for alpha in odd {
                draw(isa, Vec3::new(x, 0.3, alpha), alpha, [&u0, &u1]);
            }
        }
    }
    // One number that is none harms its own light only.
    let before = draw(Isa::best(), Vec3::new(0.6, 0.0, 0.8), 0.3, [&u0, &u1]);
    (u0[5], u1[20]) = (f32::NAN, f32::NAN);
    let after = draw(Isa::best(), Vec3::new(0.6, 0.0, 0.8), 0.3, [&u0, &u1]);
    for (before, after) in before.iter().zip(&after) {
        let changed = (0..before.len()).filter(|&i| before[i].to_bits() != after[i].to_bits());
        assert!(changed.into_iter().all(|i| i == 5 || i == 20));
    }
}
