//! The tutor on the screen: one loop that waits for keys, tells the state, and draws it.
//!
//! Nothing is drawn while nothing happens; the loop wakes sooner only while something of its
//! own is under way (a log being written, a draft to be kept, a picture being drawn).

pub mod ball;
pub mod dials;
pub mod draw;
pub mod field;
pub mod guard;
pub mod keyboard;
pub mod keys;
pub mod lesson;
pub mod picker;
pub mod pictures;
pub mod play;
pub mod probe;
pub mod review;
#[cfg(test)]
mod wire;

use std::io::stdout;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{DisableMouseCapture, EnableMouseCapture};
use crossterm::execute;
use crossterm::terminal::{Clear, ClearType};
use ratatui::Frame;
use tutor::Lesson;
use tutor::view::Stage;

use self::draw::style::Palette;
use self::guard::Guard;
use self::keyboard::Keyboard;
use self::keys::{Action, Focus};
use self::lesson::{Flow, LessonScreen};
use self::picker::{Chosen, Picker};
use self::pictures::Pictures;
use self::play::{Left, Play};
use crate::config::SecondJudge;
use crate::due::{Due, Lineup};
use crate::exit::{Done, Failure, plain_reason};
use crate::lessons::Shelf;
use crate::sitting::{Sitting, Wish};
use crate::store::Store;

/// How long the loop sleeps while nothing is under way; only a signal waits for it.
const IDLE: Duration = Duration::from_millis(500);

/// What is on the screen.
enum Screen {
    Picker(Picker),
    Lesson(Box<LessonScreen>),
}

struct App<'a> {
    shelf: &'a Shelf,
    store: &'a Store,
    /// Who gives second opinions.
    judge: Option<SecondJudge>,
    screen: Screen,
    /// How far the help is scrolled, while it lies over the screen.
    help: Option<usize>,
    pictures: Pictures,
    keyboard: Keyboard,
    palette: Palette,
    /// Whether leaving a lesson leads to the list.
    from_list: bool,
    /// What comes when a lesson is at its end.
    lineup: Option<Lineup>,
    /// How the lesson was opened.
    wish: Wish,
}

/// What to open.
pub enum Open<'a> {
    List,
    Lesson(&'a Arc<Lesson>, Wish),
    /// What is due, alone.
    Due(Due),
}

/// Runs the tutor until the learner leaves.
pub fn run(
    shelf: &Shelf,
    store: &Store,
    judge: Option<SecondJudge>,
    open: Open,
) -> Result<Done, Failure> {
    let palette = Palette::from_env();
    let mut app = App {
        shelf,
        store,
        judge,
        screen: Screen::Picker(Picker::empty()),
        help: None,
        pictures: Pictures::new(palette.has_colours()),
        keyboard: Keyboard::default(),
        palette,
        from_list: matches!(open, Open::List),
        lineup: None,
        wish: Wish::default(),
    };
    match open {
        Open::List => app.screen = Screen::Picker(Picker::new(shelf, store)),
        Open::Lesson(lesson, wish) => app.open(lesson, wish)?,
        Open::Due(due) => {
            app.lineup = Some(Lineup::new(due, None));
            app.go_on()?;
        }
    }
    let result = app.run_in_terminal();
    let parting = app.part();
    result?;
    parting
}

impl App<'_> {
    fn run_in_terminal(&mut self) -> Result<(), Failure> {
        let broken = |error: std::io::Error| {
            Failure::unusable(format!("the terminal gave up: {}", plain_reason(&error)))
        };
        let (guard, mut terminal) = Guard::take().map_err(broken)?;
        let (mut redraw, mut mouse) = (true, false);
        loop {
            if redraw {
                let size = terminal.size().map_err(broken)?;
                self.fit(size.into());
                terminal.draw(|frame| self.draw(frame)).map_err(broken)?;
                // Only while it is of use: elsewhere the mouse is the terminal's, to select with.
                if mouse != self.wants_mouse() {
                    mouse = !mouse;
                    match mouse {
                        true => execute!(stdout(), EnableMouseCapture),
                        false => execute!(stdout(), DisableMouseCapture),
                    }
                    .map_err(broken)?;
                }
                // After the first frame, so that it need not wait for the terminal's answer.
                self.want_pictures();
                self.keyboard.put_back(&self.pictures.typed());
                #[cfg(debug_assertions)]
                panic_where_a_test_asks();
            }
            redraw = false;
            if self.keyboard.poll(self.wakes_in()).map_err(broken)? {
                // All keys that wait are one step: a held key never runs ahead of the screen.
                loop {
                    let event = self.keyboard.read().map_err(broken)?;
                    let action = keys::action(event, self.focus());
                    let mut repaint = action == Action::Repaint;
                    redraw |= action != Action::Nothing;
                    match self.act(action)? {
                        // What is due is opened already.
                        Flow::Stay | Flow::AskDue => {}
                        Flow::Play => {
                            if self.play(&mut terminal).map_err(broken)? == Left::QuitAll {
                                let _ = self.act(Action::QuitAll)?;
                                return Ok(());
                            }
                            repaint = true;
                        }
                        Flow::Leave | Flow::Finish => return Ok(()),
                        Flow::OpenEditor => {
                            self.open_editor(&guard).map_err(broken)?;
                            repaint = true;
                        }
                    }
                    if repaint {
                        // Not `Terminal::clear`: that asks the terminal where its cursor is, and
                        // gives up where no answer comes.
                        execute!(stdout(), Clear(ClearType::All)).map_err(broken)?;
                        terminal.swap_buffers();
                    }
                    if !self.keyboard.poll(Duration::ZERO).map_err(broken)? {
                        break;
                    }
                }
            }
            if guard::signalled().is_some() {
                return Ok(());
            }
            redraw |= self.tend();
        }
    }

    /// Whether there is something to point at.
    fn wants_mouse(&self) -> bool {
        match &self.screen {
            Screen::Lesson(lesson) => matches!(lesson.field, field::Field::Place(_)),
            Screen::Picker(_) => false,
        }
    }

    fn focus(&self) -> Focus {
        match (&self.screen, self.help) {
            (_, Some(_)) => Focus::Help,
            (Screen::Picker(_), None) => Focus::Picker,
            (Screen::Lesson(lesson), None) => lesson.focus,
        }
    }

    fn wakes_in(&self) -> Duration {
        let lesson = match &self.screen {
            Screen::Lesson(lesson) => lesson.wakes_in(),
            Screen::Picker(_) => None,
        };
        [lesson, self.pictures.wakes_in()]
            .into_iter()
            .flatten()
            .fold(IDLE, Duration::min)
    }

    /// Does what waits. True where the screen changed.
    fn tend(&mut self) -> bool {
        let turning = self.pictures.wakes_in().is_some();
        let finished = self.pictures.collect();
        let told = match &mut self.screen {
            Screen::Lesson(lesson) => lesson.tend(),
            Screen::Picker(_) => false,
        };
        turning || finished || told
    }

    fn act(&mut self, action: Action) -> Result<Flow, Failure> {
        if action == Action::QuitAll {
            return Ok(match &mut self.screen {
                Screen::Lesson(lesson) => lesson.act(action),
                Screen::Picker(_) => Flow::Leave,
            });
        }
        if let Some(scroll) = self.help {
            self.help = match action {
                Action::Leave => None,
                Action::Up => Some(scroll.saturating_sub(1)),
                Action::Down => Some(scroll + 1),
                _ => Some(scroll),
            };
            return Ok(Flow::Stay);
        }
        if action == Action::Help {
            self.help = Some(0);
            return Ok(Flow::Stay);
        }
        match &mut self.screen {
            Screen::Picker(picker) => match picker.act(&action) {
                Chosen::Nothing => Ok(Flow::Stay),
                Chosen::Leave => Ok(Flow::Leave),
                Chosen::Lesson { lesson } => {
                    self.open(&lesson, Wish::default())?;
                    Ok(Flow::Stay)
                }
                Chosen::Due { lesson } => {
                    if let Some(due) = Due::within(self.shelf, self.store, &lesson) {
                        self.lineup = Some(Lineup::new(due, None));
                        self.go_on()?;
                    }
                    Ok(Flow::Stay)
                }
            },
            Screen::Lesson(lesson) => match lesson.act(action) {
                Flow::AskDue | Flow::Finish if !lesson.may_go() => Ok(Flow::Stay),
                Flow::AskDue => {
                    let then = Some((Arc::clone(lesson.sitting.lesson()), self.wish));
                    if let Some(due) = lesson.offer.take() {
                        self.lineup = Some(Lineup::new(due, then));
                        self.go_on()?;
                    }
                    Ok(Flow::Stay)
                }
                Flow::Finish if self.go_on()? => Ok(Flow::Stay),
                flow @ (Flow::Leave | Flow::Finish) if self.from_list => {
                    self.back_to_list(flow);
                    Ok(Flow::Stay)
                }
                flow => Ok(flow),
            },
        }
    }

    /// Opens a lesson, and offers what is due in others.
    fn open(&mut self, lesson: &Arc<Lesson>, wish: Wish) -> Result<(), Failure> {
        let sitting = Sitting::open(lesson, self.store, wish)?;
        let due = Due::elsewhere(self.shelf, self.store, lesson);
        self.wish = wish;
        self.show(sitting, due);
        Ok(())
    }

    /// Opens what comes next. False where nothing does.
    fn go_on(&mut self) -> Result<bool, Failure> {
        let next = match &mut self.lineup {
            Some(lineup) => lineup.next(self.store)?,
            None => None,
        };
        let goes_on = next.is_some();
        match next {
            Some(sitting) => self.show(sitting, None),
            None => self.lineup = None,
        }
        Ok(goes_on)
    }

    fn show(&mut self, sitting: Sitting, offer: Option<Due>) {
        let sitting = sitting.with_second_opinions(self.judge.clone());
        let screen = LessonScreen::new(sitting, offer, self.palette);
        self.screen = Screen::Lesson(Box::new(screen));
    }

    fn back_to_list(&mut self, flow: Flow) {
        let Screen::Lesson(lesson) = &mut self.screen else {
            return;
        };
        let said = match (lesson.sitting.asks_due(), flow) {
            (false, _) => "Saved. You come back to this very screen.",
            (true, Flow::Finish) => "Saved.",
            (true, _) => "Saved. What is left stays due.",
        };
        self.lineup = None;
        let mut picker = Picker::new(self.shelf, self.store);
        picker.said = Some(said.to_owned());
        self.screen = Screen::Picker(picker);
    }

    /// Opens the picture in view over the whole screen.
    fn play(&mut self, terminal: &mut guard::Screen) -> std::io::Result<Left> {
        let Screen::Lesson(lesson) = &mut self.screen else {
            return Ok(Left::Back);
        };
        let Some(subject) = lesson.picture_in_view() else {
            return Ok(Left::Back);
        };
        let taught = Arc::clone(lesson.sitting.lesson());
        let play = crate::fingerprints::fingerprint(&taught, &subject.id)
            .ok_or_else(|| "the lesson has no such picture".to_owned())
            .and_then(|fingerprint| Play::new(&fingerprint));
        match play {
            Ok(mut play) => {
                let picker = self.pictures.picker();
                self.keyboard.put_back(&self.pictures.typed());
                play.run(terminal, &mut self.keyboard, &picker, self.palette)
            }
            Err(why) => {
                lesson.greeting = vec![why];
                Ok(Left::Back)
            }
        }
    }

    /// Lends the terminal to the learner's editor.
    fn open_editor(&mut self, guard: &Guard) -> std::io::Result<()> {
        let Screen::Lesson(lesson) = &mut self.screen else {
            return Ok(());
        };
        let Some(text) = lesson.text_to_edit() else {
            return Ok(());
        };
        let edited = guard.lend(|| crate::editor::edit(&text))?;
        lesson.take_over(edited);
        Ok(())
    }

    fn fit(&mut self, area: ratatui::layout::Rect) {
        if let Screen::Lesson(lesson) = &mut self.screen
            && draw::has_room(area)
        {
            // First for the width, from which the page's height follows, then for the height.
            for _ in 0..2 {
                let areas = draw::lesson::Areas::new(lesson, area);
                let page = areas.page;
                let ball = draw::input::inside(areas.input);
                lesson.fit(page.width, page.height);
                lesson.fit_ball(ball.height, (ball.x, ball.y));
            }
        }
    }

    fn draw(&self, frame: &mut Frame) {
        if !draw::has_room(frame.area()) {
            draw::too_small(frame);
            return;
        }
        match &self.screen {
            Screen::Picker(picker) => draw::picker::draw(frame, picker, self.palette),
            Screen::Lesson(lesson) => {
                draw::lesson::draw(frame, lesson, &self.pictures, self.palette)
            }
        }
        if let Some(scroll) = self.help {
            draw::help::draw(
                frame,
                scroll.min(draw::help::last_scroll(frame.area().height)),
                self.palette,
            );
        }
    }

    fn want_pictures(&mut self) {
        match &self.screen {
            Screen::Lesson(lesson) => {
                let taught = Arc::clone(lesson.sitting.lesson());
                self.pictures.want(&taught, lesson.page.pictures());
            }
            Screen::Picker(_) => {}
        }
    }

    /// Saves what is left, and says so on the terminal that was given back.
    fn part(self) -> Result<Done, Failure> {
        let Screen::Lesson(mut lesson) = self.screen else {
            return Ok(Done::Fine);
        };
        lesson.save_draft();
        let id = lesson.sitting.lesson().id.text.clone();
        let over = lesson.view().stage == Stage::Result;
        let asks_due = lesson.sitting.asks_due();
        match lesson.sitting.close() {
            Ok(()) => {
                // The terminal may be gone: then there is nobody to tell.
                let _ = crate::output::line(&match over {
                    _ if asks_due => "Saved. What is left stays due.".to_owned(),
                    true => "Saved. `lobe list` says when it is due again.".to_owned(),
                    false => format!("Saved. `lobe learn {id}` goes on where you left."),
                });
                Ok(Done::Fine)
            }
            Err(why) => Err(Failure::unusable(format!(
                "not saved in {}: {why}; make room there or name another folder with --progress",
                self.store.folder.display()
            ))),
        }
    }
}

/// So that a test can see that a panic gives the terminal back.
#[cfg(debug_assertions)]
fn panic_where_a_test_asks() {
    assert!(
        std::env::var_os("LOBE_TEST_PANIC").is_none(),
        "a test asked for a panic"
    );
}
