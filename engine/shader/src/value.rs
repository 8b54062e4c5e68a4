//! What a shader computes with: numbers, vectors, and what is made of them.

use std::rc::Rc;

use naga::{ArraySize, Handle, Literal, Module, Type, TypeInner};

use crate::halt::Halt;

/// A number or a truth value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    Bool(bool),
    I32(i32),
    U32(u32),
    F32(f32),
}

/// Two to four scalars.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector {
    len: u8,
    lanes: [Scalar; 4],
}

impl Vector {
    /// A vector of at most four scalars; what is beyond is dropped.
    pub fn new(scalars: &[Scalar]) -> Vector {
        let mut lanes = [Scalar::F32(0.0); 4];
        let len = scalars.len().min(4);
        lanes[..len].copy_from_slice(&scalars[..len]);
        Vector {
            len: len as u8,
            lanes,
        }
    }

    pub fn lanes(&self) -> &[Scalar] {
        &self.lanes[..usize::from(self.len)]
    }

    pub fn lanes_mut(&mut self) -> &mut [Scalar] {
        &mut self.lanes[..usize::from(self.len)]
    }
}

/// Anything a variable can hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Not computed yet.
    Nothing,
    Scalar(Scalar),
    Vector(Vector),
    /// The columns of a matrix, the elements of an array, the members of a struct. Shared until
    /// written to, so that looking at one element copies none.
    Composite(Rc<Vec<Value>>),
    Pointer(Pointer),
}

/// Where something is stored.
#[derive(Clone, Debug, PartialEq)]
pub struct Pointer {
    /// Whether the variable is one of the module's, not of a function.
    pub global: bool,
    /// Its place among all of that sort.
    pub at: usize,
    /// Which part of it, from the outside inwards.
    pub path: Vec<u32>,
}

impl Value {
    pub fn f32(value: f32) -> Value {
        Value::Scalar(Scalar::F32(value))
    }

    pub fn composite(parts: Vec<Value>) -> Value {
        Value::Composite(Rc::new(parts))
    }

    /// The scalar, where it is one.
    pub fn scalar(&self) -> Result<Scalar, Halt> {
        match self {
            Value::Scalar(scalar) => Ok(*scalar),
            _ => Err(Halt::Unexpected("a number")),
        }
    }

    pub fn bool(&self) -> Result<bool, Halt> {
        match self {
            Value::Scalar(Scalar::Bool(value)) => Ok(*value),
            _ => Err(Halt::Unexpected("a truth value")),
        }
    }

    /// An index; negative ones are past every end.
    pub fn index(&self) -> Result<u32, Halt> {
        match self {
            Value::Scalar(Scalar::U32(index)) => Ok(*index),
            Value::Scalar(Scalar::I32(index)) => Ok(u32::try_from(*index).unwrap_or(u32::MAX)),
            _ => Err(Halt::Unexpected("an index")),
        }
    }

    /// The scalars of a scalar or a vector.
    pub fn lanes(&self) -> Result<&[Scalar], Halt> {
        match self {
            Value::Scalar(scalar) => Ok(std::slice::from_ref(scalar)),
            Value::Vector(vector) => Ok(vector.lanes()),
            _ => Err(Halt::Unexpected("a number or a vector")),
        }
    }

    /// Its lanes as floating-point numbers.
    pub fn floats(&self) -> Result<Vec<f32>, Halt> {
        self.lanes()?
            .iter()
            .map(|lane| match lane {
                Scalar::F32(value) => Ok(*value),
                _ => Err(Halt::Unexpected("an f32")),
            })
            .collect()
    }

    /// One part: a lane, a column, an element, a member.
    pub fn part(&self, index: u32) -> Result<Value, Halt> {
        let at = index as usize;
        let (part, len) = match self {
            Value::Vector(vector) => {
                let lanes = vector.lanes();
                (lanes.get(at).copied().map(Value::Scalar), lanes.len())
            }
            Value::Composite(parts) => (parts.get(at).cloned(), parts.len()),
            _ => return Err(Halt::Unexpected("something with parts")),
        };
        part.ok_or(Halt::PastTheEnd { index, len })
    }

    /// Writes one part, found along a path. Gives how many parts had to be copied.
    pub fn write(&mut self, path: &[u32], value: Value) -> Result<usize, Halt> {
        let Some((&index, rest)) = path.split_first() else {
            *self = value;
            return Ok(0);
        };
        match self {
            Value::Vector(vector) => {
                let len = vector.lanes().len();
                let lane = vector.lanes_mut().get_mut(index as usize);
                *lane.ok_or(Halt::PastTheEnd { index, len })? = value.scalar()?;
                Ok(0)
            }
            Value::Composite(parts) => {
                let copied = match Rc::strong_count(parts) {
                    1 => 0,
                    _ => parts.len(),
                };
                let parts = Rc::make_mut(parts);
                let len = parts.len();
                let part = parts.get_mut(index as usize);
                let inner = part.ok_or(Halt::PastTheEnd { index, len })?;
                Ok(copied + inner.write(rest, value)?)
            }
            _ => Err(Halt::Unexpected("something with parts")),
        }
    }
}

/// A literal, where this machine knows its type.
pub fn literal(literal: Literal) -> Option<Scalar> {
    Some(match literal {
        Literal::F32(value) => Scalar::F32(value),
        Literal::U32(value) => Scalar::U32(value),
        Literal::I32(value) => Scalar::I32(value),
        Literal::Bool(value) => Scalar::Bool(value),
        Literal::AbstractInt(value) => Scalar::I32(i32::try_from(value).ok()?),
        Literal::AbstractFloat(value) => Scalar::F32(value as f32),
        _ => return None,
    })
}

/// A zero of that sort of number.
fn zero_scalar(scalar: naga::Scalar) -> Option<Scalar> {
    match scalar {
        naga::Scalar::BOOL => Some(Scalar::Bool(false)),
        naga::Scalar::I32 => Some(Scalar::I32(0)),
        naga::Scalar::U32 => Some(Scalar::U32(0)),
        naga::Scalar::F32 => Some(Scalar::F32(0.0)),
        _ => None,
    }
}

/// The zero of a type. Its size was looked at before.
pub fn zero(module: &Module, ty: Handle<Type>) -> Result<Value, Halt> {
    let scalar = |of| zero_scalar(of).ok_or(Halt::Unexpected("a number of 32 bits"));
    Ok(match &module.types[ty].inner {
        TypeInner::Scalar(of) => Value::Scalar(scalar(*of)?),
        TypeInner::Vector { size, scalar: of } => {
            Value::Vector(Vector::new(&[scalar(*of)?; 4][..*size as usize]))
        }
        TypeInner::Matrix {
            columns,
            rows,
            scalar: of,
        } => {
            let column = Value::Vector(Vector::new(&[scalar(*of)?; 4][..*rows as usize]));
            Value::composite(vec![column; *columns as usize])
        }
        TypeInner::Array {
            base,
            size: ArraySize::Constant(len),
            ..
        } => Value::composite(vec![zero(module, *base)?; len.get() as usize]),
        TypeInner::Struct { members, .. } => {
            let members = members.iter().map(|member| zero(module, member.ty));
            Value::composite(members.collect::<Result<_, _>>()?)
        }
        _ => return Err(Halt::Unexpected("a type that holds numbers")),
    })
}

/// How many numbers a type holds, padding included; 0 where it holds none of its own.
pub fn count(module: &Module, ty: Handle<Type>) -> u64 {
    // From the sizes that reading computed: types within types within types are many.
    match &module.types[ty].inner {
        TypeInner::Scalar(_) => 1,
        TypeInner::Vector { size, .. } => *size as u64,
        TypeInner::Matrix { columns, rows, .. } => *columns as u64 * *rows as u64,
        TypeInner::Array {
            size: ArraySize::Constant(len),
            stride,
            ..
        } => u64::from(len.get()) * u64::from(*stride).div_ceil(4),
        TypeInner::Struct { span, .. } => u64::from(*span).div_ceil(4),
        _ => 0,
    }
}

/// Whether a type is made of what this machine computes with; what it is made of is asked by
/// itself.
pub fn knows(inner: &TypeInner) -> bool {
    match inner {
        TypeInner::Scalar(scalar)
        | TypeInner::Vector { scalar, .. }
        | TypeInner::Matrix { scalar, .. }
        | TypeInner::ValuePointer { scalar, .. } => zero_scalar(*scalar).is_some(),
        TypeInner::Array { size, .. } => matches!(size, ArraySize::Constant(_)),
        TypeInner::Struct { .. } | TypeInner::Pointer { .. } => true,
        _ => false,
    }
}
