//! Periodic motion made of the segments of one cycle.

use std::f64::consts::TAU;

use centrode_geometry::{COMPUTED, Extreme, maximum};
use thiserror::Error;

use super::design::{MotionSpec, SegmentSpec};
use super::law::{Coefficients, Law};
use centrode_kinematics::formula::Taylor;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::SpecError;

/// Motion of a follower in one turn of the cam: exact, and without a jump of position or velocity.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Input at which the first segment starts, in `[0, 2 pi)`.
    start: f64,
    pieces: Vec<MotionPiece>,
}

#[derive(Clone, Debug)]
struct MotionPiece {
    /// Input from the start of the cycle.
    from: f64,
    span: f64,
    /// Position at the start.
    level: f64,
    course: Course,
}

#[derive(Clone, Debug)]
enum Course {
    Rest,
    /// A law and its stroke.
    Law(Law, f64),
    /// Polynomial in the input as a share of the span.
    Polynomial(Coefficients),
}

/// Joint of two segments, and the jumps there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Join {
    /// Cam angle, rad.
    pub input: f64,
    /// Acceleration after less acceleration before, per radian squared.
    pub acceleration_jump: f64,
    /// Jerk after less jerk before, per radian cubed.
    pub jerk_jump: f64,
}

/// Maximum position, and maximum size of each derivative, of a motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peaks {
    /// Maximum position, mm or rad.
    pub lift: Extreme,
    /// Maximum velocity in either direction, per radian.
    pub velocity: Extreme,
    /// Maximum acceleration in either direction, per radian squared.
    pub acceleration: Extreme,
    /// Maximum jerk in either direction between jumps of the acceleration, per radian cubed.
    pub jerk: Extreme,
}

/// Error of segments that make no motion.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum MotionError {
    /// A value out of its range.
    #[error(transparent)]
    Spec(#[from] SpecError),
    /// The spans are not a whole turn.
    #[error("the spans of the segments add up to {degrees} deg, not 360")]
    Spans {
        /// Sum of the spans, degrees.
        degrees: f64,
    },
    /// Rise and return differ.
    #[error(
        "the follower rises by {} and returns by {}: a cycle must end where it started",
        stroke(*.rise, *.swings), stroke(*.fall, *.swings)
    )]
    Open {
        /// Sum of all strokes away from the axis, mm or rad.
        rise: f64,
        /// Sum of all strokes towards it.
        fall: f64,
        /// Whether they are angles.
        swings: bool,
    },
    /// A segment starts at another velocity than the one before it ended with.
    #[error(
        "at {degrees} deg the velocity jumps from {before} to {after} per radian: an infinite acceleration"
    )]
    VelocityJump {
        /// Cam angle.
        degrees: f64,
        /// Velocity just before, mm/rad or rad/rad.
        before: f64,
        /// Velocity just after.
        after: f64,
    },
}

/// A stroke in the unit of the file, rounded to 1e-9.
fn stroke(of: f64, swings: bool) -> String {
    let (of, unit) = if swings {
        (of.to_degrees(), "deg")
    } else {
        (of, "mm")
    };
    format!("{} {unit}", (of * 1e9).round() / 1e9)
}

impl MotionError {
    /// Key of the design file at fault, inside the table of the motion.
    #[must_use]
    pub fn key(&self) -> String {
        match self {
            Self::Spec(error) => error.key.clone(),
            _ => "segments".into(),
        }
    }
}

impl Motion {
    /// Joins segments into a motion.
    ///
    /// # Errors
    /// [`MotionError`] naming the rule broken: a value out of range, spans that are no whole turn, a
    /// cycle that does not come back, a jump of the velocity.
    pub fn resolve(spec: &MotionSpec) -> Result<Self, MotionError> {
        spec.validate()?;
        let total: f64 = spec.segments.iter().map(SegmentSpec::span).sum();
        if (total - TAU).abs() > COMPUTED * TAU {
            return Err(MotionError::Spans {
                degrees: total.to_degrees(),
            });
        }
        let changes: Vec<f64> = spec.segments.iter().map(SegmentSpec::change).collect();
        let rise: f64 = changes.iter().filter(|c| **c > 0.0).sum();
        let fall: f64 = -changes.iter().filter(|c| **c < 0.0).sum::<f64>();
        if (rise - fall).abs() > COMPUTED * rise.max(fall) {
            let swings = spec.swings() == Some(true);
            return Err(MotionError::Open { rise, fall, swings });
        }
        let mut pieces = Vec::with_capacity(spec.segments.len());
        let (mut from, mut level, mut lowest) = (0.0, 0.0_f64, 0.0_f64);
        for segment in &spec.segments {
            let span = segment.span();
            pieces.push(MotionPiece {
                from,
                span,
                level,
                course: Course::new(segment)?,
            });
            from += span;
            lowest = lowest.min(level);
            level += segment.change();
        }
        for piece in &mut pieces {
            piece.level -= lowest;
        }
        let motion = Self {
            start: spec.start.rem_euclid(TAU),
            pieces,
        };
        motion.velocity_is_continuous()?;
        Ok(motion)
    }

    fn velocity_is_continuous(&self) -> Result<(), MotionError> {
        let scale = self.peaks().velocity.value;
        for (input, before, after) in self.meetings() {
            if (after.velocity - before.velocity).abs() > COMPUTED * scale {
                return Err(MotionError::VelocityJump {
                    degrees: input.to_degrees(),
                    before: before.velocity,
                    after: after.velocity,
                });
            }
        }
        Ok(())
    }

    /// Input where each segment starts, with the jets on both sides.
    fn meetings(&self) -> impl Iterator<Item = (f64, MotionJet, MotionJet)> + '_ {
        (0..self.pieces.len()).map(|index| {
            let piece = &self.pieces[index];
            let before = &self.pieces[(index + self.pieces.len() - 1) % self.pieces.len()];
            let input = (self.start + piece.from).rem_euclid(TAU);
            (input, before.at(before.span), piece.at(0.0))
        })
    }

    /// The angles at which segments meet, in order from the start of the cycle.
    #[must_use]
    pub fn joins(&self) -> Vec<Join> {
        self.meetings()
            .map(|(input, before, after)| Join {
                input,
                acceleration_jump: after.acceleration - before.acceleration,
                jerk_jump: after.jerk - before.jerk,
            })
            .collect()
    }

    /// Maximum position and derivatives over the cycle, to the float limit.
    #[must_use]
    pub fn peaks(&self) -> Peaks {
        peaks(self)
    }
}

/// Maximum position and derivatives of any motion over one period.
#[must_use]
pub(crate) fn peaks(motion: &dyn Transmission) -> Peaks {
    let ends = ends(motion);
    let peak = |of: &dyn Fn(MotionJet) -> f64| maximum(|input| of(motion.at(input)), &ends);
    Peaks {
        lift: peak(&|m| m.position),
        velocity: peak(&|m| m.velocity.abs()),
        acceleration: peak(&|m| m.acceleration.abs()),
        jerk: peak(&|m| m.jerk.abs()),
    }
}

/// Ends of the analytic parts of one period.
pub(crate) fn ends(motion: &dyn Transmission) -> Vec<f64> {
    let period = motion.period();
    let mut ends = motion.breaks();
    match ends.first().copied() {
        // From break to break: no artificial seam at zero.
        Some(first) => ends.push(first + period),
        None => ends.extend([0.0, period]),
    }
    ends
}

impl Course {
    fn new(segment: &SegmentSpec) -> Result<Self, SpecError> {
        Ok(match segment {
            SegmentSpec::Rise(travel) | SegmentSpec::Return(travel) => {
                Self::Law(travel.law.resolve()?, segment.change())
            }
            SegmentSpec::Dwell(_) => Self::Rest,
            SegmentSpec::Transition(t) => {
                let (span, change) = (t.span, segment.change());
                let start = [
                    0.0,
                    t.start_velocity * span,
                    t.start_acceleration * span * span,
                ];
                let end = [
                    change,
                    t.end_velocity * span,
                    t.end_acceleration * span * span,
                ];
                Self::Polynomial(Coefficients::meeting(&start, &end))
            }
        })
    }
}

impl MotionPiece {
    /// Motion at an input counted from the start of the piece.
    fn at(&self, input: f64) -> MotionJet {
        let mut x = Taylor::constant(input / self.span);
        x.0[1] = 1.0 / self.span;
        let moved = match &self.course {
            Course::Rest => Taylor::constant(0.0),
            Course::Law(law, stroke) => law.of(x) * Taylor::constant(*stroke),
            Course::Polynomial(polynomial) => polynomial.of(x),
        };
        MotionJet::from_series(&(Taylor::constant(self.level) + moved))
    }

    fn breaks(&self) -> impl Iterator<Item = f64> + '_ {
        let inner = match &self.course {
            Course::Law(law, _) => law.breaks(),
            Course::Rest | Course::Polynomial(_) => Vec::new(),
        };
        let inside = inner.into_iter().map(|x| self.from + x * self.span);
        std::iter::once(self.from).chain(inside)
    }
}

impl Transmission for Motion {
    fn at(&self, input: f64) -> MotionJet {
        let mut along = (input - self.start).rem_euclid(TAU);
        if along >= TAU {
            // A tiny negative remainder rounds to the whole turn.
            along = 0.0;
        }
        let after = self.pieces.partition_point(|piece| piece.from <= along);
        let piece = &self.pieces[after.max(1) - 1];
        piece.at((along - piece.from).min(piece.span))
    }

    fn breaks(&self) -> Vec<f64> {
        let of_pieces = self.pieces.iter().flat_map(MotionPiece::breaks);
        let mut breaks: Vec<f64> = of_pieces
            .map(|from| (self.start + from).rem_euclid(TAU))
            .collect();
        breaks.sort_by(f64::total_cmp);
        breaks
    }
}

#[cfg(test)]
mod tests;
