//! Steps as a learner does them: each from the numbers of the steps before, kept to a few
//! digits.

use formula::{BinaryOp, Expr, Library, Node, Values};

use crate::lesson::Lesson;

/// A step's formula written with the results of earlier steps wherever they occur in it, so
/// that a slip in one step is followed into the next. `s(c = n_dot_v)` inside a definition
/// becomes `root_v` where an earlier step of that name computes it.
pub fn follow(lesson: &Lesson, expr: &Expr, earlier: &[(&str, &Expr)]) -> Expr {
    let opened = open(&lesson.library, expr, 8);
    let earlier_opened: Vec<(&str, Expr)> = earlier
        .iter()
        .map(|(name, step)| (*name, open(&lesson.library, step, 8)))
        .collect();
    let replaced = replace(&opened, &earlier_opened);
    // What stands where a step's own formula was would be that step's name: a step that is
    // nothing but an earlier step stays as it is.
    match replaced.node {
        Node::Name(_) => expr.clone(),
        _ => replaced,
    }
}

/// Opens calls without arguments of the lesson's own formulas.
///
/// Such a call takes everything from the givens, and so do the names in its body. The result
/// may fail to evaluate where a parameter is only implied (alpha by roughness); callers compare
/// it with the original before they use it.
fn open(library: &Library, expr: &Expr, depth: usize) -> Expr {
    if let Node::Call { name, args } = &expr.node
        && args.is_empty()
        && depth > 0
        && let Some(definition) = library.definition(name)
    {
        return open(library, &definition.body, depth - 1);
    }
    with_children(expr, |child| open(library, child, depth))
}

fn replace(expr: &Expr, earlier: &[(&str, Expr)]) -> Expr {
    let step = earlier.iter().find(|(_, step)| {
        !matches!(step.node, Node::Name(_) | Node::Number { .. }) && step.same(expr)
    });
    match step {
        Some((name, _)) => Expr::name(name),
        None => with_children(expr, |child| replace(child, earlier)),
    }
}

/// The same node over other children.
fn with_children(expr: &Expr, mut child: impl FnMut(&Expr) -> Expr) -> Expr {
    let node = match &expr.node {
        Node::Number { .. } | Node::Name(_) => expr.node.clone(),
        Node::Neg(inner) => Node::Neg(Box::new(child(inner))),
        Node::Binary { op, left, right } => Node::Binary {
            op: *op,
            left: Box::new(child(left)),
            right: Box::new(child(right)),
        },
        Node::Compare { op, left, right } => Node::Compare {
            op: *op,
            left: Box::new(child(left)),
            right: Box::new(child(right)),
        },
        Node::Call { name, args } => Node::Call {
            name: name.clone(),
            args: args
                .iter()
                .map(|arg| formula::Arg {
                    name: arg.name.clone(),
                    value: child(&arg.value),
                })
                .collect(),
        },
    };
    Expr {
        node,
        span: expr.span,
    }
}

/// The value that somebody gets who writes down every intermediate result with so many
/// significant digits; NaN where there is none.
pub fn rounded(library: &Library, expr: &Expr, known: &Values, digits: u32) -> f64 {
    let value = |expr: &Expr| rounded(library, expr, known, digits);
    let result = match &expr.node {
        Node::Number { value, .. } => return *value,
        Node::Name(name) => {
            return match known.get(name) {
                Some(value) => *value,
                None => library.eval(expr, known).unwrap_or(f64::NAN),
            };
        }
        Node::Neg(inner) => -value(inner),
        Node::Binary { op, left, right } => {
            let (left, right) = (value(left), value(right));
            match op {
                BinaryOp::Add => left + right,
                BinaryOp::Sub => left - right,
                BinaryOp::Mul => left * right,
                BinaryOp::Div => left / right,
                BinaryOp::Pow => left.powf(right),
            }
        }
        // A condition has no digits to lose.
        Node::Compare { .. } => return library.eval(expr, known).unwrap_or(f64::NAN),
        Node::Call { .. } => {
            let call = with_children(expr, |child| Expr::number(value(child)));
            library.eval(&call, known).unwrap_or(f64::NAN)
        }
    };
    round_to(result, digits)
}

/// A number to so many significant digits, to within a few units in the last place of f64.
pub fn round_to(value: f64, digits: u32) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let scale = 10_f64.powi(digits as i32 - 1 - value.abs().log10().floor() as i32);
    let rounded = (value * scale).round() / scale;
    if rounded.is_finite() { rounded } else { value }
}

/// Equal but for f64's own rounding.
pub fn nearly_equal(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}
