use std::f64::consts::PI;

use super::Form;
use centrode_kinematics::formula::Taylor;

/// Simple harmonic (einfache Sinuslinie): `s = (1 - cos(pi x)) / 2`.
///
/// Cv = pi / 2, Ca = pi^2 / 2; the acceleration jumps by Ca where the law meets a dwell, so Cj is infinite; between its ends it
/// is pi^3 / 2.
#[derive(Debug)]
pub(super) struct Harmonic;

impl Form for Harmonic {
    fn of(&self, x: Taylor) -> Taylor {
        let half = Taylor::constant(0.5);
        // 2 sin^2(pi x / 2) / 2: exact near x = 0, where 1 - cos cancels.
        let (sin, _) = (x * Taylor::constant(PI) * half).sin_cos();
        sin * sin
    }
}
