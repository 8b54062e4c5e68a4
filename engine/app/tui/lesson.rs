//! The screen of a lesson: what a key does to the session, and what of it is in view.

use std::time::{Duration, Instant};

use tutor::prose::Block;
use tutor::session::Msg;
use tutor::view::{Input, View};

use super::draw::page::Page;
use super::draw::style::Palette;
use super::field::Field;
use super::keys::{Action, Focus};
use crate::due::Due;
use crate::fingerprints::{Subject, fingerprint};
use crate::sitting::{Request, Sitting};

/// A pause in typing after which the draft is saved.
const DRAFT_AFTER: Duration = Duration::from_millis(600);

/// The draft of who types on without a pause is saved as often.
const DRAFT_EVERY: Duration = Duration::from_secs(3);

/// How fast the sign turns while something is waited for.
const SPINNING: Duration = Duration::from_millis(120);

/// Said of a lesson that was begun before.
pub const GOING_ON: &str = "Going on where you left.";

/// Rows of a page that are too few for a picture and a text below it.
const LOW: usize = 20;

/// What the loop does next.
#[must_use]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flow {
    Stay,
    /// The lesson is left.
    Leave,
    /// It is at its end.
    Finish,
    /// What is due in other lessons comes first.
    AskDue,
    /// The text in the field is wanted in the learner's own editor.
    OpenEditor,
    /// The picture in view is wanted under the arrow keys.
    Play,
}

/// The state of the screen; drawing takes a shared reference.
pub struct LessonScreen {
    pub sitting: Sitting,
    pub field: Field,
    pub focus: Focus,
    pub page: Page,
    pub scroll: usize,
    /// The line that came new and is to be seen, however high the window turns out to be.
    follow: Option<usize>,
    /// The cell of the screen at the upper left of the ball, where there is one.
    pub ball_at: Option<(u16, u16)>,
    /// The screen that the window was last made for.
    fitted: String,
    /// Rows in which the page is seen.
    pub window: usize,
    /// Said before the lesson starts, until a key is pressed.
    pub greeting: Vec<String>,
    /// What is due in other lessons, until the first answer or page.
    pub offer: Option<Due>,
    /// Leaving would lose something: the next `q` means it.
    pub leaving_unsaved: Option<String>,
    /// What the field and the page were made for.
    shown: View,
    laid_out_for: u16,
    palette: Palette,
    /// When the text was changed, where that is not saved yet.
    typed: Option<Typed>,
    /// When waiting began.
    asked_at: Option<Instant>,
}

impl LessonScreen {
    pub fn new(sitting: Sitting, offer: Option<Due>, palette: Palette) -> Self {
        let shown = sitting.view().clone();
        let field = Field::of(&shown.input);
        let mut greeting: Vec<String> = sitting
            .notices
            .iter()
            .map(|notice| notice.says.clone())
            .collect();
        if sitting.resumed && greeting.is_empty() {
            greeting.push(GOING_ON.into());
        }
        Self {
            focus: field.focus(),
            page: Page::new(&shown.blocks, 80, palette),
            scroll: 0,
            follow: None,
            ball_at: None,
            fitted: String::new(),
            window: 1,
            greeting,
            offer,
            leaving_unsaved: None,
            laid_out_for: 80,
            palette,
            typed: None,
            asked_at: None,
            sitting,
            field,
            shown,
        }
    }

    pub fn view(&self) -> &View {
        &self.shown
    }

    /// Lays the page out for a window of that size.
    pub fn fit(&mut self, width: u16, height: u16) {
        let scrolled = self.last_scroll() > 0;
        let at_end = self.scroll >= self.last_scroll();
        if self.laid_out_for != width {
            // What is read stays at the top, however many lines come before it now.
            let (block, line) = self.page.block_at(self.scroll);
            self.page = Page::new(&self.shown.blocks, width, self.palette);
            self.laid_out_for = width;
            let first = self.page.start_of(block);
            let last = self.page.start_of(block + 1).saturating_sub(1);
            self.scroll = (first + line).min(last.max(first));
        }
        // A note below takes its lines from the page: what was read last stays in view.
        let lost = self.window.saturating_sub(height as usize);
        let stays_at_end = at_end && (scrolled || lost <= 3) && self.fitted == self.shown.key;
        self.window = height as usize;
        self.fitted.clone_from(&self.shown.key);
        if stays_at_end {
            self.scroll = self.last_scroll();
        }
        self.scroll = self.follow.unwrap_or(self.scroll).min(self.last_scroll());
    }

    /// What is known of the place under the cursor of a ball: where it is, how the light falls
    /// and how one looks at it, but not how wrong it is.
    pub fn under_cursor(&self) -> Vec<String> {
        let (Field::Place(ball), Input::Place { picture, .. }) = (&self.field, &self.shown.input)
        else {
            return Vec::new();
        };
        let (x, y) = ball.place();
        let mut lines = vec![
            format!(
                "{:.2} to the {}",
                x.abs(),
                if x < 0.0 { "left" } else { "right" }
            ),
            format!("{:.2} {}", y.abs(), if y < 0.0 { "down" } else { "up" }),
        ];
        if x.hypot(y) >= 1.0 {
            lines.push("beside the ball".to_owned());
            return lines;
        }
        let print = fingerprint(self.sitting.lesson(), picture);
        match print.and_then(|print| renders::point_at(&print, x, y)) {
            Some(point) => {
                lines.push(format!("N·L = {:.2}", point.n_dot_l));
                lines.push(format!("N·V = {:.2}", point.n_dot_v));
            }
            None => lines.push("no light here".to_owned()),
        }
        lines
    }

    /// Has the ball drawn for the place that it gets.
    pub fn fit_ball(&mut self, rows: u16, at: (u16, u16)) {
        if let Field::Place(ball) = &mut self.field {
            ball.fit(self.sitting.lesson(), rows);
            self.ball_at = Some(at);
        } else {
            self.ball_at = None;
        }
    }

    fn last_scroll(&self) -> usize {
        self.page.height().saturating_sub(self.window)
    }

    /// Whether something stands below the window.
    pub fn has_more_below(&self) -> bool {
        self.scroll < self.last_scroll()
    }

    /// Whether anything of the page is out of view.
    pub fn scrolls(&self) -> bool {
        self.last_scroll() > 0
    }

    /// The picture of the lesson that is in view, the first of several.
    pub fn picture_in_view(&self) -> Option<&Subject> {
        self.page.picture_in(self.scroll..self.scroll + self.window)
    }

    /// How long the loop may sleep, where something waits to be done here.
    pub fn wakes_in(&self) -> Option<Duration> {
        const SAVING: Duration = Duration::from_millis(10);
        if self.sitting.is_saving() || self.sitting.is_running() {
            return Some(SAVING);
        }
        let draft = self.typed.map(|typed| typed.draft_in());
        let asking = self.sitting.is_asking().then_some(SPINNING);
        draft.into_iter().chain(asking).min()
    }

    /// What is waited for, and the sign that something is under way.
    pub fn waiting(&self) -> Option<(&'static str, &str)> {
        const SIGNS: [&str; 4] = ["◐", "◓", "◑", "◒"];
        let what = self.shown.waiting.as_deref()?;
        let turns =
            self.asked_at.map_or(0, |when| when.elapsed().as_millis()) / SPINNING.as_millis();
        Some((SIGNS[(turns % 4) as usize], what))
    }

    /// Does what waits. True where the screen changed.
    pub fn tend(&mut self) -> bool {
        if self.typed.is_some_and(|typed| typed.draft_in().is_zero()) {
            self.save_draft();
        }
        let changed = self.sitting.collect();
        if changed {
            self.refresh();
        }
        changed || self.shown.waiting.is_some()
    }

    fn note_typing(&mut self) {
        let now = Instant::now();
        let first = self.typed.map_or(now, |typed| typed.first);
        self.typed = Some(Typed { first, last: now });
    }

    /// What an action of the learner does.
    pub fn act(&mut self, action: Action) -> Flow {
        self.greeting.clear();
        self.follow = None;
        if self.leaving_unsaved.is_some() && !matches!(action, Action::Quit | Action::QuitAll) {
            self.leaving_unsaved = None;
            return Flow::Stay;
        }
        match action {
            Action::Quit | Action::QuitAll => return self.leave(),
            Action::Enter => return self.enter(),
            Action::Forward => return self.forward(),
            Action::HandIn => return self.hand_in(),
            Action::OpenEditor if matches!(self.field, Field::Code(_)) => return Flow::OpenEditor,
            Action::OpenEditor => {}
            Action::Play if self.picture_in_view().is_some() => {
                self.save_draft();
                return Flow::Play;
            }
            Action::Play => {}
            Action::AskDue if self.offer.is_some() => {
                self.save_draft();
                return Flow::AskDue;
            }
            Action::AskDue => {}
            Action::Back => return self.send_if(self.shown.can.back, Msg::Back),
            Action::Skip => return self.skip(),
            Action::Hint => return self.send_if(self.shown.can.hint.is_some(), Msg::Hint),
            Action::Up => self.up_or_down(false),
            Action::Down => self.up_or_down(true),
            Action::PageUp => {
                self.scroll = self
                    .scroll
                    .saturating_sub(self.window.saturating_sub(2).max(1))
            }
            Action::PageDown => self.page_down(),
            Action::Top => self.scroll = 0,
            Action::Bottom => self.scroll = self.last_scroll(),
            Action::NextFocus => self.next_focus(),
            Action::Leave => self.focus = Focus::Page,
            Action::Toggle => return self.toggle(None),
            Action::Yes => return self.toggle(Some(true)),
            Action::No => return self.toggle(Some(false)),
            Action::Pick(index) => self.pick(index),
            Action::Move(right, down) => {
                if let Field::Place(ball) = &mut self.field {
                    ball.step((right, down));
                }
            }
            Action::Click(column, row) => {
                if let (Field::Place(ball), Some(at)) = (&mut self.field, self.ball_at)
                    && let Some(cell) = inside(at, ball.cells(), (column, row))
                {
                    ball.at = cell;
                    self.focus = Focus::Place;
                }
            }
            Action::Scroll(lines) => {
                let to = self.scroll.saturating_add_signed(lines.into());
                self.scroll = to.min(self.last_scroll());
            }
            Action::Edit(edit) => {
                if self.field.edit(edit) {
                    self.note_typing();
                }
            }
            Action::Paste(text) => {
                if matches!(self.focus, Focus::Line | Focus::Editor) {
                    self.field.paste(&text);
                    self.note_typing();
                }
            }
            Action::Help | Action::Redraw | Action::Repaint | Action::Nothing => {}
        }
        Flow::Stay
    }

    fn enter(&mut self) -> Flow {
        match (self.focus, &self.field) {
            (Focus::Line, Field::Line(_)) => {
                let text = self.field.text().unwrap_or_default();
                let msg = if text.trim().is_empty() {
                    Msg::Next
                } else {
                    Msg::Answer(text.trim().to_owned())
                };
                self.send(msg)
            }
            (Focus::Options, Field::Choice { at }) => self.send(Msg::Answer((at + 1).to_string())),
            (Focus::Options, Field::Order(order)) => self.send(Msg::Answer(order.answer())),
            (Focus::Options, Field::Checklist { .. }) => self.send(Msg::ChecklistDone),
            // What was not read yet comes first.
            _ if self.has_more_below() => {
                self.page_down();
                Flow::Stay
            }
            _ if self.shown.can.next => self.send(Msg::Next),
            _ => {
                self.focus = self.field.focus();
                Flow::Stay
            }
        }
    }

    /// Goes on as Enter does, but leaves nothing unanswered: the same key moves cursors.
    fn forward(&mut self) -> Flow {
        if matches!(self.field, Field::None) || self.has_more_below() {
            return self.enter();
        }
        self.focus = self.field.focus();
        Flow::Stay
    }

    /// Skips, and says how to come back where several pages are passed over.
    fn skip(&mut self) -> Flow {
        let passed = self.shown.skip_label.strip_prefix("skip the ");
        let passed = passed.map(|what| format!("The {what} is skipped. ← goes back to it."));
        let flow = self.send_if(self.shown.can.skip, Msg::Skip);
        self.greeting.extend(passed);
        flow
    }

    fn hand_in(&mut self) -> Flow {
        match &self.field {
            Field::Editor(_) | Field::Code(_) => {
                let text = self.field.text().unwrap_or_default();
                self.typed = None;
                // A shader's first lines may be empty for a reason; an explanation's are not.
                let text = match &self.field {
                    Field::Editor(_) => text.trim(),
                    _ => text.trim_end(),
                };
                self.send(Msg::Answer(text.to_owned()))
            }
            Field::Place(ball) => {
                let answer = ball.answer();
                self.send(Msg::Answer(answer))
            }
            _ => Flow::Stay,
        }
    }

    /// The text that an editor is to open.
    pub fn text_to_edit(&self) -> Option<String> {
        self.field.text()
    }

    /// Takes over what came back from an editor, or says why nothing did.
    pub fn take_over(&mut self, edited: Result<String, String>) {
        match edited {
            Ok(text) => {
                self.field = Field::of_code(&text);
                self.note_typing();
                self.save_draft();
                self.refresh();
            }
            Err(why) => self.greeting = vec![why],
        }
    }

    fn up_or_down(&mut self, down: bool) {
        let count = match &self.shown.input {
            Input::Choice { options } => options.len(),
            Input::Order { items } => items.len(),
            Input::Checklist { points } => points.len(),
            _ => 0,
        };
        if self.focus == Focus::Options {
            self.field.step(down, count);
        } else if down {
            self.scroll = (self.scroll + 1).min(self.last_scroll());
        } else {
            self.scroll = self.scroll.saturating_sub(1);
        }
    }

    fn page_down(&mut self) {
        self.scroll = (self.scroll + self.window.saturating_sub(2).max(1)).min(self.last_scroll());
    }

    fn next_focus(&mut self) {
        self.focus = match (self.focus, &self.field) {
            (Focus::Editor, _) => Focus::Button,
            (Focus::Page, field) => field.focus(),
            _ => Focus::Page,
        };
    }

    fn toggle(&mut self, wanted: Option<bool>) -> Flow {
        match (&mut self.field, &self.shown.input) {
            (Field::Order(order), _) if wanted.is_none() => {
                order.grabbed = !order.grabbed;
                Flow::Stay
            }
            (Field::Checklist { at }, Input::Checklist { points }) => {
                let Some(point) = points.get(*at) else {
                    return Flow::Stay;
                };
                let said = wanted.unwrap_or(point.said != Some(true));
                let msg = Msg::Mark { point: *at, said };
                if wanted.is_some() {
                    *at = (*at + 1).min(points.len() - 1);
                }
                self.send(msg)
            }
            _ => Flow::Stay,
        }
    }

    fn pick(&mut self, index: usize) {
        match (&mut self.field, &self.shown.input) {
            (Field::Choice { at }, Input::Choice { options }) if index < options.len() => {
                *at = index
            }
            (Field::Order(order), _) if index < order.places.len() => order.at = index,
            (Field::Checklist { at }, Input::Checklist { points }) if index < points.len() => {
                *at = index
            }
            _ => {}
        }
    }

    fn send_if(&mut self, can: bool, msg: Msg) -> Flow {
        if can { self.send(msg) } else { Flow::Stay }
    }

    fn send(&mut self, msg: Msg) -> Flow {
        let clears = matches!(msg, Msg::Answer(_));
        self.offer = None;
        if !clears {
            self.save_draft();
        }
        let requests = self.sitting.tell(msg);
        if clears && let Field::Line(_) = self.field {
            self.typed = None;
            self.field = Field::of(&self.sitting.view().input);
        }
        self.refresh();
        if requests.contains(&Request::Leave) {
            Flow::Finish
        } else {
            Flow::Stay
        }
    }

    /// Hands the text over that was not handed in, so that leaving keeps it.
    pub fn save_draft(&mut self) {
        if self.typed.take().is_some()
            && matches!(
                self.shown.input,
                Input::Number { .. }
                    | Input::Text { .. }
                    | Input::Reply { .. }
                    | Input::Code { .. }
            )
        {
            let text = self.field.text().unwrap_or_default();
            // A draft asks for nothing but to be saved.
            let _ = self.sitting.tell(Msg::Draft(text));
        }
    }

    fn leave(&mut self) -> Flow {
        if self.leaving_unsaved.is_some() {
            return Flow::Leave;
        }
        self.save_draft();
        let _ = self.sitting.tell(Msg::Quit);
        if self.may_go() {
            Flow::Leave
        } else {
            Flow::Stay
        }
    }

    /// Saves what is left. False where that fails: then the learner is asked first.
    pub fn may_go(&mut self) -> bool {
        self.sitting.settle();
        self.refresh();
        if let tutor::view::Saving::Failed(why) = &self.shown.saving {
            self.leaving_unsaved = Some(why.clone());
            return false;
        }
        true
    }

    /// Takes over what the session shows now.
    fn refresh(&mut self) {
        let view = self.sitting.view();
        let before = std::mem::replace(&mut self.shown, view.clone());
        let view = &self.shown;
        let other_screen = view.key != before.key;
        if view.waiting.is_some() != before.waiting.is_some() {
            self.asked_at = view.waiting.as_ref().map(|_| Instant::now());
        }
        if other_screen || !same_input(&view.input, &before.input) {
            self.field = Field::of(&view.input);
            self.focus = self.field.focus();
            self.typed = None;
        }
        if other_screen || view.blocks != before.blocks {
            self.page = Page::new(&view.blocks, self.laid_out_for, self.palette);
            // A ball that came new is to be looked at, and a low window has room for one of both.
            let new = view.blocks.iter().skip(before.blocks.len());
            if !other_screen && self.window < LOW && new.into_iter().any(is_own_ball) {
                self.focus = Focus::Page;
            }
            // What is new is in view; what was read may scroll away.
            self.follow = (!other_screen).then(|| self.page.start_of(before.blocks.len()));
            if !other_screen && matches!(self.field, Field::Code(_)) {
                self.follow_complaint(before.blocks.len());
            }
            self.scroll = self.follow.unwrap_or(0).min(self.last_scroll());
        }
    }
}

/// When a text was changed since it was last saved.
#[derive(Clone, Copy)]
struct Typed {
    first: Instant,
    last: Instant,
}

impl Typed {
    /// How long its draft may wait.
    fn draft_in(self) -> Duration {
        let pause = DRAFT_AFTER.saturating_sub(self.last.elapsed());
        pause.min(DRAFT_EVERY.saturating_sub(self.first.elapsed()))
    }
}

impl LessonScreen {
    /// What was said of a shader is seen with the place it is about, even where there is no room
    /// for all that is new; where there is none for that, the field makes room.
    fn follow_complaint(&mut self, first: usize) {
        let blocks = &self.shown.blocks;
        let said = blocks
            .iter()
            .rposition(|block| matches!(block, Block::Verdict { .. }))
            .filter(|said| *said >= first);
        let (Some(new), Some(said)) = (self.follow, said) else {
            return;
        };
        let end = self.page.height();
        if end - new <= self.window {
            return;
        }
        let said = self.page.start_of(said);
        self.follow = Some(said);
        if end - said > self.window {
            self.focus = Focus::Page;
        }
    }
}

/// The ball of a learner's shader.
fn is_own_ball(block: &Block) -> bool {
    matches!(block, Block::Picture { own: Some(_), .. })
}

/// The cell of a ball that lies under a cell of the screen.
fn inside(at: (u16, u16), size: (u16, u16), clicked: (u16, u16)) -> Option<(u16, u16)> {
    let column = clicked.0.checked_sub(at.0)?;
    let row = clicked.1.checked_sub(at.1)?;
    (column < size.0 && row < size.1).then_some((column, row))
}

/// Whether a field made for one serves for the other, text and all.
fn same_input(a: &Input, b: &Input) -> bool {
    match (a, b) {
        (
            Input::Number { label, note, .. },
            Input::Number {
                label: other_label,
                note: other_note,
                ..
            },
        ) => label == other_label && note == other_note,
        (Input::Text { label: a, .. }, Input::Text { label: b, .. })
        | (Input::Reply { label: a, .. }, Input::Reply { label: b, .. })
        | (Input::Code { label: a, .. }, Input::Code { label: b, .. })
        | (Input::Place { picture: a, .. }, Input::Place { picture: b, .. }) => a == b,
        (Input::Checklist { points: a }, Input::Checklist { points: b }) => a
            .iter()
            .map(|point| &point.text)
            .eq(b.iter().map(|point| &point.text)),
        _ => a == b,
    }
}
