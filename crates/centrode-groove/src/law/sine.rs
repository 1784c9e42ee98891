use std::f64::consts::TAU;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::MAX_HARMONICS;
use crate::ShaftError;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::degrees;
use centrode_spec::rule::{count_in_range, finite, positive};

/// A cosine on the speed: `s = p theta / (2 pi) - B sin(n (theta - theta_0))`, slowest at `theta_0`.
///
/// Equation (2) of Zhou et al. 2018 with its amplitude `B = dv / omega`; the constant there is omitted, for
/// the integral from zero has none. Monotone while `n |B| < p / (2 pi)`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sine {
    /// Amplitude `B`, mm; 0 for a plain shaft.
    pub amplitude: f64,
    /// Slow points per turn, `n`.
    pub harmonic: u32,
    /// Shaft angle `theta_0` of a slow point, rad (degrees in the file).
    #[serde(rename = "phase_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub phase: f64,
}

impl Default for Sine {
    fn default() -> Self {
        Self {
            amplitude: 0.0,
            harmonic: 1,
            phase: 0.0,
        }
    }
}

/// Problem of a required distance in a window around a slow point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AmplitudeFor {
    /// Distance the slider must move in the window, mm.
    pub moved_distance: f64,
    /// Width of the window, rad.
    pub window: f64,
    /// Lead, mm per turn.
    pub lead: f64,
    /// Slow points per turn.
    pub harmonic: u32,
}

impl AmplitudeFor {
    /// Solves for the amplitude, mm: `B = (p W / (2 pi) - d) / (2 sin(n W / 2))`, for the distance `d` in the window `W`.
    ///
    /// # Errors
    /// [`ShaftError::MovedDistance`] where the slider would have to stop or a plain shaft is slower;
    /// [`ShaftError::Window`] for a window of whole waves.
    pub fn solve(self) -> Result<f64, ShaftError> {
        positive("lead", self.lead)?;
        finite("moved_distance", self.moved_distance)?;
        positive("window_deg", self.window.to_degrees())?;
        count_in_range("law.harmonic", self.harmonic, 1, MAX_HARMONICS)?;
        let n = f64::from(self.harmonic);
        let sin = (0.5 * n * self.window).sin();
        let mean = self.lead / TAU;
        if sin.abs() < 1e-9 {
            return Err(ShaftError::Window {
                window_deg: self.window.to_degrees(),
                harmonic: self.harmonic,
            });
        }
        let plain = mean * self.window;
        let bound = plain - 2.0 * mean / n * sin;
        let (minimum, maximum) = (bound.min(plain), bound.max(plain));
        let amplitude = (plain - self.moved_distance) / (2.0 * sin);
        if amplitude >= 0.0 && n * amplitude < mean {
            Ok(amplitude)
        } else {
            Err(ShaftError::MovedDistance {
                required: self.moved_distance,
                minimum,
                maximum,
            })
        }
    }
}

/// A sine law with its lead.
#[derive(Debug)]
pub(super) struct Resolved {
    mean: f64,
    amplitude: f64,
    harmonic: f64,
    phase: f64,
}

impl Sine {
    pub(super) fn resolve(&self, lead: f64) -> Result<Resolved, ShaftError> {
        finite("law.amplitude", self.amplitude)?;
        finite("law.phase_deg", self.phase.to_degrees())?;
        count_in_range("law.harmonic", self.harmonic, 1, MAX_HARMONICS)?;
        let (mean, n) = (lead / TAU, f64::from(self.harmonic));
        if n * self.amplitude.abs() >= mean {
            return Err(ShaftError::Amplitude {
                amplitude: self.amplitude,
                harmonic: self.harmonic,
                lead,
                limit: mean / n,
            });
        }
        Ok(Resolved {
            mean,
            amplitude: self.amplitude,
            harmonic: n,
            phase: self.phase,
        })
    }
}

impl Transmission for Resolved {
    fn at(&self, theta: f64) -> MotionJet {
        let (n, b) = (self.harmonic, self.amplitude);
        let (sin, cos) = (n * (theta - self.phase)).sin_cos();
        MotionJet {
            position: self.mean * theta - b * sin,
            velocity: self.mean - n * b * cos,
            acceleration: n * n * b * sin,
            jerk: n * n * n * b * cos,
        }
    }

    fn advance(&self) -> f64 {
        self.mean * TAU
    }
}
