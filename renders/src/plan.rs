//! What of a picture must be computed: decided from the formulas, before anything is.

use crate::Fingerprint;
use crate::geometry::Geometry;
use crate::own::Own;
use crate::scene::{VARYING, column};
use formula::{Expr, Node, Program};
use std::collections::BTreeSet;

/// How the sentence about the half that is copied begins.
const MIRRORED: &str = "the lower half is copied from the upper";

/// The decisions for one picture, and the reasons in words.
#[derive(Clone, Debug, Default)]
pub(crate) struct Plan {
    /// Shade the upper half and copy it: with eye and lights in one plane the lower half mirrors
    /// it.
    pub mirror: bool,
    /// Shade the left half and copy it, where the plane is upright.
    pub half: bool,
    /// Shade only pixels in the lit and visible part of the sphere.
    pub lens: bool,
    /// Evaluate calls that are constant over the picture beforehand.
    pub fold: bool,
    /// The lights that are shaded, by their places in the scene.
    pub lights: Vec<usize>,
    /// The columns of [`VARYING`] that have a value for each point.
    pub columns: [bool; VARYING.len()],
    /// The columns of [`VARYING`] that a shader is given: it knows the others as constants, or
    /// does not need them.
    pub uploaded: [bool; VARYING.len()],
    /// `wrong / right` after what both have in common has cancelled: the wrong value is then the
    /// right one times this.
    pub ratio: Option<Expr>,
    /// What stands for the wrong formula, where that is none.
    pub own: Option<Own>,
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
            lights: (0..fingerprint.scene.lights.len()).collect(),
            columns: [true; VARYING.len()],
            uploaded: [true; VARYING.len()],
            explain: vec!["nothing is skipped: every pixel, every light, every term".to_owned()],
            ..Self::default()
        }
    }

    /// What the formulas and the scene allow to leave out.
    pub fn of(fingerprint: &Fingerprint<'_>, skip: bool) -> Self {
        if !skip {
            return Self::nothing_skipped(fingerprint);
        }
        let mut plan = Self {
            lens: true,
            fold: true,
            ..Self::default()
        };
        plan.choose_pixels(fingerprint);
        plan.choose_terms(fingerprint);
        plan.choose_columns(fingerprint);
        plan
    }

    /// What the formulas alone allow to leave out, whatever scene they are drawn in: lights,
    /// columns and what mirrors are chosen for each scene.
    pub fn of_any_scene(fingerprint: &Fingerprint<'_>) -> Self {
        Self {
            lens: true,
            ratio: cheaper_ratio(fingerprint),
            ..Self::default()
        }
    }

    /// Lights that reach nothing, pixels that are not lit, and the half that mirrors the other.
    fn choose_pixels(&mut self, fingerprint: &Fingerprint<'_>) {
        let scene = &fingerprint.scene;
        let geometries = scene.geometries();
        for (index, (light, geometry)) in scene.lights.iter().zip(&geometries).enumerate() {
            let name = index + 1;
            if light.weights() == [0.0; 3] {
                self.explain
                    .push(format!("light {name} is not shaded: it gives no light"));
            } else if !geometry.reaches() {
                self.explain.push(format!(
                    "light {name} is not shaded: it stands behind the sphere and reaches nothing that is seen"
                ));
            } else {
                self.lights.push(index);
            }
        }
        let several = self.lights.len() > 1;
        self.explain.push(match several {
            false => "pixels that are outside the sphere or that no light reaches are not shaded".to_owned(),
            true => "pixels that are outside the sphere are not shaded, and for each light those that it does not reach"
                .to_owned(),
        });
        if self.lights.is_empty() {
            self.explain.push(
                "nothing is lit: no formula is evaluated, and no graphics processor is started"
                    .to_owned(),
            );
            return;
        }
        self.mirror = self
            .lights
            .iter()
            .all(|&light| geometries[light].is_level());
        let lit = || self.lights.iter().map(|&light| &geometries[light]);
        self.half = lit().all(Geometry::is_upright);
        let lights = if several { "lights" } else { "light" };
        if self.mirror {
            self.explain.push(format!(
                "{MIRRORED}: with eye and {lights} in the horizontal plane they mirror each other"
            ));
        }
        if self.half {
            self.explain.push(format!(
                "the right half is copied from the left: with eye and {lights} in the vertical plane they mirror each other"
            ));
        }
        if !self.mirror && !self.half && !several {
            self.explain.push(
                "both halves beside the light's direction are shaded, though they mirror each other: the mirror image of a pixel is no pixel unless the light is level or upright"
                    .to_owned(),
            );
        }
    }

    /// Shades both halves, for this reason.
    pub fn no_mirror(&mut self, why: &str) {
        if self.mirror {
            self.mirror = false;
            self.explain.retain(|line| !line.starts_with(MIRRORED));
            self.explain.push(format!(
                "the lower half is shaded too, though it mirrors the upper: {why}"
            ));
        }
    }

    /// What cancels in buggy / correct, and what is constant.
    fn choose_terms(&mut self, fingerprint: &Fingerprint<'_>) {
        let Fingerprint {
            library,
            right,
            wrong,
            ..
        } = fingerprint;
        self.ratio = cheaper_ratio(fingerprint);
        let of_right = calls(right);
        let of_wrong = calls(self.ratio.as_ref().unwrap_or(wrong));
        let same = fingerprint.scene.same();
        for call in of_right.union(&of_wrong) {
            let is =
                |same| formula::parse(call).is_ok_and(|expr| constant(fingerprint, &expr, same));
            if is(&same.everywhere) {
                self.skipped.push(format!(
                    "{call}: the same over the whole picture, evaluated once"
                ));
            } else if is(&same.a_light) {
                self.skipped.push(format!(
                    "{call}: the same over the whole picture under each light, evaluated once for each"
                ));
            } else {
                self.evaluated.push(call.clone());
            }
        }
        for call in calls(wrong).difference(&of_wrong) {
            self.skipped.push(format!(
                "{call} of the buggy formula: cancels in buggy / correct"
            ));
        }
        if let Some(ratio) = &self.ratio {
            self.explain.push(format!(
                "the buggy value is the correct one times {}: what both have in common cancels",
                library.unicode(ratio)
            ));
        }
        self.explain.extend(self.skipped.iter().cloned());
    }

    /// Which quantities have to be known at every point.
    fn choose_columns(&mut self, fingerprint: &Fingerprint<'_>) {
        let Fingerprint {
            library,
            right,
            wrong,
            ..
        } = fingerprint;
        let second = self.ratio.as_ref().unwrap_or(wrong);
        let mut needed = library.needs(&settled(fingerprint, right));
        needed.append(&mut library.needs(&settled(fingerprint, second)));
        let same = fingerprint.scene.same();
        for (index, name) in VARYING.iter().enumerate() {
            let needed = needed.contains(*name);
            self.columns[index] = needed && !same.a_light[index];
            self.uploaded[index] = needed && !same.everywhere[index];
        }
    }
}

/// `wrong / right` with what both have in common cancelled, where that is less work than the
/// wrong formula itself.
fn cheaper_ratio(fingerprint: &Fingerprint<'_>) -> Option<Expr> {
    let Fingerprint {
        library,
        right,
        wrong,
        ..
    } = fingerprint;
    let work = |expr: &Expr| program(fingerprint, expr).map(|program| program.ops());
    library.ratio(right, wrong).filter(
        |ratio| matches!((work(ratio), work(wrong)), (Ok(ratio), Ok(wrong)) if ratio < wrong),
    )
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
    fingerprint.library.compile(expr, &inputs(&constants))
}

/// The names of a formula's inputs: what varies, then the scene's constants.
pub(crate) fn inputs(constants: &[(String, f64)]) -> Vec<&str> {
    let names = constants.iter().map(|(name, _)| name.as_str());
    VARYING.into_iter().chain(names).collect()
}

/// The formula with its constant calls evaluated: a shader then holds their values, as the CPU's
/// program computes them once a block.
pub(crate) fn folded(fingerprint: &Fingerprint<'_>, expr: &Expr) -> Expr {
    let same = fingerprint.scene.same().everywhere;
    fold(fingerprint, expr, &|call| {
        constant(fingerprint, call, &same)
    })
}

/// The formula with those calls evaluated that take in what varies and do not depend on it, as D
/// does not at roughness 1.
pub(crate) fn settled(fingerprint: &Fingerprint<'_>, expr: &Expr) -> Expr {
    let drops_out = |call: &Expr| {
        let takes_in = fingerprint.library.needs(call);
        VARYING.iter().any(|name| takes_in.contains(*name))
            && constant(fingerprint, call, &[false; VARYING.len()])
    };
    fold(fingerprint, expr, &drops_out)
}

/// The values of those of [`VARYING`] that may be the same everywhere.
pub(crate) fn of_main_light(fingerprint: &Fingerprint<'_>) -> [(usize, f64); 3] {
    let geometry = fingerprint.scene.geometry();
    let (v_dot_h, l_dot_v) = geometry.of_distant();
    [
        (column::V_DOT_H, v_dot_h),
        (column::L_DOT_V, l_dot_v),
        (column::LIGHT_DEG, geometry.light_deg),
    ]
}

/// The formula with the values of some of its calls.
fn fold(fingerprint: &Fingerprint<'_>, expr: &Expr, known: &dyn Fn(&Expr) -> bool) -> Expr {
    let inner = |expr: &Expr| Box::new(fold(fingerprint, expr, known));
    let node = match &expr.node {
        Node::Number { .. } | Node::Name(_) => return expr.clone(),
        Node::Call { .. } => {
            // A call that has no value, or varies, stays what it is.
            let value = match known(expr) {
                true => fingerprint.library.eval(expr, &values(fingerprint)).ok(),
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

/// What a constant call is computed from: what varies may have any value there.
fn values(fingerprint: &Fingerprint<'_>) -> formula::Values {
    let anything = VARYING.iter().map(|name| ((*name).to_owned(), 0.5));
    let mut values: formula::Values = anything.collect();
    values.extend(fingerprint.scene.constants());
    for (index, value) in of_main_light(fingerprint) {
        values.insert(VARYING[index].to_owned(), value);
    }
    values
}

/// Whether a formula has one value wherever `same` of [`VARYING`] have one.
fn constant(fingerprint: &Fingerprint<'_>, expr: &Expr, same: &[bool; VARYING.len()]) -> bool {
    let known = fingerprint.scene.constants().into_iter().collect();
    !fingerprint
        .library
        .depends(expr, &known)
        .iter()
        .any(|name| {
            let place = VARYING.iter().position(|varying| varying == name);
            place.is_some_and(|index| !same[index])
        })
}
