use std::f64::consts::FRAC_PI_2;

use centrode_geometry::{Outline, Point, Segment, Tolerance};
use centrode_kinematics::machine::LineRole;
use serde::ser::SerializeSeq as _;
use serde::{Serialize, Serializer};

/// A chain of lines and arcs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Path {
    /// Its meaning, which determines its appearance.
    pub role: LineRole,
    /// x and y of each vertex, mm, and the bulge of the arc that follows it: the tangent of a quarter of
    /// the turned angle, positive counter-clockwise, zero for a line.
    pub vertices: Vec<f64>,
    /// Whether the last vertex joins the first.
    pub closed: bool,
}

impl Path {
    /// The path of a closed outline, within the tolerance.
    #[must_use]
    pub fn closed(role: LineRole, outline: &Outline, tolerance: Tolerance) -> Self {
        let fitted = outline.display_arcs(tolerance.scaled(0.9));
        let unit = unit(tolerance);
        let vertices = fitted
            .segments()
            .iter()
            .flat_map(|segment| {
                let bulge = match segment {
                    Segment::Arc(arc) => arc.bulge,
                    Segment::Line(..) | Segment::Poly(_) => 0.0,
                };
                let start = segment.start();
                let chord = (segment.end() - start).norm();
                // A change of a bulge moves the middle of its arc by half the chord times this change.
                [
                    short(start.x, unit),
                    short(start.y, unit),
                    short(bulge, unit / chord.max(unit)),
                ]
            })
            .collect();
        Self {
            role,
            vertices,
            closed: true,
        }
    }

    /// The path of a point, within the tolerance of the straight lines between the given points; closed if it ends where it
    /// begins.
    pub(crate) fn way(role: LineRole, places: &[Point], tolerance: Tolerance) -> Self {
        let unit = unit(tolerance);
        let place = |p: &Point| [short(p.x, unit), short(p.y, unit), 0.0];
        let kept = fewest(places, 0.9 * tolerance.mm()).into_iter();
        let mut places: Vec<[f64; 3]> = kept.map(|i| place(&places[i])).collect();
        let closed = places.len() > 1 && places.first() == places.last();
        if closed {
            places.pop();
        }
        Self {
            role,
            vertices: places.concat(),
            closed,
        }
    }

    /// An open chain of lines.
    #[must_use]
    pub fn open(role: LineRole, corners: &[Point]) -> Self {
        Self {
            role,
            vertices: corners.iter().flat_map(|p| [p.x, p.y, 0.0]).collect(),
            closed: false,
        }
    }
}

/// Indices of positions such that straight lines between them pass all other positions within the distance `off`; each line is as
/// long as possible.
fn fewest(places: &[Point], off: f64) -> Vec<usize> {
    let last = places.len().saturating_sub(1);
    let mut kept: Vec<usize> = (0..places.len().min(1)).collect();
    while let Some(&from) = kept.last()
        && from < last
    {
        kept.push(from + farthest(&places[from..], off));
    }
    kept
}

/// Index of the last position to which a straight line from the first passes all positions between them within the distance
/// `off`, before the positions turn back; at least 1.
///
/// The directions in which the line passes a position near enough form a range, which narrows from position to position.
fn farthest(places: &[Point], off: f64) -> usize {
    let from = places[0];
    let (mut middle, mut range) = (None, [-FRAC_PI_2, FRAC_PI_2]);
    let mut before = 0.0;
    for (number, place) in places.iter().enumerate().skip(1) {
        let way = place - from;
        let distance = way.norm();
        if distance <= off && middle.is_none() {
            continue;
        }
        let along = *middle.get_or_insert(way.y.atan2(way.x));
        let (sin, cos) = f64::sin_cos(along);
        let angle = (cos * way.y - sin * way.x).atan2(cos * way.x + sin * way.y);
        if distance < before || !(range[0]..=range[1]).contains(&angle) {
            return (number - 1).max(1);
        }
        before = distance;
        let width = (off / distance.max(off)).asin();
        range = [range[0].max(angle - width), range[1].min(angle + width)];
    }
    places.len() - 1
}

/// Unit to which numbers are rounded; the rounding uses less than a tenth of the tolerance.
fn unit(tolerance: Tolerance) -> f64 {
    let decimals = (-(0.05 * tolerance.mm()).log10()).ceil().clamp(0.0, 12.0);
    10_f64.powi(-(decimals as i32))
}

/// The number at most half of `unit` away that prints short.
pub(crate) fn short(value: f64, unit: f64) -> f64 {
    Rounding::to(unit).of(value)
}

/// Rounding of many numbers to one unit.
#[derive(Clone, Copy)]
pub(crate) struct Rounding {
    /// Whole power of ten: dividing by it gives the nearest float of the short decimal.
    power: f64,
}

impl Rounding {
    pub(crate) fn to(unit: f64) -> Self {
        let power = 10_f64.powi((-unit.log10()).ceil() as i32);
        Self { power }
    }

    /// The number at most half of the unit away that prints short.
    pub(crate) fn of(self, value: f64) -> f64 {
        let rounded = (value * self.power).round() / self.power;
        if rounded.is_finite() {
            rounded + 0.0
        } else {
            value
        }
    }
}

/// Digits of a number that is drawn: finer than any screen.
const DIGITS: i32 = 7;

/// Numbers as JSON with as many digits as drawing needs, null for numbers that are not finite.
pub(crate) fn drawn<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(values.len()))?;
    for &value in values {
        let leading = value.abs().log10().floor();
        let unit = 10_f64.powi(leading.clamp(-300.0, 300.0) as i32 + 1 - DIGITS);
        let value = if value == 0.0 {
            0.0
        } else {
            short(value, unit)
        };
        list.serialize_element(&Some(value).filter(|v| v.is_finite()))?;
    }
    list.end()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use centrode_geometry::{Arc, Point};

    #[test]
    fn a_path_stays_within_its_tolerance() {
        let circle = Outline::circle(Point::new(1.234_567_8, -7.0), 31.415_926);
        for mm in [1.0, 1e-2, 1e-4] {
            let tolerance = Tolerance::new(mm).expect("positive");
            let path = Path::closed(LineRole::Body, &circle, tolerance);
            let corners: Vec<&[f64]> = path.vertices.chunks(3).collect();
            let next = corners.iter().cycle().skip(1);
            for (from, to) in corners.iter().zip(next) {
                let arc = Segment::Arc(Arc {
                    start: Point::new(from[0], from[1]),
                    end: Point::new(to[0], to[1]),
                    bulge: from[2],
                });
                for i in 0..=8 {
                    let p = arc.at(-1.0 + 0.25 * f64::from(i)).point;
                    let off = (p - Point::new(1.234_567_8, -7.0)).norm() - 31.415_926;
                    assert!(off.abs() <= mm, "{off} at {mm}");
                }
            }
        }
    }

    #[test]
    fn a_way_has_few_places_and_stays_near_all_that_it_leaves_out() {
        let curve = |i: u32| {
            let t = f64::from(i) * TAU / 720.0;
            Point::new(90.0 * t.cos() + 20.0 * (3.0 * t).sin(), 60.0 * t.sin())
        };
        let places: Vec<Point> = (0..=720).map(curve).collect();
        // There and back on one line, with a stop.
        let back = [0.0, 1.0, 2.0, 2.0, 2.0, 3.0, 1.5, 0.0].map(|x| Point::new(x, 0.0));
        for (places, most) in [
            (&places[..], 160),
            (&back, 4),
            (&back[..1], 1),
            (&back[..0], 0),
        ] {
            let tolerance = Tolerance::new(0.03).expect("positive");
            let path = Path::way(LineRole::Trace, places, tolerance);
            let corners: Vec<Point> = path
                .vertices
                .chunks(3)
                .map(|v| Point::new(v[0], v[1]))
                .collect();
            assert!(corners.len() <= most, "{}", corners.len());
            for p in places {
                let away = |(a, b): (&Point, &Point)| {
                    let (along, way) = (b - a, p - a);
                    let share = (along.dot(&way) / along.norm_squared().max(1e-12)).clamp(0.0, 1.0);
                    (way - along * share).norm()
                };
                let sides = corners.iter().zip(corners.iter().cycle().skip(1));
                let off = sides.map(away).fold(f64::INFINITY, f64::min);
                assert!(off <= 0.03, "{p} is {off} mm off");
            }
        }
    }

    #[test]
    fn curves_have_the_digits_that_can_be_drawn() {
        let values = [
            1.0 / 3.0,
            -12_345.678_912_3,
            0.0,
            1.23e-13 / 7.0,
            f64::INFINITY,
            f64::NAN,
            1e-320,
        ];
        let mut out = Vec::new();
        let mut serializer = serde_json::Serializer::new(&mut out);
        drawn(&values, &mut serializer).expect("written");
        let read: Vec<Option<f64>> = serde_json::from_slice(&out).expect("JSON");
        assert!(out.len() < 80, "{}", String::from_utf8_lossy(&out));
        for (value, read) in values.into_iter().zip(read) {
            match read {
                Some(read) => {
                    let off = (read - value).abs();
                    assert!(off <= 1e-6 * value.abs() || off < 1e-300, "{read}");
                }
                None => assert!(!value.is_finite()),
            }
        }
    }

    #[test]
    fn rounded_numbers_are_near_and_short() {
        assert_eq!(short(1.234_567, 1e-3).to_string(), "1.235");
        assert_eq!(short(-1e-9, 1e-3).to_string(), "0");
        assert_eq!(short(12.5, 0.03).to_string(), "12.5");
        assert!(short(f64::INFINITY, 0.1).is_infinite());
    }
}
