/// Number with at most `places` decimals, without trailing zeros.
pub fn number(x: f64, places: usize) -> String {
    let text = format!("{x:.places$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    if text == "-0" { "0" } else { text }.to_owned()
}

/// A length on paper, mm, without its rounding errors: the order of points and notes must not depend on them.
pub fn steady(length: f64) -> f64 {
    const PARTS: f64 = 1e6;
    (length * PARTS).round() / PARTS
}

#[cfg(test)]
mod tests {
    use super::number;

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
    }
}
