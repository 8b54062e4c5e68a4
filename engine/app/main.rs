//! The program `lobe`: the only place with IO (terminal, files, clock, threads).
//!
//! What is taught, marked and judged is decided below, in `tutor`; here keys become
//! messages, effects are carried out, and results are printed. Nothing here computes a
//! number that a learner sees.

mod class;
mod cli;
mod commands;
mod config;
mod due;
mod editor;
mod exit;
mod fingerprints;
mod lessons;
mod maps;
mod output;
mod picture_cache;
mod plain;
mod second;
mod seen;
mod shaders;
mod sheet;
mod sitting;
mod store;
mod text;
mod tui;

use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    quieten_graphics_driver();
    match cli::Cli::try_parse_from(cli::arguments(std::env::args_os())) {
        Ok(cli) => exit::code_of(commands::run(cli)),
        // `--help` and `--version` come as errors too, and go to standard output.
        Err(error) if !error.use_stderr() => {
            let _ = error.print();
            ExitCode::SUCCESS
        }
        Err(error) => exit::code_of(Err(exit::Failure::usage(&error))),
    }
}

/// Mesa's layer that chooses a device looks for a display and complains on standard error where
/// there is none, unless it is told to stay out of the way.
fn quieten_graphics_driver() {
    // SAFETY: this is the first thing the program does: no other thread reads the environment.
    unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
}
