//! Pairs of teeth in contact along a period, from the driver angles at which contacts begin and end at the ends of flanks.

use centrode_gear::GearPair;
use centrode_geometry::Extreme;

use super::{
    Contact,
    backlash_position::BacklashPosition,
    cycle_samples::{AngleInterval, at_angle, period},
    edge_contacts::EdgeContact,
    extremes::ExtremeSearch,
    pose_sampling::PoseSampling,
};
use crate::contact::seat::Meshing;

/// Share of a pitch next to a change within which the count of a sample is uncertain: the gap at the edge still counts
/// as contact there. A smaller share compares uncertain samples, a larger one compares fewer samples.
const UNCERTAIN_SHARE: f64 = 0.02;

/// Share of a pitch within which edges of both gears can end the same contact. A larger share merges the ends of two
/// contacts, a smaller one counts one contact twice.
const SAME_CONTACT_SHARE: f64 = 0.25;

/// Minimum duration of a count, as a share of a pitch. A shorter count is rounding. A much larger limit hides real
/// short counts.
const MIN_DURATION_SHARE: f64 = 1e-9;

/// Number of pairs of teeth in contact over a cycle.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ContactCounts {
    /// Minimum and maximum.
    pub(super) range: [Extreme; 2],
    /// Mean along the pitch curve; an edge that drives alone counts as zero.
    pub(super) mean: f64,
    /// Intervals over which no flanks are in contact, but an edge is.
    pub(super) gaps: Vec<AngleInterval>,
}

/// Begin or end of a contact.
#[derive(Clone, Copy)]
struct CountChange {
    /// Driver angle, rad.
    input: f64,
    /// Change of the count: 1 or -1.
    by: i32,
    /// Teeth of driver and driven gear.
    teeth: (u32, u32),
}

/// The changes in order, with one begin and one end per contact. If edges of both gears reach the mate within an angle `near`, two
/// teeth touch from the later begin to the earlier end.
fn merge_changes_of_teeth(mut changes: Vec<CountChange>, near: f64) -> Vec<CountChange> {
    changes.sort_by(|a, b| a.input.total_cmp(&b.input));
    let mut merged: Vec<CountChange> = Vec::with_capacity(changes.len());
    for change in changes {
        let same = |other: &CountChange| other.teeth == change.teeth && other.by == change.by;
        let last_far = merged
            .iter()
            .rposition(|other| change.input - other.input > near);
        let from = last_far.map_or(0, |k| k + 1);
        match merged[from..].iter().position(same) {
            Some(_) if change.by < 0 => continue,
            Some(k) => drop(merged.remove(from + k)),
            None => {}
        }
        merged.push(change);
    }
    merged
}

/// Counts from the samples alone.
pub(super) fn counts_of_samples(contact: &Contact) -> ContactCounts {
    let samples = contact.input.iter().zip(&contact.contacts);
    let samples = samples.map(|(&input, &count)| Extreme {
        input,
        value: f64::from(count),
    });
    counts_of_steps(samples.map(|count| CountStep { count, length: 1.0 }))
}

/// Count at the start of a step, and the length of the step as its weight.
struct CountStep {
    count: Extreme,
    length: f64,
}

/// Counts of consecutive steps.
fn counts_of_steps(steps: impl Iterator<Item = CountStep>) -> ContactCounts {
    let [mut minimum, mut maximum] =
        [f64::INFINITY, f64::NEG_INFINITY].map(|value| Extreme { input: 0.0, value });
    let (mut sum, mut total) = (0.0, 0.0);
    for CountStep { count, length } in steps {
        if count.value < minimum.value {
            minimum = count;
        }
        if count.value > maximum.value {
            maximum = count;
        }
        sum += length * count.value;
        total += length;
    }
    ContactCounts {
        range: [minimum, maximum],
        mean: sum / total,
        gaps: Vec::new(),
    }
}

/// Number of pairs of teeth in contact at a driver angle, rad.
#[derive(Clone, Copy)]
pub(super) struct CountAt {
    input: f64,
    count: u32,
}

/// Begins and ends of contacts in a period.
pub(super) struct CountChanges<'a> {
    pair: &'a GearPair,
    /// In the order of the driver angle.
    list: Vec<CountChange>,
    /// Count after each of them, minus that at the start of the period.
    above: Vec<i32>,
}

impl<'a> CountChanges<'a> {
    /// The changes at edges that drive in one direction; `None` if contacts begin and end unequally often.
    pub(super) fn new(meshing: &Meshing<'a>, edges: &[EdgeContact]) -> Option<Self> {
        let pair = meshing.pair;
        let changes = edges.iter().filter_map(|edge| {
            Some(CountChange {
                input: edge.at.input,
                by: if edge.begins { 1 } else { -1 },
                teeth: meshing.touching_teeth(edge)?,
            })
        });
        let list = merge_changes_of_teeth(changes.collect(), SAME_CONTACT_SHARE * pitch(pair));
        let above: Vec<i32> = list
            .iter()
            .scan(0, |count, change| {
                *count += change.by;
                Some(*count)
            })
            .collect();
        (above.last() == Some(&0)).then_some(Self { pair, list, above })
    }

    /// Driver angles of each change and of the next one, rad.
    fn steps(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        let ends = self.list.iter().skip(1).map(|change| change.input);
        let last = self.list[0].input + period(self.pair);
        self.list
            .iter()
            .map(|change| change.input)
            .zip(ends.chain([last]))
    }

    /// Driver angles midway between two changes at which the count is certain, rad.
    pub(super) fn middles(&self) -> impl Iterator<Item = f64> {
        let uncertain = UNCERTAIN_SHARE * pitch(self.pair);
        let long = self
            .steps()
            .filter(move |(from, to)| to - from > 2.0 * uncertain);
        long.map(|(from, to)| 0.5 * (from + to))
    }

    /// Whether the count at a driver angle is certain: it is far enough from all changes.
    fn is_certain(&self, input: f64) -> bool {
        let (angle, last) = (period(self.pair), self.list.len());
        let next = self.list.partition_point(|c| c.input < input);
        let distances = [(next + last - 1) % last, next % last].map(|k| {
            let off = (input - self.list[k].input).rem_euclid(angle);
            off.min(angle - off)
        });
        distances[0].min(distances[1]) > UNCERTAIN_SHARE * pitch(self.pair)
    }

    /// Counts over the period, from the counts at some driver angles; `None` if these disagree with the changes.
    fn counts(&self, samples: &[CountAt]) -> Option<ContactCounts> {
        let angle = period(self.pair);
        let count_at = |input: f64| {
            let input = input.rem_euclid(angle);
            match self.list.partition_point(|c| c.input <= input) {
                0 => 0,
                k => self.above[k - 1],
            }
        };
        let mut starts = samples
            .iter()
            .filter(|sample| self.is_certain(sample.input.rem_euclid(angle)))
            .map(|sample| sample.count as i32 - count_at(sample.input));
        let start = starts.next()?;
        if starts.any(|count| count != start) {
            return None;
        }
        let steps = self.steps().zip(&self.above);
        let steps = steps.map(|((from, to), above)| (from, to, start + above));
        let gaps = steps.clone().filter(|(.., count)| *count < 1);
        let gaps = gaps.map(|(from, to, _)| AngleInterval {
            middle: 0.5 * (from + to),
            half_length: 0.5 * (to - from),
        });
        let gaps = gaps.collect();
        let arc = |input: f64| arc_length(self.pair, input);
        let min_length = MIN_DURATION_SHARE * arc(angle) / f64::from(self.pair.period());
        let steps = steps.map(|(from, to, count)| {
            let count = Extreme {
                input: from,
                value: f64::from(count),
            };
            CountStep {
                count,
                length: arc(to) - arc(from),
            }
        });
        let counts = counts_of_steps(steps.filter(|step| step.length > min_length));
        // An edge that drives alone is a contact.
        let range = counts.range.map(|count| Extreme {
            value: count.value.max(1.0),
            ..count
        });
        Some(ContactCounts {
            gaps,
            range,
            ..counts
        })
    }
}

/// Contacts over a cycle, with the driver pushing forward and pushing back.
pub(super) struct CycleContacts {
    /// Counts with the driver pushing forward.
    pub(super) counts: ContactCounts,
    /// Intervals over which no flanks are in contact, with the driver pushing forward or back.
    pub(super) gaps: Vec<AngleInterval>,
    /// Share of the cycle that these intervals take: the larger one of the two directions.
    pub(super) lost: f64,
}

impl ExtremeSearch<'_> {
    /// Counts the contacts over the cycle. With backlash the driven gear is at its seat: its edges reach the mate at other
    /// driver angles than in the middle of the backlash.
    pub(super) fn contacts(
        &mut self,
        edges: &[EdgeContact],
        law: &PoseSampling,
        seats: &[PoseSampling],
    ) -> CycleContacts {
        let (contact, period) = (self.contact, period(self.pair));
        let missing = |on_flanks: &[bool]| {
            let off = on_flanks.iter().filter(|on| !**on).count();
            off as f64 / on_flanks.len() as f64
        };
        let [off, reverse_off] =
            [&contact.on_flanks, &contact.reverse_on_flanks].map(|on| missing(on));
        if !self.is_followed {
            return CycleContacts {
                counts: counts_of_samples(contact),
                gaps: Vec::new(),
                lost: off.max(reverse_off),
            };
        }
        let share = |counts: &ContactCounts| {
            let halves = counts.gaps.iter().map(|gap| gap.half_length);
            2.0 * halves.sum::<f64>() / period
        };
        let on = self.flank_counts(edges, 1.0);
        let mut lost = on.as_ref().map_or(off, share);
        let counts = on.unwrap_or_else(|| counts_of_samples(contact));
        let mut gaps = counts.gaps.clone();
        // If the pair is mirrored, the contact pushed back is the mirror image of the contact pushed forward.
        if !self.base.is_mirrored() {
            let edges = self
                .meshing()
                .edge_contacts(seats.get(1).unwrap_or(law), -1.0);
            let back = self.flank_counts(&edges, -1.0);
            lost = lost.max(back.as_ref().map_or(reverse_off, share));
            gaps.extend(back.into_iter().flat_map(|counts| counts.gaps));
        }
        CycleContacts { counts, gaps, lost }
    }

    /// Counts from the ends of the flanks, with the driver pushing forward (`sign` 1) or back (-1). `None` if they
    /// disagree with other counts:
    ///
    /// 1. if the flanks transmit the motion at all samples: with the counts of the samples;
    /// 2. otherwise: with the flanks that face each other midway between two changes.
    fn flank_counts(&mut self, edges: &[EdgeContact], sign: f64) -> Option<ContactCounts> {
        let (pair, contact, base, flanks_transmit) =
            (self.pair, self.contact, self.base, self.flanks_transmit);
        let meshing = self.meshing();
        let changes = CountChanges::new(meshing, edges)?;
        let samples: Vec<CountAt> = if flanks_transmit {
            let counted = if sign > 0.0 {
                &contact.contacts
            } else {
                &contact.reverse_contacts
            };
            let samples = contact.input.iter().zip(counted).take(base.period);
            samples
                .map(|(&input, &count)| CountAt { input, count })
                .collect()
        } else {
            let position = BacklashPosition::of(pair, sign);
            let middles = changes.middles();
            let count = |input| CountAt {
                input,
                count: meshing.facing_teeth(&at_angle(pair, input), position, sign),
            };
            middles.map(count).collect()
        };
        changes.counts(&samples)
    }
}

/// Driver angle of a mean pitch, rad.
fn pitch(pair: &GearPair) -> f64 {
    period(pair) / f64::from(pair.period())
}

/// Arc length of the pitch curve at a driver angle, mm.
fn arc_length(pair: &GearPair, input: f64) -> f64 {
    let rolling = pair.rolling();
    rolling.arc_length(rolling.parameter_at_angle(input))
}
