//! What is claimed without being said again: "and the centre too", "the centre is not".

use super::lexicon::{Lexicon, PLACE, Role, SURFACE};
use super::parse::{Reading, Statement};
use super::text::Kind;

impl Reading {
    /// "The edges get too dark, and the centre too": says the same of the centre.
    pub fn complete(&mut self, lexicon: &Lexicon) {
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
            let trails = matches!(after, "too" | "also" | "likewise" | "equally" | "similarly")
                && ends
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
                .take(12)
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
        added.extend(self.answered(lexicon));
        added.extend(self.does_have_one(lexicon));
        self.statements.extend(added);
        self.statements.sort_by_key(|s| (s.tokens.0, s.tokens.1));
    }

    /// "There should be no bright edge, and his version has one": so there is one.
    fn does_have_one(&mut self, lexicon: &Lexicon) -> Vec<Statement> {
        let mut added = Vec::new();
        for at in 0..self.tokens.len() {
            let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
            if !matches!(
                word(at),
                "have" | "has" | "shows" | "show" | "gives" | "gets"
            ) || word(at + 1) != "one"
                || self
                    .tokens
                    .get(at + 2)
                    .is_some_and(|t| t.kind == Kind::Word)
            {
                continue;
            }
            let split = self.statements.partition_point(|s| s.tokens.0 < at);
            let sentence = self.sentence[at];
            let clause = self.clause[at];
            let denied = self.statements[..split]
                .iter_mut()
                .rev()
                .take(6)
                .take_while(|s| s.sentence == sentence)
                .find(|s| {
                    s.denied
                        && !s.void
                        && s.concepts
                            .iter()
                            .any(|&id| lexicon.concept(id).antonym.is_some())
                });
            if let Some(said) = denied {
                added.push(Statement {
                    denied: false,
                    ideal: false,
                    clause,
                    tokens: (at, at + 2),
                    ..said.clone()
                });
                said.void = true;
            }
        }
        added
    }

    /// "N is not the normal of the facet, H is", "the rim is bright, the centre is not": a verb
    /// alone says the same of another, or denies it.
    fn answered(&self, lexicon: &Lexicon) -> Vec<Statement> {
        let mut added = Vec::new();
        let state = |s: &&Statement| {
            s.concepts
                .iter()
                .any(|&id| lexicon.concept(id).role == Role::State)
        };
        for (index, other) in self.statements.iter().enumerate() {
            let (start, end) = other.tokens;
            let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
            let verb = matches!(
                word(end),
                "is" | "are" | "does" | "do" | "has" | "have" | "will"
            );
            let denied = word(end + 1) == "not";
            let ends = self
                .tokens
                .get(end + 1 + usize::from(denied))
                .is_none_or(|t| {
                    t.kind != Kind::Word && t.kind != Kind::Value && t.kind != Kind::Op
                });
            if !verb || !ends || state(&other) {
                continue;
            }
            let said = self.statements[..index]
                .iter()
                .rev()
                .take(6)
                .take_while(|s| s.sentence == other.sentence)
                .find(|s| state(s) && s.tokens.1 <= start && s.clause != other.clause);
            let Some(said) = said.filter(|s| s.denied != denied && !s.compared) else {
                continue;
            };
            let mut copy = Statement {
                denied,
                clause: other.clause,
                tokens: other.tokens,
                ..said.clone()
            };
            for &id in &other.concepts {
                if let Role::Entity(class) = lexicon.concept(id).role {
                    copy.about[class] = other.about[class].clone();
                }
            }
            added.push(copy);
        }
        added
    }
}
