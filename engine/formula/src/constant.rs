//! On which of its givens a formula depends once some of them have values: at roughness 1 GGX's
//! D is 1/π in every direction, and a mirror with F0 = 1 has F = 1 at every angle.

use crate::dag::{Dag, Op};
use crate::eval::apply;
use crate::expr::Expr;
use crate::library::{Library, Values};
use std::collections::BTreeSet;

/// Terms of the core that are the same for all of their other arguments when one of them has
/// this value, in the upper hemisphere; and a diffuse lobe keeps its albedo.
const DEGENERATE: [(&str, &str, f64); 6] = [
    ("d_ggx", "alpha", 1.0),
    ("d_blinn_phong", "alpha", 1.0),
    ("f_schlick", "f0", 1.0),
    ("f_spherical_gaussian", "f0", 1.0),
    ("diffuse_oren_nayar", "sigma", 0.0),
    ("diffuse_oren_nayar_full", "sigma", 0.0),
];

/// Arguments that still count where a term of [`DEGENERATE`] is the same for all others.
const KEPT: [&str; 1] = ["albedo"];

/// What is known of one operation.
#[derive(Clone, Debug)]
enum Known {
    Value(f64),
    /// The inputs it depends on, and whether it is finite wherever they are.
    Varies(BTreeSet<usize>, bool),
}

impl Known {
    fn value(&self) -> Option<f64> {
        match self {
            Known::Value(value) => Some(*value),
            Known::Varies(..) => None,
        }
    }

    fn finite(&self) -> bool {
        match self {
            Known::Value(value) => value.is_finite(),
            Known::Varies(_, finite) => *finite,
        }
    }
}

impl Library {
    /// The givens on which the value of `expr` depends where `known` have these values: those
    /// of [`Library::needs`] without the known ones, and without those that drop out. The others
    /// are taken to be finite, and cosines in (0, 1].
    ///
    /// All that [`Library::needs`] says, where the expression cannot be read.
    pub fn depends(&self, expr: &Expr, known: &Values) -> BTreeSet<String> {
        let Ok(dag) = self.lower(expr, None) else {
            return self.needs(expr);
        };
        match dag.known(known).get(dag.root) {
            Some(Known::Varies(inputs, _)) => inputs
                .iter()
                .map(|index| dag.inputs[*index].clone())
                .collect(),
            _ => BTreeSet::new(),
        }
    }
}

impl Dag {
    fn known(&self, givens: &Values) -> Vec<Known> {
        let mut all: Vec<Known> = Vec::with_capacity(self.ops.len());
        for op in &self.ops {
            let known = match op {
                Op::Input(index) => match givens.get(&self.inputs[*index]) {
                    Some(value) => Known::Value(*value),
                    None => Known::Varies(BTreeSet::from([*index]), true),
                },
                op => of_operation(op, &all),
            };
            all.push(known);
        }
        all
    }
}

fn of_operation(op: &Op, all: &[Known]) -> Known {
    let operands = op.operands();
    if operands.iter().all(|id| all[*id].value().is_some()) {
        let value = |id: usize| all[id].value().unwrap_or(f64::NAN);
        return Known::Value(apply(op, &[] as &[f64], value));
    }
    let finite = operands.iter().all(|id| all[*id].finite());
    let is = |id: usize, value: f64| all[id].value() == Some(value);
    let whole = |keep: &dyn Fn(usize) -> bool| {
        let kept = operands
            .iter()
            .enumerate()
            .filter(|(place, _)| keep(*place));
        kept.fold(BTreeSet::new(), |mut inputs, (_, id)| {
            if let Known::Varies(own, _) = &all[*id] {
                inputs.extend(own);
            }
            inputs
        })
    };
    match op {
        Op::Mul(a, b) if finite && (is(*a, 0.0) || is(*b, 0.0)) => Known::Value(0.0),
        Op::PowInt(_, 0) if finite => Known::Value(1.0),
        Op::Pow(a, b) if finite && (is(*a, 1.0) || is(*b, 0.0)) => Known::Value(1.0),
        Op::Neg(_) | Op::Add(..) | Op::Sub(..) | Op::Mul(..) | Op::Min(..) | Op::Max(..) => {
            Known::Varies(whole(&|_| true), finite)
        }
        Op::PowInt(_, power) => Known::Varies(whole(&|_| true), finite && *power > 0),
        Op::Term(term, args) => {
            let params = &term.0.params;
            let degenerate = DEGENERATE.iter().any(|(name, param, value)| {
                let place = params.iter().position(|it| it.name == *param);
                *name == term.0.name && place.is_some_and(|place| is(args[place], *value))
            });
            let kept = |place: usize| {
                !degenerate
                    || params
                        .get(place)
                        .is_none_or(|param| KEPT.contains(&param.name))
            };
            let inputs = whole(&kept);
            match inputs.is_empty() {
                // Its value, with anything in the place of what does not count.
                true => Known::Value(apply(op, &[] as &[f64], |id| {
                    all[id].value().unwrap_or(0.5)
                })),
                false => Known::Varies(inputs, false),
            }
        }
        _ => Known::Varies(whole(&|_| true), false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, known: &[(&str, f64)], expected: &[&str]) {
        let mut library = Library::new();
        library
            .define(
                "d",
                &["n_dot_h", "alpha"],
                "alpha^2 / (pi * (n_dot_h^2 * (alpha^2 - 1) + 1)^2)",
            )
            .expect("a definition");
        let expr = crate::parse(text).expect(text);
        let known = known
            .iter()
            .map(|(name, value)| (name.to_string(), *value))
            .collect();
        let found = library.depends(&expr, &known);
        assert_eq!(
            found.iter().map(String::as_str).collect::<Vec<_>>(),
            expected,
            "{text}"
        );
    }

    #[test]
    fn what_drops_out_is_no_given() {
        check("d_ggx()", &[("alpha", 1.0)], &[]);
        check("d_ggx()", &[("alpha", 0.9)], &["n_dot_h"]);
        check("d_ggx()", &[("roughness", 1.0), ("alpha", 1.0)], &[]);
        check("d()", &[("roughness", 1.0), ("alpha", 1.0)], &[]);
        check("d()", &[("roughness", 0.5), ("alpha", 0.25)], &["n_dot_h"]);
        check(
            "v_ggx()",
            &[("roughness", 1.0), ("alpha", 1.0)],
            &["n_dot_l", "n_dot_v"],
        );
        check("f_schlick()", &[("f0", 1.0)], &[]);
        check("f_schlick() * n_dot_l", &[("f0", 1.0)], &["n_dot_l"]);
        check("diffuse_oren_nayar(sigma = 0)", &[], &["albedo"]);
        check("diffuse_oren_nayar(sigma = 0)", &[("albedo", 0.5)], &[]);
        check("n_dot_l ^ a", &[("a", 0.0)], &[]);
        // Nothing times infinity is not nothing.
        check("a / n_dot_l", &[("a", 0.0)], &["n_dot_l"]);
        check("a * (1 / n_dot_l)", &[("a", 0.0)], &["n_dot_l"]);
    }

    #[test]
    fn degenerate_terms_are_the_same_at_every_point() {
        for (name, param, value) in DEGENERATE {
            let term = brdf::term(name).expect(name);
            let at = |share: f64| {
                let args: Vec<f64> = term
                    .params
                    .iter()
                    .map(|it| match it.name {
                        it if it == param => value,
                        it if KEPT.contains(&it) => 0.5,
                        _ => share,
                    })
                    .collect();
                let call = format!(
                    "{name}({})",
                    std::iter::zip(term.params, &args)
                        .map(|(it, arg)| format!("{} = {arg}", it.name))
                        .collect::<Vec<_>>()
                        .join(", ")
                );
                let expr = crate::parse(&call).expect(&call);
                Library::new().eval(&expr, &Values::new()).expect(&call)
            };
            let first = at(0.5);
            for share in [1e-3, 0.1, 0.37, 0.77, 0.99, 1.0] {
                let found = at(share);
                assert!(
                    (found - first).abs() <= 8.0 * f64::EPSILON * first,
                    "{name} at {share}: {found}, {first}"
                );
            }
        }
    }
}
