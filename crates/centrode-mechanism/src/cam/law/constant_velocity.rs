use super::Form;
use crate::formula::Taylor;

/// Straight line (Gerade): `s = x`.
///
/// Cv = 1, Ca = Cj = 0; its ends must join a motion of the same velocity.
#[derive(Debug)]
pub(super) struct ConstantVelocity;

impl Form for ConstantVelocity {
    fn of(&self, x: Taylor) -> Taylor {
        x
    }
}
