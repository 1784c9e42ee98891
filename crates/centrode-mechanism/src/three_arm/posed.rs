use std::f64::consts::{FRAC_PI_2, TAU};

use thiserror::Error;

use super::design::{ArmSpec, ThreeArmDesign};
use crate::composed::{free_backlash, free_body};
use crate::degrees;
use crate::gear::design::Addendum;
use crate::gear::pitch::{PitchSpec, Transmission};
use crate::reverse::KeyPoses;

/// Reason why key poses give no three-arm mechanism.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum NotPosed {
    /// A clamp that points back at the planet's axis.
    #[error(
        "the clamp stands {clamp:.2} deg from the arm; in a three-arm mechanism it must be less than 90 deg either way: give other poses"
    )]
    Clamp {
        /// Angle found, degrees.
        clamp: f64,
    },
    /// No law of one pair twice.
    #[error(
        "no law of one pair twice brings the arm through the poses with a bend of {bend:.3} deg: take another bend"
    )]
    Law {
        /// Bend, degrees.
        bend: f64,
    },
}

impl ThreeArmDesign {
    /// A mechanism whose clamps take key poses: the first is where they pick, the last where they plant.
    ///
    /// Its axis is the origin of its frame; the poses stand about [`TwoBar::axis`](crate::reverse::TwoBar::axis). It starts in
    /// the first pose. The law of its pair is a sum of harmonics that comes as near to the amplitudes of `bias` as the poses
    /// leave room for. The pusher's axis is S sin(clamp) from the planet's, S the arm's length.
    ///
    /// # Errors
    /// [`NotPosed`].
    pub fn through(poses: &KeyPoses, bend: f64, bias: &[f64]) -> Result<Self, NotPosed> {
        if poses.clamp.abs() >= FRAC_PI_2 {
            let clamp = poses.clamp.to_degrees();
            return Err(NotPosed::Clamp { clamp });
        }
        let law = poses.one_pair(bend, bias).ok_or(NotPosed::Law {
            bend: degrees::rounded(bend),
        })?;
        let chain = &poses.chain;
        let [carrier, arm] = poses.start;
        let distance = chain.center_distance(bend);
        let pitch = PitchSpec::Transmission(Transmission {
            center_distance: Some(distance),
            ..Transmission::expression(law.formula())
        });
        let sun = principal(carrier - 0.5 * bend);
        // As `Train` has it where it is left out.
        let reference = -law.at(chain.sense() * bend.abs());
        let spec = ArmSpec::new(
            principal(arm - (sun + bend - reference)),
            chain.arm(),
            chain.arm() * poses.clamp.sin(),
        );
        let mut design = Self::new(pitch, sun, bend, spec);
        design.title = "Three-arm transplanting mechanism made from key poses".into();
        design.direction = chain.direction();
        design.work.picking = Some(0.0);
        design.work.planting = poses.turns.last().map(|turns| turns[0]);
        design.teeth.addendum = Addendum::Full;
        design.teeth.backlash = free_backlash(distance);
        let body = free_body(distance);
        (design.sun, design.intermediate, design.planet) =
            (body.clone().keyed(0.0), body.clone(), body.keyed(0.0));
        Ok(design)
    }
}

/// An angle between half a turn either way.
fn principal(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
