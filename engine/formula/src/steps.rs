//! From operations to steps over a chunk of points: runs of the machine's code, and what needs
//! a function called between them.

use crate::builtin::Builtin;
use crate::dag::{Id, Op, TermRef};
use crate::expr::CompareOp;
use crate::machine::{Code, Inner, Instr, Outer, pair};

/// Where a chunk of values lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    /// An input that varies.
    Input(usize),
    /// Where a result goes; it can be read again.
    Result(usize),
    /// Memory of the evaluation.
    Temporary,
    /// A value that is the same at all points, written out for a function that wants columns.
    Same(Id),
}

/// What is done to a whole chunk before the next step; numbers are those of slots.
#[derive(Clone, Debug)]
pub(crate) enum Step {
    Run(Vec<Instr>),
    Unary(Builtin, usize, usize),
    Pow(usize, usize, usize),
    Term(TermRef, Vec<usize>, usize),
}

/// How a result comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The same at all points.
    Same(Id),
    /// It is in this slot: its own, or that of an input or of an equal result.
    Held(usize),
}

/// The evaluation of a program whose inputs are known to vary or not.
#[derive(Clone, Debug)]
pub(crate) struct Steps {
    pub steps: Vec<Step>,
    pub slots: Vec<Slot>,
    pub results: Vec<Outcome>,
    /// Operations that are the same at all points, operands first.
    pub same: Vec<Id>,
}

/// The function with its operands swapped.
fn swapped(op: CompareOp) -> CompareOp {
    match op {
        CompareOp::Less => CompareOp::Greater,
        CompareOp::LessEqual => CompareOp::GreaterEqual,
        CompareOp::Greater => CompareOp::Less,
        CompareOp::GreaterEqual => CompareOp::LessEqual,
        same => same,
    }
}

/// What the machine does with its register on the left of an operation and on the right, with a
/// slot and with a value that is the same everywhere.
fn binary(op: &Op) -> Option<(Id, Id, [Code; 4])> {
    use Code::*;
    Some(match *op {
        Op::Add(a, b) => (a, b, [Add, AddSame, Add, AddSame]),
        Op::Sub(a, b) => (a, b, [Sub, SubSame, SubFrom, SubFromSame]),
        Op::Mul(a, b) => (a, b, [Mul, MulSame, Mul, MulSame]),
        Op::Div(a, b) => (a, b, [Div, DivSame, DivInto, DivIntoSame]),
        Op::Min(a, b) => (a, b, [Least, LeastSame, Least, LeastSame]),
        Op::Max(a, b) => (a, b, [Most, MostSame, Most, MostSame]),
        Op::Compare(op, a, b) => {
            let turned = swapped(op);
            let codes = [
                Compare(op),
                CompareSame(op),
                Compare(turned),
                CompareSame(turned),
            ];
            (a, b, codes)
        }
        _ => return None,
    })
}

/// What the machine does with its register alone.
fn unary(op: &Op) -> Option<(Id, Vec<Instr>)> {
    let plain = |code| Instr {
        code,
        at: 0,
        with: 0,
    };
    Some(match *op {
        Op::Neg(a) => (a, vec![plain(Code::Neg)]),
        Op::Unary(Builtin::Sqrt, a) => (a, vec![plain(Code::Sqrt)]),
        Op::Unary(Builtin::Abs, a) => (a, vec![plain(Code::Abs)]),
        Op::PowInt(a, 2) => (a, vec![plain(Code::Square)]),
        Op::PowInt(a, 3) => (a, vec![plain(Code::Cube)]),
        Op::PowInt(a, 4) => (a, vec![plain(Code::Square); 2]),
        Op::PowInt(a, 5) => (a, vec![plain(Code::Fifth)]),
        Op::PowInt(a, power) => {
            // A whole exponent is small: the language says so.
            let at = (power as i16).cast_unsigned();
            (
                a,
                vec![Instr {
                    at,
                    ..plain(Code::Power)
                }],
            )
        }
        // One value used twice needs no second reading.
        Op::Mul(a, b) if a == b => (a, vec![plain(Code::Square)]),
        _ => return None,
    })
}

/// What the machine does with its register and a pair, the pair on the right or on the left.
fn outer(op: &Op) -> Option<(Id, Id, [Outer; 2])> {
    Some(match *op {
        Op::Add(a, b) => (a, b, [Outer::Add, Outer::Add]),
        Op::Sub(a, b) => (a, b, [Outer::Sub, Outer::SubFrom]),
        Op::Mul(a, b) => (a, b, [Outer::Mul, Outer::Mul]),
        Op::Div(a, b) => (a, b, [Outer::Div, Outer::DivInto]),
        _ => return None,
    })
}

/// An operation as a pair: of two slots, of a slot and a value, of a value and a slot.
fn inner(op: &Op) -> Option<(Id, Id, [Inner; 3])> {
    use Inner::*;
    Some(match *op {
        Op::Add(a, b) => (a, b, [Add, AddSame, AddSame]),
        Op::Sub(a, b) => (a, b, [Sub, SubSame, SubFromSame]),
        Op::Mul(a, b) => (a, b, [Mul, MulSame, MulSame]),
        Op::Div(a, b) => (a, b, [Div, DivSame, DivIntoSame]),
        Op::PowInt(a, 2) => (a, a, [Mul; 3]),
        _ => return None,
    })
}

struct Planner<'a> {
    ops: &'a [Op],
    /// Whether an operation is the same at all points.
    same: Vec<bool>,
    /// How often an operation's value is read, and by which operation last.
    reads: Vec<u32>,
    last_read: Vec<Id>,
    /// The pair that an operation computes on its way, and whether an operation is such a pair.
    pair: Vec<Option<Id>>,
    absorbed: Vec<bool>,
    /// The slot that holds an operation's value.
    held: Vec<Option<usize>>,
    slots: Vec<Slot>,
    free: Vec<usize>,
    steps: Vec<Step>,
    run: Vec<Instr>,
    /// The operation whose value the machine's register holds.
    register: Option<Id>,
}

impl Steps {
    /// Plans the evaluation of `roots`, with `varying` telling which inputs differ from point
    /// to point.
    pub fn new(ops: &[Op], roots: &[Id], varying: &[bool]) -> Steps {
        let mut same = Vec::with_capacity(ops.len());
        for op in ops {
            same.push(match op {
                Op::Input(index) => !varying.get(*index).copied().unwrap_or(false),
                _ => op.operands().iter().all(|id| same[*id]),
            });
        }
        let mut planner = Planner {
            ops,
            reads: vec![0; ops.len()],
            last_read: vec![0; ops.len()],
            pair: vec![None; ops.len()],
            absorbed: vec![false; ops.len()],
            held: vec![None; ops.len()],
            slots: Vec::new(),
            free: Vec::new(),
            steps: Vec::new(),
            run: Vec::new(),
            register: None,
            same,
        };
        planner.count_reads(roots);
        planner.find_pairs();
        let mut results = Vec::new();
        for (index, root) in roots.iter().enumerate() {
            results.push(match (planner.same[*root], &ops[*root]) {
                (true, _) => Outcome::Same(*root),
                (false, Op::Input(_)) => Outcome::Held(planner.slot(*root)),
                (false, _) => Outcome::Held(planner.result(*root, index)),
            });
        }
        let order: Vec<Id> = (0..ops.len())
            .filter(|id| !planner.same[*id] && !planner.absorbed[*id])
            .filter(|id| !matches!(ops[*id], Op::Input(_)))
            .collect();
        for (place, id) in order.iter().enumerate() {
            planner.operation(*id, order.get(place + 1).copied());
        }
        planner.end_run();
        Steps {
            steps: planner.steps,
            slots: planner.slots,
            results,
            same: (0..ops.len()).filter(|id| planner.same[*id]).collect(),
        }
    }
}

impl Steps {
    /// Whether those of a function's arguments that are of the material are the same everywhere.
    pub fn of_material(&self, term: &brdf::Term, args: &[usize]) -> bool {
        let mut args = args.iter().zip(term.params);
        args.all(|(slot, param)| {
            !param.is_of_material() || matches!(self.slots[*slot], Slot::Same(_))
        })
    }
}

impl Planner<'_> {
    fn count_reads(&mut self, roots: &[Id]) {
        for (id, op) in self.ops.iter().enumerate() {
            if !self.same[id] {
                let mut operands = op.operands();
                // One value used twice by one operation is read once.
                operands.dedup();
                operands
                    .iter()
                    .for_each(|operand| self.reads[*operand] += 1);
            }
        }
        // A result is not passed on unseen.
        roots.iter().for_each(|root| self.reads[*root] += 2);
    }

    /// Whether an operation's value lies in memory or is the same everywhere.
    fn leaf(&self, id: Id) -> bool {
        self.same[id] || self.reads[id] > 1 || matches!(self.ops[id], Op::Input(_))
    }

    /// Finds operations on values in memory that are read once, by arithmetic: they are done
    /// together with it. Then notes which operation reads each value last.
    fn find_pairs(&mut self) {
        for (id, op) in self
            .ops
            .iter()
            .enumerate()
            .filter(|(id, _)| !self.same[*id])
        {
            let Some((a, b, _)) = outer(op) else {
                continue;
            };
            let pair = [b, a].into_iter().find(|pair| {
                let operands = inner(&self.ops[*pair]);
                let leaves = operands.is_some_and(|(a, b, _)| self.leaf(a) && self.leaf(b));
                // What has a pair itself is more than one.
                let simple = self.pair[*pair].is_none();
                a != b && leaves && simple && !self.leaf(*pair)
            });
            if let Some(pair) = pair {
                self.pair[id] = Some(pair);
                self.absorbed[pair] = true;
            }
        }
        for id in (0..self.ops.len()).filter(|id| !self.same[*id] && !self.absorbed[*id]) {
            for operand in self.operands(id) {
                self.last_read[operand] = id;
            }
        }
    }

    /// What an operation reads, through the pair that it computes on its way.
    fn operands(&self, id: Id) -> Vec<Id> {
        let mut operands = self.ops[id].operands();
        if let Some(pair) = self.pair[id] {
            operands.retain(|operand| *operand != pair);
            operands.extend(self.ops[pair].operands());
        }
        operands.sort_unstable();
        operands.dedup();
        operands
    }

    fn hold(&mut self, id: Id, slot: Slot) -> usize {
        self.slots.push(slot);
        self.held[id] = Some(self.slots.len() - 1);
        self.slots.len() - 1
    }

    /// The slot of a formula's value.
    fn result(&mut self, id: Id, index: usize) -> usize {
        self.held[id].unwrap_or_else(|| self.hold(id, Slot::Result(index)))
    }

    /// The slot of a value that was kept, or of an input.
    fn slot(&mut self, id: Id) -> usize {
        match (self.held[id], &self.ops[id]) {
            (Some(slot), _) => slot,
            (None, _) if self.same[id] => self.hold(id, Slot::Same(id)),
            (None, Op::Input(index)) => self.hold(id, Slot::Input(*index)),
            // Not reached: what is read from memory was kept.
            (None, _) => self.keep(id),
        }
    }

    /// A slot for a value that is to be kept.
    fn keep(&mut self, id: Id) -> usize {
        if let Some(slot) = self.held[id] {
            return slot;
        }
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots.push(Slot::Temporary);
            self.slots.len() - 1
        });
        self.held[id] = Some(slot);
        slot
    }

    /// Frees what is not read any more.
    fn release(&mut self, id: Id) {
        for operand in self.operands(id) {
            if self.last_read[operand] == id
                && let Some(slot) = self.held[operand]
                && self.slots[slot] == Slot::Temporary
            {
                self.free.push(slot);
            }
        }
    }

    fn end_run(&mut self) {
        if !self.run.is_empty() {
            self.steps.push(Step::Run(std::mem::take(&mut self.run)));
        }
        self.register = None;
    }

    fn push(&mut self, code: Code, at: usize) {
        self.push_pair(code, at, 0);
    }

    fn push_pair(&mut self, code: Code, at: usize, with: usize) {
        // A program has far fewer operations, and so fewer slots.
        let (at, with) = (at as u16, with as u16);
        self.run.push(Instr { code, at, with });
    }

    /// Brings a value into the register.
    fn load(&mut self, id: Id) {
        if self.register == Some(id) {
            return;
        }
        if self.same[id] {
            self.push(Code::LoadSame, id);
        } else {
            let slot = self.slot(id);
            self.push(Code::Load, slot);
        }
    }

    /// An operation with a pair, which is loaded with it.
    fn with_pair(&mut self, id: Id, pair: Id) {
        let Some((a, b, [right, left])) = outer(&self.ops[id]) else {
            return;
        };
        let (first, outer) = if b == pair { (a, right) } else { (b, left) };
        self.load(first);
        self.pair(pair, outer);
    }

    /// What is done with an operation on values in memory as a pair.
    fn pair(&mut self, id: Id, outer: Outer) {
        let Some((m, n, [slots, same_right, same_left])) = inner(&self.ops[id]) else {
            return;
        };
        let (inner, m, n) = match (self.same[m], self.same[n]) {
            (true, _) => (same_left, n, m),
            (false, true) => (same_right, m, n),
            (false, false) => (slots, m, n),
        };
        let with = if self.same[n] { n } else { self.slot(n) };
        let at = self.slot(m);
        self.push_pair(pair(outer, inner), at, with);
    }

    /// Whether an operation's operands lie in memory, or one of them is the same everywhere, and
    /// it can begin a chain. One value used twice is better loaded once.
    fn begins(&self, id: Id) -> bool {
        let free = |operand: Id| self.register != Some(operand);
        inner(&self.ops[id]).is_some_and(|(a, b, _)| a != b && free(a) && free(b))
    }

    fn operation(&mut self, id: Id, next: Option<Id>) {
        if let Some(pair) = self.pair[id] {
            self.with_pair(id, pair);
        } else if self.begins(id) {
            self.pair(id, Outer::Only);
        } else if let Some((operand, code)) = unary(&self.ops[id]) {
            self.load(operand);
            self.run.extend(code);
        } else if let Some((a, b, [left, left_same, right, right_same])) = binary(&self.ops[id]) {
            // What is in the register stays there; else what varies comes in.
            let from_right = self.register == Some(b) && self.register != Some(a);
            let from_right = from_right || (self.same[a] && !self.same[b]);
            let (first, second, code, code_same) = match from_right {
                true => (b, a, right, right_same),
                false => (a, b, left, left_same),
            };
            self.load(first);
            if self.same[second] {
                self.push(code_same, second);
            } else {
                let slot = self.slot(second);
                self.push(code, slot);
            }
        } else {
            self.end_run();
            let operands: Vec<usize> = self.ops[id].operands();
            let operands: Vec<usize> = operands.into_iter().map(|id| self.slot(id)).collect();
            // A function never writes where it reads: its slot is taken before any is freed.
            let to = self.keep(id);
            self.steps.push(match (&self.ops[id], operands.as_slice()) {
                (Op::Unary(function, _), [from]) => Step::Unary(*function, *from, to),
                (Op::Pow(..), [base, exponent]) => Step::Pow(*base, *exponent, to),
                (Op::Term(term, _), _) => Step::Term(*term, operands, to),
                // Not reached: these are all that are neither of the machine nor inputs.
                _ => return,
            });
            self.release(id);
            return;
        }
        self.register = Some(id);
        self.release(id);
        // The next operation may take it from the register, if it is the only one to read it.
        let passed_on = next.is_some_and(|next| self.takes(next, id));
        if self.reads[id] > 1 || !passed_on {
            let slot = self.keep(id);
            self.push(Code::Store, slot);
        }
    }

    /// Whether an operation of the machine takes this value from the register.
    fn takes(&self, next: Id, id: Id) -> bool {
        if self.pair[next].is_some() {
            return outer(&self.ops[next]).is_some_and(|(a, b, _)| a == id || b == id);
        }
        if let Some((operand, _)) = unary(&self.ops[next]) {
            return operand == id;
        }
        binary(&self.ops[next]).is_some_and(|(a, b, _)| a == id || b == id)
    }
}
