//! Contact analysis of a finished pair: the driven angle, the backlash, and all clearances.
//!
//! Works on the outlines and the centre distance alone; how the teeth were made plays no part. At each
//! input the driven gear is seated against the driver from either side, and every place where the two
//! outlines face each other is measured.

mod body;
mod edges;
mod extremes;
mod fillets;
mod hit;
mod jumps;
mod meeting;
mod meshing;
mod places;
mod proof;
mod seat;
mod span;
mod stretch;
#[cfg(test)]
mod tests;
mod touch;
mod tree;
mod turning;
mod walk;
mod window;

use std::ops::Range;

use centrode_geometry::Cancel;
use centrode_mechanism::gear::design::Addendum;
use centrode_mechanism::gear::{GearPair, Member, Tooth, ToothSide};
pub use extremes::ContactExtremes;
pub use jumps::SeatJump;
use meshing::Meshing;
pub use proof::{Proof, ProofError, ProofMeeting, ProofStretch, prove};
use rayon::prelude::{IntoParallelIterator, ParallelIterator};

/// Samples a pitch where no flank is undercut or short.
const SAMPLES_PER_PITCH: u32 = 4;

/// Samples a pitch where contact may be lost.
const FINE_SAMPLES_PER_PITCH: u32 = 48;

/// Samples that are analysed one after the other, each from what is known of the one before.
const RUN: u32 = 512;

/// Transmission error, rad, below which flanks carry the motion.
const CARRIED: f64 = 1e-9;

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
    /// Deepest penetration of the two outlines with the driven gear seated, mm.
    pub penetration: Vec<f64>,
    /// Least distance of a tip from a root, mm; infinite where none is near.
    pub clearance: Vec<f64>,
    /// Least clearance from a fillet, mm; infinite where nothing is near.
    pub fillet_clearance: Vec<f64>,
    /// Greatest sliding speed in the contact per driver speed, mm/rad.
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
    /// pitch curve is concave: contact can then be lost over a small part of a pitch.
    #[must_use]
    pub fn analyse(pair: &GearPair) -> Self {
        if pair.teeth().addendum == Addendum::Full && is_whole(pair) {
            let found = Self::sampled(pair, SAMPLES_PER_PITCH);
            if found.carries() {
                return found;
            }
        }
        Self::sampled(pair, FINE_SAMPLES_PER_PITCH)
    }

    /// Analyses one whole cycle at about `per_pitch` inputs a pitch, spaced evenly along the pitch curve
    /// and never in step with the teeth.
    #[must_use]
    pub fn sampled(pair: &GearPair, per_pitch: u32) -> Self {
        let (n1, _) = pair.mean_ratio();
        let teeth = pair.driver().tooth_count() * n1;
        // One more than a multiple of the teeth: every sample is elsewhere on its tooth.
        let count = teeth * per_pitch.max(1) + 1;
        let runs = count.div_ceil(RUN);
        let cores = (rayon::current_num_threads() as u32).min(runs);
        if cores < 2 {
            return Self::stretch(pair, 0..runs, count);
        }
        let cancel = Cancel::current();
        let stretches = (0..cores).into_par_iter().panic_fuse().map(|core| {
            let _scope = cancel.enter();
            let [from, to] = [core, core + 1].map(|k| k * runs / cores);
            Self::stretch(pair, from..to, count)
        });
        stretches.reduce(Self::default, Self::followed_by)
    }

    /// Analyses runs of samples, of so many in the cycle. Every run begins anew, so the figures do not depend on which are done
    /// together.
    fn stretch(pair: &GearPair, runs: Range<u32>, count: u32) -> Self {
        let rolling = pair.rolling();
        let length = rolling.pitch_length(Member::Driver) * f64::from(pair.mean_ratio().0);
        let mut meshing = Meshing::new(pair);
        let mut out = Self::default();
        for run in runs {
            meshing.begin();
            for i in run * RUN..count.min((run + 1) * RUN) {
                let t = rolling.parameter(length * f64::from(i) / f64::from(count));
                meshing.sample(rolling.angle(t), rolling.driven_angle_at(t), &mut out);
            }
        }
        out
    }

    /// Samples followed by others.
    fn followed_by(mut self, mut next: Self) -> Self {
        for (list, more) in [
            (&mut self.input, &mut next.input),
            (&mut self.law, &mut next.law),
            (&mut self.driven_angle, &mut next.driven_angle),
            (
                &mut self.reverse_driven_angle,
                &mut next.reverse_driven_angle,
            ),
            (&mut self.transmission_error, &mut next.transmission_error),
            (
                &mut self.reverse_transmission_error,
                &mut next.reverse_transmission_error,
            ),
            (&mut self.backlash, &mut next.backlash),
            (&mut self.normal_backlash, &mut next.normal_backlash),
            (&mut self.penetration, &mut next.penetration),
            (&mut self.clearance, &mut next.clearance),
            (&mut self.fillet_clearance, &mut next.fillet_clearance),
            (&mut self.sliding, &mut next.sliding),
        ] {
            list.append(more);
        }
        self.contacts.append(&mut next.contacts);
        self
    }

    /// Analyses given driver angles, rad.
    #[must_use]
    pub fn analyse_at(pair: &GearPair, inputs: &[f64]) -> Self {
        let mut meshing = Meshing::new(pair);
        let mut out = Self::default();
        for &phi in inputs {
            meshing.sample(phi, pair.driven_angle(phi), &mut out);
        }
        out
    }

    /// Analyses poses: driver angle and the driven angle asked for there, rad, whatever their source.
    #[must_use]
    pub fn posed(pair: &GearPair, poses: &[[f64; 2]]) -> Self {
        let mut meshing = Meshing::new(pair);
        let mut out = Self::default();
        for &[phi, law] in poses {
            meshing.sample(phi, law, &mut out);
        }
        out
    }
}
