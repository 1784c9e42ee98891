use crate::page::{Curve, Link, Motion, Path, Picture, Role, short};
use centrode_geometry::{Bounds, Point, Tolerance};
use centrode_mechanism::gear::{Gear, GearPair, Member};
use std::f64::consts::TAU;

/// Samples of one driver turn for the curves of the cycle.
const SAMPLES: u32 = 360;

/// Fewest steps of one driver turn: half degrees.
const STEPS: f64 = 720.0;

/// The pair as a picture that moves; every line and pose is within the tolerance of the exact one.
#[must_use]
pub fn picture(pair: &GearPair, tolerance: Tolerance) -> Picture {
    let members = [Member::Driven, Member::Driver];
    let links = members.map(|member| drawn_gear(pair.gear(member), tolerance));
    let input = angles(pair, tolerance);
    let a = pair.center_distance();
    // Angles rounded to a hundredth of what the tolerance is seen under.
    let unit = 0.01 * tolerance.mm() / a;
    let poses = members.map(|member| {
        let pose = |&phi: &f64| {
            let (x, angle) = match member {
                Member::Driver => (0.0, -phi),
                Member::Driven => (a, pair.driven_angle(phi)),
            };
            [x, 0.0, short(angle, unit)]
        };
        input.iter().flat_map(pose).collect()
    });
    let round = |member: Member, x: f64| {
        let (_, reach) = pair.gear(member).radii();
        let corner = |s: f64| Point::new(x + s * reach, s * reach);
        let Bounds { min, max } = Bounds {
            min: corner(-1.0),
            max: corner(1.0),
        };
        (min, max)
    };
    let (driver, driven) = (round(Member::Driver, 0.0), round(Member::Driven, a));
    Picture {
        links: links.into(),
        motion: Motion {
            input_name: Member::Driver.name().into(),
            input: input.iter().map(|&phi| short(phi, unit)).collect(),
            poses: poses.into(),
        },
        handles: Vec::new(),
        marks: Vec::new(),
        extent: [
            driver.0.x.min(driven.0.x),
            driver.0.y.min(driven.0.y),
            driver.1.x.max(driven.1.x),
            driver.1.y.max(driven.1.y),
        ],
    }
}

/// Outline, bore and pitch curve of a gear, in its own frame.
pub(crate) fn drawn_gear(gear: &Gear, tolerance: Tolerance) -> Link {
    let mut paths = vec![Path::closed(Role::Body, gear.outline(), tolerance)];
    if let Some(bore) = gear.bore() {
        paths.push(Path::closed(Role::Hole, &bore, tolerance));
    }
    paths.push(Path::closed(Role::Pitch, gear.pitch_curve(), tolerance));
    Link {
        name: gear.member().name().into(),
        paths,
    }
}

/// What the pitch curves say along the cycle: law of motion, curvature, pressure angle.
#[must_use]
pub fn curves(pair: &GearPair) -> Vec<Curve> {
    let steps = SAMPLES * pair.mean_ratio().0;
    let input: Vec<f64> = (0..=steps)
        .map(|i| pair.cycle() * f64::from(i) / f64::from(steps))
        .collect();
    let points: Vec<_> = input.iter().map(|&phi| pair.pitch_point(phi)).collect();
    let curve = |chart, name, unit, value: Vec<f64>| Curve {
        chart,
        name,
        unit,
        count: false,
        input: input.clone(),
        value,
    };
    let law = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { input.iter().map(|&phi| f(phi)).collect() };
    let slope = f64::from(pair.mean_ratio().1) / f64::from(pair.mean_ratio().0);
    vec![
        curve("Ratio", "", "", law(&|phi| pair.ratio(phi))),
        curve(
            "Ratio slope",
            "",
            "1/rad",
            law(&|phi| pair.ratio_slope(phi)),
        ),
        curve(
            "Lead of the driven gear",
            "",
            "°",
            law(&|phi| (pair.driven_angle(phi) - slope * phi).to_degrees()),
        ),
        curve(
            "Pressure angle",
            "forward",
            "°",
            points
                .iter()
                .map(|p| p.pressure_angle.to_degrees())
                .collect(),
        ),
        curve(
            "Pressure angle",
            "reverse",
            "°",
            points
                .iter()
                .map(|p| p.reverse_pressure_angle.to_degrees())
                .collect(),
        ),
        curve(
            "Pitch curvature",
            "driver",
            "1/mm",
            points.iter().map(|p| p.driver_curvature).collect(),
        ),
        curve(
            "Pitch curvature",
            "driven",
            "1/mm",
            points.iter().map(|p| p.driven_curvature).collect(),
        ),
    ]
}

/// Driver angles of the poses: between them the driven angle is linear to within the tolerance at the centre distance.
fn angles(pair: &GearPair, tolerance: Tolerance) -> Vec<f64> {
    let least = STEPS * pair.cycle() / TAU;
    // A chord of the law over a step h is off by at most h² / 8 times the greatest slope.
    let slope = greatest_slope(pair);
    let angle = tolerance.mm() / pair.center_distance();
    let steps = (pair.cycle() * (slope / (8.0 * angle)).sqrt()).clamp(least, 1e6);
    let steps = steps.ceil() as u32;
    (0..=steps)
        .map(|i| pair.cycle() * f64::from(i) / f64::from(steps))
        .collect()
}

/// Greatest slope of the ratio, 1/rad, of 2880 over a turn.
fn greatest_slope(pair: &GearPair) -> f64 {
    (0..=2880)
        .map(|i| pair.ratio_slope(TAU * f64::from(i) / 2880.0).abs())
        .fold(0.0, f64::max)
}
