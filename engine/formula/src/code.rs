//! What the [machine](crate::machine) can be told to do.

use crate::dag::Id;
use crate::expr::CompareOp;

/// Hands all pairs to another macro: a row for each [`Outer`], in it one for each [`Inner`].
macro_rules! pairs {
    ($to:ident) => {
        $to! {
            Only:
                OnlyAdd OnlyAddSame OnlySub OnlySubSame OnlySubFromSame
                OnlySubFromSameFifth OnlyMul OnlyMulSame OnlySquare
                OnlySquareMulSame OnlyDiv OnlyDivSame OnlyDivIntoSame;
            Park:
                ParkAdd ParkAddSame ParkSub ParkSubSame ParkSubFromSame
                ParkSubFromSameFifth ParkMul ParkMulSame ParkSquare
                ParkSquareMulSame ParkDiv ParkDivSame ParkDivIntoSame;
            Add:
                AddAdd AddAddSame AddSub AddSubSame AddSubFromSame
                AddSubFromSameFifth AddMul AddMulSame AddSquare AddSquareMulSame
                AddDiv AddDivSame AddDivIntoSame;
            Sub:
                SubAdd SubAddSame SubSub SubSubSame SubSubFromSame
                SubSubFromSameFifth SubMul SubMulSame SubSquare SubSquareMulSame
                SubDiv SubDivSame SubDivIntoSame;
            SubFrom:
                SubFromAdd SubFromAddSame SubFromSub SubFromSubSame
                SubFromSubFromSame SubFromSubFromSameFifth SubFromMul
                SubFromMulSame SubFromSquare SubFromSquareMulSame SubFromDiv
                SubFromDivSame SubFromDivIntoSame;
            Mul:
                MulAdd MulAddSame MulSub MulSubSame MulSubFromSame
                MulSubFromSameFifth MulMul MulMulSame MulSquare MulSquareMulSame
                MulDiv MulDivSame MulDivIntoSame;
            Div:
                DivAdd DivAddSame DivSub DivSubSame DivSubFromSame
                DivSubFromSameFifth DivMul DivMulSame DivSquare DivSquareMulSame
                DivDiv DivDivSame DivDivIntoSame;
            DivInto:
                DivIntoAdd DivIntoAddSame DivIntoSub DivIntoSubSame
                DivIntoSubFromSame DivIntoSubFromSameFifth DivIntoMul
                DivIntoMulSame DivIntoSquare DivIntoSquareMulSame DivIntoDiv
                DivIntoDivSame DivIntoDivIntoSame;
        }
    };
}
pub(crate) use pairs;

/// What is done with a pair, which is what an operation of a slot with another operand gives,
/// and the register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outer {
    /// r = p: a chain begins with it.
    Only,
    /// q = r, r = p: the next chain begins.
    Park,
    Add,
    Sub,
    /// r = p − r
    SubFrom,
    Mul,
    Div,
    /// r = p / r
    DivInto,
}

/// What a pair is: of two slots, of a slot and a value that is the same everywhere, or of one
/// slot with itself; and the two of one slot and a value that lobes are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Inner {
    Add,
    AddSame,
    Sub,
    SubSame,
    SubFromSame,
    /// (c − m)⁵, as in Schlick's approximation
    SubFromSameFifth,
    Mul,
    MulSame,
    Square,
    /// c m², as in α² x²
    SquareMulSame,
    Div,
    DivSame,
    DivIntoSame,
}

macro_rules! define {
    ($($outer:ident: $($pair:ident)+;)+) => {
        /// What is done with the register `r`, and with a slot `m`, a value `c` that is the same
        /// everywhere, or the value `q` that was parked.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) enum Code {
            /// r = m
            Load,
            /// r = c
            LoadSame,
            /// r = q
            LoadParked,
            /// m = r
            Store,
            /// q = r
            Park,
            /// r = r²
            Square,
            /// r = r³
            Cube,
            /// r = r⁵
            Fifth,
            /// r = r to the power of [`Instr::power`]
            Power,
            Sqrt,
            Abs,
            Neg,
            Add,
            AddSame,
            AddParked,
            Sub,
            SubSame,
            SubParked,
            /// r = m − r
            SubFrom,
            SubFromSame,
            SubFromParked,
            Mul,
            MulSame,
            MulParked,
            Div,
            DivSame,
            DivParked,
            /// r = m / r
            DivInto,
            DivIntoSame,
            DivIntoParked,
            Least,
            LeastSame,
            LeastParked,
            Most,
            MostSame,
            MostParked,
            Compare(CompareOp),
            CompareSame(CompareOp),
            CompareParked(CompareOp),
            $($($pair,)+)+
        }

        /// All pairs, by [`Outer`] and [`Inner`].
        #[rustfmt::skip]
        const PAIRS: [[Code; 13]; 8] = [$([$(Code::$pair),+]),+];
    };
}
pairs!(define);

/// What the machine does with the register and a pair in one instruction.
pub(crate) fn pair(outer: Outer, inner: Inner) -> Code {
    PAIRS[outer as usize][inner as usize]
}

/// What an instruction works on besides the register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Operand {
    None,
    Slot(usize),
    /// A value that is the same everywhere.
    Same(Id),
}

/// One instruction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Instr {
    pub code: Code,
    pub at: Operand,
    /// The second operand of a pair.
    pub with: Operand,
    pub power: i32,
}

impl Instr {
    /// An instruction that needs nothing but the register.
    pub fn new(code: Code) -> Instr {
        Instr {
            code,
            at: Operand::None,
            with: Operand::None,
            power: 1,
        }
    }

    pub fn at(self, at: Operand) -> Instr {
        Instr { at, ..self }
    }
}
