use crate::csv::Column;
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::GearPair;
use std::f64::consts::TAU;

/// Fewest steps of one driver turn: half degrees.
const STEPS: f64 = 720.0;

/// Driver and driven angle, ratio and its slope over one whole cycle at equal steps.
///
/// Between rows the driven angle is linear to within the tolerance at the radius of the centre distance.
pub(super) fn columns(pair: &GearPair, tolerance: Tolerance) -> Vec<Column> {
    let angles = angles(pair, tolerance);
    let over = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { angles.iter().map(|&phi| f(phi)).collect() };
    vec![
        Column::numbers("driver_angle_rad", angles.iter().copied()),
        Column::numbers("driven_angle_rad", over(&|phi| pair.driven_angle(phi))),
        Column::numbers("ratio", over(&|phi| pair.ratio(phi))),
        Column::numbers("ratio_slope_per_rad", over(&|phi| pair.ratio_slope(phi))),
    ]
}

fn angles(pair: &GearPair, tolerance: Tolerance) -> Vec<f64> {
    let least = STEPS * pair.cycle() / TAU;
    // A chord of the law over a step h is off by at most h² / 8 times the greatest slope.
    let slope = (0..=2880)
        .map(|i| pair.ratio_slope(TAU * f64::from(i) / 2880.0).abs())
        .fold(0.0, f64::max);
    let angle = tolerance.mm() / pair.center_distance();
    let steps = (pair.cycle() * (slope / (8.0 * angle)).sqrt()).clamp(least, 1e6);
    let steps = steps.ceil() as u32;
    (0..=steps)
        .map(|i| pair.cycle() * f64::from(i) / f64::from(steps))
        .collect()
}

/// The straight line nearest to the law of motion: driven angle = slope x driver angle + offset, and the
/// greatest distance from it, rad.
pub(super) fn line(pair: &GearPair) -> (f64, f64, f64) {
    let (driver, driven) = pair.mean_ratio();
    let slope = f64::from(driven) / f64::from(driver);
    let steps = 2880 * driver;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..=steps {
        let phi = pair.cycle() * f64::from(i) / f64::from(steps);
        let rest = pair.driven_angle(phi) - slope * phi;
        low = low.min(rest);
        high = high.max(rest);
    }
    (slope, 0.5 * (low + high), 0.5 * (high - low))
}
