//! Phase, thickness and pressure angle at which fitted teeth work deepest.
//!
//! Along the pitch curve a flank works from its mate's tip to its own, by the sum of both tips' rolls. Where one flank ends the next
//! has begun if what is left of the one and what there is of the other are more than a pitch together; over the pitch that is the
//! contact ratio there. Where the least of them is above one, the flanks alone carry the motion. What is free is chosen for the
//! greatest least: from a grid of places on, by ever smaller steps along each number.

use centrode_geometry::checkpoint;

use super::{
    design::{Addendum, Fit, GearPairDesign, Phase},
    flank::Side,
    pair::parameters,
    profile::{FlankPlan, Top},
    rolling::{Member, Rolling},
    teeth::{Counts, Layout, layout},
};

/// Share of the mean contact ratio that counts beside the least, so that flanks with room to spare are made deeper too.
const MEAN: f64 = 1e-3;

/// Number that is free.
struct Free {
    fit: Fit,
    /// Values tried first, beside the one written.
    first: &'static [f64],
    range: [f64; 2],
    /// First step, a power of two times the last.
    step: f64,
    /// Parts of a unit to which it is rounded, so that a file can hold it.
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

/// Choices of which gears are tried to be cut.
const TRIED: usize = 12;

/// Halvings of the first steps.
const HALVINGS: u32 = 5;

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
            _ => *design.tool.pressure_angle_mut() = value.to_radians(),
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
    /// The design with what it leaves free chosen and nothing free: the best choices, then what is written. A later one serves where
    /// no gears can be cut by those before.
    pub(super) fn settled(&self, design: &GearPairDesign) -> Vec<GearPairDesign> {
        let mut base = design.clone();
        let fits = std::mem::take(&mut base.teeth.fit);
        let free: Vec<&Free> = FREE.iter().filter(|f| fits.contains(&f.fit)).collect();
        if !fits.is_empty() {
            // What is chosen is chosen for fitted teeth.
            base.teeth.addendum = Addendum::Fitted;
        }
        if free.is_empty() {
            return vec![base];
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
        let mut ranked = self.ranked(&free, &start, &with);
        ranked.retain(|(merit, values)| merit.is_finite() && *values != start);
        ranked.dedup_by(|a, b| a.1 == b.1);
        let best = ranked.iter().take(TRIED).map(|(_, values)| with(values));
        // Where nothing is better what is written stays, to the letter.
        let written = self.merit(&with(&start));
        let is_better = ranked.first().is_some_and(|(merit, _)| *merit > written);
        best.filter(|_| is_better).chain([base.clone()]).collect()
    }

    /// All choices that were tried, the best first.
    fn ranked(
        &self,
        free: &[&Free],
        start: &[f64],
        with: &impl Fn(&[f64]) -> GearPairDesign,
    ) -> Vec<(f64, Vec<f64>)> {
        let merit = |values: &[f64]| self.merit(&with(values));
        let mut tried: Vec<(f64, Vec<f64>)> = grid(free, start)
            .into_iter()
            .map(|values| (merit(&values), values))
            .collect();
        let first = |tried: &[(f64, Vec<f64>)]| {
            let best = tried.iter().max_by(|a, b| a.0.total_cmp(&b.0));
            best.map_or((f64::NEG_INFINITY, start.to_vec()), Clone::clone)
        };
        let mut best = first(&tried);
        for halving in 0..=HALVINGS {
            loop {
                let before = best.0;
                for (k, free) in free.iter().enumerate() {
                    let step = free.step / f64::from(1 << halving);
                    for step in [-step, step] {
                        let mut values = best.1.clone();
                        values[k] = free.rounded(values[k] + step);
                        let found = (merit(&values), values);
                        if found.0 > best.0 {
                            best = found.clone();
                        }
                        tried.push(found);
                    }
                }
                if best.0 <= before {
                    break;
                }
            }
        }
        tried.sort_by(|a, b| b.0.total_cmp(&a.0));
        tried
    }

    /// Layout of a design's teeth, fitted, if it has one.
    fn layout(&self, design: &GearPairDesign) -> Option<Layout> {
        let teeth = parameters(design, self.module);
        layout(self.rolling, self.counts, &teeth).ok()
    }

    /// The least contact ratio from a flank to the next, and a little of their mean; without limit below where there are no teeth.
    fn merit(&self, design: &GearPairDesign) -> f64 {
        checkpoint();
        let is_valid = design.tool.validate().is_ok() && design.teeth.validate().is_ok();
        let Some(layout) = is_valid.then(|| self.layout(design)).flatten() else {
            return f64::NEG_INFINITY;
        };
        let (least, mean) = self.contact_ratios(&layout);
        least + MEAN * mean
    }

    /// Least and mean contact ratio from one flank to the next.
    fn contact_ratios(&self, layout: &Layout) -> (f64, f64) {
        let Layout { driver, driven, .. } = layout;
        let pitch = self.rolling.pitch_length(Member::Driver) / f64::from(self.counts.driver);
        let meshes = driver.len() * self.rolling.mean_ratio().0 as usize;
        let both = |m: usize, side: Side| {
            let mate = &driven[m % driven.len()];
            match side {
                Side::Trailing => (&driver[m % driver.len()].trailing, &mate.leading),
                Side::Leading => (&driver[(m + 1) % driver.len()].leading, &mate.trailing),
            }
        };
        // Up to a flank's tip, as far as the mate's flank goes: deeper the tip cuts into the fillet.
        let above = |flank: &FlankPlan, mate: &FlankPlan| match flank.top {
            Top::Reach(reach) if reach <= mate.corner.end => reach,
            _ => f64::NEG_INFINITY,
        };
        let mut least = f64::INFINITY;
        let mut sum = 0.0;
        for side in [Side::Leading, Side::Trailing] {
            for m in 0..meshes {
                let ((one, its), (next, mate)) = (both(m, side), both((m + 1) % meshes, side));
                // A driver's flank works from its tip on, or up to it.
                let along = if side.sign() > 0.0 {
                    above(its, one) + above(next, mate)
                } else {
                    above(one, its) + above(mate, next)
                };
                least = least.min(along / pitch);
                sum += along / pitch;
            }
        }
        (least, sum / (2 * meshes) as f64)
    }
}

/// All combinations of the first values and those written.
fn grid(free: &[&Free], start: &[f64]) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new()];
    for (free, &written) in free.iter().zip(start) {
        let values = || free.first.iter().copied().chain([written]);
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
    use crate::gear::GearPair;
    use crate::gear::pitch::{Ellipse, PitchSpec};

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
