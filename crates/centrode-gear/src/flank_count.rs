use std::f64::consts::PI;

use super::{
    GearPairError,
    design::{Addendum, GearPairDesign},
    flank::{Flank, Side},
    pair::parameters,
    profile::{FlankPlan, Top},
    rolling::{Member, Rolling},
    teeth::{Counts, TeethParameters, layout},
    tool::Tool,
};

/// Flank count of a gear with every tooth cut to the tool's full height: all, undercut and short ones.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub struct FlankCount {
    /// Flanks of the gear, two per tooth.
    pub flanks: u32,
    /// Flanks that undercut shortens.
    pub undercut: u32,
    /// Flanks that cannot be cut up to the full addendum.
    pub short: u32,
    /// Flanks that are either or both.
    pub unsound: u32,
}

impl FlankCount {
    /// Counts the flanks of both members of a pair without cutting its teeth; the addendum is taken as full whatever
    /// is written.
    ///
    /// A flank is undercut if its speed of generation falls to zero below the crossing, before the end of the tool's straight
    /// side. It is short if it does not reach the addendum, or reaches it only beyond the roll that the tool can generate.
    ///
    /// # Errors
    /// [`GearPairError`] where the driver has no tooth count, or no teeth can be laid out.
    pub fn new(design: &GearPairDesign, rolling: &Rolling) -> Result<[Self; 2], GearPairError> {
        let driver = design
            .driver_tooth_count()
            .ok_or(GearPairError::NoToothCount)?;
        let (n1, n2) = rolling.mean_ratio();
        let counts = Counts {
            driver,
            driven: (f64::from(driver) * f64::from(n1) / f64::from(n2)).round() as u32,
        };
        let module = rolling.pitch_length(Member::Driver) / (PI * f64::from(driver));
        let teeth = TeethParameters {
            addendum: Addendum::Full,
            ..parameters(design, module)
        };
        let plan = layout(rolling, &counts, &teeth)?;
        let count = |member: Member, plans: &[super::profile::ToothPlan]| {
            let mut found = Self::default();
            for tooth in plans {
                for (side, plan) in [
                    (Side::Leading, tooth.leading),
                    (Side::Trailing, tooth.trailing),
                ] {
                    found.add(rolling, member, teeth.tool(member), side, &plan);
                }
            }
            found
        };
        Ok([
            count(Member::Driver, &plan.driver),
            count(Member::Driven, &plan.driven),
        ])
    }

    fn add(
        &mut self,
        rolling: &Rolling,
        member: Member,
        tool: &Tool,
        side: Side,
        plan: &FlankPlan,
    ) {
        let flank = Flank {
            rolling,
            member,
            tool,
            side,
            crossing: plan.crossing,
        };
        let start = rolling.parameter(plan.crossing);
        let below = rolling.parameter(plan.crossing + side.sign() * plan.corner.end);
        let undercut = flank.slower(0.0, start, below).is_some();
        let short = match plan.top {
            Top::Reach(_) => false,
            Top::Height(height) => flank.at_height(height).is_none_or(|(tip, _)| {
                (rolling.arc_length(tip) - plan.crossing).abs() > tool.addendum_reach()
            }),
        };
        self.flanks += 1;
        self.undercut += u32::from(undercut);
        self.short += u32::from(short);
        self.unsound += u32::from(undercut || short);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pitch::{Circle, Ellipse, PitchSpec};
    use crate::{GearPair, Limits};

    fn counted(pitch: PitchSpec) -> (GearPair, Limits, [FlankCount; 2]) {
        let design = GearPairDesign::new(pitch);
        let pair = GearPair::resolve(&design).expect("a pair");
        let sound = FlankCount::new(&design, pair.rolling()).expect("teeth");
        let limits = pair.limits();
        (pair, limits, sound)
    }

    #[test]
    fn a_circle_is_undercut_below_its_least_tooth_count() {
        // Undercut where z/2 sin^2 alpha < the depth of the straight flank, 1 in modules for ISO 53 A: z < 17.1.
        for (teeth, undercut) in [(16, 32), (17, 34), (18, 0), (40, 0)] {
            let circle = PitchSpec::Circle(Circle {
                module: Some(2.0),
                tooth_count: Some(teeth),
                ..Circle::default()
            });
            let [driver, driven] = counted(circle).2;
            assert_eq!(
                (driver.undercut, driven.undercut),
                (undercut, undercut),
                "{teeth}"
            );
            assert_eq!((driver.flanks, driver.short), (2 * teeth, 0));
        }
    }

    #[test]
    fn the_counts_are_those_of_the_cut_teeth() {
        for eccentricity in [0.2, 0.45, 0.6] {
            let ellipse = PitchSpec::Ellipse(Ellipse {
                eccentricity,
                module: Some(2.0),
                tooth_count: Some(25),
                ..Ellipse::default()
            });
            let (pair, limits, sound) = counted(ellipse);
            for (member, sound) in [Member::Driver, Member::Driven].into_iter().zip(sound) {
                let sides = pair
                    .gear(member)
                    .teeth()
                    .iter()
                    .flat_map(|t| [t.leading, t.trailing]);
                let undercut = sides.clone().filter(|s| s.undercut > 0.0).count();
                let short = sides.filter(|s| s.tip_shortening > 0.0).count();
                assert_eq!(
                    (sound.undercut, sound.short),
                    (undercut as u32, short as u32)
                );
            }
            let none = sound.iter().all(|s| s.unsound == 0);
            assert!(none || limits.largest_module < 2.0, "{eccentricity}");
        }
    }
}
