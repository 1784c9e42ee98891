use nalgebra::Rotation2;

use super::motion::{Bend, Motion, PoseJet, Tabulated};

/// Motion of a body that repeats the motion of another body with a delay, turned about the origin of the common frame.
///
/// An example is arms on one carrier. In the carrier's frame each arm is a turned copy of the first, delayed by its share of a
/// cycle.
#[derive(Clone, Copy, Debug)]
pub struct DelayedMotion<'a> {
    /// Motion that is repeated; its inputs are one whole cycle.
    pub first: &'a Tabulated,
    /// Delay of the input, in `[0, cycle]`.
    pub delay: f64,
    /// Angle of the turn, rad.
    pub turned: f64,
}

impl DelayedMotion<'_> {
    /// Input in the first body's table.
    fn own(&self, input: f64) -> f64 {
        let (start, cycle) = (self.first.start, self.first.length());
        start + (input - self.delay - start).rem_euclid(cycle)
    }
}

impl Motion for DelayedMotion<'_> {
    fn at(&self, input: f64) -> PoseJet {
        let jet = self.first.at(self.own(input));
        let turn = Rotation2::new(self.turned);
        PoseJet {
            position: turn * jet.position,
            angle: jet.angle + self.turned,
            velocity: turn * jet.velocity,
            turning: jet.turning,
        }
    }

    fn bend(&self, from: f64, to: f64) -> Bend {
        let (start, cycle) = (self.first.start, self.first.length());
        if to - from >= cycle {
            return self.first.bend(start, start + cycle);
        }
        let own = self.own(from);
        let end = own + (to - from);
        if end <= start + cycle {
            return self.first.bend(own, end);
        }
        let round = self.first.bend(start, end - cycle);
        self.first.bend(own, start + cycle).greater(round)
    }

    fn deviation(&self) -> (f64, f64) {
        self.first.deviation()
    }
}
