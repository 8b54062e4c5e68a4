//! Reading a TOML table key by key: what is missing, unknown or of the wrong kind is a finding
//! at its place, and reading goes on.

use std::cell::RefCell;

use serde::de::DeserializeOwned;
use serde_spanned::Spanned;
use toml::de::{DeTable, DeValue};

use super::literal;
use crate::finding::{Finding, Place};
use crate::lesson::{EntryPlaces, Figures, Formula, Given, Printed, Text};

/// A file being read.
pub struct Source<'a> {
    pub file: &'a str,
    pub text: &'a str,
    pub findings: RefCell<Vec<Finding>>,
}

impl<'a> Source<'a> {
    pub fn finding(&self, place: Place, code: &'static str, message: impl Into<String>) -> Finding {
        Finding::new(self.file, self.text, place, code, message)
    }

    pub fn report(&self, finding: Finding) {
        self.findings.borrow_mut().push(finding);
    }

    /// Reports an error of the formula language in `text`.
    pub fn report_formula(&self, text: &Text, error: &formula::Error) {
        let place = literal::place_in(
            self.text,
            text.place,
            &text.text,
            error.span.start,
            error.span.end,
        );
        let mut finding = self.finding(place, "formula", error.message.clone());
        finding.help = error.help.clone();
        self.report(finding);
    }

    /// Parses a string as an expression.
    pub fn formula(&self, text: Text) -> Option<Formula> {
        match formula::parse(&text.text) {
            Ok(expr) => Some(Formula { text, expr }),
            Err(error) => {
                self.report_formula(&text, &error);
                None
            }
        }
    }

    fn wrong_kind(&self, value: &Spanned<DeValue<'_>>, what: &str, expected: &str) {
        let found = value.get_ref().type_str();
        self.report(
            self.finding(
                place(value),
                "wrong-kind",
                format!("{what} is {} here.", with_article(found)),
            )
            .expecting(expected),
        );
    }
}

fn with_article(noun: &str) -> String {
    let vowel = noun.starts_with(['a', 'e', 'i', 'o', 'u']);
    format!("{} {noun}", if vowel { "an" } else { "a" })
}

/// The place of a spanned value.
pub fn place<T>(value: &Spanned<T>) -> Place {
    Place {
        start: value.span().start,
        end: value.span().end,
    }
}

/// A table being read; [`Table::finish`] reports the keys that nobody asked for.
pub struct Table<'s, 't> {
    pub source: &'s Source<'s>,
    table: &'t DeTable<'t>,
    /// Where the table is announced.
    pub place: Place,
    /// How messages call it, such as `[[exercise]]`.
    what: String,
    asked: RefCell<Vec<&'static str>>,
    /// Keys that are missing, told at the end unless they are there misspelt.
    missing: RefCell<Vec<(String, Finding)>>,
}

impl<'s, 't> Table<'s, 't> {
    pub fn new(source: &'s Source<'s>, table: &'t DeTable<'t>, place: Place, what: &str) -> Self {
        Table {
            source,
            table,
            place,
            what: what.to_owned(),
            asked: RefCell::new(Vec::new()),
            missing: RefCell::new(Vec::new()),
        }
    }

    pub fn get(&self, key: &'static str) -> Option<&'t Spanned<DeValue<'t>>> {
        if !self.asked.borrow().contains(&key) {
            self.asked.borrow_mut().push(key);
        }
        self.table.get(key)
    }

    pub fn has(&self, key: &'static str) -> bool {
        self.get(key).is_some()
    }

    /// The place of a key's value, else of the table.
    pub fn place_of(&self, key: &'static str) -> Place {
        self.get(key).map_or(self.place, place)
    }

    /// Reports that a key is missing.
    pub fn missing(&self, key: &str, expected: &str) {
        let message = format!("{} has no `{key}`.", self.what);
        let finding = self.source.finding(self.place, "missing-key", message);
        self.missing
            .borrow_mut()
            .push((key.to_owned(), finding.expecting(expected)));
    }

    /// Reports something about a key's value.
    pub fn wrong(&self, key: &'static str, code: &'static str, message: String, expected: &str) {
        let finding = self.source.finding(self.place_of(key), code, message);
        self.source.report(finding.expecting(expected));
    }

    pub fn text(&self, key: &'static str) -> Option<Text> {
        let value = self.get(key)?;
        let text = as_text(value);
        if text.is_none() {
            self.source
                .wrong_kind(value, &format!("`{key}`"), "a string");
        }
        text
    }

    pub fn need_text(&self, key: &'static str) -> Text {
        if !self.has(key) {
            self.missing(key, &format!("{key} = \"…\""));
        }
        self.text(key).unwrap_or_default()
    }

    pub fn formula(&self, key: &'static str) -> Option<Formula> {
        self.source.formula(self.text(key)?)
    }

    pub fn need_formula(&self, key: &'static str) -> Option<Formula> {
        if !self.has(key) {
            self.missing(key, &format!("{key} = \"an expression\""));
        }
        self.formula(key)
    }

    pub fn bool(&self, key: &'static str) -> Option<bool> {
        let value = self.get(key)?;
        let found = value.get_ref().as_bool();
        if found.is_none() {
            self.source
                .wrong_kind(value, &format!("`{key}`"), "true or false");
        }
        found
    }

    pub fn number(&self, key: &'static str) -> Option<f64> {
        let value = self.get(key)?;
        self.as_number(value, &format!("`{key}`"))
    }

    pub fn as_number(&self, value: &Spanned<DeValue<'_>>, what: &str) -> Option<f64> {
        let found = number(value);
        if found.is_none() {
            self.source.wrong_kind(value, what, "a finite number");
        }
        found
    }

    /// A whole number in `0..=limit`.
    pub fn count(&self, key: &'static str, limit: u32) -> Option<u32> {
        let value = self.get(key)?;
        let found =
            number(value).filter(|n| n.fract() == 0.0 && (0.0..=f64::from(limit)).contains(n));
        if found.is_none() {
            let expected = format!("a whole number from 0 to {limit}");
            self.source
                .wrong_kind(value, &format!("`{key}`"), &expected);
        }
        found.map(|n| n as u32)
    }

    /// A string or an array of strings.
    pub fn texts(&self, key: &'static str) -> Vec<Text> {
        let Some(value) = self.get(key) else {
            return Vec::new();
        };
        if let Some(text) = as_text(value) {
            return vec![text];
        }
        let Some(array) = value.get_ref().as_array() else {
            let what = format!("`{key}`");
            self.source.wrong_kind(value, &what, "an array of strings");
            return Vec::new();
        };
        let mut texts = Vec::new();
        for entry in array.iter() {
            match as_text(entry) {
                Some(text) => texts.push(text),
                None => {
                    let what = format!("An entry of `{key}`");
                    self.source.wrong_kind(entry, &what, "a string");
                }
            }
        }
        texts
    }

    /// An array of numbers, or one number.
    pub fn numbers(&self, value: &Spanned<DeValue<'_>>, what: &str) -> Option<Vec<f64>> {
        match value.get_ref().as_array() {
            Some(array) => array
                .iter()
                .map(|entry| self.as_number(entry, &format!("An entry of {what}")))
                .collect(),
            None => {
                self.source.wrong_kind(value, what, "an array of numbers");
                None
            }
        }
    }

    /// An array of numbers with their places; it has to be there.
    pub fn printed(&self, key: &'static str) -> Vec<Printed> {
        let Some(value) = self.get(key) else {
            self.missing(key, &format!("{key} = [64, 512]"));
            return Vec::new();
        };
        let Some(array) = value.get_ref().as_array() else {
            let what = format!("`{key}`");
            self.source.wrong_kind(value, &what, "an array of numbers");
            return Vec::new();
        };
        let entries = array.iter().filter_map(|entry| {
            Some(Printed {
                value: self.as_number(entry, &format!("An entry of `{key}`"))?,
                place: place(entry),
            })
        });
        entries.collect()
    }

    /// The entries of a table of anything, in the file's order, keys included.
    pub fn entries(&self, key: &'static str) -> Vec<(Text, &'t Spanned<DeValue<'t>>)> {
        let Some(value) = self.get(key) else {
            return Vec::new();
        };
        let Some(table) = value.get_ref().as_table() else {
            self.source
                .wrong_kind(value, &format!("`{key}`"), "a table such as { name = 0.5 }");
            return Vec::new();
        };
        in_order(table)
    }

    pub fn givens(&self, key: &'static str) -> Vec<Given> {
        self.entries(key)
            .into_iter()
            .filter_map(|(name, value)| {
                let number = self.as_number(value, &format!("`{name}`"))?;
                let place = place(value);
                Some(Given {
                    name,
                    value: number,
                    place,
                })
            })
            .collect()
    }

    pub fn table(&self, key: &'static str, what: &str) -> Option<Table<'s, 't>> {
        let value = self.get(key)?;
        let Some(table) = value.get_ref().as_table() else {
            self.source
                .wrong_kind(value, &format!("`{key}`"), "a table");
            return None;
        };
        Some(Table::new(self.source, table, place(value), what))
    }

    /// `[[key]]`, or an array of inline tables.
    pub fn tables(&self, key: &'static str, what: &str) -> Vec<Table<'s, 't>> {
        let Some(value) = self.get(key) else {
            return Vec::new();
        };
        let Some(array) = value.get_ref().as_array() else {
            self.source
                .wrong_kind(value, &format!("`{key}`"), &format!("two brackets: {what}"));
            return Vec::new();
        };
        let mut tables = Vec::new();
        for entry in array.iter() {
            match entry.get_ref().as_table() {
                Some(table) => tables.push(Table::new(self.source, table, place(entry), what)),
                None => self
                    .source
                    .wrong_kind(entry, &format!("An entry of `{key}`"), "a table"),
            }
        }
        tables
    }

    /// Entries that serde reads, with their places.
    pub fn deserialized<T: DeserializeOwned>(
        &self,
        key: &'static str,
    ) -> (Vec<T>, Vec<EntryPlaces>) {
        let Some(value) = self.get(key) else {
            return Default::default();
        };
        let Some(array) = value.get_ref().as_array() else {
            self.source
                .wrong_kind(value, &format!("`{key}`"), "an array of tables");
            return Default::default();
        };
        let mut found = (Vec::new(), Vec::new());
        for entry in array.iter() {
            match T::deserialize(toml::de::ValueDeserializer::from(entry.clone())) {
                Ok(value) => {
                    found.0.push(value);
                    found.1.push(entry_places(entry));
                }
                Err(error) => self
                    .source
                    .report(serde_finding(self.source, entry, &error)),
            }
        }
        found
    }

    /// Ids of what is shown below a text.
    pub fn figures(&self) -> Figures {
        Figures {
            table: self.texts("table"),
            plot: self.texts("plot"),
            map: self.texts("map"),
            picture: self.texts("picture"),
        }
    }

    /// Reports the keys that nobody asked for, and those that are missing.
    pub fn finish(&self) {
        let asked = self.asked.borrow();
        let mut missing = self.missing.take();
        for (key, _) in in_order(self.table) {
            if !asked.contains(&key.text.as_str()) {
                let known = asked.iter().copied();
                let finding = unknown_key(self.source, key.place, &self.what, &key, known);
                missing.retain(|(name, _)| finding.expected.as_ref() != Some(name));
                self.source.report(finding);
            }
        }
        for (_, finding) in missing {
            self.source.report(finding);
        }
    }
}

fn entry_places(entry: &Spanned<DeValue<'_>>) -> EntryPlaces {
    let table = entry.get_ref().as_table();
    let keys = table.into_iter().flat_map(in_order).map(|(key, value)| {
        let mut at = place(value);
        if value.get_ref().is_str() && at.end >= at.start + 2 {
            at = Place {
                start: at.start + 1,
                end: at.end - 1,
            };
        }
        (key.text, at)
    });
    EntryPlaces {
        whole: place(entry),
        keys: keys.collect(),
    }
}

fn unknown_key<'k>(
    source: &Source<'_>,
    place: Place,
    what: &str,
    key: &str,
    known: impl Iterator<Item = &'k str>,
) -> Finding {
    let known: Vec<&str> = known.collect();
    let finding = source.finding(place, "unknown-key", format!("{what} has no key `{key}`."));
    match nearest(key, known.iter().copied()) {
        Some(near) => finding
            .expecting(near.to_owned())
            .with_help(format!("Did you mean `{near}`?")),
        None => finding.with_help(format!("It knows {}.", known.join(", "))),
    }
}

/// What serde says about an entry, at its place.
fn serde_finding(
    source: &Source<'_>,
    entry: &Spanned<DeValue<'_>>,
    error: &toml::de::Error,
) -> Finding {
    let span = error.span().filter(|span| span.start != span.end);
    let at = span.map_or(place(entry), |span| Place {
        start: span.start,
        end: span.end,
    });
    let message = error.message();
    if let Some(rest) = message.strip_prefix("unknown field ") {
        let names: Vec<&str> = rest.split('`').skip(1).step_by(2).collect();
        if let Some((key, known)) = names.split_first() {
            return unknown_key(source, at, "It", key, known.iter().copied());
        }
    }
    source.finding(at, "wrong-kind", format!("{}.", capitalised(message)))
}

/// A sentence's first letter in upper case.
pub fn capitalised(text: &str) -> String {
    let text = text.trim().trim_end_matches('.');
    let mut chars = text.chars();
    match chars.next() {
        Some(first) => first.to_uppercase().chain(chars).collect(),
        None => String::new(),
    }
}

/// The known name nearest to a misspelt one, if it is near at all.
pub fn nearest<'k>(name: &str, known: impl Iterator<Item = &'k str>) -> Option<&'k str> {
    known
        .map(|candidate| (strsim::jaro_winkler(name, candidate), candidate))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

fn as_text(value: &Spanned<DeValue<'_>>) -> Option<Text> {
    Some(Text {
        text: value.get_ref().as_str()?.to_owned(),
        place: place(value),
    })
}

/// A finite number, whole or not.
pub fn number(value: &Spanned<DeValue<'_>>) -> Option<f64> {
    let found = match value.get_ref() {
        DeValue::Integer(integer) => {
            i64::from_str_radix(integer.as_str(), integer.radix()).ok()? as f64
        }
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    f64::is_finite(found).then_some(found)
}

/// A table's entries in the file's order.
pub fn in_order<'t>(table: &'t DeTable<'t>) -> Vec<(Text, &'t Spanned<DeValue<'t>>)> {
    let mut entries: Vec<_> = table
        .iter()
        .map(|(key, value)| {
            let key = Text {
                text: key.get_ref().to_string(),
                place: place(key),
            };
            (key, value)
        })
        .collect();
    entries.sort_by_key(|(key, _)| key.place);
    entries
}
