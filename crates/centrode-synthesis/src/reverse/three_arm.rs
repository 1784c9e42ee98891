use std::f64::consts::{FRAC_PI_2, TAU};

use thiserror::Error;

use crate::machine::{free_backlash, free_body};
use crate::reverse::KeyPoses;
use centrode_gear::design::Addendum;
use centrode_gear::pitch::{PitchSpec, Transmission};
use centrode_machines::three_arm::design::{ArmSpec, ThreeArmDesign};
use centrode_spec::degrees;

/// Reason why key poses give no three-arm mechanism.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum NotPosed {
    /// A clamp that points back at the planet's axis.
    #[error(
        "the clamp is {clamp:.2} deg from the arm; in a three-arm mechanism it must be less than 90 deg in either direction: change the poses"
    )]
    Clamp {
        /// Angle found, degrees.
        clamp: f64,
    },
    /// No law of one pair twice.
    #[error(
        "with a bend of {bend:.3} deg, no law of the same pair twice moves the arm through the poses: use another bend"
    )]
    Law {
        /// Bend, degrees.
        bend: f64,
    },
}

impl KeyPoses {
    /// The three-arm mechanism whose clamps take the key poses: the clamps pick in the first pose and plant in the last one.
    ///
    /// Its axis is the origin of its frame; the axis of the poses is [`TwoBar::axis`](crate::reverse::TwoBar::axis). It starts in
    /// the first pose. The law of its pair is a sum of harmonics whose amplitudes are as near to those of `bias` as the poses
    /// allow. The pusher's axis is S sin(clamp) from the planet's, S the arm's length.
    ///
    /// # Errors
    /// [`NotPosed`].
    pub fn three_arm(&self, bend: f64, bias: &[f64]) -> Result<ThreeArmDesign, NotPosed> {
        if self.clamp.abs() >= FRAC_PI_2 {
            let clamp = self.clamp.to_degrees();
            return Err(NotPosed::Clamp { clamp });
        }
        let law = self.one_pair(bend, bias).ok_or(NotPosed::Law {
            bend: degrees::rounded(bend),
        })?;
        let chain = &self.chain;
        let [carrier, arm] = self.start;
        let distance = chain.center_distance(bend);
        let pitch = PitchSpec::Transmission(Transmission {
            center_distance: Some(distance),
            ..Transmission::expression(law.formula())
        });
        let sun = principal(carrier - 0.5 * bend);
        // The default reference angle of `Train`.
        let reference = -law.at(chain.sense() * bend.abs());
        let spec = ArmSpec::new(
            principal(arm - (sun + bend - reference)),
            chain.arm(),
            chain.arm() * self.clamp.sin(),
        );
        let mut design = ThreeArmDesign::new(pitch, sun, bend, spec);
        design.title = "Three-arm transplanting mechanism made from key poses".into();
        design.direction = chain.direction();
        design.work.picking = Some(0.0);
        design.work.planting = self.turns.last().map(|turns| turns[0]);
        design.teeth.addendum = Addendum::Full;
        design.teeth.backlash = free_backlash(distance);
        let body = free_body(distance);
        (design.sun, design.intermediate, design.planet) =
            (body.clone().keyed(0.0), body.clone(), body.keyed(0.0));
        Ok(design)
    }
}

/// An angle between half a turn in either direction.
fn principal(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

#[cfg(test)]
mod tests {
    use centrode_geometry::{Point, Vector};

    use super::*;
    use crate::reverse::KeyPose;
    use centrode_kinematics::machine::Keyway;

    #[test]
    fn sun_and_planets_are_keyed_on_their_shafts_and_intermediate_gears_turn_on_theirs() {
        let pose = |share: f64| {
            let psi = TAU * share;
            let alpha = 0.4 - 0.3 * psi.sin();
            let bar = |length: f64, angle: f64| Vector::new(angle.cos(), angle.sin()) * length;
            KeyPose {
                point: Point::origin() + bar(280.0, psi) + bar(640.0, alpha),
                direction: alpha + 0.25,
            }
        };
        let poses = KeyPoses::new(&[0.05, 0.25, 0.45, 0.62, 0.85].map(pose)).expect("a machine");
        let design = poses.three_arm(0.7, &[]).expect("a design");
        for (keyed, body) in [
            (true, &design.sun),
            (false, &design.intermediate),
            (true, &design.planet),
        ] {
            let known = Keyway::of_bore(body.bore);
            assert!(known.is_some(), "a bore of {} mm has no keyway", body.bore);
            assert_eq!(body.keyway, known.filter(|_| keyed));
            assert_eq!(body.keyway_angle, 0.0);
            assert!(body.validate().is_ok());
        }
        // Each has the bore of its shaft, which is of one piece with what turns with it.
        assert_eq!(
            [design.sun.bore, design.planet.bore],
            [design.intermediate.bore; 2]
        );
    }
}
