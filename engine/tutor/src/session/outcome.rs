//! How a lesson stands and how it ended, in a teacher's words.

use super::Session;
use super::event::{Grade, NotedSlip};
use super::screen::Screen;
use super::show::{paragraph, text, verdict};
use super::show_question::{and, count};
use crate::prose::{Block, Inline, Tone};
use crate::view::Stage;

/// How an item stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Not reached, or not settled.
    Open,
    /// Left out.
    Skipped,
    /// Right at once.
    Right,
    /// Right after a question or two of the tutor's.
    Asked,
    /// Right in the end.
    Retried,
    /// Right after the answer had been shown.
    Shown,
    /// Right by the learner's own marking.
    SelfMarked,
    /// Not right.
    Missed,
}

impl Standing {
    const ALL: [Standing; 8] = [
        Standing::Right,
        Standing::Asked,
        Standing::Retried,
        Standing::SelfMarked,
        Standing::Shown,
        Standing::Missed,
        Standing::Skipped,
        Standing::Open,
    ];

    /// Right in a way that counts.
    pub fn counts(self) -> bool {
        match self {
            Standing::Right | Standing::Asked | Standing::Retried | Standing::SelfMarked => true,
            Standing::Open | Standing::Skipped | Standing::Shown | Standing::Missed => false,
        }
    }

    /// In a few words.
    pub fn words(self) -> &'static str {
        match self {
            Standing::Open => "open",
            Standing::Skipped => "left out",
            Standing::Right => "right at once",
            Standing::Asked => "right when asked",
            Standing::Retried => "right in the end",
            Standing::Shown => "with the answer shown",
            Standing::SelfMarked => "right, by your own marking",
            Standing::Missed => "not yet",
        }
    }
}

/// One exercise or question of the lesson.
#[derive(Clone, Debug, PartialEq)]
pub struct ItemOutcome {
    /// Its id.
    pub item: String,
    /// The stage it was asked in.
    pub stage: Stage,
    /// What people call it.
    pub title: String,
    /// How it stands.
    pub standing: Standing,
}

/// How a lesson stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The stage on the screen.
    pub stage: Stage,
    /// The result was reached.
    pub finished: bool,
    /// Passed or not, once finished.
    pub grade: Option<Grade>,
    /// "PASS on retry, after the histogram re-teach"; while it lasts, where it stands.
    pub words: String,
    /// Slips heard in this lesson.
    pub slips: Vec<NotedSlip>,
    /// Every exercise and question, in order.
    pub items: Vec<ItemOutcome>,
}

impl Session {
    /// How the lesson stands.
    pub fn outcome(&self) -> Outcome {
        let stage = self.here().stage(&self.lesson);
        let (grade, words) = match &self.finished {
            Some((grade, words)) => (Some(*grade), words.clone()),
            None => (None, format!("in {}", stage.phrase())),
        };
        Outcome {
            stage,
            finished: self.finished.is_some(),
            grade,
            words,
            slips: self.slips(),
            items: self.items(),
        }
    }

    fn slips(&self) -> Vec<NotedSlip> {
        let mut slips: Vec<NotedSlip> = Vec::new();
        let computed = self.problems.values().flat_map(|problem| problem.slips());
        let explained = self.path.iter().filter_map(|screen| match screen {
            Screen::Explain { item, .. } => self.questions.get(item),
            _ => None,
        });
        let explained = explained
            .flat_map(|question| &question.tries)
            .flat_map(|tried| &tried.result().slips);
        for id in explained.chain(computed) {
            if slips.iter().all(|slip| slip.id != *id) {
                slips.push(NotedSlip {
                    id: id.clone(),
                    lesson: self.lesson.id.text.clone(),
                });
            }
        }
        slips
    }

    fn items(&self) -> Vec<ItemOutcome> {
        let titled = |item: &str| {
            let title = self.lesson.exercise(item)?.title.as_ref()?;
            Some(format!("“{}”", title.text))
        };
        let mut numbers = (0, 0);
        let mut items = Vec::new();
        for screen in &self.path {
            let title = match screen {
                Screen::Practice(item) => {
                    numbers.0 += 1;
                    titled(item).unwrap_or_else(|| format!("exercise {}", numbers.0))
                }
                Screen::Retest(item) => {
                    numbers.1 += 1;
                    let titled = titled(item).map(|title| format!("{title} with fresh numbers"));
                    titled.unwrap_or_else(|| format!("re-test {}", numbers.1))
                }
                Screen::Explain { item, .. } => {
                    let explain = self.lesson.explain(item);
                    explain.map_or_else(String::new, |e| format!("“{}”", e.title.text))
                }
                // In the lesson itself it is a part of the example.
                Screen::Faded(_) if self.asks_due => "the worked example".to_owned(),
                Screen::Why
                | Screen::Step(_)
                | Screen::Worked
                | Screen::Faded(_)
                | Screen::Reteach { .. }
                | Screen::Result => continue,
            };
            let item = match screen {
                Screen::Explain { item, .. } => item.clone(),
                _ => self
                    .problem_key(screen)
                    .map_or_else(String::new, |key| key.0),
            };
            items.push(ItemOutcome {
                item,
                stage: screen.base_stage(&self.lesson),
                title,
                standing: self.standing(screen),
            });
        }
        items
    }

    fn standing(&self, screen: &Screen) -> Standing {
        let untouched = if self.skipped.contains(&screen.to_string()) {
            Standing::Skipped
        } else {
            Standing::Open
        };
        if let Screen::Explain { item, .. } = screen {
            let Some(question) = self.questions.get(item) else {
                return untouched;
            };
            let Some(last) = question.last() else {
                return untouched;
            };
            let shown = question.hints.iter().take(question.tries.len());
            let rubric = self.lesson.explain(item).map(|explain| &explain.rubric);
            return if rubric.is_none_or(|rubric| last.is_open(rubric)) {
                untouched
            } else if !last.result().passed() {
                Standing::Missed
            } else if shown.copied().any(|level| level == 3) {
                Standing::Shown
            } else if last.own.is_some() {
                Standing::SelfMarked
            } else if question.tries.len() > 1 {
                Standing::Retried
            } else if !last.turns.is_empty() {
                Standing::Asked
            } else {
                Standing::Right
            };
        }
        match self.problem(screen) {
            Some(problem) if problem.is_begun() => {
                if problem.is_solved() {
                    if problem.is_shown() {
                        Standing::Shown
                    } else if problem.is_clean() {
                        Standing::Right
                    } else {
                        Standing::Retried
                    }
                } else if problem.is_done() {
                    Standing::Missed
                } else {
                    untouched
                }
            }
            // No numbers to be had: nothing to hold against anybody.
            Some(problem) if problem.draw().is_err() => Standing::Right,
            Some(_) | None => untouched,
        }
    }

    /// The re-teaches that were read, by the names that results use.
    fn reteaches_read(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for screen in &self.trail {
            if let Screen::Reteach { name, .. } = screen
                && !self.skipped.contains(&screen.to_string())
                && let Some(reteach) = self.lesson.reteach(name)
                && !names.contains(&reteach.name.text.as_str())
            {
                names.push(reteach.name.text.as_str());
            }
        }
        names
    }

    /// The grade and what a teacher says of it: a pass needs every question, and the numbers of
    /// the re-test.
    pub(super) fn verdict(&self) -> (Grade, String) {
        let items = self.items();
        if self.asks_due {
            return due_verdict(&items);
        }
        let needed = |item: &&ItemOutcome| item.stage != Stage::Practice;
        let open: Vec<&str> = items
            .iter()
            .filter(needed)
            .filter(|item| !item.standing.counts())
            .map(|item| item.title.as_str())
            .collect();
        if !open.is_empty() {
            let words = format!("NOT YET: still open {} {}", are(open.len()), and(&open));
            return (Grade::NotYet, words);
        }
        let retried = items.iter().filter(needed).any(|item| {
            item.standing == Standing::Retried
                || self
                    .questions
                    .get(&item.item)
                    .is_some_and(|q| q.tries.len() > 1)
        });
        let own = items
            .iter()
            .filter(needed)
            .any(|item| item.standing == Standing::SelfMarked);
        let asked = items.iter().any(|item| item.standing == Standing::Asked);
        let read = self.reteaches_read();
        let mut words = match (retried, read.as_slice()) {
            (true, []) => "PASS on retry".to_owned(),
            (true, names @ ([_] | [_, _])) => format!("PASS on retry, after {}", and(names)),
            (true, names) => format!("PASS on retry, after {} re-teaches", count(names.len())),
            (false, _) if asked => "PASS after a question or two".to_owned(),
            (false, _) => "PASS at the first try".to_owned(),
        };
        if own {
            words.push_str(", in part by your own marking");
        }
        let grade = if own { Grade::SelfMarked } else { Grade::Pass };
        (grade, words)
    }

    pub(super) fn result_page(&self) -> Vec<Block> {
        let (grade, words) = self.finished.clone().unwrap_or_else(|| self.verdict());
        let says = match grade {
            Grade::Pass | Grade::SelfMarked if self.asks_due => {
                "Each comes back later, after a longer while than this time."
            }
            Grade::NotYet if self.asks_due => {
                "That is why they were asked. What was not right at once comes back tomorrow, the \
                 rest after a longer while than this time."
            }
            Grade::Pass => "You can explain it, and you can compute it.",
            Grade::SelfMarked => {
                "The judge left a part of it to you. An instructor may look at it again."
            }
            Grade::NotYet => {
                "That is no harm. Step back to anything left out, or take the lesson again; the \
                 numbers will be other ones."
            }
        };
        let tone = match grade {
            Grade::Pass | Grade::SelfMarked => Tone::Good,
            Grade::NotYet => Tone::Near,
        };
        let mut blocks = vec![verdict(tone, &words, vec![text(says)])];
        let items = self.item_lines();
        if !items.is_empty() {
            blocks.push(Block::Heading("What you did".to_owned()));
            blocks.push(Block::List {
                ordered: false,
                items,
            });
        }
        let slips = self.slip_lines();
        if !slips.is_empty() {
            blocks.push(Block::Heading("Noted for later".to_owned()));
            blocks.push(Block::List {
                ordered: false,
                items: slips,
            });
        }
        blocks.extend(self.model());
        if self.asks_due {
            return blocks;
        }
        blocks.push(paragraph(match grade {
            Grade::NotYet => "It is due again tomorrow.",
            Grade::Pass | Grade::SelfMarked => {
                "A few of these come back in some days, when they are nearly forgotten: that is \
                 when asking helps most."
            }
        }));
        blocks
    }

    /// Questions one by one, exercises by how many went how.
    fn item_lines(&self) -> Vec<Vec<Inline>> {
        let items = self.items();
        let mut lines = Vec::new();
        for (stage, name) in [
            (Stage::Worked, "Worked example"),
            (Stage::Practice, "Exercises"),
            (Stage::Retest, "Fresh numbers"),
        ] {
            let of_stage = |item: &&ItemOutcome| {
                item.stage == stage && self.lesson.explain(&item.item).is_none()
            };
            let standings: Vec<Standing> =
                items.iter().filter(of_stage).map(|i| i.standing).collect();
            let counts: Vec<String> = Standing::ALL
                .iter()
                .map(|standing| {
                    (
                        standing,
                        standings.iter().filter(|s| *s == standing).count(),
                    )
                })
                .filter(|(_, n)| *n > 0)
                .map(|(standing, n)| format!("{} {}", count(n), standing.words()))
                .collect();
            if !counts.is_empty() {
                lines.push(vec![text(format!("{name}: {}.", counts.join(", ")))]);
            }
        }
        let questions = items
            .iter()
            .filter(|item| self.lesson.explain(&item.item).is_some())
            .map(|item| vec![text(format!("{}: {}.", item.title, item.standing.words()))]);
        lines.extend(questions);
        lines
    }

    fn slip_lines(&self) -> Vec<Vec<Inline>> {
        let all = || {
            self.lesson
                .explain
                .iter()
                .flat_map(|e| &e.rubric.misconception)
        };
        let mut said: Vec<String> = Vec::new();
        let mut computed: Vec<String> = Vec::new();
        for slip in self.slips() {
            match all().find(|m| m.id == slip.id) {
                Some(m) => said.push(format!("You said something like: “{}”", m.says)),
                None => computed.push(slip.id.replace('-', " ")),
            }
        }
        if !computed.is_empty() {
            said.push(format!("Slips in the exercises: {}.", computed.join("; ")));
        }
        said.into_iter().map(|line| vec![text(line)]).collect()
    }
}

/// How many of the items that were due are right.
fn due_verdict(items: &[ItemOutcome]) -> (Grade, String) {
    let right = items.iter().filter(|item| item.standing.counts()).count();
    let own = items.iter().any(|it| it.standing == Standing::SelfMarked);
    let words = match (right, items.len()) {
        (_, 0) => "NOTHING is due here any more".to_owned(),
        (1, 1) => "RIGHT".to_owned(),
        (right, all) if right == all => format!("RIGHT: all {}", count(all)),
        (right, all) => format!("RIGHT: {} of {}", count(right), count(all)),
    };
    let grade = match (right == items.len(), own) {
        (true, false) => Grade::Pass,
        (true, true) => Grade::SelfMarked,
        (false, _) => Grade::NotYet,
    };
    (grade, words)
}

fn are(n: usize) -> &'static str {
    if n == 1 { "is" } else { "are" }
}
