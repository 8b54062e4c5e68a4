//! Evaluation of a program over a block of points, chunk by chunk: a chunk's values stay in the
//! nearest cache from the first step to the last.

use crate::code::Operand;
use crate::dag::Id;
use crate::eval::{Real, apply};
use crate::machine::{Machine, Placed};
use crate::memory::Memory;
use crate::program::{Column, Operations};
use crate::steps::{Outcome, Slot, Step, Steps};
use brdf::batch::Isa;
use std::ops::Range;
use std::sync::Arc;

/// Programs whose steps are kept.
const KEPT: usize = 8;

/// Arguments of a function, for which no memory is asked for.
const USUAL_ARGS: usize = 8;

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
    /// Where each slot's values are, and what is parked.
    slots: Vec<*mut R>,
    parked: *mut R,
    /// The code of the runs, in their order; and which operands are with the caller.
    runs: Vec<Vec<Placed<R>>>,
    moving: Vec<Moving>,
    /// Whether inputs and results are all the memory that is needed.
    in_place: bool,
    /// Half a tile.
    middle: usize,
}

/// An operand in an input or a result: which run and instruction, whether it is the second one,
/// and the slot.
#[derive(Debug)]
struct Moving {
    run: usize,
    instr: usize,
    second: bool,
    slot: usize,
}

// SAFETY: it points to its own memory, or to what it was given for the evaluation under way, for
// which it is borrowed mutably.
unsafe impl<R: Send> Send for Ready<R> {}
// SAFETY: as above; of a shared one nothing is read.
unsafe impl<R: Sync> Sync for Ready<R> {}

impl<R: Machine> Ready<R> {
    fn new(operations: &Arc<Operations>, columns: &Columns<'_, R>, isa: Isa) -> Self {
        let varying: Vec<bool> = (0..columns.inputs)
            .map(|input| matches!(columns.at(input), Column::Varying(_)))
            .collect();
        let steps = Steps::new(&operations.ops, &operations.roots, &varying);
        // One chunk a slot, whether it is needed or the caller's own memory is used, and one for
        // what is parked.
        let memory = Memory::new(steps.slots.len() + 1);
        let mut ready = Ready {
            operations: operations.clone(),
            varying,
            slots: (0..steps.slots.len())
                .map(|slot| memory.chunk(slot))
                .collect(),
            parked: memory.chunk(steps.slots.len()),
            memory,
            constants: Vec::new(),
            same: vec![R::ZERO; operations.ops.len()],
            runs: Vec::new(),
            moving: Vec::new(),
            in_place: steps.in_place(),
            middle: R::tile(isa) / 2,
            steps,
        };
        ready.place();
        ready.fix(columns);
        ready
    }

    fn fits(&self, operations: &Arc<Operations>, columns: &Columns<'_, R>) -> bool {
        let varies = |input| matches!(columns.at(input), Column::Varying(_));
        Arc::ptr_eq(&self.operations, operations)
            && self.varying.len() == columns.inputs
            && self
                .varying
                .iter()
                .enumerate()
                .all(|(input, varying)| *varying == varies(input))
    }

    /// Puts pointers for numbers of slots.
    fn place(&mut self) {
        for step in &self.steps.steps {
            let Step::Run(code) = step else {
                continue;
            };
            let mut placed = Vec::with_capacity(code.len());
            for (index, instr) in code.iter().enumerate() {
                let mut pointer = |operand, second| match operand {
                    Operand::Slot(slot) => {
                        if let Slot::Input(_) | Slot::Result(_) = self.steps.slots[slot] {
                            self.moving.push(Moving {
                                run: self.runs.len(),
                                instr: index,
                                second,
                                slot,
                            });
                        }
                        self.slots[slot].wrapping_add(self.middle)
                    }
                    Operand::None | Operand::Same(_) => std::ptr::null_mut(),
                };
                placed.push(Placed {
                    code: instr.code,
                    power: instr.power,
                    value: R::ZERO,
                    at: pointer(instr.at, false),
                    with: pointer(instr.with, true),
                });
            }
            self.runs.push(placed);
        }
    }

    /// Computes what is the same at all points, unless it is what it was.
    fn fix(&mut self, columns: &Columns<'_, R>) {
        // A program without inputs has not been computed before the first time either.
        let known = columns.inputs > 0
            && self.constants.len() == columns.inputs
            && self
                .constants
                .iter()
                .enumerate()
                .all(|(input, known)| same_bits(*known, columns.constant(input)));
        if known {
            return;
        }
        self.constants.clear();
        self.constants
            .extend((0..columns.inputs).map(|input| columns.constant(input)));
        let ops = &self.operations.ops;
        for id in &self.steps.same {
            self.same[*id] = apply(&ops[*id], &self.constants, |id: Id| self.same[id]);
        }
        for (slot, pointer) in self.steps.slots.iter().zip(&self.slots) {
            if let Slot::Same(id) = slot {
                // SAFETY: the slot is a chunk of our own, and nobody else uses it.
                unsafe { slice_mut(*pointer, R::CHUNK) }.fill(self.same[*id]);
            }
        }
        let runs = self.steps.steps.iter().filter_map(|step| match step {
            Step::Run(code) => Some(code),
            _ => None,
        });
        for (code, placed) in runs.zip(&mut self.runs) {
            for (instr, placed) in code.iter().zip(placed) {
                if let Operand::Same(id) = instr.at {
                    placed.value = self.same[id];
                }
                if let Operand::Same(id) = instr.with {
                    placed.value = self.same[id];
                }
            }
        }
    }
}

/// The inputs of an evaluation.
struct Columns<'a, R> {
    given: &'a [Column<'a, R>],
    inputs: usize,
    count: usize,
}

impl<'a, R: Real> Columns<'a, R> {
    /// NaN where one is missing or too short.
    fn at(&self, input: usize) -> Column<'a, R> {
        match self.given.get(input) {
            Some(Column::Varying(values)) if values.len() >= self.count => Column::Varying(values),
            Some(Column::Uniform(value)) => Column::Uniform(*value),
            _ => Column::Uniform(R::of(f64::NAN)),
        }
    }

    fn constant(&self, input: usize) -> R {
        match self.at(input) {
            Column::Uniform(value) => value,
            Column::Varying(_) => R::of(f64::NAN),
        }
    }
}

/// What is to be evaluated.
pub(crate) struct Block<'a, 'o, R> {
    operations: &'a Arc<Operations>,
    columns: Columns<'a, R>,
    outs: &'a mut [&'o mut [R]],
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
        Block {
            operations,
            columns: Columns {
                given: columns,
                inputs,
                count,
            },
            outs,
            isa,
        }
    }

    pub fn run(mut self, blocks: &mut Blocks<R>) {
        let fits = |ready: &Ready<R>| ready.fits(self.operations, &self.columns);
        let known = blocks.ready.iter().position(fits);
        let index = known.unwrap_or_else(|| {
            if blocks.ready.len() == KEPT {
                blocks.ready.remove(0);
            }
            let ready = Ready::new(self.operations, &self.columns, self.isa);
            blocks.ready.push(ready);
            blocks.ready.len() - 1
        });
        let ready = &mut blocks.ready[index];
        ready.fix(&self.columns);
        for (out, outcome) in self.outs.iter_mut().zip(&ready.steps.results) {
            if let Outcome::Same(id) = outcome {
                out.fill(ready.same[*id]);
            }
        }
        // A root that nobody asked for takes no slice; the program still computes it.
        let varies = |outcome: &Outcome| !matches!(outcome, Outcome::Same(_));
        if ready.steps.results.iter().any(varies) {
            let (count, tile) = (self.columns.count, R::tile(self.isa));
            // What needs no memory of ours needs no chunks.
            let own = |out: &&mut [R]| out.len() < count;
            let missing = self.outs.len() < ready.steps.results.len();
            let chunk = match ready.in_place && !missing && !self.outs.iter().any(own) {
                true => count,
                false => even(count, tile, R::CHUNK),
            };
            for start in (0..count).step_by(chunk.max(1)) {
                let range = start..(start + chunk).min(count);
                self.place(ready, range.clone(), range.len() >= tile);
                self.chunk(ready, range);
            }
        }
    }

    /// Says where a chunk's values are: with the caller where there is a tile of them, so that
    /// nothing is copied, else in memory of our own.
    fn place(&mut self, ready: &mut Ready<R>, range: Range<usize>, whole: bool) {
        for (index, slot) in ready.steps.slots.iter().enumerate() {
            ready.slots[index] = match *slot {
                Slot::Temporary | Slot::Same(_) => continue,
                // Only read from: an input's slot is never one that is stored to.
                Slot::Input(input) => match self.columns.at(input) {
                    Column::Varying(values) if whole => values[range.start..].as_ptr().cast_mut(),
                    Column::Varying(values) => {
                        let own = ready.memory.chunk(index);
                        // SAFETY: a chunk of our own has room for them, and nobody else uses it.
                        unsafe { slice_mut(own, range.len()) }
                            .copy_from_slice(&values[range.clone()]);
                        own
                    }
                    Column::Uniform(_) => ready.memory.chunk(index),
                },
                Slot::Result(result) => match self.outs.get_mut(result) {
                    Some(out) if whole && out.len() >= range.end => out[range.start..].as_mut_ptr(),
                    _ => ready.memory.chunk(index),
                },
            };
        }
        for moving in &ready.moving {
            let placed = &mut ready.runs[moving.run][moving.instr];
            let operand = match moving.second {
                false => &mut placed.at,
                true => &mut placed.with,
            };
            *operand = ready.slots[moving.slot].wrapping_add(ready.middle);
        }
    }

    fn chunk(&mut self, ready: &Ready<R>, range: Range<usize>) {
        let count = range.len();
        let at = |slot: usize| ready.slots[slot];
        let mut runs = ready.runs.iter();
        for step in &ready.steps.steps {
            // SAFETY: every slot points to a chunk of values: inputs, results and memory of our
            // own, none of which overlap; they are numbered by the planner. A step reads and
            // writes different slots, as the planner takes care.
            unsafe {
                match step {
                    Step::Run(_) => {
                        if let Some(code) = runs.next() {
                            R::run(self.isa, code, ready.parked, count);
                        }
                    }
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
                        let one = ready.steps.of_material(term.0, args);
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
        for (out, outcome) in self.outs.iter_mut().zip(&ready.steps.results) {
            let end = out.len().min(range.end);
            if let (Outcome::Held(slot), Some(out)) = (outcome, out.get_mut(range.start..end))
                && !std::ptr::eq(at(*slot), out.as_ptr())
            {
                // SAFETY: as above; what a slice already holds is not copied onto itself.
                out.copy_from_slice(unsafe { slice(at(*slot), out.len()) });
            }
        }
    }
}

/// The length of chunks of about the same size, in whole tiles.
fn even(count: usize, tile: usize, most: usize) -> usize {
    let chunks = count.div_ceil(most).max(1);
    count.div_ceil(chunks).next_multiple_of(tile).min(most)
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
