//! The worked example, line by line: the formula, the numbers put in, the value.

use formula::{Digits, Values};

use crate::lesson::{Formula, Lesson, values};
use crate::prose::{Block, Inline, shortest};

impl Lesson {
    /// The worked example's givens and the full-precision values of its first `lines` lines.
    pub fn worked_values(&self, lines: usize) -> Values {
        let Some(worked) = &self.worked else {
            return Values::new();
        };
        let mut known = values(&worked.given);
        for line in worked.lines.iter().take(lines) {
            if let Ok(value) = self.library.eval(&line.is.expr, &known) {
                known.insert(line.name.text.clone(), value);
            }
        }
        known
    }

    /// A line of the worked example, from 0.
    pub fn worked_line(&self, index: usize) -> Option<Block> {
        let line = self.worked.as_ref()?.lines.get(index)?;
        let known = self.worked_values(index);
        let digits = line
            .shown
            .as_ref()
            .map_or(Digits::Significant(4), |shown| digits_of(shown));
        let name = match &line.ask {
            Some(ask) => ask.text.clone(),
            None => self.spelled(&line.name),
        };
        let mut through = known.clone();
        if let Ok(value) = self.library.eval(&line.is.expr, &known) {
            through.insert(line.name.text.clone(), value);
        }
        let says = line
            .says
            .as_ref()
            .map_or_else(Vec::new, |says| self.inline(says, &through));
        Some(self.derivation(&name, &line.is, &known, digits, says))
    }

    /// A formula with its numbers put in, as a block.
    pub fn derivation(
        &self,
        name: &str,
        is: &Formula,
        known: &Values,
        digits: Digits,
        says: Vec<Inline>,
    ) -> Block {
        // The formula first, then the numbers; but not a name that equals itself.
        let symbols = self.library.unicode(&is.expr);
        let (lines, value) = match self.library.substitution(&is.expr, known, digits) {
            Ok(substitution) => {
                let numbers = substitution.lines.into_iter();
                let lines = std::iter::once(symbols.clone())
                    .filter(|line| line != name && !name.ends_with(&format!(" = {line}")))
                    .chain(numbers.filter(|line| *line != symbols));
                (lines.collect(), substitution.shown)
            }
            Err(_) => (vec![symbols], "undefined".to_owned()),
        };
        Block::Derivation {
            name: name.to_owned(),
            lines,
            value,
            says,
        }
    }
}

/// The digits that a printed number has: `0.560` has three decimals.
pub(crate) fn digits_of(shown: &str) -> Digits {
    let mantissa = shown.split(['e', 'E']).next().unwrap_or(shown);
    if mantissa.len() < shown.len() {
        return Digits::Significant(formula::significant_digits(shown).unwrap_or(4));
    }
    let decimals = mantissa
        .split_once(['.', ','])
        .map_or(0, |(_, fraction)| fraction.trim().len());
    Digits::Decimals(decimals.min(17) as u32)
}

/// A given as text: `roughness = 0.4` as `r = 0.4`.
pub fn given_words(name: &str, value: f64) -> String {
    format!("{} = {}", formula::unicode_name(name), shortest(value))
}
