//! The fork of a transplanting arm: an oscillating follower that moves a push rod.
//!
//! The cam is fixed to the carrier. The fork has its pivot on the arm, which turns about the cam's axis. Where the cam
//! rises, the fork pulls the rod back against its spring. Where the cam falls, the spring pushes the rod out.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use centrode_geometry::extremes;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::design::{Follower, SwingingRoller, Turn};
use super::disc::{CamError, DiscCam};
use super::motion::ends;
use centrode_kinematics::formula::Taylor;
use centrode_kinematics::transmission::{Chain, FromFn, Inverse, MotionJet, Transmission};
use centrode_spec::rule::{in_range, positive};
use centrode_spec::{SpecError, degrees};

/// A swinging arm with the cam's roller on one end and the push rod on the other.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Fork {
    /// Radius of the roller, mm.
    pub roller_radius: f64,
    /// Distance of the fork's pivot from the cam's axis, mm.
    pub center_distance: f64,
    /// Distance of the roller's centre from the pivot, mm.
    pub arm_length: f64,
    /// Sense in which the fork turns when the cam lifts it.
    #[serde(default)]
    pub lifts: Turn,
    /// Joint of the other end and the rod.
    pub rod: RodJoint,
}

/// Joint of a fork and its push rod, by the key `kind`.
///
/// The angle b is that of the lever to the square on the rod's axis, positive towards retraction; b0
/// with the roller on the base circle, the rod thrown out.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum RodJoint {
    /// A pin on the rod in a straight slot of the fork: displacement `l (tan b - tan b0)`, where l is the
    /// distance of the rod's axis from the pivot.
    PinOnRod(Lever),
    /// A pin on the fork in a slot across the rod: displacement `l (sin b - sin b0)`, where l is the
    /// distance of the pin from the pivot.
    PinOnFork(Lever),
}

/// The lever of a fork.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Lever {
    /// Length l, mm.
    pub length: f64,
    /// Angle b0 with the rod thrown out, rad (degrees in the file).
    #[serde(rename = "start_deg", with = "degrees", default)]
    #[schemars(with = "f64")]
    pub start: f64,
}

impl RodJoint {
    /// Lever of the joint.
    #[must_use]
    pub fn lever(&self) -> &Lever {
        match self {
            Self::PinOnRod(lever) | Self::PinOnFork(lever) => lever,
        }
    }

    /// Retraction of the rod, mm, when the fork has swung by an angle, with the derivatives of both.
    #[must_use]
    pub fn retraction(&self, swing: &MotionJet) -> MotionJet {
        let Lever { length, start } = *self.lever();
        let (sin, cos) = (swing.series() + Taylor::constant(start)).sin_cos();
        let (now, out) = match self {
            Self::PinOnRod(_) => (sin / cos, start.tan()),
            Self::PinOnFork(_) => (sin, start.sin()),
        };
        MotionJet::from_series(&((now - Taylor::constant(out)) * Taylor::constant(length)))
    }

    /// Swing of the fork, rad, that has retracted the rod by a displacement, with the derivatives of both.
    ///
    /// Not finite where a pin on the fork cannot reach that displacement.
    #[must_use]
    pub fn swing(&self, retraction: &MotionJet) -> MotionJet {
        let Lever { length, start } = *self.lever();
        let share = retraction.series() * Taylor::constant(1.0 / length);
        let angle = match self {
            Self::PinOnRod(_) => (share + Taylor::constant(start.tan())).atan(),
            Self::PinOnFork(_) => (share + Taylor::constant(start.sin())).asin(),
        };
        MotionJet::from_series(&(angle - Taylor::constant(start)))
    }
}

impl Fork {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        self.follower().validate()?;
        let lever = self.rod.lever();
        positive("length", lever.length).map_err(|e| e.inside("rod"))?;
        let start = lever.start.to_degrees();
        in_range("start_deg", start, [-85.0, 85.0], " deg").map_err(|e| e.inside("rod"))
    }

    fn follower(&self) -> Follower {
        Follower::SwingingRoller(SwingingRoller {
            roller_radius: self.roller_radius,
            center_distance: self.center_distance,
            arm_length: self.arm_length,
            lifts: self.lifts,
        })
    }

    /// Makes the cam for a required retraction of the rod, a function of the angle of the arm relative to the cam.
    ///
    /// `retraction` is mm, zero with the rod thrown out; `rotation` is the cam's, seen from the arm.
    ///
    /// # Errors
    /// [`CamError`] where the fork cannot follow; [`CamError::Retraction`] where the rod cannot.
    pub fn cam(
        &self,
        retraction: Arc<dyn Transmission>,
        base_radius: f64,
        rotation: Turn,
    ) -> Result<DiscCam, CamError> {
        self.validate()?;
        let ends = ends(retraction.as_ref());
        let swing = |input: f64| self.rod.swing(&retraction.at(input)).position;
        let position = |input: f64| retraction.at(input).position;
        for extreme in extremes(position, &ends) {
            // With the lever at 90 deg, a pin on the fork moves square to the rod's axis and cannot retract the rod further.
            let lever = self.rod.lever().start + swing(extreme.input);
            if lever.is_nan() || lever.abs() >= FRAC_PI_2 {
                return Err(CamError::Retraction {
                    degrees: extreme.input.to_degrees(),
                    retraction: extreme.value,
                    length: self.rod.lever().length,
                });
            }
        }
        let swing = Swing {
            retraction,
            joint: self.rod,
        };
        DiscCam::new(Arc::new(swing), self.follower(), base_radius, rotation)
    }

    /// Makes the cam for a required retraction of the rod, a function of the machine's input.
    ///
    /// `arm_angle` is the angle of the arm minus that of the carrier, by the same input. It changes in one direction only, and by
    /// one whole turn in the period of `retraction`. In the carrier's frame the cam's x axis points from the planet's axis to the
    /// position of the fork's pivot at the input zero. The cam angle is the rotation of the arm since then.
    ///
    /// # Errors
    /// [`CamError::Transmission`] where the arm stops or does not make one turn; else those of [`cam`](Self::cam).
    pub fn cam_by_input(
        &self,
        retraction: Arc<dyn Transmission>,
        arm_angle: Arc<dyn Transmission>,
        base_radius: f64,
    ) -> Result<DiscCam, CamError> {
        let (start, way) = (arm_angle.at(0.0).position, arm_angle.advance().signum());
        // An arm that turns counter-clockwise sees the cam turn clockwise.
        let rotation = if way > 0.0 {
            Turn::Clockwise
        } else {
            Turn::CounterClockwise
        };
        let since = FromFn::new(TAU, way * TAU, Vec::new(), move |turn: f64| {
            MotionJet::uniform(start + way * turn, way)
        });
        let input = Chain::cycle_for_cycle(Arc::new(Inverse::new(arm_angle)?), Arc::new(since))?;
        let retraction = Chain::cycle_for_cycle(retraction, Arc::new(input))?;
        self.cam(Arc::new(retraction), base_radius, rotation)
    }
}

/// Swing of the fork as a function of the rod's retraction.
#[derive(Debug)]
struct Swing {
    retraction: Arc<dyn Transmission>,
    joint: RodJoint,
}

impl Transmission for Swing {
    fn at(&self, input: f64) -> MotionJet {
        self.joint.swing(&self.retraction.at(input))
    }

    fn period(&self) -> f64 {
        self.retraction.period()
    }

    fn advance(&self) -> f64 {
        self.retraction.advance()
    }

    fn breaks(&self) -> Vec<f64> {
        self.retraction.breaks()
    }
}

#[cfg(test)]
mod tests;
