use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::assembly::Linkage;
use super::error::LinkageError;
use super::parts::{Line, LinkId};
use super::places::Needed;
use super::series::Series;
use crate::formula::Taylor;
use crate::transmission::{MotionJet, Transmission};

/// Steps per turn in which an angle is unwrapped at first.
const STEPS: u32 = 64;
/// Maximum number of halvings of a step over which a link turns too far to be unwrapped.
const DEEPEST: u32 = 30;

impl Linkage {
    /// The angle of a link as a function of the input, without jumps.
    ///
    /// # Errors
    /// [`LinkageError::DoesNotClose`] with the limit of the crank if it cannot turn; [`LinkageError::Flat`] with its first change
    /// point if it has one;
    /// [`LinkageError::NoDirection`] where a guided link's block passes its pivot.
    pub fn transmission(&self, link: LinkId) -> Result<LinkTransmission, LinkageError> {
        match self.limit() {
            Some(limit) => Err(limit),
            None => self.coordinate(Coordinate::Angle {
                link,
                against: LinkId::FRAME,
            }),
        }
    }

    /// A joint's coordinate as a function of the input, without jumps, of a linkage that closes over the whole cycle.
    ///
    /// # Errors
    /// [`LinkageError::NoDirection`] where an angle cannot be followed; [`LinkageError::Unknown`].
    pub fn coordinate(&self, of: Coordinate) -> Result<LinkTransmission, LinkageError> {
        let link = match of {
            Coordinate::Angle { link, against } => {
                self.know_link(against)?;
                link
            }
            Coordinate::Along { link, line } => {
                self.know_line(&line)?;
                link
            }
        };
        self.know_link(link)?;
        let found = LinkTransmission {
            needed: self.needed_among(&of.links()),
            linkage: self.clone(),
            of,
            knots: Vec::new(),
            advance: 0.0,
        };
        if matches!(of, Coordinate::Along { .. }) {
            return Ok(found);
        }
        let mut series = Series::<2>::default();
        let mut angle = |input: f64| found.coordinate(input, &mut series).0;
        let [start, _] = angle(0.0);
        let mut knots = vec![(0.0, start)];
        let count = STEPS * (self.period / TAU).round().max(1.0) as u32;
        let mut pending: Vec<(f64, u32)> = (1..=count)
            .rev()
            .map(|i| (self.period * f64::from(i) / f64::from(count), 0))
            .collect();
        while let Some((input, depth)) = pending.pop() {
            let (before, turned) = knots[knots.len() - 1];
            let ([_, v0], [to, v1]) = (angle(before), angle(input));
            let step = input - before;
            let change = wrapped(to - turned);
            // A step is accepted only if the velocities at both ends account for the change.
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
            advance: TAU * (turned / TAU).round(),
            knots,
            ..found
        })
    }
}

/// The angle in [-pi, pi) that differs from `angle` by whole turns.
pub(super) fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// A joint's coordinate that can be computed from a linkage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// Angle of a link's first axis against another link's, rad.
    Angle {
        /// The link.
        link: LinkId,
        /// The other link.
        against: LinkId,
    },
    /// Distance of a link's origin along a line from the line's point, mm.
    Along {
        /// The link.
        link: LinkId,
        /// The line.
        line: Line,
    },
}

impl Coordinate {
    /// Numbers of the two links whose relative position the coordinate describes.
    fn links(&self) -> [usize; 2] {
        match self {
            Self::Angle { link, against } => [link.0, against.0],
            Self::Along { link, line } => [link.0, line.link.0],
        }
    }
}

impl<const N: usize> Series<N> {
    /// A joint's coordinate; an angle as its principal value.
    fn coordinate(&self, of: &Coordinate) -> Taylor<N> {
        match of {
            Coordinate::Angle { link, against } => {
                let (axis, base) = (self.frame(*link).1, self.frame(*against).1);
                base.cross(axis).atan2(base.dot(axis))
            }
            Coordinate::Along { link, line } => {
                let (through, along) = self.line(line);
                self.frame(*link).0.minus(through).dot(along)
            }
        }
    }
}

/// A joint's coordinate in a [`Linkage`] as a function of its input.
#[derive(Clone, Debug)]
pub struct LinkTransmission {
    linkage: Linkage,
    of: Coordinate,
    /// Parts of the linkage on which the coordinate depends.
    needed: Needed,
    /// Inputs, each with the unwrapped angle there; between neighbours the angle changes by less than a quarter turn. Empty for a
    /// slide.
    knots: Vec<(f64, f64)>,
    advance: f64,
}

thread_local! {
    /// Memory of the last series, for reuse: a coordinate is requested thousands of times.
    static ROOM: Cell<Option<Box<Series<4>>>> = const { Cell::new(None) };
}

impl LinkTransmission {
    /// The coordinate as a series, computed in the memory of `series`; an angle as its principal value.
    fn coordinate<const N: usize>(&self, input: f64, series: &mut Series<N>) -> Taylor<N> {
        self.linkage
            .find(input, |part| self.needed.has(part), series);
        series.coordinate(&self.of)
    }

    /// The coordinate up to the jerk; an angle as its principal value.
    fn jet(&self, input: f64) -> MotionJet {
        // A law of the linkage may be such a coordinate itself. It then finds no memory here and allocates its own.
        let mut series = ROOM.take().unwrap_or_default();
        let found = MotionJet::from_series(&self.coordinate(input, &mut series));
        ROOM.set(Some(series));
        found
    }
}

impl Transmission for LinkTransmission {
    fn at(&self, input: f64) -> MotionJet {
        let period = self.linkage.period;
        let turns = (input / period).floor();
        let within = (input - turns * period).clamp(0.0, period);
        let mut jet = self.jet(within);
        let knot = self.knots.partition_point(|k| k.0 <= within);
        if let Some(&(_, near)) = self.knots.get(knot.wrapping_sub(1)) {
            jet.position = near + wrapped(jet.position - near) + turns * self.advance;
        }
        jet
    }

    fn period(&self) -> f64 {
        self.linkage.period
    }

    fn advance(&self) -> f64 {
        self.advance
    }

    fn breaks(&self) -> Vec<f64> {
        self.linkage.breaks.clone()
    }
}
