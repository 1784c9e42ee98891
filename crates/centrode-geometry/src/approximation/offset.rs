use crate::{
    Point, Vector,
    curve::{Arc, PolySegment, Segment, SegmentRange},
    numeric::Tolerance,
    region::{CORNER, Outline, Position},
};

/// Segment of an offset curve, with its source.
pub(super) struct Shifted {
    pub(super) segment: Segment,
    pub(super) source: Source,
}

/// Source of a segment of an offset curve.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Source {
    /// Part of a segment of the outline.
    Part(SegmentRange),
    /// Corner at the start of a segment of the outline.
    Corner(usize),
}

impl Source {
    /// Position on the outline for a parameter of the segment of the offset curve.
    pub(super) fn position(self, u: f64) -> Position {
        match self {
            Self::Part(SegmentRange { index, from, to }) => Position {
                segment: index,
                u: if u >= 1.0 {
                    to
                } else {
                    from + 0.5 * (1.0 + u) * (to - from)
                },
            },
            Self::Corner(segment) => Position { segment, u: -1.0 },
        }
    }
}

/// A vector turned to the right by a quarter turn.
fn right_of(tangent: Vector) -> Vector {
    Vector::new(tangent.y, -tangent.x)
}

/// Angle from one direction to another, rad, positive counter-clockwise.
pub(super) fn angle(from: Vector, to: Vector) -> f64 {
    from.perp(&to).atan2(from.dot(&to))
}

/// Moves the start of a segment by rounding.
fn start_at(segment: &mut Segment, point: Point) {
    match segment {
        Segment::Line(start, _) => *start = point,
        Segment::Arc(arc) => arc.start = point,
        Segment::Poly(poly) => *poly = poly.pinned(point, poly.end()),
    }
}

/// Moves the start of each segment of a closed chain to the end of the one before it, by rounding.
fn close<T>(chain: &mut [T], segment: impl Fn(&mut T) -> &mut Segment) {
    let mut before = chain.last_mut().map(|last| segment(last).end());
    for one in chain {
        let own = segment(one);
        if let Some(end) = before.filter(|end| *end != own.start()) {
            start_at(own, end);
        }
        before = Some(own.end());
    }
}

/// A closed outline of segments that join within rounding.
pub(super) fn joined(mut segments: Vec<Segment>) -> Outline {
    close(&mut segments, |segment| segment);
    Outline::from_closed(segments)
}

impl Outline {
    /// Offset curve at a constant normal distance, mm; polynomial parts within the tolerance.
    ///
    /// A positive distance is outside for a counter-clockwise outline. `None` if no smooth simple offset exists: the outline
    /// has a corner, the distance exceeds a radius of curvature, or the offset would cross itself.
    #[must_use]
    pub fn offset(&self, distance: f64, tolerance: Tolerance) -> Option<Self> {
        if self.tangent_jumps().iter().any(|&jump| jump > CORNER) {
            return None;
        }
        let bent = self.positions(tolerance).into_iter().any(|position| {
            let jet = self.segments()[position.segment].at(position.u);
            let curvature = jet.first.perp(&jet.second) / jet.first.norm().powi(3);
            1.0 + curvature * distance <= 0.0
        });
        if bent {
            return None;
        }
        let chain = self.shifted(distance, tolerance);
        let offset = joined(chain.into_iter().map(|shifted| shifted.segment).collect());
        offset.crossing().is_none().then_some(offset)
    }

    /// The segments moved by a distance, mm, to the right of their direction, with an arc at each corner, each joined to the
    /// one before it. At an inner corner and where a radius of curvature is smaller than the distance they form a loop.
    pub(super) fn shifted(&self, distance: f64, tolerance: Tolerance) -> Vec<Shifted> {
        let moved = |segment: &Segment, u: f64| -> Point {
            segment.at(u).point + right_of(segment.tangent(u)) * distance
        };
        let segments = self.segments().iter().enumerate();
        let segments: Vec<_> = segments.filter(|(_, segment)| !segment.is_null()).collect();
        let mut before = segments.last().map_or(Vector::x(), |(_, s)| s.tangent(1.0));
        let mut chain: Vec<Shifted> = Vec::new();
        for (index, segment) in segments {
            let after = segment.tangent(-1.0);
            let turn = angle(before, after);
            let reached = chain.last().map(|last| last.segment.end());
            if turn.abs() > CORNER {
                let at = |tangent: Vector| segment.start() + right_of(tangent) * distance;
                // The cutter turns about the tip of a cusp, on the outside.
                let turn = if turn.abs() > std::f64::consts::PI - CORNER {
                    turn.abs().copysign(distance)
                } else {
                    turn
                };
                chain.push(Shifted {
                    segment: Segment::Arc(Arc {
                        start: reached.unwrap_or_else(|| at(before)),
                        end: at(after),
                        bulge: (0.25 * turn).tan(),
                    }),
                    source: Source::Corner(index),
                });
            }
            before = segment.tangent(1.0);
            let reached = chain.last().map(|last| last.segment.end());
            let start = reached.unwrap_or_else(|| moved(segment, -1.0));
            let end = moved(segment, 1.0);
            let whole = Source::Part(SegmentRange {
                index,
                from: -1.0,
                to: 1.0,
            });
            match segment {
                Segment::Line(..) => chain.push(Shifted {
                    segment: Segment::Line(start, end),
                    source: whole,
                }),
                // An arc as round as the cutter moves it nowhere.
                Segment::Arc(_) if (end - start).norm() < tolerance.mm() => {}
                Segment::Arc(arc) => chain.push(Shifted {
                    segment: Segment::Arc(Arc {
                        start,
                        end,
                        bulge: arc.bulge,
                    }),
                    source: whole,
                }),
                Segment::Poly(_) => {
                    let fitted =
                        PolySegment::fit_spans(|u| moved(segment, u), -1.0, 1.0, tolerance);
                    chain.extend(fitted.into_iter().map(|span| Shifted {
                        segment: Segment::Poly(span.poly),
                        source: Source::Part(SegmentRange {
                            index,
                            from: span.from,
                            to: span.to,
                        }),
                    }));
                }
            }
        }
        close(&mut chain, |shifted| &mut shifted.segment);
        chain
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_shapes::{rosette, tooth_ring};

    #[test]
    fn an_offset_has_steiners_area_and_length() {
        let tolerance = Tolerance::new(1e-9).expect("positive");
        let outline = rosette(20.0, 1.0, 5, tolerance);
        for distance in [1.5, -2.0] {
            let offset = outline.offset(distance, tolerance).expect("regular");
            Outline::new(offset.segments().to_vec()).expect("closed");
            let turn = std::f64::consts::TAU;
            assert!((offset.length() - outline.length() - turn * distance).abs() < 1e-5);
            let area =
                outline.area() + outline.length() * distance + 0.5 * turn * distance * distance;
            assert!((offset.area() - area).abs() < 1e-5);
        }
        let circle = Outline::circle(Point::new(3.0, 1.0), 5.0);
        let larger = circle.offset(2.0, tolerance).expect("regular");
        assert!((larger.area() - 49.0 * std::f64::consts::PI).abs() < 1e-10);
    }

    #[test]
    fn corners_and_too_large_distances_have_no_offset() {
        let tolerance = Tolerance::new(1e-6).expect("positive");
        assert_eq!(tooth_ring(17, 2.0, tolerance).offset(0.1, tolerance), None);
        assert_eq!(
            Outline::circle(Point::origin(), 5.0).offset(-5.5, tolerance),
            None
        );
        assert_eq!(
            rosette(20.0, 6.0, 7, tolerance).offset(12.0, tolerance),
            None
        );
    }
}
