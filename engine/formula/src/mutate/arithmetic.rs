//! Slips in powers, sums, products and quotients.

use super::{Editor, is_name, is_number, power, product};
use crate::expr::{BinaryOp, Expr, Node};
use crate::mutant::MutantKind;
use crate::spelling::dot_product;

impl Editor<'_> {
    pub(super) fn power(&mut self, path: &[usize], base: &Expr, exponent: &Expr) {
        let Node::Number { value, .. } = exponent.node else {
            return;
        };
        if value == 2.0 {
            if let Node::Binary {
                op: BinaryOp::Mul,
                left,
                right,
            } = &base.node
            {
                let says = format!(
                    "only {} was squared, not the whole product",
                    self.show(right)
                );
                let new = Expr::binary(BinaryOp::Mul, (**left).clone(), power(right, 2.0));
                self.at(path, MutantKind::BracketLost, &base.to_string(), says, new);
            }
        } else if value.fract() == 0.0 && (3.0..=16.0).contains(&value) {
            let less = value - 1.0;
            let says = format!("the power {less} was used where {value} belongs");
            let subject = base.to_string();
            self.at(
                path,
                MutantKind::PowerOff,
                &subject,
                says,
                power(base, less),
            );
        }
    }

    pub(super) fn sum(&mut self, path: &[usize], op: BinaryOp, left: &Expr, right: &Expr) {
        let (other, wrong, belongs) = match op {
            BinaryOp::Add => (BinaryOp::Sub, "minus", "plus"),
            _ => (BinaryOp::Add, "plus", "minus"),
        };
        let shown = self.show(right);
        let subject = right.to_string();
        let flipped = Expr::binary(other, left.clone(), right.clone());
        let says = format!("{wrong} stands before {shown} where {belongs} belongs");
        self.at(path, MutantKind::SignFlipped, &subject, says, flipped);
        if op == BinaryOp::Sub {
            let swapped = Expr::binary(op, right.clone(), left.clone());
            let says = format!(
                "the difference was turned round: {} where {} belongs",
                self.show(&swapped),
                self.show(&Expr::binary(op, left.clone(), right.clone()))
            );
            self.at(path, MutantKind::OperandsSwapped, &subject, says, swapped);
            if is_number(left, 1.0) {
                let says = format!(
                    "the \"1 −\" was lost: {shown} stands where 1 − {} belongs",
                    self.in_sum(right)
                );
                self.at(
                    path,
                    MutantKind::ComplementLost,
                    &subject,
                    says,
                    right.clone(),
                );
            }
        }
        self.partners(path, op, left, right);
        for (lost, kept) in [(left, right), (right, left)] {
            let first = std::ptr::eq(lost, left);
            if let Node::Number { text, .. } = &lost.node
                && !(first && op == BinaryOp::Sub)
            {
                let sign = if op == BinaryOp::Add { "+" } else { "−" };
                let says = format!("the {sign} {text} was forgotten");
                self.at(path, MutantKind::TermLost, text, says, kept.clone());
            }
        }
    }

    /// a·b + c·d with b and d swapped: the roots of V paired with their own cosines.
    fn partners(&mut self, path: &[usize], op: BinaryOp, left: &Expr, right: &Expr) {
        let two = |expr: &Expr| match &expr.node {
            Node::Binary {
                op: BinaryOp::Mul,
                left,
                right,
            } => Some(((**left).clone(), (**right).clone())),
            _ => None,
        };
        if let (Some((a, b)), Some((c, d))) = (two(left), two(right)) {
            let says = format!("{} and {} changed places", self.show(&b), self.show(&d));
            let subject = format!("{b} {d}");
            let new = Expr::binary(
                op,
                Expr::binary(BinaryOp::Mul, a, d),
                Expr::binary(BinaryOp::Mul, c, b),
            );
            self.at(path, MutantKind::ArgumentsSwapped, &subject, says, new);
        }
    }

    fn in_sum(&self, expr: &Expr) -> String {
        let sum = matches!(
            &expr.node,
            Node::Binary {
                op: BinaryOp::Add | BinaryOp::Sub,
                ..
            }
        );
        if sum {
            format!("({})", self.show(expr))
        } else {
            self.show(expr)
        }
    }

    pub(super) fn product(&mut self, path: &[usize], node: &Expr, left: &Expr, right: &Expr) {
        for (lost, kept) in [(left, right), (right, left)] {
            if let Some((kind, says)) = self.lost_factor(lost) {
                self.at(path, kind, &lost.to_string(), says, kept.clone());
            }
            if is_number(lost, 4.0) {
                let says = "2 was used where 4 belongs".to_string();
                let half = Expr::binary(BinaryOp::Mul, Expr::number(2.0), kept.clone());
                self.at(
                    path,
                    MutantKind::FactorLost(2.0),
                    &node.to_string(),
                    says,
                    half,
                );
            }
        }
        if let Node::Binary {
            op,
            left: first,
            right: second,
        } = &right.node
            && matches!(op, BinaryOp::Add | BinaryOp::Sub)
        {
            let says = format!(
                "only {} was multiplied, not the whole bracket",
                self.show(first)
            );
            let only = Expr::binary(BinaryOp::Mul, left.clone(), (**first).clone());
            let new = Expr::binary(*op, only, (**second).clone());
            self.at(path, MutantKind::BracketLost, &node.to_string(), says, new);
        }
    }

    fn lost_factor(&self, factor: &Expr) -> Option<(MutantKind, String)> {
        match &factor.node {
            Node::Name(name) if name == "pi" => {
                Some((MutantKind::PiLost, "the factor π was lost".to_string()))
            }
            Node::Name(name) if dot_product(name).is_some() => Some((
                MutantKind::CosineLost,
                format!("the factor {} was forgotten", self.show(factor)),
            )),
            Node::Number { value, text } if *value != 1.0 && *value != 0.0 => Some((
                MutantKind::FactorLost(*value),
                format!("the factor {text} was lost"),
            )),
            _ => None,
        }
    }

    pub(super) fn quotient(&mut self, path: &[usize], left: &Expr, right: &Expr) {
        let shown = self.show(right);
        let subject = right.to_string();
        let whole = Expr::binary(BinaryOp::Div, left.clone(), right.clone());
        // An angle turned into degrees: x·180/π.
        if let Node::Binary {
            op: BinaryOp::Mul,
            left: angle,
            right: half_turn,
        } = &left.node
            && is_name(right, "pi")
            && is_number(half_turn, 180.0)
        {
            let says = "the angle was left in radians".to_string();
            self.at(
                path,
                MutantKind::RadiansForDegrees,
                "",
                says,
                (**angle).clone(),
            );
            return;
        }
        if is_name(right, "pi") {
            let says = "the division by π was lost".to_string();
            self.at(path, MutantKind::PiLost, "", says, left.clone());
        } else if let Node::Number { value, text } = &right.node {
            let says = format!("the division by {text} was lost");
            self.at(
                path,
                MutantKind::FactorLost(*value),
                &subject,
                says,
                left.clone(),
            );
        } else {
            let twice = Expr::binary(BinaryOp::Div, whole.clone(), right.clone());
            let says = format!("it was divided by {shown} a second time");
            self.at(path, MutantKind::DividedTwice, &subject, says, twice);
            let says = format!("the division by {shown} was left out");
            self.at(path, MutantKind::DivisionLost, &subject, says, left.clone());
        }
        if let Some((kind, says)) = self.lost_factor(left) {
            let new = Expr::binary(BinaryOp::Div, Expr::number(1.0), right.clone());
            self.at(path, kind, &left.to_string(), says, new);
        }
        if path.is_empty() {
            let swapped = Expr::binary(BinaryOp::Div, right.clone(), left.clone());
            let says = "the fraction was turned upside down".to_string();
            self.at(path, MutantKind::OperandsSwapped, "", says, swapped);
        }
        let factors = factors(right);
        if factors.len() > 1 {
            let first = Expr::binary(BinaryOp::Div, left.clone(), factors[0].clone());
            let mut rest = vec![first];
            rest.extend(factors[1..].iter().map(|factor| (*factor).clone()));
            let says = format!(
                "it was divided by {} only: the brackets around {shown} were lost",
                self.show(factors[0])
            );
            self.at(path, MutantKind::BracketLost, &subject, says, product(rest));
        }
    }
}

/// The factors of a product, left to right.
fn factors(expr: &Expr) -> Vec<&Expr> {
    match &expr.node {
        Node::Binary {
            op: BinaryOp::Mul,
            left,
            right,
        } => {
            let mut all = factors(left);
            all.push(right);
            all
        }
        _ => vec![expr],
    }
}
