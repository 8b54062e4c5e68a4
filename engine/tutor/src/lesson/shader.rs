//! What a lesson file says about a shader to be mended.

use super::{Formula, Given, Text};

/// A WGSL function with a bug. Its parameters are the exercise's variables, in their order, each
/// of type f32; it returns an f32.
#[derive(Clone, Debug)]
pub struct ShaderTask {
    /// The function's name.
    pub function: Text,
    /// Names of formulas, the core's or the lesson's, that the text may call.
    pub offers: Vec<Text>,
    /// The text as the learner gets it.
    pub source: Text,
    /// What the function should compute.
    pub is: Formula,
    /// A text that does: the last hint.
    pub solution: Text,
    /// The ball on which the function is drawn; no picture where empty.
    pub scene: Vec<Given>,
}
