//! Every instruction, against the same one value at a time.

use super::*;
use crate::code::{Inner, Outer, pair};
use crate::expr::CompareOp;
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
        LoadParked,
        Square,
        Cube,
        Fifth,
        Sqrt,
        Abs,
        Neg,
        Add,
        AddSame,
        AddParked,
        Sub,
        SubSame,
        SubParked,
        SubFrom,
        SubFromSame,
        SubFromParked,
        Mul,
        MulSame,
        MulParked,
        Div,
        DivSame,
        DivParked,
        DivInto,
        DivIntoSame,
        DivIntoParked,
        Least,
        LeastSame,
        LeastParked,
        Most,
        MostSame,
        MostParked,
    ];
    for op in [
        CompareOp::Less,
        CompareOp::LessEqual,
        CompareOp::Greater,
        CompareOp::GreaterEqual,
        CompareOp::Equal,
        CompareOp::NotEqual,
    ] {
        codes.extend([Compare(op), CompareSame(op), CompareParked(op)]);
    }
    let outers = [
        Outer::Only,
        Outer::Park,
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
        Inner::SubFromSameFifth,
        Inner::Mul,
        Inner::MulSame,
        Inner::Square,
        Inner::SquareMulSame,
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
    let (mut first, mut second, mut third) = (column(HARD.len()), column(1), column(5));
    let mut tried: Vec<(Code, i32)> = codes().into_iter().map(|code| (code, 1)).collect();
    tried.extend([0, 1, 6, 7, -3].map(|power| (Code::Power, power)));
    for (tried, power) in tried {
        let mut evaluate = |isa: Option<Isa>| -> Vec<R> {
            let (mut out, mut parked) = (vec![R::ZERO; R::CHUNK], vec![R::ZERO; R::CHUNK]);
            let middle = isa.map_or_else(tile::<Plain<R>>, R::tile) / 2;
            let mut place = |code, column: &mut [R]| Placed {
                code,
                power,
                value: R::of(-2.5),
                at: column.as_mut_ptr().wrapping_add(middle),
                with: third.as_mut_ptr().wrapping_add(middle),
            };
            let code = [
                place(Code::Load, &mut second),
                place(Code::Park, &mut second),
                place(Code::Load, &mut first),
                // What is in the register meets the second column, or its pair with the third.
                place(tried, &mut second),
                place(Code::Store, &mut out),
            ];
            // SAFETY: every pointer is to a chunk of its own.
            unsafe {
                match isa {
                    Some(isa) => R::run(isa, &code, parked.as_mut_ptr(), R::CHUNK),
                    None => run::<Plain<R>>(&code, parked.as_mut_ptr(), R::CHUNK),
                }
            }
            out
        };
        let plain = evaluate(None);
        for isa in Isa::available() {
            for (index, (out, plain)) in evaluate(Some(isa)).iter().zip(&plain).enumerate() {
                let (found, expected) = (out.to_f64(), plain.to_f64());
                // Which zero the lesser of two is, nobody says.
                assert!(
                    found == expected || found.is_nan() && expected.is_nan(),
                    "{tried:?} of {} and {} on {}: {found} instead of {expected}",
                    HARD[index % HARD.len()],
                    HARD[index / HARD.len() % HARD.len()],
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
