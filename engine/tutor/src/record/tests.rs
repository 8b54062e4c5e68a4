use super::*;
use crate::session::tests::any;
use proptest::prelude::*;

const STARTED: &str = "2026-11-22T10:00:00Z";

fn empty() -> Record {
    Record::new(
        "0.1.0",
        "small",
        "0011223344556677",
        STARTED,
        &Start::default(),
    )
}

fn bits(record: &Record) -> Vec<u64> {
    let givens = record
        .entries
        .iter()
        .filter_map(|entry| match &entry.event {
            Event::Attempt { given, .. } => Some(given.values().map(|value| value.to_bits())),
            _ => None,
        });
    givens.flatten().collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn every_value_survives(
        seed in any::<u64>(),
        slips in prop::collection::vec((any::text(), any::text()), 0..3),
        entries in prop::collection::vec((any::text(), 0..=i64::MAX as u64, any::event()), 0..12),
    ) {
        let slips = slips.into_iter().map(|(id, lesson)| NotedSlip { id, lesson }).collect();
        let start = Start { seed, slips };
        let mut record = Record::new("0.1.0", "small", "00", STARTED, &start);
        for (at, took_ms, event) in entries {
            record.push(&at, took_ms, event);
        }
        let text = record.to_toml();
        let read = Record::from_toml(&text);
        prop_assert_eq!(read.as_ref().map(bits), Ok(bits(&record)));
        prop_assert_eq!(read.as_ref().map(Record::start), Ok(start));
        prop_assert_eq!(read, Ok(record), "{}", text);
    }

    #[test]
    fn no_file_panics(text in any::text(), cut in 0..400_usize) {
        let _ = Record::from_toml(&text);
        let mut record = empty();
        record.push(STARTED, 1, Event::Draft { item: "small/explain".into(), text });
        let whole = record.to_toml();
        let cut = whole.char_indices().map(|(at, _)| at).nth(cut).unwrap_or(whole.len());
        if let Err(error) = Record::from_toml(&whole[..cut]) {
            prop_assert!(error.line <= whole.lines().count() + 1);
        }
    }
}

#[test]
fn a_megabyte_survives() {
    let mut record = empty();
    let text = "ünï\u{0}'\"\\\r\n".repeat(100_000);
    let item = "small/explain".to_owned();
    record.push(STARTED, 7, Event::Draft { item, text });
    assert_eq!(Record::from_toml(&record.to_toml()), Ok(record));
}

#[test]
fn a_log_reads_like_one() {
    let mut record = empty();
    record.push(
        "2026-11-22T10:00:05Z",
        5000,
        Event::Attempt {
            item: "small/area".into(),
            round: 0,
            step: "area".into(),
            seed: 7,
            given: [("x".to_owned(), 3.5)].into(),
            text: "12.25".into(),
            result: "correct".into(),
            mistake: None,
            named: false,
            says: "Correct.".into(),
        },
    );
    let text = record.to_toml();
    assert_eq!(
        text,
        r#"format = 1
program = "0.1.0"
lesson = "small"
hash = "0011223344556677"
seed = 0
started = "2026-11-22T10:00:00Z"

[[event]]
at = "2026-11-22T10:00:05Z"
took_ms = 5000
kind = "attempt"
item = "small/area"
round = 0
step = "area"
seed = 7
text = "12.25"
result = "correct"
says = "Correct."

[event.given]
x = 3.5
"#
    );
}

#[test]
fn drafts_replace_each_other() {
    let mut record = empty();
    let draft = |item: &str, text: &str| Event::Draft {
        item: item.into(),
        text: text.into(),
    };
    record.push(STARTED, 1, draft("a", "D"));
    record.push(STARTED, 2, draft("a", "D is"));
    record.push(STARTED, 4, draft("b", "other"));
    let kept: Vec<_> = record
        .entries
        .iter()
        .map(|e| (e.took_ms, e.event.clone()))
        .collect();
    assert_eq!(kept, [(3, draft("a", "D is")), (4, draft("b", "other"))]);
}

#[test]
fn no_wait_is_too_long_for_toml() {
    let mut record = empty();
    for text in ["a", "b"] {
        let (item, text) = ("a".into(), text.into());
        record.push(STARTED, u64::MAX, Event::Draft { item, text });
    }
    assert_eq!(Record::from_toml(&record.to_toml()), Ok(record));
}

#[track_caller]
fn refuses(text: &str, line: usize, column: usize, says: &str) {
    let error = Record::from_toml(text).expect_err("must be refused");
    assert_eq!((error.line, error.column), (line, column), "{error}");
    assert!(error.message.contains(says), "{error}");
}

#[test]
fn what_is_not_understood_is_named_with_its_place() {
    let head = empty().to_toml().replace("event = []\n", "");
    let lines = head.lines().count();
    let event = |body: &str| format!("{head}\n[[event]]\nat = \"t\"\ntook_ms = 1\n{body}\n");
    refuses("", 1, 1, "not a log");
    refuses("format = 2\n", 1, 10, "format 1");
    refuses("format = 1\nlesson = \n", 2, 10, "");
    refuses(
        &event("kind = \"dreamt\""),
        lines + 5,
        8,
        "`dreamt` is not known",
    );
    refuses(&event("item = 1"), lines + 2, 1, "without `kind`");
    refuses(&event("kind = 1"), lines + 5, 8, "must be a string");
    refuses(
        &event("kind = \"go-on\"\nitem = \"a\"\nround = 0"),
        lines + 2,
        1,
        "missing field `step`",
    );
    refuses(
        &event("kind = \"revealed\"\nlines = 1\nmood = \"good\""),
        lines + 2,
        1,
        "unknown field `mood`",
    );
    refuses(&head.replace("seed = 0", "seed = -1"), 5, 8, "seed");
    refuses(
        &head.replace("seed = 0", "seed = 0\nmood = 1"),
        6,
        1,
        "mood",
    );
}
