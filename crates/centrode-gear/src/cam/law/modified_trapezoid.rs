use super::sine_cosine::SineCosine;

/// Modified trapezoid (modifiziertes Beschleunigungstrapez): constant acceleration and deceleration with
/// sine ramps of an eighth.
///
/// Cv = 2, Ca = 8 pi / (2 + pi) = 4.8881, Cj = 4 pi Ca = 61.43.
pub(super) fn modified_trapezoid() -> SineCosine {
    SineCosine::new(0.25, 0.25)
}
