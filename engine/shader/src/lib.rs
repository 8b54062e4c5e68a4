//! One function of WGSL, read and run on the CPU.
//!
//! A text that somebody wrote is read and validated by naga, and a function of it is called
//! with numbers, step by step, in f32. Nothing is compiled and no graphics processor is asked,
//! so that it runs where there is none, and every step is counted: a loop without an end, an
//! avalanche of calls or an array without bounds ends in a [`Stop`] with a sentence.
//!
//! What cannot be counted is the reader itself. Whoever runs the texts of others does it in a
//! process of its own, with limits to its memory and its time. Nothing here touches a file, a
//! process or a clock.

mod arithmetic;
mod halt;
mod invalid;
mod machine;
mod math;
mod names;
mod read;
mod support;
mod value;
mod words;

pub use machine::Limits;

use halt::Halt;
use machine::Machine;
use naga::{Function, Handle, Module};
use serde::{Deserialize, Serialize};

/// The most bytes of a text that are read.
pub const MOST_BYTES: usize = 64 * 1024;

/// What is to be run.
#[derive(Serialize, Deserialize, Clone, Debug, Default, PartialEq)]
pub struct Task {
    /// The text.
    pub source: String,
    /// Functions that the text may call, in WGSL.
    pub offered: String,
    /// The function to call.
    pub function: String,
    /// Names of its parameters, all of type f32; it returns an f32.
    pub params: Vec<String>,
    /// The arguments of each call, in the order of the parameters.
    #[serde(with = "bits::rows")]
    pub points: Vec<Vec<f32>>,
}

/// What came of it.
#[must_use]
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// What the function returned, call by call; a NaN is a value too.
    Values(#[serde(with = "bits")] Vec<f32>),
    /// The text is not WGSL, not this function, or nothing that runs here.
    Refused(Complaint),
    /// A call came to no end, or to none that counts.
    Stopped(Stop),
}

/// What is wrong with a text.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq, Eq)]
pub struct Complaint {
    /// One sentence.
    pub says: String,
    /// What to do about it.
    pub help: Option<String>,
    /// Where, unless it is about the whole.
    pub place: Option<Place>,
}

/// A place in a text.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// How many characters it is about, at least 1.
    pub width: usize,
    /// The line, without control characters; of a long line the part around it.
    pub text: String,
    /// Where it is in `text`, in characters from 1.
    pub mark: usize,
}

/// Why a call gave no value.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq, Eq)]
pub struct Stop {
    /// Which call, from 0.
    pub point: usize,
    /// One sentence.
    pub says: String,
}

/// A text that was read, and its function.
#[derive(Debug)]
pub struct Program {
    module: Module,
    function: Handle<Function>,
    limits: Limits,
}

impl Program {
    /// Reads the text of a task.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(task: &Task, limits: Limits) -> Result<Program, Complaint> {
        let (module, function) = read::read(task, limits)?;
        Ok(Program {
            module,
            function,
            limits,
        })
    }

    /// Calls the function with the arguments of each point.
    ///
    /// # Errors
    /// The first call that gave no value.
    pub fn values(&self, points: &[Vec<f32>]) -> Result<Vec<f32>, Stop> {
        let mut machine = Machine::new(&self.module, self.limits);
        let mut values = Vec::with_capacity(points.len());
        for (point, arguments) in points.iter().enumerate() {
            let value = machine.call(self.function, arguments);
            values.push(value.map_err(|halt| Stop {
                point,
                says: sentence(halt, self.limits),
            })?);
        }
        Ok(values)
    }
}

/// Reads the text and calls its function.
pub fn run(task: &Task, limits: Limits) -> Outcome {
    match Program::read(task, limits) {
        Err(complaint) => Outcome::Refused(complaint),
        Ok(program) => match program.values(&task.points) {
            Ok(values) => Outcome::Values(values),
            Err(stop) => Outcome::Stopped(stop),
        },
    }
}

fn sentence(halt: Halt, limits: Limits) -> String {
    match halt {
        Halt::Steps => format!(
            "It had not returned after {} steps: does a loop never end?",
            thousands(limits.steps)
        ),
        Halt::AllSteps => "It takes too many steps to be run at every point.".to_owned(),
        Halt::Depth => format!("Functions call functions more than {} deep.", limits.depth),
        Halt::Room => format!(
            "Its variables hold more than {} numbers at once.",
            thousands(limits.room)
        ),
        Halt::PastTheEnd { index, len } => match i32::try_from(index) {
            Ok(index) => format!("Index {index} is past the end: there are {len}, counted from 0."),
            Err(_) => format!("A negative index is no place among the {len} there are."),
        },
        Halt::NoValue => "It came to its end without returning a value.".to_owned(),
        Halt::Unexpected(what) => format!("It cannot be run here: {what} was expected."),
    }
}

/// `500000` as `500,000`.
fn thousands(number: u64) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}

/// Floating-point numbers as their bits: JSON knows no NaN, and no digit is lost.
mod bits {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(values: &[f32], serializer: S) -> Result<S::Ok, S::Error> {
        let bits: Vec<u32> = values.iter().map(|value| value.to_bits()).collect();
        bits.serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f32>, D::Error> {
        let bits = Vec::<u32>::deserialize(deserializer)?;
        Ok(bits.into_iter().map(f32::from_bits).collect())
    }

    pub mod rows {
        use serde::{Deserialize, Deserializer, Serialize, Serializer};

        pub fn serialize<S: Serializer>(
            rows: &[Vec<f32>],
            serializer: S,
        ) -> Result<S::Ok, S::Error> {
            let bits = |row: &Vec<f32>| row.iter().map(|value| value.to_bits()).collect();
            let rows: Vec<Vec<u32>> = rows.iter().map(bits).collect();
            rows.serialize(serializer)
        }

        pub fn deserialize<'de, D: Deserializer<'de>>(
            deserializer: D,
        ) -> Result<Vec<Vec<f32>>, D::Error> {
            let rows = Vec::<Vec<u32>>::deserialize(deserializer)?;
            let floats = |row: Vec<u32>| row.into_iter().map(f32::from_bits).collect();
            Ok(rows.into_iter().map(floats).collect())
        }
    }
}
