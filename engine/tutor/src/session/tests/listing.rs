//! Lists over logs, and transcripts.

use super::*;
use crate::record::Record;
use progress::{LessonState, day_number, noted_slips, summary, unfinished};

fn record(lesson: &str, entries: &[(&str, Event)]) -> Record {
    let started = entries.first().map_or("2026-11-01T00:00:00Z", |(at, _)| at);
    let mut record = Record::new("0", lesson, "h", started, &Start::default());
    for (at, event) in entries {
        record.push(at, 0, event.clone());
    }
    record
}

fn attempt(item: &str, result: &str) -> Event {
    Event::Attempt {
        item: item.into(),
        round: 0,
        step: String::new(),
        seed: 0,
        given: BTreeMap::new(),
        text: "1".into(),
        result: result.into(),
        mistake: (result == "mistake").then(|| "doubled".to_owned()),
        named: result == "mistake",
        says: String::new(),
    }
}

fn next(stage: Stage) -> Event {
    Event::Next {
        stage,
        screen: String::new(),
    }
}

fn finished(grade: Grade, words: &str) -> Event {
    Event::Finished {
        grade,
        words: words.into(),
    }
}

#[track_caller]
fn stands(records: &[Record], words: &str) {
    assert_eq!(summary("a", records, "2026-11-22").state.words(), words);
}

#[test]
fn a_lesson_stands_where_its_latest_log_says() {
    let day = |d: u32| format!("2026-11-{d:02}T10:00:00Z");
    let begun = record("a", &[(&day(3), next(Stage::Practice))]);
    let passed = record("a", &[(&day(4), finished(Grade::Pass, "PASS on retry"))]);
    let failed = record("a", &[(&day(5), finished(Grade::NotYet, "NOT YET: all"))]);
    let mut looked_back = passed.clone();
    looked_back.push(&day(6), 0, next(Stage::Why));
    let other = record("b", &[(&day(9), next(Stage::Why))]);
    let empty = record("a", &[]);
    stands(&[], "new");
    stands(&[other.clone(), empty.clone()], "new");
    stands(std::slice::from_ref(&begun), "in progress: the exercises");
    stands(&[passed.clone(), begun.clone()], "PASS on retry");
    stands(&[failed.clone(), passed.clone()], "NOT YET: all");
    stands(&[looked_back, failed.clone()], "PASS on retry");
    assert_eq!(unfinished("a", &[other.clone(), begun.clone()]), Some(1));
    assert_eq!(unfinished("a", &[begun, passed]), None);
    assert_eq!(unfinished("a", &[other]), None);
}

#[track_caller]
fn due_on(looks: &[(&str, &str)], today: &str, overdue: Option<i64>) {
    let records: Vec<Record> = looks
        .iter()
        .map(|(day, result)| record("a", &[(day, attempt("a/x", result))]))
        .collect();
    let due = summary("a", &records, today).due;
    assert_eq!(due.first().map(|item| item.overdue), overdue, "{due:?}");
}

#[test]
fn waits_grow_with_success_and_start_again_with_a_miss() {
    due_on(&[("2026-11-20", "correct")], "2026-11-22", None);
    due_on(&[("2026-11-20", "correct")], "2026-11-23", Some(0));
    due_on(&[("2026-11-20", "wrong")], "2026-11-21", Some(0));
    due_on(&[("2026-11-20", "wrong")], "2026-11-20", None);
    due_on(
        &[("2026-11-13", "correct"), ("2026-11-16", "correct")],
        "2026-11-22",
        None,
    );
    due_on(
        &[("2026-11-13", "correct"), ("2026-11-16", "correct")],
        "2026-11-24",
        Some(1),
    );
    due_on(
        &[("2026-11-16", "correct"), ("2026-11-19", "wrong")],
        "2026-11-22",
        Some(2),
    );
    due_on(&[("2026-11-19", "invalid")], "2026-12-22", None);
    due_on(&[("not a day", "wrong")], "2026-12-22", None);
    due_on(&[("2026-11-19", "wrong")], "someday", None);
}

#[test]
fn a_miss_and_a_hit_in_one_sitting_is_a_miss() {
    let at = "2026-11-20T10:00:00Z";
    let records = [record(
        "a",
        &[
            (at, attempt("a/x", "wrong")),
            (at, attempt("a/x", "correct")),
        ],
    )];
    let all = summary("a", &records, "2026-11-21");
    assert_eq!((all.due.len(), all.answers, all.sessions), (1, 2, 1));
}

#[test]
fn slips_are_noted_for_other_lessons() {
    let at = "2026-11-20T10:00:00Z";
    let records = [
        record("a", &[(at, attempt("a/x", "mistake"))]),
        record("b", &[]),
    ];
    let slip = NotedSlip {
        id: "doubled".into(),
        lesson: "a".into(),
    };
    assert_eq!(noted_slips("b", &records), std::slice::from_ref(&slip));
    assert_eq!(noted_slips("a", &records), []);
    assert_eq!(summary("a", &records, "").slips, [slip]);
    assert_eq!(
        summary("a", &records, "").state.words(),
        LessonState::InProgress { stage: Stage::Why }.words()
    );
}

#[track_caller]
fn day(date: &str, number: Option<i64>) {
    assert_eq!(day_number(date), number, "{date}");
}

#[test]
fn days_are_counted() {
    day("1970-01-01", Some(0));
    day("1969-12-31", Some(-1));
    day("2000-02-29T23:59:59Z", Some(11_016));
    day("2026-11-22T10:00:00+01:00[Europe/Berlin]", Some(20_779));
    day("2026-13-01", None);
    day("2026-1-1", None);
    day("", None);
    day("ünïcödé…", None);
}

#[test]
fn a_transcript_tells_what_was_taught_and_said() {
    let mut s = begin();
    let mut record = Record::new(
        "0",
        "small",
        &s.lesson().hash,
        "2026-11-20T10:00:00Z",
        &s.start,
    );
    let mut keep = |events: Vec<Event>| {
        for event in events {
            record.push("2026-11-20T10:00:01Z", 1000, event);
        }
    };
    while s.screen().key != "explain:small/explain:1" {
        let msg = if s.screen().can.next {
            Msg::Next
        } else {
            Msg::Skip
        };
        keep(send(&mut s, [msg]));
    }
    keep(send(
        &mut s,
        [
            answer("It multiplies the *number* by itself."),
            answer("no *idea*"),
            Msg::Skip,
        ],
    ));
    let text = transcript::transcript(&small(), Some(&record));
    for part in [
        "# A small lesson\n\nLesson `small`, begun 2026-11-20T10:00:00Z, not finished, seed 7, 1 answer.",
        "## Walkthrough\n\n### 1 of 2: First\n\nA square has four equal sides.",
        "     = 9.0\n```",
        "*Left out.*",
        "by itself",
        "What if the number is a length?",
        "> no \\*idea\\*",
        "**Still missing**",
        "- What becomes of the unit?",
    ] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let plain = transcript::transcript(&small(), None);
    for part in [
        "Squares turn up everywhere.",
        "a number times itself\n",
        "What does cubing do?",
    ] {
        assert!(plain.contains(part), "no {part:?} in\n{plain}");
    }
    assert!(!plain.contains("Left out"));
}
