use std::borrow::Cow;

use centrode_mechanism::composed::{Composed, ComposedBody};

use crate::page::Curve;

/// Samples of one turn of the input.
const SAMPLES: u32 = 720;

/// Angle of every body along the cycle, and the least transmission angle of all dyads, where there are any.
#[must_use]
pub fn curves(composed: &Composed) -> Vec<Curve> {
    let samples = SAMPLES * composed.design().input.turns;
    let input = |i: u32| composed.period() * f64::from(i) / f64::from(samples);
    let input: Vec<f64> = (0..=samples).map(input).collect();
    let curve = |chart: Cow<'static, str>, f: &dyn Fn(f64) -> f64| {
        let value = input.iter().map(|&phi| f(phi).to_degrees());
        let curve = Curve::new(["", "", "°"], &input, value.collect());
        Curve { chart, ..curve }
    };
    let moving = composed.bodies().iter().enumerate().skip(1);
    let mut all: Vec<Curve> = moving
        .map(|(body, ComposedBody { name, .. })| {
            let angle = |phi| composed.angle(body, phi).position;
            curve(format!("Angle of {name}").into(), &angle)
        })
        .collect();
    if !composed.dyads().is_empty() {
        all.push(curve("Least transmission angle".into(), &|phi| {
            let angles = composed.transmission_angles(phi).into_iter();
            angles.fold(f64::INFINITY, f64::min)
        }));
    }
    all
}
