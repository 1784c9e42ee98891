use super::Form;
use centrode_kinematics::formula::Taylor;

/// Straight line (Gerade): `s = x`.
///
/// Cv = 1; the velocity jumps where the law meets a dwell, so Ca and Cj are infinite; between its ends both are 0. The motions at
/// its ends must have the same velocity.
#[derive(Debug)]
pub(super) struct ConstantVelocity;

impl Form for ConstantVelocity {
    fn of(&self, x: Taylor) -> Taylor {
        x
    }
}
