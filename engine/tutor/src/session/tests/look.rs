//! A place is pointed at, looked at elsewhere, and marked when what is seen comes back.

use super::*;
use crate::exercise::look::{Sight, Spot};

fn sight(stops: f64) -> Sight {
    let spot = |stops: f64| Spot {
        x: 0.0,
        y: 0.0,
        n_dot_l: 0.5,
        n_dot_v: 0.5,
        ratio: stops.exp2(),
        stops,
    };
    Sight {
        here: Some(spot(stops)),
        brightest: None,
        darkest: Some(spot(-4.0)),
    }
}

/// Points at a place; where was looked, and what was kept.
fn point(session: &mut Session, text: &str) -> (Option<(f64, f64)>, Vec<Event>) {
    let (mut looked, mut saved) = (None, Vec::new());
    for effect in session.update(answer(text)) {
        match effect {
            Effect::Save(event) => saved.push(event),
            Effect::Look { picture, x, y } => {
                assert_eq!(picture, "squared");
                looked = Some((x, y));
            }
            _ => {}
        }
    }
    (looked, saved)
}

#[track_caller]
fn result(events: &[Event]) -> &str {
    match events {
        [Event::Attempt { result, .. }, ..] => result,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_place_is_marked_by_what_is_seen_there() {
    let mut session = begin_lit("practice:lit/where");
    assert!(matches!(
        &session.screen().input,
        Input::Place { picture, at: None } if picture == "squared"
    ));
    let (looked, saved) = point(&mut session, "-0.5 0.25");
    assert_eq!((looked, saved), (Some((-0.5, 0.25)), Vec::new()));
    let events = send(&mut session, [Msg::Looked(sight(-0.5))]);
    assert_eq!(result(&events), "wrong");
    assert!(matches!(
        session.screen().input,
        Input::Place { at: Some((x, _)), .. } if x == -0.5
    ));
    let _ = point(&mut session, "left");
    let events = send(&mut session, [Msg::Looked(sight(-3.0))]);
    assert_eq!(result(&events), "correct");
    let shown = format!("{:?}", session.screen().blocks);
    assert!(
        shown.contains("Picture") && shown.contains("0.97 to the left"),
        "{shown}"
    );
}

#[test]
fn what_is_no_place_costs_nothing_and_looks_nowhere() {
    let mut session = begin_lit("practice:lit/where");
    for typed in ["over there", "2 2", "0.3"] {
        let (looked, saved) = point(&mut session, typed);
        assert_eq!(looked, None, "{typed}");
        assert_eq!(result(&saved), "invalid");
    }
    // Nobody asked: nothing happens.
    assert_eq!(send(&mut session, [Msg::Looked(sight(-4.0))]), []);
}

#[test]
fn replaying_looks_nowhere() {
    let mut session = begin_lit("practice:lit/where");
    let _ = point(&mut session, "top");
    let mut log = send(&mut session, [Msg::Looked(sight(-4.0))]);
    log.insert(
        0,
        Event::Next {
            stage: session.screen().stage,
            screen: "practice:lit/where".to_owned(),
        },
    );
    let lesson = Arc::clone(session.lesson());
    let hash = lesson.hash.clone();
    let (resumed, changed) = Session::resume(lesson, Start::default(), &hash, &log);
    assert_eq!(changed, None);
    assert_eq!(resumed.screen().blocks, session.screen().blocks);
}
