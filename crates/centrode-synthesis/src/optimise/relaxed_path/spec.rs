//! Request and result of an easing.

use crate::reverse::{Aim, AxisRange, TwoBar, Wishes};
use centrode_geometry::Point;

use centrode_analysis::{Finding, Goal};

/// Bands within which a path may move, and wishes about its machine.
#[derive(Clone, Debug)]
pub struct EasingSpec {
    /// Maximum distance at which the path may pass each point, mm: one per point, or one for all.
    pub bands: Vec<f64>,
    /// Axis of the carrier, mm, if it is given.
    pub axis: Option<Point>,
    /// Axes among which the axis is searched if it is not given; default: those around the path.
    pub axes: Option<AxisRange>,
    /// Angle from the carrier's first leg to its second, rad.
    pub bend: f64,
    /// Figure that is optimised.
    pub aim: Aim,
    /// Other requirements.
    pub wishes: Wishes,
}

impl EasingSpec {
    /// A request with bands, mm, and a bend, rad; the axis is free, and the aim is the largest module.
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
    /// Distance of each given point from its required position, mm.
    pub moved: Vec<f64>,
    /// Carrier and arm.
    pub chain: TwoBar,
    /// Module up to which full teeth are surely sound, mm: on the pitch curves of the required path, where the axis found makes
    /// a machine for it, and on those of the eased one.
    pub module: (Option<f64>, f64),
    /// Further wishes, and how far they are reached.
    pub goals: Vec<Goal>,
    /// Direction of the clamp minus that of the arm, rad, if directions were required.
    pub clamp: Option<f64>,
    /// Evaluations of the search.
    pub evaluations: u64,
    /// Finding on the axis, if there is one: `axis-at-border`.
    pub findings: Vec<Finding>,
}
