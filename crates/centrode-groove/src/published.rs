//! Equations (14) to (18) of Zhou et al. 2018 as printed, for comparison with the derived ones.

use super::{GRAVITY, Load, SpeedLaw, SpiralShaft};
use centrode_kinematics::transmission::Transmission;

/// Force on the slider as the paper prints it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedForce {
    /// Normal force of the wall, N: (14), or (17).
    pub normal: f64,
    /// Force round the shaft, N: (15), or (18).
    pub transverse: f64,
}

impl Load {
    /// Normal and transverse force by equations (14) and (15) for an acceleration of the box (m/s^2) and a
    /// lead angle (rad); (17) and (18) are the same with the acceleration of (16).
    ///
    /// Shown next to [`force`](Self::force), not used: the equations assume that load and acceleration are opposed, and (15) has
    /// the wrong sign of (11).
    #[must_use]
    pub fn published(&self, acceleration: f64, lead_angle: f64) -> PublishedForce {
        let lead = lead_angle.abs();
        let friction = self.groove_friction.atan();
        let load = self.mass * (GRAVITY * self.rail_friction - acceleration);
        let cos = (lead + friction).cos();
        PublishedForce {
            normal: load * friction.cos() / cos,
            transverse: load * (lead - friction).sin() / cos,
        }
    }
}

impl SpiralShaft {
    /// Acceleration of the box on a stroke, m/s^2.
    #[must_use]
    pub fn stroke_acceleration(&self, theta: f64, load: &Load) -> f64 {
        self.law().at(theta).acceleration * 1e-3 * load.speed().powi(2)
    }

    /// Acceleration of the box by equation (16), in m/s^2 as (17) takes it: `kappa n w cos(n (theta - theta_0) +
    /// 3 pi / 2)`, with the shaft's angular velocity `w` and the amplitude `kappa` of (3) in metres. None for a
    /// law that is no sine.
    ///
    /// (16) differentiates `kappa sin` as if it were the speed. It is the position, so a factor `n w` is missing
    /// and the unit is m/s. A sine along the shaft of amplitude `B` corresponds to `kappa = B sin b`, with `tan b =
    /// 2 pi R / p`.
    #[must_use]
    pub fn published_acceleration(&self, theta: f64, load: &Load) -> Option<f64> {
        let (kappa, harmonic, phase) = match self.speed_law() {
            SpeedLaw::Sine(law) => {
                let radius = self.groove().radius();
                let across = radius / radius.hypot(self.law().mean_speed());
                (law.amplitude * across, law.harmonic, law.phase)
            }
            SpeedLaw::RotatedSine(law) => (law.amplitude, law.harmonic, law.phase),
            SpeedLaw::Formula(_) | SpeedLaw::Knots(_) | SpeedLaw::Table(_) => return None,
        };
        let n = f64::from(harmonic);
        Some(1e-3 * kappa * n * load.speed() * (n * (theta - phase)).sin())
    }
}
