//! Limits of holes and keyways, ISO 286-2.

use super::number;

/// Upper ends of the ranges of nominal sizes, mm.
const RANGES: [f64; 9] = [3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0];

/// Lower and upper deviation of a hole or a keyway's width, mm, for classes F, G, H and JS of grades 6 to 9, and N and P of
/// grade 9, as DIN 6885 asks of keyways; `None` for other classes and sizes above 180 mm.
///
/// Source: ISO 286-1, tables of standard tolerance grades and fundamental deviations.
pub(crate) fn limits(size: f64, class: &str) -> Option<[f64; 2]> {
    let range = RANGES.iter().position(|&end| size <= end)?;
    let letters = class.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = &class[letters.len()..];
    let grade = match number {
        "6" => [6.0, 8.0, 9.0, 11.0, 13.0, 16.0, 19.0, 22.0, 25.0],
        "7" => [10.0, 12.0, 15.0, 18.0, 21.0, 25.0, 30.0, 35.0, 40.0],
        "8" => [14.0, 18.0, 22.0, 27.0, 33.0, 39.0, 46.0, 54.0, 63.0],
        "9" => [25.0, 30.0, 36.0, 43.0, 52.0, 62.0, 74.0, 87.0, 100.0],
        _ => return None,
    }[range];
    let lower = match (letters, number) {
        ("H", _) => 0.0,
        ("G", _) => [2.0, 4.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 14.0][range],
        ("F", _) => [6.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0][range],
        ("JS", _) => -0.5 * grade,
        ("N", "9") => (if range == 0 { -4.0 } else { 0.0 }) - grade,
        ("P", "9") => -[6.0, 12.0, 15.0, 18.0, 22.0, 26.0, 32.0, 37.0, 43.0][range] - grade,
        _ => return None,
    };
    Some([lower / 1000.0, (lower + grade) / 1000.0])
}

/// A bore as written on a drawing: diameter, class, and the limits where they are known.
pub(crate) fn bore(diameter: f64, class: &str) -> String {
    fitted(&format!("Ø{diameter}"), diameter, class)
}

/// A keyway's width as written on a drawing.
pub(crate) fn keyway(width: f64, class: &str) -> String {
    fitted(&number(width, 3), width, class)
}

fn fitted(size: &str, nominal: f64, class: &str) -> String {
    // Half of an odd grade is written to the half micrometre.
    let signed = |mm: f64| match (mm * 1e4).round() {
        0.0 => "0".to_owned(),
        tenths if tenths % 10.0 == 0.0 => format!("{mm:+.3}"),
        _ => format!("{mm:+.4}"),
    };
    match limits(nominal, class) {
        Some([low, high]) => format!("{size} {class} ({} / {})", signed(high), signed(low)),
        None if class.is_empty() => size.to_owned(),
        None => format!("{size} {class}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_those_of_the_standard() {
        assert_eq!(bore(12.0, "H7"), "Ø12 H7 (+0.018 / 0)");
        assert_eq!(bore(10.0, "G7"), "Ø10 G7 (+0.020 / +0.005)");
        assert_eq!(bore(50.0, "F7"), "Ø50 F7 (+0.050 / +0.025)");
        assert_eq!(bore(120.0, "H9"), "Ø120 H9 (+0.087 / 0)");
        assert_eq!(bore(25.5, "K7"), "Ø25.5 K7");
        assert_eq!(bore(500.0, "H7"), "Ø500 H7");
        assert_eq!(bore(8.0, ""), "Ø8");
        assert_eq!(bore(8.0, "é"), "Ø8 é");
        // DIN 6885-1: keyways of hub and shaft.
        assert_eq!(keyway(4.0, "JS9"), "4 JS9 (+0.015 / -0.015)");
        assert_eq!(keyway(8.0, "P9"), "8 P9 (-0.015 / -0.051)");
        assert_eq!(keyway(2.0, "N9"), "2 N9 (-0.004 / -0.029)");
        assert_eq!(keyway(12.0, "N9"), "12 N9 (0 / -0.043)");
        assert_eq!(keyway(12.0, "JS9"), "12 JS9 (+0.0215 / -0.0215)");
        assert_eq!(keyway(4.5, ""), "4.5");
    }
}
