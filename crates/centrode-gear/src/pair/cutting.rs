use centrode_geometry::{Tolerance, run_both};

use super::{Gear, GearPairError};
use crate::design::BodySpec;
use crate::flank::Side;
use crate::generation::Generation;
use crate::pattern::{Mating, Patterns};
use crate::profile::{Cutter, Profile, ProfileError};
use crate::rolling::{Member, Rolling};
use crate::teeth::Layout;
use crate::tool::Tool;

/// Data from which both gears of a pair are cut.
pub(super) struct Cutting<'a> {
    /// Pitch curves of the pair.
    pub(super) rolling: &'a Rolling,
    pub(super) generation: &'a Generation,
    /// Tools of driver and driven gear.
    pub(super) tools: &'a [Tool; 2],
    pub(super) plan: &'a Layout,
    pub(super) patterns: &'a Patterns,
    /// Bodies of the driver and the driven gear.
    pub(super) bodies: [&'a BodySpec; 2],
    pub(super) tolerance: Tolerance,
}

impl Cutting<'_> {
    /// Driver and driven gear: the driven gear is made from the driver if they have the same form, else two threads cut them.
    pub(super) fn gears(&self) -> Result<[Gear; 2], GearPairError> {
        let [driver, driven] = [Member::Driver, Member::Driven];
        if let Some(mating) = Mating::new(&self.generation.rolling, self.plan) {
            let profile = self.cut(driver)?;
            let mate = profile.mated(&mating, &self.plan.driven)?;
            return Ok([self.gear(driver, profile)?, self.gear(driven, mate)?]);
        }
        let made = |member| Ok(self.gear(member, self.cut(member)?));
        let (one, two): (Result<_, ProfileError>, Result<_, ProfileError>) =
            run_both(|| made(driver), || made(driven));
        // Teeth that cannot be cut are reported before bodies that do not fit them.
        let (one, two) = (one?, two?);
        Ok([one?, two?])
    }

    fn cut(&self, member: Member) -> Result<Profile, ProfileError> {
        let cutter = Cutter {
            rolling: &self.generation.rolling,
            member,
            tool: &self.tools[member as usize],
            pattern: self.patterns.of(member),
            tolerance: self.tolerance,
        };
        cutter.cut(match member {
            Member::Driver => &self.plan.driver,
            Member::Driven => &self.plan.driven,
        })
    }

    fn gear(&self, member: Member, mut profile: Profile) -> Result<Gear, GearPairError> {
        let mounted = |side, made| self.generation.mounted(member, side, made);
        for tooth in &mut profile.teeth {
            tooth.leading = mounted(Side::Leading, tooth.leading);
            tooth.trailing = mounted(Side::Trailing, tooth.trailing);
        }
        let body = self.bodies[member as usize].clone();
        Gear::new(self.rolling, member, profile, body, self.tolerance)
    }
}
