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

/// Most vectors in a tile: more, and sixteen registers are too few. Without optimisation each
/// value of each instruction has a place on the stack, and with fewer they fit on it.
const VECTORS: usize = if cfg!(debug_assertions) { 2 } else { 10 };

/// The same for each of them: written out, so that they stay in registers.
#[cfg(not(debug_assertions))]
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
        $one!(8);
        $one!(9);
    };
}
#[cfg(debug_assertions)]
macro_rules! all {
    ($one:ident) => {
        $one!(0);
        $one!(1);
    };
}

/// An instruction whose operands are where they are: [`Machine::tile`]`/ 2` behind the first value
/// of a slot, from where the others are near enough for a short instruction; or the value itself.
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
    /// Most values in a chunk of our own memory, a whole number of tiles.
    const CHUNK: usize = 2560 / size_of::<Self>();

    /// Values in a tile, far fewer than in a chunk.
    fn tile(isa: Isa) -> usize;

    /// Carries `count` values through the code. The last tile begins before the one before it
    /// ends, where they do not come out even: its values are computed twice.
    ///
    /// # Safety
    /// The slots that the code names point to `count` values that nothing else uses meanwhile,
    /// at least to a tile of them, and `parked` to a tile; those that are written to are
    /// writable. What the code reads from a slot it did not write, it does not write over.
    unsafe fn run(isa: Isa, code: &[Placed<Self>], parked: *mut Self, count: usize);

    /// A core function at many points.
    fn term_block(term: &brdf::Term, isa: Isa, args: &[&[Self]], out: &mut [Self]);
}

macro_rules! machine {
    ($real:ident, $block:ident, $sse:ident, $avx2:ident, $avx512:ident) => {
        impl Machine for $real {
            fn tile(isa: Isa) -> usize {
                #[cfg(not(target_arch = "x86_64"))]
                {
                    let _ = isa;
                    tile::<crate::lanes::Plain<$real>>()
                }
                #[cfg(target_arch = "x86_64")]
                {
                    use std::arch::x86_64::*;
                    match isa.level() {
                        Level::Avx512 => tile::<$avx512>(),
                        Level::Avx2 => tile::<$avx2>(),
                        Level::Baseline => tile::<$sse>(),
                    }
                }
            }

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

/// A vector of a tile whose middle is given.
#[inline(always)]
fn nth<V: Lanes>(middle: *mut V::Real, place: usize) -> *mut V::Real {
    middle
        .wrapping_add(place * V::WIDTH)
        .wrapping_sub(tile::<V>() / 2)
}

/// Vectors in a tile: of the longest ones fewer, so that few points are computed twice.
#[inline(always)]
const fn vectors<V: Lanes>() -> usize {
    if V::PARKS && VECTORS > 8 { 8 } else { VECTORS }
}

/// Values in a tile.
#[inline(always)]
fn tile<V: Lanes>() -> usize {
    vectors::<V>() * V::WIDTH
}

/// # Safety
/// As [`Machine::run`], on a machine that has the instructions of `V`.
#[inline(always)]
unsafe fn run<V: Lanes>(code: &[Placed<V::Real>], parked: *mut V::Real, count: usize) {
    // SAFETY: as promised; a tile starts at the first value, or ends at the last one or before.
    unsafe {
        let mut start = 0;
        loop {
            let mut r = [V::splat(V::Real::ZERO); VECTORS];
            // Where registers are many, what is parked is in them too.
            let mut q = [V::splat(V::Real::ZERO); VECTORS];
            for instr in code {
                /// Does the same with every vector of the register.
                macro_rules! each {
                    (|$r:ident, $i:ident| $new:expr) => {{
                        macro_rules! one {
                            ($place:literal) => {
                                if $place < vectors::<V>() {
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
                        let from = instr.at.wrapping_add(start);
                        each!(|$r, i| {
                            let $m = V::load(nth::<V>(from, i));
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
                macro_rules! park {
                    ($r:ident, $i:ident) => {
                        match V::PARKS {
                            true => q[$i] = $r,
                            false => $r.store(parked.add($i * V::WIDTH)),
                        }
                    };
                }
                /// With a pair.
                macro_rules! pair {
                    ($outer:ident, $m:ident $n:ident $pair:expr) => {{
                        let (from, other) = (instr.at.wrapping_add(start), instr.with.wrapping_add(start));
                        each!(|r, i| {
                            let $m = V::load(nth::<V>(from, i));
                            let $n = V::load(nth::<V>(other, i));
                            pair!(@ $outer r i $pair)
                        });
                    }};
                    ($outer:ident, same $m:ident $c:ident $pair:expr) => {{
                        let from = instr.at.wrapping_add(start);
                        let $c = V::splat(instr.value);
                        each!(|r, i| {
                            let $m = V::load(nth::<V>(from, i));
                            pair!(@ $outer r i $pair)
                        });
                    }};
                    (@ Only $r:ident $i:ident $pair:expr) => {{
                        let _ = $r;
                        $pair
                    }};
                    (@ Park $r:ident $i:ident $pair:expr) => {{
                        park!($r, $i);
                        $pair
                    }};
                    (@ Add $r:ident $i:ident $pair:expr) => { $r.add($pair) };
                    (@ Sub $r:ident $i:ident $pair:expr) => { $r.sub($pair) };
                    (@ SubFrom $r:ident $i:ident $pair:expr) => { $pair.sub($r) };
                    (@ Mul $r:ident $i:ident $pair:expr) => { $r.mul($pair) };
                    (@ Div $r:ident $i:ident $pair:expr) => { $r.div($pair) };
                    (@ DivInto $r:ident $i:ident $pair:expr) => { $pair.div($r) };
                }
                macro_rules! instructions {
                    ($($outer:ident: $add:ident $add_same:ident $sub:ident $sub_same:ident
                        $sub_from_same:ident $sub_from_same_fifth:ident $mul:ident $mul_same:ident
                        $square:ident $square_mul_same:ident $div:ident $div_same:ident
                        $div_into_same:ident;)+) => {
                        match instr.code {
                            Code::Load => slot!(|_r, m| m),
                            Code::LoadSame => same!(|_r, c| c),
                            Code::LoadParked => parked!(|_r, q| q),
                            Code::Store => {
                                let to = instr.at.wrapping_add(start);
                                each!(|r, i| {
                                    r.store(nth::<V>(to, i));
                                    r
                                });
                            }
                            Code::Park => each!(|r, i| {
                                park!(r, i);
                                r
                            }),
                            Code::Square => each!(|r, _i| r.mul(r)),
                            Code::Cube => each!(|r, _i| r.mul(r.mul(r))),
                            Code::Fifth => each!(|r, _i| fifth(r)),
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
                                Code::$sub_from_same_fifth => {
                                    pair!($outer, same m c fifth(c.sub(m)));
                                }
                                Code::$mul => pair!($outer, m n m.mul(n)),
                                Code::$mul_same => pair!($outer, same m c m.mul(c)),
                                Code::$square => {
                                    let from = instr.at.wrapping_add(start);
                                    each!(|r, i| {
                                        let m = V::load(nth::<V>(from, i));
                                        pair!(@ $outer r i m.mul(m))
                                    });
                                }
                                Code::$square_mul_same => {
                                    pair!($outer, same m c c.mul(m.mul(m)));
                                }
                                Code::$div => pair!($outer, m n m.div(n)),
                                Code::$div_same => pair!($outer, same m c m.div(c)),
                                Code::$div_into_same => pair!($outer, same m c c.div(m)),
                            )+
                        }
                    };
                }
                pairs!(instructions);
            }
            if start + tile::<V>() >= count {
                break;
            }
            start = (start + tile::<V>()).min(count - tile::<V>());
        }
    }
}

/// r⁵, with the products of [`Real::power`].
///
/// # Safety
/// As the methods of [`Lanes`].
#[inline(always)]
unsafe fn fifth<V: Lanes>(r: V) -> V {
    // SAFETY: the caller's promises are the same.
    unsafe {
        let square = r.mul(r);
        r.mul(square.mul(square))
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
