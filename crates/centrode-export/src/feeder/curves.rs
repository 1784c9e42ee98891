use std::f64::consts::TAU;

use centrode_machines::feeder::Feeder;

use crate::picture::Curve;

/// Samples of one cycle.
const SAMPLES: u32 = 720;

/// Angle of the effector, speed and acceleration of its tip, turn of the crank, angle between coupler and rocker along the cycle.
#[must_use]
pub fn curves(feeder: &Feeder) -> Vec<Curve> {
    let (speed, reach) = (feeder.speed(), feeder.six_bar().effector_length());
    let bar = *feeder.six_bar().four_bar();
    let input = |i: u32| TAU * f64::from(i) / f64::from(SAMPLES);
    let input: Vec<f64> = (0..=SAMPLES).map(input).collect();
    let curve = |chart, unit, f: &dyn Fn(f64) -> f64| {
        let value = input.iter().map(|&phi| f(phi));
        Curve::new([chart, "", unit], &input, value.collect())
    };
    vec![
        curve("Angle of the effector", "°", &|phi| {
            feeder.effector(phi).position.to_degrees()
        }),
        curve("Speed of the tip", "mm/s", &|phi| {
            (feeder.effector(phi).velocity * speed * reach).abs()
        }),
        curve("Acceleration of the tip along its path", "m/s²", &|phi| {
            1e-3 * feeder.effector(phi).acceleration * speed * speed * reach
        }),
        curve("Turn of the crank", "°", &|phi| {
            feeder.crank(phi).position.to_degrees()
        }),
        curve("Angle of coupler and rocker", "°", &|phi| {
            bar.transmission_angle(feeder.crank(phi).position)
                .to_degrees()
        }),
    ]
}
