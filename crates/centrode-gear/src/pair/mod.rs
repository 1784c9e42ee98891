mod after_cut;
mod cutting;
mod error;
mod follow;
mod gear;
mod housing;
mod planned;

use std::ops::Deref;
use std::sync::Arc;

use centrode_geometry::Recent;

use super::{
    design::{BodySpec, GearPairDesign, Phase},
    flank::{Flank, Side},
    pattern::Patterns,
    rolling::Member,
};

pub use after_cut::CutPair;
pub use error::GearPairError;
pub use gear::Gear;
pub use housing::Housing;
pub use planned::PlannedPair;
pub(super) use planned::parameters;

/// A non-circular gear pair, resolved: the [`PlannedPair`] to which it dereferences, with finished teeth.
#[derive(Clone, Debug)]
pub struct GearPair {
    planned: PlannedPair,
    pub(super) patterns: Patterns,
    driver: Gear,
    driven: Gear,
}

impl Deref for GearPair {
    type Target = PlannedPair;

    fn deref(&self) -> &PlannedPair {
        &self.planned
    }
}

impl GearPair {
    /// Pair of a design, as [`GearPair::resolve`] makes it.
    ///
    /// Cutting takes long. The result is cached, so that teeth are not cut again when other parts of a machine change.
    ///
    /// # Errors
    /// [`GearPairError`], as of [`Self::resolve`].
    pub fn cached(design: &GearPairDesign) -> Result<Arc<Self>, GearPairError> {
        static CUT: Recent<GearPairDesign, Result<Arc<GearPair>, GearPairError>> = Recent::new();
        CUT.get(design, || Self::resolve(design).map(Arc::new))
    }

    /// Rolls the pitch curves, lays out the teeth and cuts both gears.
    ///
    /// # Errors
    /// [`GearPairError`] naming the rule broken and its numbers.
    pub fn resolve(design: &GearPairDesign) -> Result<Self, GearPairError> {
        PlannedPair::new(design)?.cut()
    }

    /// Makes the pair with another body of the driver.
    ///
    /// # Errors
    /// [`GearPairError::Bore`] where its bore cuts into the teeth, [`GearPairError::Spec`] for a bad value.
    pub fn with_driver_body(&self, body: &BodySpec) -> Result<Self, GearPairError> {
        body.validate().map_err(|e| e.inside("driver"))?;
        let mut pair = self.clone();
        pair.planned.design.driver.body = body.clone();
        pair.driver.body = body.clone();
        pair.driver.clears_bore()?;
        Ok(pair)
    }

    /// Makes the pair with all teeth of both gears thinner by a length along the pitch curve (mm), all else unchanged.
    ///
    /// # Errors
    /// [`GearPairError`] where too little of a tooth is left.
    pub fn thinned(&self, by: f64) -> Result<Self, GearPairError> {
        let mut design = self.settled_design();
        design.teeth.phase = Phase::Pitches(self.phase());
        design.teeth.backlash_angle = None;
        // Each gear takes half of the backlash, and that on two flanks.
        design.teeth.backlash = self.backlash() + 2.0 * by * self.pressure_angle().cos();
        Self::resolve(&design)
    }

    /// The gear that is turned.
    #[must_use]
    pub fn driver(&self) -> &Gear {
        &self.driver
    }

    /// The gear that is driven.
    #[must_use]
    pub fn driven(&self) -> &Gear {
        &self.driven
    }

    /// Either gear.
    #[must_use]
    pub fn gear(&self, member: Member) -> &Gear {
        match member {
            Member::Driver => &self.driver,
            Member::Driven => &self.driven,
        }
    }

    /// Distances of the flank of a tooth's side from the gear's axis, mm: where the flank begins above the root, and where it
    /// ends at the tip. `None` where undercut leaves no flank, or there is no such tooth.
    #[must_use]
    pub fn flank_radii(&self, member: Member, tooth: usize, side: Side) -> Option<[f64; 2]> {
        let tooth = self.gear(member).teeth().get(tooth)?;
        let made = match side {
            Side::Leading => tooth.leading,
            Side::Trailing => tooth.trailing,
        };
        let (low, high) = made.active?;
        let flank = Flank {
            rolling: self.rolling(),
            member,
            tool: &self.operating_tool(member),
            side,
            crossing: made.crossing,
        };
        let radius = |arc: f64| flank.point(self.rolling().parameter(arc)).coords.norm();
        // The leading flank rises with the arc length of roll, the trailing one falls.
        Some(match side {
            Side::Leading => [radius(low), radius(high)],
            Side::Trailing => [radius(high), radius(low)],
        })
    }

    /// Number of equal parts of a turn after which a gear's teeth repeat, as far as the form of the pitch curve shows: the tooth
    /// count for round gears, 1 for a gear without such a symmetry.
    #[must_use]
    pub fn repeats(&self, member: Member) -> u32 {
        self.patterns.of(member).repeats()
    }
}
