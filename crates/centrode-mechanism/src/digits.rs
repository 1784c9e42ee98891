//! Numbers in messages.

/// A number in as many digits as mean something: ten at most, and in powers of ten where it is very large or small.
pub(crate) fn told(value: f64) -> String {
    let short = format!("{value:.9e}").parse().unwrap_or(value);
    if short == 0.0 || (1e-7..1e10).contains(&short.abs()) {
        format!("{short}")
    } else {
        format!("{short:e}")
    }
}

/// Millimetres to a thousandth, without zeros at the end.
pub(crate) fn thousandths(mm: f64) -> String {
    told((1e3 * mm).round() / 1e3)
}

#[cfg(test)]
mod tests {
    use super::told;

    #[test]
    fn digits_are_those_that_mean_something() {
        for (value, words) in [
            (119.999_999_999_999_99, "120"),
            (1e300, "1e300"),
            (-1e9, "-1000000000"),
            (0.1, "0.1"),
            (2.5e-12, "2.5e-12"),
            (0.0, "0"),
            (59.123_456_789_012, "59.12345679"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(told(value), words);
        }
    }
}
