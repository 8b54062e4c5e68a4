//! From tokens to statements: what is said, of what, and whether it is denied.
//!
//! Each mention of a concept becomes a statement that carries, for each class of things
//! that exclude each other, the one it is about: the word it stands with, else the last one
//! spoken of. All passes run over the tokens a bounded number of times.

use std::collections::BTreeMap;

use super::denial::denials;
use super::evidence::Features;
use super::grammar;
use super::lexicon::{CAUSE, CLASSES, Form, Id, Lexicon, MATERIAL, PLACE, Role, SURFACE};
use super::pairs::{inside_out, once_and_again};
use super::refer::{in_order, resolve_ordinals, suppose, the_one_for};
use super::text::{Kind, Token};

/// How surely a statement is about something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Held {
    /// It is the last one spoken of, in another sentence.
    Remembered,
    /// It is the last one spoken of, in the same sentence.
    Inherited,
    /// It stands in the same clause.
    Local,
}

/// What a statement is about, in one class.
#[derive(Clone, Debug, PartialEq)]
pub struct About {
    /// The concept, and a second where two are joined by "and".
    pub concepts: Vec<Id>,
    /// How surely.
    pub held: Held,
    /// Tokens of the mention.
    pub tokens: (usize, usize),
}

/// One thing said.
#[derive(Clone, Debug)]
pub struct Statement {
    /// The concepts of the words that say it: usually one, several where a word has
    /// several senses.
    pub concepts: Vec<Id>,
    /// Tokens of the words.
    pub tokens: (usize, usize),
    /// Whether it is denied.
    pub denied: bool,
    /// Whether it is taken back, reported, asked, echoed: said, but not claimed.
    pub void: bool,
    /// Whether the answer as a whole only asks: it may betray a mistake, but claims nothing.
    pub guessed: bool,
    /// Whether it follows from a comparison ("brighter than the centre").
    pub compared: bool,
    /// Whether it says what ought to be ("while it should really fall off").
    pub ideal: bool,
    /// What it is about.
    pub about: [Option<About>; CLASSES],
    /// Its clause.
    pub clause: usize,
    /// Its sentence.
    pub sentence: usize,
}

/// A mention of an entity.
#[derive(Clone, Copy, Debug)]
pub struct Mention {
    /// What is named.
    pub concept: Id,
    /// Its class.
    pub class: usize,
    /// Its first token.
    pub start: usize,
    /// One past its last token.
    pub end: usize,
}

/// An answer, read.
#[derive(Debug, Default)]
pub struct Reading {
    /// Its tokens.
    pub tokens: Vec<Token>,
    /// Their forms.
    pub forms: Vec<Form>,
    /// What it says, in order.
    pub statements: Vec<Statement>,
    /// For each token, its clause.
    pub clause: Vec<usize>,
    /// For each token, its sentence.
    pub sentence: Vec<usize>,
    /// For each token, whether it stands in the reach of a denial.
    pub denied: Vec<bool>,
    /// For each token, whether a concept was heard in it.
    pub heard: Vec<bool>,
    /// For each token, whether it is the question's own, or stands on the way to something else.
    pub mute: Vec<bool>,
    /// Places that are the whole object, or wherever the highlight is.
    pub generic: Vec<Id>,
    /// For each clause, the statements of it (a range, as they come in order).
    pub of_clause: Vec<(usize, usize)>,
    /// What it says, as it is weighed; empty where nothing is.
    pub features: Features,
}

/// What a question gives its answers: the order of the things it names.
#[derive(Clone, Debug, Default)]
pub struct Setting {
    /// For each class, the entities in the order in which the question names them.
    pub order: [Vec<Id>; CLASSES],
}

/// A raw match of the lexicon.
pub struct Match {
    /// Its first token.
    pub start: usize,
    /// One past its last token.
    pub end: usize,
    /// What the words may mean.
    pub concepts: Vec<Id>,
}

/// Reads tokens.
pub fn read(lexicon: &Lexicon, tokens: Vec<Token>, setting: &Setting, mute: &[bool]) -> Reading {
    // Words come back; their forms are looked up once.
    let mut known: BTreeMap<(&str, bool), Form> = BTreeMap::new();
    let forms: Vec<Form> = tokens
        .iter()
        .map(|token| {
            let key = (token.word.as_str(), token.kind == Kind::Word);
            let form = known.entry(key).or_insert_with(|| lexicon.form(token));
            form.clone()
        })
        .collect();
    // Where the question names no artist, a lamp is a lamp.
    let question_known = setting.order.iter().any(|order| !order.is_empty());
    let artist = lexicon
        .id("artist")
        .is_some_and(|artist| setting.order[CAUSE].contains(&artist));
    let without = (question_known && !artist).then_some(CAUSE);
    let mut matches = find(lexicon, &tokens, &forms, without);
    // Where the question sets no two surfaces apart, a lone 0 or 1 names none.
    if question_known && setting.order[SURFACE].len() < 2 {
        matches.retain(|m| !tokens[m.start].word.starts_with("#rough"));
    }
    matches.retain(|m| !is_verb(&tokens, m) && !is_tag(&tokens, m));
    let (clause, sentence) = clauses(lexicon, &tokens, &matches);
    let denied = denials(lexicon, &tokens, &matches, &clause, &sentence);
    suppose(lexicon, &tokens, &mut matches, &sentence, setting);
    resolve_ordinals(lexicon, &tokens, &mut matches, setting);
    once_and_again(lexicon, &tokens, &mut matches, &sentence);
    if !setting.order[PLACE].is_empty() {
        inside_out(lexicon, &tokens, &mut matches);
    }
    the_one_for(lexicon, &tokens, &mut matches, &sentence);
    in_order(lexicon, &tokens, &mut matches, setting);
    let mut heard = vec![false; tokens.len()];
    for found in &matches {
        heard[found.start..found.end].fill(true);
    }
    let mut reading = Reading {
        tokens,
        forms,
        clause,
        sentence,
        denied,
        heard,
        generic: ["whole", "highlight"]
            .into_iter()
            .filter_map(|name| lexicon.id(name))
            .collect(),
        ..Reading::default()
    };
    reading.attach(lexicon, &matches);
    let mut mute = mute.to_vec();
    mute.resize(reading.tokens.len(), false);
    if setting.order[SURFACE].len() > 1 {
        on_the_way(&reading.tokens, &mut mute);
    }
    reading.void(lexicon, &mute);
    reading.mute = mute;
    reading.index();
    reading
}

/// "f = 1, so D is 1/π": what a letter of one's own is worth is not the value asked for.
fn on_the_way(tokens: &[Token], mute: &mut [bool]) {
    for at in 2..tokens.len() {
        let letter = &tokens[at - 2];
        let own = letter.kind == Kind::Word && letter.word.len() == 1 && !letter.is("d");
        mute[at] |= own && tokens[at - 1].is("=") && (tokens[at].is("#0") || tokens[at].is("#1"));
    }
}

fn find(lexicon: &Lexicon, tokens: &[Token], forms: &[Form], without: Option<usize>) -> Vec<Match> {
    let mut out = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let found = matches!(tokens[at].kind, Kind::Word | Kind::Value | Kind::Op)
            .then(|| lexicon.longest(forms, at, without))
            .flatten();
        let Some((taken, concepts)) = found else {
            at += 1;
            continue;
        };
        // "becomes more dark": the measure is the adjective's.
        let measures = tokens[at + taken - 1].is("more")
            && taken > 1
            && says(lexicon, forms, at + taken, without);
        if measures {
            at += taken;
            continue;
        }
        // "the same normal" is not "the same".
        let article = matches!(
            tokens[at].word.as_str(),
            "the" | "a" | "an" | "way" | "far" | "much"
        );
        if article
            && at + 1 < tokens.len()
            && lexicon
                .longest(forms, at + 1, without)
                .is_some_and(|(further, _)| further >= taken)
        {
            at += 1;
            continue;
        }
        if !concepts.is_empty() {
            let names = concepts
                .iter()
                .any(|&id| matches!(lexicon.concept(id).role, Role::Entity(_)));
            out.push(Match {
                start: at,
                end: at + taken,
                concepts,
            });
            if taken > 1 && !names {
                embedded(lexicon, forms, at, at + taken, &mut out);
            }
        }
        at += taken;
    }
    out
}

/// Whether something is said by the expression that starts here.
fn says(lexicon: &Lexicon, forms: &[Form], at: usize, without: Option<usize>) -> bool {
    at < forms.len()
        && lexicon
            .longest(forms, at, without)
            .is_some_and(|(_, concepts)| {
                concepts
                    .iter()
                    .any(|&id| lexicon.concept(id).role == Role::State)
            })
}

/// "They point everywhere" names no point.
fn is_verb(tokens: &[Token], found: &Match) -> bool {
    let subject = |word: &str| {
        matches!(
            word,
            "they" | "all" | "that" | "which" | "will" | "can" | "to" | "should" | "would" | "each"
        ) || word.len() > 4 && word.ends_with('s') && !word.ends_with("ss")
    };
    found.end == found.start + 1
        && tokens[found.start].is("point")
        && found
            .start
            .checked_sub(1)
            .is_some_and(|i| subject(&tokens[i].word))
        && tokens.get(found.end).is_some_and(|t| t.kind == Kind::Word)
}

/// "It is 0/0, right?" calls nothing right.
fn is_tag(tokens: &[Token], found: &Match) -> bool {
    found.end == found.start + 1
        && found.start > 0
        && matches!(
            tokens[found.start].word.as_str(),
            "right" | "correct" | "ok" | "okay"
        )
        && tokens[found.start - 1].kind == Kind::Comma
        && tokens
            .get(found.end)
            .is_some_and(|t| t.kind == Kind::Question)
}

/// Places, surfaces and facets named inside a longer expression: the mirror of "a perfect
/// mirror".
fn embedded(lexicon: &Lexicon, forms: &[Form], start: usize, end: usize, out: &mut Vec<Match>) {
    // A "tiny mirror" is a facet, of whichever surface.
    let is_facet = out.last().is_some_and(|m| {
        m.concepts
            .iter()
            .any(|&id| lexicon.concept(id).name == "facets")
    });
    let is_singular = out.last().is_some_and(|m| {
        m.concepts
            .iter()
            .any(|&id| lexicon.concept(id).name == "singular")
    });
    for at in start..end {
        // The whole expression itself is not looked for again.
        let within = if at == start { end - 1 } else { end };
        let Some((taken, concepts)) = lexicon.longest(&forms[..within], at, None) else {
            continue;
        };
        let specific = |id: &Id| match lexicon.concept(*id).role {
            Role::Entity(PLACE) => {
                // A ratio that "has a pole" has it where it is infinite.
                !is_singular && !matches!(lexicon.concept(*id).name.as_str(), "whole" | "highlight")
            }
            Role::Entity(class) => class == SURFACE && !is_facet || class == MATERIAL,
            Role::Thing => matches!(
                lexicon.concept(*id).name.as_str(),
                "facets" | "normals" | "halfvector"
            ),
            _ => false,
        };
        let concepts: Vec<Id> = concepts.into_iter().filter(specific).collect();
        if at + taken <= end && !concepts.is_empty() {
            out.push(Match {
                start: at,
                end: at + taken,
                concepts,
            });
        }
    }
}

/// Clause and sentence of each token.
fn clauses(lexicon: &Lexicon, tokens: &[Token], matches: &[Match]) -> (Vec<usize>, Vec<usize>) {
    let states: Vec<(usize, usize)> = matches
        .iter()
        .filter(|m| {
            m.concepts
                .iter()
                .any(|&id| lexicon.concept(id).role == Role::State)
        })
        .map(|m| (m.start, m.end))
        .collect();
    let mut inside = vec![false; tokens.len()];
    for found in matches {
        inside[found.start + 1..found.end].fill(true);
    }
    let mut said = vec![false; tokens.len() + 1];
    for &(_, end) in &states {
        said[end] = true;
    }
    let mut named = vec![0; tokens.len() + 1];
    for found in matches {
        let surface = |&id: &Id| {
            matches!(
                lexicon.concept(id).role,
                Role::Entity(PLACE | SURFACE | MATERIAL)
            )
        };
        if found.concepts.iter().any(surface) {
            named[found.start] = found.end;
        }
    }
    // "it is bright the rim is dark": where no sign parts two clauses, the subject and verb of
    // the second do.
    let runs_on = |at: usize| {
        let noun = at + usize::from(tokens[at].is("the"));
        let mut verb = named[noun];
        if tokens
            .get(verb)
            .is_some_and(|t| t.is("one") || t.is("ball"))
        {
            verb += 1;
        }
        // "how dim the picture is": the verb ends it.
        let goes_on = tokens.get(verb + 1).is_some_and(|t| {
            matches!(t.kind, Kind::Word | Kind::Value) && !matches!(t.word.as_str(), "and" | "or")
        });
        // "a dead centre is": an adjective stands before its noun.
        let ended = |&(_, end): &(usize, usize)| end == at;
        let told = tokens[at].is("the")
            || states[..states.partition_point(|s| s.0 < at)]
                .iter()
                .rev()
                .take(3)
                .filter(|s| ended(s))
                .any(|s| s.0 > 0 && grammar::is_copula(&tokens[s.0 - 1].word));
        said[at]
            && told
            && verb > 0
            && goes_on
            && tokens.get(verb).is_some_and(|t| {
                matches!(
                    t.word.as_str(),
                    "is" | "are" | "has" | "gives" | "gets" | "becomes" | "->" | "=" | ";"
                )
            })
    };
    let mut clause = Vec::with_capacity(tokens.len());
    let mut sentence = Vec::with_capacity(tokens.len());
    let (mut clause_now, mut sentence_now) = (0, 0);
    let mut next_state = 0;
    let mut clause_start = 0;
    for (at, token) in tokens.iter().enumerate() {
        while next_state < states.len() && states[next_state].0 < at {
            next_state += 1;
        }
        let said_before = next_state > 0 && states[next_state - 1].0 >= clause_start;
        let soon = states
            .get(next_state)
            .is_some_and(|&(start, _)| start > at + 1 && start < at + 9);
        let joins = token.is("and") && said_before && soon;
        let boundary = !inside[at]
            && (matches!(token.kind, Kind::Comma | Kind::Break)
                || joins
                || runs_on(at)
                || (token.kind != Kind::Value && grammar::begins_clause(&token.word)));
        // "D -> infinity" says something of D; a longer clause before an arrow is a reason.
        let boundary = boundary && (said_before || !token.is("->"));
        if boundary {
            clause_now += 1;
            clause_start = at;
        }
        clause.push(clause_now);
        sentence.push(sentence_now);
        if token.ends_sentence() {
            clause_now += 1;
            sentence_now += 1;
            clause_start = at + 1;
        }
    }
    (clause, sentence)
}

pub fn starts_with(tokens: &[Token], at: usize, words: &[&str]) -> bool {
    words
        .iter()
        .enumerate()
        .all(|(i, word)| tokens.get(at + i).is_some_and(|token| token.is(word)))
}
