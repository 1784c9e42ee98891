//! Minimum clearances of tips from roots and from fillets.

use centrode_gear::PitchContact;
use centrode_geometry::{Extreme, checkpoint};

use super::{
    backlash_position::BacklashPosition,
    cycle_samples::at_angle,
    extremes::{ANGLE_ROUNDING, ExtremeSearch, SampledFigure, negated},
    pose_sampling::PoseSampling,
};
use crate::contact::seat::{Meshing, Proximity, ProximityKind, ROUNDED};

/// Feature of the mate from which the clearance of a tip is measured.
#[derive(Clone, Copy, Debug)]
pub(super) enum ClearanceFrom {
    Root,
    Fillet,
}

/// Minimum clearances of tips in one pose, mm; infinite if nothing is near.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Clearances {
    pub(in crate::contact) root: f64,
    pub(in crate::contact) fillet: f64,
}

impl Clearances {
    /// Clearances from all points that face each other, and the depth to which the driver penetrates the core of the driven gear.
    pub(super) fn new(proximities: &[Proximity], core_penetration: f64) -> Self {
        let minimum = |kind: ProximityKind| {
            let of_kind = proximities.iter().filter(|p| p.kind == kind);
            of_kind.map(|p| p.points.gap).fold(f64::INFINITY, f64::min)
        };
        let root = minimum(ProximityKind::TipAndRoot);
        Self {
            root: if core_penetration > 0.0 {
                root.min(-core_penetration)
            } else {
                root
            },
            fillet: minimum(ProximityKind::Fillet),
        }
    }

    fn get(self, from: ClearanceFrom) -> f64 {
        match from {
            ClearanceFrom::Root => self.root,
            ClearanceFrom::Fillet => self.fillet,
        }
    }
}

impl ExtremeSearch<'_> {
    /// Minimum clearance from roots or from fillets, mm; infinite if nothing is within the search distance.
    pub(super) fn min_clearance(&mut self, from: ClearanceFrom) -> Extreme {
        let near = self.meshing().search_distance;
        let contact = self.contact;
        let values = match from {
            ClearanceFrom::Root => &contact.clearance,
            ClearanceFrom::Fillet => &contact.fillet_clearance,
        };
        let values: Vec<f64> = values.iter().map(|value| -value.min(near)).collect();
        let between = |search: &mut Self, phi: f64| -search.clearance(from, phi).min(near);
        let samples = SampledFigure {
            inputs: &contact.input,
            values: &values,
        };
        let nearest = self.maximum_among(samples, self.base.half, between, near * ANGLE_ROUNDING);
        match nearest.value > -near {
            true => negated(nearest),
            false => Extreme {
                value: f64::INFINITY,
                ..nearest
            },
        }
    }

    /// A clearance at a driver angle, mm.
    fn clearance(&mut self, from: ClearanceFrom, phi: f64) -> f64 {
        let point = at_angle(self.pair, phi);
        let flanks_transmit = self.flanks_transmit;
        let meshing = self.meshing();
        // Flanks that transmit the motion hold the driven gear at the law's angle, unless something penetrates there.
        let at_law = flanks_transmit
            .then(|| meshing.clearances_at_law(&point))
            .flatten();
        let clearances = at_law.unwrap_or_else(|| {
            let sample = meshing.sample(&point);
            Clearances {
                root: sample.clearance,
                fillet: sample.fillet_clearance,
            }
        });
        clearances.get(from)
    }

    /// Minimum clearance of an edge from a fillet in the sampled poses, if below a known one of `known` mm.
    pub(super) fn edges_to_fillets(
        &mut self,
        sampling: PoseSampling,
        known: f64,
    ) -> Option<Extreme> {
        let sampling = match self.base.is_mirrored() {
            true => sampling.half(),
            false => sampling,
        };
        self.meshing().edges_to_fillets(&sampling, known)
    }

    /// Minimum clearance from a fillet: that of the nearest edge, or a smaller one found from the samples.
    pub(super) fn min_fillet_clearance(&mut self, edge: Option<Extreme>, sampled: f64) -> Extreme {
        let rounding = self.meshing().search_distance * ANGLE_ROUNDING;
        match edge {
            Some(edge) if edge.value <= sampled + rounding => edge,
            _ => self.min_clearance(ClearanceFrom::Fillet),
        }
    }
}

impl Meshing<'_> {
    /// Clearances with the driven gear at the law's angle, without a search for seats; `None` if the gears penetrate each other there.
    pub(in crate::contact) fn clearances_at_law(
        &mut self,
        point: &PitchContact,
    ) -> Option<Clearances> {
        checkpoint();
        let pose = BacklashPosition::AtLaw.pose(self.pair, point);
        let mut candidates = self.candidates(&pose);
        let proximities = self.proximities(&mut candidates, &pose);
        let rounded = -ROUNDED * self.module;
        let is_free = candidates.core_penetration <= 0.0
            && proximities.iter().all(|p| p.points.gap >= rounded);
        is_free.then(|| Clearances::new(&proximities, candidates.core_penetration))
    }
}
