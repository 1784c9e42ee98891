use centrode_geometry::{Point, Tolerance};
use centrode_mechanism::gear::{Gear, GearPair, Member};
use centrode_mechanism::three_arm::{Chain, Link as Part, LinkMotion, PointMotion, ThreeArm};
use nalgebra::Isometry2;

use super::turn::Turn;
use crate::page::{Curve, Link, Mark, Motion, Path, Picture, Role, short};

/// Fewest samples of one carrier turn.
const SAMPLES: u32 = 720;

/// The same for the curves.
const SHOWN: u32 = 360;

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
    let (sun, intermediate) = gears(mechanism, teeth, tolerance);
    let turn = Turn::of(mechanism, SAMPLES);
    let extent = extent(mechanism, &turn);
    let (length, angle) = (0.1 * tolerance.mm(), 1e-6);
    let pose = |link: &LinkMotion| {
        let Point { coords } = link.origin.position;
        [
            short(coords.x, length),
            short(coords.y, length),
            short(link.angle.position, angle),
        ]
    };
    let still = |part: Part| pose(&mechanism.link(part, 0.0)).to_vec();
    let carrier_at = |&phi: &f64| pose(&mechanism.link(Part::Carrier, phi));
    let chains: Vec<[Vec<f64>; 3]> = (0..mechanism.arms())
        .map(|k| {
            let mut chain = [const { Vec::new() }; 3];
            for links in turn.links(k) {
                for (poses, link) in chain.iter_mut().zip(&links) {
                    poses.extend(pose(link));
                }
            }
            chain
        })
        .collect();
    let [mut intermediates, mut planets, mut limbs] = [const { Vec::new() }; 3];
    for (k, [gear, planet, limb]) in (1..).zip(chains) {
        let named = |name: &str| format!("{name} {k}");
        intermediates.push((named("intermediate gear"), intermediate.clone(), gear));
        planets.push((named("planet"), sun.clone(), planet));
        limbs.push((named("arm"), arm(mechanism), limb));
    }
    let ground = |phi: &f64| [short(travel(mechanism, *phi), length), 0.0, 0.0];
    let mut parts = vec![
        (
            "machine".to_owned(),
            machine(mechanism, &turn, extent, tolerance),
            vec![0.0; 3],
        ),
        (
            "ground".to_owned(),
            over_ground(mechanism, &turn, tolerance),
            turn.inputs().iter().flat_map(ground).collect(),
        ),
    ];
    parts.extend(planted(mechanism, &turn, tolerance));
    parts.push(("sun".to_owned(), sun, still(Part::Sun)));
    parts.extend(intermediates);
    parts.extend(planets);
    parts.push((
        "carrier".to_owned(),
        carrier(mechanism),
        turn.inputs().iter().flat_map(carrier_at).collect(),
    ));
    parts.extend(limbs);
    let mut links = Vec::new();
    let mut motion = Motion {
        input_name: "carrier".into(),
        input: turn.inputs().iter().map(|&phi| short(phi, 1e-7)).collect(),
        poses: Vec::new(),
    };
    for (name, paths, poses) in parts {
        links.push(Link { name, paths });
        motion.poses.push(poses);
    }
    Picture {
        links,
        motion,
        handles: Vec::new(),
        marks: marks(mechanism),
        extent,
    }
}

/// The seedlings planted last, each with its pose at every input.
fn planted(
    mechanism: &ThreeArm,
    turn: &Turn<'_>,
    tolerance: Tolerance,
) -> Vec<(String, Vec<Path>, Vec<f64>)> {
    let Some(stem) = mechanism.stem() else {
        return Vec::new();
    };
    let stem = Path::closed(Role::Ground, &stem, tolerance);
    let unit = 0.1 * tolerance.mm();
    let mut all: Vec<_> = (1..=SEEDLINGS)
        .map(|before| {
            let name = format!("planted seedling {before}");
            (name, vec![stem.clone()], Vec::new())
        })
        .collect();
    // The newest first: where an arm plants, each moves up by one.
    for &phi in turn.inputs() {
        let feet = mechanism.planted(phi, SEEDLINGS);
        for ((_, _, poses), foot) in all.iter_mut().zip(feet) {
            poses.extend([short(foot.x, unit), short(foot.y, unit), 0.0]);
        }
    }
    all
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

/// From the planet's axis to the pusher's, along it, and the clamp to the tip: ends in the arm's frame.
fn joints(mechanism: &ThreeArm) -> [Point; 4] {
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

fn arm(mechanism: &ThreeArm) -> Vec<Path> {
    let joints = joints(mechanism);
    vec![
        Path::open(Role::Bar, &joints[..3]),
        Path::open(Role::Clamp, &joints[2..]),
    ]
}

/// The first arm as it picks and as it plants, in the machine's frame.
fn working_poses(mechanism: &ThreeArm) -> [Path; 2] {
    [mechanism.picking(0), mechanism.planting(0)].map(|input| {
        let arm = mechanism.link(Part::Arm(0), input);
        let placed = joints(mechanism).map(|joint| arm.point(joint).position);
        Path::open(Role::Pose, &placed)
    })
}

/// What does not move: the path of the tip in the machine's frame, the ground, the tray with its seedlings.
fn machine(
    mechanism: &ThreeArm,
    turn: &Turn<'_>,
    [left, _, right, _]: [f64; 4],
    tolerance: Tolerance,
) -> Vec<Path> {
    let mut tips: Vec<Point> = turn.tips().collect();
    // It ends where it begins.
    tips.pop();
    let ground = mechanism.ground();
    let line = [Point::new(left, ground), Point::new(right, ground)];
    let mut paths = vec![
        Path::polygon(Role::Trace, &tips, tolerance),
        Path::open(Role::Ground, &line),
    ];
    paths.extend(working_poses(mechanism));
    let tray = mechanism.tray_body();
    let still = [&tray.plate].into_iter().chain(&tray.stems);
    paths.extend(still.map(|outline| Path::closed(Role::Ground, &tray.placed(outline), tolerance)));
    paths
}

/// How far what is left on the ground has gone in the machine's frame at a carrier turn, mm along x.
fn travel(mechanism: &ThreeArm, phi: f64) -> f64 {
    -mechanism
        .over_ground(&PointMotion::at_rest(), phi)
        .position
        .x
}

/// The way of the first arm's tip over the ground during one carrier turn.
fn over_ground(mechanism: &ThreeArm, turn: &Turn<'_>, tolerance: Tolerance) -> Vec<Path> {
    let unit = 0.1 * tolerance.mm();
    let place = |(&phi, tip): (&f64, Point)| {
        Point::new(
            short(tip.x - travel(mechanism, phi), unit),
            short(tip.y, unit),
        )
    };
    let places: Vec<Point> = turn.inputs().iter().zip(turn.tips()).map(place).collect();
    vec![Path::open(Role::OverGround, &places)]
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
fn extent(mechanism: &ThreeArm, turn: &Turn<'_>) -> [f64; 4] {
    let reach = turn
        .tips()
        .map(|tip| tip.coords.norm())
        .fold(mechanism.gearbox_radius(), f64::max);
    [-reach, -reach, reach, reach]
}

/// What the motion of the first arm is along a carrier turn, at the design's rate.
#[must_use]
pub fn curves(mechanism: &ThreeArm) -> Vec<Curve> {
    let turn = Turn::of(mechanism, SHOWN);
    let speed = mechanism.carrier_speed();
    let curve = |chart, name, unit, f: &dyn Fn(&Chain<'_>) -> f64| Curve {
        chart,
        name,
        unit,
        count: false,
        value: turn.chains().iter().map(f).collect(),
        input: turn.inputs().to_vec(),
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

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use centrode_mechanism::design::DesignSpec as _;
    use centrode_mechanism::three_arm::design::ThreeArmDesign;

    #[test]
    fn arms_that_work_have_their_tips_at_the_marks() {
        let design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
        let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
        for (pose, mark) in working_poses(&mechanism).iter().zip(marks(&mechanism)) {
            let tip = Point::new(pose.vertices[9], pose.vertices[10]);
            assert!((tip - Point::from(mark.at)).norm() < 1e-9, "{}", mark.name);
        }
    }

    #[test]
    fn the_path_left_on_the_ground_goes_through_the_tip_at_every_input() {
        let design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
        let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
        let tolerance = Tolerance::new(1e-3).expect("positive");
        let picture = picture(&mechanism, Teeth::Plain, tolerance);
        let link = picture.links.iter().position(|l| l.name == "ground");
        let link = link.expect("drawn");
        let way = &picture.links[link].paths[0].vertices;
        let poses = &picture.motion.poses[link];
        for (i, &phi) in picture.motion.input.iter().enumerate() {
            let tip = mechanism.tip(phi, 0).position;
            let at = Point::new(way[3 * i] + poses[3 * i], way[3 * i + 1] + poses[3 * i + 1]);
            assert!((at - tip).norm() < 1e-3, "{at} is not {tip} at {phi}");
        }
        // One arm plants once a turn, and the machine has gone on by all seedlings of that turn.
        let gone = poses[0] - poses[poses.len() - 3];
        assert!(
            (gone.abs() - TAU * mechanism.advance()).abs() < 1e-3,
            "{gone}"
        );
    }
}
