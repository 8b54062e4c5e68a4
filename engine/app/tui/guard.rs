//! The terminal is given back as it was found: on exit, on a panic, on a signal.

use std::io::{self, Write as _, stdout};
use std::panic;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::thread;
use std::time::Duration;

use crossterm::cursor::Show;
use crossterm::event::{DisableBracketedPaste, DisableMouseCapture, EnableBracketedPaste};
use crossterm::execute;
use crossterm::terminal::{
    EnterAlternateScreen, LeaveAlternateScreen, disable_raw_mode, enable_raw_mode,
};
use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;

/// Whether the terminal is ours at present.
static TAKEN: AtomicBool = AtomicBool::new(false);
/// The signal that asked us to end; 0 for none.
static SIGNAL: AtomicI32 = AtomicI32::new(0);

/// How long a signalled program may take to save and leave by itself.
const GRACE: Duration = Duration::from_secs(1);

pub type Screen = Terminal<CrosstermBackend<io::Stdout>>;

/// Holds the terminal; dropping it gives the terminal back.
pub struct Guard(());

impl Guard {
    /// Takes the terminal: raw mode, alternate screen, bracketed paste.
    pub fn take() -> io::Result<(Self, Screen)> {
        give_back_on_panic();
        give_back_on_signals();
        take()?;
        let guard = Self(());
        let screen = Terminal::new(CrosstermBackend::new(stdout()))?;
        Ok((guard, screen))
    }

    /// Gives the terminal back for as long as something else needs it.
    pub fn lend<T>(&self, to: impl FnOnce() -> T) -> io::Result<T> {
        give_back();
        let done = to();
        take()?;
        Ok(done)
    }
}

fn take() -> io::Result<()> {
    enable_raw_mode()?;
    TAKEN.store(true, Ordering::SeqCst);
    execute!(stdout(), EnterAlternateScreen, EnableBracketedPaste)
}

impl Drop for Guard {
    fn drop(&mut self) {
        give_back();
    }
}

/// The signal that asked the program to end, if one did.
pub fn signalled() -> Option<i32> {
    match SIGNAL.load(Ordering::SeqCst) {
        0 => None,
        signal => Some(signal),
    }
}

/// Gives the terminal back; does nothing where it is not ours. Its own failures have nobody
/// left to tell.
fn give_back() {
    if TAKEN.swap(false, Ordering::SeqCst) {
        let _ = disable_raw_mode();
        let _ = execute!(
            stdout(),
            DisableMouseCapture,
            DisableBracketedPaste,
            LeaveAlternateScreen,
            Show
        );
        let _ = stdout().flush();
    }
}

/// A panic of the drawing thread gives the terminal back before it is told. A panic of a
/// background thread is that thread's failed result, and says nothing on the screen.
fn give_back_on_panic() {
    let main = thread::current().id();
    let tell = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if thread::current().id() == main {
            give_back();
            tell(info);
        } else if !TAKEN.load(Ordering::SeqCst) {
            tell(info);
        }
    }));
}

/// A signal is noted for the loop to leave by itself; if it cannot, the terminal is given
/// back all the same and the program ends.
#[cfg(unix)]
fn give_back_on_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGHUP, SIGINT, SIGTERM]) else {
        return;
    };
    thread::spawn(move || {
        for signal in signals.forever() {
            SIGNAL.store(signal, Ordering::SeqCst);
            thread::spawn(move || {
                thread::sleep(GRACE);
                give_back();
                process::exit(128 + signal);
            });
        }
    });
}

#[cfg(not(unix))]
fn give_back_on_signals() {}
