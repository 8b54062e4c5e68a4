//! Prose with live numbers: templates are filled, then Markdown becomes blocks.
//!
//! Blocks are what both the screen and the plain text draw.

mod markdown;
pub(crate) mod template;

use formula::Values;

use crate::lesson::Lesson;
use crate::map::MapFrame;

/// A stretch of text in one style.
#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Plain words.
    Text(String),
    /// **Strong.**
    Strong(String),
    /// *Emphasis.*
    Emph(String),
    /// `Code`.
    Code(String),
    /// A formula in Unicode.
    Math(String),
}

impl Inline {
    /// The words without their style.
    pub fn text(&self) -> &str {
        match self {
            Inline::Text(text)
            | Inline::Strong(text)
            | Inline::Emph(text)
            | Inline::Code(text)
            | Inline::Math(text) => text,
        }
    }
}

/// The words of several inlines without their styles.
pub fn plain(inlines: &[Inline]) -> String {
    inlines.iter().map(Inline::text).collect()
}

/// Blocks of prose as plain text, a line each, lists with dashes.
pub fn plain_blocks(blocks: &[Block]) -> String {
    let mut lines = Vec::new();
    for block in blocks {
        match block {
            Block::Paragraph(inlines) | Block::Quote(inlines) => lines.push(plain(inlines)),
            Block::Heading(text) | Block::CodeBlock(text) => lines.push(text.clone()),
            Block::List { items, .. } => {
                lines.extend(items.iter().map(|item| format!("- {}", plain(item))));
            }
            _ => {}
        }
    }
    lines.join("\n")
}

/// How a verdict feels; colour and symbol follow from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tone {
    /// Right.
    Good,
    /// Nearly, or right after an earlier slip.
    Near,
    /// Wrong.
    Bad,
    /// Neither.
    Info,
}

/// A table ready to draw.
#[derive(Clone, Debug, PartialEq)]
pub struct TableView {
    /// Heading.
    pub title: String,
    /// Heads of the columns.
    pub header: Vec<String>,
    /// Cells, row by row; every row is as long as the header.
    pub rows: Vec<Vec<String>>,
    /// Below the table.
    pub note: Vec<Inline>,
}

/// A plot ready to draw. Points that have no value are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotView {
    /// Id within the lesson.
    pub id: String,
    /// Heading.
    pub title: String,
    /// Below the horizontal axis.
    pub x_label: String,
    /// Beside the vertical axis.
    pub y_label: String,
    /// Logarithmic horizontal axis.
    pub x_log: bool,
    /// Logarithmic vertical axis; all values are then positive.
    pub y_log: bool,
    /// Ends of the horizontal axis.
    pub x_range: (f64, f64),
    /// Ends of the vertical axis.
    pub y_range: (f64, f64),
    /// Those of them that the author chose.
    pub y_given: (Option<f64>, Option<f64>),
    /// Label and points of every curve.
    pub series: Vec<(String, Vec<(f64, f64)>)>,
    /// Points with a name.
    pub marks: Vec<(String, f64, f64)>,
}

/// One piece of a screen.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading.
    Heading(String),
    /// A paragraph.
    Paragraph(Vec<Inline>),
    /// A list.
    List {
        /// Numbered.
        ordered: bool,
        /// Its items.
        items: Vec<Vec<Inline>>,
    },
    /// Code, lines as they are.
    CodeBlock(String),
    /// A quotation.
    Quote(Vec<Inline>),
    /// A table.
    Table(TableView),
    /// A plot.
    Plot(PlotView),
    /// A map; its values take longer than a screen may, and are asked for apart.
    Map(Box<MapFrame>),
    /// A fingerprint picture, drawn by whoever can.
    Picture {
        /// The lesson's id.
        lesson: String,
        /// The fingerprint's id.
        id: String,
        /// Heading.
        title: String,
        /// What it shows and where it does not.
        caption: Vec<Inline>,
        /// A learner's shader that stands for the wrong formula; `id` is then an exercise's.
        own: Option<String>,
    },
    /// One worked line: the formula, the numbers put in, the value.
    Derivation {
        /// What is computed, in the field's spelling.
        name: String,
        /// The formula, then the same with numbers, step by step.
        lines: Vec<String>,
        /// The value as printed.
        value: String,
        /// A remark.
        says: Vec<Inline>,
    },
    /// What the tutor thinks of an answer.
    Verdict {
        /// How it feels.
        tone: Tone,
        /// A few words, such as "Correct".
        title: String,
        /// The rest.
        text: Vec<Inline>,
    },
    /// Points to tick.
    Checklist {
        /// The point, and whether the learner said it.
        points: Vec<(String, Option<bool>)>,
    },
    /// The learner's own words with stretches marked, `start..end` in bytes.
    Quoted {
        /// The words.
        text: String,
        /// What is marked, and how.
        marks: Vec<(usize, usize, Tone)>,
    },
}

impl Lesson {
    /// Prose of the lesson as blocks, templates filled from the lesson's formulas and `values`.
    /// A template that cannot be filled is shown as written; [`crate::check()`] finds it first.
    pub fn prose(&self, text: &str, values: &Values) -> Vec<Block> {
        let filled = template::fill(self, text, values);
        markdown::blocks(&filled)
    }

    /// Prose that stands on one line: the inlines of its paragraphs.
    pub fn inline(&self, text: &str, values: &Values) -> Vec<Inline> {
        let mut inlines = Vec::new();
        for block in self.prose(text, values) {
            let more: Vec<Vec<Inline>> = match block {
                Block::Paragraph(more) | Block::Quote(more) => vec![more],
                Block::List { items, .. } => items,
                Block::Heading(text) => vec![vec![Inline::Strong(text)]],
                Block::CodeBlock(text) => vec![vec![Inline::Code(text)]],
                _ => Vec::new(),
            };
            for mut more in more {
                if !inlines.is_empty() {
                    inlines.push(Inline::Text(" ".to_owned()));
                }
                inlines.append(&mut more);
            }
        }
        inlines
    }

    /// Prose with its templates filled, still Markdown.
    pub fn filled(&self, text: &str, values: &Values) -> String {
        template::fill(self, text, values).markdown()
    }

    /// A name in the field's spelling: `n_dot_h` as N·H, `alpha` as α.
    pub fn spelled(&self, name: &str) -> String {
        formula::unicode_name(name)
    }
}

/// Markdown without templates: words in which braces are braces.
pub(crate) fn markdown_alone(text: &str) -> Vec<Block> {
    markdown::blocks(&template::Filled {
        text: text.to_owned(),
        ..Default::default()
    })
}

/// A number in its shortest form, at most 12 significant digits.
pub fn shortest(value: f64) -> String {
    let text = formula::format_number(value, formula::Digits::Significant(12));
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (text.as_str(), None),
    };
    let trimmed = if mantissa.contains('.') {
        mantissa.trim_end_matches('0').trim_end_matches('.')
    } else {
        mantissa
    };
    match exponent {
        Some(exponent) => format!("{trimmed}e{exponent}"),
        None => trimmed.to_owned(),
    }
}
