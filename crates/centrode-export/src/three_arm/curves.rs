use std::f64::consts::TAU;

use centrode_machines::three_arm::{Chain, PointMotion, ThreeArm};

use crate::picture::Curve;

/// Samples of one carrier turn.
const SAMPLES: u32 = 360;
/// Names of the arms, as their links have them.
const ARMS: [&str; 6] = ["arm 1", "arm 2", "arm 3", "arm 4", "arm 5", "arm 6"];

/// Motion of the first arm along a carrier turn, at the design's rate.
#[must_use]
pub fn curves(mechanism: &ThreeArm) -> Vec<Curve> {
    let inputs = inputs();
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
        curve(
            "Turns per carrier turn",
            "intermediate gear",
            "",
            &|chain| chain.train().intermediate.velocity,
        ),
        curve("Turns per carrier turn", "planet", "", &|chain| {
            chain.train().planet.velocity
        }),
    ]
}

/// Position and velocity of every arm's tip along a carrier turn, by components, at the design's rate.
#[must_use]
pub fn arm_curves(mechanism: &ThreeArm) -> Vec<Curve> {
    let inputs = inputs();
    let speed = mechanism.carrier_speed();
    let motions: Vec<Vec<PointMotion>> = (0..mechanism.arms())
        .map(|arm| {
            let tip = |&phi: &f64| mechanism.tip(phi, arm).at_speed(speed);
            inputs.iter().map(tip).collect()
        })
        .collect();
    let chart =
        |chart: &'static str, unit: &'static str, f: &dyn Fn(&PointMotion) -> f64| -> Vec<Curve> {
            let arms = ARMS.into_iter().zip(&motions);
            arms.map(|(name, motion)| {
                Curve::new([chart, name, unit], &inputs, motion.iter().map(f).collect())
            })
            .collect()
        };
    [
        chart("X of the tips", "mm", &|tip| tip.position.x),
        chart("Y of the tips", "mm", &|tip| tip.position.y),
        chart("Velocity of the tips, x", "mm/s", &|tip| tip.velocity.x),
        chart("Velocity of the tips, y", "mm/s", &|tip| tip.velocity.y),
    ]
    .concat()
}

/// Carrier turns at which curves are sampled.
fn inputs() -> Vec<f64> {
    (0..=SAMPLES)
        .map(|i| TAU * f64::from(i) / f64::from(SAMPLES))
        .collect()
}
