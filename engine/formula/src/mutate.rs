//! The rules by which a formula is got wrong: each makes one edit at one place, or the same
//! edit wherever the same thing is written.

use crate::expr::{Arg, BinaryOp, Expr, Node};
use crate::library::Library;
use crate::mutant::MutantKind;
use crate::spelling::dot_product;

mod arithmetic;
mod calls;

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
            // Over a sum it is V; over a product the division is the reader's own.
            if self.top && !below_is_product(self.root) {
                let says = "it was multiplied by 4·N·L·N·V: that is G2, not V".to_string();
                let new = Expr::binary(BinaryOp::Mul, by, self.root.clone());
                self.add(MutantKind::DivisionLost, "4 n_dot_l n_dot_v", says, new);
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

fn below_is_product(expr: &Expr) -> bool {
    match &expr.node {
        Node::Binary {
            op: BinaryOp::Div,
            right,
            ..
        } => {
            matches!(
                &right.node,
                Node::Binary {
                    op: BinaryOp::Mul,
                    ..
                }
            )
        }
        _ => false,
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
