//! What functions compute: rows of WGSL and values, and every twin of the core.

use shader::{Limits, Outcome, Task, run};

/// The values of a body at some `x`, the text before it being anything.
fn task(before: &str, body: &str, at: &[f32]) -> Task {
    Task {
        source: format!("{before}\nfn g(x: f32) -> f32 {{ {body} }}"),
        function: "g".to_owned(),
        params: vec!["x".to_owned()],
        points: at.iter().map(|x| vec![*x]).collect(),
        ..Task::default()
    }
}

#[track_caller]
fn check_with(before: &str, body: &str, at: f32, expected: f32) {
    match run(&task(before, body, &[at]), Limits::default()) {
        Outcome::Values(values) => {
            let same = values[0] == expected || (values[0].is_nan() && expected.is_nan());
            assert!(same, "{body} at {at}: {} is not {expected}", values[0]);
        }
        other => panic!("{body}: {other:?}"),
    }
}

#[track_caller]
fn check(body: &str, at: f32, expected: f32) {
    check_with("", body, at, expected);
}

#[test]
fn arithmetic_is_that_of_f32() {
    check("return x + 0.1;", 0.2, 0.2 + 0.1);
    check("return x / 3.0 * 3.0 - 1.0;", 0.1, 0.1 / 3.0 * 3.0 - 1.0);
    check("return 1.0 / x;", 0.0, f32::INFINITY);
    check("return x / x;", 0.0, f32::NAN);
    check("return -x % 3.0;", 7.5, -7.5 % 3.0);
    check("return x * 1e30 * 1e30;", 1.0, f32::INFINITY);
}

#[test]
fn whole_numbers_wrap_and_divide_by_zero_without_harm() {
    check("let i = i32(x); return f32(i / (i - 7));", 7.0, 7.0);
    check("let i = i32(x); return f32(i % (i - 7));", 7.0, 0.0);
    check(
        "var i = 2147483647; i += i32(x); return f32(i);",
        1.0,
        -2147483648.0,
    );
    check(
        "let u = u32(x); return f32((u << 4u) | (u >> 1u) & 1u);",
        3.0,
        49.0,
    );
    check("return f32(i32(x));", 3e10, 2147483648.0);
    check("return f32(u32(x));", -3.0, 0.0);
    check(
        "return bitcast<f32>(bitcast<u32>(x) + 1u);",
        1.0,
        1.0 + f32::EPSILON,
    );
    check("return f32(~i32(x) ^ 5);", 3.0, f32::from((!3_i16) ^ 5));
    check(
        "return f32(countOneBits(u32(x)) + firstLeadingBit(u32(x)));",
        10.0,
        5.0,
    );
    check(
        "return f32(extractBits(i32(x), 1u, 2u) + insertBits(0, 3, 4u, 2u));",
        6.0,
        47.0,
    );
}

#[test]
fn control_flow_goes_where_it_should() {
    check(
        "if x > 0.5 { return 1.0; } else if x > 0.2 { return 2.0; } return 3.0;",
        0.3,
        2.0,
    );
    check(
        "var s = 0.0; for (var i = 0; i < 10; i++) { if i == 3 { continue; } if i == 6 { break; } s += f32(i); } return s;",
        0.0,
        12.0,
    );
    check(
        "var s = x; while s < 10.0 { s *= 2.0; } return s;",
        1.5,
        12.0,
    );
    check(
        "var n = 0; loop { n++; continuing { break if n >= 4; } } return f32(n);",
        0.0,
        4.0,
    );
    check(
        "switch i32(x) { case 1, 2: { return 12.0; } case 3: { } default: { return 0.0; } } return 3.0;",
        2.0,
        12.0,
    );
    check(
        "switch i32(x) { case 1, 2: { return 12.0; } case 3: { } default: { return 0.0; } } return 3.0;",
        3.0,
        3.0,
    );
    check(
        "switch i32(x) { case 1, 2: { return 12.0; } case 3: { } default: { return 0.0; } } return 3.0;",
        9.0,
        0.0,
    );
    // The right side is not looked at where the left one decides.
    check(
        "if x > 0.0 && 1.0 / x > 1.0 { return 1.0; } return 0.0;",
        0.0,
        0.0,
    );
}

#[test]
fn vectors_and_matrices_compute_by_lanes() {
    check(
        "let v = vec3(x, 2.0, 3.0); return dot(v, v.zyx) + v.y;",
        1.0,
        12.0,
    );
    check(
        "let m = mat2x2(1.0, 2.0, 3.0, x); return (m * vec2(1.0, 1.0)).y;",
        4.0,
        6.0,
    );
    check(
        "let m = mat2x2(1.0, 2.0, 3.0, x); return (vec2(1.0, 1.0) * m).y;",
        4.0,
        7.0,
    );
    check(
        "let m = mat2x2(1.0, 2.0, 3.0, x); return (m * m)[1].x + determinant(m) + transpose(m)[0].y;",
        4.0,
        16.0,
    );
    check(
        "let v = normalize(vec3(0.0, x, 4.0)); return v.y + length(vec2(x, 4.0));",
        3.0,
        3.0 / 5.0 + 5.0,
    );
    check(
        "let v = cross(vec3(1.0, 0.0, 0.0), vec3(0.0, x, 0.0)); return v.z;",
        2.0,
        2.0,
    );
    check(
        "var v = vec4(0.0); v.z = x; v[1] = 2.0; return v.x + v.y + v.z;",
        5.0,
        7.0,
    );
    check(
        "let r = reflect(vec3(1.0, -1.0, 0.0), vec3(0.0, x, 0.0)); return r.y;",
        1.0,
        1.0,
    );
    check(
        "let v = select(vec2(1.0), vec2(2.0), vec2(x, 1.0) > vec2(0.5)); return v.x * 10.0 + v.y;",
        0.2,
        12.0,
    );
    check(
        "if all(vec2(x, 1.0) > vec2(0.5)) { return 1.0; } return 0.0;",
        0.2,
        0.0,
    );
}

#[test]
fn arrays_structs_pointers_and_globals_hold_values() {
    check(
        "var a = array(1.0, 2.0, 3.0); let b = a; a[i32(x)] = 9.0; return a[1] * 10.0 + b[1];",
        1.0,
        92.0,
    );
    check_with(
        "struct S { a: f32, b: vec2f }\nfn h(p: ptr<function, S>) { (*p).b.y = 4.0; }",
        "var s = S(1.0, vec2(2.0)); h(&s); return s.a + s.b.x + s.b.y + x;",
        0.5,
        7.5,
    );
    check_with(
        "const K = array(2.0, 3.0);\nvar<private> n: f32 = 1.0;\nfn add() -> f32 { n += 1.0; return n; }",
        "let a = add(); return a * 10.0 + add() + K[i32(x)];",
        1.0,
        26.0,
    );
}

#[test]
fn every_call_begins_afresh() {
    let task = task(
        "var<private> n: f32 = 1.0;",
        "n += x; return n;",
        &[1.0, 1.0, 5.0],
    );
    assert_eq!(
        run(&task, Limits::default()),
        Outcome::Values(vec![2.0, 2.0, 6.0])
    );
}

#[test]
fn functions_are_those_of_wgsl() {
    check("return pow(x, 2.0);", -2.0, f32::NAN);
    check("return pow(x, 5.0) + exp2(3.0) + log2(x);", 2.0, 41.0);
    check(
        "return round(x) + fract(-x) + floor(-x);",
        2.5,
        2.0 + 0.5 - 3.0,
    );
    check(
        "return clamp(x, 0.25, 0.5) + saturate(x) + sign(-x);",
        2.0,
        0.5 + 1.0 - 1.0,
    );
    check(
        "return mix(2.0, 4.0, x) + step(x, 0.5) + smoothstep(0.0, 1.0, x);",
        0.5,
        4.5,
    );
    check("return min(x, 1.0) + max(x, 1.0) + abs(-x);", 3.0, 7.0);
    check(
        "return fma(x, 2.0, 1.0) + inverseSqrt(x) + sqrt(x);",
        4.0,
        11.5,
    );
    check(
        "let m = modf(x); return m.whole * 10.0 + m.fract;",
        2.25,
        20.25,
    );
    check(
        "let f = frexp(x); return ldexp(f.fract, f.exp) + f.fract;",
        6.0,
        6.75,
    );
    check("return sin(x) + cos(x) + atan2(x, 1.0);", 0.0, 1.0);
    check("return degrees(radians(x));", 90.0, 90.0);
    check("return max(x, 1.0);", f32::NAN, 1.0);
}

/// Twins may lose so much, relative to the value: what software Vulkan is held to.
const TWIN: f64 = 5e-5;

/// Points of a term: corners, and some in between that no one chose.
fn points(term: &brdf::Term) -> Vec<Vec<f32>> {
    let mut points = Vec::new();
    let mut state = 0x9e37_79b9_u32;
    for index in 0..400_u32 {
        let point = term.params.iter().enumerate().map(|(at, param)| {
            let (low, high) = param.range;
            let share = match index {
                // Every corner of as many arguments as there are bits.
                0..64 => f64::from(index >> at & 1),
                _ => {
                    state ^= state << 13;
                    state ^= state >> 17;
                    state ^= state << 5;
                    f64::from(state) / f64::from(u32::MAX)
                }
            };
            (low + share * (high - low)) as f32
        });
        points.push(point.collect());
    }
    points
}

/// The twin of a term, run here, against the same formula in f64 at the same numbers.
fn check_twin(term: &brdf::Term) -> usize {
    let names: Vec<&str> = term.params.iter().map(|param| param.name).collect();
    let expr = formula::parse(&format!("{}()", term.name)).expect("a call");
    let wgsl = formula::Library::new().wgsl(&expr, &names).expect("a twin");
    let params: Vec<String> = names.iter().map(|name| format!("{name}: f32")).collect();
    let task = Task {
        source: format!(
            "fn twin({}) -> f32 {{ return {}; }}",
            params.join(", "),
            wgsl.expr
        ),
        offered: wgsl.functions,
        function: "twin".to_owned(),
        params: names.iter().map(|name| (*name).to_owned()).collect(),
        points: points(term),
    };
    let values = match run(&task, Limits::default()) {
        Outcome::Values(values) => values,
        other => panic!("{}: {other:?}", term.name),
    };
    let mut compared = 0;
    for (point, value) in task.points.iter().zip(&values) {
        let wide: Vec<f64> = point.iter().map(|x| f64::from(*x)).collect();
        let truth = (term.f64)(&wide);
        // Below the smallest number that f32 holds in full there is nothing to compare.
        if !truth.is_finite() || truth.abs() < 1e-30 || truth.abs() > 1e38 {
            continue;
        }
        compared += 1;
        let error = (f64::from(*value) - truth).abs();
        // What is computed as a difference of numbers near one is good to their rounding.
        let floor = 2e-7;
        assert!(
            error <= TWIN * truth.abs() + floor,
            "{} at {point:?}: {value} is not {truth}",
            term.name
        );
    }
    compared
}

#[test]
fn every_twin_of_the_core_computes_what_the_core_does() {
    let twins: Vec<_> = brdf::terms()
        .iter()
        .filter(|it| it.wgsl.is_some())
        .collect();
    assert!(twins.len() > 30, "{} twins", twins.len());
    for term in twins {
        let compared = check_twin(term);
        assert!(compared >= 200, "{}: {compared} points", term.name);
    }
}
