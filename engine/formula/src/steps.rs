//! From operations to steps over a chunk of points: runs of the machine's code, and what needs
//! a function called between them.

use crate::builtin::Builtin;
use crate::code::{Code, Instr, Operand, Outer, pair};
use crate::dag::{Id, Op, TermRef};
use crate::expr::CompareOp;
use crate::schedule::{Pair, Schedule, is_called};

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

/// What the machine does with its register and a slot, a value that is the same everywhere, or
/// what is parked.
type Codes = [Code; 3];

/// What the machine does with its register on the left of an operation and on the right.
fn binary(op: &Op) -> Option<(Id, Id, [Codes; 2])> {
    use Code::*;
    let both = |codes: Codes| [codes, codes];
    Some(match *op {
        Op::Add(a, b) => (a, b, both([Add, AddSame, AddParked])),
        Op::Mul(a, b) => (a, b, both([Mul, MulSame, MulParked])),
        Op::Min(a, b) => (a, b, both([Least, LeastSame, LeastParked])),
        Op::Max(a, b) => (a, b, both([Most, MostSame, MostParked])),
        Op::Sub(a, b) => {
            let right = [SubFrom, SubFromSame, SubFromParked];
            (a, b, [[Sub, SubSame, SubParked], right])
        }
        Op::Div(a, b) => {
            let right = [DivInto, DivIntoSame, DivIntoParked];
            (a, b, [[Div, DivSame, DivParked], right])
        }
        Op::Compare(op, a, b) => {
            let codes = |op| [Compare(op), CompareSame(op), CompareParked(op)];
            (a, b, [codes(op), codes(swapped(op))])
        }
        _ => return None,
    })
}

/// What the machine does with its register alone.
fn unary(op: &Op) -> Option<(Id, Vec<Instr>)> {
    let plain = Instr::new;
    Some(match *op {
        Op::Neg(a) => (a, vec![plain(Code::Neg)]),
        Op::Unary(Builtin::Sqrt, a) => (a, vec![plain(Code::Sqrt)]),
        Op::Unary(Builtin::Abs, a) => (a, vec![plain(Code::Abs)]),
        Op::PowInt(a, 2) => (a, vec![plain(Code::Square)]),
        Op::PowInt(a, 3) => (a, vec![plain(Code::Cube)]),
        Op::PowInt(a, 4) => (a, vec![plain(Code::Square); 2]),
        Op::PowInt(a, 5) => (a, vec![plain(Code::Fifth)]),
        Op::PowInt(a, power) => {
            let code = plain(Code::Power);
            (a, vec![Instr { power, ..code }])
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

struct Planner<'a> {
    ops: &'a [Op],
    schedule: Schedule,
    /// The slot that holds an operation's value.
    held: Vec<Option<usize>>,
    slots: Vec<Slot>,
    /// Slots to be used again; those that were filled before this run only after it, since what
    /// it reads may be read twice.
    free: Vec<usize>,
    free_later: Vec<usize>,
    /// Whether this run filled a slot.
    fresh: Vec<bool>,
    steps: Vec<Step>,
    run: Vec<Instr>,
    /// The operations whose values the machine holds.
    register: Option<Id>,
    parked: Option<Id>,
}

impl Steps {
    /// Plans the evaluation of `roots`, with `varying` telling which inputs differ from point
    /// to point.
    pub fn new(ops: &[Op], roots: &[Id], varying: &[bool]) -> Steps {
        let schedule = Schedule::new(ops, roots, varying);
        let mut planner = Planner {
            ops,
            held: vec![None; ops.len()],
            slots: Vec::new(),
            free: Vec::new(),
            free_later: Vec::new(),
            fresh: Vec::new(),
            steps: Vec::new(),
            run: Vec::new(),
            register: None,
            parked: None,
            schedule,
        };
        let mut results = Vec::new();
        for (index, root) in roots.iter().enumerate() {
            results.push(match (planner.schedule.same[*root], &ops[*root]) {
                (true, _) => Outcome::Same(*root),
                (false, Op::Input(_)) => Outcome::Held(planner.slot(*root)),
                (false, _) => Outcome::Held(planner.result(*root, index)),
            });
        }
        let order = std::mem::take(&mut planner.schedule.order);
        for (place, id) in order.iter().enumerate() {
            planner.operation(*id, &order[place + 1..]);
        }
        planner.end_run();
        let same = &planner.schedule.same;
        Steps {
            steps: planner.steps,
            slots: planner.slots,
            results,
            same: (0..ops.len()).filter(|id| same[*id]).collect(),
        }
    }

    /// Whether one run does it all, with no memory but that of inputs and results.
    pub fn in_place(&self) -> bool {
        let temporary = |slot: &Slot| matches!(slot, Slot::Temporary | Slot::Same(_));
        matches!(self.steps[..], [] | [Step::Run(_)]) && !self.slots.iter().any(temporary)
    }

    /// Whether those of a function's arguments that are of the material are the same everywhere.
    pub fn of_material(&self, term: &brdf::Term, args: &[usize]) -> bool {
        let mut args = args.iter().zip(term.params);
        args.all(|(slot, param)| {
            !param.is_of_material() || matches!(self.slots[*slot], Slot::Same(_))
        })
    }
}

impl Planner<'_> {
    fn hold(&mut self, id: Id, slot: Slot) -> usize {
        self.held[id] = Some(self.new_slot(slot));
        self.slots.len() - 1
    }

    fn new_slot(&mut self, slot: Slot) -> usize {
        self.slots.push(slot);
        self.fresh.push(false);
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
            (None, _) if self.schedule.same[id] => self.hold(id, Slot::Same(id)),
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
        let slot = self.free.pop();
        let slot = slot.unwrap_or_else(|| self.new_slot(Slot::Temporary));
        self.held[id] = Some(slot);
        slot
    }

    /// Frees what is not read any more.
    fn release(&mut self, id: Id) {
        for operand in self.schedule.operands(self.ops, id) {
            if self.schedule.last_read[operand] == id
                && let Some(slot) = self.held[operand]
                && self.slots[slot] == Slot::Temporary
            {
                match self.fresh[slot] {
                    true => self.free.push(slot),
                    false => self.free_later.push(slot),
                }
            }
        }
    }

    fn end_run(&mut self) {
        if !self.run.is_empty() {
            self.steps.push(Step::Run(std::mem::take(&mut self.run)));
        }
        self.free.append(&mut self.free_later);
        self.fresh.fill(false);
        self.register = None;
    }

    /// Where the machine finds a value that is not in its register.
    fn operand(&mut self, id: Id) -> Operand {
        match self.schedule.same[id] {
            true => Operand::Same(id),
            false => Operand::Slot(self.slot(id)),
        }
    }

    /// One of three instructions, as it depends on where the other operand is.
    fn push(&mut self, [slot, same, parked]: Codes, id: Id) {
        if self.parked == Some(id) {
            self.parked = None;
            return self.run.push(Instr::new(parked));
        }
        let at = self.operand(id);
        let code = if self.schedule.same[id] { same } else { slot };
        self.run.push(Instr::new(code).at(at));
    }

    /// Brings a value into the register.
    fn load(&mut self, id: Id) {
        if self.register != Some(id) {
            self.push([Code::Load, Code::LoadSame, Code::LoadParked], id);
        }
    }

    /// What is done with an operation on values in memory as a pair.
    fn pair(&mut self, id: Id, outer: Outer) {
        let Some(Pair {
            inner, at, with, ..
        }) = self.schedule.as_pair[id]
        else {
            return;
        };
        let (at, with) = (self.operand(at), self.operand(with));
        // A chain that begins where another one was parked.
        let parks = |last: &mut Instr| last.code == Code::Park;
        let outer = match outer == Outer::Only && self.run.pop_if(parks).is_some() {
            true => Outer::Park,
            false => outer,
        };
        let code = Instr::new(pair(outer, inner)).at(at);
        self.run.push(Instr { with, ..code });
    }

    /// An operation with a pair, which is loaded with it. One whose other operand is the same
    /// everywhere begins with the pair.
    fn with_pair(&mut self, id: Id, pair: Id) {
        let Some((a, b, [right, left])) = outer(&self.ops[id]) else {
            return;
        };
        let (first, outer) = if b == pair { (a, right) } else { (b, left) };
        if self.schedule.same[first] {
            self.pair(pair, Outer::Only);
            self.register = Some(pair);
            self.with_register(id);
        } else {
            self.load(first);
            self.pair(pair, outer);
        }
    }

    /// An operation of two operands, one of which comes into the register if none is there.
    fn with_register(&mut self, id: Id) {
        let Some((a, b, [left, right])) = binary(&self.ops[id]) else {
            return;
        };
        let held = |id: Id| self.register == Some(id);
        // What is in the register stays there; else what varies, and was not parked, comes in.
        let from_right = held(b) && !held(a);
        let waits = |id: Id| self.schedule.same[id] || self.parked == Some(id);
        let from_right = from_right || (waits(a) && !waits(b) && !held(a));
        let (first, second, codes) = match from_right {
            true => (b, a, right),
            false => (a, b, left),
        };
        self.load(first);
        self.push(codes, second);
    }

    /// Whether an operation begins a chain as a pair: not if it can go on from the register.
    fn begins(&self, id: Id) -> bool {
        let goes_on = self
            .register
            .is_some_and(|held| self.ops[id].operands().contains(&held));
        self.schedule.as_pair[id].is_some() && !goes_on
    }

    /// Plans an operation; `after` are those that come later.
    fn operation(&mut self, id: Id, after: &[Id]) {
        if is_called(&self.ops[id]) {
            return self.call(id);
        }
        if let Some(pair) = self.schedule.pair[id] {
            self.with_pair(id, pair);
        } else if self.begins(id) {
            self.pair(id, Outer::Only);
        } else if let Some((operand, code)) = unary(&self.ops[id]) {
            self.load(operand);
            self.run.extend(code);
        } else {
            self.with_register(id);
        }
        self.register = Some(id);
        self.release(id);
        // The next operation may take it from the register, if it is the only one to read it.
        let reads = |next: &Id| self.schedule.takes(self.ops, *next, id);
        let once = self.schedule.reads[id] == 1;
        if once && after.first().is_some_and(reads) {
            return;
        }
        // A later one finds it parked, unless a function is called in between.
        let mut run = after
            .iter()
            .take_while(|next| !is_called(&self.ops[**next]));
        if once && self.parked.is_none() && run.any(reads) {
            self.parked = Some(id);
            self.run.push(Instr::new(Code::Park));
        } else {
            let slot = self.keep(id);
            self.fresh[slot] = true;
            self.run
                .push(Instr::new(Code::Store).at(Operand::Slot(slot)));
        }
    }

    /// Calls a function for the whole chunk.
    fn call(&mut self, id: Id) {
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
    }
}
