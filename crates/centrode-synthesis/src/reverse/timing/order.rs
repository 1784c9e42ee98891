use std::f64::consts::TAU;

use centrode_geometry::{COMPUTED, bracketed_root, piece_ends};

use super::{Required, Section, TimingError};
use centrode_kinematics::transmission::Transmission;
use centrode_spec::degrees;

/// Samples per turn for the search of the output's turning points.
const SAMPLES: u32 = 720;
/// Margin of a rest to the limit of its band, as a share of the stroke.
const SLACK: f64 = 1e-6;
/// Minimum band of a rest, as a share of the stroke: the crank turns by about the square root of it, and with less, a table of
/// the law has too few digits.
const MIN_BAND: f64 = 1e-9;

/// An output with one maximum and one minimum in a turn.
#[derive(Clone, Debug)]
pub(super) struct Swing {
    /// Angles of the crank at the minimum and at the maximum position, rad.
    angles: [f64; 2],
    /// Minimum and maximum position, mm or rad.
    places: [f64; 2],
}

/// A section with the angles of the crank at its ends.
#[derive(Clone, Debug)]
pub(super) struct Placed<'a> {
    pub(super) section: &'a Section,
    pub(super) within: [f64; 2],
    pub(super) angles: [f64; 2],
}

impl Swing {
    pub(super) fn new(output: &dyn Transmission) -> Result<Self, TimingError> {
        let advance = output.advance();
        if advance != 0.0 {
            return Err(TimingError::Advances { advance });
        }
        let mut looks = piece_ends(0.0, TAU, SAMPLES, &output.breaks());
        looks.pop();
        let speed = |angle: f64| output.at(angle).velocity;
        let speeds: Vec<f64> = looks.iter().map(|&angle| speed(angle)).collect();
        // The last sample is followed by the first, so a speed of zero there counts once.
        let turns = (0..looks.len()).filter_map(|i| {
            let next = (i + 1) % looks.len();
            let to = looks[next] + if next == 0 { TAU } else { 0.0 };
            let turns = (speeds[i] > 0.0) != (speeds[next] > 0.0);
            let root = || bracketed_root(speed, looks[i], to, speeds[i], speeds[next]);
            turns.then(|| (root().rem_euclid(TAU), speeds[i] > 0.0))
        });
        let turns: Vec<(f64, bool)> = turns.collect();
        let angles = match turns[..] {
            [(maximum, true), (minimum, false)] | [(minimum, false), (maximum, true)] => {
                [minimum, maximum]
            }
            _ => return Err(TimingError::Swings { count: turns.len() }),
        };
        let places = angles.map(|angle| output.at(angle).position);
        Ok(Self { angles, places })
    }

    pub(super) fn places(&self) -> [f64; 2] {
        self.places
    }

    /// Angle at which the rising, or falling, output is at a position, within a turn after the end of the stroke it comes from.
    fn angle(&self, output: &dyn Transmission, place: f64, rises: bool) -> f64 {
        let [minimum, maximum] = self.angles;
        let [from, to] = if rises {
            [minimum, maximum]
        } else {
            [maximum, minimum]
        };
        let to = from + (to - from).rem_euclid(TAU);
        let miss = |angle: f64| output.at(angle).position - place;
        bracketed_root(miss, from, to, miss(from), miss(to))
    }

    /// Angles at which the output enters and leaves a band at an end of its stroke.
    fn rest(&self, output: &dyn Transmission, band: f64, is_maximum: bool) -> [f64; 2] {
        let [minimum, maximum] = self.places;
        // A little less, because the law is written as a table.
        let band = band - (SLACK * (maximum - minimum)).min(0.1 * band);
        let place = if is_maximum {
            maximum - band
        } else {
            minimum + band
        };
        let enters = self.angle(output, place, is_maximum);
        let leaves = self.angle(output, place, !is_maximum);
        [enters, enters + (leaves - enters).rem_euclid(TAU)]
    }
}

/// All sequences of crank angles that pass the sections in their order within one turn of the crank: the end of the stroke of a
/// rest may be free.
pub(super) fn placed<'a>(
    output: &dyn Transmission,
    swing: &Swing,
    sections: &'a [Section],
) -> Result<Vec<Vec<Placed<'a>>>, TimingError> {
    let sections = in_order(sections)?;
    let mut ways: Vec<Vec<Placed<'a>>> = vec![Vec::new()];
    for (section, within) in &sections {
        let mut grown = Vec::new();
        for angles in angles(output, swing, section)? {
            for way in &ways {
                let mut way = way.clone();
                let angles = match way.last() {
                    Some(before) => lifted(before.angles[1], angles),
                    None => angles,
                };
                way.push(Placed {
                    section,
                    within: *within,
                    angles,
                });
                // Within a turn after the first angle.
                let [start, end] = [way[0].angles[0], angles[1]];
                if end < start + TAU - COMPUTED {
                    grown.push(way);
                }
            }
        }
        ways = grown;
    }
    if ways.is_empty() {
        let names: Vec<&str> = sections.iter().map(|(s, _)| s.name.as_str()).collect();
        let names = names.join(", ");
        return Err(TimingError::Order { names });
    }
    Ok(ways)
}

/// Angles moved by whole turns, such that the first is the next one after `after`.
fn lifted(after: f64, [from, to]: [f64; 2]) -> [f64; 2] {
    let lift = after + (from - after).rem_euclid(TAU) - from;
    [from + lift, to + lift]
}

/// Sections sorted by their starts, with their inputs counted on from the start of the first one.
fn in_order(sections: &[Section]) -> Result<Vec<(&Section, [f64; 2])>, TimingError> {
    let mut all: Vec<(&Section, [f64; 2])> = sections
        .iter()
        .map(|section| {
            let [from, to] = section.within;
            let start = from.rem_euclid(TAU);
            (section, [start, start + (to - from)])
        })
        .collect();
    all.sort_by(|a, b| a.1[0].total_cmp(&b.1[0]));
    for i in 0..all.len() {
        let (section, [from, to]) = all[i];
        let (other, [mut next, _]) = all[(i + 1) % all.len()];
        if i + 1 == all.len() {
            next += TAU;
        }
        let has_room = to > from && next > to + COMPUTED;
        if !has_room {
            let [from, to, next] = [from, to, next].map(degrees::rounded);
            let (name, other) = (section.name.clone(), other.name.clone());
            return Err(TimingError::Overlap {
                name,
                from,
                to,
                other,
                next,
            });
        }
    }
    Ok(all)
}

/// Angles of the crank at both ends of a section, one pair for each possibility.
fn angles(
    output: &dyn Transmission,
    swing: &Swing,
    section: &Section,
) -> Result<Vec<[f64; 2]>, TimingError> {
    let name = || section.name.clone();
    let [minimum, maximum] = swing.places;
    match section.required {
        Required::Even([from, to]) => {
            if from == to {
                return Err(TimingError::Stationary {
                    name: name(),
                    place: from,
                });
            }
            let is_inside = |place: f64| place > minimum && place < maximum;
            if !(is_inside(from) && is_inside(to)) {
                return Err(TimingError::Beyond {
                    name: name(),
                    from,
                    to,
                    minimum,
                    maximum,
                });
            }
            Ok(vec![[from, to].map(|p| swing.angle(output, p, to > from))])
        }
        Required::Rest(band) => {
            let stroke = maximum - minimum;
            let minimum = MIN_BAND * stroke;
            let is_part = band >= minimum && band < 0.5 * stroke;
            if !is_part {
                return Err(TimingError::Band {
                    name: name(),
                    band,
                    stroke,
                    minimum,
                });
            }
            Ok([true, false]
                .map(|end| swing.rest(output, band, end))
                .into())
        }
    }
}
