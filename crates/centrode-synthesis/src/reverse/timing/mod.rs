//! Angle of a machine's crank as a function of the input, such that the output of the machine meets the requirements.

mod free;
mod order;
mod search;

use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::{Extreme, bracketed_root, maximum_of_each, piece_ends};
use thiserror::Error;

use self::free::Free;
use self::order::{Placed, Swing};
use self::search::StretchShape;
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::degrees;
use centrode_spec::digits::stated;

/// Number of equal parts of a turn, in each of which the ratio has few extremes.
const PARTS: u32 = 32;

/// Part of a turn over which something is required of an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Name, for messages.
    pub name: String,
    /// First and last input, rad.
    pub within: [f64; 2],
    /// Motion required there.
    pub required: Required,
}

/// Motion of an output over a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Required {
    /// The output moves evenly from one position to another, mm or rad.
    Even([f64; 2]),
    /// The output stays within a band at an end of its stroke, mm or rad: gears, whose ratio is never zero, can only approximate
    /// a rest.
    Rest(f64),
}

/// Law of a crank by the input with which the output of a machine does what is required.
///
/// The output q is known by the angle tau of the crank, with one maximum and one minimum in a turn. Where q must be w(phi), tau
/// solves `q(tau) = w(phi)`. Over a rest the crank runs evenly through the end of the stroke. In between `ln(d tau/d phi)` is a
/// polynomial that joins both sides with two derivatives and makes the turn whole, so the crank never turns back. Two things are
/// free: how far the crank moves within the band of a rest outside the section, and where between sections it is faster. They are
/// chosen such that the maximum convex curvature of both pitch curves is smallest.
#[derive(Clone, Debug)]
pub struct Timing {
    output: Arc<dyn Transmission>,
    swing: Swing,
    /// Parts of the turn in ascending order, from the start of the first section over one turn.
    stretches: Vec<Stretch>,
}

/// A part of the turn.
#[derive(Clone, Debug)]
struct Stretch {
    /// Inputs, rad.
    within: [f64; 2],
    /// Angles of the crank there, rad.
    angles: [f64; 2],
    course: Course,
}

#[derive(Clone, Debug)]
enum Course {
    /// The output moves evenly from one position to another.
    Even([f64; 2]),
    /// The crank turns evenly.
    Turn,
    Free(Free),
}

/// Reason why no law of the crank does what is required.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TimingError {
    /// Nothing required.
    #[error("nothing is required of the output")]
    Nothing,
    /// An output that does not come back.
    #[error("the output moves by {} in a turn of the crank and does not come back", stated(*advance))]
    Advances {
        /// Change of the output in a turn, mm or rad.
        advance: f64,
    },
    /// An output with more than two turning points, or none.
    #[error(
        "the output turns back {count} times in a turn of the crank; with one maximum and one minimum it does twice"
    )]
    Swings {
        /// Number of turning points.
        count: usize,
    },
    /// A section of uniform motion that reaches an end of the stroke or goes beyond.
    #[error(
        "{name}: the output must move evenly from {} to {}, but its stroke is from {} to {}, and it stops at both ends: require positions between them",
        stated(*from), stated(*to), stated(*minimum), stated(*maximum)
    )]
    Beyond {
        /// Section.
        name: String,
        /// First required position.
        from: f64,
        /// Last.
        to: f64,
        /// Minimum position of the output.
        minimum: f64,
        /// Maximum.
        maximum: f64,
    },
    /// A rest that is not at an end of the stroke.
    #[error(
        "{name}: the output is required to rest at {}, but the gears never stop; require a rest at an end of the stroke instead",
        stated(*place)
    )]
    Stationary {
        /// Section.
        name: String,
        /// The position.
        place: f64,
    },
    /// A rest whose band is too small, or half of the stroke or more.
    #[error(
        "{name}: the rest has a band of {} in a stroke of {}; the band must be above {} and below half of the stroke",
        stated(*band), stated(*stroke), stated(*minimum)
    )]
    Band {
        /// Section.
        name: String,
        /// Band given, mm or rad.
        band: f64,
        /// Stroke.
        stroke: f64,
        /// Minimum band: with less the gears would stop within rounding.
        minimum: f64,
    },
    /// Sections of the input that touch or overlap, or whose limits are invalid.
    #[error(
        "{name} is from {from} deg to {to} deg, and {other} begins at {next} deg: leave a gap between them, with all of them within one turn"
    )]
    Overlap {
        /// Section.
        name: String,
        /// Its start, degrees.
        from: f64,
        /// Its end, degrees.
        to: f64,
        /// The next.
        other: String,
        /// Its start, degrees.
        next: f64,
    },
    /// Sections that the output cannot pass in one turn of the crank.
    #[error(
        "the output cannot pass {names} in this order in one turn of the crank, in which it goes once from its minimum to its maximum and once back"
    )]
    Order {
        /// Names in the order of the input.
        names: String,
    },
    /// Too large a turn of the crank between two sections.
    #[error(
        "between {from} and {to}, the crank must turn by {turn:.4} deg within {room:.4} deg of the input, which no smooth law does: leave a larger gap"
    )]
    Abrupt {
        /// Section before.
        from: String,
        /// Section after.
        to: String,
        /// Turn of the crank, degrees.
        turn: f64,
        /// Room, degrees.
        room: f64,
    },
}

impl TimingError {
    /// The error of an output that is an angle, in the degrees of a design file instead of rad.
    pub(crate) fn in_degrees(mut self) -> Self {
        let places = match &mut self {
            Self::Advances { advance } => vec![advance],
            Self::Beyond {
                from,
                to,
                minimum,
                maximum,
                ..
            } => vec![from, to, minimum, maximum],
            Self::Stationary { place, .. } => vec![place],
            Self::Band {
                band,
                stroke,
                minimum,
                ..
            } => vec![band, stroke, minimum],
            _ => Vec::new(),
        };
        for place in places {
            *place = degrees::rounded(*place);
        }
        self
    }
}

impl Timing {
    /// Finds the law of the crank; `output` is the output's position by the crank's angle, over one turn.
    ///
    /// # Errors
    /// [`TimingError`] with the section and the numbers: an output that turns back more than twice, positions beyond its stroke,
    /// sections that overlap or that it cannot pass in their order.
    pub fn new(output: Arc<dyn Transmission>, sections: &[Section]) -> Result<Self, TimingError> {
        if sections.is_empty() {
            return Err(TimingError::Nothing);
        }
        let swing = Swing::new(output.as_ref())?;
        let mut best: Result<(f64, Self), TimingError> = Err(TimingError::Nothing);
        for placed in order::placed(output.as_ref(), &swing, sections)? {
            let made = search::mildest(&output, &swing, &placed);
            best = match (best, made) {
                (Ok(best), Ok(made)) if made.0 < best.0 => Ok(made),
                (Ok(best), _) => Ok(best),
                (Err(_), made) => made,
            };
        }
        Ok(best?.1)
    }

    /// The law of sections with known crank angles and shapes.
    fn through(
        output: &Arc<dyn Transmission>,
        swing: &Swing,
        placed: &[Placed<'_>],
        shapes: &[StretchShape],
    ) -> Result<Self, TimingError> {
        let mut law = Self {
            output: Arc::clone(output),
            swing: swing.clone(),
            stretches: Vec::new(),
        };
        let fixed = placed.iter().zip(shapes);
        let fixed: Vec<Stretch> = fixed.map(|(p, shape)| Stretch::new(p, shape)).collect();
        for (i, stretch) in fixed.iter().enumerate() {
            let next = (i + 1) % fixed.len();
            let mut after = fixed[next].clone();
            if next == 0 {
                after.within = after.within.map(|input| input + TAU);
                after.angles = after.angles.map(|angle| angle + TAU);
            }
            let [_, from] = stretch.within;
            let [to, _] = after.within;
            let ends = [law.jet(stretch, from), law.jet(&after, to)];
            let free = Free::between([from, to], &ends, shapes[i].skew);
            let free = free.ok_or_else(|| TimingError::Abrupt {
                from: placed[i].section.name.clone(),
                to: placed[next].section.name.clone(),
                turn: degrees::rounded(ends[1].position - ends[0].position),
                room: degrees::rounded(to - from),
            })?;
            law.stretches.push(stretch.clone());
            law.stretches.push(Stretch {
                within: [from, to],
                angles: ends.map(|end| end.position),
                course: Course::Free(free),
            });
        }
        Ok(law)
    }

    /// The law within a stretch.
    fn jet(&self, stretch: &Stretch, input: f64) -> MotionJet {
        let [from, to] = stretch.within;
        let [first, last] = stretch.angles;
        match &stretch.course {
            Course::Even([start, end]) => {
                let rate = (end - start) / (to - from);
                let place = start + rate * (input - from);
                let miss = |angle: f64| self.output.at(angle).position - place;
                let [before, after] = [first, last].map(miss);
                let angle = if (before > 0.0) == (after > 0.0) {
                    // Near an end rounding decides: the nearer end is used.
                    if before.abs() < after.abs() {
                        first
                    } else {
                        last
                    }
                } else {
                    bracketed_root(miss, first, last, before, after)
                };
                let even = MotionJet::uniform(place, rate);
                self.output.at(angle).inverse(angle).after(&even)
            }
            Course::Turn => {
                let rate = (last - first) / (to - from);
                MotionJet::uniform(first + rate * (input - from), rate)
            }
            Course::Free(free) => free.at(first, input),
        }
    }

    /// Output of the machine by the crank's angle.
    #[must_use]
    pub fn output(&self) -> &Arc<dyn Transmission> {
        &self.output
    }

    /// Minimum and maximum position of the output, mm or rad.
    #[must_use]
    pub fn places(&self) -> [f64; 2] {
        self.swing.places()
    }

    /// Minimum and maximum speed of the crank by the input's, and the inputs there.
    #[must_use]
    pub fn ratios(&self) -> [Extreme; 2] {
        let start = self.stretches[0].within[0];
        let ratio = |input: f64| {
            let ratio = self.at(input).velocity.ln();
            [-ratio, ratio]
        };
        let ends: Vec<f64> = self.stretches.iter().map(|s| s.within[0]).collect();
        let [minimum, maximum] =
            maximum_of_each(ratio, &piece_ends(start, start + TAU, PARTS, &ends));
        let value = |of: Extreme, log: f64| Extreme {
            value: log.exp(),
            ..of
        };
        [
            value(minimum, -minimum.value),
            value(maximum, maximum.value),
        ]
    }
}

impl Stretch {
    fn new(placed: &Placed<'_>, shape: &StretchShape) -> Self {
        let [from, to] = placed.angles;
        let angles = match placed.section.required {
            Required::Even(_) => placed.angles,
            Required::Rest(_) => {
                let half = 0.5 * (to - from);
                [from + shape.late * half, to - shape.early * half]
            }
        };
        Self {
            within: placed.within,
            angles,
            course: match placed.section.required {
                Required::Even(places) => Course::Even(places),
                Required::Rest(_) => Course::Turn,
            },
        }
    }
}

impl Transmission for Timing {
    fn at(&self, input: f64) -> MotionJet {
        let start = self.stretches[0].within[0];
        let turns = ((input - start) / TAU).floor();
        let inside = input - turns * TAU;
        let after = self.stretches.partition_point(|s| s.within[0] <= inside);
        let stretch = &self.stretches[after.saturating_sub(1)];
        let [from, to] = stretch.within;
        let mut jet = self.jet(stretch, inside.clamp(from, to));
        jet.position += turns * TAU;
        jet
    }

    fn advance(&self) -> f64 {
        TAU
    }

    fn breaks(&self) -> Vec<f64> {
        let ends = self.stretches.iter().map(|s| s.within[0].rem_euclid(TAU));
        centrode_kinematics::transmission::sorted(ends, TAU)
    }
}
