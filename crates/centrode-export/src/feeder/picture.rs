use std::f64::consts::{PI, TAU};

use centrode_geometry::{Bounds, Outline, Point, Tolerance, Vector};
use centrode_mechanism::feeder::{Feeder, Part, Plate};
use centrode_mechanism::gear::{Gear, IncompletePair};
use centrode_mechanism::linkage::SixBar;

use crate::page::{Curve, Link, Mark, Motion, Path, Picture, Role, short};

/// Samples of one cycle.
const SAMPLES: u32 = 720;
/// Points of the curve on which the effector's pivot may lie.
const PIVOTS: usize = 240;

fn inputs() -> impl Iterator<Item = f64> {
    (0..=SAMPLES).map(|i| TAU * f64::from(i) / f64::from(SAMPLES))
}

/// How the incomplete gears are drawn.
#[derive(Clone, Copy, Debug)]
pub enum Teeth<'a> {
    /// By their pitch circles alone: nothing is cut.
    Plain,
    /// With their teeth and locking arcs, cams and pins as lines.
    Cut(&'a IncompletePair),
}

/// The six-bar as a picture that moves, with the path of the tip and with all places of the effector's pivot that would
/// give the swing asked for: a chord for half a turn, see [`SixBar::pivots`]. Behind it the incomplete gears that turn its
/// crank, the driver to the left. Links that make no plate are left out.
#[must_use]
pub fn picture(feeder: &Feeder, teeth: Teeth<'_>, tolerance: Tolerance) -> Picture {
    let input: Vec<f64> = inputs().collect();
    let mut links = Vec::new();
    let mut motion = Motion {
        input_name: "incomplete gear".into(),
        input: input.iter().map(|&phi| short(phi, 1e-7)).collect(),
        poses: Vec::new(),
    };
    let (length, angle) = (0.1 * tolerance.mm(), 1e-6);
    let gears = gears(feeder, teeth, tolerance);
    let center_distance = center_distance(feeder);
    for (name, paths) in ["driver", "driven gear"].into_iter().zip(gears) {
        let name = name.into();
        links.push(Link { name, paths });
    }
    let poses = |pose: &dyn Fn(f64) -> [f64; 3]| -> Vec<f64> {
        let rounded = |&phi: &f64| {
            let [x, y, turned] = pose(phi);
            [short(x, length), short(y, length), short(turned, angle)]
        };
        input.iter().flat_map(rounded).collect()
    };
    motion
        .poses
        .push(poses(&|phi| [-center_distance, 0.0, -phi]));
    motion.poses.push(poses(&|phi| {
        [0.0, 0.0, feeder.crank(phi).position - feeder.start()]
    }));
    let before = links.len();
    let plates: Vec<Plate> = Part::ALL
        .into_iter()
        .filter_map(|part| feeder.plate(part).ok())
        .collect();
    for plate in &plates {
        let mut paths = vec![Path::closed(Role::Body, &plate.outline, tolerance)];
        let holes = plate.cut_outs();
        paths.extend(holes.iter().map(|h| Path::closed(Role::Hole, h, tolerance)));
        if plate.part == Part::Frame {
            let tip = feeder.path(2, SAMPLES);
            paths.push(Path::open(Role::Trace, &tip));
            let bar = feeder.six_bar().four_bar();
            let pivots = SixBar::pivots(bar, feeder.design().goals.swing, PIVOTS);
            paths.push(Path::open(Role::Locus, &pivots));
        }
        links.push(Link {
            name: plate.part.name().into(),
            paths,
        });
        // Unwrapped along the cycle: between samples a pose is interpolated.
        let mut before: Option<f64> = None;
        let mut poses = Vec::with_capacity(3 * input.len());
        for &phi in &input {
            let place = feeder.place(plate.part, feeder.crank(phi).position);
            let mut turned = place.rotation.angle();
            if let Some(before) = before {
                turned = before + (turned - before + PI).rem_euclid(TAU) - PI;
            }
            before = Some(turned);
            let at = place.translation.vector;
            poses.extend([
                short(at.x, length),
                short(at.y, length),
                short(turned, angle),
            ]);
        }
        motion.poses.push(poses);
    }
    let index = |part: Part| before + plates.iter().position(|p| p.part == part).unwrap_or(0);
    let marks = plates
        .iter()
        .flat_map(|plate| plate.joints.iter().map(move |joint| (plate.part, joint)))
        .filter(|(part, joint)| match part {
            Part::Frame => true,
            Part::Crank => joint.name == "B",
            Part::Effector => joint.name == "E",
            Part::Slider => joint.name == "C",
            Part::Coupler | Part::Rocker => false,
        })
        .map(|(part, joint)| Mark {
            name: joint.name.into(),
            link: index(part),
            at: joint.at.coords.into(),
        });
    Picture {
        marks: marks.collect(),
        links,
        motion,
        handles: Vec::new(),
        extent: extent(feeder),
    }
}

/// Distance between the shafts of the incomplete gears, mm.
fn center_distance(feeder: &Feeder) -> f64 {
    let gears = &feeder.design().gears;
    0.5 * gears.module * f64::from(gears.driver_pitches + gears.driven_pitches)
}

/// Driver and driven gear, each in its own axes.
fn gears(feeder: &Feeder, teeth: Teeth<'_>, tolerance: Tolerance) -> [Vec<Path>; 2] {
    let pair = match teeth {
        Teeth::Cut(pair) => pair,
        Teeth::Plain => {
            let gears = &feeder.design().gears;
            return [gears.driver_pitches, gears.driven_pitches].map(|pitches| {
                let radius = 0.5 * gears.module * f64::from(pitches);
                let circle = Outline::circle(Point::origin(), radius);
                [Role::Body, Role::Pitch]
                    .map(|role| Path::closed(role, &circle, tolerance))
                    .into()
            });
        }
    };
    let gear = |outline: &Outline, gear: &Gear| {
        let mut paths = vec![Path::closed(Role::Body, outline, tolerance)];
        paths.extend(
            gear.bore()
                .map(|bore| Path::closed(Role::Hole, &bore, tolerance)),
        );
        paths.push(Path::closed(Role::Pitch, gear.pitch_curve(), tolerance));
        paths
    };
    let mut both = [
        gear(pair.driver(), pair.pair().driver()),
        gear(pair.driven(), pair.pair().driven()),
    ];
    for cam in pair.cams() {
        both[0].push(Path::closed(Role::Beside, &cam.outline, tolerance));
        let pins = cam.pins.iter();
        let pins = pins.map(|&at| Outline::circle(at, cam.pin_radius));
        both[1].extend(pins.map(|pin| Path::closed(Role::Beside, &pin, tolerance)));
    }
    both
}

/// A rectangle around the paths of all joints, the plates about them, and the gears.
fn extent(feeder: &Feeder) -> [f64; 4] {
    let frame = feeder.six_bar().four_bar().lengths()[3];
    let fixed = [
        Point::origin(),
        Point::new(frame, 0.0),
        feeder.six_bar().pivot(),
    ];
    let paths = (0..3).flat_map(|joint| feeder.path(joint, SAMPLES));
    let bounds = paths.chain(fixed).fold(Bounds::EMPTY, |b, p| b.with(p));
    let margin = Vector::repeat(0.5 * feeder.design().plates.width);
    let mut all = Bounds {
        min: bounds.min - margin,
        max: bounds.max + margin,
    };
    let gears = &feeder.design().gears;
    let axes = [-center_distance(feeder), 0.0].map(|x| Point::new(x, 0.0));
    for (axis, pitches) in axes
        .into_iter()
        .zip([gears.driver_pitches, gears.driven_pitches])
    {
        // Pitch radius and a tooth's height.
        let reach = Vector::repeat(gears.module * (0.5 * f64::from(pitches) + 1.0));
        all = all.with(axis - reach).with(axis + reach);
    }
    [all.min.x, all.min.y, all.max.x, all.max.y]
}

/// Angle of the effector, speed and acceleration of its tip, turn of the crank, angle between coupler and rocker along the cycle.
#[must_use]
pub fn curves(feeder: &Feeder) -> Vec<Curve> {
    let (speed, reach) = (feeder.speed(), feeder.six_bar().effector_length());
    let bar = *feeder.six_bar().four_bar();
    let input: Vec<f64> = inputs().collect();
    let curve = |chart, unit, f: &dyn Fn(f64) -> f64| Curve {
        chart,
        name: "",
        unit,
        count: false,
        input: input.clone(),
        value: input.iter().map(|&phi| f(phi)).collect(),
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
