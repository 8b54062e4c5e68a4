//! Single precision as the batches have it: from memory and back, and with fused products.

use super::{Real, lit};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Single precision in a batch: loaded from and stored to slices of `f32`.
pub(crate) trait Single: Real {
    /// From memory.
    fn load(x: f32) -> Self;
    /// To memory.
    fn store(self) -> f32;

    /// 1 − x², without cancellation near 1: one instruction where products are fused.
    #[inline(always)]
    fn one_minus_square(self) -> Self {
        (lit::<Self>(1.0) - self) * (lit::<Self>(1.0) + self)
    }

    /// sin and cos of 2π times this, see [`batch::sin_cos_turn`](crate::batch::sin_cos_turn).
    fn sin_cos_turn(self) -> (Self, Self);
}

impl Single for f32 {
    #[inline(always)]
    fn load(x: f32) -> f32 {
        x
    }
    #[inline(always)]
    fn store(self) -> f32 {
        self
    }
    #[inline(always)]
    fn sin_cos_turn(self) -> (f32, f32) {
        crate::batch::sin_cos_turn(self)
    }
}

/// Single precision where the machine multiplies and adds in one instruction.
///
/// Only for functions compiled with that feature: elsewhere each `mul_add` is a library call.
#[cfg_attr(not(target_arch = "x86_64"), allow(dead_code))]
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub(crate) struct Fused(pub(crate) f32);

impl Single for Fused {
    #[inline(always)]
    fn load(x: f32) -> Fused {
        Fused(x)
    }
    #[inline(always)]
    fn store(self) -> f32 {
        self.0
    }
    #[inline(always)]
    fn one_minus_square(self) -> Fused {
        (-self).mul_add(self, lit(1.0))
    }
    #[inline(always)]
    fn sin_cos_turn(self) -> (Fused, Fused) {
        crate::batch::sin_cos_turn(self)
    }
}

macro_rules! fused_operators {
    ($($trait:ident $method:ident),*) => { $(
        impl $trait for Fused {
            type Output = Fused;
            #[inline(always)]
            fn $method(self, other: Fused) -> Fused {
                Fused($trait::$method(self.0, other.0))
            }
        }
    )* };
}
fused_operators!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Fused {
    type Output = Fused;
    #[inline(always)]
    fn neg(self) -> Fused {
        Fused(-self.0)
    }
}

macro_rules! fused_functions {
    ($($name:ident),*) => { $(
        #[inline(always)]
        fn $name(self) -> Fused {
            Fused(Real::$name(self.0))
        }
    )* };
}

impl Real for Fused {
    const EPSILON: f64 = <f32 as Real>::EPSILON;
    const LARGE: f64 = f32::LARGE;
    const TINY: f64 = f32::TINY;
    const SPLITTER: f64 = f32::SPLITTER;
    const ERFC_TERMS: usize = f32::ERFC_TERMS;

    fused_functions!(sqrt, abs, exp, exp2, ln, ln_1p, sin, cos, asin, acos, atan);

    #[inline(always)]
    fn of(x: f64) -> Fused {
        Fused(x as f32)
    }
    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self.0)
    }
    fn powf(self, y: Fused) -> Fused {
        Fused(Real::powf(self.0, y.0))
    }
    fn atan2(self, x: Fused) -> Fused {
        Fused(Real::atan2(self.0, x.0))
    }
    #[inline(always)]
    fn is_nan(self) -> bool {
        self.0.is_nan()
    }
    #[inline(always)]
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    #[inline(always)]
    fn mul_add(self, y: Fused, z: Fused) -> Fused {
        Fused(self.0.mul_add(y.0, z.0))
    }
    #[inline(always)]
    fn two_prod(self, y: Fused) -> (Fused, Fused) {
        let p = self * y;
        (p, self.mul_add(y, -p))
    }
    #[inline(always)]
    fn two_square(self) -> (Fused, Fused) {
        self.two_prod(self)
    }
}
