//! What a text may hold that WGSL knows and this machine does not: said before it runs.

use naga::{
    AddressSpace, Block, Expression, Function, Module, RelationalFunction, Span, Statement,
};

use crate::machine::Limits;
use crate::read::{Text, complaint};
use crate::{Complaint, math, thousands, value};

/// Whether every part of a module can be run here.
pub fn check(text: &Text<'_>, module: &Module, limits: Limits) -> Result<(), Complaint> {
    if let Some((handle, _)) = module.overrides.iter().next() {
        let span = module.overrides.get_span(handle);
        return Err(refused(text, span, "An `override`", "write `const`"));
    }
    for (handle, variable) in module.global_variables.iter() {
        let span = module.global_variables.get_span(handle);
        if variable.space != AddressSpace::Private {
            let what = "A variable that lives outside of the shader";
            return Err(refused(text, span, what, "take what you need as a number"));
        }
        room(text, module, variable.ty, span, limits)?;
    }
    for (handle, ty) in module.types.iter() {
        if !value::knows(&ty.inner) {
            let span = module.types.get_span(handle);
            return Err(refused(text, span, "This type", "use f32, i32, u32, bool"));
        }
    }
    for (_, function) in module.functions.iter() {
        for (handle, variable) in function.local_variables.iter() {
            let span = function.local_variables.get_span(handle);
            room(text, module, variable.ty, span, limits)?;
        }
        expressions(text, module, function, limits)?;
        block(text, &function.body)?;
    }
    let constants = module.global_expressions.iter();
    for (handle, expression) in constants {
        let span = module.global_expressions.get_span(handle);
        one(text, module, expression, span, limits)?;
    }
    Ok(())
}

fn refused(text: &Text<'_>, span: Span, what: &str, instead: &str) -> Complaint {
    let says = format!("{what} is WGSL, but cannot be run here.");
    let help = format!("Here one function of numbers is run, on the processor: {instead}.");
    complaint(says).with_help(help).at(text.place(span))
}

const WITHOUT: &str = "do without it";

fn room(
    text: &Text<'_>,
    module: &Module,
    ty: naga::Handle<naga::Type>,
    span: Span,
    limits: Limits,
) -> Result<(), Complaint> {
    match value::count(module, ty) {
        count if count > limits.room => Err(complaint(format!(
            "This holds {} numbers; {} is the most there is room for.",
            thousands(count),
            thousands(limits.room)
        ))
        .at(text.place(span))),
        _ => Ok(()),
    }
}

fn expressions(
    text: &Text<'_>,
    module: &Module,
    function: &Function,
    limits: Limits,
) -> Result<(), Complaint> {
    for (handle, expression) in function.expressions.iter() {
        let span = function.expressions.get_span(handle);
        one(text, module, expression, span, limits)?;
    }
    Ok(())
}

fn one(
    text: &Text<'_>,
    module: &Module,
    expression: &Expression,
    span: Span,
    limits: Limits,
) -> Result<(), Complaint> {
    let no = |what: &str| Err(refused(text, span, what, WITHOUT));
    match expression {
        Expression::Literal(literal) => match value::literal(*literal) {
            Some(_) => Ok(()),
            None => no("A number of this type"),
        },
        Expression::ZeroValue(ty) | Expression::Compose { ty, .. } => {
            room(text, module, *ty, span, limits)
        }
        Expression::Constant(_)
        | Expression::Access { .. }
        | Expression::AccessIndex { .. }
        | Expression::Splat { .. }
        | Expression::Swizzle { .. }
        | Expression::FunctionArgument(_)
        | Expression::GlobalVariable(_)
        | Expression::LocalVariable(_)
        | Expression::Load { .. }
        | Expression::Unary { .. }
        | Expression::Binary { .. }
        | Expression::Select { .. }
        | Expression::CallResult(_) => Ok(()),
        Expression::As { convert, .. } => match convert {
            None | Some(1 | 4) => Ok(()),
            Some(_) => no("A number of this type"),
        },
        Expression::Math { fun, .. } if math::knows(*fun) => Ok(()),
        Expression::Math { .. } => no("This function"),
        Expression::Relational {
            fun: RelationalFunction::All | RelationalFunction::Any,
            ..
        } => Ok(()),
        Expression::Relational { .. } => no("This function"),
        Expression::Derivative { .. } => no("A derivative between pixels"),
        Expression::ImageSample { .. }
        | Expression::ImageLoad { .. }
        | Expression::ImageQuery { .. } => no("A texture"),
        Expression::ArrayLength(_) => no("An array of any length"),
        Expression::Override(_)
        | Expression::AtomicResult { .. }
        | Expression::WorkGroupUniformLoadResult { .. }
        | Expression::RayQueryVertexPositions { .. }
        | Expression::RayQueryProceedResult
        | Expression::RayQueryGetIntersection { .. }
        | Expression::SubgroupBallotResult
        | Expression::SubgroupOperationResult { .. }
        | Expression::CooperativeLoad { .. }
        | Expression::CooperativeMultiplyAdd { .. } => no("This"),
    }
}

fn block(text: &Text<'_>, of: &Block) -> Result<(), Complaint> {
    for (statement, span) in of.span_iter() {
        match statement {
            Statement::Emit(_)
            | Statement::Break
            | Statement::Continue
            | Statement::Return { .. }
            | Statement::Store { .. }
            | Statement::Call { .. } => {}
            Statement::Block(inner) => block(text, inner)?,
            Statement::If { accept, reject, .. } => {
                block(text, accept)?;
                block(text, reject)?;
            }
            Statement::Switch { cases, .. } => {
                for case in cases {
                    block(text, &case.body)?;
                }
            }
            Statement::Loop {
                body, continuing, ..
            } => {
                block(text, body)?;
                block(text, continuing)?;
            }
            Statement::Kill => return Err(refused(text, *span, "`discard`", WITHOUT)),
            _ => return Err(refused(text, *span, "This statement", WITHOUT)),
        }
    }
    Ok(())
}
