use super::Form;
use centrode_kinematics::formula::Taylor;

/// 4-5-6-7 polynomial (Polynom 7. Grades): `s = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7`.
///
/// Cv = 35/16, Ca = 84 sqrt 5 / 25 = 7.5132, Cj = 52.5.
#[derive(Debug)]
pub(super) struct Polynomial4567;

impl Form for Polynomial4567 {
    fn of(&self, x: Taylor) -> Taylor {
        let c = Taylor::constant;
        let square = x * x;
        square * square * (c(35.0) + x * (c(-84.0) + x * (c(70.0) + x * c(-20.0))))
    }
}
