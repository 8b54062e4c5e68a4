//! The program's own lessons, played from the first screen to the result.

use std::path::Path;
use std::sync::Arc;
use tutor::Lesson;
use tutor::exercise::look::{Sight, Spot};
use tutor::exercise::shader::{Job, Ran};
use tutor::exercise::{Truth, draw};
use tutor::judge::Verdict;
use tutor::lesson::{Shows, Task};
use tutor::prose::Block;
use tutor::session::{Effect, Event, Grade, Msg, Outcome, Session, Start};
use tutor::view::{Input, View};

fn lessons() -> Vec<Arc<Lesson>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../lessons");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("the lessons are there")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|it| it == "toml"))
        .collect();
    files.sort();
    let load = |path: &std::path::PathBuf| {
        let text = std::fs::read_to_string(path).expect("readable");
        let (lesson, findings) = tutor::load(&path.to_string_lossy(), &text);
        Arc::new(lesson.unwrap_or_else(|| panic!("{}: {findings:#?}", path.display())))
    };
    files.iter().map(load).collect()
}

/// The right answer to what is asked; the seed of the exercise comes from its hints' event.
fn right_answer(lesson: &Lesson, session: &Session) -> Msg {
    let view = session.screen();
    let mut parts = view.key.splitn(2, ':');
    let (kind, rest) = (
        parts.next().unwrap_or_default(),
        parts.next().unwrap_or_default(),
    );
    if kind == "explain" {
        let item = rest.rsplit_once(':').map_or(rest, |(item, _)| item);
        let explain = lesson.explain(item).expect("the question is there");
        let examples = explain
            .rubric
            .example
            .iter()
            .filter(|it| it.verdict == "pass");
        let passes = |text: &&str| explain.judge.judge(text).verdict == Verdict::Pass;
        let text = std::iter::once(explain.model_answer.text.as_str())
            .chain(examples.map(|example| example.text.as_str()))
            .find(passes);
        return Msg::Answer(text.expect("an answer that passes").to_owned());
    }
    // A hint says which step and round; a copy of the session asks for it, so it costs nothing.
    let hint = session
        .clone()
        .update(Msg::Hint)
        .into_iter()
        .find_map(|effect| match effect {
            Effect::Save(Event::Hint { item, step, .. }) => Some((item, step)),
            _ => None,
        });
    let (item, step) = hint.expect("an exercise gives hints");
    let exercise = lesson.exercise(&item).expect("the exercise is there");
    match &exercise.task {
        Task::Shader(task) => return Msg::Answer(task.solution.text.clone()),
        Task::Look(_) => return Msg::Answer("0 0".to_owned()),
        _ => {}
    }
    // An answer that is no number says the seed, and costs nothing either.
    let seed = session
        .clone()
        .update(Msg::Answer("?".into()))
        .into_iter()
        .find_map(|effect| match effect {
            Effect::Save(Event::Attempt { seed, .. }) => Some(seed),
            _ => None,
        });
    let drawn = draw(lesson, exercise, seed.expect("attempts keep the seed")).expect("has numbers");
    let text = match (&drawn.truth, drawn.steps.iter().find(|it| it.name == step)) {
        (_, Some(step)) => step.truth.to_string(),
        (Truth::Number(value), None) => value.to_string(),
        (Truth::Choice(place), None) => (place + 1).to_string(),
        (Truth::Order(places), None) => {
            let numbers: Vec<String> = places.iter().map(|place| (place + 1).to_string()).collect();
            numbers.join(" ")
        }
    };
    Msg::Answer(text)
}

/// What the right function computes at the job's points.
fn computed(lesson: &Lesson, job: &Job) -> Ran {
    let task = lesson.exercises.iter().find_map(|it| match &it.task {
        Task::Shader(task) if task.function.text == job.function => Some(task),
        _ => None,
    });
    let right = &task.expect("the shader of the job").is.expr;
    let value = |point: &Vec<f32>| {
        let inputs = job.params.iter().cloned();
        let inputs = inputs.zip(point.iter().map(|value| f64::from(*value)));
        lesson
            .library
            .eval(right, &inputs.collect())
            .expect("a value") as f32
    };
    Ran::Values(job.points.iter().map(value).collect())
}

/// A place than which there is no better one for what is asked of a picture.
fn best(lesson: &Lesson, picture: &str) -> Sight {
    let shows = lesson.exercises.iter().find_map(|it| match &it.task {
        Task::Look(task) if task.picture.text == picture => Some(task.shows),
        _ => None,
    });
    let stops: f64 = if shows == Some(Shows::Darker) {
        -1.0
    } else {
        1.0
    };
    let spot = Spot {
        x: 0.0,
        y: 0.0,
        n_dot_l: 0.5,
        n_dot_v: 0.5,
        ratio: stops.exp2(),
        stops,
    };
    Sight {
        here: Some(spot),
        brightest: (stops > 0.0).then_some(spot),
        darkest: (stops < 0.0).then_some(spot),
    }
}

/// Plays to the result; `missing` first answers to questions say nothing.
fn play(lesson: &Arc<Lesson>, seed: u64, mut missing: usize) -> (Outcome, View, Vec<Event>) {
    let start = Start {
        seed,
        slips: Vec::new(),
    };
    let mut session = Session::new(Arc::clone(lesson), start);
    let mut log = Vec::new();
    for _ in 0..500 {
        let view = session.screen();
        let msg = match &view.input {
            Input::None if view.key == "result" => break,
            Input::None => Msg::Next,
            Input::Text { .. } if missing > 0 => {
                missing -= 1;
                Msg::Answer("I have no idea, sorry.".into())
            }
            Input::Checklist { points } => match points.iter().position(|it| it.said.is_none()) {
                Some(point) => Msg::Mark { point, said: false },
                None => Msg::ChecklistDone,
            },
            _ => right_answer(lesson, &session),
        };
        let mut effects = session.update(msg);
        while let Some(effect) = (!effects.is_empty()).then(|| effects.remove(0)) {
            match effect {
                Effect::Save(event) => log.push(event),
                Effect::Run(job) => {
                    effects.extend(session.update(Msg::Ran(computed(lesson, &job))))
                }
                Effect::Look { picture, .. } => {
                    effects.extend(session.update(Msg::Looked(best(lesson, &picture))));
                }
                _ => {}
            }
        }
    }
    (session.outcome(), session.view(), log)
}

#[test]
fn right_answers_pass_at_the_first_try() {
    for lesson in lessons() {
        for seed in [0, 7, 1_000_003] {
            let (outcome, _, log) = play(&lesson, seed, 0);
            let wrong: Vec<&Event> = log
                .iter()
                .filter(|event| match event {
                    Event::Attempt { result, .. } => result != "correct",
                    Event::Explained { verdict, .. } => verdict != "pass",
                    _ => false,
                })
                .collect();
            assert!(wrong.is_empty(), "{}, seed {seed}: {wrong:#?}", lesson.id);
            assert_eq!(
                outcome.words, "PASS at the first try",
                "{}, seed {seed}",
                lesson.id
            );
        }
    }
}

#[test]
fn an_empty_explanation_leads_to_a_reteach_and_a_second_try() {
    for lesson in lessons() {
        let (outcome, view, log) = play(&lesson, 7, 1);
        assert_eq!(
            outcome.grade,
            Some(Grade::Pass),
            "{}: {outcome:#?}",
            lesson.id
        );
        assert!(
            outcome.words.starts_with("PASS on retry, after "),
            "{}: {}",
            lesson.id,
            outcome.words
        );
        assert!(log.iter().any(
            |event| matches!(event, Event::Next { screen, .. } if screen.starts_with("reteach:"))
        ));
        let says = view
            .blocks
            .iter()
            .any(|block| matches!(block, Block::Verdict { title, .. } if *title == outcome.words));
        assert!(says, "the result page says how it ended");
        let again = Session::resume(
            Arc::clone(&lesson),
            Start {
                seed: 7,
                slips: Vec::new(),
            },
            &lesson.hash,
            &log,
        );
        assert_eq!(again.1, None);
        assert_eq!(again.0.screen().blocks, view.blocks);
    }
}
