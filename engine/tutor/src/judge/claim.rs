//! What is said but not claimed: taken back, dismissed, asked, only listed.

use super::grammar;
use super::lexicon::{CLASSES, Id, Lexicon, PLACE, QUANTITY, Role};
use super::parse::{About, Held, Reading, Statement, starts_with};
use super::spelling::is_preposition;
use super::text::{Kind, Token};

impl Reading {
    /// Marks what is said but not claimed: taken back, dismissed, asked, echoed, or only a
    /// list of words.
    pub fn void(&mut self, lexicon: &Lexicon, mute: &[bool]) {
        let (asked, guessed) = self.questions();
        let listed = self.lists(lexicon);
        let wondered = self.wonders();
        for statement in &mut self.statements {
            let (start, end) = statement.tokens;
            let muted = mute
                .get(start..end)
                .is_some_and(|range| range.iter().any(|&m| m));
            statement.guessed = guessed;
            statement.void =
                muted || asked[statement.sentence] || listed[statement.sentence] || wondered[start];
        }
        // "a quarter as bright as it should be", "not as bright as it should be": dim.
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
            let below = self.tokens[start.saturating_sub(4)..start]
                .iter()
                .any(share)
                && !self.tokens[start.saturating_sub(3)..start]
                    .iter()
                    .any(|t| t.is("times"));
            let not = self.tokens[start.saturating_sub(4)..start]
                .iter()
                .any(|t| matches!(t.word.as_str(), "not" | "hardly" | "nowhere"));
            let contrary: Vec<Id> = statement
                .concepts
                .iter()
                .filter_map(|&id| lexicon.concept(id).antonym)
                .collect();
            let less = below && !statement.denied || not && statement.denied;
            if measured && less && !contrary.is_empty() {
                statement.concepts = contrary;
                statement.denied = false;
            } else {
                statement.void |= measured;
            }
        }
        self.subjects(lexicon);
        self.pass_through(lexicon);
        self.take_back(lexicon);
        self.dismiss();
        self.hearsay(lexicon);
        self.addressed();
        self.left_open();
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

    /// For each clause, whether it says what ought to be rather than what is.
    pub fn ideals(&self) -> Vec<bool> {
        let mut ideal = vec![false; self.clause.last().map_or(0, |last| last + 1)];
        let mut contrasts = false;
        // Whether the clause after this one turns against it.
        let mut turned = vec![false; ideal.len() + 1];
        for at in 1..self.tokens.len() {
            let turns = matches!(self.tokens[at].word.as_str(), "but" | "yet" | "instead");
            if turns
                && self.clause[at] != self.clause[at - 1]
                && self.sentence[at] == self.sentence[at - 1]
            {
                turned[self.clause[at - 1]] = true;
                if self.tokens[at - 1].kind == Kind::Comma && at > 1 {
                    turned[self.clause[at - 2]] = true;
                }
            }
        }
        for (at, token) in self.tokens.iter().enumerate() {
            if at == 0 || self.clause[at] != self.clause[at - 1] {
                contrasts = matches!(
                    token.word.as_str(),
                    "while"
                        | "whereas"
                        | "although"
                        | "though"
                        | "which"
                        | "that"
                        | "because"
                        | "since"
                );
                contrasts |= self.tokens.get(at + 1).is_some_and(|next| next.is("which"));
                contrasts |= turned[self.clause[at]];
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

    /// Sentences that ask, and whether all of them do. A question mark behind a statement only
    /// hedges it; an answer with nothing but question marks is a guess.
    fn questions(&self) -> (Vec<bool>, bool) {
        let mut asked = vec![false; self.sentences()];
        let mut first = true;
        let (mut asks, mut shy) = (false, false);
        let mut stated = false;
        for (at, token) in self.tokens.iter().enumerate() {
            if first && matches!(token.kind, Kind::Word | Kind::Value) {
                asks = grammar::asks(&token.word);
                let next = self.tokens.get(at + 1).map(|t| t.word.as_str());
                let hedged = self.hedges(at) || self.owns(at);
                asked[self.sentence[at]] =
                    !hedged && next.is_some_and(|n| grammar::inverts(&token.word, n));
                asks &= !hedged;
                shy = hedged;
                first = false;
            }
            if token.ends_sentence() {
                // "Double division? Not at all."
                let refused = self.tokens.get(at + 1).is_some_and(|next| {
                    matches!(
                        next.word.as_str(),
                        "no" | "not" | "nope" | "never" | "nah" | "hardly" | "wrong" | "forget"
                    )
                }) || starts_with(&self.tokens, at + 1, &["i", "doubt"])
                    || starts_with(&self.tokens, at + 1, &["on", "the", "contrary"])
                    || starts_with(&self.tokens, at + 1, &["quite", "the", "opposite"])
                    || starts_with(&self.tokens, at + 1, &["that", "is", "a", "myth"]);
                asked[self.sentence[at]] |= token.kind == Kind::Question && (asks || refused);
                let held = !asks && (self.reasons(at) || self.is_tag(at)) || shy;
                stated |= !first && (token.kind != Kind::Question || held);
                first = true;
                (asks, shy) = (false, false);
            }
        }
        stated |= !first;
        (asked, !stated)
    }

    /// "It goes white because you divide by almost nothing?", "it gets too dark then, I think?":
    /// who gives a reason or his opinion does not only ask.
    fn reasons(&self, end: usize) -> bool {
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        (end.saturating_sub(30)..end)
            .rev()
            .take_while(|&i| self.sentence[i] == self.sentence[end])
            .any(|i| {
                let thinks = word(i) == "i" && matches!(word(i + 1), "think" | "guess" | "believe");
                thinks || matches!(word(i), "because" | "since" | "cause")
            })
    }

    /// "It is 0/0, right?", "it gets darker, doesn't it?": who wants a yes has said it.
    fn is_tag(&self, end: usize) -> bool {
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        let parted = (end.saturating_sub(5)..end).rev().find(|&i| {
            self.tokens[i].kind == Kind::Comma && self.sentence[i] == self.sentence[end]
        });
        let Some(comma) = parted else { return false };
        let first = word(comma + 1);
        match end - comma - 1 {
            1 => matches!(
                first,
                "right" | "no" | "yes" | "correct" | "eh" | "innit" | "ok" | "okay"
            ),
            2..=4 => {
                grammar::asks(first)
                    && (comma + 2..end).any(|i| matches!(word(i), "not" | "it" | "they"))
            }
            _ => false,
        }
    }

    /// "Is it maybe that ...?", "Isn't it that ...?": says it, if shyly.
    fn hedges(&self, first: usize) -> bool {
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        let shy = |i: usize| matches!(word(i), "maybe" | "perhaps" | "possibly" | "because");
        word(first + 1) == "not"
            || matches!(word(first + 1), "it" | "that" | "this")
                && word(first) == "is"
                && (shy(first + 2) || word(first + 2) == "that")
    }

    /// "Is it the roughness? That would be my answer.": it is.
    fn owns(&self, first: usize) -> bool {
        let next = self
            .sentence
            .partition_point(|&s| s <= self.sentence[first]);
        [
            ["that", "would", "be", "my"],
            ["that", "is", "my", "answer"],
            ["that", "is", "my", "guess"],
        ]
        .iter()
        .any(|words| starts_with(&self.tokens, next, words))
    }

    /// For each token, whether it stands behind "I wonder whether".
    fn wonders(&self) -> Vec<bool> {
        let mut wondered = vec![false; self.tokens.len()];
        let mut on = None;
        for (at, flag) in wondered.iter_mut().enumerate() {
            if grammar::WONDERS
                .iter()
                .any(|words| starts_with(&self.tokens, at, words))
            {
                on = Some(self.sentence[at]);
            }
            let turns = matches!(self.tokens[at].word.as_str(), "but" | ";" | "--" | "...");
            if on != Some(self.sentence[at]) || turns {
                on = None;
            }
            *flag = on.is_some();
        }
        wondered
    }

    /// Sentences that are lists of words of the field without anything said.
    fn lists(&self, lexicon: &Lexicon) -> Vec<bool> {
        let mut words = vec![0usize; self.sentences()];
        let mut glue = words.clone();
        let mut breaks = words.clone();
        let mut mentions = words.clone();
        let mut joined = words.clone();
        for (at, token) in self.tokens.iter().enumerate() {
            words[self.sentence[at]] += usize::from(matches!(token.kind, Kind::Word | Kind::Value));
            let joins = token.is("and") || token.is("or");
            glue[self.sentence[at]] += usize::from(grammar::is_glue(&token.word) && !joins);
            breaks[self.sentence[at]] += usize::from(token.is(";") || token.is("--"));
            joined[self.sentence[at]] += usize::from(joins);
        }
        for statement in self.statements.iter().filter(|s| !s.compared) {
            mentions[statement.sentence] += 1;
        }
        let mut names = vec![false; words.len()];
        for statement in &self.statements {
            names[statement.sentence] |= statement.about.iter().any(Option::is_some);
        }
        // "concentrated spread": a word and its contrary, of nothing.
        let mut torn = vec![false; words.len()];
        for pair in self.statements.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            torn[a.sentence] |= a.sentence == b.sentence
                && a.tokens.1 == b.tokens.0
                && a.concepts
                    .iter()
                    .filter_map(|&id| lexicon.concept(id).antonym)
                    .any(|id| b.concepts.contains(&id))
                && !names[a.sentence];
        }
        let mut commas = vec![0usize; words.len()];
        let mut stops = vec![false; words.len()];
        for (at, token) in self.tokens.iter().enumerate() {
            let parts = token.kind == Kind::Comma || token.is(";");
            commas[self.sentence[at]] += usize::from(parts);
            stops[self.sentence[at]] |= matches!(token.kind, Kind::Comma | Kind::Break);
        }
        (0..words.len())
            .map(|s| {
                let long = mentions[s] >= 7 && glue[s] + joined[s] == 0;
                // "spike flat 1/pi infinity": no subject, no verb, no comma.
                let bare = mentions[s] >= 4 && glue[s] == 0 && !names[s] && !stops[s];
                // "0/0, delta, spike, 1/pi, constant": words to choose from.
                let one_each = mentions[s] <= commas[s] + 2;
                let offered = mentions[s] >= 5 && commas[s] >= 4 && one_each && glue[s] <= 1;
                let parts = commas[s] + joined[s];
                let named =
                    mentions[s] >= 4 && parts >= 3 && mentions[s] <= parts + 1 && glue[s] == 0;
                // "grazing; 1; metal; F0; gold; high".
                let chopped =
                    breaks[s] >= 5 && glue[s] == breaks[s] && words[s] <= 2 * (breaks[s] + 1);
                chopped || long || bare || offered || named || (glue[s] == 0 && torn[s])
            })
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
            self.put_right(marker);
            let here = self.sentence[marker];
            let split = self.statements.partition_point(|s| s.tokens.0 < marker);
            let near = split.saturating_sub(12);
            let from = self.statements[near..split]
                .iter()
                .rposition(|s| s.sentence + 1 < here)
                .map_or(near, |i| near + i + 1);
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

    /// "from the roughness, sorry, from the index": the same preposition opens it again.
    fn put_right(&mut self, marker: usize) {
        let here = self.sentence[marker];
        let Some(again) = (marker + 1..(marker + 6).min(self.tokens.len()))
            .find(|&i| self.sentence[i] == here && is_preposition(&self.tokens[i].word))
        else {
            return;
        };
        let first = (marker.saturating_sub(9)..marker)
            .rev()
            .find(|&i| self.sentence[i] == here && self.tokens[i].word == self.tokens[again].word);
        let Some(first) = first else { return };
        self.each_between(first, marker, |s| s.void = true);
    }

    fn dismiss(&mut self) {
        for at in 0..self.tokens.len() {
            if !grammar::DISMISSALS
                .iter()
                .any(|words| starts_with(&self.tokens, at, words))
            {
                continue;
            }
            // "A white edge, which is wrong": the picture is, not who says so.
            let first = self.sentence.partition_point(|&s| s < self.sentence[at]);
            let spoken = (first..at).any(|i| grammar::speaks(&self.tokens[i].word));
            if self.tokens[at].is("which") && !spoken {
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
            // "V contains the denominator is not true": a whole clause is its subject.
            let whole = at > 0
                && self.tokens[at].is("is")
                && !matches!(
                    self.tokens[at - 1].word.as_str(),
                    "it" | "this" | "that" | "which" | "what"
                );
            for statement in self.statements[..split]
                .iter_mut()
                .rev()
                .take_while(|s| s.sentence >= sentence)
                .take(12)
            {
                statement.void |= statement.clause < clause || opens || whole;
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
            let unknown = (start..end).any(|i| grammar::disclaims(&self.tokens, i));
            if names && strange && !says && !unknown {
                return Some((self.tokens[start].start, self.tokens[end - 1].end));
            }
            start = end;
        }
        None
    }

    pub fn index(&mut self) {
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
    #[cfg(test)]
    super::steps::step();
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
