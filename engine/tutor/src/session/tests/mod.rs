use super::*;
use crate::prose::{Block, plain};
use crate::view::Input;

pub(crate) mod any;
mod consult;
mod dialogue;
mod due;
mod explain;
mod flow;
mod listing;
mod look;
mod numbers;
mod replay;
mod shader;

/// A small lesson that has every kind of screen.
fn small() -> Arc<Lesson> {
    thread_local! {
        static SMALL: Arc<Lesson> = {
            let (lesson, findings) = crate::load::load("small.toml", include_str!("small.toml"));
            Arc::new(lesson.unwrap_or_else(|| panic!("the fixture does not load: {findings:#?}")))
        };
    }
    SMALL.with(Arc::clone)
}

/// On a screen of a lesson with a shader to mend and a picture to point at.
#[track_caller]
fn begin_lit(key: &str) -> Session {
    let (lesson, findings) = crate::load::load("lit.toml", include_str!("lit.toml"));
    let lesson = lesson.unwrap_or_else(|| panic!("{findings:#?}"));
    let mut session = Session::new(Arc::new(lesson), Start::default());
    walk_to(&mut session, key);
    session
}

fn begin() -> Session {
    Session::new(
        small(),
        Start {
            seed: 7,
            slips: Vec::new(),
        },
    )
}

/// Sends messages; what was asked to be saved.
fn send(session: &mut Session, msgs: impl IntoIterator<Item = Msg>) -> Vec<Event> {
    let mut saved = Vec::new();
    for msg in msgs {
        for effect in session.update(msg) {
            match effect {
                Effect::Save(event) => saved.push(event),
                Effect::Draw { .. }
                | Effect::Consult { .. }
                | Effect::StopConsulting
                | Effect::Run(_)
                | Effect::Quit
                | Effect::Look { .. } => {}
            }
        }
    }
    saved
}

fn answer(text: &str) -> Msg {
    Msg::Answer(text.to_owned())
}

/// Goes on, leaving out what stands in the way, until a screen is shown.
#[track_caller]
fn walk_to(session: &mut Session, key: &str) {
    for _ in 0..60 {
        if session.screen().key == key {
            return;
        }
        let msg = if session.screen().can.next {
            Msg::Next
        } else {
            Msg::Skip
        };
        send(session, [msg]);
    }
    panic!("{key} was never shown; at {}", session.screen().key);
}

/// Titles of everything the tutor said on the screen.
fn verdicts(session: &Session) -> Vec<&str> {
    let blocks = session.screen().blocks.iter();
    blocks
        .filter_map(|block| match block {
            Block::Verdict { title, .. } => Some(title.as_str()),
            _ => None,
        })
        .collect()
}

/// All words on the screen.
fn words(session: &Session) -> String {
    let mut out = String::new();
    for block in &session.screen().blocks {
        let part = match block {
            Block::Heading(text) | Block::CodeBlock(text) => text.clone(),
            Block::Paragraph(text) | Block::Quote(text) => plain(text),
            Block::List { items, .. } => items.iter().map(|item| plain(item) + "\n").collect(),
            Block::Table(table) => table.title.clone(),
            Block::Plot(plot) => plot.title.clone(),
            Block::Map(map) => map.title.clone(),
            Block::Picture { title, .. } => title.clone(),
            Block::Derivation { name, value, .. } => format!("{name} = {value}"),
            Block::Verdict { title, text, .. } => format!("{title}: {}", plain(text)),
            Block::Checklist { points } => format!("{points:?}"),
            Block::Quoted { text, .. } => text.clone(),
        };
        out.push_str(&part);
        out.push('\n');
    }
    out
}

/// The input as one word.
fn input(session: &Session) -> &'static str {
    match session.screen().input {
        Input::None => "none",
        Input::Number { .. } => "number",
        Input::Text { .. } => "text",
        Input::Reply { .. } => "reply",
        Input::Code { .. } => "code",
        Input::Place { .. } => "place",
        Input::Choice { .. } => "choice",
        Input::Order { .. } => "order",
        Input::Checklist { .. } => "checklist",
    }
}
