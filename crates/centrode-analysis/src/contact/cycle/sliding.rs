//! Sliding speed of the teeth in contact.

use centrode_gear::{PitchContact, Role};
use centrode_geometry::{Extreme, Vector};

use super::{
    backlash_position::BacklashPosition,
    cycle_samples::{at_angle, period},
    edge_contacts::EdgeContact,
    extremes::{EQUAL_PEAKS, ExtremeSearch, SampledFigure},
};
use crate::contact::contour::GearOutline;
use crate::contact::seat::{
    ContactNormal, FacingFlanks, Meshing, Proximity, ProximityKind, SeatedPose,
};

/// Distance from the end of a contact at which it is sampled, pitches: on the side of the contact in spite of rounding,
/// and so close that the sliding speed is that of the end.
const END_OFFSET: f64 = 2.5e-10;

/// Distance from an edge contact within which the contact ends with the driven gear at its seat, pitches: the edge contact is exact to
/// the first order of the backlash. Ten times less misses ends at a large backlash, ten times more takes another contact for it.
const END_SEARCH: f64 = 1e-2;

/// Minimum drop of the sliding speed at the end of the fastest contact, as a share, and its maximum change within
/// [`END_SEARCH`]. A larger share misses ends, a smaller one takes a normal change for an end.
const SPEED_CHANGE: f64 = 0.05;

/// The part if it belongs to a flank, otherwise the part before it if that one does: a corner is at the start of its part.
fn flank_part(body: &GearOutline<'_>, part: usize) -> Option<usize> {
    let count = body.parts.len();
    let mut parts = [part, (part + count - 1) % count].into_iter();
    parts.find(|&part| body.parts[part].role == Role::Flank)
}

impl Meshing<'_> {
    /// Maximum sliding speed per driver speed, mm/rad, with the driver pushing forward (`sign` 1) or back (-1): of the
    /// flanks that touch as designed or, if none do, of the edges at the seat.
    ///
    /// Flanks that face each other at the law's angle have half the backlash between them. They are followed until they touch.
    pub(super) fn sliding(
        &self,
        proximities: &[Proximity],
        point: &PitchContact,
        sign: f64,
        seat: &SeatedPose,
    ) -> f64 {
        let a = self.pair.center_distance();
        let pose = BacklashPosition::of(self.pair, sign).pose(self.pair, point);
        let near = self.position_tolerance();
        let facing = proximities
            .iter()
            .filter(|p| p.kind == ProximityKind::Flanks && sign * p.points.lever > 0.0);
        let on_flanks = facing.filter_map(|proximity| {
            let (i, j) = proximity.parts;
            let parts = (flank_part(&self.driver, i)?, flank_part(&self.driven, j)?);
            let FacingFlanks { points, .. } =
                self.along_flanks(parts, proximity.points.at, &pose)?;
            let touches = points.is_on_both() && points.gap.abs() < near;
            let contact = ContactNormal {
                point: points.point,
                normal: points.normal,
            };
            touches.then(|| speed(contact, point.input, a))
        });
        let normals = seat.normals.iter();
        let on_edges = normals.map(|&contact| speed(contact, point.input, a));
        let fastest = on_flanks
            .reduce(f64::max)
            .or_else(|| on_edges.reduce(f64::max));
        fastest.map_or(0.0, |speed| speed.max(0.0))
    }
}

impl ExtremeSearch<'_> {
    /// Maximum sliding speed per driver speed, mm/rad. It grows with the distance of a contact from the pitch point, so it is
    /// at the end of a contact, at an edge. While an edge drives, the maximum is that of the samples.
    pub(super) fn max_sliding(&mut self, edges: &[EdgeContact]) -> Extreme {
        let contact = self.contact;
        let mut best = SampledFigure {
            inputs: &contact.input,
            values: &contact.sliding,
        }
        .maximum();
        let (pair, flanks_transmit) = (self.pair, self.flanks_transmit);
        let pitch = period(pair) / f64::from(pair.period());
        // Maximum speed at the ends found so far: slower ends are skipped.
        let mut ended: f64 = 0.0;
        for edge in edges {
            let speed = edge.sliding;
            if speed <= best.value.max(ended) * (1.0 + EQUAL_PEAKS) {
                break;
            }
            let meshing = self.meshing();
            // Gears off their law may touch at any point.
            if flanks_transmit && !meshing.reaches_mate(edge) {
                continue;
            }
            let mut value = |phi: f64| meshing.sample(&at_angle(pair, phi)).loaded[0].sliding;
            let off = if pair.backlash() > 0.0 {
                END_SEARCH
            } else {
                END_OFFSET
            };
            let off = pitch * if edge.begins { off } else { -off };
            let [mut inside, mut outside] = [off, -off].map(|off| edge.at.input + off);
            let [mut found, mut other] = [inside, outside].map(&mut value);
            let is_edge = (found - speed).abs() < SPEED_CHANGE * speed;
            if is_edge && other < found * (1.0 - SPEED_CHANGE) {
                while (inside - outside).abs() > 2.5 * END_OFFSET * pitch {
                    let middle = 0.5 * (inside + outside);
                    let at_middle = value(middle);
                    if at_middle > found * (1.0 - SPEED_CHANGE) {
                        (inside, found) = (middle, at_middle);
                    } else {
                        (outside, other) = (middle, at_middle);
                    }
                }
                ended = ended.max(speed);
            }
            for (phi, value) in [(inside, found), (outside, other)] {
                if value > best.value {
                    let input = phi.rem_euclid(pair.cycle());
                    best = Extreme { input, value };
                }
            }
        }
        best
    }
}

/// Sliding speed in a contact per driver speed, mm/rad, at driver angle `phi` and centre distance `a`.
///
/// Along the normal the gears have no relative speed, which gives the ratio. With the driven gear at its seat within the backlash, or
/// on an edge, the ratio differs from that of the law.
fn speed(contact: ContactNormal, phi: f64, a: f64) -> f64 {
    let ContactNormal { point, normal } = contact;
    let across = |v: Vector| Vector::new(-v.y, v.x);
    let axis = Vector::new(a * phi.cos(), a * phi.sin());
    let [of_axis, of_arm] = [axis, point.coords - axis].map(across);
    let relative = of_axis - of_arm * (of_axis.dot(&normal) / of_arm.dot(&normal));
    relative.perp(&normal).abs()
}
