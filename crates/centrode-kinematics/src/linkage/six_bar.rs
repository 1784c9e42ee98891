use std::f64::consts::TAU;

use centrode_geometry::{Point, Vector};

use super::four_bar::{FourBar, Grashof, joints};
use super::laps::Unwrap;
use super::point_series::PointSeries;
use super::slider_arc::SliderArc;
use crate::formula::Taylor;
use crate::transmission::{FromFn, Transmission};

/// Reason why there is no such six-bar.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SixBarError {
    /// The four-bar in it is not a crank-rocker.
    #[error(
        "the four-bar must be a crank-rocker, but it is a {}: the crank must be the shortest link, and Grashof's margin must be above 0: it is {margin} mm (the two other lengths minus shortest and longest)", .class.name()
    )]
    NotCrankRocker {
        /// Its Grashof type.
        class: Grashof,
        /// Grashof margin: the two other lengths less shortest and longest, mm.
        margin: f64,
    },
    /// The effector's pivot lies on the path of the slider.
    #[error(
        "the effector's pivot ({x}, {y}) mm lies on the path of the slider: the effector's angle is not defined there"
    )]
    PivotOnPath {
        /// X coordinate of the pivot, mm.
        x: f64,
        /// Y coordinate of the pivot, mm.
        y: f64,
    },
    /// A number that is not finite.
    #[error("{name} is {value}; it must be finite, and above zero if it is a length")]
    Value {
        /// Name of the number.
        name: &'static str,
        /// Number as given.
        value: f64,
    },
}

/// The ends of the effector's swing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EffectorExtremes {
    /// Crank angle and effector angle at the lower end, rad.
    pub low: (f64, f64),
    /// Crank angle and effector angle at the upper end, rad.
    pub high: (f64, f64),
}

impl EffectorExtremes {
    /// Crank angle of the longer of the two strokes, rad.
    #[must_use]
    pub fn longer_stroke(&self) -> f64 {
        let one = (self.high.0 - self.low.0).rem_euclid(TAU);
        one.max(TAU - one)
    }
}

/// Sensitivity of the swing to each dimension, rad/mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwingSensitivity {
    /// Sensitivity to the lengths of crank, coupler, rocker and frame.
    pub lengths: [f64; 4],
    /// Sensitivity to the position of the effector's pivot.
    pub pivot: Vector,
}

/// The picking six-bar: a crank-rocker ABCD that swings an end effector about a fixed pivot F through
/// a slider at C.
///
/// A is the origin and D = (frame, 0). The effector's angle is the direction from F to C, unwrapped; its
/// tip E is F + effector length (cos, sin). Ye et al. 2022, DOI 10.6041/j.issn.1000-1298.2022.05.010,
/// equations (2) to (11), derived again: (5) and (10) need the two-argument arctangent, and (4) as
/// printed is the lower branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SixBar {
    four_bar: FourBar,
    pivot: Point,
    effector_length: f64,
    extremes: EffectorExtremes,
    pub(super) laps: Unwrap,
}

impl SixBar {
    /// Makes a six-bar on a crank-rocker.
    ///
    /// # Errors
    /// [`SixBarError`].
    pub fn new(four_bar: FourBar, pivot: Point, effector_length: f64) -> Result<Self, SixBarError> {
        for (name, value) in [("the pivot's x", pivot.x), ("the pivot's y", pivot.y)] {
            if !value.is_finite() {
                return Err(SixBarError::Value { name, value });
            }
        }
        if !(effector_length.is_finite() && effector_length > 0.0) {
            let (name, value) = ("the effector's length", effector_length);
            return Err(SixBarError::Value { name, value });
        }
        let class = four_bar.grashof();
        let margin = four_bar.grashof_margin();
        let arc = SliderArc::new(&four_bar).ok_or(SixBarError::NotCrankRocker { class, margin })?;
        if arc.distance(pivot) <= 0.0 {
            let (x, y) = (pivot.x, pivot.y);
            return Err(SixBarError::PivotOnPath { x, y });
        }
        let extremes = arc.extremes(pivot);
        Ok(Self {
            four_bar,
            pivot,
            effector_length,
            extremes,
            laps: Unwrap::about(0.5 * (extremes.low.1 + extremes.high.1)),
        })
    }

    /// The crank-rocker in it.
    #[must_use]
    pub fn four_bar(&self) -> &FourBar {
        &self.four_bar
    }

    /// The effector's pivot F.
    #[must_use]
    pub fn pivot(&self) -> Point {
        self.pivot
    }

    /// Length of the effector from F to its tip, mm.
    #[must_use]
    pub fn effector_length(&self) -> f64 {
        self.effector_length
    }

    /// Minimum distance of the slider from the effector's pivot, mm.
    #[must_use]
    pub fn minimum_slider_distance(&self) -> f64 {
        SliderArc::new(&self.four_bar).map_or(0.0, |arc| arc.distance(self.pivot))
    }

    /// Maximum distance of the slider from the effector's pivot, mm.
    #[must_use]
    pub fn maximum_slider_distance(&self) -> f64 {
        SliderArc::new(&self.four_bar).map_or(0.0, |arc| arc.farthest(self.pivot))
    }

    /// The ends of the effector's swing.
    ///
    /// They are dead centres of the crank-rocker, or positions in which the line from the pivot to the slider is tangent to the
    /// slider's path.
    #[must_use]
    pub fn extremes(&self) -> EffectorExtremes {
        self.extremes
    }

    /// Angle between the ends of the effector's motion, rad.
    #[must_use]
    pub fn swing(&self) -> f64 {
        self.extremes.high.1 - self.extremes.low.1
    }

    /// Exact sensitivity of the swing to each dimension.
    ///
    /// At an end of the swing the effector is at rest, so the end's own shift along the cycle does not
    /// count: the change of the swing is that of the effector's angle at the two crank angles.
    #[must_use]
    pub fn swing_sensitivity(&self) -> SwingSensitivity {
        let slope = |dimension: usize, input: f64| {
            let is = |k: usize, value: f64| {
                if k == dimension {
                    Taylor::<2>::variable(value)
                } else {
                    Taylor::constant(value)
                }
            };
            let lengths = self.four_bar.lengths();
            let lengths: [Taylor<2>; 4] = std::array::from_fn(|k| is(k, lengths[k]));
            let pivot = PointSeries {
                x: is(4, self.pivot.x),
                y: is(5, self.pivot.y),
            };
            let crank = PointSeries::unit(Taylor::constant(input));
            let (_, c) = joints(lengths, self.four_bar.branch(), crank);
            c.at.minus(pivot).angle().0[1]
        };
        let change = |dimension: usize| {
            slope(dimension, self.extremes.high.0) - slope(dimension, self.extremes.low.0)
        };
        SwingSensitivity {
            lengths: std::array::from_fn(change),
            pivot: Vector::new(change(4), change(5)),
        }
    }

    /// The effector's angle as a function of the crank angle.
    #[must_use]
    pub fn transmission(&self) -> impl Transmission + use<> {
        let six_bar = *self;
        FromFn::new(TAU, 0.0, Vec::new(), move |input| {
            six_bar.effector_angle(input)
        })
    }
}
