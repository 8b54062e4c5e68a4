//! The registers of x86-64: four, eight and sixteen numbers.
//!
//! A type here is used only inside functions that are compiled for its instruction set, after
//! [`super::Isa`] has found it: everything is inlined there.

use super::lanes::Lanes;
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

/// SSE2, which every machine of the architecture has.
#[derive(Clone, Copy)]
pub(crate) struct F32x4(__m128);

/// AVX2 with FMA.
#[derive(Clone, Copy)]
pub(crate) struct F32x8(__m256);

/// AVX-512.
#[derive(Clone, Copy)]
pub(crate) struct F32x16(__m512);

macro_rules! operators {
    ($name:ident: $($trait:ident $method:ident $intrinsic:ident),*) => { $(
        impl $trait for $name {
            type Output = $name;
            #[inline(always)]
            fn $method(self, other: $name) -> $name {
                // SAFETY: the instruction set was found.
                $name(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    )* };
}

operators!(F32x4: Add add _mm_add_ps, Sub sub _mm_sub_ps, Mul mul _mm_mul_ps, Div div _mm_div_ps);
operators!(F32x8: Add add _mm256_add_ps, Sub sub _mm256_sub_ps, Mul mul _mm256_mul_ps, Div div _mm256_div_ps);
operators!(F32x16: Add add _mm512_add_ps, Sub sub _mm512_sub_ps, Mul mul _mm512_mul_ps, Div div _mm512_div_ps);

/// What the three have in common. The larger of two numbers is the second where one is a NaN.
macro_rules! common {
    ($count:literal, $splat:ident, $load:ident, $store:ident, $sqrt:ident, $max:ident, $min:ident) => {
        const COUNT: usize = $count;

        #[inline(always)]
        fn splat(x: f32) -> Self {
            // SAFETY: the instruction set was found.
            Self(unsafe { $splat(x) })
        }
        #[inline(always)]
        unsafe fn load(from: *const f32) -> Self {
            // SAFETY: as the caller promises.
            Self(unsafe { $load(from) })
        }
        #[inline(always)]
        unsafe fn store(self, to: *mut f32) {
            // SAFETY: as the caller promises.
            unsafe { $store(to, self.0) }
        }
        #[inline(always)]
        fn sqrt(self) -> Self {
            // SAFETY: the instruction set was found.
            Self(unsafe { $sqrt(self.0) })
        }
        #[inline(always)]
        fn at_least(self, low: Self) -> Self {
            // SAFETY: the instruction set was found.
            Self(unsafe { $max(low.0, self.0) })
        }
        #[inline(always)]
        fn at_most(self, high: Self) -> Self {
            // SAFETY: the instruction set was found.
            Self(unsafe { $min(high.0, self.0) })
        }
    };
}

/// The lanes of a shuffle, first to last: two of its first argument, two of its second.
const fn lanes(a: i32, b: i32, c: i32, d: i32) -> i32 {
    a | b << 2 | c << 4 | d << 6
}

/// Three columns from x y z x, y z x y, z x y z, in each 128 bits.
macro_rules! transposed {
    ($name:ident, $shuffle:ident, $a:expr, $b:expr, $c:expr) => {{
        let (a, b, c) = ($a, $b, $c);
        let xy = $shuffle::<{ lanes(2, 3, 1, 2) }>(b, c);
        let yz = $shuffle::<{ lanes(1, 2, 0, 1) }>(a, b);
        [
            $name($shuffle::<{ lanes(0, 3, 0, 2) }>(a, xy)),
            $name($shuffle::<{ lanes(0, 2, 1, 3) }>(yz, xy)),
            $name($shuffle::<{ lanes(1, 3, 0, 3) }>(yz, c)),
        ]
    }};
}

impl Lanes for F32x4 {
    common!(
        4,
        _mm_set1_ps,
        _mm_loadu_ps,
        _mm_storeu_ps,
        _mm_sqrt_ps,
        _mm_max_ps,
        _mm_min_ps
    );

    #[inline(always)]
    unsafe fn load_three(from: *const f32) -> [F32x4; 3] {
        // SAFETY: as the caller promises.
        unsafe {
            transposed!(
                F32x4,
                _mm_shuffle_ps,
                _mm_loadu_ps(from),
                _mm_loadu_ps(from.add(4)),
                _mm_loadu_ps(from.add(8))
            )
        }
    }
    #[inline(always)]
    fn mul_add(self, y: F32x4, z: F32x4) -> F32x4 {
        self * y + z
    }
    #[inline(always)]
    fn one_minus_square(self) -> F32x4 {
        let one = F32x4::splat(1.0);
        (one - self) * (one + self)
    }
    #[inline(always)]
    fn masks(self, value: F32x4) -> F32x4 {
        // SAFETY: the instruction set was found.
        F32x4(unsafe { _mm_and_ps(_mm_cmpnle_ps(self.0, _mm_setzero_ps()), value.0) })
    }
    #[inline(always)]
    fn any_less(self, limit: F32x4) -> bool {
        // SAFETY: the instruction set was found.
        unsafe { _mm_movemask_ps(_mm_cmplt_ps(self.0, limit.0)) != 0 }
    }
    #[inline(always)]
    fn if_less(self, limit: F32x4, yes: F32x4, no: F32x4) -> F32x4 {
        // SAFETY: the instruction set was found.
        F32x4(unsafe {
            let less = _mm_cmplt_ps(self.0, limit.0);
            _mm_or_ps(_mm_and_ps(less, yes.0), _mm_andnot_ps(less, no.0))
        })
    }
    #[inline(always)]
    fn turned(count: F32x4, sin: F32x4, cos: F32x4) -> (F32x4, F32x4) {
        // SAFETY: the instruction set was found.
        unsafe {
            let bits = _mm_castps_si128(count.0);
            let odd = _mm_castsi128_ps(_mm_srai_epi32::<31>(_mm_slli_epi32::<31>(bits)));
            let change = _mm_and_ps(odd, _mm_xor_ps(sin.0, cos.0));
            let sign = |x, count| {
                let second = _mm_and_si128(count, _mm_set1_epi32(2));
                F32x4(_mm_xor_ps(
                    x,
                    _mm_castsi128_ps(_mm_slli_epi32::<30>(second)),
                ))
            };
            (
                sign(_mm_xor_ps(sin.0, change), bits),
                sign(
                    _mm_xor_ps(cos.0, change),
                    _mm_add_epi32(bits, _mm_set1_epi32(1)),
                ),
            )
        }
    }
}

impl Lanes for F32x8 {
    common!(
        8,
        _mm256_set1_ps,
        _mm256_loadu_ps,
        _mm256_storeu_ps,
        _mm256_sqrt_ps,
        _mm256_max_ps,
        _mm256_min_ps
    );

    #[inline(always)]
    unsafe fn load_three(from: *const f32) -> [F32x8; 3] {
        // SAFETY: as the caller promises.
        unsafe {
            macro_rules! both {
                ($i:literal) => {
                    _mm256_set_m128(
                        _mm_loadu_ps(from.add(4 * ($i + 3))),
                        _mm_loadu_ps(from.add(4 * $i)),
                    )
                };
            }
            transposed!(F32x8, _mm256_shuffle_ps, both!(0), both!(1), both!(2))
        }
    }
    #[inline(always)]
    fn mul_add(self, y: F32x8, z: F32x8) -> F32x8 {
        // SAFETY: the instruction set was found.
        F32x8(unsafe { _mm256_fmadd_ps(self.0, y.0, z.0) })
    }
    #[inline(always)]
    fn one_minus_square(self) -> F32x8 {
        // SAFETY: the instruction set was found.
        F32x8(unsafe { _mm256_fnmadd_ps(self.0, self.0, _mm256_set1_ps(1.0)) })
    }
    #[inline(always)]
    fn masks(self, value: F32x8) -> F32x8 {
        // SAFETY: the instruction set was found.
        F32x8(unsafe {
            let above = _mm256_cmp_ps::<_CMP_NLE_UQ>(self.0, _mm256_setzero_ps());
            _mm256_and_ps(above, value.0)
        })
    }
    #[inline(always)]
    fn any_less(self, limit: F32x8) -> bool {
        // SAFETY: the instruction set was found.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, limit.0)) != 0 }
    }
    #[inline(always)]
    fn if_less(self, limit: F32x8, yes: F32x8, no: F32x8) -> F32x8 {
        // SAFETY: the instruction set was found.
        F32x8(unsafe {
            let less = _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, limit.0);
            _mm256_blendv_ps(no.0, yes.0, less)
        })
    }
    #[inline(always)]
    fn turned(count: F32x8, sin: F32x8, cos: F32x8) -> (F32x8, F32x8) {
        // SAFETY: the instruction set was found.
        unsafe {
            let bits = _mm256_castps_si256(count.0);
            let odd = _mm256_castsi256_ps(_mm256_slli_epi32::<31>(bits));
            let sign = |x, count| {
                let second = _mm256_and_si256(count, _mm256_set1_epi32(2));
                let second = _mm256_castsi256_ps(_mm256_slli_epi32::<30>(second));
                F32x8(_mm256_xor_ps(x, second))
            };
            (
                sign(_mm256_blendv_ps(sin.0, cos.0, odd), bits),
                sign(
                    _mm256_blendv_ps(cos.0, sin.0, odd),
                    _mm256_add_epi32(bits, _mm256_set1_epi32(1)),
                ),
            )
        }
    }
}

/// For one of three alternating columns in three registers of 16: which lanes of the first two,
/// then which of that and the third.
const fn column(first: i32) -> [[i32; 16]; 2] {
    let (mut early, mut late) = ([0; 16], [0; 16]);
    let mut i = 0;
    while i < 16 {
        let from = first + 3 * i as i32;
        if from < 32 {
            early[i] = from;
            late[i] = i as i32;
        } else {
            late[i] = from - 16;
        }
        i += 1;
    }
    [early, late]
}

impl Lanes for F32x16 {
    common!(
        16,
        _mm512_set1_ps,
        _mm512_loadu_ps,
        _mm512_storeu_ps,
        _mm512_sqrt_ps,
        _mm512_max_ps,
        _mm512_min_ps
    );

    #[inline(always)]
    unsafe fn load_three(from: *const f32) -> [F32x16; 3] {
        static COLUMNS: [[[i32; 16]; 2]; 3] = [column(0), column(1), column(2)];
        // SAFETY: as the caller promises.
        unsafe {
            let a = _mm512_loadu_ps(from);
            let b = _mm512_loadu_ps(from.add(16));
            let c = _mm512_loadu_ps(from.add(32));
            macro_rules! column {
                ($i:literal) => {{
                    let early = _mm512_loadu_si512(COLUMNS[$i][0].as_ptr().cast());
                    let late = _mm512_loadu_si512(COLUMNS[$i][1].as_ptr().cast());
                    F32x16(_mm512_permutex2var_ps(
                        _mm512_permutex2var_ps(a, early, b),
                        late,
                        c,
                    ))
                }};
            }
            [column!(0), column!(1), column!(2)]
        }
    }
    #[inline(always)]
    fn mul_add(self, y: F32x16, z: F32x16) -> F32x16 {
        // SAFETY: the instruction set was found.
        F32x16(unsafe { _mm512_fmadd_ps(self.0, y.0, z.0) })
    }
    #[inline(always)]
    fn one_minus_square(self) -> F32x16 {
        // SAFETY: the instruction set was found.
        F32x16(unsafe { _mm512_fnmadd_ps(self.0, self.0, _mm512_set1_ps(1.0)) })
    }
    #[inline(always)]
    fn masks(self, value: F32x16) -> F32x16 {
        // SAFETY: the instruction set was found.
        F32x16(unsafe {
            let above = _mm512_cmp_ps_mask::<_CMP_NLE_UQ>(self.0, _mm512_setzero_ps());
            _mm512_maskz_mov_ps(above, value.0)
        })
    }
    #[inline(always)]
    fn any_less(self, limit: F32x16) -> bool {
        // SAFETY: the instruction set was found.
        unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, limit.0) != 0 }
    }
    #[inline(always)]
    fn if_less(self, limit: F32x16, yes: F32x16, no: F32x16) -> F32x16 {
        // SAFETY: the instruction set was found.
        F32x16(unsafe {
            let less = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, limit.0);
            _mm512_mask_blend_ps(less, no.0, yes.0)
        })
    }
    #[inline(always)]
    fn turned(count: F32x16, sin: F32x16, cos: F32x16) -> (F32x16, F32x16) {
        // SAFETY: the instruction set was found.
        unsafe {
            let bits = _mm512_castps_si512(count.0);
            let odd = _mm512_test_epi32_mask(bits, _mm512_set1_epi32(1));
            let sign = |x, count| {
                let second = _mm512_and_si512(count, _mm512_set1_epi32(2));
                let second = _mm512_slli_epi32::<30>(second);
                F32x16(_mm512_castsi512_ps(_mm512_xor_si512(
                    _mm512_castps_si512(x),
                    second,
                )))
            };
            (
                sign(_mm512_mask_blend_ps(odd, sin.0, cos.0), bits),
                sign(
                    _mm512_mask_blend_ps(odd, cos.0, sin.0),
                    _mm512_add_epi32(bits, _mm512_set1_epi32(1)),
                ),
            )
        }
    }
}
