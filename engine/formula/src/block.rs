//! Evaluation of a program over a block of points, chunk by chunk: a chunk's values stay in the
//! nearest cache from the first step to the last.

use crate::dag::Id;
use crate::eval::{Real, apply};
use crate::machine::Machine;
use crate::program::{Column, Operations};
use crate::steps::{Outcome, Slot, Step, Steps};
use brdf::batch::Isa;
use std::sync::Arc;

/// Programs whose steps are kept.
const KEPT: usize = 8;

/// Slots, and arguments of a function, for which no memory is asked for.
const USUAL_SLOTS: usize = 48;
const USUAL_ARGS: usize = 8;

/// Bytes of a cache line, and of the longest vector.
const LINE: usize = 64;

/// The steps of the programs evaluated last, and memory for them.
#[derive(Debug)]
pub(crate) struct Blocks<R> {
    ready: Vec<Ready<R>>,
}

impl<R> Default for Blocks<R> {
    fn default() -> Self {
        Blocks { ready: Vec::new() }
    }
}

/// A program that is ready to run where the same inputs vary.
#[derive(Debug)]
struct Ready<R> {
    operations: Arc<Operations>,
    varying: Vec<bool>,
    steps: Steps,
    /// The inputs, NaN where they vary, and every operation that is the same at all points.
    constants: Vec<R>,
    same: Vec<R>,
    memory: Memory<R>,
}

/// Chunks of values, each on cache lines of its own.
#[derive(Debug, Default)]
struct Memory<R> {
    values: Vec<R>,
    first: usize,
}

impl<R: Machine> Memory<R> {
    fn new(chunks: usize) -> Self {
        let values = vec![R::ZERO; chunks * R::CHUNK + LINE / size_of::<R>()];
        let first = values
            .as_ptr()
            .align_offset(LINE)
            .min(LINE / size_of::<R>());
        Memory { values, first }
    }

    /// All chunks, one after the other.
    fn chunks(&mut self) -> &mut [R] {
        &mut self.values[self.first..]
    }
}

impl<R: Machine> Ready<R> {
    fn new(operations: &Arc<Operations>, varying: Vec<bool>) -> Self {
        let steps = Steps::new(&operations.ops, &operations.roots, &varying);
        // One chunk a slot, whether it is needed or the caller's own memory is used.
        let memory = Memory::new(steps.slots.len());
        Ready {
            operations: operations.clone(),
            varying,
            steps,
            constants: Vec::new(),
            same: Vec::new(),
            memory,
        }
    }

    /// Computes what is the same at all points, unless it is what it was.
    fn fix(&mut self, constants: Vec<R>) {
        let known = self.constants.len() == constants.len()
            && self
                .constants
                .iter()
                .zip(&constants)
                .all(|(a, b)| same_bits(*a, *b));
        if known && !self.same.is_empty() {
            return;
        }
        let ops = &self.operations.ops;
        self.same = vec![R::ZERO; ops.len()];
        for id in &self.steps.same {
            self.same[*id] = apply(&ops[*id], &constants, |id: Id| self.same[id]);
        }
        self.constants = constants;
        for (index, slot) in self.steps.slots.iter().enumerate() {
            if let Slot::Same(id) = slot {
                let chunk = self.memory.chunks().chunks_mut(R::CHUNK).nth(index);
                chunk
                    .into_iter()
                    .for_each(|chunk| chunk.fill(self.same[*id]));
            }
        }
    }
}

/// What is to be evaluated.
pub(crate) struct Block<'a, 'o, R> {
    operations: &'a Arc<Operations>,
    columns: Vec<Column<'a, R>>,
    outs: &'a mut [&'o mut [R]],
    count: usize,
    isa: Isa,
}

impl<'a, 'o, R: Machine> Block<'a, 'o, R> {
    pub fn new(
        operations: &'a Arc<Operations>,
        inputs: usize,
        columns: &'a [Column<'a, R>],
        outs: &'a mut [&'o mut [R]],
        isa: Isa,
    ) -> Self {
        let count = outs.iter().map(|out| out.len()).max().unwrap_or(0);
        let missing = Column::Uniform(R::of(f64::NAN));
        let columns = (0..inputs)
            .map(|index| match columns.get(index) {
                Some(Column::Varying(values)) if values.len() < count => missing,
                Some(column) => *column,
                None => missing,
            })
            .collect();
        Block {
            operations,
            columns,
            outs,
            count,
            isa,
        }
    }

    pub fn run(mut self, blocks: &mut Blocks<R>) {
        let varying = |column: &Column<R>| matches!(column, Column::Varying(_));
        let varying: Vec<bool> = self.columns.iter().map(varying).collect();
        let known = blocks.ready.iter().position(|ready| {
            Arc::ptr_eq(&ready.operations, self.operations) && ready.varying == varying
        });
        let index = known.unwrap_or_else(|| {
            if blocks.ready.len() == KEPT {
                blocks.ready.remove(0);
            }
            blocks.ready.push(Ready::new(self.operations, varying));
            blocks.ready.len() - 1
        });
        let constants = self.columns.iter().map(|column| match column {
            Column::Uniform(value) => *value,
            Column::Varying(_) => R::of(f64::NAN),
        });
        let ready = &mut blocks.ready[index];
        ready.fix(constants.collect());
        for (out, outcome) in self.outs.iter_mut().zip(&ready.steps.results) {
            if let Outcome::Same(id) = outcome {
                out.fill(ready.same[*id]);
            }
        }
        // A root that nobody asked for takes no slice; the program still computes it.
        let varies = |outcome: &Outcome| !matches!(outcome, Outcome::Same(_));
        if ready.steps.results.iter().any(varies) {
            for start in (0..self.count).step_by(R::CHUNK) {
                self.chunk(ready, start);
            }
        }
    }

    fn chunk(&mut self, ready: &mut Ready<R>, start: usize) {
        let count = (self.count - start).min(R::CHUNK);
        let whole = count == R::CHUNK;
        let Ready {
            steps,
            same,
            memory,
            ..
        } = ready;
        // Where a slot's values are: with the caller where the chunk is whole, so that nothing
        // is copied, else in memory of our own, where a tile may reach beyond the last point.
        let (mut usual, mut many) = ([std::ptr::null_mut(); USUAL_SLOTS], Vec::new());
        let slots: &mut [*mut R] = match usual.get_mut(..steps.slots.len()) {
            Some(usual) => usual,
            None => {
                many.resize(steps.slots.len(), std::ptr::null_mut());
                &mut many
            }
        };
        let own = memory.chunks().chunks_exact_mut(R::CHUNK);
        for ((place, slot), own) in slots.iter_mut().zip(&steps.slots).zip(own) {
            *place = match *slot {
                Slot::Temporary | Slot::Same(_) => own.as_mut_ptr(),
                Slot::Input(input) => match self.columns[input] {
                    // Only read from: an input's slot is never one that is stored to.
                    Column::Varying(values) if whole => values[start..].as_ptr().cast_mut(),
                    Column::Varying(values) => {
                        own[..count].copy_from_slice(&values[start..start + count]);
                        own.as_mut_ptr()
                    }
                    Column::Uniform(_) => own.as_mut_ptr(),
                },
                Slot::Result(result) => match self.outs.get_mut(result) {
                    Some(out) if whole && out.len() >= start + count => out[start..].as_mut_ptr(),
                    _ => own.as_mut_ptr(),
                },
            };
        }
        let slots = &*slots;
        let at = |slot: usize| slots[slot];
        for step in &steps.steps {
            // SAFETY: every slot points to a chunk of values: inputs, results and memory of our
            // own, none of which overlap; slots and values are numbered by the planner. A step
            // reads and writes different slots, as the planner takes care.
            unsafe {
                match step {
                    Step::Run(code) => R::run(self.isa, code, slots, same, count),
                    Step::Unary(function, from, to) => {
                        let (from, to) = (slice(at(*from), count), slice_mut(at(*to), count));
                        for (to, from) in to.iter_mut().zip(from) {
                            *to = from.unary(*function);
                        }
                    }
                    Step::Pow(base, exponent, to) => {
                        let (base, exponent) =
                            (slice(at(*base), count), slice(at(*exponent), count));
                        let to = slice_mut(at(*to), count);
                        for ((to, base), exponent) in to.iter_mut().zip(base).zip(exponent) {
                            *to = base.pow(*exponent);
                        }
                    }
                    Step::Term(term, args, to) => {
                        // Of what is the same everywhere one value may do.
                        let one = steps.of_material(term.0, args);
                        let arg = |(slot, param): (&usize, &brdf::Param)| {
                            let one = one && param.is_of_material();
                            slice(at(*slot), if one { 1 } else { count })
                        };
                        let to = slice_mut(at(*to), count);
                        let args = args.iter().zip(term.0.params).map(arg);
                        let mut usual: [&[R]; USUAL_ARGS] = [&[]; USUAL_ARGS];
                        match usual.get_mut(..args.len()) {
                            Some(usual) => {
                                usual.iter_mut().zip(args).for_each(|(to, arg)| *to = arg);
                                R::term_block(term.0, self.isa, usual, to);
                            }
                            None => {
                                R::term_block(term.0, self.isa, &args.collect::<Vec<_>>(), to);
                            }
                        }
                    }
                }
            }
        }
        for (out, outcome) in self.outs.iter_mut().zip(&steps.results) {
            let end = out.len().min(start + count);
            if let (Outcome::Held(slot), Some(out)) = (outcome, out.get_mut(start..end))
                && !std::ptr::eq(at(*slot), out.as_ptr())
            {
                // SAFETY: as above; what a slice already holds is not copied onto itself.
                out.copy_from_slice(unsafe { slice(at(*slot), out.len()) });
            }
        }
    }
}

/// Equal, or the same NaN.
fn same_bits<R: Real>(a: R, b: R) -> bool {
    a.to_f64().to_bits() == b.to_f64().to_bits()
}

/// # Safety
/// There are `count` values, and nobody writes to them meanwhile.
unsafe fn slice<'a, R>(from: *mut R, count: usize) -> &'a [R] {
    // SAFETY: as promised.
    unsafe { std::slice::from_raw_parts(from, count) }
}

/// # Safety
/// There are `count` values, and nobody else uses them meanwhile.
unsafe fn slice_mut<'a, R>(from: *mut R, count: usize) -> &'a mut [R] {
    // SAFETY: as promised.
    unsafe { std::slice::from_raw_parts_mut(from, count) }
}
