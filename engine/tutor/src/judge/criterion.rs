//! How one criterion is found in an answer: by its phrases, and by what all that is said weighs.

use super::evidence::{self, Heard, Weights};
use super::lexicon::lexicon;
use super::parse::Reading;
use super::phrase::{Ears, Hit, PERHAPS, Phrase, STATED};
use super::{Criterion, Finding, matching};

/// From here on a phrase is said in so many words.
const CLEAR: f64 = 0.97;

/// What no phrase says has to weigh that much by itself before a pass is built on it.
const PLAIN: f64 = 2.5;

impl Criterion {
    pub fn find(&self, reading: &Reading, understood: u128, deaf: &[(usize, usize)]) -> Finding {
        let ears = Ears {
            deaf,
            ..self.ears(understood)
        };
        let mut best = Hit::default();
        for phrase in &self.phrases {
            let hit = self.hear(phrase, reading, ears);
            if hit.score > best.score {
                best = hit;
            }
        }
        let against = self
            .against
            .iter()
            .map(|p| p.said(lexicon(), reading, ears).score)
            .fold(0.0, f64::max);
        self.settle(best, against, reading)
    }

    pub fn ears(&self, understood: u128) -> Ears<'static> {
        Ears {
            strict: self.is_misconception,
            understood,
            deaf: &[],
        }
    }

    /// How well a phrase of this criterion is said.
    pub fn hear(&self, phrase: &Phrase, reading: &Reading, ears: Ears<'_>) -> Hit {
        let mut hit = phrase.said(lexicon(), reading, ears);
        if hit.score > 0.6 && phrase.gainsaid(lexicon(), reading) {
            // Said and gainsaid: which of the two stands is not for a machine to guess.
            hit.score = 0.6;
        }
        hit
    }

    /// What follows from the best of its phrases and the best of those against it.
    pub fn settle(&self, best: Hit, against: f64, reading: &Reading) -> Finding {
        let heard = self.by_phrases(best, against, reading);
        match &self.weights {
            Some(weights) if against < STATED => self.weighed(weights, heard, reading),
            _ => heard,
        }
    }

    /// The same, all that is said considered.
    fn weighed(&self, weights: &Weights, found: Finding, reading: &Reading) -> Finding {
        // What is said in words that only the phrase knows has no weight, and needs none.
        if matches!(&found, Finding::Stated(hit) if hit.own_words) {
            return found;
        }
        let log_odds = weights.log_odds(&reading.features);
        let (heard, hit) = match found {
            Finding::Absent => (Heard::Not, None),
            Finding::Perhaps(hit) => (Heard::Half, Some(hit)),
            Finding::Stated(hit) => (Heard::Said, Some(hit)),
        };
        // Who says the contrary, and nothing for it, has not said it in other words.
        let gainsaid = |phrase: &Phrase| phrase.gainsaid(lexicon(), reading);
        if heard == Heard::Not && !self.is_misconception && self.phrases.iter().any(gainsaid) {
            return Finding::Absent;
        }
        let score = evidence::likelihood(self.is_misconception, heard, log_odds);
        // What a phrase says in so many words is not taken for its contrary: it stays open.
        let clear = hit.as_ref().is_some_and(|hit| hit.score >= CLEAR);
        let (perhaps, stated) = self.bars(heard, clear);
        let (hit, plain) = match hit {
            Some(hit) => (Some(hit), true),
            None => {
                let strongest = self.strongest(reading);
                let plain = strongest.as_ref().is_some_and(|it| it.1 >= PLAIN);
                (strongest.map(|it| it.0), plain || !self.required)
            }
        };
        match hit.map(|hit| Hit { score, ..hit }) {
            Some(hit) if score >= stated && plain => Finding::Stated(hit),
            Some(hit) if score >= perhaps => Finding::Perhaps(hit),
            _ => Finding::Absent,
        }
    }

    /// How likely it has to be to stay open, and to be stated.
    fn bars(&self, heard: Heard, clear: bool) -> (f64, f64) {
        let (perhaps, stated) = match (self.is_misconception, heard) {
            // Without a phrase nobody is kept from passing, and nobody passes easily.
            (true, Heard::Not) if self.blocking => (0.35, 2.0),
            (true, Heard::Not) => (0.6, 0.8),
            (false, Heard::Not) if self.required => (0.4, 0.85),
            (false, Heard::Half) if self.required => (0.4, 0.75),
            (true, Heard::Half) if self.blocking => (0.25, 0.6),
            (true, Heard::Said) if self.blocking => (0.2, 0.5),
            (true, _) => (0.4, 0.5),
            (false, _) => (0.4, 0.6),
        };
        (if clear { 0.0 } else { perhaps }, stated)
    }

    /// The words that speak most for it, and how much they do.
    pub fn strongest(&self, reading: &Reading) -> Option<(Hit, f64)> {
        let (at, weight) = self.weights.as_ref()?.strongest(&reading.features)?;
        let range = matching::quote(reading, &reading.statements[at]);
        let hit = Hit {
            score: PERHAPS,
            range,
            own_words: false,
        };
        Some((hit, weight))
    }

    /// What follows from its phrases alone.
    fn by_phrases(&self, best: Hit, against: f64, reading: &Reading) -> Finding {
        match best.score {
            _ if against >= STATED => Finding::Absent,
            score if score >= STATED => Finding::Stated(best),
            score if score >= PERHAPS => Finding::Perhaps(best),
            // It speaks of the right thing in words that are not known: no ground to say no.
            _ if self.required => match reading.unread(lexicon(), &self.topics) {
                Some(range) => Finding::Perhaps(Hit {
                    score: PERHAPS,
                    range,
                    own_words: false,
                }),
                None => Finding::Absent,
            },
            _ => Finding::Absent,
        }
    }
}
