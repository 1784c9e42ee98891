//! The contact of a pair along one whole cycle: the number of samples, and the threads that compute them.

use std::ops::Range;

use centrode_gear::design::Addendum;
use centrode_gear::{GearPair, PitchContact};
use centrode_geometry::Cancel;
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

use super::{
    cycle_samples::{CycleSamples, at_angle},
    sample::Sample,
};
use crate::contact::SAMPLES_PER_PITCH;
use crate::contact::seat::{Meshing, has_complete_teeth};
use crate::progress::{Steps, filling};

/// Samples per pitch if contact may be lost over a small part of a pitch. Fewer miss such parts; the time grows with the number.
const FINE_SAMPLES_PER_PITCH: u32 = 48;

/// Maximum number of samples per run. Within a run each search starts from the result of the previous sample. Shorter
/// runs repeat the slow first search more often, longer runs share the work unevenly between cores.
const SAMPLES_PER_RUN: u32 = 512;

/// The number of runs, if above one, is a multiple of this, so that the cores share them evenly. It only affects the
/// time.
const RUN_MULTIPLE: u32 = 4;

/// Transmission error below which complete teeth at most graze a fillet, rad. The search between a few samples then
/// finds its maximum. A larger limit misses short losses of contact, a smaller one uses the slow fine sampling more
/// often.
const GRAZING_ERROR: f64 = 1e-6;

/// Transmission error below which flanks transmit the motion, rad. It must be above the rounding of the driven angle,
/// and below any error of an edge contact that is reported.
pub(super) const EXACT_ERROR: f64 = 1e-9;

/// Penetration above which gears have no room for each other, modules. A smaller depth counts tips that graze a fillet,
/// a larger one misses teeth that cannot mesh.
const INTERFERENCE_DEPTH: f64 = 0.05;

/// Share of samples without room above which gears interfere. A smaller share reports one bad tooth of many as
/// interference of the whole pair; a larger one searches extremes of gears that cannot turn.
const INTERFERENCE_SHARE: f64 = 0.02;

/// Share of samples off the law above which gears run on their edges. With a smaller share a few short teeth are
/// enough; with a larger one the slow search also follows gears without useful contact.
const EDGE_SHARE: f64 = 0.2;

/// The contact of a pair along one whole cycle, one value per input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contact {
    /// Driver angle, rad.
    pub input: Vec<f64>,
    /// Driven angle of the law, rad.
    pub law: Vec<f64>,
    /// Driven angle when the driver pushes the driven gear forward, rad.
    pub driven_angle: Vec<f64>,
    /// Driven angle when the driver pushes the driven gear back, rad.
    pub reverse_driven_angle: Vec<f64>,
    /// Driven angle when the driver pushes the driven gear forward, minus the law and the designed half backlash, rad.
    pub transmission_error: Vec<f64>,
    /// Transmission error with the driver pushing the driven gear back, rad.
    pub reverse_transmission_error: Vec<f64>,
    /// Angular backlash of the driven gear with the driver held, rad.
    pub backlash: Vec<f64>,
    /// Normal backlash, mm: angular backlash times the distance of the driven axis from the line of action, along which the
    /// driver pushes forward by the law, `r2 cos(alpha)` (ISO 21771).
    pub normal_backlash: Vec<f64>,
    /// Pairs of teeth in contact when the driver pushes the driven gear forward.
    pub contacts: Vec<u32>,
    /// Pairs of teeth in contact when the driver pushes the driven gear back.
    pub reverse_contacts: Vec<u32>,
    /// Whether flanks face each other as designed when the driver pushes the driven gear forward. If not, an edge
    /// drives.
    pub on_flanks: Vec<bool>,
    /// Whether flanks face each other as designed when the driver pushes the driven gear back.
    pub reverse_on_flanks: Vec<bool>,
    /// Maximum penetration of the two outlines with the driven gear seated, mm.
    pub penetration: Vec<f64>,
    /// Minimum clearance of a tip from a root, mm; infinite if none is near. The driven gear is at the law's angle, in the middle of its
    /// backlash. Pushed to one side the clearance can be smaller, by up to the backlash.
    pub clearance: Vec<f64>,
    /// Minimum clearance from a fillet in the same position, mm; infinite if nothing is near.
    pub fillet_clearance: Vec<f64>,
    /// Maximum sliding speed per driver speed when the driver pushes the driven gear forward, mm/rad: of the flanks in
    /// contact or, if no flanks are, of the edges.
    pub sliding: Vec<f64>,
}

impl Contact {
    /// Analyses one whole cycle. The number of samples depends on the pair: with few of them contact that is lost over a small part of a
    /// pitch would be missed.
    ///
    /// | Pair | Samples per pitch |
    /// |---|---|
    /// | complete teeth with full addenda: transmission error below 1e-6 rad, or not followed ([`Self::is_followed`]) | 4 |
    /// | other teeth: interferes or runs on edges, pitch curves that oscillate at least once per two pitches | 1 |
    /// | other teeth: interferes, or pitch curves that oscillate more than twice per tooth | 4 |
    /// | all others | 48 |
    #[must_use]
    pub fn analyse(pair: &GearPair) -> Self {
        Self::analyse_with(pair, &mut None)
    }

    /// The analysis of one whole cycle. It uses the prepared pair in `ready`, or prepares one there.
    pub(crate) fn analyse_with<'a>(pair: &'a GearPair, ready: &mut Option<Meshing<'a>>) -> Self {
        let mut sampled = |per_pitch| Self::sampled_with(pair, per_pitch, ready);
        if pair.teeth().addendum == Addendum::Full && has_complete_teeth(pair) {
            let found = filling([0.0, 0.1], || sampled(SAMPLES_PER_PITCH));
            if found.errors_below(GRAZING_ERROR) || !found.is_followed(pair) {
                return found;
            }
        } else {
            let found = filling([0.0, 0.1], || sampled(1));
            let has_no_motion = found.interferes(pair) || found.runs_on_edges(pair);
            if has_no_motion && oscillates_every_two_teeth(pair) {
                return found;
            }
            if has_no_motion || oscillates_per_tooth(pair) {
                return filling([0.1, 1.0], || sampled(SAMPLES_PER_PITCH));
            }
        }
        filling([0.1, 1.0], || sampled(FINE_SAMPLES_PER_PITCH))
    }

    /// Whether the gears cannot turn: at more than 2 % of the samples they penetrate each other by more than 5 % of the module,
    /// whatever the driven angle.
    #[must_use]
    pub fn interferes(&self, pair: &GearPair) -> bool {
        let limit = INTERFERENCE_DEPTH * pair.module();
        let interfering = self.penetration.iter().filter(|p| **p > limit).count();
        interfering as f64 > INTERFERENCE_SHARE * self.input.len() as f64
    }

    /// Whether the gears run on their edges, because their pitch curves oscillate too often for their teeth. Both must hold:
    ///
    /// 1. at more than 20 % of the samples no flanks face each other as designed, and the driven gear is off its law by more than
    ///    1e-6 rad;
    /// 2. the ratio rises and falls at least once per two pitches.
    #[must_use]
    pub fn runs_on_edges(&self, pair: &GearPair) -> bool {
        let errors = self.transmission_error.iter();
        let errors = errors.zip(&self.reverse_transmission_error);
        let off =
            errors
                .zip(self.on_flanks_in_both_directions())
                .filter(|&((on, back), on_flanks)| {
                    !on_flanks && on.abs().max(back.abs()) > GRAZING_ERROR
                });
        off.count() as f64 > EDGE_SHARE * self.input.len() as f64
            && oscillates_every_two_teeth(pair)
    }

    /// Whether flanks face each other as designed, per sample, with the driver pushing forward and with the driver
    /// pushing back.
    pub(crate) fn on_flanks_in_both_directions(&self) -> impl Iterator<Item = bool> {
        let both = self.on_flanks.iter().zip(&self.reverse_on_flanks);
        both.map(|(on, back)| *on && *back)
    }

    /// Whether the figures are searched between the samples: the gears neither interfere nor run on their edges, and their pitch curves
    /// oscillate at most twice per tooth.
    #[must_use]
    pub fn is_followed(&self, pair: &GearPair) -> bool {
        !oscillates_per_tooth(pair) && !self.interferes(pair) && !self.runs_on_edges(pair)
    }

    /// Analyses one whole cycle at `per_pitch` inputs per pitch or a few more. They are evenly spaced along the pitch curve, each at
    /// another position on its tooth.
    ///
    /// If law and teeth repeat within the cycle ([`GearPair::period`]) one period is analysed, and half of it if the pair is its own
    /// mirror image. The other samples are copies.
    #[must_use]
    pub fn sampled(pair: &GearPair, per_pitch: u32) -> Self {
        Self::sampled_with(pair, per_pitch, &mut None)
    }

    /// Analyses one whole cycle like [`Self::sampled`]. On one thread it uses the prepared pair in `ready`, or prepares one there.
    fn sampled_with<'a>(
        pair: &'a GearPair,
        per_pitch: u32,
        ready: &mut Option<Meshing<'a>>,
    ) -> Self {
        let cycle = CycleSamples::new(pair, per_pitch);
        let runs = match cycle.analysed().div_ceil(SAMPLES_PER_RUN) {
            few @ ..=1 => few,
            many => many.next_multiple_of(RUN_MULTIPLE),
        };
        let cores = (rayon::current_num_threads() as u32).min(runs);
        let cancel = Cancel::current();
        let steps = Steps::new(cycle.analysed() as usize);
        if cores <= 1 {
            // For a single run another thread would take longer.
            let meshing = ready.get_or_insert_with(|| Meshing::new(pair));
            return cycle.whole(run_samples(meshing, &cycle, 0..runs, runs, &steps));
        }
        let shares = (0..cores).into_par_iter().panic_fuse();
        let samples = shares.flat_map_iter(|core| {
            let _scope = cancel.enter();
            let [from, to] = [core, core + 1].map(|k| k * runs / cores);
            run_samples(&mut Meshing::new(pair), &cycle, from..to, runs, &steps)
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

    /// Analyses given poses: driver angle and driven angle of the law, rad.
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

/// Whether the pitch curves oscillate more than twice per tooth.
pub(crate) fn oscillates_per_tooth(pair: &GearPair) -> bool {
    pair.rolling()
        .oscillates_per_tooth(pair.driver().tooth_count())
}

/// Whether the pitch curves oscillate at least once per two pitches, by more than rounding.
fn oscillates_every_two_teeth(pair: &GearPair) -> bool {
    2 * pair.rolling().swings() >= pair.driver().tooth_count() as usize
}

/// Samples of the runs `runs`, of `count` runs in all. No run uses results of another, so the figures do not depend on the
/// number of threads.
fn run_samples(
    meshing: &mut Meshing<'_>,
    cycle: &CycleSamples,
    runs: Range<u32>,
    count: u32,
    steps: &Steps,
) -> Vec<Sample> {
    let rolling = meshing.pair.rolling();
    let mut out = Vec::new();
    let first = |run: u32| {
        let sample = u64::from(cycle.analysed()) * u64::from(run) / u64::from(count);
        sample as u32
    };
    for run in runs {
        meshing.forget_previous();
        for i in first(run)..first(run + 1) {
            let point = rolling.pitch_contact(rolling.parameter(cycle.arc(i)));
            out.push(meshing.sample(&point));
            steps.step();
        }
    }
    meshing.forget_previous();
    out
}
