//! What the terms of `brdf` should be: the textbook forms, evaluated in as many digits as
//! their cancellations need.
//!
//! The forms here are written as the papers print them, apart from the stable ones in
//! `brdf`: a formula measured against itself in higher precision would agree with its own
//! mistake. `bench`, `stress` and tests measure against this crate; `brdf` never uses it.

pub mod albedo;
pub mod bench;
mod big;
mod directions;
mod forms;
pub mod naive;
mod quadrature;
pub mod stress;

pub use big::Big;

/// Significant bits to which two evaluations must agree, a little over 36 digits.
const AGREED_BITS: isize = 120;

/// Value of a term at exactly the given arguments, to at least 36 digits.
///
/// `None` where the formula has no finite value there, or the term is not a closed form.
/// Evaluated in growing precision until two results agree, so that a form that cancels is as
/// good as one that does not.
pub fn value(name: &str, args: &[f64]) -> Option<Big> {
    let mut bits = 192;
    let mut coarse = at_precision(name, args, bits)?;
    loop {
        bits *= 2;
        let fine = at_precision(name, args, bits)?;
        if fine.agrees(&coarse, AGREED_BITS) || bits > 4096 {
            return Some(fine);
        }
        coarse = fine;
    }
}

pub(crate) fn at_precision(name: &str, args: &[f64], bits: usize) -> Option<Big> {
    let args: Vec<Big> = args.iter().map(|&x| Big::new(x, bits)).collect();
    forms::evaluate(name, &args, bits).finite()
}
