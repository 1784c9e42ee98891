//! Numbers in messages.

/// A number in at most ten significant digits, in powers of ten if it is very large or small.
pub fn stated(value: f64) -> String {
    digits(value, 10)
}

/// A number in at most `count` significant digits, in powers of ten if it is very large or small.
pub fn digits(value: f64, count: usize) -> String {
    let decimals = count.saturating_sub(1);
    let short = format!("{value:.decimals$e}").parse().unwrap_or(value);
    if short == 0.0 || (1e-7..1e10).contains(&short.abs()) {
        format!("{short}")
    } else {
        format!("{short:e}")
    }
}

/// A message with numbers of at most ten digits, in powers of ten if they are very large or small.
#[must_use]
pub fn shortened(text: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric() || "_\"'".contains(c);
    let mut short = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, number) = rest.split_at(start);
        let (number, after) = number.split_at(length(number));
        let in_word = before.ends_with(is_word) || after.starts_with(is_word);
        let digits = number.bytes().take_while(|c| *c != b'e').count();
        // A whole number of up to 20 digits may be a count and stays as it is.
        let is_long = digits > if number.contains('.') { 10 } else { 20 };
        let value = number.parse().ok().filter(|_| is_long && !in_word);
        short.push_str(before);
        short.push_str(&value.map_or_else(|| number.to_owned(), stated));
        rest = after;
    }
    short + rest
}

/// Length of the number with which a text begins.
fn length(text: &str) -> usize {
    let digits = |text: &str| text.bytes().take_while(u8::is_ascii_digit).count();
    let mut length = digits(text);
    for mark in [".", "e", "e-"] {
        if let Some(rest) = text[length..].strip_prefix(mark) {
            let more = digits(rest);
            length += if more > 0 { mark.len() + more } else { 0 };
        }
    }
    length
}

/// Millimetres to a thousandth, without zeros at the end.
pub fn thousandths(mm: f64) -> String {
    rounded(mm, 3)
}

/// A number to `decimals` decimals, without zeros at the end.
pub fn rounded(value: f64, decimals: i32) -> String {
    let scale = 10.0_f64.powi(decimals);
    stated((scale * value).round() / scale)
}

#[cfg(test)]
mod tests {
    use super::{shortened, stated};

    #[test]
    fn numbers_in_a_text_have_the_digits_that_mean_something() {
        for (text, words) in [
            ("54.000000000000014 mm", "54 mm"),
            (
                "(0.5774011647378556, -1.439239460421746) mm",
                "(0.5774011647, -1.43923946) mm",
            ),
            ("at 119.99999999999999.", "at 120."),
            ("at 119.99999999999999 deg", "at 120 deg"),
            (
                "arm-2 at 12.5, \"part123456789012\"",
                "arm-2 at 12.5, \"part123456789012\"",
            ),
            (
                "must be 0.1 to 1e9, not 5.3e-14",
                "must be 0.1 to 1e9, not 5.3e-14",
            ),
            ("5.299999493450935e0 mm", "5.299999493 mm"),
            ("2.220446049250313e-16", "2.220446049e-16"),
            ("123456789012345", "123456789012345"),
            ("123456789012345678901234567890", "1.23456789e29"),
            ("", ""),
            ("no number", "no number"),
        ] {
            assert_eq!(shortened(text), words);
        }
    }

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
            assert_eq!(stated(value), words);
        }
    }
}
