use centrode_geometry::Point;
use thiserror::Error;

use super::DrawingError;
use centrode_spec::NotNumber;
use centrode_spec::digits::stated;

/// Reason why points or a file give no path.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PathError {
    /// A drawing that gives no path.
    #[error(transparent)]
    Drawing(#[from] DrawingError),
    /// A coordinate is NaN or infinite.
    #[error("point {number} of the path is ({x}, {y}): both must be finite numbers", x = stated(*x), y = stated(*y))]
    NotFinite {
        /// Number of the point, from one.
        number: usize,
        /// Its x, mm.
        x: f64,
        /// Its y, mm.
        y: f64,
    },
    /// A coordinate beyond the limit.
    #[error(
        "point {number} of the path is ({}, {}) mm: coordinates may be up to {limit:e} mm", stated(*x), stated(*y)
    )]
    TooFar {
        /// Number of the point, from one.
        number: usize,
        /// Its x, mm.
        x: f64,
        /// Its y, mm.
        y: f64,
        /// Maximum coordinate, mm.
        limit: f64,
    },
    /// A path that is small next to its distance from the origin.
    #[error("the path is {} mm across and up to {} mm from the origin of x and y: too few digits are left for its shape; draw it larger, or nearer to the origin", stated(*size), stated(*far))]
    TooSmall {
        /// Diagonal of the path's bounding box, mm.
        size: f64,
        /// Maximum coordinate, mm.
        far: f64,
    },
    /// Fewer points than make a closed curve.
    #[error("the path has {count} points; a closed curve takes at least {minimum}")]
    TooFew {
        /// Number of points.
        count: usize,
        /// Fewest allowed.
        minimum: usize,
    },
    /// More points than a path may have.
    #[error("the path has {count} points; the limit is {limit}")]
    TooMany {
        /// Number of points.
        count: usize,
        /// Most allowed.
        limit: usize,
    },
    /// Two neighbouring points coincide.
    #[error("points {first} and {second} of the path are both ({x}, {y}) mm: omit one of them", x = stated(*x), y = stated(*y))]
    Twice {
        /// Number of the first, from one.
        first: usize,
        /// Number of the second.
        second: usize,
        /// Their x, mm.
        x: f64,
        /// Their y, mm.
        y: f64,
    },
    /// The last point is far from the first.
    #[error(
        "the path is open: its last point is {gap:.4} mm from the first, and no other two neighbours are more than {step:.4} mm apart; add points of the return"
    )]
    Open {
        /// Distance of the last point from the first, mm.
        gap: f64,
        /// Maximum distance of two other neighbours, mm.
        step: f64,
    },
    /// The path crosses itself.
    #[error("the path crosses itself at ({x:.4}, {y:.4}) mm: are its points in order?")]
    Crossing {
        /// Position, mm.
        x: f64,
        /// Position, mm.
        y: f64,
    },
    /// A file that is too large.
    #[error("the file of the path has {bytes} bytes or more; the limit is {limit}")]
    TooLarge {
        /// Bytes read.
        bytes: usize,
        /// Most allowed.
        limit: usize,
    },
    /// A file that is no text.
    #[error("line {line}: the file of the path is not text in UTF-8")]
    NotText {
        /// Line, from one.
        line: usize,
    },
    /// A tolerance that is negative or not finite.
    #[error("line {line}: the tolerance of a point must be zero or more, in mm, not {}", stated(*value))]
    Tolerance {
        /// Line, from one.
        line: usize,
        /// Value given.
        value: f64,
    },
    /// A line that holds no point.
    #[error(
        "line {line}: {found:?} is not a number; a line must contain x and y in mm, separated by a comma"
    )]
    NotNumber {
        /// Line, from one.
        line: usize,
        /// The word found.
        found: String,
    },
    /// A line of headings that names no columns.
    #[error("line {line}: {fault}; known columns are {known}")]
    Headings {
        /// Line, from one.
        line: usize,
        /// The heading at fault.
        fault: String,
        /// Headings of the columns that a file may have.
        known: String,
    },
    /// A line of too few values, or of values in columns without a heading.
    #[error(
        "line {line} has {count} values; it must contain {required}, separated by commas; other columns need a heading"
    )]
    Columns {
        /// Line, from one.
        line: usize,
        /// Number of values.
        count: usize,
        /// Values that a line must hold.
        required: &'static str,
    },
}

/// Reason why no machine with its carrier's axis at a position has a tip that runs along the path.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum AxisFault {
    /// A coordinate that is not finite or too large.
    #[error("the axis ({}, {}) must be two finite numbers within {limit:e} mm", stated(*x), stated(*y))]
    NotFinite {
        /// Its x, mm.
        x: f64,
        /// Its y, mm.
        y: f64,
        /// Maximum coordinate, mm.
        limit: f64,
    },
    /// An axis so far from the path that rounding spoils the tip's position.
    #[error("the axis is {} mm from the path: it may be up to {} mm away, 1000 times the size of the path", stated(distance.round()), stated(limit.round()))]
    TooFar {
        /// Minimum distance of the path from the axis, mm.
        distance: f64,
        /// Maximum allowed, mm.
        limit: f64,
    },
    /// The distance from the axis has several maximum or minimum points.
    #[error(
        "the distance from the axis has {} maxima along the path, at {}, and as many minima; it must have one of each, where the arm is stretched and folded",
        maxima.len(),
        places(maxima)
    )]
    Extremes {
        /// Positions on the path with a local maximum of the distance, mm.
        maxima: Vec<Point>,
    },
    /// The path is a circle about the axis.
    #[error(
        "the distance from the axis is {distance:.6} mm along the whole path: one arm on the axis would be enough, so the two bars cannot be determined"
    )]
    Circle {
        /// The distance, mm.
        distance: f64,
    },
    /// The path passes through the axis.
    #[error(
        "the distance of the path from the axis is only {distance:.6} mm: the tip would hit the shaft"
    )]
    OnAxis {
        /// Minimum distance, mm.
        distance: f64,
    },
    /// The path winds about the axis more than once.
    #[error(
        "the path goes {turns} times round the axis; it must go round once, or not at all with the axis outside"
    )]
    Winding {
        /// Turns, counter-clockwise positive.
        turns: i32,
    },
    /// An axis inside the path allows one sense only.
    #[error(
        "with the axis inside the path, the carrier turns in the direction of the path, {sense}: the other direction needs an axis outside"
    )]
    Sense {
        /// The sense that is possible, in words.
        sense: &'static str,
    },
    /// The carrier would turn back.
    #[error(
        "the carrier, {carrier:.4} mm long, would turn back near ({:.4}, {:.4}) mm of the path: it must turn in one direction only",
        at.x,
        at.y
    )]
    CarrierTurnsBack {
        /// Length of the carrier, mm.
        carrier: f64,
        /// Position on the path, mm.
        at: Point,
    },
    /// The arm would not move relative to the carrier.
    #[error(
        "the arm would stop on the carrier at ({:.4}, {:.4}) mm of the path, where the path lies on a circle about the axis",
        at.x,
        at.y
    )]
    ArmStops {
        /// Position on the path, mm.
        at: Point,
    },
}

impl From<NotNumber> for PathError {
    fn from(NotNumber { line, found }: NotNumber) -> Self {
        Self::NotNumber { line, found }
    }
}

impl AxisFault {
    /// Short name of the reason, for maps of many axes.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "not-finite",
            Self::TooFar { .. } => "too-far",
            Self::Extremes { .. } => "extremes",
            Self::Circle { .. } => "circle",
            Self::OnAxis { .. } => "on-axis",
            Self::Winding { .. } => "winding",
            Self::Sense { .. } => "sense",
            Self::CarrierTurnsBack { .. } => "carrier-turns-back",
            Self::ArmStops { .. } => "arm-stops",
        }
    }
}

/// The first few points as text.
fn places(points: &[Point]) -> String {
    const SHOWN: usize = 4;
    let words = points.iter().take(SHOWN);
    let mut words: Vec<String> = words.map(|p| format!("({:.4}, {:.4})", p.x, p.y)).collect();
    if points.len() > SHOWN {
        words.push("...".into());
    }
    words.join(", ")
}
