use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, Point, Tolerance, Vector, checkpoint};
use centrode_mechanism::gear::IntermittentPair;
use centrode_mechanism::transmission::Transmission;
use nalgebra::Isometry2;

use crate::progress::Steps;

/// Greatest turn of the driven gear searched, rad.
const FREE: f64 = 0.5;
/// Share of a squared distance that rounding may be off.
const ROUNDING: f64 = 1e-12;
/// Corners of a pin.
const PIN_CORNERS: u32 = 240;

/// Contact analysis of a finished intermittent gear pair: the free angle of the driven gear either way at each input.
///
/// Works on the finished contours alone: every corner of either gear is turned about the driven gear's axis until it
/// meets an edge of the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IntermittentContact {
    /// Driver's turn, rad.
    pub input: Vec<f64>,
    /// Whether the driven gear moves.
    pub moving: Vec<bool>,
    /// Angle by which the driven gear can turn on from its law, rad; negative where it must go back to be free.
    pub ahead: Vec<f64>,
    /// Angle by which it can turn back, rad.
    pub back: Vec<f64>,
    /// Deepest penetration along the driven gear's turning, mm.
    pub penetration: Vec<f64>,
}

impl IntermittentContact {
    /// Analyses one turn of the driver at so many even inputs, never in step with the teeth.
    ///
    /// Contours are taken as polygons nowhere farther off than the tolerance.
    #[must_use]
    pub fn analyse(pair: &IntermittentPair, count: u32, tolerance: Tolerance) -> Self {
        let motion = pair.law().motion_angle();
        let mut layers = vec![(
            Wheel::star(pair.driver(), tolerance),
            vec![Wheel::star(pair.driven(), tolerance)],
        )];
        for cam in pair.cams() {
            let pins = cam.pins.iter().map(|&p| Wheel::pin(p, cam.pin_radius));
            layers.push((Wheel::star(&cam.outline, tolerance), pins.collect()));
        }
        let mut out = Self::default();
        let steps = Steps::new(count as usize);
        for i in 0..count {
            checkpoint();
            steps.step();
            let input = TAU * (f64::from(i) + 0.37) / f64::from(count);
            let turned = pair.law().at(input).position;
            // The driver's axes seen from the driven gear's.
            let placed = Isometry2::new(Vector::new(pair.center_distance(), 0.0), turned);
            let driver = placed.inverse() * Isometry2::rotation(-input);
            let mut room = Room::default();
            for (wheel, mates) in &layers {
                for mate in mates {
                    room.narrow(wheel, &driver, mate);
                }
            }
            out.input.push(input);
            out.moving.push(input < motion);
            out.ahead.push(room.ahead);
            out.back.push(room.back);
            out.penetration.push(room.penetration);
        }
        out
    }

    /// Greatest of a column where the driven gear moves, or where it rests.
    #[must_use]
    pub fn greatest(&self, column: &[f64], moving: bool) -> f64 {
        let of = column.iter().zip(&self.moving).filter(|c| *c.1 == moving);
        of.map(|c| *c.0).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Deepest penetration of all, mm.
    #[must_use]
    pub fn deepest(&self) -> f64 {
        self.penetration.iter().copied().fold(0.0, f64::max)
    }
}

/// Polygon with an index of what lies in it.
struct Wheel {
    corners: Vec<Point>,
    reach: f64,
    /// A pin about this centre; a star about its own origin otherwise.
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
}

/// Free angle of the driven gear.
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
    /// Narrows the room by a driver, its axes given in the driven gear's, and the mate it meets there.
    fn narrow(&mut self, driver: &Wheel, place: &Isometry2<f64>, mate: &Wheel) {
        let axis = Point::from(place.translation.vector);
        let driver_points: Vec<Point> = driver.corners.iter().map(|p| place * p).collect();
        let near_driver = near_edges(&driver_points, Point::origin(), mate.reach);
        let near_mate = near_edges(&mate.corners, axis, driver.reach);
        // The driven gear going on turns the driver back, in its axes.
        for edge in &near_driver {
            self.corner(edge.from, &near_mate, 1.0, mate.holds(edge.from));
        }
        for edge in &near_mate {
            let inside = driver.holds(place.inverse_transform_point(&edge.from));
            self.corner(edge.from, &near_driver, -1.0, inside);
        }
    }

    /// Narrows the room by a corner that turns about the origin until it meets an edge; `sense` is 1 for one of the
    /// driver.
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
        // A corner of the driver is met from ahead when it turns back, one of the driven gear when it turns on.
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

/// Edge of a polygon, and the squares of its least and greatest distance from the axis.
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
            low: foot.min(ends[0]).min(ends[1]) * (1.0 - ROUNDING),
            high: ends[0].max(ends[1]) * (1.0 + ROUNDING),
        }
    }

    /// Whether a circle about the axis, of a squared radius, can meet it.
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
mod tests {
    use super::*;
    use centrode_mechanism::gear::design::GearPairDesign;
    use centrode_mechanism::gear::pitch::{Circle, PitchSpec, Polar};
    use centrode_mechanism::gear::{IntermittentPairSpec, Member};

    use crate::optimise::Random;

    fn spec(driver: u32, mean_ratio: [u32; 2], teeth: u32, entry: f64) -> IntermittentPairSpec {
        let mut pair = GearPairDesign::new(PitchSpec::Circle(Circle {
            module: Some(3.0),
            tooth_count: Some(driver),
            ..Circle::default()
        }));
        pair.mean_ratio = mean_ratio;
        (pair.driver.bore, pair.driven.bore) = (16.0, 16.0);
        IntermittentPairSpec::new(pair, teeth, entry)
    }

    fn contact(spec: &IntermittentPairSpec) -> (IntermittentPair, IntermittentContact) {
        let pair = IntermittentPair::resolve(spec).expect("a pair");
        let tolerance = Tolerance::new(1e-4).expect("positive");
        let contact = IntermittentContact::analyse(&pair, 360, tolerance);
        (pair, contact)
    }

    /// Angular backlash of a tooth on the driven gear, rad.
    fn backlash(pair: &IntermittentPair) -> f64 {
        let length = pair.pair().rolling().pitch_length(Member::Driven);
        0.05 / (length / TAU * 20_f64.to_radians().cos())
    }

    /// Guards that nothing penetrates, and that the driven gear is held all the way, moving or not.
    fn held(spec: &IntermittentPairSpec) {
        let (pair, contact) = contact(spec);
        assert!(contact.deepest() < 1e-3, "{spec:?}: {}", contact.deepest());
        let most = 1.1 * backlash(&pair);
        for column in [&contact.ahead, &contact.back] {
            for moving in [false, true] {
                let loose = contact.greatest(column, moving);
                assert!(loose < most, "{spec:?}: {loose}, {most} allowed");
            }
        }
    }

    #[test]
    fn a_pair_with_cams_is_held_all_the_way() {
        let spec = spec(40, [3, 4], 30, 20_f64.to_radians());
        held(&spec);
        let (pair, contact) = contact(&spec);
        let least = contact.ahead.iter().chain(&contact.back).copied();
        let least = least.fold(f64::INFINITY, f64::min);
        assert!(least > 0.95 * backlash(&pair), "{least}");
    }

    #[test]
    fn random_pairs_are_held_too() {
        let mut random = Random::new(3, 0);
        for (stops, ratios) in [(1, [[3, 4], [2, 3]]), (2, [[1, 1], [4, 5]])] {
            let mean_ratio = ratios[usize::from(random.between(0.0, 1.0) > 0.5)];
            let [n1, n2] = mean_ratio;
            let driver = n2 * (random.between(28.0, 44.0) as u32 / n2) * 2;
            let driven = driver * n1 / n2;
            let entry = random.between(0.2, 0.4);
            held(&spec(driver, mean_ratio, driven / stops, entry));
        }
    }

    #[test]
    fn a_pair_of_waves_is_held_too() {
        let mut spec = spec(40, [3, 4], 30, 0.35);
        spec.pair.pitch = PitchSpec::Polar(Polar {
            expression: Some("1 + 0.03*cos(4*phi)".into()),
            module: Some(3.0),
            tooth_count: Some(40),
            ..Polar::default()
        });
        held(&spec);
    }

    #[test]
    fn without_cams_the_lock_holds_and_the_start_is_a_shock() {
        let (pair, contact) = contact(&spec(40, [3, 4], 30, 0.0));
        assert!(contact.deepest() < 1e-3, "{}", contact.deepest());
        assert!((pair.shock() - 4.0 / 3.0).abs() < 1e-9 && pair.cams().is_empty());
        let locked = pair.locked_backlash();
        let motion = pair.law().motion_angle();
        let ends = 0.25 * (TAU - motion);
        // Where the locking arc's ends come to the notch they hold less well; cams do it better.
        for (i, &input) in contact.input.iter().enumerate() {
            let loose = contact.ahead[i].max(contact.back[i]);
            if input > motion + ends && input < TAU - ends {
                assert!(
                    (loose / locked - 1.0).abs() < 0.02,
                    "{loose} of {locked} while locked at {input}"
                );
            }
            assert!(input < motion || loose < 0.02, "{loose} at {input}");
        }
    }

    #[test]
    fn a_gear_turned_too_far_penetrates() {
        let (pair, contact) = contact(&spec(40, [3, 4], 30, 0.35));
        let tolerance = Tolerance::new(1e-4).expect("positive");
        let [driver, driven] = [pair.driver(), pair.driven()].map(|o| Wheel::star(o, tolerance));
        let input = contact.input[200];
        for (off, free) in [(0.0, true), (0.01, false), (-0.01, false)] {
            let turned = pair.law().at(input).position + off;
            let placed = Isometry2::new(Vector::new(pair.center_distance(), 0.0), turned);
            let place = placed.inverse() * Isometry2::rotation(-input);
            let mut room = Room::default();
            room.narrow(&driver, &place, &driven);
            assert_eq!(room.penetration == 0.0, free, "{off}");
        }
    }
}
