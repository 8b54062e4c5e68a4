//! Single precision against double precision at hard points, in ulps.

use brdf::{Param, term, terms};

/// Numbers that follow from a seed (SplitMix64).
struct Numbers(u64);

impl Numbers {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A hard value for a parameter: close to its ends more often than not.
    fn hard(&mut self, param: &Param) -> f32 {
        let (low, high) = match param.name {
            "alpha" | "roughness" | "alpha_x" | "alpha_y" => (1e-4, 1.0),
            name if name.contains("_dot_") && param.range.0 >= 0.0 => (1e-6, 1.0),
            _ => param.range,
        };
        let span = high - low;
        let x = match (self.unit() * 4.0) as u32 {
            0 => low + span * self.unit(),
            1 => low + span * (1e-7f64).powf(self.unit()),
            2 => high - span * (1e-8f64).powf(self.unit()),
            _ if low > 0.0 => low * (high / low).powf(self.unit()),
            _ => 0.5 * (low + high) + span * (self.unit() - 0.5) * (1e-8f64).powf(self.unit()),
        };
        (x as f32).clamp(low as f32, high as f32)
    }
}

/// Distance in units of the last place of the truth in single precision.
fn ulps(value: f32, truth: f64) -> f64 {
    if f64::from(value) == truth || (value.is_infinite() && truth.abs() > f64::from(f32::MAX)) {
        return 0.0;
    }
    let exponent = truth.abs().max(f64::from(f32::MIN_POSITIVE)).log2().floor();
    (f64::from(value) - truth).abs() / (exponent - 23.0).exp2()
}

fn worst(name: &str, points: u32) -> (f64, Vec<f32>) {
    let term = term(name).unwrap_or_else(|| panic!("no term {name}"));
    let mut numbers = Numbers(1);
    let mut worst = (0.0, Vec::new());
    for _ in 0..points {
        let args: Vec<f32> = term
            .params
            .iter()
            .map(|param| numbers.hard(param))
            .collect();
        let wide: Vec<f64> = args.iter().map(|&x| f64::from(x)).collect();
        let error = ulps((term.f32)(&args), (term.f64)(&wide));
        if error > worst.0 || error.is_nan() {
            worst = (error, args);
        }
    }
    worst
}

/// Terms that single precision cannot hold to 12 ulps, with what they reach and why.
const WIDER: [(&str, f64); 3] = [
    // The correction and Schlick cancel where F is 0.
    ("f_lazanyi", 25.0),
    // Differences that vanish in the model itself.
    ("diffuse_oren_nayar_full", 1e9),
    ("diffuse_eon", 25.0),
];

#[test]
fn single_precision_is_close() {
    let mut bad = Vec::new();
    for term in terms().iter().filter(|term| term.cost < 10_000) {
        let bound = WIDER
            .iter()
            .find(|row| row.0 == term.name)
            .map_or(12.0, |row| row.1);
        let (error, at) = worst(term.name, 20_000);
        println!("{:26} {error:9.2}  {at:?}", term.name);
        if error > bound || error.is_nan() {
            bad.push(format!("{}: {error:.1} ulps at {at:?}", term.name));
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}
