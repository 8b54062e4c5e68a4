//! What the tutor asks and says back: that there is a question for everything that a verdict
//! hangs on, that no question gives the answer away, and that a blank is heard once it is filled.

use formula::Values;

use super::Checker;
use super::texts::prose;
use crate::finding::{Place, Severity};
use crate::lesson::{EntryPlaces, Explain, Text};
use crate::prose::plain;
use crate::rubric::{Blank, Criterion};

pub fn check(checker: &mut Checker<'_>) {
    let lesson = checker.lesson;
    if lesson.explain.is_empty() {
        let message = format!("`{}` asks nothing to be explained back.", lesson.id);
        checker
            .error_in(&lesson.id, "nothing-explained", message)
            .help = Some(
            "Add an `[[explain]]`: what the learner says in his own words is the test of a lesson."
                .to_owned(),
        );
    }
    for explain in &lesson.explain {
        let places = explain
            .expectation_places
            .iter()
            .chain(&explain.misconception_places);
        for (criterion, places) in explain.rubric.criteria().zip(places) {
            texts(checker, &criterion, places);
            questions(checker, explain, &criterion, places);
        }
        let misconceptions = explain.rubric.misconception.iter();
        for (misconception, places) in misconceptions.zip(&explain.misconception_places) {
            text(
                checker,
                misconception.says_back.as_deref(),
                "says_back",
                places,
            );
        }
    }
}

fn texts(checker: &mut Checker<'_>, criterion: &Criterion<'_>, places: &EntryPlaces) {
    for (words, key) in [
        (criterion.ask, "ask"),
        (criterion.hint, "hint"),
        (criterion.prompt, "prompt"),
    ] {
        text(checker, words, key, places);
    }
}

fn text(checker: &mut Checker<'_>, words: Option<&str>, key: &str, places: &EntryPlaces) {
    if let Some(words) = words {
        let text = Text {
            text: words.to_owned(),
            place: literal(&checker.lesson.source, places.of(key)),
        };
        prose(checker, &text, &Values::new());
    }
}

/// The text with its leading questions as statements: "Is it twice?" says that it is, "Is it once
/// or twice?" does not.
fn leading(text: &str) -> String {
    const VERBS: [&str; 8] = ["is", "are", "was", "does", "do", "did", "has", "have"];
    let mut out = String::new();
    for part in text.split_inclusive(['.', '?', '!']) {
        let first = part.split_whitespace().next().unwrap_or_default();
        let is_polar = VERBS.contains(&first.to_lowercase().as_str());
        match part.strip_suffix('?') {
            Some(asked) if is_polar && !asked.contains(" or ") => {
                out.push_str(asked);
                out.push('.');
            }
            _ => out.push_str(part),
        }
    }
    out
}

/// The whole literal of a string whose place is that of what stands between the quotes.
fn literal(source: &str, inside: Place) -> Place {
    let long = ["\"\"\"", "'''"];
    let before = source.get(..inside.start).unwrap_or_default();
    let before = before.trim_end_matches('\n');
    let quotes = if long.iter().any(|quotes| before.ends_with(quotes)) {
        3
    } else {
        1
    };
    Place {
        start: before.len().saturating_sub(quotes),
        end: inside.end + quotes,
    }
}

fn questions(
    checker: &mut Checker<'_>,
    explain: &Explain,
    criterion: &Criterion<'_>,
    places: &EntryPlaces,
) {
    let id = criterion.id;
    if criterion.decides && criterion.ask.is_none() {
        let message = format!("`{id}` has no `ask`.");
        let finding = checker.error(places.of("id"), "no-question", message);
        finding.severity = Severity::Warning;
        finding.help = Some(
            "Add one pointed question that does not give it away: it is asked where the answer \
             leaves this open."
                .to_owned(),
        );
    }
    let read =
        |checker: &Checker<'_>, words: &str| plain(&checker.lesson.inline(words, &Values::new()));
    let is_said = |words: &str| {
        let judgement = explain.judge.judge(words);
        let heard = match criterion.is_misconception {
            true => judgement.misconceptions,
            false => judgement.met,
        };
        heard.iter().any(|it| it == id)
    };
    let sentence = criterion.prompt.map(|prompt| read(checker, prompt));
    let blank = sentence.as_deref().and_then(Blank::of);
    let seen = blank.as_ref().map(|blank| blank.filled(""));
    let asked = [
        ("ask", criterion.ask.map(|it| read(checker, it))),
        ("hint", criterion.hint.map(|it| read(checker, it))),
        ("prompt", seen.or_else(|| sentence.clone())),
    ];
    for (key, words) in asked {
        let stated = |words: &String| is_said(words) || is_said(&leading(words));
        let given_away = words.filter(|words| !criterion.is_misconception && stated(words));
        if given_away.is_some() {
            let message =
                format!("This gives `{id}` away: the judge hears it in the {key} itself.");
            checker.error(places.of(key), "gives-it-away", message).help =
                Some("Ask where to look, not what is there.".to_owned());
        }
    }
    match (criterion.prompt, blank) {
        (Some(_), None) => {
            let message = format!("The prompt of `{id}` has no blank.");
            checker
                .error(places.of("prompt"), "no-blank", message)
                .expected =
                Some("the decisive words in square brackets: \"It is [the answer].\"".to_owned());
        }
        (Some(_), Some(blank)) => {
            let filled = blank.filled(blank.fill);
            if is_said(&filled) == criterion.is_misconception {
                let hears = match criterion.is_misconception {
                    true => "hears the mistake in it",
                    false => "does not hear it in it",
                };
                let message = format!("\"{filled}\" should settle `{id}`, but the judge {hears}.");
                checker
                    .error(places.of("prompt"), "blank-not-heard", message)
                    .help =
                    Some("Say it in the words of a phrase, or add it as a phrase.".to_owned());
            }
        }
        (None, _) => {}
    }
}
