//! `lobe review`: a class's unsure and disputed explanations, marked by the teacher.

use std::env;
use std::io::{self, IsTerminal as _};
use std::path::Path;

use serde_json::json;
use tutor::class::Reason;
use tutor::judge::Verdict;
use tutor::review::{self, Effect, Key, Review, Waiting};
use tutor::rubric::Example;

use crate::class::{Class, Marks};
use crate::cli::{self, Folders};
use crate::exit::{Done, Failure};
use crate::lessons::{Shelf, unknown};
use crate::{output, sheet, store, text, tui};

pub fn run(folders: &Folders, args: &cli::Review) -> Result<Done, Failure> {
    let shelf = super::shelf(folders)?;
    if let Some(item) = &args.item {
        known(&shelf, item)?;
    }
    let mut marks = Marks::of(&args.folder)?;
    if args.examples {
        return examples(&shelf, &marks, args);
    }
    let class = Class::read(&args.folder)?;
    let waiting = waiting(&shelf, &class, &marks, args);
    if args.list {
        list(&waiting, args.json)?;
        return Ok(Done::found(class.incomplete));
    }
    if waiting.is_empty() {
        output::line(&format!(
            "Nothing to mark: {} explanations in {} logs, none of them open. `--all` goes through all of them.",
            class.answers.len(),
            class.logs
        ))?;
        return Ok(Done::found(class.incomplete));
    }
    let mut review = Review::new(waiting);
    if args.plain || !has_screen() {
        plain(&mut review, &mut marks)?;
    } else {
        tui::review::run(&mut review, &mut |effect| carry_out(&mut marks, effect))?;
    }
    part(&review, &marks, &args.folder)?;
    Ok(Done::found(class.incomplete))
}

fn has_screen() -> bool {
    let dumb = env::var_os("TERM").is_some_and(|term| term == "dumb");
    !dumb && io::stdin().is_terminal() && io::stdout().is_terminal()
}

fn known(shelf: &Shelf, item: &str) -> Result<(), Failure> {
    let asked = || shelf.lessons().flat_map(|lesson| &lesson.explain);
    let mut items = asked().map(|explain| explain.rubric.item.as_str());
    if items.any(|it| it == item) {
        return Ok(());
    }
    let items = asked().map(|explain| explain.rubric.item.as_str());
    let elsewhere = "`lobe transcript LESSON` shows them";
    Err(unknown("question", item, items, elsewhere))
}

/// What waits for a mark: disputed answers first, then what nobody settled; within that by
/// question, so that like is compared with like.
fn waiting(shelf: &Shelf, class: &Class, marks: &Marks, args: &cli::Review) -> Vec<Waiting> {
    let mut gone = 0;
    let mut out: Vec<Waiting> = Vec::new();
    for answered in &class.answers {
        let explanation = &answered.explanation;
        if args.item.as_ref().is_some_and(|it| *it != explanation.item) {
            continue;
        }
        let found = shelf
            .lessons()
            .find_map(|lesson| lesson.explain(&explanation.item));
        let Some(explain) = found else {
            gone += 1;
            continue;
        };
        let today = explain.judge.judge(&explanation.text);
        let reason = match explanation.open_because(&today) {
            Some(reason) => reason,
            None if args.all => Reason::Asked,
            None => continue,
        };
        let today = match explanation.replies.is_empty() {
            true => today,
            false => explain.judge.judge(&explanation.whole()),
        };
        let id = explanation.mark_id(&answered.log);
        if marks.has(&id) && !args.again {
            continue;
        }
        out.push(Waiting {
            id,
            learner: answered.learner.clone(),
            explanation: explanation.clone(),
            reason,
            rubric: explain.rubric.clone(),
            today,
        });
    }
    if gone > 0 {
        output::complain(&format!(
            "{gone} answers are left out: no lesson here asks their questions"
        ));
    }
    out.sort_by(|a, b| (a.reason, &a.rubric.item).cmp(&(b.reason, &b.rubric.item)));
    out
}

fn list(waiting: &[Waiting], as_json: bool) -> Result<(), Failure> {
    for it in waiting {
        let explanation = &it.explanation;
        if as_json {
            output::json(&json!({
                "id": it.id,
                "reason": it.reason.as_str(),
                "learner": it.learner,
                "item": explanation.item,
                "try": explanation.attempt,
                "at": explanation.at,
                "told": explanation.told(),
                "verdict": it.today.verdict.as_str(),
                "unsure": it.today.unsure,
                "disputed": explanation.disputed,
                "text": explanation.whole(),
            }))?;
            continue;
        }
        let first = explanation.text.lines().next().unwrap_or_default();
        let line = format!(
            "{}  {}  {}: {first}",
            it.reason.as_str(),
            explanation.item,
            it.learner
        );
        for line in text::wrap_plain(&line, 92, "", "    ") {
            output::line(&line)?;
        }
    }
    if !as_json {
        output::line(&format!("{} to mark", waiting.len()))?;
    }
    Ok(())
}

fn carry_out(marks: &mut Marks, effect: Effect) -> Result<(), Failure> {
    match effect {
        Effect::Keep(mark) => marks.keep(mark),
        Effect::Forget(id) => marks.forget(&id),
    }
}

/// One line is one key; end of input leaves.
fn plain(review: &mut Review, marks: &mut Marks) -> Result<(), Failure> {
    output::line(
        "p pass, a partial, f fail; a number turns that point; an empty line takes the verdict that follows; later, back, quit.\n",
    )?;
    let mut fresh = true;
    while review.current().is_some() {
        if fresh {
            for line in sheet::lines(review, 80) {
                let line: String = line.into_iter().map(|piece| piece.text).collect();
                output::line(&line)?;
            }
        } else {
            for line in sheet::points(review, 80) {
                let line: String = line.into_iter().map(|piece| piece.text).collect();
                output::line(&line)?;
            }
        }
        let mut typed = String::new();
        let read = io::stdin().read_line(&mut typed);
        if read.map_err(|error| {
            Failure::unusable(format!("cannot read from standard input: {error}"))
        })? == 0
        {
            return Ok(());
        }
        let key = match typed.trim() {
            "" => Key::Accept,
            "p" | "pass" => Key::Verdict(Verdict::Pass),
            "a" | "partial" => Key::Verdict(Verdict::Partial),
            "f" | "fail" => Key::Verdict(Verdict::Fail),
            "l" | "later" => Key::Later,
            "b" | "back" => Key::Back,
            "q" | "quit" => return Ok(()),
            other => match other.parse::<usize>() {
                Ok(number) if (1..=review.points().len()).contains(&number) => {
                    Key::Turn(number - 1)
                }
                _ => {
                    output::line(
                        "! p, a, f, a number of a point, an empty line, later, back or quit\n",
                    )?;
                    continue;
                }
            },
        };
        let before = review.place().0;
        if let Some(effect) = review.press(key) {
            carry_out(marks, effect)?;
        }
        fresh = review.place().0 != before;
        if let Some(said) = review.said() {
            output::line(&format!("! {said}\n"))?;
        }
    }
    Ok(())
}

fn part(review: &Review, marks: &Marks, folder: &Path) -> Result<(), Failure> {
    let left = review.place().1 - review.marked();
    output::line(&format!(
        "{} marked now, {left} left; {} marks in {}.",
        review.marked(),
        marks.all.len(),
        marks.path.display()
    ))?;
    if !marks.all.is_empty() {
        let (folder, file) = (folder.display(), marks.path.display());
        output::line(&format!(
            "`lobe review {folder} --examples --write` makes them examples of the lessons.\n`lobe judge --evaluate {file}` compares the judge with them; `--learn` proposes phrases."
        ))?;
    }
    Ok(())
}

/// The marks as examples, printed or put into the lesson files.
fn examples(shelf: &Shelf, marks: &Marks, args: &cli::Review) -> Result<Done, Failure> {
    if marks.all.is_empty() {
        return Err(Failure::unusable(format!(
            "no marks in {}: `lobe review {}` makes them",
            marks.path.display(),
            args.folder.display()
        )));
    }
    let mut wrong = false;
    for file in &shelf.files {
        let Some(lesson) = &file.lesson else { continue };
        let (mut text, mut added) = (file.text.clone(), 0);
        for explain in &lesson.explain {
            let item = explain.rubric.item.as_str();
            if args.item.as_ref().is_some_and(|only| only != item) {
                continue;
            }
            let mut new: Vec<Example> = Vec::new();
            for mark in marks.all.iter().filter(|mark| mark.item == item) {
                let known = explain.rubric.example.iter().chain(&new);
                if !known.into_iter().any(|it| it.text == mark.text) {
                    new.push(review::example(mark));
                }
            }
            if !args.write {
                if !new.is_empty() {
                    output::line(&format!("# {item}, in {}", file.name))?;
                }
                for example in &new {
                    output::text(&review::example_toml(example))?;
                }
                continue;
            }
            match review::with_examples(&text, item, &new) {
                Ok(changed) => {
                    text = changed;
                    added += new.len();
                }
                Err(why) => {
                    wrong = true;
                    output::complain(&format!("{}: {why}", file.name));
                }
            }
        }
        if args.write && added > 0 {
            let path = Path::new(&file.name);
            if !path.exists() {
                return Err(Failure::unusable(format!(
                    "{} is built into the program: name a folder of lesson files with --lessons",
                    file.name
                )));
            }
            store::replace(path, &text).map_err(|error| Failure::unwritable(path, &error))?;
            output::line(&format!(
                "{}: {added} examples added; `lobe check {}` says which of them the judge does not hear yet, and which phrase would help",
                file.name, file.name
            ))?;
        }
    }
    Ok(Done::found(wrong))
}
