//! Contours for a CAD kernel, without sides so short that the kernel treats them as points.

use super::StepError;
use centrode_geometry::{Arc, Outline, Point, Segment, Solid};

/// Height over its chord, mm, below which an arc counts as a straight line for a kernel.
const FLAT: f64 = 1e-9;

/// The sides of a solid's contours, the outer one first, each starting exactly where the one before it ends, with the material on
/// its left; sides shorter than `shortest`, mm, are removed and their gaps closed.
pub(super) fn contours(solid: &Solid, shortest: f64) -> Result<Vec<Vec<Segment>>, StepError> {
    let mut all = vec![sides(0, solid.outline(), shortest)?];
    for (hole, outline) in solid.holes().iter().enumerate() {
        all.push(sides(hole + 1, &outline.reversed(), shortest)?);
    }
    Ok(all)
}

fn sides(contour: usize, outline: &Outline, shortest: f64) -> Result<Vec<Segment>, StepError> {
    let finite = |p: Point| p.x.is_finite() && p.y.is_finite();
    let all = outline.segments();
    if !all
        .iter()
        .all(|s| finite(s.start()) && s.length().is_finite())
    {
        return Err(StepError::NotFinite { contour });
    }
    let mut kept: Vec<Segment> = Vec::with_capacity(all.len());
    for segment in all.iter().filter(|s| s.length() >= shortest) {
        let start = kept.last().map_or_else(|| segment.start(), Segment::end);
        kept.push(between(segment, start, segment.end()));
    }
    if let [first, .., last] = kept.as_mut_slice() {
        *last = between(last, last.start(), first.start());
    }
    // A chord there and back bounds nothing; one side alone cannot be closed.
    if kept.len() < 2 || outline.area().abs() < shortest * shortest {
        return Err(StepError::NoRegion { contour });
    }
    Ok(kept)
}

/// Segment with its ends moved to close the gaps of removed sides; a flat arc becomes a line.
fn between(segment: &Segment, start: Point, end: Point) -> Segment {
    match segment {
        Segment::Line(..) => Segment::Line(start, end),
        Segment::Arc(arc) if 0.5 * (arc.bulge * (end - start).norm()).abs() < FLAT => {
            Segment::Line(start, end)
        }
        Segment::Arc(arc) => Segment::Arc(Arc {
            start,
            end,
            bulge: arc.bulge,
        }),
        Segment::Poly(poly) if poly.start() == start && poly.end() == end => *segment,
        Segment::Poly(poly) => Segment::Poly(poly.pinned(start, end)),
    }
}
