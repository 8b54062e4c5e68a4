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
    /// The pointed question asked where it is missing or the judge is unsure about it. It does
    /// not give it away.
    #[serde(default)]
    pub ask: Option<String>,
    /// A nudge that does not give it away, after the question.
    #[serde(default)]
    pub hint: Option<String>,
    /// The thing as one sentence with its decisive words in square brackets, after the nudge:
    /// "At the rim the ball is [too bright]." The learner sees a blank in their place. A
    /// question in round brackets is for the learner only: "(which way?)".
    #[serde(default)]
    pub prompt: Option<String>,
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
    /// Criteria that, once heard, make the same words harmless: "it is dim" is no mistake
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
    /// The pointed question asked where the judge is unsure whether the answer says it.
    #[serde(default)]
    pub ask: Option<String>,
    /// A nudge that does not give it away, after the question.
    #[serde(default)]
    pub hint: Option<String>,
    /// The truth as one sentence with a blank, as in [`Expectation::prompt`].
    #[serde(default)]
    pub prompt: Option<String>,
}

/// A sentence with its decisive words in square brackets, taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Blank<'a> {
    before: &'a str,
    /// The author's words for the blank.
    pub fill: &'a str,
    after: &'a str,
}

impl<'a> Blank<'a> {
    /// The first pair of square brackets of a prompt; `None` where there is none.
    pub fn of(prompt: &'a str) -> Option<Blank<'a>> {
        let (before, rest) = prompt.split_once('[')?;
        let (fill, after) = rest.split_once(']')?;
        Some(Blank {
            before,
            fill,
            after,
        })
    }

    /// As the learner sees it.
    pub fn open(&self) -> String {
        format!("{}\\_\\_\\_{}", self.before, self.after)
    }

    /// The sentence with these words in the blank, and without questions in round brackets.
    pub fn filled(&self, words: &str) -> String {
        let words = words.trim().trim_end_matches(['.', '!', '?']);
        let whole = format!(
            "{}{words}{}",
            aside_removed(self.before),
            aside_removed(self.after)
        );
        whole.trim().to_owned()
    }
}

/// The text without the questions that stand in round brackets.
fn aside_removed(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('(') {
        match after.split_once(')') {
            Some((aside, behind)) if aside.trim_end().ends_with('?') => {
                out.push_str(before.trim_end());
                rest = behind;
            }
            _ => {
                out.push_str(before);
                out.push('(');
                rest = after;
            }
        }
    }
    out + rest
}

/// What the tutor has to say about one criterion, expectation or misconception alike.
#[derive(Clone, Copy, Debug)]
pub struct Criterion<'a> {
    /// Its id.
    pub id: &'a str,
    /// The sentence for teachers.
    pub says: &'a str,
    /// The pointed question.
    pub ask: Option<&'a str>,
    /// The nudge.
    pub hint: Option<&'a str>,
    /// The sentence with a blank.
    pub prompt: Option<&'a str>,
    /// Whether it is a wrong thing.
    pub is_misconception: bool,
    /// Whether a verdict hangs on it: a required expectation, a blocking misconception.
    pub decides: bool,
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

impl Rubric {
    /// Expectations, then misconceptions, in the rubric's order.
    pub fn criteria(&self) -> impl Iterator<Item = Criterion<'_>> {
        let expectations = self.expectation.iter().map(|it| Criterion {
            id: &it.id,
            says: &it.says,
            ask: it.ask.as_deref(),
            hint: it.hint.as_deref(),
            prompt: it.prompt.as_deref(),
            is_misconception: false,
            decides: it.required,
        });
        let misconceptions = self.misconception.iter().map(|it| Criterion {
            id: &it.id,
            says: &it.says,
            ask: it.ask.as_deref(),
            hint: it.hint.as_deref(),
            prompt: it.prompt.as_deref(),
            is_misconception: true,
            decides: it.blocking,
        });
        expectations.chain(misconceptions)
    }

    /// The criterion of that id.
    pub fn criterion(&self, id: &str) -> Option<Criterion<'_>> {
        self.criteria().find(|criterion| criterion.id == id)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_blank(prompt: &str, seen: &str, words: &str, filled: &str) {
        let blank = Blank::of(prompt).expect("square brackets");
        assert_eq!(blank.open().replace('\\', ""), seen);
        assert_eq!(blank.filled(words), filled);
    }

    #[test]
    fn a_blank_is_seen_and_filled() {
        check_blank("It is [1/π].", "It is ___.", "0.3.", "It is 0.3.");
        check_blank(
            "The rim is [bright] (bright or dark?).",
            "The rim is ___ (bright or dark?).",
            " dark ",
            "The rim is dark.",
        );
        check_blank("f(x) is [1]", "f(x) is ___", "2", "f(x) is 2");
        check_blank("[Up]", "___", "", "");
        assert_eq!(Blank::of("no blank ["), None);
        assert_eq!(Blank::of("] no blank ["), None);
    }
}
