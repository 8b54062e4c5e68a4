//! The concepts of the field and the words for them, read once from `lexicon.txt`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use rust_stemmers::{Algorithm, Stemmer};

use super::spelling;
use super::text::{Kind, Token};

/// Classes of things that exclude each other: a statement is about one of each at most.
pub const CLASSES: usize = 5;
/// Where on the object.
pub const PLACE: usize = 0;
/// Which surface.
pub const SURFACE: usize = 1;
/// Which material.
pub const MATERIAL: usize = 2;
/// Which quantity.
pub const QUANTITY: usize = 3;
/// Which cause: the bug, or the artist.
pub const CAUSE: usize = 4;

const CLASS_NAMES: [&str; CLASSES] = ["place", "surface", "material", "quantity", "cause"];

/// Index of a concept.
pub type Id = u16;

/// What a concept does in a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What it is about; of a class.
    Entity(usize),
    /// What is said.
    State,
    /// What else is named.
    Thing,
    /// A word of the language that is none of these.
    Plain,
}

/// A concept.
#[derive(Clone, Debug)]
pub struct Concept {
    /// Its name in `lexicon.txt`.
    pub name: String,
    /// What it does.
    pub role: Role,
    /// The opposite state.
    pub antonym: Option<Id>,
    /// Whether denying it states the opposite.
    pub binary: bool,
}

#[derive(Debug)]
struct Entry {
    words: Vec<EntryWord>,
    concept: Id,
}

#[derive(Debug)]
struct EntryWord {
    word: String,
    stem: String,
    exact: bool,
    /// Whether an article may stand before it.
    article: bool,
}

/// A word of an answer, with the forms by which it may be found.
#[derive(Clone, Debug)]
pub struct Form {
    /// As written, or as a typo was read.
    pub word: String,
    /// Its stem.
    pub stem: String,
    /// The stem of its positive, for comparatives.
    pub positive: Option<String>,
}

/// Concepts and words.
#[derive(Debug)]
pub struct Lexicon {
    /// All concepts; an [`Id`] indexes them.
    pub concepts: Vec<Concept>,
    entries: Vec<Entry>,
    by_stem: BTreeMap<String, Vec<usize>>,
    vocabulary: BTreeSet<String>,
    stems: BTreeSet<String>,
    by_shape: BTreeMap<(char, usize), Vec<String>>,
}

/// Words that a longer expression may carry between its own.
fn is_filler(word: &str) -> bool {
    matches!(
        word,
        "its"
            | "very"
            | "too"
            | "so"
            | "quite"
            | "really"
            | "all"
            | "just"
            | "also"
            | "then"
            | "even"
            | "their"
            | "his"
            | "such"
            | "extremely"
            | "incredibly"
    )
}

fn is_article(word: &str) -> bool {
    matches!(word, "the" | "a" | "an")
}

/// The one lexicon.
pub fn lexicon() -> &'static Lexicon {
    static LEXICON: OnceLock<Lexicon> = OnceLock::new();
    LEXICON.get_or_init(|| Lexicon::read(include_str!("lexicon.txt")))
}

/// The expressions that an entry stands for: `weak|dim lamp|light` is four, and `~` is no word.
fn alternatives(entry: &str) -> Vec<String> {
    let mut all = vec![String::new()];
    for word in entry.split_whitespace() {
        all = all
            .iter()
            .flat_map(|before| {
                word.split('|').map(move |choice| match choice {
                    "~" => before.clone(),
                    _ if before.is_empty() => choice.to_owned(),
                    _ => format!("{before} {choice}"),
                })
            })
            .collect();
    }
    all
}

/// The stem of an English word.
pub fn stem(word: &str) -> String {
    Stemmer::create(Algorithm::English).stem(word).into_owned()
}

impl Lexicon {
    fn read(text: &str) -> Lexicon {
        let mut lexicon = Lexicon {
            concepts: Vec::new(),
            entries: Vec::new(),
            by_stem: BTreeMap::new(),
            vocabulary: BTreeSet::new(),
            stems: BTreeSet::new(),
            by_shape: BTreeMap::new(),
        };
        let mut antonyms: Vec<(Id, String)> = Vec::new();
        let mut more = Vec::new();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let Some((head, words)) = line.split_once(" = ") else {
                continue;
            };
            let head: Vec<&str> = head.split_whitespace().collect();
            let (name, role) = match head.as_slice() {
                ["entity", class, name] => {
                    let class = CLASS_NAMES
                        .iter()
                        .position(|known| known == class)
                        .unwrap_or(QUANTITY);
                    (*name, Role::Entity(class))
                }
                ["state", name, ..] => (*name, Role::State),
                ["thing", name] => (*name, Role::Thing),
                ["more", name] => {
                    more.push((*name, words));
                    continue;
                }
                _ => ("plain", Role::Plain),
            };
            let id = lexicon.concepts.len() as Id;
            if role == Role::State {
                for other in head[2..].iter().filter(|word| **word != "binary") {
                    antonyms.push((id, (*other).to_owned()));
                }
            }
            lexicon.concepts.push(Concept {
                name: name.to_owned(),
                role,
                antonym: None,
                binary: head.contains(&"binary"),
            });
            lexicon.add_all(words, id);
        }
        for (name, words) in more {
            if let Some(id) = lexicon.id(name) {
                lexicon.add_all(words, id);
            }
        }
        for (id, name) in antonyms {
            lexicon.concepts[id as usize].antonym = lexicon.id(&name);
        }
        for word in &lexicon.vocabulary {
            if let Some(first) = word.chars().next() {
                lexicon
                    .by_shape
                    .entry((first, word.chars().count()))
                    .or_default()
                    .push(word.clone());
            }
        }
        lexicon
    }

    fn add_all(&mut self, words: &str, concept: Id) {
        for entry in words.split(',') {
            for spelled in alternatives(entry.trim()) {
                self.add(&spelled, concept);
            }
        }
    }

    fn add(&mut self, entry: &str, concept: Id) {
        let mut words: Vec<EntryWord> = Vec::new();
        let mut article = false;
        for raw in entry.split_whitespace() {
            // Articles come and go inside an expression.
            if !words.is_empty() && is_article(raw) {
                article = true;
                continue;
            }
            let exact = raw.starts_with('=') && raw.len() > 1;
            for word in spelling::words_of(raw.strip_prefix('=').filter(|_| exact).unwrap_or(raw)) {
                let stem = stem(&word);
                self.vocabulary.insert(word.clone());
                self.stems.insert(stem.clone());
                article |= words.last().is_some_and(|last| {
                    spelling::is_preposition(&last.word)
                        || matches!(last.word.as_str(), "all" | "both" | "half")
                });
                words.push(EntryWord {
                    exact: exact || word.starts_with('#'),
                    stem,
                    word,
                    article,
                });
                article = false;
            }
        }
        let Some(first) = words.first() else { return };
        self.by_stem
            .entry(first.stem.clone())
            .or_default()
            .push(self.entries.len());
        self.entries.push(Entry { words, concept });
    }

    /// The concept of that name.
    pub fn id(&self, name: &str) -> Option<Id> {
        self.concepts
            .iter()
            .position(|concept| concept.name == name)
            .map(|at| at as Id)
    }

    /// A concept.
    pub fn concept(&self, id: Id) -> &Concept {
        &self.concepts[id as usize]
    }

    /// The forms of a token, its typos put right.
    pub fn form(&self, token: &Token) -> Form {
        let mut word = token.word.clone();
        let mut stemmed = stem(&word);
        let mut positive = spelling::positive(&word)
            .map(|p| stem(&p))
            .filter(|p| self.stems.contains(p));
        if token.kind == Kind::Word
            && !self.stems.contains(&stemmed)
            && positive.is_none()
            && !super::grammar::is_known(&word)
            && let Some(correct) = self.correct(&word)
        {
            word = correct;
            stemmed = stem(&word);
            positive = spelling::positive(&word)
                .map(|p| stem(&p))
                .filter(|p| self.stems.contains(p));
        }
        Form {
            word,
            stem: stemmed,
            positive,
        }
    }

    /// The one word of the lexicon that this is a typo of.
    fn correct(&self, word: &str) -> Option<String> {
        let letters = word.chars().count();
        if !(5..=24).contains(&letters) || !word.chars().all(char::is_alphabetic) {
            return None;
        }
        let first = word.chars().next()?;
        let allowed = spelling::errors_allowed(letters);
        let mut best: Option<(usize, &String)> = None;
        for length in letters.saturating_sub(allowed)..=letters + allowed {
            for candidate in self.by_shape.get(&(first, length)).into_iter().flatten() {
                if length < 5 {
                    continue;
                }
                let distance = strsim::osa_distance(word, candidate);
                if letters <= SHORT && length == letters && is_another_word(word, candidate) {
                    continue;
                }
                if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, candidate));
                }
            }
        }
        best.map(|(_, candidate)| candidate.clone())
    }

    /// The longest expressions that start at a token: their concepts and how many tokens
    /// they take. Several concepts where a word has several senses. Entities of a class that
    /// is not spoken of can be left out.
    pub fn longest(
        &self,
        forms: &[Form],
        at: usize,
        without: Option<usize>,
    ) -> Option<(usize, Vec<Id>)> {
        let form = &forms[at];
        // Rank: tokens, then words as they stand, so that "lower" is not the stem of "low".
        let mut best: Option<(usize, usize)> = None;
        let mut concepts: Vec<Id> = Vec::new();
        let keys = [Some(&form.stem), form.positive.as_ref()];
        for key in keys.into_iter().flatten() {
            for &entry in self.by_stem.get(key).into_iter().flatten() {
                let entry = &self.entries[entry];
                if without
                    .is_some_and(|class| self.concept(entry.concept).role == Role::Entity(class))
                {
                    continue;
                }
                let Some((taken, exact)) = matches(entry, forms, at) else {
                    continue;
                };
                let rank = (taken, exact);
                if best.is_none_or(|known| rank > known) {
                    best = Some(rank);
                    concepts.clear();
                }
                if best == Some(rank) && !concepts.contains(&entry.concept) {
                    concepts.push(entry.concept);
                }
            }
        }
        let (taken, _) = best?;
        concepts.retain(|&id| self.concept(id).role != Role::Plain);
        Some((taken, concepts))
    }
}

/// Up to this length, words of the language lie so close together that a consonant exchanged for
/// another makes another word ("taped", "tamed"), not a slip of the finger.
const SHORT: usize = 6;

/// Whether two words of one length differ by one consonant in place of another.
fn is_another_word(word: &str, candidate: &str) -> bool {
    let is_vowel = |c: char| matches!(c, 'a' | 'e' | 'i' | 'o' | 'u' | 'y');
    let mut differing = word.chars().zip(candidate.chars()).filter(|(a, b)| a != b);
    match (differing.next(), differing.next()) {
        (Some((a, b)), None) => !(is_vowel(a) && is_vowel(b)),
        _ => false,
    }
}

/// How many tokens an entry takes from here, and whether all its words stand as written.
fn matches(entry: &Entry, forms: &[Form], at: usize) -> Option<(usize, usize)> {
    let mut next = at;
    let mut all_exact = true;
    let long = entry.words.len() > 2;
    let counted = |position: usize| {
        position > 0
            && matches!(
                entry.words[position - 1].word.as_str(),
                "one" | "single" | "same"
            )
    };
    for (position, wanted) in entry.words.iter().enumerate() {
        loop {
            let form = forms.get(next)?;
            let exact = form.word == wanted.word;
            let by_stem = !wanted.exact
                && (form.stem == wanted.stem || form.positive.as_ref() == Some(&wanted.stem));
            if exact || by_stem {
                all_exact &= exact;
                next += 1;
                break;
            }
            let inside = position > 0 && next < at + position + 2;
            let skipped = inside
                && (is_filler(&form.word) && !counted(position)
                    || is_article(&form.word) && (wanted.article || long && !counted(position)));
            if !skipped {
                return None;
            }
            next += 1;
        }
    }
    Some((next - at, usize::from(all_exact)))
}
