//! From tokens to statements: what is said, of what, and whether it is denied.
//!
//! Each mention of a concept becomes a statement that carries, for each class of things
//! that exclude each other, the one it is about: the word it stands with, else the last one
//! spoken of. All passes run over the tokens a bounded number of times.

use super::grammar;
use super::lexicon::{CAUSE, CLASSES, Form, Id, Lexicon, MATERIAL, PLACE, QUANTITY, Role, SURFACE};
use super::spelling::is_preposition;
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
struct Mention {
    concept: Id,
    class: usize,
    start: usize,
    end: usize,
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
    /// Places that are the whole object, or wherever the highlight is.
    pub generic: Vec<Id>,
    /// For each clause, the statements of it (a range, as they come in order).
    pub of_clause: Vec<(usize, usize)>,
}

/// What a question gives its answers: the order of the things it names.
#[derive(Clone, Debug, Default)]
pub struct Setting {
    /// For each class, the entities in the order in which the question names them.
    pub order: [Vec<Id>; CLASSES],
}

/// A raw match of the lexicon.
struct Match {
    start: usize,
    end: usize,
    concepts: Vec<Id>,
}

/// Reads tokens.
pub fn read(lexicon: &Lexicon, tokens: Vec<Token>, setting: &Setting, mute: &[bool]) -> Reading {
    let forms: Vec<Form> = tokens.iter().map(|token| lexicon.form(token)).collect();
    let mut matches = find(lexicon, &tokens, &forms);
    let (clause, sentence) = clauses(lexicon, &tokens, &matches);
    let denied = denials(lexicon, &tokens, &matches, &clause, &sentence);
    let question_known = setting.order.iter().any(|order| !order.is_empty());
    if question_known
        && !lexicon
            .id("artist")
            .is_some_and(|artist| setting.order[CAUSE].contains(&artist))
    {
        // Where the question names no artist, a lamp is a lamp.
        for found in &mut matches {
            found
                .concepts
                .retain(|&id| lexicon.concept(id).role != Role::Entity(CAUSE));
        }
        matches.retain(|found| !found.concepts.is_empty());
    }
    suppose(lexicon, &tokens, &mut matches, &sentence, setting);
    resolve_ordinals(lexicon, &tokens, &mut matches, setting);
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
    reading.void(lexicon, mute);
    reading.index();
    reading
}

fn find(lexicon: &Lexicon, tokens: &[Token], forms: &[Form]) -> Vec<Match> {
    let mut out = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let found = matches!(tokens[at].kind, Kind::Word | Kind::Value | Kind::Op)
            .then(|| lexicon.longest(forms, at))
            .flatten();
        let Some((taken, concepts)) = found else {
            at += 1;
            continue;
        };
        // "the same normal" is not "the same".
        let article = matches!(tokens[at].word.as_str(), "the" | "a" | "an");
        if article
            && at + 1 < tokens.len()
            && lexicon
                .longest(forms, at + 1)
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

/// Places, surfaces and facets named inside a longer expression: the mirror of "a perfect
/// mirror".
fn embedded(lexicon: &Lexicon, forms: &[Form], start: usize, end: usize, out: &mut Vec<Match>) {
    for at in start..end {
        // The whole expression itself is not looked for again.
        let within = if at == start { end - 1 } else { end };
        let Some((taken, concepts)) = lexicon.longest(&forms[..within], at) else {
            continue;
        };
        let specific = |id: &Id| match lexicon.concept(*id).role {
            Role::Entity(PLACE) => {
                !matches!(lexicon.concept(*id).name.as_str(), "whole" | "highlight")
            }
            Role::Entity(class) => class == SURFACE || class == MATERIAL,
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

fn starts_with(tokens: &[Token], at: usize, words: &[&str]) -> bool {
    words
        .iter()
        .enumerate()
        .all(|(i, word)| tokens.get(at + i).is_some_and(|token| token.is(word)))
}

/// For each token, whether it stands in the reach of a denial. Two denials cancel out.
fn denials(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &[Match],
    clause: &[usize],
    sentence: &[usize],
) -> Vec<bool> {
    let mut denied = vec![false; tokens.len()];
    let mut inside = vec![false; tokens.len()];
    for found in matches {
        inside[found.start..found.end].fill(true);
    }
    let mut at = 0;
    while at < tokens.len() {
        let token = &tokens[at];
        if inside[at] {
            at += 1;
            continue;
        }
        let report = grammar::REPORTS
            .iter()
            .find(|words| starts_with(tokens, at, words));
        let negator = token.kind == Kind::Word && grammar::is_negator(&token.word);
        let not_only = starts_with(tokens, at, &["not", "only"])
            || starts_with(tokens, at, &["not", "just"])
            || starts_with(tokens, at, &["not", "merely"]);
        let idle = starts_with(tokens, at, &["no", "doubt"])
            || starts_with(tokens, at, &["no", "wonder"])
            || starts_with(tokens, at, &["no", "idea"])
            || starts_with(tokens, at, &["no", "matter"])
            || starts_with(tokens, at, &["not", "sure"])
            || starts_with(tokens, at, &["not", "know"])
            || (token.is("no")
                && tokens
                    .get(at + 1)
                    .is_none_or(|t| t.kind != Kind::Word && t.kind != Kind::Value))
            || starts_with(tokens, at, &["nothing", "but"])
            || starts_with(tokens, at, &["nothing", "else"]);
        if report.is_none() && (!negator || not_only || idle) {
            at += 1;
            continue;
        }
        let skip = report.map_or(1, |words| words.len());
        let speech = report.is_some_and(|words| {
            matches!(
                words[words.len() - 1],
                "say" | "think" | "expect" | "people" | "would" | "that"
            )
        });
        let wide = speech || token.is("neither") || token.is("nobody") || token.is("none");
        // "less" and "not" before a measure reach only it; a denial reaches to the clause's end.
        let mut end = at + skip;
        let limit = if wide { at + 24 } else { at + 14 };
        while end < tokens.len() && end < limit && sentence[end] == sentence[at] {
            let word = &tokens[end];
            let hard =
                matches!(word.kind, Kind::Break | Kind::Stop | Kind::Question) || word.is("->");
            let soft = word.kind == Kind::Comma
                || grammar::ends_denial(&word.word)
                || (word.is("and") && clause[end] != clause[at]);
            let passed = wide && (word.kind == Kind::Comma || word.is("and"));
            // "not so bright", "not even close".
            let opens = end == at + skip && word.kind == Kind::Word && !word.is("but");
            if hard || (soft && !passed && !opens && !inside[end]) {
                break;
            }
            if end > at + skip && !inside[end] && grammar::is_negator(&word.word) {
                break;
            }
            end += 1;
        }
        for flag in &mut denied[at + skip..end] {
            *flag = !*flag;
        }
        at = (at + skip).max(at + 1);
    }
    less(lexicon, tokens, matches, &mut denied);
    denied
}

/// "less concentrated", "not as wide": denies the one word that follows.
fn less(lexicon: &Lexicon, tokens: &[Token], matches: &[Match], denied: &mut [bool]) {
    for pair in matches.windows(2) {
        let [first, second] = pair else { continue };
        let is_less = first.end == first.start + 1
            && matches!(
                tokens[first.start].word.as_str(),
                "less" | "least" | "little"
            );
        let measures = second
            .concepts
            .iter()
            .any(|&id| lexicon.concept(id).antonym.is_some());
        if is_less && measures && second.start == first.end {
            for flag in &mut denied[second.start..second.end] {
                *flag = !*flag;
            }
        }
    }
}

/// "If the light were weak, ...": what an artist might have done, where the question names him.
fn suppose(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &mut Vec<Match>,
    sentence: &[usize],
    setting: &Setting,
) {
    let Some(artist) = lexicon
        .id("artist")
        .filter(|id| setting.order[CAUSE].contains(id))
    else {
        return;
    };
    let ids = [lexicon.id("light"), lexicon.id("basecolour")];
    let mut found = Vec::new();
    for at in (0..tokens.len()).filter(|&at| tokens[at].is("if") || tokens[at].is("were")) {
        let first = matches.partition_point(|m| m.start < at);
        let names = matches[first..].iter().take(4).any(|m| {
            sentence[m.start] == sentence[at]
                && m.start < at + 8
                && m.concepts.iter().any(|&id| ids.contains(&Some(id)))
        });
        if names {
            found.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![artist],
            });
        }
    }
    matches.extend(found);
    matches.sort_by_key(|m| m.start);
}

/// "the first", "the other": which of two.
fn resolve_ordinals(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &mut Vec<Match>,
    setting: &Setting,
) {
    let Some(class) = [SURFACE, MATERIAL, PLACE]
        .into_iter()
        .find(|&class| setting.order[class].len() >= 2)
    else {
        return;
    };
    if class == PLACE {
        return;
    }
    let mut named: Vec<Id> = Vec::new();
    let mut last: Option<Id> = None;
    let mut resolved: Vec<Match> = Vec::new();
    let mut next = 0;
    for at in 0..tokens.len() {
        while next < matches.len() && matches[next].start < at {
            next += 1;
        }
        if let Some(found) = matches.get(next).filter(|m| m.start == at) {
            for &id in &found.concepts {
                if lexicon.concept(id).role == Role::Entity(class) {
                    last = Some(id);
                    if !named.contains(&id) {
                        named.push(id);
                    }
                }
            }
        }
        let word = tokens[at].word.as_str();
        let follows = tokens
            .get(at + 1)
            .map(|t| t.word.as_str())
            .unwrap_or_default();
        let after_article = at > 0 && matches!(tokens[at - 1].word.as_str(), "the" | "in" | "one");
        let names_one = matches!(
            follows,
            "is" | "has"
                | "gives"
                | "shows"
                | "looks"
                | "are"
                | "will"
                | "would"
                | "should"
                | "one"
                | "ball"
                | "case"
                | "photo"
                | "surface"
                | "sphere"
                | "picture"
                | "material"
                | "image"
                | "it"
                | "version"
        ) || !is_word(tokens.get(at + 1));
        let stands_alone = after_article || names_one;
        let order = if named.len() >= 2 {
            &named
        } else {
            &setting.order[class]
        };
        let id = match word {
            "first" | "former" | "1st" if stands_alone && follows != "place" => {
                order.first().copied()
            }
            "second" | "latter" | "2nd"
                if stands_alone && follows != "time" && follows != "division" =>
            {
                order.get(1).copied()
            }
            "other" if names_one || (after_article && grammar::is_copula(follows)) => {
                let topic = last.or_else(|| order.first().copied());
                setting.order[class]
                    .iter()
                    .copied()
                    .find(|&id| Some(id) != topic)
            }
            _ => None,
        };
        let taken = matches
            .iter()
            .skip(next.saturating_sub(1))
            .take(2)
            .any(|m| m.start <= at && at < m.end);
        if let Some(id) = id
            && !taken
        {
            last = Some(id);
            resolved.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![id],
            });
        }
    }
    matches.extend(resolved);
    matches.sort_by_key(|m| m.start);
}

fn is_word(token: Option<&Token>) -> bool {
    token.is_some_and(|t| matches!(t.kind, Kind::Word | Kind::Value))
}

impl Reading {
    /// Gives each mention what it is about.
    fn attach(&mut self, lexicon: &Lexicon, matches: &[Match]) {
        let mut mentions: [Vec<Mention>; CLASSES] = Default::default();
        for found in matches {
            for &id in &found.concepts {
                if let Role::Entity(class) = lexicon.concept(id).role {
                    mentions[class].push(Mention {
                        concept: id,
                        class,
                        start: found.start,
                        end: found.end,
                    });
                }
            }
        }
        // Which words are said rather than spoken of: they may stand before their noun.
        let mut is_state = vec![false; self.tokens.len()];
        for found in matches.iter().filter(|m| {
            m.concepts
                .iter()
                .any(|&id| lexicon.concept(id).role == Role::State)
        }) {
            is_state[found.start..found.end].fill(true);
        }
        let ideal = self.ideals();
        let mut cursor = [0usize; CLASSES];
        for found in matches {
            let mut about: [Option<About>; CLASSES] = Default::default();
            let mut compared = None;
            for class in 0..CLASSES {
                let list = &mentions[class];
                while cursor[class] < list.len() && list[cursor[class]].end <= found.start {
                    cursor[class] += 1;
                }
                about[class] = self.about(list, cursor[class], found, &is_state);
                if class == PLACE || class == SURFACE {
                    compared = compared.or_else(|| self.compared(list, cursor[class], found));
                }
            }
            // A place named before the talk turned to another surface is not its place.
            let since = |class: usize| about[class].as_ref().map_or(0, |a: &About| a.tokens.0);
            if about[PLACE]
                .as_ref()
                .is_some_and(|a| a.held == Held::Remembered)
                && since(SURFACE).max(since(MATERIAL)) > since(PLACE)
            {
                about[PLACE] = None;
            }
            let (clause, sentence) = (self.clause[found.start], self.sentence[found.start]);
            let statement = Statement {
                concepts: found.concepts.clone(),
                tokens: (found.start, found.end),
                denied: self.denied[found.start],
                void: false,
                compared: false,
                ideal: ideal[clause],
                about,
                clause,
                sentence,
            };
            if let Some(other) = compared {
                let opposite: Vec<Id> = found
                    .concepts
                    .iter()
                    .filter_map(|&id| lexicon.concept(id).antonym)
                    .collect();
                if !opposite.is_empty() {
                    let mut implied = statement.clone();
                    implied.concepts = opposite;
                    implied.compared = true;
                    implied.about[other.class] = Some(About {
                        concepts: vec![other.concept],
                        held: Held::Local,
                        tokens: (other.start, other.end),
                    });
                    self.statements.push(statement);
                    self.statements.push(implied);
                    continue;
                }
            }
            self.statements.push(statement);
        }
    }

    /// What stands on the other side of "than".
    fn compared(&self, list: &[Mention], next: usize, found: &Match) -> Option<Mention> {
        let than = (found.end..(found.end + 5).min(self.tokens.len()))
            .find(|&i| self.tokens[i].is("than") || self.tokens[i].is("compared"))?;
        list.get(next..)?
            .iter()
            .find(|m| {
                m.start > than
                    && m.start < than + 5
                    && self.sentence[m.start] == self.sentence[found.start]
            })
            .copied()
    }

    fn about(
        &self,
        list: &[Mention],
        next: usize,
        found: &Match,
        is_state: &[bool],
    ) -> Option<About> {
        let clause = self.clause[found.start];
        // The words themselves name it ("white edge" is one entry; "quarter" is not).
        if let Some(own) = list
            .get(next)
            .filter(|m| m.start >= found.start && m.end <= found.end)
            .filter(|m| !(self.generic.contains(&m.concept) && is_state[found.start]))
        {
            let concepts = list[next..]
                .iter()
                .take_while(|m| m.end <= found.end)
                .map(|m| m.concept)
                .collect();
            return Some(About {
                concepts,
                held: Held::Local,
                tokens: (own.start, own.end),
            });
        }
        let after = list[next.min(list.len())..]
            .iter()
            .take(4)
            .find(|m| m.start >= found.end);
        let before = self.before(list, next, clause, found.start);
        let local =
            |m: &Mention| Some(self.with_partner(list, self.specific(list, m), Held::Local));
        let after_here = after.filter(|m| self.clause[m.start] == clause);
        // "the ball has the larger highlight": an article before the word binds it forward.
        let article = found.start > 0
            && matches!(
                self.tokens[found.start - 1].word.as_str(),
                "the" | "a" | "an" | "this" | "its" | "no"
            );
        if let Some(m) = after_here.filter(|m| article && m.start - found.end <= 2)
            && (found.end..m.start).all(|i| is_state[i] || self.tokens[i].is("and"))
        {
            return local(m);
        }
        if let Some(prev) = before.filter(|m| self.clause[m.start] == clause) {
            let gap = prev.end..found.start;
            if gap.len() <= 3
                && gap
                    .clone()
                    .all(|i| grammar::is_copula(&self.tokens[i].word) || self.tokens[i].is("not"))
            {
                // "rim bright", "rim is bright"; yet "the reflection is weaker at the rim".
                if self.generic.contains(&prev.concept)
                    && let Some(m) = after_here.filter(|m| !self.generic.contains(&m.concept))
                    && (found.end..m.start).any(|i| is_preposition(&self.tokens[i].word))
                    && m.start - found.end <= 4
                {
                    return local(m);
                }
                return local(prev);
            }
        }
        if let Some(m) = after_here {
            let gap = found.end..m.start;
            let adjectival = gap.len() <= 3
                && gap.clone().all(|i| {
                    is_state[i]
                        || matches!(
                            self.tokens[i].word.as_str(),
                            "and" | "or" | "of" | "the" | "part" | "looking"
                        )
                });
            let of_only = gap.clone().any(|i| self.tokens[i].is("the"))
                && !gap.clone().any(|i| self.tokens[i].is("of"));
            if adjectival && !of_only {
                return local(m);
            }
            let preposition = gap
                .clone()
                .take(3)
                .find(|&i| is_preposition(&self.tokens[i].word));
            let trailing = preposition.is_some_and(|i| m.start <= i + 4)
                && !gap.clone().any(|i| self.tokens[i].is("than"));
            if trailing
                && before.is_none_or(|prev| {
                    self.clause[prev.start] != clause
                        || found.start - prev.end > 3
                        || prev.class == PLACE
                })
            {
                return local(m);
            }
        }
        if let Some(prev) = before.filter(|m| self.clause[m.start] == clause) {
            return local(prev);
        }
        if let Some(m) = after_here.filter(|m| {
            !(m.start - 1..m.start).any(|i| self.tokens[i].is("than")) && m.start - found.end <= 8
        }) {
            let than_before = (found.end..m.start)
                .any(|i| self.tokens[i].is("than") || self.tokens[i].is("compared"));
            if !than_before {
                return local(m);
            }
        }
        if list
            .get(next)
            .or(list.last())
            .is_some_and(|m| m.class == QUANTITY)
        {
            return None;
        }
        let prev = before?;
        // What an artist might have done ends where the contrast begins.
        let contrast = |t: &Token| {
            matches!(
                t.word.as_str(),
                "but" | "whereas" | "while" | "however" | ";" | "--"
            )
        };
        if prev.class == CAUSE
            && self.tokens[prev.end..found.start]
                .iter()
                .rev()
                .take(40)
                .any(contrast)
        {
            return None;
        }
        let held = if self.sentence[prev.start] == self.sentence[found.start]
            || self.refers_back(found.start)
        {
            Held::Inherited
        } else {
            Held::Remembered
        };
        Some(self.with_partner(list, self.specific(list, prev), held))
    }

    /// "At the edge the reflection ...": the place named first is the one meant.
    fn specific<'a>(&self, list: &'a [Mention], m: &'a Mention) -> &'a Mention {
        if m.class != PLACE || !self.generic.contains(&m.concept) {
            return m;
        }
        let index = list.partition_point(|other| other.start < m.start);
        let Some(earlier) = index.checked_sub(1).and_then(|i| list.get(i)) else {
            return m;
        };
        let leads = (earlier.start.saturating_sub(3)..earlier.start)
            .any(|i| is_preposition(&self.tokens[i].word));
        let same = self.clause[earlier.start] == self.clause[m.start]
            && !self.generic.contains(&earlier.concept);
        if same && leads { earlier } else { m }
    }

    /// Whether a sentence begins by taking up the one before: "There it is", "This".
    fn refers_back(&self, at: usize) -> bool {
        let sentence = self.sentence[at];
        let first = self.sentence.partition_point(|&s| s < sentence);
        let word = self
            .tokens
            .get(first)
            .map(|t| t.word.as_str())
            .unwrap_or_default();
        matches!(
            word,
            "it" | "its"
                | "there"
                | "this"
                | "that"
                | "these"
                | "those"
                | "they"
                | "here"
                | "and"
                | "so"
                | "way"
                | "too"
                | "where"
        )
    }

    /// The last mention before, leaving out what stands behind "than".
    fn before<'a>(
        &self,
        list: &'a [Mention],
        next: usize,
        clause: usize,
        _at: usize,
    ) -> Option<&'a Mention> {
        let mut index = next;
        for _ in 0..3 {
            index = index.checked_sub(1)?;
            let m = &list[index];
            let behind_than = (m.start.saturating_sub(3)..m.start).any(|i| {
                (self.tokens[i].is("than")
                    || self.tokens[i].is("against")
                    || self.tokens[i].is("compared"))
                    && self.clause[i] == self.clause[m.start]
            });
            if !(behind_than && index > 0)
                || self.clause[m.start] != clause
                    && self.sentence[m.start] != self.sentence.get(m.end).copied().unwrap_or(0)
            {
                return Some(m);
            }
        }
        list.get(next.checked_sub(1)?)
    }

    /// "the rim and the centre": both.
    fn with_partner(&self, list: &[Mention], m: &Mention, held: Held) -> About {
        let mut concepts = vec![m.concept];
        let index = list.partition_point(|other| other.start < m.start);
        if let Some(other) = index.checked_sub(1).and_then(|i| list.get(i)) {
            let gap = other.end..m.start;
            let joined = gap.len() <= 3
                && gap
                    .clone()
                    .any(|i| self.tokens[i].is("and") || self.tokens[i].is("or"))
                && gap
                    .clone()
                    .all(|i| matches!(self.tokens[i].word.as_str(), "and" | "or" | "the" | "its"));
            if joined && other.concept != m.concept {
                concepts.push(other.concept);
            }
        }
        About {
            concepts,
            held,
            tokens: (m.start, m.end),
        }
    }

    /// Marks what is said but not claimed: taken back, dismissed, asked, echoed, or only a
    /// list of words.
    fn void(&mut self, lexicon: &Lexicon, mute: &[bool]) {
        let asked = self.questions();
        let listed = self.lists();
        for statement in &mut self.statements {
            let (start, end) = statement.tokens;
            let muted = mute
                .get(start..end)
                .is_some_and(|range| range.iter().any(|&m| m));
            statement.void = muted || asked[statement.sentence] || listed[statement.sentence];
        }
        // "a quarter as bright as it should be" does not say bright.
        for statement in &mut self.statements {
            let (start, end) = statement.tokens;
            let share = |t: &Token| {
                matches!(
                    t.word.as_str(),
                    "#1/4" | "quarter" | "half" | "third" | "#num" | "#0.9" | "fourth" | "fraction"
                )
            };
            let measured = start > 0
                && self.tokens[start - 1].is("as")
                && (self.tokens.get(end).is_some_and(|t| t.is("as"))
                    || self.tokens[start.saturating_sub(4)..start]
                        .iter()
                        .any(share));
            statement.void |= measured;
        }
        self.pass_through(lexicon);
        self.take_back(lexicon);
        self.dismiss();
        self.complete(lexicon);
    }

    /// "it collapses to 1 -> 1/pi": the last value of a chain is the one meant.
    fn pass_through(&mut self, lexicon: &Lexicon) {
        let number = |s: &Statement| {
            s.concepts
                .iter()
                .any(|&id| matches!(lexicon.concept(id).name.as_str(), "one" | "zero"))
        };
        let value = |s: &Statement| {
            s.concepts.iter().any(|&id| {
                matches!(
                    lexicon.concept(id).name.as_str(),
                    "singular" | "oneoverpi" | "quarter"
                )
            })
        };
        for index in 1..self.statements.len() {
            let (before, after) = self.statements.split_at_mut(index);
            let (first, second) = (&mut before[index - 1], &after[0]);
            let leads = second.tokens.0 == first.tokens.1 + 1
                && self
                    .tokens
                    .get(first.tokens.1)
                    .is_some_and(|t| t.is("->") || t.is("=") || t.is("/"));
            if leads && number(first) && value(second) {
                first.void = true;
            }
        }
    }

    /// "The edges get too dark, and the centre too": says the same of the centre.
    fn complete(&mut self, lexicon: &Lexicon) {
        let is_state = |s: &Statement| {
            s.concepts
                .iter()
                .any(|&id| lexicon.concept(id).role == Role::State)
        };
        let mut added: Vec<Statement> = Vec::new();
        for (index, entity) in self.statements.iter().enumerate() {
            let Some(class) =
                entity
                    .concepts
                    .iter()
                    .find_map(|&id| match lexicon.concept(id).role {
                        Role::Entity(class) if class == PLACE || class == SURFACE => Some(class),
                        _ => None,
                    })
            else {
                continue;
            };
            let (start, end) = entity.tokens;
            let after = self
                .tokens
                .get(end)
                .map(|t| t.word.as_str())
                .unwrap_or_default();
            let ends = self
                .tokens
                .get(end + 1)
                .is_none_or(|t| t.kind != Kind::Word && t.kind != Kind::Value);
            let trails = matches!(after, "too" | "also" | "likewise") && ends
                || after == "as" && self.tokens.get(end + 1).is_some_and(|t| t.is("well"));
            let leads = (start.saturating_sub(4)..start).any(|i| {
                matches!(self.tokens[i].word.as_str(), "as" | "so")
                    && self.tokens.get(i + 1).is_some_and(|t| {
                        matches!(
                            t.word.as_str(),
                            "will" | "is" | "does" | "do" | "are" | "would"
                        )
                    })
            });
            let above_all = (start.saturating_sub(2)..start).any(|i| {
                matches!(
                    self.tokens[i].word.as_str(),
                    "mostly"
                        | "especially"
                        | "particularly"
                        | "mainly"
                        | "chiefly"
                        | "notably"
                        | "particular"
                )
            }) && !self.statements[index..]
                .iter()
                .take_while(|s| s.clause == entity.clause)
                .any(is_state);
            if !(trails || leads || above_all) {
                continue;
            }
            let about = entity.about[class].clone();
            let earlier = self.statements[..index]
                .iter()
                .rev()
                .take_while(|s| s.sentence + 1 >= entity.sentence)
                .take(8);
            if let Some(said) = earlier
                .filter(|s| is_state(s))
                .find(|s| s.tokens.1 <= start)
            {
                let mut copy = said.clone();
                copy.about[class] = about;
                added.push(copy);
            }
        }
        self.statements.extend(added);
        self.statements.sort_by_key(|s| (s.tokens.0, s.tokens.1));
    }

    /// For each clause, whether it says what ought to be rather than what is.
    fn ideals(&self) -> Vec<bool> {
        let mut ideal = vec![false; self.clause.last().map_or(0, |last| last + 1)];
        let mut contrasts = false;
        for (at, token) in self.tokens.iter().enumerate() {
            if at == 0 || self.clause[at] != self.clause[at - 1] {
                contrasts = matches!(
                    token.word.as_str(),
                    "while" | "whereas" | "although" | "though"
                );
            }
            let ought = matches!(token.word.as_str(), "should" | "ought" | "supposed");
            let really = self.tokens.get(at + 1).is_some_and(|next| {
                matches!(
                    next.word.as_str(),
                    "really" | "actually" | "normally" | "rather" | "in"
                )
            });
            let reference = matches!(token.word.as_str(), "normally" | "usually" | "ordinarily");
            ideal[self.clause[at]] |= (ought && (contrasts || really)) || reference;
        }
        ideal
    }

    fn sentences(&self) -> usize {
        self.sentence.last().map_or(0, |last| last + 1)
    }

    fn questions(&self) -> Vec<bool> {
        let mut asked = vec![false; self.sentences()];
        let mut first = true;
        let mut asks = false;
        for (at, token) in self.tokens.iter().enumerate() {
            if first && token.kind == Kind::Word {
                asks = grammar::asks(&token.word);
                first = false;
            }
            if token.ends_sentence() {
                // "Double division? Not at all."
                let refused = self.tokens.get(at + 1).is_some_and(|next| {
                    matches!(
                        next.word.as_str(),
                        "no" | "not" | "nope" | "never" | "nah" | "hardly"
                    )
                });
                asked[self.sentence[at]] = token.kind == Kind::Question && (asks || refused);
                first = true;
                asks = false;
            }
        }
        asked
    }

    /// Sentences that are lists of words of the field without anything said.
    fn lists(&self) -> Vec<bool> {
        let mut words = vec![0usize; self.sentences()];
        let mut glue = words.clone();
        let mut mentions = words.clone();
        for (at, token) in self.tokens.iter().enumerate() {
            words[self.sentence[at]] += usize::from(matches!(token.kind, Kind::Word | Kind::Value));
            glue[self.sentence[at]] += usize::from(grammar::is_glue(&token.word));
        }
        for statement in self.statements.iter().filter(|s| !s.compared) {
            mentions[statement.sentence] += 1;
        }
        (0..words.len())
            .map(|s| mentions[s] >= 7 && glue[s] * 10 < words[s])
            .collect()
    }

    /// "it is infinite, but no, it is 1": the later statement of the two stands.
    fn take_back(&mut self, lexicon: &Lexicon) {
        let markers: Vec<usize> = (0..self.tokens.len())
            .filter(|&at| {
                grammar::CORRECTIONS
                    .iter()
                    .any(|words| starts_with(&self.tokens, at, words))
            })
            .collect();
        for marker in markers {
            let here = self.sentence[marker];
            let split = self.statements.partition_point(|s| s.tokens.0 < marker);
            let from = self.statements[..split]
                .iter()
                .rposition(|s| s.sentence + 1 < here)
                .map_or(0, |i| i + 1)
                .max(split.saturating_sub(12));
            let to = (split + 12).min(self.statements.len());
            for earlier in from..split {
                let conflict = (split..to).any(|later| {
                    self.statements[later].sentence <= here + 1
                        && conflicts(lexicon, &self.statements[earlier], &self.statements[later])
                });
                if conflict {
                    self.statements[earlier].void = true;
                }
            }
        }
    }

    fn dismiss(&mut self) {
        for at in 0..self.tokens.len() {
            if !grammar::DISMISSALS
                .iter()
                .any(|words| starts_with(&self.tokens, at, words))
            {
                continue;
            }
            let clause = self.clause[at];
            // A dismissal that opens its sentence speaks of the sentence before.
            let opens = self.sentence[at] != self.sentence[at.saturating_sub(2)] || at < 2;
            let sentence = if opens {
                self.sentence[at].saturating_sub(1)
            } else {
                self.sentence[at]
            };
            let split = self.statements.partition_point(|s| s.tokens.0 < at);
            for statement in self.statements[..split]
                .iter_mut()
                .rev()
                .take_while(|s| s.sentence >= sentence)
                .take(12)
            {
                statement.void |= statement.clause < clause || opens;
            }
        }
    }

    /// The first clause that speaks of one of these and says something of it in words that
    /// are not known.
    pub fn unread(&self, lexicon: &Lexicon, topics: &[Id]) -> Option<(usize, usize)> {
        let heard = self
            .statements
            .iter()
            .filter(|s| {
                s.concepts
                    .iter()
                    .any(|&id| lexicon.concept(id).role == Role::State)
            })
            .any(|s| {
                s.about.iter().flatten().any(|about| {
                    about.held >= Held::Inherited
                        && about.concepts.iter().any(|id| topics.contains(id))
                })
            });
        if heard {
            return None;
        }
        let mut start = 0;
        while start < self.tokens.len() {
            let clause = self.clause[start];
            let end = start
                + self.clause[start..]
                    .iter()
                    .take_while(|&&c| c == clause)
                    .count();
            let (from, to) = self.of_clause[clause];
            let here = self.statements[from..to]
                .iter()
                .filter(|s| s.clause == clause);
            let names = here
                .clone()
                .any(|s| s.concepts.iter().any(|id| topics.contains(id)) && !s.void);
            let says = here.clone().any(|s| {
                s.concepts
                    .iter()
                    .any(|&id| lexicon.concept(id).role == Role::State)
            });
            let strange = (start..end).any(|i| {
                let token = &self.tokens[i];
                !self.heard[i]
                    && token.kind == Kind::Word
                    && token.word.len() > 3
                    && !grammar::is_known(&token.word)
                    && !grammar::is_known(&self.forms[i].stem)
            });
            if names && strange && !says {
                return Some((self.tokens[start].start, self.tokens[end - 1].end));
            }
            start = end;
        }
        None
    }

    fn index(&mut self) {
        let clauses = self.clause.last().map_or(0, |last| last + 1);
        self.of_clause = vec![(0, 0); clauses];
        for (at, statement) in self.statements.iter().enumerate() {
            let range = &mut self.of_clause[statement.clause];
            if range.1 == 0 {
                range.0 = at;
            }
            range.1 = at + 1;
        }
    }
}

/// Whether two statements about the same thing cannot both be held.
pub fn conflicts(lexicon: &Lexicon, a: &Statement, b: &Statement) -> bool {
    let same_topic = (0..CLASSES)
        .filter(|&class| class != QUANTITY)
        .all(|class| match (&a.about[class], &b.about[class]) {
            (Some(x), Some(y)) => {
                let generic = |about: &About| {
                    about.concepts.iter().all(|&id| {
                        matches!(lexicon.concept(id).name.as_str(), "whole" | "highlight")
                    })
                };
                x.concepts.iter().any(|id| y.concepts.contains(id))
                    || (class == PLACE && (generic(x) || generic(y)))
            }
            _ => true,
        });
    let values = ["singular", "zero", "one", "oneoverpi"];
    let opposed = a.concepts.iter().any(|&x| {
        b.concepts.iter().any(|&y| {
            let (cx, cy) = (lexicon.concept(x), lexicon.concept(y));
            let both_values =
                values.contains(&cx.name.as_str()) && values.contains(&cy.name.as_str());
            if a.denied == b.denied {
                cx.antonym == Some(y) || (both_values && x != y)
            } else {
                x == y
            }
        })
    });
    same_topic && opposed
}
