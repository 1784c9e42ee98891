use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_kinematics::transmission::{MotionJet, Transmission};

/// The motion of an [`IntermittentPair`](super::IntermittentPair): the law of its pitch curves over the toothed arc, with a
/// gradual start and stop over the entry angle, and rest.
#[derive(Clone, Debug)]
pub struct IntermittentLaw {
    pub(super) pair: Arc<crate::Rolling>,
    /// Driver angle of the toothed arc.
    pub(super) arc: f64,
    pub(super) entry: f64,
    pub(super) driven: f64,
}

impl IntermittentLaw {
    /// The driver angle from start to stop, rad.
    #[must_use]
    pub fn motion_angle(&self) -> f64 {
        self.arc + self.entry
    }

    /// Roll of the pitch curves within one turn, rad of the driver.
    fn rolled(&self, input: f64) -> MotionJet {
        let (entry, motion) = (self.entry, self.motion_angle());
        let ease = |input: f64| {
            let u = input / entry;
            MotionJet {
                position: entry * u.powi(4) * (2.5 - 3.0 * u + u * u),
                velocity: u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u),
                acceleration: 30.0 * (u * (1.0 - u)).powi(2) / entry,
                jerk: 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u) / (entry * entry),
            }
        };
        if input < entry {
            return ease(input);
        }
        if input <= motion - entry {
            return MotionJet::uniform(input - 0.5 * entry, 1.0);
        }
        // The exit is the entry run backwards.
        let back = ease(motion - input);
        MotionJet {
            position: self.arc - back.position,
            velocity: back.velocity,
            acceleration: -back.acceleration,
            jerk: back.jerk,
        }
    }
}

impl Transmission for IntermittentLaw {
    fn at(&self, input: f64) -> MotionJet {
        let turns = (input / TAU).floor();
        let within = input - turns * TAU;
        let gone = turns * self.driven;
        if within >= self.motion_angle() {
            return MotionJet::at_rest(gone + self.driven);
        }
        let rolled = self.rolled(within);
        let phi = rolled.position;
        let mesh = MotionJet {
            position: self.pair.driven_angle(phi),
            velocity: self.pair.ratio(phi),
            acceleration: self.pair.ratio_slope(phi),
            jerk: 0.0,
        };
        let mut jet = mesh.after(&rolled);
        jet.position += gone - self.pair.driven_angle(0.0);
        jet
    }

    fn advance(&self) -> f64 {
        self.driven
    }

    fn breaks(&self) -> Vec<f64> {
        let motion = self.motion_angle();
        if self.entry > 0.0 {
            vec![0.0, self.entry, motion - self.entry, motion]
        } else {
            vec![0.0, motion]
        }
    }
}
