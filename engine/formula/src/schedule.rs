//! In which order the operations of a program are done, so that few of their values are written
//! down: functions first, and of two operands the one that needs more comes before the other.

use crate::builtin::Builtin;
use crate::code::Inner;
use crate::dag::{Id, Op};

/// Whether an operation is a function called for a whole chunk, and not one of the machine's.
pub(crate) fn is_called(op: &Op) -> bool {
    match op {
        Op::Unary(function, _) => !matches!(function, Builtin::Sqrt | Builtin::Abs),
        Op::Pow(..) | Op::Term(..) => true,
        _ => false,
    }
}

/// An operation that can be done as a pair, since what it needs lies in memory or is the same
/// everywhere.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    pub inner: Inner,
    /// What varies, and what it is taken with: itself where there is nothing else.
    pub at: Id,
    pub with: Id,
    /// Whether it does an operand's operation as well, which then is not done by itself.
    pub deep: bool,
}

/// What is known of each operation, and the order.
#[derive(Debug)]
pub(crate) struct Schedule {
    /// Whether an operation is the same at all points.
    pub same: Vec<bool>,
    /// How often an operation's value is read, and by which operation last.
    pub reads: Vec<u32>,
    pub last_read: Vec<Id>,
    /// How an operation is done as a pair, if it can be.
    pub as_pair: Vec<Option<Pair>>,
    /// The operand that an operation computes on its way, as a pair.
    pub pair: Vec<Option<Id>>,
    /// The operations that differ from point to point, operands first, without those that others
    /// compute on their way.
    pub order: Vec<Id>,
}

impl Schedule {
    pub fn new(ops: &[Op], roots: &[Id], varying: &[bool]) -> Schedule {
        let mut same = Vec::with_capacity(ops.len());
        for op in ops {
            same.push(match op {
                Op::Input(index) => !varying.get(*index).copied().unwrap_or(false),
                _ => op.operands().iter().all(|id| same[*id]),
            });
        }
        let mut schedule = Schedule {
            same,
            reads: vec![0; ops.len()],
            last_read: vec![0; ops.len()],
            as_pair: vec![None; ops.len()],
            pair: vec![None; ops.len()],
            order: Vec::new(),
        };
        schedule.count_reads(ops, roots);
        schedule.find_pairs(ops);
        schedule.put_in_order(ops, roots);
        for id in &schedule.order {
            for operand in schedule.operands(ops, *id) {
                schedule.last_read[operand] = *id;
            }
        }
        schedule
    }

    fn count_reads(&mut self, ops: &[Op], roots: &[Id]) {
        for (id, op) in ops.iter().enumerate() {
            if !self.same[id] {
                let mut operands = op.operands();
                // A square reads its operand once.
                if matches!(op, Op::Mul(..)) {
                    operands.dedup();
                }
                operands
                    .iter()
                    .for_each(|operand| self.reads[*operand] += 1);
            }
        }
        // A result is not passed on unseen.
        roots.iter().for_each(|root| self.reads[*root] += 2);
    }

    /// Whether an operation's value lies in memory or is the same everywhere.
    fn leaf(&self, ops: &[Op], id: Id) -> bool {
        self.same[id]
            || self.reads[id] > 1
            || matches!(ops[id], Op::Input(_))
            || is_called(&ops[id])
    }

    /// How an operation is done as a pair.
    fn form(&self, ops: &[Op], id: Id) -> Option<Pair> {
        use Inner::*;
        let square = |id: Id| match ops[id] {
            Op::PowInt(a, 2) => Some(a),
            Op::Mul(a, b) if a == b => Some(a),
            _ => None,
        };
        let simple = |inner, at, with| {
            let deep = false;
            Some(Pair {
                inner,
                at,
                with,
                deep,
            })
        };
        let by_kind =
            |a: Id, b: Id, [slots, right, left]: [Inner; 3]| match (self.same[a], self.same[b]) {
                (true, _) => simple(left, b, a),
                (false, true) => simple(right, a, b),
                (false, false) => simple(slots, a, b),
            };
        // An operand that only this operation reads, and can do as well.
        let own = |id: Id| !self.same[id] && self.reads[id] == 1;
        let pair = match ops[id] {
            _ if self.same[id] => None,
            Op::PowInt(a, 5) if own(a) => match ops[a] {
                Op::Sub(c, m) if self.same[c] => {
                    let pair = simple(SubFromSameFifth, m, c);
                    pair.map(|pair| Pair { deep: true, ..pair })
                }
                _ => None,
            },
            Op::Mul(a, b) if a != b && self.same[a] != self.same[b] => {
                let (c, other) = if self.same[a] { (a, b) } else { (b, a) };
                match square(other) {
                    Some(m) if own(other) && self.leaf(ops, m) => {
                        let pair = simple(SquareMulSame, m, c);
                        pair.map(|pair| Pair { deep: true, ..pair })
                    }
                    _ => simple(MulSame, other, c),
                }
            }
            Op::Add(a, b) => by_kind(a, b, [Add, AddSame, AddSame]),
            Op::Sub(a, b) => by_kind(a, b, [Sub, SubSame, SubFromSame]),
            Op::Div(a, b) => by_kind(a, b, [Div, DivSame, DivIntoSame]),
            _ => match (square(id), &ops[id]) {
                (Some(m), _) => simple(Square, m, m),
                (None, Op::Mul(a, b)) => simple(Mul, *a, *b),
                _ => None,
            },
        };
        pair.filter(|pair| self.leaf(ops, pair.at) && self.leaf(ops, pair.with))
    }

    /// Finds operations on values in memory that are read once, by arithmetic: they are done
    /// together with it.
    fn find_pairs(&mut self, ops: &[Op]) {
        for (id, op) in ops.iter().enumerate().filter(|(id, _)| !self.same[*id]) {
            self.as_pair[id] = self.form(ops, id);
            let (Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b)) = *op else {
                continue;
            };
            let pair = [b, a]
                .into_iter()
                .find(|pair| a != b && self.as_pair[*pair].is_some() && !self.leaf(ops, *pair));
            if self.as_pair[id].is_none() {
                self.pair[id] = pair;
            }
        }
    }

    /// What an operation reads, through the pair that it computes on its way.
    pub fn operands(&self, ops: &[Op], id: Id) -> Vec<Id> {
        let mut operands = ops[id].operands();
        let through = match self.as_pair[id] {
            Some(Pair { deep: true, .. }) => Some(id),
            _ => self.pair[id],
        };
        if let Some(Pair { at, with, .. }) = through.and_then(|id| self.as_pair[id]) {
            operands.retain(|operand| through != Some(id) && through != Some(*operand));
            operands.extend([at, with]);
        }
        operands.sort_unstable();
        operands.dedup();
        operands
    }

    /// Whether an operation of the machine can take this value from the register.
    pub fn takes(&self, ops: &[Op], next: Id, id: Id) -> bool {
        !is_called(&ops[next]) && ops[next].operands().contains(&id)
    }

    /// How many values the machine has to hold at once for an operation, in [`put_in_order`]'s
    /// order, if nothing of it is in memory yet.
    ///
    /// [`put_in_order`]: Schedule::put_in_order
    fn needs(&self, ops: &[Op]) -> Vec<u32> {
        let mut needs: Vec<u32> = Vec::with_capacity(ops.len());
        for id in 0..ops.len() {
            let operands = self.operands(ops, id);
            let mut operands: Vec<u32> = operands
                .into_iter()
                .filter(|operand| !self.leaf(ops, *operand))
                .map(|operand| needs[operand])
                .collect();
            operands.sort_unstable_by(|a, b| b.cmp(a));
            let held = operands.iter().zip(0..).map(|(need, before)| need + before);
            needs.push(held.max().unwrap_or(1));
        }
        needs
    }

    fn put_in_order(&mut self, ops: &[Op], roots: &[Id]) {
        let needs = self.needs(ops);
        let mut done: Vec<bool> = (0..ops.len())
            .map(|id| self.same[id] || matches!(ops[id], Op::Input(_)))
            .collect();
        let called = (0..ops.len()).filter(|id| is_called(&ops[*id]));
        let goals: Vec<Id> = called.chain(roots.iter().copied()).collect();
        for goal in goals {
            // Operations to do, the next one last, and whether their operands are done.
            let mut left = vec![(goal, false)];
            while let Some((id, ready)) = left.pop() {
                if done[id] {
                    continue;
                }
                if ready {
                    done[id] = true;
                    self.order.push(id);
                    continue;
                }
                left.push((id, true));
                let mut operands = self.operands(ops, id);
                // What lies in memory when it is done goes first: then the chains.
                operands.sort_by_key(|operand| {
                    (
                        !self.leaf(ops, *operand),
                        std::cmp::Reverse(needs[*operand]),
                    )
                });
                left.extend(operands.into_iter().rev().map(|operand| (operand, false)));
            }
        }
    }
}
