//! What comes in while a lesson is read as text: lines and signals.

use std::io::{self, BufRead as _};
use std::sync::mpsc::{self, Receiver};
use std::thread;

/// What comes in.
pub enum Incoming {
    Line(String),
    End,
    /// A signal asks to end.
    Signal(i32),
}

/// Lines and signals, in the order in which they come.
pub fn incoming() -> Receiver<Incoming> {
    let (send, incoming) = mpsc::channel();
    let signals = send.clone();
    thread::spawn(move || {
        let mut bytes = Vec::new();
        let mut stdin = io::stdin().lock();
        loop {
            bytes.clear();
            match stdin.read_until(b'\n', &mut bytes) {
                Ok(1..) => {
                    let text = String::from_utf8_lossy(&bytes);
                    let line = text
                        .trim_end_matches(['\n', '\r'])
                        .trim_start_matches('\u{feff}');
                    if send.send(Incoming::Line(line.to_owned())).is_err() {
                        return;
                    }
                }
                // What cannot be read has ended.
                Ok(0) | Err(_) => {
                    let _ = send.send(Incoming::End);
                    return;
                }
            }
        }
    });
    watch_signals(signals);
    incoming
}

#[cfg(unix)]
fn watch_signals(send: mpsc::Sender<Incoming>) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGHUP, SIGINT, SIGTERM]) else {
        return;
    };
    thread::spawn(move || {
        for signal in signals.forever() {
            let _ = send.send(Incoming::Signal(signal));
        }
    });
}

#[cfg(not(unix))]
fn watch_signals(_send: mpsc::Sender<Incoming>) {}
