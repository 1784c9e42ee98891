use crate::{
    Point, Vector,
    curve::{Arc, PolySegment, Segment},
    numeric::Tolerance,
    region::{CORNER, Outline},
};

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
        let shifted = |segment: &Segment, u: f64| -> Point {
            let tangent = segment.tangent(u);
            segment.at(u).point + Vector::new(tangent.y, -tangent.x) * distance
        };
        let mut segments: Vec<Segment> = Vec::new();
        for segment in self.segments() {
            let start = segments
                .last()
                .map_or_else(|| shifted(segment, -1.0), Segment::end);
            let end = shifted(segment, 1.0);
            match segment {
                Segment::Line(..) => segments.push(Segment::Line(start, end)),
                Segment::Arc(arc) => segments.push(Segment::Arc(Arc {
                    start,
                    end,
                    bulge: arc.bulge,
                })),
                Segment::Poly(_) => {
                    let mut fitted =
                        PolySegment::fit(|u| shifted(segment, u), -1.0, 1.0, tolerance);
                    if let Some(first) = fitted.first_mut() {
                        *first = first.pinned(start, first.end());
                    }
                    segments.extend(fitted.into_iter().map(Segment::Poly));
                }
            }
        }
        // Close the gap that rounding leaves at the end.
        let first = segments.first()?.start();
        match segments.last_mut()? {
            Segment::Line(_, end) => *end = first,
            Segment::Arc(arc) => arc.end = first,
            Segment::Poly(poly) => *poly = poly.pinned(poly.start(), first),
        }
        let offset = Self::from_closed(segments);
        offset.crossing().is_none().then_some(offset)
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
