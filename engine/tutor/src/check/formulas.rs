//! A lesson's formulas against the core's functions, and the formulas of its pictures.

use formula::{Arg, Expr, Node, Values};

use super::Checker;
use crate::exercise::random::Random;
use crate::lesson::{Fingerprint, Formula, FormulaEntry, STAGING, Text};

/// Random points at which a formula must equal its core function.
const POINTS: usize = 200;
/// How near it must come, relatively. Textbook forms cancel at hard points: near the peak of a
/// polished surface D keeps ten of f64's sixteen digits.
const REL: f64 = 1e-6;
/// The quantities that a picture offers to its formulas, besides those of its scene.
pub(super) const OFFERED: [&str; 10] = [
    "n_dot_l",
    "n_dot_v",
    "n_dot_h",
    "cos_phi",
    "v_dot_h",
    "l_dot_v",
    "roughness",
    "alpha",
    "f0",
    "light_deg",
];

pub fn check(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    for entry in &lesson.formulas {
        if let Some(core) = &entry.core {
            against_core(checker, entry, core);
        }
    }
    for print in &lesson.fingerprints {
        let own = print.scene.iter().map(|it| it.name.text.as_str());
        let own = own.filter(|name| !STAGING.contains(name));
        let names: Vec<&str> = OFFERED.into_iter().chain(own).collect();
        let mut sound = true;
        for formula in [&print.right, &print.wrong] {
            sound &= checker.expression(formula, &names);
            if sound && let Err(error) = lesson.library.wgsl(&formula.expr, &names) {
                checker.formula_error(&formula.text, &error);
            }
        }
        if sound && draws_the_same(checker, print, &names) {
            let message = format!("The wrong picture of `{}` is the right one.", print.id);
            let finding = checker.error_in(&print.wrong.text, "same-picture", message);
            finding.expected = Some("a formula that gives other values than `right`".to_owned());
        }
    }
}

/// Whether both formulas of a fingerprint have the same values, wherever both have one.
fn draws_the_same(checker: &Checker<'_>, print: &Fingerprint, names: &[&str]) -> bool {
    let mut random = Random::new(1, &print.id);
    let mut compared = 0;
    for _ in 0..POINTS {
        let mut values: Values = names
            .iter()
            .map(|name| {
                (
                    (*name).to_owned(),
                    0.05 + 0.9 * random.below(1000) as f64 / 1000.0,
                )
            })
            .collect();
        for given in &print.scene {
            values.insert(given.name.text.clone(), given.value);
        }
        if let Some(roughness) = values.get("roughness").copied() {
            values.insert("alpha".to_owned(), roughness * roughness);
        }
        let of = |formula: &Formula| checker.lesson.library.eval(&formula.expr, &values);
        if let (Ok(right), Ok(wrong)) = (of(&print.right), of(&print.wrong)) {
            if (right - wrong).abs() > 1e-9 * (right.abs() + wrong.abs()) {
                return false;
            }
            compared += 1;
        }
    }
    compared > 0
}

fn against_core(checker: &mut Checker<'_>, entry: &FormulaEntry, core: &Text) {
    let Some(term) = brdf::term(core) else {
        let known = brdf::terms().iter().map(|term| term.name);
        let near = crate::load::nearest(core, known).map(str::to_owned);
        let message = format!("The core has no function `{core}`.");
        checker.error_in(core, "unknown-name", message).expected = near;
        return;
    };
    let params: Vec<&str> = entry.of.iter().map(|param| param.text.as_str()).collect();
    let call = |name: &str, names: &[&str]| Expr {
        node: Node::Call {
            name: name.to_owned(),
            args: names
                .iter()
                .map(|name| Arg {
                    name: Some((*name).to_owned()),
                    value: Expr::name(name),
                })
                .collect(),
        },
        span: formula::Span::default(),
    };
    let core_params: Vec<&str> = term.params.iter().map(|param| param.name).collect();
    let library = &checker.lesson.library;
    let own = library.compile(&call(&entry.name, &params), &params);
    // Arguments that both have by the same name are passed; the rest is implied.
    let shared: Vec<&str> = core_params
        .iter()
        .copied()
        .filter(|p| params.contains(p))
        .collect();
    let theirs = library.compile(&call(core, &shared), &params);
    let (own, theirs) = match (own, theirs) {
        (Ok(own), Ok(theirs)) => (own, theirs),
        (_, Err(error)) => {
            let message = format!(
                "`{}` takes {}, and `{core}` takes {}: {}.",
                entry.name,
                params.join(", "),
                core_params.join(", "),
                error.message
            );
            checker.error_in(core, "core-takes-other-arguments", message);
            return;
        }
        // The definition itself is wrong; reading it said so.
        (Err(_), _) => return,
    };
    let range = |name: &str| {
        let param = term.params.iter().find(|param| param.name == name);
        let (low, high) = param.map_or((0.0, 1.0), |param| param.range);
        // Exactly 0 is a limit for most terms, and alpha far below 1/1000 is for the stress test.
        let floor = if matches!(name, "alpha" | "roughness") {
            1e-3
        } else {
            1e-4
        };
        (if low == 0.0 { floor } else { low }, high)
    };
    let mut random = Random::new(1, core);
    for index in 0..POINTS {
        let inputs: Vec<f64> = params
            .iter()
            .map(|param| {
                let (low, high) = range(param);
                // Every third point takes each number from an end of its range.
                match (index % 3, random.below(4)) {
                    (0, 0) => low,
                    (0, 1) => high,
                    _ => low + (high - low) * random.below(1 << 20) as f64 / (1 << 20) as f64,
                }
            })
            .collect();
        let (own, theirs) = (own.eval(&inputs), theirs.eval(&inputs));
        // Where the core itself has no value there is nothing to compare.
        if theirs.is_finite() && (own - theirs).abs() > REL * theirs.abs()
            || own.is_nan() && theirs.is_finite()
        {
            let at: Vec<String> = params
                .iter()
                .zip(&inputs)
                .map(|(name, value)| format!("{name} = {}", crate::prose::shortest(*value)))
                .collect();
            let message = format!(
                "At {} this is {}; `{core}` is {}.",
                at.join(", "),
                crate::prose::shortest(own),
                crate::prose::shortest(theirs)
            );
            checker.error_in(&entry.is.text, "differs-from-core", message);
            return;
        }
    }
}
