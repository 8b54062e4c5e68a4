//! What marked answers teach: phrases, with what each gains and costs on other writers.

use tutor::judge::evaluate::Marked;
use tutor::judge::learn::{Learned, List, learn};
use tutor::rubric::{Expectation, Rubric};

fn rubric(item: &str) -> Rubric {
    let files = [
        include_str!("../../../lessons/01-ggx-d.toml"),
        include_str!("../../../lessons/02-smith-g2.toml"),
    ];
    files
        .into_iter()
        .filter_map(|text| tutor::load::load("lesson.toml", text).0)
        .flat_map(|lesson| lesson.explain)
        .map(|explain| explain.rubric)
        .find(|rubric| rubric.item == item)
        .expect("a rubric of that id")
}

fn marks() -> Vec<Marked> {
    include_str!("answers/train.jsonl")
        .lines()
        .map(|line| serde_json::from_str(line).expect("a marked answer"))
        .collect()
}

/// The rubric with nothing but sentences, as an author begins: of a question that nobody has
/// weighed answers to.
fn without_phrases(mut rubric: Rubric) -> Rubric {
    rubric.item.insert_str(0, "new-");
    for e in &mut rubric.expectation {
        e.phrases.clear();
        e.against.clear();
    }
    for m in &mut rubric.misconception {
        m.phrases.clear();
        m.against.clear();
    }
    rubric
}

fn kappa(learned: &Learned) -> (f64, f64) {
    let held_out = learned.held_out.as_ref().expect("many writers");
    let right = |e: &tutor::judge::evaluate::Evaluation| {
        (e.confusion[0][0] + e.confusion[1][1] + e.confusion[2][2]) as f64 / e.coverage.of as f64
    };
    (right(&learned.before), right(held_out))
}

#[test]
fn an_author_without_phrases_is_given_some_that_help_on_other_writers() {
    for item in ["ggx-d/explain", "smith-g2/explain-3"] {
        let mut marks = marks();
        marks
            .iter_mut()
            .for_each(|it| it.item.insert_str(0, "new-"));
        let learned = learn(&without_phrases(rubric(item)), &marks);
        assert!(learned.answers >= 20 && learned.writers >= 20, "{item}");
        assert!(!learned.proposals.is_empty(), "{item}");
        for proposal in &learned.proposals {
            assert!(
                proposal.gains.len() > 2 * proposal.costs.len(),
                "{proposal:?}"
            );
            assert!(!proposal.gains.contains(&proposal.from), "{proposal:?}");
        }
        let (before, after) = kappa(&learned);
        println!("{item}: right {before:.2} before, {after:.2} on held-out writers");
        assert!(after > before, "{item}: {before} then {after}");
    }
}

#[test]
fn a_rubric_that_hears_everything_is_left_alone() {
    let learned = learn(&rubric("smith-g2/explain-3"), &marks());
    assert_eq!(learned.proposals, []);
}

fn sky() -> Rubric {
    let expectation = |id: &str, phrase: &str| Expectation {
        id: id.into(),
        says: format!("{phrase}."),
        required: true,
        phrases: vec![phrase.into()],
        against: Vec::new(),
        reteach: None,
        ask: None,
        hint: None,
        prompt: None,
    };
    Rubric {
        item: "x/y".into(),
        prompt: "What happens at the rim?".into(),
        expectation: vec![expectation("bright-rim", "the rim is bright")],
        ..Rubric::default()
    }
}

fn mark(id: &str, writer: &str, text: &str, met: bool) -> Marked {
    Marked {
        id: id.into(),
        item: "x/y".into(),
        writer: writer.into(),
        text: text.into(),
        met: None,
        misconceptions: None,
        verdict: if met { "pass" } else { "fail" }.into(),
        disputed: Vec::new(),
        adversarial: false,
    }
}

#[test]
fn says_where_a_phrase_comes_from_and_what_it_gains() {
    // A word that no list of the field knows, and three who use it.
    let marks = [
        mark("1", "A", "The rim glorps.", true),
        mark("2", "B", "I think the rim glorps a lot.", true),
        mark("3", "C", "At the edge it glorps.", true),
        mark("4", "D", "The middle glorps.", false),
    ];
    let learned = learn(&sky(), &marks);
    let [proposal] = learned.proposals.as_slice() else {
        panic!("{:#?}", learned.proposals)
    };
    assert_eq!(proposal.list, List::Phrases);
    assert_eq!(proposal.criterion, "bright-rim");
    assert!(proposal.words.contains("glorps"), "{}", proposal.words);
    assert_eq!(proposal.gains.len(), 2, "{proposal:?}");
    assert_eq!(proposal.costs, Vec::<String>::new());
}

#[test]
fn no_phrase_spans_an_answer_and_the_reply_to_it() {
    let marks = [
        mark("1", "A", "No idea\nthe rim glorps", true),
        mark("2", "B", "Hard to say\nthe rim glorps a lot", true),
        mark("3", "C", "At the edge it glorps.", true),
        mark("4", "D", "The middle glorps.", false),
    ];
    let learned = learn(&sky(), &marks);
    assert!(!learned.proposals.is_empty());
    for proposal in &learned.proposals {
        assert!(!proposal.words.contains('\n'), "{proposal:?}");
    }
}

#[test]
fn words_that_only_one_writer_uses_are_not_proposed() {
    let marks = [
        mark("1", "A", "The rim glorps.", true),
        mark("2", "A", "The rim glorps again.", true),
        mark("3", "B", "The rim is bright.", true),
    ];
    let learned = learn(&sky(), &marks);
    assert_eq!(learned.proposals, []);
    assert_eq!(learned.lonely.len(), 1, "{:#?}", learned.lonely);
}

#[test]
fn nothing_to_learn_from() {
    let learned = learn(&sky(), &[]);
    assert_eq!((learned.answers, learned.writers), (0, 0));
    assert!(learned.proposals.is_empty() && learned.held_out.is_none());
}
