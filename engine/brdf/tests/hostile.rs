//! Arguments nobody should pass: what comes out is still what the documentation says.

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
