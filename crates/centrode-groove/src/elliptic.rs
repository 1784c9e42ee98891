use std::f64::consts::TAU;

use super::ShaftError;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::rule::{finite, in_range, positive};

/// The turn of a shaft driven by a pair of focal ellipses: `x - 2 atan2(k sin x, 1 + k cos x)`,
/// slowest at `phase`, where `x = input - phase`.
///
/// The integral (8) of Zhou et al. 2018 in closed form, with the slow side of (7), which is half a turn
/// from its zero, at `phase`. The speed runs from `(1 - k)/(1 + k)` to `(1 + k)/(1 - k)` of its mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EllipticDrive {
    /// Eccentricity `k` of both pitch curves, 0 to below 1.
    pub eccentricity: f64,
    /// Input angle at which the shaft turns slowest, rad.
    pub phase: f64,
}

impl EllipticDrive {
    /// Elliptic pair with which a plain shaft of this lead (mm per turn) moves the slider by `moved` (mm) in the window (rad)
    /// around the slow point: `k = t / (sin h - t cos h)`, `h = W / 2`, `t = tan((W - 2 pi d / p) / 4)`.
    ///
    /// # Errors
    /// [`ShaftError::MovedDistance`] where no eccentricity from 0 to below 1 gives it.
    pub fn for_moved_distance(moved: f64, window: f64, lead: f64) -> Result<Self, ShaftError> {
        positive("lead", lead)?;
        finite("moved_distance", moved)?;
        in_range("window_deg", window.to_degrees(), [1e-6, 359.0], " deg")?;
        let half = 0.5 * window;
        let t = (0.25 * (window - TAU * moved / lead)).tan();
        let eccentricity = t / (half.sin() - t * half.cos());
        if moved > 0.0 && (0.0..1.0).contains(&eccentricity) {
            Ok(Self {
                eccentricity,
                phase: 0.0,
            })
        } else {
            Err(ShaftError::MovedDistance {
                required: moved,
                minimum: 0.0,
                maximum: lead * window / TAU,
            })
        }
    }

    /// Elliptic pair whose maximum speed is `ratio` times its minimum: `k = (sqrt q - 1)/(sqrt q + 1)`.
    ///
    /// # Errors
    /// [`ShaftError::Spec`] unless `ratio` is at least 1.
    pub fn for_speed_ratio(ratio: f64) -> Result<Self, ShaftError> {
        in_range("speed_ratio", ratio, [1.0, 1e6], "")?;
        let root = ratio.sqrt();
        Ok(Self {
            eccentricity: (root - 1.0) / (root + 1.0),
            phase: 0.0,
        })
    }

    /// Input at which the shaft has turned by an angle, rad: the gears with their parts exchanged,
    /// `y + 2 atan2(k sin y, 1 - k cos y)` with `y = turn - phase`.
    #[must_use]
    pub fn input_at(&self, turn: f64) -> f64 {
        let k = self.eccentricity;
        let (sin, cos) = (turn - self.phase).sin_cos();
        turn + 2.0 * (k * sin).atan2(1.0 - k * cos)
    }
}

impl Transmission for EllipticDrive {
    fn at(&self, input: f64) -> MotionJet {
        let k = self.eccentricity;
        let x = input - self.phase;
        let (sin, cos) = x.sin_cos();
        let w = 1.0 + 2.0 * k * cos + k * k;
        let share = 1.0 - k * k;
        MotionJet {
            position: input - 2.0 * (k * sin).atan2(1.0 + k * cos),
            velocity: share / w,
            acceleration: share * 2.0 * k * sin / (w * w),
            jerk: share * (2.0 * k * cos / (w * w) + 8.0 * k * k * sin * sin / (w * w * w)),
        }
    }

    fn advance(&self) -> f64 {
        TAU
    }
}
