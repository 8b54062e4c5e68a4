//! What a lesson file says about a place to be found in a picture.

use super::Text;

/// What the bug does at the place asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shows {
    /// It is too bright there.
    Brighter,
    /// It is too dark there.
    Darker,
    /// Either, whichever it does more.
    Either,
}

impl Shows {
    /// The word of the lesson file.
    pub fn as_str(self) -> &'static str {
        match self {
            Shows::Brighter => "brighter",
            Shows::Darker => "darker",
            Shows::Either => "either",
        }
    }

    /// The meaning of a word; `None` for any other word.
    pub fn parse(word: &str) -> Option<Shows> {
        [Shows::Brighter, Shows::Darker, Shows::Either]
            .into_iter()
            .find(|it| it.as_str() == word)
    }
}

/// "Where would you look?": a place of a fingerprint is pointed at.
#[derive(Clone, Debug)]
pub struct LookTask {
    /// Id of the fingerprint.
    pub picture: Text,
    /// Which kind of error is looked for.
    pub shows: Shows,
    /// The share of the best place's log2 ratio that is good enough, in (0, 1].
    pub near: f64,
}
