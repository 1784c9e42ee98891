use std::f64::consts::TAU;

use centrode_geometry::Antiderivative;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::ShaftError;
use centrode_gear::cam::law::{Law, LawSpec};
use centrode_gear::pitch::{Interpolation, Periodic, PitchError, formula_parts, read_formula};
use centrode_kinematics::formula::{Formula, Taylor};
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::degrees;
use centrode_spec::rule::positive;

/// Speeds at chosen shaft angles, each joined to the next by a motion law; only their ratios count.
///
/// Two neighbouring equal speeds are a stretch of constant speed: the slow one is the position for the
/// picking window. The whole is scaled so that one turn advances by the lead.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedKnots {
    /// Shaft angles, rad (degrees in the file), ascending within one turn.
    #[serde(rename = "angle_deg", with = "degrees")]
    #[schemars(with = "Vec<f64>")]
    pub angle: Vec<f64>,
    /// Speed at each angle, in any unit.
    pub speed: Vec<f64>,
    /// Motion law of the speed from each knot to the next.
    pub law: LawSpec,
}

/// Speeds over equal steps of one turn from the angle zero, without the repeated end; only ratios count.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedTable {
    /// The speeds, in any unit.
    pub speed: Vec<f64>,
    /// Interpolation between the samples; default: "quintic".
    pub interpolation: Option<Interpolation>,
}

/// The speed as a formula; only ratios count.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedFormula {
    /// Speed, in any unit, as a formula in the shaft angle `phi`, rad.
    pub expression: String,
}

#[derive(Debug)]
enum Speed {
    Knots {
        angle: Vec<f64>,
        speed: Vec<f64>,
        law: Law,
    },
    Table(Periodic),
    Formula {
        formula: Formula,
        parts: Vec<f64>,
    },
}

impl Speed {
    /// The speed's series at an angle in `[0, TAU)`.
    fn at(&self, theta: f64) -> Taylor {
        match self {
            Self::Table(table) => table.at(theta),
            Self::Formula { formula, .. } => formula.at(theta),
            Self::Knots { angle, speed, law } => {
                let count = angle.len();
                let after = angle.partition_point(|&a| a <= theta);
                let (i, j) = ((after + count - 1) % count, after % count);
                let span = (angle[j] - angle[i]).rem_euclid(TAU);
                let span = if count == 1 { TAU } else { span };
                let x = (theta - angle[i]).rem_euclid(TAU) / span;
                let jet = law.at(x);
                let inner = MotionJet::uniform(x, 1.0 / span);
                let rise = Taylor::constant(speed[j] - speed[i]);
                Taylor::constant(speed[i]) + rise * jet.after(&inner).series()
            }
        }
    }

    fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Table(table) => table.breaks(),
            Self::Formula { parts, .. } => parts.clone(),
            Self::Knots { angle, law, .. } => {
                let inner = law.breaks();
                let count = angle.len();
                let mut breaks = Vec::new();
                for (i, &start) in angle.iter().enumerate() {
                    let span = (angle[(i + 1) % count] - start).rem_euclid(TAU);
                    breaks.push(start);
                    breaks.extend(inner.iter().map(|x| (start + x * span).rem_euclid(TAU)));
                }
                breaks.sort_by(f64::total_cmp);
                breaks
            }
        }
    }
}

/// Law given by its speed.
#[derive(Debug)]
pub(super) struct Resolved {
    speed: Speed,
    way: Antiderivative,
    /// Factor from the integral's unit to mm.
    scale: f64,
    lead: f64,
}

impl Resolved {
    fn new(speed: Speed, lead: f64) -> Result<Self, ShaftError> {
        let mut ends = speed.breaks();
        ends.retain(|&t| t > 0.0);
        ends.insert(0, 0.0);
        ends.push(TAU);
        let way = Antiderivative::new(|t| speed.at(t).0[0], &ends);
        let total = way.total();
        if total > 0.0 && total.is_finite() {
            let scale = lead / total;
            Ok(Self {
                speed,
                way,
                scale,
                lead,
            })
        } else {
            Err(ShaftError::SpeedNotPositive {
                angle_deg: 0.0,
                ratio: total,
            })
        }
    }
}

impl Transmission for Resolved {
    fn at(&self, theta: f64) -> MotionJet {
        let turns = (theta / TAU).floor();
        let within = (theta - turns * TAU).clamp(0.0, TAU.next_down());
        let [v, a, j, _] = self.speed.at(within).derivatives();
        MotionJet {
            position: turns * self.lead + self.scale * self.way.at(within),
            velocity: self.scale * v,
            acceleration: self.scale * a,
            jerk: self.scale * j,
        }
    }

    fn advance(&self) -> f64 {
        self.lead
    }

    fn breaks(&self) -> Vec<f64> {
        self.speed.breaks()
    }
}

impl SpeedKnots {
    pub(super) fn resolve(&self, lead: f64) -> Result<Resolved, ShaftError> {
        let law = self.law.resolve().map_err(|e| e.inside("law.law"))?;
        let (angles, speeds) = (self.angle.len(), self.speed.len());
        if angles != speeds || angles < 2 {
            return Err(ShaftError::Speed(PitchError::LengthMismatch {
                first: "angle_deg",
                first_length: angles,
                second: "speed",
                second_length: speeds,
            }));
        }
        for &speed in &self.speed {
            positive("law.speed", speed)?;
        }
        let in_turn = self.angle.iter().all(|a| (0.0..TAU).contains(a));
        if !in_turn || self.angle.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Err(ShaftError::Speed(PitchError::Key {
                key: "angle_deg",
                rule: "must increase from value to value, from 0 to less than 360 deg",
            }));
        }
        let speed = Speed::Knots {
            angle: self.angle.clone(),
            speed: self.speed.clone(),
            law,
        };
        Resolved::new(speed, lead)
    }
}

impl SpeedTable {
    pub(super) fn resolve(&self, lead: f64) -> Result<Resolved, ShaftError> {
        for &speed in &self.speed {
            positive("law.speed", speed)?;
        }
        let interpolation = self.interpolation.unwrap_or(Interpolation::Quintic);
        let table = Periodic::even("speed", &self.speed, interpolation)?;
        Resolved::new(Speed::Table(table), lead)
    }
}

impl SpeedFormula {
    pub(super) fn resolve(&self, lead: f64) -> Result<Resolved, ShaftError> {
        let key = "expression";
        let formula = read_formula(key, &self.expression)?;
        let (start, end) = (formula.at(0.0).0, formula.at(TAU).0);
        if (0..3).any(|i| (start[i] - end[i]).abs() > 1e-9 * (1.0 + start[i].abs())) {
            return Err(ShaftError::Speed(PitchError::OpenCurve {
                key,
                what: "the speed",
                start: start[0],
                end: end[0],
            }));
        }
        let parts = formula_parts(key, &formula)?;
        Resolved::new(Speed::Formula { formula, parts }, lead)
    }
}
