//! A formula as a flat program for blocks of points: one operation over a whole block at a
//! time, so that the tree costs little more than compiled code of the same operations.

use crate::dag::{Dag, Id, Op};
use crate::error::Error;
use crate::eval::{Real, apply};
use crate::expr::Expr;
use crate::library::Library;

/// Points that are carried through all operations before the next ones are: few enough
/// that the intermediate values stay in the first cache.
const CHUNK: usize = 512;

/// One input of a block.
#[derive(Clone, Copy, Debug)]
pub enum Column<'a, T> {
    /// The same value at every point: what depends only on such inputs is computed once.
    Uniform(T),
    /// A value for each point; as long as the output.
    Varying(&'a [T]),
}

/// Memory that block evaluation reuses between calls.
#[derive(Debug, Default)]
pub struct Scratch {
    double: Lanes<f64>,
    single: Lanes<f32>,
}

impl Scratch {
    /// No memory yet.
    pub fn new() -> Scratch {
        Scratch::default()
    }
}

#[derive(Debug, Default)]
struct Lanes<T> {
    /// One chunk of values each.
    registers: Vec<Vec<T>>,
    /// The value of every operation that is the same at all points.
    uniform: Vec<Option<T>>,
}

/// A formula opened and compiled over named inputs.
///
/// Values outside a domain are NaN or infinite here, as in compiled code:
/// [`Library::eval`] is the one that explains.
#[derive(Clone, Debug)]
pub struct Program {
    ops: Vec<Op>,
    inputs: Vec<String>,
    root: Id,
    /// Products that block evaluation does together with the operation that needs them, by
    /// that operation: a product that nothing else reads need not be stored.
    fused: Vec<Option<Id>>,
    /// Whether an operation is done together with another one.
    absorbed: Vec<bool>,
    /// Where each operation keeps its values in block evaluation.
    register: Vec<usize>,
    registers: usize,
}

impl Library {
    /// Compiles an expression over the given inputs. Common parts are computed once.
    ///
    /// # Errors
    /// As [`Library::check_expr`]: the first of them.
    pub fn compile(&self, expr: &Expr, inputs: &[&str]) -> Result<Program, Error> {
        let dag = self.lower(expr, Some(inputs))?;
        let inputs = inputs.iter().map(ToString::to_string).collect();
        Ok(Program::new(&dag, inputs))
    }
}

impl Program {
    fn new(dag: &Dag, inputs: Vec<String>) -> Program {
        let needed = dag.needed();
        let mut place = vec![0; dag.ops.len()];
        let mut ops = Vec::new();
        for (id, op) in dag.ops.iter().enumerate().filter(|(id, _)| needed[*id]) {
            place[id] = ops.len();
            // The dag's inputs are the program's, in the same order: they were given.
            ops.push(op.renumbered(|id| place[id]));
        }
        let (fused, absorbed) = fused(&ops);
        let (register, registers) = registers(&ops, &fused, &absorbed);
        Program {
            root: place.get(dag.root).copied().unwrap_or(0),
            ops,
            inputs,
            fused,
            absorbed,
            register,
            registers,
        }
    }

    /// The names of the inputs, in order.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// The number of operations of one evaluation; a call of the core counts as one.
    pub fn ops(&self) -> usize {
        self.ops
            .iter()
            .filter(|op| !op.operands().is_empty())
            .count()
    }

    /// Names of the core's functions that are called, each once.
    pub fn terms(&self) -> Vec<&'static str> {
        let mut names = Vec::new();
        for op in &self.ops {
            if let Op::Term(term, _) = op
                && !names.contains(&term.0.name)
            {
                names.push(term.0.name);
            }
        }
        names
    }

    /// The value at one point; an input that is missing is NaN.
    pub fn eval(&self, inputs: &[f64]) -> f64 {
        self.point(inputs)
    }

    /// The value at one point, every operation in f32.
    pub fn eval_f32(&self, inputs: &[f32]) -> f32 {
        self.point(inputs)
    }

    fn point<R: Real>(&self, inputs: &[R]) -> R {
        let mut values: Vec<R> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            values.push(apply(op, inputs, |id| values[id]));
        }
        values.get(self.root).copied().unwrap_or(R::of(f64::NAN))
    }

    /// The values at a block of points, in f64. A column that is missing or shorter than
    /// `out` gives NaN where it has no value.
    pub fn eval_block_f64(&self, inputs: &[Column<f64>], out: &mut [f64], scratch: &mut Scratch) {
        self.block(inputs, out, &mut scratch.double);
    }

    /// The values at a block of points, every operation in f32; otherwise as
    /// [`Program::eval_block_f64`].
    pub fn eval_block_f32(&self, inputs: &[Column<f32>], out: &mut [f32], scratch: &mut Scratch) {
        self.block(inputs, out, &mut scratch.single);
    }

    fn block<R: Real>(&self, inputs: &[Column<R>], out: &mut [R], lanes: &mut Lanes<R>) {
        let nan = R::of(f64::NAN);
        let columns: Vec<Column<R>> = (0..self.inputs.len())
            .map(|index| match inputs.get(index) {
                Some(Column::Varying(values)) if values.len() < out.len() => Column::Uniform(nan),
                Some(column) => *column,
                None => Column::Uniform(nan),
            })
            .collect();
        let constants: Vec<R> = columns
            .iter()
            .map(|column| match column {
                Column::Uniform(value) => *value,
                Column::Varying(_) => nan,
            })
            .collect();
        let Lanes { registers, uniform } = lanes;
        uniform.clear();
        for op in &self.ops {
            let same = match op {
                Op::Input(index) => matches!(columns.get(*index), Some(Column::Uniform(_)) | None),
                _ => op.operands().iter().all(|id| uniform[*id].is_some()),
            };
            let value = same.then(|| apply(op, &constants, |id| uniform[id].unwrap_or(nan)));
            uniform.push(value);
        }
        if let Some(value) = uniform.get(self.root).copied().flatten() {
            out.fill(value);
            return;
        }
        registers.resize_with(self.registers.max(registers.len()), Vec::new);
        for register in registers.iter_mut() {
            register.resize(CHUNK, R::ZERO);
        }
        for (index, out) in out.chunks_mut(CHUNK).enumerate() {
            let run = Run {
                program: self,
                columns: &columns,
                uniform,
                start: index * CHUNK,
            };
            run.chunk(registers, out);
        }
    }
}

/// One chunk on its way through the operations.
struct Run<'a, R> {
    program: &'a Program,
    columns: &'a [Column<'a, R>],
    uniform: &'a [Option<R>],
    start: usize,
}

/// An operand over a chunk.
#[derive(Clone, Copy)]
enum View<'a, R> {
    Same(R),
    Each(&'a [R]),
}

impl<R: Real> Run<'_, R> {
    fn chunk(&self, registers: &mut [Vec<R>], out: &mut [R]) {
        let ops = self.program.ops.iter().enumerate();
        for (id, op) in ops.filter(|(id, _)| self.uniform[*id].is_none()) {
            if id == self.program.root {
                self.operation(id, op, registers, out);
                return;
            }
            if matches!(op, Op::Input(_)) || self.program.absorbed[id] {
                continue;
            }
            // An operation never writes where it reads: registers are allotted so.
            let slot = self.program.register[id];
            let mut to = std::mem::take(&mut registers[slot]);
            self.operation(id, op, registers, &mut to[..out.len()]);
            registers[slot] = to;
        }
    }

    fn view<'v>(&'v self, id: Id, registers: &'v [Vec<R>], count: usize) -> View<'v, R> {
        if let Some(value) = self.uniform[id] {
            return View::Same(value);
        }
        match &self.program.ops[id] {
            Op::Input(index) => match self.columns[*index] {
                Column::Varying(values) => View::Each(&values[self.start..self.start + count]),
                Column::Uniform(value) => View::Same(value),
            },
            _ => View::Each(&registers[self.program.register[id]][..count]),
        }
    }

    /// The kind of operation is looked at once, outside of the loops.
    fn operation(&self, id: Id, op: &Op, registers: &[Vec<R>], out: &mut [R]) {
        let count = out.len();
        let view = |id: &Id| self.view(*id, registers, count);
        // A product that is the same at all points is no longer one.
        if let Some(product) = self.program.fused[id].filter(|id| self.uniform[*id].is_none()) {
            let (x, y) = match &self.program.ops[product] {
                Op::Mul(x, y) => (view(x), view(y)),
                Op::PowInt(x, _) => (view(x), view(x)),
                _ => return,
            };
            match op {
                Op::Add(a, b) if *a == product => with_product(out, x, y, view(b), R::add),
                Op::Add(a, _) => with_product(out, x, y, view(a), |p, z| z.add(p)),
                Op::Sub(a, b) if *a == product => with_product(out, x, y, view(b), R::sub),
                Op::Sub(a, _) => with_product(out, x, y, view(a), |p, z| z.sub(p)),
                Op::Mul(a, b) if *a == product => with_product(out, x, y, view(b), R::mul),
                Op::Mul(a, _) => with_product(out, x, y, view(a), |p, z| z.mul(p)),
                Op::Div(a, b) if *a == product => with_product(out, x, y, view(b), R::div),
                Op::Div(a, _) => with_product(out, x, y, view(a), |p, z| z.div(p)),
                _ => {}
            }
            return;
        }
        match op {
            Op::Number(_) | Op::Pi => {}
            Op::Input(index) => {
                if let Column::Varying(values) = self.columns[*index] {
                    out.copy_from_slice(&values[self.start..self.start + count]);
                }
            }
            Op::Neg(a) => one(out, view(a), R::neg),
            Op::Add(a, b) => two(out, view(a), view(b), R::add),
            Op::Sub(a, b) => two(out, view(a), view(b), R::sub),
            Op::Mul(a, b) => two(out, view(a), view(b), R::mul),
            Op::Div(a, b) => two(out, view(a), view(b), R::div),
            Op::PowInt(a, 2) => one(out, view(a), |x| x.mul(x)),
            Op::PowInt(a, 3) => one(out, view(a), |x| x.mul(x.mul(x))),
            Op::PowInt(a, 4) => one(out, view(a), |x| x.mul(x).mul(x.mul(x))),
            Op::PowInt(a, 5) => one(out, view(a), |x| x.mul(x.mul(x).mul(x.mul(x)))),
            Op::PowInt(a, power) => one(out, view(a), |x| x.power(*power)),
            Op::Pow(a, b) => two(out, view(a), view(b), R::pow),
            Op::Compare(op, a, b) => two(out, view(a), view(b), |x, y| x.compare(*op, y)),
            Op::Min(a, b) => two(out, view(a), view(b), R::least),
            Op::Max(a, b) => two(out, view(a), view(b), R::most),
            Op::Unary(function, a) => one(out, view(a), |x| x.unary(*function)),
            Op::Term(term, args) => {
                let views: Vec<View<R>> = args.iter().map(view).collect();
                let mut values = vec![R::ZERO; args.len()];
                for (index, out) in out.iter_mut().enumerate() {
                    for (value, view) in values.iter_mut().zip(&views) {
                        *value = match view {
                            View::Same(value) => *value,
                            View::Each(each) => each[index],
                        };
                    }
                    *out = R::term(term.0, &values);
                }
            }
        }
    }
}

#[inline(always)]
fn one<R: Real>(out: &mut [R], a: View<R>, f: impl Fn(R) -> R) {
    match a {
        View::Same(a) => out.fill(f(a)),
        View::Each(a) => {
            for (out, a) in out.iter_mut().zip(a) {
                *out = f(*a);
            }
        }
    }
}

#[inline(always)]
fn two<R: Real>(out: &mut [R], a: View<R>, b: View<R>, f: impl Fn(R, R) -> R) {
    match (a, b) {
        (View::Same(a), View::Same(b)) => out.fill(f(a, b)),
        (View::Same(a), View::Each(b)) => {
            for (out, b) in out.iter_mut().zip(b) {
                *out = f(a, *b);
            }
        }
        (View::Each(a), View::Same(b)) => {
            for (out, a) in out.iter_mut().zip(a) {
                *out = f(*a, b);
            }
        }
        (View::Each(a), View::Each(b)) => {
            for ((out, a), b) in out.iter_mut().zip(a).zip(b) {
                *out = f(*a, *b);
            }
        }
    }
}

/// A product and what is done with it, in one pass; rounded twice, as if it were two.
#[inline(always)]
fn with_product<R: Real>(out: &mut [R], x: View<R>, y: View<R>, z: View<R>, f: impl Fn(R, R) -> R) {
    let (x, y) = match (x, y) {
        (View::Each(x), y) => (x, y),
        (x, View::Each(y)) => (y, x),
        // Not reached: such a product is the same at all points.
        (View::Same(x), View::Same(y)) => return one(out, z, |z| f(x.mul(y), z)),
    };
    match (y, z) {
        (View::Same(y), View::Same(z)) => {
            for (out, x) in out.iter_mut().zip(x) {
                *out = f(x.mul(y), z);
            }
        }
        (View::Same(y), View::Each(z)) => {
            for ((out, x), z) in out.iter_mut().zip(x).zip(z) {
                *out = f(x.mul(y), *z);
            }
        }
        (View::Each(y), View::Same(z)) => {
            for ((out, x), y) in out.iter_mut().zip(x).zip(y) {
                *out = f(x.mul(*y), z);
            }
        }
        (View::Each(y), View::Each(z)) => {
            for (((out, x), y), z) in out.iter_mut().zip(x).zip(y).zip(z) {
                *out = f(x.mul(*y), *z);
            }
        }
    }
}

impl Op {
    fn renumbered(&self, new: impl Fn(Id) -> Id) -> Op {
        match self {
            Op::Number(_) | Op::Pi | Op::Input(_) => self.clone(),
            Op::Neg(a) => Op::Neg(new(*a)),
            Op::Add(a, b) => Op::Add(new(*a), new(*b)),
            Op::Sub(a, b) => Op::Sub(new(*a), new(*b)),
            Op::Mul(a, b) => Op::Mul(new(*a), new(*b)),
            Op::Div(a, b) => Op::Div(new(*a), new(*b)),
            Op::PowInt(a, power) => Op::PowInt(new(*a), *power),
            Op::Pow(a, b) => Op::Pow(new(*a), new(*b)),
            Op::Compare(op, a, b) => Op::Compare(*op, new(*a), new(*b)),
            Op::Min(a, b) => Op::Min(new(*a), new(*b)),
            Op::Max(a, b) => Op::Max(new(*a), new(*b)),
            Op::Unary(function, a) => Op::Unary(*function, new(*a)),
            Op::Term(term, args) => Op::Term(*term, args.iter().map(|id| new(*id)).collect()),
        }
    }
}

/// Finds products that are read once, by a sum, a difference, a product or a quotient.
fn fused(ops: &[Op]) -> (Vec<Option<Id>>, Vec<bool>) {
    let mut reads = vec![0_u32; ops.len()];
    for op in ops {
        for operand in op.operands() {
            reads[operand] += 1;
        }
    }
    let mut fused = vec![None; ops.len()];
    let mut absorbed = vec![false; ops.len()];
    for (id, op) in ops.iter().enumerate() {
        let (Op::Add(a, b) | Op::Sub(a, b) | Op::Mul(a, b) | Op::Div(a, b)) = op else {
            continue;
        };
        // One level: a product that itself takes one in is left alone.
        let product = [*a, *b].into_iter().find(|operand| {
            let simple = matches!(ops[*operand], Op::Mul(..) | Op::PowInt(_, 2));
            simple && reads[*operand] == 1 && fused[*operand].is_none()
        });
        if let Some(product) = product {
            fused[id] = Some(product);
            absorbed[product] = true;
        }
    }
    (fused, absorbed)
}

/// Allots registers: one is free again after the last operation that reads it, and that
/// operation itself still writes elsewhere.
fn registers(ops: &[Op], fused: &[Option<Id>], absorbed: &[bool]) -> (Vec<usize>, usize) {
    // What an operation reads, through the product that is done with it.
    let reads = |id: Id| {
        let mut operands = ops[id].operands();
        if let Some(product) = fused[id] {
            operands.retain(|operand| *operand != product);
            operands.extend(ops[product].operands());
        }
        operands.sort_unstable();
        operands.dedup();
        operands
    };
    let mut last_read = vec![0; ops.len()];
    for id in (0..ops.len()).filter(|id| !absorbed[*id]) {
        for operand in reads(id) {
            last_read[operand] = id;
        }
    }
    let mut register = vec![0; ops.len()];
    let mut free = Vec::new();
    let mut count = 0;
    for id in (0..ops.len()).filter(|id| !absorbed[*id]) {
        let operands = reads(id);
        if operands.is_empty() {
            continue;
        }
        register[id] = free.pop().unwrap_or_else(|| {
            count += 1;
            count - 1
        });
        for operand in operands {
            if last_read[operand] == id && !ops[operand].operands().is_empty() {
                free.push(register[operand]);
            }
        }
    }
    (register, count)
}
