//! Explain-back: verdict, re-teach, second try, checklist.

use super::*;
use crate::prose::Tone;

pub(super) const QUESTION: &str = "explain:small/explain:1";
pub(super) const GOOD: &str = "It multiplies the number by itself, and a length becomes an area.";

/// An answer as some judge might have heard it.
pub(super) fn hear(
    s: &mut Session,
    attempt: u32,
    verdict: &str,
    met: &[&str],
    wrong: &[&str],
    open: &[&str],
) {
    let list = |ids: &[&str]| ids.iter().map(|id| (*id).to_owned()).collect::<Vec<_>>();
    let missed = ["itself", "area"].into_iter();
    let missed: Vec<&str> = missed
        .filter(|id| !met.contains(id) && !open.contains(id))
        .collect();
    let slips: Vec<&str> = wrong
        .iter()
        .copied()
        .filter(|id| *id == "always-larger")
        .collect();
    s.apply(&Event::Explained {
        item: "small/explain".into(),
        attempt,
        text: "some words, and more".into(),
        verdict: verdict.into(),
        met: list(met),
        missed: list(&missed),
        misconceptions: list(wrong),
        slips: list(&slips),
        unsure: list(open),
        judge: "test".into(),
        why: vec![Quote {
            id: met
                .iter()
                .chain(wrong)
                .chain(open)
                .next()
                .unwrap_or(&"")
                .to_string(),
            quote: "some words".into(),
            start: 0,
            end: 10,
        }],
    });
    s.refresh();
}

pub(super) fn at_question() -> Session {
    let mut s = begin();
    walk_to(&mut s, QUESTION);
    s
}

/// Ends the dialogue, where there is one.
fn no_more_questions(s: &mut Session) {
    if input(s) == "reply" {
        send(s, [Msg::Skip]);
    }
}

/// From a first try to the screens that follow it.
#[track_caller]
fn follows(met: &[&str], wrong: &[&str], verdict: &str, keys: &[&str]) {
    let mut s = at_question();
    hear(&mut s, 1, verdict, met, wrong, &[]);
    no_more_questions(&mut s);
    for key in keys {
        send(&mut s, [Msg::Next]);
        assert_eq!(s.screen().key, *key);
    }
}

#[test]
fn what_is_missed_is_taught_again_and_asked_again() {
    let (tiles, units) = ("reteach:small/explain:tiles", "reteach:small/explain:units");
    let (again, on) = ("explain:small/explain:2", "retest:small/area");
    follows(&["itself", "area"], &[], "pass", &[on]);
    follows(&["itself"], &[], "partial", &[units, again]);
    follows(&["area"], &[], "partial", &[tiles, again]);
    follows(&[], &[], "fail", &[tiles, units, again]);
    follows(&["itself", "area"], &["doubling"], "partial", &[again]);
}

#[test]
fn the_judge_reads_the_answer() {
    let mut s = at_question();
    assert_eq!(input(&s), "text");
    let saved = send(&mut s, [answer(GOOD)]);
    assert!(
        matches!(&saved[..], [Event::Explained { verdict, judge, .. }]
            if verdict == "pass" && judge == crate::judge::JUDGE_VERSION),
        "{saved:#?}"
    );
    assert_eq!(verdicts(&s), ["That is it"]);
    assert!(words(&s).contains("Both points are there."));
    assert_eq!(input(&s), "none");
}

#[test]
fn a_missing_point_is_named_without_giving_it_away() {
    let mut s = at_question();
    hear(&mut s, 1, "partial", &["itself"], &[], &[]);
    no_more_questions(&mut s);
    assert_eq!(
        verdicts(&s),
        ["One question", "As you like", "Part of it", "Still missing"]
    );
    let said = words(&s);
    assert!(said.contains("What becomes of the unit?"));
    assert!(said.contains("Next: the units re-teach. Then the same question again."));
    assert!(!said.contains("A length becomes an area"));
    assert!(s.screen().blocks.contains(&Block::Quoted {
        text: "some words, and more".into(),
        marks: vec![(0, 10, Tone::Good)],
    }));
    assert_eq!(s.screen().next_label, "another angle");
    send(&mut s, [Msg::Next, Msg::Next]);
    assert_eq!(s.screen().stage, Stage::Explain);
    assert!(
        words(&s).contains("some words, and more"),
        "the first try is remembered"
    );
    hear(&mut s, 2, "pass", &["itself", "area"], &[], &[]);
    assert!(verdicts(&s).contains(&"Now it is all there"));
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "retest:small/area");
}

#[test]
fn a_second_miss_shows_the_answer_and_goes_on() {
    let mut s = at_question();
    hear(&mut s, 1, "fail", &[], &[], &[]);
    send(&mut s, [Msg::Next, Msg::Next, Msg::Next]);
    hear(&mut s, 2, "fail", &[], &[], &[]);
    assert!(words(&s).contains("What I was listening for"));
    assert!(words(&s).contains("a length becomes an area"));
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "retest:small/area");
}

#[test]
fn a_blocking_mistake_is_quoted_and_a_slip_is_noted() {
    let mut s = at_question();
    hear(
        &mut s,
        1,
        "partial",
        &["itself", "area"],
        &["doubling"],
        &[],
    );
    assert_eq!(verdicts(&s), ["Nearly", "Look at this again"]);
    assert!(words(&s).contains("Try it with three."));
    assert_eq!(s.outcome().slips, []);
    let mut s = at_question();
    hear(
        &mut s,
        1,
        "pass",
        &["itself", "area"],
        &["always-larger"],
        &[],
    );
    assert_eq!(verdicts(&s), ["That is it", "A slip, by the way"]);
    let slip = NotedSlip {
        id: "always-larger".into(),
        lesson: "small".into(),
    };
    assert_eq!(s.outcome().slips, [slip]);
    walk_to(&mut s, "result");
    assert!(words(&s).contains("A square is always larger than its side."));
}

#[test]
fn where_the_judge_cannot_tell_the_learner_marks_himself() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &["itself"], &[], &["area", "doubling"]);
    no_more_questions(&mut s);
    assert_eq!(verdicts(&s)[2..], ["I cannot tell"]);
    assert_eq!(input(&s), "checklist");
    assert_eq!(send(&mut s, [Msg::ChecklistDone, Msg::Next]), []);
    assert!(s.screen().note.is_some());
    let mark = |point, said| Msg::Mark { point, said };
    let saved = send(
        &mut s,
        [mark(0, true), mark(1, true), mark(1, false), mark(9, true)],
    );
    assert_eq!(saved.len(), 3);
    let saved = send(&mut s, [Msg::ChecklistDone]);
    assert!(
        matches!(&saved[..], [Event::SelfMarked { verdict, met, .. }]
            if verdict == "pass" && met == &["itself", "area"]),
        "{saved:#?}"
    );
    assert_eq!(
        verdicts(&s)[2..],
        ["I cannot tell", "By your own marking: yes"]
    );
    let outcome = s.outcome();
    let item = outcome
        .items
        .iter()
        .find(|item| item.item == "small/explain");
    assert_eq!(item.map(|item| item.standing), Some(Standing::SelfMarked));
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "retest:small/area");
}

#[test]
fn an_honest_no_leads_to_the_reteach() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &["itself"], &[], &["area"]);
    no_more_questions(&mut s);
    let no = Msg::Mark {
        point: 0,
        said: false,
    };
    send(&mut s, [no, Msg::ChecklistDone, Msg::Next]);
    assert_eq!(s.screen().key, "reteach:small/explain:units");
}

#[test]
fn hints_nudge_twice_and_then_tell() {
    let mut s = at_question();
    assert_eq!(s.screen().can.hint, Some(1));
    send(&mut s, [Msg::Hint]);
    assert!(words(&s).contains("What is the number multiplied with?"));
    send(&mut s, [Msg::Hint]);
    assert!(words(&s).contains("What becomes of the unit?"));
    assert!(!words(&s).contains("A model answer"));
    send(&mut s, [Msg::Hint]);
    assert!(words(&s).contains("A model answer"));
    assert_eq!(s.screen().can.hint, None);
    hear(&mut s, 1, "pass", &["itself", "area"], &[], &[]);
    let outcome = s.outcome();
    let item = outcome
        .items
        .iter()
        .find(|item| item.item == "small/explain");
    assert_eq!(item.map(|item| item.standing), Some(Standing::Shown));
}

#[test]
fn a_draft_waits_for_its_writer() {
    let mut s = at_question();
    send(&mut s, [Msg::Draft("It mult".into())]);
    send(&mut s, [Msg::Back, Msg::Next]);
    let draft = match &s.screen().input {
        Input::Text { draft, .. } => draft.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(draft, "It mult");
    assert_eq!(
        send(&mut s, [Msg::Draft("It mult".into())]),
        [],
        "nothing new"
    );
    assert_eq!(send(&mut s, [answer("  \n ")]), [], "nothing typed");
}

#[test]
fn a_draft_outlives_a_change_of_the_lesson() {
    let resumed = |log: &[Event]| {
        let start = Start {
            seed: 7,
            slips: Vec::new(),
        };
        let (mut s, notice) = Session::resume(small(), start, "another hash", log);
        assert!(notice.is_some_and(|says| says.contains("changed")));
        walk_to(&mut s, QUESTION);
        match &s.screen().input {
            Input::Text { draft, .. } => draft.clone(),
            other => panic!("{other:?}"),
        }
    };
    let mut s = begin();
    let mut log = Vec::new();
    while s.screen().key != QUESTION {
        log.extend(send(&mut s, [Msg::Skip]));
    }
    log.extend(send(&mut s, [Msg::Draft("It mult".into())]));
    assert_eq!(resumed(&log), "It mult");
    // Half a reply is no answer.
    log.extend(send(
        &mut s,
        [answer("It multiplies the number by itself.")],
    ));
    log.extend(send(&mut s, [Msg::Draft("a leng".into())]));
    assert_eq!(resumed(&log), "");
}

#[test]
fn an_answer_that_tries_to_be_a_template_stays_what_it_is() {
    let mut s = at_question();
    send(&mut s, [answer("{{ pi }} **bold** `code`")]);
    let quoted = s.screen().blocks.iter().any(
        |block| matches!(block, Block::Quoted { text, .. } if text == "{{ pi }} **bold** `code`"),
    );
    assert!(quoted);
}
