//! Writing to standard output: a reader that goes away ends the program quietly.

use std::fmt::Write as _;
use std::io::{self, IsTerminal as _, Write as _};

use serde::Serialize;

use crate::exit::Failure;

/// Writes `text` as it is and flushes.
pub fn text(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(broken)
}

/// Writes `text` and a line break.
pub fn line(text_of_line: &str) -> Result<(), Failure> {
    text(&format!("{text_of_line}\n"))
}

/// Writes a line to standard error; where that is gone too, there is nobody to tell.
pub fn complain(line: &str) {
    note(&format!("lobe: {line}"));
}

/// The same without a name before it: what goes with a complaint.
pub fn note(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// One line on standard error that says how far a long command is: each takes the place of
/// the one before. Where standard error is no terminal, nothing is said.
pub fn progress(line: &str) {
    let mut error = io::stderr().lock();
    if error.is_terminal() {
        let _ = write!(error, "\r\x1b[K{line}").and_then(|()| error.flush());
    }
}

/// Writes one JSON object on a line of its own.
pub fn json(value: &impl Serialize) -> Result<(), Failure> {
    match serde_json::to_string(value) {
        Ok(text) => line(&text),
        Err(error) => Err(Failure::unusable(format!("cannot write JSON: {error}"))),
    }
}

fn broken(error: io::Error) -> Failure {
    if error.kind() == io::ErrorKind::BrokenPipe {
        Failure::ReaderGone
    } else {
        let why = crate::exit::plain_reason(&error);
        Failure::unusable(format!("cannot write to standard output: {why}"))
    }
}

/// `value` with 17 significant digits, which tell every f64 apart, as a JSON number.
/// Trailing zeros are left out; the exponent form is used outside 1e-5 … 1e17.
pub fn digits_17(value: f64) -> String {
    if value == 0.0 {
        return if value.is_sign_negative() {
            "-0.0".into()
        } else {
            "0.0".into()
        };
    }
    let scientific = format!("{value:.16e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let sign = if mantissa.starts_with('-') { "-" } else { "" };
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let digits = digits.trim_end_matches('0');

    let mut text = String::from(sign);
    if (0..17).contains(&exponent) {
        let whole = exponent as usize + 1;
        let padded = format!("{digits:0<whole$}");
        let (before, after) = padded.split_at(whole);
        let after = if after.is_empty() { "0" } else { after };
        let _ = write!(text, "{before}.{after}");
    } else if (-5..0).contains(&exponent) {
        let zeros = "0".repeat((-exponent - 1) as usize);
        let _ = write!(text, "0.{zeros}{digits}");
    } else {
        let (first, rest) = digits.split_at(1);
        let rest = if rest.is_empty() { "0" } else { rest };
        let _ = write!(text, "{first}.{rest}e{exponent}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(value: f64, shown: &str) {
        let text = digits_17(value);
        assert_eq!(text, shown);
        assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
    }

    #[test]
    fn seventeen_digits_come_back_as_the_same_number() {
        check(0.0, "0.0");
        check(-0.0, "-0.0");
        check(0.5, "0.5");
        check(1.0 / 3.0, "0.33333333333333331");
        check(-12.43, "-12.43");
        check(100.0, "100.0");
        check(0.1, "0.10000000000000001");
        check(1e-5, "0.000010000000000000001");
        check(1e-6, "9.9999999999999995e-7");
        check(1e22, "1.0e22");
        check(f64::MAX, "1.7976931348623157e308");
        check(5e-324, "4.9406564584124654e-324");
        check(123_456_789.123_456_79, "123456789.12345679");
    }
}
