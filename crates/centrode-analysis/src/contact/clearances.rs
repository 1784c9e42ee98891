//! Least clearances of a contact.

use centrode_geometry::Extreme;

use super::{
    at_angle,
    extremes::{ROUNDING, Search, negative},
    walk::Walk,
};

/// Clearances of tips from roots, and from fillets, by number.
pub(super) const TIP: usize = 0;
const FILLET: usize = 1;

/// A clearance by the greatest nearness; infinite where nothing is as near as `within`.
fn told(nearest: Extreme, within: f64) -> Extreme {
    match nearest.value > -within {
        true => negative(nearest),
        false => Extreme {
            value: f64::INFINITY,
            ..nearest
        },
    }
}

impl Search<'_> {
    /// Least value of a clearance of the samples, from roots or from fillets; infinite where all are.
    pub(super) fn least_clearance(&mut self, which: usize) -> Extreme {
        // Nothing farther apart is looked at.
        let near = self.meshing().near;
        let contact = self.contact;
        let values = [&contact.clearance, &contact.fillet_clearance][which];
        let values: Vec<f64> = values.iter().map(|value| -value.min(near)).collect();
        let between = |search: &mut Self, phi: f64| -search.clearance(which, phi).min(near);
        let samples = (&contact.input[..], &values[..]);
        told(
            self.greatest_among(samples, self.base.half, between, near * ROUNDING),
            near,
        )
    }

    /// A clearance at a driver angle.
    fn clearance(&mut self, which: usize, phi: f64) -> f64 {
        let point = at_angle(self.pair, phi);
        let carries = self.carries;
        let meshing = self.meshing();
        // Without penetration the driven gear stays where flanks that carry the motion have it.
        let at_law = carries.then(|| meshing.gaps_at_law(&point)).flatten();
        at_law.unwrap_or_else(|| {
            let sample = meshing.sample(&point);
            [sample.clearance, sample.fillet_clearance]
        })[which]
    }

    /// Least clearance of an edge from a fillet with the driven gear at the law's angle, where one is known.
    pub(super) fn edges_to_fillets(&mut self, walk: Walk, known: f64) -> Option<Extreme> {
        let walk = match self.base.is_mirrored() {
            true => walk.half(),
            false => walk,
        };
        self.meshing().edges_to_fillets(&walk, known)
    }

    /// Least clearance from a fillet: that of the nearest edge, or what comes nearer and is found among the samples.
    pub(super) fn least_fillet_clearance(
        &mut self,
        edge: Option<Extreme>,
        sampled: f64,
    ) -> Extreme {
        let rounding = self.meshing().near * ROUNDING;
        match edge {
            Some(edge) if edge.value <= sampled + rounding => edge,
            _ => self.least_clearance(FILLET),
        }
    }
}
