//! Both formulas on the CPU, in f64 or f32, a block of points at a time.

use crate::error::Error;
use crate::own::Own;
use crate::plan::{Plan, inputs, settled};
use crate::sample::{Input, Samples};
use crate::shade::Values;
use crate::{Fingerprint, Precision, Scene};
use formula::{Column, Expr, Program, Scratch};
use std::cell::RefCell;

/// Points evaluated at once: some dozens of columns of this length fit in a core's cache.
const BLOCK: usize = 1024;

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::new());
    static NARROW: RefCell<Vec<f32>> = const { RefCell::new(Vec::new()) };
}

/// Both formulas compiled for one scene, into one program: what they share is computed once.
#[derive(Clone)]
pub(crate) struct Cpu {
    program: Program,
    /// The second value is the wrong one over the right one.
    second_is_ratio: bool,
    /// The scene's constants, and what they are called.
    constants: Vec<f64>,
    names: Vec<String>,
    precision: Precision,
    /// What stands for the wrong formula, and where its parameters stand among the inputs.
    own: Option<(Own, Vec<usize>)>,
}

impl Cpu {
    pub fn new(
        fingerprint: &Fingerprint<'_>,
        plan: &Plan,
        precision: Precision,
    ) -> Result<Self, Error> {
        fingerprint.scene.check()?;
        let Fingerprint {
            library,
            right,
            wrong,
            scene,
            ..
        } = fingerprint;
        let constants = scene.constants();
        let inputs = inputs(&constants);
        // One by one, so that an error says which of them it is in.
        for (which, expr) in [("right", right), ("wrong", wrong)] {
            let compiled = library.compile(expr, &inputs);
            compiled.map_err(|error| Error::Formula { which, error })?;
        }
        let folded = |expr: &Expr| match plan.fold {
            true => settled(fingerprint, expr),
            false => expr.clone(),
        };
        let (right, second) = (folded(right), folded(plan.ratio.as_ref().unwrap_or(wrong)));
        let program = library.compile_all(&[&right, &second], &inputs);
        let own = plan.own.clone();
        let own = own.map(|own| own.places(&inputs).map(|places| (own, places)));
        Ok(Self {
            program: program.map_err(|error| Error::Formula {
                which: "wrong",
                error,
            })?,
            second_is_ratio: plan.ratio.is_some(),
            constants: constants.iter().map(|(_, value)| *value).collect(),
            names: constants.into_iter().map(|(name, _)| name).collect(),
            precision: match own {
                None => precision,
                Some(_) => Precision::F64,
            },
            own: own.transpose()?,
        })
    }

    /// Takes the constants of another scene, where they are the same by name. Only for a plan that
    /// folds nothing: what was folded holds the first scene's values.
    pub fn take_over(&mut self, scene: &Scene) -> Result<(), Error> {
        let constants = scene.constants();
        if !constants.iter().map(|(name, _)| name).eq(&self.names) {
            return Err(Error::Scene(
                "its givens are not those that the formulas were prepared for".to_owned(),
            ));
        }
        self.constants.clear();
        self.constants
            .extend(constants.into_iter().map(|(_, value)| value));
        Ok(())
    }

    pub fn evaluate(&self, samples: &Samples) -> Values {
        let mut values = Values::default();
        self.evaluate_into(samples, &mut values);
        values
    }

    /// The same into memory that is there already.
    pub fn evaluate_into(&self, samples: &Samples, values: &mut Values) {
        let count = samples.len();
        values.resize(count);
        let Values {
            right,
            wrong,
            ratio,
        } = values;
        let second = match self.second_is_ratio {
            true => ratio,
            false => wrong,
        };
        for start in (0..count).step_by(BLOCK) {
            let range = start..(start + BLOCK).min(count);
            let inputs = samples.inputs(&range);
            let outs = [&mut right[range.clone()], &mut second[range]];
            SCRATCH.with_borrow_mut(|scratch| match self.precision {
                Precision::F64 => self.block(&inputs, outs, scratch),
                Precision::F32 => self.narrow_block(&inputs, outs, scratch),
            });
        }
        match self.second_is_ratio {
            true => values.multiply(),
            false => values.divide(),
        }
    }

    fn block(&self, inputs: &[Input<'_>], mut outs: [&mut [f64]; 2], scratch: &mut Scratch) {
        let columns = inputs.iter().map(|input| match input {
            Input::Uniform(value) => Column::Uniform(*value),
            Input::Varying(values) => Column::Varying(values),
        });
        let constants = self.constants.iter().map(|&value| Column::Uniform(value));
        let columns: Vec<Column<'_, f64>> = columns.chain(constants).collect();
        self.program.eval_blocks_f64(&columns, &mut outs, scratch);
        if let Some((own, places)) = &self.own {
            own.evaluate(places, &columns, outs[1]);
        }
    }

    /// The same with every operation in f32.
    fn narrow_block(&self, inputs: &[Input<'_>], outs: [&mut [f64]; 2], scratch: &mut Scratch) {
        let count = outs[0].len();
        NARROW.with_borrow_mut(|memory| {
            memory.resize((inputs.len() + outs.len()) * count, 0.0);
            let (values, results) = memory.split_at_mut(inputs.len() * count);
            for (narrow, input) in values.chunks_exact_mut(count).zip(inputs) {
                if let Input::Varying(wide) = input {
                    for (narrow, wide) in narrow.iter_mut().zip(*wide) {
                        *narrow = *wide as f32;
                    }
                }
            }
            let columns = inputs.iter().zip(values.chunks_exact(count));
            let columns = columns.map(|(input, narrow)| match input {
                Input::Uniform(value) => Column::Uniform(*value as f32),
                Input::Varying(_) => Column::Varying(narrow),
            });
            let constants = self.constants.iter();
            let constants = constants.map(|&value| Column::Uniform(value as f32));
            let columns: Vec<Column<'_, f32>> = columns.chain(constants).collect();
            let (right, second) = results.split_at_mut(count);
            let mut narrow_outs = [&mut *right, &mut *second];
            self.program
                .eval_blocks_f32(&columns, &mut narrow_outs, scratch);
            for (out, narrow) in outs.into_iter().zip([right, second]) {
                for (out, narrow) in out.iter_mut().zip(narrow) {
                    *out = f64::from(*narrow);
                }
            }
        });
    }
}
