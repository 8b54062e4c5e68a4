//! Informal spelling brought to the dictionary's: contractions, chat, comparatives, typos.

use super::text::{Kind, Token};

/// What a short form stands for; two words where it hides a negation.
fn expanded(word: &str) -> Option<&'static [&'static str]> {
    Some(match word {
        "isnt" | "aint" => &["is", "not"],
        "arent" => &["are", "not"],
        "wasnt" => &["was", "not"],
        "werent" => &["were", "not"],
        "doesnt" | "dosent" | "doesn" => &["does", "not"],
        "dont" => &["do", "not"],
        "didnt" => &["did", "not"],
        "cant" | "cannot" => &["can", "not"],
        "couldnt" => &["could", "not"],
        "wont" => &["will", "not"],
        "wouldnt" => &["would", "not"],
        "shouldnt" | "shudnt" => &["should", "not"],
        "hasnt" => &["has", "not"],
        "havent" => &["have", "not"],
        "mustnt" => &["must", "not"],
        "neednt" => &["need", "not"],
        "youd" => &["you", "would"],
        "theyd" => &["they", "would"],
        "itd" => &["it", "would"],
        "hed" => &["he", "would"],
        "id" => &["i", "would"],
        "itll" => &["it", "will"],
        "youll" => &["you", "will"],
        "theyll" => &["they", "will"],
        "thatll" => &["that", "will"],
        "theres" => &["there", "is"],
        "thats" => &["that", "is"],
        "bc" | "cuz" | "coz" | "becuz" | "bcs" | "bcz" | "becos" => &["because"],
        "u" => &["you"],
        "ur" => &["your"],
        "shud" | "shd" => &["should"],
        "tho" => &["though"],
        "thru" => &["through"],
        "w" | "wiv" => &["with"],
        "r" => &["are"],
        "px" => &["pixels"],
        "shouldve" => &["should"],
        "nothings" => &["nothing", "is"],
        "everythings" => &["everything", "is"],
        "spose" => &["suppose"],
        "smth" => &["something"],
        "btw" | "tbh" | "imo" | "imho" | "lol" | "lmao" | "ngl" | "haha" => &[],
        "v2" => &["2"],
        "norm" => &["normal"],
        "orientated" => &["oriented"],
        "2wice" => &["twice"],
        _ => return None,
    })
}

/// The words that a word of the lexicon stands for, so that both sides meet.
pub fn words_of(word: &str) -> Vec<String> {
    match word {
        "zero" => return vec!["#0".to_owned()],
        "unity" => return vec!["#1".to_owned()],
        _ => {}
    }
    match expanded(word) {
        Some(words) if !words.is_empty() && word != "r" && word != "w" => {
            words.iter().map(|w| (*w).to_owned()).collect()
        }
        _ => vec![word.to_owned()],
    }
}

/// Replaces short forms. `n` between two ordinary words is "and"; else it is the normal.
pub fn expand(tokens: Vec<Token>, answer: &str) -> Vec<Token> {
    let mut out: Vec<Token> = Vec::with_capacity(tokens.len());
    let mut tagged = 0;
    for at in 0..tokens.len() {
        let token = &tokens[at];
        let next = tokens.get(at + 1);
        if tagged > at {
            continue;
        }
        if asks_back(&tokens, at) {
            tagged = at + 2;
            continue;
        }
        let ordinary = |t: Option<&Token>| {
            t.is_some_and(|t| {
                t.kind == Kind::Word
                    && t.word.len() > 2
                    && !is_preposition(&t.word)
                    && t.word != "dot"
            })
        };
        if token.is("n")
            && answer.get(token.start..token.end) == Some("n")
            && ordinary(out.last())
            && ordinary(next)
            && token.spaced
        {
            let names_a_vector = out.last().is_some_and(|t| {
                matches!(
                    t.word.as_str(),
                    "normal" | "vector" | "equals" | "angle" | "between"
                )
            });
            let verb =
                next.is_some_and(|t| matches!(t.word.as_str(), "is" | "are" | "equals" | "and"));
            if !names_a_vector && !verb {
                out.push(Token {
                    word: "and".to_owned(),
                    ..token.clone()
                });
                continue;
            }
        }
        // "light at the sides", "too light": not the thing, but bright.
        let previous = out.last().map(|t| t.word.as_str()).unwrap_or_default();
        let measured = matches!(previous, "too" | "very" | "so" | "becomes" | "looks");
        let follows = next.is_none_or(|t| {
            t.kind != Kind::Word
                || matches!(
                    t.word.as_str(),
                    "at" | "in" | "on" | "and" | "but" | "there" | "near" | "around" | "towards"
                )
        });
        let opens = out.last().is_none_or(|t| t.kind != Kind::Word);
        let measures = measured
            || opens && next.is_some_and(|t| is_preposition(&t.word))
            || opens
                && next.is_some_and(|t| {
                    matches!(
                        t.word.as_str(),
                        "rim"
                            | "edge"
                            | "edges"
                            | "border"
                            | "outline"
                            | "contour"
                            | "silhouette"
                            | "ring"
                    )
                });
        if token.is("light") && (follows || opens) && measures {
            out.push(Token {
                word: "bright".to_owned(),
                ..token.clone()
            });
            continue;
        }
        let symbol = matches!(token.word.as_str(), "r" | "w" | "u")
            && next.is_some_and(|t| t.kind != Kind::Word);
        let chat = if token.is("v2") || token.is("norm") {
            None
        } else {
            expanded(&token.word)
        };
        match chat {
            Some(words) if token.kind == Kind::Word && !symbol => {
                for word in words {
                    out.push(Token {
                        word: (*word).to_owned(),
                        ..token.clone()
                    });
                }
            }
            _ => out.push(token.clone()),
        }
    }
    out
}

/// "…, isn't it?" asks for a nod and denies nothing.
fn asks_back(tokens: &[Token], at: usize) -> bool {
    let word = |i: usize| tokens.get(i).map_or("", |t| t.word.as_str());
    matches!(
        word(at),
        "isnt"
            | "arent"
            | "doesnt"
            | "dont"
            | "wont"
            | "cant"
            | "wouldnt"
            | "wasnt"
            | "aint"
            | "innit"
    ) && matches!(word(at + 1), "it" | "they" | "you" | "he" | "we")
        && tokens
            .get(at + 2)
            .is_none_or(|t| t.kind != Kind::Word && t.kind != Kind::Value)
}

/// Words that lead to a place or a circumstance.
pub fn is_preposition(word: &str) -> bool {
    matches!(
        word,
        "at" | "in"
            | "on"
            | "near"
            | "around"
            | "along"
            | "toward"
            | "towards"
            | "for"
            | "round"
            | "to"
            | "by"
            | "with"
            | "of"
            | "over"
            | "from"
            | "under"
            | "across"
            | "inside"
            | "within"
            | "beside"
            | "outside"
            | "about"
            | "through"
            | "above"
            | "below"
            | "against"
            | "next"
            | "close"
    )
}

/// The positive form of a comparative or superlative, where the word looks like one.
pub fn positive(word: &str) -> Option<String> {
    let base = word
        .strip_suffix("est")
        .or_else(|| word.strip_suffix("er"))?;
    if base.len() < 3 {
        return None;
    }
    if let Some(stem) = base.strip_suffix('i') {
        return Some(format!("{stem}y"));
    }
    let mut letters = base.chars().rev();
    if let (Some(a), Some(b)) = (letters.next(), letters.next())
        && a == b
        && !matches!(a, 'l' | 's')
    {
        return Some(base[..base.len() - a.len_utf8()].to_owned());
    }
    Some(base.to_owned())
}

/// How many typing errors a word of this length may carry.
pub fn errors_allowed(length: usize) -> usize {
    match length {
        0..=4 => 0,
        5..=8 => 1,
        _ => 2,
    }
}
