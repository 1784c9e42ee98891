use centrode_geometry::Tolerance;
use centrode_kinematics::machine::{FrameJet, Joint, JointKind, LinkedMachine, Surface};

use crate::side_by_side::each;

use super::{
    Body, BodyError, Clearance, InterferenceError, MotionError, Moving, PhaseShifts, PoseJet,
};

/// Range of the input that counts as one position, rad. A larger range includes motion of the links, a smaller one is
/// lost in rounding.
const MOMENT: f64 = 1e-9;

/// Reason why the clearance of two links cannot be determined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkClearanceError {
    /// A link that does not exist, or one link twice.
    #[error("links {links:?} must be two different links of the machine, which has {count}")]
    Links {
        /// The requested links.
        links: [usize; 2],
        /// Number of links of the machine.
        count: usize,
    },
    /// A joint whose motion leaves the plane of the two links.
    #[error("the joint of {link} moves it out of the plane of the two links")]
    OutOfPlane {
        /// Name of the link that the joint carries.
        link: String,
    },
    /// A contour makes no body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A pose is not finite.
    #[error(transparent)]
    Interference(#[from] InterferenceError),
}

impl From<MotionError> for LinkClearanceError {
    fn from(error: MotionError) -> Self {
        Self::Interference(error.into())
    }
}

/// Minimum clearance, over one period of the input, between the contact surfaces of two links of a machine; `None` if no two
/// of them overlap in height.
///
/// # Errors
/// [`LinkClearanceError`] as for [`LinkPair::new`].
pub fn between_links(
    machine: &LinkedMachine,
    links: [usize; 2],
    tolerance: Tolerance,
) -> Result<Option<Clearance>, LinkClearanceError> {
    let surfaces = links.map(|link| {
        let own = machine.links.get(link).map(|link| &link.surfaces);
        let own = own.into_iter().flatten();
        own.map(|&index| &machine.surfaces[index]).collect()
    });
    let pair = LinkPair::new(machine, links, surfaces, tolerance)?;
    pair.map(|pair| pair.over([0.0, machine.input.period]))
        .transpose()
}

/// Contours on two links of a machine, prepared for their clearance.
#[derive(Clone, Debug)]
pub struct LinkPair {
    links: [usize; 2],
    /// Joints that carry each link from the nearest link that carries both.
    chains: [Vec<Joint>; 2],
    /// The bodies, each with its link: 0 or 1.
    bodies: Vec<(usize, Body)>,
    /// Bodies that overlap in height.
    pairs: Vec<[usize; 2]>,
    shares: PhaseShifts,
}

impl LinkPair {
    /// Prepares contours on two links: those of the links themselves or others; `None` if no two of them overlap in height.
    ///
    /// # Errors
    /// [`LinkClearanceError`] for a link that does not exist, and for a joint between the two that turns about another axis
    /// than z or slides along z.
    pub fn new(
        machine: &LinkedMachine,
        links: [usize; 2],
        surfaces: [Vec<&Surface>; 2],
        tolerance: Tolerance,
    ) -> Result<Option<Self>, LinkClearanceError> {
        let count = machine.links.len();
        if links[0] == links[1] || links.iter().any(|link| *link >= count) {
            return Err(LinkClearanceError::Links { links, count });
        }
        Self::of_any(machine, links, surfaces, tolerance)
    }

    /// Prepares contours like [`new`](Self::new), also of a single link, on which both sets of contours are fixed. The links
    /// must exist.
    pub(crate) fn of_any(
        machine: &LinkedMachine,
        links: [usize; 2],
        surfaces: [Vec<&Surface>; 2],
        tolerance: Tolerance,
    ) -> Result<Option<Self>, LinkClearanceError> {
        let chains = apart(machine, links);
        for joint in chains.iter().flatten() {
            if !joint.is_planar() {
                let link = machine.links[joint.child].name.clone();
                return Err(LinkClearanceError::OutOfPlane { link });
            }
        }
        let height = |link: usize| -> f64 {
            let chain = chains[link].iter();
            chain.map(|joint| joint.origin[2]).sum()
        };
        let all: Vec<(usize, &Surface)> = surfaces
            .iter()
            .enumerate()
            .flat_map(|(link, all)| all.iter().map(move |surface| (link, *surface)))
            .collect();
        let level = |&[i, j]: &[usize; 2]| {
            let ((one, a), (other, b)) = (all[i], all[j]);
            let [low, high] = a.span.map(|end| end + height(one));
            let [bottom, top] = b.span.map(|end| end + height(other));
            one != other && low < top && bottom < high
        };
        let count = all.len();
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
        let pairs: Vec<[usize; 2]> = pairs.filter(level).collect();
        if pairs.is_empty() {
            return Ok(None);
        }
        let shares = PhaseShifts::new(tolerance);
        let bodies = all.iter().map(|(link, surface)| {
            let body = shares.body(std::slice::from_ref(&surface.outline))?;
            Ok((*link, body))
        });
        Ok(Some(Self {
            links,
            bodies: bodies.collect::<Result<_, BodyError>>()?,
            chains: chains.map(|chain| chain.into_iter().cloned().collect()),
            pairs,
            shares,
        }))
    }

    /// Minimum clearance while the input runs from the first to the second of `inputs`.
    ///
    /// Both links are described in the frame of the nearest link that carries them. Clearances are in mm, inputs in rad,
    /// points in that frame; `pair` has the two links. `minimum` exceeds the true clearance by at most the tolerance, and
    /// `lower_bound` is below it by at most the tolerance, as described at [`clearance`](super::clearance). Teeth in mesh
    /// overlap by their penetration.
    ///
    /// # Errors
    /// [`LinkClearanceError`] if inputs do not ascend or a pose is not finite.
    pub fn over(&self, inputs: [f64; 2]) -> Result<Clearance, LinkClearanceError> {
        let motions = each(&self.bodies, |(link, body)| {
            let chain = &self.chains[*link];
            self.shares.motion(body, inputs, |input| pose(chain, input))
        });
        let motions = motions
            .into_iter()
            .collect::<Result<Vec<_>, MotionError>>()?;
        let moving: Vec<Moving<'_>> = self
            .bodies
            .iter()
            .zip(&motions)
            .map(|((_, body), motion)| Moving { body, motion })
            .collect();
        let minimum = self.shares.minimum(&moving, &self.pairs, inputs)?;
        // There is at least one pair, so there is a minimum distance.
        let nowhere = MotionError::NotFinite { input: inputs[0] };
        let found = minimum.ok_or(nowhere)?;
        Ok(Clearance {
            pair: self.links,
            ..found
        })
    }

    /// Clearance at one input, like [`over`](Self::over) for a range.
    ///
    /// # Errors
    /// [`LinkClearanceError`] if a pose is not finite.
    pub fn at(&self, input: f64) -> Result<Clearance, LinkClearanceError> {
        self.over([input, input + MOMENT])
    }
}

/// Joints that carry each of two links, from the nearest link that carries both.
fn apart(machine: &LinkedMachine, links: [usize; 2]) -> [Vec<&Joint>; 2] {
    let [mut one, mut other] = links.map(|link| {
        let mut chain: Vec<&Joint> = machine.carriers(link).collect();
        chain.reverse();
        chain
    });
    let shared = one
        .iter()
        .zip(&other)
        .take_while(|(a, b)| std::ptr::eq(**a, **b))
        .count();
    one.drain(..shared);
    other.drain(..shared);
    [one, other]
}

/// Pose of the last link of a chain in the frame of the link that carries the first, with its first derivative.
fn pose(chain: &[Joint], input: f64) -> PoseJet {
    let mut frame = FrameJet::identity();
    // Turns are added up: an angle read from the frame would not be continuous.
    let (mut angle, mut turning) = (0.0, 0.0);
    for joint in chain {
        let coordinate = joint.law.at(input);
        frame = frame.then(&joint.frame(&coordinate));
        angle += joint.turn[2];
        if joint.kind == JointKind::Turning {
            angle += joint.axis[2] * coordinate.position;
            turning += joint.axis[2] * coordinate.velocity;
        }
    }
    let origin = frame.point([0.0; 3]);
    PoseJet {
        position: origin.position.xy(),
        angle,
        velocity: origin.velocity.xy(),
        turning,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::sync::Arc;

    use super::*;
    use centrode_geometry::{Outline, Point, Segment};
    use centrode_kinematics::machine::{Constant, Input, Linear, Link};

    fn square(half: f64) -> Outline {
        let corner = |x: f64, y: f64| Point::new(x * half, y * half);
        let corners = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        let sides = (0..4).map(|i| Segment::Line(corners[i], corners[(i + 1) % 4]));
        Outline::new(sides.collect()).expect("closed")
    }

    /// A bar that turns about the origin and carries a square 50 mm out, and a square at rest 80 mm out.
    fn machine(height: f64) -> LinkedMachine {
        let mut machine = LinkedMachine {
            input: Input {
                name: "crank".into(),
                period: TAU,
                speed: 1.0,
            },
            ..LinkedMachine::default()
        };
        let surface = |name: &str, half: f64, low: f64| Surface {
            name: name.into(),
            outline: square(half),
            span: [low, low + 10.0],
            teeth: Vec::new(),
            coarseness: 1.0,
        };
        let ours = machine.surface(surface("ours", 5.0, 0.0));
        let theirs = machine.surface(surface("theirs", 10.0, height));
        let named = |name: &str, surfaces: Vec<usize>| Link {
            name: name.into(),
            surfaces,
            ..Link::default()
        };
        let frame = machine.link(named("frame", Vec::new()));
        let crank = machine.link(named("crank", Vec::new()));
        let tip = machine.link(named("tip", vec![ours]));
        let block = machine.link(named("block", vec![theirs]));
        machine.joint(Joint {
            kind: JointKind::Turning,
            law: Arc::new(Linear {
                start: 0.3,
                slope: 1.0,
            }),
            ..Joint::fixed(frame, crank)
        });
        machine.joint(Joint {
            kind: JointKind::Turning,
            law: Arc::new(Linear {
                start: -0.3,
                slope: -1.0,
            }),
            ..Joint::fixed(crank, tip).at([50.0, 0.0, 0.0])
        });
        machine.joint(Joint {
            law: Arc::new(Constant(0.0)),
            ..Joint::fixed(frame, block).at([80.0, 0.0, 0.0])
        });
        machine
    }

    #[test]
    fn a_square_kept_level_by_a_crank_passes_another_at_the_distance_of_the_drawing() {
        let tolerance = Tolerance::new(1e-4).expect("positive");
        let found = between_links(&machine(5.0), [2, 3], tolerance);
        let found = found.expect("determined").expect("level");
        // The crank points at the block: the pin is at x = 50 mm, the block at x = 80 mm. The squares stay level and reach 5 and
        // 10 mm towards each other: 80 - 50 - 15 = 15 mm.
        assert!((found.minimum - 15.0).abs() < 1e-4, "{found:?}");
        assert!(found.lower_bound <= 15.0 && found.lower_bound > 15.0 - 1e-4);
        // There 25 mm/rad^2 of the turn squared are within the tolerance.
        assert!((found.input - (TAU - 0.3)).abs() < 2e-3, "{found:?}");
        assert_eq!(found.pair, [2, 3]);
    }

    #[test]
    fn links_at_other_heights_and_links_that_are_not_there_have_no_clearance() {
        let tolerance = Tolerance::new(1e-3).expect("positive");
        assert_eq!(between_links(&machine(10.0), [2, 3], tolerance), Ok(None));
        let links = [2, 9];
        let refused = Err(LinkClearanceError::Links { links, count: 4 });
        assert_eq!(between_links(&machine(0.0), links, tolerance), refused);
        let mut tilted = machine(0.0);
        tilted.joints[1].turn = [0.5, 0.0, 0.0];
        let refused = between_links(&tilted, [2, 3], tolerance).expect_err("out of the plane");
        assert!(refused.to_string().contains("joint of tip"), "{refused}");
    }
}
