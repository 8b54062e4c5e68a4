use super::*;

#[test]
fn empty_log_round_trips() {
    let record = Record::new("0.1.0", "smith-g2", "00", "2026-11-22T10:00:00Z", &Start::default());
    assert_eq!(Record::from_toml(&record.to_toml()), Ok(record));
}
