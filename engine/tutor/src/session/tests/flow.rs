//! The way through a lesson: on, back, skip, leave.

use super::*;
use crate::view::{Progress, Saving};

#[track_caller]
fn leads(session: &mut Session, msg: Msg, key: &str, label: &str) {
    send(session, [msg]);
    let view = session.screen();
    assert_eq!((view.key.as_str(), view.next_label.as_str()), (key, label));
}

#[test]
fn the_walkthrough_leads_to_the_worked_example_line_by_line() {
    let mut s = begin();
    assert_eq!(s.screen().key, "why");
    assert_eq!(s.screen().stage, Stage::Why);
    leads(&mut s, Msg::Next, "step:1", "on");
    leads(&mut s, Msg::Next, "step:2", "on");
    assert!(words(&s).contains("A square is a number times itself."));
    leads(&mut s, Msg::Next, "worked", "next line");
    assert!(words(&s).contains("area = 9.0"));
    assert!(!words(&s).contains("27"));
    leads(&mut s, Msg::Next, "worked", "on");
    assert!(words(&s).contains("volume = 27.0"));
    assert!(words(&s).contains("So the volume is 27."));
    leads(&mut s, Msg::Next, "faded:1", "");
    // Whatever lines are asked for, the numbers they need are there.
    assert!(words(&s).contains("Given: x = "), "{}", words(&s));
}

#[test]
fn looking_back_loses_nothing() {
    let mut s = begin();
    walk_to(&mut s, "faded:1");
    leads(&mut s, Msg::Back, "worked", "on");
    assert!(words(&s).contains("volume = 27.0"), "revealed lines stay");
    leads(&mut s, Msg::Back, "step:2", "on");
    leads(&mut s, Msg::Next, "worked", "on");
    leads(&mut s, Msg::Next, "faded:1", "");
    let mut s = begin();
    send(&mut s, [Msg::Back]);
    assert_eq!(s.screen().note.as_deref(), Some("This is the beginning."));
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().note, None);
}

#[test]
fn skipping_leaves_out_the_stage_or_the_item() {
    let mut s = begin();
    leads(&mut s, Msg::Skip, "step:1", "on");
    leads(&mut s, Msg::Skip, "worked", "next line");
    leads(&mut s, Msg::Skip, "practice:small/area", "");
    leads(&mut s, Msg::Skip, "practice:small/which", "");
    leads(&mut s, Msg::Back, "practice:small/area", "on");
    assert_eq!(input(&s), "number", "what was left out can still be done");
    // What was passed over on the way is there to be read, too.
    leads(&mut s, Msg::Back, "worked", "next line");
    leads(&mut s, Msg::Back, "step:1", "on");
    leads(&mut s, Msg::Next, "step:2", "on");
    leads(&mut s, Msg::Next, "worked", "next line");
}

/// What skipping is called where it is more than going on.
#[track_caller]
fn check_skip(session: &Session, key: &str, label: &str) {
    let view = session.screen();
    let found = (view.key.as_str(), view.can.skip, view.skip_label.as_str());
    assert_eq!(found, (key, !label.is_empty(), label));
}

#[test]
fn skipping_is_offered_where_something_would_be_left_out() {
    let mut s = begin();
    check_skip(&s, "why", "");
    for (msg, key, label) in [
        (Msg::Next, "step:1", "skip the walkthrough"),
        (Msg::Next, "step:2", ""),
        (Msg::Next, "worked", "skip the worked example"),
        (Msg::Next, "worked", "skip the worked example"),
        (Msg::Next, "faded:1", "skip this round"),
        (Msg::Skip, "faded:2", "skip this round"),
        (Msg::Skip, "practice:small/area", "skip this exercise"),
        (Msg::Skip, "practice:small/which", "skip this exercise"),
    ] {
        send(&mut s, [msg]);
        check_skip(&s, key, label);
    }
    let Input::Choice { options } = s.screen().input.clone() else {
        panic!("a choice is asked for");
    };
    let right = options.iter().position(|it| it == "a number times itself");
    let right = right.expect("it is one of them") + 1;
    send(&mut s, [answer(&right.to_string())]);
    check_skip(&s, "practice:small/which", "");
    let saved = send(&mut s, [Msg::Skip]);
    assert!(
        matches!(&saved[..], [Event::Next { .. }]),
        "what is done is not left out: {saved:?}"
    );
    walk_to(&mut s, "explain:small/explain:1");
    check_skip(&s, "explain:small/explain:1", "skip this question");
    send(&mut s, [answer("it doubles the number")]);
    check_skip(&s, "explain:small/explain:1", "skip the second try");
    walk_to(&mut s, "explain:small/explain:2");
    check_skip(&s, "explain:small/explain:2", "skip this question");
    send(&mut s, [answer(super::explain::GOOD)]);
    check_skip(&s, "explain:small/explain:2", "");
    walk_to(&mut s, "result");
    check_skip(&s, "result", "");
}

#[test]
fn going_on_wants_an_answer_first() {
    let mut s = begin();
    walk_to(&mut s, "practice:small/area");
    let saved = send(&mut s, [Msg::Next]);
    assert_eq!(saved, []);
    assert!(
        s.screen()
            .note
            .as_deref()
            .is_some_and(|n| n.contains("Your answer first"))
    );
    assert!(!s.screen().can.next);
}

#[test]
fn leaving_out_everything_is_not_a_pass() {
    let mut s = begin();
    walk_to(&mut s, "result");
    let outcome = s.outcome();
    assert!(outcome.finished);
    assert_eq!(outcome.grade, Some(Grade::NotYet));
    assert_eq!(
        outcome.words,
        "NOT YET: still open are “What is a square?”, re-test 1 and “And a cube?”"
    );
    assert!(
        outcome
            .items
            .iter()
            .all(|item| item.standing == Standing::Skipped)
    );
    assert_eq!(s.update(Msg::Next), [Effect::Quit]);
}

#[test]
fn the_header_knows_what_is_done() {
    let mut s = begin();
    walk_to(&mut s, "practice:small/which");
    let stages: Vec<_> = s.screen().stages.clone();
    assert_eq!(
        stages,
        [
            (Stage::Why, Progress::Done),
            (Stage::Walkthrough, Progress::Done),
            (Stage::Worked, Progress::Done),
            (Stage::Practice, Progress::Here),
            (Stage::Explain, Progress::Ahead),
            (Stage::Retest, Progress::Ahead),
            (Stage::Result, Progress::Ahead),
        ]
    );
    assert_eq!(s.screen().place, (2, 4));
}

#[test]
fn slips_of_earlier_lessons_lead_in() {
    let slips = vec![NotedSlip {
        id: "halves".into(),
        lesson: "before".into(),
    }];
    let s = Session::new(small(), Start { seed: 1, slips });
    assert_eq!(verdicts(&s), ["Noted last time"]);
    assert!(words(&s).contains("you halved"));
    assert!(!words(&s).contains("Nobody"));
    assert_eq!(verdicts(&begin()), [""; 0]);
}

#[test]
fn saving_is_shown_and_failing_keeps_everything() {
    let mut s = begin();
    assert_eq!(s.screen().saving, Saving::Nothing);
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().saving, Saving::Waiting);
    send(&mut s, [Msg::Saved]);
    assert_eq!(s.screen().saving, Saving::Saved);
    let blocks = s.screen().blocks.clone();
    send(&mut s, [Msg::SaveFailed("disk full".into())]);
    assert_eq!(s.screen().saving, Saving::Failed("disk full".into()));
    assert_eq!(s.screen().blocks, blocks);
}

#[test]
fn quitting_saves_nothing_more_and_draws_nothing() {
    let mut s = begin();
    assert_eq!(s.update(Msg::Quit), [Effect::Quit]);
}

#[test]
fn a_changed_lesson_says_so_once() {
    let mut s = begin();
    let mut log = send(&mut s, [Msg::Next, Msg::Next, Msg::Next, Msg::Next]);
    assert_eq!(s.screen().key, "worked");
    let start = Start {
        seed: 7,
        slips: Vec::new(),
    };
    let (mut s, notice) = Session::resume(small(), start.clone(), "other", &log);
    assert_eq!(
        notice.as_deref(),
        Some(
            "The lesson file changed since you left, so you begin the worked example again. What \
             you did before it is kept."
        )
    );
    assert_eq!(s.screen().note, None, "whoever resumes says it");
    assert_eq!(s.screen().key, "worked");
    assert_eq!(s.screen().next_label, "next line");
    log.extend(send(&mut s, [Msg::Back]));
    assert_eq!(s.screen().key, "step:2");
    let (s, notice) = Session::resume(small(), start, "other", &log);
    assert_eq!((s.screen().key.as_str(), notice), ("step:2", None));
}

#[test]
fn what_was_left_out_can_be_made_good_after_the_result() {
    let mut s = begin();
    walk_to(&mut s, "result");
    send(&mut s, [Msg::Back]);
    assert_eq!(s.screen().key, "explain:small/retest:1");
    let cube = answer("It multiplies the number by itself twice.");
    let saved = send(&mut s, [cube, Msg::Next]);
    let words = "NOT YET: still open are “What is a square?” and re-test 1";
    assert!(
        matches!(saved.last(), Some(Event::Finished { words: now, .. }) if now == words),
        "{saved:#?}"
    );
    assert_eq!(s.outcome().words, words);
    let saved = send(&mut s, [Msg::Back, Msg::Next]);
    assert_eq!(saved.len(), 2, "looking back changes nothing: {saved:#?}");
}
