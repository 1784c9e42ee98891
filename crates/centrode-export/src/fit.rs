//! Holes, keyways and shafts as written on a drawing, with their limits.

use crate::grade::{SYMMETRY, grade};
use centrode_formats::sheet::number;
use centrode_kinematics::machine::{Fit, Keyway, limits_of_size};

/// Tolerance class of the width of a keyway in a shaft, ISO 286.
pub(crate) const SHAFT_KEYWAY: &str = "N9";

/// A bore as written on a drawing: diameter, class, and the limits where they are known.
pub(crate) fn bore(diameter: f64, class: &str) -> String {
    fitted(&format!("Ø{}", number(diameter, 4)), diameter, class)
}

/// Width of a keyway, of a slot or of a part that runs in it, as written on a drawing.
pub(crate) fn keyway(width: f64, class: &str) -> String {
    fitted(&number(width, 3), width, class)
}

/// Polar angle of a keyway in a bore (`angle` in rad), written in degrees with the deviation that its symmetry tolerance permits.
pub(crate) fn keyway_angle(angle: f64, bore: f64, width: f64) -> String {
    let stated = number(angle.to_degrees(), 4);
    let off = grade(width, SYMMETRY).map(|zone| (zone / bore).to_degrees());
    match off.map(|off| (off * 1e2).floor() / 1e2) {
        Some(off) if off > 0.0 => format!("{stated}° ±{}°", number(off, 2)),
        _ => format!("{stated}°"),
    }
}

/// Bore diameter plus depth of a keyway in a hub, as written on a drawing.
pub(crate) fn hub_depth(bore: f64, key: Keyway) -> String {
    let deeper = key.depth_tolerance().map(|most| [0.0, most]);
    limited(&number(bore + key.depth, 3), deeper)
}

/// Diameter of a shaft less the depth of its keyway, as written on a drawing.
pub(crate) fn shaft_depth(diameter: f64, key: Keyway) -> String {
    let deeper = key.depth_tolerance().map(|most| [-most, 0.0]);
    limited(&number(diameter - key.depth, 3), deeper)
}

/// A length with its deviations as written on a drawing.
pub(crate) fn length(mm: f64, deviations: [f64; 2]) -> String {
    limited(&number(mm, 3), Some(deviations))
}

/// Size of the shaft or slider of a fit with its class, as written on a drawing.
pub(crate) fn shaft(fit: &Fit) -> String {
    fitted(&size(fit), fit.size, &fit.shaft)
}

/// Size of a fit: a diameter, or a width.
pub(crate) fn size(fit: &Fit) -> String {
    let sign = if fit.is_width { "" } else { "Ø" };
    format!("{sign}{}", number(fit.size, 4))
}

fn fitted(size: &str, nominal: f64, class: &str) -> String {
    let size = match class {
        "" => size.to_owned(),
        class => format!("{size} {class}"),
    };
    limited(&size, limits_of_size(nominal, class))
}

/// A size with its limits in mm, if there are any, the upper limit first.
fn limited(size: &str, limits: Option<[f64; 2]>) -> String {
    // Half of an odd tolerance ends in half a micrometre: it needs a fourth decimal.
    let signed = |mm: f64| match (mm * 1e4).round() {
        0.0 => "0".to_owned(),
        tenths if tenths % 10.0 == 0.0 => format!("{mm:+.3}"),
        _ => format!("{mm:+.4}"),
    };
    match limits {
        Some([low, high]) => format!("{size} ({} / {})", signed(high), signed(low)),
        None => size.to_owned(),
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
        assert_eq!(length(15.0, [0.05, 0.15]), "15 (+0.150 / +0.050)");
        let fit = Fit {
            size: 16.0,
            shaft: "h6".into(),
            ..Fit::default()
        };
        assert_eq!(shaft(&fit), "Ø16 h6 (0 / -0.011)");
        let key = |width: f64, depth: f64| Keyway { width, depth };
        assert_eq!(hub_depth(12.0, key(4.0, 1.8)), "13.8 (+0.100 / 0)");
        assert_eq!(shaft_depth(25.0, key(8.0, 4.0)), "21 (0 / -0.200)");
        assert_eq!(hub_depth(12.0, key(4.5, 1.8)), "13.8");
    }
}
