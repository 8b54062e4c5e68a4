//! What is said but not held: what others say and are wrong about, what the learner thought at
//! first, both sides of an "or", a thing and its contrary in one breath.

use super::claim::conflicts;
use super::grammar;
use super::lexicon::{CAUSE, CLASSES, Lexicon, QUANTITY, Role};
use super::parse::{Reading, Statement, starts_with};
use super::text::{Kind, Token};

/// Openings behind which stands what the learner no longer holds, if he turns against it.
const AT_FIRST: &[&[&str]] = &[
    &["at", "first", "i"],
    &["i", "first", "thought"],
    &["first", "i", "thought"],
    &["i", "thought"],
    &["i", "was", "going", "to"],
    &["i", "was", "about", "to"],
    &["i", "used", "to"],
    &["my", "first"],
    &["my", "initial"],
    &["i", "had", "thought"],
    &["i", "would", "have", "said"],
    &["i", "wanted", "to"],
    &["i", "almost"],
    &["i", "nearly"],
    &["initially", "i"],
    &["i", "initially"],
    &["i", "assumed"],
    &["tempted", "to"],
    &["i", "would", "say"],
    &["i", "could", "say"],
];

/// Of what they say, the clause before is only reported.
const ATTRIBUTED: &[&[&str]] = &[
    &["is", "what", "a"],
    &["is", "what", "they"],
    &["is", "what", "you"],
    &["is", "what", "the"],
    &["what", "they", "want"],
    &["what", "you", "want"],
];

/// Words at which a sentence turns.
const TURNS: &[&str] = &[
    "but", "however", "though", "although", "--", ";", "...", "actually", "yet",
];

/// So many tokens what is said of others' words, or taken back, reaches at most.
const REACH: usize = 60;

impl Reading {
    /// Marks what is said without being held.
    pub fn hearsay(&mut self, lexicon: &Lexicon) {
        self.reported();
        self.supposed();
        self.unreal(lexicon);
        self.something_else();
        self.retracted();
        self.torn(lexicon);
    }

    /// "My teacher says it is the rim, but he is wrong": so it is not.
    fn reported(&mut self) {
        for at in 1..self.tokens.len() {
            if ATTRIBUTED
                .iter()
                .any(|words| starts_with(&self.tokens, at, words))
            {
                let quoted = (at..(at + 9).min(self.tokens.len())).any(|i| {
                    matches!(
                        self.tokens[i].word.as_str(),
                        "say" | "says" | "hear" | "want" | "wants" | "expect" | "answer" | "write"
                    )
                });
                if quoted {
                    let sentence = self.sentence[at];
                    let from = at.saturating_sub(REACH);
                    self.each_between(from, at, |s| s.void |= s.sentence == sentence);
                }
            }
            if !grammar::speaks(&self.tokens[at].word) || !self.others_speak(at) {
                continue;
            }
            let end = self.turn_after(at + 1);
            if self.dismissed(end) {
                self.each_between(at + 1, end, |s| s.denied = true);
            }
        }
    }

    /// "If H were its normal the rim would be bright, but it is not": nothing of it is so.
    fn supposed(&mut self) {
        for at in 0..self.tokens.len() {
            if !self.tokens[at].is("if") {
                continue;
            }
            let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
            let unreal = (at + 1..at + 7).any(|i| word(i) == "were");
            let to = (at + REACH).min(self.tokens.len());
            let refused = (at..to)
                .take_while(|&i| self.sentence[i] == self.sentence[at])
                .find(|&i| {
                    word(i) == "but"
                        && matches!(word(i + 1), "it" | "they" | "that")
                        && (i + 2..i + 5).any(|j| word(j) == "not")
                });
            if let Some(end) = refused.filter(|_| unreal) {
                self.each_between(at, end, |s| s.void = true);
            }
        }
    }

    /// "Were it smooth, the two would agree", "Had the rim been dark, ...": nothing of it is so,
    /// but what a light or a paint would do, which is asked for.
    fn unreal(&mut self, lexicon: &Lexicon) {
        for at in 0..self.tokens.len() {
            let opens = at == 0 || self.sentence[at - 1] != self.sentence[at];
            let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
            let inverted = matches!(word(at), "were" | "had")
                && (matches!(
                    word(at + 1),
                    "it" | "this" | "they" | "there" | "the" | "a" | "h" | "n" | "d"
                ));
            let would = |i: &usize| matches!(word(*i), "would" | "could" | "might");
            let to = (at + REACH).min(self.tokens.len());
            let end = (at..to)
                .find(|&i| self.sentence[i] != self.sentence[at])
                .unwrap_or(to);
            if !opens || !inverted || !(at..end).any(|i| would(&i)) {
                continue;
            }
            let artist = lexicon.id("artist");
            let of_artist = |s: &Statement| {
                let cause = s.about[CAUSE].as_ref();
                cause.is_some_and(|it| it.concepts.iter().any(|&id| Some(id) == artist))
            };
            self.each_between(at, end, |s| s.void |= !of_artist(s));
        }
    }

    /// "What falls off is how much you see of the inside": not what was asked about.
    fn something_else(&mut self) {
        for at in 0..self.tokens.len() {
            let opens = at == 0 || self.clause[at - 1] != self.clause[at];
            if !opens || !matches!(self.tokens[at].word.as_str(), "what" | "whatever") {
                continue;
            }
            let to = (at + 14).min(self.tokens.len());
            let is = (at + 1..to)
                .take_while(|&i| self.sentence[i] == self.sentence[at])
                .find(|&i| self.tokens[i].is("is"));
            let how = |i: usize| {
                (i + 1..(i + 4).min(self.tokens.len())).any(|j| {
                    matches!(
                        self.tokens[j].word.as_str(),
                        "how" | "diffuse" | "refracted" | "transmitted" | "transmission"
                    )
                })
            };
            if let Some(end) = is.filter(|&i| how(i)) {
                self.each_between(at, end, |s| s.void = true);
            }
        }
    }

    /// Whether somebody else is the subject of the verb of speech that stands here.
    fn others_speak(&self, at: usize) -> bool {
        (at.saturating_sub(5)..at).rev().any(|i| {
            let word = self.tokens[i].word.as_str();
            self.sentence[i] == self.sentence[at]
                && (grammar::names_others(word)
                    || word == "one"
                        && (i + 1..at).any(|j| grammar::is_modal(&self.tokens[j].word)))
        })
    }

    /// The first token from here on at which the sentence turns or ends.
    fn turn_after(&self, from: usize) -> usize {
        let limit = (from + REACH).min(self.tokens.len());
        (from..limit)
            .find(|&i| {
                self.sentence[i] != self.sentence[from - 1]
                    || TURNS.iter().any(|word| self.tokens[i].is(word))
            })
            .unwrap_or(limit)
    }

    /// Whether what follows calls what went before wrong, or turns away from it.
    fn dismissed(&self, from: usize) -> bool {
        let here = self.sentence.get(from.saturating_sub(1)).copied();
        let near = |i: usize| here.is_some_and(|here| self.sentence[i] <= here + 1);
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        (from..(from + 9).min(self.tokens.len()))
            .take_while(|&i| near(i))
            .any(|i| {
                let they = (i.saturating_sub(4)..i).any(|j| {
                    grammar::names_others(word(j)) || matches!(word(j), "that" | "this" | "it")
                });
                match word(i) {
                    "wrong" | "mistaken" | "false" | "nonsense" | "rubbish" | "backwards"
                    | "incorrect" | "untrue" | "myth" => they,
                    // "People say it does. It doesn't."
                    "it" | "they" | "that" | "this" if from + 1 >= i => {
                        matches!(word(i + 1), "is" | "are" | "does" | "do")
                            && matches!(word(i + 2), "not" | "so")
                            && matches!(word(i + 3), "" | "," | "." | ";" | "--" | "only" | "at")
                    }
                    "disagree" => true,
                    "look" => word(i + 1) == "again",
                    "i" => {
                        word(i + 1) == "do"
                            && word(i + 2) == "not"
                            && (matches!(word(i + 3), "believe" | "think" | "agree" | "buy")
                                || self.tokens.get(i + 3).is_none_or(|t| t.kind != Kind::Word))
                    }
                    "but" => matches!(word(i + 1), "really" | "actually" | "no" | "in"),
                    _ => false,
                }
            })
    }

    /// "At first I thought the rim gets darker, but ..."
    fn retracted(&mut self) {
        for at in 0..self.tokens.len() {
            let Some(opening) = AT_FIRST
                .iter()
                .find(|words| starts_with(&self.tokens, at, words))
            else {
                continue;
            };
            let from = at + opening.len();
            let end = self.turn_after(from);
            let turns = self.tokens.get(end).is_some_and(|t| {
                self.sentence[end] == self.sentence[at]
                    || matches!(
                        t.word.as_str(),
                        "but" | "no" | "actually" | "however" | "wait" | "then" | "now"
                    )
            });
            // "I would say ..." is held, unless what follows takes it back.
            let said = opening.last() == Some(&"say") && opening.len() == 3;
            let taken_back = !said || self.dismissed(end);
            if turns && taken_back {
                self.each_between(from, end, |s| s.void = true);
            }
        }
    }

    /// "Note to the grader: this answer contains both points": speaks of answers, says nothing.
    pub fn addressed(&mut self) {
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        let speaks = |i: usize| match word(i) {
            "grader" | "graders" | "grades" | "grading" | "examiner" | "rubric" | "verdict" => true,
            "mark" => matches!(word(i + 1), "it" | "this" | "as" | "me"),
            "marks" => matches!(word(i.wrapping_sub(1)), "full" | "all"),
            "answer" => word(i.wrapping_sub(1)) == "this" || word(i + 1) == "key",
            // "Dimmer, brighter: one of these is right."
            "one" => word(i + 1) == "of" && matches!(word(i + 2), "these" | "those" | "them"),
            _ => false,
        };
        let sentences: Vec<usize> = (0..self.tokens.len())
            .filter(|&i| speaks(i))
            .map(|i| self.sentence[i])
            .collect();
        for statement in &mut self.statements {
            statement.void |= sentences.binary_search(&statement.sentence).is_ok();
        }
    }

    /// "Small and bright, or it may be large and dim": neither is claimed.
    pub fn left_open(&mut self) {
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        let open: Vec<usize> = (0..self.tokens.len())
            .filter(|&i| {
                word(i) == "or"
                    && (word(i + 1) == "else"
                        || (i + 1..i + 4).any(|j| matches!(word(j), "may" | "might")))
            })
            .collect();
        for at in open {
            let (from, to) = (at.saturating_sub(12), (at + 10).min(self.tokens.len()));
            let ends = |i: &usize| {
                matches!(
                    self.tokens[*i].kind,
                    Kind::Stop | Kind::Question | Kind::Break
                )
            };
            let from = (from..at).rev().find(ends).unwrap_or(from);
            let to = (at..to).find(ends).unwrap_or(to);
            self.each_between(from, to, |s| s.void = true);
        }
    }

    /// "bright or dark", "contains it and does not contain it": neither is claimed.
    fn torn(&mut self, lexicon: &Lexicon) {
        let count = self.statements.len();
        for index in 0..count {
            for other in index + 1..count.min(index + 5) {
                let (a, b) = (&self.statements[index], &self.statements[other]);
                if a.sentence != b.sentence || a.tokens.1 > b.tokens.0 {
                    continue;
                }
                let gap = &self.tokens[a.tokens.1..b.tokens.0];
                // Numbers may follow one another; only an "or" leaves them open.
                let number = |s: &Statement| {
                    s.concepts.iter().any(|&id| {
                        matches!(
                            lexicon.concept(id).name.as_str(),
                            "one" | "zero" | "oneoverpi" | "singular"
                        )
                    })
                };
                let open = gap.iter().any(|t| t.is("or"));
                let plain = |t: &Token| grammar::is_glue(&t.word) || grammar::is_copula(&t.word);
                let joined = gap.len() <= 6
                    && (open || gap.iter().any(|t| t.is("and")) && !number(a))
                    && gap
                        .iter()
                        .enumerate()
                        .all(|(i, t)| plain(t) || self.heard[a.tokens.1 + i])
                    && !gap
                        .iter()
                        .any(|t| matches!(t.word.as_str(), "but" | "no" | "was" | "than"));
                // "small and strong": only what the words mean first can be at odds.
                let first = |s: &Statement| s.concepts.first().copied();
                let at_odds = first(a) == first(b) && a.denied != b.denied
                    || first(a).and_then(|id| lexicon.concept(id).antonym) == first(b)
                    || number(a) && number(b);
                if joined
                    && at_odds
                    && !a.compared
                    && !b.compared
                    && same_subject(a, b)
                    && conflicts(lexicon, a, b)
                {
                    let says = |s: &Statement| {
                        s.concepts
                            .iter()
                            .any(|&id| lexicon.concept(id).role == Role::State)
                    };
                    if says(a) && says(b) {
                        self.statements[index].void = true;
                        self.statements[other].void = true;
                    }
                }
            }
        }
    }

    /// Changes the statements that begin within a range of tokens.
    pub fn each_between(&mut self, from: usize, to: usize, change: impl Fn(&mut Statement)) {
        let first = self.statements.partition_point(|s| s.tokens.0 < from);
        self.statements[first..]
            .iter_mut()
            .take_while(|s| {
                #[cfg(test)]
                super::steps::step();
                s.tokens.0 < to
            })
            .for_each(change);
    }
}

/// Whether two statements are about the same, class by class.
fn same_subject(a: &Statement, b: &Statement) -> bool {
    (0..CLASSES)
        .filter(|&class| class != QUANTITY)
        .all(|class| match (&a.about[class], &b.about[class]) {
            (Some(x), Some(y)) => x.concepts.iter().any(|id| y.concepts.contains(id)),
            (None, None) => true,
            _ => false,
        })
}
