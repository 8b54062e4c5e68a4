//! Both formulas on the CPU, in f64, a block of points at a time.

use crate::Fingerprint;
use crate::error::Error;
use crate::plan::{Plan, program, settled};
use crate::sample::{Input, Samples};
use crate::shade::Values;
use formula::{Column, Expr, Program, Scratch};
use std::cell::RefCell;

/// Points evaluated at once: some dozens of columns of this length fit in a core's cache.
const BLOCK: usize = 1024;

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::new());
}

/// Both formulas compiled for one scene.
pub(crate) struct Cpu {
    right: Program,
    second: Second,
    constants: Vec<f64>,
}

/// Where the wrong value comes from.
enum Second {
    /// Its own formula.
    Wrong(Program),
    /// The right value times this.
    Ratio(Program),
}

impl Cpu {
    pub fn new(fingerprint: &Fingerprint<'_>, plan: &Plan) -> Result<Self, Error> {
        fingerprint.scene.check()?;
        let compile = |which, expr: &Expr| {
            let expr = match plan.fold {
                true => settled(fingerprint, expr),
                false => expr.clone(),
            };
            program(fingerprint, &expr).map_err(|error| Error::Formula { which, error })
        };
        let right = compile("right", fingerprint.right)?;
        let wrong = compile("wrong", fingerprint.wrong)?;
        Ok(Self {
            right,
            second: match &plan.ratio {
                Some(ratio) => Second::Ratio(compile("wrong", ratio)?),
                None => Second::Wrong(wrong),
            },
            constants: fingerprint
                .scene
                .constants()
                .into_iter()
                .map(|(_, value)| value)
                .collect(),
        })
    }

    pub fn evaluate(&self, samples: &Samples) -> Values {
        let count = samples.len();
        let mut right = vec![0.0; count];
        let mut second = vec![0.0; count];
        let program = match &self.second {
            Second::Wrong(program) | Second::Ratio(program) => program,
        };
        for start in (0..count).step_by(BLOCK) {
            let range = start..(start + BLOCK).min(count);
            let columns: Vec<Column<'_, f64>> = samples
                .inputs(&range)
                .into_iter()
                .map(|input| match input {
                    Input::Uniform(value) => Column::Uniform(value),
                    Input::Varying(values) => Column::Varying(values),
                })
                .chain(self.constants.iter().map(|&value| Column::Uniform(value)))
                .collect();
            SCRATCH.with_borrow_mut(|scratch| {
                self.right
                    .eval_block_f64(&columns, &mut right[range.clone()], scratch);
                program.eval_block_f64(&columns, &mut second[range.clone()], scratch);
            });
        }
        match &self.second {
            Second::Wrong(_) => Values::of_both(right, second),
            Second::Ratio(_) => Values::of_ratio(right, second),
        }
    }
}
