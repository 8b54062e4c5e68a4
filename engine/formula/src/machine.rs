//! A machine with one register that is a whole tile of values: it carries the tile through a
//! chain of operations without writing it down, and only what is needed again goes to memory.
//!
//! One instruction works on some dozens of values, so that looking at what it is costs little,
//! and the processor is already busy with the next ones while a quotient is under way.

use crate::eval::Real;
use crate::expr::CompareOp;
use crate::lanes::Lanes;
use brdf::batch::{Isa, Level};

/// Most vectors in a tile.
const VECTORS: usize = 16;

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
        $one!(8);
        $one!(9);
        $one!(10);
        $one!(11);
        $one!(12);
        $one!(13);
        $one!(14);
        $one!(15);
    };
}

/// What is done with the register `r`, a slot `m` or a value `c` that is the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Code {
    /// r = m
    Load,
    /// r = c
    LoadSame,
    /// m = r
    Store,
    /// r = r²
    Square,
    /// r = r³
    Cube,
    /// r = r⁵
    Fifth,
    /// r = r to the power `at`
    Power,
    Sqrt,
    Abs,
    Neg,
    Add,
    AddSame,
    Sub,
    SubSame,
    /// r = m − r
    SubFrom,
    SubFromSame,
    Mul,
    MulSame,
    Div,
    DivSame,
    /// r = m / r
    DivInto,
    DivIntoSame,
    Least,
    LeastSame,
    Most,
    MostSame,
    Compare(CompareOp),
    CompareSame(CompareOp),
    /// r = p, r = r ∘ p or r = p ∘ r, where p is an operation of a slot with another operand,
    /// which need not be written down in between. The number is that of [`pair`].
    Pair(u8),
}

/// What is done with a pair, as one number: so the machine looks once at what it is.
pub(crate) fn pair(outer: Outer, inner: Inner) -> Code {
    Code::Pair(10 * outer as u8 + inner as u8)
}

/// What is done with the register and a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outer {
    /// r = p: a chain begins with it.
    Only,
    Add,
    Sub,
    SubFrom,
    Mul,
    Div,
    DivInto,
}

/// What a pair is: of two slots, or of a slot and a value that is the same everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Inner {
    Add,
    AddSame,
    Sub,
    SubSame,
    SubFromSame,
    Mul,
    MulSame,
    Div,
    DivSame,
    DivIntoSame,
}

/// An operation, and the slots, value or exponent that it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Instr {
    pub code: Code,
    pub at: u16,
    /// The second operand of a pair.
    pub with: u16,
}

/// A precision that the machine computes in.
pub(crate) trait Machine: Real {
    /// Values in a chunk: a multiple of every tile, and a slot of two kilobytes.
    const CHUNK: usize = 2048 / size_of::<Self>();

    /// Carries `count` values, rounded up to whole tiles, through the code.
    ///
    /// # Safety
    /// Each of the code's slots is in `slots` and points to [`Machine::CHUNK`] values that
    /// nothing else uses meanwhile, those that are written to writable ones; each of its values
    /// is in `same`; `count` is at most [`Machine::CHUNK`].
    unsafe fn run(isa: Isa, code: &[Instr], slots: &[*mut Self], same: &[Self], count: usize);

    /// A core function at many points.
    fn term_block(term: &brdf::Term, isa: Isa, args: &[&[Self]], out: &mut [Self]);
}

macro_rules! machine {
    ($real:ident, $block:ident, $sse:ident, $avx2:ident, $avx512:ident) => {
        impl Machine for $real {
            unsafe fn run(
                isa: Isa,
                code: &[Instr],
                slots: &[*mut $real],
                same: &[$real],
                count: usize,
            ) {
                #[cfg(not(target_arch = "x86_64"))]
                {
                    let _ = isa;
                    // SAFETY: the caller's promises are the same.
                    unsafe { run::<crate::lanes::Plain<$real>>(code, slots, same, count) }
                }
                #[cfg(target_arch = "x86_64")]
                {
                    use std::arch::x86_64::*;

                    #[target_feature(enable = "avx2")]
                    unsafe fn avx2(c: &[Instr], m: &[*mut $real], s: &[$real], n: usize) {
                        // SAFETY: the caller's promises are the same.
                        unsafe { run::<$avx2>(c, m, s, n) }
                    }
                    #[target_feature(enable = "avx2,avx512f,avx512vl,avx512dq,avx512bw")]
                    unsafe fn avx512(c: &[Instr], m: &[*mut $real], s: &[$real], n: usize) {
                        // SAFETY: the caller's promises are the same.
                        unsafe { run::<$avx512>(c, m, s, n) }
                    }
                    // SAFETY: a level above the baseline is named only where its instructions
                    // were found; the rest is what the caller promises.
                    unsafe {
                        match isa.level() {
                            Level::Avx512 => avx512(code, slots, same, count),
                            Level::Avx2 => avx2(code, slots, same, count),
                            Level::Baseline => run::<$sse>(code, slots, same, count),
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
unsafe fn run<V: Lanes>(code: &[Instr], slots: &[*mut V::Real], same: &[V::Real], count: usize) {
    // SAFETY: as promised; a tile starts below `count`, and a chunk is a multiple of a tile.
    unsafe {
        let mut start = 0;
        while start < count {
            let mut r = [V::splat(V::Real::ZERO); VECTORS];
            /// Does the same with every vector of the register.
            macro_rules! each {
                (|$r:ident| $new:expr) => {{
                    macro_rules! one {
                        ($place:literal) => {
                            if $place < V::TILE {
                                let $r = r[$place];
                                r[$place] = $new;
                            }
                        };
                    }
                    all!(one);
                }};
                ($slot:expr, |$r:ident, $m:ident| $new:expr) => {{
                    let from = slots.get_unchecked($slot as usize).add(start);
                    macro_rules! one {
                        ($place:literal) => {
                            if $place < V::TILE {
                                let ($r, $m) = (r[$place], V::load(from.add($place * V::WIDTH)));
                                r[$place] = $new;
                            }
                        };
                    }
                    all!(one);
                }};
            }
            for instr in code {
                let at = instr.at;
                /// The same with what a slot and another one, or a value, give together.
                macro_rules! pair {
                    (|$r:ident, $p:ident = $m:ident.$op:ident($n:ident)| $new:expr) => {{
                        let from = slots.get_unchecked(at as usize).add(start);
                        let other = slots.get_unchecked(instr.with as usize).add(start);
                        macro_rules! one {
                            ($place:literal) => {
                                if $place < V::TILE {
                                    let $m = V::load(from.add($place * V::WIDTH));
                                    let $n = V::load(other.add($place * V::WIDTH));
                                    let ($r, $p) = (r[$place], $m.$op($n));
                                    r[$place] = $new;
                                }
                            };
                        }
                        all!(one);
                    }};
                }
                macro_rules! pair_same {
                    (|$r:ident, $p:ident = $x:ident.$op:ident($y:ident)| $new:expr) => {{
                        let from = slots.get_unchecked(at as usize).add(start);
                        let value = V::splat(*same.get_unchecked(instr.with as usize));
                        macro_rules! one {
                            ($place:literal) => {
                                if $place < V::TILE {
                                    let m = V::load(from.add($place * V::WIDTH));
                                    let ($r, $p) = (r[$place], pair_same!(@ $x $op $y m value));
                                    r[$place] = $new;
                                }
                            };
                        }
                        all!(one);
                    }};
                    (@ m $op:ident c $m:ident $c:ident) => { $m.$op($c) };
                    (@ c $op:ident m $m:ident $c:ident) => { $c.$op($m) };
                }
                /// The same with any pair, by its number: a row for each [`Outer`], in it one for
                /// each [`Inner`].
                macro_rules! pairs {
                    ($number:expr, $(
                        [$add:literal $add_same:literal $sub:literal $sub_same:literal
                         $sub_from_same:literal $mul:literal $mul_same:literal $div:literal
                         $div_same:literal $div_into_same:literal]
                        |$r:ident, $p:ident| $new:expr;
                    )+) => {
                        match $number {
                            $(
                                $add => pair!(|$r, $p = m.add(n)| $new),
                                $add_same => pair_same!(|$r, $p = m.add(c)| $new),
                                $sub => pair!(|$r, $p = m.sub(n)| $new),
                                $sub_same => pair_same!(|$r, $p = m.sub(c)| $new),
                                $sub_from_same => pair_same!(|$r, $p = c.sub(m)| $new),
                                $mul => pair!(|$r, $p = m.mul(n)| $new),
                                $mul_same => pair_same!(|$r, $p = m.mul(c)| $new),
                                $div => pair!(|$r, $p = m.div(n)| $new),
                                $div_same => pair_same!(|$r, $p = m.div(c)| $new),
                                $div_into_same => pair_same!(|$r, $p = c.div(m)| $new),
                            )+
                            _ => {}
                        }
                    };
                }
                if let Code::Pair(number) = instr.code {
                    pairs!(number,
                        [0 1 2 3 4 5 6 7 8 9] |_r, p| p;
                        [10 11 12 13 14 15 16 17 18 19] |r, p| r.add(p);
                        [20 21 22 23 24 25 26 27 28 29] |r, p| r.sub(p);
                        [30 31 32 33 34 35 36 37 38 39] |r, p| p.sub(r);
                        [40 41 42 43 44 45 46 47 48 49] |r, p| r.mul(p);
                        [50 51 52 53 54 55 56 57 58 59] |r, p| r.div(p);
                        [60 61 62 63 64 65 66 67 68 69] |r, p| p.div(r);
                    );
                    continue;
                }
                macro_rules! value {
                    () => {
                        V::splat(*same.get_unchecked(at as usize))
                    };
                }
                match instr.code {
                    Code::Load => each!(at, |_r, m| m),
                    Code::LoadSame => {
                        let c = value!();
                        each!(|_r| c);
                    }
                    Code::Store => {
                        let to = slots.get_unchecked(at as usize).add(start);
                        macro_rules! one {
                            ($place:literal) => {
                                if $place < V::TILE {
                                    r[$place].store(to.add($place * V::WIDTH));
                                }
                            };
                        }
                        all!(one);
                    }
                    Code::Square => each!(|r| r.mul(r)),
                    Code::Cube => each!(|r| r.mul(r.mul(r))),
                    Code::Fifth => each!(|r| {
                        let square = r.mul(r);
                        r.mul(square.mul(square))
                    }),
                    Code::Power => each!(|r| power(r, at.cast_signed().into())),
                    Code::Sqrt => each!(|r| r.sqrt()),
                    Code::Abs => each!(|r| r.abs()),
                    Code::Neg => each!(|r| r.neg()),
                    Code::Add => each!(at, |r, m| r.add(m)),
                    Code::Sub => each!(at, |r, m| r.sub(m)),
                    Code::SubFrom => each!(at, |r, m| m.sub(r)),
                    Code::Mul => each!(at, |r, m| r.mul(m)),
                    Code::Div => each!(at, |r, m| r.div(m)),
                    Code::DivInto => each!(at, |r, m| m.div(r)),
                    Code::Least => each!(at, |r, m| r.least(m)),
                    Code::Most => each!(at, |r, m| r.most(m)),
                    Code::Compare(op) => each!(at, |r, m| r.compare(op, m)),
                    Code::AddSame => {
                        let c = value!();
                        each!(|r| r.add(c));
                    }
                    Code::SubSame => {
                        let c = value!();
                        each!(|r| r.sub(c));
                    }
                    Code::SubFromSame => {
                        let c = value!();
                        each!(|r| c.sub(r));
                    }
                    Code::MulSame => {
                        let c = value!();
                        each!(|r| r.mul(c));
                    }
                    Code::DivSame => {
                        let c = value!();
                        each!(|r| r.div(c));
                    }
                    Code::DivIntoSame => {
                        let c = value!();
                        each!(|r| c.div(r));
                    }
                    Code::LeastSame => {
                        let c = value!();
                        each!(|r| r.least(c));
                    }
                    Code::MostSame => {
                        let c = value!();
                        each!(|r| r.most(c));
                    }
                    Code::CompareSame(op) => {
                        let c = value!();
                        each!(|r| r.compare(op, c));
                    }
                    // Done above.
                    Code::Pair(_) => {}
                }
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
mod tests {
    use super::*;
    use crate::lanes::Plain;

    const HARD: [f64; 12] = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        0.3,
        3e-310,
        1e-40,
        1e30,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        -7.25,
    ];

    fn codes() -> Vec<Code> {
        use Code::*;
        let mut codes = vec![
            Load,
            LoadSame,
            Square,
            Cube,
            Fifth,
            Sqrt,
            Abs,
            Neg,
            Add,
            AddSame,
            Sub,
            SubSame,
            SubFrom,
            SubFromSame,
            Mul,
            MulSame,
            Div,
            DivSame,
            DivInto,
            DivIntoSame,
            Least,
            LeastSame,
            Most,
            MostSame,
        ];
        for op in [
            CompareOp::Less,
            CompareOp::LessEqual,
            CompareOp::Greater,
            CompareOp::GreaterEqual,
            CompareOp::Equal,
            CompareOp::NotEqual,
        ] {
            codes.extend([Compare(op), CompareSame(op)]);
        }
        let outers = [
            Outer::Only,
            Outer::Add,
            Outer::Sub,
            Outer::SubFrom,
            Outer::Mul,
            Outer::Div,
            Outer::DivInto,
        ];
        let inners = [
            Inner::Add,
            Inner::AddSame,
            Inner::Sub,
            Inner::SubSame,
            Inner::SubFromSame,
            Inner::Mul,
            Inner::MulSame,
            Inner::Div,
            Inner::DivSame,
            Inner::DivIntoSame,
        ];
        for outer in outers {
            codes.extend(inners.map(|inner| pair(outer, inner)));
        }
        codes
    }

    /// Every operation gives on every set of instructions what it gives one value at a time.
    #[track_caller]
    fn check<R: Machine>() {
        let column = |step: usize| -> Vec<R> {
            let value = |i: usize| HARD[i * step / HARD.len() % HARD.len()];
            (0..R::CHUNK).map(|i| R::of(value(i))).collect()
        };
        // Every value meets every other one.
        let (mut a, mut b) = (column(HARD.len()), column(1));
        let same = [R::of(0.3), R::of(-2.5)];
        let start = Instr {
            code: Code::Load,
            at: 0,
            with: 0,
        };
        let end = Instr {
            code: Code::Store,
            at: 2,
            with: 0,
        };
        let mut tried = codes()
            .into_iter()
            .map(|code| (code, 1))
            .collect::<Vec<_>>();
        tried.extend([0_i16, 1, 6, 7, -3].map(|power| (Code::Power, power.cast_unsigned())));
        for (code, at) in tried {
            let code = [start, Instr { code, at, with: 1 }, end];
            let mut plain = vec![R::ZERO; R::CHUNK];
            let slots = [a.as_mut_ptr(), b.as_mut_ptr(), plain.as_mut_ptr()];
            // SAFETY: three chunks, two values.
            unsafe { run::<Plain<R>>(&code, &slots, &same, R::CHUNK) };
            for isa in Isa::available() {
                let mut out = vec![R::ZERO; R::CHUNK];
                let slots = [a.as_mut_ptr(), b.as_mut_ptr(), out.as_mut_ptr()];
                // SAFETY: as above.
                unsafe { R::run(isa, &code, &slots, &same, R::CHUNK) };
                for (index, (out, plain)) in out.iter().zip(&plain).enumerate() {
                    let (found, expected) = (out.to_f64(), plain.to_f64());
                    // Which zero the lesser of two is, nobody says.
                    assert!(
                        found == expected || found.is_nan() && expected.is_nan(),
                        "{:?} of {:?} and {:?} on {}: {found} instead of {expected}",
                        code[1],
                        a[index].to_f64(),
                        b[index].to_f64(),
                        isa.name(),
                    );
                }
            }
        }
    }

    #[test]
    fn every_set_of_instructions_computes_the_same() {
        check::<f64>();
        check::<f32>();
    }
}
