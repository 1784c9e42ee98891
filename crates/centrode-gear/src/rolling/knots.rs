//! From the driver's polar angle back to the parameter of its pitch curve.

use std::f64::consts::TAU;

use centrode_geometry::{bracketed_newton, checkpoint, piece_ends};

use super::Rolling;

/// Number of knots per turn, in addition to the breaks. Fewer make the search for a parameter slower, more take memory.
const KNOTS: u32 = 96;

impl Rolling {
    /// Parameters of one turn, at its breaks and evenly between them, with the polar angle at each.
    pub(super) fn knots_at(&self, breaks: &[f64]) -> Vec<[f64; 2]> {
        let (start, end) = (self.start, self.start + self.curve.period());
        let angle = |t: f64| match t {
            t if t == start => 0.0,
            t if t == end => TAU,
            t => self.polar_angle(t, &self.curve.at(t)),
        };
        let ends = piece_ends(start, end, KNOTS, breaks).into_iter();
        ends.map(|t| [t, angle(t)]).collect()
    }

    /// Curve parameter at a driver polar angle; any real angle.
    #[must_use]
    pub fn parameter_at_angle(&self, phi: f64) -> f64 {
        checkpoint();
        let turns = (phi / TAU).floor();
        let required = phi - turns * TAU;
        let before = turns * self.curve.period();
        let [[low, from], [high, to]] = self.around(required);
        if required == from {
            return low + before;
        }
        let at = |t: f64| {
            let jet = self.curve.at(t);
            let off = self.polar_angle(t, &jet) - required;
            let p = jet.point.coords;
            (off, off * p.norm_squared() / p.perp(&jet.first))
        };
        let start = low + (high - low) * (required - from) / (to - from);
        bracketed_newton(at, low, high, start) + before
    }

    /// Neighbouring knots: the polar angle of the first is at most `angle`, that of the second is above it.
    fn around(&self, angle: f64) -> [[f64; 2]; 2] {
        let pair = |after: usize| [self.knots[after - 1], self.knots[after]];
        let is_around = |pair: &[[f64; 2]; 2]| pair[0][1] <= angle && angle < pair[1][1];
        let last = self.knots.len() - 1;
        let after = self.knots.partition_point(|knot| knot[1] <= angle);
        let found = pair(after.clamp(1, last));
        if is_around(&found) {
            return found;
        }
        // On a curve whose polar angle decreases for a while several pairs fit: the first is used.
        let mut pairs = (1..=last).map(pair);
        pairs.find(is_around).unwrap_or(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::{PitchSpec, Polar};

    #[test]
    fn the_parameter_at_an_angle_is_where_the_curve_has_it() {
        for expression in [
            "30 + 6*cos(2*phi) + 2*sin(4*phi)",
            "20/(1 - 0.6*cos(phi))",
            "30",
        ] {
            let spec = PitchSpec::Polar(Polar {
                expression: Some(expression.into()),
                ..Polar::default()
            });
            let curve = spec.resolve().expect("a curve").curve;
            let rolling = Rolling::new(curve, (1, 1)).expect("it rolls");
            let knots = rolling.knots.iter().map(|knot| knot[1]);
            let odd = (-40..80).map(|i| 0.173 * f64::from(i));
            for phi in odd.chain(knots).chain([-1e-17, TAU, -TAU, 1e-300]) {
                let t = rolling.parameter_at_angle(phi);
                let p = rolling.curve.at(t).point;
                let off = (p.y.atan2(p.x) - phi + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
                assert!(
                    off.abs() < 1e-14 * (1.0 + phi.abs()),
                    "{expression} {phi}: {off}"
                );
                assert!((rolling.angle(t) - phi).abs() < 1e-14 * (1.0 + phi.abs()));
            }
        }
    }
}
