//! A shader is handed in, runs elsewhere, and is marked when it comes back; replaying runs none.

use super::*;
use crate::exercise::shader::{CodePlace, Job, Ran};

/// Hands a text in; what is to be saved and run.
#[track_caller]
fn hand_in(session: &mut Session, text: &str) -> (Vec<Event>, Job) {
    let mut saved = Vec::new();
    let mut job = None;
    for effect in session.update(answer(text)) {
        match effect {
            Effect::Save(event) => saved.push(event),
            Effect::Run(run) => job = Some(*run),
            _ => {}
        }
    }
    (saved, job.expect("something to run"))
}

/// What a function of cosine and albedo computes at the job's points.
fn values(job: &Job, of: impl Fn(f32, f32) -> f32) -> Ran {
    Ran::Values(
        job.points
            .iter()
            .map(|point| of(point[0], point[1]))
            .collect(),
    )
}

/// The only attempt among some events: result, mistake, what was said.
#[track_caller]
fn attempt(events: &[Event]) -> (&str, Option<&str>, &str) {
    match events {
        [
            Event::Attempt {
                result,
                mistake,
                says,
                ..
            },
        ] => (result, mistake.as_deref(), says),
        other => panic!("{other:?}"),
    }
}

const TEXT: &str = "fn lit(n_dot_l: f32, albedo: f32) -> f32 {\n    return albedo;\n}";

#[test]
fn the_text_is_kept_before_it_runs() {
    let mut session = begin_lit("practice:lit/mend");
    let Input::Code { text, .. } = &session.screen().input else {
        panic!("{:?}", session.screen().input);
    };
    assert!(text.starts_with("fn lit(") && text.contains("n_dot_l * n_dot_l"));
    let (saved, job) = hand_in(&mut session, TEXT);
    assert!(
        matches!(&saved[..], [Event::Draft { item, text }] if item == "lit/mend" && text == TEXT),
        "{saved:?}"
    );
    assert_eq!((job.function.as_str(), job.source.as_str()), ("lit", TEXT));
    assert_eq!(job.params, ["n_dot_l", "albedo"]);
    assert!(job.points.len() >= 64 && job.points.iter().all(|point| point.len() == 2));
    // Nothing is said before it comes back, and nothing runs twice at once.
    assert!(verdicts(&session).is_empty());
    assert_eq!(send(&mut session, [answer("fn other() {}")]), []);
    assert!(
        session
            .screen()
            .note
            .as_deref()
            .is_some_and(|note| note.contains("still running"))
    );
}

#[test]
fn what_it_computed_is_compared_with_the_right_and_the_known_wrong() {
    type Row<'a> = (
        &'a dyn Fn(f32, f32) -> f32,
        &'a str,
        Option<&'a str>,
        &'a str,
    );
    let rows: [Row<'_>; 9] = [
        (&|c, a| a * c, "correct", None, "Correct."),
        (&|c, a| a * c * 1.005, "correct", None, "Correct."),
        (
            &|c, a| a * c * c,
            "mistake",
            Some("squared"),
            "The cosine is there twice.",
        ),
        (&|c, a| -a * c, "wrong", None, "the sign is not"),
        (
            &|c, a| 4.0 * a * c,
            "wrong",
            None,
            "off by a factor 4 everywhere",
        ),
        (
            &|c, a| a * c / std::f32::consts::PI,
            "wrong",
            None,
            "off by a factor π everywhere",
        ),
        (
            &|c, a| 7.0 * a * c,
            "wrong",
            None,
            "7.000 times what is right, everywhere",
        ),
        (
            &|c, a| if c < 0.15 { f32::NAN } else { a * c },
            "wrong",
            None,
            "is not a number (NaN",
        ),
        (
            &|c, a| a / (c - c),
            "wrong",
            None,
            "is infinite (a division by zero?)",
        ),
    ];
    for (of, result, mistake, says) in rows {
        let mut session = begin_lit("practice:lit/mend");
        let (_, job) = hand_in(&mut session, TEXT);
        let events = send(&mut session, [Msg::Ran(values(&job, of))]);
        let found = attempt(&events);
        assert_eq!((found.0, found.1), (result, mistake), "{}", found.2);
        assert!(found.2.contains(says), "{says:?} is not in {:?}", found.2);
    }
}

#[test]
fn the_worst_point_is_told() {
    let mut session = begin_lit("practice:lit/mend");
    let (_, job) = hand_in(&mut session, TEXT);
    let of = |c: f32, a: f32| if c < 0.15 && a > 0.85 { 9.0 } else { a * c };
    let events = send(&mut session, [Msg::Ran(values(&job, of))]);
    let says = attempt(&events).2;
    assert!(
        says.contains(
            "At `n_dot_l = 0.1, albedo = 0.9` it should give 0.09000, and gives 9.000, 100 times as much."
        ),
        "{says}"
    );
}

#[test]
fn what_is_no_shader_counts_for_nothing_and_what_never_ends_does() {
    let mut session = begin_lit("practice:lit/mend");
    let _ = hand_in(&mut session, TEXT);
    let refused = Ran::Refused {
        says: "A `;` is missing.".to_owned(),
        help: Some("Put one.".to_owned()),
        place: Some(CodePlace {
            line: 12,
            column: 5,
            width: 3,
            text: "let {{ x }}".to_owned(),
            mark: 5,
        }),
    };
    let events = send(&mut session, [Msg::Ran(refused)]);
    let (result, _, says) = attempt(&events);
    assert_eq!(result, "invalid");
    let expected = "Line 12, column 5: A `;` is missing. Put one.\n\n~~~~~~~~~~\n12 | let {{ x }}\n         ^^^\n~~~~~~~~~~";
    assert_eq!(says, expected);
    // Braces of the learner's are no templates.
    let shown = words(&session);
    assert!(shown.contains("12 | let {{ x }}"), "{shown}");
    assert!(!session.screen().can.next, "nothing counted yet");

    let (_, _) = hand_in(&mut session, TEXT);
    let stopped = Ran::Stopped {
        point: Some(0),
        says: "It never ends.".to_owned(),
    };
    let events = send(&mut session, [Msg::Ran(stopped)]);
    let (result, _, says) = attempt(&events);
    assert_eq!(result, "wrong");
    assert!(
        says.starts_with("Not yet. It never ends. It was run at `n_dot_l = "),
        "{says}"
    );
    assert!(session.screen().can.next, "now it may be left");

    let _ = hand_in(&mut session, TEXT);
    let events = send(
        &mut session,
        [Msg::Ran(Ran::Unable("no process".to_owned()))],
    );
    assert_eq!(attempt(&events).0, "invalid");
}

#[test]
fn resuming_runs_nothing_and_shows_the_same() {
    let mut session = begin_lit("practice:lit/mend");
    let start = Start::default();
    let mut events = Vec::new();
    let mut recorded = Session::new(Arc::clone(session.lesson()), start.clone());
    for _ in 0..60 {
        if recorded.screen().key == "practice:lit/mend" {
            break;
        }
        let msg = if recorded.screen().can.next {
            Msg::Next
        } else {
            Msg::Skip
        };
        events.extend(send(&mut recorded, [msg]));
    }
    for of in [|c: f32, a: f32| a * c * c, |c: f32, a: f32| a * c] {
        let (saved, job) = hand_in(&mut recorded, &format!("{TEXT}{}", events.len()));
        events.extend(saved);
        let ran = values(&job, of);
        events.extend(send(&mut recorded, [Msg::Ran(ran)]));
    }
    let hash = recorded.lesson().hash.clone();
    let (resumed, notice) = Session::resume(Arc::clone(recorded.lesson()), start, &hash, &events);
    assert_eq!(notice, None);
    assert_eq!(resumed.screen().blocks, recorded.screen().blocks);
    assert_eq!(verdicts(&resumed), ["A known mistake", "Correct"]);
    let pictures = resumed.screen().blocks.iter();
    let own = pictures.filter(|block| matches!(block, Block::Picture { own: Some(_), .. }));
    assert_eq!(own.count(), 2, "each run has its ball");

    // Left while it ran: the text is there again.
    let (saved, _) = hand_in(&mut session, TEXT);
    let mut before: Vec<Event> = events
        .iter()
        .take_while(|event| !matches!(event, Event::Draft { .. }))
        .cloned()
        .collect();
    before.extend(saved);
    let (resumed, _) = Session::resume(
        Arc::clone(session.lesson()),
        Start::default(),
        &hash,
        &before,
    );
    assert!(
        matches!(&resumed.screen().input, Input::Code { text, .. } if text == TEXT),
        "{:?}",
        resumed.screen().input
    );
}

#[test]
fn hints_end_with_the_solution() {
    let mut session = begin_lit("practice:lit/mend");
    send(&mut session, [Msg::Hint, Msg::Hint, Msg::Hint]);
    let shown = words(&session);
    assert!(
        shown.contains("There are two of it.") && shown.contains("return albedo * n_dot_l; }"),
        "{shown}"
    );
}

#[test]
fn what_comes_back_without_having_been_asked_for_is_nothing() {
    let mut session = begin_lit("practice:lit/mend");
    assert_eq!(send(&mut session, [Msg::Ran(Ran::Values(vec![1.0]))]), []);
}
