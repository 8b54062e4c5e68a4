//! An author's phrases, read as the answers are, and how well an answer says one.

use std::collections::BTreeMap;

use super::grammar;
use super::lexicon::{CLASSES, Id, Lexicon, MATERIAL, PLACE, Role, SURFACE};
use super::matching::highest;
use super::parse::{self, Reading, Setting, Statement};
use super::symbols;
use super::text::{self, Kind, Token};

/// From here on a criterion is stated.
pub const STATED: f64 = 0.75;
/// From here on the judge cannot tell.
pub const PERHAPS: f64 = 0.5;

/// From here on the contrary is stated.
const GAINSAID: f64 = 0.93;

/// How to listen.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ears<'a> {
    /// Whether what goes unnamed counts against a statement, as where a mistake is laid to
    /// somebody's charge.
    pub strict: bool,
    /// Quantities that the question itself asks about, which may go unnamed: a bit each.
    pub understood: u128,
    /// Byte ranges that count already as something else.
    pub deaf: &'a [(usize, usize)],
}

impl Ears<'_> {
    /// Whether one of these may go unnamed.
    pub fn understands(self, ids: &[Id]) -> bool {
        ids.iter()
            .any(|&id| id < 128 && self.understood & (1 << id) != 0)
    }
}

/// One proposition of a phrase.
#[derive(Clone, Debug, Default)]
pub struct Atom {
    /// What is said: any of these concepts, or, if empty, the words alone.
    pub anchor: Vec<Id>,
    /// Whether it is said to be not so.
    pub denied: bool,
    /// What it is about, by class; empty where the phrase does not say.
    pub about: [Vec<Id>; CLASSES],
    /// What else is named; of each group any.
    pub things: Vec<Vec<Id>>,
    /// Words that the lexicon does not know, by stem.
    pub words: Vec<String>,
}

/// A phrase: all its propositions together.
#[derive(Clone, Debug)]
pub struct Phrase {
    /// As the author wrote it.
    pub text: String,
    /// Its propositions.
    pub atoms: Vec<Atom>,
    /// Whether they make one clause, so that an answer must say them together.
    together: bool,
}

/// How well an answer says something, and where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hit {
    /// 0 to 1.
    pub score: f64,
    /// Byte range of the words that say it.
    pub range: (usize, usize),
    /// Whether it is said in words of the phrase's own, which nothing else is heard in.
    pub own_words: bool,
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
        // A lone name says nothing.
        let alone = states.is_empty() && things.is_empty() && reading.statements.len() < 2;
        let anchors = if alone { Vec::new() } else { anchors };
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
                // Where the verb is nobody's word, the place that it is said of still counts.
                let about = std::array::from_fn(|class| {
                    let named = reading
                        .statements
                        .iter()
                        .filter_map(|s| s.about[class].as_ref());
                    named.flat_map(|about| about.concepts.clone()).collect()
                });
                atoms.push(Atom {
                    words,
                    about,
                    ..Atom::default()
                });
            }
        }
        Phrase {
            text: text.to_owned(),
            atoms,
            together: single,
        }
    }

    /// How well a reading says the phrase: as well as it says its weakest part.
    pub fn said(&self, lexicon: &Lexicon, reading: &Reading, ears: Ears<'_>) -> Hit {
        let Some(first) = self.atoms.first() else {
            return Hit::default();
        };
        let mut hits: BTreeMap<usize, Hit> = first.hits(lexicon, reading, ears, false);
        for atom in &self.atoms[1..] {
            if hits.is_empty() {
                return Hit::default();
            }
            let others = atom.hits(lexicon, reading, ears, false);
            let best = highest(others.values());
            for (&sentence, hit) in &mut hits {
                // Parts of one clause belong together; two clauses may stand far apart.
                let near = [
                    (sentence.wrapping_sub(1), 0.9),
                    (sentence, 1.0),
                    (sentence + 1, 0.9),
                ]
                .into_iter()
                .filter_map(|(at, weight)| {
                    others.get(&at).map(|other| (other.score * weight, other))
                })
                .max_by(|a, b| a.0.total_cmp(&b.0));
                let other = if self.together {
                    near
                } else {
                    best.as_ref().map(|hit| (hit.score, hit))
                };
                match other {
                    Some((score, other)) => {
                        hit.score = hit.score.min(score);
                        hit.range = (
                            hit.range.0.min(other.range.0),
                            hit.range.1.max(other.range.1),
                        );
                    }
                    None => hit.score = 0.0,
                }
            }
        }
        let own_words = self.atoms.iter().any(|atom| !atom.words.is_empty());
        highest(hits.values().filter(|hit| !ears.deaf.contains(&hit.range)))
            .filter(|hit| hit.score >= PERHAPS)
            .map(|hit| Hit { own_words, ..hit })
            .unwrap_or_default()
    }

    /// Whether a reading says the contrary; only a single proposition has one.
    pub fn gainsaid(&self, lexicon: &Lexicon, reading: &Reading) -> bool {
        match self.atoms.as_slice() {
            [atom] => {
                let ears = Ears {
                    strict: true,
                    ..Ears::default()
                };
                highest(atom.hits(lexicon, reading, ears, true).values())
                    .is_some_and(|hit| hit.score >= GAINSAID)
            }
            _ => false,
        }
    }

    /// The places, surfaces and materials that the phrase is about.
    pub fn topics(&self) -> impl Iterator<Item = Id> + '_ {
        self.atoms.iter().flat_map(|atom| {
            [PLACE, SURFACE, MATERIAL]
                .into_iter()
                .flat_map(|class| atom.about[class].iter().copied())
        })
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
            && !grammar::is_known(&reading.forms[at].stem)
            && !grammar::is_known(token.word.trim_end_matches('s'))
            && clause.is_none_or(|c| reading.clause[at] == c);
        let stem = &reading.forms[at].stem;
        if counts && !out.contains(stem) {
            out.push(stem.clone());
        }
    }
    out
}

/// The clauses and sentences of a text that say something, as they stand in it.
pub fn clauses_of(lexicon: &Lexicon, text: &str) -> Vec<String> {
    let reading = parse::read(lexicon, prepare(text), &Setting::default(), &[]);
    let mut out = Vec::new();
    for group in [&reading.clause, &reading.sentence] {
        let mut start = 0;
        for at in 1..=group.len() {
            // An answer and the reply after it stand on lines of their own.
            let same_line = |at: usize| {
                let (before, here) = (reading.tokens[at - 1].end, reading.tokens[at].start);
                !text.get(before..here).is_some_and(|gap| gap.contains('\n'))
            };
            if at < group.len() && group[at] == group[start] && same_line(at) {
                continue;
            }
            let says = reading.heard[start..at].contains(&true);
            let words = text.get(reading.tokens[start].start..reading.tokens[at - 1].end);
            if let Some(words) = words.filter(|_| says) {
                let words = words
                    .trim_matches(|c: char| !c.is_alphanumeric())
                    .to_owned();
                if !out.contains(&words) {
                    out.push(words);
                }
            }
            start = at;
        }
    }
    out
}
