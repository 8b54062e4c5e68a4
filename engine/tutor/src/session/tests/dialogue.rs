//! The tutor asks back: one question, a hint, a blank, the answer; then whoever is asked marks
//! himself or is taught again.

use super::explain::{at_question, hear};
use super::*;
use crate::prose::Tone;

const ANSWER: &str = "It multiplies the number by itself.";
const ASK: &str = "What if the number is a length?";
const HINT: &str = "What becomes of the unit?";

/// From an answer that lacks the area: what is said or asked for, and the titles that follow.
#[track_caller]
fn check_from(first: &str, replies: &[&str], titles: &[&str], then: &str) {
    let mut s = at_question();
    send(&mut s, [answer(first)]);
    for reply in replies {
        assert_eq!(input(&s), "reply", "{:?}", verdicts(&s));
        send(
            &mut s,
            [match *reply {
                ":hint" => Msg::Hint,
                ":skip" => Msg::Skip,
                text => answer(text),
            }],
        );
    }
    assert_eq!(verdicts(&s), titles);
    assert_eq!(input(&s), then);
}

#[test]
fn a_missing_point_is_asked_for_step_by_step() {
    check_from(ANSWER, &[], &["One question"], "reply");
    let all = "Now it is all there";
    check_from(
        ANSWER,
        &["a length becomes an area"],
        &["One question", "Yes", all],
        "none",
    );
    check_from(
        ANSWER,
        &["no idea", "a length becomes an area"],
        &["One question", "A hint", "Yes", all],
        "none",
    );
    let asked = ["One question", "A hint", "Fill in the blank"];
    check_from(
        ANSWER,
        &["no idea", "hm", "an area"],
        &[&asked[..], &["Yes", all]].concat(),
        "none",
    );
    check_from(ANSWER, &[":hint", ":hint"], &asked, "reply");
    let told = [&asked[..], &["The answer", "Part of it"]].concat();
    check_from(ANSWER, &["no idea", "hm", "a volume"], &told, "none");
    check_from(ANSWER, &[":hint", ":hint", ":hint"], &told, "none");
    let left = ["One question", "As you like", "Part of it", "Still missing"];
    check_from(ANSWER, &[":skip"], &left, "none");
    let later = [
        "One question",
        "A hint",
        "As you like",
        "Part of it",
        "Still missing",
    ];
    check_from(ANSWER, &["no idea", ":skip"], &later, "none");
}

#[test]
fn a_full_answer_a_poor_one_and_a_wrong_one_are_not_interrogated() {
    check_from(super::explain::GOOD, &[], &["That is it"], "none");
    check_from("No idea.", &[], &["Not yet", "Still missing"], "none");
    let wrong = "It multiplies the number by itself. It doubles the number.";
    check_from(
        wrong,
        &[],
        &["Part of it", "Look at this again", "Still missing"],
        "none",
    );
}

#[test]
fn a_mistake_in_a_reply_ends_the_questions_and_is_taught_again() {
    check_from(
        ANSWER,
        &["It doubles the number."],
        &[
            "One question",
            "Part of it",
            "Look at this again",
            "Still missing",
        ],
        "none",
    );
}

#[test]
fn what_was_told_does_not_count_as_said() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &[], &[], &["itself", "area"]);
    send(&mut s, [Msg::Hint, Msg::Hint, Msg::Hint]);
    assert!(words(&s).contains("The number is multiplied by itself."));
    assert_eq!(verdicts(&s).last(), Some(&"Another question"));
    send(
        &mut s,
        [answer(
            "The number is multiplied by itself, and a length becomes an area.",
        )],
    );
    assert_eq!(input(&s), "none");
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "reteach:small/explain:tiles");
}

#[test]
fn no_more_than_five_questions_follow_an_answer() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &[], &[], &["itself", "area"]);
    let mut asked = 0;
    while input(&s) == "reply" {
        asked += 1;
        send(&mut s, [answer("no idea")]);
        assert!(asked < 9, "it never ends");
    }
    assert_eq!(asked, 5);
}

#[test]
fn a_doubt_starts_from_the_learners_own_words() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &["itself"], &[], &["area"]);
    let said = words(&s);
    assert!(said.contains(ASK) && !said.contains(HINT), "{said}");
    send(&mut s, [answer("what do you mean?")]);
    assert!(words(&s).contains("I do not hear it yet. What becomes of the unit?"));
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &[], &[], &["itself"]);
    assert!(words(&s).contains("You say “some words”. Which number is it"));
    // Where something is right already, that is said first.
    let mut s = at_question();
    send(&mut s, [answer(ANSWER)]);
    let said = words(&s);
    assert!(
        said.contains("You say “") && said.contains("and that is right. What if"),
        "{said}"
    );
}

#[test]
fn what_stays_in_doubt_is_put_to_the_learner_as_a_checklist() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &["itself", "area"], &[], &["doubling"]);
    assert!(words(&s).contains("What does it make of three?"));
    send(&mut s, [Msg::Hint]);
    assert_eq!(verdicts(&s)[1..], ["The answer", "I cannot tell"]);
    assert_eq!(input(&s), "checklist");
    assert_eq!(s.screen().skip_label, "leave it open");
    let no = Msg::Mark {
        point: 0,
        said: false,
    };
    send(&mut s, [no, Msg::ChecklistDone]);
    assert_eq!(verdicts(&s).last(), Some(&"By your own marking: yes"));
    // A part that is missing makes marking the rest pointless.
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &[], &[], &["area"]);
    send(&mut s, [Msg::Skip]);
    assert_eq!(input(&s), "none");
    assert!(
        verdicts(&s).contains(&"Not all of it yet"),
        "{:?}",
        verdicts(&s)
    );
}

#[test]
fn a_later_denial_overrides() {
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &["itself", "area"], &[], &["doubling"]);
    let saved = send(&mut s, [answer("It doubles the number.")]);
    assert!(
        matches!(&saved[..], [Event::Replied { misconceptions, verdict, .. }]
            if misconceptions == &["doubling"] && verdict == "partial"),
        "{saved:#?}"
    );
    let mut s = at_question();
    hear(&mut s, 1, "unsure", &["itself", "area"], &[], &["doubling"]);
    let saved = send(&mut s, [answer("It does not double the number.")]);
    assert!(
        matches!(&saved[..], [Event::Replied { unsure, verdict, .. }]
            if unsure.is_empty() && verdict == "pass"),
        "{saved:#?}"
    );
}

#[test]
fn a_reply_is_kept_with_its_question_and_marked() {
    let mut s = at_question();
    send(&mut s, [answer(ANSWER)]);
    let saved = send(&mut s, [answer("so a length becomes an area, I think")]);
    let [
        Event::Replied {
            about,
            asked,
            text,
            why,
            judge,
            ..
        },
    ] = &saved[..]
    else {
        panic!("{saved:#?}");
    };
    assert_eq!(about, "area");
    assert!(asked.ends_with(ASK), "{asked}");
    assert_eq!(judge, crate::judge::JUDGE_VERSION);
    let [quote] = &why[..] else { panic!("{why:?}") };
    assert_eq!(&text[quote.start..quote.end], quote.quote);
    let marked = s.screen().blocks.iter().any(|block| {
        matches!(block, Block::Quoted { text: shown, marks } if shown == text
            && marks == &[(quote.start, quote.end, Tone::Good)])
    });
    assert!(marked, "{:#?}", s.screen().blocks);
    assert_eq!(
        s.outcome()
            .items
            .iter()
            .find(|it| it.item == "small/explain")
            .map(|it| it.standing),
        Some(Standing::Asked)
    );
}

#[test]
fn an_empty_reply_is_none_and_a_draft_of_one_waits() {
    let mut s = at_question();
    send(&mut s, [answer(ANSWER)]);
    assert_eq!(send(&mut s, [answer(" "), Msg::Next]), []);
    assert!(s.screen().note.is_some());
    send(&mut s, [Msg::Draft("a length bec".into())]);
    let Input::Reply { draft, .. } = &s.screen().input else {
        panic!("{:?}", s.screen().input);
    };
    assert_eq!(draft, "a length bec");
    send(&mut s, [answer("hm")]);
    assert!(matches!(&s.screen().input, Input::Reply { draft, .. } if draft.is_empty()));
}

#[test]
fn the_second_try_remembers_the_replies() {
    let mut s = at_question();
    send(
        &mut s,
        [answer(ANSWER), answer("no idea of that"), Msg::Skip],
    );
    walk_to(&mut s, "explain:small/explain:2");
    assert!(words(&s).contains("no idea of that"));
}
