use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_gear::{GearPair, Member};
use centrode_geometry::{Outline, Point, WRITTEN};
use centrode_kinematics::machine::{Constant, Line, LineRole, LinkedMachine, Mark, Quantity, Seat};
use centrode_kinematics::transmission::{FromFn, MotionJet};
use centrode_machines::three_arm::{ThreeArm, ThreeArmLink};

use super::bodies;
use super::machine::Parts;
use crate::gear_pair;

/// Number of planted seedlings that are shown.
const SEEDLINGS: u32 = 4;
/// Number of corners of each curve that is drawn instead of teeth.
const CORNERS: u32 = 240;
/// Draws gears, carrier, arms, the path of the tip, tray and seedlings. Without a pair the gears are drawn by their pitch and tip
/// curves; without parts carrier and arms are bars.
pub(super) fn draw(
    mechanism: &ThreeArm,
    parts: Option<&Parts<'_>>,
    teeth: Option<&GearPair>,
    machine: &mut LinkedMachine,
) {
    let link = |machine: &LinkedMachine, name: &str| machine.link_named(name).unwrap_or(0);
    let around = surroundings(mechanism);
    let around = machine.sketch("surroundings", around);
    machine.draw("machine", 0, around);
    let way = machine.sketch("way", vec![Line::trace(LineRole::OverGround, 0)]);
    let ground = link(machine, "ground");
    machine.draw("ground", ground, way);
    planted(mechanism, machine);
    let [sun, intermediate] = [Member::Driver, Member::Driven].map(|member| {
        let lines = match teeth {
            Some(pair) => gear_pair::lines(pair.gear(member)),
            None => plain(mechanism, member),
        };
        machine.sketch(member.name(), lines)
    });
    let fixed = link(machine, "sun");
    machine.draw("sun", fixed, sun);
    let chains = |machine: &mut LinkedMachine, link_name: &str, name: &str, sketch: usize| {
        for k in 0..mechanism.arms() {
            let own = link(machine, &format!("{link_name}_{k}"));
            machine.draw(&format!("{name} {}", k + 1), own, sketch);
        }
    };
    chains(machine, "intermediate", "intermediate gear", intermediate);
    let planet = match parts {
        None => sun,
        Some(parts) => {
            let lines = gear_pair::lines(parts.pairs[1].gear(Member::Driver));
            machine.sketch("planet", lines)
        }
    };
    chains(machine, "planet", "planet", planet);
    match parts {
        Some(parts) => bodies::draw(parts, machine),
        None => {
            let legs = machine.sketch("carrier", carrier(mechanism));
            let turning = link(machine, "carrier");
            machine.draw("carrier", turning, legs);
            let limb = machine.sketch("arm", arm(mechanism));
            chains(machine, "arm", "arm", limb);
        }
    }
    let mark = |(name, input): (&str, f64)| {
        let Point { coords } = mechanism.tip(input, 0).position;
        Mark {
            name: name.into(),
            figure: 0,
            at: coords.into(),
        }
    };
    let work = [
        ("picking", mechanism.picking(0)),
        ("planting", mechanism.planting(0)),
    ];
    machine.marks.extend(work.map(mark));
}

/// The seedlings planted last, the newest first: at each planting the number of every seedling rises by one.
fn planted(mechanism: &ThreeArm, machine: &mut LinkedMachine) {
    let Some(stem) = mechanism.stem() else {
        return;
    };
    let stem = machine.sketch("stem", vec![Line::contour(LineRole::Ground, &stem)]);
    let apart = TAU / f64::from(mechanism.arms());
    let release = mechanism.planting(0);
    let Some(foot) = mechanism.planted(release, 1).first().copied() else {
        return;
    };
    // The seedlings move with the ground, backwards under the machine.
    let velocity = mechanism.train().direction().sign() * mechanism.advance();
    for before in 0..SEEDLINGS {
        let place = move |input: f64| {
            let steps = (input - release) / apart;
            let since = steps - (steps + WRITTEN).floor() + f64::from(before);
            MotionJet::uniform(foot.x + velocity * since * apart, velocity)
        };
        let breaks = vec![release.rem_euclid(apart)];
        let x = Quantity::Law(Arc::new(FromFn::new(apart, 0.0, breaks, place)));
        let still = |at: f64| Quantity::Law(Arc::new(Constant(at)));
        let seat = Seat::Free(Box::new([x, still(foot.y), still(0.0)]));
        let name = format!("planted seedling {}", before + 1);
        machine.draw_at(&name, seat, [0.0; 3], stem);
    }
}

/// A gear by its pitch curve and, a module beyond, the curve of its tips.
fn plain(mechanism: &ThreeArm, member: Member) -> Vec<Line> {
    let rolling = mechanism.rolling();
    let length = rolling.pitch_length(member);
    let curve = |(role, beyond): (LineRole, f64)| {
        let point = |i: u32| {
            let arc = length * f64::from(i) / f64::from(CORNERS);
            let frame = rolling.frame(member, rolling.parameter(arc));
            frame.point + frame.normal * beyond
        };
        let points: Vec<Point> = (0..CORNERS).map(point).collect();
        Line::contour(role, &Outline::polygon(&points))
    };
    let module = mechanism.module().unwrap_or_default();
    let lines = [(LineRole::Body, module), (LineRole::Pitch, 0.0)];
    lines.map(curve).into()
}

/// The legs from the sun's axis over the axis of each intermediate gear to the axis of its planet.
fn carrier(mechanism: &ThreeArm) -> Vec<Line> {
    let leg = |k: u32| {
        let [middle, end] = [ThreeArmLink::Intermediate(k), ThreeArmLink::Planet(k)];
        let axes = [middle, end].map(|link| mechanism.on_carrier(link));
        Line::chain(LineRole::Bar, &[Point::origin(), axes[0], axes[1]])
    };
    (0..mechanism.arms()).map(leg).collect()
}

/// Points of an arm in its frame: the planet's axis, its foot on the pusher's axis, the start of the clamp, and the tip.
pub(super) fn joints(mechanism: &ThreeArm) -> [Point; 4] {
    let spec = &mechanism.design().arm;
    let offset = -spec.pusher_offset;
    let reach = (spec.tip_distance.powi(2) - offset.powi(2)).max(0.0).sqrt();
    [
        Point::origin(),
        Point::new(0.0, offset),
        Point::new(reach - spec.clamp_length, offset),
        Point::new(reach, offset),
    ]
}

fn arm(mechanism: &ThreeArm) -> Vec<Line> {
    let joints = joints(mechanism);
    vec![
        Line::chain(LineRole::Bar, &joints[..3]),
        Line::chain(LineRole::Clamp, &joints[2..]),
    ]
}

/// The path of the tip in the machine's frame, the ground, the first arm while it picks and while it plants, the tray with its
/// seedlings.
fn surroundings(mechanism: &ThreeArm) -> Vec<Line> {
    let ground = mechanism.ground();
    let axis = mechanism.on_carrier(ThreeArmLink::Planet(0)).coords.norm();
    let reach = axis + mechanism.design().arm.tip_distance;
    let line = [-reach, reach].map(|x| Point::new(x, ground));
    let mut lines = vec![
        Line::trace(LineRole::Trace, 0),
        Line::chain(LineRole::Ground, &line),
    ];
    let working = [mechanism.picking(0), mechanism.planting(0)];
    lines.extend(working.map(|input| {
        let arm = mechanism.link(ThreeArmLink::Arm(0), input);
        let placed = joints(mechanism).map(|joint| arm.point(joint).position);
        Line::chain(LineRole::Pose, &placed)
    }));
    let tray = mechanism.tray_body();
    let still = [&tray.plate].into_iter().chain(&tray.stems);
    lines.extend(still.map(|outline| Line::contour(LineRole::Ground, &tray.placed(outline))));
    lines
}
