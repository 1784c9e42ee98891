//! Datums and geometrical tolerances, ISO 5459 and ISO 1101.

use std::fmt;

use centrode_geometry::{Arc, Bounds, Outline, Point, Vector};
use centrode_kinematics::machine::limits_of_size;

use super::{Draft, Pen, draft::ARROW, lettering, number};
use crate::drawing::{Anchor, EntityShape};

/// Room beside the words of a cell, mm.
const PAD: f64 = 1.0;
/// Height of the letters in a frame, mm.
const LETTERS: f64 = 2.5;
/// Half the height of a frame, mm.
const HALF: f64 = 2.15;

/// Tolerated property of a feature.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Characteristic {
    /// Place of an axis; the zone is a cylinder.
    Position,
    /// Form and place of a profile, the zone equally on both sides of it.
    Profile,
    /// Median plane of a feature on that of its datum.
    Symmetry,
    /// Circular runout, axial on a face and radial on a cylinder.
    Runout,
    /// A feature that others refer to, with its letter.
    Datum,
}

impl Characteristic {
    fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Profile => "profile",
            Self::Symmetry => "symmetry",
            Self::Runout => "runout",
            Self::Datum => "datum",
        }
    }
}

/// A line of a note beside a feature.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum NoteLine {
    /// Words.
    Words(String),
    /// A geometrical tolerance or a datum.
    Frame(Frame),
}

impl NoteLine {
    /// Width on a sheet, mm, with letters of a height.
    pub(super) fn width(&self, letters: f64) -> f64 {
        match self {
            Self::Words(words) => lettering::width(words, letters),
            Self::Frame(frame) => frame.width(""),
        }
    }
}

impl From<String> for NoteLine {
    fn from(words: String) -> Self {
        Self::Words(words)
    }
}

impl From<Frame> for NoteLine {
    fn from(frame: Frame) -> Self {
        Self::Frame(frame)
    }
}

impl fmt::Display for NoteLine {
    /// The words; those of a frame say what it shows.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Words(words) => f.write_str(words),
            Self::Frame(frame) => frame.fmt(f),
        }
    }
}

/// Geometrical tolerance of a feature, or its datum letter.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frame {
    pub(crate) characteristic: Characteristic,
    /// Value and letters, each in a cell.
    cells: Vec<String>,
}

impl Frame {
    /// Datum of a letter.
    pub(crate) fn datum(letter: char) -> Self {
        Self {
            characteristic: Characteristic::Datum,
            cells: vec![letter.to_string()],
        }
    }

    /// Position of an axis at a distance from its datum: within the eighth grade of that distance, or twice what it may be off
    /// either way. None beyond the grades of ISO 286-1.
    pub(crate) fn position(
        distance: f64,
        off: f64,
        apart: Option<f64>,
        datums: &str,
    ) -> Option<Self> {
        let width = match off > 0.0 {
            true => 2.0 * off,
            false => grade(distance, "H8")?,
        };
        // Two holes that each are off by half of it are so far off their distance.
        let width = apart.map_or(width, |apart| width.min((apart * 1e3).floor() / 1e3));
        let value = format!("Ø{}", number(width, 3));
        Some(Self::new(Characteristic::Position, value, datums))
    }

    /// Position of the median plane of a slot at a distance from its datum: within the eighth grade of that distance. None beyond the
    /// grades of ISO 286-1.
    pub(crate) fn position_of_slot(distance: f64, datums: &str) -> Option<Self> {
        let value = number(grade(distance, "H8")?, 3);
        Some(Self::new(Characteristic::Position, value, datums))
    }

    /// Symmetry of a keyway of a width: within the ninth grade of that, as the width itself. None beyond the grades of ISO 286-1.
    pub(crate) fn symmetry(width: f64, datums: &str) -> Option<Self> {
        let value = number(grade(width, SYMMETRY)?, 3);
        Some(Self::new(Characteristic::Symmetry, value, datums))
    }

    /// Runout of a feature of a diameter: within the seventh grade of that. None beyond the grades of ISO 286-1.
    pub(crate) fn runout(diameter: f64, datums: &str) -> Option<Self> {
        Some(Self::runout_within(grade(diameter, "H7")?, datums))
    }

    /// Runout within a width, mm.
    pub(crate) fn runout_within(width: f64, datums: &str) -> Self {
        Self::new(Characteristic::Runout, number(width, 4), datums)
    }

    /// Profile of a contour that reaches so far from its datum, mm: within the eighth grade of that. None beyond the grades of
    /// ISO 286-1.
    pub(crate) fn profile(reach: f64, datums: &str) -> Option<Self> {
        let value = number(grade(reach, "H8")?, 3);
        Some(Self::new(Characteristic::Profile, value, datums))
    }

    fn new(characteristic: Characteristic, value: String, datums: &str) -> Self {
        let letters = datums.split(' ').map(String::from);
        Self {
            characteristic,
            cells: std::iter::once(value).chain(letters).collect(),
        }
    }

    /// Width of the frame and of words above it on a sheet, mm.
    pub(crate) fn width(&self, words: &str) -> f64 {
        let own: f64 = self.widths().iter().sum();
        own.max(lettering::width(words, LETTERS))
    }

    fn widths(&self) -> Vec<f64> {
        let wide = |cell: &String| lettering::width(cell, LETTERS) + 2.0 * PAD;
        let cells = self.cells.iter().map(wide).map(|w| w.max(2.0 * HALF));
        // The triangle of a datum stands where the symbol of a tolerance does.
        std::iter::once(2.0 * HALF).chain(cells).collect()
    }
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.characteristic.name(), self.cells.join(" "))
    }
}

/// Class whose width is the symmetry of a keyway, by the width of that.
pub(crate) const SYMMETRY: &str = "H9";

/// Width of a tolerance grade for a size, mm, ISO 286-1, by a class of holes of that grade.
pub(crate) fn grade(size: f64, class: &str) -> Option<f64> {
    limits_of_size(size, class).map(|[low, high]| high - low)
}

impl Draft {
    /// Writes a line of a note from the left end of its baseline, or draws its frame.
    pub(super) fn line_of_note(&mut self, at: Point, line: &NoteLine) {
        match line {
            NoteLine::Frame(frame) => self.frame(at + Vector::new(0.0, 0.5 * self.letters), frame),
            NoteLine::Words(words) => self.text(at, self.letters, words, Anchor::Left),
        }
    }

    /// Draws a frame from the middle of its left side, with a leader from a feature and words above it.
    pub(crate) fn pointed_frame(&mut self, tip: Point, at: Point, frame: &Frame, words: &str) {
        self.arrow(tip, tip - at);
        self.line(Pen::Dimension, tip, at);
        self.frame(at, frame);
        let above = at + Vector::new(0.0, HALF + 1.0);
        self.text(above, LETTERS, words, Anchor::Left);
    }

    fn frame(&mut self, at: Point, frame: &Frame) {
        let mut left = at.x;
        for (index, width) in frame.widths().into_iter().enumerate() {
            let middle = Point::new(left + 0.5 * width, at.y);
            match index.checked_sub(1) {
                None => self.symbol(frame.characteristic, middle),
                Some(cell) => {
                    let base = middle - Vector::new(0.0, 0.5 * LETTERS);
                    self.text(base, LETTERS, &frame.cells[cell], Anchor::Middle);
                }
            }
            if index > 0 || frame.characteristic != Characteristic::Datum {
                self.rectangle(
                    Pen::Dimension,
                    Bounds {
                        min: Point::new(left, at.y - HALF),
                        max: Point::new(left + width, at.y + HALF),
                    },
                );
            }
            left += width;
        }
    }

    fn symbol(&mut self, characteristic: Characteristic, middle: Point) {
        let p = |x: f64, y: f64| middle + Vector::new(x, y);
        match characteristic {
            Characteristic::Position => {
                let circle = Outline::circle(middle, 0.9);
                self.draw(Pen::Dimension, EntityShape::Contour(circle));
                self.line(Pen::Dimension, p(-1.5, 0.0), p(1.5, 0.0));
                self.line(Pen::Dimension, p(0.0, -1.5), p(0.0, 1.5));
            }
            Characteristic::Profile => {
                // Half a circle on its diameter.
                let half = Arc {
                    start: p(1.5, -0.7),
                    end: p(-1.5, -0.7),
                    bulge: 1.0,
                };
                self.draw(Pen::Dimension, EntityShape::Arc(half));
                self.line(Pen::Dimension, half.start, half.end);
            }
            Characteristic::Symmetry => {
                for (y, half) in [(-0.8, 0.9), (0.0, 1.5), (0.8, 0.9)] {
                    self.line(Pen::Dimension, p(-half, y), p(half, y));
                }
            }
            Characteristic::Runout => {
                self.line(Pen::Dimension, p(-1.4, -1.4), p(1.4, 1.4));
                let head = Vector::new(1.0, 1.0).normalize();
                let side = Vector::new(-head.y, head.x) * (0.16 * ARROW);
                let foot = p(1.4, 1.4) - head * (0.5 * ARROW);
                let corners = [p(1.4, 1.4), foot + side, foot - side];
                self.draw(Pen::Dimension, EntityShape::Triangle(corners));
            }
            Characteristic::Datum => {
                let corners = [p(-1.8, 1.3), p(-1.8, -1.3), p(0.4, 0.0)];
                self.draw(Pen::Dimension, EntityShape::Triangle(corners));
                self.line(Pen::Dimension, p(0.4, 0.0), p(HALF, 0.0));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_grades_of_iso_286_and_frames_have_words() {
        // IT8 of 50 to 80 mm is 46 um, IT7 of 80 to 120 mm 35 um.
        let position = Frame::position(60.0, 0.0, None, "A B").expect("a grade");
        assert_eq!(position.to_string(), "position Ø0.046 A B");
        let off = Frame::position(60.0, 0.02, None, "A").expect("a grade");
        assert_eq!(off.to_string(), "position Ø0.04 A");
        // Two holes each off by half of it are so much off their distance, rounded down.
        let meshing = Frame::position(60.0, 0.0, Some(0.0379), "A").expect("a grade");
        assert_eq!(meshing.to_string(), "position Ø0.037 A");
        let wide = Frame::position(60.0, 0.0, Some(0.2), "A").expect("a grade");
        assert_eq!(wide.to_string(), "position Ø0.046 A");
        let runout = Frame::runout(100.0, "A").expect("a grade");
        assert_eq!(runout.to_string(), "runout 0.035 A");
        // IT8 of 30 to 50 mm is 39 um.
        let profile = Frame::profile(40.0, "A").expect("a grade");
        assert_eq!(profile.to_string(), "profile 0.039 A");
        assert_eq!(
            Frame::runout_within(0.0465, "A").to_string(),
            "runout 0.0465 A"
        );
        assert_eq!(Frame::runout(501.0, "A"), None);
        // IT9 of 3 to 6 mm is 30 um.
        let keyway = Frame::symmetry(5.0, "A").expect("a grade");
        assert_eq!(keyway.to_string(), "symmetry 0.03 A");
        let slot = Frame::position_of_slot(60.0, "A B").expect("a grade");
        assert_eq!(slot.to_string(), "position 0.046 A B");
        assert_eq!(NoteLine::from(Frame::datum('A')).to_string(), "datum A");
    }

    #[test]
    fn a_frame_is_as_wide_as_its_line_says() {
        for frame in [
            Frame::runout(30.0, "A"),
            Frame::position(30.0, 0.0, None, "A B"),
            Frame::profile(30.0, "A"),
            Frame::symmetry(5.0, "A"),
            Some(Frame::datum('B')),
        ] {
            let frame = frame.expect("a grade");
            let mut draft = Draft::default();
            draft.frame(Point::new(5.0, 0.0), &frame);
            let bounds = draft.bounds();
            let wide = NoteLine::from(frame).width(3.5);
            assert!((bounds.max.x - 5.0 - wide).abs() < 1e-9);
            assert!(bounds.max.y < HALF + 1e-9 && bounds.min.y > -HALF - 1e-9);
        }
    }
}
