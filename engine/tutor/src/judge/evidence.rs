//! What all that an answer says speaks for, taken together.
//!
//! A phrase is heard or it is not. Where a lesson comes with many marked answers, everything
//! else that is said is weighed too: each statement ("dim, of the centre"), for and against each
//! criterion, by a logistic regression whose weights stand in `evidence.txt`. `weigh` learns
//! them. A rubric that is not in that file is judged by its phrases alone, and so is a criterion
//! whose sentence has been changed since.

use std::collections::BTreeMap;

use super::lexicon::{Id, Lexicon, QUANTITY};
use super::matching::is_given;
use super::parse::{Held, Reading, Statement};
use super::text::Kind;

/// The weights that come with the program.
pub const LEARNT: &str = include_str!("evidence.txt");

/// Something said of up to two things.
pub type Key = u64;

/// Words of one tendency, heard as one beside what they say each.
const FAMILIES: [(&str, &[&str]); 5] = [
    ("up", &["bright", "glow", "sparkle", "rise", "high"]),
    ("down", &["dim", "fall", "quarter", "nospot", "low"]),
    ("wide", &["blurred", "spread", "big", "uniform"]),
    ("tight", &["concentrated", "small"]),
    ("infinite", &["singular"]),
];

/// A statement that weighs less says nothing by itself.
const TELLING: f64 = 1.5;

/// A word by itself tells less than what it is heard to say.
const OF_A_WORD: f64 = 0.6;

/// Set in the keys of words; no statement reaches that bit.
const WORD: Key = 1 << 63;

/// Before a word, where keys are written down.
const WORD_SIGN: &str = "'";

/// How a word is said: its code is the concept's, times four, and this.
const PLAIN: u64 = 0;
/// The contrary of it is denied.
const CONTRARY: u64 = 1;
/// It is denied, and has no contrary.
const DENIED: u64 = 2;
/// One of a family of words.
const FAMILY: u64 = 3;

/// Bits of a code; one more than its value, so that none is 0.
const BITS: u32 = 20;

/// What an answer says, each thing once.
#[derive(Clone, Debug, Default)]
pub struct Features(Vec<Feature>);

#[derive(Clone, Copy, Debug)]
struct Feature {
    key: Key,
    /// How surely it is said of that, 0 to 1.
    value: f64,
    /// The statement that says it most surely.
    statement: usize,
}

impl Features {
    /// Each thing said and how surely.
    pub fn iter(&self) -> impl Iterator<Item = (Key, f64)> + '_ {
        self.0.iter().map(|it| (it.key, it.value))
    }
}

/// What a reading says, each thing once, in the order of the keys.
pub fn features(lexicon: &Lexicon, reading: &Reading) -> Features {
    let mut all = Vec::new();
    for (index, statement) in reading.statements.iter().enumerate() {
        // Who only asks claims nothing.
        if !statement.void && !statement.guessed {
            add(lexicon, statement, index, &mut all);
        }
    }
    all.extend(words(reading).map(|(stem, statement)| Feature {
        key: word_key(stem),
        value: OF_A_WORD,
        statement,
    }));
    all.sort_by(|a: &Feature, b| {
        (a.key, a.statement)
            .cmp(&(b.key, b.statement))
            .then(b.value.total_cmp(&a.value))
    });
    all.dedup_by(|next, kept| {
        let same = next.key == kept.key;
        if same && next.value > kept.value {
            *kept = *next;
        }
        same
    });
    Features(all)
}

/// The words that a reading claims something with, each with the statement next to it in its
/// clause; where nothing else is heard in the clause, with [`NOWHERE`].
pub fn words(reading: &Reading) -> impl Iterator<Item = (&str, usize)> {
    let asks = reading.statements.iter().any(|s| s.guessed);
    let tokens = if asks { 0 } else { reading.tokens.len() };
    (0..tokens).filter_map(|at| {
        let token = &reading.tokens[at];
        let tells = match token.kind {
            Kind::Word => !is_filling(&token.word),
            Kind::Value | Kind::Op | Kind::Question => true,
            _ => false,
        };
        if !tells || reading.mute[at] {
            return None;
        }
        let (from, to) = reading.of_clause[reading.clause[at]];
        let here = &reading.statements[from..to];
        let next = from + here.partition_point(|s| s.tokens.0 <= at);
        let distance = |index: &usize| {
            let (start, end) = reading.statements[*index].tokens;
            start.saturating_sub(at).max((at + 1).saturating_sub(end))
        };
        let claimed = |index: &usize| !reading.statements[*index].void;
        let near = from.max(next.saturating_sub(NEAR))..to.min(next + NEAR);
        let nearest = near.filter(claimed).min_by_key(distance);
        // What is only reported, asked or taken back is not claimed by its words either.
        (from == to || nearest.is_some())
            .then(|| (reading.forms[at].stem.as_str(), nearest.unwrap_or(NOWHERE)))
    })
}

/// Words that fill any sentence and so tell nothing of it.
fn is_filling(word: &str) -> bool {
    matches!(
        word,
        "the"
            | "a"
            | "an"
            | "is"
            | "are"
            | "be"
            | "it"
            | "its"
            | "of"
            | "to"
            | "and"
            | "in"
            | "so"
            | "i"
    )
}

/// So many statements to either side of a word are looked at: no clause says much more.
const NEAR: usize = 4;

/// No statement.
const NOWHERE: usize = usize::MAX;

/// The key of a word: its stem's hash (FNV-1a).
pub fn word_key(stem: &str) -> Key {
    let hash = stem.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    hash | WORD
}

fn add(lexicon: &Lexicon, statement: &Statement, index: usize, out: &mut Vec<Feature>) {
    for (place, &id) in statement.concepts.iter().take(3).enumerate() {
        // A further sense of a word is a guess.
        let sure = if place == 0 { 1.0 } else { 0.5 };
        let said = code_of(lexicon, id, statement.denied);
        // At most two concepts in each of five classes.
        let mut of = [(0, 0.0); 10];
        let mut count = 0;
        for about in statement.about.iter().flatten() {
            if about.concepts.first() == Some(&id) && !statement.denied {
                continue;
            }
            let held = match about.held {
                Held::Local => 1.0,
                Held::Inherited => 0.8,
                Held::Remembered => 0.5,
            };
            for &other in about.concepts.iter().take(2) {
                if count < of.len() {
                    of[count] = (code(u64::from(other), PLAIN), held);
                    count += 1;
                }
            }
        }
        let of = &of[..count];
        // "N·V goes to zero at the rim": what is put in does, and nothing else there.
        let given = statement.about[QUANTITY].as_ref().filter(|about| {
            about.held == Held::Local
                && about
                    .concepts
                    .iter()
                    .all(|&id| is_given(&lexicon.concept(id).name))
        });
        let given: Option<Vec<u64>> = given.map(|about| {
            let codes = about.concepts.iter();
            codes.map(|&id| code(u64::from(id), PLAIN)).collect()
        });
        let counts = |one: u64, other: u64| {
            given
                .as_ref()
                .is_none_or(|codes| codes.contains(&one) || codes.contains(&other))
        };
        let family = family_of(&lexicon.concept(id).name).filter(|_| !statement.denied);
        let family = family.map(|it| code(it, FAMILY));
        let mut push = |key: Key, value: f64| {
            out.push(Feature {
                key,
                value,
                statement: index,
            });
        };
        for (said, sure) in [(Some(said), sure), (family, 1.0)] {
            let Some(said) = said else { continue };
            if counts(0, 0) {
                push(said, sure);
            }
            for (i, &(one, held)) in of.iter().enumerate() {
                if counts(one, 0) {
                    push(key(said, one, 0), sure * held);
                }
                for &(other, too) in &of[..i] {
                    if counts(one, other) {
                        push(key(said, other, one), sure * held * too);
                    }
                }
            }
        }
    }
}

fn code(value: u64, how: u64) -> u64 {
    value * 4 + how + 1
}

fn key(said: u64, one: u64, other: u64) -> Key {
    said | one << BITS | other << (2 * BITS)
}

fn code_of(lexicon: &Lexicon, id: Id, denied: bool) -> u64 {
    match lexicon.concept(id).antonym {
        _ if !denied => code(u64::from(id), PLAIN),
        Some(other) => code(u64::from(other), CONTRARY),
        None => code(u64::from(id), DENIED),
    }
}

fn family_of(name: &str) -> Option<u64> {
    let place = FAMILIES.iter().position(|(_, all)| all.contains(&name));
    place.map(|place| place as u64)
}

/// A key in words: `~bright@rim` is "not dim, of the rim", and `'halo` is that very word, which
/// only who has read it knows.
pub fn name(lexicon: &Lexicon, key: Key, words: &BTreeMap<Key, String>) -> String {
    if key & WORD != 0 {
        let word = words.get(&key).map_or("", String::as_str);
        return format!("{WORD_SIGN}{word}");
    }
    let mask = (1 << BITS) - 1;
    let parts = [key & mask, key >> BITS & mask, key >> (2 * BITS) & mask];
    let one = |&code: &u64| {
        let value = (code - 1) / 4;
        let name = |id: u64| lexicon.concept(id as Id).name.as_str();
        match (code - 1) % 4 {
            CONTRARY => format!("~{}", name(value)),
            DENIED => format!("!{}", name(value)),
            FAMILY => format!("+{}", FAMILIES[value as usize].0),
            _ => name(value).to_owned(),
        }
    };
    let named: Vec<String> = parts.iter().filter(|&&code| code > 0).map(one).collect();
    named.join("@")
}

/// The key of those words; `None` where the lexicon has no such concept.
fn key_of(lexicon: &Lexicon, words: &str) -> Option<Key> {
    if let Some(stem) = words.strip_prefix(WORD_SIGN) {
        return Some(word_key(stem));
    }
    let mut out = 0;
    for (place, word) in words.split('@').enumerate() {
        let (how, word) = match word.split_at_checked(1)? {
            ("~", rest) => (CONTRARY, rest),
            ("!", rest) => (DENIED, rest),
            ("+", rest) => (FAMILY, rest),
            _ => (PLAIN, word),
        };
        let value = match how {
            FAMILY => FAMILIES.iter().position(|(name, _)| *name == word)? as u64,
            _ => u64::from(lexicon.id(word)?),
        };
        out |= code(value, how) << (place as u32 * BITS);
    }
    Some(out)
}

/// How much each thing said speaks for a criterion.
#[derive(Clone, Debug, Default)]
pub struct Weights {
    bias: f64,
    of: BTreeMap<Key, f64>,
}

impl Weights {
    /// The weights for a criterion that stand in a text like `evidence.txt`; `None` where there
    /// are none, or where they were learnt for another sentence.
    pub fn read(
        lexicon: &Lexicon,
        text: &str,
        item: &str,
        id: &str,
        says: &str,
    ) -> Option<Weights> {
        let head = format!("= {item} {id} ");
        let opens = |at: &usize| *at == 0 || text.as_bytes()[at - 1] == b'\n';
        let at = text.match_indices(&head).map(|(at, _)| at).find(opens)?;
        let mut lines = text[at + head.len()..].lines();
        let bias = lines.next()?;
        if lines.next()? != says {
            return None;
        }
        let mut weights = Weights {
            bias: bias.parse().ok()?,
            of: BTreeMap::new(),
        };
        for line in lines.take_while(|line| !line.starts_with('=')) {
            for entry in line.split_whitespace() {
                let (words, weight) = entry.rsplit_once(':')?;
                if let Some(key) = key_of(lexicon, words) {
                    weights.of.insert(key, weight.parse().ok()?);
                }
            }
        }
        Some(weights)
    }

    /// The log odds that an answer meets the criterion, as far as all that it says tells.
    pub fn log_odds(&self, features: &Features) -> f64 {
        let weigh = |it: &Feature| self.of.get(&it.key).map_or(0.0, |weight| weight * it.value);
        let sum: f64 = features.0.iter().map(weigh).sum();
        (self.bias + sum).clamp(-9.0, 9.0)
    }

    /// The statement that speaks most for the criterion, and how much; `None` where none says much: what only
    /// goes along with it, as good answers say many things, is not said.
    pub fn strongest(&self, features: &Features) -> Option<(usize, f64)> {
        let mut by_statement: BTreeMap<usize, f64> = BTreeMap::new();
        for it in features.0.iter().filter(|it| it.statement != NOWHERE) {
            if let Some(weight) = self.of.get(&it.key) {
                *by_statement.entry(it.statement).or_default() += weight * it.value;
            }
        }
        let most = by_statement.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        most.filter(|&(_, weight)| weight > TELLING)
    }
}

/// How likely a criterion is met, given what its phrases heard and what all that is said weighs.
pub fn likelihood(is_misconception: bool, heard: Heard, log_odds: f64) -> f64 {
    // Fitted on answers by writers on whom neither the phrases nor the weights were tuned.
    let (share, bias) = match (is_misconception, heard) {
        (false, Heard::Not) => (0.7, 0.0),
        (false, Heard::Half) => (0.7, 0.5),
        (false, Heard::Said) => (0.7, 1.1),
        (true, Heard::Not) => (1.0, 0.3),
        (true, Heard::Half) => (1.0, -0.5),
        (true, Heard::Said) => (1.0, 1.7),
    };
    1.0 / (1.0 + (-(share * log_odds + bias)).exp())
}

/// What the phrases of a criterion heard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Heard {
    /// None of them.
    Not,
    /// One, in doubt.
    Half,
    /// One of them.
    Said,
}
