use crate::reverse::{AxisFault, PathError};
use centrode_spec::SpecError;

/// Reason why a path is not eased.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EasingError {
    /// The points make no path.
    #[error(transparent)]
    Path(#[from] PathError),
    /// A band that is negative or not finite.
    #[error("the band of point {number} must be zero or more, in mm, not {band:?}")]
    Band {
        /// Number of the point, from one.
        number: usize,
        /// Band given, mm.
        band: f64,
    },
    /// Another number of bands than of points.
    #[error("there are {bands} bands for {points} points: give one for each, or one for all")]
    Bands {
        /// Bands given.
        bands: usize,
        /// Points.
        points: usize,
    },
    /// Too few points of a working part.
    #[error("the working part of a path must have {minimum} points or more, not {count}")]
    TooFew {
        /// Points given.
        count: usize,
        /// Fewest.
        minimum: usize,
    },
    /// No return closes the working part.
    #[error(
        "no machine of this kind can move its tip along the points: with {axis}, none of the {returns} returns tried from the last point to the first is possible"
    )]
    NoReturn {
        /// Returns tried.
        returns: usize,
        /// With which axes.
        axis: &'static str,
    },
    /// A wish that breaks a rule.
    #[error("wishes.{0}")]
    Wish(#[from] SpecError),
    /// A module that is not a positive number.
    #[error("the module must be greater than zero, in mm, not {module:?}")]
    Module {
        /// Module given, mm.
        module: f64,
    },
    /// The axis given makes no machine for the required path.
    #[error(transparent)]
    Axis(#[from] AxisFault),
    /// No axis tried makes a machine for the required path.
    #[error(
        "no machine of this kind can move its tip along the path: none of the {tried} axes tried on and around the path is possible"
    )]
    NoAxis {
        /// Axes tried.
        tried: usize,
    },
}
