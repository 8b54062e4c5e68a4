//! Two words that are heard together: "once ... and again", "outside ..., inside ...".

use super::lexicon::Lexicon;
use super::parse::Match;
use super::text::{Kind, Token};

/// "It is applied once inside V and then again outside": twice in all.
pub fn once_and_again(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &mut Vec<Match>,
    sentence: &[usize],
) {
    let Some(twice) = lexicon.id("twice") else {
        return;
    };
    let mut found = Vec::new();
    for at in (0..tokens.len()).filter(|&at| tokens[at].is("once")) {
        let near = (at + 1..(at + REACH).min(tokens.len()))
            .take_while(|&i| sentence[i] == sentence[at])
            .skip_while(|&i| !matches!(tokens[i].word.as_str(), "and" | "then"));
        let again = near
            .into_iter()
            .find(|&i| matches!(tokens[i].word.as_str(), "again" | "once"));
        found.extend(again.map(|i| Match {
            start: i,
            end: i + 1,
            concepts: vec![twice],
        }));
    }
    found.retain(|m| matches.binary_search_by_key(&m.start, |m| m.start).is_err());
    matches.extend(found);
    matches.sort_by_key(|m| m.start);
}

/// "Too bright outside of that circle, too dark inside": the two say where, of each other.
pub fn inside_out(lexicon: &Lexicon, tokens: &[Token], matches: &mut Vec<Match>) {
    let (Some(centre), Some(rim)) = (lexicon.id("centre"), lexicon.id("rim")) else {
        return;
    };
    let mut found = Vec::new();
    for at in 0..tokens.len() {
        let (id, other) = match tokens[at].word.as_str() {
            "inside" | "within" => (centre, ["outside", "outside"]),
            "outside" => (rim, ["inside", "within"]),
            _ => continue,
        };
        // "inside V" names what it is inside of.
        let alone = tokens.get(at + 1).is_none_or(|t| {
            !matches!(t.kind, Kind::Word | Kind::Value | Kind::Op)
                || matches!(
                    t.word.as_str(),
                    "and" | "but" | "while" | "too" | "is" | "everything"
                )
        });
        let near = at.saturating_sub(REACH)..(at + REACH).min(tokens.len());
        if alone
            && tokens[near]
                .iter()
                .any(|t| other.iter().any(|word| t.is(word)))
        {
            found.push((at, id));
        }
    }
    if found.is_empty() {
        return;
    }
    matches.retain(|m| {
        !(m.end == m.start + 1 && found.binary_search_by_key(&m.start, |&(at, _)| at).is_ok())
    });
    matches.extend(found.into_iter().map(|(at, id)| Match {
        start: at,
        end: at + 1,
        concepts: vec![id],
    }));
    matches.sort_by_key(|m| m.start);
}

/// So far apart stand two words that are each other's contrary, at most.
const REACH: usize = 12;
