use centrode_geometry::{
    Outline, PolySegment, Segment, SegmentRange, bracketed_minimum, checkpoint,
};

use super::{Cutter, Member, Profile, ProfileError, Role, Side, Tooth, ToothCurve};

impl Cutter<'_> {
    /// Joins the remaining parts of the pieces into the contour, and records what remains of the flanks of each tooth.
    pub(super) fn join(
        &self,
        pieces: &[ToothCurve],
        kept: &[SegmentRange],
        mut teeth: Vec<Tooth>,
    ) -> Result<Profile, ProfileError> {
        let mut polys: Vec<PolySegment> = kept
            .iter()
            .map(|k| pieces[k.index].poly.part(k.from, k.to))
            .collect();
        let pitch = self.rolling.pitch_length(self.member) / teeth.len() as f64;
        let count = polys.len();
        for i in 0..count {
            checkpoint();
            let end = polys[i].end();
            let next = (i + 1) % count;
            if polys[next].start() != end {
                polys[next] = polys[next].pinned(end, polys[next].end());
            }
        }
        let mut roles = Vec::with_capacity(count);
        let mut owners = Vec::with_capacity(count);
        for (k, poly) in kept.iter().zip(&polys) {
            let piece = &pieces[k.index];
            roles.push(piece.role);
            owners.push(piece.tooth);
            let tooth = &mut teeth[piece.tooth as usize];
            let side = match piece.side {
                Side::Leading => &mut tooth.leading,
                Side::Trailing => &mut tooth.trailing,
            };
            match piece.role {
                Role::Flank => {
                    let (t0, t1) = piece.span;
                    let at = |u: f64| {
                        let arc = self.rolling.arc_length(t0 + 0.5 * (1.0 + u) * (t1 - t0));
                        piece.image.map_or(arc, |image| image.arc(arc, pitch))
                    };
                    let (a, b) = (at(k.from), at(k.to));
                    let (low, high) = side.active.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
                    side.active = Some((low.min(a).min(b), high.max(a).max(b)));
                }
                Role::Fillet => {
                    side.fillet_radius = side.fillet_radius.min(minimum_radius(poly));
                }
                Role::Tip => {
                    tooth.cut_through = false;
                    tooth.tip_width += poly.chord_length(8);
                }
                Role::Root => {}
            }
        }
        for tooth in &mut teeth {
            tooth.cut_through = tooth.cut_through
                && tooth.leading.active.is_none()
                && tooth.trailing.active.is_none();
            for (side, sign) in [(&mut tooth.leading, -1.0), (&mut tooth.trailing, 1.0)] {
                let left = side.active.map_or(0.0, |(low, high)| {
                    if sign > 0.0 {
                        high - side.crossing
                    } else {
                        side.crossing - low
                    }
                });
                let lost = side.active_depth - left;
                // A loss within the rounding of a crossing is not undercut.
                side.undercut = if lost > 1e-7 * side.active_depth {
                    lost
                } else {
                    0.0
                };
            }
        }
        let mut segments: Vec<Segment> = polys.into_iter().map(Segment::Poly).collect();
        if self.member == Member::Driven {
            // The driven gear is rolled clockwise: its contour is reversed.
            segments = segments.iter().rev().map(Segment::reversed).collect();
            roles.reverse();
            owners.reverse();
        }
        Ok(Profile {
            outline: Outline::new(segments)?,
            roles,
            owners,
            teeth,
        })
    }
}

/// Minimum radius of curvature of a segment, mm.
fn minimum_radius(poly: &PolySegment) -> f64 {
    /// Number of steps of the parameter. Fewer can miss a minimum between two samples, more take longer.
    const STEPS: usize = 4;
    let radius = |u: f64| {
        let jet = poly.at(u);
        jet.first.norm().powi(3) / jet.first.perp(&jet.second).abs()
    };
    let at = |i: usize| -1.0 + 2.0 * i as f64 / STEPS as f64;
    let samples: [f64; STEPS + 1] = std::array::from_fn(|i| radius(at(i)));
    let dips = (1..STEPS).filter(|&i| samples[i] <= samples[i - 1].min(samples[i + 1]));
    let inside = dips.map(|i| bracketed_minimum(radius, at(i - 1), at(i + 1)).1);
    inside.chain(samples).fold(f64::INFINITY, f64::min)
}
