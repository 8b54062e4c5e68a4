//! `lobe check`: everything a lesson file can get wrong.

use std::env;
use std::fmt::Write as _;
use std::io::{self, IsTerminal as _};

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use rayon::prelude::*;
use tutor::check::{DrawCount, Report, looks, shaders};
use tutor::{Finding, Lesson, Severity};

use crate::cli::{Check, Folders, Format};
use crate::exit::{Done, Failure};
use crate::lessons::{File, Shelf};
use crate::output;
use crate::seen::check_seen;

pub fn run(folders: &Folders, args: &Check) -> Result<Done, Failure> {
    let shelf = if args.paths.is_empty() {
        Shelf::open(folders.lessons.as_deref())?
    } else {
        Shelf::of_paths(&args.paths)?
    };
    // Among files picked one by one, or beside a broken one, what a lesson refers to may be
    // there and only not be seen.
    let whole = args.paths.iter().all(|path| path.is_dir()) && shelf.broken().next().is_none();
    let Report { findings, draws } = report(&shelf, whole);
    let wrong = findings
        .iter()
        .any(|finding| finding.severity == Severity::Error);
    match args.format {
        Format::Human => human(&shelf, &findings, &draws)?,
        Format::Json => findings.iter().try_for_each(output::json)?,
        Format::Github => findings
            .iter()
            .try_for_each(|finding| output::line(&github(finding)))?,
        Format::Junit => output::text(&junit(&shelf, &findings))?,
    }
    Ok(Done::found(wrong))
}

/// What computing finds in one lesson: its numbers, its shaders, its pictures.
fn of_lesson(lesson: &Lesson) -> Report {
    let sight = |picture: &str| crate::fingerprints::sight(lesson, picture, 0.0, 0.0);
    let pictures = || {
        let mut findings = check_seen(lesson);
        // Where a bug shows is known when its picture was looked at.
        findings.extend(looks::findings(lesson, sight));
        findings
    };
    // What a lesson's shaders compute is known when they ran, each in a process of its own.
    let ran = || {
        shaders::runs(lesson)
            .into_par_iter()
            .flat_map_iter(|run| run.finding(&crate::shaders::run(run.job.clone())))
            .collect::<Vec<_>>()
    };
    let (mut report, (ran, seen)) = rayon::join(
        || tutor::check::report(lesson),
        || rayon::join(ran, pictures),
    );
    report.findings.extend(ran);
    report.findings.extend(seen);
    report
}

/// What reading found, then what computing found, in the order of the files.
fn report(shelf: &Shelf, whole: bool) -> Report {
    let mut findings: Vec<Finding> = shelf
        .files
        .iter()
        .flat_map(|file| file.findings.clone())
        .collect();
    let lessons: Vec<&Lesson> = shelf.lessons().map(AsRef::as_ref).collect();
    let computed: Vec<Report> = lessons.par_iter().map(|lesson| of_lesson(lesson)).collect();
    let mut draws = Vec::new();
    for one in computed {
        findings.extend(one.findings);
        draws.extend(one.draws);
    }
    if whole {
        findings.extend(tutor::check::together(&lessons));
    }
    let place = |finding: &Finding| {
        shelf
            .files
            .iter()
            .position(|file| file.name == finding.file)
    };
    findings.sort_by_key(|finding| (place(finding), finding.start, finding.end));
    findings.dedup();
    Report { findings, draws }
}

fn human(shelf: &Shelf, findings: &[Finding], draws: &[DrawCount]) -> Result<(), Failure> {
    let coloured =
        io::stdout().is_terminal() && env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let renderer = if coloured {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    for finding in findings {
        match shelf.files.iter().find(|file| file.name == finding.file) {
            Some(file) => output::line(&snippet(file, finding, &renderer))?,
            None => output::line(&crate::lessons::one_line(finding))?,
        }
        output::line("")?;
    }
    let errors = findings
        .iter()
        .filter(|finding| finding.severity == Severity::Error)
        .count();
    let warnings = findings.len() - errors;
    for count in draws {
        output::line(&format!(
            "{:<32} {:>5} of {} draws accepted, {} named mistakes, {} others",
            count.exercise, count.accepted, count.tries, count.named, count.mutants
        ))?;
    }
    let files = shelf.files.len();
    output::line(&format!(
        "{} {files} lesson{} checked: {errors} error{}, {warnings} warning{}",
        if errors == 0 { "✓" } else { "✗" },
        plural(files),
        plural(errors),
        plural(warnings),
    ))
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

fn snippet(file: &File, finding: &Finding, renderer: &Renderer) -> String {
    let level = match finding.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let label = finding
        .expected
        .as_ref()
        .map(|expected| format!("expected {expected}"));
    let mut mark = AnnotationKind::Primary.span(finding.start..finding.end.max(finding.start));
    if let Some(label) = &label {
        mark = mark.label(label.as_str());
    }
    let source = Snippet::source(file.text.as_str())
        .path(file.name.as_str())
        .annotation(mark);
    let mut group = level
        .primary_title(finding.message.as_str())
        .id(finding.code)
        .element(source);
    if let Some(help) = &finding.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    renderer.render(&[group])
}

/// A line that GitHub shows beside the changed file.
fn github(finding: &Finding) -> String {
    let kind = match finding.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let mut message = finding.message.clone();
    if let Some(expected) = &finding.expected {
        let _ = write!(message, " (expected {expected})");
    }
    if let Some(help) = &finding.help {
        let _ = write!(message, "; {help}");
    }
    let message = message
        .replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A");
    let file = finding
        .file
        .replace('%', "%25")
        .replace(',', "%2C")
        .replace(':', "%3A");
    format!(
        "::{kind} file={file},line={},col={},title={}::{message}",
        finding.line, finding.column, finding.code
    )
}

/// One test case a lesson file.
fn junit(shelf: &Shelf, findings: &[Finding]) -> String {
    let errors_of = |file: &File| -> Vec<&Finding> {
        findings
            .iter()
            .filter(|finding| finding.file == file.name && finding.severity == Severity::Error)
            .collect()
    };
    let failed = shelf
        .files
        .iter()
        .filter(|file| !errors_of(file).is_empty())
        .count();
    let mut xml = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"lobe check\" tests=\"{}\" failures=\"{failed}\">\n",
        shelf.files.len()
    );
    for file in &shelf.files {
        let errors = errors_of(file);
        let name = escape(&file.name);
        if errors.is_empty() {
            let _ = writeln!(xml, "  <testcase classname=\"lessons\" name=\"{name}\"/>");
            continue;
        }
        let _ = writeln!(xml, "  <testcase classname=\"lessons\" name=\"{name}\">");
        for finding in errors {
            let line = escape(&crate::lessons::one_line(finding));
            let _ = writeln!(
                xml,
                "    <failure type=\"{}\" message=\"{line}\"/>",
                finding.code
            );
        }
        xml.push_str("  </testcase>\n");
    }
    xml.push_str("</testsuite>\n");
    xml
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\n', "&#10;")
}
