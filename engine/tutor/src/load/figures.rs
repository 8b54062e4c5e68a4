//! Reading tables, plots and maps.

use formula::Digits;

use super::each_some;
use super::reader::{Table, place};
use crate::lesson::{AxisX, AxisY, Column, Curve, Limit, Map, Mark, Plot, Series, Text};
use crate::map::Scale;

pub fn read_table(table: &Table<'_, '_>) -> crate::lesson::Table {
    let mut rows = Vec::new();
    let mut row_texts = Vec::new();
    for (name, value) in table.entries("rows") {
        let Some(numbers) = table.numbers(value, &format!("`{name}`")) else {
            continue;
        };
        let texts = value.get_ref().as_array().map_or_else(Vec::new, |array| {
            array
                .iter()
                .map(|entry| table.source.text[entry.span()].trim().to_owned())
                .collect()
        });
        if let Some((first, values)) = rows.first() as Option<&(Text, Vec<f64>)>
            && values.len() != numbers.len()
        {
            let message = format!(
                "`{name}` has {} numbers, but `{first}` has {}.",
                numbers.len(),
                values.len()
            );
            let finding = table
                .source
                .finding(place(value), "rows-differ", message)
                .expecting(format!("{} numbers", values.len()));
            table.source.report(finding);
            continue;
        }
        rows.push((name, numbers));
        row_texts.push(texts);
    }
    if !table.has("rows") {
        table.missing("rows", "rows = { name = [0.5, 1.0] }");
    }
    let columns = each_some(table, "column", "A column", |column| {
        let (title, shown) = (column.need_text("title"), column.texts("shown"));
        let digits = column.count("digits", 17).map(Digits::Decimals);
        let significant = column.count("significant", 17).map(Digits::Significant);
        if digits.is_some() && significant.is_some() {
            let message = "A column has `digits` (decimals) or `significant`, not both.";
            column.wrong(
                "significant",
                "both-given",
                message.to_owned(),
                "one of them",
            );
        }
        Some(Column {
            title,
            digits: digits.or(significant).unwrap_or(Digits::Significant(4)),
            shown,
            is: column.need_formula("is")?,
        })
    });
    if columns.is_empty() {
        table.missing(
            "column",
            "column = [{ title = \"…\", is = \"…\", digits = 2 }]",
        );
    }
    let limit = table.table("limit", "`limit`").map(|limit| {
        let found = Limit {
            label: limit.need_text("label"),
            cells: limit.texts("cells"),
            at: limit.givens("at"),
        };
        limit.finish();
        found
    });
    crate::lesson::Table {
        id: table.need_text("id"),
        title: table.need_text("title"),
        with: table.givens("with"),
        rows,
        row_texts,
        row_labels: table.texts("row_labels"),
        columns,
        limit,
        note: table.text("note"),
    }
}

pub fn read_plot(table: &Table<'_, '_>) -> Plot {
    for axis in ["x", "y"] {
        if !table.has(axis) {
            table.missing(axis, &format!("{axis} = {{ label = \"…\" }}"));
        }
    }
    let x = read_axis(table, "x", "The plot's `x`");
    let y = table.table("y", "The plot's `y`").map(|y| {
        let axis = AxisY {
            label: y.need_text("label"),
            log: y.bool("log").unwrap_or(false),
            from: y.number("from"),
            to: y.number("to"),
        };
        y.finish();
        axis
    });
    let series = each_some(table, "series", "A series", |series| {
        let (label, with) = (series.need_text("label"), series.givens("with"));
        let is = match series.text("means_of") {
            Some(picture) => read_means(series, picture),
            None => Curve::Formula(series.need_formula("is")?),
        };
        Some(Series { label, is, with })
    });
    if series.is_empty() {
        table.missing("series", "series = [{ label = \"…\", is = \"…\" }]");
    }
    Plot {
        id: table.need_text("id"),
        title: table.need_text("title"),
        x,
        y: y.unwrap_or_else(|| AxisY {
            label: Text::default(),
            log: false,
            from: None,
            to: None,
        }),
        with: table.givens("with"),
        series,
        marks: each_some(table, "mark", "A mark", |mark| {
            let (label, with) = (mark.need_text("label"), mark.givens("with"));
            let (x, is) = (mark.need_formula("x"), mark.need_formula("is"));
            Some(Mark {
                label,
                with,
                x: x?,
                is: is?,
            })
        }),
    }
}

/// A curve of measured means: of which panel.
fn read_means(series: &Table<'_, '_>, picture: Text) -> Curve {
    let panel = series.text("panel");
    let wrong = match panel.as_deref() {
        Some("wrong") => true,
        Some("right") => false,
        _ => {
            let message = "A curve of means is of the right panel or of the wrong one.".to_owned();
            let expected = "panel = \"wrong\"";
            match panel {
                Some(_) => series.wrong("panel", "unknown-name", message, expected),
                None => series.missing("panel", expected),
            }
            false
        }
    };
    Curve::Means { picture, wrong }
}

/// An axis along which a variable runs.
fn read_axis(table: &Table<'_, '_>, key: &'static str, what: &str) -> AxisX {
    let axis = table.table(key, what).map(|x| {
        let need = |key: &'static str| {
            if !x.has(key) {
                x.missing(key, &format!("{key} = 1.0"));
            }
            x.number(key).unwrap_or(1.0)
        };
        let axis = AxisX {
            name: x.need_text("name"),
            from: need("from"),
            to: need("to"),
            label: x.need_text("label"),
            log: x.bool("log").unwrap_or(false),
        };
        if x.has("from") && x.has("to") && axis.from >= axis.to {
            let message = "The axis runs from a number to a greater one.".to_owned();
            x.wrong(
                "to",
                "empty-range",
                message,
                &format!("more than {}", axis.from),
            );
        }
        if axis.log && axis.from <= 0.0 {
            let message = "A logarithmic axis starts above 0.".to_owned();
            x.wrong("from", "empty-range", message, "a positive number");
        }
        x.finish();
        axis
    });
    axis.unwrap_or_else(|| AxisX {
        name: Text::default(),
        from: 0.0,
        to: 1.0,
        label: Text::default(),
        log: false,
    })
}

pub fn read_map(table: &Table<'_, '_>) -> Option<Map> {
    for axis in ["x", "y"] {
        if !table.has(axis) {
            let expected =
                format!("{axis} = {{ name = \"…\", from = 0.0, to = 1.0, label = \"…\" }}");
            table.missing(axis, &expected);
        }
    }
    let axes = ["x", "y"].map(|key| read_axis(table, key, &format!("The map's `{key}`")));
    if !table.has("value") {
        table.missing("value", "value = { label = \"…\", from = 0.0, to = 1.0 }");
    }
    let value = table.table("value", "The map's `value`").map(|value| {
        let label = value.need_text("label");
        let (from, to) = (value.number("from"), value.number("to"));
        let scale = match value.text("scale").as_deref() {
            None | Some("linear") => Some(Scale::Linear(from.unwrap_or(0.0), to.unwrap_or(1.0))),
            Some("log") => Some(Scale::Log(from.unwrap_or(0.01), to.unwrap_or(1.0))),
            Some("ratio") => Some(Scale::Ratio),
            Some(other) => {
                let message = format!("No scale is called \"{other}\".");
                value.wrong("scale", "unknown-scale", message, "linear, log or ratio");
                None
            }
        };
        if let Some(Scale::Linear(from, to) | Scale::Log(from, to)) = scale
            && (from >= to || (matches!(scale, Some(Scale::Log(..))) && from <= 0.0))
        {
            let message =
                "The scale runs from a number to a greater one, a logarithmic one from above 0.";
            value.wrong(
                "to",
                "empty-range",
                message.to_owned(),
                "from = 0.01, to = 1.0",
            );
        }
        value.finish();
        (label, scale.unwrap_or(Scale::Ratio))
    });
    let (value_label, scale) = value.unwrap_or((Text::default(), Scale::Ratio));
    let [x, y] = axes;
    for (key, axis) in [("x", &x), ("y", &y)] {
        if axis.log {
            let message = "The axes of a map are linear.".to_owned();
            table.wrong(key, "unknown-key", message, "no `log`");
        }
    }
    Some(Map {
        id: table.need_text("id"),
        title: table.need_text("title"),
        x,
        y,
        value_label,
        scale,
        says: table.text("says"),
        with: table.givens("with"),
        is: table.need_formula("is")?,
    })
}
