use std::f64::consts::TAU;

use super::Form;
use centrode_kinematics::formula::Taylor;

/// Inclined sine (Sinoide von Bestehorn): `s = x - sin(2 pi x) / (2 pi)`.
///
/// Cv = 2, Ca = 2 pi, Cj = 4 pi^2.
#[derive(Debug)]
pub(super) struct Cycloidal;

impl Form for Cycloidal {
    fn of(&self, x: Taylor) -> Taylor {
        let (sin, _) = (x * Taylor::constant(TAU)).sin_cos();
        x - sin * Taylor::constant(1.0 / TAU)
    }
}
