//! One exercise with its numbers, and what was said about it so far.

use crate::exercise::{self, Draw, NoDraw, Truth};
use crate::lesson::{Exercise, Lesson, Task};
use formula::Values;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// The name of the only step of an exercise that has no steps of its own.
pub(super) const WHOLE: &str = "";

/// An exercise begun.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    lesson: Arc<Lesson>,
    item: String,
    pub(super) seed: u64,
    /// Drawn when first looked at, so that resuming draws what it shows and no more.
    draw: OnceLock<Result<Draw, NoDraw>>,
    /// The numbers that an answer was given to, as the log has them.
    pub(super) answered_to: Option<Values>,
    /// The steps that the learner is asked for, in order.
    pub(super) asked: Vec<String>,
    /// What was said, in order.
    pub(super) turns: Vec<Turn>,
    /// A text being written, not handed in.
    pub(super) draft: Option<String>,
}

/// One exchange.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Turn {
    Hint {
        step: String,
        level: u8,
    },
    Attempt {
        step: String,
        text: String,
        result: String,
        mistake: Option<String>,
        named: bool,
        says: String,
    },
    /// The step is left as it is.
    GoneOn {
        step: String,
    },
}

impl Turn {
    pub(super) fn step(&self) -> &str {
        match self {
            Turn::Hint { step, .. } | Turn::Attempt { step, .. } | Turn::GoneOn { step } => step,
        }
    }

    /// An answer that settles its step.
    fn is_right(&self) -> bool {
        matches!(self, Turn::Attempt { result, .. } if result == "correct" || result == "carried")
    }

    /// An answer that counts: invalid input costs nothing.
    fn counts(&self) -> bool {
        matches!(self, Turn::Attempt { result, .. } if result != "invalid")
    }
}

impl Problem {
    /// `last` limits the question to so many of the last steps.
    pub(super) fn new(
        lesson: &Arc<Lesson>,
        exercise: &Exercise,
        seed: u64,
        last: Option<usize>,
    ) -> Problem {
        let mut asked: Vec<String> = match &exercise.task {
            Task::Numeric { steps } => steps.iter().map(|step| step.name.text.clone()).collect(),
            Task::FindTheMistake { .. } => vec!["line".to_owned(), "answer".to_owned()],
            Task::Choice { .. } | Task::Order { .. } | Task::Look(_) | Task::Shader(_) => {
                vec![WHOLE.to_owned()]
            }
        };
        asked.drain(..last.map_or(0, |last| asked.len().saturating_sub(last)));
        Problem {
            lesson: Arc::clone(lesson),
            item: exercise.id.text.clone(),
            seed,
            draw: OnceLock::new(),
            answered_to: None,
            asked,
            turns: Vec::new(),
            draft: None,
        }
    }

    /// The numbers.
    pub(super) fn draw(&self) -> Result<&Draw, &NoDraw> {
        let draw = || match self.lesson.exercise(&self.item) {
            Some(exercise) => exercise::draw(&self.lesson, exercise, self.seed),
            None => Err(NoDraw {
                message: "The lesson no longer has this exercise.".to_owned(),
            }),
        };
        self.draw.get_or_init(draw).as_ref()
    }

    /// The numbers answered to are not those drawn now: the lesson or the program has changed.
    pub(super) fn is_stale(&self) -> bool {
        let other = |then: &Values| self.draw().map_or(true, |draw| draw.given != *then);
        self.answered_to.as_ref().is_some_and(other)
    }

    /// What can be answered now: the numbers and the step.
    pub(super) fn open(&self) -> Option<(&Draw, &str)> {
        let step = self.current()?;
        let draw = self.draw().ok()?;
        (!self.is_stale()).then_some((draw, step))
    }

    /// The first step that is not settled.
    pub(super) fn current(&self) -> Option<&str> {
        let open = |step: &&String| !self.is_settled(step);
        self.asked.iter().find(open).map(String::as_str)
    }

    /// Turns about a step.
    pub(super) fn turns_on<'a>(&'a self, step: &'a str) -> impl Iterator<Item = &'a Turn> {
        self.turns.iter().filter(move |turn| turn.step() == step)
    }

    fn is_settled(&self, step: &str) -> bool {
        self.turns_on(step)
            .any(|turn| turn.is_right() || matches!(turn, Turn::GoneOn { .. }))
    }

    /// Whether the learner may leave a step without having got it right.
    pub(super) fn may_go_on(&self, step: &str) -> bool {
        self.hints(step) == 3 || self.turns_on(step).any(Turn::counts)
    }

    /// The highest level of hint shown for a step.
    pub(super) fn hints(&self, step: &str) -> u8 {
        self.turns_on(step)
            .filter_map(|turn| match turn {
                Turn::Hint { level, .. } => Some(*level),
                Turn::Attempt { .. } | Turn::GoneOn { .. } => None,
            })
            .max()
            .unwrap_or(0)
    }

    /// The learner's answers to the steps before `step`, for what follows from a slip. A step
    /// whose answer was shown counts as known.
    pub(super) fn earlier(&self, step: &str) -> BTreeMap<String, String> {
        let before = self.asked.iter().take_while(|asked| *asked != step);
        before
            .filter(|asked| self.hints(asked) < 3)
            .filter_map(|asked| {
                let last = self.turns_on(asked).filter(|turn| turn.counts()).last()?;
                match last {
                    Turn::Attempt { text, .. } => Some((asked.clone(), text.clone())),
                    Turn::Hint { .. } | Turn::GoneOn { .. } => None,
                }
            })
            .collect()
    }

    /// The place pointed at last, of a picture.
    pub(super) fn place(&self) -> Option<(f64, f64)> {
        self.turns.iter().rev().find_map(|turn| match turn {
            Turn::Attempt { text, .. } => crate::exercise::look::place(text).ok(),
            Turn::Hint { .. } | Turn::GoneOn { .. } => None,
        })
    }

    /// The text of a shader as it stands: the draft, else the last one run, else the lesson's.
    pub(super) fn text(&self, source: &str) -> String {
        let attempts = self.turns.iter().rev().filter_map(|turn| match turn {
            Turn::Attempt { text, .. } => Some(text),
            Turn::Hint { .. } | Turn::GoneOn { .. } => None,
        });
        let last = self.draft.as_ref().or(attempts.into_iter().next());
        last.map_or(source, String::as_str).to_owned()
    }

    /// Every step is settled.
    pub(super) fn is_done(&self) -> bool {
        self.current().is_none()
    }

    /// Something was answered or shown.
    pub(super) fn is_begun(&self) -> bool {
        !self.turns.is_empty()
    }

    /// The answer that the exercise is about was right in the end, if only to a few digits.
    pub(super) fn is_solved(&self) -> bool {
        let near =
            |turn: &Turn| matches!(turn, Turn::Attempt { result, .. } if result == "precision");
        let last = self.asked.last();
        last.is_some_and(|step| {
            self.turns_on(step)
                .any(|turn| turn.is_right() || near(turn))
        })
    }

    /// The step's true value was given.
    pub(super) fn is_correct(&self, step: &str) -> bool {
        self.turns_on(step)
            .any(|turn| matches!(turn, Turn::Attempt { result, .. } if result == "correct"))
    }

    /// Mistakes made that the author names.
    pub(super) fn slips(&self) -> impl Iterator<Item = &String> {
        self.turns.iter().filter_map(|turn| match turn {
            Turn::Attempt {
                mistake,
                named: true,
                ..
            } => mistake.as_ref(),
            Turn::Attempt { .. } | Turn::Hint { .. } | Turn::GoneOn { .. } => None,
        })
    }

    /// No step needed a second answer or a hint.
    pub(super) fn is_clean(&self) -> bool {
        self.asked.iter().all(|step| {
            let mut turns = self
                .turns_on(step)
                .filter(|turn| turn.counts() || matches!(turn, Turn::Hint { .. }));
            turns.next().is_some_and(Turn::is_right)
        })
    }

    /// The answer that the exercise is about was shown before it was given.
    pub(super) fn is_shown(&self) -> bool {
        self.asked.last().is_some_and(|step| self.hints(step) == 3)
    }

    /// The numbers as the learner had them.
    pub(super) fn given(&self) -> Values {
        let drawn = || {
            self.draw()
                .map(|draw| draw.given.clone())
                .unwrap_or_default()
        };
        self.answered_to.clone().unwrap_or_else(drawn)
    }

    /// A step's name and value as shown when given away: `α`, `0.16`.
    pub(super) fn truth(&self, step: &str) -> Option<(String, String)> {
        let draw = self.draw().ok()?;
        if let Some(truth) = draw.steps.iter().find(|truth| truth.name == step) {
            return Some((truth.ask.clone(), truth.shown.clone()));
        }
        match &draw.truth {
            Truth::Number(_) => None,
            Truth::Choice(index) => Some((String::new(), draw.shown.get(*index)?.clone())),
            Truth::Order(places) => {
                let numbers: Vec<String> = places.iter().map(|p| (p + 1).to_string()).collect();
                Some((String::new(), numbers.join(" ")))
            }
        }
    }
}

/// The seed of one exercise in one round. 53 bits, so that every JSON reader keeps it whole.
pub(super) fn mix(seed: u64, item: &str, round: u32) -> u64 {
    // FNV-1a tells the items apart, splitmix64 spreads what is left.
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for byte in item.bytes().chain(round.to_le_bytes()) {
        hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
    let mut z = hash ^ seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) >> 11
}
