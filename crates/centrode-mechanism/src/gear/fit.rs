//! Phase, thickness and pressure angle at which fitted teeth work deepest.
//!
//! A flank works from its mate's tip to its own: along the pitch curve, by the sum of both tips' rolls. Over the pitch that is how
//! many such flanks hold the gears at once, its contact ratio; where the least of all flanks is above one, the flanks alone carry
//! the motion. What is free is chosen for the greatest least: from a grid of places on, by ever smaller steps along each number.

use centrode_geometry::checkpoint;

use super::{
    design::{Addendum, Fit, GearPairDesign, Phase},
    pair::parameters,
    profile::{ToothPlan, Top},
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
        first: &[0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875],
        range: [f64::NEG_INFINITY, f64::INFINITY],
        step: 0.064,
        parts: 1000.0,
    },
    Free {
        fit: Fit::ThicknessSplit,
        first: &[0.44, 0.5, 0.56],
        range: [0.35, 0.65],
        step: 0.032,
        parts: 1000.0,
    },
    Free {
        fit: Fit::PressureAngle,
        first: &[17.5, 20.0, 25.0],
        range: [14.5, 30.0],
        step: 1.6,
        parts: 20.0,
    },
];

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
    /// The design with what it leaves free chosen, and nothing free.
    pub(super) fn settled(&self, design: &GearPairDesign) -> GearPairDesign {
        let mut base = design.clone();
        let fits = std::mem::take(&mut base.teeth.fit);
        if fits.contains(&Fit::Addendum) {
            base.teeth.addendum = Addendum::Fitted;
        }
        let free: Vec<&Free> = FREE.iter().filter(|f| fits.contains(&f.fit)).collect();
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
        let merit = |values: &[f64]| self.merit(&with(values));
        let mut best = (merit(&start), start.clone());
        for values in grid(&free, &start) {
            let found = merit(&values);
            if found > best.0 {
                best = (found, values);
            }
        }
        for halving in 0..=HALVINGS {
            loop {
                let before = best.0;
                for (k, free) in free.iter().enumerate() {
                    let step = free.step / f64::from(1 << halving);
                    for step in [-step, step] {
                        let mut values = best.1.clone();
                        values[k] = free.rounded(values[k] + step);
                        let found = merit(&values);
                        if found > best.0 {
                            best = (found, values);
                        }
                    }
                }
                if best.0 <= before {
                    break;
                }
            }
        }
        // Where nothing is better what is written stays, to the letter.
        match best.1 == start {
            true => base,
            false => with(&best.1),
        }
    }

    /// Layout of a design's teeth, fitted, if it has one.
    fn layout(&self, design: &GearPairDesign) -> Option<Layout> {
        let teeth = parameters(design, self.module);
        layout(self.rolling, self.counts, &teeth).ok()
    }

    /// The least contact ratio of a flank, and a little of their mean; without limit below where there are no teeth.
    fn merit(&self, design: &GearPairDesign) -> f64 {
        checkpoint();
        let mut fitted = design.clone();
        fitted.teeth.addendum = Addendum::Fitted;
        let is_valid = fitted.tool.validate().is_ok() && fitted.teeth.validate().is_ok();
        let Some(layout) = is_valid.then(|| self.layout(&fitted)).flatten() else {
            return f64::NEG_INFINITY;
        };
        let pitch = self.rolling.pitch_length(Member::Driver) / f64::from(self.counts.driver);
        let (least, mean) = contact_ratios(&layout, pitch);
        least + MEAN * mean
    }
}

/// Least and mean contact ratio of the flanks of fitted teeth.
fn contact_ratios(layout: &Layout, pitch: f64) -> (f64, f64) {
    let flanks = |teeth: &[ToothPlan]| -> Vec<f64> {
        let flanks = teeth
            .iter()
            .flat_map(|tooth| [&tooth.leading, &tooth.trailing]);
        let ratio = flanks.map(|flank| match flank.top {
            Top::Reach(reach) => (reach + flank.active_depth) / pitch,
            _ => 0.0,
        });
        ratio.collect()
    };
    let ratios = [flanks(&layout.driver), flanks(&layout.driven)].concat();
    let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
    (least, ratios.iter().sum::<f64>() / ratios.len() as f64)
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
