//! Holes, keyways and shafts as written on a drawing, with their limits.

use centrode_mechanism::machine::{Fit, limits_of_size};

use super::number;

/// A bore as written on a drawing: diameter, class, and the limits where they are known.
pub(crate) fn bore(diameter: f64, class: &str) -> String {
    fitted(&format!("Ø{}", number(diameter, 4)), diameter, class)
}

/// A keyway's width as written on a drawing.
pub(crate) fn keyway(width: f64, class: &str) -> String {
    fitted(&number(width, 3), width, class)
}

/// Size of what is in a hole or slot as written on a drawing.
pub(crate) fn shaft(fit: &Fit) -> String {
    fitted(&size(fit), fit.size, &fit.shaft)
}

/// Size of a fit: a diameter, or a width.
pub(crate) fn size(fit: &Fit) -> String {
    let sign = if fit.is_width { "" } else { "Ø" };
    format!("{sign}{}", number(fit.size, 4))
}

fn fitted(size: &str, nominal: f64, class: &str) -> String {
    // Half of an odd grade is written to the half micrometre.
    let signed = |mm: f64| match (mm * 1e4).round() {
        0.0 => "0".to_owned(),
        tenths if tenths % 10.0 == 0.0 => format!("{mm:+.3}"),
        _ => format!("{mm:+.4}"),
    };
    match limits_of_size(nominal, class) {
        Some([low, high]) => format!("{size} {class} ({} / {})", signed(high), signed(low)),
        None if class.is_empty() => size.to_owned(),
        None => format!("{size} {class}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_written_with_their_class_and_limits() {
        assert_eq!(bore(12.0, "H7"), "Ø12 H7 (+0.018 / 0)");
        assert_eq!(bore(10.0, "G7"), "Ø10 G7 (+0.020 / +0.005)");
        assert_eq!(bore(50.0, "F7"), "Ø50 F7 (+0.050 / +0.025)");
        assert_eq!(bore(120.0, "H9"), "Ø120 H9 (+0.087 / 0)");
        assert_eq!(bore(25.5, "K7"), "Ø25.5 K7");
        assert_eq!(bore(501.0, "H7"), "Ø501 H7");
        assert_eq!(bore(8.0, ""), "Ø8");
        assert_eq!(bore(8.0, "é"), "Ø8 é");
        // DIN 6885-1: keyways of hub and shaft.
        assert_eq!(keyway(4.0, "JS9"), "4 JS9 (+0.015 / -0.015)");
        assert_eq!(keyway(8.0, "P9"), "8 P9 (-0.015 / -0.051)");
        assert_eq!(keyway(2.0, "N9"), "2 N9 (-0.004 / -0.029)");
        assert_eq!(keyway(12.0, "N9"), "12 N9 (0 / -0.043)");
        assert_eq!(keyway(12.0, "JS9"), "12 JS9 (+0.0215 / -0.0215)");
        assert_eq!(keyway(4.5, ""), "4.5");
        let fit = Fit {
            size: 16.0,
            shaft: "h6".into(),
            ..Fit::default()
        };
        assert_eq!(shaft(&fit), "Ø16 h6 (0 / -0.011)");
    }
}
