use super::simulator::joint_name;
use crate::csv::Column;
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::{GearPair, Member};
use std::f64::consts::TAU;

/// Fewest steps of one driver turn: half degrees.
const STEPS: f64 = 720.0;

/// Angle, rad, below which a law of motion counts as linear: float noise over a whole cycle.
pub(super) const LINEAR: f64 = 1e-9;

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

pub(super) fn angles(pair: &GearPair, tolerance: Tolerance) -> Vec<f64> {
    let least = STEPS * pair.cycle() / TAU;
    // A chord of the law over a step h is off by at most h² / 8 times the greatest slope.
    let slope = greatest_slope(pair);
    let angle = tolerance.mm() / pair.center_distance();
    let steps = (pair.cycle() * (slope / (8.0 * angle)).sqrt()).clamp(least, 1e6);
    let steps = steps.ceil() as u32;
    (0..=steps)
        .map(|i| pair.cycle() * f64::from(i) / f64::from(steps))
        .collect()
}

/// Greatest slope of the ratio, 1/rad, of 2880 over a turn.
fn greatest_slope(pair: &GearPair) -> f64 {
    (0..=2880)
        .map(|i| pair.ratio_slope(TAU * f64::from(i) / 2880.0).abs())
        .fold(0.0, f64::max)
}

/// What `motion.csv` means, as JSON for programs: columns, units, joints, how to read between rows and
/// beyond them, and what a linear stand-in would cost.
pub(super) fn sidecar(pair: &GearPair, tolerance: Tolerance) -> Vec<u8> {
    let angles = angles(pair, tolerance);
    let step = pair.cycle() / (angles.len() - 1) as f64;
    let (slope, offset, error) = line(pair);
    let [driver, driven] = [Member::Driver, Member::Driven].map(joint_name);
    format!(
        r#"{{
  "table": "motion.csv",
  "input": "driver_angle_rad",
  "columns": [
    {{"name": "driver_angle_rad", "unit": "rad", "meaning": "polar angle of the driver's pitch point; the driver has turned by minus this"}},
    {{"name": "driven_angle_rad", "unit": "rad", "meaning": "angle the driven gear has turned by, counter-clockwise"}},
    {{"name": "ratio", "unit": "1", "meaning": "d driven_angle / d driver_angle"}},
    {{"name": "ratio_slope_per_rad", "unit": "1/rad", "meaning": "d ratio / d driver_angle"}}
  ],
  "rows": {rows},
  "joints": [
    {{"name": "{driver}", "column": "driver_angle_rad", "factor": -1.0}},
    {{"name": "{driven}", "column": "driven_angle_rad", "factor": 1.0}}
  ],
  "interpolation": {{"kind": "linear", "steps": "equal", "error_max_rad": {between:?}}},
  "continuation": {{"kind": "cyclic", "driver_angle_rad": {cycle:?}, "driven_angle_rad": {turned:?}}},
  "linear_stand_in": {{"multiplier": {multiplier:?}, "offset_rad": {offset:?}, "error_max_rad": {error:?}, "is_the_law": {is_the_law}}}
}}
"#,
        rows = angles.len(),
        between = greatest_slope(pair) * step * step / 8.0,
        cycle = pair.cycle(),
        turned = pair.driven_angle(pair.cycle()),
        multiplier = -slope,
        is_the_law = error <= LINEAR,
    )
    .into_bytes()
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
