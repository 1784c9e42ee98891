//! Geometrical tolerances of features by the grades of ISO 286-1.

use centrode_formats::sheet::geometrical::{Characteristic, Frame};
use centrode_formats::sheet::number;
use centrode_kinematics::machine::limits_of_size;

/// Class whose width is the symmetry of a keyway, by the width of that.
pub(crate) const SYMMETRY: &str = "H9";

/// Width of a tolerance grade for a size, mm, ISO 286-1, by a class of holes of that grade.
pub(crate) fn grade(size: f64, class: &str) -> Option<f64> {
    limits_of_size(size, class).map(|[low, high]| high - low)
}

/// Position of an axis at a distance from its datum: within the eighth grade of that distance, or twice what it may be off
/// in either direction. None beyond the grades of ISO 286-1.
pub(crate) fn position(distance: f64, off: f64, apart: Option<f64>, datums: &str) -> Option<Frame> {
    let width = match off > 0.0 {
        true => 2.0 * off,
        false => grade(distance, "H8")?,
    };
    // Two holes that each are off by half of it are so far off their distance.
    let width = apart.map_or(width, |apart| width.min((apart * 1e3).floor() / 1e3));
    let value = format!("Ø{}", number(width, 3));
    Some(Frame::new(Characteristic::Position, value, datums))
}

/// Position of the median plane of a slot at a distance from its datum: within the eighth grade of that distance. None beyond the
/// grades of ISO 286-1.
pub(crate) fn position_of_slot(distance: f64, datums: &str) -> Option<Frame> {
    let value = number(grade(distance, "H8")?, 3);
    Some(Frame::new(Characteristic::Position, value, datums))
}

/// Symmetry of a keyway of a width: within the ninth grade of that, as the width itself. None beyond the grades of ISO 286-1.
pub(crate) fn symmetry(width: f64, datums: &str) -> Option<Frame> {
    let value = number(grade(width, SYMMETRY)?, 3);
    Some(Frame::new(Characteristic::Symmetry, value, datums))
}

/// Runout of a feature of a diameter: within the seventh grade of that. None beyond the grades of ISO 286-1.
pub(crate) fn runout(diameter: f64, datums: &str) -> Option<Frame> {
    Some(runout_within(grade(diameter, "H7")?, datums))
}

/// Runout within a width, mm.
pub(crate) fn runout_within(width: f64, datums: &str) -> Frame {
    Frame::new(Characteristic::Runout, number(width, 4), datums)
}

/// Profile of a contour that reaches so far from its datum, mm: within the eighth grade of that. None beyond the grades of
/// ISO 286-1.
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
