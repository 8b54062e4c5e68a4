//! What a screen shows, as data: the terminal and `--plain` draw it, neither decides anything.
//!
//! A view under one [`View::key`] only ever grows at its end, so that a linear reader can
//! print what was added and nothing twice.

use crate::prose::Block;
use serde::{Deserialize, Serialize};

/// The parts of a lesson, in their order.
#[derive(Serialize, Deserialize, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[serde(rename_all = "kebab-case")]
pub enum Stage {
    /// Why the lesson matters, with lead-ins to slips noted earlier.
    Why,
    /// The idea, step by step.
    Walkthrough,
    /// The worked example, and the same with lines left for the learner.
    Worked,
    /// Exercises with numbers of their own.
    Practice,
    /// The learner explains it back.
    Explain,
    /// What was missed, from another angle.
    Reteach,
    /// Again, with fresh numbers and another question.
    Retest,
    /// How it went.
    Result,
}

impl Stage {
    /// Every stage in the order in which a lesson takes them.
    pub const ALL: [Stage; 8] = [
        Stage::Why,
        Stage::Walkthrough,
        Stage::Worked,
        Stage::Practice,
        Stage::Explain,
        Stage::Reteach,
        Stage::Retest,
        Stage::Result,
    ];

    /// The word in the header.
    pub fn title(self) -> &'static str {
        match self {
            Stage::Why => "Why",
            Stage::Walkthrough => "Walkthrough",
            Stage::Worked => "Worked example",
            Stage::Practice => "Exercises",
            Stage::Explain => "Explain back",
            Stage::Reteach => "Another angle",
            Stage::Retest => "Re-test",
            Stage::Result => "Result",
        }
    }

    /// The stage within a sentence: "you left in the middle of …".
    pub fn phrase(self) -> &'static str {
        match self {
            Stage::Why => "the opening",
            Stage::Walkthrough => "the walkthrough",
            Stage::Worked => "the worked example",
            Stage::Practice => "the exercises",
            Stage::Explain => "the explain-back",
            Stage::Reteach => "the re-teach",
            Stage::Retest => "the re-test",
            Stage::Result => "the result",
        }
    }
}

/// Where a stage of the header stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Gone through.
    Done,
    /// The one on the screen.
    Here,
    /// Still to come.
    Ahead,
}

/// What the learner is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// Nothing: read, and go on.
    None,
    /// One line: a number or arithmetic.
    Number {
        /// The quantity asked for, as a short prompt.
        label: String,
        /// How near is near enough, said beforehand.
        note: String,
        /// What was typed before, and not yet handed in.
        draft: String,
    },
    /// Several lines in the learner's own words.
    Text {
        /// What to write about, as a short prompt.
        label: String,
        /// What was typed before, and not yet handed in.
        draft: String,
    },
    /// A sentence or a few words, in reply to a question of the tutor's.
    Reply {
        /// What to write, as a short prompt.
        label: String,
        /// How much is enough.
        note: String,
        /// What was typed before, and not yet handed in.
        draft: String,
    },
    /// A place of a picture; answered by two numbers, how far to the right of the ball's centre
    /// and how far up, in its radii.
    Place {
        /// Id of the fingerprint; its buggy panel is what is looked at.
        picture: String,
        /// Where somebody pointed last.
        at: Option<(f64, f64)>,
    },
    /// A WGSL function to be changed; what is handed in is the whole text.
    Code {
        /// The function's name.
        label: String,
        /// How near is near enough, said beforehand.
        note: String,
        /// The text as it stands.
        text: String,
    },
    /// One of several; answered by its letter (`a`, `b`, …), its number, or its text.
    Choice {
        /// The options in the order shown.
        options: Vec<String>,
    },
    /// All of several, in the right order; answered by the numbers shown, "2 1 3".
    Order {
        /// The items in the order shown.
        items: Vec<String>,
    },
    /// Points that the learner ticks himself, because the judge could not tell.
    Checklist {
        /// The points in the order shown; [`crate::session::Msg::Mark`] names them by position.
        points: Vec<Point>,
    },
}

/// One line of a checklist.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What a good answer says.
    pub text: String,
    /// What the learner says of his answer; `None` until marked.
    pub said: Option<bool>,
}

/// What the keys do here.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Can {
    /// `Msg::Next` leads on.
    pub next: bool,
    /// `Msg::Back` shows the screen before.
    pub back: bool,
    /// `Msg::Skip` leaves this out.
    pub skip: bool,
    /// The level of the next hint, from 1 to 3; the last one is the answer.
    pub hint: Option<u8>,
}

/// Whether what the learner sees is safe on the disk.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Saving {
    /// Nothing to save yet.
    #[default]
    Nothing,
    /// On its way.
    Waiting,
    /// Everything shown is saved.
    Saved,
    /// Not saved; kept here until it can be. The reason, as told by the app.
    Failed(String),
}

/// One screen.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// Title of the lesson.
    pub lesson_title: String,
    /// The stage on the screen.
    pub stage: Stage,
    /// All stages of this lesson, for the header.
    pub stages: Vec<(Stage, Progress)>,
    /// Position of this screen within its stage, from 1, and how many the stage has.
    pub place: (usize, usize),
    /// Title of the screen.
    pub heading: String,
    /// Changes when the screen is another one; under the same key blocks are only added.
    pub key: String,
    /// What there is to read.
    pub blocks: Vec<Block>,
    /// What is asked for.
    pub input: Input,
    /// What the keys do.
    pub can: Can,
    /// What `Msg::Next` does: "next line", "on", "finish".
    pub next_label: String,
    /// What `Msg::Skip` does: "skip this exercise"; empty where nothing can be skipped.
    pub skip_label: String,
    /// What is under way and worth waiting for, in a few words; `Msg::Skip` waits no longer.
    pub waiting: Option<String>,
    /// One line about the last message; gone with the next.
    pub note: Option<String>,
    /// Whether all this is saved.
    pub saving: Saving,
}
