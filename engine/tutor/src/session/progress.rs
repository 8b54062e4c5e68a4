//! What many logs say together: how each lesson stands, what is due, which slips were noted.
//!
//! Pure: today comes in as a date.

use super::event::{Event, Grade, NotedSlip};
use crate::record::Record;
use crate::view::Stage;
use std::collections::BTreeMap;

/// How a lesson stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LessonState {
    /// No log of it.
    New,
    /// Begun; the session can be resumed.
    InProgress {
        /// Where it was left.
        stage: Stage,
    },
    /// Passed.
    Passed {
        /// By judge, or in part by the learner.
        grade: Grade,
        /// "PASS on retry, after the histogram re-teach".
        words: String,
    },
    /// Taken to the end, and not passed.
    NotYet {
        /// What is open.
        words: String,
    },
}

impl LessonState {
    /// In a few words, for a list.
    pub fn words(&self) -> String {
        match self {
            LessonState::New => "new".to_owned(),
            LessonState::InProgress { stage } => format!("in progress: {}", stage.phrase()),
            LessonState::Passed { words, .. } | LessonState::NotYet { words } => words.clone(),
        }
    }
}

/// A lesson in the list.
#[derive(Clone, Debug, PartialEq)]
pub struct LessonSummary {
    /// Its id.
    pub lesson: String,
    /// How it stands, by the latest log that says something.
    pub state: LessonState,
    /// Logs of it.
    pub sessions: usize,
    /// Answers given in all of them, invalid input left out.
    pub answers: usize,
    /// Items due today or before, most overdue first.
    pub due: Vec<DueItem>,
    /// Slips noted, each once.
    pub slips: Vec<NotedSlip>,
}

/// An item that is worth asking again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DueItem {
    /// Its id.
    pub item: String,
    /// Days since it became due; 0 is today.
    pub overdue: i64,
}

/// Sums up one lesson. `records` may hold other lessons' logs too, in any order; `today` is a
/// date, `2026-11-22`, or starts with one. A date that cannot be read makes nothing due.
pub fn summary(lesson: &str, records: &[Record], today: &str) -> LessonSummary {
    let mut own: Vec<&Record> = records
        .iter()
        .filter(|record| record.header.lesson == lesson)
        .collect();
    own.sort_by(|a, b| last_time(a).cmp(last_time(b)));
    LessonSummary {
        lesson: lesson.to_owned(),
        state: own
            .iter()
            .rev()
            .filter(|record| due_items(record).is_none())
            .map(|record| state(record))
            .find(|state| *state != LessonState::New)
            .unwrap_or(LessonState::New),
        sessions: own.len(),
        answers: own.iter().map(|record| answers(record)).sum(),
        due: due(&own, today),
        slips: slips_of(own.iter().copied()),
    }
}

/// Slips noted in other lessons than `lesson`, each once: what a session of it begins with.
pub fn noted_slips(lesson: &str, records: &[Record]) -> Vec<NotedSlip> {
    slips_of(records.iter().filter(|r| r.header.lesson != lesson))
}

/// The latest log of a lesson that was not taken to its end, by position.
pub fn unfinished(lesson: &str, records: &[Record]) -> Option<usize> {
    let mut own: Vec<usize> = (0..records.len())
        .filter(|at| records[*at].header.lesson == lesson)
        .filter(|at| due_items(&records[*at]).is_none())
        .collect();
    own.sort_by(|a, b| last_time(&records[*a]).cmp(last_time(&records[*b])));
    let latest = own.pop()?;
    matches!(state(&records[latest]), LessonState::InProgress { .. }).then_some(latest)
}

/// The items that a log's session asked because they were due; `None` where it taught the lesson.
pub fn due_items(record: &Record) -> Option<&[String]> {
    let mut events = record.entries.iter().map(|entry| &entry.event);
    events.find_map(|event| match event {
        Event::DueAgain { items } => Some(items.as_slice()),
        _ => None,
    })
}

/// The latest log that asked due items of a lesson and was left, by position, where what it did
/// not come to is still `due`.
pub fn unfinished_due(lesson: &str, records: &[Record], due: &[String]) -> Option<usize> {
    let own = (0..records.len()).filter(|at| records[*at].header.lesson == lesson);
    let latest = own
        .filter(|at| due_items(&records[*at]).is_some())
        .max_by(|a, b| last_time(&records[*a]).cmp(last_time(&records[*b])))?;
    let record = &records[latest];
    let looked = record_looks(record);
    let mut left = due_items(record)?
        .iter()
        .filter(|item| !looked.iter().any(|(other, _)| other == item));
    let goes_on = matches!(state(record), LessonState::InProgress { .. });
    (goes_on && left.all(|item| due.contains(item))).then_some(latest)
}

/// The items to ask first, by lesson in the order given: of all that is due the `most` that have
/// waited longest.
pub fn ask_first(due: &[(&str, &[DueItem])], most: usize) -> Vec<(String, Vec<String>)> {
    let all = due.iter().flat_map(|(_, items)| items.iter());
    let mut waits: Vec<i64> = all.map(|item| item.overdue).collect();
    waits.sort_unstable_by(|a, b| b.cmp(a));
    let mut left = most;
    // As many of those that waited as long as the last one as there is room for.
    let Some(least) = waits.get(most.saturating_sub(1)).or(waits.last()).copied() else {
        return Vec::new();
    };
    let mut asked: Vec<(String, Vec<String>)> = due
        .iter()
        .map(|(lesson, _)| ((*lesson).to_owned(), Vec::new()))
        .collect();
    for is_longer in [true, false] {
        for ((_, asked), (_, items)) in asked.iter_mut().zip(due) {
            let wanted = items.iter().filter(|item| match is_longer {
                true => item.overdue > least,
                false => item.overdue == least,
            });
            for item in wanted.take(left) {
                asked.push(item.item.clone());
                left -= 1;
            }
        }
    }
    asked.retain(|(_, items)| !items.is_empty());
    asked
}

/// How the session of a log stands.
pub fn state(record: &Record) -> LessonState {
    let mut state = LessonState::New;
    for entry in &record.entries {
        match &entry.event {
            Event::Finished { grade, words } => {
                let words = words.clone();
                state = match grade {
                    Grade::Pass | Grade::SelfMarked => LessonState::Passed {
                        grade: *grade,
                        words,
                    },
                    Grade::NotYet => LessonState::NotYet { words },
                };
            }
            // Looking back after the end leaves the lesson at its end.
            _ if matches!(
                state,
                LessonState::Passed { .. } | LessonState::NotYet { .. }
            ) && !matches!(entry.event, Event::LessonChanged { .. }) => {}
            Event::Next { stage, .. }
            | Event::Back { stage, .. }
            | Event::LessonChanged { stage, .. } => {
                state = LessonState::InProgress { stage: *stage };
            }
            _ => {
                if state == LessonState::New {
                    state = LessonState::InProgress { stage: Stage::Why };
                }
            }
        }
    }
    state
}

fn last_time(record: &Record) -> &str {
    let last = record.entries.last().map(|entry| entry.at.as_str());
    last.unwrap_or(&record.header.started)
}

fn answers(record: &Record) -> usize {
    let counts = |event: &Event| match event {
        Event::Attempt { result, .. } => result != "invalid",
        Event::Explained { .. } | Event::Replied { .. } => true,
        _ => false,
    };
    let events = record.entries.iter().map(|entry| &entry.event);
    events.filter(|event| counts(event)).count()
}

fn slips_of<'a>(records: impl Iterator<Item = &'a Record>) -> Vec<NotedSlip> {
    let mut all: Vec<NotedSlip> = Vec::new();
    for record in records {
        for entry in &record.entries {
            let slips = match &entry.event {
                Event::Explained { slips, .. }
                | Event::Replied { slips, .. }
                | Event::SelfMarked { slips, .. } => slips.iter(),
                Event::Attempt {
                    mistake: Some(mistake),
                    named: true,
                    ..
                } => std::slice::from_ref(mistake).iter(),
                _ => continue,
            };
            for id in slips {
                let slip = NotedSlip {
                    id: id.clone(),
                    lesson: record.header.lesson.clone(),
                };
                if !all.contains(&slip) {
                    all.push(slip);
                }
            }
        }
    }
    all
}

/// One look at an item: the day, and whether it was right at once.
struct Look {
    day: i64,
    right: bool,
}

/// Days until the next look after so many right ones in a row. A rule of thumb: each success
/// a little more than doubles the wait, a miss starts again.
const WAITS: [i64; 6] = [1, 3, 7, 16, 35, 80];

fn due(records: &[&Record], today: &str) -> Vec<DueItem> {
    let Some(today) = day_number(today) else {
        return Vec::new();
    };
    let mut looks: BTreeMap<&str, Vec<Look>> = BTreeMap::new();
    for record in records {
        for (item, look) in record_looks(record) {
            looks.entry(item).or_default().push(look);
        }
    }
    let mut due: Vec<DueItem> = looks
        .iter()
        .filter_map(|(item, looks)| {
            let last = looks.last()?;
            let streak = looks.iter().rev().take_while(|look| look.right).count();
            let next = last.day + WAITS[streak.min(WAITS.len() - 1)];
            (next <= today).then(|| DueItem {
                item: (*item).to_owned(),
                overdue: today - next,
            })
        })
        .collect();
    due.sort_by(|a, b| b.overdue.cmp(&a.overdue).then(a.item.cmp(&b.item)));
    due
}

/// What a log says about each item, a day and round at a time: right when nothing went wrong.
fn record_looks(record: &Record) -> Vec<(&str, Look)> {
    let mut looks: Vec<((&str, u32), Look)> = Vec::new();
    // What was said last of each item: the try, and how many replies there were.
    let mut said: BTreeMap<&str, (u32, u32)> = BTreeMap::new();
    for entry in &record.entries {
        let Some(day) = day_number(&entry.at) else {
            continue;
        };
        match &entry.event {
            Event::Explained { item, attempt, .. } => {
                said.insert(item, (*attempt, 0));
            }
            Event::Replied { item, attempt, .. } => {
                let replies = said.get(item.as_str()).map_or(0, |(_, replies)| *replies);
                said.insert(item, (*attempt, replies + 1));
            }
            Event::SelfMarked { item, .. } => {
                said.remove(item.as_str());
            }
            _ => {}
        }
        let (item, round, right) = match &entry.event {
            Event::Attempt { result, .. } if result == "invalid" => continue,
            Event::Attempt {
                item,
                round,
                result,
                ..
            } => (item, *round, result == "correct"),
            Event::Hint {
                item,
                round,
                level: 3,
                ..
            } => (item, *round, false),
            Event::GoOn { item, round, .. } => (item, *round, false),
            Event::Explained { item, verdict, .. } if verdict != "unsure" => {
                (item, 0, verdict == "pass")
            }
            // Of a doubt, the last word counts; what was missing at first stays missing.
            Event::Replied { item, verdict, .. } if verdict != "unsure" => {
                (item, 0, verdict == "pass")
            }
            Event::SelfMarked { item, verdict, .. } => (item, 0, verdict == "pass"),
            // What it settles counts where nothing was said since.
            Event::SecondOpinion {
                item,
                attempt,
                reply,
                settled,
                verdict,
                ..
            } if verdict != "unsure"
                && !settled.is_empty()
                && said.get(item.as_str()) == Some(&(*attempt, *reply)) =>
            {
                (item, 0, verdict == "pass")
            }
            _ => continue,
        };
        let key = (item.as_str(), round);
        match looks.iter_mut().find(|(other, _)| *other == key) {
            Some((_, look)) => {
                look.day = day;
                look.right &= right;
            }
            None => looks.push((key, Look { day, right })),
        }
    }
    looks
        .into_iter()
        .map(|((item, _), look)| (item, look))
        .collect()
}

/// Days since 1970-01-01 of a date or of a time that starts with one.
pub fn day_number(date: &str) -> Option<i64> {
    let date = date.get(..10)?;
    let mut parts = date.split('-');
    let mut part = || parts.next()?.parse::<i64>().ok();
    let (year, month, day) = (part()?, part()?, part()?);
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    // Howard Hinnant, "chrono-compatible low-level date algorithms", days_from_civil.
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let year_of_era = year.rem_euclid(400);
    let day_of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    let day_of_era = year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year;
    Some(era * 146_097 + day_of_era - 719_468)
}
