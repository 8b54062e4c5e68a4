//! What of a picture must be computed: decided from the formulas, before anything is.

use crate::Fingerprint;
use crate::scene::{AZIMUTH, VARYING};
use formula::{Expr, Node, Program};
use std::collections::BTreeSet;

/// The decisions for one picture, and the reasons in words.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    /// Shade the upper half and copy it: with eye and light in one plane the lower half mirrors it.
    pub mirror: bool,
    /// Shade only pixels in the lit and visible part of the sphere.
    pub lens: bool,
    /// Evaluate calls that are constant over the picture beforehand.
    pub fold: bool,
    /// Fill the column of the azimuth.
    pub azimuth: bool,
    /// `wrong / right` after what both have in common has cancelled: the wrong value is then the
    /// right one times this.
    pub ratio: Option<Expr>,
    /// Calls evaluated at every point.
    pub evaluated: Vec<String>,
    /// Calls that are not, each with the reason.
    pub skipped: Vec<String>,
    /// Every decision as a sentence.
    pub explain: Vec<String>,
}

impl Plan {
    /// Everything is computed.
    fn nothing_skipped(fingerprint: &Fingerprint<'_>) -> Self {
        let (right, wrong) = (calls(fingerprint.right), calls(fingerprint.wrong));
        Self {
            evaluated: right.union(&wrong).cloned().collect(),
            azimuth: true,
            explain: vec!["nothing is skipped: every pixel, every term".to_owned()],
            ..Self::default()
        }
    }

    /// What the formulas allow to leave out.
    pub fn of(fingerprint: &Fingerprint<'_>, skip: bool) -> Self {
        if !skip {
            return Self::nothing_skipped(fingerprint);
        }
        let Fingerprint {
            library,
            right,
            wrong,
            ..
        } = fingerprint;
        let mut plan = Self {
            mirror: true,
            lens: true,
            fold: true,
            ..Self::default()
        };
        plan.azimuth = [right, wrong]
            .iter()
            .any(|expr| library.needs(expr).contains(AZIMUTH));
        plan.explain.push(
            "pixels that are outside the sphere or that no light reaches are not shaded".to_owned(),
        );
        plan.explain.push(
            "the lower half is copied from the upper: eye and light stand in the horizontal plane, so they mirror each other"
                .to_owned(),
        );
        plan.ratio = library.ratio(right, wrong).filter(|ratio| {
            // Worth it only where the ratio is less work than the wrong formula itself.
            let work = |expr: &Expr| program(fingerprint, expr).map(|program| program.ops());
            matches!((work(ratio), work(wrong)), (Ok(ratio), Ok(wrong)) if ratio < wrong)
        });
        let of_right = calls(right);
        let of_wrong = calls(plan.ratio.as_ref().unwrap_or(wrong));
        for call in of_right.union(&of_wrong) {
            let constant = formula::parse(call).is_ok_and(|expr| constant(fingerprint, &expr));
            if constant {
                plan.skipped.push(format!(
                    "{call}: the same over the whole picture, evaluated once"
                ));
            } else {
                plan.evaluated.push(call.clone());
            }
        }
        for call in calls(wrong).difference(&of_wrong) {
            plan.skipped.push(format!(
                "{call} of the buggy formula: cancels in buggy / correct"
            ));
        }
        if let Some(ratio) = &plan.ratio {
            plan.explain.push(format!(
                "the buggy value is the correct one times {}: what both have in common cancels",
                library.unicode(ratio)
            ));
        }
        plan.explain.extend(plan.skipped.iter().cloned());
        plan
    }
}

/// The calls of a formula as they are written, outermost only.
fn calls(formula: &Expr) -> BTreeSet<String> {
    fn collect(expr: &Expr, found: &mut BTreeSet<String>) {
        match &expr.node {
            Node::Number { .. } | Node::Name(_) => {}
            Node::Neg(inner) => collect(inner, found),
            Node::Binary { left, right, .. } | Node::Compare { left, right, .. } => {
                collect(left, found);
                collect(right, found);
            }
            Node::Call { .. } => {
                found.insert(expr.to_string());
            }
        }
    }
    let mut found = BTreeSet::new();
    collect(formula, &mut found);
    found
}

/// A formula of the fingerprint, compiled over what its scene gives.
pub(crate) fn program(
    fingerprint: &Fingerprint<'_>,
    expr: &Expr,
) -> Result<Program, formula::Error> {
    let constants = fingerprint.scene.constants();
    let inputs: Vec<&str> = VARYING
        .into_iter()
        .chain(constants.iter().map(|(name, _)| name.as_str()))
        .collect();
    fingerprint.library.compile(expr, &inputs)
}

/// The formula with its constant calls evaluated: a shader then holds their values, as the CPU's
/// program computes them once a block.
pub(crate) fn folded(fingerprint: &Fingerprint<'_>, expr: &Expr) -> Expr {
    let values = fingerprint.scene.constants().into_iter().collect();
    fold(fingerprint, expr, &values)
}

fn fold(fingerprint: &Fingerprint<'_>, expr: &Expr, values: &formula::Values) -> Expr {
    let inner = |expr: &Expr| Box::new(fold(fingerprint, expr, values));
    let node = match &expr.node {
        Node::Number { .. } | Node::Name(_) => return expr.clone(),
        Node::Call { .. } => {
            // A call that has no value, or varies, stays what it is.
            let value = match constant(fingerprint, expr) {
                true => fingerprint.library.eval(expr, values).ok(),
                false => None,
            };
            return value
                .filter(|value| value.is_finite())
                .map_or_else(|| expr.clone(), Expr::number);
        }
        Node::Neg(operand) => Node::Neg(inner(operand)),
        Node::Binary { op, left, right } => Node::Binary {
            op: *op,
            left: inner(left),
            right: inner(right),
        },
        Node::Compare { op, left, right } => Node::Compare {
            op: *op,
            left: inner(left),
            right: inner(right),
        },
    };
    Expr {
        node,
        span: expr.span,
    }
}

/// Whether a formula has one value over the whole picture.
fn constant(fingerprint: &Fingerprint<'_>, expr: &Expr) -> bool {
    !fingerprint
        .library
        .needs(expr)
        .iter()
        .any(|name| VARYING.contains(&name.as_str()))
}
