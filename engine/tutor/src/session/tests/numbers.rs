//! Exercises: answers, slips carried forward, hints, fresh numbers.

use super::*;

/// The true value of a step of the exercise shown, as one would type it.
#[track_caller]
fn truth(s: &Session, step: &str) -> f64 {
    let problem = s.problem(s.here()).expect("an exercise is shown");
    let draw = problem.draw().expect("it has numbers");
    let step = draw.steps.iter().find(|truth| truth.name == step);
    step.expect("it has that step").truth
}

fn given(s: &Session) -> f64 {
    s.problem(s.here()).expect("an exercise is shown").given()["x"]
}

fn at(key: &str) -> Session {
    let mut s = begin();
    walk_to(&mut s, key);
    s
}

fn right(s: &Session, step: &str) -> Msg {
    answer(&truth(s, step).to_string())
}

#[test]
fn steps_are_asked_one_by_one() {
    let mut s = at("practice:small/area");
    let area = right(&s, "area");
    let saved = send(&mut s, [area]);
    assert!(
        matches!(&saved[..], [Event::Attempt { item, step, result, given, .. }]
            if item == "small/area" && step == "area" && result == "correct" && given.contains_key("x")),
        "{saved:#?}"
    );
    assert_eq!(verdicts(&s), ["Correct"]);
    assert_eq!(input(&s), "number");
    let msg = right(&s, "volume");
    send(&mut s, [msg]);
    assert_eq!(verdicts(&s), ["Correct", "Correct"]);
    assert_eq!(input(&s), "none");
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "practice:small/which");
}

#[test]
fn a_named_mistake_is_named_and_an_earlier_slip_is_carried() {
    let mut s = at("practice:small/area");
    let doubled = 2.0 * given(&s);
    let saved = send(&mut s, [answer(&doubled.to_string())]);
    assert!(
        matches!(&saved[..], [Event::Attempt { result, mistake: Some(mistake), named: true, .. }]
            if result == "mistake" && mistake == "doubled"),
        "{saved:#?}"
    );
    assert!(words(&s).contains("You doubled instead of squaring."));
    assert_eq!(s.screen().next_label, "leave it and go on");
    // On with the wrong area: the volume that follows from it is right.
    send(&mut s, [Msg::Next]);
    let carried = doubled * given(&s);
    let saved = send(&mut s, [answer(&carried.to_string())]);
    assert!(
        matches!(&saved[..], [Event::Attempt { result, .. }] if result == "carried"),
        "{saved:#?}"
    );
    assert!(words(&s).contains("The whole way"));
    let outcome = s.outcome();
    assert_eq!(outcome.items[0].standing, Standing::Retried);
    assert_eq!(outcome.slips[0].id, "doubled");
}

#[test]
fn invalid_input_costs_nothing() {
    let mut s = at("practice:small/area");
    send(&mut s, [answer("sq(3)"), answer("?")]);
    assert_eq!(verdicts(&s), ["Not counted", "Not counted"]);
    assert!(!s.screen().can.next, "nothing was answered yet");
    let msgs = [right(&s, "area")];
    send(&mut s, msgs);
    let msgs = [right(&s, "volume")];
    send(&mut s, msgs);
    assert_eq!(s.outcome().items[0].standing, Standing::Right);
}

#[test]
fn an_empty_line_after_a_wrong_answer_goes_on() {
    let mut s = at("practice:small/area");
    assert_eq!(send(&mut s, [answer("")]), []);
    let saved = send(&mut s, [answer("123456"), answer(" ")]);
    assert!(
        matches!(&saved[..], [Event::Attempt { .. }, Event::GoOn { step, .. }] if step == "area")
    );
}

#[test]
fn hints_come_in_three_levels_and_the_last_lets_on() {
    let mut s = at("practice:small/area");
    for level in 1..=3 {
        assert_eq!(s.screen().can.hint, Some(level));
        send(&mut s, [Msg::Hint]);
    }
    assert_eq!(s.screen().can.hint, None);
    assert_eq!(verdicts(&s), ["A nudge", "A bigger hint", "The answer"]);
    assert!(words(&s).contains("Side times side."));
    send(&mut s, [Msg::Next]);
    let volume = right(&s, "volume");
    let saved = send(&mut s, [volume]);
    assert!(
        matches!(&saved[..], [Event::Attempt { result, .. }] if result == "correct"),
        "after the answer was shown, the next step follows from the truth: {saved:#?}"
    );
}

#[test]
fn the_faded_example_asks_more_each_round() {
    let mut s = at("faded:1");
    assert!(
        words(&s).contains("area ="),
        "the first line is done: {}",
        words(&s)
    );
    let volume = right(&s, "volume");
    send(&mut s, [volume]);
    assert_eq!(s.screen().next_label, "on");
    let first = given(&s);
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "faded:2");
    assert_ne!(given(&s), first, "other numbers");
    let area = right(&s, "area");
    send(&mut s, [area]);
    assert_eq!(input(&s), "number");
}

#[test]
fn the_retest_has_fresh_numbers() {
    let mut s = at("practice:small/area");
    let first = given(&s);
    walk_to(&mut s, "retest:small/area");
    assert_ne!(given(&s), first);
}

#[test]
fn choices_and_orders_are_answered_by_what_is_shown() {
    let mut s = at("practice:small/which");
    assert_eq!(input(&s), "choice");
    send(&mut s, [answer("z")]);
    assert_eq!(verdicts(&s), ["Not counted"]);
    let options = match &s.screen().input {
        Input::Choice { options } => options.clone(),
        other => panic!("{other:?}"),
    };
    let wrong = options
        .iter()
        .position(|o| o == "twice a number")
        .expect("shown");
    let right = options
        .iter()
        .position(|o| o == "a number times itself")
        .expect("shown");
    let letter = |place: usize| ["a", "b"][place];
    send(&mut s, [answer(letter(wrong))]);
    assert!(words(&s).contains("twice a number"));
    assert!(words(&s).contains("That is doubling."));
    send(&mut s, [answer(letter(right))]);
    assert_eq!(verdicts(&s).last(), Some(&"Correct"));
    send(&mut s, [Msg::Next]);
    assert_eq!(input(&s), "order");
    let items = match &s.screen().input {
        Input::Order { items } => items.clone(),
        other => panic!("{other:?}"),
    };
    let place = |item: &str| items.iter().position(|i| i == item).expect("shown") + 1;
    let order = ["a point", "a line", "an area"].map(|item| place(item).to_string());
    send(&mut s, [answer(&order.join(" "))]);
    assert_eq!(verdicts(&s), ["Correct"]);
    assert!(words(&s).contains("a point → a line → an area"));
    send(&mut s, [Msg::Next]);
    assert_eq!(s.screen().key, "practice:small/slip");
}

#[test]
fn the_mistake_is_found_and_mended() {
    let mut s = at("practice:small/slip");
    assert!(
        words(&s).contains("area"),
        "the lines are shown: {}",
        words(&s)
    );
    send(&mut s, [answer("2")]);
    assert_eq!(verdicts(&s), ["Not yet"]);
    send(&mut s, [answer("1")]);
    assert_eq!(verdicts(&s), ["Not yet", "Correct"]);
    send(&mut s, [answer("27")]);
    assert_eq!(verdicts(&s).last(), Some(&"Correct"));
    assert_eq!(input(&s), "none");
}

/// The whole lesson, everything right but what `miss` says, and the result in words.
#[track_caller]
fn ends(miss_first_try: bool, words_then: &str) {
    let mut s = begin();
    for _ in 0..80 {
        let key = s.screen().key.clone();
        let msg = match input(&s) {
            "none" if key == "result" => break,
            "none" => Msg::Next,
            "number" => {
                let problem = s.problem(s.here()).expect("an exercise");
                let step = problem.current().expect("open").to_owned();
                right(&s, &step)
            }
            "text" if miss_first_try && key == "explain:small/explain:1" => answer("Hm."),
            "text" if key.starts_with("explain:small/retest") => {
                answer("It multiplies the number by itself twice.")
            }
            "text" => answer("It multiplies the number by itself. A length becomes an area."),
            "checklist" => {
                let mark = |point| Msg::Mark { point, said: false };
                send(&mut s, [mark(0), mark(1), mark(2)]);
                Msg::ChecklistDone
            }
            _ => Msg::Skip,
        };
        send(&mut s, [msg]);
    }
    let outcome = s.outcome();
    assert_eq!(
        (outcome.grade, outcome.words.as_str()),
        (Some(Grade::Pass), words_then)
    );
    assert!(words(&s).contains(words_then));
}

#[test]
fn a_whole_lesson_ends_in_a_teachers_words() {
    ends(false, "PASS at the first try");
    ends(
        true,
        "PASS on retry, after the tiles re-teach and the units re-teach",
    );
}

/// What stands in the field.
fn draft(s: &Session) -> &str {
    match &s.screen().input {
        Input::Number { draft, .. } => draft,
        other => panic!("no number is asked for: {other:?}"),
    }
}

#[test]
fn a_number_half_typed_is_kept_until_it_is_answered() {
    for key in ["faded:2", "practice:small/area", "retest:small/area"] {
        let mut s = at(key);
        let mut saved = Vec::new();
        // Only what was done from here on is looked at: the way here is replayed as it was.
        let mut begun = begin();
        for _ in 0..60 {
            if begun.screen().key == key {
                break;
            }
            let msg = if begun.screen().can.next {
                Msg::Next
            } else {
                Msg::Skip
            };
            saved.extend(send(&mut begun, [msg]));
        }
        let typed = send(&mut s, [Msg::Draft("0.4^".into())]);
        assert!(matches!(&typed[..], [Event::Draft { text, .. }] if text == "0.4^"));
        assert_eq!(send(&mut s, [Msg::Draft("0.4^".into())]), [], "once");
        saved.extend(typed);
        let (mut again, changed) = Session::resume(small(), s.start.clone(), &small().hash, &saved);
        assert_eq!(changed, None);
        assert_eq!((again.screen().key.as_str(), draft(&again)), (key, "0.4^"));
        send(&mut again, [Msg::Hint]);
        assert_eq!(draft(&again), "0.4^", "a hint leaves it");
        send(&mut again, [answer("1")]);
        assert_eq!(draft(&again), "", "an answer takes its place");
    }
}
