//! A machine with one register that is a whole tile of values: it carries the tile through a
//! chain of operations without writing it down. One more tile can be parked beside it, and only
//! what is needed again later goes to memory.
//!
//! One instruction works on some dozens of values, so that looking at what it is costs little,
//! and the processor is already busy with the next ones while a quotient is under way.

use crate::code::{Code, pairs};
use crate::eval::Real;
use crate::lanes::Lanes;
use brdf::batch::{Isa, Level};

/// Most vectors in a tile.
const VECTORS: usize = 8;

/// The same for each of them: written out, so that they stay in registers.
macro_rules! all {
    ($one:ident) => {
        $one!(0);
        $one!(1);
        $one!(2);
        $one!(3);
        $one!(4);
        $one!(5);
        $one!(6);
        $one!(7);
    };
}

/// An instruction whose operands are where they are: at the first value of a slot, or the value
/// itself.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed<R> {
    pub code: Code,
    pub power: i32,
    pub value: R,
    pub at: *mut R,
    pub with: *mut R,
}

/// A precision that the machine computes in.
pub(crate) trait Machine: Real {
    /// Values in a chunk: a multiple of every tile, and a slot of two kilobytes.
    const CHUNK: usize = 2048 / size_of::<Self>();

    /// Carries `count` values, rounded up to whole tiles, through the code.
    ///
    /// # Safety
    /// The slots that the code names, and the one for what is parked, point to
    /// [`Machine::CHUNK`] values that nothing else uses meanwhile, those that are written to
    /// writable ones; `count` is at most [`Machine::CHUNK`].
    unsafe fn run(isa: Isa, code: &[Placed<Self>], parked: *mut Self, count: usize);

    /// A core function at many points.
    fn term_block(term: &brdf::Term, isa: Isa, args: &[&[Self]], out: &mut [Self]);
}

macro_rules! machine {
    ($real:ident, $block:ident, $sse:ident, $avx2:ident, $avx512:ident) => {
        impl Machine for $real {
            unsafe fn run(isa: Isa, code: &[Placed<$real>], parked: *mut $real, count: usize) {
                #[cfg(not(target_arch = "x86_64"))]
                {
                    let _ = isa;
                    // SAFETY: the caller's promises are the same.
                    unsafe { run::<crate::lanes::Plain<$real>>(code, parked, count) }
                }
                #[cfg(target_arch = "x86_64")]
                {
                    use std::arch::x86_64::*;

                    #[target_feature(enable = "avx2")]
                    unsafe fn avx2(code: &[Placed<$real>], parked: *mut $real, count: usize) {
                        // SAFETY: the caller's promises are the same.
                        unsafe { run::<$avx2>(code, parked, count) }
                    }
                    #[target_feature(enable = "avx2,avx512f,avx512vl,avx512dq,avx512bw")]
                    unsafe fn avx512(code: &[Placed<$real>], parked: *mut $real, count: usize) {
                        // SAFETY: the caller's promises are the same.
                        unsafe { run::<$avx512>(code, parked, count) }
                    }
                    // SAFETY: a level above the baseline is named only where its instructions
                    // were found; the rest is what the caller promises.
                    unsafe {
                        match isa.level() {
                            Level::Avx512 => avx512(code, parked, count),
                            Level::Avx2 => avx2(code, parked, count),
                            Level::Baseline => run::<$sse>(code, parked, count),
                        }
                    }
                }
            }

            fn term_block(term: &brdf::Term, isa: Isa, args: &[&[$real]], out: &mut [$real]) {
                (term.$block)(isa, args, out);
            }
        }
    };
}
machine!(f32, f32_block, __m128, __m256, __m512);
machine!(f64, f64_block, __m128d, __m256d, __m512d);

/// # Safety
/// As [`Machine::run`], on a machine that has the instructions of `V`.
#[inline(always)]
unsafe fn run<V: Lanes>(code: &[Placed<V::Real>], parked: *mut V::Real, count: usize) {
    // SAFETY: as promised; a tile starts below `count`, and a chunk is a multiple of a tile.
    unsafe {
        let mut start = 0;
        while start < count {
            let mut r = [V::splat(V::Real::ZERO); VECTORS];
            // Where registers are many, what is parked is in them too.
            let mut q = [V::splat(V::Real::ZERO); VECTORS];
            for instr in code {
                /// Does the same with every vector of the register.
                macro_rules! each {
                    (|$r:ident, $i:ident| $new:expr) => {{
                        macro_rules! one {
                            ($place:literal) => {
                                if $place < V::TILE {
                                    let ($r, $i) = (r[$place], $place);
                                    r[$place] = $new;
                                }
                            };
                        }
                        all!(one);
                    }};
                }
                /// With those of a slot.
                macro_rules! slot {
                    (|$r:ident, $m:ident| $new:expr) => {{
                        let from = instr.at.add(start);
                        each!(|$r, i| {
                            let $m = V::load(from.add(i * V::WIDTH));
                            $new
                        });
                    }};
                }
                /// With a value that is the same everywhere.
                macro_rules! same {
                    (|$r:ident, $c:ident| $new:expr) => {{
                        let $c = V::splat(instr.value);
                        each!(|$r, _i| $new);
                    }};
                }
                /// With those that were parked.
                macro_rules! parked {
                    (|$r:ident, $q:ident| $new:expr) => {
                        each!(|$r, i| {
                            let $q = match V::PARKS {
                                true => q[i],
                                false => V::load(parked.add(i * V::WIDTH)),
                            };
                            $new
                        })
                    };
                }
                /// With a pair.
                macro_rules! pair {
                    ($outer:ident, $m:ident $n:ident $pair:expr) => {{
                        let (from, other) = (instr.at.add(start), instr.with.add(start));
                        each!(|r, i| {
                            let $m = V::load(from.add(i * V::WIDTH));
                            let $n = V::load(other.add(i * V::WIDTH));
                            pair!(@ $outer r $pair)
                        });
                    }};
                    ($outer:ident, same $m:ident $c:ident $pair:expr) => {{
                        let from = instr.at.add(start);
                        let $c = V::splat(instr.value);
                        each!(|r, i| {
                            let $m = V::load(from.add(i * V::WIDTH));
                            pair!(@ $outer r $pair)
                        });
                    }};
                    (@ Only $r:ident $pair:expr) => {{
                        let _ = $r;
                        $pair
                    }};
                    (@ Add $r:ident $pair:expr) => { $r.add($pair) };
                    (@ Sub $r:ident $pair:expr) => { $r.sub($pair) };
                    (@ SubFrom $r:ident $pair:expr) => { $pair.sub($r) };
                    (@ Mul $r:ident $pair:expr) => { $r.mul($pair) };
                    (@ Div $r:ident $pair:expr) => { $r.div($pair) };
                    (@ DivInto $r:ident $pair:expr) => { $pair.div($r) };
                }
                macro_rules! instructions {
                    ($($outer:ident: $add:ident $add_same:ident $sub:ident $sub_same:ident
                        $sub_from_same:ident $mul:ident $mul_same:ident $square:ident $div:ident
                        $div_same:ident $div_into_same:ident;)+) => {
                        match instr.code {
                            Code::Load => slot!(|_r, m| m),
                            Code::LoadSame => same!(|_r, c| c),
                            Code::LoadParked => parked!(|_r, q| q),
                            Code::Store => {
                                let to = instr.at.add(start);
                                each!(|r, i| {
                                    r.store(to.add(i * V::WIDTH));
                                    r
                                });
                            }
                            Code::Park => each!(|r, i| {
                                match V::PARKS {
                                    true => q[i] = r,
                                    false => r.store(parked.add(i * V::WIDTH)),
                                }
                                r
                            }),
                            Code::Square => each!(|r, _i| r.mul(r)),
                            Code::Cube => each!(|r, _i| r.mul(r.mul(r))),
                            Code::Fifth => each!(|r, _i| {
                                let square = r.mul(r);
                                r.mul(square.mul(square))
                            }),
                            Code::Power => each!(|r, _i| power(r, instr.power)),
                            Code::Sqrt => each!(|r, _i| r.sqrt()),
                            Code::Abs => each!(|r, _i| r.abs()),
                            Code::Neg => each!(|r, _i| r.neg()),
                            Code::Add => slot!(|r, m| r.add(m)),
                            Code::AddSame => same!(|r, m| r.add(m)),
                            Code::AddParked => parked!(|r, m| r.add(m)),
                            Code::Sub => slot!(|r, m| r.sub(m)),
                            Code::SubSame => same!(|r, m| r.sub(m)),
                            Code::SubParked => parked!(|r, m| r.sub(m)),
                            Code::SubFrom => slot!(|r, m| m.sub(r)),
                            Code::SubFromSame => same!(|r, m| m.sub(r)),
                            Code::SubFromParked => parked!(|r, m| m.sub(r)),
                            Code::Mul => slot!(|r, m| r.mul(m)),
                            Code::MulSame => same!(|r, m| r.mul(m)),
                            Code::MulParked => parked!(|r, m| r.mul(m)),
                            Code::Div => slot!(|r, m| r.div(m)),
                            Code::DivSame => same!(|r, m| r.div(m)),
                            Code::DivParked => parked!(|r, m| r.div(m)),
                            Code::DivInto => slot!(|r, m| m.div(r)),
                            Code::DivIntoSame => same!(|r, m| m.div(r)),
                            Code::DivIntoParked => parked!(|r, m| m.div(r)),
                            Code::Least => slot!(|r, m| r.least(m)),
                            Code::LeastSame => same!(|r, m| r.least(m)),
                            Code::LeastParked => parked!(|r, m| r.least(m)),
                            Code::Most => slot!(|r, m| r.most(m)),
                            Code::MostSame => same!(|r, m| r.most(m)),
                            Code::MostParked => parked!(|r, m| r.most(m)),
                            Code::Compare(op) => slot!(|r, m| r.compare(op, m)),
                            Code::CompareSame(op) => same!(|r, m| r.compare(op, m)),
                            Code::CompareParked(op) => parked!(|r, m| r.compare(op, m)),
                            $(
                                Code::$add => pair!($outer, m n m.add(n)),
                                Code::$add_same => pair!($outer, same m c m.add(c)),
                                Code::$sub => pair!($outer, m n m.sub(n)),
                                Code::$sub_same => pair!($outer, same m c m.sub(c)),
                                Code::$sub_from_same => pair!($outer, same m c c.sub(m)),
                                Code::$mul => pair!($outer, m n m.mul(n)),
                                Code::$mul_same => pair!($outer, same m c m.mul(c)),
                                Code::$square => slot!(|r, m| pair!(@ $outer r m.mul(m))),
                                Code::$div => pair!($outer, m n m.div(n)),
                                Code::$div_same => pair!($outer, same m c m.div(c)),
                                Code::$div_into_same => pair!($outer, same m c c.div(m)),
                            )+
                        }
                    };
                }
                pairs!(instructions);
            }
            start += V::TILE * V::WIDTH;
        }
    }
}

/// As [`Real::power`]: the same products in the same order.
///
/// # Safety
/// As the methods of [`Lanes`].
#[inline(always)]
unsafe fn power<V: Lanes>(base: V, exponent: i32) -> V {
    // SAFETY: the caller's promises are the same.
    unsafe {
        let one = V::splat(V::Real::ONE);
        let (mut result, mut square) = (one, base);
        let mut left = exponent.unsigned_abs();
        let mut first = true;
        while left > 0 {
            if left & 1 == 1 {
                result = if first { square } else { result.mul(square) };
                first = false;
            }
            left >>= 1;
            if left > 0 {
                square = square.mul(square);
            }
        }
        if exponent < 0 {
            one.div(result)
        } else {
            result
        }
    }
}

#[cfg(test)]
mod tests;
