//! Models for simulators: links and joints.

use centrode_geometry::{MassProperties, Mesh};
use nalgebra::{Rotation3, Unit, Vector3};

/// Maximum number of triangles of a visible mesh. `MuJoCo` reads no STL file of more than 200 000.
pub const MAX_FACES: usize = 100_000;

/// Rigid links joined by joints, as simulators require them; lengths in mm here, whatever a format uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name of the machine.
    pub name: String,
    /// Comment at the head of the file.
    pub note: String,
    /// The links; the first is fixed to the world.
    pub links: Vec<ModelLink>,
    /// The joints, which make the links a tree.
    pub joints: Vec<ModelJoint>,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelLink {
    /// Name.
    pub name: String,
    /// Mass and inertia in the link's frame; `None` for a link without a body.
    pub mass: Option<MassProperties>,
    /// Visible meshes.
    pub meshes: Vec<Seen>,
    /// Convex bodies for contact with other links; together they need not fill the whole link.
    pub collision: Vec<Convex>,
}

/// A visible mesh of a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    /// Name of its file in mm, next to the model file.
    pub file: String,
    /// Its origin in the link's frame, mm.
    pub at: [f64; 3],
    /// Its turn in the link's frame as roll, pitch and yaw, rad.
    pub turn: [f64; 3],
}

impl Seen {
    /// A mesh in the frame of its link.
    #[must_use]
    pub fn upright(file: String) -> Self {
        Self {
            file,
            at: [0.0; 3],
            turn: [0.0; 3],
        }
    }
}

/// A convex body.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    /// Name: bodies with the same name are one body, which several links may share.
    pub name: String,
    /// Its surface in the link's frame, mm.
    pub mesh: Mesh,
}

/// A joint between two links, turning about an axis or sliding along it.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelJoint {
    /// Name.
    pub name: String,
    /// How it may move.
    pub kind: JointKind,
    /// Name of the link it is mounted on.
    pub parent: String,
    /// Name of the link it carries.
    pub child: String,
    /// Position of the child's origin in the parent's frame, mm.
    pub origin: [f64; 3],
    /// Turn of the child's frame in the parent's at rest about the parent's x, then y, then z, rad.
    pub turn: [f64; 3],
    /// Unit vector of the axis in the child's frame.
    pub axis: [f64; 3],
    /// The joint it follows, if it follows one linearly.
    pub mimic: Option<Mimic>,
}

impl ModelJoint {
    /// The joint with its zero moved to `value` (rad or mm): at rest its link is at this value.
    #[must_use]
    pub fn starting_at(mut self, value: f64) -> Self {
        let [x, y, z] = self.turn;
        let axis = Vector3::from(self.axis);
        match &mut self.kind {
            JointKind::Fixed => {}
            JointKind::Continuous if [x, y] == [0.0; 2] && self.axis == [0.0, 0.0, 1.0] => {
                self.turn[2] += value;
            }
            JointKind::Continuous => {
                let own = Rotation3::from_axis_angle(&Unit::new_normalize(axis), value);
                let turned = Rotation3::from_euler_angles(x, y, z) * own;
                self.turn = turned.euler_angles().into();
            }
            JointKind::Sliding(range) => {
                let way = Rotation3::from_euler_angles(x, y, z) * axis * value;
                for (place, along) in self.origin.iter_mut().zip(way.iter()) {
                    *place += along;
                }
                *range = range.map(|end| end - value);
            }
        }
        self
    }
}

/// How a joint may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Does not move.
    Fixed,
    /// Turns without limits.
    Continuous,
    /// Slides between two positions, mm.
    Sliding([f64; 2]),
}

/// `angle = multiplier * (angle of the other joint) + offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mimic {
    /// Name of the joint followed.
    pub joint: String,
    /// Factor.
    pub multiplier: f64,
    /// Offset, rad.
    pub offset: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_with_another_zero_carries_its_child_to_the_same_places() {
        let turn = [0.3, -0.4, 0.5];
        let axis = Unit::new_normalize(Vector3::new(0.2, -0.7, 0.6));
        let joint = |kind| ModelJoint {
            name: "joint".into(),
            kind,
            parent: "one".into(),
            child: "other".into(),
            origin: [1.0, 2.0, 3.0],
            turn,
            axis: axis.into_inner().into(),
            mimic: None,
        };
        let frame = |[x, y, z]: [f64; 3]| Rotation3::from_euler_angles(x, y, z);
        let hinge = joint(JointKind::Continuous).starting_at(0.8);
        let own = |angle| Rotation3::from_axis_angle(&axis, angle);
        let off = frame(turn) * own(1.1) / (frame(hinge.turn) * own(1.1 - 0.8));
        assert!(off.angle() < 1e-7 && hinge.origin == [1.0, 2.0, 3.0]);
        let slide = joint(JointKind::Sliding([-5.0, 7.0])).starting_at(2.0);
        let expected = Vector3::new(1.0, 2.0, 3.0) + frame(turn) * axis.into_inner() * 2.0;
        assert!((Vector3::from(slide.origin) - expected).norm() < 1e-14);
        assert_eq!(slide.kind, JointKind::Sliding([-7.0, 5.0]));
        assert_eq!(slide.turn, turn);
    }
}
