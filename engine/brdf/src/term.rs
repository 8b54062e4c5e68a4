//! The registry: every formula as data, found by its name.

use crate::batch::Isa;
use std::sync::LazyLock;

/// What an argument of a term means, and where it may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Param {
    /// Name as written in a formula, `n_dot_h`.
    pub name: &'static str,
    /// Sensible closed range, for random points and checks. Values outside it are allowed;
    /// the documentation of each function says what they give.
    pub range: (f64, f64),
    /// Unit, `1` for a pure number.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub meaning: &'static str,
}

/// A formula with everything that belongs to it.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    /// Name by which lessons call it, `d_ggx`.
    pub name: &'static str,
    /// Arguments in order.
    pub params: &'static [Param],
    /// One line on what it computes.
    pub doc: &'static str,
    /// Paper and equation.
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
    /// longer is cut. The values are those of `f64` to the last bit. NaN everywhere if the
    /// number of arguments is wrong.
    pub f64_block: fn(Isa, &[&[f64]], &mut [f64]),
    /// The same in single precision throughout.
    pub f32_block: fn(Isa, &[&[f32]], &mut [f32]),
    /// WGSL twin: one function `lobe_<name>` with the arguments in order; `None` where the
    /// term is a quadrature.
    pub wgsl: Option<&'static str>,
    /// Other terms whose WGSL twins this one calls.
    pub wgsl_needs: &'static [&'static str],
    /// Rough cost in scalar operations.
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

/// Every term, family by family.
pub fn terms() -> &'static [Term] {
    &TERMS
}

/// The term of that name.
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
/// inlined and free of branches, the loop works on several points at a time; AVX-512 divides and
/// takes roots no faster than AVX2, so there is no loop for it.
macro_rules! block {
    ($name:ident::<$real:ident>($($arg:ident),+)) => {
        #[inline(always)]
        fn body(args: &[&[$real]], out: &mut [$real]) {
            let [$($arg),+] = *args else {
                return out.fill($real::NAN);
            };
            let count = out.len()$(.min($arg.len()))+;
            $(let $arg = &$arg[..count];)+
            for (index, out) in out[..count].iter_mut().enumerate() {
                *out = $name::<$real>($($arg[index]),+);
            }
        }
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = "avx2")]
        fn avx2(args: &[&[$real]], out: &mut [$real]) {
            body(args, out);
        }
        fn each(isa: $crate::batch::Isa, args: &[&[$real]], out: &mut [$real]) {
            match isa.level() {
                $crate::batch::Level::Baseline => body(args, out),
                // SAFETY: a level is named only where its instructions, AVX2 among them, were found.
                #[cfg(target_arch = "x86_64")]
                $crate::batch::Level::Avx2 | $crate::batch::Level::Avx512 => unsafe {
                    avx2(args, out)
                },
            }
        }
    };
}
pub(crate) use block;

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
