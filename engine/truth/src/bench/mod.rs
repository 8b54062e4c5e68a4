//! Run time against error, for every term and every way to compute it.
//!
//! Times are of one thread on data in the nearest caches, where a row does not say otherwise:
//! the best of many short runs, since everything that disturbs a run makes it longer. The runs of
//! the batches are spread over the whole time of measuring: on a shared machine, what is not
//! limited by the division unit alone loses a third of its speed for seconds at a time, as it
//! would beside a neighbour on the core's other thread. Errors are in units of the last place
//! against the textbook forms in high precision, at random points of the sensible ranges; the
//! search for the worst points is [`crate::stress`].

mod albedo;
mod approximations;
mod batches;
mod cores;
mod energy;
mod terms;

use std::hint::black_box;
use std::time::{Duration, Instant};

/// One way to compute something: how long it takes and how wrong it is.
#[derive(Debug, Clone)]
pub struct Row {
    /// What is computed: a term, `specular`, `albedo`, ...
    pub group: String,
    /// How: `f32`, `batch`, `hoisted`, ...
    pub variant: String,
    /// `f32` or `f64`.
    pub precision: &'static str,
    /// `baseline`, `avx2` or `avx512`.
    pub isa: &'static str,
    /// Nanoseconds for one evaluation.
    pub ns: f64,
    /// Share of what the unit that divides and takes roots allows, where it is known what an
    /// evaluation needs.
    pub limit_ratio: Option<f64>,
    /// The same for the units that multiply: where it is more, these are the limit.
    pub products_ratio: Option<f64>,
    /// What an evaluation needs of the first: `1÷2√` for a division and two square roots.
    pub needs: Option<String>,
    /// Largest error.
    pub max_ulp: f64,
    /// Error that one point in a thousand exceeds.
    pub p999_ulp: f64,
    /// Error that half of the points exceed.
    pub median_ulp: f64,
    /// `ulp`, `ulp of f64`, `relative` for approximations, or `none` where nothing is known
    /// to measure against; the errors are 0 then.
    pub error_unit: &'static str,
    /// Whether no other row of the group is both faster and more accurate.
    pub pareto: bool,
}

impl Row {
    /// A row of single precision in the baseline, with nothing known but its time.
    pub fn new(group: impl Into<String>, variant: impl Into<String>, ns: f64) -> Row {
        Row {
            group: group.into(),
            variant: variant.into(),
            precision: "f32",
            isa: "baseline",
            ns,
            limit_ratio: None,
            products_ratio: None,
            needs: None,
            max_ulp: 0.0,
            p999_ulp: 0.0,
            median_ulp: 0.0,
            error_unit: "none",
            pareto: false,
        }
    }

    /// The row with its errors; NaN counts as infinitely wrong.
    pub fn with_errors(mut self, error_unit: &'static str, errors: Vec<f64>) -> Row {
        let errors = Errors::of(errors);
        self.error_unit = error_unit;
        (self.max_ulp, self.p999_ulp, self.median_ulp) = (errors.max, errors.p999, errors.median);
        self
    }

    /// The row, in another precision.
    pub fn in_precision(mut self, precision: &'static str) -> Row {
        self.precision = precision;
        self
    }

    /// The row, with another set of instructions.
    pub fn on(mut self, isa: &'static str) -> Row {
        self.isa = isa;
        self
    }

    /// Million evaluations a second.
    pub fn meval_s(&self) -> f64 {
        1e3 / self.ns
    }
}

/// How long to measure.
#[derive(Debug, Clone, Copy)]
pub struct Effort {
    /// For the time of each row.
    pub time: Duration,
    /// Points at which the error of double precision is taken, and that of approximations.
    pub points: usize,
}

impl Effort {
    /// Everything in some ten seconds.
    pub const QUICK: Effort = Effort {
        time: Duration::from_millis(10),
        points: 200,
    };
    /// Everything in a few minutes.
    pub const FULL: Effort = Effort {
        time: Duration::from_millis(200),
        points: 5_000,
    };
}

/// What divisions, square roots and products cost on this machine.
#[derive(Debug, Clone, Copy)]
pub struct Limit {
    /// The instruction set.
    pub isa: &'static str,
    /// Nanoseconds a lane for a division.
    pub division_ns: f64,
    /// Nanoseconds a lane for a square root.
    pub square_root_ns: f64,
    /// Nanoseconds a lane for a product.
    pub product_ns: f64,
    /// For how many products a division occupies the units that multiply.
    pub division_products: f64,
    /// For how many products a square root does.
    pub root_products: f64,
}

/// What one evaluation needs in the form with the least of it that is known here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Needs {
    pub divisions: f64,
    pub roots: f64,
    /// Products, each with a sum where the form has one for it.
    pub products: f64,
}

impl Needs {
    /// The least time in the unit that divisions and square roots share: even where all the rest
    /// is done beside them.
    fn slow(self, limit: &Limit) -> f64 {
        self.divisions * limit.division_ns + self.roots * limit.square_root_ns
    }

    /// The least time in the units that multiply, which divisions and roots need, too.
    fn fast(self, limit: &Limit) -> f64 {
        let beside = self.divisions * limit.division_products + self.roots * limit.root_products;
        (self.products + beside) * limit.product_ns
    }

    /// A row with its shares of a limit, `at_once` evaluations being under way.
    pub fn share(self, limit: &Limit, at_once: usize, mut row: Row) -> Row {
        let part = |count: f64, sign| match count {
            0.0 => String::new(),
            _ => format!("{count}{sign}"),
        };
        let of = |least: f64| Some(least / at_once as f64 / row.ns);
        (row.limit_ratio, row.products_ratio) = (of(self.slow(limit)), of(self.fast(limit)));
        row.needs = Some(part(self.divisions, '÷') + &part(self.roots, '√'));
        row
    }
}

/// The limits of every instruction set that this machine has, measured.
pub fn limits(effort: Effort) -> Vec<Limit> {
    batches::limits(effort)
}

/// All rows, group by group; `done` is told of each group when it is finished.
pub fn run(effort: Effort, limits: &[Limit], mut done: impl FnMut(&[Row])) -> Vec<Row> {
    let mut all: Vec<Row> = Vec::new();
    let mut add = |mut rows: Vec<Row>| {
        mark_pareto(&mut rows);
        done(&rows);
        all.append(&mut rows);
    };
    let mut batches = batches::Batches::new(effort);
    for term in brdf::terms() {
        add(terms::rows(term, effort));
        batches.round();
    }
    for group in batches.finish(limits) {
        add(group);
    }
    add(cores::rows(effort, limits));
    for group in approximations::groups(effort) {
        add(group);
    }
    for group in albedo::groups(effort) {
        add(group);
    }
    for group in energy::groups(effort) {
        add(group);
    }
    all
}

/// Marks the rows that no other row beats in time and in error. Different units of error
/// are not compared.
pub fn mark_pareto(rows: &mut [Row]) {
    let beaten = |row: &Row, by: &Row| {
        row.error_unit == by.error_unit
            && by.ns <= row.ns
            && by.max_ulp <= row.max_ulp
            && (by.ns < row.ns || by.max_ulp < row.max_ulp)
    };
    for i in 0..rows.len() {
        rows[i].pareto = !rows.iter().any(|by| beaten(&rows[i], by));
    }
}

/// Nanoseconds for one of the `count` evaluations that a call of `f` makes: the best of runs
/// of some fifty microseconds each.
pub(crate) fn time(effort: Effort, count: usize, f: impl FnMut()) -> f64 {
    let mut stopwatch = Stopwatch::new(count, f);
    stopwatch.round(effort.time, 5);
    stopwatch.ns()
}

/// Takes the time of something, now and then.
pub(crate) struct Stopwatch<F> {
    f: F,
    /// Evaluations of a call, and calls of a run.
    count: usize,
    calls: usize,
    /// Seconds of a call.
    best: f64,
}

impl<F: FnMut()> Stopwatch<F> {
    pub fn new(count: usize, mut f: F) -> Self {
        let mut seconds = || {
            let start = Instant::now();
            f();
            start.elapsed().as_secs_f64().max(1e-9)
        };
        let mut once = seconds();
        // One that was interrupted would leave runs so short that the clock counts. What is
        // slow is not repeated for that.
        for _ in 0..4 {
            if once < 5e-2 {
                once = once.min(seconds());
            }
        }
        Stopwatch {
            f,
            count,
            calls: ((5e-5 / once) as usize).clamp(1, 10_000),
            best: f64::INFINITY,
        }
    }

    /// Runs for so long, and at least so often.
    pub fn round(&mut self, time: Duration, least: usize) {
        let (begin, mut runs) = (Instant::now(), 0);
        while runs < least || begin.elapsed() < time {
            let start = Instant::now();
            for _ in 0..self.calls {
                (self.f)();
            }
            self.best = self
                .best
                .min(start.elapsed().as_secs_f64() / self.calls as f64);
            runs += 1;
        }
    }

    /// Nanoseconds of an evaluation, in the best run so far.
    pub fn ns(&self) -> f64 {
        self.best / self.count as f64 * 1e9
    }
}

/// Keeps the compiler from computing a value in advance, or not at all.
pub(crate) fn opaque<T>(value: T) -> T {
    black_box(value)
}

/// Errors, summarised.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Errors {
    pub max: f64,
    pub p999: f64,
    pub median: f64,
}

impl Errors {
    /// NaN counts as infinitely wrong.
    pub fn of(mut errors: Vec<f64>) -> Errors {
        for error in &mut errors {
            if error.is_nan() {
                *error = f64::INFINITY;
            }
        }
        errors.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let index = (share * errors.len().saturating_sub(1) as f64) as usize;
            errors
                .get(index.min(errors.len().saturating_sub(1)))
                .copied()
                .unwrap_or(0.0)
        };
        Errors {
            max: at(1.0),
            p999: at(0.999),
            median: at(0.5),
        }
    }
}

/// Numbers that follow from a seed (SplitMix64).
pub(crate) struct Numbers(pub u64);

impl Numbers {
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, (low, high): (f64, f64)) -> f64 {
        low + (high - low) * self.unit()
    }
}
