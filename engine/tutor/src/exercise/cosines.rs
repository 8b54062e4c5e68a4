//! Cosines that belong to each other: of a light, an eye and H between them.

/// Where the cosines of a point stand among its variables.
///
/// With N·L, N·V and one more of them, the others follow. Drawn each for itself they belong to
/// no three directions, and a function that is right wherever there are directions, such as
/// V·H = (N·L + N·V) / (2·N·H), would be called wrong.
pub(super) struct Cosines {
    n_dot_l: usize,
    n_dot_v: usize,
    n_dot_h: Option<usize>,
    v_dot_h: Option<usize>,
    l_dot_v: Option<usize>,
}

impl Cosines {
    /// The cosines among these names; `None` where they are free of each other.
    pub(super) fn among<'n>(names: impl Iterator<Item = &'n str> + Clone) -> Option<Cosines> {
        let at = |name: &str| names.clone().position(|other| other == name);
        let it = Cosines {
            n_dot_l: at("n_dot_l")?,
            n_dot_v: at("n_dot_v")?,
            n_dot_h: at("n_dot_h"),
            v_dot_h: at("v_dot_h"),
            l_dot_v: at("l_dot_v"),
        };
        (it.n_dot_h.is_some() || it.v_dot_h.is_some() || it.l_dot_v.is_some()).then_some(it)
    }

    /// Moves what follows from N·L and N·V to the nearest place where it does; `false` where
    /// there is none within the ranges (lowest and highest value of each variable).
    pub(super) fn settle(&self, point: &mut [f64], ranges: &[(f64, f64)]) -> bool {
        let (n_dot_l, n_dot_v) = (point[self.n_dot_l], point[self.n_dot_v]);
        let sines = ((1.0 - n_dot_l * n_dot_l) * (1.0 - n_dot_v * n_dot_v))
            .max(0.0)
            .sqrt();
        // Everything as V·H, which is cos of half the angle between light and eye.
        let half = |l_dot_v: f64| (0.5 + 0.5 * l_dot_v).max(0.0).sqrt();
        let mut low = half(n_dot_l * n_dot_v - sines);
        let mut high = half((n_dot_l * n_dot_v + sines).min(1.0));
        let mut narrow = |from: f64, to: f64| {
            low = low.max(from);
            high = high.min(to);
        };
        let sum = n_dot_l + n_dot_v;
        let mut wanted = None;
        if let Some(at) = self.n_dot_h {
            let (from, to) = ranges[at];
            narrow(sum / (2.0 * to), sum / (2.0 * from));
            wanted = Some(sum / (2.0 * point[at]));
        }
        if let Some(at) = self.l_dot_v {
            let (from, to) = ranges[at];
            narrow(half(from), half(to));
            wanted = Some(half(point[at]));
        }
        if let Some(at) = self.v_dot_h {
            narrow(ranges[at].0, ranges[at].1);
            wanted = Some(point[at]);
        }
        // Also false where one of them is no number.
        let v_dot_h = match wanted {
            Some(wanted) if low <= high && wanted.is_finite() => wanted.clamp(low, high),
            _ => return false,
        };
        let mut put = |at: Option<usize>, value: f64| {
            if let Some(at) = at {
                point[at] = f64::from(value as f32);
            }
        };
        put(self.v_dot_h, v_dot_h);
        put(self.n_dot_h, (sum / (2.0 * v_dot_h)).min(1.0));
        put(self.l_dot_v, 2.0 * v_dot_h * v_dot_h - 1.0);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 5] = ["n_dot_l", "n_dot_v", "n_dot_h", "v_dot_h", "l_dot_v"];
    const ANY: [(f64, f64); 5] = [(0.0, 1.0), (0.0, 1.0), (0.0, 1.0), (0.0, 1.0), (-1.0, 1.0)];

    #[track_caller]
    fn settled(mut point: [f64; 5], ranges: [(f64, f64); 5]) -> Option<[f64; 5]> {
        let cosines = Cosines::among(NAMES.into_iter()).expect("cosines");
        cosines.settle(&mut point, &ranges).then_some(point)
    }

    #[test]
    fn what_comes_out_belongs_to_three_directions() {
        for step in 0..4000_u32 {
            let part = |by: u32, of: u32| f64::from(step / by % of) / f64::from(of - 1);
            let (n_dot_l, n_dot_v) = (part(1, 11).max(0.01), part(11, 11).max(0.01));
            let wanted = part(121, 33);
            let point = [n_dot_l, n_dot_v, wanted, wanted, 2.0 * wanted - 1.0];
            let Some([_, _, n_dot_h, v_dot_h, l_dot_v]) = settled(point, ANY) else {
                panic!("no place for {point:?}");
            };
            // Light and eye stand somewhere around the normal.
            let sines = ((1.0 - n_dot_l * n_dot_l) * (1.0 - n_dot_v * n_dot_v)).sqrt();
            let across = l_dot_v - n_dot_l * n_dot_v;
            assert!(across.abs() <= sines + 1e-6, "{point:?}: {l_dot_v}");
            // And H between them.
            let length = (2.0 + 2.0 * l_dot_v).sqrt();
            assert!(
                (v_dot_h - length / 2.0).abs() < 1e-5,
                "{point:?}: {v_dot_h}"
            );
            let between = (n_dot_l + n_dot_v) / length;
            assert!(
                (n_dot_h - between).abs() < 1e-3 * between,
                "{point:?}: {n_dot_h}"
            );
        }
    }

    #[test]
    fn a_range_without_directions_is_left_out() {
        let mut ranges = ANY;
        ranges[2] = (0.5, 1.0);
        // Both graze from the same side: H grazes too, unless they come from opposite sides.
        let Some(point) = settled([0.05, 0.05, 0.9, 1.0, 1.0], ranges) else {
            panic!("they may stand opposite each other");
        };
        assert!(point[2] >= 0.5 - 1e-6, "{point:?}");
        ranges[3] = (0.9, 1.0);
        assert_eq!(settled([0.05, 0.05, 0.9, 1.0, 1.0], ranges), None);
        assert_eq!(settled([0.5, 0.5, f64::NAN, f64::NAN, f64::NAN], ANY), None);
    }

    #[test]
    fn free_cosines_are_left_alone() {
        for names in [
            &["n_dot_l", "n_dot_v", "roughness"][..],
            &["n_dot_h", "v_dot_h"],
            &["n_dot_l", "l_dot_v"],
        ] {
            assert!(Cosines::among(names.iter().copied()).is_none(), "{names:?}");
        }
    }
}
