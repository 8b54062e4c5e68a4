//! Exercises: draws that tell mistakes apart, and every kind of marking.

use std::collections::BTreeMap;

use tutor::Lesson;
use tutor::exercise::{Draw, Marking, Truth, draw, hint, mark, tolerance_words};
use tutor::lesson::Exercise;

fn lesson() -> Lesson {
    let text = include_str!("fixtures/complete.toml");
    tutor::load("complete.toml", text).0.expect("a lesson")
}

fn drawn(lesson: &Lesson, id: &str, seed: u64) -> Draw {
    let exercise = lesson.exercise(id).expect("the exercise");
    draw(lesson, exercise, seed).expect("numbers")
}

fn apart(a: f64, b: f64, rel: f64) -> bool {
    (a - b).abs() > rel * (a.abs() + b.abs())
}

/// The fixture and the lessons that the program ships with.
fn lessons() -> Vec<Lesson> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../lessons");
    let files = std::fs::read_dir(folder).expect("the lessons");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    let texts = paths
        .iter()
        .map(|path| std::fs::read_to_string(path).expect("text"));
    let shipped = texts.map(|text| tutor::load("lesson.toml", &text).0.expect("a lesson"));
    std::iter::once(lesson()).chain(shipped).collect()
}

/// Every exercise that asks for numbers, the faded worked example included.
fn numeric(lesson: &Lesson) -> impl Iterator<Item = &Exercise> {
    let faded = lesson.worked.as_ref().and_then(|it| it.faded.as_ref());
    let all = lesson.exercises.iter().chain(faded.map(|it| &it.exercise));
    all.filter(|it| matches!(it.kind(), "numeric" | "find-the-mistake"))
}

/// Every exercise of the lessons with its first seeds.
fn cases(lessons: &[Lesson], seeds: u64) -> impl Iterator<Item = (&Lesson, &Exercise, u64)> {
    let exercises = lessons
        .iter()
        .flat_map(|lesson| numeric(lesson).map(move |it| (lesson, it)));
    exercises.flat_map(move |(lesson, it)| (0..seeds).map(move |seed| (lesson, it, seed)))
}

#[test]
fn draws_tell_every_mistake_apart() {
    for (lesson, exercise, seed) in cases(&lessons(), 5) {
        let (id, rel) = (&exercise.id, exercise.tolerance.rel);
        let drawn = drawn(lesson, id, seed);
        let again = draw(lesson, exercise, seed).expect("numbers");
        assert_eq!(drawn, again, "{id} {seed}");
        for step in &drawn.steps {
            let here = || drawn.mistakes.iter().filter(|it| it.step == step.name);
            for (index, mistake) in here().enumerate() {
                assert!(
                    apart(mistake.value, step.truth, rel),
                    "{id} {seed} {mistake:?}"
                );
                for other in here().take(index).filter(|it| it.named) {
                    assert!(
                        apart(mistake.value, other.value, rel),
                        "{id} {seed} {other:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn every_truth_is_right_and_every_mistake_is_met() {
    let none = BTreeMap::new();
    for (lesson, exercise, seed) in cases(&lessons(), 3) {
        let (id, rel) = (&exercise.id, exercise.tolerance.rel);
        let drawn = drawn(lesson, id, seed);
        for step in drawn.steps.iter().filter(|it| it.name != "line") {
            let marked = |value: f64| {
                mark(
                    lesson,
                    exercise,
                    &drawn,
                    Some(&step.name),
                    &format!("{value:e}"),
                    &none,
                )
            };
            for factor in [1.0, 1.0 - rel, 1.0 + rel] {
                let found = marked(step.truth * factor);
                assert_eq!(found, Marking::Correct, "{id} {seed} {step:?} {factor}");
            }
            for factor in [1.0 - 1.01 * rel, 1.0 + 1.01 * rel] {
                let found = marked(step.truth * factor);
                assert_ne!(found, Marking::Correct, "{id} {seed} {step:?} {factor}");
            }
            for mistake in drawn.mistakes.iter().filter(|it| it.step == step.name) {
                match marked(mistake.value) {
                    Marking::Mistake { id, .. } => {
                        assert!(id == mistake.id || !mistake.named, "{id} {mistake:?}");
                    }
                    Marking::Ambiguous { ids, .. } => assert!(ids.contains(&mistake.id)),
                    // 0.5 for 0.51: more likely too few digits than an unnamed mistake.
                    Marking::Precision { .. } => assert!(!mistake.named),
                    other => panic!("{id} {seed} {mistake:?}: {other:?}"),
                }
            }
            let found = mark(
                lesson,
                exercise,
                &drawn,
                Some(&step.name),
                &step.shown,
                &none,
            );
            assert_eq!(found, Marking::Correct, "{id} {seed} {step:?}");
        }
    }
}

/// A draw with the numbers of the worked example: V = 0.5132.
fn at_worked(lesson: &Lesson) -> Draw {
    let exercise = lesson.exercise("fixture/v").expect("the exercise");
    let mut lesson = lesson.clone();
    let mut fixed = exercise.clone();
    for variable in &mut fixed.draw {
        variable.values = match variable.name.text.as_str() {
            "roughness" => vec![0.4],
            "n_dot_v" => vec![0.8],
            _ => vec![0.6],
        };
    }
    // Some mutants are nearer than 1 % here: only a finer draw accepts these numbers.
    fixed.tolerance.rel = 1e-4;
    fixed.keep = Some(9);
    lesson.exercises = vec![fixed];
    draw(&lesson, &lesson.exercises[0], 1).expect("numbers")
}

/// What an answer to V at roughness 0.4, N·V = 0.8, N·L = 0.6 is.
#[track_caller]
fn check(step: Option<&str>, earlier: &[(&str, &str)], answer: &str, result: &str, says: &str) {
    let lesson = lesson();
    let exercise = lesson.exercise("fixture/v").expect("the exercise");
    let drawn = at_worked(&lesson);
    let earlier = earlier
        .iter()
        .map(|(name, text)| ((*name).to_owned(), (*text).to_owned()))
        .collect();
    let found = mark(&lesson, exercise, &drawn, step, answer, &earlier);
    assert_eq!(found.result(), result, "{answer:?}: {found:?}");
    assert!(found.says().contains(says), "{answer:?}: {found:?}");
}

#[test]
fn answers_are_marked_in_order() {
    // Invalid costs nothing.
    check(None, &[], "", "invalid", "Type a number");
    check(None, &[], "abc", "invalid", "Unknown name \"abc\"");
    check(None, &[], "cos 3", "invalid", "");
    check(
        None,
        &[],
        "v_ggx(n_dot_l = 0.6, n_dot_v = 0.8, alpha = 0.16)",
        "invalid",
        "v_ggx(…) would give the answer away; put numbers in and work it out.",
    );
    check(None, &[], "visibility()", "invalid", "");
    check(None, &[], "1/0", "invalid", "");
    check(
        Some("nothing"),
        &[],
        "1",
        "invalid",
        "No step is called `nothing`",
    );
    // Right, also as arithmetic, with the names given, with a decimal comma.
    check(None, &[], "0.5132", "correct", "");
    check(None, &[], "0,5132", "correct", "");
    check(None, &[], "5.132e-1", "correct", "");
    check(Some("alpha"), &[], "0.4^2", "correct", "");
    check(Some("alpha"), &[], "roughness * roughness", "correct", "");
    // As they are printed, and steps before that were left out or given.
    check(Some("alpha"), &[], "r²", "correct", "");
    check(None, &[], "0.5132 + 0 * alpha", "correct", "");
    check(None, &[], "0.5132 * alpha / 0.16", "correct", "");
    check(None, &[], "abc", "invalid", "roughness (r)");
    check(
        None,
        &[],
        "0.5 / (n_dot_l * 0.8057 + n_dot_v * 0.6135)",
        "correct",
        "",
    );
    // Too few digits.
    check(None, &[], "0.5", "precision", "one digit is too few");
    check(
        Some("alpha"),
        &[],
        "0.2",
        "precision",
        "one digit is too few",
    );
    // Right after a slip.
    check(
        Some("v"),
        &[("root_v", "0.9")],
        "0.484",
        "carried",
        "root of N·V",
    );
    check(Some("v"), &[("alpha", "0.4")], "0.4784", "carried", "α");
    check(
        Some("v"),
        &[("root_v", "0.8057"), ("root_l", "0.6135")],
        "0.5132",
        "correct",
        "",
    );
    check(Some("v"), &[("root_v", "nonsense")], "0.7", "wrong", "");
    // Honest with rounded intermediates: each within its tolerance, and what follows from them.
    check(
        Some("v"),
        &[("root_v", "0.798"), ("root_l", "0.608")],
        "0.518",
        "correct",
        "",
    );
    check(
        Some("v"),
        &[("root_v", "0.798"), ("root_l", "0.608")],
        "0.5191",
        "correct",
        "",
    );
    // Known mistakes.
    check(
        None,
        &[],
        "0.4784",
        "mistake",
        "Under the root stands α², and α is 0.160.",
    );
    check(Some("alpha"), &[], "0.4", "mistake", "That is the slider.");
    // Off by a common factor.
    check(None, &[], "-0.5132", "wrong", "the sign");
    check(None, &[], "5.132", "wrong", "power of ten");
    check(None, &[], "0.5132 * pi", "wrong", "factor π");
    check(None, &[], "0.5132 * 4", "wrong", "factor 4");
    check(
        None,
        &[],
        "0.7",
        "wrong",
        "too large. An answer within 1 % counts",
    );
}

#[test]
fn two_unnamed_mistakes_with_one_number_are_asked_about() {
    let lesson = lesson();
    let exercise = lesson.exercise("fixture/v").expect("the exercise");
    let mut drawn = at_worked(&lesson);
    drawn.mistakes.retain(|it| it.named);
    for id in ["one", "two"] {
        drawn.mistakes.push(tutor::exercise::Mistake {
            id: id.to_owned(),
            step: "v".to_owned(),
            value: 0.7,
            named: false,
            made_before: id == "two",
            says: format!("Mistake {id}."),
        });
    }
    let found = mark(&lesson, exercise, &drawn, None, "0.7", &BTreeMap::new());
    assert_eq!((found.result(), found.mistake()), ("mistake", None));
    assert!(found.says().contains("Mistake one.") && found.says().contains("Mistake two."));
    // Of two steps before, one was right: the slip was not made there.
    let earlier = BTreeMap::from([("root_v".to_owned(), "0.8057".to_owned())]);
    let found = mark(&lesson, exercise, &drawn, None, "0.7", &earlier);
    assert_eq!(found.mistake(), Some("one"), "{found:?}");
}

#[test]
fn words_are_marked() {
    let lesson = lesson();
    let none = BTreeMap::new();
    let marked = |id: &str, step: Option<&str>, answer: &str| {
        let exercise = lesson.exercise(id).expect("the exercise");
        mark(
            &lesson,
            exercise,
            &drawn(&lesson, id, 3),
            step,
            answer,
            &none,
        )
    };
    let Truth::Choice(right) = drawn(&lesson, "fixture/which", 3).truth else {
        panic!("a choice");
    };
    let letter = |place: usize| char::from(b'a' + place as u8).to_string();
    assert_eq!(
        marked("fixture/which", None, &(right + 1).to_string()),
        Marking::Correct
    );
    assert_eq!(
        marked("fixture/which", None, &letter(right)),
        Marking::Correct
    );
    let other = marked("fixture/which", None, &letter(1 - right));
    assert_eq!(
        (other.result(), other.mistake()),
        ("mistake", Some("g2-for-v"))
    );
    assert_eq!(marked("fixture/which", None, "3").result(), "invalid");

    let Truth::Order(places) = drawn(&lesson, "fixture/order", 3).truth else {
        panic!("an order");
    };
    let numbers: Vec<String> = places.iter().map(|place| (place + 1).to_string()).collect();
    assert_eq!(
        marked("fixture/order", None, &numbers.join(" ")),
        Marking::Correct
    );
    assert_eq!(
        marked("fixture/order", None, &numbers.concat()),
        Marking::Correct
    );
    let exercise = lesson.exercise("fixture/order").expect("the exercise");
    let order = drawn(&lesson, "fixture/order", 3);
    let shown = hint(&lesson, exercise, &order, None, 3);
    let Some(tutor::prose::Block::List { items, .. }) = shown.get(1) else {
        panic!("the right order as a list: {shown:?}");
    };
    let first = &order.shown[places[0]];
    assert_eq!(items[0], [tutor::prose::Inline::Text(first.clone())]);
    assert_eq!(marked("fixture/order", None, "1 2 3").result(), "wrong");
    assert_eq!(marked("fixture/order", None, "1 1 2").result(), "invalid");

    assert_eq!(marked("fixture/slip", Some("line"), "2"), Marking::Correct);
    assert_eq!(marked("fixture/slip", Some("line"), "a2"), Marking::Correct);
    assert_eq!(marked("fixture/slip", Some("line"), "1").result(), "wrong");
    assert_eq!(
        marked("fixture/slip", Some("line"), "6").result(),
        "invalid"
    );
    assert_eq!(
        marked("fixture/slip", Some("answer"), "0.5132"),
        Marking::Correct
    );
    assert_eq!(marked("fixture/slip", None, "0.513"), Marking::Correct);
    assert_eq!(
        marked("fixture/slip", None, "0.4784").mistake(),
        Some("as-shown")
    );
}

#[test]
fn the_last_hint_is_the_answer() {
    let lesson = lesson();
    let exercise = lesson.exercise("fixture/v").expect("the exercise");
    let drawn = at_worked(&lesson);
    assert_eq!(
        tolerance_words(exercise),
        "within 1 %; keep 4 digits in between"
    );
    for level in 1..=3 {
        let blocks = hint(&lesson, exercise, &drawn, Some("v"), level);
        assert!(!blocks.is_empty(), "{level}");
        let text = format!("{blocks:?}");
        assert_eq!(text.contains("0.5132"), level == 3, "{level}: {text}");
    }
}

#[test]
fn reports_are_the_json_that_is_promised() {
    let lesson = lesson();
    let exercise = lesson.exercise("fixture/d").expect("the exercise");
    let drawn = drawn(&lesson, "fixture/d", 5);
    let report = tutor::exercise::report::ExerciseReport::new(exercise, &drawn);
    let json = serde_json::to_value(&report).expect("JSON");
    for key in [
        "id",
        "seed",
        "given",
        "prompt",
        "steps",
        "truth",
        "tolerance",
        "mistakes",
    ] {
        assert!(json.get(key).is_some(), "{key}");
    }
    assert_eq!(json["tolerance"]["rel"], 0.01);
    assert_eq!(json["steps"][0]["name"], "alpha");
    assert_eq!(json["truth"], json["steps"][2]["truth"]);
    assert!(json["mistakes"].as_array().is_some_and(|it| it.len() >= 7));
    let marking = mark(&lesson, exercise, &drawn, None, "x", &BTreeMap::new());
    let json = serde_json::to_value(tutor::exercise::report::MarkReport::new(&marking));
    assert_eq!(json.expect("JSON")["mistake"], serde_json::Value::Null);
}
