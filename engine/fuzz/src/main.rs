//! Fuzzing without a special compiler: what is known to be valid is cut, spliced, repeated and
//! spoiled at random, from a seed, and fed to a target. A panic writes the input to a file.
//!
//! ```text
//! cargo run --release --manifest-path engine/fuzz/Cargo.toml -- [TARGET…] [--seconds N] [--seed N]
//! cargo run --release --manifest-path engine/fuzz/Cargo.toml -- grow
//! ```
//!
//! `grow` judges answers of twenty kinds from 16 KB to 1 MB and prints the time a byte.

use std::env;
use std::fs;
use std::panic;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use lobe_fuzz::{LESSONS, formula, judge, judges, lesson, record};

type Target = (&'static str, fn(&[u8]));

const TARGETS: [Target; 4] = [
    ("judge", judge),
    ("lesson", lesson),
    ("record", record),
    ("formula", formula),
];

/// What answers, lessons, logs and formulas are made of.
const SCRAPS: &[&str] = &[
    "the rim is bright",
    "the centre is dim",
    "but",
    "not ",
    "wait, no",
    "is it? ",
    "1/π",
    "α²",
    "N·H",
    "n dot v",
    "0/0",
    "∞",
    "\\frac{1}{4}",
    "$",
    "{",
    "}",
    "(((",
    ")",
    "²",
    "->",
    "≤",
    "…",
    "—",
    "\u{202e}",
    "\u{200f}",
    "\u{200d}",
    "e\u{301}",
    "🦀",
    "\0",
    "\r\n",
    "\n- ",
    "\n\n",
    "\t",
    "[[explain]]\n",
    "id = \"x\"\n",
    "\"\"\"",
    "'''",
    "= 1e999",
    "-9223372036854775808",
    "0x",
    "{{",
    "}}",
    "{{ 1/0 : .2 }}",
    "d_ggx(n_dot_h = 0.95, roughness = 0.4)",
    "^",
    "--1",
    "1.2.3",
    ",",
    "[[event]]\n",
    "kind = \"draft\"\n",
    "at = \"\"\n",
    "NaN",
    "inf",
    "1e-320",
    "a.b",
];

/// xorshift64*: enough to shuffle with.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}

fn main() -> ExitCode {
    let mut arguments = env::args().skip(1);
    let (mut names, mut seconds, mut seed) = (Vec::new(), 20, 1);
    while let Some(argument) = arguments.next() {
        let mut number = || arguments.next().and_then(|text| text.parse().ok());
        match argument.as_str() {
            "--seconds" => seconds = number().unwrap_or(seconds),
            "--seed" => seed = number().unwrap_or(seed),
            "grow" => {
                grow();
                return ExitCode::SUCCESS;
            }
            _ => names.push(argument),
        }
    }
    let chosen: Vec<Target> = TARGETS
        .into_iter()
        .filter(|(name, _)| names.is_empty() || names.iter().any(|wanted| wanted == name))
        .collect();
    if chosen.is_empty() {
        eprintln!("fuzz: no such target; there are judge, lesson, record, formula, and grow");
        return ExitCode::from(2);
    }
    let mut found = false;
    for (name, target) in chosen {
        found |= run(name, target, Duration::from_secs(seconds), seed);
    }
    ExitCode::from(u8::from(found))
}

/// Whether the target broke.
fn run(name: &str, target: fn(&[u8]), time: Duration, seed: u64) -> bool {
    let mut corpus = seeds(name);
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let (begun, mut runs, mut bytes) = (Instant::now(), 0_u64, 0_u64);
    let mut slowest = (Duration::ZERO, 0);
    while begun.elapsed() < time {
        let input = mutated(&corpus, &mut random);
        let start = Instant::now();
        let outcome = panic::catch_unwind(|| target(&input));
        let took = start.elapsed();
        runs += 1;
        bytes += input.len() as u64;
        if took > slowest.0 {
            slowest = (took, input.len());
        }
        if outcome.is_err() {
            let file = format!("fuzz-{name}-{seed}-{runs}.input");
            let kept = fs::write(&file, &input);
            println!("{name}: broke on run {runs}; input in {file} ({kept:?})");
            return true;
        }
        // What is new now and then becomes the ground for more.
        if corpus.len() < 400 && random.below(50) == 0 && input.len() < 20_000 {
            corpus.push(input);
        }
    }
    println!(
        "{name}: {runs} inputs, {bytes} bytes, nothing broke; slowest {:.1} ms for {} bytes",
        slowest.0.as_secs_f64() * 1e3,
        slowest.1
    );
    false
}

fn seeds(name: &str) -> Vec<Vec<u8>> {
    let answers = include_str!("../../tutor/tests/answers/written.jsonl")
        .lines()
        .filter_map(|line| line.split("\"text\": \"").nth(1))
        .filter_map(|rest| rest.split("\", \"").next());
    match name {
        "judge" => answers
            .enumerate()
            .map(|(place, text)| {
                let mut bytes = vec![place as u8];
                bytes.extend(text.bytes());
                bytes
            })
            .collect(),
        "lesson" => LESSONS
            .iter()
            .map(|text| text.as_bytes().to_vec())
            .collect(),
        "record" => vec![RECORD.as_bytes().to_vec()],
        _ => SCRAPS.iter().map(|text| text.as_bytes().to_vec()).collect(),
    }
}

const RECORD: &str = "format = 1\nprogram = \"0\"\nlesson = \"smith-g2\"\nhash = \"x\"\nseed = 7\nstarted = \"2026-01-02T03:04:05Z\"\n\n[[event]]\nat = \"2026-01-02T03:04:06Z\"\ntook_ms = 5\nkind = \"draft\"\nitem = \"smith-g2/explain-1\"\ntext = \"the rim\"\n\n[[event]]\nat = \"2026-01-02T03:04:07Z\"\ntook_ms = 9\nkind = \"skip\"\nscreen = \"x\"\n";

fn mutated(corpus: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut input = corpus[random.below(corpus.len())].clone();
    for _ in 0..1 + random.below(6) {
        let at = random.below(input.len() + 1);
        let end = (at + random.below(40)).min(input.len());
        match random.below(8) {
            0 => {
                input.drain(at..end);
            }
            1 => {
                let scrap = SCRAPS[random.below(SCRAPS.len())];
                input.splice(at..at, scrap.bytes());
            }
            2 => {
                let other = &corpus[random.below(corpus.len())];
                let from = random.below(other.len() + 1);
                let to = (from + random.below(200)).min(other.len());
                let piece = other[from..to].to_vec();
                input.splice(at..at, piece);
            }
            3 => {
                let piece = input[at..end].to_vec();
                let times = 1 + random.below(200);
                input.splice(at..at, piece.repeat(times));
            }
            4 if at < input.len() => input[at] = random.next() as u8,
            5 if at < input.len() => input[at] ^= 1 << random.below(8),
            6 => input.truncate(at),
            _ => input.extend(SCRAPS[random.below(SCRAPS.len())].bytes()),
        }
        input.truncate(200_000);
    }
    input
}

/// The time a byte for answers that grow: where it grows too, the judge is not linear.
fn grow() {
    const PIECES: &[(&str, &str)] = &[
        ("clauses", "the rim is bright, but the centre is dim; "),
        ("sentences", "The rim is bright. The centre is dim. "),
        (
            "no sentence end",
            "the rim is bright and the centre is dim and ",
        ),
        ("denials", "not "),
        ("double denials", "it is not that the rim is not bright, "),
        ("corrections", "wait no the rim bright the centre dark "),
        ("comparisons", "as bright as "),
        ("chains of than", "brighter than the rim than "),
        ("references", "it is brighter, the other is not, the first "),
        ("open brackets", "("),
        ("fractions", "\\frac{"),
        ("sums", "1+"),
        ("equations", "D = 1/pi = 0.318 = "),
        ("digits", "1"),
        ("one word", "a"),
        ("unknown words", "qwertzu "),
        ("typos", "brihgt silhuoette "),
        ("right to left", "\u{202e}\u{200f}אבג "),
        ("combining", "e\u{301}\u{301}"),
        ("lines", "- rim bright\n"),
    ];
    let judge = &judges()[judges().len() / 2];
    println!(
        "{:<18} {:>10} {:>10} {:>10} {:>8}",
        "ns a byte", "16 KB", "128 KB", "1 MB", "growth"
    );
    for (name, piece) in PIECES {
        let each = [1 << 14, 1 << 17, 1 << 20].map(|size: usize| {
            let text = piece.repeat(size / piece.len());
            let runs = if size < 1 << 16 { 5 } else { 2 };
            let best = (0..runs)
                .map(|_| {
                    let start = Instant::now();
                    std::hint::black_box(judge.judge(std::hint::black_box(&text)));
                    start.elapsed()
                })
                .min()
                .unwrap_or_default();
            best.as_secs_f64() * 1e9 / text.len() as f64
        });
        println!(
            "{name:<18} {:>10.0} {:>10.0} {:>10.0} {:>8.2}",
            each[0],
            each[1],
            each[2],
            each[2] / each[0]
        );
    }
}
