//! An author's phrases, read as the answers are, and how well an answer says one.

use super::grammar;
use super::lexicon::{CAUSE, CLASSES, Form, Id, Lexicon, MATERIAL, PLACE, QUANTITY, Role, SURFACE};
use super::parse::{self, Held, Reading, Setting, Statement};
use super::symbols;
use super::text::{self, Kind, Token};

/// From here on a criterion is stated.
pub const STATED: f64 = 0.75;
/// From here on the judge cannot tell.
pub const PERHAPS: f64 = 0.5;

/// One proposition of a phrase.
#[derive(Clone, Debug, Default)]
pub struct Atom {
    /// What is said: any of these concepts, or, if empty, the words alone.
    anchor: Vec<Id>,
    /// Whether it is said to be not so.
    denied: bool,
    /// What it is about, by class; empty where the phrase does not say.
    about: [Vec<Id>; CLASSES],
    /// What else is named; of each group any.
    things: Vec<Vec<Id>>,
    /// Words that the lexicon does not know, by stem.
    words: Vec<String>,
}

/// A phrase: all its propositions together.
#[derive(Clone, Debug)]
pub struct Phrase {
    /// As the author wrote it.
    pub text: String,
    /// Its propositions.
    pub atoms: Vec<Atom>,
}

/// How well an answer says something, and where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hit {
    /// 0 to 1.
    pub score: f64,
    /// Byte range of the words that say it.
    pub range: (usize, usize),
}

/// Splits, spells out and recognises: the way every text goes before it is read.
pub fn prepare(text: &str) -> Vec<Token> {
    symbols::fuse(super::spelling::expand(text::tokens(text), text))
}

impl Phrase {
    /// Reads a phrase.
    pub fn new(lexicon: &Lexicon, text: &str, setting: &Setting) -> Phrase {
        let reading = parse::read(lexicon, prepare(text), setting, &[]);
        let role = |s: &Statement, wanted: fn(Role) -> bool| {
            s.concepts
                .iter()
                .any(|&id| wanted(lexicon.concept(id).role))
        };
        let is_state = |s: &&Statement| role(s, |r| r == Role::State);
        let is_thing =
            |s: &&Statement| role(s, |r| r == Role::Thing) && !role(s, |r| r == Role::State);
        let states: Vec<&Statement> = reading.statements.iter().filter(is_state).collect();
        let things: Vec<&Statement> = reading.statements.iter().filter(is_thing).collect();
        let anchors: Vec<&Statement> = match (states.is_empty(), things.is_empty()) {
            (false, _) => states.iter().copied().filter(|s| !s.compared).collect(),
            (true, false) => things[..1].to_vec(),
            (true, true) => reading.statements.iter().rev().take(1).collect(),
        };
        let single = anchors.iter().all(|s| s.clause == anchors[0].clause) || anchors.len() == 1;
        let mut atoms: Vec<Atom> = anchors
            .iter()
            .map(|s| Atom {
                anchor: keep(
                    lexicon,
                    &s.concepts,
                    if states.is_empty() {
                        None
                    } else {
                        Some(Role::State)
                    },
                ),
                denied: s.denied,
                about: std::array::from_fn(|class| {
                    s.about[class]
                        .as_ref()
                        .map(|about| about.concepts.clone())
                        .unwrap_or_default()
                }),
                things: things
                    .iter()
                    .filter(|t| t.tokens != s.tokens && (single || t.clause == s.clause))
                    .map(|t| keep(lexicon, &t.concepts, Some(Role::Thing)))
                    .collect(),
                words: literal(&reading, if single { None } else { Some(s.clause) }),
            })
            .collect();
        if atoms.is_empty() {
            let words = literal(&reading, None);
            if !words.is_empty() {
                atoms.push(Atom {
                    words,
                    ..Atom::default()
                });
            }
        }
        Phrase {
            text: text.to_owned(),
            atoms,
        }
    }

    /// How well a reading says the phrase: as well as it says its weakest part.
    pub fn said(&self, lexicon: &Lexicon, reading: &Reading) -> Hit {
        let mut whole = Hit {
            score: if self.atoms.is_empty() { 0.0 } else { 1.0 },
            range: (usize::MAX, 0),
        };
        for atom in &self.atoms {
            let hit = atom.best(lexicon, reading, false);
            whole.score = whole.score.min(hit.score);
            whole.range = (
                whole.range.0.min(hit.range.0),
                whole.range.1.max(hit.range.1),
            );
            if whole.score < PERHAPS {
                return Hit::default();
            }
        }
        whole
    }

    /// How well a reading says the contrary; only a single proposition has one.
    pub fn gainsaid(&self, lexicon: &Lexicon, reading: &Reading) -> Hit {
        match self.atoms.as_slice() {
            [atom] => atom.best(lexicon, reading, true),
            _ => Hit::default(),
        }
    }

    /// The phrase as the judge understands it, for authors.
    pub fn explain(&self, lexicon: &Lexicon) -> String {
        let names = |ids: &[Id]| {
            ids.iter()
                .map(|&id| lexicon.concept(id).name.as_str())
                .collect::<Vec<_>>()
                .join("|")
        };
        let parts: Vec<String> = self
            .atoms
            .iter()
            .map(|atom| {
                let mut out = String::new();
                if atom.denied {
                    out.push_str("not ");
                }
                out.push_str(&names(&atom.anchor));
                for about in atom.about.iter().filter(|about| !about.is_empty()) {
                    out.push_str(&format!(" of {}", names(about)));
                }
                for thing in &atom.things {
                    out.push_str(&format!(" with {}", names(thing)));
                }
                for word in &atom.words {
                    out.push_str(&format!(" \"{word}\""));
                }
                out
            })
            .collect();
        parts.join("; ")
    }
}

fn keep(lexicon: &Lexicon, ids: &[Id], role: Option<Role>) -> Vec<Id> {
    ids.iter()
        .copied()
        .filter(|&id| role.is_none_or(|role| lexicon.concept(id).role == role))
        .collect()
}

/// The words of a phrase that only themselves can say.
fn literal(reading: &Reading, clause: Option<usize>) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    for (at, token) in reading.tokens.iter().enumerate() {
        let counts = token.kind == Kind::Word
            && !reading.heard[at]
            && token.word.len() > 2
            && !grammar::is_known(&token.word)
            && clause.is_none_or(|c| reading.clause[at] == c);
        let stem = &reading.forms[at].stem;
        if counts && !out.contains(stem) {
            out.push(stem.clone());
        }
    }
    out
}

impl Atom {
    fn best(&self, lexicon: &Lexicon, reading: &Reading, contrary: bool) -> Hit {
        let mut best = Hit::default();
        if self.anchor.is_empty() {
            return if contrary {
                best
            } else {
                self.by_words(reading)
            };
        }
        for statement in reading.statements.iter().filter(|s| !s.void) {
            let mut score = self.polarity(lexicon, statement, contrary);
            if score < PERHAPS {
                continue;
            }
            score *= self.topic(lexicon, statement);
            if score < PERHAPS {
                continue;
            }
            score *= self.company(reading, statement);
            if score > best.score + 1e-9 {
                best = Hit {
                    score,
                    range: quote(reading, statement),
                };
            }
        }
        best
    }

    /// Does the statement say it (or, if asked, the contrary), and how clearly?
    fn polarity(&self, lexicon: &Lexicon, statement: &Statement, contrary: bool) -> f64 {
        let says = statement.concepts.iter().any(|id| self.anchor.contains(id));
        let opposite = statement.concepts.iter().any(|&id| {
            lexicon
                .concept(id)
                .antonym
                .is_some_and(|a| self.anchor.contains(&a))
        });
        let binary = statement
            .concepts
            .iter()
            .any(|&id| lexicon.concept(id).binary);
        let sure = if statement.compared { 0.8 } else { 1.0 };
        let denied = statement.denied != self.denied;
        match (says, opposite, denied, contrary) {
            (true, _, false, false) => sure,
            (true, _, true, true) => sure,
            (false, true, true, false) if binary => sure,
            (false, true, true, false) => 0.6,
            (false, true, false, true) => sure,
            _ => 0.0,
        }
    }

    /// Is the statement about what the phrase is about?
    fn topic(&self, lexicon: &Lexicon, statement: &Statement) -> f64 {
        let mut score: f64 = 1.0;
        for class in 0..CLASSES {
            let wanted = &self.about[class];
            if wanted.is_empty() {
                continue;
            }
            let generic = class == PLACE
                && wanted
                    .iter()
                    .any(|&id| matches!(lexicon.concept(id).name.as_str(), "whole" | "highlight"));
            score *= match &statement.about[class] {
                None if generic => 0.9,
                None => match class {
                    PLACE => 0.55,
                    SURFACE | MATERIAL | CAUSE => 0.8,
                    _ => 0.9,
                },
                Some(about) if about.concepts.iter().any(|id| wanted.contains(id)) => {
                    match about.held {
                        Held::Local => 1.0,
                        Held::Inherited => 0.95,
                        Held::Remembered => 0.9,
                    }
                }
                Some(about)
                    if class == PLACE
                        && about.concepts.iter().any(|&id| {
                            matches!(lexicon.concept(id).name.as_str(), "whole" | "highlight")
                        }) =>
                {
                    0.5
                }
                Some(about) if class == QUANTITY && about.held < Held::Local => 0.9,
                Some(_) => 0.0,
            };
        }
        score
    }

    /// Are the other things of the phrase named beside it?
    fn company(&self, reading: &Reading, statement: &Statement) -> f64 {
        let mut score: f64 = 1.0;
        for group in &self.things {
            let mut near: f64 = 0.3;
            let low = reading
                .statements
                .partition_point(|s| s.sentence + 1 < statement.sentence);
            for other in reading.statements[low..]
                .iter()
                .take_while(|s| s.sentence <= statement.sentence + 1)
                .take(64)
            {
                if !other.concepts.iter().any(|id| group.contains(id)) {
                    continue;
                }
                let same_clause = other.clause == statement.clause;
                near = near.max(match () {
                    () if same_clause => 1.0,
                    () if other.sentence == statement.sentence => 0.9,
                    () => 0.75,
                });
            }
            score *= near;
        }
        if !self.words.is_empty() {
            let (start, end) = sentence_around(reading, statement.tokens.0);
            score *= share(&self.words, &reading.forms[start..end]);
        }
        score
    }

    /// Words that the lexicon does not know: they must stand in one sentence, not denied.
    fn by_words(&self, reading: &Reading) -> Hit {
        let mut best = Hit::default();
        let mut start = 0;
        while start < reading.tokens.len() {
            let (_, end) = sentence_around(reading, start);
            let score = share(&self.words, &reading.forms[start..end]);
            let denied = (start..end)
                .any(|i| reading.denied[i] && self.words.contains(&reading.forms[i].stem));
            if score > best.score && denied == self.denied {
                best = Hit {
                    score,
                    range: (reading.tokens[start].start, reading.tokens[end - 1].end),
                };
            }
            start = end.max(start + 1);
        }
        best
    }
}

fn share(words: &[String], forms: &[Form]) -> f64 {
    let present = words
        .iter()
        .filter(|word| forms.iter().any(|form| form.stem == **word))
        .count();
    present as f64 / words.len() as f64
}

/// The tokens of the sentence around a token, at most 200 to either side.
fn sentence_around(reading: &Reading, at: usize) -> (usize, usize) {
    let sentence = reading.sentence[at];
    let mut start = at;
    while start > 0 && reading.sentence[start - 1] == sentence && at - start < 200 {
        start -= 1;
    }
    let mut end = at + 1;
    while end < reading.tokens.len() && reading.sentence[end] == sentence && end - at < 200 {
        end += 1;
    }
    (start, end)
}

/// The words of a statement and of what it is about, where they stand in one sentence.
fn quote(reading: &Reading, statement: &Statement) -> (usize, usize) {
    let (mut first, mut last) = (statement.tokens.0, statement.tokens.1);
    for about in statement
        .about
        .iter()
        .flatten()
        .filter(|about| about.held >= Held::Inherited)
    {
        if reading.sentence[about.tokens.0] == statement.sentence {
            first = first.min(about.tokens.0);
            last = last.max(about.tokens.1);
        }
    }
    let range = (reading.tokens[first].start, reading.tokens[last - 1].end);
    if range.1 - range.0 <= 200 {
        return range;
    }
    (
        reading.tokens[statement.tokens.0].start,
        reading.tokens[statement.tokens.1 - 1].end,
    )
}
