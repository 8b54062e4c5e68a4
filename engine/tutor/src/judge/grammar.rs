//! The words that hold a sentence together: what ends a clause, denies, corrects, compares.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use super::text::Token;

/// Words that state nothing by themselves and that no typo is read into.
const GLUE: &str = include_str!("known.txt");

/// Whether a word is part of the language's machinery, or so common that no typo means it.
pub fn is_known(word: &str) -> bool {
    static KNOWN: OnceLock<BTreeSet<&'static str>> = OnceLock::new();
    KNOWN
        .get_or_init(|| GLUE.split_whitespace().collect())
        .contains(word)
}

/// Words that hold a sentence together: where there are none, there is only a list.
pub fn is_glue(word: &str) -> bool {
    matches!(
        word,
        "a" | "an"
            | "the"
            | "this"
            | "that"
            | "it"
            | "its"
            | "is"
            | "are"
            | "was"
            | "be"
            | "as"
            | "so"
            | "because"
            | "since"
            | "but"
            | "while"
            | "whereas"
            | "than"
            | "of"
            | "in"
            | "on"
            | "at"
            | "to"
            | "from"
            | "by"
            | "with"
            | "for"
            | "there"
            | "here"
            | "where"
            | "when"
            | "which"
            | "if"
            | "then"
            | "not"
            | "no"
            | "has"
            | "have"
            | "gets"
            | "get"
            | "you"
            | "i"
            | "we"
            | "one"
            | "will"
            | "would"
            | "should"
            | "can"
            | "does"
            | "do"
            | "too"
            | "more"
            | "towards"
            | "toward"
            | "and"
            | "or"
            | "->"
            | "="
            | "~"
            | ";"
            | "--"
            | "goes"
            | "becomes"
            | "means"
            | "only"
            | "just"
            | "all"
            | "into"
            | "over"
            | "like"
    )
}

/// Words that deny what follows in their clause.
pub fn is_negator(word: &str) -> bool {
    matches!(
        word,
        "not"
            | "no"
            | "never"
            | "neither"
            | "nor"
            | "none"
            | "nothing"
            | "nobody"
            | "without"
            | "hardly"
            | "barely"
            | "scarcely"
            | "lacks"
            | "unlike"
            | "nowhere"
            | "wrongly"
    )
}

/// Whether what follows is what something is compared with: "than", "with respect to".
pub fn compares(tokens: &[Token], at: usize) -> bool {
    let next = |words: &[&str]| {
        tokens
            .get(at + 1)
            .is_some_and(|t| words.contains(&&*t.word))
    };
    match tokens[at].word.as_str() {
        // "a broad sheen rather than a spot" compares nothing.
        "than" => !at
            .checked_sub(1)
            .is_some_and(|i| matches!(tokens[i].word.as_str(), "rather" | "other")),
        "compared" | "outshines" | "outshine" | "outshining" | "outglows" | "outdoes" => true,
        // "Five orders of magnitude above the other."
        "above" | "over" => at
            .checked_sub(1)
            .is_some_and(|i| matches!(tokens[i].word.as_str(), "magnitude" | "stops")),
        "respect" | "relative" | "relatively" | "comparison" => next(&["to", "with"]),
        _ => false,
    }
}

/// Whether two things are spoken of together from here on: "both lobes are", "in either photo".
pub fn means_both(tokens: &[Token], at: usize) -> bool {
    let word = |i: usize| tokens.get(i).map_or("", |t| t.word.as_str());
    match word(at) {
        // "both small and bright"
        "both" => !(at + 2..at + 5).any(|i| word(i) == "and"),
        "either" => matches!(
            word(at + 1),
            "case" | "ball" | "photo" | "picture" | "image" | "surface" | "shot" | "photograph"
        ),
        _ => false,
    }
}

/// Words that end the reach of a denial.
pub fn ends_denial(word: &str) -> bool {
    matches!(
        word,
        "but"
            | "because"
            | "since"
            | "so"
            | "while"
            | "whereas"
            | "although"
            | "though"
            | "however"
            | "instead"
            | "then"
            | "hence"
            | "therefore"
            | "thus"
            | "as"
            | "yet"
            | "rather"
            | "just"
            | "only"
            | "even"
    )
}

/// Words that begin another clause.
pub fn begins_clause(word: &str) -> bool {
    matches!(
        word,
        "but"
            | "because"
            | "since"
            | "so"
            | "while"
            | "whereas"
            | "although"
            | "though"
            | "however"
            | "therefore"
            | "thus"
            | "hence"
            | "then"
            | "yet"
            | "whilst"
            | "if"
            | "unless"
            | "which"
            | "nevertheless"
            | "otherwise"
            | "meanwhile"
            | "->"
            | "when"
            | "where"
            | "that"
            | "until"
    )
}

/// Forms of "to be" and its like, between a subject and what is said of it.
pub fn is_copula(word: &str) -> bool {
    matches!(
        word,
        "is" | "are"
            | "was"
            | "were"
            | "be"
            | "being"
            | "been"
            | "becomes"
            | "become"
            | "became"
            | "gets"
            | "get"
            | "looks"
            | "look"
            | "appears"
            | "appear"
            | "stays"
            | "stay"
            | "seems"
            | "turns"
            | "goes"
            | "go"
            | "will"
            | "would"
            | "comes"
            | "come"
            | "remains"
            | "remain"
            | "="
            | "->"
            | "~"
            | ";"
            | "too"
            | "very"
            | "way"
            | "so"
            | "much"
            | "far"
            | "more"
            | "the"
            | "really"
            | "also"
            | "both"
            | "has"
            | "have"
            | "a"
            | "an"
            | "all"
            | "itself"
            | "coming"
            | "getting"
            | "looking"
            | "to"
            | "should"
            | "can"
            | "could"
            | "must"
            | "does"
            | "do"
    )
}

/// Words that ask, at the beginning of a question.
pub fn asks(word: &str) -> bool {
    matches!(
        word,
        "what"
            | "why"
            | "how"
            | "when"
            | "where"
            | "who"
            | "which"
            | "does"
            | "do"
            | "is"
            | "are"
            | "can"
            | "could"
            | "would"
            | "should"
            | "will"
            | "did"
            | "has"
            | "have"
            | "shall"
            | "may"
    )
}

/// Whether two words open a question: the verb stands before its subject.
pub fn inverts(verb: &str, subject: &str) -> bool {
    let helps = matches!(
        verb,
        "is" | "are"
            | "does"
            | "do"
            | "can"
            | "could"
            | "would"
            | "should"
            | "will"
            | "did"
            | "shall"
            | "may"
    );
    let known = matches!(
        subject,
        "it" | "they" | "i" | "you" | "we" | "there" | "this" | "that" | "d"
    );
    let full = !matches!(verb, "is" | "are") && subject == "the";
    helps && (known || full)
}

/// Verbs of saying and thinking.
pub fn speaks(word: &str) -> bool {
    matches!(
        word,
        "say"
            | "says"
            | "said"
            | "claim"
            | "claims"
            | "claimed"
            | "argue"
            | "argues"
            | "argued"
            | "think"
            | "thinks"
            | "believe"
            | "believes"
            | "insist"
            | "insists"
            | "reckon"
            | "reckons"
            | "assume"
            | "assumes"
            | "suggest"
            | "suggests"
            | "told"
            | "tell"
            | "tells"
    )
}

/// Words for people other than who speaks and who listens.
pub fn names_others(word: &str) -> bool {
    matches!(
        word,
        "he" | "she"
            | "they"
            | "some"
            | "people"
            | "everyone"
            | "everybody"
            | "others"
            | "many"
            | "most"
            | "teacher"
            | "professor"
            | "prof"
            | "colleague"
            | "friend"
            | "book"
            | "books"
            | "textbook"
            | "someone"
            | "somebody"
            | "boss"
            | "students"
            | "beginners"
            | "learners"
            | "folk"
            | "folks"
            | "guys"
            | "colleagues"
            | "anyone"
    )
}

/// Verbs that weaken another.
pub fn is_modal(word: &str) -> bool {
    matches!(word, "might" | "may" | "could" | "would" | "can")
}

/// Whether somebody says here that he does not know, or speaks of answers instead of giving one.
pub fn disclaims(tokens: &[Token], at: usize) -> bool {
    let word = |i: usize| tokens.get(i).map_or("", |t| t.word.as_str());
    match word(at) {
        "dunno" | "idk" | "forgot" | "clueless" | "clue" | "unsure" | "described" | "rubric"
        | "answered" | "marks" => true,
        "no" => matches!(word(at + 1), "idea" | "clue"),
        "not" => matches!(
            word(at + 1),
            "know"
                | "remember"
                | "recall"
                | "sure"
                | "certain"
                | "tell"
                | "say"
                | "do"
                | "solve"
                | "work"
                | "figure"
                | "explain"
                | "get"
                | "understand"
        ),
        _ => false,
    }
}

/// Words behind "is not" that deny that something comes of their subject.
pub fn denies_source(word: &str) -> bool {
    matches!(word, "where" | "why" | "reason" | "cause" | "what")
}

/// Words behind "is not" that deny their subject: "1/pi is not the value".
pub fn denies_subject(word: &str) -> bool {
    matches!(
        word,
        "value"
            | "case"
            | "true"
            | "there"
            | "right"
            | "correct"
            | "so"
            | "how"
            | "answer"
            | "result"
            | "it"
    )
}

/// Expressions after which a learner takes back what he just said.
pub const CORRECTIONS: &[&[&str]] = &[
    &["wait"],
    &["but", "no"],
    &["no", "wait"],
    &["scratch", "that"],
    &["strike", "that"],
    &["correction"],
    &["i", "mean"],
    &["or", "was", "it"],
    &["or", "is", "it"],
    &["sorry"],
    &["actually", "no"],
    &["no", ",", "actually"],
    &["hmm"],
    &["hm"],
    &["oops"],
    &["on", "second", "thought"],
    &["on", "reflection"],
    &["or", "rather"],
    &["no", ","],
    &["nope"],
    &["actually"],
    &["i", "take", "that", "back"],
    &["forget", "that"],
    &["other", "way", "around"],
    &["other", "way", "round"],
    &["vice", "versa"],
    &["reversed"],
    &["non"],
];

/// Expressions that call what was just said wrong.
pub const DISMISSALS: &[&[&str]] = &[
    &["that", "would", "be", "silly"],
    &["would", "be", "wrong"],
    &["would", "be", "silly"],
    &["would", "be", "a", "mistake"],
    &["that", "is", "wrong"],
    &["that", "is", "false"],
    &["which", "is", "wrong"],
    &["which", "is", "false"],
    &["this", "is", "wrong"],
    &["is", "not", "true"],
    &["is", "not", "the", "case"],
    &["is", "a", "myth"],
    &["is", "nonsense"],
    &["classic", "error"],
    &["common", "mistake"],
    &["classic", "mistake"],
    &["is", "a", "misconception"],
    &[",", "i", "dispute"],
    &[",", "i", "doubt"],
    &["are", "the", "classic"],
];

/// Expressions behind which nothing is claimed.
pub const WONDERS: &[&[&str]] = &[
    &["wonder", "if"],
    &["wonder", "whether"],
    &["wondering", "if"],
    &["wondering", "whether"],
    &["sure", "if"],
    &["sure", "whether"],
    &["unsure", "if"],
    &["unsure", "whether"],
    &["know", "if"],
    &["not", "remember", "what"],
    &["not", "remember", "how"],
    &["not", "remember", "which"],
    &["not", "recall", "what"],
    &["not", "recall", "how"],
    &["not", "recall", "which"],
    &["forgot", "what"],
    &["forgot", "which"],
    &["forgotten", "what"],
    &["forgotten", "which"],
    &["know", "whether"],
    &["idea", "if"],
    &["idea", "whether"],
    &["tell", "if"],
    &["tell", "whether"],
    &["say", "whether"],
];

/// Expressions that report what somebody else might say.
pub const REPORTS: &[&[&str]] = &[
    &["you", "might", "think"],
    &["you", "would", "think"],
    &["you", "may", "think"],
    &["one", "might", "think"],
    &["one", "would", "think"],
    &["one", "might", "expect"],
    &["you", "might", "expect"],
    &["you", "would", "expect"],
    &["forget"],
    &["never", "mind"],
    &["people", "say"],
    &["some", "say"],
    &["people", "think"],
    &["some", "people"],
    &["some", "would"],
    &["wrong", "to", "say"],
    &["wrong", "to", "think"],
    &["false", "that"],
    &["myth", "that"],
    &["mistake", "to"],
    &["instead", "of"],
    &["rather", "than"],
    &["anything", "but"],
    &["far", "from"],
    &["not", "buy"],
    &["doubt", "that"],
    &["in", "place", "of"],
    &["as", "opposed", "to"],
    &["fails", "to"],
    &["fail", "to"],
];
