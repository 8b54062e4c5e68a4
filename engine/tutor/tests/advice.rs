//! What the check tells an author about an example that is judged otherwise than he says.

use tutor::judge::check_examples;
use tutor::rubric::{Example, Rubric};

/// Two points, in the words of an author who begins.
fn copper(verdict: &str, text: &str) -> Rubric {
    let mut rubric: Rubric = toml::from_str(
        r#"
        item = "metal/explain"
        prompt = "Why does the copper ball have no diffuse part?"
        [[expectation]]
        id = "absorbed"
        says = "The light that enters the metal is absorbed."
        phrases = ["the light that enters copper is absorbed"]
        [[expectation]]
        id = "nothing-comes-out"
        says = "So nothing comes out again: there is no diffuse light."
        phrases = ["no light comes out of copper"]
        "#,
    )
    .expect("a rubric");
    rubric.example = vec![Example {
        text: text.to_owned(),
        verdict: verdict.to_owned(),
        met: None,
        misconceptions: None,
    }];
    rubric
}

/// The advice to one example; following it makes the example come out.
#[track_caller]
fn check(verdict: &str, text: &str, advice: &[(&str, &str)]) {
    let mut rubric = copper(verdict, text);
    let findings = check_examples(&rubric);
    let [finding] = &findings[..] else {
        panic!("{text}: {findings:?}");
    };
    for (id, words) in advice {
        let part = format!("\"{words}\" for {id}");
        assert!(finding.message.contains(&part), "{}", finding.message);
        let expectation = rubric.expectation.iter_mut().find(|it| it.id == *id);
        let phrases = &mut expectation.expect("an expectation").phrases;
        phrases.push((*words).to_owned());
    }
    assert_eq!(check_examples(&rubric), [], "{text}");
}

#[test]
fn the_advice_settles_what_it_is_given_for() {
    check(
        "partial",
        "It turns into heat inside the copper.",
        &[("absorbed", "It turns into heat inside the copper")],
    );
    check(
        "pass",
        "Because the electrons in the metal eat up the refracted light right away. No light \
         leaves the copper after it entered.",
        &[
            (
                "absorbed",
                "Because the electrons in the metal eat up the refracted light right away",
            ),
            (
                "nothing-comes-out",
                "No light leaves the copper after it entered",
            ),
        ],
    );
}
