//! A lesson as linear text on standard input and output: for screen readers, pipes and tests.
//!
//! One line is one input; an empty line goes on; a line that starts with `:` is a command; an
//! explanation ends with a line of one `.`. What is printed holds no time and no path, and
//! nothing is printed twice.

mod incoming;
mod words;

use std::io::{self, IsTerminal as _};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

use tutor::Lesson;
use tutor::prose::{Block, TableView};
use tutor::session::Msg;
use tutor::view::{Input, Saving, Stage, View};

use crate::config::SecondJudge;
use crate::due::{Due, Lineup};
use crate::exit::{Done, Failure};
use crate::fingerprints::{places_table, profile_table};
use crate::maps::map_table;
use crate::output;
use crate::shaders;
use crate::sitting::{Request, Sitting, Wish};
use crate::store::Store;
use crate::text;

use incoming::{Incoming, incoming};
use words::{
    asks_for_help, checklist, headline, help, is_command_without_colon, numbered, with_line,
};

/// Lines are wrapped here.
const WIDTH: usize = 80;

/// Runs the lesson until its end, or the input's; `due` is offered first.
pub fn run(
    lesson: &Arc<Lesson>,
    wish: Wish,
    due: Option<Due>,
    store: &Store,
    judge: Option<SecondJudge>,
) -> Result<Done, Failure> {
    let sitting = Sitting::open(lesson, store, wish)?;
    let lineup = due.map(|due| {
        (
            due.words(":due"),
            Lineup::new(due, Some((Arc::clone(lesson), wish))),
        )
    });
    run_sitting(sitting, lineup, None, store, judge)
}

/// Asks what is due, and nothing else.
pub fn run_due(due: Due, store: &Store, judge: Option<SecondJudge>) -> Result<Done, Failure> {
    let mut lineup = Lineup::new(due, None);
    match lineup.next(store)? {
        Some(sitting) => run_sitting(sitting, None, Some(lineup), store, judge),
        None => Ok(Done::Fine),
    }
}

fn run_sitting(
    sitting: Sitting,
    offer: Option<(String, Lineup)>,
    lineup: Option<Lineup>,
    store: &Store,
    judge: Option<SecondJudge>,
) -> Result<Done, Failure> {
    let mut plain = Plain {
        echo: !io::stdin().is_terminal(),
        sitting: sitting.with_second_opinions(judge.clone()),
        store,
        judge,
        offer,
        lineup,
        seen: None,
        told: true,
        said_unsaved: false,
        editor: None,
        asked: false,
    };
    let result = plain.converse(&incoming());
    plain.part(result)
}

struct Plain<'a> {
    sitting: Sitting,
    store: &'a Store,
    /// Who gives second opinions.
    judge: Option<SecondJudge>,
    /// What is due in other lessons, in words, until something else is done.
    offer: Option<(String, Lineup)>,
    /// What comes when the lesson is at its end.
    lineup: Option<Lineup>,
    /// Whether input is printed, because no terminal shows it.
    echo: bool,
    /// What was printed last: its key, how many blocks, the input asked for.
    seen: Option<View>,
    /// Whether the last line of input reached the lesson: its answer is news.
    told: bool,
    said_unsaved: bool,
    /// Lines of the explanation being typed.
    editor: Option<Vec<String>>,
    /// What is asked was just said.
    asked: bool,
}

/// What follows from a line.
#[must_use]
enum Then {
    Stay,
    Leave,
    /// The lesson is at its end.
    Finish,
}

/// How the conversation ended.
enum End {
    Left,
    InputEnded,
    Signal(i32),
}

impl Plain<'_> {
    fn converse(&mut self, incoming: &Receiver<Incoming>) -> Result<End, Failure> {
        self.greet()?;
        loop {
            self.print_news()?;
            // The channel closes only with the program.
            match incoming.recv().unwrap_or(Incoming::End) {
                Incoming::End => return Ok(End::InputEnded),
                Incoming::Signal(signal) => return Ok(End::Signal(signal)),
                Incoming::Line(line) => {
                    if self.echo {
                        output::line(&format!("> {line}"))?;
                    }
                    match self.take(&line)? {
                        Then::Stay => {}
                        Then::Leave => return Ok(End::Left),
                        Then::Finish => {
                            if !self.go_on()? {
                                return Ok(End::Left);
                            }
                        }
                    }
                }
            }
            self.wait_for_opinion()?;
            self.sitting.finish_run();
            self.sitting.settle();
        }
    }

    /// A second opinion is read where it is given, so that a transcript has an order.
    fn wait_for_opinion(&mut self) -> Result<(), Failure> {
        if self.sitting.is_asking() {
            if let Some(waiting) = &self.sitting.view().waiting {
                output::line(&format!("\n{waiting} …"))?;
            }
            self.sitting.settle_opinions();
        }
        Ok(())
    }

    fn greet(&mut self) -> Result<(), Failure> {
        let title = self.sitting.view().lesson_title.clone();
        print(&text::wrap_plain(&title, WIDTH, "# ", "  "))?;
        if self.sitting.resumed {
            output::line("\nResuming where you left.")?;
        }
        for notice in self.sitting.notices.clone() {
            print(&text::wrap_plain(&notice.says, WIDTH, "! ", "  "))?;
            if let Some(place) = notice.place {
                output::complain(&place);
            }
        }
        if let Some((words, _)) = &self.offer {
            print(&text::wrap_plain(words, WIDTH, "! ", "  "))?;
        }
        output::line(
            "\nOne line is one input. An empty line goes on. :help says what else there is.",
        )
    }

    /// Takes one line of input.
    fn take(&mut self, line: &str) -> Result<Then, Failure> {
        self.told = false;
        let view = self.sitting.view();
        let command = line.trim();
        let msg = match command {
            ":quit" | ":q" | ":exit" => Msg::Quit,
            ":back" | ":b" => Msg::Back,
            ":skip" | ":s" => Msg::Skip,
            ":hint" | ":h" => Msg::Hint,
            ":due" => return self.ask_due(),
            ":help" | ":?" => {
                print(&help(view, self.offer.is_some()))?;
                return Ok(Then::Stay);
            }
            _ if self.editor.is_none() && asks_for_help(command) => {
                print(&help(view, self.offer.is_some()))?;
                return Ok(Then::Stay);
            }
            _ if is_command_without_colon(command, &view.input) => {
                output::line(&format!("! Commands begin with a colon: :{command}"))?;
                return Ok(Then::Stay);
            }
            _ if matches!(view.input, Input::Text { .. }) => return self.take_text(line),
            _ if matches!(view.input, Input::Code { .. }) => return self.take_code(line),
            "" => Msg::Next,
            _ if command.starts_with(':') => {
                output::line(&format!(
                    "! {command} is no command. :help says which there are."
                ))?;
                return Ok(Then::Stay);
            }
            _ => match &view.input {
                Input::Checklist { points } => {
                    match checklist(command, points.iter().position(|p| p.said.is_none())) {
                        Some(msg) => msg,
                        None => {
                            output::line("! Answer y or n, or a point's number and y or n: 2 n.")?;
                            return Ok(Then::Stay);
                        }
                    }
                }
                Input::None => {
                    output::line("! Nothing is asked here. An empty line goes on.")?;
                    return Ok(Then::Stay);
                }
                _ => Msg::Answer(command.to_owned()),
            },
        };
        let msg = match (&view.input, msg) {
            (Input::Checklist { points }, Msg::Next)
                if points.iter().all(|point| point.said.is_some()) =>
            {
                Msg::ChecklistDone
            }
            (_, msg) => msg,
        };
        self.keep_draft();
        Ok(self.tell(msg))
    }

    /// Has what is due asked first.
    fn ask_due(&mut self) -> Result<Then, Failure> {
        match self.offer.take() {
            Some((_, lineup)) => {
                self.lineup = Some(lineup);
                Ok(Then::Finish)
            }
            None => {
                output::line("! Nothing waits to be asked first.")?;
                Ok(Then::Stay)
            }
        }
    }

    /// Opens what comes next. False where nothing does.
    fn go_on(&mut self) -> Result<bool, Failure> {
        let next = match &mut self.lineup {
            Some(lineup) => lineup.next(self.store)?,
            None => None,
        };
        let Some(sitting) = next else {
            return Ok(false);
        };
        let next = sitting.with_second_opinions(self.judge.clone());
        if let Err(why) = std::mem::replace(&mut self.sitting, next).close() {
            output::complain(&format!("the last answers could not be saved: {why}"));
        }
        self.said_unsaved = false;
        self.seen = None;
        self.editor = None;
        output::line("")?;
        self.greet()?;
        Ok(true)
    }

    /// A line of an explanation; one `.` hands it in.
    fn take_text(&mut self, line: &str) -> Result<Then, Failure> {
        let lines = self.editor.as_deref().unwrap_or_default();
        let empty = lines.iter().all(|line| line.trim().is_empty());
        if line.trim() == "." {
            let answer = lines.join("\n");
            self.editor = None;
            return Ok(self.tell(Msg::Answer(answer)));
        }
        if line.trim().is_empty() && empty {
            if self.sitting.view().can.next {
                self.editor = None;
                return Ok(self.tell(Msg::Next));
            }
            output::line("! Say it in your own words, and end with a line of one `.`")?;
            return Ok(Then::Stay);
        }
        let lines = self.editor.get_or_insert_default();
        lines.push(line.to_owned());
        let draft = lines.join("\n");
        Ok(self.tell(Msg::Draft(draft)))
    }

    /// A line of a shader. Lines typed stand for the whole text; `:7 …` changes one line of it;
    /// a line of one `.` runs it.
    fn take_code(&mut self, line: &str) -> Result<Then, Failure> {
        let Input::Code { text, .. } = &self.sitting.view().input else {
            return Ok(Then::Stay);
        };
        let text = text.clone();
        let command = line.trim();
        if command == "." {
            let typed = self.editor.take().map(|lines| lines.join("\n"));
            return Ok(self.tell(Msg::Answer(typed.unwrap_or(text))));
        }
        if command == ":edit" {
            let text = self.editor.as_ref().map_or(text, |lines| lines.join("\n"));
            return match crate::editor::edit(&text) {
                Ok(edited) => {
                    self.editor = None;
                    Ok(self.tell(Msg::Answer(edited.trim_end().to_owned())))
                }
                Err(why) => {
                    print(&text::wrap_plain(&why, WIDTH, "! ", "  "))?;
                    Ok(Then::Stay)
                }
            };
        }
        if command == ":show" {
            let text = self.editor.as_ref().map_or(text, |lines| lines.join("\n"));
            print(&numbered(&text))?;
            self.asked = true;
            return Ok(Then::Stay);
        }
        if let Some(rest) = command.strip_prefix(':') {
            let digits = rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            let text = self.editor.as_ref().map_or(text, |lines| lines.join("\n"));
            self.asked = true;
            match with_line(&text, &rest[..digits], rest[digits..].trim_start()) {
                Some((changed, shown)) => {
                    self.editor = None;
                    output::line(&shown)?;
                    return Ok(self.tell(Msg::Draft(changed)));
                }
                None => {
                    output::line("! :7 TEXT changes line 7; a line of one `.` runs the whole.")?;
                    return Ok(Then::Stay);
                }
            }
        }
        if command.is_empty() && self.editor.is_none() {
            return Ok(self.tell(Msg::Next));
        }
        let lines = self.editor.get_or_insert_default();
        lines.push(line.to_owned());
        // Whatever ends the input, what was typed is kept.
        let draft = lines.join("\n");
        Ok(self.tell(Msg::Draft(draft)))
    }

    /// Leaving an explanation half written: what there is was kept line by line.
    fn keep_draft(&mut self) {
        self.editor = None;
    }

    fn tell(&mut self, msg: Msg) -> Then {
        self.told = true;
        self.offer = None;
        let quits = msg == Msg::Quit;
        match (self.sitting.tell(msg).contains(&Request::Leave), quits) {
            (false, _) => Then::Stay,
            (true, true) => Then::Leave,
            (true, false) => Then::Finish,
        }
    }

    /// Prints what is new: a new screen, or what was added to this one; then what is asked.
    fn print_news(&mut self) -> Result<(), Failure> {
        let view = self.sitting.view().clone();
        let before = self.seen.replace(view.clone());
        let lesson = self.sitting.lesson().clone();
        let same_screen = before.as_ref().is_some_and(|before| before.key == view.key);
        let old_blocks = if same_screen {
            before.as_ref().map_or(0, |before| before.blocks.len())
        } else {
            0
        };
        if !same_screen {
            output::line("")?;
            output::line(&headline(&view))?;
        }
        let describe = Profiles { lesson: &lesson };
        for block in view.blocks.iter().skip(old_blocks) {
            output::line("")?;
            print(&text::plain(block, WIDTH, &describe))?;
        }
        if let Some(note) = view.note.as_ref().filter(|_| self.told) {
            output::line("")?;
            print(&text::wrap_plain(note, WIDTH, "! ", "  "))?;
        }
        self.print_unsaved(&view)?;
        if self.editor.is_none() && !std::mem::take(&mut self.asked) {
            self.ask(&view, same_screen)?;
        }
        if !self.echo {
            // A terminal shows what is typed; this shows where.
            output::text("> ")?;
        }
        Ok(())
    }

    fn print_unsaved(&mut self, view: &View) -> Result<(), Failure> {
        match &view.saving {
            Saving::Failed(why) if !self.said_unsaved => {
                self.said_unsaved = true;
                let says = format!("Not saved: {why}. It is kept in memory and tried again.");
                print(&text::wrap_plain(&says, WIDTH, "! ", "  "))
            }
            Saving::Saved if self.said_unsaved => {
                self.said_unsaved = false;
                output::line("✓ Saved now, everything that was kept.")
            }
            _ => Ok(()),
        }
    }

    fn ask(&mut self, view: &View, same_screen: bool) -> Result<(), Failure> {
        let mut lines = Vec::new();
        match &view.input {
            Input::None => {
                let label = if view.next_label.is_empty() {
                    "on"
                } else {
                    &view.next_label
                };
                lines.push(format!("[Empty line: {label}]"));
            }
            Input::Number { label, note, draft } => {
                let note = if note.is_empty() {
                    String::new()
                } else {
                    format!(" ({note})")
                };
                lines.extend(text::wrap_plain(
                    &format!("{label}{note}?"),
                    WIDTH,
                    "",
                    "  ",
                ));
                if !draft.is_empty() && !same_screen {
                    lines.push("You had begun to write:".into());
                    lines.extend(draft.lines().map(|line| format!("| {line}")));
                }
            }
            Input::Reply { label, note, draft } => {
                lines.extend(text::wrap_plain(
                    &format!("{label} ({note})?"),
                    WIDTH,
                    "",
                    "  ",
                ));
                lines.push("[One line; :hint for more help, :skip for no more questions]".into());
                if !draft.is_empty() && !same_screen {
                    lines.push("You had begun to write:".into());
                    lines.extend(draft.lines().map(|line| format!("| {line}")));
                }
            }
            Input::Text { label, draft } => {
                lines.extend(text::wrap_plain(label, WIDTH, "", "  "));
                lines.push(
                    "[Write as many lines as you like; a line of one `.` hands it in]".into(),
                );
                if !draft.is_empty() && !same_screen {
                    lines.push("Your draft so far; go on after it:".into());
                    lines.extend(draft.lines().map(|line| format!("| {line}")));
                    self.editor = Some(draft.split('\n').map(str::to_owned).collect());
                }
            }
            Input::Place { picture, .. } => {
                let lesson = self.sitting.lesson();
                let table = places_table(lesson, picture).filter(|_| !same_screen);
                if let Some(table) = table {
                    let block = Block::Table(table);
                    lines.extend(text::plain(&block, WIDTH, &Profiles { lesson }));
                }
                lines.push("Where on the ball would you look?".into());
                lines.push(
                    "[Type how far to the right and how far up, such as 0.8 -0.2; the".into(),
                );
                lines.push(" radius is 1. Or: centre, left, right, top, bottom]".into());
            }
            Input::Code { label, note, text } => {
                lines.extend(text::wrap_plain(
                    &format!("fn {label} ({}):", note.replace('`', "")),
                    WIDTH,
                    "",
                    "  ",
                ));
                lines.extend(numbered(text));
                lines.push(
                    "[Change a line: `:7 TEXT`; or type it anew, or `:edit` opens your".into(),
                );
                lines.push(" editor. A line of one `.` runs it.]".into());
            }
            Input::Choice { options } => {
                for (index, option) in options.iter().enumerate() {
                    lines.extend(text::wrap_plain(
                        option,
                        WIDTH,
                        &format!("{}. ", index + 1),
                        "   ",
                    ));
                }
                lines.push("[Type a number]".into());
            }
            Input::Order { items } => {
                for (index, item) in items.iter().enumerate() {
                    lines.extend(text::wrap_plain(
                        item,
                        WIDTH,
                        &format!("{}. ", index + 1),
                        "   ",
                    ));
                }
                lines.push("[Type the numbers in the right order, such as 2 1 3]".into());
            }
            Input::Checklist { points } => match points
                .iter()
                .position(|point| point.said.is_none())
            {
                Some(open) => {
                    lines.extend(text::wrap_plain(
                        &points[open].text,
                        WIDTH,
                        &format!("{}. ", open + 1),
                        "   ",
                    ));
                    lines.push("[Does your answer say this? y or n]".into());
                }
                None => {
                    for (index, point) in points.iter().enumerate() {
                        let before = format!("{}. {} ", index + 1, text::tick(point.said));
                        lines.extend(text::wrap_plain(&point.text, WIDTH, &before, "       "));
                    }
                    lines.push("[Empty line: done; or a number and y or n to change one]".into());
                }
            },
        }
        output::line("")?;
        print(&lines)
    }

    fn part(self, result: Result<End, Failure>) -> Result<Done, Failure> {
        let Self {
            mut sitting, store, ..
        } = self;
        // Even where nobody reads any more, the answers are kept.
        let _ = sitting.tell(Msg::Quit);
        let over = sitting.view().stage == Stage::Result;
        let asks_due = sitting.asks_due();
        let saved = sitting.close();
        let end = result?;
        match saved {
            Ok(()) if over => output::line("\nSaved.")?,
            Ok(()) if asks_due => output::line("\nSaved. What is left stays due.")?,
            Ok(()) => output::line("\nSaved. The same command goes on from here.")?,
            Err(why) => {
                return Err(Failure::unusable(format!(
                    "not saved in {}: {why}; make room there or name another folder with --progress",
                    store.folder.display()
                )));
            }
        }
        match end {
            End::Left | End::InputEnded => Ok(Done::Fine),
            End::Signal(signal) => std::process::exit(128 + signal),
        }
    }
}

fn print(lines: &[String]) -> Result<(), Failure> {
    lines.iter().try_for_each(|line| output::line(line))
}

struct Profiles<'a> {
    lesson: &'a Lesson,
}

impl text::Describe for Profiles<'_> {
    fn picture(&self, lesson: &str, id: &str, own: Option<&str>) -> Option<TableView> {
        if lesson != self.lesson.id.text {
            return None;
        }
        match own {
            None => profile_table(self.lesson, id),
            Some(source) => shaders::profile(self.lesson, id, source),
        }
    }

    fn map(&self, lesson: &str, id: &str) -> Option<TableView> {
        (lesson == self.lesson.id.text).then(|| map_table(self.lesson, id))?
    }
}
