use centrode_mechanism::composed::Composed;

use crate::page::Curve;

/// Samples of one turn of the input.
const SAMPLES: u32 = 720;

/// Least transmission angle of all dyads along the cycle; none for a machine without dyads.
#[must_use]
pub fn curves(composed: &Composed) -> Vec<Curve> {
    if composed.dyads().is_empty() {
        return Vec::new();
    }
    let samples = SAMPLES * composed.design().input.turns;
    let input = |i: u32| composed.period() * f64::from(i) / f64::from(samples);
    let input: Vec<f64> = (0..=samples).map(input).collect();
    let least = |&phi: &f64| {
        let angles = composed.transmission_angles(phi).into_iter();
        angles.fold(f64::INFINITY, f64::min).to_degrees()
    };
    let value = input.iter().map(least).collect();
    vec![Curve::new(
        ["Least transmission angle", "", "°"],
        &input,
        value,
    )]
}
