//! A teacher goes through answers and marks them, one key an answer: a pure state machine, as
//! the session is.

use crate::class::{Explanation, Reason};
use crate::judge::evaluate::Marked;
use crate::judge::{Judgement, Verdict, verdict};
use crate::rubric::{Example, Rubric};

/// An answer that waits for a mark.
#[derive(Clone, Debug)]
pub struct Waiting {
    /// Name of the mark.
    pub id: String,
    /// Who wrote it.
    pub learner: String,
    /// The answer.
    pub explanation: Explanation,
    /// Why it is here.
    pub reason: Reason,
    /// The rubric of its question.
    pub rubric: Rubric,
    /// What today's judge hears in answer and replies.
    pub today: Judgement,
}

/// What the teacher says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// The verdict. The points follow: whatever the judge heard stays, what it left open is
    /// settled so that the verdict comes out.
    Verdict(Verdict),
    /// A point is there, or is not: the one at this position, from 0.
    Turn(usize),
    /// The verdict that follows from the points as they stand.
    Accept,
    /// Not now.
    Later,
    /// Back to the answer before; its mark is taken back.
    Back,
}

/// What is to be kept.
#[must_use]
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Keep this mark.
    Keep(Marked),
    /// Forget the mark of that name.
    Forget(String),
}

/// A point of the rubric on the sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Id of the criterion.
    pub id: String,
    /// The thing itself, as a sentence.
    pub says: String,
    /// Whether it is a misconception.
    pub is_misconception: bool,
    /// Whether a pass needs it, or it keeps from passing.
    pub weighs: bool,
    /// Whether the answer says it; `None` where the judge cannot tell and the teacher has not
    /// said.
    pub said: Option<bool>,
    /// The words that today's judge heard.
    pub quote: Option<(usize, usize)>,
}

/// Going through a list of answers.
#[derive(Clone, Debug)]
pub struct Review {
    waiting: Vec<Waiting>,
    at: usize,
    points: Vec<Point>,
    /// Whether the teacher turned a point of the answer on the sheet.
    turned: bool,
    marked: usize,
    /// By answer: whether it was marked now.
    done: Vec<bool>,
    /// What the teacher should know, for one key long.
    said: Option<String>,
}

impl Review {
    /// Begins with the first.
    pub fn new(waiting: Vec<Waiting>) -> Review {
        let mut review = Review {
            done: vec![false; waiting.len()],
            waiting,
            at: 0,
            points: Vec::new(),
            turned: false,
            marked: 0,
            said: None,
        };
        review.lay_out();
        review
    }

    /// The answer on the sheet; `None` past the last.
    pub fn current(&self) -> Option<&Waiting> {
        self.waiting.get(self.at)
    }

    /// Position of the answer on the sheet, from 0, and how many there are.
    pub fn place(&self) -> (usize, usize) {
        (self.at, self.waiting.len())
    }

    /// How many were marked.
    pub fn marked(&self) -> usize {
        self.marked
    }

    /// The points of the sheet, expectations first.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// What the last key came to, where that needs saying.
    pub fn said(&self) -> Option<&str> {
        self.said.as_deref()
    }

    /// The verdict that follows from the points as they stand.
    pub fn follows(&self) -> Verdict {
        match self.current() {
            Some(waiting) => follows(&waiting.rubric, &self.points),
            None => Verdict::Unsure,
        }
    }

    /// One key.
    pub fn press(&mut self, key: Key) -> Option<Effect> {
        self.said = None;
        match key {
            Key::Back => return self.back(),
            Key::Later => self.go_to(self.at + 1),
            Key::Turn(place) => {
                if let Some(point) = self.points.get_mut(place) {
                    point.said = Some(point.said != Some(true));
                    self.turned = true;
                }
            }
            Key::Accept => match self.follows() {
                Verdict::Unsure => {
                    self.said = Some(
                        "A point is still open: press its number, or p, a or f for the verdict."
                            .to_owned(),
                    );
                }
                _ => return self.keep(self.points.clone(), self.follows()),
            },
            Key::Verdict(wanted) => {
                let points = self.settled(wanted);
                let comes_out = self
                    .current()
                    .map(|waiting| follows(&waiting.rubric, &points));
                if comes_out == Some(wanted) {
                    return self.keep(points, wanted);
                }
                self.said = self.current().map(|_| why_not(wanted));
            }
        }
        None
    }

    /// The points, so that the verdict comes out where that is possible without a guess.
    fn settled(&self, wanted: Verdict) -> Vec<Point> {
        let mut points = self.points.clone();
        for point in &mut points {
            let open = point.said.is_none();
            let free = open || !self.turned;
            match (wanted, point.is_misconception) {
                (Verdict::Pass, false) if point.weighs && free => point.said = Some(true),
                (Verdict::Pass, true) if point.weighs && free => point.said = Some(false),
                (Verdict::Fail, false) if point.weighs && free => point.said = Some(false),
                _ if open => point.said = Some(false),
                _ => {}
            }
        }
        points
    }

    fn keep(&mut self, points: Vec<Point>, verdict: Verdict) -> Option<Effect> {
        let waiting = self.waiting.get(self.at)?;
        let said = |is_misconception: bool| -> Vec<String> {
            points
                .iter()
                .filter(|p| p.is_misconception == is_misconception && p.said == Some(true))
                .map(|p| p.id.clone())
                .collect()
        };
        let marked = Marked {
            id: waiting.id.clone(),
            item: waiting.rubric.item.clone(),
            writer: waiting.learner.clone(),
            text: waiting.explanation.whole(),
            met: Some(said(false)),
            misconceptions: Some(said(true)),
            verdict: verdict.as_str().to_owned(),
            disputed: Vec::new(),
            adversarial: false,
        };
        self.marked += usize::from(!self.done[self.at]);
        self.done[self.at] = true;
        self.go_to(self.at + 1);
        Some(Effect::Keep(marked))
    }

    fn back(&mut self) -> Option<Effect> {
        if self.at == 0 {
            self.said = Some("This is the first.".to_owned());
            return None;
        }
        self.go_to(self.at - 1);
        if !std::mem::take(&mut self.done[self.at]) {
            return None;
        }
        self.marked -= 1;
        Some(Effect::Forget(self.waiting[self.at].id.clone()))
    }

    fn go_to(&mut self, at: usize) {
        self.at = at.min(self.waiting.len());
        self.turned = false;
        self.lay_out();
    }

    fn lay_out(&mut self) {
        self.points = self.current().map(points).unwrap_or_default();
    }
}

fn points(waiting: &Waiting) -> Vec<Point> {
    let (rubric, today) = (&waiting.rubric, &waiting.today);
    let point = |id: &String, says: &String, is_misconception, weighs| {
        let heard = match is_misconception {
            true => &today.misconceptions,
            false => &today.met,
        };
        let quote = today.why.iter().find(|why| why.id == *id);
        Point {
            id: id.clone(),
            says: says.clone(),
            is_misconception,
            weighs,
            said: (!today.unsure.contains(id)).then(|| heard.contains(id)),
            quote: quote.map(|why| (why.start, why.end)),
        }
    };
    let expectations = rubric.expectation.iter();
    let misconceptions = rubric.misconception.iter();
    expectations
        .map(|e| point(&e.id, &e.says, false, e.required))
        .chain(misconceptions.map(|m| point(&m.id, &m.says, true, m.blocking)))
        .collect()
}

fn follows(rubric: &Rubric, points: &[Point]) -> Verdict {
    let ids = |is_misconception: Option<bool>, said: Option<bool>| -> Vec<String> {
        points
            .iter()
            .filter(|p| is_misconception.is_none_or(|it| it == p.is_misconception))
            .filter(|p| p.said == said)
            .map(|p| p.id.clone())
            .collect()
    };
    let (yes, open) = (Some(true), None);
    verdict(
        rubric,
        &ids(Some(false), yes),
        &ids(Some(true), yes),
        &ids(None, open),
    )
}

fn why_not(wanted: Verdict) -> String {
    match wanted {
        Verdict::Pass => "With these points it is no pass: turn what keeps it from passing, then Enter.",
        Verdict::Partial => {
            "Partial, but which point is missing? Press the numbers of what it says or gets wrong, then Enter."
        }
        Verdict::Fail => "With these points it is no fail: turn off what it does not say, then Enter.",
        Verdict::Unsure => "A mark is pass, partial or fail.",
    }
    .to_owned()
}

/// A mark as an example of the lesson file.
pub fn example(mark: &Marked) -> Example {
    Example {
        text: mark.text.clone(),
        verdict: mark.verdict.clone(),
        met: mark.met.clone(),
        misconceptions: mark.misconceptions.clone(),
    }
}

/// An example as it stands in a lesson file.
pub fn example_toml(example: &Example) -> String {
    let body = toml::to_string(example).unwrap_or_default();
    format!("\n[[explain.example]]\n{body}")
}

/// A lesson file with examples added to one of its questions; everything else stays as it is,
/// byte for byte.
///
/// # Errors
///
/// A sentence for the author where the file cannot take them.
pub fn with_examples(text: &str, item: &str, examples: &[Example]) -> Result<String, String> {
    let before = rubric_in(text, item).ok_or_else(|| format!("it does not ask {item}"))?;
    let new: Vec<&Example> = examples
        .iter()
        .filter(|e| !before.example.iter().any(|old| old.text == e.text))
        .collect();
    if new.is_empty() {
        return Ok(text.to_owned());
    }
    let end = end_of_question(text, item).ok_or_else(|| format!("it does not ask {item}"))?;
    let mut changed = text[..end].to_owned();
    if !changed.ends_with('\n') {
        changed.push('\n');
    }
    for example in &new {
        changed.push_str(&example_toml(example));
    }
    changed.push_str(&text[end..]);
    // A file of another shape (examples in one line) would not read back as the same lesson.
    let mut wanted = before;
    wanted.example.extend(new.into_iter().cloned());
    match rubric_in(&changed, item) {
        Some(rubric) if rubric == wanted => Ok(changed),
        _ => Err(format!(
            "examples cannot be added to {item} by machine: write them as [[explain.example]] below it"
        )),
    }
}

fn rubric_in(text: &str, item: &str) -> Option<Rubric> {
    let lesson = crate::load("", text).0?;
    lesson.explain(item).map(|explain| explain.rubric.clone())
}

/// One past the line on which the last value of a question ends.
fn end_of_question(text: &str, item: &str) -> Option<usize> {
    use toml::de::{DeTable, DeValue};

    fn last(value: &toml::Spanned<DeValue<'_>>) -> usize {
        match value.get_ref() {
            DeValue::Table(table) => last_of(table),
            DeValue::Array(all) if all.iter().any(|it| it.get_ref().is_table()) => {
                all.iter().map(last).max().unwrap_or(0)
            }
            _ => value.span().end,
        }
    }
    fn last_of(table: &DeTable<'_>) -> usize {
        table.values().map(last).max().unwrap_or(0)
    }
    let doc = DeTable::parse(text).ok()?;
    let questions = doc.get_ref().get("explain")?.get_ref().as_array()?;
    let question = questions.iter().find(|question| {
        let id = question
            .get_ref()
            .as_table()
            .and_then(|table| table.get("id"));
        id.and_then(|id| id.get_ref().as_str()) == Some(item)
    })?;
    let end = last(question);
    Some(
        text[end..]
            .find('\n')
            .map_or(text.len(), |line| end + line + 1),
    )
}

#[cfg(test)]
mod tests;
