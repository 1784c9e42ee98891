//! Minimum and maximum figures of a contact, searched between its samples.

use centrode_gear::GearPair;
use centrode_geometry::{Extreme, bracketed_minimum_below};

use super::{
    Contact,
    backlash_position::BacklashPosition,
    clearances::ClearanceFrom,
    contact::EXACT_ERROR,
    contact_count::CycleContacts,
    cycle_samples::{AngleInterval, DistinctSamples, at_angle, period},
    pose_sampling::PoseSampling,
};
use crate::contact::seat::Meshing;

/// Rounding of the driven angle of a seat, rad. Peaks that differ by less are not searched. Ten times less follows
/// noise, ten times more makes the maximum error that much less accurate.
pub(super) const ANGLE_ROUNDING: f64 = 1e-12;

/// Relative difference below which two peaks count as equal. A larger one makes the maximum less accurate, a smaller
/// one follows peaks that differ by rounding.
pub(super) const EQUAL_PEAKS: f64 = 1e-10;

/// Pitches before and after the deepest penetration of an edge into a fillet that contain the maximum error caused by
/// it. A shorter interval misses this maximum, a longer one takes longer to search.
const SUSPECT_REACH: f64 = 1.0 / 16.0;

/// Minimum and maximum of the figures of a contact over the cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactExtremes {
    /// Maximum magnitude of the transmission error with the driver pushing forward, rad.
    pub transmission_error: Extreme,
    /// Maximum magnitude of the transmission error with the driver pushing back, rad.
    pub reverse_transmission_error: Extreme,
    /// Maximum penetration of the gears if there is no room for them, mm.
    pub penetration: Extreme,
    /// Minimum and maximum angular backlash, rad.
    pub backlash: [Extreme; 2],
    /// Minimum and maximum normal backlash, mm, defined as [`Contact::normal_backlash`].
    pub normal_backlash: [Extreme; 2],
    /// Minimum clearance of a tip from a root, mm; infinite if none is near.
    pub clearance: Extreme,
    /// Minimum clearance from a fillet, mm; infinite if nothing is near.
    pub fillet_clearance: Extreme,
    /// Maximum sliding speed of teeth in contact per driver speed, mm/rad, with the driver pushing forward. For
    /// circular gears it does not depend on the backlash.
    pub sliding: Extreme,
    /// Minimum and maximum number of pairs of teeth in contact with the driver pushing forward. They follow from the
    /// driver angles at which contacts reach the ends of flanks. They are those of the samples if the gears are not
    /// followed, or if these ends disagree with the flanks that face each other between them. An edge that drives alone
    /// counts as one.
    pub contacts: [Extreme; 2],
    /// Contact ratio: mean number of pairs of flanks in contact along the pitch curve, not over the angle, found in the same
    /// way. An edge that drives alone counts as zero. For circular gears it is the transverse contact ratio of ISO 21771.
    pub contact_ratio: f64,
    /// Share of the cycle, by driver angle, over which no flanks are in contact, with the driver pushing forward or
    /// back, the larger of both. It is found in the same way.
    pub lost: f64,
}

/// A figure of one sample of a contact.
type Figure = fn(&Contact, usize) -> f64;

impl Contact {
    /// Extremes over one whole cycle. They start from the peaks of the samples and are searched between these.
    ///
    /// The samples must ascend in driver angle, as those of [`Contact::analyse`] do. If a figure is infinite at a sample, this is its
    /// extreme. For gears that are not followed ([`Self::is_followed`]) the extremes are those of the samples.
    #[must_use]
    pub fn extremes(&self, pair: &GearPair) -> ContactExtremes {
        self.extremes_with(pair, None)
    }

    /// Extremes like [`Self::extremes`], with the prepared pair in `ready` if there is one.
    pub(crate) fn extremes_with<'a>(
        &'a self,
        pair: &'a GearPair,
        ready: Option<Meshing<'a>>,
    ) -> ContactExtremes {
        let mut search = ExtremeSearch {
            contact: self,
            pair,
            base: DistinctSamples::new(self, pair),
            is_followed: self.is_followed(pair),
            flanks_transmit: self.flanks_transmit(),
            meshing: ready,
        };
        let a = pair.center_distance();
        let DistinctSamples { period, half } = search.base;
        let minimum =
            |search: &mut ExtremeSearch<'_>, figure: Figure, among: usize, rounding: f64| {
                negated(search.maximum(|c, k| -figure(c, k), among, rounding))
            };
        let error: Figure = |c, k| c.transmission_error[k].abs();
        let reverse: Figure = |c, k| c.reverse_transmission_error[k].abs();
        let penetration: Figure = |c, k| c.penetration[k];
        let backlash: Figure = |c, k| c.backlash[k];
        let normal: Figure = |c, k| c.normal_backlash[k];
        let sampling = PoseSampling::new(pair, BacklashPosition::AtLaw);
        let seats = search.seats();
        let edges = match search.is_followed {
            true => search
                .meshing()
                .edge_contacts(seats.first().unwrap_or(&sampling), 1.0),
            false => Vec::new(),
        };
        let CycleContacts { counts, gaps, lost } = search.contacts(&edges, &sampling, &seats);
        // Flanks that transmit the motion hold the driven gear at the law's angle. Then edges can be followed along
        // fillets.
        let sampled = self.fillet_clearance.iter().copied();
        let sampled = sampled.fold(f64::INFINITY, f64::min);
        let nearest = search
            .flanks_transmit
            .then(|| search.edges_to_fillets(sampling, sampled));
        let nearest = nearest.flatten();
        let suspects = search.suspects(gaps, nearest, &seats);
        let transmission_error = search.maximum(error, period, ANGLE_ROUNDING);
        let transmission_error = search.maximum_with_suspects(error, transmission_error, &suspects);
        ContactExtremes {
            transmission_error,
            // If the pair is mirrored, the driven gear pushed back is the mirror image of the one pushed forward.
            reverse_transmission_error: if search.base.is_mirrored() {
                Extreme {
                    input: (-transmission_error.input).rem_euclid(pair.cycle()),
                    ..transmission_error
                }
            } else {
                let found = search.maximum(reverse, period, ANGLE_ROUNDING);
                search.maximum_with_suspects(reverse, found, &suspects)
            },
            penetration: search.maximum(penetration, half, a * ANGLE_ROUNDING),
            backlash: [
                minimum(&mut search, backlash, half, ANGLE_ROUNDING),
                search.maximum(backlash, half, ANGLE_ROUNDING),
            ],
            normal_backlash: [
                minimum(&mut search, normal, period, a * ANGLE_ROUNDING),
                search.maximum(normal, period, a * ANGLE_ROUNDING),
            ],
            clearance: search.min_clearance(ClearanceFrom::Root),
            fillet_clearance: search.min_fillet_clearance(nearest, sampled),
            sliding: search.max_sliding(&edges),
            contacts: counts.range,
            contact_ratio: counts.mean,
            lost,
        }
    }

    /// Whether the flanks transmit the motion at every sample.
    pub(super) fn flanks_transmit(&self) -> bool {
        self.errors_below(EXACT_ERROR)
    }

    /// Whether all transmission errors are below a limit, rad.
    pub(super) fn errors_below(&self, limit: f64) -> bool {
        let are_below = |errors: &[f64]| errors.iter().all(|e| e.abs() < limit);
        are_below(&self.transmission_error) && are_below(&self.reverse_transmission_error)
    }
}

/// An extreme of the figure with the other sign.
pub(super) fn negated(extreme: Extreme) -> Extreme {
    Extreme {
        value: -extreme.value,
        ..extreme
    }
}

/// One figure at all samples.
#[derive(Clone, Copy)]
pub(super) struct SampledFigure<'a> {
    /// Driver angles, rad.
    pub(super) inputs: &'a [f64],
    pub(super) values: &'a [f64],
}

impl SampledFigure<'_> {
    /// The maximum of the values.
    pub(super) fn maximum(&self) -> Extreme {
        let first = Extreme {
            input: self.inputs.first().copied().unwrap_or(0.0),
            value: f64::NEG_INFINITY,
        };
        let samples = self.inputs.iter().zip(self.values);
        samples.fold(first, |best, (&input, &value)| match value > best.value {
            true => Extreme { input, value },
            false => best,
        })
    }

    /// Sample `k` with its neighbours on a closed cycle, if it is a peak.
    fn peak(&self, k: usize, cycle: f64) -> Option<Peak> {
        let Self { inputs, values } = self;
        let count = values.len();
        let (before, after) = ((k + count - 1) % count, (k + 1) % count);
        let low = inputs[before] - if k == 0 { cycle } else { 0.0 };
        let high = inputs[after] + if after == 0 { cycle } else { 0.0 };
        let (value, neighbours) = (values[k], [values[before], values[after]]);
        let is_peak = neighbours.iter().all(|&b| b <= value) && low < inputs[k] && inputs[k] < high;
        let peak = Peak([
            (low, neighbours[0]),
            (inputs[k], value),
            (high, neighbours[1]),
        ]);
        (is_peak && peak.possible_rise().is_finite()).then_some(peak)
    }
}

/// Input and value of three neighbouring samples, of which the middle one is not below the others.
struct Peak([(f64, f64); 3]);

impl Peak {
    fn value(&self) -> f64 {
        self.0[1].1
    }

    /// Maximum rise above the middle sample between its neighbours: eight times that of a parabola, twice that of a kink.
    fn possible_rise(&self) -> f64 {
        2.0 * self.value() - self.0[0].1 - self.0[2].1
    }
}

/// Search between the samples of a contact.
pub(super) struct ExtremeSearch<'a> {
    pub(super) contact: &'a Contact,
    pub(super) pair: &'a GearPair,
    pub(super) base: DistinctSamples,
    /// Whether figures are searched between the samples.
    pub(super) is_followed: bool,
    /// Whether the flanks transmit the motion at every sample.
    pub(super) flanks_transmit: bool,
    /// Prepared on first use.
    meshing: Option<Meshing<'a>>,
}

impl<'a> ExtremeSearch<'a> {
    pub(super) fn meshing(&mut self) -> &mut Meshing<'a> {
        let pair = self.pair;
        self.meshing.get_or_insert_with(|| Meshing::new(pair))
    }

    /// Maximum of a figure over the cycle, from peaks at the first `among` samples. Differences below `rounding` do not count.
    fn maximum(
        &mut self,
        figure: impl Fn(&Contact, usize) -> f64,
        among: usize,
        rounding: f64,
    ) -> Extreme {
        let contact = self.contact;
        let values: Vec<f64> = (0..contact.input.len())
            .map(|k| figure(contact, k))
            .collect();
        let between = |search: &mut Self, phi: f64| search.value(&figure, phi);
        let samples = SampledFigure {
            inputs: &contact.input,
            values: &values,
        };
        self.maximum_among(samples, among, between, rounding)
    }

    /// Maximum of a figure over the cycle, from peaks at the first `among` samples and the figure `between` them.
    pub(super) fn maximum_among(
        &mut self,
        samples: SampledFigure<'_>,
        among: usize,
        between: impl Fn(&mut Self, f64) -> f64,
        rounding: f64,
    ) -> Extreme {
        let mut best = SampledFigure {
            inputs: &samples.inputs[..among],
            values: &samples.values[..among],
        }
        .maximum();
        if !self.is_followed || !best.value.is_finite() {
            return best;
        }
        let mut peaks: Vec<Peak> = (0..among)
            .filter_map(|k| samples.peak(k, self.pair.cycle()))
            .collect();
        // The highest peak first: most other peaks then cannot exceed its maximum.
        peaks.sort_by(|p, q| q.value().total_cmp(&p.value()));
        for peak in peaks {
            let threshold = rounding.max(EQUAL_PEAKS * best.value.abs());
            let rise = peak.possible_rise();
            if rise <= threshold || peak.value() + rise <= best.value + threshold {
                continue;
            }
            let (input, lowest) = bracketed_minimum_below(
                |phi| -between(self, phi),
                peak.0.map(|(input, value)| (input, -value)),
                -best.value - threshold,
                rounding,
            );
            if -lowest > best.value {
                best = Extreme {
                    input: input.rem_euclid(self.pair.cycle()),
                    value: -lowest,
                };
            }
        }
        best
    }

    /// Intervals in which the flanks may not transmit the motion although they do at all samples: around gaps between
    /// contacts of flanks, and around the deepest penetration of an edge into a fillet.
    fn suspects(
        &mut self,
        mut suspects: Vec<AngleInterval>,
        nearest: Option<Extreme>,
        seats: &[PoseSampling],
    ) -> Vec<AngleInterval> {
        if !self.flanks_transmit {
            return Vec::new();
        }
        let reach = SUSPECT_REACH * period(self.pair) / f64::from(self.pair.period());
        let around = |deepest: Extreme| AngleInterval {
            middle: deepest.input,
            half_length: reach,
        };
        if seats.is_empty() {
            suspects.extend(nearest.filter(|nearest| nearest.value < 0.0).map(around));
            return suspects;
        }
        for sampling in seats {
            let deepest = self.meshing().edges_to_fillets(sampling, 0.0);
            suspects.extend(deepest.map(around));
        }
        suspects
    }

    /// The maximum of a figure, or a larger value of it in a suspect interval.
    fn maximum_with_suspects(
        &mut self,
        figure: Figure,
        found: Extreme,
        suspects: &[AngleInterval],
    ) -> Extreme {
        let mut worst = found;
        for &AngleInterval {
            middle,
            half_length,
        } in suspects
        {
            let ends = [middle - half_length, middle, middle + half_length];
            let values = ends.map(|phi| (phi, -self.value(&figure, phi)));
            let [before, (_, value), after] = values;
            let (input, lowest) = if value <= before.1.min(after.1) {
                let known = -worst.value - ANGLE_ROUNDING;
                bracketed_minimum_below(
                    |phi| -self.value(&figure, phi),
                    values,
                    known,
                    ANGLE_ROUNDING,
                )
            } else {
                [before, after]
                    .into_iter()
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .unwrap_or(before)
            };
            if -lowest > worst.value + ANGLE_ROUNDING {
                worst = Extreme {
                    input: input.rem_euclid(self.pair.cycle()),
                    value: -lowest,
                };
            }
        }
        worst
    }

    /// Poses of a pair with backlash, with the driven gear pushed forward and, unless that is the mirror image, pushed
    /// back.
    fn seats(&self) -> Vec<PoseSampling> {
        if !self.is_followed || self.pair.backlash() == 0.0 {
            return Vec::new();
        }
        let signs: &[f64] = match self.base.is_mirrored() {
            true => &[1.0],
            false => &[1.0, -1.0],
        };
        let positions = signs.iter().copied().map(BacklashPosition::Pushed);
        positions
            .map(|position| PoseSampling::new(self.pair, position))
            .collect()
    }

    /// A figure at a driver angle.
    fn value(&mut self, figure: &impl Fn(&Contact, usize) -> f64, phi: f64) -> f64 {
        let point = at_angle(self.pair, phi);
        let sample = self.meshing().sample(&point);
        figure(&Contact::from_iter([sample]), 0)
    }
}
