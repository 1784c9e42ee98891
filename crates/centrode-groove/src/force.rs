use std::f64::consts::{FRAC_PI_2, TAU};

use centrode_geometry::{Extreme, extremes, maximum};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Groove;
use centrode_kinematics::machine::GuideForce;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::SpecError;
use centrode_spec::rule::{not_negative, positive};

/// Acceleration of free fall, m/s^2, as used in the paper.
pub const GRAVITY: f64 = 9.81;

/// Load that the slider moves, and its speed.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Load {
    /// Speed of the shaft, turns per minute.
    pub speed_rpm: f64,
    /// Mass moved along the shaft, kg.
    pub mass: f64,
    /// Coefficient of friction between slider and groove.
    pub groove_friction: f64,
    /// Coefficient of friction between the box and its rails.
    pub rail_friction: f64,
}

impl Default for Load {
    fn default() -> Self {
        Self {
            speed_rpm: 200.0,
            mass: 10.0,
            groove_friction: 0.10,
            rail_friction: 0.15,
        }
    }
}

impl Load {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        positive("speed_rpm", self.speed_rpm)?;
        positive("mass", self.mass)?;
        not_negative("groove_friction", self.groove_friction)?;
        not_negative("rail_friction", self.rail_friction)
    }

    /// Speed of the shaft, rad/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.speed_rpm * TAU / 60.0
    }

    /// Forces on the slider for a motion (mm, by the angle in rad of the part that turns at the load's speed) on a groove of this
    /// lead angle (rad) and radius (mm): those of a [`GuideForce`] for the push `m (x'' + g mu)` along the path of the box.
    ///
    /// Replaces equations (14) and (15) of Zhou et al. 2018.
    #[must_use]
    pub fn force(&self, motion: MotionJet, lead_angle: f64, radius: f64) -> GuideForce {
        let omega = self.speed();
        let along = way(&motion) * motion.acceleration * 1e-3 * omega * omega;
        let push = self.mass * (along + GRAVITY * self.rail_friction);
        GuideForce::new(push, lead_angle, radius, self.groove_friction)
    }

    /// Friction force of the rails on the box, N: opposite to its motion.
    #[must_use]
    pub fn rail_force(&self, motion: &MotionJet) -> f64 {
        -way(motion) * self.mass * GRAVITY * self.rail_friction
    }

    /// Speed of the shaft, turns per minute, above which a motion whose deceleration along its motion is at most
    /// `deceleration` (mm/rad^2) leaves the driving wall: `omega^2 = g mu / deceleration`. A motion that never slows down
    /// stays on its wall at any speed: infinite, with friction on the rails and without.
    #[must_use]
    pub fn contact_limit_rpm(&self, deceleration: f64) -> f64 {
        if deceleration <= 0.0 {
            return f64::INFINITY;
        }
        (GRAVITY * self.rail_friction * 1e3 / deceleration).sqrt() * 60.0 / TAU
    }

    /// Lead angle, rad, at which the shaft can no longer move the slider, whatever its torque.
    #[must_use]
    pub fn jamming_angle(&self) -> f64 {
        FRAC_PI_2 - self.groove_friction.atan()
    }
}

/// Sign of the box's motion, or, at rest, of the motion that begins.
fn way(motion: &MotionJet) -> f64 {
    if motion.velocity == 0.0 {
        motion.acceleration.signum()
    } else {
        motion.velocity.signum()
    }
}

/// Extremes of the forces over a whole cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceRange {
    /// Minimum and maximum normal force on the strokes, N.
    pub normal: [Extreme; 2],
    /// Maximum normal force in a reversal, N.
    pub normal_of_reversal: Extreme,
    /// Minimum and maximum torque over the cycle, N mm.
    pub torque: [Extreme; 2],
    /// Maximum deceleration along the motion on the strokes, mm/rad^2.
    pub deceleration: Extreme,
    /// Maximum deceleration over the whole cycle, with the reversals, mm/rad^2.
    pub deceleration_of_cycle: Extreme,
}

impl Groove {
    /// Forces on the slider at an angle of the shaft.
    #[must_use]
    pub fn force(&self, theta: f64, load: &Load) -> GuideForce {
        load.force(
            self.traverse().at(theta),
            self.lead_angle(theta),
            self.radius(),
        )
    }

    /// Minimum and maximum forces over the cycle.
    #[must_use]
    pub fn force_range(&self, load: &Load) -> ForceRange {
        let ends = self.ends();
        let stroke = self.traverse().stroke();
        let turn = self.traverse().reversal();
        let out = self.ends_between(0.0, stroke);
        let back = self.ends_between(stroke, stroke + turn);
        let normal = |theta: f64| self.force(theta, load).normal;
        let torque = |theta: f64| self.force(theta, load).torque;
        let slowing = |theta: f64| {
            let motion = self.traverse().at(theta);
            -way(&motion) * motion.acceleration
        };
        ForceRange {
            normal: extremes(normal, &out),
            normal_of_reversal: maximum(normal, &back),
            torque: extremes(torque, &ends),
            deceleration: maximum(slowing, &out),
            deceleration_of_cycle: maximum(slowing, &ends),
        }
    }
}
