//! Formulas as data: one line of text is parsed once into a tree, and the tree gives its
//! value (f64 or f32), its substitution line by line, its Unicode and LaTeX spelling, its
//! plausible mistakes ([`Mutant`]), its WGSL source and a flat [`Program`] for blocks of
//! pixels. What a lesson says, what the core computes and what the GPU draws come from the
//! same tree and cannot drift apart.
//!
//! ```
//! let mut library = formula::Library::new();
//! library.define("s", &["c", "alpha"], "sqrt(alpha^2 + (1 - alpha^2) * c^2)")?;
//! let root = formula::parse("s(c = n_dot_v)")?;
//! let given = [("roughness", 0.4), ("n_dot_v", 0.8)];
//! let given = given.map(|(name, value)| (name.to_string(), value)).into();
//! let value = library.eval(&root, &given)?;
//! assert_eq!(formula::format_number(value, formula::Digits::Significant(4)), "0.8057");
//! # Ok::<(), formula::Error>(())
//! ```
//!
//! Everything here is total: no input panics, recurses without bound or runs long. Texts
//! have a greatest length and depth ([`MAX_TEXT`], [`MAX_DEPTH`]), and a formula with its
//! definitions opened has a greatest size ([`MAX_OPERATIONS`]).
//!
//! This crate must never touch files, the environment, the clock, threads or randomness.

mod algebra;
mod answer;
mod block;
mod builtin;
mod code;
mod constant;
mod dag;
mod digits;
mod error;
mod eval;
mod expr;
mod lanes;
mod latex;
mod lex;
mod library;
mod lower;
mod machine;
mod memory;
mod mutant;
mod mutate;
mod parse;
mod pretty;
mod program;
mod schedule;
mod scope;
mod spelling;
mod steps;
mod substitution;
mod wgsl;

pub use answer::parse_answer;
pub use builtin::builtin_names;
pub use digits::{Digits, agrees_with_printed, format_number, significant_digits};
pub use error::{Error, Span};
pub use expr::{Arg, BinaryOp, CompareOp, Expr, Node};
pub use library::{Definition, Library, MAX_OPERATIONS, Values};
pub use mutant::{Mutant, MutantKind};
pub use parse::{MAX_DEPTH, MAX_TEXT, parse};
pub use program::{Column, Program, Scratch};
pub use spelling::{latex_name, unicode_name};
pub use substitution::Substitution;
pub use wgsl::Wgsl;
