//! Denials and how far they reach.

use super::grammar;
use super::lexicon::{Lexicon, Role};
use super::parse::{Match, starts_with};
use super::text::{Kind, Token};

/// For each token, whether it stands in the reach of a denial. Two denials cancel out.
pub fn denials(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &[Match],
    clause: &[usize],
    sentence: &[usize],
) -> Vec<bool> {
    let mut denied = vec![false; tokens.len()];
    let mut inside = vec![false; tokens.len()];
    for found in matches {
        inside[found.start..found.end].fill(true);
    }
    let mut at = 0;
    while at < tokens.len() {
        let token = &tokens[at];
        let report = grammar::REPORTS
            .iter()
            .find(|words| starts_with(tokens, at, words));
        let negator = !inside[at] && token.kind == Kind::Word && grammar::is_negator(&token.word);
        let not_only = starts_with(tokens, at, &["not", "only"])
            || starts_with(tokens, at, &["not", "just"])
            || starts_with(tokens, at, &["not", "merely"]);
        let idle = starts_with(tokens, at, &["no", "doubt"])
            || starts_with(tokens, at, &["no", "wonder"])
            || starts_with(tokens, at, &["no", "idea"])
            || starts_with(tokens, at, &["no", "matter"])
            || starts_with(tokens, at, &["not", "sure"])
            || starts_with(tokens, at, &["not", "know"])
            || (token.is("no")
                && tokens
                    .get(at + 1)
                    .is_none_or(|t| t.kind != Kind::Word && t.kind != Kind::Value))
            // "nearly (not exactly) uniform"
            || starts_with(tokens, at, &["not"])
                && tokens.get(at + 1).is_some_and(|t| {
                    matches!(t.word.as_str(), "exactly" | "quite" | "perfectly" | "strictly")
                })
                && tokens
                    .get(at + 2)
                    .is_none_or(|t| !matches!(t.kind, Kind::Word | Kind::Value))
            // "nothing to distribute"
            || starts_with(tokens, at, &["nothing", "to"])
                && !tokens.get(at + 2).is_some_and(|t| t.is("do"))
            || starts_with(tokens, at, &["nothing", "but"])
            || token.is("nothing") && at > 0 && nearly(&tokens[at - 1].word)
            // "Isn't the answer that it gets darker?"
            || token.is("not") && expects_a_yes(tokens, at, sentence)
            // "Most goes in; what does not is 4 %."
            || token.is("not")
                && tokens
                    .get(at + 1)
                    .is_some_and(|t| matches!(t.word.as_str(), "is" | "are"))
            || starts_with(tokens, at, &["nothing", "else"]);
        if report.is_none() && (!negator || not_only || idle) {
            at += 1;
            continue;
        }
        let skip = report.map_or(1, |words| words.len());
        let speech = report.is_some_and(|words| {
            matches!(
                words[words.len() - 1],
                "say" | "think" | "expect" | "people" | "would" | "that"
            )
        });
        let wide = speech || token.is("neither") || token.is("nobody") || token.is("none");
        // "less" and "not" before a measure reach only it; a denial reaches to the clause's end.
        let mut end = at + skip;
        let limit = if wide { at + 24 } else { at + 14 };
        while end < tokens.len() && end < limit && sentence[end] == sentence[at] {
            let word = &tokens[end];
            let hard =
                matches!(word.kind, Kind::Break | Kind::Stop | Kind::Question) || word.is("->");
            let soft = word.kind == Kind::Comma
                || grammar::ends_denial(&word.word)
                || (word.is("and") && (clause[end] != clause[at] || begins_anew(tokens, end + 1)));
            let passed = wide && (word.kind == Kind::Comma || word.is("and"));
            // "instead of a bright one you get a dull one": the clause goes on without a comma.
            let subject = matches!(
                word.word.as_str(),
                "you" | "we" | "i" | "it" | "they" | "there" | "one"
            );
            if subject && !speech && report.is_some() && end > at + skip + 1 && word.spaced {
                break;
            }
            // "instead of the facet's H the border glows": and so does a noun.
            let noun = matches!(word.word.as_str(), "the" | "his" | "its")
                && !super::spelling::is_preposition(&tokens[end - 1].word)
                && !matches!(tokens[end - 1].word.as_str(), "and" | "or" | "is" | "than");
            if noun && !speech && report.is_some() && end > at + skip + 1 && inside[end - 1] {
                break;
            }
            // "not so bright", "not even close".
            let opens = end == at + skip && word.kind == Kind::Word && !word.is("but");
            if hard || (soft && !passed && !opens && !inside[end]) {
                break;
            }
            if end > at + skip && !inside[end] && grammar::is_negator(&word.word) {
                break;
            }
            end += 1;
        }
        let subject = if report.is_none() {
            denied_subject(lexicon, tokens, matches, sentence, at, end)
        } else {
            None
        };
        if let Some((from, to)) = subject {
            for flag in &mut denied[from..to] {
                *flag = !*flag;
            }
        }
        for flag in &mut denied[at + skip..end] {
            *flag = !*flag;
        }
        at = (at + skip).max(at + 1);
    }
    less(lexicon, tokens, matches, &mut denied);
    denied
}

/// Whether a denial opens a question, which expects a yes.
fn expects_a_yes(tokens: &[Token], at: usize, sentence: &[usize]) -> bool {
    let opens = at > 0
        && grammar::asks(&tokens[at - 1].word)
        && (at == 1 || sentence[at - 2] != sentence[at]);
    let ends = || {
        (at..(at + 40).min(tokens.len()))
            .take_while(|&i| sentence[i] == sentence[at])
            .any(|i| tokens[i].kind == Kind::Question)
    };
    opens && ends()
}

/// Words before "nothing" that make it a very small amount.
fn nearly(word: &str) -> bool {
    matches!(
        word,
        "almost" | "nearly" | "practically" | "virtually" | "to" | "over" | "by" | "times" | "of"
    )
}

/// Whether a clause with a subject of its own begins here: "and if you", "and it".
fn begins_anew(tokens: &[Token], at: usize) -> bool {
    tokens.get(at).is_some_and(|t| {
        matches!(
            t.word.as_str(),
            "if" | "it"
                | "you"
                | "we"
                | "then"
                | "so"
                | "they"
                | "i"
                | "there"
                | "when"
                | "because"
        )
    })
}

/// What a denial behind it denies: "the facet's normal is not H", "1/pi is not the value",
/// "dimmer it is not".
fn denied_subject(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &[Match],
    sentence: &[usize],
    at: usize,
    end: usize,
) -> Option<(usize, usize)> {
    let has = |m: &Match, wanted: fn(Role) -> bool| {
        m.concepts
            .iter()
            .any(|&id| wanted(lexicon.concept(id).role))
    };
    let is_state = |m: &Match| has(m, |role| role == Role::State);
    // Back over the verb and what may stand between it and its subject.
    let mut from = at;
    let (mut copula, mut fronted) = (false, false);
    while from > 0 && at - from < 4 {
        let word = tokens[from - 1].word.as_str();
        let verb = matches!(
            word,
            "is" | "are" | "was" | "were" | "does" | "do" | "would" | "will" | "can"
        );
        let pronoun = matches!(word, "it" | "they");
        if !(verb || pronoun && copula || word.ends_with("ly") || word == "just") {
            break;
        }
        copula |= verb;
        fronted |= pronoun;
        from -= 1;
    }
    let index = matches.partition_point(|m| m.start < from);
    let ends_here = matches[index.saturating_sub(3)..index]
        .iter()
        .filter(|m| m.end == from && copula && sentence[m.start] == sentence[at]);
    let subject = ends_here.clone().find(|m| is_state(m)).or_else(|| {
        ends_here
            .clone()
            .find(|m| has(m, |role| role == Role::Thing))
    })?;
    // "bright is" is no subject where "the rim is bright" stands before it.
    let opens = subject.start == 0
        || !matches!(
            tokens[subject.start - 1].word.as_str(),
            "is" | "are" | "gets" | "too" | "looks" | "becomes" | "will" | "be"
        );
    // "is not N but H", "is not N, it is H": what follows says what it is.
    let amended = tokens[end.min(tokens.len())..]
        .iter()
        .take(3)
        .any(|t| matches!(t.word.as_str(), "but" | "it" | "its" | "rather" | "instead"));
    let mut reach = matches.iter().skip(index).take_while(|m| m.start < end);
    let same = reach.clone().any(|m| {
        m.start > at
            && m.concepts.iter().any(|&id| {
                subject.concepts.contains(&id) || lexicon.concept(id).name == "halfvector"
            })
    });
    let bare = !reach
        .any(|m| m.start > at && is_state(m) && !has(m, |role| matches!(role, Role::Entity(_))));
    let said = is_state(subject);
    let named = tokens[at + 1..end.min(at + 4).max(at + 1)]
        .iter()
        .any(|t| grammar::denies_source(&t.word) || said && grammar::denies_subject(&t.word))
        || said && end == at + 1;
    let denied = said && fronted && bare || said && same && !amended || named && !amended;
    (opens && denied).then_some((subject.start, subject.end))
}

/// "less concentrated", "not as wide": denies the one word that follows.
fn less(lexicon: &Lexicon, tokens: &[Token], matches: &[Match], denied: &mut [bool]) {
    for pair in matches.windows(2) {
        let [first, second] = pair else { continue };
        let is_less = first.end == first.start + 1
            && matches!(
                tokens[first.start].word.as_str(),
                "less" | "least" | "little"
            );
        // "a hard little sparkle": an adjective, no denial.
        let is_less = is_less
            && !(tokens[first.start].is("little")
                && second
                    .concepts
                    .iter()
                    .any(|&id| lexicon.concept(id).name == "small"));
        let measures = second
            .concepts
            .iter()
            .any(|&id| lexicon.concept(id).antonym.is_some());
        if is_less && measures && second.start == first.end {
            for flag in &mut denied[second.start..second.end] {
                *flag = !*flag;
            }
        }
    }
}
