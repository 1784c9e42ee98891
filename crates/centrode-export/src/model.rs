//! Models for simulators: links and joints.

use centrode_geometry::{MassProperties, Mesh};

/// Rigid links joined by joints, as simulators want them; lengths in mm here, whatever a format uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    /// Name of the machine.
    pub name: String,
    /// What a reader of the file should know.
    pub note: String,
    /// The links; the first is fixed to the world.
    pub links: Vec<Link>,
    /// The joints, which make the links a tree.
    pub joints: Vec<Joint>,
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name.
    pub name: String,
    /// Mass and inertia in the link's frame; `None` for a link without a body.
    pub mass: Option<MassProperties>,
    /// File name of its mesh in mm, beside the model file.
    pub mesh: Option<String>,
    /// Convex bodies it touches other links with; together they need not be the whole link.
    pub collision: Vec<Convex>,
}

/// A convex body.
#[derive(Clone, Debug, PartialEq)]
pub struct Convex {
    /// Name: bodies of one name are the same body, which several links may have.
    pub name: String,
    /// Its surface in the link's frame, mm.
    pub mesh: Mesh,
}

/// A joint between two links, turning about an axis or sliding along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
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

/// How a joint may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// Turns without end.
    Continuous,
    /// Slides between two places, mm.
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
