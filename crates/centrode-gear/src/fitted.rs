//! Addenda trimmed flank by flank to the height at which the teeth can mesh on these pitch curves.

use std::collections::HashSet;

use centrode_geometry::{Disc, bracketed_root, checkpoint, parallel_map};

use super::{
    flank::{Flank, Side},
    pattern::Patterns,
    pitch::gcd,
    profile::{FlankPlan, ToothPlan, Top},
    rolling::{Member, Rolling},
    tool::Tool,
    tooth_chords::circle,
    tooth_passage::{Candidate, Poses, Reaches, ToothPassage},
};

/// Minimum share of a straight rack's flank speed at the end of a trimmed flank: below it the flank ends in a knife
/// edge whose radius of curvature is zero. A larger value makes teeth shorter than necessary.
const MIN_SPEED: f64 = 0.05;

/// Data of the trimming.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fitting<'a> {
    pub(crate) rolling: &'a Rolling,
    /// Tools of driver and driven gear.
    pub(crate) tools: &'a [Tool; 2],
    pub(crate) minimum_tip_width: f64,
}

/// Number of driver teeth whose passages are computed at a time. It trades memory for an even load of the cores; the
/// result does not depend on it.
const BLOCK: usize = 32;

/// Passage of a driver tooth and a driven tooth, by their numbers, with the crossings of their flanks.
struct Meeting<'a> {
    passage: ToothPassage<'a>,
    teeth: [usize; 2],
    crossings: [[f64; 2]; 2],
}

impl Meeting<'_> {
    /// Both teeth. Each flank is needed down to the depth that the tips of its mate reach.
    fn candidates(&self, [driver, driven]: [Reaches; 2]) -> [Candidate; 2] {
        let candidate = |member, reaches, mates: Reaches| Candidate {
            member,
            crossings: self.crossings[member as usize],
            reaches,
            depths: [mates[1], mates[0]],
        };
        [
            candidate(Member::Driver, driver, driven),
            candidate(Member::Driven, driven, driver),
        ]
    }
}

/// Roll length to a tip corner, and its normal height.
pub(super) type Tip = (f64, f64);

impl Fitting<'_> {
    /// Trims every tip of both gears and fits every space to the tips that enter it.
    ///
    /// A tip is as high as both flanks stay regular, as mating flanks stay clear of each other away from their contact, and as
    /// the top land stays wide enough. Teeth that are copies of others, turned, get the same heights.
    pub(crate) fn fit(
        &self,
        all: [&mut [ToothPlan]; 2],
        patterns: &Patterns,
        pitch: f64,
        space: impl Fn(Member) -> f64,
    ) {
        let [all_1, all_2] = all;
        let counts = [all_1.len(), all_2.len()];
        let meshes = patterns.period();
        let driver = patterns.driver.first(all_1);
        let driven = patterns.driven.first(all_2);
        let reaches = |member: Member, teeth: &[ToothPlan]| -> Vec<Reaches> {
            let reach = |plan: &FlankPlan, side| self.regular(member, side, plan);
            parallel_map(teeth, |t| {
                [
                    reach(&t.leading, Side::Leading),
                    reach(&t.trailing, Side::Trailing),
                ]
            })
        };
        let mut reach_1 = reaches(Member::Driver, driver);
        let mut reach_2 = reaches(Member::Driven, driven);
        let (first, last) = (driver.len(), driven.len());
        let length = |member: Member, teeth: usize| {
            let share = teeth as f64 / counts[member as usize] as f64;
            self.rolling.pitch_length(member) * share
        };
        let lengths = [length(Member::Driver, first), length(Member::Driven, last)];
        let crossings = |tooth: &ToothPlan, turns: f64| {
            [
                tooth.leading.crossing + turns,
                tooth.trailing.crossing + turns,
            ]
        };
        let circles = self.circles([(driver, &reach_1), (driven, &reach_2)]);
        let circle = |member: Member, tooth: isize| {
            let count = counts[member as usize] as isize;
            let circles = &circles[member as usize];
            let place = tooth.rem_euclid(count) as usize;
            let Disc { center, radius } = circles[place % circles.len()];
            let center = patterns.of(member).turn(place) * center;
            Disc { center, radius }
        };
        let middle = 0.5 * (driver[0].leading.crossing + driver[0].trailing.crossing);
        let mut poses = Poses::new(self.rolling, middle + 0.25 * pitch, pitch);
        // Crossings of driver tooth k, and of a driven tooth next to it, with the numbers of both.
        let pair = |k: usize, beside: isize| {
            let i = k % first;
            let one = crossings(&driver[i], (k / first) as f64 * lengths[0]);
            let index = k as isize + beside;
            let j = index.rem_euclid(last as isize) as usize;
            let turns = index.div_euclid(last as isize) as f64;
            ([i, j], [one, crossings(&driven[j], turns * lengths[1])])
        };
        let middle = |[one, two]: [[f64; 2]; 2]| 0.25 * (one[0] + one[1] + two[0] + two[1]);
        // The two driven teeth next to the driver tooth mesh with it. Those beyond can still touch it where the pitch curve is
        // concave.
        const NEIGHBOURS: [isize; 8] = [-4, -3, -2, -1, 0, 1, 2, 3];
        let cycle = counts[0] / gcd(counts[0] as u32, counts[1] as u32) as usize * counts[1];
        let mut changed = 0;
        for from in (0..cycle).step_by(BLOCK) {
            // What all teeth have met without a change, they meet for ever.
            if from >= changed + meshes as usize {
                break;
            }
            let mut met = Vec::new();
            let to = cycle.min(from + BLOCK);
            poses.find(
                [(from, NEIGHBOURS[0]), (to - 1, NEIGHBOURS[7])]
                    .map(|(k, by)| middle(pair(k, by).1)),
            );
            for (k, by) in (from..to).flat_map(|k| NEIGHBOURS.map(|by| (k, by))) {
                checkpoint();
                let ([i, j], crossings) = pair(k, by);
                let passage = ToothPassage::about(
                    &mut poses,
                    self.tools,
                    middle(crossings),
                    pitch,
                    [
                        &circle(Member::Driver, k as isize),
                        &circle(Member::Driven, k as isize + by),
                    ],
                );
                met.extend(passage.map(|passage| Meeting {
                    passage,
                    teeth: [i, j],
                    crossings,
                }));
            }
            let known = |[i, j]: [usize; 2]| [reach_1[i], reach_2[j]];
            let are_foul = parallel_map(&met, |meeting| {
                let teeth = meeting.candidates(known(meeting.teeth));
                meeting.passage.is_foul(&teeth)
            });
            // Teeth that are clear stay so when they are shortened.
            let mut left: Vec<&Meeting> = (met.iter().zip(are_foul))
                .filter_map(|(meeting, is_foul)| is_foul.then_some(meeting))
                .collect();
            while !left.is_empty() {
                // Meetings without a common tooth are cleared in parallel.
                let mut busy = HashSet::new();
                let (first, later): (Vec<&Meeting>, _) = left.into_iter().partition(|meeting| {
                    let [driver, driven] = meeting.teeth;
                    // Both teeth are busy from here on, even if one of them was busy before.
                    let is_free = [(Member::Driver, driver), (Member::Driven, driven)]
                        .map(|tooth| busy.insert(tooth));
                    is_free == [true, true]
                });
                left = later;
                let known = |[i, j]: [usize; 2]| [reach_1[i], reach_2[j]];
                let cleared = parallel_map(&first, |meeting| {
                    let teeth = meeting.candidates(known(meeting.teeth));
                    meeting.passage.clear(&teeth)
                });
                for (meeting, cleared) in first.iter().zip(cleared) {
                    let [i, j] = meeting.teeth;
                    if cleared != [reach_1[i], reach_2[j]] {
                        changed = to;
                    }
                    [reach_1[i], reach_2[j]] = cleared;
                }
            }
        }
        let settled = |member: Member, teeth: &mut [ToothPlan], mut reaches: Vec<Reaches>| {
            let tips = self.tops(member, teeth, &reaches);
            match self.level(member, &tips, &mut reaches, space(member.mate())) {
                true => self.tops(member, teeth, &reaches),
                false => tips,
            }
        };
        let tips_1 = settled(Member::Driver, driver, reach_1);
        let tips_2 = settled(Member::Driven, driven, reach_2);
        let meshes = meshes as usize;
        let (one, two) = (Member::Driver, Member::Driven);
        self.serve(one, driver, &tips_2, meshes, lengths[0], space(one));
        self.serve(two, driven, &tips_1, meshes, lengths[1], space(two));
        patterns.driver.repeat(all_1, pitch);
        patterns.driven.repeat(all_2, pitch);
    }

    /// Circles around the teeth of both gears before any is trimmed, as deep as any mate reaches.
    fn circles(&self, gears: [(&[ToothPlan], &[Reaches]); 2]) -> [Vec<Disc>; 2] {
        [Member::Driver, Member::Driven].map(|member| {
            let (teeth, reaches) = gears[member as usize];
            let mates = gears[member.mate() as usize].1.iter().flatten();
            let depth = mates.copied().fold(0.0, f64::max);
            let around = |(tooth, &reaches): (&ToothPlan, &Reaches)| {
                let candidate = Candidate {
                    member,
                    crossings: [tooth.leading.crossing, tooth.trailing.crossing],
                    reaches,
                    depths: [depth; 2],
                };
                circle(self.rolling, self.tools, &candidate)
            };
            teeth.iter().zip(reaches).map(around).collect()
        })
    }

    /// Shortens the higher flank of teeth whose tip is so oblique that no root of one depth has room for both sides. Returns
    /// whether there are any.
    ///
    /// Where that depth would cut into the flank that the lower side works on, the root has a step. The tip moves to and fro
    /// above this step. It is clear at every position if its higher side would also be clear of the root that the lower side
    /// needs.
    fn level(
        &self,
        member: Member,
        tips: &[[Tip; 2]],
        reaches: &mut [Reaches],
        space: f64,
    ) -> bool {
        let mate = member.mate();
        let clearance = self.clearance(mate);
        let mut any = false;
        for (tip, reach) in tips.iter().zip(reaches) {
            for (low, high) in [(0, 1), (1, 0)] {
                let most = tip[low].1 + clearance;
                let shared = || self.corner_below(mate, tip[high].1 + clearance, tip[low], space);
                if tip[high].1 > most && shared().is_none() {
                    reach[high] = tip[high].0 * (most / tip[high].1);
                    any = true;
                }
            }
        }
        any
    }

    pub(super) fn tool(&self, member: Member) -> &Tool {
        &self.tools[member as usize]
    }

    /// Clearance between the root of a member and the tip of its mate, mm.
    pub(super) fn clearance(&self, member: Member) -> f64 {
        (self.tool(member).dedendum - self.tool(member.mate()).addendum).max(0.0)
    }

    pub(super) fn flank(&self, member: Member, side: Side, crossing: f64) -> Flank<'_> {
        Flank {
            rolling: self.rolling,
            member,
            tool: self.tool(member),
            side,
            crossing,
        }
    }

    /// Roll length up to which a flank and its mate are both regular, at most that of its full height.
    fn regular(&self, member: Member, side: Side, plan: &FlankPlan) -> f64 {
        let Top::Height(height) = plan.top else {
            return 0.0;
        };
        let flank = self.flank(member, side, plan.crossing);
        // A full tooth has its full height, exactly.
        let end = flank
            .at_height(height)
            .map_or_else(|| flank.farthest(height), |(t, _)| t);
        let rolled = side.sign() * (flank.crossing - self.rolling.arc_length(end));
        reach(&flank, rolled.max(0.0))
    }

    /// Final tips of the teeth of a gear, with top lands of at least the minimum width.
    fn tops(&self, member: Member, teeth: &mut [ToothPlan], reaches: &[Reaches]) -> Vec<[Tip; 2]> {
        let known: Vec<_> = teeth.iter().zip(reaches).collect();
        let found = parallel_map(
            &known,
            |&(tooth, &[lead, trail]): &(&ToothPlan, &[f64; 2])| {
                let leading = self.flank(member, Side::Leading, tooth.leading.crossing);
                let trailing = self.flank(member, Side::Trailing, tooth.trailing.crossing);
                let flanks = [&leading, &trailing];
                let share = share_for_width(flanks, [lead, trail], self.minimum_tip_width);
                let (lead, trail) = (share * lead, share * trail);
                let tip = |flank: &Flank<'_>, reach: f64| {
                    let t = self
                        .rolling
                        .parameter(flank.crossing - flank.side.sign() * reach);
                    (reach, flank.foot(t).1)
                };
                [tip(&leading, lead), tip(&trailing, trail)]
            },
        );
        for (tooth, tips) in teeth.iter_mut().zip(&found) {
            tooth.leading.top = Top::Reach(tips[0].0);
            tooth.trailing.top = Top::Reach(tips[1].0);
        }
        found
    }
}

/// Roll length, in arc, up to which a flank can work above the pitch curve together with its mate, at most `limit`.
///
/// At a roll v above the crossing both flanks are regular while sin alpha + kappa v cos alpha (its own
/// curvature) and sin alpha - kappa v cos alpha (its mate's) are positive.
fn reach(flank: &Flank<'_>, limit: f64) -> f64 {
    /// Number of steps of the roll length. Fewer can step over a short part without contact, more take longer.
    const STEPS: u32 = 48;
    let (sin, cos) = flank.tool.pressure_angle.sin_cos();
    let (rolling, mate) = (flank.rolling, flank.member.mate());
    let margin = |v: f64| {
        let t = rolling.parameter(flank.crossing - flank.side.sign() * v);
        let own = sin + rolling.frame(flank.member, t).curvature * v * cos;
        let other = sin - rolling.frame(mate, t).curvature * v * cos;
        own.min(other) - MIN_SPEED * sin
    };
    let limit = limit.min(flank.tool.addendum_reach());
    let mut before = (0.0, sin * (1.0 - MIN_SPEED));
    for i in 1..=STEPS {
        let v = limit * f64::from(i) / f64::from(STEPS);
        let value = margin(v);
        if value <= 0.0 {
            return bracketed_root(margin, before.0, v, before.1, value);
        }
        before = (v, value);
    }
    limit
}

/// Share of both roll lengths at which the top land of a tooth is still at least `width` wide.
fn share_for_width(flanks: [&Flank<'_>; 2], reaches: Reaches, width: f64) -> f64 {
    let [leading, trailing] = flanks;
    let land = |share: f64| {
        let tip = |flank: &Flank<'_>| {
            let arc = flank.crossing - flank.side.sign() * share * reaches[flank.side as usize];
            flank.point(flank.rolling.parameter(arc))
        };
        let (a, b) = (tip(leading), tip(trailing));
        let middle = 0.5 * (leading.crossing + trailing.crossing);
        let frame = leading.frame(leading.rolling.parameter(middle));
        (b - a).dot(&frame.tangent) - width
    };
    let (low, high) = (land(0.0), land(1.0));
    if high >= 0.0 {
        1.0
    } else if low <= 0.0 {
        0.0
    } else {
        bracketed_root(land, 0.0, 1.0, low, high)
    }
}
