//! What each statement is about: the word it stands with, else the last one spoken of.

use super::grammar;
use super::lexicon::{CAUSE, CLASSES, Id, Lexicon, MATERIAL, PLACE, QUANTITY, Role, SURFACE};
use super::parse::{About, Held, Match, Mention, Reading, Statement};
use super::spelling::is_preposition;
use super::text::Token;

impl Reading {
    /// Gives each mention what it is about.
    pub fn attach(&mut self, lexicon: &Lexicon, matches: &[Match]) {
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
        let both: Vec<usize> = (0..self.tokens.len())
            .filter(|&at| grammar::means_both(&self.tokens, at))
            .collect();
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
            let (place, surface) = (since(PLACE), since(SURFACE));
            let parted = place < surface
                && self.tokens[place..surface]
                    .iter()
                    .rev()
                    .take(20)
                    .any(|t| t.is(";"));
            if about[PLACE].as_ref().is_some_and(|a| a.held < Held::Local)
                && (since(MATERIAL) > since(PLACE)
                    || since(SURFACE) > since(PLACE)
                        && (parted
                            || about[PLACE]
                                .as_ref()
                                .is_some_and(|a| a.held == Held::Remembered)))
            {
                about[PLACE] = None;
            }
            // "Both lobes are centred on one normal": not of the one named last.
            for class in [SURFACE, MATERIAL] {
                let of_both = about[class].as_ref().is_some_and(|a| {
                    let since = both.partition_point(|&at| at < a.tokens.1);
                    a.held < Held::Local && both.get(since).is_some_and(|&at| at < found.end)
                });
                if of_both {
                    about[class] = None;
                }
            }
            let (clause, sentence) = (self.clause[found.start], self.sentence[found.start]);
            let statement = Statement {
                concepts: found.concepts.clone(),
                tokens: (found.start, found.end),
                denied: self.denied[found.start] && !self.forbidden(lexicon, found),
                void: false,
                guessed: false,
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
        self.owed(lexicon, &mentions[QUANTITY]);
    }

    /// "It is dark there because of Fresnel", "dark there, by Fresnel": said of Fresnel too.
    fn owed(&mut self, lexicon: &Lexicon, mentions: &[Mention]) {
        let fresnel = lexicon.id("fresnel");
        let word = |tokens: &[Token], i: usize| -> bool {
            matches!(
                tokens[i].word.as_str(),
                "because" | "due" | "by" | "thanks" | "via" | "through" | "your" | "," | "owing"
            )
        };
        for m in mentions.iter().filter(|m| Some(m.concept) == fresnel) {
            let owed = (m.start.saturating_sub(3)..m.start)
                .any(|i| self.sentence[i] == self.sentence[m.start] && word(&self.tokens, i));
            if !owed {
                continue;
            }
            let here = self.sentence[m.start];
            let (from, to) = (m.start.saturating_sub(12), m.end + 9);
            self.each_between(from, to, |s| {
                let near = s.sentence == here && s.about[QUANTITY].is_none();
                if near {
                    s.about[QUANTITY] = Some(About {
                        concepts: vec![m.concept],
                        held: Held::Inherited,
                        tokens: (m.start, m.end),
                    });
                }
            });
        }
    }

    /// "One should not divide a second time": so somebody does.
    fn forbidden(&self, lexicon: &Lexicon, found: &Match) -> bool {
        found
            .concepts
            .iter()
            .any(|&id| lexicon.concept(id).name == "twice")
            && (found.start.saturating_sub(8)..found.start).any(|i| {
                self.sentence[i] == self.sentence[found.start]
                    && matches!(
                        self.tokens[i].word.as_str(),
                        "should" | "must" | "ought" | "need" | "needs" | "may"
                    )
                    && (i + 1..(i + 4).min(found.start)).any(|j| self.tokens[j].is("not"))
            })
    }

    /// What stands on the other side of "than".
    fn compared(&self, list: &[Mention], next: usize, found: &Match) -> Option<Mention> {
        // "Outshines the highlight" compares by itself.
        let from = found.end - usize::from(self.tokens[found.end - 1].word.starts_with("outsh"));
        let than = (from..(found.end + 5).min(self.tokens.len()))
            .find(|&i| grammar::compares(&self.tokens, i))?;
        let other = list.get(next..)?.iter().find(|m| {
            m.start > than
                && m.start < than + 5
                && self.sentence[m.start] == self.sentence[found.start]
        })?;
        // "Duller than a metal ball should be": compared with what it ought to be.
        let ought = (other.end..(other.end + 5).min(self.tokens.len())).any(|i| {
            self.clause[i] == self.clause[other.start]
                && matches!(
                    self.tokens[i].word.as_str(),
                    "should" | "ought" | "must" | "would" | "right" | "normally" | "usually"
                )
        });
        (!ought).then_some(*other)
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
        let before = self.before(list, next);
        let local =
            |m: &Mention| Some(self.with_partner(list, self.specific(list, m), Held::Local));
        // "darker than the centre, which is a quarter": what stands right before is meant.
        let first = self.clause.partition_point(|&c| c < clause);
        if first > 0
            && matches!(self.tokens[first].word.as_str(), "which" | "that")
            && list
                .get(next.wrapping_sub(1))
                .is_none_or(|m| m.start < first)
            && let Some(m) = list[..next.min(list.len())].last().filter(|m| {
                m.end + 2 >= first
                    && (m.class == PLACE
                        && (m.end == first || m.end + 1 == first && self.tokens[first].is("which"))
                        || m.class == QUANTITY
                            && (m.end..first).len() <= 2
                            && (m.end..first).all(|i| {
                                matches!(
                                    self.tokens[i].word.as_str(),
                                    "," | "effect" | "term" | "factor" | "reflectance" | "law"
                                )
                            }))
            })
        {
            return Some(self.with_partner(list, m, Held::Local));
        }
        // "It is white there and gloomy in the middle": the place named before.
        let there = self.tokens.get(found.end).is_some_and(|t| t.is("there"))
            && !self
                .tokens
                .get(found.end + 1)
                .is_some_and(|t| grammar::is_copula(&t.word));
        if let Some(m) = before.filter(|m| {
            there && m.class == PLACE && self.sentence[m.start] == self.sentence[found.start]
        }) {
            return local(m);
        }
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
                // and "his picture has a white edge".
                if self.generic.contains(&prev.concept)
                    && let Some(m) = after_here.filter(|m| !self.generic.contains(&m.concept))
                    && ((found.end..m.start).any(|i| is_preposition(&self.tokens[i].word))
                        && m.start - found.end <= 4
                        || (found.end..m.start).all(|i| is_state[i])
                            && !is_state.get(m.end).copied().unwrap_or(false))
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
                // "blown highlights along the outline".
                let at = list[next..]
                    .iter()
                    .take(4)
                    .find(|p| p.start > m.end && !self.generic.contains(&p.concept))
                    .filter(|p| {
                        self.generic.contains(&m.concept)
                            && self.clause[p.start] == clause
                            && p.start - m.end <= 3
                            && is_preposition(&self.tokens[m.end].word)
                            && !matches!(self.tokens[m.end].word.as_str(), "of" | "with" | "to")
                    });
                return local(at.unwrap_or(m));
            }
            let preposition = gap
                .clone()
                .take(3)
                .find(|&i| is_preposition(&self.tokens[i].word));
            let trailing = preposition.is_some_and(|i| m.start <= i + 4)
                && !gap.clone().any(|i| grammar::compares(&self.tokens, i));
            if trailing
                && before.is_none_or(|prev| {
                    self.clause[prev.start] != clause
                        || found.start - prev.end > 3
                        || preposition == Some(found.end)
                            && (prev.end..found.start)
                                .any(|i| self.tokens[i].is("and") || self.tokens[i].is(","))
                        || prev.class == PLACE
                })
            {
                return local(m);
            }
        }
        // "loses light where you face it and gains light where you graze it".
        let right_behind = self.tokens.get(found.end).is_some_and(|t| t.is("where"))
            && self.sentence[found.end] == self.sentence[found.start];
        if let Some(m) = after.filter(|m| {
            right_behind
                && m.class == PLACE
                && m.start <= found.end + 5
                && self.sentence[m.start] == self.sentence[found.start]
        }) {
            return local(m);
        }
        if let Some(prev) = before.filter(|m| self.clause[m.start] == clause) {
            return local(prev);
        }
        if let Some(m) = after_here.filter(|m| {
            !(m.start - 1..m.start).any(|i| self.tokens[i].is("than")) && m.start - found.end <= 8
        }) {
            let than_before = (found.end..m.start).any(|i| grammar::compares(&self.tokens, i));
            if !than_before {
                return local(m);
            }
        }
        // "too dark where it faces you": the place comes in a clause of its own.
        let where_it_is = (found.end..found.end + 3).any(|i| {
            self.tokens
                .get(i)
                .is_some_and(|t| t.is("where") || t.is("when"))
                && self.sentence[i] == self.sentence[found.start]
                && after.is_some_and(|m| {
                    m.start > i && m.start <= i + 5 && self.sentence[m.start] == self.sentence[i]
                })
        });
        if let Some(m) = after.filter(|_| where_it_is) {
            return local(m);
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
            || prev.class != CAUSE && self.refers_back(found.start)
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
        let led = |m: &Mention, reach: usize| {
            (m.start.saturating_sub(reach)..m.start).any(|i| is_preposition(&self.tokens[i].word))
        };
        let same = self.clause[earlier.start] == self.clause[m.start]
            && !self.generic.contains(&earlier.concept);
        // "At the edge the reflection", "the rim in his picture".
        let within = m.start - earlier.end <= 3
            && (m.start.saturating_sub(2)..m.start)
                .any(|i| matches!(self.tokens[i].word.as_str(), "of" | "in" | "on"));
        if same && (led(earlier, 3) || within) {
            earlier
        } else {
            m
        }
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
    fn before<'a>(&self, list: &'a [Mention], next: usize) -> Option<&'a Mention> {
        let behind_than = |m: &Mention| {
            (m.start.saturating_sub(3)..m.start).any(|i| {
                let compares = matches!(
                    self.tokens[i].word.as_str(),
                    "than" | "against" | "compared" | "unlike" | "opposed"
                ) || grammar::compares(&self.tokens, i);
                compares && self.clause[i] == self.clause[m.start]
            })
        };
        let nearest = list[..next.min(list.len())].iter().rev();
        nearest
            .clone()
            .take(3)
            .find(|m| !behind_than(m))
            .or_else(|| nearest.clone().next())
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
}
