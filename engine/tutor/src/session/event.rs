//! What comes in, what goes out, and what is kept of a session.

pub use super::dialogue::Rung;
use crate::exercise::look::Sight;
use crate::exercise::shader::{Job, Ran};
use crate::judge::Why;
use crate::opinion::Finding;
use crate::view::Stage;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What the learner or the machine tells the session.
#[derive(Clone, Debug, PartialEq)]
pub enum Msg {
    /// Go on: next line, next question, next screen.
    Next,
    /// Look at the screen before; nothing is lost.
    Back,
    /// Leave this out.
    Skip,
    /// One hint more.
    Hint,
    /// A number, an option's letter or number, an order "2 1 3", or an explanation.
    Answer(String),
    /// What stands in the text field, not handed in.
    Draft(String),
    /// The learner says whether his answer makes a point of the checklist.
    Mark {
        /// Position of the point, from 0.
        point: usize,
        /// Whether the answer says it.
        said: bool,
    },
    /// The checklist is marked as it should be.
    ChecklistDone,
    /// What the second opinion that [`Effect::Consult`] asked for came to.
    SecondOpinion {
        /// Id of the question.
        item: String,
        /// The try it is about.
        attempt: u32,
        /// The reply it is about, from 1; 0 for the answer itself.
        reply: u32,
        /// Who was asked.
        by: String,
        /// What came back, unchecked; or why nothing did.
        said: Result<Vec<Finding>, String>,
    },
    /// What is seen at the place that [`Effect::Look`] asked about.
    Looked(Sight),
    /// What came of the shader that [`Effect::Run`] asked to have run.
    Ran(Ran),
    /// Ask these items alone, by their ids: they are due again. Only before anything else.
    AskDue(Vec<String>),
    /// The log could not be written, and why.
    SaveFailed(String),
    /// Everything handed out by [`Effect::Save`] so far is on the disk.
    Saved,
    /// Leave; resuming comes back to this very screen.
    Quit,
}

/// What the app is asked to do.
#[must_use]
#[derive(Clone, Debug, PartialEq)]
// A handful at a time, and nearly all of them are events.
#[allow(clippy::large_enum_variant)]
pub enum Effect {
    /// Append to the log, and answer with [`Msg::Saved`] or [`Msg::SaveFailed`].
    Save(Event),
    /// A picture is on the screen: have it drawn.
    Draw {
        /// Id of the lesson.
        lesson: String,
        /// Id of the fingerprint.
        picture: String,
    },
    /// Have a second opinion on an answer, and bring it back as [`Msg::SecondOpinion`].
    Consult {
        /// Id of the question.
        item: String,
        /// The try it is about.
        attempt: u32,
        /// The reply it is about, from 1; 0 for the answer itself.
        reply: u32,
        /// The answer, and the replies up to that one, each on a line of its own.
        text: String,
        /// What was asked back, and replied to that.
        dialogue: Vec<(String, String)>,
    },
    /// The learner waits for it no longer.
    StopConsulting,
    /// Say what is seen at a place of a picture, with [`Msg::Looked`].
    Look {
        /// Id of the fingerprint.
        picture: String,
        /// To the right of the disc's centre, in its radii.
        x: f64,
        /// Upwards.
        y: f64,
    },
    /// Have the learner's shader run, somewhere it can do no harm, and answer with [`Msg::Ran`].
    Run(Box<Job>),
    /// Leave.
    Quit,
}

/// The learner's words that decided one criterion.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct Quote {
    /// Id of the expectation or misconception.
    pub id: String,
    /// The words.
    pub quote: String,
    /// Their first byte in the answer.
    pub start: usize,
    /// One past their last byte.
    pub end: usize,
}

impl From<Why> for Quote {
    fn from(why: Why) -> Quote {
        Quote {
            id: why.id,
            quote: why.quote,
            start: why.start,
            end: why.end,
        }
    }
}

/// A slip heard in an earlier lesson.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[serde(deny_unknown_fields)]
pub struct NotedSlip {
    /// Id of the misconception, such as `fresnel-falls-at-edge`.
    pub id: String,
    /// Id of the lesson in which it was heard.
    pub lesson: String,
}

/// How a finished lesson ended.
#[derive(Serialize, Deserialize, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[serde(rename_all = "kebab-case")]
pub enum Grade {
    /// Passed, as the judge heard it.
    Pass,
    /// Passed, where the learner marked at least one answer himself.
    SelfMarked,
    /// Not yet.
    NotYet,
}

/// What happened, with its outcome: applying events needs no judge.
///
/// Item ids are those of the lesson file; `step` names a line of an exercise.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq)]
#[serde(tag = "kind", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Event {
    /// On to a screen.
    Next {
        /// The stage it belongs to.
        stage: Stage,
        /// The screen's key.
        screen: String,
    },
    /// Back to a screen seen before.
    Back {
        /// The stage it belongs to.
        stage: Stage,
        /// The screen's key.
        screen: String,
    },
    /// One more line of the worked example.
    Revealed {
        /// How many lines are shown now.
        lines: usize,
    },
    /// A step of an exercise is left as it is.
    GoOn {
        /// Id of the exercise.
        item: String,
        /// 0 the first time, 1 in the re-test.
        round: u32,
        /// The step left.
        step: String,
    },
    /// A screen was left out; another event says where it went on.
    Skip {
        /// The screen's key.
        screen: String,
    },
    /// A hint was shown; in a dialogue about an answer, the next help was asked for.
    Hint {
        /// Id of the exercise or question.
        item: String,
        /// 0 the first time, 1 in the re-test; the try, for a question.
        round: u32,
        /// The step it is for; empty for a question; in a dialogue, the criterion.
        step: String,
        /// From 1 to 3.
        level: u8,
    },
    /// Text not yet handed in.
    Draft {
        /// Id of the question.
        item: String,
        /// What stands in the field.
        text: String,
    },
    /// An answer to an exercise.
    Attempt {
        /// Id of the exercise.
        item: String,
        /// 0 the first time, 1 in the re-test, the round of a faded example.
        round: u32,
        /// The step answered.
        step: String,
        /// The seed that the numbers were drawn from.
        #[serde(with = "crate::record::seed")]
        seed: u64,
        /// The numbers drawn.
        #[serde(default)]
        given: BTreeMap<String, f64>,
        /// The raw text typed.
        text: String,
        /// `correct`, `carried`, `precision`, `mistake`, `wrong` or `invalid`.
        result: String,
        /// The known mistake, where it is one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        mistake: Option<String>,
        /// The author names that mistake, so it is noted as a slip.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        named: bool,
        /// What the learner was told.
        says: String,
    },
    /// An explanation, judged.
    Explained {
        /// Id of the question.
        item: String,
        /// 1, or 2 for the second try.
        #[serde(rename = "try")]
        attempt: u32,
        /// The raw text typed.
        text: String,
        /// `pass`, `partial`, `fail` or `unsure`.
        verdict: String,
        /// Expectations met.
        #[serde(default)]
        met: Vec<String>,
        /// Required expectations not met.
        #[serde(default)]
        missed: Vec<String>,
        /// Misconceptions heard, slips included.
        #[serde(default)]
        misconceptions: Vec<String>,
        /// Those of them that block nothing.
        #[serde(default)]
        slips: Vec<String>,
        /// Criteria that the judge could not settle.
        #[serde(default)]
        unsure: Vec<String>,
        /// Which judge decided.
        judge: String,
        /// The words behind each criterion.
        #[serde(default)]
        why: Vec<Quote>,
    },
    /// A reply to a question that the tutor asked back, judged with what was said before.
    Replied {
        /// Id of the question.
        item: String,
        /// The try that it is about.
        #[serde(rename = "try")]
        attempt: u32,
        /// Id of the criterion asked about.
        about: String,
        /// How much the question gave away.
        rung: Rung,
        /// The question as the learner read it.
        asked: String,
        /// The raw text typed.
        text: String,
        /// What follows from answer and replies: `pass`, `partial`, `fail` or `unsure`.
        verdict: String,
        /// Expectations met, in answer and replies.
        #[serde(default)]
        met: Vec<String>,
        /// Required expectations not met.
        #[serde(default)]
        missed: Vec<String>,
        /// Misconceptions that stand, slips included.
        #[serde(default)]
        misconceptions: Vec<String>,
        /// Those of them that block nothing.
        #[serde(default)]
        slips: Vec<String>,
        /// Criteria that are still open.
        #[serde(default)]
        unsure: Vec<String>,
        /// Which judge decided.
        judge: String,
        /// The words of the reply that decided something.
        #[serde(default)]
        why: Vec<Quote>,
    },
    /// The learner wants to be asked no more about a try.
    LeftOpen {
        /// Id of the question.
        item: String,
        /// The try.
        #[serde(rename = "try")]
        attempt: u32,
    },
    /// A second opinion on an explanation, beside the built-in judge's.
    SecondOpinion {
        /// Id of the question.
        item: String,
        /// The try it is about.
        #[serde(rename = "try")]
        attempt: u32,
        /// The reply it is about, from 1; 0 for the answer itself.
        #[serde(default, skip_serializing_if = "is_zero")]
        reply: u32,
        /// Who was asked.
        by: String,
        /// `agrees`, `settles`, `disputes`, or `unusable`.
        result: String,
        /// Why it is unusable, or what was left out of it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        problem: Option<String>,
        /// The verdict that follows from its own findings.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        own_verdict: Option<String>,
        /// What it says of each criterion: `yes`, `no` or `unsure`, as it came.
        #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
        says: BTreeMap<String, String>,
        /// Its quotes that stand in the answer, or in answer and replies as one text, each of them
        /// on a line of its own.
        #[serde(default)]
        why: Vec<Quote>,
        /// Criteria on which the two differ; the built-in judge's finding stands.
        #[serde(default)]
        disputed: Vec<String>,
        /// Criteria that the built-in judge left open and this settled.
        #[serde(default)]
        settled: Vec<String>,
        /// The verdict that counts from then on.
        verdict: String,
        /// Expectations met, by both together.
        #[serde(default)]
        met: Vec<String>,
        /// Required expectations not met.
        #[serde(default)]
        missed: Vec<String>,
        /// Misconceptions that stand, slips included.
        #[serde(default)]
        misconceptions: Vec<String>,
        /// Those of them that block nothing.
        #[serde(default)]
        slips: Vec<String>,
        /// Criteria that are still open.
        #[serde(default)]
        unsure: Vec<String>,
    },
    /// The learner marked one point of the checklist.
    Marked {
        /// Id of the question.
        item: String,
        /// The try marked.
        #[serde(rename = "try")]
        attempt: u32,
        /// Id of the criterion.
        point: String,
        /// Whether the answer makes the point.
        said: bool,
    },
    /// The learner's own marking stands in for the judge's.
    SelfMarked {
        /// Id of the question.
        item: String,
        /// The try marked.
        #[serde(rename = "try")]
        attempt: u32,
        /// The verdict that follows: `pass`, `partial` or `fail`.
        verdict: String,
        /// Expectations met, by judge or learner.
        #[serde(default)]
        met: Vec<String>,
        /// Required expectations not met.
        #[serde(default)]
        missed: Vec<String>,
        /// Misconceptions that stand.
        #[serde(default)]
        misconceptions: Vec<String>,
        /// Those of them that block nothing.
        #[serde(default)]
        slips: Vec<String>,
    },
    /// The lesson reached its result.
    Finished {
        /// Passed or not.
        grade: Grade,
        /// The result in a teacher's words.
        words: String,
    },
    /// This session asks nothing but items of the lesson that were due again.
    DueAgain {
        /// Their ids.
        items: Vec<String>,
    },
    /// The lesson file or the program changed since; the stage starts again.
    LessonChanged {
        /// Hash of the lesson file from here on.
        hash: String,
        /// The stage that starts again.
        stage: Stage,
    },
}

/// Logs of before replies got opinions have none.
fn is_zero(reply: &u32) -> bool {
    *reply == 0
}

impl Event {
    /// Every value of `kind` that this version writes.
    pub const KINDS: [&str; 17] = [
        "next",
        "back",
        "revealed",
        "go-on",
        "skip",
        "hint",
        "draft",
        "attempt",
        "explained",
        "replied",
        "left-open",
        "second-opinion",
        "marked",
        "self-marked",
        "finished",
        "due-again",
        "lesson-changed",
    ];

    /// The item that the event is about, where it is about one.
    pub fn item(&self) -> Option<&str> {
        match self {
            Event::GoOn { item, .. }
            | Event::Hint { item, .. }
            | Event::Draft { item, .. }
            | Event::Attempt { item, .. }
            | Event::Explained { item, .. }
            | Event::Replied { item, .. }
            | Event::LeftOpen { item, .. }
            | Event::SecondOpinion { item, .. }
            | Event::Marked { item, .. }
            | Event::SelfMarked { item, .. } => Some(item),
            Event::Next { .. }
            | Event::Back { .. }
            | Event::Revealed { .. }
            | Event::Skip { .. }
            | Event::Finished { .. }
            | Event::DueAgain { .. }
            | Event::LessonChanged { .. } => None,
        }
    }
}
