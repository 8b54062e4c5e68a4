//! Numbers as people print and type them: rounding, significant digits, agreement.

use crate::answer::decimal_comma;

/// How many digits to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// So many from the first that is not zero.
    Significant(u32),
    /// So many behind the decimal point.
    Decimals(u32),
}

/// More digits than an f64 has say nothing.
const MOST: u32 = 17;

/// A number for people: `0.560`, `4.17`, `1.3e-7`, `∞`; never `-0`, minus as `−`.
///
/// Rounding is that of the exact binary value, half to even; digits before the decimal point
/// are never rounded away. Very large and very small numbers get an exponent.
pub fn format_number(value: f64, digits: Digits) -> String {
    if value.is_nan() {
        return "undefined".to_string();
    }
    let sign = if value < 0.0 { "−" } else { "" };
    if value.is_infinite() {
        return format!("{sign}∞");
    }
    let magnitude = value.abs();
    let text = match digits {
        Digits::Decimals(decimals) if magnitude < 1e15 => {
            format!("{magnitude:.*}", decimals.min(MOST) as usize)
        }
        Digits::Decimals(decimals) => significant(magnitude, decimals.clamp(1, MOST)),
        Digits::Significant(count) => significant(magnitude, count.clamp(1, MOST)),
    };
    if text.bytes().all(|byte| matches!(byte, b'0' | b'.')) {
        return text;
    }
    format!("{sign}{text}")
}

fn significant(magnitude: f64, count: u32) -> String {
    let count = count as usize;
    if magnitude == 0.0 {
        return format!("{:.*}", count - 1, 0.0);
    }
    // Rounding may carry into the next power of ten: ask the rounded number, not the value.
    let scientific = format!("{magnitude:.*e}", count - 1);
    let exponent = scientific
        .split_once('e')
        .and_then(|(_, exponent)| exponent.parse::<i32>().ok())
        .unwrap_or(0);
    if !(-5..15).contains(&exponent) {
        return scientific;
    }
    // Whole digits are never rounded away: 12345 to three digits stays 12345.
    let decimals = (count as i32 - 1 - exponent).max(0) as usize;
    format!("{magnitude:.decimals$}")
}

/// The shortest text of a value rounded to so many significant digits: `0.64`, not
/// `0.6400`.
pub(crate) fn rounded(value: f64, count: u32) -> f64 {
    format!("{value:.*e}", (count.clamp(1, MOST) - 1) as usize)
        .parse()
        .unwrap_or(value)
}

/// How many significant digits a plain number was typed with: `0.50` has 2, `0.0256` has
/// 3, `100` has 3. Arithmetic has none.
pub fn significant_digits(text: &str) -> Option<u32> {
    let text = text.trim().trim_start_matches(['=', '≈']).trim_start();
    let text = decimal_comma(text).unwrap_or_else(|| text.to_string());
    let unsigned = text.trim_start_matches(['+', '-', '−', '–']).trim_start();
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned, None),
    };
    let digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    if let Some(exponent) = exponent {
        let exponent = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        if exponent.is_empty() || !digits(exponent) {
            return None;
        }
    }
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if !digits(whole) || !digits(fraction) || whole.len() + fraction.len() == 0 {
        return None;
    }
    let all = format!("{whole}{fraction}");
    let kept = all.trim_start_matches('0').len();
    // 0.00 claims two decimals of nothing: one digit at least.
    u32::try_from(kept.max(1)).ok()
}

/// Does `value`, printed with as many digits as `shown` has, give `shown`?
///
/// `shown` may carry a decimal comma, a minus of either kind, an exponent, and `∞`. Exactly
/// half-way both neighbours are right: 0.125 is 0.12 and 0.13.
pub fn agrees_with_printed(value: f64, shown: &str) -> bool {
    let shown = shown.trim();
    let (negative, unsigned) = match shown.strip_prefix(['-', '−', '–']) {
        Some(rest) => (true, rest.trim_start()),
        None => (false, shown.strip_prefix('+').unwrap_or(shown)),
    };
    if unsigned == "∞" {
        return value.is_infinite() && (value < 0.0) == negative;
    }
    let plain = decimal_comma(unsigned).unwrap_or_else(|| unsigned.to_string());
    let Ok(printed) = plain.parse::<f64>() else {
        return false;
    };
    if !value.is_finite() || !printed.is_finite() || significant_digits(&plain).is_none() {
        return false;
    }
    let printed = if negative { -printed } else { printed };
    let (mantissa, exponent) = plain.split_once(['e', 'E']).unwrap_or((&plain, "0"));
    let decimals = mantissa
        .split_once('.')
        .map_or(0, |(_, fraction)| fraction.len());
    let (Ok(exponent), Ok(decimals)) = (exponent.parse::<i32>(), i32::try_from(decimals)) else {
        return false;
    };
    // Half of a unit in the last digit printed, and what the difference itself may be off.
    let half = format!("5e{}", exponent.saturating_sub(decimals).saturating_sub(1));
    let half = half.parse::<f64>().unwrap_or(0.0);
    (value - printed).abs() <= half + 2.0 * f64::EPSILON * value.abs()
}
