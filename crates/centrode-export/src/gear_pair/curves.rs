use crate::picture::Curve;
use centrode_gear::GearPair;

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
    let curve = |chart, name, unit, value| Curve::new([chart, name, unit], &input, value);
    let law = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { input.iter().map(|&phi| f(phi)).collect() };
    let slope = f64::from(pair.mean_ratio().1) / f64::from(pair.mean_ratio().0);
    vec![
        curve("Ratio", "", "", law(&|phi| pair.ratio(phi))),
        curve(
            "Ratio slope",
            "",
            "1/rad",
            law(&|phi| pair.ratio_slope(phi)),
        ),
        curve(
            "Lead of the driven gear",
            "",
            "°",
            law(&|phi| (pair.driven_angle(phi) - slope * phi).to_degrees()),
        ),
        curve(
            "Pressure angle",
            "forward",
            "°",
            points
                .iter()
                .map(|p| p.pressure_angle.to_degrees())
                .collect(),
        ),
        curve(
            "Pressure angle",
            "reverse",
            "°",
            points
                .iter()
                .map(|p| p.reverse_pressure_angle.to_degrees())
                .collect(),
        ),
        curve(
            "Pitch curvature",
            "driver",
            "1/mm",
            points.iter().map(|p| p.driver_curvature).collect(),
        ),
        curve(
            "Pitch curvature",
            "driven",
            "1/mm",
            points.iter().map(|p| p.driven_curvature).collect(),
        ),
    ]
}
