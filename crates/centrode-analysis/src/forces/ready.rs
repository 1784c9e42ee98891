use std::sync::Arc;

use centrode_kinematics::machine::{Guide, Joint, JointKind, LinkedMachine, Load};
use nalgebra::{Matrix3, Vector3};

use super::ForcesError;
use super::blocks::blocks;
use super::motion::Seat;
use super::tie::{Tie, between};

/// A machine prepared for the computation of its forces.
#[derive(Clone, Debug)]
pub struct Balance {
    pub(super) machine: Arc<LinkedMachine>,
    pub(super) seats: Vec<Seat>,
    /// Joints from the first link outwards.
    pub(super) order: Vec<usize>,
    /// Joint that carries each link.
    pub(super) carrier: Vec<Option<usize>>,
    pub(super) masses: Vec<Mass>,
    /// Steps that determine the forces that the tree alone does not, in the order of computation.
    pub(super) steps: Vec<Step>,
    /// Whether a force with an unknown line of action passes through a joint, per joint.
    pub(super) hidden: Vec<bool>,
    /// Whether the input drives a joint directly, per joint.
    pub(super) driven: Vec<bool>,
}

/// Mass of a link in its frame, kg and mm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mass {
    pub(super) link: usize,
    pub(super) mass: f64,
    pub(super) center: Vector3<f64>,
    pub(super) inertia: Matrix3<f64>,
}

/// A step that determines forces that the tree alone does not.
#[derive(Clone, Debug)]
pub(super) enum Step {
    /// Ties whose forces are found together.
    Ties(Vec<Tie>),
    /// A joint moved by another one.
    Follower(Follower),
}

/// A joint moved by another one through a cam or groove.
#[derive(Clone, Copy, Debug)]
pub(super) struct Follower {
    pub(super) joint: usize,
    pub(super) leader: usize,
    pub(super) guide: Option<(usize, Guide)>,
}

impl Balance {
    /// Prepares a machine.
    ///
    /// A joint moved by a closure, mesh or contact has no drive of its own. A joint that another joint leads through a cam or
    /// groove is driven by that joint: with the friction of a guide if there is one, otherwise without loss. Any other joint
    /// is driven by its law: the drive acts between the two links that it connects.
    ///
    /// # Errors
    /// [`ForcesError`] for invalid masses, for links held by more than one part, and for a part that does not reach the link
    /// it holds.
    pub fn new(machine: impl Into<Arc<LinkedMachine>>) -> Result<Self, ForcesError> {
        let machine: Arc<LinkedMachine> = machine.into();
        let masses = masses(&machine)?;
        let ties = Tie::all(&machine)?;
        let count = machine.joints.len();
        let mut driven: Vec<bool> = machine
            .joints
            .iter()
            .map(|joint| joint.kind != JointKind::Fixed)
            .collect();
        let mut hidden = vec![false; count];
        for tie in &ties {
            for &joint in &tie.held {
                driven[joint] = false;
            }
            if tie.is_vague(&machine) {
                tie.between
                    .iter()
                    .for_each(|(joint, _)| hidden[*joint] = true);
            }
        }
        let mut followers = Vec::new();
        for (joint, about) in machine.joints.iter().enumerate() {
            let Some(leader) = about.leader.filter(|_| driven[joint]) else {
                continue;
            };
            driven[joint] = false;
            let children = [leader, joint].map(|joint| machine.joints[joint].child);
            for (joint, _) in between(&machine, children) {
                hidden[joint] = true;
            }
            let mut guides = machine.guides.iter().copied().enumerate();
            let guide = guides.find(|(_, guide)| guide.joint == joint);
            followers.push(Follower {
                joint,
                leader,
                guide,
            });
        }
        let steps = steps(&machine, ties, &followers)?;
        let mut carrier = vec![None; machine.links.len()];
        for (index, joint) in machine.joints.iter().enumerate() {
            carrier[joint.child] = Some(index);
        }
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&joint| machine.carriers(machine.joints[joint].child).count());
        Ok(Self {
            seats: machine.joints.iter().map(Seat::new).collect(),
            order,
            carrier,
            masses,
            steps,
            hidden,
            driven,
            machine,
        })
    }

    /// The machine.
    #[must_use]
    pub fn machine(&self) -> &Arc<LinkedMachine> {
        &self.machine
    }

    /// Whether every link stays in the plane of the first link.
    #[must_use]
    pub fn is_planar(&self) -> bool {
        self.machine.joints.iter().all(Joint::is_planar)
    }

    /// Whether the input drives a joint directly: no teeth, pin, roller or other joint moves it.
    #[must_use]
    pub fn is_driven(&self, joint: usize) -> bool {
        self.driven[joint]
    }
}

/// Masses of the links and of the loads that they carry.
fn masses(machine: &LinkedMachine) -> Result<Vec<Mass>, ForcesError> {
    let own = machine.links.iter().enumerate();
    let own = own.filter_map(|(link, about)| {
        let about = about.mass.as_ref()?;
        Some(Mass {
            link,
            mass: about.mass,
            center: about.center.coords,
            inertia: about.inertia,
        })
    });
    let carried = machine.loads.iter().filter_map(|load| match *load {
        Load::Mass { link, at, mass } => Some(Mass {
            link,
            mass,
            center: at.into(),
            inertia: Matrix3::zeros(),
        }),
        _ => None,
    });
    let all: Vec<Mass> = own.chain(carried).collect();
    for mass in &all {
        let inertia = mass.inertia.diagonal().min();
        let good = |v: f64| v.is_finite() && v >= 0.0;
        if !(good(mass.mass) && good(inertia)) {
            return Err(ForcesError::Mass {
                link: machine.links[mass.link].name.clone(),
                mass: mass.mass,
                inertia,
            });
        }
    }
    Ok(all)
}

/// Ties and followers in an order in which each can be computed.
fn steps(
    machine: &LinkedMachine,
    ties: Vec<Tie>,
    followers: &[Follower],
) -> Result<Vec<Step>, ForcesError> {
    let apart = ties.len();
    let count = apart + followers.len();
    // Whether step `one` changes the force or torque that a joint must supply.
    let changes = |one: usize, joint: usize| match ties.get(one) {
        Some(tie) => tie.sign(joint) != 0.0,
        None => followers[one - apart].leader == joint,
    };
    let needs = |one: usize| -> Vec<bool> {
        let requested = match ties.get(one) {
            Some(tie) => tie.held.as_slice(),
            None => std::slice::from_ref(&followers[one - apart].joint),
        };
        let needed = |other: usize| requested.iter().any(|&joint| changes(other, joint));
        (0..count).map(needed).collect()
    };
    let ordered = blocks((0..count).map(needs).collect());
    let mut steps = Vec::new();
    for block in ordered {
        let follower = block.iter().find_map(|one| one.checked_sub(apart));
        let Some(follower) = follower.map(|one| followers[one]) else {
            let together = block.iter().map(|&one| ties[one].clone());
            steps.push(Step::Ties(together.collect()));
            continue;
        };
        if block.len() > 1 || follower.leader == follower.joint {
            return Err(ForcesError::Apart {
                holder: format!("the leading joint {}", machine.joint_name(follower.leader)),
                link: machine.links[machine.joints[follower.joint].child]
                    .name
                    .clone(),
            });
        }
        steps.push(Step::Follower(follower));
    }
    Ok(steps)
}
