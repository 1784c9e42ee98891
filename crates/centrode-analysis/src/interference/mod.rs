//! Clearance of moving bodies over a whole cycle, proven also between the samples.

mod body;
mod depth;
mod later;
mod links;
mod motion;
mod parry;
mod sweep;

use centrode_geometry::{Outline, Point, Tolerance};

pub use body::{Body, BodyError};
pub use later::DelayedMotion;
pub use links::{LinkClearanceError, LinkPair, between_links};
pub use motion::{Bend, Motion, MotionError, PoseJet, Rest, Tabulated, Uniform};

use depth::deepest;
use motion::{Frame, ascending};
use parry::Boundary;
use sweep::approach;

/// Body with its motion.
#[derive(Clone, Copy, Debug)]
pub struct Moving<'a> {
    /// Shape.
    pub body: &'a Body,
    /// Pose as a function of the input.
    pub motion: &'a dyn Motion,
}

/// Clearance of two bodies while the input runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Minimum distance found, mm. If the bodies overlap it is negative: minus the depth of the deepest point of one body
    /// inside the other.
    pub minimum: f64,
    /// Proven lower bound of the clearance, mm.
    pub lower_bound: f64,
    /// Input at which `minimum` was found, rad.
    pub input: f64,
    /// Closest points of the two bodies there, in the common frame; for bodies that overlap, the deepest
    /// point twice.
    pub points: [Point; 2],
    /// Indices of the two bodies in the list.
    pub pair: [usize; 2],
}

/// Division of a tolerance: the errors of two bodies, their motions and the search sum up to the tolerance. Then the minimum
/// clearance found exceeds the true clearance by at most the tolerance, and the bound is below it by at most the tolerance.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhaseShifts {
    body: Tolerance,
    motion: Tolerance,
    search: Tolerance,
}

impl PhaseShifts {
    pub(crate) fn new(tolerance: Tolerance) -> Self {
        Self {
            body: tolerance.scaled(0.125),
            motion: tolerance.scaled(0.0625),
            search: tolerance.scaled(0.625),
        }
    }

    /// Makes a body of outlines, with the body's part of the tolerance.
    pub(crate) fn body(self, outlines: &[Outline]) -> Result<Body, BodyError> {
        Body::new(outlines, self.body)
    }

    /// Makes a motion of a body, with the motion's part of the tolerance.
    pub(crate) fn motion(
        self,
        body: &Body,
        inputs: [f64; 2],
        motion: impl FnMut(f64) -> PoseJet,
    ) -> Result<Tabulated, MotionError> {
        Tabulated::within(inputs, body.reach(), motion, self.motion)
    }

    /// Minimum clearance among pairs of bodies, with the search's part of the tolerance.
    pub(crate) fn minimum(
        self,
        bodies: &[Moving<'_>],
        pairs: &[[usize; 2]],
        inputs: [f64; 2],
    ) -> Result<Option<Clearance>, InterferenceError> {
        minimum_clearance(bodies, pairs, inputs, self.search)
    }
}

/// Reason why a clearance cannot be determined.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InterferenceError {
    /// Inputs that do not ascend, or a pose that is not finite.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A pair that names a body that does not exist, or one body twice.
    #[error("the pair {pair:?} must name two different bodies; there are {bodies}")]
    Pair {
        /// The pair.
        pair: [usize; 2],
        /// Number of bodies.
        bodies: usize,
    },
}

/// Minimum clearance of two bodies while the input runs from the first to the second of `inputs`.
///
/// The search halves intervals of the input until no interval can contain a clearance below the minimum found minus the
/// tolerance. Within an interval the maximum second derivative limits the distance of every point from its tangent.
/// `lower_bound` is below `minimum` by at most the tolerance, the flattening of both bodies and the deviation of both motions;
/// it is proven if [`Motion::bend`] is. Poses may be given in any common frame; the search is fastest in the frame in which
/// the bodies have the minimum motion, such as the carrier's frame for arms on a carrier. Arms that follow one another in equal phases move
/// along one curve: one pair is enough.
///
/// A body inside another, or one that passes through it between two samples, overlaps it. Cost: a few hundred evaluations of
/// the few edges that come close; more for bodies that overlap. If bodies are equally near or deep all along, the tolerance
/// doubles after every 50,000,000 tests of near parts, or 200,000 tests of parts inside: `lower_bound` is then farther from
/// `minimum`.
///
/// # Errors
/// [`InterferenceError::Motion`] if `inputs` do not ascend or a pose is not finite.
pub fn clearance(
    a: &Moving<'_>,
    b: &Moving<'_>,
    inputs: [f64; 2],
    tolerance: Tolerance,
) -> Result<Clearance, InterferenceError> {
    let found = below([a, b], [0, 1], inputs, f64::INFINITY, tolerance)?;
    // Nothing is at infinity: a pair always has a minimum distance.
    let nowhere = MotionError::NotFinite { input: inputs[0] };
    Ok(found.closest.ok_or(nowhere)?)
}

/// Minimum clearance among pairs of bodies, each given by two indices into `bodies`; `None` if there are no pairs.
///
/// Faster than [`clearance`] of every pair: each pair is searched only for clearances below the minimum of the pairs before
/// it.
/// `lower_bound` holds for all pairs.
///
/// # Errors
/// [`InterferenceError`] for an invalid pair, and the errors of [`clearance`].
pub fn minimum_clearance(
    bodies: &[Moving<'_>],
    pairs: &[[usize; 2]],
    inputs: [f64; 2],
    tolerance: Tolerance,
) -> Result<Option<Clearance>, InterferenceError> {
    let mut minimum: Option<Clearance> = None;
    for &pair in pairs {
        let [i, j] = pair;
        let (Some(a), Some(b), true) = (bodies.get(i), bodies.get(j), i != j) else {
            let bodies = bodies.len();
            return Err(InterferenceError::Pair { pair, bodies });
        };
        let beat = minimum.map_or(f64::INFINITY, |c| c.minimum);
        let found = below([a, b], pair, inputs, beat, tolerance)?;
        let bound = minimum.map_or(f64::INFINITY, |c| c.lower_bound);
        minimum = found.closest.or(minimum);
        if let Some(minimum) = &mut minimum {
            minimum.lower_bound = found.bound.min(bound);
        }
    }
    Ok(minimum)
}

/// Tolerance of a search, mm. It doubles after every `most` steps, so that the search ends in time.
#[derive(Debug)]
struct Patience {
    tolerance: f64,
    steps: u32,
    most: u32,
}

impl Patience {
    fn new(tolerance: f64, most: u32) -> Self {
        Self {
            tolerance,
            steps: 0,
            most,
        }
    }

    /// Tolerance of one more step.
    fn after_one_more(&mut self) -> f64 {
        self.steps += 1;
        if self.steps == self.most {
            (self.tolerance, self.steps) = (2.0 * self.tolerance, 0);
        }
        self.tolerance
    }
}

/// Result of the search of a pair.
struct Search {
    /// Clearance, if the pair comes closer than the clearance to beat.
    closest: Option<Clearance>,
    bound: f64,
}

fn below(
    both: [&Moving<'_>; 2],
    pair: [usize; 2],
    inputs: [f64; 2],
    beat: f64,
    tolerance: Tolerance,
) -> Result<Search, InterferenceError> {
    ascending(inputs)?;
    // The search cannot be finer than rounding.
    let size = both[0].extent(inputs)? + both[1].extent(inputs)?;
    let decided = tolerance.mm().max(1e-13 * size);
    let unsure = both.iter().map(|m| m.unsure()).sum::<f64>() + 1e-14 * size;
    if !inside_one_another(both, inputs[0])? && beat > 0.0 {
        let found = approach(both, inputs, beat, decided)?;
        if found.bound > 0.0 {
            let closest = match found.input {
                Some(input) => gap(both, input)?.map(|(minimum, points)| Clearance {
                    minimum,
                    lower_bound: found.bound.min(minimum) - unsure,
                    input,
                    points,
                    pair,
                }),
                None => None,
            };
            return Ok(Search {
                closest,
                bound: found.bound - unsure,
            });
        }
    }
    let found = deepest(both, inputs, -beat, decided)?;
    let bound = -found.bound - unsure;
    let closest = found.place.map(|(input, point)| Clearance {
        minimum: -found.depth,
        lower_bound: bound,
        input,
        points: [point; 2],
        pair,
    });
    Ok(Search { closest, bound })
}

/// Distance and closest points at one input.
fn gap(both: [&Moving<'_>; 2], input: f64) -> Result<Option<(f64, [Point; 2])>, InterferenceError> {
    let poses = [both[0].frame(input)?, both[1].frame(input)?].map(|f| f.jet.isometry());
    let boundaries = both.map(|m| m.body.boundary());
    Ok(Boundary::gap(boundaries, [&poses[0], &poses[1]]))
}

/// Whether a piece of one body lies inside the other. It stays so unless the boundaries meet.
fn inside_one_another(both: [&Moving<'_>; 2], input: f64) -> Result<bool, InterferenceError> {
    let frames = [both[0].frame(input)?, both[1].frame(input)?];
    Ok([0, 1].into_iter().any(|own| {
        both[own].body.corners().any(|corner| {
            let seen = frames[1 - own].inside(&frames[own].moved(&corner).0);
            both[1 - own].body.contains(seen)
        })
    }))
}

impl Moving<'_> {
    fn frame(&self, input: f64) -> Result<Frame, MotionError> {
        let jet = self.motion.at(input);
        if jet.is_finite() {
            Ok(Frame::new(jet))
        } else {
            Err(MotionError::NotFinite { input })
        }
    }

    /// Maximum error of the position of a point, mm, from the flattened outline and the tabulated motion.
    fn unsure(&self) -> f64 {
        let (far, turned) = self.motion.deviation();
        self.body.flattening() + far + turned * self.body.reach()
    }

    /// Maximum size of the body's coordinates at both inputs.
    fn extent(&self, inputs: [f64; 2]) -> Result<f64, MotionError> {
        let mut far: f64 = 0.0;
        for input in inputs {
            far = far.max(self.frame(input)?.jet.position.coords.norm());
        }
        Ok(far + self.body.reach())
    }
}

#[cfg(test)]
mod tests;
