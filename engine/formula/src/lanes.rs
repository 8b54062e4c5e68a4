//! Vectors of the machine: the few operations that a tile is computed with, for every set of
//! instructions. Results are the same on all of them to the last bit: nothing is contracted.

#[cfg(any(test, not(target_arch = "x86_64")))]
use crate::builtin::Builtin;
use crate::eval::Real;
use crate::expr::CompareOp;

/// Some values that one instruction works on.
///
/// # Safety
/// Every method needs the instructions of its type: an implementor for more than the baseline
/// is used only inside of a function that enables them, on a machine that has them.
pub(crate) trait Lanes: Copy {
    type Real: Real;
    /// Values in a vector.
    const WIDTH: usize;
    /// Whether there are registers for two tiles.
    const PARKS: bool;
    /// Reads [`Lanes::WIDTH`] values, which must be there.
    unsafe fn load(from: *const Self::Real) -> Self;
    /// Writes [`Lanes::WIDTH`] values, for which there must be room.
    unsafe fn store(self, to: *mut Self::Real);
    unsafe fn splat(value: Self::Real) -> Self;
    unsafe fn add(self, other: Self) -> Self;
    unsafe fn sub(self, other: Self) -> Self;
    unsafe fn mul(self, other: Self) -> Self;
    unsafe fn div(self, other: Self) -> Self;
    /// The smaller one; the other where one is a NaN.
    unsafe fn least(self, other: Self) -> Self;
    /// The larger one; the other where one is a NaN.
    unsafe fn most(self, other: Self) -> Self;
    unsafe fn sqrt(self) -> Self;
    unsafe fn abs(self) -> Self;
    unsafe fn neg(self) -> Self;
    /// 1 where the comparison holds, else 0.
    unsafe fn compare(self, op: CompareOp, other: Self) -> Self;
}

/// What every machine has: a few values one after the other.
#[cfg(any(test, not(target_arch = "x86_64")))]
#[derive(Clone, Copy)]
pub(crate) struct Plain<R>([R; 4]);

#[cfg(any(test, not(target_arch = "x86_64")))]
impl<R: Real> Plain<R> {
    #[inline(always)]
    fn each(self, f: impl Fn(R) -> R) -> Self {
        Plain(self.0.map(f))
    }

    #[inline(always)]
    fn pairs(self, other: Self, f: impl Fn(R, R) -> R) -> Self {
        Plain(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

#[cfg(any(test, not(target_arch = "x86_64")))]
impl<R: Real> Lanes for Plain<R> {
    type Real = R;
    const WIDTH: usize = 4;
    const PARKS: bool = false;
    #[inline(always)]
    unsafe fn load(from: *const R) -> Self {
        // SAFETY: the caller promises four values.
        unsafe { from.cast::<Self>().read_unaligned() }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut R) {
        // SAFETY: the caller promises room for four values.
        unsafe { to.cast::<Self>().write_unaligned(self) }
    }
    #[inline(always)]
    unsafe fn splat(value: R) -> Self {
        Plain([value; 4])
    }
    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        self.pairs(other, R::add)
    }
    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        self.pairs(other, R::sub)
    }
    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        self.pairs(other, R::mul)
    }
    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        self.pairs(other, R::div)
    }
    #[inline(always)]
    unsafe fn least(self, other: Self) -> Self {
        self.pairs(other, R::least)
    }
    #[inline(always)]
    unsafe fn most(self, other: Self) -> Self {
        self.pairs(other, R::most)
    }
    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        self.each(|r| r.unary(Builtin::Sqrt))
    }
    #[inline(always)]
    unsafe fn abs(self) -> Self {
        self.each(|r| r.unary(Builtin::Abs))
    }
    #[inline(always)]
    unsafe fn neg(self) -> Self {
        self.each(R::neg)
    }
    #[inline(always)]
    unsafe fn compare(self, op: CompareOp, other: Self) -> Self {
        self.pairs(other, |a, b| a.compare(op, b))
    }
}

#[cfg(target_arch = "x86_64")]
mod x86 {
    use super::{CompareOp, Lanes};
    use std::arch::x86_64::*;

    /// The methods that are one instruction everywhere.
    macro_rules! simple {
        ($real:ty, $load:ident, $store:ident, $splat:ident, $add:ident, $sub:ident, $mul:ident,
         $div:ident, $sqrt:ident, $andnot:ident, $xor:ident) => {
            type Real = $real;
            const WIDTH: usize = size_of::<Self>() / size_of::<$real>();
            const PARKS: bool = size_of::<Self>() == 64;
            #[inline(always)]
            unsafe fn load(from: *const $real) -> Self {
                // SAFETY: the caller promises the values and the instruction.
                unsafe { $load(from) }
            }
            #[inline(always)]
            unsafe fn store(self, to: *mut $real) {
                // SAFETY: the caller promises the room and the instruction.
                unsafe { $store(to, self) }
            }
            simple!(@one splat($real) $splat);
            simple!(@two add $add);
            simple!(@two sub $sub);
            simple!(@two mul $mul);
            simple!(@two div $div);
            #[inline(always)]
            unsafe fn sqrt(self) -> Self {
                // SAFETY: the caller promises the instruction.
                unsafe { $sqrt(self) }
            }
            #[inline(always)]
            unsafe fn abs(self) -> Self {
                // SAFETY: the caller promises the instruction.
                unsafe { $andnot($splat(-0.0), self) }
            }
            #[inline(always)]
            unsafe fn neg(self) -> Self {
                // SAFETY: the caller promises the instruction.
                unsafe { $xor($splat(-0.0), self) }
            }
        };
        (@one $name:ident($real:ty) $instruction:ident) => {
            #[inline(always)]
            unsafe fn $name(value: $real) -> Self {
                // SAFETY: the caller promises the instruction.
                unsafe { $instruction(value) }
            }
        };
        (@two $name:ident $instruction:ident) => {
            #[inline(always)]
            unsafe fn $name(self, other: Self) -> Self {
                // SAFETY: the caller promises the instruction.
                unsafe { $instruction(self, other) }
            }
        };
    }

    macro_rules! sse {
        ($vector:ty, $real:ty, $min:ident, $max:ident, $and:ident, $or:ident, $not_nan:ident,
         $lt:ident, $le:ident, $gt:ident, $ge:ident, $eq:ident, $ne:ident,
         $load:ident, $store:ident, $splat:ident, $add:ident, $sub:ident, $mul:ident,
         $div:ident, $sqrt:ident, $andnot:ident, $xor:ident) => {
            impl Lanes for $vector {
                simple!(
                    $real, $load, $store, $splat, $add, $sub, $mul, $div, $sqrt, $andnot, $xor
                );
                #[inline(always)]
                unsafe fn least(self, other: Self) -> Self {
                    // SAFETY: every machine has these. The instruction gives its second operand
                    // where one is a NaN.
                    unsafe {
                        let known = $not_nan(self, self);
                        $or($and(known, $min(other, self)), $andnot(known, other))
                    }
                }
                #[inline(always)]
                unsafe fn most(self, other: Self) -> Self {
                    // SAFETY: as above.
                    unsafe {
                        let known = $not_nan(self, self);
                        $or($and(known, $max(other, self)), $andnot(known, other))
                    }
                }
                #[inline(always)]
                unsafe fn compare(self, op: CompareOp, other: Self) -> Self {
                    // SAFETY: every machine has these.
                    unsafe {
                        let holds = match op {
                            CompareOp::Less => $lt(self, other),
                            CompareOp::LessEqual => $le(self, other),
                            CompareOp::Greater => $gt(self, other),
                            CompareOp::GreaterEqual => $ge(self, other),
                            CompareOp::Equal => $eq(self, other),
                            CompareOp::NotEqual => $ne(self, other),
                        };
                        $and(holds, $splat(1.0))
                    }
                }
            }
        };
    }
    sse!(
        __m128d,
        f64,
        _mm_min_pd,
        _mm_max_pd,
        _mm_and_pd,
        _mm_or_pd,
        _mm_cmpord_pd,
        _mm_cmplt_pd,
        _mm_cmple_pd,
        _mm_cmpgt_pd,
        _mm_cmpge_pd,
        _mm_cmpeq_pd,
        _mm_cmpneq_pd,
        _mm_loadu_pd,
        _mm_storeu_pd,
        _mm_set1_pd,
        _mm_add_pd,
        _mm_sub_pd,
        _mm_mul_pd,
        _mm_div_pd,
        _mm_sqrt_pd,
        _mm_andnot_pd,
        _mm_xor_pd
    );
    sse!(
        __m128,
        f32,
        _mm_min_ps,
        _mm_max_ps,
        _mm_and_ps,
        _mm_or_ps,
        _mm_cmpord_ps,
        _mm_cmplt_ps,
        _mm_cmple_ps,
        _mm_cmpgt_ps,
        _mm_cmpge_ps,
        _mm_cmpeq_ps,
        _mm_cmpneq_ps,
        _mm_loadu_ps,
        _mm_storeu_ps,
        _mm_set1_ps,
        _mm_add_ps,
        _mm_sub_ps,
        _mm_mul_ps,
        _mm_div_ps,
        _mm_sqrt_ps,
        _mm_andnot_ps,
        _mm_xor_ps
    );

    macro_rules! avx2 {
        ($vector:ty, $real:ty, $min:ident, $max:ident, $and:ident, $blend:ident, $cmp:ident,
         $load:ident, $store:ident, $splat:ident, $add:ident, $sub:ident, $mul:ident,
         $div:ident, $sqrt:ident, $andnot:ident, $xor:ident) => {
            impl Lanes for $vector {
                simple!(
                    $real, $load, $store, $splat, $add, $sub, $mul, $div, $sqrt, $andnot, $xor
                );
                #[inline(always)]
                unsafe fn least(self, other: Self) -> Self {
                    // SAFETY: the caller promises the instructions, which give their second
                    // operand where one is a NaN.
                    unsafe {
                        let unknown = $cmp::<_CMP_UNORD_Q>(self, self);
                        $blend($min(other, self), other, unknown)
                    }
                }
                #[inline(always)]
                unsafe fn most(self, other: Self) -> Self {
                    // SAFETY: as above.
                    unsafe {
                        let unknown = $cmp::<_CMP_UNORD_Q>(self, self);
                        $blend($max(other, self), other, unknown)
                    }
                }
                #[inline(always)]
                unsafe fn compare(self, op: CompareOp, other: Self) -> Self {
                    // SAFETY: the caller promises the instructions.
                    unsafe {
                        let holds = match op {
                            CompareOp::Less => $cmp::<_CMP_LT_OQ>(self, other),
                            CompareOp::LessEqual => $cmp::<_CMP_LE_OQ>(self, other),
                            CompareOp::Greater => $cmp::<_CMP_GT_OQ>(self, other),
                            CompareOp::GreaterEqual => $cmp::<_CMP_GE_OQ>(self, other),
                            CompareOp::Equal => $cmp::<_CMP_EQ_OQ>(self, other),
                            CompareOp::NotEqual => $cmp::<_CMP_NEQ_UQ>(self, other),
                        };
                        $and(holds, $splat(1.0))
                    }
                }
            }
        };
    }
    avx2!(
        __m256d,
        f64,
        _mm256_min_pd,
        _mm256_max_pd,
        _mm256_and_pd,
        _mm256_blendv_pd,
        _mm256_cmp_pd,
        _mm256_loadu_pd,
        _mm256_storeu_pd,
        _mm256_set1_pd,
        _mm256_add_pd,
        _mm256_sub_pd,
        _mm256_mul_pd,
        _mm256_div_pd,
        _mm256_sqrt_pd,
        _mm256_andnot_pd,
        _mm256_xor_pd
    );
    avx2!(
        __m256,
        f32,
        _mm256_min_ps,
        _mm256_max_ps,
        _mm256_and_ps,
        _mm256_blendv_ps,
        _mm256_cmp_ps,
        _mm256_loadu_ps,
        _mm256_storeu_ps,
        _mm256_set1_ps,
        _mm256_add_ps,
        _mm256_sub_ps,
        _mm256_mul_ps,
        _mm256_div_ps,
        _mm256_sqrt_ps,
        _mm256_andnot_ps,
        _mm256_xor_ps
    );

    macro_rules! avx512 {
        ($vector:ty, $real:ty, $min:ident, $max:ident, $blend:ident, $cmp:ident, $keep:ident,
         $load:ident, $store:ident, $splat:ident, $add:ident, $sub:ident, $mul:ident,
         $div:ident, $sqrt:ident, $andnot:ident, $xor:ident) => {
            impl Lanes for $vector {
                simple!(
                    $real, $load, $store, $splat, $add, $sub, $mul, $div, $sqrt, $andnot, $xor
                );
                #[inline(always)]
                unsafe fn least(self, other: Self) -> Self {
                    // SAFETY: the caller promises the instructions, which give their second
                    // operand where one is a NaN.
                    unsafe {
                        let unknown = $cmp::<_CMP_UNORD_Q>(self, self);
                        $blend(unknown, $min(other, self), other)
                    }
                }
                #[inline(always)]
                unsafe fn most(self, other: Self) -> Self {
                    // SAFETY: as above.
                    unsafe {
                        let unknown = $cmp::<_CMP_UNORD_Q>(self, self);
                        $blend(unknown, $max(other, self), other)
                    }
                }
                #[inline(always)]
                unsafe fn compare(self, op: CompareOp, other: Self) -> Self {
                    // SAFETY: the caller promises the instructions.
                    unsafe {
                        let holds = match op {
                            CompareOp::Less => $cmp::<_CMP_LT_OQ>(self, other),
                            CompareOp::LessEqual => $cmp::<_CMP_LE_OQ>(self, other),
                            CompareOp::Greater => $cmp::<_CMP_GT_OQ>(self, other),
                            CompareOp::GreaterEqual => $cmp::<_CMP_GE_OQ>(self, other),
                            CompareOp::Equal => $cmp::<_CMP_EQ_OQ>(self, other),
                            CompareOp::NotEqual => $cmp::<_CMP_NEQ_UQ>(self, other),
                        };
                        $keep(holds, $splat(1.0))
                    }
                }
            }
        };
    }
    avx512!(
        __m512d,
        f64,
        _mm512_min_pd,
        _mm512_max_pd,
        _mm512_mask_blend_pd,
        _mm512_cmp_pd_mask,
        _mm512_maskz_mov_pd,
        _mm512_loadu_pd,
        _mm512_storeu_pd,
        _mm512_set1_pd,
        _mm512_add_pd,
        _mm512_sub_pd,
        _mm512_mul_pd,
        _mm512_div_pd,
        _mm512_sqrt_pd,
        _mm512_andnot_pd,
        _mm512_xor_pd
    );
    avx512!(
        __m512,
        f32,
        _mm512_min_ps,
        _mm512_max_ps,
        _mm512_mask_blend_ps,
        _mm512_cmp_ps_mask,
        _mm512_maskz_mov_ps,
        _mm512_loadu_ps,
        _mm512_storeu_ps,
        _mm512_set1_ps,
        _mm512_add_ps,
        _mm512_sub_ps,
        _mm512_mul_ps,
        _mm512_div_ps,
        _mm512_sqrt_ps,
        _mm512_andnot_ps,
        _mm512_xor_ps
    );
}
