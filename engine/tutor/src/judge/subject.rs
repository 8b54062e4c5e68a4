//! Of whom a word is said: "the spread is narrow" claims no spread, and the half-vector that is
//! aligned with the normal says nothing of the facets.

use super::grammar;
use super::lexicon::{Id, Lexicon, PLACE, QUANTITY, Role};
use super::parse::{About, Held, Reading, Statement};
use super::spelling::is_preposition;
use super::text::Kind;

/// Who is in line with something.
#[derive(Clone, Copy, PartialEq)]
enum Subject {
    /// One vector of the question: H, N, their dot product.
    Vector,
    /// Facets or their normals.
    Facets,
    /// Something else, or nobody named.
    Other,
}

impl Reading {
    /// Hears nouns that name a measure, and alignments, for what they are.
    pub fn subjects(&mut self, lexicon: &Lexicon) {
        self.measured();
        self.bounded(lexicon);
        self.only_less();
        self.objects(lexicon);
        self.clamped(lexicon);
        self.sizes();
        self.sums(lexicon);
        self.seeming(lexicon);
        self.shines(lexicon);
        self.measures(lexicon);
        self.alignments(lexicon);
    }

    /// "A couple of pixels wide": how wide, not that it is.
    fn sizes(&mut self) {
        for statement in &mut self.statements {
            let (start, end) = statement.tokens;
            let dimension = end == start + 1
                && matches!(
                    self.tokens[start].word.as_str(),
                    "wide" | "broad" | "large" | "big" | "high" | "tall" | "thick"
                );
            let unit = start.checked_sub(1).is_some_and(|i| {
                matches!(
                    self.tokens[i].word.as_str(),
                    "pixel" | "pixels" | "degree" | "degrees" | "deg" | "mm" | "millimetres" | "cm"
                )
            });
            statement.void |= dimension && unit;
        }
    }

    /// "It looks like the textbook, but": a concession. "There is no pi in it": nothing is in it.
    fn seeming(&mut self, lexicon: &Lexicon) {
        let word = |i: usize| self.tokens.get(i).map_or("", |t| t.word.as_str());
        for index in 0..self.statements.len() {
            let statement = &self.statements[index];
            let start = statement.tokens.0;
            let meant = |s: &Statement, name: &str| {
                s.concepts
                    .iter()
                    .any(|&id| lexicon.concept(id).name == name)
            };
            let seems = (start.saturating_sub(4)..start)
                .any(|i| matches!(word(i), "looks" | "look" | "seems" | "appears" | "sounds"));
            let turns = || {
                (start..(start + 30).min(self.tokens.len()))
                    .take_while(|&i| self.sentence[i] == statement.sentence)
                    .any(|i| matches!(word(i), "but" | "yet" | "however" | "except"))
            };
            let conceded = meant(statement, "correct") && seems && turns();
            let none = index.checked_sub(1).is_some_and(|i| {
                let before = &self.statements[i];
                before.tokens.1 == start
                    && meant(before, "missing")
                    && meant(statement, "contains")
                    && word(start) == "in"
            });
            self.statements[index].void |= conceded || none;
        }
    }

    /// "The integral of D is 1": the sum over all directions has that value, not D.
    fn sums(&mut self, lexicon: &Lexicon) {
        for index in 0..self.statements.len() {
            let statement = &self.statements[index];
            let one = |&id: &Id| lexicon.concept(id).name == "one";
            if !statement.concepts.iter().any(one) {
                continue;
            }
            let (at, clause) = (statement.tokens.0, statement.clause);
            let of_sum = (at.saturating_sub(10)..at).any(|i| {
                self.clause[i] == clause
                    && matches!(
                        self.tokens[i].word.as_str(),
                        "integral"
                            | "integrates"
                            | "integrate"
                            | "integrated"
                            | "∫"
                            | "normalisation"
                            | "normalization"
                            | "normalised"
                            | "normalized"
                            | "sums"
                            | "sum"
                            | "area"
                    )
            });
            self.statements[index].void |= of_sum;
        }
    }

    /// "The glare is broad and faint": the noun names the spot, the words behind say how it is.
    fn shines(&mut self, lexicon: &Lexicon) {
        for index in 0..self.statements.len() {
            let (start, end) = self.statements[index].tokens;
            let names_spot = end == start + 1
                && matches!(
                    self.tokens[start].word.as_str(),
                    "glare" | "glow" | "gleam" | "shimmer" | "blaze" | "sparkle" | "flare"
                );
            let is = self.tokens.get(end).is_some_and(|t| {
                matches!(
                    t.word.as_str(),
                    "is" | "are" | "looks" | "gets" | "becomes" | "stays"
                )
            });
            let determined = (start.saturating_sub(3)..start).any(|i| {
                matches!(
                    self.tokens[i].word.as_str(),
                    "the" | "its" | "this" | "that"
                ) && self.clause[i] == self.clause[start]
            });
            let described = || {
                (index + 1..self.statements.len().min(index + 4))
                    .take_while(|&i| self.statements[i].tokens.0 <= end + 4)
                    .any(|i| {
                        self.statements[i].clause == self.statements[index].clause
                            && self.is_state(lexicon, i)
                    })
            };
            if names_spot && is && determined && described() {
                self.statements[index].void = true;
            }
        }
    }

    /// "5 pixels wide", "a degree across": so much, which may be little.
    fn measured(&mut self) {
        for statement in &mut self.statements {
            let (start, end) = statement.tokens;
            let unit = start > 1
                && matches!(
                    self.tokens[start - 1].word.as_str(),
                    "pixel"
                        | "pixels"
                        | "degree"
                        | "degrees"
                        | "mm"
                        | "millimetre"
                        | "millimetres"
                        | "millimeter"
                        | "millimeters"
                )
                && (self.tokens[start - 2].kind == Kind::Value
                    || matches!(
                        self.tokens[start - 2].word.as_str(),
                        "a" | "one" | "two" | "few" | "three" | "five" | "ten"
                    ));
            let extent = end == start + 1
                && matches!(
                    self.tokens[start].word.as_str(),
                    "wide" | "large" | "big" | "broad" | "high" | "tall"
                );
            statement.void |= unit && extent;
        }
    }

    /// "It can't be more than one", "it never passes 1": a bound is no value.
    fn bounded(&mut self, lexicon: &Lexicon) {
        for statement in &mut self.statements {
            let start = statement.tokens.0;
            let number = statement.concepts.iter().any(|&id| {
                matches!(
                    lexicon.concept(id).name.as_str(),
                    "one" | "zero" | "oneoverpi"
                )
            });
            let bound = start > 0
                && matches!(
                    self.tokens[start - 1].word.as_str(),
                    "than"
                        | "above"
                        | "below"
                        | "under"
                        | "beyond"
                        | "exceed"
                        | "exceeds"
                        | "past"
                        | "surpass"
                        | ">"
                        | "<"
                );
            statement.void |= number && bound;
        }
    }

    /// "The pits eat more light" shines no brighter; "does not prefer any
    /// direction" says nothing of directions.
    fn objects(&mut self, lexicon: &Lexicon) {
        let is = |statement: &Statement, names: &[&str]| {
            statement
                .concepts
                .iter()
                .any(|&id| names.contains(&lexicon.concept(id).name.as_str()))
        };
        for index in 1..self.statements.len() {
            let (before, after) = self.statements.split_at_mut(index);
            let (verb, object) = (&before[index - 1], &mut after[0]);
            if verb.clause != object.clause || object.tokens.0 > verb.tokens.1 + 1 {
                continue;
            }
            let lost = is(verb, &["absorbs", "dim", "fall", "missing"]);
            let light = is(object, &["bright"])
                && (object.tokens.0..object.tokens.1).any(|i| self.tokens[i].is("light"));
            let prefers = is(verb, &["varies"]) && verb.denied && object.denied;
            let direction = is(object, &["spread", "concentrated"])
                && matches!(
                    self.tokens[object.tokens.0].word.as_str(),
                    "any" | "one" | "a" | "single"
                );
            object.void |= lost && light || prefers && direction;
        }
    }

    /// "The centre is brighter too, only less so": less of the same, not little of it. "Less
    /// attenuation": only the other word says something.
    fn only_less(&mut self) {
        for index in 0..self.statements.len() {
            let (start, end) = self.statements[index].tokens;
            let less = end == start + 1 && self.tokens[start].is("less");
            let of_the_same = start > 0
                && matches!(
                    self.tokens[start - 1].word.as_str(),
                    "only" | "just" | "though" | "but" | "if"
                )
                && (self
                    .tokens
                    .get(end)
                    .is_none_or(|t| t.is("so") || t.kind == Kind::Stop)
                    || self.tokens.get(end).is_some_and(|t| t.is("of"))
                        && self.tokens.get(end + 1).is_some_and(|t| t.is("it")));
            let measures = self.statements.get(index + 1).is_some_and(|next| {
                next.tokens.0 == end && next.denied != self.statements[index].denied
            });
            self.statements[index].void |= less && (of_the_same || measures);
        }
    }

    /// "So people clamp it at 0.02": no ceiling of 1.
    fn clamped(&mut self, lexicon: &Lexicon) {
        let Some(capped) = lexicon.id("capped") else {
            return;
        };
        for statement in &mut self.statements {
            let (start, end) = statement.tokens;
            let clamps = statement.concepts.contains(&capped)
                && self.tokens[start].word.starts_with("clamp");
            let to = (end + 6).min(self.tokens.len());
            let number = self.tokens[end..to]
                .iter()
                .take_while(|t| !t.ends_sentence())
                .find(|t| t.kind == Kind::Value);
            let at_one = number.is_some_and(|t| t.is("#1") || t.is("#rough1"));
            // "unless you clamp": what one does against it.
            let does = self.tokens[start].is("clamp")
                && start > 0
                && matches!(
                    self.tokens[start - 1].word.as_str(),
                    "you" | "we" | "i" | "people" | "must" | "to" | "everyone" | "they" | "and"
                );
            statement.void |= clamps && !at_one && (number.is_some() || does);
        }
    }

    /// "The spread is small", "a narrow spread": the noun names what is measured, the other
    /// word says how much of it there is.
    fn measures(&mut self, lexicon: &Lexicon) {
        for index in 0..self.statements.len() {
            let noun = &self.statements[index];
            let (start, end) = noun.tokens;
            let names_measure = end == start + 1
                && matches!(
                    self.tokens[start].word.as_str(),
                    "spread"
                        | "scatter"
                        | "scattering"
                        | "dispersion"
                        | "diffusion"
                        | "blur"
                        | "peak"
                        | "pulse"
                        | "spike"
                        | "bump"
                );
            let opposite = noun
                .concepts
                .first()
                .and_then(|&id| lexicon.concept(id).antonym);
            let Some(opposite) = opposite.filter(|_| names_measure) else {
                continue;
            };
            // "A thin spike" is a spike; "the spike is smeared out" is none.
            let by_contrary =
                matches!(self.tokens[start].word.as_str(), "pulse" | "spike" | "bump");
            let little = |s: &Statement| {
                !s.denied
                    && !s.compared
                    && s.concepts.iter().any(|&id| {
                        id == opposite
                            || !by_contrary
                                && matches!(
                                    lexicon.concept(id).name.as_str(),
                                    "small" | "dim" | "fall" | "low" | "zero"
                                )
                    })
            };
            let before = index
                .checked_sub(1)
                .filter(|&i| self.statements[i].tokens.1 == start)
                .filter(|&i| little(&self.statements[i]));
            let determined = start > 0
                && matches!(
                    self.tokens[start - 1].word.as_str(),
                    "the" | "its" | "their" | "this" | "a" | "that"
                );
            let after = || {
                let next = (index + 1..self.statements.len().min(index + 8))
                    .find(|&i| self.is_state(lexicon, i) && self.statements[i].tokens.0 >= end)?;
                let to = self.statements[next].tokens.0;
                let gap = &self.tokens[end..to];
                let linked = gap.iter().any(|t| grammar::is_copula(&t.word)) || gap.is_empty();
                let near = gap.len() <= 9 && self.sentence[to] == self.sentence[start];
                let plain = gap.iter().all(|t| {
                    matches!(t.kind, Kind::Word | Kind::Value) && !grammar::begins_clause(&t.word)
                });
                (linked && near && plain && little(&self.statements[next])).then_some(next)
            };
            let opens = start == 0 || self.clause[start - 1] != self.clause[start];
            let Some(other) = before.or_else(|| (determined || opens).then(after).flatten()) else {
                continue;
            };
            if !self.statements[other].concepts.contains(&opposite) {
                self.statements[other].void = true;
            }
            let noun = &mut self.statements[index];
            noun.concepts = vec![opposite];
            // The spread is not that of the highlight, unless it says so.
            let own = |about: &About| about.held == Held::Local && about.tokens.0 >= end;
            if !noun.about[PLACE].as_ref().is_some_and(own) {
                noun.about[PLACE] = None;
            }
        }
    }

    /// "H is aligned with the normal" tells how two vectors of the question lie. "All normals
    /// are aligned with H" tells how the facets lie.
    fn alignments(&mut self, lexicon: &Lexicon) {
        let (Some(concentrated), Some(facet)) =
            (lexicon.id("concentrated"), lexicon.id("isfacetnormal"))
        else {
            return;
        };
        let same = lexicon.id("nodifference");
        for index in 0..self.statements.len() {
            let statement = &self.statements[index];
            let aligns = self.tokens[statement.tokens.0..statement.tokens.1]
                .iter()
                .any(|t| {
                    matches!(
                        t.word.as_str(),
                        "align"
                            | "aligned"
                            | "aligns"
                            | "parallel"
                            | "coincide"
                            | "coincides"
                            | "lined"
                            | "lines"
                            | "line"
                            | "direction"
                            | "way"
                            | "orientation"
                            | "along"
                            | "towards"
                            | "equals"
                            | "point"
                            | "points"
                    )
                });
            let meant = |id: Id| statement.concepts.contains(&id);
            // "H equals V": two directions of the question, not two pictures.
            let equals = same.is_some_and(meant)
                && self.tokens[statement.tokens.0].word.starts_with("equal");
            let number = (statement.tokens.1..statement.tokens.1 + 2)
                .any(|i| self.tokens.get(i).is_some_and(|t| t.kind == Kind::Value));
            if equals && number {
                self.statements[index].void = true;
                continue;
            }
            if same.is_some_and(meant) && self.tokens[statement.tokens.0].word.starts_with("equal")
            {
                let clause = statement.clause;
                let here = |names: &[&str]| {
                    let from = self.clause.partition_point(|&c| c < clause);
                    let to = self.clause.partition_point(|&c| c <= clause).min(from + 40);
                    self.tokens[from..to]
                        .iter()
                        .any(|t| names.contains(&t.word.as_str()))
                };
                if here(&["h"]) && here(&["v", "l"]) && !here(&["n", "#n.v", "#v.h"]) {
                    self.statements[index].void = true;
                    continue;
                }
            }
            if !aligns || !(meant(concentrated) || meant(facet)) {
                continue;
            }
            match self.subject_of(lexicon, index) {
                (Subject::Vector, _) if meant(concentrated) => {
                    self.statements[index].void = true;
                }
                (Subject::Facets, true) if !meant(concentrated) => {
                    self.statements[index].concepts.push(concentrated);
                }
                _ => {}
            }
        }
    }

    /// The last one named before a statement that no preposition governs, in its clause or,
    /// where that opens with "which" or "that", the one before; and whether all of them.
    fn subject_of(&self, lexicon: &Lexicon, index: usize) -> (Subject, bool) {
        let (at, clause) = (
            self.statements[index].tokens.0,
            self.statements[index].clause,
        );
        let first = self.clause.partition_point(|&c| c < clause);
        let relative = matches!(self.tokens[first].word.as_str(), "which" | "that" | ",")
            && self.tokens[first..at]
                .iter()
                .all(|t| !matches!(t.word.as_str(), "facets" | "normals"));
        let all = self.tokens[first..at]
            .iter()
            .any(|t| matches!(t.word.as_str(), "all" | "every" | "each"));
        let mut facets_named = false;
        let mut vector = false;
        for statement in self.statements[..index].iter().rev().take(12) {
            let here = statement.clause == clause
                || relative
                    && statement.clause + 2 >= clause
                    && statement.sentence == self.sentence[at];
            if !here {
                break;
            }
            let start = statement.tokens.0;
            let governed = (start.saturating_sub(2)..start).any(|i| {
                is_preposition(&self.tokens[i].word)
                    && !self.tokens[i].is("for")
                    && self.clause[i] == self.clause[start]
            });
            let is = |name: &str| {
                statement
                    .concepts
                    .iter()
                    .any(|&id| lexicon.concept(id).name == name)
            };
            let lone_normal = statement.tokens.1 == start + 1
                && self.tokens[start].is("normal")
                && !(start > 0
                    && matches!(
                        self.tokens[start - 1].word.as_str(),
                        "all" | "every" | "each"
                    ));
            facets_named |= is("facets") || (is("normals") && !lone_normal) || is("isfacetnormal");
            let quantity = statement
                .concepts
                .iter()
                .any(|&id| lexicon.concept(id).role == Role::Entity(QUANTITY));
            if governed {
                continue;
            }
            let direction = statement.tokens.1 == start + 1
                && matches!(
                    self.tokens[start].word.as_str(),
                    "v" | "l" | "view" | "viewer"
                );
            if direction || is("halfvector") || is("surfacenormal") || is("ndoth") || lone_normal {
                vector = true;
            } else if quantity && !vector {
                return (Subject::Other, all);
            }
        }
        match (facets_named, vector) {
            (true, _) => (Subject::Facets, all),
            (false, true) => (Subject::Vector, all),
            _ => (Subject::Other, all),
        }
    }

    fn is_state(&self, lexicon: &Lexicon, index: usize) -> bool {
        self.statements[index]
            .concepts
            .iter()
            .any(|&id| lexicon.concept(id).role == Role::State)
    }
}
