//! Path from an SVG file.

mod svg;

use centrode_geometry::{Extreme, Point, maximum, piece_ends};
use kurbo::{ParamCurve as _, ParamCurveArclen as _, ParamCurveDeriv as _, PathSeg};
use thiserror::Error;

use super::path::text;
use super::{PathError, RequiredPath};
use centrode_spec::digits::stated;

/// Minimum and maximum number of points through which a curve is laid.
const FEWEST: usize = 32;
const MOST: usize = 1024;
/// Maximum error of a length along the drawing, as a share of the whole length; or, if more, this number of roundings of a
/// coordinate.
const LENGTH: f64 = 1e-12;
const ROUNDINGS: f64 = 16.0;

/// Points along a closed path of an SVG file, evenly spread over its length; the first is the start of the drawing.
///
/// The curvature of a drawing jumps where its pieces join; the path of a machine must not have such jumps. The closed spline of
/// [`RequiredPath::through`] runs through the smallest number of points, 32, 64 and so on, with which it comes within the given
/// distance of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnPath {
    /// The points, mm: x to the right and y up from the drawing's lower left corner.
    pub points: Vec<Point>,
    /// Maximum distance of the drawing from the spline through the points, mm, and the position along the drawing, mm.
    pub deviation: Extreme,
}

impl DrawnPath {
    /// Reads the only path of a drawing whose root states its size (`width="210mm" viewBox="0 0 210 297"`); `within` is the
    /// maximum distance allowed between drawing and spline, mm.
    ///
    /// Groups and transforms are followed. Shapes that are not paths (circles, texts), and elements that are only defined or
    /// hidden, are ignored; drawings within the drawing, uses of other shapes and transforms in styles are refused.
    ///
    /// # Errors
    /// [`DrawingError`] for a file that is no such drawing, for an open path, and for a path with a corner, to which no spline
    /// comes near.
    pub fn from_svg(bytes: &[u8], within: f64) -> Result<Self, PathError> {
        if !(within > 0.0 && within.is_finite()) {
            return Err(DrawingError::Within { within }.into());
        }
        let drawing = Drawing::new(svg::closed_path(text(bytes)?)?);
        let mut count = FEWEST;
        loop {
            let points: Vec<Point> = (0..count)
                .map(|i| drawing.at(drawing.length * i as f64 / count as f64))
                .collect();
            let path = RequiredPath::through(&points)?;
            let step = drawing.length / count as f64;
            // Ends of the pieces of the spline, and the joints of the drawing.
            let ends = piece_ends(0.0, drawing.length, count as u32, &drawing.joints());
            let off = |s: f64| path.distance_near(drawing.at(s), s / step);
            let deviation = maximum(off, &ends);
            if deviation.value <= within {
                return Ok(Self { points, deviation });
            }
            count *= 2;
            if count > MOST {
                return Err(drawing.corner(within, deviation.value).into());
            }
        }
    }
}

/// Pieces of a closed path and the lengths at which they start.
struct Drawing {
    /// Pieces and their starts in units of the drawing's size: lengths along a curve are found for curves of a size near 1.
    segments: Vec<PathSeg>,
    starts: Vec<f64>,
    /// Size of the drawing, mm.
    size: f64,
    /// Maximum error of a length, in units of the size: a small drawing far from the origin has fewer digits.
    accuracy: f64,
    /// Length of the whole path, mm.
    length: f64,
}

impl Drawing {
    fn new(segments: Vec<PathSeg>) -> Self {
        // The path is at least as long as the polygon of the pieces' ends.
        let size: f64 = segments.iter().map(|s| (s.end() - s.start()).hypot()).sum();
        let far = |at: kurbo::Point| at.x.abs().max(at.y.abs());
        let far = segments.iter().map(|s| far(s.start())).fold(0.0, f64::max);
        let accuracy = (ROUNDINGS * f64::EPSILON * far / size).max(LENGTH);
        let unit = kurbo::Affine::scale(1.0 / size);
        let segments: Vec<PathSeg> = segments.iter().map(|s| unit * *s).collect();
        let mut length = 0.0;
        let mut starts = Vec::with_capacity(segments.len());
        for segment in &segments {
            starts.push(length);
            length += segment.arclen(accuracy);
        }
        Self {
            segments,
            starts,
            size,
            accuracy,
            length: length * size,
        }
    }

    /// Lengths at which the pieces start, mm.
    fn joints(&self) -> Vec<f64> {
        self.starts.iter().map(|start| start * self.size).collect()
    }

    /// Point at a length from the start.
    fn at(&self, s: f64) -> Point {
        let s = s / self.size;
        let number = self.starts.partition_point(|&start| start <= s);
        let number = number.saturating_sub(1);
        let segment = &self.segments[number];
        let t = segment.inv_arclen(s - self.starts[number], self.accuracy);
        self.placed(segment.eval(t))
    }

    fn placed(&self, at: kurbo::Point) -> Point {
        Point::new(at.x * self.size, at.y * self.size)
    }

    /// The sharpest corner, to which no spline comes near.
    fn corner(&self, within: f64, reached: f64) -> DrawingError {
        let next = self.segments.iter().cycle().skip(1);
        let joints = self.segments.iter().zip(next).map(|(one, other)| {
            let (before, after) = (tangent(one, 1.0), tangent(other, 0.0));
            let turn = before.cross(after).atan2(before.dot(after)).abs();
            (turn.to_degrees(), self.placed(one.end()))
        });
        let sharpest = |a: &(f64, Point), b: &(f64, Point)| a.0.total_cmp(&b.0);
        let (angle, at) = joints.max_by(sharpest).unwrap_or((0.0, Point::origin()));
        let (x, y) = (at.x, at.y);
        DrawingError::Corner {
            within,
            reached,
            count: MOST,
            angle,
            x,
            y,
        }
    }
}

/// Direction of a piece at one of its ends, also if a handle coincides with the end point.
fn tangent(segment: &PathSeg, t: f64) -> kurbo::Vec2 {
    let cubic = segment.to_cubic();
    let derivative = cubic.deriv().eval(t).to_vec2();
    if derivative.hypot() > 0.0 {
        return derivative;
    }
    let inner = if t < 0.5 { 1e-6 } else { 1.0 - 1e-6 };
    cubic.deriv().eval(inner).to_vec2()
}

/// Reason why a drawing gives no path.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum DrawingError {
    /// A file that is no XML.
    #[error("the drawing cannot be read: {why}")]
    Xml {
        /// Message of the reader.
        why: String,
    },
    /// XML whose root is another than svg.
    #[error("the drawing's root is <{root}>; it must be <svg>")]
    NotSvg {
        /// Name of the root.
        root: String,
    },
    /// A root without the size of the drawing.
    #[error(
        "the drawing does not state its size: {why}; write it at the root as width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\""
    )]
    Size {
        /// Key at fault, and its value.
        why: String,
    },
    /// A feature of SVG that positions a path and is not supported.
    #[error("{what} in the drawing is not supported: {remedy}")]
    NotFollowed {
        /// Name of the feature.
        what: &'static str,
        /// How to change the drawing so that it does not need the feature.
        remedy: &'static str,
    },
    /// No path, or several.
    #[error(
        "the drawing has {count} paths; it must contain only the path to follow (the drawing program changes circles and other shapes into paths with \"object to path\")"
    )]
    Paths {
        /// Number of paths.
        count: usize,
    },
    /// A path without length.
    #[error("the path of the drawing has no length")]
    Empty,
    /// Data of a path or a transform that cannot be read.
    #[error("{key} = {data:?} of the drawing cannot be read: {why}")]
    Data {
        /// Key.
        key: &'static str,
        /// Its first characters.
        data: String,
        /// Message of the reader.
        why: String,
    },
    /// A path of several lines.
    #[error(
        "the path of the drawing consists of {count} separate lines; it must be one closed line"
    )]
    Several {
        /// Number of lines.
        count: usize,
    },
    /// A path that does not end where it begins.
    #[error("the path of the drawing is open: it begins at ({:.4}, {:.4}) mm and ends at ({:.4}, {:.4}) mm", from[0], from[1], to[0], to[1])]
    Open {
        /// Start, mm.
        from: [f64; 2],
        /// End, mm.
        to: [f64; 2],
    },
    /// A path of too many pieces.
    #[error("the path of the drawing has {count} pieces; the limit is {limit}")]
    TooMany {
        /// Pieces.
        count: usize,
        /// Most allowed.
        limit: usize,
    },
    /// A coordinate that is no number or too large.
    #[error(
        "the path of the drawing reaches ({x:e}, {y:e}) mm: coordinates may be up to {limit:e} mm"
    )]
    TooFar {
        /// Its x, mm.
        x: f64,
        /// Its y, mm.
        y: f64,
        /// Maximum coordinate, mm.
        limit: f64,
    },
    /// A path to which no smooth curve comes near enough.
    #[error(
        "a smooth curve through {count} points comes within {} mm of the drawing, not within {} mm: the sharpest joint of its pieces turns by {angle:.2} deg, at ({x:.4}, {y:.4}) mm; round corners, or allow a larger distance",
        stated(*reached),
        stated(*within)
    )]
    Corner {
        /// Distance allowed, mm.
        within: f64,
        /// Distance reached, mm.
        reached: f64,
        /// Points of the curve.
        count: usize,
        /// Angle of the sharpest joint, degrees.
        angle: f64,
        /// Its position, mm.
        x: f64,
        /// Its position, mm.
        y: f64,
    },
    /// An allowed distance that is not a positive number.
    #[error(
        "the distance allowed from the drawing is {within} mm; it must be a number greater than zero"
    )]
    Within {
        /// The distance, mm.
        within: f64,
    },
}

#[cfg(test)]
mod tests;
