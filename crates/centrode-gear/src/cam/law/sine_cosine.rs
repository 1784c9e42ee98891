use std::f64::consts::PI;

use super::Form;
use centrode_kinematics::formula::Taylor;

/// A law whose acceleration rises by a quarter sine over `ramp / 2`, stays constant and falls by a
/// quarter cosine over `fall / 2` to the middle; the second half is the first, turned about the middle.
///
/// The family of Norton, R. L., Cam Design and Manufacturing Handbook, 2nd ed. (2009), chapter 3.
#[derive(Debug)]
pub(super) struct SineCosine {
    ramp: f64,
    fall: f64,
    /// Peak acceleration Ca.
    peak: f64,
    /// Law and velocity at the end of the ramp and at the start of the fall, over the peak.
    after_ramp: [f64; 2],
    before_fall: [f64; 2],
}

impl SineCosine {
    /// Makes a law; `ramp + fall` must be at most 1.
    pub(super) fn new(ramp: f64, fall: f64) -> Self {
        let (b, d) = (ramp / PI, fall / PI);
        let flat = 0.5 * (1.0 - ramp - fall);
        let after_ramp = [b * (0.5 * ramp - b), b];
        let before_fall = [
            after_ramp[0] + b * flat + 0.5 * flat * flat,
            after_ramp[1] + flat,
        ];
        // Law over the peak at the middle, where the law must be 1/2.
        let middle = before_fall[0] + before_fall[1] * 0.5 * fall + d * d;
        Self {
            ramp,
            fall,
            peak: 0.5 / middle,
            after_ramp,
            before_fall,
        }
    }

    /// The first half of the law at `x` (0 to 1/2), by the formula of a zone.
    fn half(&self, x: Taylor, zone: Zone) -> Taylor {
        let c = Taylor::constant;
        let sum = match zone {
            Zone::Ramp => {
                let b = self.ramp / PI;
                let (sin, _) = (x * c(1.0 / b)).sin_cos();
                (x - sin * c(b)) * c(b)
            }
            Zone::Constant => {
                let [s, v] = self.after_ramp;
                let t = x - c(0.5 * self.ramp);
                c(s) + t * (c(v) + t * c(0.5))
            }
            Zone::Fall => {
                let [s, v] = self.before_fall;
                let d = self.fall / PI;
                let t = x - c(0.5 * (1.0 - self.fall));
                // 1 - cos, without cancellation.
                let (sin, _) = (t * c(0.5 / d)).sin_cos();
                c(s) + t * c(v) + sin * sin * c(2.0 * d * d)
            }
        };
        sum * c(self.peak)
    }
}

#[derive(Clone, Copy)]
enum Zone {
    Ramp,
    Constant,
    Fall,
}

impl Form for SineCosine {
    fn of(&self, x: Taylor) -> Taylor {
        let at = x.0[0];
        let (ramp, fall) = (0.5 * self.ramp, 0.5 * (1.0 - self.fall));
        let zone = |in_ramp: bool, in_constant: bool| match (in_ramp, in_constant) {
            (true, _) => Zone::Ramp,
            (false, true) => Zone::Constant,
            (false, false) => Zone::Fall,
        };
        // The exact breaks are compared, so each break gives its limit from the right.
        if at < 0.5 {
            self.half(x, zone(at < ramp, at < fall))
        } else {
            let one = Taylor::constant(1.0);
            let zone = zone(at >= 1.0 - ramp && ramp > 0.0, at >= 1.0 - fall);
            one - self.half(one - x, zone)
        }
    }

    fn breaks(&self) -> Vec<f64> {
        let (ramp, fall) = (0.5 * self.ramp, 0.5 * (1.0 - self.fall));
        let mut breaks: Vec<f64> = [ramp, fall, 1.0 - fall, 1.0 - ramp]
            .into_iter()
            .filter(|&x| x > 0.0 && x < 1.0)
            .collect();
        breaks.dedup();
        breaks
    }
}
