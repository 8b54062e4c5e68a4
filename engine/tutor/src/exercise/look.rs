//! "Where would you look?": a place is pointed at, and judged by the ratio there against the
//! best place.
//!
//! What is seen at a place is not computed here: whoever draws the picture says it.

use super::Marking;
use crate::lesson::{Exercise, LookTask, Shows, Task};
use crate::prose::shortest;

/// A place of the ball, and how wrong the bug is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// To the right of the disc's centre, in its radii.
    pub x: f64,
    /// Upwards.
    pub y: f64,
    /// Cosine between normal and light.
    pub n_dot_l: f64,
    /// Cosine between normal and view.
    pub n_dot_v: f64,
    /// Buggy over correct.
    pub ratio: f64,
    /// Its log2, limited where the ratio is 0 or infinite; 0 where nothing is known.
    pub stops: f64,
}

/// What there is to see where somebody pointed, and at the best places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// The place; `None` beside the ball or in the dark.
    pub here: Option<Spot>,
    /// Where the bug is too bright by most, if anywhere.
    pub brightest: Option<Spot>,
    /// Where it is too dark by most, if anywhere.
    pub darkest: Option<Spot>,
}

impl Sight {
    /// The best place for what is looked for.
    pub fn best(&self, shows: Shows) -> Option<Spot> {
        match shows {
            Shows::Brighter => self.brightest,
            Shows::Darker => self.darkest,
            Shows::Either => {
                let all = [self.brightest, self.darkest].into_iter().flatten();
                all.max_by(|a, b| a.stops.abs().total_cmp(&b.stops.abs()))
            }
        }
    }
}

/// The task, where an exercise is one of this kind.
pub fn task(exercise: &Exercise) -> Option<&LookTask> {
    match &exercise.task {
        Task::Look(task) => Some(task),
        _ => None,
    }
}

/// Places that may be named in words.
const NAMED: [(&[&str], (f64, f64)); 5] = [
    (&["centre", "center", "middle"], (0.0, 0.0)),
    (&["right", "right rim", "rim right"], (0.97, 0.0)),
    (&["left", "left rim", "rim left"], (-0.97, 0.0)),
    (&["top", "top rim", "upper rim"], (0.0, 0.97)),
    (&["bottom", "bottom rim", "lower rim"], (0.0, -0.97)),
];

/// The place that somebody typed: two numbers in radii from the centre, to the right and
/// upwards, or one of a few words.
///
/// # Errors
///
/// What to type instead, as a sentence.
pub fn place(typed: &str) -> Result<(f64, f64), String> {
    let help = || {
        "Type two numbers, how far to the right and how far up, such as `0.8 -0.2`: the ball's radius is 1. Or centre, left, right, top, bottom.".to_owned()
    };
    let words = typed.trim().trim_end_matches('.').to_lowercase();
    if let Some((_, at)) = NAMED
        .iter()
        .find(|(names, _)| names.contains(&words.as_str()))
    {
        return Ok(*at);
    }
    let minus = words.replace('−', "-");
    let parts: Vec<&str> = minus
        .split(|c: char| c.is_whitespace() || c == ';' || c == '(' || c == ')')
        .map(|part| part.trim_matches(','))
        .filter(|part| !part.is_empty())
        .collect();
    // "0.8,-0.2" is two numbers; "0,8" alone is none.
    let parts: Vec<&str> = match parts.as_slice() {
        [one] => one.split(',').collect(),
        _ => parts,
    };
    let [x, y] = parts.as_slice() else {
        return Err(help());
    };
    let number = |text: &str| text.replace(',', ".").parse::<f64>().ok();
    match (number(x), number(y)) {
        (Some(x), Some(y)) if x.is_finite() && y.is_finite() => match x.hypot(y) < 1.0 {
            true => Ok((x, y)),
            false => Err("That is beside the ball, whose radius is 1.".to_owned()),
        },
        _ => Err(help()),
    }
}

/// Marks a place by what is to be seen there.
pub fn mark(task: &LookTask, sight: &Sight) -> Marking {
    let Some(best) = sight.best(task.shows) else {
        return Marking::Invalid {
            says: "The bug does not show anywhere on this ball.".to_owned(),
        };
    };
    let Some(here) = sight.here else {
        return Marking::Invalid {
            says: "No light falls there: there is nothing to see. Point at a lit place.".to_owned(),
        };
    };
    let way = match task.shows {
        Shows::Brighter => 1.0,
        Shows::Darker => -1.0,
        Shows::Either => best.stops.signum(),
    };
    let share = match task.shows {
        Shows::Either => here.stops.abs() / best.stops.abs(),
        _ => way * here.stops / best.stops.abs(),
    };
    if share >= task.near {
        return Marking::Correct;
    }
    let mut says = format!(
        "Here the buggy value is {} times the correct one, at N·L = {} and N·V = {}",
        round(here.ratio),
        round(here.n_dot_l),
        round(here.n_dot_v),
    );
    says.push_str(&match share {
        share if share > task.near / 2.0 && task.shows != Shows::Either => {
            format!(
                "; it is the right side, but there is a place with {}.",
                round(best.ratio)
            )
        }
        share if share < -0.02 && way > 0.0 => {
            ": too dark, and asked is where it is too bright.".to_owned()
        }
        share if share < -0.02 => ": too bright, and asked is where it is too dark.".to_owned(),
        _ => format!(". There is a place with {}.", round(best.ratio)),
    });
    Marking::Wrong { says }
}

/// Three digits are enough to compare with.
fn round(value: f64) -> String {
    if !value.is_finite() {
        return "infinitely many".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = 2 - value.abs().log10().floor() as i32;
    let scale = 10_f64.powi(digits.clamp(0, 12));
    shortest((value * scale).round() / scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_place(typed: &str, expected: Option<(f64, f64)>) {
        assert_eq!(place(typed).ok(), expected, "{typed}");
    }

    #[test]
    fn a_place_is_two_numbers_or_a_word() {
        check_place("0.8 -0.2", Some((0.8, -0.2)));
        check_place(" ( 0.8, −0.2 ) ", Some((0.8, -0.2)));
        check_place("0.8,-0.2", Some((0.8, -0.2)));
        check_place("0,8 0,1", Some((0.8, 0.1)));
        check_place("Centre.", Some((0.0, 0.0)));
        check_place("left rim", Some((-0.97, 0.0)));
        check_place("0.8", None);
        check_place("1 2 3", None);
        check_place("inf 0", None);
        check_place("nan 0", None);
        check_place("0.8 0.8", None);
        check_place("over there", None);
        check_place("", None);
    }

    fn spot(stops: f64) -> Spot {
        Spot {
            x: 0.0,
            y: 0.0,
            n_dot_l: 0.5,
            n_dot_v: 0.25,
            ratio: stops.exp2(),
            stops,
        }
    }

    #[track_caller]
    fn check(shows: Shows, here: f64, result: &str, says: &str) {
        let place = crate::Place::default();
        let task = LookTask {
            picture: crate::lesson::Text {
                text: "x".into(),
                place,
            },
            shows,
            near: 0.5,
        };
        let sight = Sight {
            here: Some(spot(here)),
            brightest: Some(spot(4.0)),
            darkest: Some(spot(-2.0)),
        };
        let marking = mark(&task, &sight);
        assert_eq!(marking.result(), result);
        assert!(marking.says().contains(says), "{}", marking.says());
    }

    #[test]
    fn a_place_is_marked_by_the_ratio_there() {
        check(Shows::Brighter, 2.0, "correct", "");
        check(Shows::Brighter, 1.5, "wrong", "the right side");
        check(Shows::Brighter, 0.0, "wrong", "1 times the correct one");
        check(Shows::Brighter, -2.0, "wrong", "too dark, and asked");
        check(Shows::Darker, -1.0, "correct", "");
        check(Shows::Darker, 4.0, "wrong", "too bright, and asked");
        check(Shows::Either, 2.5, "correct", "");
        check(Shows::Either, -2.0, "correct", "");
        check(Shows::Either, -1.0, "wrong", "There is a place with 16");
    }

    #[test]
    fn where_nothing_is_seen_costs_nothing() {
        let text = crate::lesson::Text {
            text: "x".into(),
            place: crate::Place::default(),
        };
        let task = LookTask {
            picture: text,
            shows: Shows::Either,
            near: 0.5,
        };
        let dark = Sight {
            here: None,
            brightest: Some(spot(1.0)),
            darkest: None,
        };
        assert_eq!(mark(&task, &dark).result(), "invalid");
        let nowhere = Sight {
            here: Some(spot(0.0)),
            brightest: None,
            darkest: None,
        };
        assert_eq!(mark(&task, &nowhere).result(), "invalid");
    }
}
