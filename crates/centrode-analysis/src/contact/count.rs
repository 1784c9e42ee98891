//! Pairs of teeth in contact along a period, from the driver angles at which a contact comes to an edge of a flank or leaves it.

use centrode_gear::GearPair;
use centrode_geometry::Extreme;

use super::{Contact, cycle::period, edges::EdgeContact, meshing::Meshing};

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
    /// Mean along the pitch curve; an edge that carries alone counts as none.
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

/// Driver angles of a period at which a contact comes to the end of a flank.
pub(super) struct Changes<'a> {
    pair: &'a GearPair,
    /// In order.
    list: Vec<Change>,
    /// Count after each of them, above that at the start of the period.
    above: Vec<i32>,
}

impl<'a> Changes<'a> {
    /// The changes at edges that drive one way; `None` if contacts begin and end unequally often.
    pub(super) fn new(meshing: &Meshing<'a>, edges: &[EdgeContact]) -> Option<Self> {
        let pair = meshing.pair;
        let changes = edges.iter().filter_map(|edge| {
            Some(Change {
                input: edge.at.input,
                by: if edge.begins { 1 } else { -1 },
                teeth: meshing.touching_teeth(edge)?,
            })
        });
        let list = of_teeth(changes.collect(), BOTH * pitch(pair));
        let above: Vec<i32> = list
            .iter()
            .scan(0, |count, change| {
                *count += change.by;
                Some(*count)
            })
            .collect();
        (above.last() == Some(&0)).then_some(Self { pair, list, above })
    }

    /// Driver angle of each change and of the next one.
    fn steps(&self) -> impl Iterator<Item = (f64, f64)> + Clone {
        let ends = self.list.iter().skip(1).map(|change| change.input);
        let last = self.list[0].input + period(self.pair);
        self.list
            .iter()
            .map(|change| change.input)
            .zip(ends.chain([last]))
    }

    /// Driver angles between two changes that are so far apart that the count there is sure.
    pub(super) fn middles(&self) -> impl Iterator<Item = f64> {
        let unsure = UNSURE * pitch(self.pair);
        let long = self
            .steps()
            .filter(move |(from, to)| to - from > 2.0 * unsure);
        long.map(|(from, to)| 0.5 * (from + to))
    }

    /// Whether a driver angle is so far from all changes that the count there is sure.
    fn is_sure(&self, input: f64) -> bool {
        let (angle, last) = (period(self.pair), self.list.len());
        let next = self.list.partition_point(|c| c.input < input);
        let beside = [(next + last - 1) % last, next % last].map(|k| {
            let off = (input - self.list[k].input).rem_euclid(angle);
            off.min(angle - off)
        });
        beside[0].min(beside[1]) > UNSURE * pitch(self.pair)
    }

    /// Counts over the period, by those at some driver angles; `None` if they do not agree with the changes.
    pub(super) fn counts(&self, seen: &[(f64, u32)]) -> Option<Counts> {
        let angle = period(self.pair);
        let count_at = |input: f64| {
            let input = input.rem_euclid(angle);
            match self.list.partition_point(|c| c.input <= input) {
                0 => 0,
                k => self.above[k - 1],
            }
        };
        let mut first = seen
            .iter()
            .filter(|(input, _)| self.is_sure(input.rem_euclid(angle)))
            .map(|&(input, count)| count as i32 - count_at(input));
        let start = first.next()?;
        if first.any(|count| count != start) {
            return None;
        }
        let steps = self.steps().zip(&self.above);
        let steps = steps.map(|((from, to), above)| (from, to, start + above));
        let gaps = steps.clone().filter(|(.., count)| *count < 1);
        let gaps = gaps.map(|(from, to, _)| (0.5 * (from + to), 0.5 * (to - from)));
        let gaps = gaps.collect();
        let arc = |input: f64| arc_length(self.pair, input);
        let lasting = LASTING * arc(angle) / f64::from(self.pair.period());
        let steps = steps.map(|(from, to, count)| {
            let step = Extreme {
                input: from,
                value: f64::from(count),
            };
            (step, arc(to) - arc(from))
        });
        let counts = of_steps(steps.filter(|(_, length)| *length > lasting));
        // An edge that carries alone is a contact.
        let range = counts.range.map(|count| Extreme {
            value: count.value.max(1.0),
            ..count
        });
        Some(Counts {
            gaps,
            range,
            ..counts
        })
    }
}

/// Driver angle of a mean pitch, rad.
fn pitch(pair: &GearPair) -> f64 {
    period(pair) / f64::from(pair.period())
}

/// Arc length of roll at a driver angle, mm.
fn arc_length(pair: &GearPair, input: f64) -> f64 {
    let rolling = pair.rolling();
    rolling.arc_length(rolling.parameter_at_angle(input))
}
