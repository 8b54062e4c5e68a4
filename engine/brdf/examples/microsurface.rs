//! Hammon's simulation of 2017, repeated: `cargo run --release -p brdf --example microsurface`.

#[path = "../tests/hammon/mod.rs"]
mod hammon;

use brdf::Ggx;
use brdf::walk::{Facets, Split, walk};
use hammon::{F0, Numbers, fit, lost, split_of_the_slides, view, views, walk_of_the_slides};

const VIEWS: u32 = 32;
const WALKS: u32 = 40_000;
const ROUGHNESS: [f64; 8] = [0.1, 0.25, 0.4, 0.5, 0.6, 0.75, 0.9, 1.0];

/// Average over the views.
fn mean(mut of: impl FnMut(f64) -> f64) -> f64 {
    views(VIEWS).map(&mut of).sum::<f64>() / f64::from(VIEWS)
}

fn mirrors() {
    println!("Share of the light that single scattering between mirrors loses, 1 - E");
    println!(
        "({} walks each, ± one standard error; the rest by quadrature)\n",
        VIEWS * WALKS
    );
    println!("               seen from above            at 60 degrees              all around");
    println!("rough  alpha   walks            exact     walks            exact     walks   exact");
    for roughness in ROUGHNESS {
        let alpha = roughness * roughness;
        print!("{roughness:.2}  {alpha:.4}");
        let mut numbers = Numbers(1);
        let mut more_than_one = |cos: f64, walks: u32| {
            let mut walk = || {
                walk(Ggx::new(alpha), Facets::Mirror, view(cos), || {
                    numbers.unit()
                })
            };
            let more = (0..walks)
                .filter_map(|_| walk())
                .filter(|exit| exit.bounces > 1);
            more.count() as f64 / f64::from(walks)
        };
        for cos in [1.0, 0.5] {
            let share = more_than_one(cos, VIEWS * WALKS);
            let error = (share * (1.0 - share) / f64::from(VIEWS * WALKS)).sqrt();
            print!("  {share:.5} ±{error:.5} {:.5}", lost(cos, alpha));
        }
        let walks = mean(|cos| more_than_one(cos, WALKS));
        println!("  {walks:.5} {:.5}", mean(|cos| lost(cos, alpha)));
    }
}

fn coated() {
    println!(
        "\n\nFacets under a coat with F0 = {F0} over a white base: how often light was let in"
    );
    println!(
        "(average over all views, standard error below 0.0005; multi for albedo 1 and for 0.5)\n"
    );
    println!(
        "               walks here                   slides' walk    published fit  fit/walks"
    );
    println!(
        "rough  alpha   mirror single multi  (0.5)   single multi    single multi   single multi"
    );
    for roughness in ROUGHNESS {
        let alpha = roughness * roughness;
        let (mut sums, mut numbers) = ([0.0; 8], Numbers(2));
        for cos in views(VIEWS) {
            let split = Split::new(Ggx::new(alpha), F0, view(cos), WALKS, || numbers.unit());
            let printed = split_of_the_slides(alpha, view(cos), WALKS, &mut numbers);
            let fitted = fit(cos, alpha);
            let new = [
                split.specular,
                split.single(),
                split.multi(1.0),
                split.multi(0.5),
                printed[1],
                printed[2],
                fitted[0],
                fitted[1],
            ];
            sums.iter_mut()
                .zip(new)
                .for_each(|(sum, new)| *sum += new / f64::from(VIEWS));
        }
        let [mirror, single, multi, darker, s, m, fs, fm] = sums;
        println!(
            "{roughness:.2}  {alpha:.4}  {mirror:.4} {single:.4} {multi:.4} {darker:.4}   {s:.4} {m:.4}   {fs:.4} {fm:.4}   {:5.3} {:6.3}",
            fs / single,
            fm / multi
        );
    }
}

fn shape() {
    const SIDE: usize = 12;
    println!(
        "\n\nHow far the fit is from the walks, direction by direction, for a base of albedo 0.5:"
    );
    println!("the sum of |fit - walks| over the diffuse light\n");
    println!("rough  alpha   walks here  slides' walk  noise: two runs of the walks");
    for roughness in ROUGHNESS {
        let alpha = roughness * roughness;
        let bin = |l: [f64; 3]| {
            let side = SIDE as f64;
            let phi = l[1].atan2(l[0]).abs() / std::f64::consts::PI;
            let at = |x: f64| ((x * side) as usize).min(SIDE - 1);
            at(l[2] * l[2]) * SIDE + at(phi)
        };
        let mut off = [0.0; 3];
        let mut light = 0.0;
        for cos in [0.2, 0.5, 0.8, 0.95] {
            let v = view(cos);
            let mut histogram = |kind: usize| {
                let mut bins = vec![0.0; SIDE * SIDE];
                let mut numbers = Numbers(kind as u64 + 3);
                for _ in 0..10 * WALKS {
                    let (inside, l) = if kind < 2 {
                        let facets = Facets::Coated {
                            f0: F0,
                            albedo: 1.0,
                        };
                        match walk(Ggx::new(alpha), facets, v, || numbers.unit()) {
                            Some(exit) => (exit.diffuse, exit.l),
                            None => continue,
                        }
                    } else {
                        let (_, inside, l) = walk_of_the_slides(alpha, F0, v, &mut numbers);
                        (inside, l)
                    };
                    if inside > 0 {
                        bins[bin(l)] += 0.5f64.powi(inside as i32) / f64::from(10 * WALKS);
                    }
                }
                bins
            };
            let [here, again, printed] = [0, 1, 2].map(&mut histogram);
            // The fit at points spread over the bins.
            let mut fitted = vec![0.0; SIDE * SIDE];
            const FINE: usize = 8 * SIDE;
            for i in 0..FINE {
                let z = ((i as f64 + 0.5) / FINE as f64).sqrt();
                for j in 0..FINE {
                    let phi = std::f64::consts::PI * (j as f64 + 0.5) / FINE as f64;
                    let [x, ..] = view(z);
                    let l = [x * phi.cos(), x * phi.sin(), z];
                    let l_dot_v = l[0] * v[0] + z * v[2];
                    fitted[bin(l)] += brdf::diffuse_hammon(z, cos, l_dot_v, alpha, 0.5)
                        * std::f64::consts::PI
                        / (FINE * FINE) as f64;
                }
            }
            light += here.iter().sum::<f64>();
            for (i, other) in [&fitted, &fitted, &again].into_iter().enumerate() {
                let from = if i == 1 { &printed } else { &here };
                off[i] += from
                    .iter()
                    .zip(other)
                    .map(|(a, b)| (a - b).abs())
                    .sum::<f64>();
            }
        }
        let [here, printed, noise] = off.map(|off| off / light);
        println!("{roughness:.2}  {alpha:.4}  {here:11.4}  {printed:12.4}  {noise:.4}");
    }
}

fn main() {
    mirrors();
    coated();
    shape();
}
