//! How names look on a blackboard: `n_dot_h` is N·H, `alpha` is α.

/// The name as a person writes it, in Unicode: `N·H`, `α`, `r`, `F₀`.
pub fn unicode_name(name: &str) -> String {
    if let Some((left, right)) = dot_product(name) {
        return format!("{left}·{right}");
    }
    let known = match name {
        "roughness" => "r",
        "f0" => "F₀",
        "cos_phi" => "cos φ",
        "alpha_squared" => "α²",
        "light_deg" => "β",
        "albedo" => "ρ",
        "ior" => "n",
        _ => "",
    };
    if !known.is_empty() {
        return known.to_string();
    }
    // `alpha1` is α₁, but `a2` may well be the square of a: Latin names stay as typed.
    let (stem, index) = split_index(name);
    if let Some(letter) = greek(stem) {
        let index: String = index.chars().map(subscript).collect();
        return format!("{letter}{index}");
    }
    match name.split_once('_') {
        Some((first, rest)) if greek(first).is_some() => {
            format!("{}_{rest}", greek(first).unwrap_or(first))
        }
        _ => name.to_string(),
    }
}

/// The name in LaTeX.
pub fn latex_name(name: &str) -> String {
    if let Some((left, right)) = dot_product(name) {
        return format!(r"\mathbf{{{left}}}\!\cdot\!\mathbf{{{right}}}");
    }
    let known = match name {
        "roughness" => "r",
        "f0" => "F_0",
        "cos_phi" => r"\cos\phi",
        "alpha_squared" => r"\alpha^2",
        "light_deg" => r"\beta",
        "albedo" => r"\rho",
        "ior" => "n",
        _ => "",
    };
    if !known.is_empty() {
        return known.to_string();
    }
    let (stem, index) = split_index(name);
    let stem = if greek(stem).is_some() {
        format!(r"\{stem}")
    } else if stem.chars().count() == 1 {
        stem.to_string()
    } else {
        format!(r"\mathrm{{{}}}", stem.replace('_', r"\_"))
    };
    if index.is_empty() {
        stem
    } else {
        format!("{stem}_{{{index}}}")
    }
}

/// `n_dot_h` as (N, H), where the name is a cosine of two directions.
pub(crate) fn dot_product(name: &str) -> Option<(char, char)> {
    let (left, right) = name.split_once("_dot_")?;
    let one = |part: &str| {
        let mut chars = part.chars();
        let first = chars.next().filter(char::is_ascii_alphabetic)?;
        chars.next().is_none().then(|| first.to_ascii_uppercase())
    };
    Some((one(left)?, one(right)?))
}

/// `alpha1`, `alpha_1` as (alpha, 1).
fn split_index(name: &str) -> (&str, &str) {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    if stem.is_empty() {
        return (name, "");
    }
    let index = &name[stem.len()..];
    let stem = match stem.strip_suffix('_') {
        Some(bare) if !index.is_empty() && !bare.is_empty() => bare,
        _ => stem,
    };
    (stem, index)
}

fn subscript(digit: char) -> char {
    digit
        .to_digit(10)
        .and_then(|value| char::from_u32('₀' as u32 + value))
        .unwrap_or(digit)
}

pub(crate) fn superscript(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '0' => '⁰',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '4' => '⁴',
            '5' => '⁵',
            '6' => '⁶',
            '7' => '⁷',
            '8' => '⁸',
            '9' => '⁹',
            '-' => '⁻',
            other => other,
        })
        .collect()
}

fn greek(name: &str) -> Option<&'static str> {
    Some(match name {
        "alpha" => "α",
        "beta" => "β",
        "gamma" => "γ",
        "eta" => "η",
        "theta" => "θ",
        "lambda" => "λ",
        "mu" => "μ",
        "pi" => "π",
        "rho" => "ρ",
        "sigma" => "σ",
        "phi" => "φ",
        "psi" => "ψ",
        "omega" => "ω",
        _ => return None,
    })
}
