//! How closely a machine made from its path meets the further wishes.

use std::f64::consts::{PI, TAU};

use crate::reverse::{KeepOut, RequiredTurn, ReversedMachine, TwoBar, Wishes};
use centrode_geometry::{Outline, Point, SampledPiece, maximum_of_samples, rounding};

use centrode_analysis::{Goal, Unit};

/// Poses of the arm per turn at which its distance from a shape is sampled, before the minimum is refined.
const SAMPLES: usize = 192;
/// Miss at which a goal has half its progress: for a length as a share of the reach of the machine, for a ratio this value
/// itself.
const SCALE: f64 = 0.1;
/// Names of goals that are distances from shapes.
const KEEP_OUT: &str = "keep-out-";
/// Margin of distances from shapes, mm: with a tenth of it the check of the bodies may still find a collision.
const SPARE: f64 = 5e-3;
/// Miss at which a goal of an angle has half its progress, rad.
const TURN: f64 = 0.2;

/// Wishes as goals, with the values that carrier and arm reach. The path runs through `points` points at equal steps of its
/// parameter; the machine has a bend, rad.
#[must_use]
pub fn reached(wishes: &Wishes, chain: &TwoBar, bend: f64, points: usize) -> Vec<Goal> {
    goals(wishes, chain, bend, points).0
}

/// Goals of a machine with its points along the path at equal steps of the parameter; and the direction of its clamp minus that
/// of its arm, rad, if directions are required.
pub(super) fn goals(
    wishes: &Wishes,
    chain: &TwoBar,
    bend: f64,
    points: usize,
) -> (Vec<Goal>, Option<f64>) {
    let leg = chain.center_distance(bend);
    let size = SCALE * (chain.carrier() + chain.arm());
    let [minimum, maximum] = chain.ratios().map(|ratio| ratio.value);
    let figures = [
        (
            "carrier",
            "length of the carrier",
            [chain.carrier(); 2],
            wishes.carrier,
            Unit::Millimetre,
            size,
        ),
        (
            "arm",
            "length of the arm",
            [chain.arm(); 2],
            wishes.arm,
            Unit::Millimetre,
            size,
        ),
        (
            "center-distance",
            "centre distance of the gears",
            [leg; 2],
            wishes.center_distance,
            Unit::Millimetre,
            size,
        ),
        (
            "ratio",
            "ratio",
            [minimum, maximum],
            wishes.ratio,
            Unit::Number,
            SCALE,
        ),
    ];
    let mut goals = Vec::new();
    let mut add = |name: String, title: String, value: f64, required, unit, scale| {
        let goal = Goal::new(goals.len() as u32 + 1, name, title, unit);
        goals.push(goal.range(required, scale).with(value));
    };
    for (name, title, [minimum, maximum], required, unit, scale) in figures {
        let words = |end: &str| match minimum == maximum {
            true => title.to_owned(),
            false => format!("{end} {title}"),
        };
        if let Some(end) = required.minimum {
            add(
                format!("{name}-minimum"),
                words("minimum"),
                minimum,
                [Some(end), None],
                unit,
                scale,
            );
        }
        if let Some(end) = required.maximum {
            add(
                format!("{name}-maximum"),
                words("maximum"),
                maximum,
                [None, Some(end)],
                unit,
                scale,
            );
        }
    }
    let step = chain.path().period() / points as f64;
    let at = |number: usize| chain.at(step * (number - 1) as f64);
    if let Some(turn) = wishes.turn {
        let RequiredTurn {
            from,
            to,
            between: [minimum, most],
        } = turn;
        let turned = at(to).carrier[0] - at(from).carrier[0];
        let turned = (turned * chain.direction().sign()).rem_euclid(TAU);
        let title = format!("turn of the carrier from point {from} to point {to}");
        add(
            "turn".into(),
            title,
            turned,
            [Some(minimum), Some(most)],
            Unit::Angle,
            TURN,
        );
    }
    let arm = |number: usize| {
        let jet = at(number);
        jet.carrier[0] + jet.elbow[0]
    };
    let off: Vec<f64> = wishes
        .directions
        .iter()
        .map(|required| required.direction - arm(required.point))
        .collect();
    let tolerances: Vec<f64> = wishes
        .directions
        .iter()
        .map(|required| required.tolerance)
        .collect();
    let clamp = wishes.clamp.or_else(|| middle(&off, &tolerances));
    for ((required, off), clamp) in wishes.directions.iter().zip(&off).zip(clamp.iter().cycle()) {
        let (point, tolerance) = (required.point, required.tolerance);
        let title = format!("clamp direction error at point {point}");
        let ends = [Some(-tolerance), Some(tolerance)];
        add(
            format!("direction-{point}"),
            title,
            wrapped(clamp - off),
            ends,
            Unit::Angle,
            TURN,
        );
    }
    for (name, shape) in &wishes.keep_out {
        let required = [Some(shape.clearance), None];
        let gap = Room::new(shape).clearance(chain, bend);
        let title = format!("distance of the arm from {name}");
        add(
            format!("{KEEP_OUT}{name}"),
            title,
            gap,
            required,
            Unit::Millimetre,
            size,
        );
    }
    (
        goals,
        (!wishes.directions.is_empty()).then_some(clamp).flatten(),
    )
}

/// Violations of goals, each by its own scale. Distances get a margin, because the check of the bodies is less exact.
pub(super) fn violations(goals: &[Goal]) -> Vec<f64> {
    let violation = |goal: &Goal| {
        let is_distance = goal.name.starts_with(KEEP_OUT);
        let spare = if is_distance { SPARE } else { 0.0 };
        (spare - goal.margin.unwrap_or(0.0)) / goal.scale
    };
    goals.iter().map(violation).collect()
}

/// An angle within half a turn in either direction.
fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// Angle from which the maximum deviation of several angles, as a share of their tolerances, is smallest; each angle is taken
/// within half a turn of the first.
fn middle(angles: &[f64], tolerances: &[f64]) -> Option<f64> {
    let first = *angles.first()?;
    let from_first: Vec<f64> = angles.iter().map(|angle| wrapped(angle - first)).collect();
    let all = || from_first.iter().zip(tolerances);
    // Two angles need this share of their tolerances to overlap; all angles need the maximum of these shares.
    let shares = all().flat_map(|(a, s)| all().map(move |(b, t)| (a - b) / (s + t)));
    let share = shares.fold(0.0, f64::max);
    let low = all()
        .map(|(a, t)| a - share * t)
        .fold(f64::NEG_INFINITY, f64::max);
    let high = all()
        .map(|(a, t)| a + share * t)
        .fold(f64::INFINITY, f64::min);
    Some(wrapped(first + 0.5 * (low + high)))
}

/// A shape that the arm must not enter.
enum Room {
    /// Sides of a polygon in order.
    Polygon(Vec<[Point; 2]>, Outline),
    Circle(Point, f64),
    Below(f64),
}

impl Room {
    fn new(shape: &KeepOut) -> Self {
        match (shape.below, shape.center, shape.radius) {
            (Some(below), ..) => Self::Below(below),
            (None, Some(center), Some(radius)) => Self::Circle(center.into(), radius),
            _ => {
                let corners: Vec<Point> = shape.corners.iter().map(|c| Point::from(*c)).collect();
                let next = corners.iter().cycle().skip(1);
                let sides = corners.iter().zip(next).map(|(p, q)| [*p, *q]);
                Self::Polygon(sides.collect(), Outline::polygon(&corners))
            }
        }
    }

    /// Minimum distance of the arm's plate in a turn, mm; negative where the plate penetrates the shape.
    fn clearance(&self, chain: &TwoBar, bend: f64) -> f64 {
        let half = 0.5 * ReversedMachine::plate_width(chain.carrier(), bend);
        let nearness = |t: f64| {
            let jet = chain.at(t);
            let knee = chain.knee(jet.carrier[0]);
            let tip = chain.tip(jet.carrier[0], jet.elbow[0]);
            half - self.distance([knee, tip])
        };
        let piece = SampledPiece {
            from: 0.0,
            to: chain.path().period(),
            steps: SAMPLES,
        };
        let samples: Vec<f64> = (0..=SAMPLES).map(|i| nearness(piece.at(i))).collect();
        -maximum_of_samples(&samples, nearness, rounding, &[piece]).value
    }

    /// Distance of a bar from the shape, mm. Negative if they overlap: minus the length inside a polygon, or minus the depth in
    /// another shape.
    fn distance(&self, [p, q]: [Point; 2]) -> f64 {
        match self {
            Self::Below(below) => p.y.min(q.y) - below,
            Self::Circle(center, radius) => from_bar(*center, [p, q]) - radius,
            Self::Polygon(sides, outline) => {
                let mut cuts: Vec<f64> = sides
                    .iter()
                    .filter_map(|side| crossing([p, q], *side))
                    .collect();
                cuts.extend([0.0, 1.0]);
                cuts.sort_by(f64::total_cmp);
                let is_inside =
                    |cut: &[f64]| outline.contains(p + (q - p) * (0.5 * (cut[0] + cut[1])));
                let inside = cuts
                    .windows(2)
                    .filter(|cut| is_inside(cut))
                    .map(|cut| cut[1] - cut[0]);
                let inside = inside.sum::<f64>() * (q - p).norm();
                if inside > 0.0 {
                    return -inside;
                }
                let gaps = sides.iter().map(|side| {
                    let ends = [from_bar(p, *side), from_bar(q, *side)];
                    let corner = from_bar(side[0], [p, q]);
                    ends[0].min(ends[1]).min(corner)
                });
                gaps.fold(f64::INFINITY, f64::min)
            }
        }
    }
}

/// Distance of a point from a bar.
fn from_bar(point: Point, [p, q]: [Point; 2]) -> f64 {
    let (along, off) = (q - p, point - p);
    let share = (off.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    let share = if share.is_nan() { 0.0 } else { share };
    (off - along * share).norm()
}

/// Position on a bar at which a side crosses it, as a share of the bar's length.
fn crossing([p, q]: [Point; 2], [a, b]: [Point; 2]) -> Option<f64> {
    let (bar, side, off) = (q - p, b - a, a - p);
    let area = bar.perp(&side);
    let [share, along] = [off.perp(&side) / area, off.perp(&bar) / area];
    ((0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&along)).then_some(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_is_as_far_from_a_shape_as_its_nearest_point() {
        let corners = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]];
        let square = Room::new(&KeepOut {
            corners,
            ..KeepOut::default()
        });
        let bar = |p: [f64; 2], q: [f64; 2]| [Point::from(p), Point::from(q)];
        for (bar, distance) in [
            (bar([5.0, -1.0], [5.0, 8.0]), 1.0),
            (bar([-3.0, -4.0], [-3.0, -5.0]), 5.0),
            (bar([1.0, 1.0], [1.0, 8.0]), -2.0),
            (bar([-1.0, 1.0], [9.0, 1.0]), -4.0),
            (bar([1.0, 1.0], [2.0, 1.0]), -1.0),
        ] {
            assert!((square.distance(bar) - distance).abs() < 1e-12, "{bar:?}");
        }
        let circle = Room::new(&KeepOut {
            center: Some([0.0, 2.0]),
            radius: Some(1.0),
            ..KeepOut::default()
        });
        assert!((circle.distance(bar([-5.0, 0.0], [5.0, 0.0])) - 1.0).abs() < 1e-12);
        let ground = Room::new(&KeepOut {
            below: Some(-1.0),
            ..KeepOut::default()
        });
        assert_eq!(ground.distance(bar([0.0, 2.0], [1.0, -3.0])), -2.0);
    }

    #[test]
    fn the_middle_of_angles_is_off_by_equal_shares_of_their_tolerances() {
        let angles = [3.0, -3.1, 3.05];
        let tolerances = [0.1, 0.3, 0.2];
        let middle = middle(&angles, &tolerances).expect("an angle");
        let shares = |x: f64| {
            let share = |(a, t): (&f64, &f64)| wrapped(a - x).abs() / t;
            angles
                .iter()
                .zip(&tolerances)
                .map(share)
                .fold(0.0, f64::max)
        };
        let minimum = shares(middle);
        for i in 0..2000 {
            assert!(shares(middle - 1.0 + 1e-3 * f64::from(i)) >= minimum - 1e-12);
        }
    }
}
