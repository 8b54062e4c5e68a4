//! A session with its log: messages go in, effects are carried out, events are saved.

use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, TryRecvError};
use std::thread;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use tutor::Lesson;
use tutor::exercise::shader::Ran;
use tutor::record::Record;
use tutor::session::{Effect, Event, Msg, Session, Start, progress};
use tutor::view::View;

use crate::config::SecondJudge;
use crate::exit::Failure;
use crate::fingerprints;
use crate::second::{Asking, Said};
use crate::store::{Log, Logs, Store, Writer};

/// What is left for the screen to carry out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Request {
    /// A picture of the lesson is on the screen.
    Picture {
        lesson: String,
        id: String,
    },
    Leave,
}

/// What a learner asked for.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wish {
    /// Start afresh.
    pub new: bool,
    /// The seed of a new session.
    pub seed: Option<u64>,
}

/// One learner in one lesson, with the log.
pub struct Sitting {
    session: Session,
    writer: Writer,
    last_event: Instant,
    /// A shader that runs.
    running: Option<Receiver<Ran>>,
    /// Whether this goes on with an earlier session.
    pub resumed: bool,
    /// What the learner should know before the lesson starts.
    pub notices: Vec<Notice>,
    /// Who gives second opinions.
    judge: Option<SecondJudge>,
    /// Opinions that are on their way, oldest first.
    asked: Vec<Asked>,
}

/// A second opinion on its way.
struct Asked {
    item: String,
    attempt: u32,
    reply: u32,
    asking: Asking,
}

/// Something to say before the lesson starts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// One sentence, without a path.
    pub says: String,
    /// Where, for the error output.
    pub place: Option<String>,
}

impl Sitting {
    /// Opens a lesson: resumes the last session where it was left unfinished, else starts one.
    pub fn open(lesson: &Arc<Lesson>, store: &Store, wish: Wish) -> Result<Self, Failure> {
        let (logs, mut notices) = look_through(store);
        let unfinished = progress::unfinished(&lesson.id, &logs.records())
            .map(|at| &logs.readable[at])
            .filter(|log| !wish.new && wish.seed.is_none_or(|seed| seed == log.record.header.seed));
        if let Some(log) = unfinished {
            match store.resume(log) {
                Some(writer) => return Ok(Self::resume(lesson, log, writer, notices)),
                None => notices.push(Notice {
                    says: "This lesson is open in another window: a new session starts here."
                        .into(),
                    place: None,
                }),
            }
        }
        Ok(Self::begin(lesson, store, &logs, wish, notices))
    }

    /// Asks items of a lesson that are due, in a log of their own; goes on where that was left.
    pub fn ask_due(
        lesson: &Arc<Lesson>,
        store: &Store,
        items: Vec<String>,
    ) -> Result<Self, Failure> {
        let (logs, notices) = look_through(store);
        let unfinished = progress::unfinished_due(&lesson.id, &logs.records(), &items);
        if let Some(log) = unfinished.map(|at| &logs.readable[at])
            && let Some(writer) = store.resume(log)
        {
            return Ok(Self::resume(lesson, log, writer, notices));
        }
        let mut sitting = Self::begin(lesson, store, &logs, Wish::default(), notices);
        // It asks for nothing but to be saved.
        let _ = sitting.tell(Msg::AskDue(items));
        Ok(sitting)
    }

    fn resume(lesson: &Arc<Lesson>, log: &Log, writer: Writer, mut notices: Vec<Notice>) -> Self {
        let record = &log.record;
        let (session, changed) = Session::resume(
            Arc::clone(lesson),
            record.start(),
            &record.header.hash,
            &record.events(),
        );
        notices.extend(changed.map(|says| Notice { says, place: None }));
        Self {
            session,
            writer,
            last_event: Instant::now(),
            running: None,
            resumed: true,
            notices,
            judge: None,
            asked: Vec::new(),
        }
    }

    fn begin(
        lesson: &Arc<Lesson>,
        store: &Store,
        logs: &Logs,
        wish: Wish,
        notices: Vec<Notice>,
    ) -> Self {
        let start = Start {
            seed: wish.seed.unwrap_or_else(seed_from_clock),
            slips: progress::noted_slips(&lesson.id, &logs.records()),
        };
        let record = Record::new(
            env!("CARGO_PKG_VERSION"),
            &lesson.id,
            &lesson.hash,
            &now(),
            &start,
        );
        let writer = store.begin(record);
        let session = Session::new(Arc::clone(lesson), start);
        Self {
            session,
            writer,
            last_event: Instant::now(),
            running: None,
            resumed: false,
            notices,
            judge: None,
            asked: Vec::new(),
        }
    }

    /// The same, with second opinions on explanations where a judge for them is named.
    #[must_use]
    pub fn with_second_opinions(mut self, judge: Option<SecondJudge>) -> Self {
        if judge.is_some() {
            self.session = self.session.with_second_opinions();
        }
        self.judge = judge;
        self
    }

    /// Passes on the opinions that have come. True where there was one.
    fn collect_opinions(&mut self) -> bool {
        let mut came = Vec::new();
        for (at, asked) in self.asked.iter().enumerate().rev() {
            if let Some(said) = asked.asking.answer() {
                came.push((at, said));
            }
        }
        let came: Vec<(Asked, Said)> = came
            .into_iter()
            .map(|(at, said)| (self.asked.remove(at), said))
            .collect();
        let any = !came.is_empty();
        for (asked, said) in came.into_iter().rev() {
            self.pass_on_opinion(asked, said);
        }
        any
    }

    fn pass_on_opinion(&mut self, asked: Asked, said: Said) {
        let by = self.judge.as_ref().map(SecondJudge::name);
        // It asks for nothing but to be saved.
        let _ = self.tell(Msg::SecondOpinion {
            item: asked.item,
            attempt: asked.attempt,
            reply: asked.reply,
            by: by.unwrap_or_default(),
            said,
        });
    }

    /// Waits for every opinion that is on its way.
    pub fn settle_opinions(&mut self) {
        for asked in std::mem::take(&mut self.asked) {
            let said = asked.asking.wait();
            self.pass_on_opinion(asked, said);
        }
    }

    /// Whether an opinion is on its way.
    pub fn is_asking(&self) -> bool {
        !self.asked.is_empty()
    }

    /// Whether it asks nothing but what was due.
    pub fn asks_due(&self) -> bool {
        self.session.asks_due()
    }

    /// What is on the screen.
    pub fn view(&self) -> &View {
        self.session.screen()
    }

    /// The lesson taught.
    pub fn lesson(&self) -> &Arc<Lesson> {
        self.session.lesson()
    }

    /// Tells the session something, and has what follows saved.
    pub fn tell(&mut self, msg: Msg) -> Vec<Request> {
        let effects = self.session.update(msg);
        effects
            .into_iter()
            .filter_map(|effect| self.carry_out(effect))
            .collect()
    }

    fn carry_out(&mut self, effect: Effect) -> Option<Request> {
        match effect {
            Effect::Save(event) => {
                self.save(event);
                None
            }
            Effect::Draw { lesson, picture } => Some(Request::Picture {
                lesson,
                id: picture,
            }),
            Effect::Consult {
                item,
                attempt,
                reply,
                text,
                dialogue,
            } => {
                let explain = self.session.lesson().explain(&item);
                if let (Some(judge), Some(explain)) = (&self.judge, explain) {
                    let asking = Asking::start(judge, &explain.rubric, &text, &dialogue);
                    self.asked.push(Asked {
                        item,
                        attempt,
                        reply,
                        asking,
                    });
                }
                None
            }
            Effect::StopConsulting => {
                // The one waited for is the one asked last.
                self.asked.pop();
                None
            }
            Effect::Run(job) => {
                let (send, ran) = mpsc::channel();
                thread::spawn(move || send.send(crate::shaders::run(*job)));
                self.running = Some(ran);
                None
            }
            Effect::Look { picture, x, y } => {
                let sight = fingerprints::sight(self.session.lesson(), &picture, x, y);
                // What is seen asks for nothing but to be saved.
                let _ = self.tell(Msg::Looked(sight));
                None
            }
            Effect::Quit => Some(Request::Leave),
        }
    }

    fn save(&mut self, event: Event) {
        let took = self.last_event.elapsed();
        self.last_event = Instant::now();
        let took_ms = u64::try_from(took.as_millis()).unwrap_or(u64::MAX);
        self.writer.append(now(), took_ms, event);
    }

    /// Passes on what became of the log, and of a shader. True where the screen changed.
    pub fn collect(&mut self) -> bool {
        let opinions = self.collect_opinions();
        let ran = self.running.as_ref().map(Receiver::try_recv);
        let ran = match ran {
            None | Some(Err(TryRecvError::Empty)) => false,
            Some(Ok(ran)) => self.has_run(ran),
            Some(Err(TryRecvError::Disconnected)) => self.has_run(lost()),
        };
        match self.writer.news() {
            Some(news) => {
                self.pass_on(news);
                true
            }
            None => opinions || ran,
        }
    }

    fn has_run(&mut self, ran: Ran) -> bool {
        self.running = None;
        // What came of a shader asks for nothing but to be saved.
        let _ = self.tell(Msg::Ran(ran));
        true
    }

    /// Waits for the shader that runs, if one does; it has a limit of its own.
    pub fn finish_run(&mut self) {
        if let Some(running) = &self.running {
            let ran = running.recv().unwrap_or_else(|_| lost());
            self.has_run(ran);
        }
    }

    /// Whether a shader runs.
    pub fn is_running(&self) -> bool {
        self.running.is_some()
    }

    /// Waits until everything is saved, or known not to be.
    pub fn settle(&mut self) {
        const PATIENCE: Duration = Duration::from_secs(10);
        let until = Instant::now() + PATIENCE;
        while self.writer.is_busy() && Instant::now() < until {
            if let Some(news) = self.writer.wait_for_news(Duration::from_millis(200)) {
                self.pass_on(news);
            }
        }
        self.collect();
    }

    fn pass_on(&mut self, news: Result<(), String>) {
        let msg = news.map_or_else(Msg::SaveFailed, |()| Msg::Saved);
        // A message about the log asks for nothing but, at most, more of the log.
        let _ = self.tell(msg);
    }

    /// Whether news of the log will come soon.
    pub fn is_saving(&self) -> bool {
        self.writer.is_busy()
    }

    /// Saves what is left and ends.
    pub fn close(mut self) -> Result<(), String> {
        for asked in std::mem::take(&mut self.asked) {
            let said = Err("the learner left before it came".to_owned());
            self.pass_on_opinion(asked, said);
        }
        self.writer.close()
    }
}

/// Reads all logs, and says what the learner should know of them.
fn look_through(store: &Store) -> (Logs, Vec<Notice>) {
    let mut notices = Vec::new();
    // What cannot be read is said again, and better, when trying to write.
    let logs = store.logs().unwrap_or_default();
    if let Err(why) = store.try_out() {
        notices.push(Notice {
            says: format!(
                "Your answers cannot be saved: {why}. They are kept in memory, and saving is tried again after every answer."
            ),
            place: Some(format!(
                "answers cannot be saved in {}",
                store.folder.display()
            )),
        });
    }
    for unreadable in &logs.unreadable {
        let name = unreadable
            .path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        if unreadable.is_newer {
            notices.push(Notice {
                says: "A log was written by a newer version; it is left where it is, and \
                       not read here."
                    .into(),
                place: Some(format!("{name}: {}", unreadable.why)),
            });
            continue;
        }
        let moved = match store.set_aside(unreadable) {
            Ok(aside) => format!(
                "set aside as {}",
                aside.file_name().unwrap_or_default().to_string_lossy()
            ),
            Err(_) => "left as it is".to_owned(),
        };
        notices.push(Notice {
            says: "A log could not be read; it is kept, and nothing is written over it.".into(),
            place: Some(format!("{name}: {}; {moved}", unreadable.why)),
        });
    }
    (logs, notices)
}

/// The thread that waited for a shader broke down.
fn lost() -> Ran {
    Ran::Unable("what ran it broke down".to_owned())
}

/// The time, as logs keep it.
pub fn now() -> String {
    jiff::Timestamp::now()
        .round(jiff::Unit::Millisecond)
        .map_or_else(|_| String::new(), |time| time.to_string())
}

fn seed_from_clock() -> u64 {
    let since = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .unwrap_or_default();
    // Small enough to be read aloud: sessions of one learner need no more.
    since.as_nanos() as u64 % 1_000_000
}
