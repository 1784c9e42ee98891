use super::sine_cosine::SineCosine;

/// Modified sine (modifizierte Sinuslinie): sine ramps over an eighth at both ends, joined by half a
/// wave of a slower sine.
///
/// Ca = 4 pi^2 / (4 + pi) = 5.5280, Cv = Ca / pi = 1.7596, Cj = 4 pi Ca = 69.47.
pub(super) fn modified_sine() -> SineCosine {
    SineCosine::new(0.25, 0.75)
}
