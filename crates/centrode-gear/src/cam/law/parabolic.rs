use super::sine_cosine::SineCosine;

/// Two parabolas (quadratische Parabel): constant acceleration, then as much deceleration.
///
/// Cv = 2, Ca = 4; the acceleration jumps by 4 at both ends and by 8 in the middle, so Cj is infinite.
pub(super) fn parabolic() -> SineCosine {
    SineCosine::new(0.0, 0.0)
}
