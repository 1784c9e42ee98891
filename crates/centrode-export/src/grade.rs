//! Geometrical tolerances of features by the grades of ISO 286-1.

use centrode_formats::sheet::geometrical::{Characteristic, Frame};
use centrode_formats::sheet::number;
use centrode_kinematics::machine::limits_of_size;

/// Tolerance class for the symmetry of a keyway; its size is the width of the keyway.
pub(crate) const SYMMETRY: &str = "H9";

/// Width of a tolerance grade for a size, mm, ISO 286-1; `class` is a class of holes with that grade.
pub(crate) fn grade(size: f64, class: &str) -> Option<f64> {
    limits_of_size(size, class).map(|[low, high]| high - low)
}

/// Position tolerance of an axis: grade IT8 of its distance from the datum, or 2 `off` if its permitted deviation `off` is
/// positive (mm). `None` beyond the grades of ISO 286-1.
pub(crate) fn position(distance: f64, off: f64, apart: Option<f64>, datums: &str) -> Option<Frame> {
    let width = match off > 0.0 {
        true => 2.0 * off,
        false => grade(distance, "H8")?,
    };
    // If two holes are each off by half of `apart`, their distance is off by `apart`: the width is limited to it.
    let width = apart.map_or(width, |apart| width.min((apart * 1e3).floor() / 1e3));
    let value = format!("Ø{}", number(width, 3));
    Some(Frame::new(Characteristic::Position, value, datums))
}

/// Position tolerance of the median plane of a slot: grade IT8 of its distance from the datum. `None` beyond the grades of ISO
/// 286-1.
pub(crate) fn position_of_slot(distance: f64, datums: &str) -> Option<Frame> {
    let value = number(grade(distance, "H8")?, 3);
    Some(Frame::new(Characteristic::Position, value, datums))
}

/// Symmetry tolerance of a keyway: grade IT9 of its width, as for the width itself. `None` beyond the grades of ISO 286-1.
pub(crate) fn symmetry(width: f64, datums: &str) -> Option<Frame> {
    let value = number(grade(width, SYMMETRY)?, 3);
    Some(Frame::new(Characteristic::Symmetry, value, datums))
}

/// Runout tolerance of a feature: grade IT7 of its diameter. `None` beyond the grades of ISO 286-1.
pub(crate) fn runout(diameter: f64, datums: &str) -> Option<Frame> {
    Some(runout_within(grade(diameter, "H7")?, datums))
}

/// Runout tolerance of a given width, mm.
pub(crate) fn runout_within(width: f64, datums: &str) -> Frame {
    Frame::new(Characteristic::Runout, number(width, 4), datums)
}

/// Profile tolerance of a contour: grade IT8 of its maximum distance `reach` from the datum, mm. `None` beyond the grades of ISO
/// 286-1.
pub(crate) fn profile(reach: f64, datums: &str) -> Option<Frame> {
    let value = number(grade(reach, "H8")?, 3);
    Some(Frame::new(Characteristic::Profile, value, datums))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_grades_of_iso_286_and_frames_have_words() {
        for (frame, words) in [
            // IT8 of 50 to 80 mm is 46 um, IT7 of 80 to 120 mm 35 um.
            (position(60.0, 0.0, None, "A B"), "position Ø0.046 A B"),
            (position(60.0, 0.02, None, "A"), "position Ø0.04 A"),
            // Two holes each off by half of it are so much off their distance, rounded down.
            (position(60.0, 0.0, Some(0.0379), "A"), "position Ø0.037 A"),
            (position(60.0, 0.0, Some(0.2), "A"), "position Ø0.046 A"),
            (runout(100.0, "A"), "runout 0.035 A"),
            // IT8 of 30 to 50 mm is 39 um.
            (profile(40.0, "A"), "profile 0.039 A"),
            (Some(runout_within(0.0465, "A")), "runout 0.0465 A"),
            // IT9 of 3 to 6 mm is 30 um.
            (symmetry(5.0, "A"), "symmetry 0.03 A"),
            (position_of_slot(60.0, "A B"), "position 0.046 A B"),
            (Some(Frame::datum('A')), "datum A"),
        ] {
            assert_eq!(frame.expect("a grade").to_string(), words);
        }
        assert_eq!(runout(501.0, "A"), None);
    }
}
