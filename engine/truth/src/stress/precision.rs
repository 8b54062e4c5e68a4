//! The two arithmetics, and how far apart their numbers are.

/// The arithmetic a term is computed in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// `f32`.
    Single,
    /// `f64`.
    Double,
}

impl Precision {
    /// As commands write it, `f32` or `f64`.
    pub fn name(self) -> &'static str {
        match self {
            Precision::Single => "f32",
            Precision::Double => "f64",
        }
    }

    /// Bits after the leading one, and the exponent of the smallest normal number.
    pub(super) fn format(self) -> (isize, isize) {
        match self {
            Precision::Single => (23, -126),
            Precision::Double => (52, -1022),
        }
    }

    pub(super) fn largest(self) -> f64 {
        match self {
            Precision::Single => f64::from(f32::MAX),
            Precision::Double => f64::MAX,
        }
    }

    /// The argument as this precision can hold it.
    pub(super) fn round(self, x: f64) -> f64 {
        match self {
            Precision::Single => f64::from(x as f32),
            Precision::Double => x,
        }
    }

    /// `steps` representable numbers up or down.
    pub(super) fn step(self, x: f64, steps: i32) -> f64 {
        let up = steps > 0;
        (0..steps.unsigned_abs()).fold(x, |x, _| match (self, up) {
            (Precision::Single, true) => f64::from((x as f32).next_up()),
            (Precision::Single, false) => f64::from((x as f32).next_down()),
            (Precision::Double, true) => x.next_up(),
            (Precision::Double, false) => x.next_down(),
        })
    }

    /// Distance between neighbours at a number of that size.
    pub(super) fn ulp(self, size: f64) -> f64 {
        let (digits, smallest) = self.format();
        // A logarithm may round up to the next power of two.
        let exponent = match size.abs() {
            size if size > 0.0 && size.is_finite() => {
                let exponent = size.log2().floor();
                if exponent.exp2() > size {
                    exponent - 1.0
                } else {
                    exponent
                }
            }
            _ => smallest as f64,
        };
        (exponent.max(smallest as f64) - digits as f64).exp2()
    }
}
