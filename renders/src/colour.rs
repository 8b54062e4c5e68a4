//! Colours: the sRGB curve, the diverging map of the ratio, and the two themes.

/// An opaque sRGB colour.
pub type Rgb = [u8; 3];

/// Linear radiance in [0, 1] to the sRGB signal in [0, 1] (IEC 61966-2-1); clipped outside.
pub fn srgb_encode(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * linear.powf(1.0 / 2.4) - 0.055
    }
}

/// The sRGB curve as a table, for the many pixels of a panel: within a quarter of a level.
pub struct EncodeTable {
    signals: Vec<f32>,
    bytes: Vec<u8>,
}

impl Default for EncodeTable {
    fn default() -> Self {
        Self::new()
    }
}

impl EncodeTable {
    const STEPS: usize = 1 << 14;

    /// Computes the table, which costs as much as some thousand pixels.
    pub fn new() -> Self {
        let signal = |i: usize| srgb_encode(i as f64 / Self::STEPS as f64) as f32;
        let signals: Vec<f32> = (0..=Self::STEPS).map(signal).collect();
        let byte = |signal: &f32| (signal * 255.0 + 0.5) as u8;
        Self {
            bytes: signals.iter().map(byte).collect(),
            signals,
        }
    }

    fn step(linear: f32) -> usize {
        (linear.clamp(0.0, 1.0) * Self::STEPS as f32 + 0.5) as usize
    }

    /// The signal in [0, 1]; NaN gives 0.
    pub fn signal(&self, linear: f32) -> f32 {
        self.signals[Self::step(linear)]
    }

    /// The signal as a byte.
    pub fn byte(&self, linear: f32) -> u8 {
        self.bytes[Self::step(linear)]
    }
}

/// The sRGB signal of a byte to linear radiance in [0, 1].
pub fn srgb_decode(byte: u8) -> f64 {
    let signal = f64::from(byte) / 255.0;
    if signal <= 0.040_45 {
        signal / 12.92
    } else {
        ((signal + 0.055) / 1.055).powf(2.4)
    }
}

/// A signal in [0, 1] as a byte.
pub fn to_byte(signal: f64) -> u8 {
    // A NaN becomes 0: a broken formula paints black, it does not stop the picture.
    (signal.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// `log2` of a ratio at which the diverging map saturates: three stops, a factor of 8.
pub const RATIO_STOPS: f64 = 3.0;

/// Blue where the buggy value is lower, white where it is right, orange to brown where it is
/// higher. Blue against orange stays apart under every common kind of colour blindness, and
/// lightness falls on both sides of white, so it survives a grey print too.
///
/// `log2_ratio` is in stops; it saturates at ±[`RATIO_STOPS`].
pub fn diverging(log2_ratio: f64) -> Rgb {
    const STOPS: [(f64, Rgb); 9] = [
        (-1.0, [8, 48, 107]),
        (-0.75, [20, 84, 158]),
        (-0.5, [66, 141, 204]),
        (-0.22, [160, 205, 234]),
        (0.0, [247, 247, 245]),
        (0.22, [252, 208, 150]),
        (0.5, [240, 142, 46]),
        (0.75, [191, 86, 10]),
        (1.0, [112, 44, 6]),
    ];
    let at = if log2_ratio.is_nan() {
        0.0
    } else {
        (log2_ratio / RATIO_STOPS).clamp(-1.0, 1.0)
    };
    let upper = STOPS
        .iter()
        .position(|stop| at <= stop.0)
        .unwrap_or(8)
        .max(1);
    let (low, from) = STOPS[upper - 1];
    let (high, to) = STOPS[upper];
    mix(from, to, (at - low) / (high - low))
}

/// [`diverging`] as a table.
pub struct DivergingTable(Vec<Rgb>);

impl Default for DivergingTable {
    fn default() -> Self {
        Self::new()
    }
}

impl DivergingTable {
    const STEPS: usize = 1 << 10;

    /// Computes the table.
    pub fn new() -> Self {
        let stops = |i: usize| (2.0 * i as f64 / Self::STEPS as f64 - 1.0) * RATIO_STOPS;
        Self((0..=Self::STEPS).map(|i| diverging(stops(i))).collect())
    }

    /// The colour of a ratio in stops.
    pub fn colour(&self, stops: f32) -> Rgb {
        let at = (stops / RATIO_STOPS as f32 + 1.0) / 2.0;
        self.0[(at.clamp(0.0, 1.0) * Self::STEPS as f32 + 0.5) as usize]
    }
}

/// `from` where `t` is 0, `to` where it is 1; mixed in the signal.
pub fn mix(from: Rgb, to: Rgb, t: f64) -> Rgb {
    std::array::from_fn(|i| {
        to_byte((f64::from(from[i]) * (1.0 - t) + f64::from(to[i]) * t) / 255.0)
    })
}

/// The colours that a chart or a picture is drawn with.
#[derive(Clone, Copy, Debug)]
pub struct Theme {
    /// Behind everything.
    pub paper: Rgb,
    /// Behind a panel or the plotted area.
    pub panel: Rgb,
    /// Titles and labels.
    pub ink: Rgb,
    /// Secondary text.
    pub faint: Rgb,
    /// Grid lines.
    pub grid: Rgb,
    /// Curves, in order: for a fingerprint the first is right and the second wrong.
    pub series: [Rgb; 6],
    /// What a chart needs beyond these where it shows more at once.
    pub more: [Rgb; 4],
    /// The line through the best points of a chart.
    pub front: Rgb,
}

/// For pictures: a dark surround, so that the highlight is the brightest thing to see.
pub const DARK: Theme = Theme {
    paper: [19, 21, 26],
    panel: [30, 33, 40],
    ink: [233, 235, 239],
    faint: [157, 163, 174],
    grid: [56, 61, 71],
    series: [
        [101, 184, 240],
        [245, 158, 66],
        [94, 201, 154],
        [226, 132, 190],
        [240, 222, 98],
        [170, 178, 190],
    ],
    more: [
        [120, 210, 230],
        [230, 110, 100],
        [170, 150, 240],
        [180, 210, 110],
    ],
    front: [70, 76, 90],
};

/// For plots on a page: the Okabe-Ito colours, which stay apart for colour-blind readers.
pub const LIGHT: Theme = Theme {
    paper: [255, 255, 255],
    panel: [250, 250, 249],
    ink: [32, 34, 38],
    faint: [98, 103, 112],
    grid: [222, 224, 228],
    series: [
        [0, 114, 178],
        [213, 94, 0],
        [0, 150, 110],
        [190, 95, 150],
        [150, 120, 0],
        [90, 96, 106],
    ],
    more: [[86, 180, 233], [160, 30, 30], [110, 80, 190], [90, 150, 30]],
    front: [232, 222, 190],
};
