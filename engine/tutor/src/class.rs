//! A class's logs: the explanations in them, which of them need a teacher's eye, and what
//! today's judge makes of those that another judge decided.

use std::collections::BTreeMap;

use crate::judge::evaluate::Marked;
use crate::judge::{Judge, Judgement};
use crate::record::Record;
use crate::session::{Event, Quote};

/// One explanation of one learner, with what was made of it then.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// Id of the question.
    pub item: String,
    /// 1, or 2 for the second try.
    pub attempt: u32,
    /// When it was handed in, RFC 3339.
    pub at: String,
    /// The answer.
    pub text: String,
    /// What the tutor asked back, and what the learner replied.
    pub replies: Vec<(String, String)>,
    /// Which judge decided.
    pub judge: String,
    /// What the judge said of the answer: `pass`, `partial`, `fail` or `unsure`.
    pub verdict: String,
    /// What stood after the replies and a second opinion.
    pub stands: String,
    /// Expectations met.
    pub met: Vec<String>,
    /// Misconceptions shown.
    pub misconceptions: Vec<String>,
    /// Criteria that it left open.
    pub unsure: Vec<String>,
    /// The words that decided.
    pub why: Vec<Quote>,
    /// The verdict that follows from the learner's own marks on the checklist.
    pub self_marked: Option<String>,
    /// Criteria on which a second opinion said otherwise.
    pub disputed: Vec<String>,
}

/// Why a teacher should look at an explanation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// A second opinion differs from the judge's.
    Disputed,
    /// The judge could not tell, and nothing settled it.
    Unsure,
    /// The judge could not tell, and the learner marked it himself.
    SelfMarked,
    /// Today's judge gives another verdict than the learner was told.
    Changed,
    /// Nothing is open; every answer was asked for.
    Asked,
}

impl Reason {
    /// The word of JSON and filters.
    pub fn as_str(self) -> &'static str {
        match self {
            Reason::Disputed => "disputed",
            Reason::Unsure => "unsure",
            Reason::SelfMarked => "self-marked",
            Reason::Changed => "changed",
            Reason::Asked => "asked",
        }
    }

    /// The reason as a sentence for the teacher.
    pub fn sentence(self) -> &'static str {
        match self {
            Reason::Disputed => "A second opinion differs.",
            Reason::Unsure => "The judge could not tell.",
            Reason::SelfMarked => "The judge could not tell; the learner marked it himself.",
            Reason::Changed => "Today's judge gives another verdict than the learner was told.",
            Reason::Asked => "Nothing is open here.",
        }
    }
}

/// The explanations of a session, oldest first.
pub fn explanations(record: &Record) -> Vec<Explanation> {
    let mut out: Vec<Explanation> = Vec::new();
    let mut at: BTreeMap<(String, u32), usize> = BTreeMap::new();
    for entry in &record.entries {
        match &entry.event {
            Event::Explained {
                item,
                attempt,
                text,
                verdict,
                met,
                misconceptions,
                unsure,
                judge,
                why,
                ..
            } => {
                // A lesson that changed may ask the same try again: each stands for itself.
                at.insert((item.clone(), *attempt), out.len());
                out.push(Explanation {
                    item: item.clone(),
                    attempt: *attempt,
                    at: entry.at.clone(),
                    text: text.clone(),
                    replies: Vec::new(),
                    judge: judge.clone(),
                    verdict: verdict.clone(),
                    stands: verdict.clone(),
                    met: met.clone(),
                    misconceptions: misconceptions.clone(),
                    unsure: unsure.clone(),
                    why: why.clone(),
                    self_marked: None,
                    disputed: Vec::new(),
                });
            }
            Event::SelfMarked {
                item,
                attempt,
                verdict,
                ..
            } => {
                if let Some(&place) = at.get(&(item.clone(), *attempt)) {
                    out[place].self_marked = Some(verdict.clone());
                }
            }
            Event::Replied {
                item,
                attempt,
                asked,
                text,
                verdict,
                ..
            } => {
                if let Some(&place) = at.get(&(item.clone(), *attempt)) {
                    out[place].replies.push((asked.clone(), text.clone()));
                    out[place].stands = verdict.clone();
                }
            }
            Event::SecondOpinion {
                item,
                attempt,
                reply,
                disputed,
                verdict,
                ..
            } => {
                if let Some(&place) = at.get(&(item.clone(), *attempt)) {
                    let out = &mut out[place];
                    let new = disputed.iter().filter(|id| !out.disputed.contains(id));
                    let new: Vec<String> = new.cloned().collect();
                    out.disputed.extend(new);
                    // What was said since is judged by itself.
                    if *reply as usize == out.replies.len() {
                        out.stands = verdict.clone();
                    }
                }
            }
            _ => {}
        }
    }
    out
}

impl Explanation {
    /// The verdict that the learner was told last.
    pub fn told(&self) -> &str {
        self.self_marked.as_deref().unwrap_or(&self.stands)
    }

    /// Answer and replies as one text, a paragraph each: no sentence runs from one into another.
    pub fn whole(&self) -> String {
        let mut whole = self.text.clone();
        for (_, reply) in &self.replies {
            whole.push_str("\n\n");
            whole.push_str(reply);
        }
        whole
    }

    /// Why a teacher should look at it, given what today's judge says of the answer alone;
    /// `None` where nothing is open.
    pub fn open_because(&self, today: &Judgement) -> Option<Reason> {
        if !self.disputed.is_empty() {
            Some(Reason::Disputed)
        } else if self.self_marked.is_some() {
            Some(Reason::SelfMarked)
        } else if self.stands == "unsure" {
            Some(Reason::Unsure)
        } else if self.verdict != "unsure" && self.verdict != today.verdict.as_str() {
            Some(Reason::Changed)
        } else {
            None
        }
    }

    /// The name under which its mark is kept: the log's name, the question, the try.
    pub fn mark_id(&self, log: &str) -> String {
        format!("{log}#{}#{}#{}", self.item, self.attempt, self.at)
    }
}

/// A verdict that another judge gave, and today's.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// What the log says.
    pub was: String,
    /// What today's judge says.
    pub now: Judgement,
    /// Criteria heard now and not then, `+`, or then and not now, `-`.
    pub differs: Vec<(char, String)>,
}

/// Judges an explanation again; `None` where the verdict is the same.
pub fn regrade(judge: &Judge, explanation: &Explanation) -> Option<Change> {
    let now = judge.judge(&explanation.text);
    if now.verdict.as_str() == explanation.verdict {
        return None;
    }
    let lists = [
        (&explanation.met, &now.met),
        (&explanation.misconceptions, &now.misconceptions),
    ];
    let mut differs = Vec::new();
    for (then, now) in lists {
        let new = now.iter().filter(|id| !then.contains(id));
        let gone = then.iter().filter(|id| !now.contains(id));
        differs.extend(new.map(|id| ('+', id.clone())));
        differs.extend(gone.map(|id| ('-', id.clone())));
    }
    Some(Change {
        was: explanation.verdict.clone(),
        now,
        differs,
    })
}

/// The mark of an explanation among a teacher's marks.
pub fn mark_of<'a>(marks: &'a [Marked], id: &str) -> Option<&'a Marked> {
    marks.iter().find(|mark| mark.id == id)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::session::Start;

    fn explained(item: &str, attempt: u32, text: &str, verdict: &str) -> Event {
        Event::Explained {
            item: item.into(),
            attempt,
            text: text.into(),
            verdict: verdict.into(),
            met: Vec::new(),
            missed: Vec::new(),
            misconceptions: Vec::new(),
            slips: Vec::new(),
            unsure: Vec::new(),
            judge: "1".into(),
            why: Vec::new(),
        }
    }

    fn self_marked(item: &str, attempt: u32, verdict: &str) -> Event {
        Event::SelfMarked {
            item: item.into(),
            attempt,
            verdict: verdict.into(),
            met: Vec::new(),
            missed: Vec::new(),
            misconceptions: Vec::new(),
            slips: Vec::new(),
        }
    }

    fn replied(item: &str, text: &str, verdict: &str) -> Event {
        Event::Replied {
            item: item.into(),
            attempt: 1,
            about: "wrong-shape".into(),
            rung: crate::session::Rung::Ask,
            asked: "Where?".into(),
            text: text.into(),
            verdict: verdict.into(),
            met: Vec::new(),
            missed: Vec::new(),
            misconceptions: Vec::new(),
            slips: Vec::new(),
            unsure: Vec::new(),
            judge: "1".into(),
            why: Vec::new(),
        }
    }

    fn disputed(item: &str, verdict: &str) -> Event {
        Event::SecondOpinion {
            item: item.into(),
            attempt: 1,
            reply: 0,
            by: "a colleague".into(),
            result: "disputes".into(),
            problem: None,
            own_verdict: Some("pass".into()),
            says: BTreeMap::new(),
            why: Vec::new(),
            disputed: vec!["wrong-shape".into()],
            settled: Vec::new(),
            verdict: verdict.into(),
            met: Vec::new(),
            missed: Vec::new(),
            misconceptions: Vec::new(),
            slips: Vec::new(),
            unsure: Vec::new(),
        }
    }

    #[test]
    fn replies_belong_to_the_answer() {
        let item = "smith-g2/explain-3";
        let all = explanations(&record(vec![
            explained(item, 1, "No idea.", "unsure"),
            replied(item, "The rim is bright.", "pass"),
        ]));
        assert_eq!(all.len(), 1);
        assert_eq!(all[0].whole(), "No idea.\n\nThe rim is bright.");
        assert_eq!((all[0].verdict.as_str(), all[0].told()), ("unsure", "pass"));
    }

    fn record(events: Vec<Event>) -> Record {
        let start = Start {
            seed: 1,
            slips: Vec::new(),
        };
        let mut record = Record::new("0", "smith-g2", "hash", "2026-01-02T03:04:05Z", &start);
        for (second, event) in events.into_iter().enumerate() {
            record.push(&format!("2026-01-02T03:04:{second:02}Z"), 1, event);
        }
        record
    }

    fn judge() -> Judge {
        let (lesson, _) = crate::load("", include_str!("../../../lessons/02-smith-g2.toml"));
        let lesson = lesson.expect("a lesson");
        Judge::new(&lesson.explain("smith-g2/explain-3").expect("asked").rubric)
    }

    #[track_caller]
    fn check(events: Vec<Event>, told: &str, reason: Option<Reason>) {
        let all = explanations(&record(events));
        let explanation = &all[0];
        let today = judge().judge(&explanation.text);
        assert_eq!(explanation.told(), told);
        assert_eq!(explanation.open_because(&today), reason);
    }

    #[test]
    fn what_a_teacher_should_look_at() {
        let item = "smith-g2/explain-3";
        let no_idea = |verdict| explained(item, 1, "No idea.", verdict);
        check(vec![no_idea("fail")], "fail", None);
        check(vec![no_idea("unsure")], "unsure", Some(Reason::Unsure));
        check(vec![no_idea("pass")], "pass", Some(Reason::Changed));
        check(
            vec![no_idea("unsure"), self_marked(item, 1, "pass")],
            "pass",
            Some(Reason::SelfMarked),
        );
        check(
            vec![
                no_idea("unsure"),
                replied(item, "The rim is bright.", "pass"),
            ],
            "pass",
            None,
        );
        check(
            vec![no_idea("fail"), disputed(item, "fail")],
            "fail",
            Some(Reason::Disputed),
        );
        // A mark of another try settles nothing here.
        check(
            vec![no_idea("unsure"), self_marked(item, 2, "pass")],
            "unsure",
            Some(Reason::Unsure),
        );
    }

    #[test]
    fn a_verdict_that_changed_says_what_differs() {
        let mut event = explained("smith-g2/explain-3", 1, "No idea.", "pass");
        if let Event::Explained { met, .. } = &mut event {
            met.push("wrong-shape".into());
        }
        let all = explanations(&record(vec![event]));
        let change = regrade(&judge(), &all[0]).expect("it changed");
        assert_eq!(change.was, "pass");
        assert_eq!(change.now.verdict.as_str(), "fail");
        assert_eq!(change.differs, [('-', "wrong-shape".to_owned())]);
        let same = explanations(&record(vec![explained(
            "smith-g2/explain-3",
            1,
            "No idea.",
            "fail",
        )]));
        assert_eq!(regrade(&judge(), &same[0]), None);
    }
}
