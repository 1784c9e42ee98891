use centrode_geometry::{Outline, Tolerance, Vector};
use centrode_mechanism::machine::{Joint, JointKind, Machine};
use nalgebra::Rotation2;

use super::{BodyError, Clearance, InterferenceError, MotionError, Moving, PoseJet, Shares};

/// Difference of a direction from the drawing plane, or from its normal, that is rounding.
const PLANE: f64 = 1e-12;

/// Reason why the clearance of two links cannot be determined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinkClearanceError {
    /// A link that is not there, or one link twice.
    #[error("links {links:?} are not two of the machine's {count}")]
    Links {
        /// The links asked for.
        links: [usize; 2],
        /// Links of the machine.
        count: usize,
    },
    /// A joint that leads out of the plane.
    #[error("the joint of {link} leads out of the plane of the two links")]
    OutOfPlane {
        /// Name of the link it carries.
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

/// Least clearance, over one period of the input, of the contours with which two links of a machine touch others; none
/// where no two of them overlap in height.
///
/// Both links are seen from the nearest link that carries them. Clearances are mm, inputs rad, points in that link's
/// frame; `pair` is the two links. `least` is above the true clearance by no more than the tolerance, `lower_bound` below
/// it by no more, as [`clearance`](super::clearance) tells. Teeth in mesh overlap by their penetration.
///
/// # Errors
/// [`LinkClearanceError`] for a link that is not there, and for a joint between the two that turns about another axis than z
/// or slides along it.
pub fn between_links(
    machine: &Machine,
    links: [usize; 2],
    tolerance: Tolerance,
) -> Result<Option<Clearance>, LinkClearanceError> {
    let count = machine.links.len();
    if links[0] == links[1] || links.iter().any(|link| *link >= count) {
        return Err(LinkClearanceError::Links { links, count });
    }
    let chains = apart(machine, links);
    for joint in chains.iter().flatten() {
        if !in_plane(joint) {
            let link = machine.links[joint.child].name.clone();
            return Err(LinkClearanceError::OutOfPlane { link });
        }
    }
    let shares = Shares::of(tolerance);
    let inputs = [0.0, machine.input.period];
    let mut least: Option<Clearance> = None;
    for [one, other] in level_pairs(machine, links, &chains) {
        let bodies = [one, other].map(|outline| shares.body(std::slice::from_ref(outline)));
        let [a, b] = bodies;
        let (a, b) = (a?, b?);
        let motions = [
            shares.motion(&a, inputs, |input| pose(&chains[0], input))?,
            shares.motion(&b, inputs, |input| pose(&chains[1], input))?,
        ];
        let moving =
            [(&a, &motions[0]), (&b, &motions[1])].map(|(body, motion)| Moving { body, motion });
        let Some(found) = shares.least(&moving, &[[0, 1]], inputs)? else {
            continue;
        };
        least = Some(match least {
            None => found,
            Some(best) => {
                let nearer = if found.least < best.least {
                    found
                } else {
                    best
                };
                Clearance {
                    lower_bound: found.lower_bound.min(best.lower_bound),
                    ..nearer
                }
            }
        });
    }
    Ok(least.map(|found| Clearance {
        pair: links,
        ..found
    }))
}

/// Joints that carry each of two links, from the nearest link that carries both.
fn apart(machine: &Machine, links: [usize; 2]) -> [Vec<&Joint>; 2] {
    let [mut one, mut other] = links.map(|link| {
        let mut chain = Vec::new();
        let mut at = link;
        while let Some(joint) = machine.joints.iter().find(|joint| joint.child == at) {
            chain.push(joint);
            at = joint.parent;
            if chain.len() > machine.joints.len() {
                break;
            }
        }
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

/// Whether a joint keeps its link's plane.
fn in_plane(joint: &Joint) -> bool {
    let [x, y, z] = joint.axis;
    let flat = joint.turn[0].abs() <= PLANE && joint.turn[1].abs() <= PLANE;
    flat && match joint.kind {
        JointKind::Turning => x.abs() <= PLANE && y.abs() <= PLANE,
        JointKind::Sliding(_) => z.abs() <= PLANE,
        _ => true,
    }
}

/// Contours of both links that overlap in height.
fn level_pairs<'a>(
    machine: &'a Machine,
    links: [usize; 2],
    chains: &[Vec<&Joint>; 2],
) -> Vec<[&'a Outline; 2]> {
    let surfaces = |which: usize| {
        let height: f64 = chains[which].iter().map(|joint| joint.origin[2]).sum();
        let of_link = machine.links[links[which]].surfaces.iter();
        of_link
            .map(|&index| &machine.surfaces[index])
            .map(move |surface| (&surface.outline, surface.span.map(|end| end + height)))
            .collect::<Vec<_>>()
    };
    let (ours, theirs) = (surfaces(0), surfaces(1));
    let mut pairs = Vec::new();
    for (one, [low, high]) in &ours {
        for (other, [bottom, top]) in &theirs {
            if low < top && bottom < high {
                pairs.push([*one, *other]);
            }
        }
    }
    pairs
}

/// Pose of the last link of a chain in the frame of the link that carries the first, with its first derivative.
fn pose(chain: &[&Joint], input: f64) -> PoseJet {
    let mut found = PoseJet {
        position: nalgebra::Point2::origin(),
        angle: 0.0,
        velocity: Vector::zeros(),
        turning: 0.0,
    };
    for joint in chain {
        found = step(
            &found,
            [joint.origin[0], joint.origin[1]].into(),
            Vector::zeros(),
        );
        found.angle += joint.turn[2];
        let coordinate = joint.law.at(input);
        let axis = Vector::new(joint.axis[0], joint.axis[1]);
        match joint.kind {
            JointKind::Turning => {
                found.angle += joint.axis[2] * coordinate.position;
                found.turning += joint.axis[2] * coordinate.velocity;
            }
            JointKind::Sliding(_) => {
                let (way, speed) = (axis * coordinate.position, axis * coordinate.velocity);
                found = step(&found, way, speed);
            }
            _ => {}
        }
    }
    found
}

/// A frame moved by a vector of its own that changes at a speed of its own.
fn step(frame: &PoseJet, way: Vector, speed: Vector) -> PoseJet {
    let turn = Rotation2::new(frame.angle);
    let arm = turn * way;
    PoseJet {
        position: frame.position + arm,
        velocity: frame.velocity + Vector::new(-arm.y, arm.x) * frame.turning + turn * speed,
        ..*frame
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;
    use std::sync::Arc;

    use super::*;
    use centrode_geometry::{Point, Segment};
    use centrode_mechanism::machine::{Constant, Input, Linear, Link, Surface};

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
    fn machine(height: f64) -> Machine {
        let mut machine = Machine {
            input: Input {
                name: "crank".into(),
                period: TAU,
                speed: 1.0,
            },
            ..Machine::default()
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
        // The crank's pin is nearest at 50 mm; the squares keep level and reach 5 and 10 mm towards each other.
        assert!((found.least - 15.0).abs() < 1e-4, "{found:?}");
        assert!(found.lower_bound <= 15.0 && found.lower_bound > 15.0 - 1e-4);
        assert!((found.input - (TAU - 0.3)).abs() < 0.3, "{found:?}");
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
