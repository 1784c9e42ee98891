use crate::{Point, curve::Segment};

/// A closed contour: segments joined end to start, the last to the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    segments: Vec<Segment>,
}

impl Outline {
    /// Joins segments into a closed contour.
    ///
    /// # Errors
    /// [`OpenOutline`] if a segment does not start exactly at the end of the previous one, or is not a number.
    pub fn new(segments: Vec<Segment>) -> Result<Self, OpenOutline> {
        let mut before = segments.last().map_or(Point::origin(), Segment::end);
        for (index, segment) in segments.iter().enumerate() {
            let is_finite = segment.at(0.0).point.coords.norm().is_finite();
            if segment.start() != before || !is_finite {
                return Err(OpenOutline {
                    index,
                    gap: if is_finite {
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

    /// Outline of segments that are known to join exactly.
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
    "the outline is open: segment {index} starts {gap:e} mm from the end of the previous segment"
)]
pub struct OpenOutline {
    /// The segment that does not start at the end of the previous one.
    pub index: usize,
    /// The distance between the two, mm; NaN if a coordinate is not a number.
    pub gap: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::PolySegment;

    #[test]
    fn a_segment_that_is_not_a_number_between_its_ends_is_refused() {
        let tolerance = crate::Tolerance::new(1e-9).expect("positive");
        let bow = |t: f64| Point::new(t, if t.abs() < 0.5 { f64::NAN } else { 1.0 - t * t });
        let bow = PolySegment::fit(bow, -1.0, 1.0, tolerance)[0];
        let back = Segment::Line(bow.end(), bow.start());
        let refused = Outline::new(vec![Segment::Poly(bow), back]).expect_err("no outline");
        assert!(refused.index == 0 && refused.gap.is_nan());
    }
}
