//! What validation came upon, in plain words.

use naga::valid::{ExpressionError, FunctionError, TypeError, ValidationError};
use naga::{
    BinaryOperator as Op, Block, Expression, Handle, Module, Scalar, ScalarKind, Span, Statement,
    TypeInner, UnaryOperator, WithSpan,
};

use crate::Complaint;
use crate::read::{Text, complaint};
use crate::words::sentence;

/// What validating a text came upon.
pub fn validating(
    text: &Text<'_>,
    module: &Module,
    error: &WithSpan<ValidationError>,
) -> Complaint {
    // The last place is the narrowest.
    let mut spans: Vec<Span> = error.spans().map(|(span, _)| *span).collect();
    spans.extend(condition(module, error.as_inner()));
    let place = spans.into_iter().rev().find_map(|span| text.place(span));
    let said = match error.as_inner() {
        ValidationError::Function { name, source, .. } => {
            let exact = error.spans().len() > 1;
            function(module, name, source, exact)
        }
        ValidationError::EntryPoint { name, .. } => {
            complaint(format!("`{name}` is marked as a whole shader."))
                .with_help("Take the attribute that begins with `@` away.")
        }
        ValidationError::GlobalVariable { name, .. } => complaint(format!(
            "The variable `{name}` stands outside of every function without saying where it lives."
        ))
        .with_help(format!("Write `const {name} = …;`, or move it inside.")),
        ValidationError::Type {
            source: TypeError::WidthError(_),
            ..
        } => complaint("A number of this type cannot be run here.").with_help("Use `f32`."),
        ValidationError::Layouter(_) => complaint("An array is larger than anything can hold."),
        other => complaint(sentence(&innermost(other))),
    };
    said.at(place)
}

/// The `if` whose condition is wrong: the condition itself may be a name that stands elsewhere.
fn condition(module: &Module, error: &ValidationError) -> Option<Span> {
    let ValidationError::Function {
        handle,
        source: FunctionError::InvalidIfType(wrong),
        ..
    } = error
    else {
        return None;
    };
    fn find(block: &Block, wrong: Handle<Expression>) -> Option<Span> {
        block
            .span_iter()
            .find_map(|(statement, span)| match statement {
                Statement::If { condition, .. } if *condition == wrong => Some(*span),
                Statement::If { accept, reject, .. } => {
                    find(accept, wrong).or_else(|| find(reject, wrong))
                }
                Statement::Block(inner) => find(inner, wrong),
                Statement::Loop {
                    body, continuing, ..
                } => find(body, wrong).or_else(|| find(continuing, wrong)),
                Statement::Switch { cases, .. } => {
                    cases.iter().find_map(|case| find(&case.body, wrong))
                }
                _ => None,
            })
    }
    find(&module.functions[*handle].body, *wrong)
}

fn function(module: &Module, name: &str, error: &FunctionError, exact: bool) -> Complaint {
    match error {
        FunctionError::Expression { source, .. } => expression(source),
        FunctionError::InvalidReturnType {
            expression: None, ..
        } if exact => complaint("This `return` gives no value.")
            .with_help(format!("`{name}` should return a number.")),
        FunctionError::InvalidReturnType {
            expression: None, ..
        } => complaint(format!(
            "Not every way through `{name}` ends in a `return`."
        ))
        .with_help("Put a `return` at its end."),
        FunctionError::InvalidReturnType { expected_ty, .. } => {
            let wanted = expected_ty.map_or_else(
                || "nothing".to_owned(),
                |ty| type_name(module, &module.types[ty].inner),
            );
            complaint(format!(
                "What is returned here is of another type than `{wanted}`, which `{name}` promises."
            ))
        }
        FunctionError::InvalidIfType(_) => {
            complaint("The condition of an `if` should be true or false, and this is a number.")
                .with_help("Compare it: `x > 0.0`.")
        }
        FunctionError::BreakOutsideOfLoopOrSwitch => {
            complaint("`break` stands outside of every loop.")
        }
        FunctionError::ContinueOutsideOfLoop => {
            complaint("`continue` stands outside of every loop.")
        }
        FunctionError::MissingDefaultCase => complaint("This `switch` has no `default` case."),
        FunctionError::InvalidStoreTypes { .. } => {
            complaint("The variable is of another type than what it is given here.")
                .with_help("WGSL converts nothing by itself: `f32(i)`.")
        }
        FunctionError::InvalidCall { .. } => {
            complaint("This function is called with other types than it takes.")
                .with_help("WGSL converts nothing by itself: `f32(i)`.")
        }
        other => complaint(sentence(&innermost(other))),
    }
}

fn expression(error: &ExpressionError) -> Complaint {
    match error {
        ExpressionError::InvalidBinaryOperandTypes {
            op: Op::ExclusiveOr,
            lhs_type: TypeInner::Scalar(Scalar::F32),
            ..
        } => complaint("`^` is no power in WGSL: it works on the bits of whole numbers.")
            .with_help("A power is a product, `x * x`, or `pow(x, y)`."),
        ExpressionError::InvalidBinaryOperandTypes {
            op,
            lhs_type,
            rhs_type,
            ..
        } => {
            let (left, right) = (simple_name(lhs_type), simple_name(rhs_type));
            let says = format!("`{}` does not take {left} and {right}.", sign(*op));
            match [lhs_type, rhs_type].iter().any(|ty| is_whole(ty)) {
                true => complaint(says)
                    .with_help("WGSL converts nothing by itself: write `2.0`, or `f32(i)`."),
                false => complaint(says),
            }
        }
        ExpressionError::InvalidUnaryOperandType(op, _) => {
            let sign = match op {
                UnaryOperator::Negate => "-",
                UnaryOperator::LogicalNot => "!",
                UnaryOperator::BitwiseNot => "~",
            };
            complaint(format!("`{sign}` does not go before a value of this type."))
        }
        ExpressionError::SelectConditionNotABool { .. } => {
            complaint("The last argument of `select` should be true or false.")
                .with_help("Compare it: `select(otherwise, value, x > 0.0)`.")
        }
        ExpressionError::IndexOutOfBounds(_, index) => complaint(format!(
            "Index {index} is past the end; counting begins with 0."
        )),
        ExpressionError::NegativeIndex(_) => complaint("A negative index is no place."),
        ExpressionError::DivideByZero => complaint("This divides a whole number by zero."),
        ExpressionError::MissingCapabilities(_) => {
            complaint("A number of this type cannot be run here.").with_help("Use `f32`.")
        }
        other => complaint(sentence(&innermost(other))),
    }
}

fn is_whole(ty: &TypeInner) -> bool {
    matches!(
        ty,
        TypeInner::Scalar(Scalar {
            kind: ScalarKind::Sint | ScalarKind::Uint,
            ..
        })
    )
}

fn sign(op: Op) -> &'static str {
    match op {
        Op::Add => "+",
        Op::Subtract => "-",
        Op::Multiply => "*",
        Op::Divide => "/",
        Op::Modulo => "%",
        Op::Equal => "==",
        Op::NotEqual => "!=",
        Op::Less => "<",
        Op::LessEqual => "<=",
        Op::Greater => ">",
        Op::GreaterEqual => ">=",
        Op::And => "&",
        Op::ExclusiveOr => "^",
        Op::InclusiveOr => "|",
        Op::LogicalAnd => "&&",
        Op::LogicalOr => "||",
        Op::ShiftLeft => "<<",
        Op::ShiftRight => ">>",
    }
}

fn scalar_name(scalar: &Scalar) -> String {
    let letter = match scalar.kind {
        ScalarKind::Bool | ScalarKind::AbstractInt | ScalarKind::AbstractFloat => {
            return match scalar.kind {
                ScalarKind::Bool => "bool".to_owned(),
                _ => "number".to_owned(),
            };
        }
        ScalarKind::Sint => 'i',
        ScalarKind::Uint => 'u',
        ScalarKind::Float => 'f',
    };
    format!("{letter}{}", u32::from(scalar.width) * 8)
}

/// A type in quotes, without what only the module knows of it.
fn simple_name(ty: &TypeInner) -> String {
    match ty {
        TypeInner::Scalar(scalar) => format!("`{}`", scalar_name(scalar)),
        TypeInner::Vector { size, scalar } => {
            format!("`vec{}<{}>`", *size as u8, scalar_name(scalar))
        }
        TypeInner::Matrix { columns, rows, .. } => {
            format!("`mat{}x{}`", *columns as u8, *rows as u8)
        }
        TypeInner::Array { .. } => "an array".to_owned(),
        TypeInner::Struct { .. } => "a struct".to_owned(),
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "a pointer".to_owned(),
        _ => "something else".to_owned(),
    }
}

fn type_name(module: &Module, ty: &TypeInner) -> String {
    let named = module.types.iter().find(|(_, known)| known.inner == *ty);
    match named.and_then(|(_, known)| known.name.clone()) {
        Some(name) => name,
        None => simple_name(ty).trim_matches('`').to_owned(),
    }
}

/// What the error is in the end.
fn innermost(error: &dyn std::error::Error) -> String {
    let mut last = error;
    while let Some(inner) = last.source() {
        last = inner;
    }
    last.to_string()
}
