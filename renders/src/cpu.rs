//! Both formulas on the CPU, in f64, a block of points at a time.

use crate::Fingerprint;
use crate::error::Error;
use crate::sample::Samples;
use crate::scene::{Scene, VARYING};
use crate::shade::Values;
use formula::{Column, Expr, Library, Program, Scratch};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Points evaluated at once: some dozens of columns of this length fit in a core's cache.
const BLOCK: usize = 1024;

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::new());
}

/// Both formulas compiled for one scene.
pub(crate) struct Cpu {
    right: Program,
    wrong: Program,
    constants: Vec<f64>,
}

impl Cpu {
    pub fn new(
        library: &Library,
        right: &Expr,
        wrong: &Expr,
        scene: &Scene,
    ) -> Result<Self, Error> {
        let constants = scene.constants();
        let inputs: Vec<&str> = VARYING
            .into_iter()
            .chain(constants.iter().map(|(name, _)| name.as_str()))
            .collect();
        let compile = |which, expr| {
            library
                .compile(expr, &inputs)
                .map_err(|error| Error::Formula { which, error })
        };
        Ok(Self {
            right: compile("right", right)?,
            wrong: compile("wrong", wrong)?,
            constants: constants.iter().map(|(_, value)| *value).collect(),
        })
    }

    pub fn evaluate(&self, samples: &Samples) -> Values {
        let count = samples.len();
        let mut values = Values {
            right: vec![0.0; count],
            wrong: vec![0.0; count],
        };
        for start in (0..count).step_by(BLOCK) {
            let range = start..(start + BLOCK).min(count);
            let columns: Vec<Column<'_, f64>> = [
                &samples.n_dot_l,
                &samples.n_dot_v,
                &samples.n_dot_h,
                &samples.cos_phi,
            ]
            .into_iter()
            .map(|column| Column::Varying(&column[range.clone()]))
            .chain(self.constants.iter().map(|&value| Column::Uniform(value)))
            .collect();
            SCRATCH.with_borrow_mut(|scratch| {
                self.right
                    .eval_block_f64(&columns, &mut values.right[range.clone()], scratch);
                self.wrong
                    .eval_block_f64(&columns, &mut values.wrong[range.clone()], scratch);
            });
        }
        values
    }
}

/// The calls of both formulas: those that change from point to point, and those that do not,
/// each with the reason why it is evaluated only once.
pub(crate) fn terms(fingerprint: &Fingerprint<'_>) -> (Vec<String>, Vec<String>) {
    let mut calls = BTreeSet::new();
    for expr in [fingerprint.right, fingerprint.wrong] {
        collect(expr, &mut calls);
    }
    let mut evaluated = Vec::new();
    let mut skipped = Vec::new();
    for call in calls {
        let needs = match formula::parse(&call) {
            Ok(expr) => fingerprint.library.needs(&expr),
            Err(_) => continue,
        };
        if VARYING.iter().any(|name| needs.contains(*name)) {
            evaluated.push(call);
        } else {
            skipped.push(format!("{call}: constant over the picture"));
        }
    }
    (evaluated, skipped)
}

/// Calls as they are written, outermost only.
fn collect(expr: &Expr, calls: &mut BTreeSet<String>) {
    use formula::Node;
    match &expr.node {
        Node::Number { .. } | Node::Name(_) => {}
        Node::Neg(inner) => collect(inner, calls),
        Node::Binary { left, right, .. } | Node::Compare { left, right, .. } => {
            collect(left, calls);
            collect(right, calls);
        }
        Node::Call { .. } => {
            calls.insert(expr.to_string());
        }
    }
}
