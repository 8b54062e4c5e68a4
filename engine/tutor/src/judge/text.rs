//! From bytes to tokens: Unicode, LaTeX, code and everyday typing brought to one form.
//!
//! Every token keeps its byte range in the answer, so that a decision can be quoted. One
//! pass, no recursion: linear in the answer.

use unicode_normalization::UnicodeNormalization;

use super::signs::{Brace, Items, greek, is_combining, is_invisible, operator, superscript};

/// What a token is for those who read on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A word, lower case, without accents or apostrophes.
    Word,
    /// A number as written, or a value or formula that was recognised (`#1/pi`).
    Value,
    /// An operator, bracket or arrow.
    Op,
    /// A comma.
    Comma,
    /// Ends a clause: colon, semicolon, dash.
    Break,
    /// Ends a sentence; also an empty line or bullet.
    Stop,
    /// Ends a question.
    Question,
}

/// One token and where it stands.
#[derive(Clone, Debug)]
pub struct Token {
    /// Normalised form.
    pub word: String,
    /// What it is.
    pub kind: Kind,
    /// First byte in the answer.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
    /// Whether white space stands before it.
    pub spaced: bool,
}

impl Token {
    /// Whether it is this word, operator or value.
    pub fn is(&self, word: &str) -> bool {
        #[cfg(test)]
        super::steps::step();
        self.word == word
    }

    /// Whether it ends a sentence.
    pub fn ends_sentence(&self) -> bool {
        matches!(self.kind, Kind::Stop | Kind::Question)
    }
}

struct Reader<'a> {
    chars: Vec<(usize, char)>,
    answer: &'a str,
    at: usize,
    tokens: Vec<Token>,
    spaced: bool,
    braces: Vec<Brace>,
    next_brace: Option<Brace>,
    items: Option<Items>,
    numbered: bool,
}

/// Splits an answer into tokens.
pub fn tokens(answer: &str) -> Vec<Token> {
    let mut reader = Reader {
        chars: answer.char_indices().collect(),
        answer,
        at: 0,
        tokens: Vec::new(),
        spaced: true,
        braces: Vec::new(),
        next_brace: None,
        items: None,
        numbered: answer.lines().any(|line| {
            let line = line.trim_start();
            line.starts_with("2.") || line.starts_with("2)")
        }),
    };
    while reader.at < reader.chars.len() {
        reader.step();
    }
    reader.tokens
}

impl Reader<'_> {
    fn peek(&self, ahead: usize) -> Option<char> {
        self.chars.get(self.at + ahead).map(|&(_, c)| c)
    }

    fn byte(&self, index: usize) -> usize {
        self.chars
            .get(index)
            .map_or(self.answer.len(), |&(byte, _)| byte)
    }

    fn push(&mut self, word: impl Into<String>, kind: Kind, from: usize) {
        let (start, end) = (self.byte(from), self.byte(self.at));
        let spaced = std::mem::replace(&mut self.spaced, false);
        self.tokens.push(Token {
            word: word.into(),
            kind,
            start,
            end,
            spaced,
        });
    }

    fn step(&mut self) {
        let from = self.at;
        let c = self.chars[from].1;
        if c == '\\' {
            return self.latex();
        }
        if c.is_ascii_digit()
            || (c == '.' && self.peek(1).is_some_and(|d| d.is_ascii_digit()) && !self.after_word())
        {
            return self.number();
        }
        if let Some(first) = superscript(c) {
            self.push("^", Kind::Op, from);
            let mut digits = String::from(first);
            self.at += 1;
            while let Some(next) = self.peek(0).and_then(superscript) {
                digits.push(next);
                self.at += 1;
            }
            return self.push_exponent(&digits, from);
        }
        if let Some(name) = greek(c) {
            self.at += 1;
            for word in name.split(' ') {
                self.push(word, Kind::Word, from);
            }
            return;
        }
        if c == '%' {
            self.at += 1;
            return self.push("%", Kind::Op, from);
        }
        if c == '°' {
            self.at += 1;
            return self.push("degrees", Kind::Word, from);
        }
        if matches!(c, '{' | '}') {
            return self.brace(c);
        }
        if matches!(c, '-' | '−' | '–' | '‐' | '‑') {
            return self.dash();
        }
        if c == '.' {
            return self.dot();
        }
        if c == '=' && self.peek(1) == Some('>') || c == '-' && self.peek(1) == Some('>') {
            self.at += 2;
            return self.push("->", Kind::Op, from);
        }
        if c == '<' && matches!(self.peek(1), Some('-' | '=')) {
            self.at += 2;
            let word = if self.chars[from + 1].1 == '-' {
                "<-"
            } else {
                "<"
            };
            return self.push(word, Kind::Op, from);
        }
        if c == '!' && self.peek(1) == Some('=') {
            self.at += 2;
            return self.push("!=", Kind::Op, from);
        }
        if c == '&' {
            self.at += 1;
            return self.push("and", Kind::Word, from);
        }
        if matches!(c, '=' | '>') && self.peek(1) == Some('=') {
            self.at += 1;
        }
        if let Some((word, kind)) = operator(c) {
            self.at += 1;
            let separate = self.spaced && self.peek(0).is_some_and(char::is_whitespace);
            if c == '*' && separate && (self.opens() || self.items == Some(Items::Star)) {
                self.items = Some(Items::Star);
                return self.push(".", Kind::Stop, from);
            }
            // Two strokes open a comment in code; the comment is prose.
            if word == "/" && self.peek(0) == Some('/') {
                self.at += 1;
                return self.push(";", Kind::Break, from);
            }
            return self.push(word, kind, from);
        }
        // `x0.25`: times.
        if matches!(c, 'x' | 'X')
            && self.peek(1).is_some_and(|d| d.is_ascii_digit() || d == '.')
            && !self.after_word()
        {
            self.at += 1;
            return self.push("*", Kind::Op, from);
        }
        if c.is_alphabetic() {
            return self.word();
        }
        self.at += 1;
        self.spaced = self.spaced || c.is_whitespace();
        if c == '\n' && self.blank_line() {
            self.items = None;
            self.push(".", Kind::Stop, from);
            self.spaced = true;
        }
    }

    /// After a line break: does an empty line follow? One break wraps a line, which means
    /// nothing; two end a paragraph.
    fn blank_line(&mut self) -> bool {
        let mut ahead = 0;
        while let Some(c) = self.peek(ahead).filter(|c| c.is_whitespace()) {
            ahead += 1;
            if c == '\n' {
                self.at += ahead;
                return true;
            }
        }
        // What was passed over is white space; nobody needs to see it again.
        self.at += ahead;
        false
    }

    /// Whether a sentence begins here.
    fn opens(&self) -> bool {
        self.tokens.last().is_none_or(|t| t.kind == Kind::Stop)
    }

    fn after_word(&self) -> bool {
        self.at > 0 && self.chars[self.at - 1].1.is_alphanumeric()
    }

    fn push_exponent(&mut self, digits: &str, from: usize) {
        if let Some(rest) = digits.strip_prefix('-') {
            self.push("-", Kind::Op, from);
            self.push(rest, Kind::Value, from);
        } else {
            self.push(digits.trim_start_matches('+'), Kind::Value, from);
        }
    }

    fn number(&mut self) {
        let from = self.at;
        let mut text = String::new();
        while let Some(c) = self.peek(0) {
            let digit_follows = self.peek(1).is_some_and(|d| d.is_ascii_digit());
            if c.is_ascii_digit() {
                text.push(c);
            } else if matches!(c, '.' | ',') && digit_follows && !text.contains('.') {
                text.push('.');
            } else if c == '.' && !text.contains('.') && self.point_of_a_float() {
                // `1./pi`, `2.*x`: a float as shaders write it.
            } else {
                break;
            }
            self.at += 1;
        }
        if text.starts_with('.') {
            text.insert(0, '0');
        }
        // `1.` or `2)` where a sentence or a list begins numbers what follows.
        let opens_line = self.opens();
        let number = text.parse::<u32>().ok();
        let opens_list = self.numbered
            && number == Some(1)
            && self.tokens.last().is_some_and(|t| t.kind == Kind::Break);
        let goes_on = self.spaced && number.is_some_and(|n| self.items == Some(Items::Number(n)));
        if (opens_line || opens_list || goes_on)
            && matches!(self.peek(0), Some('.' | ')'))
            && text.len() <= 2
            && self.peek(1).is_some_and(char::is_whitespace)
        {
            self.items = number.map(|n| Items::Number(n + 1));
            self.at += 1;
            return self.push(".", Kind::Stop, from);
        }
        self.push(text, Kind::Value, from);
    }

    /// After digits: is this point part of the number? Only an operator may follow it.
    fn point_of_a_float(&self) -> bool {
        let mut ahead = 1;
        while ahead < 3 && self.peek(ahead).is_some_and(char::is_whitespace) {
            ahead += 1;
        }
        match self.peek(ahead) {
            Some('*' | '/' | '+' | ')' | ',' | '=' | '→' | '⇒') => true,
            Some('-') => ahead == 1 || self.peek(ahead + 1) == Some('>'),
            _ => false,
        }
    }

    fn brace(&mut self, c: char) {
        let from = self.at;
        self.at += 1;
        if c == '{' {
            let brace = self.next_brace.take().unwrap_or(Brace::Group);
            self.braces.push(brace);
            if !matches!(brace, Brace::Silent) {
                self.push("(", Kind::Op, from);
            }
            return;
        }
        match self.braces.pop() {
            Some(Brace::Numerator) => {
                self.push(")", Kind::Op, from);
                self.push("/", Kind::Op, from);
                self.next_brace = Some(Brace::Denominator);
            }
            Some(Brace::Silent) => {}
            _ => self.push(")", Kind::Op, from),
        }
    }

    fn dash(&mut self) {
        let from = self.at;
        if self.peek(1) == Some('>') {
            self.at += 2;
            return self.push("->", Kind::Op, from);
        }
        let before = from.checked_sub(1).map(|i| self.chars[i].1);
        let glued = |c: Option<char>| c.is_some_and(|c| !c.is_whitespace());
        let (joined_left, joined_right) = (glued(before), glued(self.peek(1)));
        self.at += 1;
        let opens_line = self.opens();
        let opens_list = opens_line || self.tokens.last().is_some_and(|t| t.is(";"));
        let goes_on = self.items == Some(Items::Dash) && !joined_left;
        if (opens_list || goes_on) && !joined_right {
            self.items = Some(Items::Dash);
            return self.push(".", Kind::Stop, from);
        }
        let wordy = |c: Option<char>| c.is_some_and(|c| c.is_alphabetic() && greek(c).is_none());
        if joined_left
            && joined_right
            && wordy(before)
            && wordy(self.peek(0))
            && self.chars[from].1 != '−'
        {
            // A hyphen: two words of one name. A lone letter is a symbol: a difference.
            let lone = |at: usize| {
                !self
                    .chars
                    .get(at)
                    .is_some_and(|&(_, c)| c.is_alphanumeric())
            };
            if !(from >= 1 && (from < 2 || lone(from - 2)) && lone(self.at + 1)) {
                self.spaced = false;
                return;
            }
        }
        // With space on both sides: a dash, unless numbers or symbols stand around it.
        let arithmetic = |c: Option<char>| {
            c.is_some_and(|c| {
                c.is_ascii_digit() || matches!(c, ')' | '(' | '^') || greek(c).is_some()
            })
        };
        let mut right = 0;
        while self.peek(right).is_some_and(char::is_whitespace) && right < 3 {
            right += 1;
        }
        let left = (from.saturating_sub(2)..from)
            .rev()
            .map(|i| self.chars[i].1)
            .find(|c| !c.is_whitespace());
        let is_minus = self.chars[from].1 == '−'
            || arithmetic(self.peek(right))
            || (arithmetic(left) && joined_left && joined_right);
        if is_minus && !(opens_line) {
            self.push("-", Kind::Op, from);
        } else if self.peek(0) == Some('-')
            || !joined_left
            || !joined_right
            || self.chars[from].1 != '-'
        {
            self.push("--", Kind::Break, from);
        } else {
            self.push("-", Kind::Op, from);
        }
    }

    fn dot(&mut self) {
        let from = self.at;
        self.at += 1;
        if self.peek(0) == Some('.') {
            while self.peek(0) == Some('.') {
                self.at += 1;
            }
            return self.push("...", Kind::Break, from);
        }
        let single = |index: Option<usize>| {
            index
                .and_then(|i| self.chars.get(i))
                .is_some_and(|&(_, c)| c.is_alphabetic())
        };
        let letter_before = single(from.checked_sub(1)) && !single(from.checked_sub(2));
        let letter_after = single(Some(self.at)) && !single(Some(self.at + 1));
        if letter_before && letter_after {
            self.push("*", Kind::Op, from);
        } else {
            self.push(".", Kind::Stop, from);
        }
    }

    fn word(&mut self) {
        let from = self.at;
        let abbreviated = |a: char, b: char| {
            let at = |i: usize| self.peek(i).map(|c| c.to_ascii_lowercase());
            [at(0), at(1), at(2), at(3)] == [Some(a), Some('.'), Some(b), Some('.')]
        };
        if abbreviated('i', 'e') || abbreviated('e', 'g') {
            self.at += 4;
            return self.push("namely", Kind::Word, from);
        }
        let mut text = String::new();
        while let Some(c) = self.peek(0) {
            if greek(c).is_some() || superscript(c).is_some() {
                break;
            }
            let joins = matches!(c, '\'' | '’' | '‘' | '`')
                && self.peek(1).is_some_and(char::is_alphabetic)
                && !text.is_empty();
            // "the mirror's": whose it is, or what it is, shows where it stands.
            let owns = joins
                && matches!(self.peek(1), Some('s' | 'S'))
                && !self.peek(2).is_some_and(char::is_alphanumeric)
                && text.len() > 2
                && !is_pronoun(&text);
            if owns {
                self.at += 2;
                break;
            }
            if c.is_alphanumeric() {
                text.extend(
                    c.nfkd()
                        .filter(|d| d.is_alphanumeric())
                        .flat_map(char::to_lowercase),
                );
            } else if !(joins
                || is_invisible(c)
                || c == '_' && self.peek(1).is_some_and(char::is_alphanumeric)
                || is_combining(c))
            {
                break;
            }
            self.at += 1;
        }
        if matches!(text.as_str(), "vs" | "approx" | "resp" | "cf") && self.peek(0) == Some('.') {
            self.at += 1;
        }
        self.push(text, Kind::Word, from);
    }

    /// `\frac{a}{b}`, and `\frac12`: a digit or a letter needs no braces.
    fn fraction(&mut self) {
        while self.peek(0) == Some(' ') {
            self.at += 1;
        }
        let from = self.at;
        match self.peek(0) {
            Some(c) if c.is_ascii_alphanumeric() => {
                self.at += 1;
                let kind = if c.is_ascii_digit() {
                    Kind::Value
                } else {
                    Kind::Word
                };
                self.push(c.to_ascii_lowercase(), kind, from);
                self.push("/", Kind::Op, from);
            }
            _ => self.next_brace = Some(Brace::Numerator),
        }
    }

    fn latex(&mut self) {
        let from = self.at;
        self.at += 1;
        let mut name = String::new();
        while let Some(c) = self.peek(0).filter(char::is_ascii_alphabetic) {
            name.push(c);
            self.at += 1;
        }
        match name.as_str() {
            "" => self.at += usize::from(self.at < self.chars.len()),
            "frac" | "tfrac" | "dfrac" | "nicefrac" => self.fraction(),
            "text" | "mathrm" | "mathbf" | "mathit" | "vec" | "hat" | "operatorname" | "textbf"
            | "emph" | "textit" => {
                self.next_brace = Some(Brace::Silent);
            }
            "to" | "rightarrow" | "Rightarrow" | "mapsto" | "implies" | "longrightarrow"
            | "uparrow" | "nearrow" => self.push("->", Kind::Op, from),
            "approx" | "simeq" | "sim" | "propto" => self.push("~", Kind::Op, from),
            "equiv" | "triangleq" => self.push("=", Kind::Op, from),
            "neq" | "ne" => self.push("!=", Kind::Op, from),
            "cdot" | "times" | "cdotp" => self.push("*", Kind::Op, from),
            "le" | "leq" | "ll" | "lt" => self.push("<", Kind::Op, from),
            "ge" | "geq" | "gg" | "gt" => self.push(">", Kind::Op, from),
            "langle" | "lbrack" => self.push("(", Kind::Op, from),
            "rangle" | "rbrack" => self.push(")", Kind::Op, from),
            "infty" => self.push("infinity", Kind::Word, from),
            "varepsilon" | "epsilon" => self.push("epsilon", Kind::Word, from),
            "left" | "right" | "big" | "bigl" | "bigr" | "Big" | "Bigl" | "Bigr" | "quad"
            | "qquad" | "displaystyle" | "lVert" | "rVert" | "lvert" | "rvert" => {}
            _ => self.push(name.to_lowercase(), Kind::Word, from),
        }
    }
}

/// Words behind which an apostrophe and an s stand for "is".
fn is_pronoun(word: &str) -> bool {
    matches!(
        word,
        "it" | "he"
            | "she"
            | "that"
            | "this"
            | "what"
            | "who"
            | "how"
            | "why"
            | "when"
            | "let"
            | "here"
            | "there"
            | "where"
            | "everything"
            | "nothing"
            | "something"
    )
}
