//! Where values stand on an axis, and which of them get a tick.

/// One axis of a chart: a range that is not empty, linear or logarithmic.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    low: f64,
    high: f64,
    log: bool,
}

/// A grid line of an [`Axis`], and what is written beside it (nothing at a minor one).
pub struct Tick {
    /// The value.
    pub at: f64,
    /// The value as it is written, with a true minus sign; empty at a minor line.
    pub label: String,
}

impl Tick {
    /// Width of the grid line in pixels, for labels of size `em`.
    pub(crate) fn weight(&self, em: f64) -> f64 {
        if self.label.is_empty() {
            0.05 * em
        } else {
            0.09 * em
        }
    }
}

impl Axis {
    /// An axis from one value to another; `None` where nothing can stand on it, as a value that is
    /// not positive on a logarithmic one.
    pub fn over(range: (f64, f64), log: bool) -> Option<Self> {
        Self::fit([].into_iter(), log, Some(range), false)
    }

    /// An axis that holds every drawable value, or `range`; `None` where there is none.
    pub(crate) fn fit(
        values: impl Iterator<Item = f64>,
        log: bool,
        range: Option<(f64, f64)>,
        room: bool,
    ) -> Option<Self> {
        let drawable = |v: &f64| v.is_finite() && (!log || *v > 0.0);
        let (mut low, mut high) = match range {
            Some(range) => range,
            None => values
                .filter(drawable)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                    (low.min(v), high.max(v))
                }),
        };
        if !drawable(&low) || !drawable(&high) {
            return None;
        }
        if low >= high {
            // One value only: put it in the middle.
            (low, high) = if log {
                (low / 2.0, high * 2.0)
            } else {
                let pad = 0.5 * low.abs().max(1.0);
                (low - pad, high + pad)
            };
        } else if room && range.is_none() {
            if log {
                let pad = (0.04 * (high.ln() - low.ln())).exp();
                (low, high) = (low / pad, high * pad);
            } else {
                let pad = 0.05 * (high - low);
                // A curve that comes near zero is read against zero.
                low = if low >= 0.0 && low < 0.5 * high {
                    0.0
                } else {
                    low - pad
                };
                high += pad;
            }
        }
        // A range that overflows has no places in it, and neither has one below the smallest
        // numbers.
        let usable = (high - low).is_normal() && (!log || low.is_normal());
        if !usable {
            return None;
        }
        Some(Self { low, high, log })
    }

    /// The same axis with other ends, where they are given; `None` where nothing is between them.
    pub(crate) fn with_ends(self, (low, high): (Option<f64>, Option<f64>)) -> Option<Self> {
        if low.is_none() && high.is_none() {
            return Some(self);
        }
        let range = (low.unwrap_or(self.low), high.unwrap_or(self.high));
        let fits = range.0 < range.1;
        fits.then(|| Self::over(range, self.log))?
    }

    /// The same axis out to the ticks that lie just beyond its ends: a curve that stops short of a
    /// pole is read against a round number all the same.
    pub fn to_ticks(self, count: usize) -> Self {
        if self.log {
            return self;
        }
        let (step, span) = (self.step(count), self.high - self.low);
        let near = |end: f64, tick: f64| match (end - tick).abs() < NEAR * span {
            true => tick,
            false => end,
        };
        Self {
            low: near(self.low, (self.low / step).floor() * step),
            high: near(self.high, (self.high / step).ceil() * step),
            log: false,
        }
    }

    /// Where `value` stands: 0 at the low end, 1 at the high end; NaN where it cannot stand.
    pub fn share(&self, value: f64) -> f64 {
        if self.log {
            if value <= 0.0 {
                return f64::NAN;
            }
            (value.ln() - self.low.ln()) / (self.high.ln() - self.low.ln())
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// Whether `value` lies within the axis.
    pub fn holds(&self, value: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.share(value))
    }

    /// Ticks with at most about `count` labels.
    pub fn ticks(&self, count: usize) -> Vec<Tick> {
        if self.log && self.high / self.low >= 5.0 {
            self.log_ticks(count)
        } else {
            self.linear_ticks(count)
        }
    }

    /// From one tick of a linear axis to the next.
    fn step(&self, count: usize) -> f64 {
        let raw = (self.high - self.low) / count.max(1) as f64;
        let power = 10.0_f64.powf(raw.log10().floor());
        let enough = |step: &f64| *step >= raw * 0.999;
        let step = [1.0, 2.0, 2.5, 5.0, 10.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(enough)
            .unwrap_or(10.0 * power);
        // Parts of a right angle, where they end where the axis does and tens do not.
        let ends_on = |step: f64| [self.low, self.high].iter().all(|end| end % step == 0.0);
        let angle = [15.0, 30.0, 45.0]
            .into_iter()
            .find(|angle| enough(angle) && *angle < 3.0 * raw && ends_on(*angle));
        angle.filter(|_| !ends_on(step)).unwrap_or(step)
    }

    fn linear_ticks(&self, count: usize) -> Vec<Tick> {
        let step = self.step(count);
        let decimals = (0..12)
            .find(|&d| {
                let scaled = step * 10.0_f64.powi(d);
                (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1.0)
            })
            .unwrap_or(0) as usize;
        let first = (self.low / step - 1e-9).ceil() as i64;
        let last = (self.high / step + 1e-9).floor() as i64;
        (first..=last.min(first.saturating_add(200)))
            .map(|i| {
                let at = i as f64 * step;
                Tick {
                    at,
                    label: minus(format!("{at:.decimals$}")),
                }
            })
            .collect()
    }

    /// Ticks at powers of two, where both ends are: such are the sizes of pictures.
    fn doublings(&self, count: usize) -> Option<Vec<Tick>> {
        let power = |end: f64| {
            let exponent = end.log2().round();
            (exponent.exp2() == end && (1.0..=20.0).contains(&exponent)).then_some(exponent as i32)
        };
        let (first, last) = (power(self.low)?, power(self.high)?);
        let every = ((last - first) as usize).div_ceil(count.max(1)).max(1);
        let ticks = (first..=last).step_by(every).map(|exponent| Tick {
            at: f64::from(exponent).exp2(),
            label: (1_i64 << exponent).to_string(),
        });
        Some(ticks.collect())
    }

    fn log_ticks(&self, count: usize) -> Vec<Tick> {
        if let Some(ticks) = self.doublings(count) {
            return ticks;
        }
        let first = (self.low.log10() + 1e-9).floor() as i32;
        let last = (self.high.log10() - 1e-9).ceil() as i32;
        let span = (self.high / self.low).log10();
        let every = span.ceil().max(1.0) as usize;
        let every = every.div_ceil(count.max(1)).max(1) as i32;
        // With few decades the labels 2 and 5 fit in between.
        let between = span * 3.0 <= count as f64 + 2.0;
        // Where decades stand close, the lines between them would be a hatching.
        let minor = every == 1 && span * 2.0 <= count as f64;
        let mut ticks = Vec::new();
        for exponent in first..=last {
            for digit in 1..=9 {
                let at = f64::from(digit) * 10.0_f64.powi(exponent);
                if !self.holds(at) {
                    continue;
                }
                let labelled = match digit {
                    1 => exponent.rem_euclid(every) == 0,
                    2 | 5 => between,
                    _ => false,
                };
                if labelled || minor {
                    let label = if labelled {
                        power(digit, exponent)
                    } else {
                        String::new()
                    };
                    ticks.push(Tick { at, label });
                }
            }
        }
        ticks
    }
}

/// How far beyond an axis's end a tick may lie to become its end, as a share of its length.
const NEAR: f64 = 0.025;

fn minus(text: String) -> String {
    text.replace('-', "\u{2212}")
}

/// `digit`·10^`exponent`, written out where that is short.
fn power(digit: i32, exponent: i32) -> String {
    match exponent {
        0..=4 => (i64::from(digit) * 10_i64.pow(exponent as u32)).to_string(),
        -4..=-1 => format!(
            "{:.*}",
            -exponent as usize,
            f64::from(digit) * 10.0_f64.powi(exponent)
        ),
        _ => {
            let raised: String = exponent
                .to_string()
                .chars()
                .map(|c| match c {
                    '-' => '⁻',
                    '1' => '¹',
                    '2' => '²',
                    '3' => '³',
                    other => char::from_u32('⁰' as u32 + other.to_digit(10).unwrap_or(0))
                        .unwrap_or(other),
                })
                .collect();
            if digit == 1 {
                format!("10{raised}")
            } else {
                format!("{digit}·10{raised}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_labels(low: f64, high: f64, log: bool, count: usize, expected: &[&str]) {
        let axis = Axis::over((low, high), log).expect("a range");
        let labels: Vec<String> = axis
            .ticks(count)
            .into_iter()
            .map(|t| t.label)
            .filter(|l| !l.is_empty())
            .collect();
        assert_eq!(labels, expected);
    }

    #[test]
    fn ticks_are_round_numbers() {
        check_labels(
            0.0,
            1.0,
            false,
            5,
            &["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"],
        );
        check_labels(-1.0, 1.0, false, 4, &["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        check_labels(
            0.0,
            90.0,
            false,
            6,
            &["0", "15", "30", "45", "60", "75", "90"],
        );
        check_labels(
            0.0,
            90.0,
            false,
            9,
            &["0", "10", "20", "30", "40", "50", "60", "70", "80", "90"],
        );
        check_labels(0.0, 45.0, false, 6, &["0", "15", "30", "45"]);
        check_labels(0.0, 100.0, false, 6, &["0", "20", "40", "60", "80", "100"]);
        check_labels(32.0, 512.0, true, 7, &["32", "64", "128", "256", "512"]);
        check_labels(0.01, 100.0, true, 6, &["0.01", "0.1", "1", "10", "100"]);
        check_labels(
            0.1,
            10.0,
            true,
            8,
            &["0.1", "0.2", "0.5", "1", "2", "5", "10"],
        );
        check_labels(1e-8, 1.0, true, 4, &["10⁻⁸", "10⁻⁶", "0.0001", "0.01", "1"]);
    }

    #[test]
    fn an_axis_reaches_the_ticks_that_are_near() {
        let ends = |low, high| {
            let axis = Axis::over((low, high), false);
            let axis = axis.expect("a range").to_ticks(6);
            (axis.low, axis.high)
        };
        assert_eq!(ends(-0.495, 0.998), (-0.5, 1.0));
        assert_eq!(ends(0.02, 0.98), (0.0, 1.0));
        assert_eq!(ends(0.1, 0.9), (0.1, 0.9));
        assert_eq!(ends(0.0, 90.0), (0.0, 90.0));
    }

    #[test]
    fn an_axis_needs_a_value_it_can_show() {
        assert!(Axis::fit([f64::NAN].into_iter(), false, None, true).is_none());
        assert!(Axis::fit([-1.0, 0.0].into_iter(), true, None, true).is_none());
        assert!(Axis::fit([-f64::MAX, f64::MAX].into_iter(), false, None, true).is_none());
        assert!(
            Axis::fit([3.0].into_iter(), false, None, true)
                .is_some_and(|axis| axis.share(3.0) == 0.5)
        );
    }
    #[test]
    fn no_range_makes_ticks_without_end() {
        let extremes = [
            -f64::MAX,
            -1e300,
            -1.0,
            0.0,
            1e-310,
            1e-300,
            1.0,
            1.0 + f64::EPSILON,
            1e20,
            1e300,
            f64::MAX,
        ];
        for low in extremes {
            for high in extremes {
                for log in [false, true] {
                    let axis = Axis::fit([low, high].into_iter(), log, None, true);
                    let ticks = axis.map_or(0, |axis| axis.ticks(8).len());
                    assert!(ticks < 6000, "{low} to {high}: {ticks} ticks");
                }
            }
        }
    }
}
