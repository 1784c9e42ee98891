use super::machine::{Gears, Machine};
use crate::ExportError;
use crate::gear_pair::drawn_gear;
use crate::page::{Curve, Link, Motion, Path, Picture, Role, short};
use centrode_geometry::{Bounds, Outline, Point, Tolerance};
use centrode_mechanism::gear::Member;
use centrode_mechanism::shaft::{MovingBox, ShaftSolid, SpiralShaft};
use std::f64::consts::{PI, TAU};

/// Step of the moving picture and of the curves, rad.
const STEP: f64 = PI / 30.0;

/// Turn of the line between the gears' axes from the x axis, rad.
const UPRIGHT: f64 = 0.5 * PI;

/// How long a jump from one edge of the development to the other lasts, rad.
const JUMP: f64 = 1e-6;

/// The developed groove with its slider running in it, and the box that goes with it: along x the shaft, along y its
/// turned surface.
///
/// # Errors
/// [`ExportError`] where body and groove make no solid.
pub fn shaft_picture(shaft: &SpiralShaft, tolerance: Tolerance) -> Result<Picture, ExportError> {
    picture(&Machine::of_shaft(shaft), tolerance)
}

/// The same of a moving box, by its own input.
///
/// # Errors
/// [`ExportError`] where body and groove make no solid, or the elliptic gears no pair.
pub fn box_picture(machine: &MovingBox, tolerance: Tolerance) -> Result<Picture, ExportError> {
    picture(&Machine::of_box(machine)?, tolerance)
}

/// Position, speed, acceleration, lead angle and forces over the cycle.
#[must_use]
pub fn shaft_curves(shaft: &SpiralShaft) -> Vec<Curve> {
    curves(&Machine::of_shaft(shaft))
}

/// The same of a moving box, by its own input.
///
/// # Errors
/// [`ExportError`] where the elliptic gears make no pair.
pub fn box_curves(machine: &MovingBox) -> Result<Vec<Curve>, ExportError> {
    Ok(curves(&Machine::of_box(machine)?))
}

/// A point of the development as drawn: the shaft lies along x.
fn drawn(point: Point) -> Point {
    Point::new(point.y, -point.x)
}

fn rectangle(low: Point, high: Point) -> Outline {
    let p = Point::new;
    Outline::polygon(&[low, p(high.x, low.y), high, p(low.x, high.y)])
}

fn picture(machine: &Machine<'_>, tolerance: Tolerance) -> Result<Picture, ExportError> {
    let shaft = machine.shaft;
    let groove = shaft.groove();
    let around = TAU * groove.radius();
    let [low, high] = ShaftSolid::new(groove, shaft.body())?.ends();
    let blank = rectangle(Point::new(low, -around), Point::new(high, 0.0));
    let mut surface = vec![Path::closed(Role::Body, &blank, tolerance)];
    for edge in shaft.wall_edges(tolerance)? {
        let edge: Vec<Point> = edge.into_iter().map(drawn).collect();
        surface.push(Path::open(Role::Trace, &edge));
    }
    let design = shaft.design();
    for edge in [-0.5, 0.5] {
        let turned = machine.turn(design.pick + edge * design.window).position;
        let y = -groove.radius() * turned.rem_euclid(TAU);
        let ends = [Point::new(low, y), Point::new(high, y)];
        surface.push(Path::open(Role::Window, &ends));
    }
    let slider = shaft.slider().outline(groove.width());
    let traverse = shaft.traverse();
    let (lead, holes) = (shaft.law().lead(), f64::from(traverse.holes()));
    // The box in its rows of holes, above the development.
    let (length, depth) = (lead * holes, 2.0 * lead);
    let rim = rectangle(
        Point::new(-0.5 * length, lead),
        Point::new(0.5 * length, lead + depth),
    );
    let mut rows = vec![Path::closed(Role::Body, &rim, tolerance)];
    for i in 0..traverse.holes() {
        let center = Point::new(
            (f64::from(i) + 0.5) * lead - 0.5 * length,
            lead + 0.5 * depth,
        );
        let hole = rectangle(
            center - nalgebra::Vector2::repeat(0.4 * lead),
            center + nalgebra::Vector2::repeat(0.4 * lead),
        );
        rows.push(Path::closed(Role::Hole, &hole, tolerance));
    }
    let mut links = vec![
        ("shaft", surface),
        ("box", rows),
        ("slider", vec![Path::closed(Role::Body, &slider, tolerance)]),
    ];
    let axes = machine.gears.as_ref().map(|gears| {
        let members = [Member::Driver, Member::Driven];
        links.extend(members.map(|member| {
            let link = drawn_gear(gears.pair.gear(member), tolerance);
            (member.name(), link.paths)
        }));
        gear_axes(gears, Point::new(low, -0.5 * around), 0.5 * lead)
    });
    let mut motion = Motion {
        input_name: if machine.gears.is_some() {
            "driver"
        } else {
            "shaft"
        }
        .into(),
        input: Vec::new(),
        poses: vec![Vec::new(); links.len()],
    };
    let unit = 0.1 * tolerance.mm();
    let mut bounds = Bounds {
        min: Point::new(low, -around),
        max: Point::new(high, lead + depth),
    };
    if let (Some(axes), Some(gears)) = (axes, &machine.gears) {
        for (axis, member) in axes.into_iter().zip([Member::Driver, Member::Driven]) {
            let (_, reach) = gears.pair.gear(member).radii();
            let corner = nalgebra::Vector2::repeat(reach);
            bounds = bounds.with(axis - corner).with(axis + corner);
        }
    }
    let mut before: Option<f64> = None;
    for input in groove.steps(STEP) {
        let turned = machine.turn(input).position;
        let lap = (turned / TAU + 1e-12).floor();
        let jumps = before.is_some_and(|before| before < lap);
        before = Some(lap);
        // At a whole turn the slider leaves one edge of the development for the other.
        let places = if jumps {
            vec![(input - JUMP, lap - 1.0), (input, lap)]
        } else {
            vec![(input, lap)]
        };
        for (input, lap) in places {
            let (turn, stroke) = (machine.turn(input), machine.motion(input));
            let slope = stroke.velocity / turn.velocity;
            let at = drawn(Point::new(
                groove.radius() * (turn.position - TAU * lap),
                stroke.position,
            ));
            motion.input.push(short(input, 1e-7));
            let mut poses = vec![
                [0.0; 3],
                [at.x, 0.0, 0.0],
                [at.x, at.y, (-groove.radius()).atan2(slope)],
            ];
            if let (Some(axes), Some(gears)) = (axes, &machine.gears) {
                let turns = axes.into_iter().zip(gears.turns(input));
                poses.extend(turns.map(|(axis, turn)| [axis.x, axis.y, UPRIGHT + turn]));
            }
            for (all, [x, y, angle]) in motion.poses.iter_mut().zip(poses) {
                all.extend([short(x, unit), short(y, unit), short(angle, 1e-6)]);
            }
            bounds = bounds.with(Point::new(at.x - 0.5 * length, lead));
            bounds = bounds.with(Point::new(at.x + 0.5 * length, lead));
        }
    }
    Ok(Picture {
        links: links
            .into_iter()
            .map(|(name, paths)| Link {
                name: name.into(),
                paths,
            })
            .collect(),
        motion,
        handles: Vec::new(),
        marks: Vec::new(),
        extent: [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y],
    })
}

/// Where the gears are drawn, driver and driven: beside the end of the shaft at `end`, seen along the shaft, the driver
/// below.
fn gear_axes(gears: &Gears<'_>, end: Point, room: f64) -> [Point; 2] {
    let reach = [Member::Driver, Member::Driven].map(|member| gears.pair.gear(member).radii().1);
    let x = end.x - room - reach[0].max(reach[1]);
    let center_distance = gears.pair.center_distance();
    [Point::new(x, end.y - center_distance), Point::new(x, end.y)]
}

fn curves(machine: &Machine<'_>) -> Vec<Curve> {
    let input = machine.shaft.groove().steps(STEP);
    let omega = machine.shaft.load().speed();
    let curve = |chart, unit, f: &dyn Fn(f64) -> f64| Curve {
        chart,
        name: "",
        unit,
        count: false,
        value: input.iter().map(|&t| f(t)).collect(),
        input: input.clone(),
    };
    vec![
        curve("Position of the box", "mm", &|t| machine.motion(t).position),
        curve("Speed of the box", "mm/s", &|t| {
            omega * machine.motion(t).velocity
        }),
        curve("Acceleration of the box", "m/s²", &|t| {
            1e-3 * omega * omega * machine.motion(t).acceleration
        }),
        curve("Lead angle", "°", &|t| {
            machine.swivel(t).position.to_degrees()
        }),
        curve("Force on the groove's wall", "N", &|t| {
            machine.force(t).normal
        }),
        curve("Torque of the shaft", "N·m", &|t| {
            1e-3 * machine.force(t).torque
        }),
    ]
}
