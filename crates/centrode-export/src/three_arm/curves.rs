use std::f64::consts::TAU;

use centrode_mechanism::three_arm::{Chain, ThreeArm};

use crate::page::Curve;

/// Samples of one carrier turn.
const SAMPLES: u32 = 360;

/// Motion of the first arm along a carrier turn, at the design's rate.
#[must_use]
pub fn curves(mechanism: &ThreeArm) -> Vec<Curve> {
    let input = |i: u32| TAU * f64::from(i) / f64::from(SAMPLES);
    let inputs: Vec<f64> = (0..=SAMPLES).map(input).collect();
    let chains: Vec<Chain<'_>> = inputs.iter().map(|&phi| mechanism.chain(0, phi)).collect();
    let speed = mechanism.carrier_speed();
    let curve = |chart, name, unit, f: &dyn Fn(&Chain<'_>) -> f64| {
        Curve::new([chart, name, unit], &inputs, chains.iter().map(f).collect())
    };
    let tip = |chain: &Chain<'_>| chain.tip().at_speed(speed);
    vec![
        curve("Clamp above horizontal", "", "°", &|chain| {
            chain.clamp_elevation().to_degrees()
        }),
        curve("Height of the tip", "", "mm", &|chain| {
            chain.tip().position.y
        }),
        curve("Speed of the tip", "", "mm/s", &|chain| {
            tip(chain).velocity.norm()
        }),
        curve("Acceleration of the tip", "", "m/s²", &|chain| {
            1e-3 * tip(chain).acceleration.norm()
        }),
        curve("Turn a carrier turn", "intermediate gear", "", &|chain| {
            chain.train().intermediate.velocity
        }),
        curve("Turn a carrier turn", "planet", "", &|chain| {
            chain.train().planet.velocity
        }),
    ]
}
