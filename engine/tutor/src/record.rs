//! The log of one session as TOML: what was shown, asked, typed and decided, in order.
//!
//! Nothing is dropped on the way: every value survives the round trip, and a file that this
//! version does not understand is an error that says where, never a shorter record.

use crate::session::{Event, NotedSlip, Start};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::fmt;
use toml::Spanned;
use toml::de::{DeTable, DeValue, ValueDeserializer};

/// The log format that this version writes and reads.
pub const FORMAT: u32 = 1;

/// One session's log.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// What holds for the whole session.
    pub header: Header,
    /// What happened, oldest first.
    pub entries: Vec<Entry>,
}

/// What holds for the whole session.
#[derive(Serialize, Deserialize, Clone, Debug, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// [`FORMAT`].
    pub format: u32,
    /// Version of the program that began the session.
    pub program: String,
    /// Id of the lesson.
    pub lesson: String,
    /// Hash of the lesson file when the session began.
    pub hash: String,
    /// The seed that every number was drawn from.
    #[serde(with = "seed")]
    pub seed: u64,
    /// When the session began, RFC 3339.
    pub started: String,
    /// When it reached its result, RFC 3339.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finished: Option<String>,
    /// Slips that earlier lessons had noted when it began.
    #[serde(default, rename = "slip", skip_serializing_if = "Vec::is_empty")]
    pub slips: Vec<NotedSlip>,
}

/// One thing that happened.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// When, RFC 3339.
    pub at: String,
    /// Milliseconds since the entry before, as the app measured them; at most `i64::MAX`.
    pub took_ms: u64,
    /// What.
    pub event: Event,
}

/// Why a log cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RecordError {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong and what to do.
    pub message: String,
    /// It is a log all the same, of a version that knows more than this one.
    pub is_newer: bool,
}

impl fmt::Display for RecordError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "line {}, column {}: {}",
            self.line, self.column, self.message
        )
    }
}

impl std::error::Error for RecordError {}

impl Record {
    /// A log with nothing in it yet.
    pub fn new(program: &str, lesson: &str, hash: &str, started: &str, start: &Start) -> Record {
        Record {
            header: Header {
                format: FORMAT,
                program: program.to_owned(),
                lesson: lesson.to_owned(),
                hash: hash.to_owned(),
                seed: start.seed,
                started: started.to_owned(),
                finished: None,
                slips: start.slips.clone(),
            },
            entries: Vec::new(),
        }
    }

    /// What the session began with, for [`crate::session::Session::resume`].
    pub fn start(&self) -> Start {
        Start {
            seed: self.header.seed,
            slips: self.header.slips.clone(),
        }
    }

    /// The events alone.
    pub fn events(&self) -> Vec<Event> {
        self.entries
            .iter()
            .map(|entry| entry.event.clone())
            .collect()
    }

    /// Appends. A draft replaces the draft just before it, so that typing does not swell the
    /// log; reaching the result sets the time in the header.
    pub fn push(&mut self, at: &str, took_ms: u64, event: Event) {
        if let Event::Finished { .. } = event {
            self.header.finished = Some(at.to_owned());
        }
        // TOML's integers end there.
        let most = i64::MAX as u64;
        let mut took_ms = took_ms.min(most);
        if let (
            Some(Entry {
                event: Event::Draft { item: before, .. },
                took_ms: took_before,
                ..
            }),
            Event::Draft { item, .. },
        ) = (self.entries.last(), &event)
            && before == item
        {
            took_ms = took_ms.saturating_add(*took_before).min(most);
            self.entries.pop();
        }
        self.entries.push(Entry {
            at: at.to_owned(),
            took_ms,
            event,
        });
    }

    /// The log as TOML.
    pub fn to_toml(&self) -> String {
        #[derive(Serialize)]
        struct Out<'a> {
            at: &'a str,
            took_ms: i64,
            #[serde(flatten)]
            event: &'a Event,
        }
        #[derive(Serialize)]
        struct File<'a> {
            #[serde(flatten)]
            header: &'a Header,
            event: Vec<Out<'a>>,
        }
        let file = File {
            header: &self.header,
            event: self
                .entries
                .iter()
                .map(|entry| Out {
                    at: &entry.at,
                    took_ms: i64::try_from(entry.took_ms).unwrap_or(i64::MAX),
                    event: &entry.event,
                })
                .collect(),
        };
        // Strings, numbers that TOML can hold, and keys that are strings: it has no way to fail.
        toml::to_string(&file).expect("a record is always TOML")
    }

    /// Reads a log.
    ///
    /// # Errors
    ///
    /// What is not TOML, what a later version wrote, and what lost a part, with its place.
    pub fn from_toml(text: &str) -> Result<Record, RecordError> {
        let doc = DeTable::parse(text)
            .map_err(|e| error(text, e.span().map_or(0, |s| s.start), e.message()))?;
        let span = doc.span();
        let mut table = doc.into_inner();
        check_format(text, &table)?;
        let events = table.remove("event");
        let header = Header::deserialize(ValueDeserializer::from(Spanned::new(
            span,
            DeValue::Table(table),
        )))
        .map_err(|e| {
            let at = e.span().map_or(0, |s| s.start);
            error(text, at, &format!("{}. {ADVICE}", e.message()))
        })?;
        let mut entries = Vec::new();
        if let Some(events) = events {
            let at = events.span().start;
            let DeValue::Array(events) = events.into_inner() else {
                return Err(error(text, at, "`event` must be [[event]] tables"));
            };
            for event in events {
                entries.push(read_entry(text, event)?);
            }
        }
        Ok(Record { header, entries })
    }
}

const ADVICE: &str = "The file is kept as it is. Use the version of lobe that wrote it or a \
                      newer one, or mend the line";

fn check_format(text: &str, table: &DeTable<'_>) -> Result<(), RecordError> {
    let Some(format) = table.get("format") else {
        return Err(error(
            text,
            0,
            "this is not a log of lobe: `format` is missing",
        ));
    };
    let known = format
        .get_ref()
        .as_integer()
        .is_some_and(|n| n.as_str() == FORMAT.to_string());
    if known {
        return Ok(());
    }
    let number = format
        .get_ref()
        .as_integer()
        .and_then(|n| n.as_str().parse::<u32>().ok());
    let message = format!("this log is not of format {FORMAT}, the one known here. {ADVICE}");
    let error = error(text, format.span().start, &message);
    Err(match number {
        Some(number) if number > FORMAT => newer(error),
        _ => error,
    })
}

fn read_entry(text: &str, value: Spanned<DeValue<'_>>) -> Result<Entry, RecordError> {
    let span = value.span();
    let DeValue::Table(mut table) = value.into_inner() else {
        return Err(error(text, span.start, "an event must be a table"));
    };
    match table
        .get("kind")
        .map(|kind| (kind.span(), kind.get_ref().as_str()))
    {
        None => return Err(error(text, span.start, "an event without `kind`")),
        Some((at, None)) => return Err(error(text, at.start, "`kind` must be a string")),
        Some((at, Some(kind))) if !Event::KINDS.contains(&kind) => {
            let message = format!("the event kind `{kind}` is not known here. {ADVICE}");
            return Err(newer(error(text, at.start, &message)));
        }
        Some((_, Some(_))) => {}
    }
    let taken: Result<(String, u64), toml::de::Error> = (|| {
        let mut take = |key: &'static str| {
            table
                .remove(key)
                .map(ValueDeserializer::from)
                .ok_or_else(|| <toml::de::Error as de::Error>::missing_field(key))
        };
        Ok((
            String::deserialize(take("at")?)?,
            u64::deserialize(take("took_ms")?)?,
        ))
    })();
    let whole = span.clone();
    let event = |table| {
        Event::deserialize(ValueDeserializer::from(Spanned::new(
            whole,
            DeValue::Table(table),
        )))
    };
    let (at, took_ms, event) = taken
        .and_then(|(at, took_ms)| Ok((at, took_ms, event(table)?)))
        .map_err(|e| {
            let at = e.span().map_or(span.start, |s| s.start);
            error(text, at, &format!("{}. {ADVICE}", e.message()))
        })?;
    Ok(Entry { at, took_ms, event })
}

fn error(text: &str, offset: usize, message: &str) -> RecordError {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    RecordError {
        line: before.matches('\n').count() + 1,
        column: before[line_start..].chars().count() + 1,
        message: message.to_owned(),
        is_newer: false,
    }
}

/// The same, of a log that a newer version wrote.
fn newer(error: RecordError) -> RecordError {
    RecordError {
        is_newer: true,
        ..error
    }
}

/// A seed is an integer where TOML can hold it, else its digits as a string.
pub(crate) mod seed {
    use super::*;

    pub(crate) fn serialize<S: Serializer>(seed: &u64, to: S) -> Result<S::Ok, S::Error> {
        match i64::try_from(*seed) {
            Ok(seed) => to.serialize_i64(seed),
            Err(_) => to.serialize_str(&seed.to_string()),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u64, D::Error> {
        struct Seed;
        impl de::Visitor<'_> for Seed {
            type Value = u64;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a seed: an integer of at least 0, or its digits as a string")
            }
            fn visit_i64<E: de::Error>(self, seed: i64) -> Result<u64, E> {
                u64::try_from(seed)
                    .map_err(|_| E::invalid_value(de::Unexpected::Signed(seed), &self))
            }
            fn visit_u64<E: de::Error>(self, seed: u64) -> Result<u64, E> {
                Ok(seed)
            }
            fn visit_str<E: de::Error>(self, seed: &str) -> Result<u64, E> {
                seed.parse()
                    .map_err(|_| E::invalid_value(de::Unexpected::Str(seed), &self))
            }
        }
        from.deserialize_any(Seed)
    }
}

#[cfg(test)]
mod tests;
