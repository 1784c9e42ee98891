use std::f64::consts::{PI, TAU};

use centrode_gear::{Cam, IntermittentPair, Member};
use centrode_geometry::{
    Extreme, Outline, Point, SampledPiece, Tolerance, Vector, WRITTEN, bracketed_minimum_below,
    checkpoint,
};
use centrode_kinematics::transmission::Transmission;
use nalgebra::Isometry2;

use crate::progress::Steps;

/// Maximum rotation of the driven gear that is searched, rad. A gear that can turn farther gets this value. A larger
/// one takes longer.
const FREE: f64 = 0.5;
/// Number of corners of the polygon of a pin. With fewer the polygon deviates more from the circle, more take longer.
const PIN_CORNERS: u32 = 240;
/// Number of steps in which the path of a pin along its cam is sampled, per step of the free angle: a distance is quick to
/// compute.
const PIN_STEPS: usize = 6;

/// Contact analysis of a finished intermittent gear pair: the free angle of the driven gear in either direction at each input.
///
/// The analysis uses only the finished contours: every corner of either gear is turned about the driven gear's axis until it
/// meets an edge of the other gear.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IntermittentContact {
    /// Driver angle, rad.
    pub input: Vec<f64>,
    /// Whether the driven gear moves.
    pub moving: Vec<bool>,
    /// Angle by which the driven gear can turn on from its law, rad; negative if it must turn back to be free.
    pub ahead: Vec<f64>,
    /// Angle by which the driven gear can turn back, rad.
    pub back: Vec<f64>,
    /// Maximum penetration along the path of the driven gear's rotation, mm.
    pub penetration: Vec<f64>,
    /// Maximum free angle in either direction while the driven gear moves and while it rests, rad, each with its input: local
    /// maxima of the columns are followed between the samples, and at the start and end of the motion both sides count.
    pub free: [Extreme; 2],
    /// Minimum distance between a cam and a pin of nominal size, mm, with its input; `None` if there are no cams.
    pub pin_clearance: Option<Extreme>,
    /// Maximum penetration, mm, with its input, followed like the free angles.
    pub deepest: Extreme,
}

impl IntermittentContact {
    /// Analyses one turn of the driver at `count` inputs or a few more, never in step with the teeth, and follows the maxima
    /// between them.
    ///
    /// Contours are replaced by polygons within the tolerance.
    #[must_use]
    pub fn analyse(pair: &IntermittentPair, count: u32, tolerance: Tolerance) -> Self {
        let mut layers = vec![(
            Wheel::star(pair.driver(), tolerance),
            vec![Wheel::star(pair.driven(), tolerance)],
        )];
        for cam in pair.cams() {
            let pins = cam.pins.iter().map(|&p| Wheel::pin(p, cam.pin_radius));
            layers.push((Wheel::star(&cam.outline, tolerance), pins.collect()));
        }
        let room = |input: f64| {
            let turned = pair.law().at(input).position;
            // Pose of the driver in the driven gear's axes.
            let placed = Isometry2::new(Vector::new(pair.center_distance(), 0.0), turned);
            let driver = placed.inverse() * Isometry2::rotation(-input);
            let mut room = Room::default();
            for (wheel, mates) in &layers {
                for mate in mates {
                    room.narrow(wheel, &driver, mate);
                }
            }
            room
        };
        let parts = parts(pair, count as usize);
        let motion = pair.law().motion_angle();
        let mut out = Self::default();
        let steps = Steps::new(parts.iter().map(|part| part.steps + 1).sum());
        for part in &parts {
            for i in 0..=part.steps {
                checkpoint();
                steps.step();
                let input = part.at(i);
                let room = room(input);
                out.input.push(input);
                out.moving.push(input < motion);
                out.ahead.push(room.ahead);
                out.back.push(room.back);
                out.penetration.push(room.penetration);
            }
        }
        // A peak lower than the accuracy of the contours does not count.
        let exact = pair.accuracy().mm() * TAU / pair.pair().rolling().pitch_length(Member::Driven);
        let (moves, rests): (Vec<_>, Vec<_>) = parts.iter().partition(|part| part.from < motion);
        let start_of_rest = out.moving.iter().filter(|moving| **moving).count();
        out.free = [
            (0..start_of_rest, moves),
            (start_of_rest..out.input.len(), rests),
        ]
        .map(|(samples, parts)| {
            let follow = |column: &[f64], of: fn(&Room) -> f64| {
                let f = |input| of(&room(input));
                maximum(&column[samples.clone()], f, exact, &parts)
            };
            let [ahead, back] = [
                follow(&out.ahead, |room| room.ahead),
                follow(&out.back, |room| room.back),
            ];
            if ahead.value >= back.value {
                ahead
            } else {
                back
            }
        });
        let depth = |input| room(input).penetration;
        out.deepest = maximum(&out.penetration, depth, pair.accuracy().mm(), &parts);
        let clearances =
            pair.cams()
                .iter()
                .zip(layers.iter().skip(1))
                .flat_map(|(cam, (wheel, _))| {
                    cam.pins
                        .iter()
                        .map(|&pin| pin_clearance(pair, cam, wheel, pin, &parts))
                });
        out.pin_clearance = clearances.min_by(|a, b| a.value.total_cmp(&b.value));
        out
    }

    /// Maximum of a column while the driven gear moves, or while it rests.
    #[must_use]
    pub fn maximum(&self, column: &[f64], moving: bool) -> f64 {
        let of = column.iter().zip(&self.moving).filter(|c| *c.1 == moving);
        of.map(|c| *c.0).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Pieces of a driver turn in which the law is smooth, with `count` steps or a few more in all: whole pitches and one step, so
/// that the samples are never in step with the teeth.
fn parts(pair: &IntermittentPair, count: usize) -> Vec<SampledPiece> {
    let mut ends = pair.law().breaks();
    ends.push(TAU);
    let pitches = pair.pair().driver().tooth_count() as usize;
    let piece = |ends: &[f64]| {
        let steps = (count as f64 * (ends[1] - ends[0]) / TAU).ceil() as usize;
        SampledPiece {
            from: ends[0],
            to: ends[1],
            steps: steps + 1 + (pitches - steps % pitches) % pitches,
        }
    };
    ends.windows(2).map(piece).collect()
}

/// Maximum of a function whose samples are known, those of each piece after those of the piece before. Its local maxima are
/// followed between the samples as far as they can exceed the maximum found by more than `exact`.
fn maximum(samples: &[f64], f: impl Fn(f64) -> f64, exact: f64, parts: &[SampledPiece]) -> Extreme {
    let inputs = parts
        .iter()
        .flat_map(|part| (0..=part.steps).map(|i| part.at(i)));
    let known = inputs.zip(samples.iter().copied());
    let mut best = known.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
    let mut rest = samples;
    for part in parts {
        let (own, after) = rest.split_at(part.steps + 1);
        rest = after;
        let sampled: Vec<_> = own
            .iter()
            .enumerate()
            .map(|(i, &value)| (part.at(i), value))
            .collect();
        // An end has no neighbour on one side: the middle of the adjacent step shows whether the function rises from the end.
        let [first, .., last] = [&sampled[..2], &sampled[sampled.len() - 2..]].map(|ends| {
            let middle = 0.5 * (ends[0].0 + ends[1].0);
            [ends[0], (middle, f(middle)), ends[1]]
        });
        let inner = sampled
            .windows(3)
            .map(|three| [three[0], three[1], three[2]]);
        for [low, middle, high] in inner.chain([first, last]) {
            let above = 2.0 * middle.1 - low.1 - high.1;
            let is_peak = middle.1 >= low.1 && middle.1 >= high.1;
            if is_peak && middle.1 + above > best.1 + exact {
                let three = [low, middle, high].map(|(input, value)| (input, -value));
                let (input, value) = bracketed_minimum_below(|x| -f(x), three, -best.1, exact);
                if -value > best.1 {
                    best = (input, -value);
                }
            }
        }
    }
    Extreme {
        input: best.0,
        value: best.1,
    }
}

/// Minimum distance of a pin from its cam, mm, negative if they overlap, with its input.
fn pin_clearance(
    pair: &IntermittentPair,
    cam: &Cam,
    wheel: &Wheel,
    pin: Point,
    parts: &[SampledPiece],
) -> Extreme {
    let clearance = |input: f64| {
        let placed = Isometry2::new(
            Vector::new(pair.center_distance(), 0.0),
            pair.law().at(input).position,
        );
        wheel.distance(Isometry2::rotation(input) * placed * pin) - cam.pin_radius
    };
    let parts: Vec<_> = parts
        .iter()
        .map(|&part| SampledPiece {
            steps: PIN_STEPS * part.steps,
            ..part
        })
        .collect();
    let overlap = |input: f64| -clearance(input);
    let inputs = parts
        .iter()
        .flat_map(|part| (0..=part.steps).map(|i| part.at(i)));
    let samples: Vec<f64> = inputs.map(overlap).collect();
    // A thousandth of the accuracy of the contours: a distance is quick to compute.
    let exact = 1e-3 * pair.accuracy().mm();
    let Extreme { input, value } = maximum(&samples, overlap, exact, &parts);
    Extreme {
        input,
        value: -value,
    }
}

/// Polygon with an index for the test whether a point lies inside.
struct Wheel {
    corners: Vec<Point>,
    reach: f64,
    /// Centre and radius of a pin; `None` for a polygon that is star-shaped about its origin.
    pin: Option<(Point, f64)>,
    /// Directions of the corners, ascending, with their indices.
    directions: Vec<(f64, usize)>,
}

impl Wheel {
    fn star(outline: &Outline, tolerance: Tolerance) -> Self {
        let corners = outline.flatten(tolerance);
        let mut directions: Vec<(f64, usize)> = corners
            .iter()
            .enumerate()
            .map(|(i, p)| (p.y.atan2(p.x), i))
            .collect();
        directions.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self {
            reach: corners.iter().map(|p| p.coords.norm()).fold(0.0, f64::max),
            corners,
            pin: None,
            directions,
        }
    }

    fn pin(center: Point, radius: f64) -> Self {
        let corner = |i: u32| {
            let angle = TAU * f64::from(i) / f64::from(PIN_CORNERS);
            center + Vector::new(angle.cos(), angle.sin()) * radius
        };
        Self {
            corners: (0..PIN_CORNERS).map(corner).collect(),
            reach: center.coords.norm() + radius,
            pin: Some((center, radius)),
            directions: Vec::new(),
        }
    }

    fn holds(&self, point: Point) -> bool {
        if let Some((center, radius)) = self.pin {
            return (point - center).norm() < radius * (PI / f64::from(PIN_CORNERS)).cos();
        }
        let direction = point.y.atan2(point.x);
        let count = self.directions.len();
        let after = self.directions.partition_point(|d| d.0 <= direction);
        let a = self.corners[self.directions[(after + count - 1) % count].1];
        let b = self.corners[self.directions[after % count].1];
        (b - a).perp(&(point - a)) > 0.0
    }

    /// Distance of a point from the polygon, negative inside. For a point farther off than the polygon reaches from its origin
    /// it is a lower bound.
    fn distance(&self, point: Point) -> f64 {
        let beyond = point.coords.norm() - self.reach;
        if beyond > self.reach {
            return beyond;
        }
        let next = self.corners.iter().cycle().skip(1);
        let squared = self.corners.iter().zip(next).map(|(a, b)| {
            let (way, to) = (b - a, point - a);
            let along = (to.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
            (to - way * along).norm_squared()
        });
        let off = squared.fold(f64::INFINITY, f64::min).sqrt();
        if self.holds(point) { -off } else { off }
    }
}

/// Free angles of the driven gear, rad, and the penetration, mm.
struct Room {
    ahead: f64,
    back: f64,
    penetration: f64,
}

impl Default for Room {
    fn default() -> Self {
        Self {
            ahead: FREE,
            back: FREE,
            penetration: 0.0,
        }
    }
}

impl Room {
    /// Narrows the room by a driver, whose pose is given in the driven gear's axes, and the part of the driven gear that it
    /// meets.
    fn narrow(&mut self, driver: &Wheel, place: &Isometry2<f64>, mate: &Wheel) {
        let axis = Point::from(place.translation.vector);
        let driver_points: Vec<Point> = driver.corners.iter().map(|p| place * p).collect();
        let near_driver = near_edges(&driver_points, Point::origin(), mate.reach);
        let near_mate = near_edges(&mate.corners, axis, driver.reach);
        // In the axes of the driven gear the driver turns back when the driven gear turns on.
        for edge in &near_driver {
            self.corner(edge.from, &near_mate, 1.0, mate.holds(edge.from));
        }
        for edge in &near_mate {
            let inside = driver.holds(place.inverse_transform_point(&edge.from));
            self.corner(edge.from, &near_driver, -1.0, inside);
        }
    }

    /// Narrows the room by a corner that turns about the origin until it meets an edge; `sense` is 1 for a corner of the
    /// driver, -1 for one of the driven gear.
    fn corner(&mut self, corner: Point, edges: &[Edge], sense: f64, inside: bool) {
        let squared = corner.coords.norm_squared();
        let (mut less, mut more) = (FREE, FREE);
        for edge in edges.iter().filter(|edge| edge.meets(squared)) {
            let (from, way) = (edge.from.coords, edge.way);
            let (p, q) = (way.norm_squared(), from.dot(&way));
            let room = q * q - p * (from.norm_squared() - squared);
            if room < 0.0 || p == 0.0 {
                continue;
            }
            for root in [room.sqrt(), -room.sqrt()] {
                let t = (root - q) / p;
                if !(0.0..=1.0).contains(&t) {
                    continue;
                }
                let met = from + way * t;
                let off = corner.coords.perp(&met).atan2(corner.coords.dot(&met));
                if off >= 0.0 {
                    more = more.min(off);
                } else {
                    less = less.min(-off);
                }
            }
        }
        // When the driven gear turns on, a corner of the driver turns back in these axes, and a corner of the driven gear
        // turns on.
        let (ahead, back) = if sense > 0.0 {
            (less, more)
        } else {
            (more, less)
        };
        if !inside {
            self.ahead = self.ahead.min(ahead);
            self.back = self.back.min(back);
            return;
        }
        let depth = ahead.min(back);
        self.penetration = self.penetration.max(depth * squared.sqrt());
        if ahead < back {
            self.back = self.back.min(-ahead);
        } else {
            self.ahead = self.ahead.min(-back);
        }
    }
}

/// Edge of a polygon, and the squares of its minimum and maximum distance from the axis.
struct Edge {
    from: Point,
    way: Vector,
    low: f64,
    high: f64,
}

impl Edge {
    fn new(from: Point, to: Point) -> Self {
        let way = to - from;
        let ends = [from, to].map(|p| p.coords.norm_squared());
        let t = -from.coords.dot(&way) / way.norm_squared();
        let foot = (from + way * t.clamp(0.0, 1.0)).coords.norm_squared();
        Self {
            from,
            way,
            low: foot.min(ends[0]).min(ends[1]) * (1.0 - WRITTEN),
            high: ends[0].max(ends[1]) * (1.0 + WRITTEN),
        }
    }

    /// Whether a circle about the axis, with a squared radius, can meet the edge.
    fn meets(&self, squared: f64) -> bool {
        (self.low..=self.high).contains(&squared)
    }
}

/// The edges of a polygon that begin or end within a distance of a point.
fn near_edges(corners: &[Point], from: Point, reach: f64) -> Vec<Edge> {
    let near = |p: &Point| (p - from).norm_squared() <= reach * reach;
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next);
    edges
        .filter(|(a, b)| near(a) || near(b))
        .map(|(a, b)| Edge::new(*a, *b))
        .collect()
}

#[cfg(test)]
mod tests;
