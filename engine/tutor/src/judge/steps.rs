//! Counts comparisons of tokens in tests, so that one sees what grows faster than the answer.

use std::cell::Cell;

thread_local! {
    static TAKEN: Cell<u64> = const { Cell::new(0) };
}

/// One more.
pub fn step() {
    TAKEN.with(|taken| taken.set(taken.get() + 1));
}

/// How many so far.
pub fn taken() -> u64 {
    TAKEN.with(Cell::get)
}
