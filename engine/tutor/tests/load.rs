//! Reading lesson files: a complete one without a finding, broken ones with the right place.

use proptest::prelude::*;
use tutor::{Finding, check, load};

const COMPLETE: &str = include_str!("fixtures/complete.toml");

/// Replaces a stretch of the complete lesson that occurs exactly once.
#[track_caller]
fn edited(from: &str, to: &str) -> String {
    assert_eq!(COMPLETE.matches(from).count(), 1, "{from:?} occurs once");
    COMPLETE.replacen(from, to, 1)
}

fn findings(text: &str) -> Vec<Finding> {
    let (lesson, mut findings) = load("lesson.toml", text);
    if let Some(lesson) = lesson {
        findings.extend(check(&lesson));
    }
    findings
}

/// One edit must give a first finding whose message starts so, at the text `at`
/// within the edit (anywhere, where `at` is empty).
#[track_caller]
fn check_edit(from: &str, to: &str, at: &str, message: &str) {
    let text = edited(from, to);
    let found = findings(&text);
    let Some(first) = found.first() else {
        panic!("{to:?}: nothing found");
    };
    assert!(
        first.message.starts_with(message),
        "{to:?}: {:?}\nwanted {message:?}",
        found
    );
    if at.is_empty() {
        return;
    }
    let within = text.find(to).expect("the edit is there");
    let start = within + to.find(at).expect("the place is in the edit");
    let line = text[..start].matches('\n').count() + 1;
    let line_start = text[..start].rfind('\n').map_or(0, |end| end + 1);
    let column = text[line_start..start].chars().count() + 1;
    assert_eq!(
        (first.line, first.column),
        (line, column),
        "{to:?}: {first:?}"
    );
}

#[test]
fn a_complete_lesson_has_no_finding() {
    let (lesson, found) = load("complete.toml", COMPLETE);
    assert_eq!(found, []);
    let lesson = lesson.expect("a lesson");
    assert_eq!(check(&lesson), []);
    assert_eq!(lesson.hash.len(), 16);
    assert_eq!(lesson.exercises.len(), 7);
    assert_eq!(lesson.worked.expect("worked").lines.len(), 4);
}

#[test]
fn broken_files_are_told_by_place() {
    // Not TOML.
    check_edit("minutes = 5", "minutes = five", "five", "");
    check_edit("minutes = 5", "minutes =", "", "A value is missing here.");
    // Structure.
    check_edit(
        "summary = \"Every",
        "sumary = \"Every",
        "sumary",
        "The lesson has no key `sumary`.",
    );
    check_edit(
        "minutes = 5",
        "minutes = \"5\"",
        "\"5\"",
        "`minutes` is a string here.",
    );
    check_edit(
        "format = 1",
        "format = 2",
        "2",
        "This format is not known here.",
    );
    check_edit(
        "retest = true",
        "retests = true",
        "retests",
        "[[exercise]] has no key `retests`.",
    );
    check_edit(
        "kind = \"order\"",
        "kind = \"ordr\"",
        "\"ordr\"",
        "`ordr` is not a kind of exercise.",
    );
    check_edit(
        "stage = \"retest\"",
        "stage = \"later\"",
        "\"later\"",
        "`later` is not a stage.",
    );
    check_edit(
        "n_dot_h = \"0.85..0.98 by 0.01\"",
        "n_dot_h = \"0.85..0.98\"",
        "\"0.85",
        "`0.85..0.98` is not a range.",
    );
    check_edit(
        "phrases = [\"d cannot exceed one\"]",
        "phrase = [\"d cannot\"]",
        "phrase",
        "It has no key `phrase`.",
    );
    check_edit(
        "rounds = [1, 3]",
        "rounds = [1, 5]",
        "[1, 5]",
        "A round cannot ask for 5 of 4 lines.",
    );
    check_edit(
        "\"second\", \"third\"]",
        "\"second\", 3]",
        "3",
        "An entry of `item` is an integer here.",
    );
    // Formulas.
    check_edit(
        "is = \"1 / (pi * alpha^2)\"",
        "is = \"1 / (pi * alfa^2)\"",
        "alfa",
        "",
    );
    check_edit("is = \"roughness\"", "is = \"rougness\"", "rougness", "");
    check_edit(
        "is = \"1 / roughness^4\"",
        "is = \"1 / / roughness\"",
        "/ roughness",
        "",
    );
    check_edit(
        "where = \"n_dot_l * n_dot_v > 0.02\"",
        "where = \"n_dot_l * * 2\"",
        "* 2",
        "",
    );
}

#[test]
fn numbers_are_compared_as_printed() {
    check_edit(
        "shown = \"0.5132\"",
        "shown = \"0.5133\"",
        "0.5133",
        "`v` is printed as 0.5133; the core computes 0.5132.",
    );
    check_edit(
        "\"0.71\"",
        "\"0.72\"",
        "0.72",
        "Row 2 of \"ratio\" is printed as 0.72; the core computes 0.71.",
    );
    check_edit(
        "\"0.71\"",
        "\"0.714\"",
        "0.714",
        "The table prints 0.71 here, not 0.714.",
    );
    check_edit(
        "shown = \"0.4784\"",
        "shown = \"0.4785\"",
        "0.4785",
        "The source's number is given as 0.4785",
    );
    check_edit(
        "truth = \"visibility()\"",
        "truth = \"0.4784\"",
        "",
        "The source's 0.4784 is right",
    );
    check_edit(
        "equals = \"0.25\"",
        "equals = \"0.26\"",
        "0.26",
        "The claim says 0.26; the core computes 0.25.",
    );
    check_edit(
        "n_dot_v = 0) < 10",
        "n_dot_v = 0) > 10",
        "",
        "This does not hold: V is finite at the rim.",
    );
    check_edit(
        "cells = [\"→ ∞\"",
        "cells = [\"→ 0\"",
        "→ 0",
        "\"→ 0\" is said to be the limit",
    );
    check_edit(
        "is = \"alpha^2 / (pi * (n_dot_h^2",
        "is = \"alpha^2 / (3 * (n_dot_h^2",
        "alpha^2 / ",
        "At ",
    );
}

#[test]
fn scenes_are_possible() {
    const SCENE: &str = "scene = { roughness = 0.7, f0 = 0.95, light_deg = 60 }";
    let scene = |with: &str| SCENE.replace("light_deg = 60", with);
    check_edit(
        SCENE,
        &scene("light_deg = 180"),
        "180",
        "`light_deg` is 180, which no scene can have.",
    );
    check_edit(
        "wrong = \"d() * visibility() / (4 * n_dot_l * n_dot_v) * f_schlick() * n_dot_l\"",
        "wrong = \"n_dot_l * f_schlick() * visibility() * d()\"",
        "n_dot_l",
        "The wrong picture of `twice` is the right one.",
    );
    check_edit(
        SCENE,
        &scene("light_degs = 60"),
        "",
        "The scene of `twice` has no `light_deg`.",
    );
    let found = findings(&edited(SCENE, &scene("light_degs = 60")));
    assert_eq!(
        found[0].help.as_deref(),
        Some("Is `light_degs` meant for it?")
    );
    check_edit(
        SCENE,
        &scene("light_deg = 60, eye_distance = 1"),
        "1 }",
        "`eye_distance` is 1, which no scene can have.",
    );
    check_edit(
        SCENE,
        &scene("light_deg = 60, v_dot_h = 1"),
        "v_dot_h",
        "`v_dot_h` follows from the scene, point by point.",
    );
    check_edit(
        SCENE,
        &scene("light_deg = 60, radius = 0.5").replace("0.7", "1.7"),
        "1.7",
        "`roughness` is 1.7, which no scene can have.",
    );
    let lit = |with: &str| scene("ior = 1.5") + "\nlight = [" + with + "]";
    check_edit(
        SCENE,
        &lit("{ deg = 60 }, { deg = 20, distance = 0.5 }"),
        "{ deg = 20",
        "`distance` is 0.5, which no scene can have.",
    );
    check_edit(
        SCENE,
        &lit("{ deg = 60, colour = [1, 2] }"),
        "[1, 2]",
        "A colour has three numbers, not 2.",
    );
    check_edit(
        SCENE,
        &lit("{ turn_deg = 60 }"),
        "{ turn_deg",
        "[[fingerprint.light]] has no `deg`.",
    );
    check_edit(
        SCENE,
        &lit("{ deg = 60, intensity = 0 }"),
        "",
        "No light of `twice` shines.",
    );
    check_edit(
        SCENE,
        &(SCENE.to_owned() + "\nlight = [{ deg = 60 }]"),
        "light_deg",
        "The scene has `light_deg`, and lights of its own below.",
    );
    check_edit(
        SCENE,
        &(SCENE.to_owned() + "\nseen = { lit_above = 0.3 }"),
        "lit_above",
        "No figure of a picture is called `lit_above`.",
    );
    let text = edited(
        SCENE,
        &(lit("{ deg = 60 }, { deg = 20, colour = [1, 0.5, 0] }")
            + "\nseen = { lit_above_one = 0.3 }"),
    );
    assert_eq!(findings(&text), []);
}

#[test]
fn prose_types_no_numbers() {
    check_edit(
        "The peak of D is ",
        "At roughness 0.4 the peak of D is ",
        "0.4",
        "0.4 is typed here",
    );
    check_edit("- two, ", "- α two 1.5, ", "1.5", "1.5 is typed here");
    check_edit("{{ v : .4 }}", "{{ w : .4 }}", "w", "");
    check_edit(
        "{{ v : .4 }}",
        "{{ v : 4 }}",
        "4 }}",
        "This is not a format of numbers.",
    );
    check_edit(
        "{{ v : .4 }}",
        "{{ v : .4",
        "{{",
        "This template is not closed.",
    );
    // The end of another template is not the end of this one.
    check_edit(
        "{{ v : .4 }}",
        "{{ v : .4 } and {{ v : .4 }}",
        "{{",
        "This template is not closed.",
    );
    check_edit(
        "{{ formula d }}",
        "{{ formula dd }}",
        "dd",
        "No formula is called `dd`.",
    );
    check_edit(
        "{{ source slip }} for V",
        "{{ source slop }} for V",
        "slop",
        "No `[[source_says]]` has the id `slop`.",
    );
}

#[test]
fn means_are_those_of_a_picture() {
    const MEANS: &str = "means = { size = [16, 32] }";
    check_edit(
        MEANS,
        &MEANS.replace("[16, 32]", "[32, 16]"),
        "16]",
        "`size` is 16, which no scene can have.",
    );
    check_edit(
        MEANS,
        &MEANS.replace("32]", "32.5]"),
        "32.5",
        "`size` is 32.5, which no scene can have.",
    );
    check_edit(
        MEANS,
        &MEANS.replace("size = [16, 32]", ""),
        "{  }",
        "`means` has no `size`.",
    );
    check_edit(MEANS, "", "", "The fingerprint `twice` has no `means`.");
    check_edit(
        "means_of = \"twice\"",
        "means_of = \"twise\"",
        "twise",
        "No `[[fingerprint]]` is called `twise`.",
    );
    check_edit(
        "panel = \"wrong\"",
        "panel = \"left\"",
        "\"left\"",
        "A curve of means is of the right panel",
    );
}

#[test]
fn what_is_drawn_is_shown() {
    check_edit(
        "map = \"everywhere\"\n",
        "",
        "",
        "No step and no re-teach shows `everywhere`.",
    );
    check_edit(
        "map = \"everywhere\"",
        "map = \"nowhere\"",
        "nowhere",
        "No `[[map]]` is called `nowhere`.",
    );
}

#[test]
fn references_and_ids() {
    check_edit(
        "picture = \"twice\"",
        "picture = \"twise\"",
        "twise",
        "No `[[fingerprint]]` is called `twise`.",
    );
    check_edit(
        "source = \"slip\"",
        "source = \"slap\"",
        "slap",
        "No `[[source_says]]` is called `slap`.",
    );
    check_edit(
        "step = \"inner\"",
        "step = \"iner\"",
        "iner",
        "No step is called `iner`.",
    );
    check_edit(
        "id = \"fixture/order\"",
        "id = \"order\"",
        "order",
        "`order` is not an id of this lesson.",
    );
    check_edit(
        "id = \"fixture/order\"",
        "id = \"fixture/which\" # again",
        "fixture/which",
        "Another exercise or question",
    );
    check_edit(
        "core = \"v_ggx\"",
        "core = \"v_gxx\"",
        "v_gxx",
        "The core has no function `v_gxx`.",
    );
    check_edit(
        "reteach = \"shape\"",
        "reteach = \"shapes\"",
        "shapes",
        "`already-inside` is taken up by `shapes`",
    );
    check_edit(
        "verdict = \"pass\"",
        "verdict = \"passs\"",
        "passs",
        "\"passs\" is no verdict",
    );
    check_edit(
        "verdict = \"pass\"",
        "met = [\"nothing\"]\nverdict = \"pass\"",
        "[\"nothing\"]",
        "No expectation of this question is called `nothing`.",
    );
}

#[test]
fn what_the_tutor_asks_back() {
    let ask = "ask = \"What is V made of?\"";
    check_edit(ask, "# no question", "", "`already-inside` has no `ask`.");
    check_edit(
        ask,
        "ask = \"Is the division already inside V?\"",
        "Is the division already inside V?",
        "This gives `already-inside` away: the judge hears it in the ask itself.",
    );
    check_edit(
        "[already inside V] (where?)",
        "already inside V",
        "",
        "This gives `already-inside` away",
    );
    check_edit(
        "[already inside V] (where?)",
        "somewhere",
        "",
        "The prompt of `already-inside` has no blank.",
    );
    check_edit(
        "[already inside V]",
        "[quite elsewhere]",
        "",
        "\"The division is quite elsewhere.\" should settle `already-inside`",
    );
    // Numbers in what the tutor says are computed, as everywhere.
    for words in ["Look at the one half on top.", "At the peak it does."] {
        check_edit(words, "Look at 0.5.", "0.5", "0.5 is typed here");
        check_edit(words, "{{ nobody }}", "nobody", "");
    }
}

#[test]
fn a_lesson_asks_for_an_explanation() {
    let end = COMPLETE.find("[[explain]]").expect("questions");
    let found = findings(&COMPLETE[..end]);
    assert!(
        matches!(&found[..], [it] if it.code == "nothing-explained" && it.severity == tutor::Severity::Error),
        "{found:?}"
    );
}

#[test]
fn exercises_are_rich_enough() {
    check_edit(
        "tolerance = { rel = 0.02 }",
        "tolerance = { rel = 0.002 }",
        "0.002",
        "Learners who round",
    );
    check_edit(
        "is = \"1 / roughness^4\"",
        "is = \"1 / (pi * roughness^2)\" # twice",
        "",
        "10000 tries give no numbers for `fixture/peak`",
    );
    check_edit(
        "is = \"1 / (pi * roughness^4)\"\ntolerance",
        "is = \"roughness + 0.5\"\ntolerance",
        "",
        "`fixture/peak` has ",
    );
}

#[test]
fn maps_are_checked() {
    check_edit(
        "scale = \"log\", from = 0.25",
        "scale = \"lag\", from = 0.25",
        "\"lag\"",
        "No scale is called",
    );
    check_edit(
        "from = 0.25, to = 25.0",
        "from = -1.0, to = 25.0",
        "25.0",
        "The scale runs from",
    );
    check_edit("to = 0.95", "to = 0.04", "0.04", "The axis runs");
    let map = "[[map]]\nid = \"everywhere\"";
    let plot = r#"
[[plot]]
id = "everywhere"
title = "The same name"
x = { name = "n_dot_v", from = 0.02, to = 1.0, label = "N·V" }
y = { label = "N·V" }
series = [{ label = "itself", is = "n_dot_v" }]
"#;
    check_edit(
        map,
        &format!("{plot}\n{map}"),
        "everywhere\"\ntitle = \"The",
        "No step and no re-teach shows `everywhere`.",
    );
    let named = |finding: &tutor::Finding| finding.code == "id-given-twice";
    let text = edited(map, &format!("{plot}\n{map}"));
    assert!(findings(&text).iter().any(named));
    check_edit(
        "is = \"0.25 / (n_dot_l * n_dot_v)\"",
        "is = \"0.25 / (n_dot_l * n_dot_h)\"",
        "n_dot_h",
        "Unknown name",
    );
    check_edit(
        "is = \"0.25 / (n_dot_l * n_dot_v)\"",
        "is = \"sqrt(-n_dot_l * n_dot_v)\"",
        "sqrt",
        "The map has no values",
    );
}

/// Between its points a curve is drawn straight: nowhere may that be seen.
#[test]
fn a_curve_has_points_where_it_bends() {
    let sharp = "0.001 / (0.001 + (n_dot_v - 0.5)^2)";
    let text = edited("log = true, from = 0.1, to = 100.0", "log = false");
    let text = text.replacen(
        "1 / (4 * n_dot_l * n_dot_v)\" },",
        &format!("{sharp}\" }},"),
        1,
    );
    let lesson = load("lesson.toml", &text).0.expect("a lesson");
    let Some(tutor::prose::Block::Plot(plot)) = lesson.plot("ratio") else {
        panic!("no plot");
    };
    let points = &plot.series[0].1;
    assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0));
    for pair in points.windows(2) {
        let [(x0, y0), (x1, y1)] = [pair[0], pair[1]];
        let middle = f64::midpoint(x0, x1);
        let truth = 0.001 / (0.001 + (middle - 0.5) * (middle - 0.5));
        assert!(
            (truth - f64::midpoint(y0, y1)).abs() < 1.5e-3,
            "at {middle}"
        );
    }
}

/// Whoever can draw measures the means, once; where nobody can the curve is empty.
#[test]
fn means_are_measured_by_who_can_draw() {
    fn half(
        _: &tutor::Lesson,
        _: &tutor::lesson::Fingerprint,
        means: &tutor::lesson::Means,
    ) -> Vec<tutor::lesson::Total> {
        let total = |size| tutor::lesson::Total {
            size,
            right: 1.0 / size,
            wrong: size / 32.0,
        };
        means.drawable().map(f64::from).map(total).collect()
    }
    let mut lesson = load("complete.toml", COMPLETE).0.expect("a lesson");
    let curve = |lesson: &tutor::Lesson| match lesson.plot("ratio") {
        Some(tutor::prose::Block::Plot(plot)) => plot.series[1].1.clone(),
        other => panic!("no plot: {other:?}"),
    };
    assert_eq!(curve(&lesson), []);
    lesson.measure = Some(half);
    assert_eq!(curve(&lesson), [(16.0, 0.5), (32.0, 1.0)]);
    lesson.measure = Some(|_, _, _| panic!("measured twice"));
    assert_eq!(curve(&lesson).len(), 2);
}

#[test]
fn a_map_has_its_values_from_the_bottom() {
    let lesson = load("complete.toml", COMPLETE).0.expect("a lesson");
    let map = lesson.map_frame("everywhere").expect("a map");
    let values = lesson.map_cells("everywhere", 48);
    assert_eq!(values.len(), 48 * 48);
    let middle = |(from, to): (f64, f64), cell: f64| from + (to - from) * cell / 48.0;
    let at = |column: f64, row: f64| 0.25 / (middle(map.y, row) * middle(map.x, column));
    assert!((values[0] - at(0.5, 0.5)).abs() < 1e-12);
    // One column to the right, on the uppermost row.
    let upper = 48 * 47 + 1;
    assert!((values[upper] - at(1.5, 47.5)).abs() < 1e-12);
}

/// A file that is not even TOML tells its first errors, not one a line.
#[track_caller]
fn check_syntax(text: &str, message: &str) {
    let found = findings(text);
    assert!(!found.is_empty() && found.len() <= 5, "{}", found.len());
    assert!(found[0].message.starts_with(message), "{:?}", found[0]);
}

#[test]
fn broken_syntax_is_told_briefly() {
    check_syntax(&COMPLETE.replace('\n', "\r"), "Carriage return");
    check_syntax(&COMPLETE.replacen("\"\"\"", "", 1), "");
    check_syntax(
        &COMPLETE.replacen("summary = \"", "summary = \"\0", 1),
        "The control character U+0000",
    );
    let single = "[step]\ntitle = \"a\"\n[step]\n";
    check_syntax(single, "Duplicate key.");
    let help = findings(single)[0].help.clone();
    assert!(help.is_some_and(|help| help.contains("[[step]]")));
}

#[test]
fn several_errors_come_at_once() {
    let text = COMPLETE
        .replacen("minutes = 5", "minutes = \"5\"", 1)
        .replacen("retest = true", "retests = true", 1)
        .replacen("kind = \"order\"", "kind = \"ordr\"", 1);
    let codes: Vec<&str> = load("x", &text).1.iter().map(|it| it.code).collect();
    assert_eq!(codes, ["wrong-kind", "unknown-key", "unknown-name"]);
    let text = "a = \nb = \n[c\nd = 1";
    assert!(load("x", text).1.len() >= 2);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_gives_an_answer(text in "(?s).{0,200}") {
        let _ = load("x", &text);
    }

    #[test]
    fn any_damage_gives_an_answer(at in 0..COMPLETE.len(), length in 0..40usize, with in "[\\PC\\n\"'\\\\{}\\[\\]=]{0,6}") {
        let mut start = at;
        while !COMPLETE.is_char_boundary(start) { start -= 1; }
        let mut end = (start + length).min(COMPLETE.len());
        while !COMPLETE.is_char_boundary(end) { end -= 1; }
        let text = format!("{}{with}{}", &COMPLETE[..start], &COMPLETE[end.max(start)..]);
        let (lesson, findings) = load("x", &text);
        prop_assert!(lesson.is_some() || !findings.is_empty());
        for finding in &findings {
            prop_assert!(finding.end <= text.len() && finding.line >= 1 && finding.column >= 1);
        }
    }
}
