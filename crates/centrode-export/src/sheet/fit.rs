//! Limits of holes, ISO 286-2.

/// Upper ends of the ranges of nominal sizes, mm.
const RANGES: [f64; 9] = [3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0];

/// Lower and upper deviation of a hole, mm, for classes F, G and H of grades 6 to 9; `None` for other
/// classes and sizes above 180 mm.
///
/// Source: ISO 286-1, tables of standard tolerance grades and fundamental deviations.
pub(crate) fn limits(diameter: f64, class: &str) -> Option<[f64; 2]> {
    let range = RANGES.iter().position(|&end| diameter <= end)?;
    let mut letters = class.chars();
    let lower = match letters.next()? {
        'H' => 0.0,
        'G' => [2.0, 4.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 14.0][range],
        'F' => [6.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0][range],
        _ => return None,
    };
    let grade = match letters.as_str() {
        "6" => [6.0, 8.0, 9.0, 11.0, 13.0, 16.0, 19.0, 22.0, 25.0],
        "7" => [10.0, 12.0, 15.0, 18.0, 21.0, 25.0, 30.0, 35.0, 40.0],
        "8" => [14.0, 18.0, 22.0, 27.0, 33.0, 39.0, 46.0, 54.0, 63.0],
        "9" => [25.0, 30.0, 36.0, 43.0, 52.0, 62.0, 74.0, 87.0, 100.0],
        _ => return None,
    };
    Some([lower / 1000.0, (lower + grade[range]) / 1000.0])
}

/// A bore as written on a drawing: diameter, class, and the limits where they are known.
pub(crate) fn bore(diameter: f64, class: &str) -> String {
    let size = format!("Ø{diameter}");
    let signed = |mm: f64| match mm {
        0.0 => "0".to_owned(),
        mm => format!("{mm:+.3}"),
    };
    match limits(diameter, class) {
        Some([low, high]) => format!("{size} {class} ({} / {})", signed(high), signed(low)),
        None if class.is_empty() => size,
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
    }
}
