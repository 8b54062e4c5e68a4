//! Numbers as they are printed and typed.

use formula::Digits::{Decimals, Significant};
use formula::{Digits, agrees_with_printed, format_number, significant_digits};

#[track_caller]
fn shown(value: f64, digits: Digits, expected: &str) {
    assert_eq!(format_number(value, digits), expected, "{value} {digits:?}");
}

#[test]
fn numbers_are_printed_for_people() {
    shown(0.560_123, Significant(3), "0.560");
    shown(4.1666, Significant(3), "4.17");
    shown(0.99999, Significant(3), "1.00");
    shown(9.9996, Significant(4), "10.00");
    shown(12345.0, Significant(3), "12345");
    shown(12.434, Significant(2), "12");
    shown(1.3e-7, Significant(2), "1.3e-7");
    shown(0.000_012_34, Significant(3), "0.0000123");
    shown(6.02e23, Significant(3), "6.02e23");
    shown(0.0, Significant(3), "0.00");
    shown(-0.0, Significant(1), "0");
    shown(-0.25, Significant(2), "−0.25");
    shown(0.2345, Decimals(2), "0.23");
    shown(-0.001, Decimals(2), "0.00");
    shown(3.0, Decimals(0), "3");
    shown(1e300, Decimals(2), "1.0e300");
    shown(f64::INFINITY, Decimals(2), "∞");
    shown(f64::NEG_INFINITY, Significant(2), "−∞");
    shown(f64::NAN, Significant(2), "undefined");
    shown(1.0, Significant(u32::MAX), "1.0000000000000000");
    shown(f64::MIN_POSITIVE, Decimals(u32::MAX), "0.00000000000000000");
}

#[track_caller]
fn digits(text: &str, expected: Option<u32>) {
    assert_eq!(significant_digits(text), expected, "{text}");
}

#[test]
fn significant_digits_are_those_typed() {
    for (text, expected) in [
        ("0.50", 2),
        ("0.0256", 3),
        ("0,56", 2),
        ("100", 3),
        ("-0.5", 1),
        ("−1.20", 3),
        ("5.60e-1", 3),
        (" 12. ", 2),
        (".5", 1),
        ("0", 1),
        ("0.00", 1),
        ("= 0.56", 2),
    ] {
        digits(text, Some(expected));
    }
    for text in ["0.4^2", "1/2", "", "pi", "-", "1e", "1,2,3", "."] {
        digits(text, None);
    }
}

#[track_caller]
fn agrees(value: f64, text: &str, expected: bool) {
    assert_eq!(
        agrees_with_printed(value, text),
        expected,
        "{value} as {text}"
    );
}

#[test]
fn a_printed_number_is_compared_at_its_own_precision() {
    for (value, text) in [
        (0.513_207, "0.5132"),
        (0.513_207, "0,5132"),
        (0.560_3, "0.560"),
        (-0.713, "-71.3e-2"),
        (-70.6, "−71"),
        (4.1666, "4.17"),
        (0.125, "0.13"),
        (0.125, "0.12"),
        (2.5, "3"),
        (3183.0989, "3183.099"),
        (0.0, "-0.0"),
        (1e-7, "0.000"),
        (f64::INFINITY, "∞"),
        (6.022e23, "6.02e23"),
    ] {
        agrees(value, text, true);
    }
    for (value, text) in [
        (0.513_207, "0.5133"),
        (0.513_207, "0.51321x"),
        (0.713, "-0.713"),
        (4.1666, "4.16"),
        (0.126, "0.12"),
        (f64::NAN, "0"),
        (f64::INFINITY, "1e999"),
        (1.0, ""),
        (1.0, "inf"),
        (1.0, "NaN"),
    ] {
        agrees(value, text, false);
    }
}
