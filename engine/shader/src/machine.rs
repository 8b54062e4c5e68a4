//! Runs functions of a validated module, one step at a time, and counts the steps.
//!
//! What is evaluated is what the reader of WGSL wrote down: an arena of expressions, and
//! statements that say when each range of it is computed. So no expression, however deep,
//! recurses here; only blocks and calls do, and their depth is limited.

use naga::{Block, Expression, Function, Handle, Module, Statement, SwitchValue};

use crate::arithmetic;
use crate::halt::Halt;
use crate::math;
use crate::value::{self, Pointer, Scalar, Value, Vector};

/// How much a run may cost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Steps of one call.
    pub steps: u64,
    /// Steps of all calls together.
    pub all_steps: u64,
    /// Functions within functions.
    pub depth: usize,
    /// Numbers held in variables at once.
    pub room: u64,
}

impl Default for Limits {
    fn default() -> Limits {
        Limits {
            steps: 500_000,
            all_steps: 200_000_000,
            depth: 64,
            room: 65_536,
        }
    }
}

/// Gives the value of another expression of the same arena.
type Get<'a, M> = &'a mut dyn FnMut(&mut M, Handle<Expression>) -> Result<Value, Halt>;

/// What happens after a statement.
enum Flow {
    On,
    Break,
    Continue,
    Return(Option<Value>),
}

/// Where the things of one call stand on the stacks.
#[derive(Clone, Copy)]
struct Frame<'m> {
    function: &'m Function,
    values: usize,
    locals: usize,
    arguments: usize,
}

/// A module ready to run.
pub struct Machine<'m> {
    module: &'m Module,
    limits: Limits,
    /// Values of the expressions of all open calls.
    values: Vec<Value>,
    /// Variables of all open calls.
    locals: Vec<Value>,
    arguments: Vec<Value>,
    globals: Vec<Value>,
    /// Values of the module's own expressions.
    constants: Vec<Value>,
    /// Numbers that each function's variables hold, and that all open calls hold.
    rooms: Vec<u64>,
    held: u64,
    depth: usize,
    /// Steps left to this call, and to all.
    left: u64,
    all_left: u64,
}

impl<'m> Machine<'m> {
    /// A machine for a module that passed [`crate::support::check`].
    pub fn new(module: &'m Module, limits: Limits) -> Machine<'m> {
        let rooms = module.functions.iter().map(|(_, function)| {
            let variables = function.local_variables.iter();
            let counts = variables.map(|(_, it)| value::count(module, it.ty));
            counts.fold(0, u64::saturating_add)
        });
        Machine {
            module,
            limits,
            rooms: rooms.collect(),
            held: 0,
            values: Vec::new(),
            locals: Vec::new(),
            arguments: Vec::new(),
            globals: Vec::new(),
            constants: vec![Value::Nothing; module.global_expressions.len()],
            depth: 0,
            left: 0,
            all_left: limits.all_steps,
        }
    }

    /// Calls a function of numbers that returns a number; every call begins afresh.
    pub fn call(&mut self, function: Handle<Function>, arguments: &[f32]) -> Result<f32, Halt> {
        self.left = self.limits.steps;
        self.depth = 0;
        self.held = 0;
        self.values.clear();
        self.locals.clear();
        self.arguments.clear();
        self.globals.clear();
        for (_, variable) in self.module.global_variables.iter() {
            let value = match variable.init {
                Some(init) => self.constant(init)?,
                None => value::zero(self.module, variable.ty)?,
            };
            self.globals.push(value);
        }
        let arguments = arguments.iter().map(|value| Value::f32(*value)).collect();
        match self.enter(function, arguments)? {
            Some(Value::Scalar(Scalar::F32(value))) => Ok(value),
            Some(_) => Err(Halt::Unexpected("an f32")),
            None => Err(Halt::NoValue),
        }
    }

    fn spend(&mut self, steps: u64) -> Result<(), Halt> {
        self.left = self.left.checked_sub(steps).ok_or(Halt::Steps)?;
        self.all_left = self.all_left.checked_sub(steps).ok_or(Halt::AllSteps)?;
        Ok(())
    }

    fn enter(
        &mut self,
        function: Handle<Function>,
        arguments: Vec<Value>,
    ) -> Result<Option<Value>, Halt> {
        let room = self.rooms[function.index()];
        let function = &self.module.functions[function];
        self.held = self.held.saturating_add(room);
        if self.held > self.limits.room {
            return Err(Halt::Room);
        }
        if self.depth >= self.limits.depth {
            return Err(Halt::Depth);
        }
        self.depth += 1;
        let frame = Frame {
            function,
            values: self.values.len(),
            locals: self.locals.len(),
            arguments: self.arguments.len(),
        };
        // Zeroing what it holds is work too.
        self.spend(1 + (room + function.expressions.len() as u64) / 16)?;
        let expressions = frame.values + function.expressions.len();
        self.values.resize(expressions, Value::Nothing);
        self.arguments.extend(arguments);
        for (_, variable) in function.local_variables.iter() {
            let value = match variable.init {
                Some(init) => self.get(frame, init)?,
                None => value::zero(self.module, variable.ty)?,
            };
            self.locals.push(value);
        }
        let flow = self.block(frame, &function.body)?;
        self.values.truncate(frame.values);
        self.locals.truncate(frame.locals);
        self.arguments.truncate(frame.arguments);
        self.depth -= 1;
        self.held -= room;
        Ok(match flow {
            Flow::Return(value) => value,
            Flow::On | Flow::Break | Flow::Continue => None,
        })
    }

    fn block(&mut self, frame: Frame<'m>, block: &'m Block) -> Result<Flow, Halt> {
        for statement in block.iter() {
            match self.statement(frame, statement)? {
                Flow::On => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::On)
    }

    fn statement(&mut self, frame: Frame<'m>, statement: &'m Statement) -> Result<Flow, Halt> {
        self.spend(1)?;
        match statement {
            Statement::Emit(range) => {
                for handle in range.clone() {
                    self.spend(1)?;
                    let value = self.evaluate(frame, handle)?;
                    self.values[frame.values + handle.index()] = value;
                }
            }
            Statement::Block(block) => return self.block(frame, block),
            Statement::If {
                condition,
                accept,
                reject,
            } => {
                let taken = if self.get(frame, *condition)?.bool()? {
                    accept
                } else {
                    reject
                };
                return self.block(frame, taken);
            }
            Statement::Switch { selector, cases } => {
                let selector = self.get(frame, *selector)?;
                let matches = |value: &SwitchValue| match (value, &selector) {
                    (SwitchValue::I32(case), Value::Scalar(Scalar::I32(value))) => case == value,
                    (SwitchValue::U32(case), Value::Scalar(Scalar::U32(value))) => case == value,
                    _ => false,
                };
                let default = |value: &SwitchValue| matches!(value, SwitchValue::Default);
                let at = cases
                    .iter()
                    .position(|case| matches(&case.value))
                    .or_else(|| cases.iter().position(|case| default(&case.value)));
                for case in at.map_or(&[][..], |at| &cases[at..]) {
                    match self.block(frame, &case.body)? {
                        Flow::On if case.fall_through => {}
                        Flow::On | Flow::Break => break,
                        other => return Ok(other),
                    }
                }
            }
            Statement::Loop {
                body,
                continuing,
                break_if,
            } => loop {
                self.spend(1)?;
                match self.block(frame, body)? {
                    Flow::Break => break,
                    Flow::On | Flow::Continue => {}
                    Flow::Return(value) => return Ok(Flow::Return(value)),
                }
                let _ = self.block(frame, continuing)?;
                if let Some(condition) = break_if
                    && self.get(frame, *condition)?.bool()?
                {
                    break;
                }
            },
            Statement::Break => return Ok(Flow::Break),
            Statement::Continue => return Ok(Flow::Continue),
            Statement::Return { value } => {
                let value = value.map(|value| self.get(frame, value)).transpose()?;
                return Ok(Flow::Return(value));
            }
            Statement::Store { pointer, value } => {
                let value = self.get(frame, *value)?;
                let pointer = self.pointer(frame, *pointer)?;
                let stored = self.variable(&pointer)?;
                let copied = stored.write(&pointer.path, value)?;
                self.spend(copied as u64)?;
            }
            Statement::Call {
                function,
                arguments,
                result,
            } => {
                let arguments = arguments.iter().map(|argument| self.get(frame, *argument));
                let arguments = arguments.collect::<Result<Vec<_>, _>>()?;
                let value = self.enter(*function, arguments)?;
                if let Some(result) = result {
                    let value = value.ok_or(Halt::NoValue)?;
                    self.values[frame.values + result.index()] = value;
                }
            }
            // Everything else was refused before it ran.
            _ => return Err(Halt::Unexpected("a statement that runs on a CPU")),
        }
        Ok(Flow::On)
    }

    /// The value of an expression: as computed last, else computed now.
    fn get(&mut self, frame: Frame<'m>, handle: Handle<Expression>) -> Result<Value, Halt> {
        let at = frame.values + handle.index();
        if let Value::Nothing = self.values[at] {
            // Literals and the like are never announced by a statement.
            self.values[at] = self.evaluate(frame, handle)?;
        }
        Ok(self.values[at].clone())
    }

    fn pointer(&mut self, frame: Frame<'m>, handle: Handle<Expression>) -> Result<Pointer, Halt> {
        match self.get(frame, handle)? {
            Value::Pointer(pointer) => Ok(pointer),
            _ => Err(Halt::Unexpected("a pointer")),
        }
    }

    fn variable(&mut self, pointer: &Pointer) -> Result<&mut Value, Halt> {
        let all = match pointer.global {
            true => &mut self.globals,
            false => &mut self.locals,
        };
        all.get_mut(pointer.at)
            .ok_or(Halt::Unexpected("a variable"))
    }

    fn load(&mut self, pointer: &Pointer) -> Result<Value, Halt> {
        let stored = self.variable(pointer)?;
        let mut path = pointer.path.iter();
        let Some(first) = path.next() else {
            return Ok(stored.clone());
        };
        path.try_fold(stored.part(*first)?, |value, index| value.part(*index))
    }

    /// One part of a value, or of what a pointer points to.
    fn access(base: Value, index: u32) -> Result<Value, Halt> {
        match base {
            Value::Pointer(mut pointer) => {
                pointer.path.push(index);
                Ok(Value::Pointer(pointer))
            }
            value => value.part(index),
        }
    }

    fn evaluate(&mut self, frame: Frame<'m>, handle: Handle<Expression>) -> Result<Value, Halt> {
        let expression = &frame.function.expressions[handle];
        match expression {
            Expression::FunctionArgument(index) => {
                let argument = self.arguments.get(frame.arguments + *index as usize);
                argument.cloned().ok_or(Halt::Unexpected("an argument"))
            }
            Expression::LocalVariable(variable) => Ok(Value::Pointer(Pointer {
                global: false,
                at: frame.locals + variable.index(),
                path: Vec::new(),
            })),
            Expression::GlobalVariable(variable) => Ok(Value::Pointer(Pointer {
                global: true,
                at: variable.index(),
                path: Vec::new(),
            })),
            Expression::Load { pointer } => {
                let pointer = self.pointer(frame, *pointer)?;
                self.load(&pointer)
            }
            Expression::Access { base, index } => {
                let index = self.get(frame, *index)?.index()?;
                Self::access(self.get(frame, *base)?, index)
            }
            _ => {
                let module = self.module;
                let get = &mut |machine: &mut Self, handle| machine.get(frame, handle);
                self.pure(module, expression, get)
            }
        }
    }

    /// A constant of the module.
    fn constant(&mut self, handle: Handle<Expression>) -> Result<Value, Halt> {
        let at = handle.index();
        if let Value::Nothing = self.constants[at] {
            let module = self.module;
            let expression = &module.global_expressions[handle];
            let get = &mut |machine: &mut Self, handle| machine.constant(handle);
            self.constants[at] = self.pure(module, expression, get)?;
        }
        Ok(self.constants[at].clone())
    }

    /// An expression that depends on nothing but other expressions, which `get` gives.
    fn pure(
        &mut self,
        module: &'m Module,
        expression: &'m Expression,
        get: Get<'_, Self>,
    ) -> Result<Value, Halt> {
        Ok(match expression {
            Expression::Literal(literal) => {
                let scalar = value::literal(*literal);
                Value::Scalar(scalar.ok_or(Halt::Unexpected("a number of 32 bits"))?)
            }
            Expression::Constant(constant) => self.constant(module.constants[*constant].init)?,
            Expression::ZeroValue(ty) => value::zero(module, *ty)?,
            Expression::Compose { ty, components } => {
                let mut parts = Vec::with_capacity(components.len());
                for component in components {
                    parts.push(get(self, *component)?);
                }
                compose(module, *ty, parts)?
            }
            Expression::Splat { size, value } => {
                let scalar = get(self, *value)?.scalar()?;
                Value::Vector(Vector::new(&[scalar; 4][..*size as usize]))
            }
            Expression::Swizzle {
                size,
                vector,
                pattern,
            } => {
                let vector = get(self, *vector)?;
                let lanes = vector.lanes()?;
                let picked = pattern[..*size as usize].iter().map(|component| {
                    let index = *component as u32;
                    let len = lanes.len();
                    let lane = lanes.get(index as usize).copied();
                    lane.ok_or(Halt::PastTheEnd { index, len })
                });
                Value::Vector(Vector::new(&picked.collect::<Result<Vec<_>, _>>()?))
            }
            Expression::AccessIndex { base, index } => Self::access(get(self, *base)?, *index)?,
            Expression::Access { base, index } => {
                let index = get(self, *index)?.index()?;
                Self::access(get(self, *base)?, index)?
            }
            Expression::Unary { op, expr } => arithmetic::unary(*op, &get(self, *expr)?)?,
            Expression::Binary { op, left, right } => {
                let left = get(self, *left)?;
                arithmetic::binary(*op, &left, &get(self, *right)?)?
            }
            Expression::Select {
                condition,
                accept,
                reject,
            } => {
                let condition = get(self, *condition)?;
                let accept = get(self, *accept)?;
                select(&condition, accept, get(self, *reject)?)?
            }
            Expression::Relational { fun, argument } => relational(*fun, &get(self, *argument)?)?,
            Expression::Math {
                fun,
                arg,
                arg1,
                arg2,
                arg3,
            } => {
                let mut arguments = vec![get(self, *arg)?];
                for more in [arg1, arg2, arg3].into_iter().flatten() {
                    arguments.push(get(self, *more)?);
                }
                math::call(*fun, &arguments)?
            }
            Expression::As {
                expr,
                kind,
                convert,
            } => arithmetic::convert(&get(self, *expr)?, *kind, convert.is_none())?,
            // Everything else was refused before it ran.
            _ => return Err(Halt::Unexpected("an expression that runs on a CPU")),
        })
    }
}

fn compose(module: &Module, ty: Handle<naga::Type>, parts: Vec<Value>) -> Result<Value, Halt> {
    if let naga::TypeInner::Vector { .. } = module.types[ty].inner {
        // A vector is put together from numbers and shorter vectors.
        let mut lanes = Vec::with_capacity(4);
        for part in &parts {
            lanes.extend_from_slice(part.lanes()?);
        }
        return Ok(Value::Vector(Vector::new(&lanes)));
    }
    Ok(Value::composite(parts))
}

fn select(condition: &Value, accept: Value, reject: Value) -> Result<Value, Halt> {
    let Value::Vector(conditions) = condition else {
        return Ok(if condition.bool()? { accept } else { reject });
    };
    let (accept, reject) = (accept.lanes()?, reject.lanes()?);
    let lanes = conditions.lanes().iter().zip(accept.iter().zip(reject));
    let chosen = lanes.map(|(condition, (accept, reject))| match condition {
        Scalar::Bool(true) => *accept,
        _ => *reject,
    });
    Ok(Value::Vector(Vector::new(&chosen.collect::<Vec<_>>())))
}

fn relational(fun: naga::RelationalFunction, argument: &Value) -> Result<Value, Halt> {
    use naga::RelationalFunction as Fun;
    let is_true = |lane: &Scalar| *lane == Scalar::Bool(true);
    match fun {
        Fun::All => Ok(Scalar::Bool(argument.lanes()?.iter().all(is_true))),
        Fun::Any => Ok(Scalar::Bool(argument.lanes()?.iter().any(is_true))),
        Fun::IsNan | Fun::IsInf => Err(Halt::Unexpected("a function that WGSL has")),
    }
    .map(Value::Scalar)
}
