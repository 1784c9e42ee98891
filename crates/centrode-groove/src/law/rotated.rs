use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::MAX_HARMONICS;
use crate::ShaftError;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::degrees;
use centrode_spec::rule::{count_in_range, finite};

/// A sine drawn across the helix and turned with it: equations (3) to (5) of Zhou et al. 2018.
///
/// With `tan b = 2 pi R / p`: `theta = E + e sin(n E)`, `e = kappa cos(b) / R`, and
/// `s = p theta / (2 pi) - kappa / sin(b) sin(n E)`, slowest at `theta_0`. It is not the integral of the
/// speed law (1); a plain shaft has `kappa = 0`, not 1.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct RotatedSine {
    /// Amplitude across the helix `kappa`, mm on the development.
    pub amplitude: f64,
    /// Slow points per turn, `n`.
    pub harmonic: u32,
    /// Shaft angle `theta_0` of a slow point, rad (degrees in the file).
    #[serde(rename = "phase_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub phase: f64,
}

impl Default for RotatedSine {
    fn default() -> Self {
        Self {
            amplitude: 0.0,
            harmonic: 1,
            phase: 0.0,
        }
    }
}

#[derive(Debug)]
pub(super) struct Resolved {
    mean: f64,
    /// Relative amplitude `e`.
    share: f64,
    /// Amplitude along the shaft, `kappa / sin b`.
    along: f64,
    harmonic: f64,
    phase: f64,
}

impl RotatedSine {
    pub(super) fn resolve(&self, lead: f64, radius: f64) -> Result<Resolved, ShaftError> {
        finite("law.amplitude", self.amplitude)?;
        finite("law.phase_deg", self.phase.to_degrees())?;
        count_in_range("law.harmonic", self.harmonic, 1, MAX_HARMONICS)?;
        let (mean, n) = (lead / TAU, f64::from(self.harmonic));
        let turn = radius.hypot(mean);
        // cos b = mean / turn, sin b = radius / turn. Neither the angle nor the slider may run back.
        let share = self.amplitude * mean / (turn * radius);
        let along = self.amplitude * turn / radius;
        // The speed has the sign of mean - n kappa R / turn cos(n E), the angle's that of 1 + n e cos(n E).
        let limit = (mean * turn / radius).min(turn * radius / mean) / n;
        if self.amplitude.abs() >= limit {
            return Err(ShaftError::Amplitude {
                amplitude: self.amplitude,
                harmonic: self.harmonic,
                lead,
                limit,
            });
        }
        Ok(Resolved {
            mean,
            share,
            along,
            harmonic: n,
            phase: self.phase,
        })
    }

    /// Running angle `E` of the sine at a shaft angle counted from the phase.
    fn running(share: f64, n: f64, theta: f64) -> f64 {
        let mut running = theta - share * (n * theta).sin() / (1.0 + n * share * (n * theta).cos());
        for _ in 0..50 {
            let (sin, cos) = (n * running).sin_cos();
            let step = (running + share * sin - theta) / (1.0 + n * share * cos);
            running -= step;
            if step.abs() <= 4.0 * f64::EPSILON * running.abs().max(1.0) {
                break;
            }
        }
        running
    }
}

impl Transmission for Resolved {
    fn at(&self, theta: f64) -> MotionJet {
        let n = self.harmonic;
        let running = RotatedSine::running(self.share, n, theta - self.phase);
        let (sin, cos) = (n * running).sin_cos();
        let wave = |size: f64| MotionJet {
            position: size * sin,
            velocity: size * n * cos,
            acceleration: -size * n * n * sin,
            jerk: -size * n * n * n * cos,
        };
        let mut angle = wave(self.share);
        angle.position += running;
        angle.velocity += 1.0;
        let mut motion = wave(-self.along).after(&angle.inverse(running));
        motion.position += self.mean * theta;
        motion.velocity += self.mean;
        motion
    }

    fn advance(&self) -> f64 {
        self.mean * TAU
    }
}
