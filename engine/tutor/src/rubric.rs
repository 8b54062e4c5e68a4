//! The rubric of an explain-back question, as an author writes it in a lesson file.
//!
//! Plain data: a sentence for each thing that a good answer says, phrases in everyday words
//! that say it, and example answers with their verdicts. Nothing here judges.

use serde::{Deserialize, Serialize};

fn yes() -> bool {
    true
}

/// One thing that a good answer says.
#[derive(Deserialize, Serialize, Clone, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Name within the item, kebab-case; logs and marked answers carry it.
    pub id: String,
    /// The thing itself, as a sentence for teachers.
    pub says: String,
    /// `false`: welcome, but a pass does not need it.
    #[serde(default = "yes")]
    pub required: bool,
    /// Ways to say it in everyday words. Each is enough by itself; a phrase that makes two
    /// statements ("the middle is dim and the rim is bright") asks for both.
    #[serde(default)]
    pub phrases: Vec<String>,
    /// Ways to say the contrary. An answer that says one of them does not meet the
    /// expectation, whatever else it says.
    #[serde(default)]
    pub against: Vec<String>,
    /// Id of the `[[reteach]]` shown when it is missed.
    #[serde(default)]
    pub reteach: Option<String>,
    /// The pointed question asked when the judge is unsure about it.
    #[serde(default)]
    pub ask: Option<String>,
    /// A nudge that does not give it away.
    #[serde(default)]
    pub hint: Option<String>,
}

/// One wrong thing that learners say.
#[derive(Deserialize, Serialize, Clone, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Misconception {
    /// Name within the item, kebab-case.
    pub id: String,
    /// The wrong thing itself, as a sentence for teachers.
    pub says: String,
    /// `true`: an answer that says it cannot pass. `false`: a slip, noted for later.
    pub blocking: bool,
    /// Ways to say it in everyday words, as in [`Expectation::phrases`].
    #[serde(default)]
    pub phrases: Vec<String>,
    /// Ways to say the contrary; an answer that says one of them does not hold it.
    #[serde(default)]
    pub against: Vec<String>,
    /// Expectations that, once met, make the same words harmless: "it is dim" is no mistake
    /// in an answer that also says where.
    #[serde(default)]
    pub unless: Vec<String>,
    /// `false`: marked answers do not carry it, so it is left out of every figure.
    #[serde(default = "yes")]
    pub marked: bool,
    /// Id of the `[[reteach]]` that takes it up.
    #[serde(default)]
    pub reteach: Option<String>,
    /// What the tutor answers when it hears this.
    #[serde(default)]
    pub says_back: Option<String>,
}

/// An answer with the verdict that the author gives it.
#[derive(Deserialize, Serialize, Clone, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Example {
    /// The answer.
    pub text: String,
    /// `pass`, `partial`, `fail` or `unsure`.
    pub verdict: String,
    /// Expectations that it meets, where the author cares to say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub met: Option<Vec<String>>,
    /// Misconceptions that it shows, where the author cares to say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub misconceptions: Option<Vec<String>>,
}

/// Everything the judge knows about one question.
#[derive(Deserialize, Serialize, Clone, Debug, PartialEq, Default)]
#[serde(deny_unknown_fields)]
pub struct Rubric {
    /// The question's id, such as `smith-g2/explain-3`.
    pub item: String,
    /// The question as the learner reads it. An answer that only repeats it says nothing,
    /// and "the first one" means the first thing it names.
    pub prompt: String,
    /// What a good answer says.
    #[serde(default)]
    pub expectation: Vec<Expectation>,
    /// What a wrong answer says.
    #[serde(default)]
    pub misconception: Vec<Misconception>,
    /// Answers with their verdicts, checked by `lobe check`.
    #[serde(default)]
    pub example: Vec<Example>,
}
