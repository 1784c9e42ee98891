//! Contact analysis of a finished pair: the driven angle, the backlash, and all clearances.
//!
//! Works on the outlines and the centre distance alone; how the teeth were made plays no part. At each
//! input the driven gear is seated against the driver from either side, and every place where the two
//! outlines face each other is measured.

mod at_law;
mod body;
mod clearances;
mod count;
mod cycle;
mod edges;
mod extremes;
mod fillets;
mod hit;
mod jumps;
mod meeting;
mod meshing;
mod places;
mod proof;
mod sample;
mod seat;
mod sliding;
mod span;
mod stretch;
#[cfg(test)]
pub(crate) mod tests;
mod touch;
mod tree;
mod turning;
mod walk;
mod window;

use std::ops::Range;

use centrode_gear::design::Addendum;
use centrode_gear::{GearPair, PitchContact, Tooth, ToothSide};
use centrode_geometry::Cancel;
use cycle::Cycle;
pub use extremes::ContactExtremes;
pub use jumps::SeatJump;
pub(crate) use meshing::Meshing;
pub use proof::{Proof, ProofError, ProofMeeting, ProofStretch, prove};
use rayon::prelude::{IntoParallelIterator, ParallelIterator};
use sample::Sample;

use crate::progress::{Steps, filling};

/// Samples a pitch where no flank is undercut or short.
const SAMPLES_PER_PITCH: u32 = 4;

/// Samples a pitch where contact may be lost.
const FINE_SAMPLES_PER_PITCH: u32 = 48;

/// Most samples that are analysed one after the other, each from what is known of the one before.
const RUN: u32 = 512;

/// Where there are more of them the number of runs is a multiple of this, so that the cores share them evenly.
const SHARES: u32 = 4;

/// Transmission error, rad, below which whole teeth at most graze a fillet: what few samples show is followed between them.
const TOUCHED: f64 = 1e-6;

/// Transmission error, rad, below which flanks carry the motion.
const CARRIED: f64 = 1e-9;

/// Penetration, in modules, beyond which gears have no room for each other.
const JAMMED: f64 = 0.05;

/// Share of the samples at which gears that jam have no room.
const JAMMED_SHARE: f64 = 0.02;

/// Share of the samples off the law from which gears are taken not to run by their flanks.
const STRAYED_SHARE: f64 = 0.2;

/// The contact of a pair along one whole cycle, one value an input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contact {
    /// Driver angle, rad.
    pub input: Vec<f64>,
    /// Driven angle the pitch curves ask for, rad.
    pub law: Vec<f64>,
    /// Driven angle when the driver pushes it on, rad.
    pub driven_angle: Vec<f64>,
    /// Driven angle when the driver pushes it back, rad.
    pub reverse_driven_angle: Vec<f64>,
    /// Driven angle when the driver pushes it on, less the law and the designed half backlash, rad.
    pub transmission_error: Vec<f64>,
    /// Transmission error with the driver pushing it back, rad.
    pub reverse_transmission_error: Vec<f64>,
    /// Angular backlash of the driven gear with the driver held, rad.
    pub backlash: Vec<f64>,
    /// Normal backlash, mm: angular backlash times the distance of the driven axis from the line of action, along which the
    /// driver pushes on by the law, `r2 cos(alpha)` (ISO 21771).
    pub normal_backlash: Vec<f64>,
    /// Pairs of teeth in contact when the driver pushes the driven gear on.
    pub contacts: Vec<u32>,
    /// Pairs of teeth in contact when the driver pushes the driven gear back.
    pub reverse_contacts: Vec<u32>,
    /// Whether flanks that face each other as designed are there to carry the load when the driver pushes the driven gear on; if not,
    /// an edge carries it.
    pub on_flanks: Vec<bool>,
    /// Whether such flanks are there when the driver pushes the driven gear back.
    pub reverse_on_flanks: Vec<bool>,
    /// Deepest penetration of the two outlines with the driven gear seated, mm.
    pub penetration: Vec<f64>,
    /// Least distance of a tip from a root with the driven gear at the law's angle, in the middle of its play, mm; infinite where none
    /// is near. Pushed to a side it is less, by up to the play.
    pub clearance: Vec<f64>,
    /// Least clearance from a fillet there, mm; infinite where nothing is near.
    pub fillet_clearance: Vec<f64>,
    /// Maximum sliding speed in the contacts of the driven gear pushed on per driver speed, mm/rad: that of the flanks in contact or,
    /// where none are, of the edges.
    pub sliding: Vec<f64>,
}

/// Whether every tooth of both gears is as the tool would make it.
fn is_whole(pair: &GearPair) -> bool {
    let sound = |side: &ToothSide| side.undercut == 0.0 && side.tip_shortening == 0.0;
    let whole =
        |tooth: &Tooth| !tooth.cut_through && sound(&tooth.leading) && sound(&tooth.trailing);
    let mut teeth = pair.driver().teeth().iter().chain(pair.driven().teeth());
    teeth.all(whole)
}

impl Contact {
    /// Analyses one whole cycle at four inputs a pitch, or at 48 where a tooth is not as the tool would make it or a
    /// pitch curve is concave: contact can then be lost over a small part of a pitch. Gears that jam are looked at at four; those
    /// that stray are told by the first look, at one input a pitch or, with full teeth, four; those whose pitch curves swing more than
    /// twice a tooth are looked at at four.
    #[must_use]
    pub fn analyse(pair: &GearPair) -> Self {
        Self::analysed(pair, &mut None)
    }

    /// The analysis of one whole cycle, which leaves the pair as it was made ready for it.
    pub(crate) fn analysed<'a>(pair: &'a GearPair, ready: &mut Option<Meshing<'a>>) -> Self {
        let mut sampled = |per_pitch| Self::sampled_by(pair, per_pitch, ready);
        if pair.teeth().addendum == Addendum::Full && is_whole(pair) {
            let found = filling([0.0, 0.1], || sampled(SAMPLES_PER_PITCH));
            if found.is_off_by_less_than(TOUCHED) || !found.is_followed(pair) {
                return found;
            }
        } else {
            let found = filling([0.0, 0.1], || sampled(1));
            let is_hopeless = found.is_jammed(pair) || found.strays(pair);
            if is_hopeless && swings(pair) {
                return found;
            }
            if is_hopeless || is_restless(pair) {
                return filling([0.1, 1.0], || sampled(SAMPLES_PER_PITCH));
            }
        }
        filling([0.1, 1.0], || sampled(FINE_SAMPLES_PER_PITCH))
    }

    /// Whether the gears cannot turn: over a fiftieth of the samples they penetrate each other by more than a twentieth of
    /// the module, wherever the driven gear is put.
    #[must_use]
    pub fn is_jammed(&self, pair: &GearPair) -> bool {
        let most = JAMMED * pair.module();
        let jammed = self.penetration.iter().filter(|p| **p > most).count();
        jammed as f64 > JAMMED_SHARE * self.input.len() as f64
    }

    /// Whether the gears run on their edges along pitch curves that swing too often for their teeth: at more than a fifth of the samples
    /// no flanks face each other as designed and the driven gear is off its law by more than 1e-6 rad, and the ratio rises and falls
    /// once in two pitches or more often.
    #[must_use]
    pub fn strays(&self, pair: &GearPair) -> bool {
        let errors = self.transmission_error.iter();
        let errors = errors.zip(&self.reverse_transmission_error);
        let off = errors
            .zip(self.on_flanks_both_ways())
            .filter(|&((on, back), on_flanks)| !on_flanks && on.abs().max(back.abs()) > TOUCHED);
        off.count() as f64 > STRAYED_SHARE * self.input.len() as f64 && swings(pair)
    }

    /// Whether flanks that face each other as designed are there at each sample, whichever way the driver pushes.
    pub(crate) fn on_flanks_both_ways(&self) -> impl Iterator<Item = bool> {
        let both = self.on_flanks.iter().zip(&self.reverse_on_flanks);
        both.map(|(on, back)| *on && *back)
    }

    /// Whether there is a motion to follow between the samples: the gears neither jam nor stray, and their pitch curves swing no more
    /// than twice a tooth.
    #[must_use]
    pub fn is_followed(&self, pair: &GearPair) -> bool {
        !is_restless(pair) && !self.is_jammed(pair) && !self.strays(pair)
    }

    /// Analyses one whole cycle at `per_pitch` inputs a pitch or a little more, spaced evenly along the pitch curve and never in
    /// step with the teeth.
    ///
    /// Where law and teeth repeat within the cycle ([`GearPair::period`]) one period is analysed, and half of it where the pair is
    /// its own mirror image: what is known of one holds for all.
    #[must_use]
    pub fn sampled(pair: &GearPair, per_pitch: u32) -> Self {
        Self::sampled_by(pair, per_pitch, &mut None)
    }

    /// Analyses one whole cycle like [`Self::sampled`]: on one thread with the pair made ready before, which is left so.
    fn sampled_by<'a>(pair: &'a GearPair, per_pitch: u32, ready: &mut Option<Meshing<'a>>) -> Self {
        let cycle = Cycle::new(pair, per_pitch);
        let runs = match cycle.analysed().div_ceil(RUN) {
            few @ ..=1 => few,
            many => many.next_multiple_of(SHARES),
        };
        let cores = (rayon::current_num_threads() as u32).min(runs);
        let cancel = Cancel::current();
        let steps = Steps::new(cycle.analysed() as usize);
        if cores <= 1 {
            // Handing little work to another thread takes longer than doing it.
            let meshing = ready.get_or_insert_with(|| Meshing::new(pair));
            return cycle.whole(run_samples(meshing, &cycle, (0..runs, runs), &steps));
        }
        let stretches = (0..cores).into_par_iter().panic_fuse();
        let samples = stretches.flat_map_iter(|core| {
            let _scope = cancel.enter();
            let [from, to] = [core, core + 1].map(|k| k * runs / cores);
            run_samples(&mut Meshing::new(pair), &cycle, (from..to, runs), &steps)
        });
        cycle.whole(samples.collect())
    }

    /// Analyses given driver angles, rad.
    #[must_use]
    pub fn analyse_at(pair: &GearPair, inputs: &[f64]) -> Self {
        let mut meshing = Meshing::new(pair);
        let sample = |&phi: &f64| meshing.sample(&at_angle(pair, phi));
        inputs.iter().map(sample).collect()
    }

    /// Analyses poses: driver angle and the driven angle asked for there, rad, whatever their source.
    #[must_use]
    pub fn posed(pair: &GearPair, poses: &[[f64; 2]]) -> Self {
        let mut meshing = Meshing::new(pair);
        let sample = |&[phi, driven_angle]: &[f64; 2]| {
            let point = at_angle(pair, phi);
            meshing.sample(&PitchContact {
                driven_angle,
                ..point
            })
        };
        poses.iter().map(sample).collect()
    }
}

/// Whether the pitch curves swing more than twice a tooth.
pub(crate) fn is_restless(pair: &GearPair) -> bool {
    pair.rolling().is_restless(pair.driver().tooth_count())
}

/// Whether the pitch curves swing once in two pitches or more often, by more than rounding.
fn swings(pair: &GearPair) -> bool {
    2 * pair.rolling().swings() >= pair.driver().tooth_count() as usize
}

/// Where the pitch curves touch at a driver angle.
fn at_angle(pair: &GearPair, phi: f64) -> PitchContact {
    let rolling = pair.rolling();
    PitchContact {
        input: phi,
        ..rolling.pitch_contact(rolling.parameter_at_angle(phi))
    }
}

/// Samples of runs of a cycle. Every run begins anew, so the figures do not depend on which are done together.
fn run_samples(
    meshing: &mut Meshing<'_>,
    cycle: &Cycle,
    (some, all): (Range<u32>, u32),
    steps: &Steps,
) -> Vec<Sample> {
    let rolling = meshing.pair.rolling();
    let mut out = Vec::new();
    let first = |run: u32| {
        let sample = u64::from(cycle.analysed()) * u64::from(run) / u64::from(all);
        sample as u32
    };
    for run in some {
        meshing.begin();
        for i in first(run)..first(run + 1) {
            let point = rolling.pitch_contact(rolling.parameter(cycle.arc(i)));
            out.push(meshing.sample(&point));
            steps.step();
        }
    }
    meshing.begin();
    out
}
