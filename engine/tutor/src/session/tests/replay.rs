//! A session is its events: nothing is lost by leaving, and no message or event panics.

use super::{any, small};
use crate::record::Record;
use crate::session::{Effect, Event, Msg, Session, Start, transcript};
use crate::view::{Saving, View};
use proptest::prelude::*;

/// What is on the screen, without what passes with the next key.
fn lasting(session: &Session) -> View {
    View {
        note: None,
        saving: Saving::Nothing,
        ..session.view()
    }
}

fn send(session: &mut Session, log: &mut Vec<Event>, msg: Msg) {
    for effect in session.update(msg) {
        match effect {
            Effect::Save(event) => log.push(event),
            Effect::Draw { .. }
            | Effect::Consult { .. }
            | Effect::StopConsulting
            | Effect::Run(_)
            | Effect::Quit
            | Effect::Look { .. } => {}
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn leaving_at_any_moment_comes_back_to_the_same_screen(
        seed in any::<u64>(),
        msgs in prop::collection::vec(any::msg(), 1..50),
    ) {
        let lesson = small();
        let start = Start { seed, slips: Vec::new() };
        let mut session = Session::new(lesson.clone(), start.clone());
        let mut log = Vec::new();
        let mut before = lasting(&session);
        for msg in msgs {
            send(&mut session, &mut log, msg);
            let now = lasting(&session);
            let (resumed, notice) =
                Session::resume(lesson.clone(), start.clone(), &lesson.hash, &log);
            prop_assert_eq!(&lasting(&resumed), &now);
            prop_assert_eq!(resumed.outcome(), session.outcome());
            prop_assert_eq!(notice, None);
            if before.key == now.key {
                prop_assert!(
                    now.blocks.starts_with(&before.blocks),
                    "a screen only grows: {:#?}\n{:#?}", before.blocks, now.blocks
                );
            }
            before = now;
        }
    }

    #[test]
    fn no_log_panics(events in prop::collection::vec(any::event(), 0..30), msgs in prop::collection::vec(any::msg(), 0..10)) {
        let lesson = small();
        let (mut session, _) = Session::resume(lesson.clone(), Start::default(), "then", &events);
        let mut log = events;
        for msg in msgs {
            send(&mut session, &mut log, msg);
        }
        let _ = session.outcome();
        let mut record = Record::new("0", "small", "then", "2026-11-22T10:00:00Z", &Start::default());
        for event in log {
            record.push("2026-11-22T10:00:01Z", 5, event);
        }
        let _ = transcript::transcript(&lesson, Some(&record));
        let again = Record::from_toml(&record.to_toml());
        prop_assert_eq!(again, Ok(record));
    }

    #[test]
    fn a_changed_lesson_starts_the_stage_again_and_stays_there(
        msgs in prop::collection::vec(any::msg(), 1..40),
        more in prop::collection::vec(any::msg(), 1..20),
    ) {
        let lesson = small();
        let mut session = Session::new(lesson.clone(), Start::default());
        let mut log = Vec::new();
        for msg in msgs {
            send(&mut session, &mut log, msg);
        }
        let stage = session.here().base_stage(&lesson);
        let (mut session, notice) =
            Session::resume(lesson.clone(), Start::default(), "another hash", &log);
        prop_assert!(notice.is_some_and(|says| says.contains("changed")));
        prop_assert_eq!(session.view().stage, stage);
        prop_assert_eq!(session.view().place.0, 1);
        for msg in more {
            send(&mut session, &mut log, msg);
            let (resumed, notice) =
                Session::resume(lesson.clone(), Start::default(), "another hash", &log);
            prop_assert_eq!(lasting(&resumed), lasting(&session));
            prop_assert_eq!(notice, None);
        }
    }
}
