//! Vector registers as numbers, and the loop over them.
//!
//! A kernel is written once, generic over [`Lanes`], and is compiled for the registers of each
//! instruction set. The registers are named, not left to the compiler's vectoriser, which finds
//! them in one build and not in the next; and the loop is pipelined: a core sees only so many
//! instructions ahead, and the way from one number's square root to its quotient is longer.

use crate::real::{Fused, Real};
use glam::Vec3;
use std::marker::PhantomData;
use std::ops::{Add, Div, Mul, Sub};

/// A register full of single precision numbers.
pub(crate) trait Lanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// How many.
    const COUNT: usize;

    /// The same number in all.
    fn splat(x: f32) -> Self;
    /// From memory.
    ///
    /// # Safety
    ///
    /// `COUNT` numbers can be read there.
    unsafe fn load(from: *const f32) -> Self;
    /// From memory where three columns alternate.
    ///
    /// # Safety
    ///
    /// Three times `COUNT` numbers can be read there.
    unsafe fn load_three(from: *const f32) -> [Self; 3];
    /// To memory.
    ///
    /// # Safety
    ///
    /// `COUNT` numbers can be written there.
    unsafe fn store(self, to: *mut f32);

    /// self · y + z, fused where that is an instruction.
    fn mul_add(self, y: Self, z: Self) -> Self;
    /// 1 − x² without cancellation near 1.
    fn one_minus_square(self) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// The larger of the two, and `self` where `self` is a NaN.
    fn at_least(self, low: Self) -> Self;
    /// The smaller of the two, and `self` where `self` is a NaN.
    fn at_most(self, high: Self) -> Self;
    /// `value`, but 0 where `self` is 0 or less.
    fn masks(self, value: Self) -> Self;
    /// Whether one of them is less than that of `limit`.
    fn any_less(self, limit: Self) -> bool;
    /// `yes` where `self` is less than `limit`, else `no`.
    fn if_less(self, limit: Self, yes: Self, no: Self) -> Self;
    /// Sine and cosine of an angle some quarters of a turn larger than that of `sin` and `cos`:
    /// the number of quarters is in the last bits of `count`.
    fn turned(count: Self, sin: Self, cos: Self) -> (Self, Self);
}

/// A constant in all lanes.
#[inline(always)]
pub(crate) fn lit<S: Lanes>(x: f64) -> S {
    S::splat(x as f32)
}

/// One lane, for the numbers that do not fill a register, and for machines whose registers are
/// not named here. The arithmetic is the same to the last bit.
macro_rules! single_lane {
    ($name:ident, $value:ident => $wrap:expr, $number:ident => $unwrap:expr) => {
        impl Lanes for $name {
            const COUNT: usize = 1;

            #[inline(always)]
            fn splat($value: f32) -> $name {
                $wrap
            }
            #[inline(always)]
            unsafe fn load(from: *const f32) -> $name {
                // SAFETY: as the caller promises.
                Self::splat(unsafe { *from })
            }
            #[inline(always)]
            unsafe fn load_three(from: *const f32) -> [$name; 3] {
                // SAFETY: as the caller promises.
                [0, 1, 2].map(|i| Self::splat(unsafe { *from.add(i) }))
            }
            #[inline(always)]
            unsafe fn store(self, to: *mut f32) {
                let $number = self;
                // SAFETY: as the caller promises.
                unsafe { *to = $unwrap }
            }
            #[inline(always)]
            fn mul_add(self, y: $name, z: $name) -> $name {
                Real::mul_add(self, y, z)
            }
            #[inline(always)]
            fn one_minus_square(self) -> $name {
                crate::real::Single::one_minus_square(self)
            }
            #[inline(always)]
            fn sqrt(self) -> $name {
                Real::sqrt(self)
            }
            #[inline(always)]
            fn at_least(self, low: $name) -> $name {
                Real::at_least(self, low)
            }
            #[inline(always)]
            fn at_most(self, high: $name) -> $name {
                Real::at_most(self, high)
            }
            #[inline(always)]
            fn masks(self, value: $name) -> $name {
                if self <= Self::splat(0.0) {
                    Self::splat(0.0)
                } else {
                    value
                }
            }
            #[inline(always)]
            fn any_less(self, limit: $name) -> bool {
                self < limit
            }
            #[inline(always)]
            fn if_less(self, limit: $name, yes: $name, no: $name) -> $name {
                if self < limit { yes } else { no }
            }
            #[inline(always)]
            fn turned(count: $name, sin: $name, cos: $name) -> ($name, $name) {
                let bits = |$number: $name| ($unwrap).to_bits();
                let count = bits(count);
                let (a, b) = if count & 1 == 0 {
                    (sin, cos)
                } else {
                    (cos, sin)
                };
                let signed =
                    |x, count: u32| Self::splat(f32::from_bits(bits(x) ^ ((count & 2) << 30)));
                (signed(a, count), signed(b, count.wrapping_add(1)))
            }
        }
    };
}

single_lane!(f32, x => x, x => x);
single_lane!(Fused, x => Fused(x), x => x.0);

/// Where a kernel is: only [`run`] makes one, for as many numbers from there on as a register
/// holds and all columns have.
#[derive(Clone, Copy)]
pub(crate) struct At(usize);

/// Numbers to read, at least as many as the loop runs over.
#[derive(Clone, Copy)]
pub(crate) struct Column<'a>(&'a [f32]);

impl<'a> Column<'a> {
    /// The first `n`.
    #[inline(always)]
    pub fn new(values: &'a [f32], n: usize) -> Self {
        Column(&values[..n])
    }

    #[inline(always)]
    pub fn at<S: Lanes>(self, At(i): At) -> S {
        debug_assert!(i + S::COUNT <= self.0.len());
        // SAFETY: `run` goes no further than the `n` that all columns were cut to.
        unsafe { S::load(self.0.as_ptr().add(i)) }
    }
}

const _: () = assert!(size_of::<Vec3>() == 12);

/// Vectors to read, likewise.
#[derive(Clone, Copy)]
pub(crate) struct Triples<'a>(&'a [Vec3]);

impl<'a> Triples<'a> {
    /// The first `n`.
    #[inline(always)]
    pub fn new(values: &'a [Vec3], n: usize) -> Self {
        Triples(&values[..n])
    }

    #[inline(always)]
    pub fn at<S: Lanes>(self, At(i): At) -> [S; 3] {
        debug_assert!(i + S::COUNT <= self.0.len());
        // SAFETY: as above; a `Vec3` is its three components, one after the other.
        unsafe { S::load_three(self.0.as_ptr().add(i).cast()) }
    }
}

/// Numbers to write, likewise.
pub(crate) struct Out<'a> {
    start: *mut f32,
    len: usize,
    slice: PhantomData<&'a mut [f32]>,
}

impl<'a> Out<'a> {
    /// The first `n`.
    #[inline(always)]
    pub fn new(values: &'a mut [f32], n: usize) -> Self {
        let values = &mut values[..n];
        Out {
            start: values.as_mut_ptr(),
            len: values.len(),
            slice: PhantomData,
        }
    }

    /// What was put there.
    #[inline(always)]
    pub fn get<S: Lanes>(&self, At(i): At) -> S {
        debug_assert!(i + S::COUNT <= self.len);
        // SAFETY: as above.
        unsafe { S::load(self.start.add(i)) }
    }

    #[inline(always)]
    pub fn put<S: Lanes>(&self, At(i): At, value: S) {
        debug_assert!(i + S::COUNT <= self.len);
        // SAFETY: as above; the slice is borrowed for as long as this lives.
        unsafe { value.store(self.start.add(i)) }
    }
}

/// What is done with each register full of numbers, in stages that leave up to `N` numbers a lane
/// to the next.
///
/// In a stage nothing should wait for long: roots and quotients are best stages of their own, of
/// what the stage before has made ready.
pub(crate) trait Kernel<S: Lanes, const N: usize> {
    /// How many stages there are, at most [`MOST`].
    const STAGES: usize;

    /// One of them, the first is 0. It gets what the one before left of the same numbers.
    fn stage<const STAGE: usize>(&self, at: At, left: [S; N]) -> [S; N];
}

/// What a stage leaves, where others leave more.
#[inline(always)]
pub(crate) fn leave<S: Lanes, const M: usize, const N: usize>(numbers: [S; M]) -> [S; N] {
    const { assert!(M <= N) };
    let mut left = [S::splat(0.0); N];
    left[..M].copy_from_slice(&numbers);
    left
}

/// Most stages of a kernel.
const MOST: usize = 10;

/// Does something with the number of each stage but the first, last to first.
macro_rules! for_later_stages {
    ($do:ident) => {
        $do!(9);
        $do!(8);
        $do!(7);
        $do!(6);
        $do!(5);
        $do!(4);
        $do!(3);
        $do!(2);
        $do!(1);
    };
}

/// Runs a kernel over `n` numbers, in registers `V`, or one by one as `T` where they fill none.
#[inline(always)]
pub(crate) fn run<V: Lanes, T: Lanes, const N: usize>(
    n: usize,
    kernel: &(impl Kernel<V, N> + Kernel<T, N>),
) {
    if V::COUNT > 1 && n >= V::COUNT {
        return run_registers::<V, N, _>(n, kernel);
    }
    for i in 0..n {
        run_one::<T, N, _>(At(i), kernel);
    }
}

#[repr(align(64))]
struct CacheLine(#[allow(dead_code)] [u8; 64]);

#[inline(always)]
fn run_one<S: Lanes, const N: usize, K: Kernel<S, N>>(at: At, kernel: &K) {
    let mut left = kernel.stage::<0>(at, leave([]));
    macro_rules! stage {
        ($i:literal) => {
            // Upwards.
            if K::STAGES > MOST - $i {
                left = kernel.stage::<{ MOST - $i }>(at, left);
            }
        };
    }
    for_later_stages!(stage);
    let _ = left;
}

/// The same for a register at least: beside the last stage of one register the one before of the
/// next, and so on. What is left over is done together with the numbers before it, once more.
#[inline(always)]
fn run_registers<V: Lanes, const N: usize, K: Kernel<V, N>>(n: usize, kernel: &K) {
    // Registers that the compiler runs out of go to the stack. They would lie across two cache
    // lines, were not something there that has to lie on one: only then the stack is aligned.
    std::hint::black_box(&mut CacheLine([0; 64]));
    let registers = n / V::COUNT;
    let mut left = [leave::<V, 0, N>([]); MOST];
    let mut step = 0;
    while step < registers + K::STAGES - 1 {
        if step + 1 == K::STAGES {
            // From here on all stages have something to do.
            while step < registers {
                macro_rules! stage {
                    ($i:literal) => {
                        if K::STAGES > $i {
                            let at = At((step - $i) * V::COUNT);
                            left[$i] = kernel.stage::<$i>(at, left[$i - 1]);
                        }
                    };
                }
                for_later_stages!(stage);
                left[0] = kernel.stage::<0>(At(step * V::COUNT), leave([]));
                step += 1;
            }
        }
        // The register that is at a stage, where there is one.
        macro_rules! stage {
            ($i:literal) => {
                if K::STAGES > $i && step >= $i && step - $i < registers {
                    let at = At((step - $i) * V::COUNT);
                    left[$i] = kernel.stage::<$i>(at, left[$i - 1]);
                }
            };
        }
        for_later_stages!(stage);
        if step < registers {
            left[0] = kernel.stage::<0>(At(step * V::COUNT), leave([]));
        }
        step += 1;
    }
    if !n.is_multiple_of(V::COUNT) {
        run_one::<V, N, _>(At(n - V::COUNT), kernel);
    }
}
