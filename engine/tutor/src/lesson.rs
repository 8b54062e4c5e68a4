//! A lesson as data: what its file says, parsed, with the place of every piece.

mod exercise;
mod fingerprint;
mod look;
mod shader;

use std::fmt;
use std::ops::Deref;
use std::sync::OnceLock;

use formula::{Expr, Library, Values};

use crate::finding::Place;
use crate::judge::Judge;
use crate::rubric::Rubric;

pub use exercise::{
    ChoiceOption, Exercise, ExerciseStep, NamedMistake, SuspectLine, Task, Tolerance, Variable,
};
pub use fingerprint::{
    Fingerprint, MEAN_SIZES, Means, Measure, Printed, SEEN, STAGING, SceneLight, Total,
};
pub use look::{LookTask, Shows};
pub use shader::ShaderTask;

/// A string of the lesson file and where it stands.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Text {
    /// The string, escapes resolved.
    pub text: String,
    /// The whole TOML literal in the file, quotes included.
    pub place: Place,
}

impl Deref for Text {
    type Target = str;
    fn deref(&self) -> &str {
        &self.text
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// An expression of the lesson file.
#[derive(Clone, Debug)]
pub struct Formula {
    /// The expression as written.
    pub text: Text,
    /// The same, parsed; its spans count from the start of `text.text`.
    pub expr: Expr,
}

/// A number given by name, such as `roughness = 0.4`.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    /// The name.
    pub name: Text,
    /// Its value.
    pub value: f64,
    /// Where the number stands.
    pub place: Place,
}

/// The givens as the formula language wants them.
pub fn values(givens: &[Given]) -> Values {
    givens
        .iter()
        .map(|given| (given.name.text.clone(), given.value))
        .collect()
}

/// One lesson.
#[derive(Clone, Debug)]
pub struct Lesson {
    /// The file as its reader named it.
    pub file: String,
    /// Stable hash of the file's text, 16 hexadecimal digits; logs keep it.
    pub hash: String,
    /// The file's text, which every [`Place`] counts in.
    pub source: String,
    /// The lesson's name, kebab-case.
    pub id: Text,
    /// One line for headings.
    pub title: Text,
    /// Lessons that come before it.
    pub needs: Vec<Text>,
    /// One line for the lesson list.
    pub summary: Text,
    /// How long it takes.
    pub minutes: u32,
    /// Why it matters (prose).
    pub why: Text,
    /// The mental model in one sentence (prose).
    pub model: Text,
    /// Lead-ins for slips noted in earlier lessons.
    pub takes_up: Vec<TakesUp>,
    /// The lesson's own formulas, in the file's order.
    pub formulas: Vec<FormulaEntry>,
    /// The core's terms and the lesson's formulas.
    pub library: Library,
    /// The walkthrough.
    pub steps: Vec<Step>,
    /// The worked example.
    pub worked: Option<Worked>,
    /// Numbers of sources, kept as what they are.
    pub sources: Vec<SourceSays>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Plots.
    pub plots: Vec<Plot>,
    /// Maps: a value over two quantities.
    pub maps: Vec<Map>,
    /// Sentences that are numbers, checked and not shown.
    pub claims: Vec<Claim>,
    /// The exercises, in order.
    pub exercises: Vec<Exercise>,
    /// What bugs look like.
    pub fingerprints: Vec<Fingerprint>,
    /// Other angles on what can be missed.
    pub reteach: Vec<Reteach>,
    /// Explain-back and re-test questions, in order.
    pub explain: Vec<Explain>,
    /// Who measures the means of pictures, where somebody can; else their curves are empty.
    pub measure: Option<Measure>,
}

impl Lesson {
    /// The exercise of that id, the faded worked example included.
    pub fn exercise(&self, id: &str) -> Option<&Exercise> {
        let faded = self.worked.as_ref().and_then(|w| w.faded.as_ref());
        self.exercises
            .iter()
            .chain(faded.map(|faded| &faded.exercise))
            .find(|exercise| exercise.id.text == id)
    }

    /// The re-teach of that id.
    pub fn reteach(&self, id: &str) -> Option<&Reteach> {
        self.reteach.iter().find(|entry| entry.id.text == id)
    }

    /// The explain-back or re-test question of that id.
    pub fn explain(&self, id: &str) -> Option<&Explain> {
        self.explain.iter().find(|entry| entry.rubric.item == id)
    }

    /// The source's number of that id.
    pub fn source_says(&self, id: &str) -> Option<&SourceSays> {
        self.sources
            .iter()
            .find(|entry| entry.id.as_ref().is_some_and(|it| it.text == id))
    }
}

/// `[[takes_up]]`: the lead-in when a slip was noted in an earlier lesson.
#[derive(Clone, Debug)]
pub struct TakesUp {
    /// Id of the misconception, as in the earlier lesson's rubric.
    pub slip: Text,
    /// The lead-in (prose).
    pub says: Text,
}

/// `[formula.NAME]`.
#[derive(Clone, Debug)]
pub struct FormulaEntry {
    /// The name.
    pub name: Text,
    /// Its parameters.
    pub of: Vec<Text>,
    /// Its body.
    pub is: Formula,
    /// What it is, in a few words.
    pub says: Option<Text>,
    /// The core function that it must equal.
    pub core: Option<Text>,
}

/// `[[step]]`: one screen of the walkthrough.
#[derive(Clone, Debug)]
pub struct Step {
    /// Heading.
    pub title: Text,
    /// Prose.
    pub text: Text,
    /// What is shown below it.
    pub figures: Figures,
}

/// Ids of what is shown below a text.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    /// Tables.
    pub table: Vec<Text>,
    /// Plots.
    pub plot: Vec<Text>,
    /// Maps.
    pub map: Vec<Text>,
    /// Fingerprint pictures.
    pub picture: Vec<Text>,
}

/// `[worked]`: the worked example.
#[derive(Clone, Debug)]
pub struct Worked {
    /// Heading.
    pub title: Text,
    /// Prose before the first line.
    pub intro: Text,
    /// The numbers it starts from.
    pub given: Vec<Given>,
    /// Its lines; each may use the names of the lines before.
    pub lines: Vec<WorkedLine>,
    /// Prose after the last line.
    pub after: Option<Text>,
    /// The same example with other numbers, filled in by the learner.
    pub faded: Option<Faded>,
}

/// One line of the worked example.
#[derive(Clone, Debug)]
pub struct WorkedLine {
    /// The name that later lines use.
    pub name: Text,
    /// How it is called when asked for; the name in the field's spelling where left out.
    pub ask: Option<Text>,
    /// What it is.
    pub is: Formula,
    /// The number as printed, checked.
    pub shown: Option<Text>,
    /// A remark (prose).
    pub says: Option<Text>,
}

/// `[worked.faded]`.
#[derive(Clone, Debug)]
pub struct Faded {
    /// How many of the last lines the learner fills in, round by round.
    pub rounds: Vec<usize>,
    /// The example as an exercise with fresh numbers; its id is `<lesson>/worked`.
    pub exercise: Exercise,
}

/// `[[source_says]]`: a number as a source prints it, and what it is.
#[derive(Clone, Debug)]
pub struct SourceSays {
    /// Name, for `{{ source ID }}`.
    pub id: Option<Text>,
    /// Where in the source.
    pub where_: Text,
    /// The number as printed there.
    pub shown: Text,
    /// How the source came by it.
    pub is: Formula,
    /// The numbers that it and the truth are computed from; the worked example's where empty.
    pub with: Vec<Given>,
    /// What the number should be; where left out, the source is right.
    pub truth: Option<Formula>,
    /// What went wrong (prose).
    pub says: Text,
}

/// `[[table]]`.
#[derive(Clone, Debug)]
pub struct Table {
    /// Name, for references.
    pub id: Text,
    /// Heading.
    pub title: Text,
    /// Numbers that all rows share.
    pub with: Vec<Given>,
    /// Columns of inputs, shown first: name and one number a row.
    pub rows: Vec<(Text, Vec<f64>)>,
    /// The inputs' digits as the author typed them, parallel to `rows`.
    pub row_texts: Vec<Vec<String>>,
    /// An optional first column of words.
    pub row_labels: Vec<Text>,
    /// Computed columns.
    pub columns: Vec<Column>,
    /// An optional last row of words.
    pub limit: Option<Limit>,
    /// Prose below.
    pub note: Option<Text>,
}

/// A computed column of a table.
#[derive(Clone, Debug)]
pub struct Column {
    /// Heading.
    pub title: Text,
    /// What stands in it.
    pub is: Formula,
    /// How its numbers are printed.
    pub digits: formula::Digits,
    /// The numbers as printed, checked; may be empty.
    pub shown: Vec<Text>,
}

/// The last row of a table: where the columns tend to, in words.
#[derive(Clone, Debug)]
pub struct Limit {
    /// First cell.
    pub label: Text,
    /// One cell a computed column; the input columns' cells may stand before them.
    pub cells: Vec<Text>,
    /// A point near the limit where the words are checked; may be empty.
    pub at: Vec<Given>,
}

/// `[[plot]]`.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Name, for references.
    pub id: Text,
    /// Heading.
    pub title: Text,
    /// Horizontal axis.
    pub x: AxisX,
    /// Vertical axis.
    pub y: AxisY,
    /// Numbers that all series share.
    pub with: Vec<Given>,
    /// The curves.
    pub series: Vec<Series>,
    /// Points with a name.
    pub marks: Vec<Mark>,
}

/// `[[map]]`: a value over two quantities, drawn as colours.
#[derive(Clone, Debug)]
pub struct Map {
    /// Name, for references; it also names the file.
    pub id: Text,
    /// Heading.
    pub title: Text,
    /// Horizontal axis.
    pub x: AxisX,
    /// Vertical axis.
    pub y: AxisX,
    /// What the colours are, beside their bar.
    pub value_label: Text,
    /// What the colours mean.
    pub scale: crate::map::Scale,
    /// What is to be seen (prose).
    pub says: Option<Text>,
    /// Numbers that are the same all over the map.
    pub with: Vec<Given>,
    /// What is drawn.
    pub is: Formula,
}

/// The horizontal axis of a plot: a variable that runs.
#[derive(Clone, Debug)]
pub struct AxisX {
    /// The variable.
    pub name: Text,
    /// Left end.
    pub from: f64,
    /// Right end.
    pub to: f64,
    /// What stands below it.
    pub label: Text,
    /// Logarithmic.
    pub log: bool,
}

/// The vertical axis of a plot.
#[derive(Clone, Debug)]
pub struct AxisY {
    /// What stands beside it.
    pub label: Text,
    /// Logarithmic.
    pub log: bool,
    /// Lower end; from the curves where left out.
    pub from: Option<f64>,
    /// Upper end; from the curves where left out.
    pub to: Option<f64>,
}

/// A curve.
#[derive(Clone, Debug)]
pub struct Series {
    /// Its name in the legend.
    pub label: Text,
    /// What is drawn.
    pub is: Curve,
    /// Numbers of this curve alone, such as its roughness.
    pub with: Vec<Given>,
}

/// What a curve is drawn from.
#[derive(Clone, Debug)]
pub enum Curve {
    /// A formula of the horizontal axis's variable.
    Formula(Formula),
    /// The means of a fingerprint's panel, over the picture's size.
    Means {
        /// The fingerprint.
        picture: Text,
        /// Of its wrong panel, or of the right one.
        wrong: bool,
    },
}

/// A point with a name.
#[derive(Clone, Debug)]
pub struct Mark {
    /// Its name.
    pub label: Text,
    /// Where on the horizontal axis.
    pub x: Formula,
    /// Its height, at x.
    pub is: Formula,
    /// Numbers of this mark alone.
    pub with: Vec<Given>,
}

/// `[[claim]]`: a sentence of the lesson that is a number; checked, never shown.
#[derive(Clone, Debug)]
pub struct Claim {
    /// The sentence.
    pub says: Text,
    /// Numbers it is computed from.
    pub with: Vec<Given>,
    /// What is claimed.
    pub test: Test,
}

/// What a claim claims.
#[derive(Clone, Debug)]
pub enum Test {
    /// `is` equals `equals`, within `rel` of it.
    Equals {
        /// Left side.
        is: Formula,
        /// Right side.
        equals: Formula,
        /// Relative difference allowed.
        rel: f64,
    },
    /// A comparison is true.
    Holds(Formula),
}

/// `[[reteach]]`: another angle.
#[derive(Clone, Debug)]
pub struct Reteach {
    /// Name, for references.
    pub id: Text,
    /// How results call it: "the histogram re-teach".
    pub name: Text,
    /// Heading.
    pub title: Text,
    /// Prose.
    pub text: Text,
    /// What is shown below it.
    pub figures: Figures,
}

/// When a question is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExplainStage {
    /// After the exercises.
    Explain,
    /// In the re-test.
    Retest,
}

/// `[[explain]]`: a question answered in the learner's own words.
#[derive(Clone, Debug)]
pub struct Explain {
    /// The question's id (also in `rubric.item`) and its place.
    pub id: Text,
    /// When it is asked.
    pub stage: ExplainStage,
    /// Heading.
    pub title: Text,
    /// The question (prose; also in `rubric.prompt`).
    pub prompt: Text,
    /// The author's answer (prose).
    pub model_answer: Text,
    /// What good and wrong answers say.
    pub rubric: Rubric,
    /// The rubric made ready for judging, when it is first needed.
    pub judge: LazyJudge,
    /// Places of the expectations, in the rubric's order.
    pub expectation_places: Vec<EntryPlaces>,
    /// Places of the misconceptions, in the rubric's order.
    pub misconception_places: Vec<EntryPlaces>,
    /// Places of the examples, in the rubric's order.
    pub example_places: Vec<EntryPlaces>,
}

/// Where an entry of a rubric stands, and where the values of its keys do.
#[derive(Clone, Debug, Default)]
pub struct EntryPlaces {
    /// Where the entry is announced.
    pub whole: Place,
    /// The keys with the places of their values; of a string, of what is between the quotes.
    pub keys: Vec<(String, Place)>,
}

impl EntryPlaces {
    /// The place of a key's value, else of the entry.
    pub fn of(&self, key: &str) -> Place {
        let found = self.keys.iter().find(|(name, _)| name == key);
        found.map_or(self.whole, |(_, place)| *place)
    }
}

/// A judge that is made when it is first asked: most starts of the program judge nothing.
#[derive(Clone, Debug)]
pub struct LazyJudge {
    rubric: Rubric,
    made: OnceLock<Judge>,
}

impl LazyJudge {
    /// A judge for a rubric.
    pub fn new(rubric: &Rubric) -> LazyJudge {
        LazyJudge {
            rubric: rubric.clone(),
            made: OnceLock::new(),
        }
    }
}

impl Deref for LazyJudge {
    type Target = Judge;
    fn deref(&self) -> &Judge {
        self.made.get_or_init(|| Judge::new(&self.rubric))
    }
}
