//! The screen as data, from the state.

use super::Session;
use super::decide::Open;
use super::event::Effect;
use super::screen::Screen;
use super::{show_dialogue, show_problem, show_question};
use crate::lesson::Lesson;
use crate::prose::{Block, Inline, Tone};
use crate::view::{Can, Input, Point, Progress, Saving, Stage, View};
use formula::Values;

/// A view before the first refresh.
pub(super) fn blank(lesson: &Lesson) -> View {
    View {
        lesson_title: lesson.title.text.clone(),
        stage: Stage::Why,
        stages: Vec::new(),
        place: (1, 1),
        heading: String::new(),
        key: String::new(),
        blocks: Vec::new(),
        input: Input::None,
        can: Can::default(),
        next_label: String::new(),
        skip_label: String::new(),
        waiting: None,
        note: None,
        saving: Saving::Nothing,
    }
}

pub(super) fn text(words: impl Into<String>) -> Inline {
    Inline::Text(words.into())
}

pub(super) fn paragraph(words: impl Into<String>) -> Block {
    Block::Paragraph(vec![text(words)])
}

pub(super) fn verdict(tone: Tone, title: &str, text: Vec<Inline>) -> Block {
    Block::Verdict {
        tone,
        title: title.to_owned(),
        text,
    }
}

/// The words with a capital letter first.
pub(super) fn capital(words: &str) -> String {
    let mut chars = words.chars();
    chars.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(chars).collect()
    })
}

impl Session {
    /// Makes the view anew; what is saved and noted stays.
    pub(super) fn refresh(&mut self) {
        let screen = self.here().clone();
        let (heading, blocks) = self.page(&screen);
        let can = self.can();
        self.view = View {
            lesson_title: match self.asks_due {
                true => format!("Due again: {}", self.lesson.title.text),
                false => self.lesson.title.text.clone(),
            },
            stage: screen.stage(&self.lesson),
            stages: self.stages(&screen),
            place: self.place(&screen),
            heading,
            key: screen.to_string(),
            blocks,
            input: self.input(),
            can,
            next_label: self.next_label(&screen, can),
            skip_label: self.skip_label(&screen).to_owned(),
            waiting: matches!(self.open(), Open::Opinion)
                .then(|| "Asking for a second opinion".to_owned()),
            note: self.view.note.take(),
            saving: std::mem::take(&mut self.view.saving),
        };
    }

    /// Pictures on the screen, to be drawn: [`Session::update`] asks for them when a screen comes
    /// up, and whoever resumes asks here.
    pub fn pictures(&self) -> Vec<Effect> {
        let blocks = self.view.blocks.iter();
        blocks
            .filter_map(|block| match block {
                Block::Picture { lesson, id, .. } => Some(Effect::Draw {
                    lesson: lesson.clone(),
                    picture: id.clone(),
                }),
                _ => None,
            })
            .collect()
    }

    /// Heading and blocks of a screen as things stand.
    pub(super) fn page(&self, screen: &Screen) -> (String, Vec<Block>) {
        let lesson = &self.lesson;
        let none = Values::new();
        match screen {
            Screen::Why => {
                let mut blocks = self.lead_ins();
                blocks.extend(lesson.prose(&lesson.why, &none));
                ("Why this matters".to_owned(), blocks)
            }
            Screen::Step(index) => match lesson.steps.get(*index) {
                Some(step) => {
                    let mut blocks = lesson.prose(&step.text, &none);
                    blocks.extend(lesson.figures(&step.figures));
                    if index + 1 == lesson.steps.len() {
                        blocks.extend(self.model());
                    }
                    (step.title.text.clone(), blocks)
                }
                None => Default::default(),
            },
            Screen::Worked => self.worked(),
            Screen::Faded(_) | Screen::Practice(_) | Screen::Retest(_) => {
                show_problem::page(self, screen)
            }
            Screen::Explain { item, attempt } => show_question::page(self, item, *attempt),
            Screen::Reteach { name, .. } => match lesson.reteach(name) {
                Some(reteach) => {
                    let mut blocks = vec![paragraph(
                        "What was missing, from another angle. Then you get the same question \
                         again.",
                    )];
                    blocks.extend(lesson.prose(&reteach.text, &none));
                    blocks.extend(lesson.figures(&reteach.figures));
                    (reteach.title.text.clone(), blocks)
                }
                None => Default::default(),
            },
            Screen::Result => ("How it went".to_owned(), self.result_page()),
        }
    }

    /// What an earlier lesson noted and this one takes up.
    fn lead_ins(&self) -> Vec<Block> {
        let noted = |id: &str| self.start.slips.iter().any(|slip| slip.id == id);
        let entries = self.lesson.takes_up.iter();
        entries
            .filter(|entry| noted(&entry.slip))
            .map(|entry| {
                let says = self.lesson.inline(&entry.says, &Values::new());
                verdict(Tone::Info, "Noted last time", says)
            })
            .collect()
    }

    /// The lesson in one sentence.
    pub(super) fn model(&self) -> Vec<Block> {
        let model = self.lesson.inline(&self.lesson.model, &Values::new());
        if model.is_empty() {
            return Vec::new();
        }
        vec![
            Block::Heading("In one sentence".to_owned()),
            Block::Quote(model),
        ]
    }

    fn worked(&self) -> (String, Vec<Block>) {
        let Some(worked) = &self.lesson.worked else {
            return Default::default();
        };
        let lines = worked.lines.len();
        let mut blocks = self
            .lesson
            .prose(&worked.intro, &self.lesson.worked_values(0));
        blocks.extend((0..lines.min(self.revealed)).filter_map(|at| self.lesson.worked_line(at)));
        if self.revealed >= lines
            && let Some(after) = &worked.after
        {
            blocks.extend(self.lesson.prose(after, &self.lesson.worked_values(lines)));
        }
        (worked.title.text.clone(), blocks)
    }

    fn stages(&self, here: &Screen) -> Vec<(Stage, Progress)> {
        let stage = here.stage(&self.lesson);
        let known = |other: &Stage| {
            *other == stage || self.path.iter().any(|s| s.stage(&self.lesson) == *other)
        };
        // A re-teach stands where its question stands.
        let order = |other: Stage| match other {
            Stage::Reteach => here.base_stage(&self.lesson),
            other => other,
        };
        let progress = |other: Stage| {
            if other == stage {
                Progress::Here
            } else if order(other) < order(stage) || other == order(stage) {
                Progress::Done
            } else {
                Progress::Ahead
            }
        };
        let mut stages: Vec<Stage> = Stage::ALL.into_iter().filter(known).collect();
        stages.sort_by_key(|other| (order(*other), *other != order(*other)));
        stages.into_iter().map(|s| (s, progress(s))).collect()
    }

    /// Position of a screen within its stage, from 1, and how many the stage has.
    pub(super) fn place(&self, here: &Screen) -> (usize, usize) {
        if let Screen::Reteach { item, name } = here {
            let explain = self.lesson.explain(item).zip(self.questions.get(item));
            let names =
                explain.map(|(explain, question)| question.reteaches(&self.lesson, explain));
            let names = names.unwrap_or_default();
            let at = names.iter().position(|other| other == name).unwrap_or(0);
            return (at + 1, names.len().max(1));
        }
        let stage = here.base_stage(&self.lesson);
        let of_stage = |screen: &&Screen| screen.base_stage(&self.lesson) == stage;
        let item = |screen: &Screen| match screen {
            Screen::Explain { item, .. } => Some(item.clone()),
            _ => None,
        };
        let same = |screen: &Screen| {
            screen == here || (item(here).is_some() && item(screen) == item(here))
        };
        let mut all = self.path.iter().filter(of_stage);
        let of = all.clone().count().max(1);
        (all.position(same).map_or(1, |at| at + 1), of)
    }

    fn input(&self) -> Input {
        match self.open() {
            Open::Nothing | Open::Line => Input::None,
            Open::Step(problem, step) => show_problem::input(self, problem, step),
            Open::Text(_, question) => Input::Text {
                label: "In your own words".to_owned(),
                draft: question.draft.clone(),
            },
            Open::Opinion => Input::None,
            Open::Reply(explain, _, asked) => {
                let question = self.questions.get(&explain.rubric.item);
                Input::Reply {
                    label: show_dialogue::label(asked.rung).to_owned(),
                    note: "a few words will do".to_owned(),
                    draft: question.map_or_else(String::new, |it| it.draft.clone()),
                }
            }
            Open::Marks(explain, _) => Input::Checklist {
                points: self.here_try().map_or_else(Vec::new, |tried| {
                    tried
                        .points(&explain.rubric)
                        .into_iter()
                        .map(|(id, text)| Point {
                            said: tried.marks.get(&id).copied(),
                            text,
                        })
                        .collect()
                }),
            },
        }
    }

    fn can(&self) -> Can {
        let next = match self.open() {
            Open::Nothing | Open::Line => true,
            Open::Step(problem, step) => problem.may_go_on(step) || self.is_reviewing(),
            Open::Text(..) | Open::Reply(..) | Open::Marks(..) => self.is_reviewing(),
            Open::Opinion => false,
        };
        Can {
            next,
            back: self.cursor > 0,
            skip: self.may_skip(),
            hint: self.next_hint(),
        }
    }

    fn next_label(&self, screen: &Screen, can: Can) -> String {
        let label = match self.open() {
            _ if !can.next => "",
            Open::Line => "next line",
            Open::Step(problem, step) if problem.may_go_on(step) => "leave it and go on",
            Open::Nothing if *screen == Screen::Result => "finish",
            Open::Nothing => match self.after(screen) {
                Some(Screen::Reteach { .. }) => "another angle",
                Some(Screen::Explain { attempt: 2, .. }) => "try again",
                Some(Screen::Result) => "to the result",
                _ => "on",
            },
            Open::Step(..) | Open::Text(..) | Open::Opinion | Open::Reply(..) | Open::Marks(..) => {
                "on"
            }
        };
        label.to_owned()
    }

    fn skip_label(&self, screen: &Screen) -> &'static str {
        match self.open() {
            Open::Opinion => "do not wait",
            Open::Reply(..) => "no more questions",
            Open::Marks(..) => "leave it open",
            Open::Nothing if !self.may_skip() => "",
            Open::Nothing | Open::Line | Open::Step(..) | Open::Text(..) => match screen {
                Screen::Why | Screen::Step(_) => "skip the walkthrough",
                Screen::Worked => "skip the worked example",
                Screen::Faded(_) => "skip this round",
                Screen::Practice(_) | Screen::Retest(_) => "skip this exercise",
                Screen::Explain { .. } if matches!(self.open(), Open::Nothing) => {
                    "skip the second try"
                }
                Screen::Explain { .. } => "skip this question",
                Screen::Reteach { .. } => "skip this angle",
                Screen::Result => "",
            },
        }
    }
}
