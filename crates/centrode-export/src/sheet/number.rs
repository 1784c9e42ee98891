/// Number to so many places, without trailing zeros.
pub(crate) fn number(x: f64, places: usize) -> String {
    let text = format!("{x:.places$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if text == "-0" { "0" } else { text }.to_owned()
}

/// Number to so many places, zeros and all, without a sign to a zero.
pub(crate) fn fixed(x: f64, places: usize) -> String {
    let text = format!("{x:.places$}");
    let bare = text.trim_start_matches('-');
    match bare.contains(|c: char| matches!(c, '1'..='9')) {
        true => text,
        false => bare.to_owned(),
    }
}

/// Least and greatest number to so many places; one where both are the same.
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
        // Of a circlip of 3 mm a tenth of a gram would be none.
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

/// A length on paper, mm, without its rounding errors: the order of things must not hang on them.
pub(crate) fn steady(length: f64) -> f64 {
    const PARTS: f64 = 1e6;
    (length * PARTS).round() / PARTS
}

#[cfg(test)]
mod tests {
    use super::{fixed, number};

    #[test]
    fn zeros_that_say_nothing_are_left_out() {
        let written = [
            (12.5, 3),
            (12.0, 2),
            (-0.0001, 2),
            (1000.0, 0),
            (0.1 + 0.2, 4),
        ];
        let written = written.map(|(x, places)| number(x, places));
        assert_eq!(written, ["12.5", "12", "0", "1000", "0.3"]);
        assert_eq!(
            [-4e-5, -6e-5, 2.5].map(|x| fixed(x, 4)),
            ["0.0000", "-0.0001", "2.5000"]
        );
    }
}
