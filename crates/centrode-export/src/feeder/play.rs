//! The script that plays the model with its loops.

/// Turns the crank of the MJCF model by the motion; the constraints do the rest.
pub(super) fn mujoco() -> Vec<u8> {
    include_str!("play_mujoco.py").into()
}
