//! Points to look at: near the ends of every range, and moved a little.

use super::Precision;
pub(super) use crate::bench::Numbers;
use brdf::Param;

impl Numbers {
    /// One of the first `count` whole numbers.
    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }

    fn hard(&mut self, param: &Param, precision: Precision) -> f64 {
        let (low, high) = range(param);
        let span = high - low;
        let x = match self.below(4) {
            0 => low + span * self.unit(),
            1 => low + span * 1e-7f64.powf(self.unit()),
            2 => high - span * 1e-8f64.powf(self.unit()),
            _ if low > 0.0 => low * (high / low).powf(self.unit()),
            _ => 0.5 * (low + high) + span * (self.unit() - 0.5) * 1e-8f64.powf(self.unit()),
        };
        // Rounded to single precision a bound may fall outside itself.
        let inside = precision.round(x).clamp(low, high);
        precision.round(inside)
    }
}

/// A point of which every argument is likely to be near an end of its range.
pub(super) fn draw(params: &[Param], precision: Precision, numbers: &mut Numbers) -> Vec<f64> {
    loop {
        let drawn = params.iter().map(|param| numbers.hard(param, precision));
        let mut args: Vec<f64> = drawn.collect();
        draw_directions(params, precision, numbers, &mut args);
        if possible(params, precision, &args) {
            return args;
        }
    }
}

/// Moves one argument by a `share` of itself or by a few units in the last place; `None` where
/// that leaves what is possible.
pub(super) fn moved(
    params: &[Param],
    precision: Precision,
    numbers: &mut Numbers,
    share: f64,
    args: &[f64],
) -> Option<Vec<f64>> {
    let mut args = args.to_vec();
    let index = numbers.below(args.len());
    let (low, high) = range(&params[index]);
    let moved = if numbers.unit() < 0.5 {
        precision.step(args[index], numbers.below(17) as i32 - 8)
    } else {
        precision.round(args[index] * (1.0 + share * (2.0 * numbers.unit() - 1.0)))
    };
    args[index] = precision.round(moved.clamp(low, high));
    possible(params, precision, &args).then_some(args)
}

/// Replaces components of vectors by those of directions: at random, close to the horizon,
/// close to the normal, and close to mirrored or equal to the other direction. Where there is
/// a normal of its own, light and view are turned with it.
fn draw_directions(
    params: &[Param],
    precision: Precision,
    numbers: &mut Numbers,
    args: &mut [f64],
) {
    let mut last: Option<[f64; 3]> = None;
    let mut frame = None;
    for i in 0..args.len().saturating_sub(2) {
        let name = params[i].name;
        if name == "n_x" {
            let n =
                direction(2.0 * numbers.unit() - 1.0, numbers.unit()).map(|x| precision.round(x));
            args[i..i + 3].copy_from_slice(&n);
            frame = Some(n);
        }
        if !matches!(name, "l_x" | "v_x") {
            continue;
        }
        let small = 1e-7f64.powf(numbers.unit());
        let z = match numbers.below(3) {
            0 => numbers.unit(),
            1 => small,
            _ => 1.0 - small,
        };
        let mut v = direction(z, numbers.unit());
        v[2] = v[2].max(1e-6);
        if let Some(l) = last.filter(|_| numbers.unit() < 0.6) {
            let sign = if numbers.unit() < 0.5 { -1.0 } else { 1.0 };
            let mut near = |x: f64| x + 1e-8f64.powf(numbers.unit()) * (numbers.unit() - 0.5);
            v = [
                near(sign * l[0]),
                near(sign * l[1]),
                near(l[2]).abs().max(1e-6),
            ];
        }
        let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let v = v.map(|x| x / length);
        last = Some(v);
        let v = frame
            .map_or(v, |n| turned(n, v))
            .map(|x| precision.round(x));
        args[i..i + 3].copy_from_slice(&v);
    }
}

/// A direction with that cosine to the normal, after a share of a turn.
fn direction(z: f64, turn: f64) -> [f64; 3] {
    let (sin, phi) = (((1.0 - z) * (1.0 + z)).sqrt(), std::f64::consts::TAU * turn);
    [sin * phi.cos(), sin * phi.sin(), z]
}

/// A vector of the tangent frame in a world where the normal is `n` (Duff et al. 2017).
fn turned(n: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    let sign = 1f64.copysign(n[2]);
    let a = -1.0 / (sign + n[2]);
    let b = n[0] * n[1] * a;
    let (x, y) = (
        [1.0 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]],
        [b, sign + n[1] * n[1] * a, -n[1]],
    );
    [0, 1, 2].map(|i| x[i] * v[0] + y[i] * v[1] + n[i] * v[2])
}

/// Whether three cosines among the arguments can belong to two directions and a normal, and
/// whether vectors are of length 1 and above the surface.
pub(crate) fn possible(params: &[Param], precision: Precision, args: &[f64]) -> bool {
    let get = |name: &str| {
        let place = params.iter().position(|param| param.name == name)?;
        Some(args[place])
    };
    let vector = |x, y, z| Some([get(x)?, get(y)?, get(z)?]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    // What rounding each component leaves.
    let length_error = 1.75 * (-precision.format().0 as f64 - 1.0).exp2();
    let (n, l, v) = (
        vector("n_x", "n_y", "n_z"),
        vector("l_x", "l_y", "l_z"),
        vector("v_x", "v_y", "v_z"),
    );
    let unit = |v: Option<[f64; 3]>| v.is_none_or(|v| (dot(v, v) - 1.0).abs() < length_error);
    let above = |v: Option<[f64; 3]>| match (n, v) {
        (Some(n), Some(v)) => dot(n, v) >= 1e-6,
        _ => true,
    };
    let cosines = match (get("n_dot_l"), get("n_dot_v"), get("l_dot_v")) {
        (Some(l), Some(v), Some(lv)) => {
            let sines = ((1.0 - l) * (1.0 + l) * (1.0 - v) * (1.0 + v)).sqrt();
            (lv - l * v).abs() <= sines
        }
        _ => true,
    };
    cosines && unit(n) && unit(l) && unit(v) && above(l) && above(v)
}

/// The range to look in: wider than the sensible one, to where the promises end.
fn range(param: &Param) -> (f64, f64) {
    match param.name {
        "alpha" | "alpha_x" | "alpha_y" => (1e-4, 1.0),
        "roughness" => (1e-2, 1.0),
        name if name.contains("_dot_") && param.range.0 >= 0.0 => (1e-6, 1.0),
        "l_dot_v" => (-1.0, 1.0),
        _ => param.range,
    }
}
