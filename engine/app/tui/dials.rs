//! What of a scene can be turned while looking at it: pure state, no keys and no screen.

use renders::Scene;

/// One thing to turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    Roughness,
    /// Angle between the main light and the eye, in degrees.
    Light,
    F0,
    /// In stops, beyond the exposure that suits the correct picture.
    Exposure,
}

impl Quantity {
    pub fn name(self) -> &'static str {
        match self {
            Self::Roughness => "roughness",
            Self::Light => "light",
            Self::F0 => "F0",
            Self::Exposure => "exposure",
        }
    }

    /// Least and greatest value. At roughness 0 the highlight is a point that nobody sees.
    pub fn range(self) -> (f64, f64) {
        match self {
            Self::Roughness => (0.02, 1.0),
            Self::Light => (0.0, 175.0),
            Self::F0 => (0.0, 1.0),
            Self::Exposure => (-10.0, 10.0),
        }
    }

    /// Steps in one unit, and steps in a big step.
    fn steps(self) -> (f64, f64) {
        match self {
            Self::Roughness | Self::F0 => (100.0, 10.0),
            Self::Light => (1.0, 10.0),
            Self::Exposure => (2.0, 4.0),
        }
    }

    /// A value with its unit, for a row of them.
    pub fn written(self, value: f64) -> String {
        match self {
            Self::Roughness | Self::F0 => crate::text::short(value),
            Self::Light => format!("{}°", crate::text::short(value)),
            Self::Exposure if value == 0.0 => "as the lesson".to_owned(),
            Self::Exposure => format!("{value:+} stops"),
        }
    }

    /// The next value of a grid; one that lies between two goes to the nearer in that direction.
    fn stepped(self, value: f64, up: bool, big: bool) -> f64 {
        let (in_a_unit, in_a_big) = self.steps();
        let steps = if big { in_a_big } else { 1.0 };
        let at = value * in_a_unit;
        let next = match up {
            true => (at + 1e-9).floor() + steps,
            false => (at - 1e-9).ceil() - steps,
        };
        let (least, most) = self.range();
        (next / in_a_unit).clamp(least, most)
    }

    fn of(self, scene: &Scene) -> f64 {
        match self {
            Self::Roughness => scene.roughness,
            Self::Light => scene.lights.first().map_or(0.0, |light| light.deg),
            Self::F0 => scene.f0,
            Self::Exposure => 0.0,
        }
    }
}

/// The values of all that can be turned in one picture, and which is chosen.
#[derive(Clone, Debug, PartialEq)]
pub struct Dials {
    lesson: Scene,
    values: Vec<(Quantity, f64)>,
    chosen: usize,
}

impl Dials {
    /// Of a lesson's scene, whose formulas need what `needs` says.
    pub fn new(lesson: Scene, needs: impl Fn(&str) -> bool) -> Self {
        let mut quantities = Vec::new();
        if needs("roughness") || needs("alpha") {
            quantities.push(Quantity::Roughness);
        }
        quantities.push(Quantity::Light);
        if needs("f0") {
            quantities.push(Quantity::F0);
        }
        quantities.push(Quantity::Exposure);
        let value = |quantity: Quantity| (quantity, quantity.of(&lesson));
        Self {
            values: quantities.into_iter().map(value).collect(),
            chosen: 0,
            lesson,
        }
    }

    /// Every quantity with its value, and whether it is the chosen one.
    pub fn rows(&self) -> impl Iterator<Item = (Quantity, f64, bool)> {
        let rows = self.values.iter().enumerate();
        rows.map(|(index, &(quantity, value))| (quantity, value, index == self.chosen))
    }

    /// Chooses the one after or before; stops at the ends.
    pub fn choose(&mut self, next: bool) {
        self.chosen = match next {
            true => (self.chosen + 1).min(self.values.len() - 1),
            false => self.chosen.saturating_sub(1),
        };
    }

    /// Turns the chosen one by a step or a big step.
    pub fn turn(&mut self, up: bool, big: bool) {
        let (quantity, value) = &mut self.values[self.chosen];
        *value = quantity.stepped(*value, up, big);
    }

    /// Back to the lesson's values.
    pub fn reset(&mut self) {
        for (quantity, value) in &mut self.values {
            *value = quantity.of(&self.lesson);
        }
    }

    /// Sets one, where the picture has it.
    pub fn set(&mut self, quantity: Quantity, to: f64) {
        let found = self.values.iter_mut().find(|(known, _)| *known == quantity);
        if let Some((_, value)) = found {
            let (least, most) = quantity.range();
            *value = to.clamp(least, most);
        }
    }

    fn value(&self, wanted: Quantity) -> Option<f64> {
        let found = self.values.iter().find(|(known, _)| *known == wanted);
        found.map(|(_, value)| *value)
    }

    /// The lesson's scene with these values.
    pub fn scene(&self) -> Scene {
        let mut scene = self.lesson.clone();
        scene.roughness = self.value(Quantity::Roughness).unwrap_or(scene.roughness);
        scene.f0 = self.value(Quantity::F0).unwrap_or(scene.f0);
        if let (Some(light), Some(deg)) = (scene.lights.first_mut(), self.value(Quantity::Light)) {
            light.deg = deg;
        }
        scene
    }

    /// Stops beyond the exposure that suits the correct picture.
    pub fn stops(&self) -> f64 {
        self.value(Quantity::Exposure).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What turning makes of a value.
    #[track_caller]
    fn check(quantity: Quantity, from: f64, up: bool, big: bool, to: f64) {
        assert_eq!(quantity.stepped(from, up, big), to, "{quantity:?} {from}");
    }

    #[test]
    fn turning_goes_along_a_grid_and_stops_at_the_ends() {
        use Quantity::{Exposure, F0, Light, Roughness};
        check(Roughness, 0.7, true, false, 0.71);
        check(Roughness, 0.7, false, false, 0.69);
        check(Roughness, 0.29, true, false, 0.3);
        check(Roughness, 0.7, true, true, 0.8);
        check(Roughness, 0.995, true, false, 1.0);
        check(Roughness, 0.345, false, false, 0.34);
        check(Roughness, 0.345, true, false, 0.35);
        check(Roughness, 1.0, true, true, 1.0);
        check(Roughness, 0.02, false, false, 0.02);
        check(F0, 0.04, false, true, 0.0);
        check(Light, 60.0, true, false, 61.0);
        check(Light, 170.0, true, true, 175.0);
        check(Light, 3.0, false, true, 0.0);
        check(Exposure, 0.0, true, false, 0.5);
        check(Exposure, 0.5, false, true, -1.5);
        check(Exposure, 10.0, true, false, 10.0);
    }

    #[test]
    fn only_what_a_picture_has_is_turned_and_reset_brings_the_lesson_back() {
        let lesson = Scene::new(0.7, 0.95, 60.0);
        let mut dials = Dials::new(lesson.clone(), |name| name == "alpha");
        let names: Vec<&str> = dials.rows().map(|row| row.0.name()).collect();
        assert_eq!(names, ["roughness", "light", "exposure"]);
        dials.turn(false, true);
        dials.choose(true);
        dials.turn(true, false);
        dials.choose(true);
        dials.choose(true);
        dials.turn(true, false);
        let scene = dials.scene();
        assert_eq!((scene.roughness, scene.lights[0].deg), (0.6, 61.0));
        assert_eq!((scene.f0, dials.stops()), (0.95, 0.5));
        dials.set(Quantity::F0, 0.5);
        dials.set(Quantity::Roughness, 7.0);
        assert_eq!((dials.scene().f0, dials.scene().roughness), (0.95, 1.0));
        dials.reset();
        assert_eq!((dials.scene(), dials.stops()), (lesson, 0.0));
        assert_eq!(dials.rows().position(|row| row.2), Some(2), "still chosen");
    }
}
