//! A lesson file's text becomes a [`Lesson`], or findings that say what is wrong and where.
//!
//! Reading goes on after an error, so that one pass finds as many as it can.

mod exercise;
mod figures;
pub(crate) mod literal;
mod reader;
mod scene;

use std::cell::RefCell;

use formula::{Library, Values};
use toml::de::DeTable;

pub(crate) use reader::{capitalised, nearest};

use crate::finding::{Finding, Place, Severity};
use crate::lesson::{
    Claim, Explain, ExplainStage, FormulaEntry, LazyJudge, Lesson, Reteach, SourceSays, Step,
    TakesUp, Test, Text, Worked, WorkedLine,
};
use crate::prose::plain_blocks;
use crate::rubric::Rubric;
use figures::{read_map, read_plot, read_table};
use reader::{Source, Table, place};

/// The only format there is so far.
const FORMAT: u32 = 1;

/// So many errors of the TOML itself are told at once.
const MOST_SYNTAX_ERRORS: usize = 5;

/// Reads a lesson. A lesson comes only without errors; total: any text gives an answer.
pub fn load(file_name: &str, text: &str) -> (Option<Lesson>, Vec<Finding>) {
    let source = Source {
        file: file_name,
        text,
        findings: RefCell::new(Vec::new()),
    };
    let (root, errors) = DeTable::parse_recoverable(text);
    let lesson = if errors.is_empty() {
        let table = Table::new(&source, root.get_ref(), Place::default(), "The lesson");
        Some(read_lesson(&table))
    } else {
        // After a quote that is not closed nearly every line is an error: the first few tell.
        for error in errors.iter().take(MOST_SYNTAX_ERRORS) {
            source.report(syntax_finding(&source, error));
        }
        None
    };
    let mut findings = source.findings.into_inner();
    findings.sort_by(|a, b| (a.start, a.end, a.code).cmp(&(b.start, b.end, b.code)));
    findings.dedup();
    let broken = findings
        .iter()
        .any(|finding| finding.severity == Severity::Error);
    (lesson.filter(|_| !broken), findings)
}

fn syntax_finding(source: &Source<'_>, error: &toml::de::Error) -> Finding {
    let span = error.span().unwrap_or_default();
    let at = Place {
        start: span.start,
        end: span.end,
    };
    let character = source
        .text
        .get(at.start..)
        .and_then(|rest| rest.chars().next());
    if let Some(control) = character.filter(|&c| c.is_control() && !"\t\r\n".contains(c)) {
        let code = u32::from(control);
        let message = format!("The control character U+{code:04X} cannot stand in a lesson.");
        return source.finding(at, "toml", message).expecting("text");
    }
    // "invalid string, expected `=`": the second half is what should stand there.
    let (message, expected) = match error.message().split_once(", expected ") {
        Some((message, expected)) => (message, Some(expected)),
        None => (error.message(), None),
    };
    if at.start == at.end && message.contains("must be quoted") {
        let finding = source.finding(at, "toml", "A value is missing here.");
        return finding.expecting("a string in quotes, a number, true, false, [ … ] or { … }");
    }
    let mut finding = source.finding(at, "toml", format!("{}.", capitalised(message)));
    finding.expected = expected.map(str::to_owned);
    let header = source
        .text
        .get(..at.start)
        .is_some_and(|before| before.ends_with('['));
    if header && message == "duplicate key" {
        let help =
            "What there may be several of has two brackets: [[step]], [[exercise]], [[explain]].";
        finding.help = Some(help.to_owned());
    }
    finding
}

/// A stable hash of a file's text (FNV-1a, 64 bits), as 16 hexadecimal digits.
fn hash(text: &str) -> String {
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{hash:016x}")
}

fn read_lesson(table: &Table<'_, '_>) -> Lesson {
    if !table.has("format") {
        table.missing("format", "format = 1");
    } else if table.count("format", u32::MAX).is_some_and(|f| f != FORMAT) {
        let message = "This format is not known here.".to_owned();
        table.wrong("format", "unknown-format", message, "format = 1");
    }
    let id = table.need_text("id");
    let (formulas, library) = read_formulas(table);
    let worked = table
        .table("worked", "[worked]")
        .map(|worked| read_worked(&worked, &id));
    let mut lesson = Lesson {
        file: table.source.file.to_owned(),
        hash: hash(table.source.text),
        source: table.source.text.to_owned(),
        title: table.need_text("title"),
        needs: table.texts("needs"),
        summary: table.need_text("summary"),
        minutes: table.count("minutes", 600).unwrap_or(20),
        why: table.need_text("why"),
        model: table.need_text("model"),
        takes_up: each(table, "takes_up", "[[takes_up]]", |entry| TakesUp {
            slip: entry.need_text("slip"),
            says: entry.need_text("says"),
        }),
        formulas,
        library,
        steps: each(table, "step", "[[step]]", |entry| Step {
            title: entry.need_text("title"),
            text: entry.need_text("text"),
            figures: entry.figures(),
        }),
        sources: each_some(table, "source_says", "[[source_says]]", read_source),
        tables: each(table, "table", "[[table]]", read_table),
        plots: each(table, "plot", "[[plot]]", read_plot),
        maps: each_some(table, "map", "[[map]]", read_map),
        claims: each_some(table, "claim", "[[claim]]", read_claim),
        exercises: each_some(table, "exercise", "[[exercise]]", |entry| {
            exercise::read(entry, worked.as_ref())
        }),
        fingerprints: each_some(
            table,
            "fingerprint",
            "[[fingerprint]]",
            scene::read_fingerprint,
        ),
        reteach: each(table, "reteach", "[[reteach]]", |entry| Reteach {
            id: entry.need_text("id"),
            name: entry.need_text("name"),
            title: entry.need_text("title"),
            text: entry.need_text("text"),
            figures: entry.figures(),
        }),
        explain: each_some(table, "explain", "[[explain]]", read_explain),
        measure: None,
        worked,
        id,
    };
    table.finish();
    // The judge hears the question as the learner reads it. Only now is everything there that
    // the question's templates may speak of.
    let mut explain = std::mem::take(&mut lesson.explain);
    for question in &mut explain {
        let asked = lesson.prose(&question.prompt, &Values::new());
        question.rubric.prompt = plain_blocks(&asked);
        question.judge = LazyJudge::new(&question.rubric);
    }
    lesson.explain = explain;
    lesson
}

/// Reads every entry of an array of tables, and reports its unknown keys.
fn each<'s, 't, T>(
    table: &Table<'s, 't>,
    key: &'static str,
    what: &str,
    read: impl Fn(&Table<'s, 't>) -> T,
) -> Vec<T> {
    each_some(table, key, what, |entry| Some(read(entry)))
}

/// The same, leaving out the entries that cannot be read (and were reported).
fn each_some<'s, 't, T>(
    table: &Table<'s, 't>,
    key: &'static str,
    what: &str,
    read: impl Fn(&Table<'s, 't>) -> Option<T>,
) -> Vec<T> {
    let entries = table.tables(key, what);
    entries
        .iter()
        .filter_map(|entry| {
            let found = read(entry);
            entry.finish();
            found
        })
        .collect()
}

fn read_formulas(table: &Table<'_, '_>) -> (Vec<FormulaEntry>, Library) {
    let mut library = Library::new();
    let mut entries = Vec::new();
    for (name, value) in table.entries("formula") {
        let what = format!("[formula.{name}]");
        let Some(inner) = value.get_ref().as_table() else {
            table.source.report(
                table
                    .source
                    .finding(
                        place(value),
                        "wrong-kind",
                        format!("`{name}` is not a table."),
                    )
                    .expecting(format!("[formula.{name}]")),
            );
            continue;
        };
        let entry = Table::new(table.source, inner, place(value), &what);
        let of = entry.texts("of");
        let is = entry.need_formula("is");
        let (says, core) = (entry.text("says"), entry.text("core"));
        entry.finish();
        let Some(is) = is else { continue };
        let params: Vec<&str> = of.iter().map(|param| param.text.as_str()).collect();
        if let Err(error) = library.define(&name, &params, &is.text) {
            // An empty span: the name or a parameter is at fault, not the formula.
            let at = if error.span.start == error.span.end {
                &name
            } else {
                &is.text
            };
            table.source.report_formula(at, &error);
            continue;
        }
        entries.push(FormulaEntry {
            name,
            of,
            is,
            says,
            core,
        });
    }
    for (name, error) in library.check() {
        if let Some(entry) = entries.iter().find(|entry| entry.name.text == name) {
            table.source.report_formula(&entry.is.text, &error);
        }
    }
    (entries, library)
}

fn read_worked(table: &Table<'_, '_>, lesson: &Text) -> Worked {
    let lines = each_some(table, "line", "A line of [worked]", |line| {
        Some(WorkedLine {
            name: line.need_text("name"),
            ask: line.text("ask"),
            shown: line.text("shown"),
            says: line.text("says"),
            is: line.need_formula("is")?,
        })
    });
    if lines.is_empty() {
        table.missing("line", "line = [{ name = \"…\", is = \"…\" }]");
    }
    let faded = table.table("faded", "[worked.faded]").map(|faded| {
        let found = exercise::read_faded(&faded, lesson, &lines);
        faded.finish();
        found
    });
    let worked = Worked {
        title: table.need_text("title"),
        intro: table.need_text("intro"),
        given: table.givens("given"),
        after: table.text("after"),
        lines,
        faded,
    };
    table.finish();
    worked
}

fn read_source(table: &Table<'_, '_>) -> Option<SourceSays> {
    let (id, where_, shown) = (
        table.text("id"),
        table.need_text("where"),
        table.need_text("shown"),
    );
    let (with, says) = (table.givens("with"), table.need_text("says"));
    let truth = table.formula("truth");
    Some(SourceSays {
        id,
        where_,
        shown,
        with,
        truth,
        says,
        is: table.need_formula("is")?,
    })
}

fn read_claim(table: &Table<'_, '_>) -> Option<Claim> {
    let (says, with) = (table.need_text("says"), table.givens("with"));
    let rel = table.number("rel").unwrap_or(1e-9);
    let (is, equals, holds) = (table.has("is"), table.has("equals"), table.has("holds"));
    let test = if holds && !is && !equals {
        Test::Holds(table.formula("holds")?)
    } else if is && equals && !holds {
        let (is, equals) = (table.formula("is"), table.formula("equals"));
        Test::Equals {
            is: is?,
            equals: equals?,
            rel,
        }
    } else {
        let (_, _, _) = (table.get("is"), table.get("equals"), table.get("holds"));
        table.missing("is", "either `is` and `equals`, or `holds`");
        return None;
    };
    Some(Claim { says, with, test })
}

fn read_explain(table: &Table<'_, '_>) -> Option<Explain> {
    let stage = match table.text("stage") {
        None => ExplainStage::Explain,
        Some(stage) => match stage.text.as_str() {
            "explain" => ExplainStage::Explain,
            "retest" => ExplainStage::Retest,
            _ => {
                let message = format!("`{stage}` is not a stage.");
                table.wrong(
                    "stage",
                    "unknown-name",
                    message,
                    "\"explain\" or \"retest\"",
                );
                ExplainStage::Explain
            }
        },
    };
    let (id, prompt) = (table.need_text("id"), table.need_text("prompt"));
    let (expectation, expectation_places) = table.deserialized("expectation");
    let (misconception, misconception_places) = table.deserialized("misconception");
    let (example, example_places) = table.deserialized("example");
    if expectation.is_empty() {
        table.missing("expectation", "[[explain.expectation]]");
    }
    let rubric = Rubric {
        item: id.text.clone(),
        prompt: prompt.text.clone(),
        expectation,
        misconception,
        example,
    };
    Some(Explain {
        id,
        stage,
        title: table.need_text("title"),
        prompt,
        model_answer: table.need_text("model_answer"),
        judge: LazyJudge::new(&Rubric::default()),
        rubric,
        expectation_places,
        misconception_places,
        example_places,
    })
}
