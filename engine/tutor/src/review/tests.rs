use super::*;
use crate::judge::Judge;

const LESSON: &str = include_str!("../../../../lessons/02-smith-g2.toml");
const ITEM: &str = "smith-g2/explain-3";

fn rubric() -> Rubric {
    rubric_in(LESSON, ITEM).expect("the lesson asks it")
}

fn waiting(id: &str, rubric: Rubric, text: &str) -> Waiting {
    let today = Judge::new(&rubric).judge(text);
    Waiting {
        id: id.into(),
        learner: "ada".into(),
        explanation: Explanation {
            item: ITEM.into(),
            attempt: 1,
            at: String::new(),
            text: text.into(),
            replies: Vec::new(),
            judge: "1".into(),
            verdict: "unsure".into(),
            stands: "unsure".into(),
            met: Vec::new(),
            misconceptions: Vec::new(),
            unsure: Vec::new(),
            why: Vec::new(),
            self_marked: None,
            disputed: Vec::new(),
        },
        reason: Reason::Unsure,
        rubric,
        today,
    }
}

/// An answer of which the judge hears nothing.
fn silent(id: &str) -> Waiting {
    waiting(id, rubric(), "No idea, sorry.")
}

#[track_caller]
fn kept(effect: Option<Effect>) -> Marked {
    match effect {
        Some(Effect::Keep(marked)) => marked,
        other => panic!("{other:?}"),
    }
}

#[test]
fn one_key_marks_an_answer() {
    let mut review = Review::new(vec![silent("1"), silent("2")]);
    let marked = kept(review.press(Key::Verdict(Verdict::Pass)));
    let rubric = rubric();
    let required: Vec<String> = rubric
        .expectation
        .iter()
        .filter(|e| e.required)
        .map(|e| e.id.clone())
        .collect();
    assert_eq!(
        (marked.verdict.as_str(), &marked.met),
        ("pass", &Some(required))
    );
    let marked = kept(review.press(Key::Verdict(Verdict::Fail)));
    assert_eq!(
        (marked.verdict.as_str(), marked.met),
        ("fail", Some(Vec::new()))
    );
    assert!(review.current().is_none());
    assert_eq!(review.marked(), 2);
}

#[test]
fn partial_asks_which_where_nothing_says_so() {
    let lesson = include_str!("../../../../lessons/01-ggx-d.toml");
    let rubric = rubric_in(lesson, "ggx-d/explain").expect("the lesson asks it");
    let mut review = Review::new(vec![waiting("1", rubric, "No idea, sorry.")]);
    assert_eq!(review.press(Key::Verdict(Verdict::Partial)), None);
    assert!(review.said().is_some_and(|said| said.contains("numbers")));
    assert_eq!(review.press(Key::Turn(0)), None);
    let first = review.points()[0].id.clone();
    let marked = kept(review.press(Key::Verdict(Verdict::Partial)));
    assert_eq!(
        (marked.verdict.as_str(), marked.met),
        ("partial", Some(vec![first]))
    );
}

#[test]
fn a_verdict_never_contradicts_the_points_that_the_teacher_turned() {
    let mut review = Review::new(vec![silent("1")]);
    let blocking = review
        .points()
        .iter()
        .position(|p| p.is_misconception && p.weighs)
        .expect("one blocks");
    assert_eq!(review.press(Key::Turn(blocking)), None);
    assert_eq!(review.press(Key::Verdict(Verdict::Pass)), None);
    assert!(review.said().is_some_and(|said| said.contains("no pass")));
    assert_eq!(review.follows(), Verdict::Fail);
    let marked = kept(review.press(Key::Accept));
    assert_eq!(marked.verdict, "fail");
    assert_eq!(
        marked.misconceptions,
        Some(vec![review_point(blocking)]),
        "the point is kept"
    );
}

fn review_point(place: usize) -> String {
    Review::new(vec![silent("1")]).points()[place].id.clone()
}

#[test]
fn going_back_takes_the_mark_back() {
    let mut review = Review::new(vec![silent("1"), silent("2"), silent("3")]);
    assert_eq!(review.press(Key::Back), None);
    let _ = kept(review.press(Key::Verdict(Verdict::Fail)));
    assert_eq!(review.press(Key::Later), None);
    assert_eq!(review.place(), (2, 3));
    assert_eq!(review.press(Key::Back), None, "the second has no mark");
    assert_eq!(
        review.press(Key::Back),
        Some(Effect::Forget("1".to_owned()))
    );
    assert_eq!((review.place(), review.marked()), ((0, 3), 0));
}

#[test]
fn keys_after_the_last_do_nothing() {
    let mut review = Review::new(Vec::new());
    for key in [
        Key::Verdict(Verdict::Pass),
        Key::Verdict(Verdict::Partial),
        Key::Accept,
        Key::Turn(3),
        Key::Later,
        Key::Back,
    ] {
        assert_eq!(review.press(key), None);
    }
}

fn new_example() -> Example {
    Example {
        text: "Two lines,\na \"quote\", a backslash \\ and an end: \"\"\".".into(),
        verdict: "fail".into(),
        met: Some(Vec::new()),
        misconceptions: Some(Vec::new()),
    }
}

#[test]
fn examples_go_into_the_lesson_and_nothing_else_changes() {
    for item in ["smith-g2/explain-1", ITEM, "smith-g2/retest"] {
        let changed = with_examples(LESSON, item, &[new_example()]).expect("there is room");
        let added = example_toml(&new_example());
        let at = changed.find(&added).expect("as printed");
        assert_eq!(
            format!("{}{}", &changed[..at], &changed[at + added.len()..]),
            LESSON
        );
        let again = with_examples(&changed, item, &[new_example()]).expect("there is room");
        assert_eq!(again, changed, "once is enough");
    }
}

#[test]
fn what_cannot_take_an_example_says_so() {
    assert!(with_examples(LESSON, "smith-g2/explain-9", &[new_example()]).is_err());
    assert!(with_examples("no = lesson", ITEM, &[new_example()]).is_err());
}
