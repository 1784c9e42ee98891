use std::f64::consts::{PI, TAU};

use centrode_geometry::Antiderivative;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::ShaftError;
use centrode_gear::cam::law::{Law, LawSpec};
use centrode_kinematics::transmission::MotionJet;
use centrode_spec::degrees;
use centrode_spec::rule::in_range;

/// Reversal of the slider at an end: its speed goes from `v0` to `-v0` by a motion law.
///
/// `s' = v0 (1 - 2 L(x))` over the angle `T`, `x` from 0 to 1. The harmonic law overshoots by `v0 T / pi`
/// and reaches `|s''| = pi v0 / T`. Where the shaft's law is accelerated at the joint, a cubic carries
/// that over, so position, speed and acceleration are always continuous.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Reversal {
    /// Shaft turn of one reversal, rad (degrees in the file): whole half turns, so that the groove
    /// closes. One turn lets the same positions be picked on the outward stroke and back.
    #[serde(rename = "angle_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub angle: f64,
    /// Motion law of the change of sign.
    pub law: LawSpec,
}

impl Default for Reversal {
    fn default() -> Self {
        Self {
            angle: TAU,
            law: LawSpec::Harmonic,
        }
    }
}

/// Maximum reversal, rad.
const LONGEST: f64 = 40.0 * PI;

impl Reversal {
    pub(super) fn resolve(&self) -> Result<Turnaround, ShaftError> {
        let degrees = self.angle.to_degrees();
        in_range(
            "reversal.angle_deg",
            degrees,
            [1e-6, LONGEST.to_degrees()],
            " deg",
        )?;
        let halves = self.angle / PI;
        if halves.round() < 1.0 || (halves - halves.round()).abs() > 1e-9 {
            return Err(ShaftError::ReversalAngle(degrees));
        }
        let law = self.law.resolve().map_err(|e| e.inside("reversal.law"))?;
        let mut ends = vec![0.0];
        ends.extend(law.breaks());
        ends.push(1.0);
        let area = Antiderivative::new(|x| law.at(x).position, &ends);
        let slope = |x: f64| law.at(x).velocity.abs();
        if (area.total() - 0.5).abs() > 1e-12 || slope(0.0) > 1e-9 || slope(1.0) > 1e-9 {
            return Err(ShaftError::ReversalLaw { law: law.name() });
        }
        Ok(Turnaround {
            angle: halves.round() * PI,
            law,
            area,
        })
    }
}

/// A reversal ready to be evaluated.
#[derive(Clone, Debug)]
pub(super) struct Turnaround {
    pub(super) angle: f64,
    law: Law,
    area: Antiderivative,
}

/// Conditions at the ends of a reversal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ends {
    /// Speed at its start, the opposite of that at its end, mm/rad.
    pub(super) speed: f64,
    /// Acceleration at both, mm/rad^2.
    pub(super) acceleration: f64,
    /// Position at the end minus that at the start, mm.
    pub(super) shift: f64,
}

impl Turnaround {
    /// Motion after the share `x` of the reversal, relative to its start.
    pub(super) fn at(&self, x: f64, ends: Ends) -> MotionJet {
        let t = self.angle;
        let Ends {
            speed: v,
            acceleration: a,
            shift: d,
        } = ends;
        let l = self.law.at(x);
        let y = 1.0 - x;
        // x - 3 x^2 + 2 x^3 has unit slope at both ends and no area; 30 x^2 y^2 has unit area and no slope.
        let carry = [
            0.5 * x * x * y * y,
            x * y * (1.0 - 2.0 * x),
            1.0 - 6.0 * x * y,
            12.0 * x - 6.0,
        ];
        let bump = [
            x * x * x * (10.0 + x * (6.0 * x - 15.0)),
            30.0 * x * x * y * y,
            60.0 * x * y * (1.0 - 2.0 * x),
            60.0 * (1.0 - 6.0 * x * y),
        ];
        MotionJet {
            position: v * t * (x - 2.0 * self.area.at(x)) + a * t * t * carry[0] + d * bump[0],
            velocity: v * (1.0 - 2.0 * l.position) + a * t * carry[1] + d / t * bump[1],
            acceleration: -2.0 * v * l.velocity / t + a * carry[2] + d / (t * t) * bump[2],
            jerk: -2.0 * v * l.acceleration / (t * t)
                + a / t * carry[3]
                + d / (t * t * t) * bump[3],
        }
    }

    /// Shares of the reversal at which a derivative may jump.
    pub(super) fn breaks(&self) -> Vec<f64> {
        self.law.breaks()
    }
}
