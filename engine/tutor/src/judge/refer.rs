//! Words that stand for something named elsewhere: "the first", "the other", "if the light
//! were weak".

use super::grammar;
use super::lexicon::{CAUSE, Id, Lexicon, MATERIAL, PLACE, Role, SURFACE};
use super::parse::{Match, Setting};
use super::text::{Kind, Token};

/// "If the light were weak, ...": what an artist might have done, where the question names him.
pub fn suppose(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &mut Vec<Match>,
    sentence: &[usize],
    setting: &Setting,
) {
    let Some(artist) = lexicon
        .id("artist")
        .filter(|id| setting.order[CAUSE].contains(id))
    else {
        return;
    };
    let ids = [lexicon.id("light"), lexicon.id("basecolour")];
    let mut found = Vec::new();
    for at in (0..tokens.len()).filter(|&at| tokens[at].is("if") || tokens[at].is("were")) {
        let first = matches.partition_point(|m| m.start < at);
        let names = matches[first..].iter().take(4).any(|m| {
            sentence[m.start] == sentence[at]
                && m.start < at + 8
                && m.concepts.iter().any(|&id| ids.contains(&Some(id)))
        });
        if names {
            found.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![artist],
            });
        }
    }
    matches.extend(found);
    matches.sort_by_key(|m| m.start);
}

/// "the first", "the other": which of two.
pub fn resolve_ordinals(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &mut Vec<Match>,
    setting: &Setting,
) {
    let Some(class) = [SURFACE, MATERIAL, PLACE]
        .into_iter()
        .find(|&class| setting.order[class].len() >= 2)
    else {
        return;
    };
    if class == PLACE {
        return;
    }
    let mut named: Vec<Id> = Vec::new();
    let mut last: Option<Id> = None;
    let mut resolved: Vec<Match> = Vec::new();
    let mut next = 0;
    for at in 0..tokens.len() {
        while next < matches.len() && matches[next].start < at {
            next += 1;
        }
        if let Some(found) = matches.get(next).filter(|m| m.start == at) {
            for &id in &found.concepts {
                if lexicon.concept(id).role == Role::Entity(class) {
                    last = Some(id);
                    if !named.contains(&id) {
                        named.push(id);
                    }
                }
            }
        }
        let word = tokens[at].word.as_str();
        let follows = tokens
            .get(at + 1)
            .map(|t| t.word.as_str())
            .unwrap_or_default();
        let after_article = at > 0 && matches!(tokens[at - 1].word.as_str(), "the" | "in" | "one");
        let names_one = matches!(
            follows,
            "is" | "has"
                | "gives"
                | "shows"
                | "looks"
                | "are"
                | "will"
                | "would"
                | "should"
                | "one"
                | "ball"
                | "case"
                | "photo"
                | "surface"
                | "sphere"
                | "picture"
                | "material"
                | "image"
                | "it"
                | "version"
        ) || !is_word(tokens.get(at + 1));
        let stands_alone = after_article || names_one;
        let order = if named.len() >= 2 {
            &named
        } else {
            &setting.order[class]
        };
        let id = match word {
            "first" | "former" | "1st" if stands_alone && follows != "place" => {
                order.first().copied()
            }
            "second" | "latter" | "2nd"
                if stands_alone && follows != "time" && follows != "division" =>
            {
                order.get(1).copied()
            }
            "other" if names_one || (after_article && grammar::is_copula(follows)) => {
                let topic = last.or_else(|| order.first().copied());
                setting.order[class]
                    .iter()
                    .copied()
                    .find(|&id| Some(id) != topic)
            }
            _ => None,
        };
        let taken = matches
            .iter()
            .skip(next.saturating_sub(1))
            .take(2)
            .any(|m| m.start <= at && at < m.end);
        if let Some(id) = id
            && !taken
        {
            last = Some(id);
            resolved.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![id],
            });
        }
    }
    matches.extend(resolved);
    matches.sort_by_key(|m| m.start);
}

fn is_word(token: Option<&Token>) -> bool {
    token.is_some_and(|t| matches!(t.kind, Kind::Word | Kind::Value))
}
