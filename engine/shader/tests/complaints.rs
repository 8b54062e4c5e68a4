//! What is said to a text that is no WGSL: the sentence, the advice, line and column.

use shader::{Limits, Outcome, Task, run};

fn complaint(source: &str) -> shader::Complaint {
    let task = Task {
        source: source.to_owned(),
        offered: "fn lobe_d(x: f32) -> f32 {\n    return x;\n}\n\nfn d_ggx(x: f32) -> f32 {\n    return lobe_d(x);\n}"
            .to_owned(),
        function: "g".to_owned(),
        params: vec!["x".to_owned()],
        points: vec![vec![0.5]],
    };
    match run(&task, Limits::default()) {
        Outcome::Refused(complaint) => complaint,
        other => panic!("{source}\n{other:?}"),
    }
}

/// A body on line 2, indented by four.
#[track_caller]
fn check(body: &str, (line, column): (usize, usize), says: &str, help: &str) {
    let found = complaint(&format!("fn g(x: f32) -> f32 {{\n    {body}\n}}\n"));
    let place = found.place.as_ref().map(|it| (it.line, it.column));
    assert_eq!(
        (found.says.as_str(), place),
        (says, Some((line, column))),
        "{body}"
    );
    assert_eq!(found.help.as_deref().unwrap_or_default(), help, "{body}");
}

#[track_caller]
fn check_whole(source: &str, says: &str) {
    assert_eq!(complaint(source).says, says, "{source}");
}

#[test]
fn what_is_not_there_is_guessed() {
    let alpha = "let alpha = x * x; return aplha;";
    check(
        alpha,
        (2, 31),
        "`aplha` is not defined here.",
        "Did you mean `alpha`?",
    );
    check(
        "return d_gxx(x);",
        (2, 12),
        "`d_gxx` is not defined here.",
        "Did you mean `d_ggx`?",
    );
    check(
        "return squrt(x);",
        (2, 12),
        "`squrt` is not defined here.",
        "Did you mean `sqrt`?",
    );
    check(
        "return lerp(x, x, x);",
        (2, 12),
        "`lerp` is not defined here.",
        "WGSL writes `mix`.",
    );
    check(
        "let a: float = x; return a;",
        (2, 12),
        "`float` is not defined here.",
        "WGSL writes `f32`.",
    );
    check(
        "return PI * x;",
        (2, 12),
        "`PI` is not defined here.",
        "WGSL has no π of its own: write `const PI = 3.14159265;`.",
    );
    check(
        "return sqrt * x;",
        (2, 12),
        "`sqrt` is a function: say of what, `sqrt(…)`.",
        "",
    );
    // What only the house calls is not offered.
    check(
        "return lobe_dd(x);",
        (2, 12),
        "`lobe_dd` is not defined here.",
        "",
    );
}

#[test]
fn what_is_left_out_is_named_where_it_is_missing() {
    let end = "A `;` is missing at the end of this line.";
    check("return x", (2, 13), end, "");
    check("let a = x * 2.0\n    return a;", (2, 20), end, "");
    check("let ä = x * 2.0   \n\n    return ä;", (2, 20), end, "");
    check(
        "return (x;",
        (2, 14),
        "A `(` is still open here: a `)` is missing before `;`.",
        "",
    );
    check(
        "return x);",
        (2, 13),
        "This `)` closes nothing: there is one too many, or a `(` too few.",
        "",
    );
    check(
        "if (x > 1.0) return 1.0; return x;",
        (2, 18),
        "A `{` is missing before `return`.",
        "WGSL wants braces even around a single statement.",
    );
    check(
        "/* return x;",
        (2, 5),
        "This comment has no end: `*/` is missing.",
        "",
    );
    check_whole(
        "fn g(x: f32) -> f32 {\n    return x;\n",
        "The text ends in the middle of a function: a `}` is missing.",
    );
    check_whole(
        "fn g(x: f32) -> f32 { return x; } }",
        "This `}` closes nothing: there is one too many, or a `{` too few.",
    );
}

#[test]
fn the_habits_of_other_languages_are_known() {
    check(
        "float a = x; return a;",
        (2, 11),
        "WGSL does not begin a declaration with the type.",
        "Write `let a = …;`, or `var a = …;` where it changes later.",
    );
    check(
        "return x > 0.0 ? 1.0 : 0.0;",
        (2, 20),
        "WGSL has no `? :`.",
        "Write `select(otherwise, value, condition)`, or an `if`.",
    );
    check(
        "return x ^ 2.0;",
        (2, 12),
        "`^` is no power in WGSL: it works on the bits of whole numbers.",
        "A power is a product, `x * x`, or `pow(x, y)`.",
    );
    check(
        "x = x * x; return x;",
        (2, 5),
        "`x` cannot be given another value.",
        "It is a parameter; copy it first: `var own_x = x;`.",
    );
    check(
        "let a = x; a = 2.0; return a;",
        (2, 16),
        "`a` cannot be given another value.",
        "It was declared with `let`; declare it with `var` instead.",
    );
    check_whole(
        "float g(float x) { return x; }",
        "`float` cannot stand outside of a function: there are `fn`, `const` and `struct`.",
    );
    check_whole(
        "fn g(x f32) -> f32 { return x; }",
        "The type stands behind the name and a `:` in WGSL.",
    );
}

#[test]
fn types_are_told_apart() {
    check(
        "let n: i32 = 2; return x * n;",
        (2, 28),
        "`*` does not take `f32` and `i32`.",
        "WGSL converts nothing by itself: write `2.0`, or `f32(i)`.",
    );
    check(
        "var s = 0.0; for (var i = 0; i < 3; i++) { s += i; } return s;",
        (2, 48),
        "This is `i32`, where `f32` is needed.",
        "Convert it: `f32(…)`.",
    );
    check(
        "return vec3(1.0, 2.0, 3.0);",
        (2, 12),
        "This is `vec3<f32>`, where `f32` is needed.",
        "",
    );
    check(
        "\n    if x { return 1.0; } return x;",
        (3, 5),
        "The condition of an `if` should be true or false, and this is a number.",
        "Compare it: `x > 0.0`.",
    );
    check(
        "return pow(x);",
        (2, 12),
        "`pow` takes 2 arguments; here 1 is given.",
        "",
    );
    check(
        "return pow(x, 2, 3);",
        (2, 12),
        "`pow` is given too many arguments.",
        "",
    );
    check(
        "let a = x;\n    let a = 1.0; return a;",
        (3, 9),
        "`a` was defined before, on line 2: choose another name.",
        "",
    );
}

#[test]
fn a_function_that_is_another_one_is_shown_the_right_one() {
    let rows = [
        (
            "fn g() -> f32 { return 1.0; }",
            "`g` takes nothing here, and should take one number.",
        ),
        (
            "fn g(x: f32) -> i32 { return 1; }",
            "`g` does not return an f32.",
        ),
        (
            "fn g(x: vec3f) -> f32 { return x.x; }",
            "The parameter `x` of `g` is not of type f32.",
        ),
    ];
    for (source, says) in rows {
        let found = complaint(source);
        assert_eq!(found.says, says);
        assert_eq!(
            found.help.as_deref(),
            Some("It should read `fn g(x: f32) -> f32`.")
        );
    }
    check_whole(
        "fn h(x: f32) -> f32 { return x; }",
        "There is no function `g` in this text.",
    );
    check_whole(
        "@fragment fn g(x: f32) -> f32 { return x; }",
        "`g` is marked as a whole shader.",
    );
}

#[test]
fn what_only_a_graphics_processor_does_is_said_to_be_so() {
    for (source, what) in [
        (
            "fn g(x: f32) -> f32 { return dpdx(x); }",
            "A derivative between pixels",
        ),
        ("fn g(x: f32) -> f32 { discard; return x; }", "`discard`"),
        (
            "@group(0) @binding(0) var<uniform> a: f32;\nfn g(x: f32) -> f32 { return a; }",
            "A variable that lives outside of the shader",
        ),
        (
            "override a: f32 = 1.0;\nfn g(x: f32) -> f32 { return a; }",
            "An `override`",
        ),
        (
            "fn g(x: f32) -> f32 { return unpack4x8unorm(u32(x)).x; }",
            "This function",
        ),
    ] {
        let found = complaint(source);
        assert_eq!(
            found.says,
            format!("{what} is WGSL, but cannot be run here.")
        );
        assert!(found.place.is_some(), "{source}");
    }
}

#[test]
fn of_a_long_line_the_part_around_the_mistake_is_shown() {
    let long = format!("{}return y;", "{ }".repeat(500));
    let found = complaint(&format!("fn g(x: f32) -> f32 {{ {long} }}"));
    let place = found.place.expect("a place");
    assert_eq!(place.column, 22 + long.find('y').expect("y") + 1);
    assert!(place.text.len() <= 120, "{}", place.text.len());
    assert_eq!(place.text.chars().nth(place.mark - 1), Some('y'));
}
