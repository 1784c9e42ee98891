use std::f64::consts::TAU;

use centrode_geometry::{Point, Tolerance};
use centrode_mechanism::gear::{Gear, GearPair, Member};
use centrode_mechanism::three_arm::{Link as Part, ThreeArm};
use nalgebra::Isometry2;

use crate::page::{Curve, Link, Mark, Motion, Path, Picture, Role, short};

/// Samples of one carrier turn.
const SAMPLES: u32 = 720;

/// Planted seedlings that are shown.
const SEEDLINGS: u32 = 4;

/// Corners of a pitch curve drawn in place of teeth.
const CORNERS: u32 = 240;

/// How the gears are drawn.
#[derive(Clone, Copy, Debug)]
pub enum Teeth<'a> {
    /// By their pitch curves alone: nothing is cut.
    Plain,
    /// With the teeth of sun and intermediate gear.
    Cut(&'a GearPair),
}

/// The mechanism as a picture that moves: gears, carrier, arms, the path of the tip, tray and seedlings.
///
/// Outlines are within the tolerance of the exact ones.
#[must_use]
pub fn picture(mechanism: &ThreeArm, teeth: Teeth<'_>, tolerance: Tolerance) -> Picture {
    let arms = mechanism.arms();
    let (sun, intermediate) = gears(mechanism, teeth, tolerance);
    let mut parts: Vec<(Part, String, Vec<Path>)> = vec![(Part::Sun, "sun".into(), sun.clone())];
    for k in 0..arms {
        let name = format!("intermediate gear {}", k + 1);
        parts.push((Part::Intermediate(k), name, intermediate.clone()));
    }
    for k in 0..arms {
        parts.push((Part::Planet(k), format!("planet {}", k + 1), sun.clone()));
    }
    parts.push((Part::Carrier, "carrier".into(), carrier(mechanism)));
    for k in 0..arms {
        parts.push((Part::Arm(k), format!("arm {}", k + 1), arm(mechanism)));
    }
    let input: Vec<f64> = inputs().collect();
    let (length, angle) = (0.1 * tolerance.mm(), 1e-6);
    let poses = |part: Part| -> Vec<f64> {
        let at = |&phi: &f64| {
            let link = mechanism.link(part, phi);
            let Point { coords } = link.origin.position;
            [
                short(coords.x, length),
                short(coords.y, length),
                short(link.angle.position, angle),
            ]
        };
        input.iter().flat_map(at).collect()
    };
    let mut links = vec![Link {
        name: "machine".into(),
        paths: machine(mechanism, tolerance),
    }];
    let mut motion = Motion {
        input_name: "carrier".into(),
        input: input.iter().map(|&phi| short(phi, 1e-7)).collect(),
        poses: vec![[0.0; 3].repeat(input.len())],
    };
    if let Some(stem) = mechanism.stem() {
        let stem = Path::closed(Role::Ground, &stem, tolerance);
        // The newest first: where an arm plants, each moves up by one.
        let mut planted = vec![Vec::with_capacity(3 * input.len()); SEEDLINGS as usize];
        for &phi in &input {
            let feet = mechanism.planted(phi, SEEDLINGS);
            for (poses, foot) in planted.iter_mut().zip(feet) {
                poses.extend([short(foot.x, length), short(foot.y, length), 0.0]);
            }
        }
        for (poses, before) in planted.into_iter().zip(1..) {
            motion.poses.push(poses);
            links.push(Link {
                name: format!("planted seedling {before}"),
                paths: vec![stem.clone()],
            });
        }
    }
    for (part, name, paths) in parts {
        motion.poses.push(poses(part));
        links.push(Link { name, paths });
    }
    Picture {
        links,
        motion,
        handles: Vec::new(),
        marks: marks(mechanism),
        extent: extent(mechanism),
    }
}

fn inputs() -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|i| TAU * f64::from(i) / f64::from(SAMPLES))
}

/// Paths of the sun, which are those of each planet, and of an intermediate gear.
fn gears(mechanism: &ThreeArm, teeth: Teeth<'_>, tolerance: Tolerance) -> (Vec<Path>, Vec<Path>) {
    let cut = |gear: &Gear| {
        let mut paths = vec![Path::closed(Role::Body, gear.outline(), tolerance)];
        if let Some(bore) = gear.bore() {
            paths.push(Path::closed(Role::Hole, &bore, tolerance));
        }
        paths.push(Path::closed(Role::Pitch, gear.pitch_curve(), tolerance));
        paths
    };
    let plain = |member: Member| {
        let rolling = mechanism.rolling();
        let length = rolling.pitch_length(member);
        let point = |i: u32| {
            let arc = length * f64::from(i) / f64::from(CORNERS);
            rolling.frame(member, rolling.parameter(arc)).point
        };
        let points: Vec<Point> = (0..CORNERS).map(point).collect();
        vec![
            Path::polygon(Role::Body, &points, tolerance),
            Path::polygon(Role::Pitch, &points, tolerance),
        ]
    };
    match teeth {
        Teeth::Plain => (plain(Member::Driver), plain(Member::Driven)),
        Teeth::Cut(pair) => (cut(pair.driver()), cut(pair.driven())),
    }
}

/// The legs from the sun's axis over each intermediate gear's to its planet's.
fn carrier(mechanism: &ThreeArm) -> Vec<Path> {
    let frame = mechanism.link(Part::Carrier, 0.0);
    let own = Isometry2::rotation(-frame.angle.position);
    let axis = |part: Part| own * mechanism.link(part, 0.0).origin.position;
    (0..mechanism.arms())
        .map(|k| {
            let joints = [
                Point::origin(),
                axis(Part::Intermediate(k)),
                axis(Part::Planet(k)),
            ];
            Path::open(Role::Bar, &joints)
        })
        .collect()
}

/// From the planet's axis to the pusher's, along it, and the clamp to the tip.
fn arm(mechanism: &ThreeArm) -> Vec<Path> {
    let spec = &mechanism.design().arm;
    let offset = -spec.pusher_offset;
    let reach = (spec.tip_distance.powi(2) - offset.powi(2)).max(0.0).sqrt();
    let [foot, clamp, tip] = [
        Point::new(0.0, offset),
        Point::new(reach - spec.clamp_length, offset),
        Point::new(reach, offset),
    ];
    vec![
        Path::open(Role::Bar, &[Point::origin(), foot, clamp]),
        Path::open(Role::Clamp, &[clamp, tip]),
    ]
}

/// What does not move: the path of the tip in the machine's frame, the ground, the tray with its seedlings.
fn machine(mechanism: &ThreeArm, tolerance: Tolerance) -> Vec<Path> {
    let tips: Vec<Point> = inputs()
        .take(SAMPLES as usize)
        .map(|phi| mechanism.tip(phi, 0).position)
        .collect();
    let [left, _, right, _] = extent(mechanism);
    let ground = mechanism.ground();
    let line = [Point::new(left, ground), Point::new(right, ground)];
    let mut paths = vec![
        Path::polygon(Role::Trace, &tips, tolerance),
        Path::open(Role::Ground, &line),
    ];
    let tray = mechanism.tray_body();
    let still = [&tray.plate].into_iter().chain(&tray.stems);
    paths.extend(still.map(|outline| Path::closed(Role::Ground, &tray.placed(outline), tolerance)));
    paths
}

/// Where an arm picks and where it plants.
fn marks(mechanism: &ThreeArm) -> Vec<Mark> {
    let mark = |name: &str, input: f64| {
        let Point { coords } = mechanism.tip(input, 0).position;
        Mark {
            name: name.into(),
            link: 0,
            at: [coords.x, coords.y],
        }
    };
    vec![
        mark("picking", mechanism.picking(0)),
        mark("planting", mechanism.planting(0)),
    ]
}

/// Round the path of the tip and the gearbox.
fn extent(mechanism: &ThreeArm) -> [f64; 4] {
    let reach = inputs()
        .map(|phi| mechanism.tip(phi, 0).position.coords.norm())
        .fold(mechanism.gearbox_radius(), f64::max);
    [-reach, -reach, reach, reach]
}

/// What the motion of the first arm is along a carrier turn, at the design's rate.
#[must_use]
pub fn curves(mechanism: &ThreeArm) -> Vec<Curve> {
    const SHOWN: u32 = 360;
    let input: Vec<f64> = (0..=SHOWN)
        .map(|i| TAU * f64::from(i) / f64::from(SHOWN))
        .collect();
    let speed = mechanism.carrier_speed();
    let curve = |chart, name, unit, f: &dyn Fn(f64) -> f64| Curve {
        chart,
        name,
        unit,
        value: input.iter().map(|&phi| f(phi)).collect(),
        input: input.clone(),
    };
    let tip = |phi: f64| mechanism.tip(phi, 0).at_speed(speed);
    let train = |phi: f64| mechanism.train().at(phi);
    vec![
        curve("Clamp above horizontal", "", "°", &|phi| {
            mechanism.clamp_elevation(phi, 0).to_degrees()
        }),
        curve("Height of the tip", "", "mm", &|phi| tip(phi).position.y),
        curve("Speed of the tip", "", "mm/s", &|phi| {
            tip(phi).velocity.norm()
        }),
        curve("Acceleration of the tip", "", "m/s²", &|phi| {
            1e-3 * tip(phi).acceleration.norm()
        }),
        curve("Turn a carrier turn", "intermediate gear", "", &|phi| {
            train(phi).intermediate.velocity
        }),
        curve("Turn a carrier turn", "planet", "", &|phi| {
            train(phi).planet.velocity
        }),
    ]
}
