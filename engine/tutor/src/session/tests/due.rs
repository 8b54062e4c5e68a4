//! What is due is asked by itself, with numbers of its own.

use super::explain::GOOD;
use super::*;
use crate::record::Record;
use progress::{DueItem, LessonState, ask_first, summary, unfinished, unfinished_due};
use std::collections::BTreeMap;

const ITEMS: [&str; 4] = ["small/explain", "small/area", "gone", "small/worked"];

fn asking(items: &[&str]) -> (Session, Vec<Event>) {
    let mut s = begin();
    let items = items.iter().map(|item| (*item).to_owned()).collect();
    let saved = send(&mut s, [Msg::AskDue(items)]);
    (s, saved)
}

#[test]
fn nothing_but_what_is_due_is_asked_in_the_lessons_order() {
    let (mut s, saved) = asking(&ITEMS);
    assert!(matches!(&saved[..], [Event::DueAgain { .. }]), "{saved:?}");
    assert_eq!(s.screen().lesson_title, "Due again: A small lesson");
    let mut keys = Vec::new();
    loop {
        keys.push(s.screen().key.clone());
        if s.screen().key == "result" {
            break;
        }
        send(&mut s, [Msg::Skip]);
    }
    assert_eq!(
        keys,
        [
            "faded:2",
            "practice:small/area",
            "explain:small/explain:1",
            "result"
        ]
    );
    assert_eq!(s.outcome().words, "RIGHT: none of three");
    assert_eq!(s.outcome().grade, Some(Grade::NotYet));
}

#[test]
fn a_right_answer_counts_and_resuming_is_replaying() {
    let (mut s, mut saved) = asking(&["small/explain"]);
    saved.extend(send(&mut s, [Msg::Draft("It multi".into())]));
    let (mut s, changed) = Session::resume(small(), s.start.clone(), &small().hash, &saved);
    assert_eq!(changed, None);
    assert!(s.asks_due());
    assert!(matches!(&s.screen().input, Input::Text { draft, .. } if draft == "It multi"));
    send(&mut s, [answer(GOOD), Msg::Next]);
    assert_eq!(s.outcome().words, "RIGHT");
    assert!(words(&s).contains("comes back later"), "{}", words(&s));
}

#[test]
fn a_session_that_has_begun_goes_on_as_it_is() {
    let mut s = begin();
    send(&mut s, [Msg::Next]);
    assert_eq!(send(&mut s, [Msg::AskDue(vec!["small/area".into()])]), []);
    assert!(!s.asks_due());
}

fn record(events: &[(&str, Event)]) -> Record {
    let started = events.first().map_or("2026-11-01", |(at, _)| at);
    let mut record = Record::new("0", "small", "h", started, &Start::default());
    for (at, event) in events {
        record.push(at, 0, event.clone());
    }
    record
}

fn explained(verdict: &str) -> Event {
    Event::Explained {
        item: "small/explain".into(),
        attempt: 1,
        text: "words".into(),
        verdict: verdict.into(),
        met: Vec::new(),
        missed: Vec::new(),
        misconceptions: Vec::new(),
        slips: Vec::new(),
        unsure: Vec::new(),
        judge: "test".into(),
        why: Vec::new(),
    }
}

#[test]
fn a_lesson_stands_where_it_stood_but_less_is_due() {
    let passed = Event::Finished {
        grade: Grade::Pass,
        words: "PASS at the first try".into(),
    };
    let lesson = record(&[("2026-11-01", explained("pass")), ("2026-11-01", passed)]);
    let due = Event::DueAgain {
        items: vec!["small/explain".into()],
    };
    let is_due = |records: &[Record]| summary("small", records, "2026-11-10").due.len();
    assert_eq!(is_due(std::slice::from_ref(&lesson)), 1);
    let asked = record(&[
        ("2026-11-09", due.clone()),
        ("2026-11-09", explained("pass")),
    ]);
    let records = [lesson.clone(), asked];
    assert_eq!(is_due(&records), 0);
    assert!(matches!(
        summary("small", &records, "2026-11-10").state,
        LessonState::Passed { .. }
    ));
    assert_eq!(
        unfinished("small", &records),
        None,
        "no lesson to go on with"
    );
    // Left before it was answered: it goes on where it is still due.
    let left = record(&[("2026-11-09", due)]);
    let records = [lesson, left];
    let still = ["small/explain".to_owned()];
    assert_eq!(unfinished_due("small", &records, &still), Some(1));
    assert_eq!(unfinished_due("small", &records, &[]), None);
    assert_eq!(unfinished_due("other", &records, &still), None);
}

#[test]
fn a_doubt_that_a_second_opinion_settled_was_looked_at() {
    let settled = |attempt, settled: &[&str]| Event::SecondOpinion {
        item: "small/explain".into(),
        attempt,
        reply: 0,
        by: "test".into(),
        result: "settles".into(),
        problem: None,
        own_verdict: None,
        says: BTreeMap::new(),
        why: Vec::new(),
        disputed: Vec::new(),
        settled: settled.iter().map(|id| (*id).to_owned()).collect(),
        verdict: "pass".into(),
        met: Vec::new(),
        missed: Vec::new(),
        misconceptions: Vec::new(),
        slips: Vec::new(),
        unsure: Vec::new(),
    };
    for (opinion, due) in [
        (settled(1, &["area"]), 1),
        // About another try, or of nothing that was open.
        (settled(2, &["area"]), 0),
        (settled(1, &[]), 0),
    ] {
        let doubted = ("2026-11-01", explained("unsure"));
        let log = record(&[doubted, ("2026-11-01", opinion.clone())]);
        let found = summary("small", &[log], "2026-11-10").due.len();
        assert_eq!(found, due, "{opinion:?}");
    }
}

#[track_caller]
fn check_first(most: usize, expected: &[(&str, &[&str])]) {
    let item = |item: &str, overdue| DueItem {
        item: item.to_owned(),
        overdue,
    };
    let a = [item("a/1", 9), item("a/2", 3), item("a/3", 3)];
    let b = [item("b/1", 5), item("b/2", 3)];
    let first = ask_first(&[("a", &a), ("b", &b)], most);
    let found: Vec<(&str, Vec<&str>)> = first
        .iter()
        .map(|(lesson, items)| (lesson.as_str(), items.iter().map(String::as_str).collect()))
        .collect();
    let expected: Vec<(&str, Vec<&str>)> = expected
        .iter()
        .map(|(lesson, items)| (*lesson, items.to_vec()))
        .collect();
    assert_eq!(found, expected, "{most}");
}

#[test]
fn what_waited_longest_comes_first() {
    check_first(0, &[]);
    check_first(1, &[("a", &["a/1"])]);
    check_first(2, &[("a", &["a/1"]), ("b", &["b/1"])]);
    check_first(3, &[("a", &["a/1", "a/2"]), ("b", &["b/1"])]);
    let all: &[(&str, &[&str])] = &[("a", &["a/1", "a/2", "a/3"]), ("b", &["b/1", "b/2"])];
    check_first(5, all);
    check_first(9, all);
}
