//! The targets: any bytes go in; a panic is a bug, and so is a promise that is not kept.

use std::sync::OnceLock;

use tutor::judge::Judge;
use tutor::record::Record;

/// The lessons of the repository, which bring rubrics, and are what lesson files look like.
pub const LESSONS: [&str; 3] = [
    include_str!("../../../lessons/01-ggx-d.toml"),
    include_str!("../../../lessons/02-smith-g2.toml"),
    include_str!("../../../lessons/03-schlick-fresnel.toml"),
];

/// A judge for every question.
pub fn judges() -> &'static [Judge] {
    static JUDGES: OnceLock<Vec<Judge>> = OnceLock::new();
    JUDGES.get_or_init(|| {
        LESSONS
            .iter()
            .filter_map(|text| tutor::load("lesson.toml", text).0)
            .flat_map(|lesson| lesson.explain)
            .map(|explain| Judge::new(&explain.rubric))
            .collect()
    })
}

/// The first byte picks the question, the rest is the answer.
pub fn judge(data: &[u8]) {
    let Some((&first, text)) = data.split_first() else {
        return;
    };
    let judges = judges();
    let judge = &judges[first as usize % judges.len()];
    answer(judge, &String::from_utf8_lossy(text));
}

/// An answer gets the same judgement twice, and every quote stands in it.
pub fn answer(judge: &Judge, text: &str) {
    let judgement = judge.judge(text);
    assert_eq!(judgement, judge.judge(text));
    for why in &judgement.why {
        assert_eq!(text.get(why.start..why.end), Some(why.quote.as_str()));
    }
}

/// A lesson file: findings point into it, and what loads can be checked.
pub fn lesson(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let (lesson, findings) = tutor::load("lesson.toml", &text);
    assert!(lesson.is_some() || !findings.is_empty());
    for finding in &findings {
        assert!(finding.line >= 1 && finding.column >= 1, "{finding:?}");
    }
}

/// A log: what is read comes back the same.
pub fn record(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    if let Ok(record) = Record::from_toml(&text) {
        assert_eq!(Record::from_toml(&record.to_toml()), Ok(record));
    }
}

/// An expression of a lesson, and what a learner types.
pub fn formula(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    if let Ok(expr) = formula::parse(&text) {
        // What is printed reads back.
        let again = formula::parse(&expr.to_string());
        assert!(again.is_ok(), "{text:?} prints as {expr}");
    }
    let _ = formula::parse_answer(&text, &["alpha", "n_dot_v"]);
}
