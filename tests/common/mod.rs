//! Drives the real program: as a command, and in a pseudo-terminal with a screen to look at.

#![allow(dead_code)] // Every test file takes what it needs.

use std::io::{Read, Write};
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::{Arc, Condvar, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

/// Long enough for a busy machine; nothing is asserted about time.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// The program under test.
pub const LOBE: &str = env!("CARGO_BIN_EXE_lobe");

/// The repository's root.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The lessons of the repository.
pub fn lessons() -> PathBuf {
    root().join("lessons")
}

/// Runs the program with `input` on standard input, in a home of its own.
#[track_caller]
pub fn run_with(home: &Path, args: &[&str], input: &str) -> Output {
    let mut child = Command::new(LOBE)
        .args(args)
        .current_dir(root())
        .env_clear()
        .envs(environment(home))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    // A program that does not read its input has closed it: that is no failure here.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    child.wait_with_output().expect("the program ends")
}

/// Runs the program without input.
#[track_caller]
pub fn run(args: &[&str]) -> Output {
    let home = tempfile::tempdir().expect("a folder");
    run_with(home.path(), args, "")
}

/// What it printed, which is UTF-8.
#[track_caller]
pub fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

/// What it complained about.
#[track_caller]
pub fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

fn environment(home: &Path) -> Vec<(String, String)> {
    let mut environment: Vec<(String, String)> = vec![
        ("HOME".into(), home.display().to_string()),
        ("XDG_RUNTIME_DIR".into(), home.display().to_string()),
        ("NODEVICE_SELECT".into(), "1".into()),
        ("TERM".into(), "xterm-256color".into()),
        ("LANG".into(), "C.UTF-8".into()),
        ("TZ".into(), "UTC".into()),
    ];
    for name in [
        "PATH",
        "LOBE_REQUIRE_GPU",
        "VK_DRIVER_FILES",
        "VK_ICD_FILENAMES",
    ] {
        if let Ok(value) = std::env::var(name) {
            environment.push((name.into(), value));
        }
    }
    environment
}

/// The program on a screen.
pub struct Terminal {
    screen: Arc<(Mutex<State>, Condvar)>,
    keyboard: Box<dyn Write + Send>,
    child: Box<dyn Child + Send + Sync>,
    master: Box<dyn MasterPty + Send>,
}

struct State {
    parser: vt100::Parser,
    ended: bool,
    /// Everything that came, for what is not on the screen.
    raw: Vec<u8>,
}

impl Terminal {
    /// Starts the program on a screen of that size, its home in `home`.
    #[track_caller]
    pub fn start(home: &Path, (columns, rows): (u16, u16), args: &[&str]) -> Self {
        Self::start_with(home, (columns, rows), args, &[])
    }

    /// The same with more in the environment.
    #[track_caller]
    pub fn start_with(
        home: &Path,
        (columns, rows): (u16, u16),
        args: &[&str],
        more: &[(&str, &str)],
    ) -> Self {
        let size = PtySize {
            rows,
            cols: columns,
            pixel_width: 0,
            pixel_height: 0,
        };
        let pair = native_pty_system()
            .openpty(size)
            .expect("a pseudo-terminal");
        let mut command = CommandBuilder::new(LOBE);
        command.args(args);
        command.cwd(root());
        command.env_clear();
        for (name, value) in environment(home) {
            command.env(name, value);
        }
        for (name, value) in more {
            command.env(name, value);
        }
        let child = pair
            .slave
            .spawn_command(command)
            .expect("the program starts");
        drop(pair.slave);
        let state = State {
            parser: vt100::Parser::new(cells(rows), cells(columns), 0),
            ended: false,
            raw: Vec::new(),
        };
        let screen = Arc::new((Mutex::new(state), Condvar::new()));
        let mut output = pair.master.try_clone_reader().expect("a reader");
        let shared = Arc::clone(&screen);
        thread::spawn(move || {
            let mut chunk = [0; 4096];
            loop {
                let read = output.read(&mut chunk).unwrap_or(0);
                let (state, changed) = &*shared;
                let mut state = state.lock().expect("no panic while held");
                if read == 0 {
                    state.ended = true;
                } else {
                    state.parser.process(&chunk[..read]);
                    state.raw.extend_from_slice(&chunk[..read]);
                }
                changed.notify_all();
                if read == 0 {
                    return;
                }
            }
        });
        let keyboard = pair.master.take_writer().expect("a writer");
        Self {
            screen,
            keyboard,
            child,
            master: pair.master,
        }
    }

    /// What is on the screen, as text.
    pub fn text(&self) -> String {
        self.screen
            .0
            .lock()
            .expect("no panic while held")
            .parser
            .screen()
            .contents()
    }

    /// Everything that the program wrote.
    pub fn raw(&self) -> String {
        String::from_utf8_lossy(&self.screen.0.lock().expect("no panic while held").raw)
            .into_owned()
    }

    /// Whether the alternate screen is shown, and whether the cursor is hidden.
    pub fn modes(&self) -> (bool, bool) {
        let state = self.screen.0.lock().expect("no panic while held");
        (
            state.parser.screen().alternate_screen(),
            state.parser.screen().hide_cursor(),
        )
    }

    /// Waits until the screen fulfils something.
    #[track_caller]
    pub fn wait_until(&self, what: &str, holds: impl Fn(&str) -> bool) {
        let (state, changed) = &*self.screen;
        let until = Instant::now() + PATIENCE;
        let mut state = state.lock().expect("no panic while held");
        loop {
            let text = state.parser.screen().contents();
            if holds(&text) {
                return;
            }
            let left = until.saturating_duration_since(Instant::now());
            if left.is_zero() || state.ended {
                panic!("waited for {what}; on the screen:\n{text}");
            }
            state = changed
                .wait_timeout(state, left)
                .expect("no panic while held")
                .0;
        }
    }

    /// Waits until something stands on the screen.
    #[track_caller]
    pub fn wait_for(&self, text: &str) {
        self.wait_until(&format!("{text:?}"), |screen| screen.contains(text));
    }

    /// Types.
    #[track_caller]
    pub fn send(&mut self, keys: &str) {
        self.keyboard
            .write_all(keys.as_bytes())
            .and_then(|()| self.keyboard.flush())
            .expect("a keyboard");
    }

    /// Makes the screen another size.
    #[track_caller]
    pub fn resize(&mut self, columns: u16, rows: u16) {
        self.screen
            .0
            .lock()
            .expect("no panic while held")
            .parser
            .screen_mut()
            .set_size(cells(rows), cells(columns));
        let size = PtySize {
            rows,
            cols: columns,
            pixel_width: 0,
            pixel_height: 0,
        };
        self.master.resize(size).expect("a pseudo-terminal");
    }

    /// The process, for signals.
    pub fn process(&self) -> u32 {
        self.child.process_id().expect("a process")
    }

    /// Ends the program as a power cut would.
    #[track_caller]
    pub fn kill(&mut self) {
        // The library's own `kill` asks politely first.
        signal(self.process(), "KILL");
        self.child.wait().expect("the program ends");
    }

    /// Waits for the program's own end; its exit code.
    #[track_caller]
    pub fn wait(&mut self) -> u32 {
        let code = self.child.wait().expect("the program ends").exit_code();
        // What it wrote last has arrived when its side is closed.
        let (state, changed) = &*self.screen;
        let state = state.lock().expect("no panic while held");
        let _ended = changed
            .wait_timeout_while(state, PATIENCE, |state| !state.ended)
            .expect("no panic while held");
        code
    }
}

fn cells(count: u16) -> NonZero<u16> {
    NonZero::new(count).expect("a screen has cells")
}

/// Sends a signal.
#[track_caller]
pub fn signal(process: u32, name: &str) {
    let sent = Command::new("kill")
        .args([&format!("-{name}"), &process.to_string()])
        .status();
    assert!(
        sent.is_ok_and(|status| status.success()),
        "kill -{name} {process}"
    );
}

/// Looks again and again until there is something to see.
#[track_caller]
pub fn wait_for<T>(what: &str, look: impl Fn() -> Option<T>) -> T {
    let until = Instant::now() + PATIENCE;
    loop {
        if let Some(seen) = look() {
            return seen;
        }
        assert!(Instant::now() < until, "waited for {what}");
        thread::sleep(Duration::from_millis(5));
    }
}
