//! Blocks as lines of text: wrapping, which the screen shares, and the plain form.

use tutor::prose::{Block, Inline, PlotView, TableView, Tone};
use unicode_width::{UnicodeWidthChar as _, UnicodeWidthStr as _};

/// How a stretch of a line is meant; the screen gives it a style.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    Text,
    Strong,
    Emph,
    Code,
    Math,
    /// The learner's words that decided something.
    Marked(Tone),
}

/// A stretch of one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    pub text: String,
    pub role: Role,
}

impl Piece {
    pub fn new(text: impl Into<String>, role: Role) -> Self {
        Self {
            text: text.into(),
            role,
        }
    }
}

/// One line after wrapping.
pub type Pieces = Vec<Piece>;

/// The sign beside a colour, so that nobody needs to see the colour.
pub fn symbol(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => "✓",
        Tone::Near => "≈",
        Tone::Bad => "✗",
        Tone::Info => "!",
    }
}

/// The inlines with their roles.
pub fn pieces(inlines: &[Inline]) -> Pieces {
    inlines
        .iter()
        .map(|inline| {
            let role = match inline {
                Inline::Text(_) => Role::Text,
                Inline::Strong(_) => Role::Strong,
                Inline::Emph(_) => Role::Emph,
                Inline::Code(_) => Role::Code,
                Inline::Math(_) => Role::Math,
            };
            Piece::new(inline.text(), role)
        })
        .collect()
}

/// The learner's words, with the stretches that decided something marked.
pub fn quoted(text: &str, marks: &[(usize, usize, Tone)]) -> Pieces {
    let mut marks: Vec<_> = marks
        .iter()
        .filter(|(start, end, _)| start < end && text.get(*start..*end).is_some())
        .collect();
    marks.sort_by_key(|(start, ..)| *start);
    let mut pieces = Vec::new();
    let mut at = 0;
    for &&(start, end, tone) in &marks {
        let start = start.max(at);
        if start >= end {
            continue;
        }
        pieces.push(Piece::new(&text[at..start], Role::Text));
        pieces.push(Piece::new(&text[start..end], Role::Marked(tone)));
        at = end;
    }
    pieces.push(Piece::new(&text[at..], Role::Text));
    pieces.retain(|piece| !piece.text.is_empty());
    pieces
}

/// Breaks lines at spaces so that none is wider than `width` columns; a word that is wider is
/// cut. Always at least one line.
pub fn wrap(pieces: &[Piece], width: usize) -> Vec<Pieces> {
    let width = width.max(1);
    let mut wrapper = Wrapper {
        width,
        lines: vec![Vec::new()],
        used: 0,
        word: Vec::new(),
        word_width: 0,
        space: None,
    };
    let letters: Vec<(char, Role)> = pieces
        .iter()
        .flat_map(|piece| piece.text.chars().map(|letter| (letter, piece.role)))
        .collect();
    let text: String = letters.iter().map(|(letter, _)| letter).collect();
    let mut held = held_spaces(&text, width.min(LONGEST_HELD));
    for (letter, role) in letters {
        match letter {
            '\n' => wrapper.new_line(),
            ' ' if held.next() == Some(true) => wrapper.letter(letter, role),
            ' ' | '\t' => wrapper.space(role),
            _ if letter.is_control() => {}
            _ => wrapper.letter(letter, role),
        }
    }
    wrapper.finish_word();
    wrapper.lines
}

/// The widest piece of a formula that is held together at the end of a line.
const LONGEST_HELD: usize = 20;

/// For each space of a text whether the line stays whole there: beside a lone sign of a formula,
/// so that `(n − 1)/(n + 1)` is not read in two halves. Long formulas break all the same.
fn held_spaces(text: &str, widest: usize) -> impl Iterator<Item = bool> + use<> {
    let is_sign = |word: &str| matches!(word, "=" | "+" | "−" | "·" | "/" | "<" | ">" | "≈" | "×");
    let mut held = Vec::new();
    for line in text.split('\n') {
        let words: Vec<&str> = line.split(' ').collect();
        let mut chain = words[0].width();
        for (index, pair) in words.windows(2).enumerate() {
            // A sign is of no use without what follows it.
            let after = match is_sign(pair[1]) {
                true => words.get(index + 2).map_or(0, |word| word.width() + 1),
                false => 0,
            };
            let both = !pair[0].is_empty() && !pair[1].is_empty();
            let holds = both
                && (is_sign(pair[0]) || is_sign(pair[1]))
                && chain + 1 + pair[1].width() + after <= widest;
            chain = pair[1].width() + if holds { chain + 1 } else { 0 };
            held.push(holds);
        }
    }
    held.into_iter()
}

struct Wrapper {
    width: usize,
    lines: Vec<Pieces>,
    used: usize,
    word: Pieces,
    word_width: usize,
    /// The role of a space that stands before the word, if it stays on the line.
    space: Option<Role>,
}

impl Wrapper {
    fn letter(&mut self, letter: char, role: Role) {
        let columns = letter.width().unwrap_or(0);
        if self.word_width + columns > self.width {
            self.finish_word();
        }
        push(&mut self.word, letter, role);
        self.word_width += columns;
    }

    fn space(&mut self, role: Role) {
        self.finish_word();
        if self.used > 0 {
            self.space = Some(role);
        }
    }

    fn new_line(&mut self) {
        self.finish_word();
        self.lines.push(Vec::new());
        self.used = 0;
        self.space = None;
    }

    fn finish_word(&mut self) {
        if self.word.is_empty() {
            return;
        }
        let gap = usize::from(self.space.is_some());
        if self.used > 0 && self.used + gap + self.word_width > self.width {
            self.lines.push(Vec::new());
            self.used = 0;
            self.space = None;
        }
        let line = self.lines.last_mut().expect("there is always a line");
        if let Some(role) = self.space.take() {
            push(line, ' ', role);
            self.used += 1;
        }
        for piece in self.word.drain(..) {
            match line.last_mut() {
                Some(last) if last.role == piece.role => last.text.push_str(&piece.text),
                _ => line.push(piece),
            }
        }
        self.used += self.word_width;
        self.word_width = 0;
    }
}

fn push(pieces: &mut Pieces, letter: char, role: Role) {
    match pieces.last_mut() {
        Some(last) if last.role == role => last.text.push(letter),
        _ => pieces.push(Piece::new(letter, role)),
    }
}

/// Wrapped plain text; `first` and `rest` stand before the first and the other lines.
pub fn wrap_plain(text: &str, width: usize, first: &str, rest: &str) -> Vec<String> {
    indented(&[Piece::new(text, Role::Text)], width, first, rest)
}

fn indented(pieces: &[Piece], width: usize, first: &str, rest: &str) -> Vec<String> {
    let room = width.saturating_sub(first.width().max(rest.width()));
    wrap(pieces, room)
        .into_iter()
        .enumerate()
        .map(|(index, line)| {
            let before = if index == 0 { first } else { rest };
            let text: String = line.into_iter().map(|piece| piece.text).collect();
            format!("{before}{text}").trim_end().to_owned()
        })
        .collect()
}

/// Cells of a table padded to columns, header first; `None` where they do not fit into `width`.
pub fn table_lines(table: &TableView, width: usize) -> Option<Vec<String>> {
    let columns = column_widths(table);
    let total: usize = columns.iter().sum::<usize>() + 2 * columns.len().saturating_sub(1);
    if total > width {
        return None;
    }
    let rule: Vec<String> = columns.iter().map(|width| "─".repeat(*width)).collect();
    let mut lines = vec![padded(&table.header, &columns), rule.join("  ")];
    lines.extend(table.rows.iter().map(|row| padded(row, &columns)));
    Some(lines)
}

/// The width of each column of a table.
pub fn column_widths(table: &TableView) -> Vec<usize> {
    (0..table.header.len())
        .map(|column| {
            let cells = table.rows.iter().filter_map(|row| row.get(column));
            cells
                .chain([&table.header[column]])
                .map(|cell| cell.width())
                .max()
                .unwrap_or(0)
        })
        .collect()
}

/// Whether a column holds numbers, which stand at the right.
fn padded(cells: &[String], columns: &[usize]) -> String {
    let cells: Vec<String> = cells
        .iter()
        .zip(columns)
        .enumerate()
        .map(|(index, (cell, width))| {
            let gap = " ".repeat(width.saturating_sub(cell.width()));
            let words = index == 0 && cell.chars().next().is_some_and(char::is_alphabetic);
            if words {
                format!("{cell}{gap}")
            } else {
                format!("{gap}{cell}")
            }
        })
        .collect();
    cells.join("  ").trim_end().to_owned()
}

/// A plot as a table: its curves at a few places.
pub fn plot_table(plot: &PlotView) -> TableView {
    const PLACES: usize = 7;
    // A long label would push the columns off the page.
    let (head, title) = match plot.x_label.width() > 36 {
        true => (
            "x".to_owned(),
            format!("Plot: {} (x: {})", plot.title, plot.x_label),
        ),
        false => (plot.x_label.clone(), format!("Plot: {}", plot.title)),
    };
    let mut header = vec![head];
    header.extend(plot.series.iter().map(|(label, _)| label.clone()));
    let (from, to) = plot.x_range;
    let even = (0..PLACES).map(|place| {
        let share = place as f64 / (PLACES - 1) as f64;
        if plot.x_log && from > 0.0 {
            from * (to / from).powf(share)
        } else {
            from + (to - from) * share
        }
    });
    // What was measured in few places is shown where it was.
    let places: Vec<f64> = match plot.series.first() {
        Some((_, points)) if points.len() <= PLACES => points.iter().map(|(x, _)| *x).collect(),
        _ => even.collect(),
    };
    let rows = places
        .into_iter()
        .map(|x| {
            let mut row = vec![short(x)];
            row.extend(
                plot.series
                    .iter()
                    .map(|(_, points)| at(points, x).map_or("–".into(), |y| short(settled(y)))),
            );
            row
        })
        .collect();
    let marks: Vec<String> = plot
        .marks
        .iter()
        .map(|(label, x, y)| format!("{label} at {}: {}", short(*x), short(*y)))
        .collect();
    let note = if marks.is_empty() {
        Vec::new()
    } else {
        vec![Inline::Text(marks.join("; ") + ".")]
    };
    TableView {
        title,
        header,
        rows,
        note,
    }
}

/// What rounding alone keeps from being 0, as at the cosine of a right angle.
fn settled(value: f64) -> f64 {
    if value.abs() < 1e-12 { 0.0 } else { value }
}

/// The curve's value at `x`, between its nearest points; `None` outside of them.
fn at(points: &[(f64, f64)], x: f64) -> Option<f64> {
    let slack = 1e-9 * (1.0 + x.abs());
    let after = points.iter().position(|(px, _)| *px >= x - slack)?;
    let (x1, y1) = points[after];
    if (x1 - x).abs() <= slack {
        return Some(y1);
    }
    let (x0, y0) = *points.get(after.checked_sub(1)?)?;
    Some(y0 + (y1 - y0) * (x - x0) / (x1 - x0))
}

/// A number for a plot's axis: three significant digits.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let size = value.abs();
    if !(1e-4..1e5).contains(&size) {
        return format!("{value:.1e}").replace(".0e", "e");
    }
    let decimals = (2 - size.log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Says the numbers of a picture in place of drawing it.
pub trait Describe {
    /// The profile of a fingerprint, or of a learner's own shader, as a table.
    fn picture(&self, lesson: &str, id: &str, own: Option<&str>) -> Option<TableView>;
    /// Some values of a map, as a table.
    fn map(&self, lesson: &str, id: &str) -> Option<TableView>;
}

/// A block as plain lines, none wider than `width` unless it is code.
pub fn plain(block: &Block, width: usize, describe: &dyn Describe) -> Vec<String> {
    let paragraph = |inlines: &[Inline]| indented(&pieces(inlines), width, "", "");
    match block {
        Block::Heading(text) => wrap_plain(text, width, "## ", "   "),
        Block::Paragraph(inlines) => paragraph(inlines),
        Block::List { ordered, items } => items
            .iter()
            .enumerate()
            .flat_map(|(index, item)| {
                let first = if *ordered {
                    format!("{}. ", index + 1)
                } else {
                    "- ".into()
                };
                let rest = " ".repeat(first.len());
                indented(&pieces(item), width, &first, &rest)
            })
            .collect(),
        Block::CodeBlock(code) => code.lines().map(|line| format!("    {line}")).collect(),
        Block::Quote(inlines) => indented(&pieces(inlines), width, "> ", "> "),
        Block::Table(table) => plain_table(table, width),
        Block::Plot(plot) => plain_table(&plot_table(plot), width),
        Block::Map(frame) => {
            let mut lines = wrap_plain(&format!("Map: {}", frame.title), width, "", "");
            lines.extend(paragraph(&frame.caption));
            if let Some(table) = describe.map(&frame.lesson, &frame.id) {
                lines.push(String::new());
                lines.extend(plain_table(&table, width));
            }
            lines
        }
        Block::Picture {
            lesson,
            id,
            title,
            caption,
            own,
        } => {
            let mut lines = wrap_plain(&format!("Picture: {title}"), width, "", "");
            lines.extend(paragraph(caption));
            if let Some(table) = describe.picture(lesson, id, own.as_deref()) {
                lines.push(String::new());
                lines.extend(plain_table(&table, width));
            }
            lines
        }
        Block::Derivation {
            name,
            lines,
            value,
            says,
        } => {
            let mut shown = derivation(name, lines, value)
                .into_iter()
                .flat_map(|(before, line)| {
                    let rest = " ".repeat(before.width() + 2);
                    wrap_plain(&line, width, &before, &rest)
                })
                .collect::<Vec<_>>();
            if !says.is_empty() {
                shown.extend(indented(&pieces(says), width, "  ", "  "));
            }
            shown
        }
        Block::Verdict { tone, title, text } => {
            let mut all = vec![Piece::new(title.trim_end_matches('.'), Role::Strong)];
            all.push(Piece::new(". ", Role::Text));
            all.extend(pieces(text));
            indented(&all, width, &format!("{} ", symbol(*tone)), "  ")
        }
        Block::Checklist { points } => points
            .iter()
            .flat_map(|(point, said)| {
                wrap_plain(point, width, &format!("{} ", tick(*said)), "    ")
            })
            .collect(),
        Block::Quoted { text, marks } => {
            let all: Pieces = quoted(text, marks)
                .into_iter()
                .map(|piece| match piece.role {
                    Role::Marked(tone) => {
                        Piece::new(format!("[{} {}]", symbol(tone), piece.text), piece.role)
                    }
                    _ => piece,
                })
                .collect();
            indented(&all, width, "> ", "> ")
        }
    }
}

/// The box before a point.
pub fn tick(said: Option<bool>) -> &'static str {
    match said {
        Some(true) => "[x]",
        Some(false) => "[ ]",
        None => "[?]",
    }
}

/// The lines of a derivation, each with what stands before it: `D = `, `  = `.
pub fn derivation(name: &str, lines: &[String], value: &str) -> Vec<(String, String)> {
    let mut right: Vec<&str> = lines.iter().map(String::as_str).collect();
    if !value.is_empty() && right.last() != Some(&value) {
        right.push(value);
    }
    let aligned = " ".repeat(name.width());
    right
        .into_iter()
        .enumerate()
        .map(|(index, line)| {
            let left = if index == 0 { name } else { &aligned };
            (format!("{left} = "), line.to_owned())
        })
        .collect()
}

fn plain_table(table: &TableView, width: usize) -> Vec<String> {
    let mut lines = wrap_plain(&table.title, width, "", "");
    match table_lines(table, width) {
        Some(rows) => lines.extend(rows),
        None => {
            for row in &table.rows {
                let cells: Vec<String> = table
                    .header
                    .iter()
                    .zip(row)
                    .map(|(head, cell)| format!("{head}: {cell}"))
                    .collect();
                lines.extend(wrap_plain(&cells.join("; "), width, "- ", "  "));
            }
        }
    }
    if !table.note.is_empty() {
        lines.extend(indented(&pieces(&table.note), width, "", ""));
    }
    lines.retain(|line| !line.is_empty());
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_wrap(text: &str, width: usize, lines: &[&str]) {
        assert_eq!(wrap_plain(text, width, "", ""), lines);
    }

    #[test]
    fn lines_break_at_spaces() {
        check_wrap("", 10, &[""]);
        check_wrap("one two three", 7, &["one two", "three"]);
        check_wrap("one two three", 8, &["one two", "three"]);
        check_wrap("abcdefghij kl", 4, &["abcd", "efgh", "ij", "kl"]);
        check_wrap("N·H = 0.95 α²", 6, &["N·H", "= 0.95", "α²"]);
        // A formula stays whole, unless it is long.
        check_wrap(
            "so (n − 1)/(n + 1) = 0.2",
            17,
            &["so", "(n − 1)/(n + 1)", "= 0.2"],
        );
        check_wrap(
            "the middle, N·V = 1, is",
            18,
            &["the middle,", "N·V = 1, is"],
        );
        check_wrap(
            "a + b + c + d + e + f + g + h",
            24,
            &["a + b + c + d + e", "+ f + g + h"],
        );
        check_wrap("a\nb  c", 9, &["a", "b c"]);
        check_wrap("長い言葉", 4, &["長い", "言葉"]);
        check_wrap("bell\u{7} and \u{1b}[31m", 20, &["bell and [31m"]);
    }

    #[test]
    fn roles_survive_wrapping() {
        let pieces = [
            Piece::new("the ", Role::Text),
            Piece::new("big rim", Role::Strong),
            Piece::new(", yes", Role::Text),
        ];
        let lines = wrap(&pieces, 7);
        assert_eq!(
            lines,
            [
                vec![
                    Piece::new("the ", Role::Text),
                    Piece::new("big", Role::Strong)
                ],
                vec![Piece::new("rim", Role::Strong), Piece::new(",", Role::Text)],
                vec![Piece::new("yes", Role::Text)],
            ]
        );
    }

    #[test]
    fn marks_outside_the_text_are_left_out() {
        let pieces = quoted("dim rim", &[(4, 7, Tone::Good), (5, 99, Tone::Bad)]);
        assert_eq!(
            pieces,
            [
                Piece::new("dim ", Role::Text),
                Piece::new("rim", Role::Marked(Tone::Good))
            ]
        );
    }

    #[track_caller]
    fn check_short(value: f64, shown: &str) {
        assert_eq!(short(value), shown);
    }

    #[test]
    fn axis_numbers_are_short() {
        check_short(0.0, "0");
        check_short(0.05, "0.05");
        check_short(1.0, "1");
        check_short(100.0, "100");
        check_short(0.333333, "0.333");
        check_short(1e-7, "1e-7");
        check_short(-2.5e-6, "-2.5e-6");
    }
}
