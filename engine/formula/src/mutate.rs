//! The rules by which a formula is got wrong: each makes one edit at one place, or the same
//! edit wherever the same thing is written.

use crate::builtin::Builtin;
use crate::expr::{Arg, BinaryOp, Expr, Node};
use crate::library::Library;
use crate::mutant::MutantKind;
use crate::scope::Callee;
use crate::spelling::dot_product;

/// A tree with one edit.
pub(crate) struct Edit {
    pub kind: MutantKind,
    /// The part of the formula it is about, in the language.
    pub subject: String,
    /// A clause for the learner, without capital and full stop.
    pub says: String,
    pub root: Expr,
}

/// Where a node stands: which child to take, from the root down.
type Path = Vec<usize>;

impl Library {
    /// Every edit of one tree. `names` are visible in it; `top` says that it is no
    /// definition's body.
    pub(crate) fn edits(&self, root: &Expr, names: &[String], top: bool, most: usize) -> Vec<Edit> {
        let mut editor = Editor {
            library: self,
            root,
            names,
            top,
            most,
            edits: Vec::new(),
        };
        let mut nodes = Vec::new();
        collect(root, &mut Vec::new(), &mut nodes);
        editor.whole(&nodes);
        for (path, node) in &nodes {
            editor.node(path, node);
        }
        editor.pairs_of_calls(&nodes);
        editor.edits
    }
}

fn collect<'e>(expr: &'e Expr, path: &mut Path, into: &mut Vec<(Path, &'e Expr)>) {
    into.push((path.clone(), expr));
    for (index, child) in expr.children().into_iter().enumerate() {
        path.push(index);
        collect(child, path, into);
        path.pop();
    }
}

fn replaced(root: &Expr, path: &[usize], new: Expr) -> Expr {
    let mut result = root.clone();
    let mut at = &mut result;
    for index in path {
        match at.children_mut().into_iter().nth(*index) {
            Some(child) => at = child,
            None => return root.clone(),
        }
    }
    *at = new;
    result
}

/// The tree with every node exchanged for which `new` has something. What was put in is
/// not looked at again: alpha² for alpha would not end.
fn everywhere(expr: &Expr, new: &impl Fn(&Expr) -> Option<Expr>) -> Expr {
    new(expr).unwrap_or_else(|| {
        let mut result = expr.clone();
        for child in result.children_mut() {
            *child = everywhere(child, new);
        }
        result
    })
}

fn squared(expr: &Expr) -> Option<&Expr> {
    match &expr.node {
        Node::Binary {
            op: BinaryOp::Pow,
            left,
            right,
        } if is_number(right, 2.0) => Some(left),
        _ => None,
    }
}

fn is_number(expr: &Expr, wanted: f64) -> bool {
    matches!(&expr.node, Node::Number { value, .. } if *value == wanted)
}

fn is_name(expr: &Expr, wanted: &str) -> bool {
    matches!(&expr.node, Node::Name(name) if name == wanted)
}

fn power(base: &Expr, exponent: f64) -> Expr {
    Expr::binary(BinaryOp::Pow, base.clone(), Expr::number(exponent))
}

fn product(factors: Vec<Expr>) -> Expr {
    factors
        .into_iter()
        .reduce(|left, right| Expr::binary(BinaryOp::Mul, left, right))
        .unwrap_or_else(|| Expr::number(1.0))
}

fn named(name: &str, value: Expr) -> Arg {
    Arg {
        name: Some(name.to_string()),
        value,
    }
}

struct Editor<'a> {
    library: &'a Library,
    root: &'a Expr,
    names: &'a [String],
    top: bool,
    most: usize,
    edits: Vec<Edit>,
}

impl Editor<'_> {
    fn add(&mut self, kind: MutantKind, subject: &str, says: String, root: Expr) {
        let known = self.edits.len() >= self.most
            || self.root.same(&root)
            || self.edits.iter().any(|edit| edit.root.same(&root));
        if !known {
            let subject = subject.to_string();
            self.edits.push(Edit {
                kind,
                subject,
                says,
                root,
            });
        }
    }

    fn at(&mut self, path: &[usize], kind: MutantKind, subject: &str, says: String, new: Expr) {
        if self.edits.len() < self.most {
            let root = replaced(self.root, path, new);
            self.add(kind, subject, says, root);
        }
    }

    fn show(&self, expr: &Expr) -> String {
        self.library.unicode(expr)
    }

    /// 4·N·L·N·V has a name of its own: everybody reads it without brackets.
    fn product_shown(&self, product: &Expr) -> String {
        let shown = self.show(product);
        if shown == "4·(N·L)·(N·V)" {
            "4·N·L·N·V".to_string()
        } else {
            shown
        }
    }

    /// Whether a plain name means something in this tree.
    fn visible(&self, name: &str) -> bool {
        let has = |wanted: &str| self.names.iter().any(|known| known == wanted);
        has(name) || crate::scope::twin(name).is_some_and(|(other, _)| has(other))
    }

    /// Misreadings that concern a quantity wherever it stands.
    fn whole(&mut self, nodes: &[(Path, &Expr)]) {
        if self.visible("alpha") {
            self.alpha_read_as(
                nodes,
                Expr::name("roughness"),
                MutantKind::RoughnessForAlpha,
                "roughness was used where α = roughness² belongs",
            );
            self.alpha_read_as(
                nodes,
                power(&Expr::name("alpha"), 2.0),
                MutantKind::SquareDoubled,
                "α = roughness² was squared once more before it was used",
            );
        }
        // The same square at several places is one thing to forget, and so is one of them.
        let squares: Vec<_> = nodes
            .iter()
            .filter_map(|(path, node)| Some((path, *node, squared(node)?)))
            .collect();
        for (path, node, base) in &squares {
            let alike: Vec<_> = squares
                .iter()
                .filter(|(_, other, _)| other.same(node))
                .collect();
            let rows = self.squares_wrong(base);
            if alike.len() == 1 {
                for (kind, says, new) in rows {
                    self.at(path, kind, &base.to_string(), says, new);
                }
                continue;
            }
            let place = alike
                .iter()
                .position(|(other, ..)| other == path)
                .unwrap_or(0);
            for (index, (kind, says, new)) in rows.into_iter().enumerate() {
                let subject = base.to_string();
                let root = everywhere(self.root, &|other| other.same(node).then(|| new.clone()));
                self.add(kind, &subject, says.clone(), root);
                if index == 0 {
                    let says = format!("{says}, {}", ordinal(place));
                    self.at(path, kind, &subject, says, new);
                }
            }
        }
        self.visibility_of_root();
    }

    /// Exchanges alpha everywhere, whether written or left out of a call; then, where
    /// several calls leave it out, in each of them alone.
    fn alpha_read_as(&mut self, nodes: &[(Path, &Expr)], new: Expr, kind: MutantKind, says: &str) {
        let root = everywhere(self.root, &|expr| {
            if is_name(expr, "alpha") {
                return Some(new.clone());
            }
            self.with_argument(expr, "alpha", &new)
        });
        self.add(kind, "", says.to_string(), root);
        let calls: Vec<_> = nodes
            .iter()
            .filter(|(_, node)| self.leaves_out(node, "alpha"))
            .collect();
        if calls.len() > 1 && kind == MutantKind::RoughnessForAlpha {
            for (path, node) in calls {
                if let (Some(call), Node::Call { name, .. }) =
                    (self.with_argument(node, "alpha", &new), &node.node)
                {
                    let says = format!("in {} alone, {says}", self.show(node));
                    self.at(path, kind, name, says, call);
                }
            }
        }
    }

    /// Whether a node is a call that takes `param` from around it.
    fn leaves_out(&self, expr: &Expr, param: &str) -> bool {
        let Node::Call { name, args } = &expr.node else {
            return false;
        };
        let Ok(callee) = self.library.callee(name, args, expr.span) else {
            return false;
        };
        let (twin, _) = crate::scope::twin(param).unwrap_or((param, crate::scope::Convert::Same));
        let wants = callee
            .params()
            .iter()
            .any(|known| *known == param || *known == twin);
        wants
            && !args.iter().any(|arg| match &arg.name {
                Some(name) => name == param || name == twin,
                None => true,
            })
    }

    /// The call with an argument written that it leaves out.
    fn with_argument(&self, expr: &Expr, param: &str, value: &Expr) -> Option<Expr> {
        if !self.leaves_out(expr, param) {
            return None;
        }
        let Node::Call { name, args } = &expr.node else {
            return None;
        };
        let mut args = args.clone();
        args.push(named(param, value.clone()));
        Some(Expr::call(name, args))
    }

    /// The ways to get a square wrong: what happened, and what stands there then.
    fn squares_wrong(&self, base: &Expr) -> Vec<(MutantKind, String, Expr)> {
        let shown = self.show(base);
        let (kind, says) = if is_name(base, "roughness") {
            let says = "roughness was used where α = roughness² belongs";
            (MutantKind::RoughnessForAlpha, says.to_string())
        } else if is_name(base, "alpha") {
            let says = "α was used where α² belongs";
            (MutantKind::SquareDropped, says.to_string())
        } else {
            let says = format!("the square on {shown} was dropped");
            (MutantKind::SquareDropped, says)
        };
        let mut rows = vec![
            (kind, says, base.clone()),
            (
                MutantKind::SquareDoubled,
                format!("the square of {shown} was squared again"),
                power(base, 4.0),
            ),
        ];
        if matches!(base.node, Node::Name(_)) {
            rows.push((
                MutantKind::DoubledInsteadOfSquared,
                format!("the double of {shown} was used instead of its square"),
                Expr::binary(BinaryOp::Mul, Expr::number(2.0), base.clone()),
            ));
        }
        rows
    }

    /// Whatever can go wrong at one node.
    fn node(&mut self, path: &[usize], node: &Expr) {
        match &node.node {
            Node::Number { .. } => {}
            Node::Name(name) => self.other_dot_product(path, name),
            Node::Neg(inner) => {
                let says = format!("the minus before {} was lost", self.show(inner));
                let subject = inner.to_string();
                self.at(
                    path,
                    MutantKind::SignFlipped,
                    &subject,
                    says,
                    (**inner).clone(),
                );
            }
            Node::Binary { op, left, right } => match op {
                BinaryOp::Pow => self.power(path, left, right),
                BinaryOp::Add | BinaryOp::Sub => self.sum(path, *op, left, right),
                BinaryOp::Mul => self.product(path, node, left, right),
                BinaryOp::Div => self.quotient(path, left, right),
            },
            Node::Compare { .. } => {}
            Node::Call { name, args } => self.call(path, node, name, args),
        }
    }

    fn other_dot_product(&mut self, path: &[usize], name: &str) {
        for other in self.other_dot_products(name) {
            let says = format!(
                "{} was used where {} belongs",
                crate::unicode_name(&other),
                crate::unicode_name(name)
            );
            let subject = format!("{other} for {name}");
            self.at(
                path,
                MutantKind::OtherDotProduct,
                &subject,
                says,
                Expr::name(&other),
            );
        }
    }

    fn other_dot_products(&self, name: &str) -> Vec<String> {
        if dot_product(name).is_none() {
            return Vec::new();
        }
        let others = self
            .names
            .iter()
            .filter(|other| dot_product(other).is_some());
        others.filter(|other| *other != name).cloned().collect()
    }

    fn power(&mut self, path: &[usize], base: &Expr, exponent: &Expr) {
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

    fn sum(&mut self, path: &[usize], op: BinaryOp, left: &Expr, right: &Expr) {
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

    fn product(&mut self, path: &[usize], node: &Expr, left: &Expr, right: &Expr) {
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

    fn quotient(&mut self, path: &[usize], left: &Expr, right: &Expr) {
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

    fn call(&mut self, path: &[usize], node: &Expr, name: &str, args: &[Arg]) {
        if let (Some(builtin), Some(first)) = (Builtin::named(name), args.first()) {
            self.elementary(path, builtin, args, &first.value);
            return;
        }
        let Ok(callee) = self.library.callee(name, args, node.span) else {
            return;
        };
        self.related_function(path, name, args);
        self.explicit_arguments(path, name, args);
        let params: Vec<String> = callee.params().iter().map(ToString::to_string).collect();
        for param in &params {
            if !self.visible(param) {
                continue;
            }
            for other in self.other_dot_products(param) {
                if let Some(new) = self.with_argument(node, param, &Expr::name(&other)) {
                    let says = format!(
                        "in {}, {} was used where {} belongs",
                        self.show(&Expr::call(name, Vec::new())),
                        crate::unicode_name(&other),
                        crate::unicode_name(param)
                    );
                    let subject = format!("{name} {other} for {param}");
                    self.at(path, MutantKind::OtherDotProduct, &subject, says, new);
                }
            }
        }
        let both = ["n_dot_l", "n_dot_v"];
        if both
            .iter()
            .all(|param| self.leaves_out(node, param) && self.visible(param))
        {
            let mut args = args.to_vec();
            args.push(named("n_dot_l", Expr::name("n_dot_v")));
            args.push(named("n_dot_v", Expr::name("n_dot_l")));
            let says = "N·L and N·V were swapped".to_string();
            self.at(
                path,
                MutantKind::ArgumentsSwapped,
                name,
                says,
                Expr::call(name, args),
            );
        }
        let divided = match callee {
            Callee::Term(_) => name.starts_with("v_") || name.starts_with("specular"),
            Callee::Definition(definition) => is_quotient(&definition.body),
            Callee::Builtin(_) => false,
        };
        if divided
            && both
                .iter()
                .all(|param| params.iter().any(|known| known == param))
        {
            let argument = |param: &str| {
                let written = args.iter().find(|arg| arg.name.as_deref() == Some(param));
                match written {
                    Some(arg) => Some(arg.value.clone()),
                    None => self.visible(param).then(|| Expr::name(param)),
                }
            };
            if let (Some(light), Some(view)) = (argument("n_dot_l"), argument("n_dot_v")) {
                let by = product(vec![Expr::number(4.0), light, view]);
                let says = format!(
                    "it was divided by {} a second time",
                    self.product_shown(&by)
                );
                let new = Expr::binary(BinaryOp::Div, node.clone(), by);
                self.at(
                    path,
                    MutantKind::DividedTwice,
                    "4 n_dot_l n_dot_v",
                    says,
                    new,
                );
            }
        }
    }

    /// A whole quotient over N·L and N·V is a visibility to a hurried reader: he divides it
    /// by 4·N·L·N·V, or takes it for G2.
    fn visibility_of_root(&mut self) {
        if !is_quotient(self.root) {
            return;
        }
        let mentions = |wanted: &str| {
            let mut found = false;
            self.root.walk(&mut |expr| found |= is_name(expr, wanted));
            found
        };
        if mentions("n_dot_l") && mentions("n_dot_v") {
            let names = [Expr::name("n_dot_l"), Expr::name("n_dot_v")];
            let [light, view] = names;
            let by = product(vec![Expr::number(4.0), light, view]);
            let new = Expr::binary(BinaryOp::Div, self.root.clone(), by.clone());
            let says = format!(
                "it was divided by {} a second time",
                self.product_shown(&by)
            );
            self.add(MutantKind::DividedTwice, "4 n_dot_l n_dot_v", says, new);
            let new = Expr::binary(BinaryOp::Mul, by.clone(), self.root.clone());
            let says = format!("it was multiplied by {}", self.product_shown(&by));
            if self.top {
                self.add(MutantKind::DivisionLost, "4 n_dot_l n_dot_v", says, new);
            }
        }
    }

    fn elementary(&mut self, path: &[usize], builtin: Builtin, args: &[Arg], first: &Expr) {
        let subject = first.to_string();
        let shown = self.show(first);
        match builtin {
            Builtin::Sqrt => {
                let says = format!("the square root of {shown} was not taken");
                self.at(path, MutantKind::SqrtLost, &subject, says, first.clone());
            }
            Builtin::Deg => {
                let says = "degrees were used where radians belong".to_string();
                self.at(
                    path,
                    MutantKind::DegreesForRadians,
                    &subject,
                    says,
                    first.clone(),
                );
            }
            Builtin::Pow => {
                if let [base, exponent] = args {
                    let new = vec![exponent.clone(), base.clone()];
                    let says = "base and exponent were swapped".to_string();
                    self.at(
                        path,
                        MutantKind::ArgumentsSwapped,
                        "pow",
                        says,
                        Expr::call("pow", new),
                    );
                }
            }
            _ => {}
        }
        let other = match builtin {
            Builtin::Sin => "cos",
            Builtin::Cos => "sin",
            Builtin::Min => "max",
            Builtin::Max => "min",
            _ => return,
        };
        let says = format!("the {other} was taken where {} belongs", builtin.name());
        let subject = format!("{other} for {}", builtin.name());
        let new = Expr::call(other, args.to_vec());
        self.at(path, MutantKind::OtherFunction, &subject, says, new);
    }

    /// V for G2 and back, separable for correlated.
    fn related_function(&mut self, path: &[usize], name: &str, args: &[Arg]) {
        let mut related = Vec::new();
        if let Some(rest) = name.strip_prefix("v_") {
            related.push(format!("g2_{rest}"));
        }
        if let Some(rest) = name.strip_prefix("g2_") {
            related.push(format!("v_{rest}"));
        }
        related.push(format!("{name}_separable"));
        related.push(name.replace("_ggx", "_beckmann"));
        for other in related {
            let fits = |term: &brdf::Term| {
                let wanted = brdf::term(name).map(|own| own.params.iter().map(|p| p.name));
                wanted.is_some_and(|wanted| term.params.iter().map(|p| p.name).eq(wanted))
            };
            let Some(term) = brdf::term(&other).filter(|term| term.name != name && fits(term))
            else {
                continue;
            };
            let family = |name: &str| match name.split_once('_') {
                Some(("v", _)) => "V".to_string(),
                Some(("g2", _)) => "G2".to_string(),
                _ => name.to_string(),
            };
            let says = if other.ends_with("_separable") {
                "the separable form was used where the height-correlated one belongs".to_string()
            } else if family(&other) == family(name) {
                format!("{} was used where {name} belongs", term.name)
            } else {
                format!("{} was used where {} belongs", family(&other), family(name))
            };
            let new = Expr::call(&other, args.to_vec());
            let subject = format!("{other} for {name}");
            self.at(path, MutantKind::OtherFunction, &subject, says, new);
        }
    }

    /// Two arguments of one call swapped.
    fn explicit_arguments(&mut self, path: &[usize], name: &str, args: &[Arg]) {
        for (first, one) in args.iter().enumerate().take(4) {
            for (second, two) in args.iter().enumerate().take(4).skip(first + 1) {
                let (Some(left), Some(right)) = (&one.name, &two.name) else {
                    continue;
                };
                let mut swapped = args.to_vec();
                swapped[first].value = two.value.clone();
                swapped[second].value = one.value.clone();
                let says = format!(
                    "{} and {} were swapped",
                    crate::unicode_name(left),
                    crate::unicode_name(right)
                );
                let subject = format!("{name} {left} {right}");
                let new = Expr::call(name, swapped);
                self.at(path, MutantKind::ArgumentsSwapped, &subject, says, new);
            }
        }
    }

    /// Two calls of one function, each with the other's argument.
    fn pairs_of_calls(&mut self, nodes: &[(Path, &Expr)]) {
        let calls: Vec<_> = nodes
            .iter()
            .filter_map(|(path, node)| match &node.node {
                Node::Call { name, args } if args.len() == 1 && Builtin::named(name).is_none() => {
                    Some((path, name, &args[0]))
                }
                _ => None,
            })
            .take(8)
            .collect();
        for (index, (path, name, arg)) in calls.iter().enumerate() {
            for (other_path, other_name, other) in &calls[index + 1..] {
                // One inside the other cannot swap places.
                let apart = !other_path.starts_with(path);
                if name != other_name || arg.name != other.name || !apart {
                    continue;
                }
                let once = replaced(self.root, path, Expr::call(name, vec![(*other).clone()]));
                let both = replaced(&once, other_path, Expr::call(name, vec![(*arg).clone()]));
                let says = format!(
                    "{} and {} changed places",
                    self.show(&Expr::call(name, vec![(*arg).clone()])),
                    self.show(&Expr::call(name, vec![(*other).clone()]))
                );
                self.add(MutantKind::ArgumentsSwapped, name, says, both);
            }
        }
    }
}

fn ordinal(index: usize) -> String {
    match ["the first", "the second", "the third"].get(index) {
        Some(word) => format!("{word} time"),
        None => format!("at place {}", index + 1),
    }
}

fn is_quotient(expr: &Expr) -> bool {
    matches!(
        &expr.node,
        Node::Binary {
            op: BinaryOp::Div,
            ..
        }
    )
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
