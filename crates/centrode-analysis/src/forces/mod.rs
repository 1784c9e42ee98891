//! Forces of a machine: the torque its input needs, and what joints, teeth and pins carry.
//!
//! Each link's forces and moments balance its inertia (Newton and Euler), link by link from the ends of the tree to the
//! first one. Where a loop closes, teeth mesh or a roller runs on a curve, the unknown force there is the one that leaves
//! nothing for the joints that it moves to supply. Lengths are mm, masses kg, forces N, torques N mm.

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
    /// Torque the input needs, N mm: positive where it drives.
    pub input_torque: f64,
    /// Force of each joint, in the order of the machine's.
    pub joints: Vec<JointForce>,
    /// Force of each closure on its second link, N, in the axes of the first link of the machine.
    pub closures: Vec<Vector3<f64>>,
    /// Force of each mesh on its driven link.
    pub meshes: Vec<ToothForce>,
    /// Force of each contact on the link with the roller, N, in the axes of the first link of the machine.
    pub contacts: Vec<Vector3<f64>>,
    /// Forces of each guide.
    pub guides: Vec<GuideForce>,
    /// Largest load on each link, in the order of the machine's.
    pub loads: Vec<LinkLoad>,
    /// Kinetic energy, N mm.
    pub kinetic_energy: f64,
    /// Potential energy in the field of gravity, N mm.
    pub potential_energy: f64,
}

/// Largest single load on a link: one of the design's, or the weight and inertia of a mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkLoad {
    /// Force, N.
    pub force: f64,
    /// Torque, N mm.
    pub torque: f64,
}

impl LinkLoad {
    /// Takes the larger of this load and another.
    fn raise(&mut self, force: f64, torque: f64) {
        self.force = self.force.max(force);
        self.torque = self.torque.max(torque);
    }
}

/// Force in a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointForce {
    /// Torque about the axis (N mm), or force along it (N), of what moves the joint: zero where teeth, a pin or a roller do.
    pub drive: f64,
    /// Force on the link carried; `None` if a cam or groove of which only the law is known takes a part of it.
    pub reaction: Option<Reaction>,
}

/// Force of the link that carries on the one carried, without drive and loads along the joint's axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction {
    /// Force, N, in the axes of the first link of the machine.
    pub force: Vector3<f64>,
    /// Moment about the origin of the link carried, N mm.
    pub moment: Vector3<f64>,
}

/// Force of the teeth of one gear on those of its mate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToothForce {
    /// Size along the flanks' normal, N: positive where the flanks carry that drive with a counter-clockwise moment on the
    /// driven link, negative on the other ones; `None` if the normal is not known.
    pub normal: Option<f64>,
    /// Force on the driven link, N, in the axes of the first link of the machine; along the pitch curves' tangent where the
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
    /// More than one thing holds a link: how they share its load depends on their stiffness.
    #[error(
        "{link} is held in its motion by more than one of {holders}: how they share the load is not determined"
    )]
    Undetermined {
        /// Name of the link.
        link: String,
        /// Those that hold it, in words.
        holders: String,
    },
    /// Something is said to move a joint that it does not reach, or the joint that leads another is led by it.
    #[error("{holder} cannot move {link}: no chain of joints leads from the one to the other")]
    Apart {
        /// Mesh, closure, contact or leader.
        holder: String,
        /// Name of the link.
        link: String,
    },
    /// Forces that are not finite.
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
