//! The textbook forms against values to 40 digits that were computed elsewhere.

use serde_json::Value;

#[test]
fn textbook_forms_agree() {
    let text = include_str!("../../brdf/tests/reference/terms.json");
    let reference: Value = serde_json::from_str(text).expect("JSON");
    let mut worst = (0.0, String::new());
    for point in reference["points"].as_array().unwrap() {
        let name = point["fn"].as_str().unwrap();
        let params = brdf::term(name).unwrap().params;
        let args: Vec<f64> = params
            .iter()
            .map(|p| point["args"][p.name].as_f64().unwrap())
            .collect();
        let expected = point["value"].as_str().unwrap();
        let expected_f64: f64 = expected.parse().unwrap();
        let value =
            truth::value(name, &args).unwrap_or_else(|| panic!("{name} {args:?} has no value"));
        let error = (value.to_f64() - expected_f64).abs() / expected_f64.abs().max(1e-300);
        if error > worst.0 {
            worst = (
                error,
                format!("{name} {args:?}: {}, not {expected}", value.to_f64()),
            );
        }
    }
    println!("{worst:?}");
    // Values of the reference that keep printed constants in double precision differ so far.
    assert!(worst.0 < 1e-15, "{worst:?}");
}
