use std::f64::consts::{FRAC_PI_2, PI, TAU};

use centrode_geometry::{bracketed_minimum, bracketed_root};

use super::assembly::Linkage;
use super::error::LinkageError;
use super::parts::Link;
use crate::transmission::{MotionJet, Transmission};

/// Samples over a turn of the input in the search for where dyads cease to close.
const LOOKS: u32 = 720;
/// Halvings of a step over which a link turns too far to be followed.
const DEEPEST: u32 = 30;

impl Linkage {
    /// Inputs in `[0, 2 pi]` at which the linkage closes, as intervals, ascending; `[(0, 2 pi)]` for
    /// a crank that turns.
    ///
    /// An end that is a limit of the crank is exact to the float limit. Gaps and islands narrower than
    /// half a degree are found where the room of a dyad has its least or greatest value there.
    #[must_use]
    pub fn closing_inputs(&self) -> Vec<(f64, f64)> {
        let mut open = vec![(0.0, TAU)];
        for dyad in 0..self.series::<1>(0.0).room.len() {
            // Dyads before this one close on the open intervals, so the joints of this one are known.
            let room = |input: f64| self.series::<1>(input).room[dyad];
            open = open
                .into_iter()
                .flat_map(|interval| positive(&room, interval))
                .collect();
        }
        open
    }

    /// First input above zero at which the linkage does not close, and the dyad at fault.
    fn limit(&self) -> Option<LinkageError> {
        let open = self.closing_inputs();
        let input = match open.first() {
            None => 0.0,
            Some(&(low, _)) if low > 0.0 => 0.0,
            Some(&(_, high)) if high < TAU => high,
            Some(_) => return None,
        };
        let past = if input > 0.0 { input + 1e-9 } else { input };
        let rooms = self.series::<1>(past).room;
        let dyad = rooms.iter().position(|&r| r <= 0.0 || r.is_nan())?;
        let missing = self.missing(dyad, past).max(0.0);
        Some(LinkageError::DoesNotClose {
            dyad,
            input,
            missing,
        })
    }

    /// The angle of a link as a function of the input, without jumps.
    ///
    /// # Errors
    /// [`LinkageError::DoesNotClose`] with the limit of the crank where it cannot turn;
    /// [`LinkageError::NoDirection`] where a guided link's block passes its pivot.
    pub fn transmission(&self, link: Link) -> Result<LinkTransmission, LinkageError> {
        if let Some(limit) = self.limit() {
            return Err(limit);
        }
        let angle = |input: f64| self.series::<2>(input).axis(link).angle().0;
        let [start, _] = angle(0.0);
        let mut knots = vec![(0.0, start)];
        let mut pending: Vec<(f64, u32)> = (1..=64)
            .rev()
            .map(|i| (TAU * f64::from(i) / 64.0, 0))
            .collect();
        while let Some((input, depth)) = pending.pop() {
            let (before, turned) = knots[knots.len() - 1];
            let ([_, v0], [to, v1]) = (angle(before), angle(input));
            let step = input - before;
            let change = wrapped(to - turned);
            // A step is followed only where the velocities at both ends account for the change.
            let expected = 0.5 * (v0 + v1) * step;
            if change.abs() < FRAC_PI_2 && (change - expected).abs() < 0.3 {
                knots.push((input, turned + change));
            } else if depth < DEEPEST {
                pending.push((input, depth + 1));
                pending.push((before + 0.5 * step, depth + 1));
            } else {
                return Err(LinkageError::NoDirection {
                    link: link.index(),
                    input,
                });
            }
        }
        let turned = knots[knots.len() - 1].1 - start;
        Ok(LinkTransmission {
            linkage: self.clone(),
            link,
            advance: TAU * (turned / TAU).round(),
            knots,
        })
    }
}

/// The angle in [-pi, pi) that differs from `angle` by whole turns.
pub(super) fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// The parts of an interval on which `room` is above zero.
fn positive(room: &dyn Fn(f64) -> f64, (low, high): (f64, f64)) -> Vec<(f64, f64)> {
    let count = (f64::from(LOOKS) * (high - low) / TAU).ceil().max(4.0) as u32;
    let even = |i: u32| low + (high - low) * f64::from(i) / f64::from(count);
    let mut looks: Vec<(f64, f64)> = (0..=count).map(|i| (even(i), room(even(i)))).collect();
    // A gap or an island between two samples shows as an extreme with a change of sign.
    for i in 1..count as usize {
        let [a, b, c] = [looks[i - 1], looks[i], looks[i + 1]];
        let sign = if b.1 > 0.0 { 1.0 } else { -1.0 };
        if a.1 * sign > b.1 * sign && c.1 * sign >= b.1 * sign && a.1 * sign > 0.0 {
            let (at, least) = bracketed_minimum(|x| sign * room(x), a.0, c.0);
            if least < 0.0 {
                looks.push((at, sign * least));
            }
        }
    }
    looks.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut parts = Vec::new();
    let mut start = (looks[0].1 > 0.0).then_some(looks[0].0);
    for pair in looks.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        match (a.1 > 0.0, b.1 > 0.0) {
            (true, false) => {
                let end = bracketed_root(room, a.0, b.0, a.1, b.1);
                parts.extend(start.take().map(|s| (s, end)));
            }
            (false, true) => start = Some(bracketed_root(room, a.0, b.0, a.1, b.1)),
            _ => {}
        }
    }
    parts.extend(start.map(|s| (s, high)));
    parts
}

/// The angle of a link of a [`Linkage`] as a function of its input.
#[derive(Clone, Debug)]
pub struct LinkTransmission {
    linkage: Linkage,
    link: Link,
    /// Inputs and the unwrapped angle there; between two of them it changes by less than a quarter turn.
    knots: Vec<(f64, f64)>,
    advance: f64,
}

impl Transmission for LinkTransmission {
    fn at(&self, input: f64) -> MotionJet {
        let turns = (input / TAU).floor();
        let within = (input - turns * TAU).clamp(0.0, TAU);
        let knot = self.knots.partition_point(|k| k.0 <= within) - 1;
        let near = self.knots[knot].1;
        let mut jet = MotionJet::of(&self.linkage.series::<4>(within).axis(self.link).angle());
        jet.position = near + wrapped(jet.position - near) + turns * self.advance;
        jet
    }

    fn advance(&self) -> f64 {
        self.advance
    }
}
