//! Motion laws of a follower: from rest at 0 to rest at 1 while the input goes from 0 to 1.
//!
//! Names and characteristic values are those of VDI 2143 part 1 (1980). The German name is given with each law.

use std::fmt;
use std::sync::Arc;

use centrode_geometry::{COMPUTED, Extreme, maximum};
use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

mod constant_velocity;
mod cycloidal;
mod harmonic;
mod modified_sine;
mod modified_trapezoid;
mod parabolic;
mod polynomial;
mod polynomial_345;
mod polynomial_4567;
mod sine_cosine;

pub(super) use polynomial::Coefficients;
pub use polynomial::Polynomial;

use centrode_kinematics::formula::Taylor;
use centrode_kinematics::transmission::MotionJet;
use centrode_spec::SpecError;

/// A motion law as written: one of the kinds, by the key `kind`.
#[derive(Clone, Debug, Default, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum LawSpec {
    /// Straight line: no acceleration inside, a jump of velocity at rest.
    ConstantVelocity,
    /// Two parabolas: the minimum peak acceleration there is, with jumps of it.
    Parabolic,
    /// Half a cosine wave: acceleration jumps at rest.
    Harmonic,
    /// Inclined sine: one sine wave of acceleration.
    #[default]
    Cycloidal,
    /// Sine of two lengths: low peak velocity and torque.
    ModifiedSine,
    /// Trapezoid of acceleration with sine ramps: low peak acceleration.
    ModifiedTrapezoid,
    /// Polynomial of fifth degree with no velocity and acceleration at both ends.
    #[serde(rename = "polynomial-345")]
    Polynomial345,
    /// Polynomial of seventh degree with no velocity, acceleration and jerk at both ends.
    #[serde(rename = "polynomial-4567")]
    Polynomial4567,
    /// Polynomial with the required derivatives at both ends.
    Polynomial(Polynomial),
}

impl LawSpec {
    /// The kinds without figures of their own, by the name they have in a file.
    pub const NAMED: [(&'static str, Self); 8] = [
        ("constant-velocity", Self::ConstantVelocity),
        ("parabolic", Self::Parabolic),
        ("harmonic", Self::Harmonic),
        ("cycloidal", Self::Cycloidal),
        ("modified-sine", Self::ModifiedSine),
        ("modified-trapezoid", Self::ModifiedTrapezoid),
        ("polynomial-345", Self::Polynomial345),
        ("polynomial-4567", Self::Polynomial4567),
    ];

    /// Every `kind`.
    const KINDS: &'static [&'static str] = &[
        "constant-velocity",
        "parabolic",
        "harmonic",
        "cycloidal",
        "modified-sine",
        "modified-trapezoid",
        "polynomial-345",
        "polynomial-4567",
        "polynomial",
    ];

    /// The law of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let found = Self::NAMED.into_iter().find(|(known, _)| *known == name);
        found.map(|(_, law)| law)
    }

    /// The name of the kind, as in a file.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let found = Self::NAMED.iter().find(|(_, law)| law == self);
        found.map_or("polynomial", |(name, _)| name)
    }

    /// Checks the rules of a law's own figures.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        match self {
            Self::Polynomial(polynomial) => polynomial.validate(),
            _ => Ok(()),
        }
    }

    /// The law, ready to be evaluated.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn resolve(&self) -> Result<Law, SpecError> {
        self.validate()?;
        let form: Arc<dyn Form> = match self {
            Self::ConstantVelocity => Arc::new(constant_velocity::ConstantVelocity),
            Self::Parabolic => Arc::new(parabolic::parabolic()),
            Self::Harmonic => Arc::new(harmonic::Harmonic),
            Self::Cycloidal => Arc::new(cycloidal::Cycloidal),
            Self::ModifiedSine => Arc::new(modified_sine::modified_sine()),
            Self::ModifiedTrapezoid => Arc::new(modified_trapezoid::modified_trapezoid()),
            Self::Polynomial345 => Arc::new(polynomial_345::Polynomial345),
            Self::Polynomial4567 => Arc::new(polynomial_4567::Polynomial4567),
            Self::Polynomial(polynomial) => Arc::new(polynomial.coefficients()),
        };
        let outside = match self {
            Self::Polynomial(polynomial) => {
                [&polynomial.start, &polynomial.end].map(|derivatives| {
                    let given = |k: usize| derivatives.get(k).copied().unwrap_or(0.0);
                    [given(0), given(1)]
                })
            }
            _ => [[0.0; 2]; 2],
        };
        let name = self.name();
        Ok(Law {
            form,
            name,
            outside,
        })
    }
}

/// Keys that may be given next to `kind`; a derived reader would ignore unknown keys next to the kinds without figures.
#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table, as in { kind = \"cycloidal\" }"
)]
struct Written {
    kind: String,
    start: Option<Vec<f64>>,
    end: Option<Vec<f64>>,
}

impl<'de> Deserialize<'de> for LawSpec {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        const POLYNOMIAL: &str = "polynomial";
        let Written { kind, start, end } = Written::deserialize(d)?;
        if kind == POLYNOMIAL {
            return Ok(Self::Polynomial(Polynomial {
                start: start.unwrap_or_default(),
                end: end.unwrap_or_default(),
            }));
        }
        let stray = start.map(|_| "start").or(end.map(|_| "end"));
        match (Self::named(&kind), stray) {
            (Some(law), None) => Ok(law),
            (Some(_), Some(key)) => Err(D::Error::unknown_field(key, &["kind"])),
            (None, _) => Err(D::Error::unknown_variant(&kind, Self::KINDS)),
        }
    }
}

/// A law's own formula.
trait Form: fmt::Debug + Send + Sync {
    /// Taylor series of the law: derivatives are exact by Taylor arithmetic.
    fn of(&self, x: Taylor) -> Taylor;

    /// Positions inside (0, 1) where a derivative jumps, ascending.
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// A normalised motion law `s(x)`: `s(0) = 0`, `s(1) = 1`.
#[derive(Clone, Debug)]
pub struct Law {
    form: Arc<dyn Form>,
    name: &'static str,
    /// Velocity and acceleration of the motion that the law joins at its start and at its end: those given for a polynomial,
    /// else rest.
    outside: [[f64; 2]; 2],
}

/// Characteristic values of a law between two rests, as in VDI 2143: peaks of its derivatives.
///
/// A follower with the lift h over the cam angle B has the peak velocity `Cv h / B`, the peak
/// acceleration `Ca h / B^2` and the peak jerk `Cj h / B^3` per radian of cam angle. Where a derivative jumps, inside the law or
/// at its ends, the next one is infinite. A polynomial joins the derivatives given for its ends instead of rest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CharacteristicValues {
    /// `Cv`, maximum |s'|: also the static torque for a constant load.
    pub velocity: f64,
    /// `Ca`, maximum |s''|; infinite if the velocity jumps.
    pub acceleration: f64,
    /// `Cj`, maximum |s'''|; infinite if the acceleration or the velocity jumps.
    pub jerk: f64,
    /// `CM`, maximum |s' s''|: the dynamic torque of a mass; infinite if the velocity jumps.
    pub torque: f64,
    /// Maximum |s''| between jumps.
    pub acceleration_inside: f64,
    /// Maximum |s'''| between jumps.
    pub jerk_inside: f64,
    /// Maximum jump of s', in `h / B`; 0 if there is none.
    pub velocity_jump: f64,
    /// Maximum jump of s'', in `h / B^2`; 0 if there is none.
    pub acceleration_jump: f64,
}

impl Law {
    /// The name of the kind, as in a file.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The law and its first three derivatives at `x`, meant for 0 to 1.
    #[must_use]
    pub fn at(&self, x: f64) -> MotionJet {
        MotionJet::from_series(&self.form.of(Taylor::variable(x)))
    }

    /// Positions inside (0, 1) where a derivative jumps, ascending.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        self.form.breaks()
    }

    /// Peaks and jumps of the derivatives, to the float limit.
    #[must_use]
    pub fn characteristic_values(&self) -> CharacteristicValues {
        let mut ends = vec![0.0];
        ends.extend(self.breaks());
        ends.push(1.0);
        let peak = |of: &dyn Fn(MotionJet) -> f64| -> f64 {
            let Extreme { value, .. } = maximum(|x| of(self.at(x)).abs(), &ends);
            value
        };
        let [start, end] = self.outside;
        let both = |s: MotionJet| [s.velocity, s.acceleration];
        let mut sides = vec![(start, both(self.at(0.0))), (both(self.at(1.0)), end)];
        let breaks = self.breaks().into_iter();
        sides.extend(breaks.map(|x| (both(self.at(x.next_down())), both(self.at(x)))));
        let jump = |k: usize, peak: f64| {
            let jumps = sides
                .iter()
                .map(|(before, after)| (after[k] - before[k]).abs());
            let jump = jumps.fold(0.0, f64::max);
            if jump > COMPUTED * peak { jump } else { 0.0 }
        };
        let velocity = peak(&|s| s.velocity);
        let acceleration_inside = peak(&|s| s.acceleration);
        let jerk_inside = peak(&|s| s.jerk);
        let torque = peak(&|s| s.velocity * s.acceleration);
        let velocity_jump = jump(0, velocity);
        let acceleration_jump = jump(1, acceleration_inside);
        let unless = |jumps: bool, inside: f64| if jumps { f64::INFINITY } else { inside };
        CharacteristicValues {
            velocity,
            acceleration: unless(velocity_jump > 0.0, acceleration_inside),
            jerk: unless(velocity_jump + acceleration_jump > 0.0, jerk_inside),
            torque: unless(velocity_jump > 0.0, torque),
            acceleration_inside,
            jerk_inside,
            velocity_jump,
            acceleration_jump,
        }
    }

    /// Taylor series of the law.
    pub(super) fn of(&self, x: Taylor) -> Taylor {
        self.form.of(x)
    }
}

#[cfg(test)]
mod tests;
