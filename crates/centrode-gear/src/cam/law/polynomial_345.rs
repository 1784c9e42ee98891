use super::Form;
use centrode_kinematics::formula::Taylor;

/// 3-4-5 polynomial (Polynom 5. Grades): `s = 10 x^3 - 15 x^4 + 6 x^5`.
///
/// Cv = 15/8, Ca = 10 / sqrt 3 = 5.7735, Cj = 60.
#[derive(Debug)]
pub(super) struct Polynomial345;

impl Form for Polynomial345 {
    fn of(&self, x: Taylor) -> Taylor {
        let c = Taylor::constant;
        x * x * x * (c(10.0) + x * (c(-15.0) + x * c(6.0)))
    }
}
