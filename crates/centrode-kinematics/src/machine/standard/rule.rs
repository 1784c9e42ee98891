use centrode_spec::rule::{Rule, SpecError, broken, finite};

use super::Screw;
use crate::machine::fit::is_class;

/// Checks the nominal diameter of screws, mm: none, zero, or a size of the standard.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn screw_size(key: &str, diameter: Option<f64>) -> Result<(), SpecError> {
    let Some(diameter) = diameter else {
        return Ok(());
    };
    finite(key, diameter)?;
    match diameter == 0.0 || Screw::sizes().any(|known| known == diameter) {
        true => Ok(()),
        false => broken(key, Rule::NoScrew(diameter)),
    }
}

/// Checks a tolerance class of holes and slots.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn hole_class(key: &str, word: &str) -> Result<(), SpecError> {
    class(key, word, true)
}

/// Checks a tolerance class of shafts, pins and keys.
///
/// # Errors
/// [`SpecError`] with the key.
pub fn shaft_class(key: &str, word: &str) -> Result<(), SpecError> {
    class(key, word, false)
}

fn class(key: &str, word: &str, of_hole: bool) -> Result<(), SpecError> {
    if word.is_empty() || is_class(word, of_hole) {
        return Ok(());
    }
    let (of, like) = if of_hole {
        ("hole", "H7")
    } else {
        ("shaft", "h6")
    };
    let word = word.chars().take(80).collect();
    broken(key, Rule::NoClass { word, of, like })
}
