//! Texts that want to go on for ever, to fill the memory, or to be read to death: each ends in a
//! sentence. What only a process of its own survives is tested with the program.

use shader::{Limits, MOST_BYTES, Outcome, Task, run};

fn outcome(source: &str) -> Outcome {
    let task = Task {
        source: source.to_owned(),
        function: "g".to_owned(),
        params: vec!["x".to_owned()],
        points: vec![vec![0.5], vec![0.0]],
        ..Task::default()
    };
    run(&task, Limits::default())
}

#[track_caller]
fn check_stopped(source: &str, says: &str) {
    match outcome(source) {
        Outcome::Stopped(stop) => assert!(stop.says.contains(says), "{}", stop.says),
        other => panic!("{source:.200}\n{other:?}"),
    }
}

#[track_caller]
fn check_refused(source: &str, says: &str) {
    match outcome(source) {
        Outcome::Refused(complaint) => {
            assert!(complaint.says.contains(says), "{}", complaint.says);
        }
        other => panic!("{source:.200}\n{other:?}"),
    }
}

fn body(statements: &str) -> String {
    format!("fn g(x: f32) -> f32 {{ {statements} }}")
}

#[test]
fn what_never_ends_is_ended() {
    const STEPS: &str = "had not returned after 500,000 steps";
    check_stopped(&body("loop { if x > 2.0 { break; } } return x;"), STEPS);
    check_stopped(&body("while true { } return x;"), STEPS);
    check_stopped(&body("for (;;) { continue; } return x;"), STEPS);
    check_stopped(
        &body("var i = 0u; loop { i++; continuing { break if i == 0u; } } return x;"),
        STEPS,
    );
    // Each function calls the one before twice.
    let mut bomb = "fn c0(x: f32) -> f32 { return x; }\n".to_owned();
    for at in 1..60 {
        let before = at - 1;
        bomb += &format!("fn c{at}(x: f32) -> f32 {{ return c{before}(x) + c{before}(x); }}\n");
    }
    check_stopped(&format!("{bomb}{}", body("return c59(x);")), STEPS);
    // Copying is work too.
    check_stopped(
        &body("var a: array<f32, 60000>; loop { let b = a; a[0] = b[1] + 1.0; } return x;"),
        STEPS,
    );
}

#[test]
fn what_is_too_deep_or_too_large_is_stopped() {
    let mut chain = "fn c0(x: f32) -> f32 { return x; }\n".to_owned();
    for at in 1..200 {
        chain += &format!("fn c{at}(x: f32) -> f32 {{ return c{}(x); }}\n", at - 1);
    }
    check_stopped(&format!("{chain}{}", body("return c199(x);")), "64 deep");
    let room = "fn h(x: f32) -> f32 { var a: array<f32, 40000>; return a[1]; }\n";
    let twice = format!(
        "{room}{}",
        body("var a: array<f32, 40000>; return h(a[2]);")
    );
    check_stopped(&twice, "more than 65,536 numbers");
    check_refused(
        &body("var a: array<f32, 100000000>; return a[1];"),
        "100,000,000",
    );
    check_refused(
        &body("let a = array<f32, 1000000000>(); return a[1];"),
        "larger than",
    );
    check_refused(
        &body("var a: array<array<array<f32, 1000>, 1000>, 100>; return a[1][1][1];"),
        "100,000,000",
    );
    check_stopped(
        &body("var a = array(1.0, 2.0); return a[i32(x * 10.0)];"),
        "Index 5 is past",
    );
    check_stopped(
        &body("var a = array(1.0, 2.0); return a[-1 + i32(x)];"),
        "negative index",
    );
}

#[test]
fn what_cannot_be_read_is_refused() {
    check_refused("", "There is no text");
    check_refused(" \n\t ", "There is no text");
    check_refused("const a = 1.0;", "no function `g`");
    check_refused(
        "fn g(y: f32, x: f32) -> f32 { return x; }",
        "takes 2 numbers here",
    );
    check_refused("fn g(x: i32) -> f32 { return 1.0; }", "not of type f32");
    check_refused(
        "fn g(x: f32) -> vec2f { return vec2f(x); }",
        "does not return an f32",
    );
    check_refused("fn g(x: f32) { }", "returns nothing");
    check_refused(&body("return g(x);"), "recursion");
    check_refused("\0\u{1}\u{feff}\u{202e}", "cannot stand outside");
    check_refused(&"x".repeat(MOST_BYTES + 1), "at most 65,536 are read");
    check_refused(&" ".repeat(1 << 20), "at most 65,536 are read");
    check_refused(
        &body(&format!(
            "return {}x{};",
            "(".repeat(10_000),
            ")".repeat(10_000)
        )),
        "nested too deep",
    );
    check_refused(&body(&"{".repeat(10_000)), "nested too deep");
    check_refused(
        &format!("{}return x;", "fn g(x: f32) -> f32 {".repeat(50)),
        "inside another",
    );
}

#[test]
fn no_value_is_a_value_too() {
    for (returned, is) in [
        ("x / 0.0", f32::INFINITY),
        ("0.0 / (x - x)", f32::NAN),
        ("sqrt(-x - 1.0)", f32::NAN),
        ("log(0.0 * x)", f32::NEG_INFINITY),
    ] {
        match outcome(&body(&format!("return {returned};"))) {
            Outcome::Values(values) => {
                let same = values[0] == is || (values[0].is_nan() && is.is_nan());
                assert!(same, "{returned}: {}", values[0]);
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn all_calls_together_have_a_limit() {
    let source = body("var s = 0.0; for (var i = 0; i < 1000; i++) { s += x; } return s;");
    let task = Task {
        source,
        function: "g".to_owned(),
        params: vec!["x".to_owned()],
        points: vec![vec![1.0]; 100],
        ..Task::default()
    };
    let limits = Limits {
        all_steps: 100_000,
        ..Limits::default()
    };
    match run(&task, limits) {
        Outcome::Stopped(stop) => assert!(stop.says.contains("at every point"), "{}", stop.says),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_task_and_its_outcome_survive_the_way_through_json() {
    let task = Task {
        source: body("return x / x;"),
        function: "g".to_owned(),
        params: vec!["x".to_owned()],
        points: vec![vec![0.1], vec![0.0], vec![f32::MIN_POSITIVE]],
        ..Task::default()
    };
    let text = serde_json::to_string(&task).expect("JSON");
    let back: Task = serde_json::from_str(&text).expect("a task");
    assert_eq!(back, task);
    let text = serde_json::to_string(&run(&back, Limits::default())).expect("JSON");
    match serde_json::from_str(&text).expect("an outcome") {
        Outcome::Values(values) => {
            assert_eq!((values[0], values[2]), (1.0, 1.0));
            assert!(values[1].is_nan());
        }
        other => panic!("{other:?}"),
    }
}
