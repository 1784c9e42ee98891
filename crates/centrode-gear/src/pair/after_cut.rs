use centrode_geometry::{LoopError, Tolerance, UncutCorner};

use super::GearPair;
use crate::profile::Role;
use crate::rolling::Member;

/// Accuracy of the path of the cut, as a share of the module: far below any kerf, far above the accuracy of outlines.
const PATH: f64 = 1e-8;

/// A pair as it is after both gears are cut out of a plate.
#[derive(Clone, Debug)]
pub struct CutPair {
    /// The pair with the outlines that remain.
    pub pair: GearPair,
    /// Corners of the driver and of the driven gear that the cut does not reach.
    pub uncut: [Vec<UncutCorner>; 2],
}

impl GearPair {
    /// Makes the same pair with another width of the cut, mm: `cut.kerf`.
    #[must_use]
    pub fn with_kerf(&self, kerf: f64) -> Self {
        let mut pair = self.clone();
        pair.planned.design.cut.kerf = kerf;
        pair
    }

    /// The pair after both gears are cut along their outlines by a cut as wide as `cut.kerf`.
    ///
    /// The middle of the cut is half its width outside the outline, so that flanks have their designed form. Corners narrower
    /// than the cut keep material: there its outline is an arc of half its width.
    ///
    /// # Errors
    /// The gear, with [`LoopError`] if the path of the cut cannot be determined.
    pub fn after_cut(&self) -> Result<CutPair, (Member, LoopError)> {
        let mut cut = CutPair {
            pair: self.clone(),
            uncut: [Vec::new(), Vec::new()],
        };
        let radius = 0.5 * self.design().cut.kerf;
        let Ok(tolerance) = Tolerance::new(PATH * self.module()) else {
            return Ok(cut);
        };
        if radius == 0.0 {
            return Ok(cut);
        }
        for (i, member) in Member::ALL.into_iter().enumerate() {
            let gear = self.gear(member);
            let path = gear.outline().cutter_path(radius, tolerance);
            let path = path.map_err(|error| (member, error))?;
            if path.uncut.is_empty() {
                continue;
            }
            let roles = path
                .sources
                .iter()
                .map(|&(source, is_corner)| match is_corner {
                    true => Role::Fillet,
                    false => gear.roles()[source],
                });
            let owners = path
                .sources
                .iter()
                .map(|&(source, _)| gear.owners()[source]);
            let left = gear.with_outline(path.remaining, roles.collect(), owners.collect());
            match member {
                Member::Driver => cut.pair.driver = left,
                Member::Driven => cut.pair.driven = left,
            }
            cut.uncut[i] = path.uncut;
        }
        Ok(cut)
    }
}
