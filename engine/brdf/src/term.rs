//! The registry: every formula as data, found by its name.
//!
//! [`terms()`] hands out each scalar formula with its arguments, their ranges and units, its source, how it
//! is written, its value in both precisions, at one point and at many, and its WGSL twin.
//!
//! ```
//! let term = brdf::term("d_ggx").expect("a term of that name");
//! assert_eq!(term.params[1].name, "alpha");
//! assert_eq!((term.f64)(&[1.0, 1.0]), std::f64::consts::FRAC_1_PI);
//! assert!(term.wgsl.is_some_and(|code| code.starts_with("fn lobe_d_ggx(")));
//! ```

use crate::batch::Isa;
use std::sync::LazyLock;

/// What an argument of a term means, and where it may lie.
///
/// ```
/// let alpha = brdf::term("d_ggx").expect("a term of that name").params[1];
/// assert_eq!((alpha.name, alpha.unit, alpha.range.1), ("alpha", "1", 1.0));
/// assert!(alpha.is_of_material());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Param {
    /// Name as written in a formula, `n_dot_h`.
    pub name: &'static str,
    /// Sensible closed range, for random points and checks. Values outside it are allowed;
    /// the documentation of each function says what they give.
    pub range: (f64, f64),
    /// Unit: `1` for a pure number, `rad`, `deg`.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
}

impl Param {
    /// Whether it describes the material and not a direction, so that it is mostly the same at
    /// many points.
    pub const fn is_of_material(&self) -> bool {
        is_of_material(self.name)
    }
}

/// [`Param::is_of_material`] by the name: directions are cosines (`n_dot_l`, `cos_phi`) or
/// coordinates (`h_x`).
const fn is_of_material(name: &str) -> bool {
    let name = name.as_bytes();
    !matches!(
        name,
        [b'c', b'o', b's', b'_', ..]
            | [_, b'_', b'd', b'o', b't', b'_', _]
            | [_, b'_', b'x' | b'y' | b'z']
    )
}

/// A formula with everything that belongs to it.
///
/// ```
/// use brdf::{batch::Isa, term};
/// let v_ggx = term("v_ggx").expect("a term of that name");
/// // One light after the other for a fixed view and width: those that are the same are given once.
/// let (n_dot_l, n_dot_v, alpha) = ([0.2f32, 0.5, 0.8], [0.6], [0.16]);
/// let mut out = [0.0; 3];
/// (v_ggx.f32_block)(Isa::best(), &[&n_dot_l, &n_dot_v, &alpha], &mut out);
/// assert_eq!(out[2], (v_ggx.f32)(&[0.8, 0.6, 0.16]));
/// assert_eq!(out[2], brdf::v_ggx(0.8, 0.6, 0.16));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Term {
    /// Name of its function, `d_ggx`.
    pub name: &'static str,
    /// Arguments in order.
    pub params: &'static [Param],
    /// One line on what it computes.
    pub doc: &'static str,
    /// Paper and equation; [`crate::sources`] has the titles.
    pub source: &'static str,
    /// Short Unicode form for pretty printing, `D_GGX`, `Λ_GGX`, `G₂`.
    pub symbol: &'static str,
    /// The same in LaTeX.
    pub latex: &'static str,
    /// Value in double precision; NaN if the number of arguments is wrong.
    pub f64: fn(&[f64]) -> f64,
    /// Value computed in single precision throughout; NaN if the number of arguments is wrong.
    pub f32: fn(&[f32]) -> f32,
    /// The same at many points: a slice for each argument, all as long as the result; what is
    /// longer is cut. A slice of one value stands for all points; the function is faster where
    /// those are all arguments that [are of the material](Param::is_of_material) and no others.
    /// The values are those of `f64` to the last bit. NaN everywhere if the number of arguments
    /// is wrong.
    pub f64_block: fn(Isa, &[&[f64]], &mut [f64]),
    /// The same in single precision throughout.
    pub f32_block: fn(Isa, &[&[f32]], &mut [f32]),
    /// WGSL twin: one function `lobe_<name>` with the arguments in order; `None` where the
    /// term is a quadrature.
    pub wgsl: Option<&'static str>,
    /// Other terms whose WGSL twins this one calls.
    pub wgsl_needs: &'static [&'static str],
    /// Rough cost in scalar operations, a division or root counted as several: 1 to 4,000,000, for budgets.
    pub cost: u32,
}

static TERMS: LazyLock<Vec<Term>> = LazyLock::new(|| {
    [
        crate::d::TERMS,
        crate::smith::TERMS,
        crate::gsf::TERMS,
        crate::fresnel::TERMS,
        crate::diffuse::TERMS,
        crate::whole::TERMS,
        crate::integral::TERMS,
        crate::energy::TERMS,
        crate::albedo_fits::TERMS,
        crate::half_vector::TERMS,
    ]
    .concat()
});

/// Every term, family by family, in an order that does not change from call to call.
///
/// ```
/// // A formula sheet: the symbol, the source and the value in the middle of each range.
/// for term in brdf::terms().iter().filter(|term| term.cost < 1000) {
///     let middle: Vec<f64> = term.params.iter().map(|p| (p.range.0 + p.range.1) / 2.0).collect();
///     println!("{:14} {:22} {:8.4}   {}", term.symbol, term.name, (term.f64)(&middle), term.source);
///     assert!(!(term.f64)(&middle).is_nan());
/// }
/// ```
pub fn terms() -> &'static [Term] {
    &TERMS
}

/// The term of that name, `None` if there is none. Names are those of the functions.
pub fn term(name: &str) -> Option<&'static Term> {
    terms().iter().find(|term| term.name == name)
}

/// Makes a [`Term`] of a generic function: its name and arguments are taken from the code,
/// so that the data cannot say something else.
macro_rules! entry {
    (
        $name:ident($($arg:ident: $param:expr),+),
        symbol: $symbol:literal, latex: $latex:literal, cost: $cost:literal,
        doc: $doc:literal, source: $source:literal,
        wgsl: $wgsl:expr $(, needs: [$($need:literal),+])?
    ) => {
        $crate::term::Term {
            name: stringify!($name),
            params: &[$($crate::term::Param { name: stringify!($arg), ..$param }),+],
            doc: $doc,
            source: $source,
            symbol: $symbol,
            latex: $latex,
            f64: |args| match *args {
                [$($arg),+] => $name::<f64>($($arg),+),
                _ => f64::NAN,
            },
            f32: |args| match *args {
                [$($arg),+] => $name::<f32>($($arg),+),
                _ => f32::NAN,
            },
            f64_block: {
                $crate::term::block!($name::<f64>($($arg),+));
                each
            },
            f32_block: {
                $crate::term::block!($name::<f32>($($arg),+));
                each
            },
            wgsl: $wgsl,
            wgsl_needs: &[$($($need),+)?],
            cost: $cost,
        }
    };
}
pub(crate) use entry;

/// Makes `each`, which evaluates a function at many points. Where the function's arithmetic is
/// inlined and free of branches, the loop works on several points at a time, and what depends on
/// the material alone is computed once.
macro_rules! block {
    ($name:ident::<$real:ident>($($arg:ident),+)) => {
        const NAMES: &[&str] = &[$(stringify!($arg)),+];
        const MATERIAL: u32 = $crate::term::of_material(NAMES);
        /// With the arguments in `SAME`, a bit for each, of which only the first value counts.
        #[inline(always)]
        fn body<const SAME: u32>(args: &[&[$real]], out: &mut [$real]) {
            let [$($arg),+] = *args else {
                return out.fill($real::NAN);
            };
            let mut count = out.len();
            $(if SAME & const { $crate::term::bit(NAMES, stringify!($arg)) } == 0 {
                count = count.min($arg.len());
            })+
            // The values, or the one that it is: read before the loop, which then need not look again.
            $(let $arg = match SAME & const { $crate::term::bit(NAMES, stringify!($arg)) } {
                0 => (&$arg[..count], $real::NAN),
                _ => (&$arg[..0], $arg[0]),
            };)+
            let out = &mut out[..count];
            // An index, and no iterators: so it is plain to the compiler that none is out of
            // bounds, and the loop has no end that it works on one by one.
            for index in 0..count {
                out[index] = $name::<$real>($(
                    match SAME & const { $crate::term::bit(NAMES, stringify!($arg)) } {
                        0 => $arg.0[index],
                        _ => $arg.1,
                    }
                ),+);
            }
        }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2")]
        fn avx2<const SAME: u32>(args: &[&[$real]], out: &mut [$real]) {
            body::<SAME>(args, out);
        }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2,avx512f,avx512vl,avx512dq,avx512bw")]
        fn avx512<const SAME: u32>(args: &[&[$real]], out: &mut [$real]) {
            body::<SAME>(args, out);
        }
        fn on<const SAME: u32>(isa: $crate::batch::Isa, args: &[&[$real]], out: &mut [$real]) {
            match isa.level() {
                $crate::batch::Level::Baseline => body::<SAME>(args, out),
                // SAFETY: a level is named only where its instructions were found.
                #[cfg(target_arch = "x86_64")]
                $crate::batch::Level::Avx2 => unsafe { avx2::<SAME>(args, out) },
                // SAFETY: as above.
                #[cfg(target_arch = "x86_64")]
                $crate::batch::Level::Avx512 => unsafe { avx512::<SAME>(args, out) },
            }
        }
        fn each(isa: $crate::batch::Isa, args: &[&[$real]], out: &mut [$real]) {
            let same = $crate::term::same(args, out.len());
            if same == 0 {
                on::<0>(isa, args, out);
            } else if same == MATERIAL {
                on::<MATERIAL>(isa, args, out);
            } else {
                $crate::term::spread(args, out, |args, out| on::<0>(isa, args, out));
            }
        }
    };
}
pub(crate) use block;

/// The bit of an argument.
pub(crate) const fn bit(names: &[&str], name: &str) -> u32 {
    let mut index = 0;
    while index < names.len() {
        if equal(names[index].as_bytes(), name.as_bytes()) {
            return 1 << index;
        }
        index += 1;
    }
    0
}

const fn equal(a: &[u8], b: &[u8]) -> bool {
    let mut index = 0;
    while index < a.len() && index < b.len() && a[index] == b[index] {
        index += 1;
    }
    index == a.len() && index == b.len()
}

/// The bits of the arguments that are of the material.
pub(crate) const fn of_material(names: &[&str]) -> u32 {
    let (mut bits, mut index) = (0, 0);
    while index < names.len() {
        if is_of_material(names[index]) {
            bits |= 1 << index;
        }
        index += 1;
    }
    bits
}

/// The bits of the arguments of which one value stands for all points.
pub(crate) fn same<R>(args: &[&[R]], points: usize) -> u32 {
    let one = |arg: &&[R]| u32::from(arg.len() == 1 && points > 1);
    let bits = args
        .iter()
        .enumerate()
        .map(|(index, arg)| one(arg) << index);
    bits.sum()
}

/// Evaluates some points after the other, with what is the same for all written out.
pub(crate) fn spread<R: Copy>(
    args: &[&[R]],
    out: &mut [R],
    mut each: impl FnMut(&[&[R]], &mut [R]),
) {
    const POINTS: usize = 64;
    let point = |arg: &&[R]| {
        if arg.len() == 1 {
            usize::MAX
        } else {
            arg.len()
        }
    };
    let count = args.iter().map(point).fold(out.len(), usize::min);
    for start in (0..count).step_by(POINTS) {
        let end = (start + POINTS).min(count);
        let column = |arg: &&[R]| match **arg {
            [only] => vec![only; end - start],
            _ => arg[start..end].to_vec(),
        };
        let columns: Vec<Vec<R>> = args.iter().map(column).collect();
        let slices: Vec<&[R]> = columns.iter().map(Vec::as_slice).collect();
        each(&slices, &mut out[start..end]);
    }
}

const fn param(
    name: &'static str,
    range: (f64, f64),
    unit: &'static str,
    meaning: &'static str,
) -> Param {
    Param {
        name,
        range,
        unit,
        meaning,
    }
}

/// Cosine of an angle on the lit side.
pub(crate) const N_DOT_H: Param = param(
    "n_dot_h",
    (0.0, 1.0),
    "1",
    "cosine between the normal and the half vector",
);
pub(crate) const N_DOT_X: Param = param(
    "n_dot_x",
    (0.01, 1.0),
    "1",
    "cosine between the normal and a direction",
);
pub(crate) const N_DOT_L: Param = param(
    "n_dot_l",
    (0.01, 1.0),
    "1",
    "cosine between the normal and the light",
);
pub(crate) const N_DOT_V: Param = param(
    "n_dot_v",
    (0.01, 1.0),
    "1",
    "cosine between the normal and the view",
);
pub(crate) const V_DOT_H: Param = param(
    "v_dot_h",
    (0.01, 1.0),
    "1",
    "cosine between the view (or the light) and the half vector",
);
pub(crate) const L_DOT_V: Param = param(
    "l_dot_v",
    (-0.99, 1.0),
    "1",
    "cosine between the light and the view",
);
pub(crate) const COS_PHI: Param = param(
    "cos_phi",
    (-1.0, 1.0),
    "1",
    "cosine of the azimuth between the light and the view",
);
pub(crate) const ALPHA: Param = param(
    "alpha",
    (0.01, 1.0),
    "1",
    "width of the distribution, roughness squared",
);
pub(crate) const ROUGHNESS: Param = param(
    "roughness",
    (0.05, 1.0),
    "1",
    "perceptual roughness, the square root of alpha",
);
pub(crate) const F0: Param = param("f0", (0.0, 1.0), "1", "reflectance at normal incidence");
pub(crate) const ALBEDO: Param = param(
    "albedo",
    (0.0, 1.0),
    "1",
    "reflectance of a facet or of the surface",
);
pub(crate) const SIGMA: Param = param(
    "sigma",
    (0.0, 1.0),
    "rad",
    "standard deviation of the facet angle",
);
