//! Pairs of teeth in contact along a period, from the driver angles at which a contact comes to an edge of a flank or leaves it.

use centrode_geometry::Extreme;
use centrode_mechanism::gear::GearPair;

use super::{
    Contact,
    cycle::{Base, period},
    edges::EdgeContact,
    meshing::Meshing,
};

/// Share of a pitch beside a change within which a sample may count either way: there the edge still is within a seated gap.
const UNSURE: f64 = 0.02;

/// Share of a pitch within which both gears' edges may end one contact.
const BOTH: f64 = 0.25;

/// Share of a pitch that a count must last.
const LASTING: f64 = 1e-9;

/// Number of pairs of teeth in contact over a cycle.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Counts {
    /// Least and greatest.
    pub(super) range: [Extreme; 2],
    /// Mean along the pitch curve.
    pub(super) mean: f64,
    /// Stretches of the driver angle, by middle and half length, over which no flanks are in contact: an edge is.
    pub(super) gaps: Vec<(f64, f64)>,
}

/// Driver angle, rad, from which on one contact more or less is there.
#[derive(Clone, Copy)]
struct Change {
    input: f64,
    by: i32,
    /// Teeth of driver and driven gear.
    teeth: (u32, u32),
}

/// The changes at which teeth come to touch and cease to, in order: two teeth touch from the later of two edges on, till the earlier
/// of two, where both come to a mate within a part of a pitch.
fn of_teeth(mut changes: Vec<Change>, near: f64) -> Vec<Change> {
    changes.sort_by(|a, b| a.input.total_cmp(&b.input));
    let mut kept: Vec<Change> = Vec::with_capacity(changes.len());
    for change in changes {
        let same = |other: &Change| other.teeth == change.teeth && other.by == change.by;
        let beside = kept
            .iter()
            .rposition(|other| change.input - other.input > near);
        let from = beside.map_or(0, |k| k + 1);
        match kept[from..].iter().position(same) {
            Some(_) if change.by < 0 => continue,
            Some(k) => drop(kept.remove(from + k)),
            None => {}
        }
        kept.push(change);
    }
    kept
}

/// Counts of samples.
pub(super) fn sampled(contact: &Contact) -> Counts {
    let samples = contact.input.iter().zip(&contact.contacts);
    let samples = samples.map(|(&input, &count)| Extreme {
        input,
        value: f64::from(count),
    });
    of_steps(samples.map(|step| (step, 1.0)))
}

/// Counts of steps of some lengths each.
fn of_steps(steps: impl Iterator<Item = (Extreme, f64)>) -> Counts {
    let [mut least, mut greatest] =
        [f64::INFINITY, f64::NEG_INFINITY].map(|value| Extreme { input: 0.0, value });
    let (mut sum, mut length) = (0.0, 0.0);
    for (step, weight) in steps {
        if step.value < least.value {
            least = step;
        }
        if step.value > greatest.value {
            greatest = step;
        }
        sum += weight * step.value;
        length += weight;
    }
    Counts {
        range: [least, greatest],
        mean: sum / length,
        gaps: Vec::new(),
    }
}

impl Meshing<'_> {
    /// Counts of a pair whose flanks carry the motion, from the counts at its samples with the driver pushing one way and the edges
    /// that drive then; nothing where they do not agree.
    pub(super) fn counts(
        &self,
        (inputs, counted): (&[f64], &[u32]),
        base: &Base,
        edges: &[EdgeContact],
    ) -> Option<Counts> {
        let pair = self.pair;
        let (angle, pitches) = (period(pair), f64::from(pair.period()));
        let changes = edges.iter().filter_map(|edge| {
            Some(Change {
                input: edge.at.input,
                by: if edge.begins { 1 } else { -1 },
                teeth: self.touching_teeth(edge)?,
            })
        });
        let changes = of_teeth(changes.collect(), BOTH * angle / pitches);
        if changes.is_empty() || changes.iter().map(|c| c.by).sum::<i32>() != 0 {
            return None;
        }
        // Above the count at the start of the period.
        let above: Vec<i32> = changes
            .iter()
            .scan(0, |count, change| {
                *count += change.by;
                Some(*count)
            })
            .collect();
        let count_at = |input: f64| match changes.partition_point(|c| c.input <= input) {
            0 => 0,
            k => above[k - 1],
        };
        let unsure = UNSURE * angle / pitches;
        let is_sure = |input: f64| {
            let next = changes.partition_point(|c| c.input < input);
            let last = changes.len();
            let [before, after] = [(next + last - 1) % last, next % last].map(|k| changes[k].input);
            let beside = |other: f64| {
                let off = (input - other).rem_euclid(angle);
                off.min(angle - off)
            };
            beside(before).min(beside(after)) > unsure
        };
        let samples = inputs.iter().zip(counted);
        let mut first = samples
            .take(base.period)
            .filter(|(input, _)| is_sure(**input))
            .map(|(&input, &count)| count as i32 - count_at(input));
        let start = first.next()?;
        if first.any(|count| count != start) {
            return None;
        }
        let arc = |input: f64| arc_length(pair, input);
        let ends = changes[1..].iter().map(|change| change.input);
        let ends = ends.chain([changes[0].input + angle]);
        let steps = changes.iter().zip(&above).zip(ends);
        let gaps = steps.clone().filter(|((_, above), _)| start + **above < 1);
        let gaps = gaps.map(|((change, _), end)| {
            let (from, to) = (change.input, end);
            (0.5 * (from + to), 0.5 * (to - from))
        });
        let gaps = gaps.collect();
        let steps = steps.map(|((change, above), end)| {
            let step = Extreme {
                input: change.input,
                value: f64::from((start + above).max(1)),
            };
            (step, arc(end) - arc(change.input))
        });
        let lasting = LASTING * arc(angle) / pitches;
        let counts = of_steps(steps.filter(|(_, length)| *length > lasting));
        Some(Counts { gaps, ..counts })
    }
}

/// Arc length of roll at a driver angle, mm.
fn arc_length(pair: &GearPair, input: f64) -> f64 {
    let rolling = pair.rolling();
    rolling.arc_length(rolling.parameter_at_angle(input))
}
