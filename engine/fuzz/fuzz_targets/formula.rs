//! `cargo +nightly fuzz run --fuzz-dir engine/fuzz --features libfuzzer formula`

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| lobe_fuzz::formula(data));
