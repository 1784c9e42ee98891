//! Greatest and least figures of a contact, sought between its samples.

use centrode_gear::GearPair;
use centrode_geometry::{Extreme, bracketed_minimum_below};

use super::{
    CARRIED, Contact, at_angle, clearances,
    count::{Changes, Counts, sampled},
    cycle::{Base, period},
    edges::EdgeContact,
    meshing::Meshing,
    touch::Stand,
    walk::Walk,
};

/// Angle, rad, of which a seat tells no more.
pub(super) const ROUNDING: f64 = 1e-12;

/// Share of a figure by which no peak is told from another.
const SAME: f64 = 1e-10;

/// Distance from an edge's contact, pitches, at which the contact that ends there is looked at.
const BESIDE: f64 = 2.5e-10;

/// Pitches on either side of where an edge comes deepest into a fillet within which the gears are farthest off their law.
const REACH: f64 = 1.0 / 16.0;

/// Distance from an edge's contact, pitches, within which the contact ends with the driven gear at its seat: where, is known to the
/// first order of the backlash. Ten times less misses ends at a large backlash, ten times more takes other contacts for it.
const ENDED: f64 = 1e-2;

/// Share of the sliding speed that is lost, at least, where the fastest contact ends, and by which it changes within [`ENDED`].
const ENDING: f64 = 0.05;

/// Figures of a contact that change steadily along the cycle, where they are greatest and least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactExtremes {
    /// Greatest size of the transmission error with the driver pushing on, rad.
    pub transmission_error: Extreme,
    /// Greatest size of the transmission error with the driver pushing back, rad.
    pub reverse_transmission_error: Extreme,
    /// Greatest penetration of the gears where there is no room for them, mm.
    pub penetration: Extreme,
    /// Least and greatest angular backlash, rad.
    pub backlash: [Extreme; 2],
    /// Least and greatest normal backlash, mm, as that of [`Contact::normal_backlash`].
    pub normal_backlash: [Extreme; 2],
    /// Least distance of a tip from a root, mm; infinite where none is near.
    pub clearance: Extreme,
    /// Least clearance from a fillet, mm; infinite where nothing is near.
    pub fillet_clearance: Extreme,
    /// Maximum sliding speed of teeth in contact per driver speed, mm/rad, with the driver pushing on. Of circular gears it does not
    /// depend on the backlash.
    pub sliding: Extreme,
    /// Minimum and maximum number of pairs of teeth in contact with the driver pushing on. They follow from the driver angles at
    /// which contacts come to the ends of flanks. Of gears that are not followed, and where these ends disagree with the flanks
    /// that face each other between them, they are those of the samples. An edge that carries alone counts as one.
    pub contacts: [Extreme; 2],
    /// Contact ratio: mean number of pairs of flanks in contact along the pitch curve, not over the angle, found in the same way.
    /// An edge that carries alone counts as none. Of circular gears it is the transverse contact ratio of ISO 21771.
    pub contact_ratio: f64,
    /// Share of the cycle, by driver angle, over which no flanks are in contact with the driver pushing one way, the worse of both
    /// ways; found in the same way.
    pub lost: f64,
}

/// A figure of one sample of a contact.
type Figure = fn(&Contact, usize) -> f64;

impl Contact {
    /// Extremes over one whole cycle: the peaks among samples of it are followed between these.
    ///
    /// The samples ascend in driver angle, as those of [`Contact::analyse`] do. A figure that has no number somewhere has there
    /// its extreme. Of gears that are not followed ([`Self::is_followed`]) they are those of the samples.
    #[must_use]
    pub fn extremes(&self, pair: &GearPair) -> ContactExtremes {
        self.extremes_by(pair, None)
    }

    /// Extremes of a pair that was made ready before.
    pub(crate) fn extremes_by<'a>(
        &'a self,
        pair: &'a GearPair,
        ready: Option<Meshing<'a>>,
    ) -> ContactExtremes {
        let mut search = Search {
            contact: self,
            pair,
            base: Base::new(self, pair),
            is_followed: self.is_followed(pair),
            carries: self.carries(),
            meshing: ready,
        };
        let a = pair.center_distance();
        let Base { period, half } = search.base;
        let least = |search: &mut Search<'_>, figure: Figure, among: usize, rounding: f64| {
            negative(search.greatest(|c, k| -figure(c, k), among, rounding))
        };
        let error: Figure = |c, k| c.transmission_error[k].abs();
        let reverse: Figure = |c, k| c.reverse_transmission_error[k].abs();
        let penetration: Figure = |c, k| c.penetration[k];
        let backlash: Figure = |c, k| c.backlash[k];
        let normal: Figure = |c, k| c.normal_backlash[k];
        let walk = Walk::new(pair, Stand::Law);
        let seats = search.seats();
        let edges = match search.is_followed {
            true => search
                .meshing()
                .edge_contacts(seats.first().unwrap_or(&walk), 1.0),
            false => Vec::new(),
        };
        let (counts, gaps, lost) = search.counts(&edges, &walk, &seats);
        // Flanks that carry the motion leave the driven gear at the law's angle, where an edge can be followed along a fillet.
        let sampled = self.fillet_clearance.iter().copied();
        let sampled = sampled.fold(f64::INFINITY, f64::min);
        let nearest = search
            .carries
            .then(|| search.edges_to_fillets(walk, sampled));
        let nearest = nearest.flatten();
        let suspects = search.suspects(gaps, nearest, &seats);
        let transmission_error = search.greatest(error, period, ROUNDING);
        let transmission_error = search.worst(error, transmission_error, &suspects);
        ContactExtremes {
            transmission_error,
            // Pushed back, the pair is the mirror image of itself pushed on.
            reverse_transmission_error: if search.base.is_mirrored() {
                Extreme {
                    input: (-transmission_error.input).rem_euclid(pair.cycle()),
                    ..transmission_error
                }
            } else {
                let found = search.greatest(reverse, period, ROUNDING);
                search.worst(reverse, found, &suspects)
            },
            penetration: search.greatest(penetration, half, a * ROUNDING),
            backlash: [
                least(&mut search, backlash, half, ROUNDING),
                search.greatest(backlash, half, ROUNDING),
            ],
            normal_backlash: [
                least(&mut search, normal, period, a * ROUNDING),
                search.greatest(normal, period, a * ROUNDING),
            ],
            clearance: search.least_clearance(clearances::TIP),
            fillet_clearance: search.least_fillet_clearance(nearest, sampled),
            sliding: search.fastest(&edges),
            contacts: counts.range,
            contact_ratio: counts.mean,
            lost,
        }
    }

    /// Whether the flanks carry the motion at every sample.
    pub(super) fn carries(&self) -> bool {
        self.is_off_by_less_than(CARRIED)
    }

    /// Whether all transmission errors are below a number, rad.
    pub(super) fn is_off_by_less_than(&self, most: f64) -> bool {
        let sure = |errors: &[f64]| errors.iter().all(|e| e.abs() < most);
        sure(&self.transmission_error) && sure(&self.reverse_transmission_error)
    }
}

/// An extreme of the figure with the other sign.
pub(super) fn negative(extreme: Extreme) -> Extreme {
    Extreme {
        value: -extreme.value,
        ..extreme
    }
}

/// The greatest of some values, and its input.
fn highest(inputs: &[f64], values: &[f64]) -> Extreme {
    let first = Extreme {
        input: inputs.first().copied().unwrap_or(0.0),
        value: f64::NEG_INFINITY,
    };
    let samples = inputs.iter().zip(values);
    samples.fold(first, |best, (&input, &value)| match value > best.value {
        true => Extreme { input, value },
        false => best,
    })
}

/// Three neighbouring samples, the middle one no less than the others: inputs and values.
struct Peak([(f64, f64); 3]);

impl Peak {
    fn value(&self) -> f64 {
        self.0[1].1
    }

    /// Height above it at most reached beside it: eight times that of a parabola, and twice that of a kink.
    fn above(&self) -> f64 {
        2.0 * self.value() - self.0[0].1 - self.0[2].1
    }
}

/// Search between the samples of a contact.
pub(super) struct Search<'a> {
    pub(super) contact: &'a Contact,
    pub(super) pair: &'a GearPair,
    pub(super) base: Base,
    /// Whether anything is sought between the samples.
    is_followed: bool,
    /// Whether the flanks carry the motion at every sample.
    pub(super) carries: bool,
    /// Made when it is first needed.
    meshing: Option<Meshing<'a>>,
}

impl<'a> Search<'a> {
    pub(super) fn meshing(&mut self) -> &mut Meshing<'a> {
        let pair = self.pair;
        self.meshing.get_or_insert_with(|| Meshing::new(pair))
    }

    /// Greatest value of a figure, whose peaks are sought at the first so many samples, where differences of `rounding` tell
    /// nothing.
    fn greatest(
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
        self.greatest_among((&contact.input, &values), among, between, rounding)
    }

    /// Greatest value of a figure over the cycle, from samples of it and from what it is between them.
    pub(super) fn greatest_among(
        &mut self,
        (inputs, values): (&[f64], &[f64]),
        among: usize,
        between: impl Fn(&mut Self, f64) -> f64,
        rounding: f64,
    ) -> Extreme {
        let mut best = highest(&inputs[..among], &values[..among]);
        if !self.is_followed || !best.value.is_finite() {
            return best;
        }
        let mut peaks: Vec<Peak> = (0..among)
            .filter_map(|k| self.peak(inputs, values, k))
            .collect();
        // Higher ones first: they leave the others nothing to reach.
        peaks.sort_by(|p, q| q.value().total_cmp(&p.value()));
        for peak in peaks {
            let least = rounding.max(SAME * best.value.abs());
            let above = peak.above();
            if above <= least || peak.value() + above <= best.value + least {
                continue;
            }
            let (input, lowest) = bracketed_minimum_below(
                |phi| -between(self, phi),
                peak.0.map(|(input, value)| (input, -value)),
                -best.value - least,
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

    /// Maximum sliding speed: flanks slide faster the farther they touch from the pitch point, so fastest where the contact
    /// reaches an edge. Where an edge carries the motion itself, the samples show it.
    fn fastest(&mut self, edges: &[EdgeContact]) -> Extreme {
        let contact = self.contact;
        let mut best = highest(&contact.input, &contact.sliding);
        let (pair, carries) = (self.pair, self.carries);
        let pitch = period(pair) / f64::from(pair.period());
        // Speed at edges at which the contact was seen to end: no others as fast are followed.
        let mut ended: f64 = 0.0;
        for edge in edges {
            let speed = edge.sliding;
            if speed <= best.value.max(ended) * (1.0 + SAME) {
                break;
            }
            let meshing = self.meshing();
            // Gears off their law may touch anywhere.
            if carries && !meshing.has_mate(edge) {
                continue;
            }
            let mut value = |phi: f64| meshing.sample(&at_angle(pair, phi)).loaded[0].sliding;
            let off = if pair.backlash() > 0.0 { ENDED } else { BESIDE };
            let off = pitch * if edge.begins { off } else { -off };
            let [mut inside, mut outside] = [off, -off].map(|off| edge.at.input + off);
            let [mut found, mut other] = [inside, outside].map(&mut value);
            let is_edge = (found - speed).abs() < ENDING * speed;
            if is_edge && other < found * (1.0 - ENDING) {
                while (inside - outside).abs() > 2.5 * BESIDE * pitch {
                    let middle = 0.5 * (inside + outside);
                    let at_middle = value(middle);
                    if at_middle > found * (1.0 - ENDING) {
                        (inside, found) = (middle, at_middle);
                    } else {
                        (outside, other) = (middle, at_middle);
                    }
                }
                ended = ended.max(speed);
            }
            for (phi, value) in [(inside, found), (outside, other)] {
                if value > best.value {
                    let input = phi.rem_euclid(pair.cycle());
                    best = Extreme { input, value };
                }
            }
        }
        best
    }

    /// Stretches of the driver angle, by middle and half length, at which flanks may not carry the motion though they do at all
    /// samples: where none of them is in contact, and where an edge comes deepest into a fillet.
    fn suspects(
        &mut self,
        mut found: Vec<(f64, f64)>,
        nearest: Option<Extreme>,
        seats: &[Walk],
    ) -> Vec<(f64, f64)> {
        if !self.carries {
            return Vec::new();
        }
        let reach = REACH * period(self.pair) / f64::from(self.pair.period());
        if seats.is_empty() {
            let deepest = nearest.filter(|nearest| nearest.value < 0.0);
            found.extend(deepest.map(|found| (found.input, reach)));
            return found;
        }
        for walk in seats {
            let deepest = self.meshing().edges_to_fillets(walk, 0.0);
            found.extend(deepest.map(|found| (found.input, reach)));
        }
        found
    }

    /// The greatest value of a figure, or of those of it in suspect stretches.
    fn worst(&mut self, figure: Figure, found: Extreme, suspects: &[(f64, f64)]) -> Extreme {
        let mut worst = found;
        for &(middle, half) in suspects {
            let ends = [middle - half, middle, middle + half];
            let values = ends.map(|phi| (phi, -self.value(&figure, phi)));
            let [before, (_, value), after] = values;
            let (input, lowest) = if value <= before.1.min(after.1) {
                let known = -worst.value - ROUNDING;
                bracketed_minimum_below(|phi| -self.value(&figure, phi), values, known, ROUNDING)
            } else {
                [before, after]
                    .into_iter()
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .unwrap_or(before)
            };
            if -lowest > worst.value + ROUNDING {
                worst = Extreme {
                    input: input.rem_euclid(self.pair.cycle()),
                    value: -lowest,
                };
            }
        }
        worst
    }

    /// Walks of a pair with backlash, pushed on and, unless that is the mirror image, back.
    fn seats(&self) -> Vec<Walk> {
        if !self.is_followed || self.pair.backlash() == 0.0 {
            return Vec::new();
        }
        let signs: &[f64] = match self.base.is_mirrored() {
            true => &[1.0],
            false => &[1.0, -1.0],
        };
        let stands = signs.iter().copied().map(Stand::Seat);
        stands.map(|stand| Walk::new(self.pair, stand)).collect()
    }

    /// Number of pairs of teeth in contact with the driver pushing on, stretches over which no flanks are whichever way it pushes,
    /// and the share of the cycle that they take, at most, with the driver pushing one way. With backlash the driven gear is at
    /// its seat, where its edges come to the mate at other angles than by the law.
    fn counts(
        &mut self,
        edges: &[EdgeContact],
        law: &Walk,
        seats: &[Walk],
    ) -> (Counts, Vec<(f64, f64)>, f64) {
        let (contact, period) = (self.contact, period(self.pair));
        let missing = |on_flanks: &[bool]| {
            let off = on_flanks.iter().filter(|on| !**on).count();
            off as f64 / on_flanks.len() as f64
        };
        let [off, reverse_off] =
            [&contact.on_flanks, &contact.reverse_on_flanks].map(|on| missing(on));
        if !self.is_followed {
            return (sampled(contact), Vec::new(), off.max(reverse_off));
        }
        let share = |counts: &Counts| {
            let halves = counts.gaps.iter().map(|(_, half)| half);
            2.0 * halves.sum::<f64>() / period
        };
        let on = self.flank_counts(edges, 1.0);
        let mut lost = on.as_ref().map_or(off, share);
        let counts = on.unwrap_or_else(|| sampled(contact));
        let mut gaps = counts.gaps.clone();
        // Pushed back it is the mirror image.
        if !self.base.is_mirrored() {
            let edges = self
                .meshing()
                .edge_contacts(seats.get(1).unwrap_or(law), -1.0);
            let back = self.flank_counts(&edges, -1.0);
            lost = lost.max(back.as_ref().map_or(reverse_off, share));
            gaps.extend(back.into_iter().flat_map(|counts| counts.gaps));
        }
        (counts, gaps, lost)
    }

    /// Counts by the ends of the flanks, with the driver pushing on (`sign` 1) or back (-1): `None` if they disagree with the counts
    /// of the samples or, where an edge may carry the motion at these, with the flanks that face each other between two ends.
    fn flank_counts(&mut self, edges: &[EdgeContact], sign: f64) -> Option<Counts> {
        let (pair, contact, base, carries) = (self.pair, self.contact, self.base, self.carries);
        let meshing = self.meshing();
        let changes = Changes::new(meshing, edges)?;
        let seen: Vec<(f64, u32)> = if carries {
            let counted = if sign > 0.0 {
                &contact.contacts
            } else {
                &contact.reverse_contacts
            };
            let samples = contact.input.iter().copied().zip(counted.iter().copied());
            samples.take(base.period).collect()
        } else {
            let stand = Stand::of(pair, sign);
            let middles = changes.middles();
            let count = |phi| (phi, meshing.facing_teeth(&at_angle(pair, phi), stand, sign));
            middles.map(count).collect()
        };
        changes.counts(&seen)
    }

    /// Sample that is a peak with those beside it.
    fn peak(&self, inputs: &[f64], values: &[f64], k: usize) -> Option<Peak> {
        let (count, cycle) = (values.len(), self.pair.cycle());
        let (before, after) = ((k + count - 1) % count, (k + 1) % count);
        let low = inputs[before] - if k == 0 { cycle } else { 0.0 };
        let high = inputs[after] + if after == 0 { cycle } else { 0.0 };
        let (value, beside) = (values[k], [values[before], values[after]]);
        let is_peak = beside.iter().all(|&b| b <= value) && low < inputs[k] && inputs[k] < high;
        let peak = Peak([(low, beside[0]), (inputs[k], value), (high, beside[1])]);
        (is_peak && peak.above().is_finite()).then_some(peak)
    }

    /// A figure at a driver angle.
    fn value(&mut self, figure: &impl Fn(&Contact, usize) -> f64, phi: f64) -> f64 {
        let point = at_angle(self.pair, phi);
        let sample = self.meshing().sample(&point);
        figure(&Contact::from_iter([sample]), 0)
    }
}
