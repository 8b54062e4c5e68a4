//! Words that stand for something named elsewhere: "the first", "the other", "if the light
//! were weak".

use std::collections::BTreeSet;

use super::grammar;
use super::lexicon::{CAUSE, Id, Lexicon, MATERIAL, PLACE, QUANTITY, Role, SURFACE};
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
    for at in (0..tokens.len())
        .filter(|&at| tokens[at].is("if") || tokens[at].is("were") || tokens[at].is("would"))
    {
        let first = matches.partition_point(|m| m.start < at);
        let names = matches[first..].iter().take(4).any(|m| {
            sentence[m.start] == sentence[at]
                && m.start < at + 8
                && m.concepts.iter().any(|&id| ids.contains(&Some(id)))
        });
        // "If I lower the key, ...".
        let verb = tokens[at].is("if")
            && tokens
                .get(at + 1)
                .is_some_and(|t| matches!(t.word.as_str(), "i" | "you" | "we" | "he" | "one"))
            && tokens.get(at + 2).is_some_and(|t| {
                matches!(
                    t.word.as_str(),
                    "lower" | "lowers" | "dim" | "reduce" | "halve" | "dial" | "scale" | "drop"
                )
            });
        // "The lamp would dim both alike."
        let would =
            tokens[at].is("would")
                && matches[..first].iter().rev().take(2).any(|m| {
                    m.end + 1 >= at && m.concepts.iter().any(|&id| ids.contains(&Some(id)))
                });
        if (names || verb) && !tokens[at].is("would") || would {
            found.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![artist],
            });
        }
    }
    // "A dark picture can be pushed": any such picture, not this one.
    for at in 0..tokens.len() {
        let opens = at == 0 || tokens[at - 1].ends_sentence();
        if !opens || !matches!(tokens[at].word.as_str(), "a" | "an" | "any") {
            continue;
        }
        let first = matches.partition_point(|m| m.start <= at);
        let [said, of, ..] = &matches[first..] else {
            continue;
        };
        let is = |m: &Match, name: &str| {
            m.concepts
                .iter()
                .any(|&id| lexicon.concept(id).name == name)
        };
        let general = tokens.get(of.end).is_some_and(|t| {
            matches!(
                t.word.as_str(),
                "can" | "could" | "would" | "will" | "still" | "just" | "keeps" | "has" | "looks"
            )
        });
        if said.start == at + 1
            && is(said, "dim")
            && of.start == said.end
            && is(of, "whole")
            && general
        {
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
        return resolve_places(lexicon, tokens, matches);
    };
    if class == PLACE {
        return resolve_places(lexicon, tokens, matches);
    }
    let mut named: Vec<Id> = Vec::new();
    let mut last: Option<Id> = None;
    let mut resolved: Vec<Match> = Vec::new();
    let mut counted: BTreeSet<usize> = BTreeSet::new();
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
                | "does"
                | "mean"
                | "means"
                | "gets"
                | "scatters"
                | "spreads"
                | "reflects"
                | "goes"
        ) || !is_word(tokens.get(at + 1));
        let stands_alone = after_article || names_one;
        let any_other = at > 0
            && matches!(
                tokens[at - 1].word.as_str(),
                "any" | "every" | "each" | "no" | "some" | "all" | "many" | "most"
            );
        let order = if named.len() >= 2 {
            &named
        } else {
            &setting.order[class]
        };
        let before = |back: usize| at.checked_sub(back).map_or("", |i| tokens[i].word.as_str());
        // "from one end to the other".
        let from_one = (2..6).any(|back| before(back) == "one" && before(back + 1) == "from");
        // "In one case ..., in the other ...".
        let end = matches!(follows, "end" | "extreme" | "limit" | "hand")
            && matches!(before(2), "at" | "to");
        let in_the =
            before(1) == "the" && (end || matches!(before(2), "in" | "on" | "for" | "with"));
        let case = matches!(before(1), "in" | "on" | "for")
            && matches!(follows, "case" | "photo" | "picture" | "image" | "ball")
            && tokens[at..].iter().take(40).any(|t| t.is("other"));
        // "One is a dot, the other is a blur."
        let opens_pair = (at == 0 || matches!(tokens[at - 1].kind, Kind::Stop | Kind::Break))
            && grammar::is_copula(follows)
            && (at + 2..(at + 40).min(tokens.len()))
                .any(|i| tokens[i].is("other") && tokens[i - 1].is("the"));
        // "Peaked for the one and flat for the other."
        let of_pair = before(1) == "the"
            && matches!(before(2), "in" | "on" | "for" | "with" | "of")
            && (at + 1..(at + 25).min(tokens.len()))
                .any(|i| tokens[i].is("other") && tokens[i - 1].is("the"));
        let other_than = |last: Option<Id>| {
            let topic = last.or_else(|| order.first().copied());
            let mut all = setting.order[class].iter().copied();
            all.find(|&id| Some(id) != topic)
        };
        // "First a dot, then a haze."
        let article = matches!(follows, "a" | "an");
        let turn = |from: usize, to: usize, word: &str| {
            (from..to.min(tokens.len())).any(|i| {
                tokens[i].is(word) && tokens.get(i + 1).is_some_and(|t| t.is("a") || t.is("an"))
            })
        };
        let in_turn = article
            && match word {
                "first" => turn(at + 1, at + 14, "then"),
                "then" => turn(at.saturating_sub(14), at, "first"),
                _ => false,
            };
        // "On the left a dot, on the right a haze": as the two are asked about, so they stand.
        let beside = |i: usize| names_side(tokens, i);
        let sides = matches!(word, "left" | "right")
            && beside(at)
            && (at.saturating_sub(SIDES)..(at + SIDES).min(tokens.len())).any(|i| {
                matches!(tokens[i].word.as_str(), "left" | "right")
                    && tokens[i].word != word
                    && beside(i)
            });
        // "photo 1", "case 2".
        let numbered = matches!(
            word,
            "photo"
                | "picture"
                | "image"
                | "case"
                | "ball"
                | "number"
                | "shot"
                | "photograph"
                | "surface"
        );
        let id = match word {
            _ if numbered && matches!(follows, "#1" | "one") => order.first().copied(),
            _ if numbered && matches!(follows, "#2" | "two") => order.get(1).copied(),
            "left" | "right" if sides => order.get(usize::from(word == "right")).copied(),
            "first" | "then" if in_turn => order.get(usize::from(word == "then")).copied(),
            "first" | "former" | "1st" if stands_alone && follows != "place" => {
                order.first().copied()
            }
            "second" | "latter" | "2nd"
                if stands_alone && follows != "time" && follows != "division" =>
            {
                order.get(1).copied()
            }
            // "the dull ball": where the question sets two apart, no judgement of its light.
            "dull"
                if matches!(
                    follows,
                    "ball" | "one" | "sphere" | "surface" | "metal" | "steel"
                ) =>
            {
                let rough = lexicon.id("rough");
                rough.filter(|id| setting.order[class].contains(id))
            }
            "one" if of_pair => order.first().copied(),
            "other" if any_other || from_one => None,
            "other" if in_the => other_than(last),
            "one" if case || opens_pair => order.first().copied(),
            "other" if names_one || (after_article && grammar::is_copula(follows)) => {
                other_than(last)
            }
            _ => None,
        };
        let taken = matches
            .iter()
            .skip(next.saturating_sub(1))
            .take(2)
            .any(|m| m.start < at && at < m.end || m.start == at && m.end > at + 2);
        let taken = taken && !numbered;
        if let Some(id) = id
            && !taken
        {
            last = Some(id);
            if numbered {
                counted.insert(at + 1);
            }
            if word == "dull" {
                counted.insert(at);
            }
            resolved.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![id],
            });
        }
    }
    matches.retain(|m| !counted.contains(&m.start));
    matches.extend(resolved);
    matches.sort_by_key(|m| m.start);
}

/// "The highlight ..., the outline ...: the latter burns": the last two places named.
fn resolve_places(lexicon: &Lexicon, tokens: &[Token], matches: &mut Vec<Match>) {
    let place = |m: &Match| {
        let mut all = m.concepts.iter().copied();
        all.find(|&id| {
            lexicon.concept(id).role == Role::Entity(PLACE) && lexicon.concept(id).name != "whole"
        })
    };
    let (mut former, mut latter): (Option<Id>, Option<Id>) = (None, None);
    let mut found = Vec::new();
    let mut next = 0;
    for (at, token) in tokens.iter().enumerate() {
        while let Some(m) = matches.get(next).filter(|m| m.start <= at) {
            if let Some(id) = place(m).filter(|&id| latter != Some(id)) {
                former = latter.replace(id);
            }
            next += 1;
        }
        let meant = match token.word.as_str() {
            "former" => former,
            "latter" => latter,
            _ => None,
        };
        found.extend(meant.map(|id| Match {
            start: at,
            end: at + 1,
            concepts: vec![id],
        }));
    }
    matches.extend(found);
    matches.sort_by_key(|m| m.start);
}

/// "The histogram of the polished one has a peak, the one for the sandblasted ...": what the
/// sentence spoke of first.
pub fn the_one_for(
    lexicon: &Lexicon,
    tokens: &[Token],
    matches: &mut Vec<Match>,
    sentence: &[usize],
) {
    let mut found = Vec::new();
    for at in 1..tokens.len().saturating_sub(1) {
        let stands_for = matches!(tokens[at].word.as_str(), "one" | "that")
            && (tokens[at].is("that") || tokens[at - 1].is("the"))
            && matches!(tokens[at + 1].word.as_str(), "for" | "of" | "from");
        if !stands_for {
            continue;
        }
        let first = matches.partition_point(|m| sentence[m.start] < sentence[at]);
        let meant = matches[first..]
            .iter()
            .take(3)
            .take_while(|m| m.end <= at)
            .flat_map(|m| &m.concepts)
            .copied()
            .find(|&id| lexicon.concept(id).role == Role::Entity(QUANTITY));
        if let Some(id) = meant {
            found.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![id],
            });
        }
    }
    matches.extend(found);
    matches.sort_by_key(|m| m.start);
}

/// "0/0. 1/pi.", "narrow / flat": two answers that name neither surface come in the order in
/// which the question names them.
pub fn in_order(lexicon: &Lexicon, tokens: &[Token], matches: &mut Vec<Match>, setting: &Setting) {
    let [first, second, ..] = setting.order[SURFACE].as_slice() else {
        return;
    };
    let role = |m: &Match, wanted: Role| {
        m.concepts
            .iter()
            .any(|&id| lexicon.concept(id).role == wanted)
    };
    opposed(lexicon, tokens, matches, (*first, *second));
    if matches.iter().any(|m| role(m, Role::Entity(SURFACE))) {
        return;
    }
    let mut segments: Vec<Option<usize>> = vec![None];
    let mut said = matches.iter().filter(|m| role(m, Role::State)).peekable();
    for (at, token) in tokens.iter().enumerate() {
        if matches!(token.kind, Kind::Stop | Kind::Break | Kind::Question) || token.is("/") {
            segments.push(None);
        }
        while let Some(found) = said.next_if(|m| m.start <= at) {
            if let Some(segment) = segments.last_mut() {
                segment.get_or_insert(found.start);
            }
        }
    }
    let said: Vec<usize> = segments.into_iter().flatten().collect();
    if let &[one, other] = said.as_slice() {
        for (at, id) in [(one, *first), (other, *second)] {
            matches.push(Match {
                start: at,
                end: at + 1,
                concepts: vec![id],
            });
        }
        matches.sort_by_key(|m| m.start);
    }
}

/// "normals all alike vs. all over the place": the one before is the one named first.
fn opposed(lexicon: &Lexicon, tokens: &[Token], matches: &mut Vec<Match>, order: (Id, Id)) {
    let ends = |t: &Token| matches!(t.kind, Kind::Stop | Kind::Break | Kind::Question);
    let has = |m: &Match, wanted: Role| {
        m.concepts
            .iter()
            .any(|&id| lexicon.concept(id).role == wanted)
    };
    let mut found = Vec::new();
    let mut start = 0;
    for at in 0..tokens.len() {
        if ends(&tokens[at]) {
            start = at + 1;
        }
        if !matches!(
            tokens[at].word.as_str(),
            "vs" | "versus" | "against" | "resp"
        ) {
            continue;
        }
        let to = matches.partition_point(|m| m.start < at);
        let before: Vec<&Match> = matches[..to]
            .iter()
            .rev()
            .take(6)
            .take_while(|m| m.start >= start)
            .collect();
        let behind: Vec<&Match> = matches[to..]
            .iter()
            .take(6)
            .take_while(|m| m.start < at + 20 && !tokens[at..m.start].iter().any(ends))
            .collect();
        let named = |m: &&&Match| has(m, Role::Entity(SURFACE));
        if before.iter().chain(&behind).find(named).is_some() {
            continue;
        }
        let state = |m: &&&Match| has(m, Role::State);
        if let (Some(one), Some(other)) = (before.iter().find(state), behind.iter().find(state)) {
            found.push((one.start, order.0));
            found.push((other.start, order.1));
        }
    }
    matches.extend(found.into_iter().map(|(at, id)| Match {
        start: at,
        end: at + 1,
        concepts: vec![id],
    }));
    matches.sort_by_key(|m| m.start);
}

/// So far apart stand the left one and the right one, at most.
const SIDES: usize = 40;

/// Whether "left" or "right" names one of two pictures here.
fn names_side(tokens: &[Token], at: usize) -> bool {
    let word = |i: usize| tokens.get(i).map_or("", |t| t.word.as_str());
    let article = at > 0 && matches!(word(at - 1), "the" | "on" | "d");
    let noun = matches!(
        word(at + 1),
        "one"
            | "picture"
            | "photo"
            | "image"
            | "plate"
            | "ball"
            | "sphere"
            | "panel"
            | "shot"
            | "frame"
            | ";"
    );
    let joins = |i: usize| matches!(word(i), "and" | "or");
    let pair = joins(at + 1) || at > 0 && joins(at - 1);
    (article || noun) && !pair && word(at + 1) != "away"
}

fn is_word(token: Option<&Token>) -> bool {
    token.is_some_and(|t| matches!(t.kind, Kind::Word | Kind::Value))
}
