use crate::picture::Curve;
use centrode_gear::{GearPair, PitchPoint};

/// Samples of one driver turn.
const SAMPLES: u32 = 360;

/// Law of motion, curvature and pressure angle along the cycle.
#[must_use]
pub fn curves(pair: &GearPair) -> Vec<Curve> {
    let steps = SAMPLES * pair.mean_ratio().0;
    let input: Vec<f64> = (0..=steps)
        .map(|i| pair.cycle() * f64::from(i) / f64::from(steps))
        .collect();
    let points: Vec<_> = input.iter().map(|&phi| pair.pitch_point(phi)).collect();
    let law = |chart, unit, f: &dyn Fn(f64) -> f64| {
        let value = input.iter().map(|&phi| f(phi)).collect();
        Curve::new([chart, "", unit], &input, value)
    };
    let of_point = |chart, name, unit, f: fn(&PitchPoint) -> f64| {
        Curve::new([chart, name, unit], &input, points.iter().map(f).collect())
    };
    let slope = f64::from(pair.mean_ratio().1) / f64::from(pair.mean_ratio().0);
    vec![
        law("Ratio", "", &|phi| pair.ratio(phi)),
        law("Ratio slope", "1/rad", &|phi| pair.ratio_slope(phi)),
        law("Lead of the driven gear", "°", &|phi| {
            (pair.driven_angle(phi) - slope * phi).to_degrees()
        }),
        of_point("Pressure angle", "forward", "°", |p| {
            p.pressure_angle.to_degrees()
        }),
        of_point("Pressure angle", "reverse", "°", |p| {
            p.reverse_pressure_angle.to_degrees()
        }),
        of_point("Pitch curvature", "driver", "1/mm", |p| p.driver_curvature),
        of_point("Pitch curvature", "driven", "1/mm", |p| p.driven_curvature),
    ]
}
