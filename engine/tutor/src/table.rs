//! Tables: computed from the core, ready to draw.

use formula::Values;

use crate::lesson::{Lesson, Table, values};
use crate::prose::{Block, TableView, plain};

impl Lesson {
    /// The table of that id.
    pub fn table(&self, id: &str) -> Option<Block> {
        let table = self.tables.iter().find(|table| table.id.text == id)?;
        let shared = values(&table.with);
        let words = |text: &str| plain(&self.inline(text, &shared));
        let mut header = Vec::new();
        if !table.row_labels.is_empty() {
            header.push(String::new());
        }
        header.extend(table.rows.iter().map(|(name, _)| self.spelled(name)));
        header.extend(table.columns.iter().map(|column| words(&column.title)));
        let mut rows: Vec<Vec<String>> = (0..row_count(table))
            .map(|row| self.table_row(table, row))
            .collect();
        if let Some(limit) = &table.limit {
            let mut cells = vec![words(&limit.label)];
            let blanks = header.len().saturating_sub(limit.cells.len());
            cells.resize(blanks.max(1), String::new());
            cells.extend(limit.cells.iter().map(|cell| words(cell)));
            rows.push(cells);
        }
        for row in &mut rows {
            row.resize(header.len(), String::new());
        }
        Some(Block::Table(TableView {
            title: words(&table.title),
            header,
            rows,
            note: table
                .note
                .as_ref()
                .map_or_else(Vec::new, |note| self.inline(note, &shared)),
        }))
    }

    fn table_row(&self, table: &Table, row: usize) -> Vec<String> {
        let known = row_values(table, row);
        let mut cells = Vec::new();
        if !table.row_labels.is_empty() {
            cells.push(
                table
                    .row_labels
                    .get(row)
                    .map_or_else(String::new, |label| plain(&self.inline(label, &known))),
            );
        }
        for texts in &table.row_texts {
            cells.push(texts.get(row).cloned().unwrap_or_default());
        }
        for column in &table.columns {
            cells.push(match self.library.eval(&column.is.expr, &known) {
                Ok(value) => formula::format_number(value, column.digits),
                Err(_) => "—".to_owned(),
            });
        }
        cells
    }
}

/// How many computed rows a table has.
pub(crate) fn row_count(table: &Table) -> usize {
    table
        .rows
        .iter()
        .map(|(_, column)| column.len())
        .max()
        .unwrap_or(0)
}

/// The numbers that a row is computed from.
pub(crate) fn row_values(table: &Table, row: usize) -> Values {
    let mut known = values(&table.with);
    for (name, column) in &table.rows {
        if let Some(value) = column.get(row) {
            known.insert(name.text.clone(), *value);
        }
    }
    known
}
