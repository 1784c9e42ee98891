//! Phase, thickness and pressure angle at which fitted teeth have the largest minimum contact ratio.
//!
//! Along the pitch curve a flank works from its mate's tip to its own; the length is the sum of the rolls of both tips. The next
//! flank begins before this one ends if the roll of this flank after its crossing of the pitch curve and the roll of the next
//! flank before its crossing are together more than a pitch. Their sum over the pitch is the contact ratio there. Where the
//! minimum of these ratios is above one, the flanks alone transmit the motion. The free parameters are chosen for the largest
//! minimum: from a grid of points on, by ever smaller steps along each parameter, first by the layout alone, then by the teeth
//! that are cut, whose flanks may end earlier.

use centrode_geometry::checkpoint;

use super::{
    design::{Addendum, Fit, GearPairDesign, Phase},
    flank::Side,
    pair::parameters,
    profile::{FlankPlan, Tooth, ToothPlan, ToothSide, Top},
    rolling::{Member, Rolling},
    teeth::{Counts, Layout, layout},
};

/// Weight of the mean contact ratio relative to the minimum, so that flanks above the minimum are made deeper too. A
/// larger weight can lower the minimum; without it such flanks stay as they are.
const MEAN: f64 = 1e-3;

/// Parameter that is free.
struct Free {
    fit: Fit,
    /// Values tried first, in addition to the written one.
    first: &'static [f64],
    range: [f64; 2],
    /// First step, a power of two times the last.
    step: f64,
    /// Values are rounded to multiples of 1 / `parts`, so that a file can hold them.
    parts: f64,
}

const FREE: [Free; 3] = [
    Free {
        fit: Fit::Phase,
        first: &[0.0, 0.25, 0.5, 0.75],
        range: [f64::NEG_INFINITY, f64::INFINITY],
        step: 0.064,
        parts: 1000.0,
    },
    Free {
        fit: Fit::ThicknessSplit,
        first: &[0.45, 0.55],
        range: [0.35, 0.65],
        step: 0.032,
        parts: 1000.0,
    },
    Free {
        fit: Fit::PressureAngle,
        first: &[17.5, 23.0],
        range: [14.5, 30.0],
        step: 1.6,
        parts: 20.0,
    },
];

/// Maximum number of choices by the layout whose gears are cut. More take longer, fewer can miss the best.
const CUT: usize = 12;

/// Number of halvings of the first steps. More make the choice finer and slower.
const HALVINGS: u32 = 5;
/// Number of halvings that are skipped when gears are cut: the first steps are then shorter, because the start is good.
const SKIPPED_HALVINGS: u32 = 2;

/// Difference of the contact ratio up to which two choices count as equal: rounding. Then the first one stays.
const TIE: f64 = 1e-9;

/// Minimum gain of the contact ratio over that of the written values for which a choice replaces them. A larger one
/// rejects small gains, a smaller one changes designs for rounding.
const BETTER: f64 = 1e-6;

impl Free {
    fn rounded(&self, value: f64) -> f64 {
        let [low, high] = self.range;
        let value = (value.clamp(low, high) * self.parts).round() / self.parts;
        if self.fit == Fit::Phase {
            value.rem_euclid(1.0)
        } else {
            value
        }
    }

    fn written(&self, design: &GearPairDesign, phase: f64) -> f64 {
        match self.fit {
            Fit::Phase => phase.rem_euclid(1.0),
            Fit::ThicknessSplit => design.teeth.thickness_split,
            _ => design.tool.pressure_angle().to_degrees(),
        }
    }

    fn write(&self, design: &mut GearPairDesign, value: f64) {
        match self.fit {
            Fit::Phase => design.teeth.phase = Phase::Pitches(value),
            Fit::ThicknessSplit => design.teeth.thickness_split = value,
            _ => design.set_pressure_angle(value.to_radians()),
        }
    }
}

/// Pair whose teeth are fitted.
pub(super) struct Fits<'a> {
    pub(super) rolling: &'a Rolling,
    pub(super) counts: &'a Counts,
    pub(super) module: f64,
}

impl Fits<'_> {
    /// The design with its free parameters chosen and fixed. `cut` returns the teeth of both gears, or `None` if they cannot be
    /// cut.
    ///
    /// The written values stay if with no choice the flanks alone transmit the motion, or if no choice is better.
    pub(super) fn settled(
        &self,
        design: &GearPairDesign,
        cut: &impl Fn(&GearPairDesign) -> Option<[Vec<Tooth>; 2]>,
    ) -> GearPairDesign {
        let mut base = design.clone();
        let fits = std::mem::take(&mut base.teeth.fit);
        let free: Vec<&Free> = FREE.iter().filter(|f| fits.contains(&f.fit)).collect();
        if !fits.is_empty() {
            // The choice is made for fitted teeth.
            base.teeth.addendum = Addendum::Fitted;
        }
        if free.is_empty() {
            return base;
        }
        let phase = self.layout(&base).map_or(0.0, |layout| layout.phase);
        let start: Vec<f64> = free.iter().map(|f| f.written(&base, phase)).collect();
        let with = |values: &[f64]| {
            let mut design = base.clone();
            for (free, &value) in free.iter().zip(values) {
                free.write(&mut design, value);
            }
            design
        };
        let planned = |values: &[f64]| self.merit(&with(values));
        let tried = grid(&free, &start).into_iter().map(|values| Choice {
            merit: planned(&values),
            values,
        });
        let mut ranked = climb(&free, tried.collect(), 0, planned);
        ranked.retain(|choice| choice.merit.is_finite() && choice.values != start);
        ranked.dedup_by(|a, b| a.values == b.values);
        ranked.truncate(CUT);
        let made = |values: &[f64]| {
            let teeth = cut(&with(values));
            teeth.map_or(f64::NEG_INFINITY, |teeth| weighed(self.worked(&teeth)))
        };
        let written = cut(&base).map_or(f64::NEG_INFINITY, |teeth| weighed(self.worked(&teeth)));
        let first = [Choice {
            merit: written,
            values: start,
        }];
        let planned = ranked.into_iter().map(|choice| Choice {
            merit: made(&choice.values),
            ..choice
        });
        let first = first.into_iter().chain(planned);
        let ranked = climb(&free, first.collect(), SKIPPED_HALVINGS, made);
        let best = ranked.first().filter(|best| {
            let has_contact = best.merit > 1.0 || written == f64::NEG_INFINITY;
            best.merit.is_finite() && has_contact && best.merit > written + BETTER
        });
        best.map_or(base.clone(), |best| with(&best.values))
    }

    /// Layout of a design's teeth, fitted, if it has one.
    fn layout(&self, design: &GearPairDesign) -> Option<Layout> {
        let teeth = parameters(design, self.module);
        let layout = layout(self.rolling, self.counts, &teeth).ok()?;
        Some(layout.fitted(self.rolling, self.counts, &teeth))
    }

    /// The minimum contact ratio from a flank to the next, plus a small share of the mean; minus infinity without teeth.
    fn merit(&self, design: &GearPairDesign) -> f64 {
        checkpoint();
        let is_valid = design.tool.validate().is_ok() && design.teeth.validate().is_ok();
        let Some(layout) = is_valid.then(|| self.layout(design)).flatten() else {
            return f64::NEG_INFINITY;
        };
        let flanks = |tooth: &ToothPlan| [tooth.leading, tooth.trailing];
        let [driver, driven] = [&layout.driver, &layout.driven]
            .map(|teeth| teeth.iter().map(flanks).collect::<Vec<_>>());
        // Up to the flank's tip, and at most as far as the mate's flank extends: a deeper tip cuts into the fillet.
        let above = |flank: &FlankPlan, _: Side, mate: &FlankPlan| match flank.top {
            Top::Reach(reach) if reach <= mate.corner.end => reach,
            _ => f64::NEG_INFINITY,
        };
        weighed(self.contact_ratios([&driver, &driven], above))
    }

    /// Minimum and mean contact ratio, from one flank to the next, of teeth that are cut.
    fn worked(&self, teeth: &[Vec<Tooth>; 2]) -> (f64, f64) {
        let flanks = |tooth: &Tooth| [tooth.leading, tooth.trailing];
        let [driver, driven] = [0, 1].map(|k| teeth[k].iter().map(flanks).collect::<Vec<_>>());
        // Rolls of the remaining flank above its crossing of the pitch curve, and below.
        let rolls = |flank: &ToothSide, side: Side| {
            let (low, high) = flank.active.unwrap_or((flank.crossing, flank.crossing));
            let (before, after) = (flank.crossing - low, high - flank.crossing);
            match side {
                Side::Leading => (after, before),
                Side::Trailing => (before, after),
            }
        };
        let above = |flank: &ToothSide, side: Side, mate: &ToothSide| {
            rolls(flank, side).0.min(rolls(mate, side.other()).1)
        };
        self.contact_ratios([&driver, &driven], above)
    }

    /// Minimum and mean contact ratio from one flank to the next, of the leading and trailing flanks of both gears. `above`
    /// returns the roll above the crossing over which a flank of a side works with its mate.
    fn contact_ratios<F>(
        &self,
        [driver, driven]: [&[[F; 2]]; 2],
        above: impl Fn(&F, Side, &F) -> f64,
    ) -> (f64, f64) {
        let pitch = self.rolling.pitch_length(Member::Driver) / f64::from(self.counts.driver);
        let meshes = driver.len() * self.rolling.mean_ratio().0 as usize;
        // Driver's flank and the driven gear's.
        let both = |m: usize, side: Side| {
            let [leading, trailing] = &driven[m % driven.len()];
            match side {
                Side::Trailing => (&driver[m % driver.len()][1], leading),
                Side::Leading => (&driver[(m + 1) % driver.len()][0], trailing),
            }
        };
        let mut minimum = f64::INFINITY;
        let mut sum = 0.0;
        for side in [Side::Leading, Side::Trailing] {
            for m in 0..meshes {
                let ((one, its), (next, mate)) = (both(m, side), both((m + 1) % meshes, side));
                // A driver's flank works from its tip on, or up to it.
                let along = match side {
                    Side::Trailing => {
                        above(its, Side::Leading, one) + above(next, Side::Trailing, mate)
                    }
                    Side::Leading => {
                        above(one, Side::Leading, its) + above(mate, Side::Trailing, next)
                    }
                };
                minimum = minimum.min(along / pitch);
                sum += along / pitch;
            }
        }
        (minimum, sum / (2 * meshes) as f64)
    }
}

/// The minimum contact ratio, plus a small share of the mean.
fn weighed((minimum, mean): (f64, f64)) -> f64 {
    minimum + MEAN * mean
}

/// Values of the free parameters, and their merit.
#[derive(Clone)]
struct Choice {
    merit: f64,
    values: Vec<f64>,
}

/// All choices that were tried, the best first: the given ones, and those found from the best of them by steps along each
/// parameter. The steps are halved if no choice is better; the first steps are already halved `halvings` times.
fn climb(
    free: &[&Free],
    mut tried: Vec<Choice>,
    halvings: u32,
    merit: impl Fn(&[f64]) -> f64,
) -> Vec<Choice> {
    let better = |a: Choice, b: &Choice| match b.merit > a.merit + TIE {
        true => b.clone(),
        false => a,
    };
    // Of equally good choices, the first.
    let Some(first) = tried.first().cloned() else {
        return tried;
    };
    let mut best = tried.iter().fold(first, better);
    for halving in halvings..=HALVINGS {
        loop {
            let before = best.merit;
            for (k, free) in free.iter().enumerate() {
                let step = free.step / f64::from(1 << halving);
                for step in [-step, step] {
                    let mut values = best.values.clone();
                    values[k] = free.rounded(values[k] + step);
                    let merit = merit(&values);
                    let found = Choice { merit, values };
                    best = better(best, &found);
                    tried.push(found);
                }
            }
            if best.merit <= before {
                break;
            }
        }
    }
    tried.sort_by(|a, b| b.merit.total_cmp(&a.merit));
    tried
}

/// All combinations of the first values and the written ones, the written ones first.
fn grid(free: &[&Free], start: &[f64]) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new()];
    for (free, &written) in free.iter().zip(start) {
        let values = || [written].into_iter().chain(free.first.iter().copied());
        all = all
            .iter()
            .flat_map(|known: &Vec<f64>| values().map(move |v| [known.as_slice(), &[v]].concat()))
            .collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::GearPair;
    use crate::pitch::{Ellipse, PitchSpec};

    const ALL: [Fit; 4] = [
        Fit::Addendum,
        Fit::ThicknessSplit,
        Fit::PressureAngle,
        Fit::Phase,
    ];

    fn weak(fit: &[Fit]) -> GearPairDesign {
        let mut design = GearPairDesign::new(PitchSpec::Ellipse(Ellipse {
            eccentricity: 0.45,
            module: Some(2.0),
            tooth_count: Some(17),
            ..Ellipse::default()
        }));
        design.teeth.fit = fit.to_vec();
        design
    }

    #[test]
    fn the_settled_design_gives_the_same_gears_and_leaves_nothing_free() {
        for fit in [&ALL[..1], &ALL[1..3], &ALL] {
            let pair = GearPair::resolve(&weak(fit)).expect("a pair");
            let settled = pair.settled_design();
            assert!(settled.teeth.fit.is_empty());
            let again = GearPair::resolve(&settled).expect("a pair");
            assert_eq!(again.driver().outline(), pair.driver().outline(), "{fit:?}");
            assert_eq!(again.driven().outline(), pair.driven().outline(), "{fit:?}");
            assert_eq!(pair.design().teeth.fit, fit);
        }
    }

    #[test]
    fn nothing_is_chosen_that_is_not_free() {
        let written = weak(&[]);
        let settled = GearPair::resolve(&weak(&[Fit::PressureAngle])).expect("a pair");
        let settled = settled.settled_design();
        assert_ne!(settled.tool.pressure_angle(), written.tool.pressure_angle());
        let degrees = settled.tool.pressure_angle().to_degrees();
        assert!((14.5..=30.0).contains(&degrees), "{degrees}");
        assert_eq!(settled.teeth.addendum, Addendum::Fitted);
        assert_eq!(settled.teeth.phase, written.teeth.phase);
        assert_eq!(settled.teeth.thickness_split, written.teeth.thickness_split);
    }
}
