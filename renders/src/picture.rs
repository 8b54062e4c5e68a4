//! The picture that a learner sees: three panels, the profile below them, and the words.

use crate::canvas::{Align, Canvas, Style};
use crate::chart::{Chart, PlotSpec};
use crate::colour::{DARK, RATIO_STOPS, diverging};
use crate::paint::{Tables, contour_width, panels};
use crate::profile::{HIGHLIGHT_SHARE, Profile};
use crate::sample::Panel;
use crate::shade::Shaded;
use crate::text::{Weight, shorten, wrap};
use crate::visibility::Visibility;
use crate::{Error, Eye, Fingerprint, Light};
use std::ops::Range;

/// Positions and sizes in pixels; all follow the panel's size.
struct Layout {
    size: f32,
    em: f32,
    margin: f32,
    gap: f32,
    width: f32,
}

impl Layout {
    fn of(panel: &Panel) -> Self {
        let size = panel.size as f32;
        let em = (size / 26.0).max(6.0);
        let (margin, gap) = ((1.7 * em).round(), (1.3 * em).round());
        Self {
            size,
            em,
            margin,
            gap,
            width: 3.0 * size + 2.0 * (margin + gap),
        }
    }

    fn chart_height(&self) -> f32 {
        0.74 * self.size
    }

    /// Left edge of a panel.
    fn column(&self, index: usize) -> f32 {
        self.margin + index as f32 * (self.size + self.gap)
    }
}

/// Panels, profile and words.
pub(crate) struct Page<'a> {
    fingerprint: &'a Fingerprint<'a>,
    profile: &'a Profile,
    panel: Panel,
    exposure: f64,
    layout: Layout,
    caption: Vec<String>,
    notes: Vec<String>,
    /// Where the panels begin, and what stands below them.
    top: f32,
    below: f32,
    pub width: usize,
    pub height: usize,
}

impl<'a> Page<'a> {
    pub fn new(
        fingerprint: &'a Fingerprint<'a>,
        panel: Panel,
        profile: &'a Profile,
        exposure: f64,
    ) -> Self {
        let layout = Layout::of(&panel);
        let Layout {
            size,
            em,
            margin,
            width,
            ..
        } = layout;
        let caption = wrap(
            &fingerprint.caption,
            1.05 * em,
            Weight::Regular,
            width - 2.0 * margin,
        );
        let top = (margin + 1.4 * em + caption.len() as f32 * 1.55 * em + 4.2 * em).round();
        let below = top + size + 1.1 * em;
        let notes = notes(fingerprint, profile, exposure);
        let chart = layout.chart_height();
        let height = below + chart + (0.4 + 1.5 * notes.len() as f32) * em + 0.7 * margin;
        Self {
            fingerprint,
            profile,
            panel,
            exposure,
            layout,
            caption,
            notes,
            top,
            below,
            width: width as usize,
            height: height.round() as usize,
        }
    }

    /// The panels' rows that some rows of the page show, and those whose contour reaches there.
    pub fn panel_rows(&self, rows: &Range<usize>) -> (Range<usize>, Range<usize>) {
        let (top, size) = (self.top as usize, self.panel.size);
        let own = |row: usize| row.saturating_sub(top).min(size);
        let reach = contour_width(size).ceil() as usize + 2;
        let shown = own(rows.start)..own(rows.end);
        let needed = shown.start.saturating_sub(reach)..(shown.end + reach).min(size);
        match shown.is_empty() {
            true => (shown.clone(), shown),
            false => (shown, needed),
        }
    }

    /// Draws what the canvas holds of the page. `shaded` starts at the panels' row `first`.
    pub fn draw(
        &self,
        canvas: &mut Canvas,
        (shaded, first): (&Shaded, usize),
        visibility: &Visibility,
        tables: &Tables,
    ) -> Result<(), Error> {
        let Layout {
            size,
            em,
            margin,
            width,
            ..
        } = self.layout;
        let title = shorten(
            &self.fingerprint.title,
            1.7 * em,
            Weight::Bold,
            width - 2.0 * margin,
        );
        let mut y = margin + 1.0 * em;
        let style = Style::new(1.7 * em, Weight::Bold, Align::Left, DARK.ink);
        canvas.text(margin, y, style, &title);
        y += 0.35 * em;
        for line in &self.caption {
            y += 1.55 * em;
            let style = Style::new(1.05 * em, Weight::Regular, Align::Left, DARK.faint);
            canvas.text(margin, y, style, line);
        }

        let (top, below) = (self.top, self.below);
        let columns = [0, 1, 2].map(|index| self.layout.column(index) as usize);
        let top_row = top as usize;
        panels(
            canvas,
            &self.panel,
            (shaded, first),
            columns,
            top_row,
            tables,
        );
        headings(canvas, &self.layout, self.fingerprint, top);
        profile_ticks(canvas, &self.layout, self.fingerprint, top);
        let chart_height = self.layout.chart_height();
        if canvas.holds(below - em, below + chart_height + em) {
            let chart_width = 2.0 * size + self.layout.gap;
            draw_profile(
                canvas,
                (margin, below, chart_width, chart_height),
                em,
                self.fingerprint,
                self.profile,
                self.exposure,
            )?;
        }
        let right = self.layout.column(2);
        colour_bar(canvas, right, below, size, em);
        let (terminator, rim) = self.fingerprint.scene.geometry().lit_along();
        let rows = figures(visibility, terminator > -rim);
        draw_figures(canvas, right, below + 4.6 * em, size, em, &rows);

        let mut y = below + chart_height + 0.2 * em;
        for note in &self.notes {
            y += 1.5 * em;
            let note = shorten(note, 0.95 * em, Weight::Regular, width - 2.0 * margin);
            let style = Style::new(0.95 * em, Weight::Regular, Align::Left, DARK.faint);
            canvas.text(margin, y, style, &note);
        }
        Ok(())
    }
}

fn headings(canvas: &mut Canvas, layout: &Layout, fingerprint: &Fingerprint<'_>, top: f32) {
    let em = layout.em;
    let formula = |expr| fingerprint.library.unicode(expr);
    let columns = [
        ("correct", formula(fingerprint.right), DARK.series[0]),
        ("buggy", formula(fingerprint.wrong), DARK.series[1]),
        (
            "buggy / correct",
            "blue: too dark · orange: too bright · line: equal".to_owned(),
            DARK.ink,
        ),
    ];
    for (index, (name, below, colour)) in columns.into_iter().enumerate() {
        let x = layout.column(index);
        canvas.text(
            x,
            top - 2.05 * em,
            Style::new(1.15 * em, Weight::Bold, Align::Left, colour),
            name,
        );
        let line = shorten(&below, 0.9 * em, Weight::Regular, layout.size);
        canvas.text(
            x,
            top - 0.6 * em,
            Style::new(0.9 * em, Weight::Regular, Align::Left, DARK.faint),
            &line,
        );
    }
}

/// Short lines at the panels' edges where the profile begins and ends.
fn profile_ticks(canvas: &mut Canvas, layout: &Layout, fingerprint: &Fingerprint<'_>, top: f32) {
    let turn = fingerprint.scene.geometry().turn_angle();
    let (across, down) = (turn.cos() as f32, -turn.sin() as f32);
    let half = layout.size / 2.0;
    for index in 0..3 {
        let (x, y) = (layout.column(index) + half, top + half);
        for reach in [half, -half] {
            let at = |reach: f32| (x + reach * across, y + reach * down);
            let inner = reach - reach.signum() * 0.5 * layout.em;
            let ends = [at(inner), at(reach)];
            canvas.stroke(&ends, layout.em / 10.0, DARK.faint, 1.0);
        }
    }
}

fn colour_bar(canvas: &mut Canvas, left: f32, top: f32, width: f32, em: f32) {
    let height = 1.1 * em;
    for column in 0..width as usize {
        let at = (column as f64 + 0.5) / f64::from(width);
        let colour = diverging((2.0 * at - 1.0) * RATIO_STOPS);
        canvas.rect(left + column as f32, top, 1.0, height, colour, 1.0);
    }
    let middle = left + width / 2.0;
    canvas.stroke(
        &[(middle, top), (middle, top + height)],
        (em / 10.0).max(1.0),
        [24, 24, 28],
        1.0,
    );
    let stops = RATIO_STOPS as i32;
    for stop in -stops..=stops {
        let x = left + width * (stop + stops) as f32 / (2 * stops) as f32;
        let factor = 1 << stop.abs();
        let label = match stop {
            0 => "equal".to_owned(),
            _ if stop == -stops => format!("≤ 1/{factor}"),
            _ if stop == stops => format!("≥ {factor}×"),
            _ if stop < 0 => format!("1/{factor}"),
            _ => format!("{factor}×"),
        };
        let align = match stop {
            _ if stop == -stops => Align::Left,
            _ if stop == stops => Align::Right,
            _ => Align::Centre,
        };
        canvas.text(
            x,
            top + height + 1.25 * em,
            Style::new(0.9 * em, Weight::Regular, align, DARK.faint),
            &label,
        );
    }
}

/// A number for people: three significant digits, no needless zeros, no exponent.
fn short(value: f64) -> String {
    if !value.is_finite() {
        return formula::format_number(value, formula::Digits::Significant(3));
    }
    let digits = match value.abs() {
        v if v < 1e-6 => return "0".to_owned(),
        v if v < 1e-4 => return "< 0.0001".to_owned(),
        v if v >= 100.0 => 0,
        v if v >= 10.0 => 1,
        v if v >= 0.1 => 2,
        v if v >= 0.01 => 3,
        _ => 4,
    };
    formula::format_number(value, formula::Digits::Decimals(digits))
}

fn percent(share: f64) -> String {
    format!(
        "{} %",
        formula::format_number(100.0 * share, formula::Digits::Decimals(1))
    )
}

/// The figures that say whether the bug shows: name and value.
fn figures(visibility: &Visibility, has_terminator: bool) -> [(&'static str, String); 7] {
    let (rim_wrong, rim_right) = visibility.rim_over_highlight;
    let (brighter, dimmer) = visibility.changed_8;
    let step = match has_terminator {
        true => short(visibility.terminator_step),
        false => "no terminator".to_owned(),
    };
    [
        (
            "highlight, buggy / correct",
            format!("{}×", short(visibility.ratio_at_highlight)),
        ),
        (
            "lit area that turns brighter",
            percent(visibility.lit_above_one),
        ),
        ("rim (outer 0.4 %) / highlight, correct", short(rim_right)),
        ("rim (outer 0.4 %) / highlight, buggy", short(rim_wrong)),
        ("terminator step / highlight", step),
        ("pixels brighter by > 8/255", percent(brighter)),
        ("pixels dimmer by > 8/255", percent(dimmer)),
    ]
}

fn draw_figures(
    canvas: &mut Canvas,
    left: f32,
    top: f32,
    width: f32,
    em: f32,
    rows: &[(&str, String)],
) {
    let mut y = top;
    for (name, value) in rows {
        canvas.text(
            left,
            y,
            Style::new(em, Weight::Regular, Align::Left, DARK.faint),
            name,
        );
        canvas.text(
            left + width,
            y,
            Style::new(em, Weight::Bold, Align::Right, DARK.ink),
            value,
        );
        y += 1.6 * em;
    }
}

fn draw_profile(
    canvas: &mut Canvas,
    (left, top, width, height): (f32, f32, f32, f32),
    em: f32,
    fingerprint: &Fingerprint<'_>,
    profile: &Profile,
    exposure: f64,
) -> Result<(), Error> {
    let curve = |pick: fn(&crate::ProfilePoint) -> f64| {
        profile
            .points
            .iter()
            .map(|p| (p.position, pick(p) * exposure))
            .collect::<Vec<_>>()
    };
    let geometry = fingerprint.scene.geometry();
    let one_light = fingerprint.scene.lights.len() == 1;
    let (terminator, rim) = geometry.lit_along();
    let spec = PlotSpec {
        x_label: x_label(&fingerprint.scene.lights).to_owned(),
        y_label: "radiance (1 = white)".to_owned(),
        y_log: true,
        series: vec![
            ("correct".to_owned(), curve(|p| p.right)),
            ("buggy".to_owned(), curve(|p| p.wrong)),
        ],
        marks: profile
            .crossings()
            .into_iter()
            .map(|(position, value)| (String::new(), position, value * exposure))
            .collect(),
        ..PlotSpec::default()
    };
    // What happens in the last pixel before rim and terminator would squeeze the rest.
    let inner = |p: &&crate::ProfilePoint| p.n_dot_l > 0.02 && p.n_dot_v > 0.02;
    let shown = || {
        profile
            .points
            .iter()
            .filter(inner)
            .flat_map(|p| [p.right * exposure, p.wrong * exposure])
    };
    let high = shown()
        .filter(|v| v.is_finite())
        .fold(1.0, f64::max)
        .min(100.0);
    let low = shown()
        .filter(|v| *v > 0.0)
        .fold(f64::INFINITY, f64::min)
        .clamp(high * 1e-6, 0.2);
    let chart = Chart {
        spec: &spec,
        theme: &DARK,
        x_range: Some((-1.0, 1.0)),
        y_range: Some((low * 0.8, high * 1.5)),
        bands: if one_light && terminator > -rim {
            vec![(-1.0, terminator.sin(), "not lit".to_owned())]
        } else {
            Vec::new()
        },
        verticals: vec![(geometry.highlight().sin(), "highlight".to_owned())],
        em: f64::from(em),
        widths: &[0.3, 0.16],
        marks_are: "equal",
    };
    chart.on_canvas(
        canvas,
        f64::from(left),
        f64::from(top),
        f64::from(width),
        f64::from(height),
    )
}

/// What the horizontal axis of the profile is, in words.
fn x_label(lights: &[Light]) -> &'static str {
    match lights {
        [only] if only.deg == 0.0 => "position across the sphere, along the equator",
        [only] if only.turn_deg == 0.0 => {
            "position across the sphere, along the equator (the light is on the right)"
        }
        [_] => "position across the sphere, towards the light (on the right here)",
        _ => "position across the sphere, towards the first light (on the right here)",
    }
}

/// The lights in words.
fn lights(lights: &[Light], number: impl Fn(f64) -> String) -> String {
    let near = |light: &Light| match light.distance {
        None => String::new(),
        Some(distance) => format!(", {} radii away", number(distance)),
    };
    match lights {
        [only] => {
            let place = match only.distance {
                None => "distant light",
                Some(_) => "light",
            };
            format!("{place} {}° from the eye{}", number(only.deg), near(only))
        }
        _ => {
            let first: Vec<String> = lights
                .iter()
                .take(3)
                .map(|light| format!("{}°{}", number(light.deg), near(light)))
                .collect();
            let more = if lights.len() > 3 { ", …" } else { "" };
            format!("{} lights: {}{more}", lights.len(), first.join("; "))
        }
    }
}

/// The lines at the foot: scene and exposure.
fn notes(fingerprint: &Fingerprint<'_>, profile: &Profile, exposure: f64) -> Vec<String> {
    let scene = &fingerprint.scene;
    let number = |value: f64| {
        let text = format!("{value:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    let mut line = format!(
        "roughness {} (α = {}) · F₀ = {} · {}",
        number(scene.roughness),
        number(scene.roughness * scene.roughness),
        number(scene.f0),
        lights(&scene.lights, number),
    );
    for (name, value) in &scene.others {
        line.push_str(&format!(" · {name} = {}", number(*value)));
    }
    match scene.eye {
        Eye::Orthographic => line.push_str(" · orthographic eye"),
        Eye::Perspective { distance } => {
            line.push_str(&format!(" · eye {} radii away", number(distance)));
        }
    }
    let share = formula::format_number(100.0 * HIGHLIGHT_SHARE, formula::Digits::Decimals(0));
    let exposure = formula::format_number(exposure, formula::Digits::Significant(3));
    let mut notes = vec![
        line,
        format!(
            "exposure × {exposure}, the same for both: the brightest correct point is at {share} % of white; brighter than white is cut off"
        ),
    ];
    match profile.growth {
        growth if growth.is_endless() => notes.push(format!(
            "at the rim the buggy value grows as 1/(N·V)²: its mean over the disc has no limit, it rises by {} (before exposure) with every doubling of the picture's size",
            formula::format_number(growth.per_doubling, formula::Digits::Significant(2))
        )),
        growth if growth.power > 0.5 => notes.push(
            "at the rim the buggy value grows as 1/(N·V), without bound: the outermost pixels get brighter as the picture gets larger"
                .to_owned(),
        ),
        _ => {}
    }
    notes
}
