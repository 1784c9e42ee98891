//! Law along the shaft: the slider's position as a function of the shaft's angle.

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{Extreme, extremes, maximum, piece_ends};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod general;
mod rotated;
mod sine;

pub use general::{SpeedFormula, SpeedKnots, SpeedTable};
pub use rotated::RotatedSine;
pub use sine::{AmplitudeFor, Sine};

use super::ShaftError;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::rule::positive;

/// The law along the shaft as written: one of the kinds, by the key `kind`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum SpeedLaw {
    /// A cosine on the speed: the integral of equation (1).
    Sine(Sine),
    /// A sine turned onto the helix, equations (3) to (5).
    RotatedSine(RotatedSine),
    /// Speeds at chosen angles, joined by a motion law.
    Knots(SpeedKnots),
    /// Speeds at equal steps of a turn.
    Table(SpeedTable),
    /// A formula for the speed.
    Formula(SpeedFormula),
}

impl SpeedLaw {
    /// Word for the kind in a design file.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Sine(_) => "sine",
            Self::RotatedSine(_) => "rotated-sine",
            Self::Knots(_) => "knots",
            Self::Table(_) => "table",
            Self::Formula(_) => "formula",
        }
    }
}

impl Default for SpeedLaw {
    fn default() -> Self {
        Self::Sine(Sine::default())
    }
}

impl SpeedLaw {
    /// The exact law for a lead (mm per turn), proved to run in one direction. `radius` (mm) is that of the shaft;
    /// only the rotated sine depends on it.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers.
    pub fn resolve(&self, lead: f64, radius: f64) -> Result<ShaftLaw, ShaftError> {
        positive("lead", lead)?;
        positive("radius", radius)?;
        let form: Arc<dyn Transmission> = match self {
            Self::Sine(spec) => Arc::new(spec.resolve(lead)?),
            Self::RotatedSine(spec) => Arc::new(spec.resolve(lead, radius)?),
            Self::Knots(spec) => Arc::new(spec.resolve(lead)?),
            Self::Table(spec) => Arc::new(spec.resolve(lead)?),
            Self::Formula(spec) => Arc::new(spec.resolve(lead)?),
        };
        ShaftLaw::new(form)
    }
}

/// Law along the shaft: `s(theta + one turn) = s(theta) + lead`, always advancing.
#[derive(Clone, Debug)]
pub struct ShaftLaw {
    form: Arc<dyn Transmission>,
    slowest: Extreme,
    fastest: Extreme,
}

impl ShaftLaw {
    /// Takes a transmission that advances by the lead in one turn.
    ///
    /// # Errors
    /// [`ShaftError::SpeedNotPositive`] where it stops or runs back.
    pub fn new(form: Arc<dyn Transmission>) -> Result<Self, ShaftError> {
        let ends = turn_pieces(form.as_ref(), 0.0);
        let [slowest, fastest] = extremes(|theta| form.at(theta).velocity, &ends);
        let mean = form.advance() / TAU;
        if slowest.value > 0.0 && fastest.value.is_finite() {
            Ok(Self {
                form,
                slowest,
                fastest,
            })
        } else {
            Err(ShaftError::SpeedNotPositive {
                angle_deg: slowest.input.to_degrees(),
                ratio: slowest.value / mean,
            })
        }
    }

    /// Lead, mm per turn.
    #[must_use]
    pub fn lead(&self) -> f64 {
        self.form.advance()
    }

    /// Mean speed, mm/rad.
    #[must_use]
    pub fn mean_speed(&self) -> f64 {
        self.lead() / TAU
    }

    /// Shaft angle in a turn at which the slider is slowest, and its speed there, mm/rad.
    #[must_use]
    pub fn slowest(&self) -> Extreme {
        self.slowest
    }

    /// Shaft angle in a turn at which the slider is fastest, and its speed there, mm/rad.
    #[must_use]
    pub fn fastest(&self) -> Extreme {
        self.fastest
    }

    /// Shaft angles of the turn that begins at `from` between which the law is smooth and short.
    #[must_use]
    pub fn pieces(&self, from: f64) -> Vec<f64> {
        turn_pieces(self.form.as_ref(), from)
    }

    /// Distance moved from one shaft angle to another, mm.
    #[must_use]
    pub fn moved(&self, start: f64, stop: f64) -> f64 {
        self.at(stop).position - self.at(start).position
    }

    /// Maximum distance between this law and another along the shaft over one turn, each counted from
    /// its own position at `from`; mm.
    #[must_use]
    pub fn deviation(&self, other: &Self, from: f64) -> f64 {
        let apart = |theta: f64| (self.moved(from, theta) - other.moved(from, theta)).abs();
        maximum(apart, &self.pieces(from)).value
    }
}

/// Number of equal parts of a turn in each of which a law has few extremes.
const PARTS: u32 = 16;

fn turn_pieces(form: &dyn Transmission, from: f64) -> Vec<f64> {
    let within = |theta: &f64| from + (theta - from).rem_euclid(TAU);
    let breaks: Vec<f64> = form.breaks().iter().map(within).collect();
    piece_ends(from, from + TAU, PARTS, &breaks)
}

impl Transmission for ShaftLaw {
    fn at(&self, theta: f64) -> MotionJet {
        self.form.at(theta)
    }

    fn period(&self) -> f64 {
        self.form.period()
    }

    fn advance(&self) -> f64 {
        self.form.advance()
    }

    fn breaks(&self) -> Vec<f64> {
        self.form.breaks()
    }
}

/// Maximum number of waves per turn.
const MAX_HARMONICS: u32 = 60;
