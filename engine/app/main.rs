//! The program `lobe`.
fn main() {}
