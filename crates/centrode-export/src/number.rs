//! Numbers and names in the form that sheets and tables use.

use centrode_formats::sheet::number;

/// Number with exactly `places` decimals; a zero has no sign.
pub(crate) fn fixed(x: f64, places: usize) -> String {
    let text = format!("{x:.places$}");
    let bare = text.trim_start_matches('-');
    match bare.contains(|c: char| matches!(c, '1'..='9')) {
        true => text,
        false => bare.to_owned(),
    }
}

/// Minimum and maximum with at most `places` decimals; one number if both are equal.
pub(crate) fn range([low, high]: [f64; 2], places: usize) -> String {
    let [low, high] = [low, high].map(|x| number(x, places));
    if low == high {
        low
    } else {
        format!("{low} to {high}")
    }
}

/// Mass in grams with its unit, from a kilogram on in kilograms.
pub(crate) fn mass(grams: f64) -> String {
    if grams >= 1000.0 {
        format!("{} kg", number(grams / 1000.0, 3))
    } else {
        // A circlip of 3 mm weighs so little that one decimal would show 0 g.
        let places = if grams < 0.1 { 3 } else { 1 };
        format!("{} g", number(grams, places))
    }
}

/// A name as a title: with a capital letter, without hyphens.
pub(crate) fn capital(name: &str) -> String {
    let mut title = name.replace('-', " ");
    if let Some(first) = title.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    title
}

#[cfg(test)]
mod tests {
    use super::fixed;

    #[test]
    fn a_zero_has_no_sign() {
        assert_eq!(
            [-4e-5, -6e-5, 2.5].map(|x| fixed(x, 4)),
            ["0.0000", "-0.0001", "2.5000"]
        );
    }
}
