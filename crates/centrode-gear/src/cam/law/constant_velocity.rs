use super::Form;
use centrode_kinematics::formula::Taylor;

/// Straight line (Gerade): `s = x`.
///
/// Cv = 1; the velocity jumps where it meets a dwell, so Ca and Cj are infinite, and 0 inside. Its ends must join a motion of the
/// same velocity.
#[derive(Debug)]
pub(super) struct ConstantVelocity;

impl Form for ConstantVelocity {
    fn of(&self, x: Taylor) -> Taylor {
        x
    }
}
