mod copy;
mod error;
mod join;
mod swing;
mod tooth;

use std::ops::Range;

use centrode_geometry::{
    FittedSpan, LoopError, Outline, Point, PolySegment, Segment, SegmentRange, Tolerance,
    checkpoint, without_loops,
};

pub use error::ProfileError;
pub(crate) use tooth::{FlankPlan, ToothPlan, Top};
pub use tooth::{Role, Tooth, ToothSide};

use copy::copy;
use swing::Swing;

use super::{
    flank::{Flank, Side},
    pattern::{Image, Pattern},
    rolling::{Member, Rolling},
    tool::{Corner, Tool},
};

/// Profile of one gear: its outline, the role of each segment of it, and its teeth.
#[derive(Clone, Debug)]
pub(crate) struct Profile {
    pub(crate) outline: Outline,
    pub(crate) roles: Vec<Role>,
    pub(crate) owners: Vec<u32>,
    pub(crate) teeth: Vec<Tooth>,
}

#[derive(Clone)]
struct ToothCurve {
    poly: PolySegment,
    role: Role,
    tooth: u32,
    /// Pitch-curve parameters at the ends.
    span: (f64, f64),
    side: Side,
    /// Image by which it was copied from the piece with this span; `None` if it was not copied.
    image: Option<Image>,
}

/// Minimum generation speed, relative to a straight rack, of a flank that cannot reach the required height: the flank ends where
/// its speed falls below this. Nearer to the singular point the flank turns back on itself. A larger value gives shorter teeth.
const MIN_TIP_SPEED: f64 = 0.02;

/// Relative difference below which two parameters are equal: rounding. Pieces of this length are omitted.
const CRUMB: f64 = 1e-14;

/// Tip and ends of one flank, as computed.
struct Ends {
    /// Parameter at the tip corner.
    tip: f64,
    /// Foot of the normal through the tip corner.
    foot: f64,
    height: f64,
    tip_shortening: f64,
}

pub(crate) struct Cutter<'a> {
    pub(crate) rolling: &'a Rolling,
    pub(crate) member: Member,
    pub(crate) tool: &'a Tool,
    /// Teeth that are copies of others.
    pub(crate) pattern: Pattern,
    pub(crate) tolerance: Tolerance,
}

impl Cutter<'_> {
    fn flank(&self, plan: &FlankPlan, side: Side) -> Flank<'_> {
        Flank {
            rolling: self.rolling,
            member: self.member,
            tool: self.tool,
            side,
            crossing: plan.crossing,
        }
    }

    /// Cuts every tooth and joins them into one contour.
    pub(crate) fn cut(&self, plans: &[ToothPlan]) -> Result<Profile, ProfileError> {
        let mut pieces: Vec<ToothCurve> = Vec::with_capacity(plans.len() * 16);
        let mut teeth: Vec<Tooth> = Vec::with_capacity(plans.len());
        let spaces = self.pattern.of_spaces();
        // Pieces of each tooth and of the space after it.
        let mut places: Vec<[Range<usize>; 2]> = Vec::with_capacity(plans.len());
        for (k, plan) in plans.iter().enumerate() {
            checkpoint();
            let next = plans.get(k + 1).map_or_else(
                || {
                    let mut first = plans[0].leading;
                    first.crossing += self.rolling.pitch_length(self.member);
                    first
                },
                |p| p.leading,
            );
            let k = k as u32;
            let start = pieces.len();
            let tooth = match self.pattern.image(k) {
                None => self.tooth(k, plan, &mut pieces),
                Some(image) => {
                    let [of, _] = &places[image.of as usize];
                    copy(of.clone(), &image, k, &mut pieces);
                    teeth[image.of as usize].image(&image, plan)
                }
            };
            teeth.push(tooth);
            let end = pieces.len();
            match spaces.image(k) {
                None => self.space(k, plan, &next, &mut pieces),
                Some(image) => {
                    let [_, of] = &places[image.of as usize];
                    copy(of.clone(), &image, k, &mut pieces);
                }
            }
            places.push([start..end, end..pieces.len()]);
        }
        let kept = self.without_loops(&pieces)?;
        self.join(&pieces, &kept, teeth)
    }

    /// Parts of the pieces without their loops.
    fn without_loops(&self, pieces: &[ToothCurve]) -> Result<Vec<SegmentRange>, ProfileError> {
        for (piece, next) in pieces.iter().zip(pieces.iter().cycle().skip(1)) {
            let gap = (next.poly.start() - piece.poly.end()).norm();
            if gap > 10.0 * self.tolerance.mm() {
                return Err(ProfileError::Gap {
                    member: self.member,
                    tooth: piece.tooth,
                    roles: [piece.role, next.role],
                    gap,
                });
            }
        }
        let segments: Vec<Segment> = pieces.iter().map(|p| p.poly.into()).collect();
        // The driven gear is rolled clockwise.
        let counter_clockwise = self.member == Member::Driver;
        without_loops(&segments, counter_clockwise, self.tolerance).map_err(|cause| match cause {
            LoopError::Everywhere => ProfileError::Looped {
                member: self.member,
            },
            cause => ProfileError::Unresolved {
                member: self.member,
                cause,
            },
        })
    }

    fn ends(&self, flank: &Flank<'_>, plan: &FlankPlan) -> Ends {
        let rolling = self.rolling;
        let start = rolling.parameter(plan.crossing);
        let sign = flank.side.sign();
        let limit = rolling.parameter(
            plan.crossing
                - sign
                    * self
                        .tool
                        .addendum_reach()
                        .min(0.25 * rolling.pitch_length(self.member)),
        );
        let required = match plan.top {
            Top::Height(height) => height,
            Top::Reach(reach) => {
                let tip = rolling.parameter(plan.crossing - sign * reach);
                let (foot, height) = flank.foot(tip);
                return Ends {
                    tip,
                    foot,
                    height,
                    tip_shortening: 0.0,
                };
            }
        };
        if let Some((tip, foot)) = flank.at_height(required)
            && sign * (limit - tip) <= 0.0
        {
            return Ends {
                tip,
                foot,
                height: required,
                tip_shortening: 0.0,
            };
        }
        // As far up as the flank goes: to its singular point or the tool's own limit.
        let farthest = flank.farthest(required);
        let farthest = if sign * (limit - farthest) > 0.0 {
            limit
        } else {
            farthest
        };
        let tip = flank
            .slower(MIN_TIP_SPEED, start, farthest)
            .unwrap_or(farthest);
        let (mut foot, mut height) = flank.foot(tip);
        if height > required {
            (foot, height) = flank.nearest_foot(tip).unwrap_or((foot, height));
        }
        Ends {
            tip,
            foot,
            height,
            tip_shortening: (required - height).max(0.0),
        }
    }

    fn tooth(&self, index: u32, plan: &ToothPlan, pieces: &mut Vec<ToothCurve>) -> Tooth {
        let leading = self.flank(&plan.leading, Side::Leading);
        let trailing = self.flank(&plan.trailing, Side::Trailing);
        let (lead, trail) = (
            self.ends(&leading, &plan.leading),
            self.ends(&trailing, &plan.trailing),
        );
        let parameter = |arc: f64| self.rolling.parameter(arc);
        let lead_end = parameter(plan.leading.crossing - plan.leading.corner.end);
        let lead_center = parameter(plan.leading.crossing - plan.leading.corner.center);
        let trail_end = parameter(plan.trailing.crossing + plan.trailing.corner.end);
        let trail_center = parameter(plan.trailing.crossing + plan.trailing.corner.center);

        let fillet = |flank: &Flank<'_>, corner: &Corner, pieces: &mut Vec<ToothCurve>| {
            let (center, end, leads) = match flank.side {
                Side::Leading => (lead_center, lead_end, true),
                Side::Trailing => (trail_center, trail_end, false),
            };
            let swing = Swing::new(corner, center, end);
            let (from, to) = if leads { (center, end) } else { (end, center) };
            let mut cuts: Vec<f64> = self.cuts(from, to).map(|t| swing.own(t)).collect();
            if cuts.len() == 2 {
                // One piece never suffices: not trying it saves a third of the work.
                cuts.insert(1, 0.5 * (cuts[0] + cuts[1]));
            }
            self.fit(pieces, Role::Fillet, flank.side, index, cuts, &|w| {
                flank.fillet(corner, swing.parameter(w))
            });
        };
        fillet(&leading, &plan.leading.corner, pieces);
        let add =
            |side: Side, flank: &Flank<'_>, from: f64, to: f64, pieces: &mut Vec<ToothCurve>| {
                let cuts = self.cuts(from, to).collect();
                self.fit(pieces, Role::Flank, side, index, cuts, &|t| flank.point(t));
            };
        add(Side::Leading, &leading, lead_end, lead.tip, pieces);
        let top = [(lead.foot, lead.height), (trail.foot, trail.height)];
        self.land(pieces, Role::Tip, index, &leading, top, |share| share);
        add(Side::Trailing, &trailing, trail.tip, trail_end, pieces);
        fillet(&trailing, &plan.trailing.corner, pieces);
        let side = |flank: &Flank<'_>, plan: &FlankPlan, ends: &Ends| ToothSide {
            crossing: plan.crossing,
            tip_height: ends.height,
            tip_shortening: ends.tip_shortening,
            form_depth: -flank.height(plan.crossing + flank.side.sign() * plan.corner.end),
            active_depth: plan.active_depth,
            undercut: 0.0,
            active: None,
            fillet_radius: f64::INFINITY,
        };
        Tooth {
            leading: side(&leading, &plan.leading, &lead),
            trailing: side(&trailing, &plan.trailing, &trail),
            tip_width: 0.0,
            cut_through: true,
        }
    }

    /// Bottom of the space between a tooth and the next.
    fn space(&self, index: u32, plan: &ToothPlan, next: &FlankPlan, pieces: &mut Vec<ToothCurve>) {
        let leading = self.flank(&plan.leading, Side::Leading);
        let parameter = |arc: f64| self.rolling.parameter(arc);
        let trail_center = parameter(plan.trailing.crossing + plan.trailing.corner.center);
        let next_center = parameter(next.crossing - next.corner.center);
        let bottom = [
            (trail_center, -plan.trailing.corner.depth),
            (next_center, -next.corner.depth),
        ];
        self.land(pieces, Role::Root, index, &leading, bottom, |share| {
            share * share * (3.0 - 2.0 * share)
        });
    }

    /// Tip or root land between two pitch-curve parameters with a height over the pitch curve at each. `blend` gives the share of
    /// the rise at a share of the distance.
    fn land(
        &self,
        pieces: &mut Vec<ToothCurve>,
        role: Role,
        tooth: u32,
        flank: &Flank<'_>,
        [(from, low), (to, high)]: [(f64, f64); 2],
        blend: fn(f64) -> f64,
    ) {
        let (width, rise) = (to - from, high - low);
        let narrow = (width * flank.frame(from).speed).abs() <= self.tolerance.mm();
        if narrow && rise.abs() <= self.tolerance.mm() {
            return;
        }
        // Two roundings of unequal depth without a land between them: a straight step joins them.
        let height = |share: f64| low + rise * if narrow { share } else { blend(share) };
        let cuts = if narrow {
            vec![0.0, 1.0]
        } else {
            self.cuts(from, to).map(|t| (t - from) / width).collect()
        };
        // As a function of the share: a parameter has too few digits for the height along a narrow land.
        self.fit(pieces, role, Side::Trailing, tooth, cuts, &|share| {
            let frame = flank.frame(from + share * width);
            frame.point + frame.normal * height(share)
        });
    }

    /// Two pitch-curve parameters and the pitch curve's breaks between them.
    fn cuts(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let breaks = self.rolling.breaks_between(from, to);
        std::iter::once(from).chain(breaks).chain([to])
    }

    /// Fits a curve between the values of its parameter at which it is cut.
    fn fit(
        &self,
        pieces: &mut Vec<ToothCurve>,
        role: Role,
        side: Side,
        tooth: u32,
        cuts: Vec<f64>,
        curve: &dyn Fn(f64) -> Point,
    ) {
        for pair in cuts.windows(2) {
            // A piece without length would only be cut off again.
            if (pair[1] - pair[0]).abs() <= CRUMB * pair[0].abs().max(pair[1].abs()) {
                continue;
            }
            let fitted = PolySegment::fit_spans(curve, pair[0], pair[1], self.tolerance);
            for FittedSpan { poly, from, to } in fitted {
                pieces.push(ToothCurve {
                    poly,
                    role,
                    tooth,
                    span: (from, to),
                    side,
                    image: None,
                });
            }
        }
    }
}

#[cfg(test)]
mod tests;
