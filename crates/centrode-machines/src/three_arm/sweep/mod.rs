//! Fast evaluation of many designs of one kind, for optimisers.

use std::f64::consts::{PI, TAU};

use super::Figures;
use super::design::ThreeArmDesign;
use super::figures::{elevation, swept_radius};
use centrode_gear::pitch::{Bspline, PitchSpec, Plane};

mod panel;
mod path;
mod spline;
mod stage;
mod track;

use path::Path;
use spline::SplinePair;
use stage::Stage;

/// Evaluates many three-arm designs with the same kind of pitch curve, each in a few microseconds.
///
/// The sun's pitch curve must be a closed B-spline with control points in the plane of polar angle and radius. The
/// transmission function is integrated on fixed panels of the curve's pieces, on which it is analytic. Both stages are solved
/// by Newton's method from input to input. No memory is allocated per design. The figures agree with those of
/// [`ThreeArm::figures`](super::ThreeArm::figures) to 1e-9 rad, or 1e-9 of the machine's size, for designs like the published
/// one, and to 1e-7 if the radii of the pitch curve differ tenfold. That the pitch curve winds round its axis is only checked
/// at the nodes of the integration. Pitch curves scaled by a module are not supported.
///
/// ```
/// use centrode_spec::DesignSpec;
/// use centrode_machines::three_arm::Sweep;
/// use centrode_machines::three_arm::design::ThreeArmDesign;
///
/// let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE)?;
/// let mut sweep = Sweep::like(&design, 360)?;
/// let height = sweep.figures(&design)?.trajectory_height;
/// design.arm.tip_distance += 5.0;
/// assert!(sweep.figures(&design)?.trajectory_height > height);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sweep {
    stage: Stage,
    path: Path,
}

/// Reason why a sweep gives no figures of a design.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SweepError {
    /// Another kind of pitch curve.
    #[error(
        "a sweep needs a bspline in the polar plane with control points and neither module nor interpolation"
    )]
    Kind,
    /// Fewer points than the spline's degree needs, or other numbers of points than those of the sweep.
    #[error("the sweep has {required} control points, but the design has {found}")]
    Points {
        /// Required number of points.
        required: usize,
        /// Number of points in the design.
        found: usize,
    },
    /// Radii of control points that are not above zero, or angles that do not increase within one turn.
    #[error(
        "radii of control points must be greater than 0 mm, and their angles must increase within one turn"
    )]
    ControlPoints,
    /// The pitch curve does not wind once round the sun's axis.
    #[error("the pitch curve must go round the axis exactly once without turning back")]
    NotAroundAxis,
    /// No centre distance closes the driven curve.
    #[error("no centre distance closes the driven curve")]
    NoClosure,
    /// No arm passes the tray's surface.
    #[error("no arm passes the tray's surface")]
    TrayOutOfReach,
}

/// Returns the spline of a design, if it is of the supported kind.
fn spline_of(design: &ThreeArmDesign) -> Result<&Bspline, SweepError> {
    match &design.pitch {
        PitchSpec::Bspline(spline)
            if spline.plane == Plane::Polar
                && !spline.interpolate
                && spline.module.or(spline.diametral_pitch).is_none() =>
        {
            Ok(spline)
        }
        _ => Err(SweepError::Kind),
    }
}

impl Sweep {
    /// Makes a sweep for designs with the number of control points and the degree of this design. The tip's path is sampled
    /// at `inputs` inputs per turn, at least 32, rounded up to a multiple of four.
    ///
    /// # Errors
    /// [`SweepError`] if the pitch curve is of another kind.
    pub fn like(design: &ThreeArmDesign, inputs: usize) -> Result<Self, SweepError> {
        let spline = spline_of(design)?;
        Ok(Self {
            stage: Stage::new(SplinePair::new(spline)?),
            path: Path::new(inputs.max(32).next_multiple_of(4)),
        })
    }

    /// Centre distance and figures of a design.
    ///
    /// # Errors
    /// [`SweepError`] if the design gives no mechanism, or is of another kind.
    pub fn figures(&mut self, design: &ThreeArmDesign) -> Result<Figures, SweepError> {
        let spline = spline_of(design)?;
        self.stage.load(spline)?;
        spline.check().map_err(|_| SweepError::ControlPoints)?;
        let machine = path::Machine::new(design, &self.stage);
        self.path.follow(&self.stage, &machine)?;
        let [below, above] =
            [-1.0, 1.0].map(|up| self.path.farthest(&self.stage, &machine, [0.0, up]));
        let planting = design.work.planting.unwrap_or(below.input);
        let picking = match design.work.picking {
            Some(given) => given,
            None => self.picking(design, &machine)?,
        };
        let sign = design.direction.sign();
        let clamp = |input: f64| {
            let arm = self.path.arm(&self.stage, &machine, input);
            elevation(arm + machine.clamp_mounting, sign)
        };
        let (pick_angle, push_angle) = (clamp(picking), -clamp(planting));
        let a = self.stage.center_distance();
        let (minimum, maximum) = self.stage.radii();
        let ground = -below.reach + design.work.planting_depth;
        let gearbox = swept_radius(a, design.bend, maximum, a - minimum);
        let teeth = design.gear_tooth_count();
        Ok(Figures {
            pick_angle,
            push_angle,
            angle_difference: pick_angle + push_angle,
            gearbox_clearance: -gearbox - design.gearbox.housing_offset - ground,
            trajectory_height: above.reach + below.reach,
            module: teeth.map(|z| self.stage.length() / (PI * f64::from(z))),
        })
    }

    /// Number of control points that the pitch curves must have.
    #[must_use]
    pub fn control_points(&self) -> usize {
        self.stage.control_points()
    }

    /// Centre distance of the last design, mm.
    #[must_use]
    pub fn center_distance(&self) -> f64 {
        self.stage.center_distance()
    }

    /// Length of the pitch curves of the last design, mm.
    #[must_use]
    pub fn pitch_length(&self) -> f64 {
        self.stage.length()
    }

    /// Maximum convex and concave curvature (1/mm) of both pitch curves of the last design. They are sampled 12 times per panel
    /// and therefore slightly low.
    #[must_use]
    pub fn curvatures(&self) -> [f64; 2] {
        self.stage.curvatures()
    }

    /// Depth of the tip's loop beyond the point of picking, mm, equal to
    /// [`ThreeArm::picking_depth`](super::ThreeArm::picking_depth). `design` must be the last design evaluated.
    #[must_use]
    pub fn picking_depth(&self, design: &ThreeArmDesign) -> f64 {
        let machine = path::Machine::new(design, &self.stage);
        let (sin, cos) = design.tray.inclination.sin_cos();
        let inwards = [-design.direction.sign() * cos, sin];
        let farthest = self.path.farthest(&self.stage, &machine, inwards);
        let picked = match (design.work.picking, design.tray.distance) {
            (Some(given), _) => {
                let [x, y] = self.path.tip(&self.stage, &machine, given);
                x * inwards[0] + y * inwards[1]
            }
            (None, Some(distance)) => distance,
            (None, None) => farthest.reach,
        };
        farthest.reach - picked
    }

    /// Points of the tip's path of the last design, at equal steps of carrier turn from the start.
    pub fn tips(&self) -> impl ExactSizeIterator<Item = [f64; 2]> + '_ {
        self.path.points()
    }

    fn picking(&self, design: &ThreeArmDesign, machine: &path::Machine) -> Result<f64, SweepError> {
        let (sin, cos) = design.tray.inclination.sin_cos();
        let inwards = [-design.direction.sign() * cos, sin];
        let farthest = self.path.farthest(&self.stage, machine, inwards);
        let Some(distance) = design.tray.distance else {
            return Ok(farthest.input);
        };
        let entering = self
            .path
            .entering(&self.stage, machine, inwards, distance, farthest.input);
        entering.map(|input| input.rem_euclid(TAU))
    }
}

#[cfg(test)]
mod tests;
