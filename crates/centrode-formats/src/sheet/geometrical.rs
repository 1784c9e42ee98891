//! Datums and geometrical tolerances, ISO 5459 and ISO 1101.

use super::draft::ARROW;
use super::{Draft, Pen, lettering};
use crate::drawing::{Anchor, EntityShape};
use centrode_geometry::{Arc, Bounds, Outline, Point, Vector};
use std::fmt;

/// Room next to the words of a cell, mm.
const PAD: f64 = 1.0;
/// Height of the letters in a frame, mm.
const LETTERS: f64 = 2.5;
/// Half the height of a frame, mm.
const HALF: f64 = 2.15;

/// Tolerated property of a feature.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Characteristic {
    /// Position of an axis; the zone is a cylinder.
    Position,
    /// Form and position of a profile, the zone equally on both sides of it.
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

/// A line of a note next to a feature.
#[derive(Clone, Debug, PartialEq)]
pub enum NoteLine {
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
    /// The words; a frame is written in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Words(words) => f.write_str(words),
            Self::Frame(frame) => frame.fmt(f),
        }
    }
}

/// Geometrical tolerance of a feature, or its datum letter.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Kind of tolerance.
    pub characteristic: Characteristic,
    /// Value and letters, each in a cell.
    cells: Vec<String>,
}

impl Frame {
    /// Datum with a letter.
    pub fn datum(letter: char) -> Self {
        Self {
            characteristic: Characteristic::Datum,
            cells: vec![letter.to_string()],
        }
    }

    /// Tolerance with a value in mm, written without the unit, and the letters of its datums, separated by spaces.
    pub fn new(characteristic: Characteristic, value: String, datums: &str) -> Self {
        let letters = datums.split(' ').map(String::from);
        Self {
            characteristic,
            cells: std::iter::once(value).chain(letters).collect(),
        }
    }

    /// Width of the frame and of words above it on a sheet, mm.
    pub fn width(&self, words: &str) -> f64 {
        let own: f64 = self.widths().iter().sum();
        own.max(lettering::width(words, LETTERS))
    }

    fn widths(&self) -> Vec<f64> {
        let wide = |cell: &String| lettering::width(cell, LETTERS) + 2.0 * PAD;
        let cells = self.cells.iter().map(wide).map(|w| w.max(2.0 * HALF));
        // The triangle of a datum is in the position of a tolerance symbol.
        std::iter::once(2.0 * HALF).chain(cells).collect()
    }
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.characteristic.name(), self.cells.join(" "))
    }
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
    pub fn pointed_frame(&mut self, tip: Point, at: Point, frame: &Frame, words: &str) {
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
    fn a_frame_is_as_wide_as_its_line_says() {
        for frame in [
            Frame::new(Characteristic::Runout, "0.021".into(), "A"),
            Frame::new(Characteristic::Position, "Ø0.033".into(), "A B"),
            Frame::new(Characteristic::Profile, "0.033".into(), "A"),
            Frame::new(Characteristic::Symmetry, "0.03".into(), "A"),
            Frame::datum('B'),
        ] {
            let mut draft = Draft::default();
            draft.frame(Point::new(5.0, 0.0), &frame);
            let bounds = draft.bounds();
            let wide = NoteLine::from(frame).width(3.5);
            assert!((bounds.max.x - 5.0 - wide).abs() < 1e-9);
            assert!(bounds.max.y < HALF + 1e-9 && bounds.min.y > -HALF - 1e-9);
        }
    }
}
