//! An answer under review as lines: who, what, why it is here, and the points of the rubric.

use tutor::judge::Verdict;
use tutor::prose::Tone;
use tutor::review::{Point, Review};

use crate::text::{self, Piece, Pieces, Role};

/// Everything on the sheet, no line wider than `width`.
pub fn lines(review: &Review, width: usize) -> Vec<Pieces> {
    let Some(waiting) = review.current() else {
        return Vec::new();
    };
    let explanation = &waiting.explanation;
    let told = match explanation.self_marked.is_some() {
        true => format!("marked himself: {}", explanation.told()),
        false => format!("was told: {}", explanation.told()),
    };
    let mut lines = plain(
        &format!(
            "{} · {} · try {} · {told}",
            waiting.learner, explanation.item, explanation.attempt
        ),
        width,
        Role::Strong,
    );
    lines.extend(plain(waiting.rubric.prompt.trim(), width, Role::Emph));
    lines.push(Vec::new());
    let marks: Vec<(usize, usize, Tone)> = review
        .points()
        .iter()
        .filter_map(|point| {
            let (start, end) = point.quote?;
            Some((start, end, tone(point)))
        })
        .collect();
    let whole = explanation.whole();
    let answer = text::wrap(&text::quoted(&whole, &marks), width.saturating_sub(2));
    lines.extend(answer.into_iter().map(|mut line| {
        line.insert(0, Piece::new("│ ", Role::Text));
        line
    }));
    for (asked, reply) in &explanation.replies {
        let words = format!("“{reply}” is what came back to: {asked}");
        lines.extend(plain(&words, width, Role::Emph));
    }
    lines.push(Vec::new());
    let mut why = waiting.reason.sentence().to_owned();
    if !explanation.disputed.is_empty() {
        why.push_str(&format!(
            " It is about {}.",
            explanation.disputed.join(", ")
        ));
    }
    lines.extend(plain(&why, width, Role::Text));
    lines.extend(points(review, width));
    lines
}

/// The points of the rubric as they stand, and the verdict that follows.
pub fn points(review: &Review, width: usize) -> Vec<Pieces> {
    let Some(waiting) = review.current() else {
        return Vec::new();
    };
    let whole = waiting.explanation.whole();
    let mut lines = Vec::new();
    for (place, point) in review.points().iter().enumerate() {
        let sign = match (point.said, point.is_misconception) {
            (None, _) => "?",
            (Some(true), false) => "✓",
            (Some(true), true) => "✗",
            (Some(false), _) => "·",
        };
        let kind = match (point.is_misconception, point.weighs) {
            (false, true) => "",
            (false, false) => " (welcome)",
            (true, true) => " (wrong)",
            (true, false) => " (slip)",
        };
        let quote = point
            .quote
            .and_then(|(start, end)| whole.get(start..end))
            .map_or_else(String::new, |quote| format!("“{quote}”"));
        let before = format!("{:>2} {sign} ", place + 1);
        let room = width.saturating_sub(before.chars().count());
        let words = [
            Piece::new(point.says.as_str(), Role::Text),
            Piece::new(kind, Role::Emph),
            Piece::new(" ", Role::Text),
            Piece::new(quote, Role::Marked(tone(point))),
        ];
        for (index, mut line) in text::wrap(&words, room).into_iter().enumerate() {
            let lead = match index {
                0 => before.clone(),
                _ => " ".repeat(before.chars().count()),
            };
            line.insert(0, Piece::new(lead, Role::Strong));
            lines.push(line);
        }
    }
    lines.push(vec![
        Piece::new("   = ", Role::Strong),
        Piece::new(review.follows().as_str(), Role::Strong),
    ]);
    lines
}

/// The sign of a verdict.
pub fn tone_of(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Pass => Tone::Good,
        Verdict::Partial => Tone::Near,
        Verdict::Fail => Tone::Bad,
        Verdict::Unsure => Tone::Info,
    }
}

fn tone(point: &Point) -> Tone {
    match (point.said, point.is_misconception) {
        (None, _) => Tone::Info,
        (_, true) => Tone::Bad,
        (_, false) => Tone::Good,
    }
}

fn plain(words: &str, width: usize, role: Role) -> Vec<Pieces> {
    text::wrap(&[Piece::new(words, role)], width)
}
