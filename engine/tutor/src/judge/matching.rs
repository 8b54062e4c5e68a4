//! How well one statement of an answer says one proposition of a phrase.

use std::collections::BTreeMap;

use super::lexicon::{CAUSE, CLASSES, Form, Id, Lexicon, MATERIAL, PLACE, QUANTITY, SURFACE};
use super::parse::{About, Held, Reading, Statement};
use super::phrase::{Atom, Ears, Hit, PERHAPS};

/// How well a word's senses meet those of a phrase. The first sense of a word is the one
/// meant; two words that meet only in their further senses do not mean the same.
fn senses(wanted: &[Id], said: &[Id], ears: Ears<'_>, as_said: impl Fn(Id) -> Option<Id>) -> f64 {
    let mut best: f64 = 0.0;
    for (i, &id) in said.iter().enumerate() {
        let Some(id) = as_said(id) else { continue };
        let Some(sought) = wanted.iter().position(|&sought| sought == id) else {
            continue;
        };
        best = best.max(match (i, sought) {
            (0, 0) => 1.0,
            (_, 0) if ears.strict => 0.7,
            (_, 0) => 0.95,
            _ => 0.45,
        });
    }
    best
}

impl Atom {
    /// The best hit in each sentence.
    pub fn hits(
        &self,
        lexicon: &Lexicon,
        reading: &Reading,
        ears: Ears<'_>,
        contrary: bool,
    ) -> BTreeMap<usize, Hit> {
        let mut hits = BTreeMap::new();
        if self.anchor.is_empty() {
            return if contrary {
                hits
            } else {
                self.by_words(reading)
            };
        }
        for statement in reading
            .statements
            .iter()
            .filter(|s| !s.void && (ears.strict || !s.guessed))
        {
            let mut score = self.polarity(lexicon, statement, ears, contrary);
            // "A weak lamp cannot make the rim bright": so something else does.
            let of_artist = statement.about[CAUSE].as_ref().is_some_and(|about| {
                about.held >= Held::Inherited
                    && about
                        .concepts
                        .iter()
                        .any(|&id| lexicon.concept(id).name == "artist")
            });
            let elsewhere = of_artist
                && statement.denied
                && !ears.strict
                && !contrary
                && self.about[CAUSE].is_empty();
            if elsewhere && !self.about[PLACE].is_empty() {
                let claimed = Statement {
                    denied: false,
                    about: without_cause(statement),
                    ..statement.clone()
                };
                score = 0.85
                    * self.polarity(lexicon, &claimed, ears, false)
                    * self.topic(lexicon, reading, &claimed, ears);
                let best: &mut Hit = hits.entry(statement.sentence).or_default();
                if score > best.score && score >= PERHAPS {
                    *best = Hit {
                        score,
                        range: quote(reading, statement),
                        own_words: false,
                    };
                }
                continue;
            }
            if score < PERHAPS {
                continue;
            }
            // A further sense of a word, of a thing unnamed, is a guess.
            if score < 1.0
                && !self.about[QUANTITY].is_empty()
                && statement.about[QUANTITY].is_none()
            {
                score *= 0.75;
            }
            score *= self.topic(lexicon, reading, statement, ears);
            if score < PERHAPS {
                continue;
            }
            score *= self.company(reading, statement);
            let range = quote(reading, statement);
            let best: &mut Hit = hits.entry(statement.sentence).or_default();
            if score > best.score + 1e-9 && !ears.deaf.contains(&range) {
                *best = Hit {
                    score,
                    range,
                    own_words: false,
                };
            }
        }
        hits
    }

    /// Does the statement say it (or, if asked, the contrary), and how clearly?
    fn polarity(
        &self,
        lexicon: &Lexicon,
        statement: &Statement,
        ears: Ears<'_>,
        contrary: bool,
    ) -> f64 {
        let says = senses(&self.anchor, &statement.concepts, ears, Some);
        let opposite = senses(&self.anchor, &statement.concepts, ears, |id| {
            lexicon.concept(id).antonym
        });
        let binary = senses(&self.anchor, &statement.concepts, ears, |id| {
            let concept = lexicon.concept(id);
            concept.antonym.filter(|_| concept.binary)
        });
        let sure = if statement.compared { 0.8 } else { 1.0 };
        let denied = statement.denied != self.denied;
        match (denied, contrary) {
            (false, false) | (true, true) => says * sure,
            (true, false) if says > 0.0 => 0.0,
            (true, false) => (binary * sure).max(opposite * 0.6),
            (false, true) if says > 0.0 => 0.0,
            (false, true) => opposite * sure,
        }
    }

    /// Is the statement about what the phrase is about?
    fn topic(
        &self,
        lexicon: &Lexicon,
        reading: &Reading,
        statement: &Statement,
        ears: Ears<'_>,
    ) -> f64 {
        // What one sees of the spot says nothing of the cause behind it.
        let of_cause = !self.about[QUANTITY].is_empty() || !self.things.is_empty();
        let held = if self.things.is_empty() {
            Held::Inherited
        } else {
            Held::Local
        };
        if of_cause
            && !self.about[SURFACE].is_empty()
            && self.about[PLACE].is_empty()
            && statement.about[QUANTITY].is_none()
            && is_highlight(lexicon, statement, held)
        {
            return 0.0;
        }
        let mut score: f64 = if statement.ideal && self.about[QUANTITY].is_empty() {
            0.4
        } else {
            1.0
        };
        for class in 0..CLASSES {
            let wanted = &self.about[class];
            let is =
                |ids: &[Id], name: &str| ids.iter().any(|&id| lexicon.concept(id).name == name);
            let about = statement.about[class].as_ref();
            if wanted.is_empty() {
                // "Nothing is wrong with the D": of the line as a whole it says nothing.
                let part = |name: &str| matches!(name, "d" | "fresnel" | "f0" | "ndotl" | "ndotv");
                if class == QUANTITY
                    && ears.strict
                    && is(&self.anchor, "correct")
                    && about.is_some_and(|a| {
                        let mut names = a.concepts.iter().map(|&id| &lexicon.concept(id).name);
                        a.held == Held::Local && names.all(|name| part(name))
                    })
                {
                    score *= 0.45;
                }
                // What an artist might have done is not what the picture shows.
                if class == CAUSE
                    && about.is_some_and(|a| a.held >= Held::Inherited && is(&a.concepts, "artist"))
                {
                    score *= 0.45;
                }
                if class == QUANTITY
                    && about.is_some_and(|a| a.held == Held::Local)
                    && self.is_value(lexicon)
                {
                    let given = about.is_some_and(|a| {
                        a.concepts
                            .iter()
                            .all(|&id| is_given(&lexicon.concept(id).name))
                    });
                    score *= if given { 0.0 } else { 1.0 };
                }
                continue;
            }
            let generic = class == PLACE && (is(wanted, "whole") || is(wanted, "highlight"));
            score *= match about {
                // "less light where N faces L; blow-out where it doesn't": somewhere, not all over.
                None if generic && ears.strict && elsewhere(lexicon, reading, statement) => 0.6,
                None if generic => 0.9,
                None => match class {
                    PLACE => 0.55,
                    SURFACE if ears.strict => 0.45,
                    QUANTITY if self.is_size(lexicon) => 0.45,
                    CAUSE if is(wanted, "artist") => 0.5,
                    SURFACE | CAUSE => 0.8,
                    QUANTITY
                        if self.is_value(lexicon)
                            && wanted.iter().all(|&id| is_given(&lexicon.concept(id).name)) =>
                    {
                        0.45
                    }
                    _ if ears.understands(wanted) => 0.9,
                    MATERIAL => 0.5,
                    _ => 0.5,
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
                        && is(wanted, "centre")
                        && is(&about.concepts, "highlight") =>
                {
                    0.6
                }
                Some(about)
                    if class == PLACE && is(wanted, "centre") && is(&about.concepts, "whole") =>
                {
                    0.5
                }
                Some(about)
                    if class == PLACE
                        && is(wanted, "whole")
                        && is(&about.concepts, "highlight") =>
                {
                    0.5
                }
                // "The polished ball has a big one": of two surfaces, whichever place.
                Some(about)
                    if class == PLACE
                        && is(wanted, "highlight")
                        && !self.about[SURFACE].is_empty()
                        && is(&about.concepts, "whole")
                        && (!ears.strict || self.is_size(lexicon)) =>
                {
                    0.8
                }
                Some(about) if class == QUANTITY && about.held < Held::Local => 0.9,
                Some(_) => 0.0,
            };
        }
        score
    }

    /// Whether the phrase says how big something is: of what, must be named.
    fn is_size(&self, lexicon: &Lexicon) -> bool {
        self.anchor
            .first()
            .is_some_and(|&id| matches!(lexicon.concept(id).name.as_str(), "small" | "big"))
    }

    /// Whether the phrase says which value something has.
    fn is_value(&self, lexicon: &Lexicon) -> bool {
        self.anchor.iter().any(|&id| {
            matches!(
                lexicon.concept(id).name.as_str(),
                "zero" | "one" | "quarter" | "rise" | "fall" | "small" | "big"
            )
        })
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
                    () => 0.7,
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
    fn by_words(&self, reading: &Reading) -> BTreeMap<usize, Hit> {
        let mut hits = BTreeMap::new();
        let mut start = 0;
        while start < reading.tokens.len() {
            let (_, end) = sentence_around(reading, start);
            let sentence = reading.sentence[start];
            let score =
                share(&self.words, &reading.forms[start..end]) * self.named_in(reading, sentence);
            let denied = (start..end)
                .any(|i| reading.denied[i] && self.words.contains(&reading.forms[i].stem));
            if score >= PERHAPS && denied == self.denied {
                let range = (reading.tokens[start].start, reading.tokens[end - 1].end);
                let hit = Hit {
                    score,
                    range,
                    own_words: true,
                };
                hits.insert(sentence, hit);
            }
            start = end.max(start + 1);
        }
        hits
    }

    /// Whether a sentence is about the places and surfaces that the words are said of: hardly
    /// known where it names none, and not where it names others.
    fn named_in(&self, reading: &Reading, sentence: usize) -> f64 {
        let mut score = 1.0;
        for class in [PLACE, SURFACE, MATERIAL] {
            if self.about[class].is_empty() {
                continue;
            }
            let mut here = reading
                .statements
                .iter()
                .filter(|s| s.sentence == sentence)
                .filter_map(|s| s.about[class].as_ref())
                .peekable();
            if here.peek().is_none() {
                score *= 0.7;
            } else if !here.any(|it| it.concepts.iter().any(|id| self.about[class].contains(id))) {
                return 0.0;
            }
        }
        score
    }
}

/// The best of several hits.
pub fn highest<'a>(hits: impl Iterator<Item = &'a Hit>) -> Option<Hit> {
    hits.fold(None, |best: Option<Hit>, hit| {
        if best.as_ref().is_none_or(|best| hit.score > best.score) {
            Some(hit.clone())
        } else {
            best
        }
    })
}

fn share(words: &[String], forms: &[Form]) -> f64 {
    let present = words
        .iter()
        .filter(|word| forms.iter().any(|form| form.stem == **word))
        .count();
    present as f64 / words.len() as f64
}

/// Whether a statement is about the spot that one sees, not about a quantity behind it.
fn is_highlight(lexicon: &Lexicon, statement: &Statement, held: Held) -> bool {
    statement.about[PLACE].as_ref().is_some_and(|about| {
        about.held >= held
            && about
                .concepts
                .iter()
                .any(|&id| lexicon.concept(id).name == "highlight")
    })
}

/// Whether the sentence of a statement that names no place names one for something else.
fn elsewhere(lexicon: &Lexicon, reading: &Reading, statement: &Statement) -> bool {
    let low = reading
        .statements
        .partition_point(|s| s.sentence < statement.sentence);
    reading.statements[low..]
        .iter()
        .take_while(|s| s.sentence == statement.sentence)
        .take(24)
        .filter_map(|s| s.about[PLACE].as_ref())
        .flat_map(|about| &about.concepts)
        .any(|&id| matches!(lexicon.concept(id).name.as_str(), "centre" | "rim"))
}

fn without_cause(statement: &Statement) -> [Option<About>; CLASSES] {
    let mut about = statement.about.clone();
    about[CAUSE] = None;
    about
}

/// Quantities that are put in, not what comes out.
pub fn is_given(name: &str) -> bool {
    matches!(
        name,
        "alpha" | "top" | "bottom" | "ndoth" | "ndotl" | "ndotv" | "vdoth" | "product"
    )
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
pub fn quote(reading: &Reading, statement: &Statement) -> (usize, usize) {
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
