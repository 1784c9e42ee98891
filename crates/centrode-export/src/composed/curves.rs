use std::borrow::Cow;

use centrode_mechanism::composed::{Composed, ComposedBody};
use centrode_mechanism::machine::JointKind;

use crate::page::Curve;

/// Samples of one turn of the input, and the most of all turns.
const SAMPLES: u32 = 720;
const MOST: u32 = 2880;

/// Angle of every body along the cycle, place and speed of those that slide, pressure angle of every cam, and the least
/// transmission angle of all dyads, where there are any.
#[must_use]
pub fn curves(composed: &Composed) -> Vec<Curve> {
    let samples = MOST.min(SAMPLES * composed.design().input.turns);
    let input = |i: u32| composed.period() * f64::from(i) / f64::from(samples);
    let input: Vec<f64> = (0..=samples).map(input).collect();
    let shown = |chart: Cow<'static, str>, unit: &'static str, f: &dyn Fn(f64) -> f64| {
        let value = input.iter().map(|&phi| f(phi));
        let curve = Curve::new(["", "", unit], &input, value.collect());
        Curve { chart, ..curve }
    };
    let curve = |chart, f: &dyn Fn(f64) -> f64| shown(chart, "°", &|phi| f(phi).to_degrees());
    let moving = composed.bodies().iter().enumerate().skip(1);
    let mut all: Vec<Curve> = moving
        .map(|(body, ComposedBody { name, .. })| {
            let angle = |phi| composed.angle(body, phi).position;
            curve(format!("Angle of {name}").into(), &angle)
        })
        .collect();
    for body in composed.bodies() {
        let Some(mount) = &body.mount else {
            continue;
        };
        if let JointKind::Sliding(_) = mount.kind {
            let (name, speed) = (&body.name, composed.speed());
            let place = |phi| mount.law.at(phi).position;
            all.push(shown(format!("Place of {name}").into(), "mm", &place));
            let rate = |phi| mount.law.at(phi).velocity * speed;
            all.push(shown(format!("Speed of {name}").into(), "mm/s", &rate));
        }
    }
    for cam in composed.cams() {
        let leans = |phi| cam.disc().contact(cam.turn(phi).position).pressure_angle;
        all.push(curve(
            format!("Pressure angle of {}", cam.name).into(),
            &leans,
        ));
    }
    if !composed.dyads().is_empty() {
        all.push(curve("Least transmission angle".into(), &|phi| {
            let angles = composed.transmission_angles(phi).into_iter();
            angles.fold(f64::INFINITY, f64::min)
        }));
    }
    all
}
