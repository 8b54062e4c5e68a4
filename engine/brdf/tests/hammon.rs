//! Hammon's simulation of 2017, repeated: what single scattering loses, what is mirrored and
//! what was inside, and his fit against it. All seeded; the bounds are five standard errors.

#[path = "hammon/mod.rs"]
mod slides;

use brdf::walk::{Facets, Split, walk};
use brdf::{Ggx, Sampler, f_schlick, g1_ggx, g2_ggx};
use slides::{F0, Numbers, fit, lost, split_of_the_slides, view, views, walk_of_the_slides};

const WALKS: u32 = 100_000;

/// Standard error of a share.
fn error(share: f64, count: f64) -> f64 {
    (share * (1.0 - share) / count).sqrt()
}

#[track_caller]
fn agree(value: f64, truth: f64, error: f64) {
    assert!(
        (value - truth).abs() < 5.0 * error,
        "{value}, not {truth} ± {error}"
    );
}

/// Share of the walks between facets that leave after one bounce.
fn once(alpha: f64, cos: f64, facets: Facets<f64>) -> f64 {
    let mut numbers = Numbers(1);
    let walks =
        (0..WALKS).filter_map(|_| walk(Ggx::new(alpha), facets, view(cos), || numbers.unit()));
    walks.filter(|exit| exit.bounces == 1).count() as f64 / f64::from(WALKS)
}

#[test]
fn single_scattering_loses_what_the_quadrature_says() {
    for alpha in [0.04, 0.25, 0.49, 1.0] {
        for cos in [0.97, 0.7, 0.4, 0.15] {
            let truth = lost(cos, alpha);
            agree(
                1.0 - once(alpha, cos, Facets::Mirror),
                truth,
                error(truth, f64::from(WALKS)),
            );
        }
    }
}

#[test]
fn the_walk_of_the_slides_does_not() {
    // Their normals leave out |T·m|: what leaves at once is not ∫ D G₂/(4 N·V) dl any more.
    for (alpha, cos) in [(0.25, 0.15), (0.49, 0.7), (0.8, 0.15)] {
        let mut numbers = Numbers(1);
        let mut walk = || walk_of_the_slides(alpha, 1.0, view(cos), &mut numbers);
        let once = (0..WALKS).filter(|_| walk().0 == 1).count() as f64 / f64::from(WALKS);
        let truth = lost(cos, alpha);
        let off = (1.0 - once - truth).abs() / error(truth, f64::from(WALKS));
        assert!(off > 20.0, "alpha {alpha}, cosine {cos}: {off}");
    }
}

#[test]
fn diffuse_facets_return_at_once_what_the_integral_says() {
    // ∫∫ D G₂ (m·v)(m·l)/π over normals and lights: visible normals have D G₁(v) m·v/N·V.
    for (alpha, cos) in [(0.3, 0.2), (0.6, 0.6), (1.0, 0.5)] {
        let (v, mut numbers) = (view(cos), Numbers(2));
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..WALKS {
            let mirrored = Ggx::new(alpha)
                .sample(v, [numbers.unit(), numbers.unit()], Sampler::Hemisphere)
                .l;
            let h = [0, 1, 2].map(|i| mirrored[i] + v[i]);
            let length = h.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (z, phi) = (
                1.0 - 2.0 * numbers.unit(),
                std::f64::consts::TAU * numbers.unit(),
            );
            let sin = ((1.0 - z) * (1.0 + z)).sqrt();
            let ball = [sin * phi.cos(), sin * phi.sin(), z];
            let l = [0, 1, 2].map(|i| h[i] / length + ball[i]);
            let n_dot_l = l[2] / l.iter().map(|x| x * x).sum::<f64>().sqrt();
            if n_dot_l > 0.0 {
                let weight = g2_ggx(n_dot_l, cos, alpha) / g1_ggx(cos, alpha);
                sum += weight;
                squares += weight * weight;
            }
        }
        let count = f64::from(WALKS);
        let mean = sum / count;
        let variance = (squares / count - mean * mean) / count;
        let share = once(alpha, cos, Facets::Diffuse { albedo: 1.0 });
        agree(share, mean, (variance + error(share, count).powi(2)).sqrt());
    }
}

#[test]
fn a_flat_coat_splits_by_fresnel() {
    for cos in [0.95, 0.5, 0.2] {
        let mut numbers = Numbers(3);
        let split = Split::new(Ggx::new(1e-4), F0, view(cos), WALKS, || numbers.unit());
        let truth = f_schlick(F0, cos);
        agree(split.specular, truth, error(truth, f64::from(WALKS)));
        // One in ten thousand meets a second facet where it grazes.
        assert!(1.0 - split.specular - split.single() < 1e-3, "{split:?}");
        // And what his fit returns there is that, but for the factor 1 − F0 it leaves out.
        let [single, multi] = fit(cos, 0.0);
        assert!(
            ((1.0 - F0) * single - (1.0 - truth)).abs() < 1e-3,
            "{single}"
        );
        assert_eq!(multi, 0.0);
    }
}

#[test]
fn nothing_is_lost_and_the_albedo_counts_each_visit() {
    let mut numbers = Numbers(4);
    let split = Split::new(Ggx::new(0.6), F0, view(0.5), WALKS, || numbers.unit());
    assert!((split.specular + split.diffuse(1.0) - 1.0).abs() < 1e-12);
    let mut numbers = Numbers(4);
    let facets = Facets::Coated {
        f0: F0,
        albedo: 0.7,
    };
    let walks =
        (0..WALKS).filter_map(|_| walk(Ggx::new(0.6), facets, view(0.5), || numbers.unit()));
    let weight = walks
        .filter(|exit| exit.diffuse > 0)
        .map(|exit| exit.weight)
        .sum::<f64>();
    let mean = weight / f64::from(WALKS);
    assert!((split.diffuse(0.7) - mean).abs() < 1e-3, "{mean}");
}

/// How often light from each of four slices of N·V leaves to each: the slices hold equal
/// shares of cosine-weighted light, so that a reciprocal surface gives a symmetric matrix.
/// The largest difference across the diagonal, in standard errors.
fn asymmetry(mut leave: impl FnMut([f64; 3], &mut Numbers) -> Option<[f64; 3]>) -> f64 {
    const SLICES: usize = 4;
    let mut numbers = Numbers(5);
    let mut counts = [[0.0f64; SLICES]; SLICES];
    for _ in 0..4 * WALKS {
        let squared = numbers.unit();
        if let Some(l) = leave(view(squared.sqrt()), &mut numbers) {
            let slice = |squared: f64| ((squared * SLICES as f64) as usize).min(SLICES - 1);
            counts[slice(squared)][slice(l[2] * l[2])] += 1.0;
        }
    }
    let mut worst = 0.0f64;
    for (i, j) in (0..SLICES).flat_map(|i| (0..i).map(move |j| (i, j))) {
        let (a, b) = (counts[i][j], counts[j][i]);
        worst = worst.max((a - b).abs() / (a + b).sqrt());
    }
    worst
}

#[test]
fn light_takes_the_same_way_back() {
    let facets = Facets::Coated {
        f0: F0,
        albedo: 1.0,
    };
    for (alpha, least) in [(0.25, 0.0), (0.8, 6.0)] {
        let right = asymmetry(|v, numbers| {
            let exit = walk(Ggx::new(alpha), facets, v, || numbers.unit())?;
            (exit.diffuse > 0).then_some(exit.l)
        });
        assert!(right < 5.0, "alpha {alpha}: {right}");
        let printed = asymmetry(|v, numbers| {
            let (_, inside, l) = walk_of_the_slides(alpha, F0, v, numbers);
            (inside > 0).then_some(l)
        });
        assert!(printed > least, "alpha {alpha}: {printed}");
    }
}

/// Averages over the views of what was inside once, and of what was inside more often.
fn averages(of: impl Fn(f64, &mut Numbers) -> [f64; 2]) -> [f64; 2] {
    const VIEWS: u32 = 16;
    let mut numbers = Numbers(6);
    let mut sums = [0.0; 2];
    for cos in views(VIEWS) {
        let shares = of(cos, &mut numbers);
        for i in 0..2 {
            sums[i] += shares[i] / f64::from(VIEWS);
        }
    }
    sums
}

#[test]
fn his_fit_returns_more_than_the_walks() {
    // alpha; single and multi of the walk, of the slides' walk, and of the fit. README.md prints
    // the same from more walks.
    const WALKS: u32 = 10_000;
    for (alpha, right, printed, fitted) in [
        (0.25, [0.887, 0.0755], [0.9035, 0.045], [0.894, 0.091]),
        (0.5625, [0.749, 0.230], [0.8125, 0.1555], [0.8166, 0.2048]),
        (1.0, [0.593, 0.395], [0.684, 0.2965], [0.7085, 0.3641]),
    ] {
        let walked = averages(|cos, numbers| {
            let split = Split::new(Ggx::new(alpha), F0, view(cos), WALKS, || numbers.unit());
            [split.single(), split.multi(1.0)]
        });
        let as_printed = averages(|cos, numbers| {
            let [_, single, multi] = split_of_the_slides(alpha, view(cos), WALKS, numbers);
            [single, multi]
        });
        let of_fit = averages(|cos, _| fit(cos, alpha));
        for i in 0..2 {
            let error = error(right[i], 16.0 * f64::from(WALKS)) + 1e-4;
            agree(walked[i], right[i], error);
            agree(as_printed[i], printed[i], error);
            assert!((of_fit[i] - fitted[i]).abs() < 1e-3, "{of_fit:?}");
        }
    }
}
