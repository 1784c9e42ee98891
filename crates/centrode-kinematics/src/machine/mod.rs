//! The machine: rigid links in a tree of joints.
//!
//! Each joint follows a transmission function of the only input. Poses, motion tables, forces, simulator models,
//! pictures, parts lists, arrangements and interference use only a [`LinkedMachine`]. Its loops are closed when it is
//! made: the laws of the joints satisfy the closures, which remain listed.

mod arrangement;
mod bar;
mod blank;
mod boss;
mod contact;
mod fastening;
mod figure;
mod fit;
mod general;
mod jet;
mod joint;
mod law;
mod load;
mod mount;
mod part;
mod plain;
mod pose;
mod spacer;
mod standard;
mod stock;
mod turned;
mod validate;

use std::fmt;
use std::sync::Arc;

use centrode_geometry::{MassProperties, Mesh, Outline, Shell, Solid, SolidError, Tolerance};
use nalgebra::{Isometry3, UnitQuaternion};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::transmission::Transmission;

pub use arrangement::{Arrangement, ArrangementTable, Axis, Callout, Datum, Dimension, Place};
pub use bar::Bar;
pub use blank::Blank;
pub use boss::with_bosses;
pub use contact::{Closure, Contact, ContactLine, GearMesh, Guide, GuideForce, PitchCurves};
pub use fastening::{Fastening, FasteningError};
pub use figure::{Figure, Line, LinePath, LineRole, Mark, Seat, Sketch};
pub use fit::{Fit, PinFit, limits_of_size, preferred_size, preferred_size_below};
pub use general::general_deviation;
pub use jet::{FrameJet, PointJet};
pub use joint::{Joint, JointKind};
pub use law::{Constant, Linear, Piecewise};
pub use load::{Axes, Load, STANDARD_GRAVITY};
pub use mount::Fastener;
pub use part::{Part, Supply};
pub use spacer::{Spacer, SpacerKind};
pub use standard::{
    Bearing, Circlip, Dowel, Key, Keyway, Screw, StandardTable, allowed_pressure, hole_class,
    screw_size, shaft_class,
};
pub use stock::Stock;
pub use turned::{HeldLength, SeatedKey, TurnedPart, TurnedPiece, TurnedPieces, TurnedStep};
pub use validate::LinkedMachineError;

/// Rigid links, and how each of them moves with the one input.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LinkedMachine {
    /// Name, as in the design.
    pub name: String,
    /// Title, as in the design; may be empty.
    pub title: String,
    /// The turning shaft that drives it.
    pub input: Input,
    /// The links; the first is fixed.
    pub links: Vec<Link>,
    /// The joints: each link but the first is carried by one.
    pub joints: Vec<Joint>,
    /// Connections that close the loops that the tree of joints leaves open.
    pub closures: Vec<Closure>,
    /// Links that touch by their teeth.
    pub meshes: Vec<GearMesh>,
    /// Pairs of links: one runs along a curve of the other.
    pub contacts: Vec<Contact>,
    /// Grooves that lead joints.
    pub guides: Vec<Guide>,
    /// Acceleration of free fall in the frame of the first link, mm/s².
    pub gravity: [f64; 3],
    /// Loads in addition to weight and inertia.
    pub loads: Vec<Load>,
    /// Points worth following.
    pub points: Vec<LinkPoint>,
    /// Columns of the table of motion; the first is the input.
    pub columns: Vec<Column>,
    /// Bodies of the links, each once.
    pub shapes: Vec<Shape>,
    /// Surfaces that links touch with, each once.
    pub surfaces: Vec<Surface>,
    /// Lines that the links are drawn with, each set once.
    pub sketches: Vec<Sketch>,
    /// The picture: what is drawn, the hindmost first.
    pub figures: Vec<Figure>,
    /// Places of the picture worth a name.
    pub marks: Vec<Mark>,
    /// Parts that a workshop makes or buys, in the order of the parts list.
    pub parts: Vec<Part>,
    /// Fits of holes and of the parts that run or sit in them, equal ones once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fits: Vec<Fit>,
    /// The general arrangement.
    pub arrangement: Arrangement,
    /// Comment of the machine's files.
    pub note: String,
}

/// The shaft that drives a machine.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Input {
    /// Name of the part that turns: a link or a shaft.
    pub name: String,
    /// Angle after which every joint repeats, up to its advance, rad.
    pub period: f64,
    /// Speed of the design, rad/s; 1 if the design gives none.
    pub speed: f64,
}

/// A rigid body.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Link {
    /// Name.
    pub name: String,
    /// Mass and inertia in the link's frame; `None` for a link without a body.
    #[serde(with = "plain::masses")]
    #[schemars(with = "plain::masses::File")]
    pub mass: Option<MassProperties>,
    /// Index of the shape it is seen as.
    pub shape: Option<usize>,
    /// Further bodies that it is seen with: its shafts and pins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mounted: Vec<Mounted>,
    /// Indices of the surfaces it touches other links with.
    pub surfaces: Vec<usize>,
}

/// A body mounted on a link.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Mounted {
    /// Index of its shape.
    pub shape: usize,
    /// Its origin in the link's frame, mm.
    pub at: [f64; 3],
    /// Its turn there as roll, pitch and yaw: about the link's x, then y, then z axis, rad.
    pub turn: [f64; 3],
}

/// A point of a link.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LinkPoint {
    /// Name.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// Place in the link's frame, mm.
    pub at: [f64; 3],
}

/// A column of the table of motion.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Column {
    /// Heading, its unit at the end: `driven_angle_rad`.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Meaning, in words.
    pub meaning: String,
    /// The quantity in it.
    pub quantity: Quantity,
}

/// A quantity along the cycle.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Quantity {
    /// The input times a factor.
    Input(f64),
    /// A joint's coordinate, or its first to third derivative by the input, times a factor.
    Joint {
        /// Index of the joint.
        joint: usize,
        /// Order of the derivative.
        order: u8,
        /// The factor.
        factor: f64,
    },
    /// A coordinate of a point, in the frame of the first link, mm.
    Point {
        /// Index of the point.
        point: usize,
        /// 0, 1, 2: x, y, z.
        axis: usize,
    },
    /// Magnitude of the derivative of a point's position by the input, times a factor.
    PointSpeed {
        /// Index of the point.
        point: usize,
        /// The factor.
        factor: f64,
    },
    /// Any other function of the input.
    Law(
        #[serde(with = "plain::laws")]
        #[schemars(with = "plain::laws::File")]
        Arc<dyn Transmission>,
    ),
}

impl Shape {
    /// A body with the name of its file and that of its own part, which may be empty.
    #[must_use]
    pub fn new(name: impl Into<String>, part: impl Into<String>, form: Form) -> Self {
        Self {
            name: name.into(),
            part: part.into(),
            form,
        }
    }

    /// Name without its folder.
    #[must_use]
    pub fn short_name(&self) -> &str {
        self.name.rsplit('/').next().unwrap_or_default()
    }
}

impl Link {
    /// A link without a body.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            ..Self::default()
        }
    }

    /// Every body it is seen with, by the index of its shape, and the body's pose in the link's frame.
    pub fn bodies(&self) -> impl Iterator<Item = (usize, Isometry3<f64>)> {
        let own = self.shape.map(|shape| (shape, Isometry3::identity()));
        let mounted = self.mounted.iter();
        own.into_iter()
            .chain(mounted.map(|body| (body.shape, body.place())))
    }
}

impl Mounted {
    /// Its pose in the link's frame.
    #[must_use]
    pub fn place(&self) -> Isometry3<f64> {
        let [x, y, z] = self.turn;
        Isometry3::from_parts(self.at.into(), UnitQuaternion::from_euler_angles(x, y, z))
    }
}

impl Quantity {
    /// A joint's coordinate.
    #[must_use]
    pub fn joint(joint: usize) -> Self {
        Self::rate(joint, 0, 1.0)
    }

    /// A derivative of a joint's coordinate by the input, times a factor.
    #[must_use]
    pub fn rate(joint: usize, order: u8, factor: f64) -> Self {
        Self::Joint {
            joint,
            order,
            factor,
        }
    }
}

/// A body as it is seen.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Shape {
    /// Name of its file.
    pub name: String,
    /// Name of the file of the part that is identical to this body at any tolerance; empty if there is no such part.
    pub part: String,
    /// The body.
    #[schemars(with = "plain::FormFile")]
    pub form: Form,
}

/// A body in space.
#[derive(Clone, Debug)]
pub enum Form {
    /// Extrusions along z.
    Solids(Vec<Solid>),
    /// A triangle mesh and its maximum deviation from the body, mm; zero for a body of plane faces.
    Mesh(Mesh, f64),
    /// A shaft or pin.
    Turned(TurnedPart),
    /// A body of another kind.
    Body(Arc<dyn SolidBody>),
}

/// A body that can be meshed.
pub trait SolidBody: fmt::Debug + Send + Sync {
    /// A closed triangle mesh within the tolerance.
    ///
    /// # Errors
    /// [`SolidError`] where the tolerance leaves no solid.
    fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, SolidError>;

    /// Its boundary on exact surfaces; `None` if there are none.
    fn shell(&self) -> Option<Shell> {
        None
    }
}

/// Surface with which a link touches others: contours over a range of heights.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Name with which those of its bodies begin.
    pub name: String,
    /// The contour.
    #[serde(with = "plain::contours")]
    #[schemars(with = "plain::contours::File")]
    pub outline: Outline,
    /// Lower and upper end along z, mm.
    pub span: [f64; 2],
    /// For a gear: the tooth of each segment of the contour, `None` for a segment that does not touch. Empty for a
    /// plate.
    pub teeth: Vec<Option<u32>>,
    /// Maximum distance of its bodies from the contour, as a multiple of the tolerance.
    pub coarseness: f64,
}

impl Surface {
    /// A plate's surface: the contour between two heights, mm, whose bodies keep to the tolerance.
    #[must_use]
    pub fn new(name: impl Into<String>, outline: Outline, span: [f64; 2]) -> Self {
        Self {
            name: name.into(),
            outline,
            span,
            teeth: Vec::new(),
            coarseness: 1.0,
        }
    }

    /// The surface round an extrusion.
    #[must_use]
    pub fn of_solid(name: impl Into<String>, solid: &Solid) -> Self {
        let span = [solid.bottom(), solid.top()];
        Self::new(name, solid.outline().clone(), span)
    }
}

impl LinkedMachine {
    /// Adds a link.
    pub fn link(&mut self, link: Link) -> usize {
        self.links.push(link);
        self.links.len() - 1
    }

    /// Adds a joint.
    pub fn joint(&mut self, joint: Joint) -> usize {
        self.joints.push(joint);
        self.joints.len() - 1
    }

    /// Adds a shape, or finds the one of that name.
    pub fn shape(&mut self, shape: Shape) -> usize {
        let known = self.shapes.iter().position(|s| s.name == shape.name);
        known.unwrap_or_else(|| {
            self.shapes.push(shape);
            self.shapes.len() - 1
        })
    }

    /// Adds solids as one shape, or finds the one of that name; its index. `part` names the part whose files have this body, or
    /// is empty.
    pub fn solids(&mut self, name: &str, part: &str, solids: Vec<Solid>) -> usize {
        self.shape(Shape {
            name: name.into(),
            part: part.into(),
            form: Form::Solids(solids),
        })
    }

    /// Adds a surface, or finds the one of that name.
    pub fn surface(&mut self, surface: Surface) -> usize {
        let known = self.surfaces.iter().position(|s| s.name == surface.name);
        known.unwrap_or_else(|| {
            self.surfaces.push(surface);
            self.surfaces.len() - 1
        })
    }

    /// Adds a column of the table.
    pub fn column(&mut self, name: &str, unit: &str, meaning: &str, quantity: Quantity) -> usize {
        self.columns.push(Column {
            name: name.into(),
            unit: unit.into(),
            meaning: meaning.into(),
            quantity,
        });
        self.columns.len() - 1
    }

    /// Adds the columns of the input angle, with its meaning, and of the time.
    pub fn input_columns(&mut self, meaning: &str) {
        self.column("input_angle_rad", "rad", meaning, Quantity::Input(1.0));
        let time = Quantity::Input(1.0 / self.input.speed);
        self.column("time_s", "s", "time at the design's speed", time);
    }

    /// Name of a joint: that of the link it carries.
    #[must_use]
    pub fn joint_name(&self, joint: usize) -> String {
        let child = self.joints.get(joint).map(|j| j.child);
        let link = child.and_then(|child| self.links.get(child));
        format!("{}_joint", link.map_or("", |link| link.name.as_str()))
    }

    /// Index of a link by its name.
    #[must_use]
    pub fn link_named(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// Title, or the name if the title is empty.
    #[must_use]
    pub fn heading(&self) -> &str {
        if self.title.is_empty() {
            &self.name
        } else {
            &self.title
        }
    }
}

#[cfg(test)]
mod tests;
