//! Reading tables and plots.

use formula::Digits;

use super::each_some;
use super::reader::{Table, place};
use crate::lesson::{AxisX, AxisY, Column, Limit, Mark, Plot, Series, Text};

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
    let x = table.table("x", "The plot's `x`").map(|x| {
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
        Some(Series {
            label: series.need_text("label"),
            with: series.givens("with"),
            is: series.need_formula("is")?,
        })
    });
    if series.is_empty() {
        table.missing("series", "series = [{ label = \"…\", is = \"…\" }]");
    }
    Plot {
        id: table.need_text("id"),
        title: table.need_text("title"),
        x: x.unwrap_or_else(|| AxisX {
            name: Text::default(),
            from: 0.0,
            to: 1.0,
            label: Text::default(),
            log: false,
        }),
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
