//! The work on an answer grows with its length and no faster.

use super::*;

fn two_balls() -> Rubric {
    toml::from_str(
        r#"
        item = "x/y"
        prompt = "How do D of the polished and of the sandblasted ball differ, and why?"
        [[expectation]]
        id = "narrow"
        says = "The polished one is narrow."
        phrases = ["polished D is narrow", "the rim is bright"]
        [[misconception]]
        id = "dark-rim"
        says = "The rim is dark."
        blocking = true
        phrases = ["the rim is dark"]
        "#,
    )
    .expect("a rubric")
}

#[track_caller]
fn check_grows_no_faster(piece: &str) {
    let judge = Judge::new(&two_balls());
    let steps = |times: usize| {
        let before = steps::taken();
        judge.judge(&piece.repeat(times));
        steps::taken() - before
    };
    let (once, eight) = (steps(200), steps(1600));
    assert!(
        eight <= 9 * once + 1000,
        "{piece:?}: {once} comparisons, then {eight}"
    );
}

#[test]
fn work_grows_with_the_answer_and_no_faster() {
    for piece in [
        "The rim is too bright because the ratio grows, but the centre is dim. ",
        "the rim is bright and the centre is dim ",
        "rim bright, ",
        "bright, wait, no, dark ",
        "from the rim, sorry, from the centre ",
        "not ",
        "bright or dark ",
        "he says bright ",
        "I thought dark ",
        "my first guess bright, but dark ",
        "sharp vs flat vs ",
        "the one for the histogram ",
        "is what they say ",
        "if the light ",
        "especially rim ",
        "the rim is bright, the centre is not, ",
        "((",
        "1+",
        "n.",
        "which is wrong ",
        "\u{202e}rim\u{200f} bright ",
        "one end to the other ",
        "the rim, which is bright, ",
    ] {
        check_grows_no_faster(piece);
    }
}
