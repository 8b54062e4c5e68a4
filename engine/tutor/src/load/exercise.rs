//! Reading exercises.

use toml::de::DeValue;

use super::reader::{self, Table, place};
use super::{each, each_some};
use crate::finding::Place;
use crate::lesson::{
    ChoiceOption, Exercise, ExerciseStep, Faded, LookTask, NamedMistake, ShaderTask, Shows,
    SuspectLine, Task, Text, Tolerance, Variable, Worked, WorkedLine,
};

/// The most values a variable may take.
const MOST_VALUES: usize = 10_000;

/// The kinds there are.
const KINDS: [&str; 6] = [
    "numeric",
    "choice",
    "order",
    "find-the-mistake",
    "look",
    "shader",
];

pub fn read(table: &Table<'_, '_>, worked: Option<&Worked>) -> Option<Exercise> {
    let kind = table.text("kind");
    let task = match kind.as_ref().map_or("numeric", |kind| kind.text.as_str()) {
        "numeric" => read_numeric(table, worked),
        "choice" => read_choice(table),
        "order" => read_order(table),
        "find-the-mistake" => read_find_the_mistake(table),
        "look" => read_look(table),
        "shader" => read_shader(table),
        other => {
            let message = format!("`{other}` is not a kind of exercise.");
            let near = reader::nearest(other, KINDS.into_iter());
            let expected = near.map_or_else(|| KINDS.join(", "), str::to_owned);
            table.wrong("kind", "unknown-name", message, &expected);
            // Which keys it should have depends on what was meant.
            for key in [
                "is", "answer", "steps", "option", "item", "line", "source", "function", "offers",
                "solution", "scene", "picture", "shows", "near",
            ] {
                let _ = table.get(key);
            }
            None
        }
    };
    let needs_number = matches!(
        task,
        Some(Task::Numeric { .. } | Task::FindTheMistake { .. } | Task::Shader(_))
    );
    let tolerance = read_tolerance(table, needs_number);
    let exercise = Exercise {
        id: table.need_text("id"),
        title: table.text("title"),
        ask: table.need_text("ask"),
        draw: read_draw(table),
        where_: table.formula("where"),
        tolerance,
        keep: table.count("keep", 15),
        hints: table.texts("hint"),
        after: table.text("after"),
        retest: table.bool("retest").unwrap_or(false),
        mistakes: read_mistakes(table),
        task: task?,
    };
    Some(exercise)
}

/// `[worked.faded]`: the worked example with other numbers.
pub fn read_faded(table: &Table<'_, '_>, lesson: &Text, lines: &[WorkedLine]) -> Faded {
    let rounds = match table.get("rounds") {
        None => vec![1; usize::from(!lines.is_empty())],
        Some(value) => table
            .numbers(value, "`rounds`")
            .unwrap_or_default()
            .into_iter()
            .map(|round| round as usize)
            .collect(),
    };
    if let Some(wrong) = rounds.iter().find(|&&n| n == 0 || n > lines.len()) {
        let message = format!("A round cannot ask for {wrong} of {} lines.", lines.len());
        let expected = format!("numbers from 1 to {}", lines.len());
        table.wrong("rounds", "empty-range", message, &expected);
    }
    let place = table.place;
    let ask = table.text("ask").unwrap_or(Text {
        text: String::new(),
        place,
    });
    let exercise = Exercise {
        id: Text {
            text: format!("{lesson}/worked"),
            place,
        },
        title: None,
        ask,
        draw: read_draw(table),
        where_: table.formula("where"),
        tolerance: read_tolerance(table, true),
        keep: table.count("keep", 15),
        hints: table.texts("hint"),
        after: None,
        retest: false,
        mistakes: read_mistakes(table),
        task: Task::Numeric {
            steps: lines.iter().map(step_of_line).collect(),
        },
    };
    Faded { rounds, exercise }
}

fn step_of_line(line: &WorkedLine) -> ExerciseStep {
    ExerciseStep {
        name: line.name.clone(),
        ask: line.ask.clone(),
        is: line.is.clone(),
    }
}

fn read_numeric(table: &Table<'_, '_>, worked: Option<&Worked>) -> Option<Task> {
    let single = table.has("is");
    let Some(value) = table.get("steps") else {
        if !single {
            table.missing("is", "`is = \"…\"` or `steps = […]`");
        }
        let ask = table.text("answer");
        let is = table.formula("is")?;
        let name = Text {
            text: "answer".to_owned(),
            place: is.text.place,
        };
        return Some(Task::Numeric {
            steps: vec![ExerciseStep { name, ask, is }],
        });
    };
    if single {
        let message = "An exercise has `is` or `steps`, not both.".to_owned();
        table.wrong("is", "both-given", message, "one of them");
    }
    let steps: Vec<ExerciseStep> = match value.get_ref() {
        DeValue::String(name) if name == "worked" => match worked {
            Some(worked) => worked.lines.iter().map(step_of_line).collect(),
            None => {
                let message = "There is no worked example to take the steps from.".to_owned();
                table.wrong("steps", "unknown-name", message, "[worked]");
                return None;
            }
        },
        DeValue::Array(_) => each_some(table, "steps", "A step", |step| {
            Some(ExerciseStep {
                name: step.need_text("name"),
                ask: step.text("ask"),
                is: step.need_formula("is")?,
            })
        }),
        _ => {
            let message = "These are not steps.".to_owned();
            let expected = "\"worked\" or an array of { name, ask, is }";
            table.wrong("steps", "wrong-kind", message, expected);
            return None;
        }
    };
    if steps.is_empty() {
        let message = "An exercise asks for at least one step.".to_owned();
        table.wrong(
            "steps",
            "missing-key",
            message,
            "{ name = \"…\", is = \"…\" }",
        );
        return None;
    }
    Some(Task::Numeric { steps })
}

fn read_choice(table: &Table<'_, '_>) -> Option<Task> {
    let options = each(table, "option", "An option", |option| ChoiceOption {
        text: option.need_text("text"),
        right: option.bool("right").unwrap_or(false),
        says: option.text("says"),
        mistake: option.text("mistake"),
    });
    let right = options.iter().filter(|option| option.right).count();
    if right != 1 || options.len() < 2 {
        let message = format!(
            "A choice has exactly one right option, and at least one other; here {right} of {} \
             are right.",
            options.len()
        );
        table.wrong("option", "choice", message, "right = true on one option");
        return None;
    }
    Some(Task::Choice { options })
}

fn read_order(table: &Table<'_, '_>) -> Option<Task> {
    let items = table.texts("item");
    if items.len() < 2 || items.len() > 9 {
        let message = format!("An order has 2 to 9 items; here are {}.", items.len());
        table.wrong("item", "order", message, "item = [\"first\", \"second\"]");
        return None;
    }
    Some(Task::Order { items })
}

fn read_find_the_mistake(table: &Table<'_, '_>) -> Option<Task> {
    let source = table.text("source");
    let lines = each_some(table, "line", "A line", |line| {
        let (name, says) = (line.need_text("name"), line.text("says"));
        let wrong = line.bool("wrong").unwrap_or(line.has("right"));
        let right = line.formula("right");
        if wrong && right.is_none() && !line.has("right") {
            line.missing("right", "right = \"what the line should compute\"");
        }
        Some(SuspectLine {
            name,
            is: line.need_formula("is")?,
            right,
            says,
        })
    });
    let wrong = lines.iter().filter(|line| line.right.is_some()).count();
    if wrong != 1 {
        let message = format!("Exactly one line is wrong; here are {wrong}.");
        table.wrong(
            "line",
            "find-the-mistake",
            message,
            "wrong = true, right = \"…\"",
        );
        return None;
    }
    Some(Task::FindTheMistake { lines, source })
}

fn read_look(table: &Table<'_, '_>) -> Option<Task> {
    if table.bool("retest") == Some(true) {
        let message = "A picture has no fresh numbers: it is not asked again.".to_owned();
        table.wrong("retest", "nothing-drawn", message, "no `retest`");
    }
    let shows = match table.text("shows") {
        None => Shows::Either,
        Some(word) => Shows::parse(&word).unwrap_or_else(|| {
            let message = format!("`{word}` is not what a bug does.");
            table.wrong(
                "shows",
                "unknown-name",
                message,
                "brighter, darker or either",
            );
            Shows::Either
        }),
    };
    let near = table.number("near");
    if near.is_some_and(|near| !(near > 0.0 && near <= 1.0)) {
        let message = "The share of the best place lies between 0 and 1.".to_owned();
        table.wrong("near", "empty-range", message, "near = 0.5");
    }
    Some(Task::Look(LookTask {
        picture: table.need_text("picture"),
        shows,
        near: near.unwrap_or(0.5),
    }))
}

fn read_shader(table: &Table<'_, '_>) -> Option<Task> {
    if table.bool("retest") == Some(true) {
        let message = "A shader has no fresh numbers: it is not asked again.".to_owned();
        table.wrong("retest", "nothing-drawn", message, "no `retest`");
    }
    if !table.has("draw") {
        table.missing("draw", "draw = { n_dot_l = \"0.05..1 by 0.01\" }");
    }
    Some(Task::Shader(Box::new(ShaderTask {
        function: table.need_text("function"),
        offers: table.texts("offers"),
        source: table.need_text("source"),
        solution: table.need_text("solution"),
        scene: table.givens("scene"),
        is: table.need_formula("is")?,
    })))
}

fn read_mistakes(table: &Table<'_, '_>) -> Vec<NamedMistake> {
    each_some(table, "mistake", "[[exercise.mistake]]", |mistake| {
        Some(NamedMistake {
            id: mistake.need_text("id"),
            step: mistake.text("step"),
            says: mistake.need_text("says"),
            is: mistake.need_formula("is")?,
        })
    })
}

fn read_tolerance(table: &Table<'_, '_>, needed: bool) -> Tolerance {
    if !table.has("tolerance") {
        if needed {
            table.missing("tolerance", "tolerance = { rel = 0.01 }");
        }
        return Tolerance {
            rel: 0.01,
            place: table.place,
        };
    }
    let place = table.place_of("tolerance");
    let Some(inner) = table.table("tolerance", "`tolerance`") else {
        return Tolerance { rel: 0.01, place };
    };
    if !inner.has("rel") {
        inner.missing("rel", "rel = 0.01");
    }
    let rel = inner.number("rel");
    if rel.is_some_and(|rel| rel <= 0.0 || rel >= 1.0) {
        let message = "A relative tolerance lies between 0 and 1.".to_owned();
        inner.wrong("rel", "empty-range", message, "rel = 0.01");
    }
    let place = inner.place_of("rel");
    inner.finish();
    Tolerance {
        rel: rel.unwrap_or(0.01),
        place,
    }
}

/// `draw` (ranges, lists, numbers) and `given` (numbers) together.
fn read_draw(table: &Table<'_, '_>) -> Vec<Variable> {
    let mut variables: Vec<Variable> = Vec::new();
    for key in ["draw", "given"] {
        for (name, value) in table.entries(key) {
            let values = match value.get_ref() {
                DeValue::String(text) => range(text).map_err(|expected| {
                    let message = format!("`{text}` is not a range.");
                    (message, expected)
                }),
                DeValue::Array(_) => match table.numbers(value, &format!("`{name}`")) {
                    Some(numbers) => Ok(numbers),
                    None => continue,
                },
                _ => match table.as_number(value, &format!("`{name}`")) {
                    Some(number) => Ok(vec![number]),
                    None => continue,
                },
            };
            match values {
                Ok(values) if !values.is_empty() => variables.push(Variable {
                    name,
                    values,
                    place: place(value),
                }),
                Ok(_) => report(table, place(value), "This list is empty.", "[0.1, 0.2]"),
                Err((message, expected)) => report(table, place(value), &message, &expected),
            }
        }
    }
    variables
}

fn report(table: &Table<'_, '_>, at: Place, message: &str, expected: &str) {
    let finding = table.source.finding(at, "range", message);
    table.source.report(finding.expecting(expected));
}

/// The values of "0.2..0.9 by 0.05", each the decimal number nearest to what is written.
fn range(text: &str) -> Result<Vec<f64>, String> {
    const EXPECTED: &str = "a range such as \"0.2..0.9 by 0.05\"";
    let expected = || EXPECTED.to_owned();
    let (from, rest) = text.split_once("..").ok_or_else(expected)?;
    let (to, by) = rest.split_once("by").ok_or_else(expected)?;
    let parts = [from, to, by].map(|part| part.trim());
    let decimals = parts
        .iter()
        .map(|part| part.split_once('.').map_or(0, |(_, digits)| digits.len()))
        .max()
        .unwrap_or(0);
    if decimals > 12 {
        return Err("at most 12 decimals".to_owned());
    }
    let scale = 10_f64.powi(decimals as i32);
    let mut scaled = [0_i64; 3];
    for (part, into) in parts.iter().zip(&mut scaled) {
        let digits = part.strip_prefix('-').unwrap_or(part);
        if digits.is_empty() || !digits.chars().all(|c| c.is_ascii_digit() || c == '.') {
            return Err(expected());
        }
        let value: f64 = part.parse().map_err(|_| expected())?;
        let value = (value * scale).round();
        if value.abs() > 1e15 {
            return Err("smaller numbers".to_owned());
        }
        *into = value as i64;
    }
    let [from, to, by] = scaled;
    if by <= 0 {
        return Err("a step above 0".to_owned());
    }
    if to < from {
        return Err("a range that goes up".to_owned());
    }
    if (to - from) / by >= MOST_VALUES as i64 {
        return Err(format!("at most {MOST_VALUES} values"));
    }
    // Integers over a power of ten give the very number that the decimal text would.
    Ok((0..=(to - from) / by)
        .map(|k| (from + k * by) as f64 / scale)
        .collect())
}

#[cfg(test)]
mod tests {
    use super::range;

    #[track_caller]
    fn check(text: &str, expected: Result<&[f64], &str>) {
        let expected = expected.map(<[f64]>::to_vec).map_err(str::to_owned);
        assert_eq!(range(text), expected);
    }

    #[test]
    fn ranges_hold_the_numbers_as_written() {
        check("0.2..0.4 by 0.05", Ok(&[0.2, 0.25, 0.3, 0.35, 0.4]));
        check("0.1..0.36 by 0.1", Ok(&[0.1, 0.2, 0.3]));
        check("-1..1 by 1", Ok(&[-1.0, 0.0, 1.0]));
        check("5..5 by 1", Ok(&[5.0]));
        check("1..0 by 1", Err("a range that goes up"));
        check("0..1 by 0", Err("a step above 0"));
        check("0..1", Err("a range such as \"0.2..0.9 by 0.05\""));
        check("0..1e9 by 1", Err("a range such as \"0.2..0.9 by 0.05\""));
        check("0..99999 by 1", Err("at most 10000 values"));
    }
}
