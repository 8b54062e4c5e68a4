//! Slips in calls: the wrong function, the wrong argument, one division too many.

use super::{Editor, Path, is_quotient, named, product, replaced};
use crate::builtin::Builtin;
use crate::expr::{Arg, BinaryOp, Expr, Node};
use crate::mutant::MutantKind;
use crate::scope::{Callee, twin};

impl Editor<'_> {
    pub(super) fn call(&mut self, path: &[usize], node: &Expr, name: &str, args: &[Arg]) {
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

    fn elementary(&mut self, path: &[usize], builtin: Builtin, args: &[Arg], first: &Expr) {
        let subject = first.to_string();
        let shown = self.show(first);
        match builtin {
            Builtin::Sqrt => {
                let says = format!("the square root of {shown} was not taken");
                self.at(path, MutantKind::SqrtLost, &subject, says, first.clone());
            }
            Builtin::Deg => {
                let says = "degrees were used where radians belong: type `60°`, or set the \
                            calculator to degrees"
                    .to_string();
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
                // Nobody passes a roughness for a cosine.
                if twin(left).is_some() != twin(right).is_some() {
                    continue;
                }
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
    pub(super) fn pairs_of_calls(&mut self, nodes: &[(Path, &Expr)]) {
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
