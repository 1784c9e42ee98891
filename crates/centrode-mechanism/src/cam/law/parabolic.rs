use super::sine_cosine::SineCosine;

/// Two parabolas (quadratische Parabel): constant acceleration, then as much deceleration.
///
/// Cv = 2, Ca = 4; the acceleration jumps at both ends and in the middle.
pub(super) fn parabolic() -> SineCosine {
    SineCosine::new(0.0, 0.0)
}
