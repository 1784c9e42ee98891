use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

use centrode_geometry::{Outline, Point, Tolerance, Vector, WRITTEN};
use centrode_groove::{ShaftSolid, SpiralShaft};
use centrode_kinematics::machine::{Constant, Line, LineRole, LinkedMachine, Quantity, Seat};
use centrode_kinematics::transmission::{FromFn, MotionJet, Transmission};

use super::links::MEMBERS;
use super::machine::{Gears, Parts};
use crate::{ExportError, gear_pair};

/// Tolerance of the drawn edges of the groove, relative to its width, and its minimum, relative to the shaft's radius: at this
/// minimum a turn has some 700 strips.
const DRAWN: f64 = 5e-3;
const FINEST: f64 = 1e-5;
/// A point of the development as drawn: the shaft lies along x.
fn drawn(point: Point) -> Point {
    Point::new(point.y, -point.x)
}

fn rectangle(low: Point, high: Point) -> Outline {
    let p = Point::new;
    Outline::polygon(&[low, p(high.x, low.y), high, p(low.x, high.y)])
}

fn still(at: f64) -> Quantity {
    Quantity::Law(Arc::new(Constant(at)))
}

/// Draws the developed groove with the slider in it, and the box: the shaft is along x, its unrolled surface along y.
pub(super) fn develop(
    parts: &Parts<'_>,
    turn: &Arc<dyn Transmission>,
    [boxed, swivelling]: [usize; 2],
    machine: &mut LinkedMachine,
) -> Result<(), ExportError> {
    let surface = machine.sketch("development", surface(parts)?);
    machine.draw("shaft", 0, surface);
    let rows = machine.sketch("box", rows(parts.shaft));
    let seat = [Quantity::joint(boxed), still(0.0), still(0.0)];
    machine.draw_at("box", Seat::Free(Box::new(seat)), [0.0; 3], rows);
    let radius = parts.shaft.groove().radius();
    let outline = parts.shaft.slider().outline(parts.shaft.groove().width());
    let slider = machine.sketch("slider", vec![Line::contour(LineRole::Body, &outline)]);
    // At a whole turn the slider jumps from one edge of the development to the other.
    let own = turn.clone();
    let round = move |input: f64| {
        let mut jet = own.at(input);
        jet.position -= TAU * (jet.position / TAU + WRITTEN).floor();
        MotionJet::default().plus(-radius, &jet)
    };
    let round = FromFn::new(
        TAU,
        0.0,
        vec![parts.input_at_turn(0.0).rem_euclid(TAU)],
        round,
    );
    let seat = [
        Quantity::joint(boxed),
        Quantity::Law(Arc::new(round)),
        Quantity::joint(swivelling),
    ];
    let at = [0.0, 0.0, -FRAC_PI_2];
    machine.draw_at("slider", Seat::Free(Box::new(seat)), at, slider);
    Ok(())
}

/// The development: its rim, the edges of the groove, the window in which a seedling is picked.
fn surface(parts: &Parts<'_>) -> Result<Vec<Line>, ExportError> {
    let shaft = parts.shaft;
    let groove = shaft.groove();
    let around = TAU * groove.radius();
    let [low, high] = ShaftSolid::new(groove, shaft.body())?.ends();
    let blank = rectangle(Point::new(low, -around), Point::new(high, 0.0));
    let mut lines = vec![Line::contour(LineRole::Body, &blank)];
    let seen = (DRAWN * groove.width()).max(FINEST * groove.radius());
    if let Ok(tolerance) = Tolerance::new(seen) {
        for edge in shaft.wall_edges(tolerance)? {
            let edge: Vec<Point> = edge.into_iter().map(drawn).collect();
            lines.push(Line::chain(LineRole::Trace, &edge));
        }
    }
    let design = shaft.design();
    lines.extend([-0.5, 0.5].map(|edge| {
        let turned = parts.turn(design.pick + edge * design.window).position;
        let y = -groove.radius() * turned.rem_euclid(TAU);
        Line::chain(LineRole::Window, &[Point::new(low, y), Point::new(high, y)])
    }));
    Ok(lines)
}

/// Lower left corner of the box as drawn.
pub(super) fn corner(shaft: &SpiralShaft) -> Point {
    let lead = shaft.law().lead();
    Point::new(-0.5 * lead * f64::from(shaft.traverse().holes()), lead)
}

/// The box with its holes, above the development.
fn rows(shaft: &SpiralShaft) -> Vec<Line> {
    let count = shaft.traverse().holes();
    let (lead, holes) = (shaft.law().lead(), f64::from(count));
    let (length, depth) = (lead * holes, 2.0 * lead);
    let low = corner(shaft);
    let rim = rectangle(low, low + Vector::new(length, depth));
    let mut lines = vec![Line::contour(LineRole::Body, &rim)];
    lines.extend((0..count).map(|i| {
        let center = low + Vector::new((f64::from(i) + 0.5) * lead, 0.5 * depth);
        let half = Vector::repeat(0.4 * lead);
        Line::contour(LineRole::Hole, &rectangle(center - half, center + half))
    }));
    lines
}

/// Draws the gears next to the near end of the shaft, seen along it, the driver below; `joints` turn them.
pub(super) fn gears(
    gears: &Gears<'_>,
    shaft: &SpiralShaft,
    end: f64,
    joints: [usize; 2],
    machine: &mut LinkedMachine,
) {
    let reach = MEMBERS.map(|member| gears.pair.gear(member).radii().1);
    let x = end - 0.5 * shaft.law().lead() - reach[0].max(reach[1]);
    let y = -0.5 * TAU * shaft.groove().radius();
    let below = [gears.pair.center_distance(), 0.0];
    let rest = [0.0, gears.rest()];
    for (i, member) in MEMBERS.into_iter().enumerate() {
        let gear = gear_pair::lines(gears.pair.gear(member));
        let sketch = machine.sketch(member.name(), gear);
        let seat = [still(x), still(y - below[i]), Quantity::joint(joints[i])];
        let at = [0.0, 0.0, FRAC_PI_2 + rest[i]];
        machine.draw_at(member.name(), Seat::Free(Box::new(seat)), at, sketch);
    }
}
