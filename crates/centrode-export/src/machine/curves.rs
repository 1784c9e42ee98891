use std::borrow::Cow;
use std::f64::consts::PI;

use centrode_kinematics::machine::JointKind;
use centrode_machines::machine::{Machine, MachineBody};

use crate::picture::Curve;

/// Samples per turn of the input, and their maximum number for all turns.
const SAMPLES: u32 = 720;
const MOST: u32 = 2880;

/// Angle of every body along the cycle, position and speed of those that slide, pressure angle and motion of the follower of
/// every cam, and the minimum transmission angle of all dyads, if there are any.
#[must_use]
pub fn curves(composed: &Machine) -> Vec<Curve> {
    let samples = MOST.min(SAMPLES * composed.design().input.turns);
    let input = |i: u32| composed.period() * f64::from(i) / f64::from(samples);
    let input: Vec<f64> = (0..=samples).map(input).collect();
    // Descending: the picture is made at the same time, ascending, so that each cached value of a law is computed only once.
    let mut rows: Vec<Vec<f64>> = input.iter().rev().map(|&phi| row(composed, phi)).collect();
    rows.reverse();
    let names = names(composed).into_iter().enumerate();
    names
        .map(|(k, (chart, unit))| {
            let value = rows.iter().map(|row| row[k]).collect();
            let curve = Curve::new(["", "", unit], &input, value);
            Curve { chart, ..curve }
        })
        .collect()
}

/// Chart and unit of every curve.
fn names(composed: &Machine) -> Vec<(Cow<'static, str>, &'static str)> {
    let moving = composed.bodies().iter().skip(1);
    let angles = moving.map(|body| (format!("Angle of {}", body.name), "°"));
    let slides = sliding(composed).flat_map(|(MachineBody { name, .. }, _)| {
        [
            (format!("Position of {name}"), "mm"),
            (format!("Speed of {name}"), "mm/s"),
        ]
    });
    let cams = composed.cams().iter();
    let cams = cams.flat_map(|cam| {
        let units = match cam.disc().follower().swings() {
            true => ["°", "°/s", "°/s²", "°/s³"],
            false => ["mm", "mm/s", "mm/s²", "mm/s³"],
        };
        let of = |words: &str, unit| (format!("{words} of {}", cam.name), unit);
        let [s, v, a, j] = units;
        [
            of("Pressure angle", "°"),
            of("Follower position", s),
            of("Follower velocity", v),
            of("Follower acceleration", a),
            of("Follower jerk", j),
        ]
    });
    let dyads = (!composed.dyads().is_empty()).then(|| ("Minimum transmission angle".into(), "°"));
    let all = angles.chain(slides).chain(cams).chain(dyads);
    all.map(|(chart, unit)| (chart.into(), unit)).collect()
}

/// Value of every curve at an input, as shown.
fn row(composed: &Machine, input: f64) -> Vec<f64> {
    let bodies = composed.bodies();
    let at = |body: &MachineBody| body.mount.as_ref().map(|mount| mount.law.at(input));
    let laws: Vec<_> = bodies.iter().map(at).collect();
    // A carrier comes before the bodies that it carries.
    let mut angles = vec![0.0; bodies.len()];
    for (body, law) in laws.iter().enumerate() {
        let (Some(mount), Some(law)) = (&bodies[body].mount, law) else {
            continue;
        };
        angles[body] = angles[mount.carrier] + mount.angle;
        if mount.kind == JointKind::Turning {
            angles[body] += law.position;
        }
    }
    let mut row: Vec<f64> = angles[1..].iter().map(|angle| angle.to_degrees()).collect();
    for (_, body) in sliding(composed) {
        let law = laws[body].unwrap_or_default();
        row.extend([law.position, law.velocity * composed.speed()]);
    }
    row.extend(composed.cams().iter().flat_map(|cam| {
        let turn = cam.turn(input);
        let contact = cam.disc().contact(turn.position);
        let motion = contact.motion.after(&turn);
        let (scale, speed) = match cam.disc().follower().swings() {
            true => (1_f64.to_degrees(), composed.speed()),
            false => (1.0, composed.speed()),
        };
        [
            contact.pressure_angle.to_degrees(),
            scale * motion.position,
            scale * motion.velocity * speed,
            scale * motion.acceleration * speed.powi(2),
            scale * motion.jerk * speed.powi(3),
        ]
    }));
    if !composed.dyads().is_empty() {
        let angles = composed.transmission_angles(input).into_iter();
        let angles = angles.map(|angle| angle.min(PI - angle));
        row.push(angles.fold(f64::INFINITY, f64::min).to_degrees());
    }
    row
}

/// Bodies that slide, with their numbers.
fn sliding(composed: &Machine) -> impl Iterator<Item = (&MachineBody, usize)> {
    let bodies = composed.bodies().iter().zip(0..);
    bodies.filter(|(body, _)| {
        let mount = body.mount.as_ref();
        mount.is_some_and(|mount| matches!(mount.kind, JointKind::Sliding(_)))
    })
}
