use crate::{
    Point, Vector,
    curve::{PolySegment, SegmentJet},
    numeric::{COMPUTED, POSITION, WRITTEN, gauss_legendre},
};
use nalgebra::Rotation2;

/// A circular arc from `start` to `end`.
///
/// `bulge` is the number DXF uses (group code 42): the tangent of a quarter of the turned angle, positive
/// counter-clockwise. It is the sagitta divided by half the chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// First point.
    pub start: Point,
    /// Last point.
    pub end: Point,
    /// `tan(turn / 4)`, positive counter-clockwise.
    pub bulge: f64,
}

impl Arc {
    /// Turned angle, rad, positive counter-clockwise.
    #[must_use]
    pub fn sweep(&self) -> f64 {
        4.0 * self.bulge.atan()
    }

    /// Radius, mm.
    #[must_use]
    pub fn radius(&self) -> f64 {
        let b = self.bulge.abs();
        (self.end - self.start).norm() * (1.0 + b * b) / (4.0 * b)
    }

    /// Center.
    #[must_use]
    pub fn center(&self) -> Point {
        let chord = self.end - self.start;
        let left = Vector::new(-chord.y, chord.x);
        self.start + 0.5 * chord + left * ((1.0 - self.bulge * self.bulge) / (4.0 * self.bulge))
    }
}

/// One smooth part of an outline, parametrised over `[-1, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "an outline is nearly all polynomials; a box each would cost more than it saves"
)]
pub enum Segment {
    /// A straight line between two points.
    Line(Point, Point),
    /// A circular arc.
    Arc(Arc),
    /// A polynomial curve.
    Poly(PolySegment),
}

/// Part of a segment in a list, between two parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentRange {
    /// Index of the segment.
    pub index: usize,
    /// Parameter of its start.
    pub from: f64,
    /// Parameter of its end.
    pub to: f64,
}

impl From<PolySegment> for Segment {
    fn from(poly: PolySegment) -> Self {
        Self::Poly(poly)
    }
}

impl Segment {
    /// First point.
    #[must_use]
    pub fn start(&self) -> Point {
        match self {
            Self::Line(start, _) => *start,
            Self::Arc(arc) => arc.start,
            Self::Poly(poly) => poly.start(),
        }
    }

    /// Last point.
    #[must_use]
    pub fn end(&self) -> Point {
        match self {
            Self::Line(_, end) => *end,
            Self::Arc(arc) => arc.end,
            Self::Poly(poly) => poly.end(),
        }
    }

    /// Position and derivatives at `u` in `[-1, 1]`.
    #[must_use]
    pub fn at(&self, u: f64) -> SegmentJet {
        match self {
            Self::Line(start, end) => SegmentJet {
                point: start + (end - start) * (0.5 * (1.0 + u)),
                first: (end - start) * 0.5,
                second: Vector::zeros(),
            },
            Self::Arc(arc) => {
                // Computed from the chord: exact for a nearly straight arc, too.
                let half = 0.5 * arc.sweep();
                let chord = arc.end - arc.start;
                let t = 0.5 * (1.0 + u);
                let (ratio, stretch) = if half == 0.0 {
                    (t, 1.0)
                } else {
                    ((half * t).sin() / half.sin(), half / half.sin())
                };
                let first = Rotation2::new(half * u) * chord * (0.5 * stretch);
                SegmentJet {
                    point: arc.start + Rotation2::new(half * (t - 1.0)) * chord * ratio,
                    first,
                    second: Vector::new(-first.y, first.x) * half,
                }
            }
            Self::Poly(poly) => poly.at(u),
        }
    }

    /// The part between two parameters, itself over `[-1, 1]`.
    #[must_use]
    pub fn part(&self, u0: f64, u1: f64) -> Self {
        if (u0, u1) == (-1.0, 1.0) {
            return *self;
        }
        match self {
            Self::Line(..) => Self::Line(self.at(u0).point, self.at(u1).point),
            Self::Arc(arc) => Self::Arc(Arc {
                start: self.at(u0).point,
                end: self.at(u1).point,
                bulge: (0.125 * (u1 - u0) * arc.sweep()).tan(),
            }),
            Self::Poly(poly) => Self::Poly(poly.part(u0, u1)),
        }
    }

    /// The segment in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match self {
            Self::Line(start, end) => Self::Line(*end, *start),
            Self::Arc(arc) => Self::Arc(Arc {
                start: arc.end,
                end: arc.start,
                bulge: -arc.bulge,
            }),
            Self::Poly(poly) => Self::Poly(poly.reversed()),
        }
    }
}

impl Segment {
    /// Whether the segment is shorter than the rounding of its end points, so that it has no tangent.
    pub(crate) fn is_null(&self) -> bool {
        let start = self.start();
        let rounding = WRITTEN * start.coords.amax();
        (self.end() - start).amax() <= rounding && self.length() <= rounding
    }

    /// Whether nine samples of the part between two parameters are nearer to a point than `distance`, mm.
    pub(crate) fn stays_near(&self, point: Point, distance: f64, from: f64, to: f64) -> bool {
        let parameter = |i: u32| from + (to - from) * 0.125 * f64::from(i);
        (0..=8).all(|i| (point - self.at(parameter(i)).point).norm() < distance)
    }

    /// Unit tangent at `u`; at an end where the speed is zero, the limit from inside.
    #[must_use]
    pub fn tangent(&self, u: f64) -> Vector {
        let jet = self.at(u);
        let speed = jet.first.norm();
        if speed > COMPUTED * jet.second.norm() {
            jet.first / speed
        } else {
            let inside = if u < 0.0 { jet.second } else { -jet.second };
            inside.try_normalize(0.0).unwrap_or_else(|| {
                (self.end() - self.start())
                    .try_normalize(0.0)
                    .unwrap_or(Vector::x())
            })
        }
    }

    /// Length, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Self::Line(start, end) => (end - start).norm(),
            Self::Arc(arc) if arc.bulge == 0.0 => (arc.end - arc.start).norm(),
            Self::Arc(arc) => arc.radius() * arc.sweep().abs(),
            Self::Poly(poly) => {
                let over = |low, high| {
                    let mut sum = 0.0;
                    gauss_legendre(low, high, |u, w| sum += w * poly.at(u).first.norm());
                    sum
                };
                // Halve until the rule agrees with its halves: at once unless the speed nearly vanishes.
                let mut total = 0.0;
                let mut stack = vec![(-1.0, 1.0, over(-1.0, 1.0), 0)];
                while let Some((low, high, whole, depth)) = stack.pop() {
                    let middle = 0.5 * (low + high);
                    let (left, right) = (over(low, middle), over(middle, high));
                    if depth >= 30
                        || (left + right - whole).abs() <= POSITION * (left + right + total)
                    {
                        total += left + right;
                    } else {
                        stack.push((middle, high, right, depth + 1));
                        stack.push((low, middle, left, depth + 1));
                    }
                }
                total
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_a_segment_is_the_same_curve() {
        let (p, q) = (Point::new(3.0, 1.0), Point::new(5.0, 4.0));
        let arc = Segment::Arc(Arc {
            start: p,
            end: q,
            bulge: -0.7,
        });
        for segment in [Segment::Line(p, q), arc] {
            let part = segment.part(-0.5, 0.7);
            for u in [-1.0, -0.3, 0.4, 1.0] {
                let (on_part, on_whole) = (part.at(u).point, segment.at(0.1 + 0.6 * u).point);
                assert!((on_part - on_whole).norm() < 1e-14, "{segment:?} {u}");
            }
        }
    }

    #[test]
    fn an_arc_has_the_jet_of_its_circle() {
        for bulge in [-1.7, -1.0, -1e-9, 1e-4, 0.3, 1.0] {
            let arc = Arc {
                start: Point::new(3.0, 1.0),
                end: Point::new(5.0, 4.0),
                bulge,
            };
            let segment = Segment::Arc(arc);
            assert!((segment.at(-1.0).point - arc.start).norm() < 1e-14);
            assert!((segment.at(1.0).point - arc.end).norm() < 1e-14);
            for u in [-0.9, -0.3, 0.0, 0.8] {
                let jet = segment.at(u);
                let h = 1e-5;
                let (before, after) = (segment.at(u - h), segment.at(u + h));
                assert!(((after.point - before.point) / (2.0 * h) - jet.first).norm() < 1e-8);
                assert!(((after.first - before.first) / (2.0 * h) - jet.second).norm() < 1e-8);
                let curvature = jet.first.perp(&jet.second) / jet.first.norm().powi(3);
                assert!((curvature * arc.radius() - bulge.signum()).abs() < 1e-9);
                if bulge.abs() > 1e-6 {
                    let r = (jet.point - arc.center()).norm();
                    assert!((r / arc.radius() - 1.0).abs() < 1e-12);
                }
            }
        }
    }
}
