//! Forces of a machine: the torque that its input needs, and the forces in joints, teeth and pins.
//!
//! The forces and moments on each link balance its inertia (Newton and Euler). They are computed link by link, from the
//! ends of the tree to the first link. A closure, a mesh or a roller contact adds an unknown force. Its value is the
//! one at which the joints that it moves need no drive of their own. Lengths are mm, masses kg, forces N, torques N mm.

mod blocks;
mod elimination;
mod motion;
mod ready;
mod state;
mod tie;

use centrode_kinematics::machine::GuideForce;
use nalgebra::Vector3;

pub use ready::Balance;

/// Forces of a machine at one input.
#[derive(Clone, Debug, PartialEq)]
pub struct Forces {
    /// Torque that the input needs, N mm: positive if the input drives.
    pub input_torque: f64,
    /// Force of each joint, in the order of the machine's joints.
    pub joints: Vec<JointForce>,
    /// Force of each closure on its second link, N, in the axes of the first link of the machine.
    pub closures: Vec<Vector3<f64>>,
    /// Force of each mesh on its driven link.
    pub meshes: Vec<ToothForce>,
    /// Force of each contact on the link with the roller, N, in the axes of the first link of the machine.
    pub contacts: Vec<Vector3<f64>>,
    /// Forces of each guide.
    pub guides: Vec<GuideForce>,
    /// Largest load on each link, in the order of the machine's links.
    pub loads: Vec<LinkLoad>,
    /// Kinetic energy, N mm.
    pub kinetic_energy: f64,
    /// Potential energy in the field of gravity, N mm.
    pub potential_energy: f64,
}

/// Maximum force and torque of a single load on a link: a load of the design, or the weight and inertia of a mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkLoad {
    /// Force, N.
    pub force: f64,
    /// Torque, N mm.
    pub torque: f64,
}

impl LinkLoad {
    /// Raises force and torque to those of another load, where these are larger.
    fn raise(&mut self, force: f64, torque: f64) {
        self.force = self.force.max(force);
        self.torque = self.torque.max(torque);
    }
}

/// Force in a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointForce {
    /// Torque about the axis (N mm), or force along it (N), of the joint's drive: zero if teeth, a pin or a roller move the
    /// joint.
    pub drive: f64,
    /// Force on the carried link; `None` if an unknown part of it acts on a cam or groove of which only the law is known.
    pub reaction: Option<Reaction>,
}

/// Force of the carrying link on the carried link, without the drive and the loads along the joint's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Force, N, in the axes of the first link of the machine.
    pub force: Vector3<f64>,
    /// Moment about the origin of the carried link, N mm.
    pub moment: Vector3<f64>,
}

/// Force of the teeth of one gear on those of its mate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothForce {
    /// Force along the flanks' normal, N: positive on the flanks that turn the driven link counter-clockwise, negative on the
    /// opposite flanks; `None` if the normal is not known.
    pub normal: Option<f64>,
    /// Force on the driven link, N, in the axes of the first link of the machine; along the pitch curves' tangent if the
    /// normal is not known.
    pub force: Vector3<f64>,
    /// Pitch point, mm.
    pub at: Vector3<f64>,
}

/// Reason why there are no forces.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ForcesError {
    /// A mass below zero or not finite.
    #[error(
        "the mass of {link} is {mass} kg with {inertia} kg mm²; both must be finite and not below zero"
    )]
    Mass {
        /// Name of the link.
        link: String,
        /// Mass as given, kg.
        mass: f64,
        /// Minimum moment of inertia as given, kg mm².
        inertia: f64,
    },
    /// More than one part holds a link: how these parts share its load depends on their stiffness.
    #[error(
        "{link} is driven by both {holders}: how they share the load is statically indeterminate"
    )]
    Undetermined {
        /// Name of the link.
        link: String,
        /// Text that lists the parts that hold the link.
        holders: String,
    },
    /// A mesh, closure, contact or leader does not reach the joint that it moves, or two joints lead each other.
    #[error("{holder} cannot move {link}: no chain of joints connects them")]
    Apart {
        /// Name of the mesh, closure, contact or leader.
        holder: String,
        /// Name of the link.
        link: String,
    },
    /// The forces are not finite.
    #[error("at the input {input} rad and {speed} rad/s the forces are not finite")]
    NotFinite {
        /// The input, rad.
        input: f64,
        /// Speed of the input, rad/s.
        speed: f64,
    },
    /// Forces grow beyond bounds: a dead position, or teeth that are fixed on both links.
    #[error("at the input {input} rad no force on {links} balances the load: a dead position")]
    Dead {
        /// The input, rad.
        input: f64,
        /// Names of the links.
        links: String,
    },
}

#[cfg(test)]
mod tests;
