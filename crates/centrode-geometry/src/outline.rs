use crate::{Point, PolySegment, Vector, poly_segment::SegmentJet};
use nalgebra::Rotation2;

/// A circular arc from `start` to `end`; `bulge` is the tangent of a quarter of the turned angle,
/// positive counter-clockwise.
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

/// One smooth part of an [`Outline`], parametrised over `[-1, 1]`.
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
                // Chord form: as good for a nearly straight arc as for a half circle.
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

    /// The segment with its direction of travel reversed.
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

/// A closed contour: segments joined end to start, the last to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    segments: Vec<Segment>,
}

impl Outline {
    /// Joins segments into a closed contour.
    ///
    /// # Errors
    /// [`OpenOutline`] where a segment does not start exactly where the one before it ends, or is not a number.
    pub fn new(segments: Vec<Segment>) -> Result<Self, OpenOutline> {
        let mut before = segments.last().map_or(Point::origin(), Segment::end);
        for (index, segment) in segments.iter().enumerate() {
            let is_somewhere = segment.at(0.0).point.coords.norm().is_finite();
            if segment.start() != before || !is_somewhere {
                return Err(OpenOutline {
                    index,
                    gap: if is_somewhere {
                        (segment.start() - before).norm()
                    } else {
                        f64::NAN
                    },
                });
            }
            before = segment.end();
        }
        Ok(Self { segments })
    }

    /// Outline of segments already known to join exactly.
    pub(crate) fn from_closed(segments: Vec<Segment>) -> Self {
        Self { segments }
    }

    /// The segments in order.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }
}

/// Segments that do not join into a closed contour.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "outline is open: segment {index} starts {gap:e} mm away from the end of the one before it"
)]
pub struct OpenOutline {
    /// The segment that does not start where the one before it ends.
    pub index: usize,
    /// The distance between the two, mm; not a number where a coordinate is none.
    pub gap: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_segment_that_is_not_a_number_between_its_ends_is_refused() {
        let tolerance = crate::Tolerance::new(1e-9).expect("positive");
        let bow = |t: f64| Point::new(t, if t.abs() < 0.5 { f64::NAN } else { 1.0 - t * t });
        let bow = PolySegment::fit(bow, -1.0, 1.0, tolerance)[0];
        let back = Segment::Line(bow.end(), bow.start());
        let refused = Outline::new(vec![Segment::Poly(bow), back]).expect_err("no outline");
        assert!(refused.index == 0 && refused.gap.is_nan());
    }

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
