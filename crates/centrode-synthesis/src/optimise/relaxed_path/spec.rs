//! Request and result of an easing.

use crate::reverse::{Aim, AxisRange, TwoBar, Wishes};
use centrode_geometry::Point;

use centrode_analysis::{Finding, Goal};

/// Room that a path has, and wishes about its machine.
#[derive(Clone, Debug)]
pub struct EasingSpec {
    /// Distance within which the path may pass each point, mm, or one for all.
    pub bands: Vec<f64>,
    /// Axis of the carrier, mm, if it is given.
    pub axis: Option<Point>,
    /// Axes among which it is searched otherwise; default: those about the path.
    pub axes: Option<AxisRange>,
    /// Angle from the carrier's first leg to its second, rad.
    pub bend: f64,
    /// Figure that is made the most of.
    pub aim: Aim,
    /// Further wishes.
    pub wishes: Wishes,
}

impl EasingSpec {
    /// Points within their bands, mm, of a machine with a bend, rad, its axis free, for the largest teeth.
    #[must_use]
    pub fn new(bands: &[f64], bend: f64) -> Self {
        Self {
            bands: bands.to_vec(),
            axis: None,
            axes: None,
            bend,
            aim: Aim::Module,
            wishes: Wishes::default(),
        }
    }
}

/// A path eased within its bands, and its machine.
#[derive(Clone, Debug)]
pub struct EasedPath {
    /// Points of the path: those given, then those of a free return.
    pub points: Vec<Point>,
    /// Distance of each point given from where it was required, mm.
    pub moved: Vec<f64>,
    /// Carrier and arm.
    pub chain: TwoBar,
    /// Module up to which full teeth are surely sound, mm: on the pitch curves of the required path, where the axis found makes
    /// a machine for it, and on those of the eased one.
    pub module: (Option<f64>, f64),
    /// Further wishes, and how far they are reached.
    pub goals: Vec<Goal>,
    /// Direction of the clamp less that of the arm, rad, where directions were required.
    pub clamp: Option<f64>,
    /// Evaluations of the search.
    pub evaluations: u64,
    /// Finding on the axis, where there is one: `axis-at-border`.
    pub findings: Vec<Finding>,
}
