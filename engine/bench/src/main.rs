//! Measures the program `lobe` from outside, in a pseudo-terminal, and prints figures.
//!
//! `cargo run --release --manifest-path engine/bench/Cargo.toml [-- PATH/TO/lobe]`
//!
//! Nothing here asserts a time: machines differ and are shared. The figures are minimum,
//! median, 99th percentile and maximum; the budget each one has is printed beside it.

use std::io::{Read, Write};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use portable_pty::{CommandBuilder, PtySize, native_pty_system};

const QUIET: Duration = Duration::from_millis(40);

fn main() {
    let lobe = std::env::args()
        .nth(1)
        .map_or_else(default_binary, PathBuf::from);
    if !lobe.exists() {
        eprintln!(
            "{}: not there; build it first: cargo build --release",
            lobe.display()
        );
        std::process::exit(2);
    }
    println!(
        "program   {} ({:.1} MB, budget 20)",
        lobe.display(),
        megabytes(&lobe)
    );
    println!("machine   {}", machine());
    println!();
    println!(
        "{:<44} {:>8} {:>8} {:>8} {:>8}   budget",
        "milliseconds", "min", "median", "p99", "max"
    );

    for (columns, rows) in [(80, 24), (200, 60)] {
        let times = repeat(20, || first_frame(&lobe, columns, rows));
        row(
            &format!("start to first frame, {columns}x{rows}"),
            times,
            "50",
        );
    }
    row(
        "key press to frame, 200x60, reading",
        keys(&lobe, 200, 60, 150),
        "16 at p99",
    );
    for kind in ["halfblocks", "kitty", "iterm2", "sixel"] {
        row(
            &format!("key press to frame, picture, {kind}"),
            turns(&lobe, kind, 60),
            "33 at p99",
        );
    }
    row(
        "check, all lessons",
        repeat(15, || whole(&lobe, &["check"])),
        "200",
    );
    row(
        "eval, one expression",
        repeat(15, || {
            whole(&lobe, &["eval", "d_ggx(n_dot_h = 0.95, roughness = 0.4)"])
        }),
        "-",
    );
    row(
        "render, one fingerprint of 512², no cache",
        repeat(25, || render(&lobe, None, &["smith-g2/double-division"])),
        "120",
    );
    row(
        "render, all pictures, no cache",
        repeat(3, || render(&lobe, None, &[])),
        "5000",
    );
    let caches = tempfile::tempdir().expect("a temporary folder");
    row(
        "render, all pictures, cached",
        repeat(15, || render(&lobe, Some(caches.path()), &[])),
        "30",
    );
    println!();
    let (share, bytes) = idle(&lobe);
    println!(
        "idle for 5 s in a lesson: {share:.2} % of one core (budget 0.5), {bytes} bytes drawn"
    );
}

fn default_binary() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    target.join("release/lobe")
}

fn megabytes(path: &Path) -> f64 {
    std::fs::metadata(path).map_or(f64::NAN, |m| m.len() as f64 / 1e6)
}

fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info
        .lines()
        .find_map(|l| l.strip_prefix("model name"))
        .unwrap_or(" unknown");
    let cores = std::thread::available_parallelism().map_or(0, |n| n.get());
    format!(
        "{}, {cores} cores",
        model.trim_start_matches([' ', '\t', ':'])
    )
}

fn repeat(times: usize, mut measure: impl FnMut() -> f64) -> Vec<f64> {
    measure(); // the first run warms the disk
    (0..times).map(|_| measure()).collect()
}

fn row(name: &str, mut times: Vec<f64>, budget: &str) {
    times.sort_by(f64::total_cmp);
    let at = |q: f64| times[((times.len() - 1) as f64 * q).round() as usize];
    println!(
        "{name:<44} {:>8.2} {:>8.2} {:>8.2} {:>8.2}   {budget}",
        at(0.0),
        at(0.5),
        at(0.99),
        at(1.0)
    );
}

fn whole(lobe: &Path, arguments: &[&str]) -> f64 {
    run(Command::new(lobe).args(arguments))
}

/// Pictures drawn by the CPU into a folder of their own, with the cache in `caches`, or with an
/// empty one.
fn render(lobe: &Path, caches: Option<&Path>, names: &[&str]) -> f64 {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let caches = caches.unwrap_or(folder.path());
    let mut command = Command::new(lobe);
    command
        .env("XDG_CACHE_HOME", caches)
        .args(["render", "--backend", "cpu", "--size", "512", "--out"])
        .arg(folder.path())
        .args(names);
    run(&mut command)
}

fn run(command: &mut Command) -> f64 {
    let start = Instant::now();
    let output = command.output().expect("the program starts");
    let time = start.elapsed();
    assert!(
        output.status.success(),
        "{command:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    time.as_secs_f64() * 1e3
}

/// The program in a pseudo-terminal, with what it has drawn.
struct Screen {
    child: Box<dyn portable_pty::Child + Send + Sync>,
    keys: Box<dyn Write + Send>,
    drawn: Receiver<(Instant, Vec<u8>)>,
    terminal: vt100::Parser,
    _master: Box<dyn portable_pty::MasterPty + Send>,
    _folder: tempfile::TempDir,
}

impl Screen {
    fn start(lobe: &Path, columns: u16, rows: u16, arguments: &[&str]) -> Self {
        Self::start_with(lobe, columns, rows, arguments, "halfblocks")
    }

    /// On a terminal of cells of 8 by 16 pixels that shows pictures of some kind.
    fn start_with(
        lobe: &Path,
        columns: u16,
        rows: u16,
        arguments: &[&str],
        pictures: &str,
    ) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let size = PtySize {
            rows,
            cols: columns,
            pixel_width: 8 * columns,
            pixel_height: 16 * rows,
        };
        let pty = native_pty_system()
            .openpty(size)
            .expect("a pseudo-terminal");
        let mut command = CommandBuilder::new(lobe);
        command.args(arguments);
        command.env("TERM", "xterm-256color");
        command.env("LOBE_PROGRESS", folder.path());
        command.env("LOBE_PICTURES", pictures);
        command.cwd(env!("CARGO_MANIFEST_DIR"));
        let child = pty
            .slave
            .spawn_command(command)
            .expect("the program starts");
        drop(pty.slave);
        let mut reader = pty.master.try_clone_reader().expect("a reader");
        let keys = pty.master.take_writer().expect("a writer");
        let (send, drawn) = channel();
        std::thread::spawn(move || {
            let mut buffer = [0; 65536];
            while let Ok(n @ 1..) = reader.read(&mut buffer) {
                if send.send((Instant::now(), buffer[..n].to_vec())).is_err() {
                    break;
                }
            }
        });
        let terminal = vt100::Parser::new(at_least_one(rows), at_least_one(columns), 0);
        Screen {
            child,
            keys,
            drawn,
            terminal,
            _master: pty.master,
            _folder: folder,
        }
    }

    /// Reads until nothing was drawn for [`QUIET`]; when the last byte came, and how many.
    fn settle(&mut self, patience: Duration) -> Option<(Instant, usize)> {
        let mut last = None;
        let mut bytes = 0;
        let mut wait = patience;
        loop {
            match self.drawn.recv_timeout(wait) {
                Ok((when, drawn)) => {
                    bytes += drawn.len();
                    self.terminal.process(&drawn);
                    last = Some(when);
                    wait = QUIET;
                }
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
                    return last.map(|when| (when, bytes));
                }
            }
        }
    }

    fn press(&mut self, key: &str) {
        self.keys
            .write_all(key.as_bytes())
            .expect("the program reads");
        self.keys.flush().expect("the program reads");
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn first_frame(lobe: &Path, columns: u16, rows: u16) -> f64 {
    let start = Instant::now();
    let mut screen = Screen::start(lobe, columns, rows, &[]);
    let (when, _) = screen
        .settle(Duration::from_secs(10))
        .expect("a first frame");
    assert!(
        screen.terminal.screen().contents().contains("GGX"),
        "the first frame lists the lessons"
    );
    (when - start).as_secs_f64() * 1e3
}

/// Goes through the walkthrough of a lesson, forth and back, and scrolls.
fn keys(lobe: &Path, columns: u16, rows: u16, presses: usize) -> Vec<f64> {
    let mut screen = Screen::start(lobe, columns, rows, &["learn", "smith-g2", "--seed", "7"]);
    screen.settle(Duration::from_secs(10));
    let pattern = ["\r", "\r", "?", "?", "\r", "h", "\r", "h", "h", "h"];
    let mut times = Vec::new();
    for i in 0..presses {
        let start = Instant::now();
        screen.press(pattern[i % pattern.len()]);
        if let Some((when, _)) = screen.settle(Duration::from_millis(300)) {
            times.push((when - start).as_secs_f64() * 1e3);
        }
    }
    times
}

/// Turns a picture of three panels of 256² pixels, where the terminal has so many.
fn turns(lobe: &Path, kind: &str, presses: usize) -> Vec<f64> {
    let mut screen = Screen::start_with(lobe, 120, 40, &["play", "smith-g2"], kind);
    screen.settle(Duration::from_secs(10));
    // The terminal is asked what it can show, and here nobody answers.
    screen.settle(Duration::from_secs(1));
    let mut times = Vec::new();
    for i in 0..presses {
        let start = Instant::now();
        // Roughness up and down again.
        screen.press(if i % 20 < 10 { "\x1b[D" } else { "\x1b[C" });
        if let Some((when, _)) = screen.settle(Duration::from_millis(1000)) {
            times.push((when - start).as_secs_f64() * 1e3);
        }
    }
    times
}

/// Share of a core in per cent, and bytes drawn, in five quiet seconds.
fn idle(lobe: &Path) -> (f64, usize) {
    let mut screen = Screen::start(lobe, 80, 24, &["learn", "ggx-d", "--seed", "7"]);
    screen.settle(Duration::from_secs(10));
    let Some(id) = screen.child.process_id() else {
        return (f64::NAN, 0);
    };
    let before = cpu_ticks(id);
    std::thread::sleep(Duration::from_secs(5));
    let ticks = cpu_ticks(id) - before;
    let drawn = screen
        .settle(Duration::from_millis(1))
        .map_or(0, |(_, bytes)| bytes);
    (ticks / 100.0 / 5.0 * 100.0, drawn)
}

/// User and system time of a process in hundredths of a second (Linux).
fn cpu_ticks(id: u32) -> f64 {
    let stat = std::fs::read_to_string(format!("/proc/{id}/stat")).unwrap_or_default();
    let after_name = stat.rsplit(')').next().unwrap_or_default();
    let fields: Vec<f64> = after_name
        .split_whitespace()
        .map(|f| f.parse().unwrap_or(0.0))
        .collect();
    fields.get(11).unwrap_or(&0.0) + fields.get(12).unwrap_or(&0.0)
}

fn at_least_one(n: u16) -> NonZero<u16> {
    NonZero::new(n).unwrap_or(NonZero::<u16>::MIN)
}
