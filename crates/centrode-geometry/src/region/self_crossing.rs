use crate::{
    Point,
    curve::{Bounds, Resolution, Segment, Span},
    numeric::{COMPUTED, POSITION, Tolerance, WRITTEN},
    region::{Outline, loops::Chain},
};

/// Point at which a contour meets itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// Position, mm.
    pub point: Point,
    /// The two segments that meet, the lower index first.
    pub segments: [usize; 2],
}

impl Outline {
    /// Point where the contour crosses or touches itself, or `None` if it is simple.
    ///
    /// The test uses the exact segments with proven bounds, not a polygon. Parts closer than 1e-14 of the size of the outline
    /// count as touching, and loops smaller than 1e-9 of it are rounding. Two parts that leave a joint in one direction touch
    /// unless they separate to one side, judged by their distance at points ever nearer to the joint.
    #[must_use]
    pub fn crossing(&self) -> Option<Crossing> {
        self.crossing_ignoring(0.0, 0.0)
    }

    /// Like [`crossing`](Self::crossing), but ignores small loops and narrow overlaps.
    ///
    /// It ignores loops smaller than `loop_size`, mm, and overlaps at the end of a cusp that are narrower than `band`, mm.
    #[must_use]
    pub fn crossing_ignoring(&self, loop_size: f64, band: f64) -> Option<Crossing> {
        let segments = self.segments().iter();
        let boxes = segments.map(|segment| Span::whole(segment).bounding_box());
        let size = boxes.fold(Bounds::EMPTY, Bounds::union).diagonal();
        // An outline without size has no tolerance, and no crossing.
        let tolerance = Tolerance::new(WRITTEN * size).ok()?;
        let resolution = Resolution {
            size: tolerance.mm(),
            gap: POSITION * size,
            cusp: Some(band),
        };
        let (owners, parts) = self.parts();
        let chain = Chain::new(&parts, tolerance);
        let (point, [i, j]) = chain.meeting(resolution, loop_size.max(COMPUTED * size))?;
        let [i, j] = [owners[i], owners[j]];
        Some(Crossing {
            point,
            segments: [i.min(j), i.max(j)],
        })
    }

    /// The segments that have a length, each with the index of its segment; one or two segments are divided into quarters.
    fn parts(&self) -> (Vec<usize>, Vec<Segment>) {
        let segments = self.segments().iter().enumerate();
        let whole: Vec<_> = segments.filter(|(_, segment)| !segment.is_null()).collect();
        // One or two segments have both their joints in common: quarters of them do not.
        let count = if whole.len() < 3 { 4 } else { 1 };
        let ends = |k: u32| [k, k + 1].map(|k| 2.0 * f64::from(k) / f64::from(count) - 1.0);
        let parts = whole.into_iter().flat_map(|(index, segment)| {
            (0..count).map(move |k| {
                let [from, to] = ends(k);
                (index, segment.part(from, to))
            })
        });
        parts.unzip()
    }
}

#[cfg(test)]
mod tests;
