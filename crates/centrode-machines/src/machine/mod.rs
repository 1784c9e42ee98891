//! Composed machines: bodies that turn, slide or are fixed, driven by laws of one input and connected by dyads.
//!
//! Each body has its own axes. A turning body has its origin on its pin. A sliding body has its first axis along its
//! line. The axes of a dyad's bodies are those of a [`Linkage`]. The input is the angle of the driving shaft, rad.
//!
//! Reading order:
//!
//! 1. `design`: the file.
//! 2. `build` and `resolve`: from the file to bodies in the order of assembly.
//! 3. `body`: points and contours.
//! 4. `motion`: laws.
//! 5. `dyad`, `gears`, `cams`, `copies` and `load`.
//! 6. `goal`: figures and obstacles.
//! 7. `hardware`: pins, shafts, plates and the frame.

mod axis;
mod body;
mod build;
mod cams;
mod copies;
mod design;
mod dyad;
mod error;
mod gears;
mod goal;
mod hardware;
mod limits;
mod links;
mod load;
mod motion;
mod resolve;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use centrode_geometry::{Jet, Outline, Point, Vector};

pub use body::MachineBodySpec;
pub use body::contour::{MachineCircleSpec, MachineCornerSpec};
pub use body::corner::{CornerSpec, MachinePointsSpec, Side};
pub use body::points::BodyPoint;
pub use cams::camming::MachineCam;
pub use cams::{
    MachineCamSpec, MachineFollowerSpec, MachineSlidingRoller, MachineSwingingFlat,
    MachineSwingingRoller,
};
pub use copies::MachineCopiesSpec;
pub use design::{MachineDesign, MachineInputSpec};
pub use dyad::{DyadKind, MachineDyadSpec};
pub use error::MachineError;
pub use gears::gearing::MachineGear;
pub use gears::pair_figure::PAIR_FIGURES;
pub use gears::{GearRole, MachineGearSpec, MachineLoopSpec, MachineMeshSpec};
pub use goal::clearance_end::ClearanceEnd;
pub use goal::figure::{FIGURE_FORMS, MachineFigure, PointPart};
pub use goal::obstacle::{MachineObstacle, MachineObstacleSpec};
pub use goal::{MachineGoalSpec, Over};
pub use hardware::Hardware;
pub use hardware::frame::Overhang;
pub use hardware::layers::LayerOrders;
pub use hardware::plates::MachinePlatesSpec;
pub use hardware::shafts::{Hold, MachineShaft, ShaftPart};
pub use hardware::sizes::Plates;
pub use hardware::slots::Slot;
pub use hardware::spacing::Frames;
pub use load::{LoadAxes, MachineLoadSpec};
pub use motion::drive::{IntermittentSpec, TraverseSpec};
pub use motion::law::{MachineLawError, MachineLawSpec};
pub use motion::table::TableReading;

use self::body::points::{BodyPoints, LocalPoint};
use self::copies::expansion::Expansion;
use self::gears::gearing::Meshing;
use self::hardware::frame::FramePlates;
use self::hardware::sizes::Sized;
use self::hardware::spacing::Passage;
use self::load::MachineLoad;
use centrode_kinematics::linkage::{Line, LinkId, Linkage};
use centrode_kinematics::machine::{JointKind, TurnedPieces};
use centrode_kinematics::transmission::{MotionJet, Transmission};

/// A composed machine: its bodies in the order of building, and their motion.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The design as given, then the design with its copies written out.
    written: MachineDesign,
    design: Sized,
    expansion: Expansion,
    linkage: Linkage,
    bodies: Vec<MachineBody>,
    dyads: Vec<MachineDyad>,
    pins: Vec<Pin>,
    points: BodyPoints,
    /// Contours that the design gives for bodies, by name.
    drawn: BTreeMap<String, Outline>,
    figures: Vec<MachineFigure>,
    gears: Vec<MachineGear>,
    meshes: Vec<Meshing>,
    cams: Vec<MachineCam>,
    loads: Vec<MachineLoad>,
    obstacles: Vec<MachineObstacle>,
    shafts: OnceLock<Vec<MachineShaft>>,
    turned: OnceLock<Vec<TurnedPieces>>,
    passage: OnceLock<Passage>,
    frame: OnceLock<Option<FramePlates>>,
}

/// A body of a composed machine.
#[derive(Clone, Debug)]
pub struct MachineBody {
    /// Name.
    pub name: String,
    /// Link of the linkage.
    pub link: LinkId,
    /// Joint that carries it; `None` for the frame.
    pub mount: Option<Mount>,
}

/// Joint that carries a body.
#[derive(Clone, Debug)]
pub struct Mount {
    /// Index of the body that carries the joint.
    pub carrier: usize,
    /// Position of the joint in the carrier's axes, mm.
    pub at: Point,
    /// Turn of the joint's axes against the carrier's, rad.
    pub angle: f64,
    /// Kind of motion; a slide moves along the first axis.
    pub kind: JointKind,
    /// Coordinate of the joint as a function of the input, rad or mm.
    pub law: Arc<dyn Transmission>,
}

/// A dyad of a composed machine.
#[derive(Clone, Debug, PartialEq)]
pub struct MachineDyad {
    /// Name.
    pub name: String,
    /// Kind.
    pub kind: DyadKind,
    /// Indices of its two bodies.
    pub bodies: [usize; 2],
}

/// Pin that closes a loop.
#[derive(Clone, Debug, PartialEq)]
struct Pin {
    bodies: [usize; 2],
    /// Position in the axes of the first body, mm.
    at: Point,
}

impl Pin {
    fn new(bodies: [usize; 2], at: Point) -> Self {
        Self { bodies, at }
    }
}

impl Mount {
    fn fixed(carrier: usize, at: Point, angle: f64) -> Self {
        Self {
            carrier,
            at,
            angle,
            kind: JointKind::Fixed,
            law: Arc::new(centrode_kinematics::machine::Constant(0.0)),
        }
    }

    fn turning(carrier: usize, at: Point, law: Arc<dyn Transmission>) -> Self {
        Self {
            kind: JointKind::Turning,
            law,
            ..Self::fixed(carrier, at, 0.0)
        }
    }

    fn sliding(carrier: usize, line: &Line, law: Arc<dyn Transmission>, range: [f64; 2]) -> Self {
        Self {
            kind: JointKind::Sliding(range),
            law,
            ..Self::fixed(carrier, line.through, line.angle)
        }
    }

    /// Position of the body that has slid along the joint's line by a distance, mm, in the carrier's axes, mm.
    fn along(&self, distance: f64) -> Point {
        let (sin, cos) = self.angle.sin_cos();
        self.at + Vector::new(cos, sin) * distance
    }

    /// Sets the law of the joint and, for a slide, its range.
    fn follow(
        &mut self,
        law: Arc<dyn Transmission>,
        range: impl Fn(&dyn Transmission) -> [f64; 2],
    ) {
        if let JointKind::Sliding(of) = &mut self.kind {
            *of = range(law.as_ref());
        }
        self.law = law;
    }
}

impl Machine {
    /// The design as given.
    #[must_use]
    pub fn design(&self) -> &MachineDesign {
        &self.written
    }

    /// The design with its copies written out.
    #[must_use]
    pub fn whole(&self) -> &MachineDesign {
        &self.design
    }

    /// Name of the original of a body, dyad, gear or cam; the name itself if it is not a copy.
    #[must_use]
    pub fn original<'a>(&'a self, name: &'a str) -> &'a str {
        self.expansion.original(name)
    }

    /// Place of a part in the design file, for lists in its order: body by body, each with its points, then dyads and all other
    /// parts. The name may be that of a part, a copy, a point of a body, or a figure with a name in brackets.
    #[must_use]
    pub fn place_in_file(&self, name: &str) -> [usize; 2] {
        let name = name.split_once('(').map_or(name, |(_, inside)| inside);
        let name = name.trim_end_matches(')');
        let (part, point) = name.split_once('.').unwrap_or((name, ""));
        let part = self.original(part);
        let written = &self.written;
        let names = written.bodies.keys();
        let names = names.chain(written.dyads.values().flat_map(|dyad| &dyad.bodies));
        let names = names
            .chain(written.dyads.keys())
            .chain(written.gears.keys());
        let names = names.chain(written.cams.keys()).chain(written.pairs.keys());
        let names = names.chain(written.obstacles.keys()).map(String::as_str);
        let place = std::iter::once(design::FRAME)
            .chain(names)
            .position(|name| name == part);
        let points = match part {
            design::FRAME => written.frame.points.get_index_of(point),
            _ => written
                .bodies
                .get(part)
                .and_then(|body| body.points.get_index_of(point)),
        };
        [place, points].map(|place| place.unwrap_or(usize::MAX))
    }

    /// The machine as a linkage.
    #[must_use]
    pub fn linkage(&self) -> &Linkage {
        &self.linkage
    }

    /// Bodies in the order of building, the frame first.
    #[must_use]
    pub fn bodies(&self) -> &[MachineBody] {
        &self.bodies
    }

    /// Dyads in the order in which they close.
    #[must_use]
    pub fn dyads(&self) -> &[MachineDyad] {
        &self.dyads
    }

    /// Gears in the order of their names.
    #[must_use]
    pub fn gears(&self) -> &[MachineGear] {
        &self.gears
    }

    /// Cams in the order of their names.
    #[must_use]
    pub fn cams(&self) -> &[MachineCam] {
        &self.cams
    }

    /// Figures of the goals, in the order of their names.
    #[must_use]
    pub fn figures(&self) -> &[MachineFigure] {
        &self.figures
    }

    /// Input after which the machine repeats, rad.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.linkage.period()
    }

    /// Inputs in a period at which a motion or a load may jump, ascending.
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = self.linkage.breaks().to_vec();
        breaks.extend(self.loads.iter().flat_map(MachineLoad::breaks));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        breaks
    }

    /// Speed of the input, rad/s.
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.design.input.speed_rpm * std::f64::consts::TAU / 60.0
    }

    /// Index of a body by its name.
    #[must_use]
    pub fn body_named(&self, name: &str) -> Option<usize> {
        self.bodies.iter().position(|body| body.name == name)
    }

    /// Every point as `body.point`, with its body and position: the points that belong to the bodies themselves, not the pins on
    /// which they turn.
    pub fn points(&self) -> impl Iterator<Item = (String, BodyPoint)> + '_ {
        self.bodies
            .iter()
            .enumerate()
            .flat_map(move |(index, body)| {
                let points = self.points.get(&body.name).into_iter().flatten();
                let own = points.filter(|(_, point)| point.own);
                own.map(move |(name, &LocalPoint { at, .. })| {
                    let point = BodyPoint { body: index, at };
                    (format!("{}.{name}", body.name), point)
                })
            })
    }

    /// Finds a point by `body.point`, or by its own name if no other body has a point of that name.
    #[must_use]
    pub fn point_named(&self, word: &str) -> Option<BodyPoint> {
        if let Some((body, point)) = word.split_once('.') {
            let at = self.points.get(body)?.get(point)?.at;
            let body = self.body_named(body)?;
            return Some(BodyPoint { body, at });
        }
        let named = |name: &str| {
            name.rsplit_once('.')
                .is_some_and(|(_, point)| point == word)
        };
        let mut found = self.points().filter(|(name, ..)| named(name));
        match (found.next(), found.next()) {
            (Some((_, point)), None) => Some(point),
            _ => None,
        }
    }

    /// Motion of a point of a body at an input: position in mm and its derivatives.
    ///
    /// # Panics
    /// If `body` is not the index of a body.
    #[must_use]
    pub fn point(&self, body: usize, at: Point, input: f64) -> Jet {
        self.linkage.body(self.bodies[body].link, input).point(at)
    }

    /// Position of a point of a body at an input, mm.
    ///
    /// # Panics
    /// If `body` is not the index of a body.
    #[must_use]
    pub fn place(&self, body: usize, at: Point, input: f64) -> Point {
        self.linkage.place(self.bodies[body].link, at, input)
    }

    /// Positions of points of bodies at many inputs, mm: all points at the first input, then at the next; see
    /// [`Linkage::places_each`].
    ///
    /// # Panics
    /// If a point's body is not the index of a body.
    #[must_use]
    pub fn places_each(&self, points: &[BodyPoint], inputs: &[f64]) -> Vec<[f64; 2]> {
        self.linkage.places_each(&self.on_links(points), inputs)
    }

    /// Writes the positions of [`places_each`](Self::places_each) to `places` until it is full; see [`Linkage::write_places`].
    ///
    /// # Panics
    /// If a point's body is not the index of a body.
    pub fn write_places(&self, points: &[BodyPoint], inputs: &[f64], places: &mut [[f64; 2]]) {
        let points = self.on_links(points);
        self.linkage.write_places(&points, inputs, places);
    }

    /// Position (mm) and velocity (mm per radian of the input) of each of several points of bodies at an input; see
    /// [`Linkage::moving`].
    ///
    /// # Panics
    /// If a point's body is not the index of a body.
    #[must_use]
    pub fn moving(&self, points: &[BodyPoint], input: f64) -> Vec<(Point, Vector)> {
        self.linkage.moving(&self.on_links(points), input)
    }

    /// Points of bodies as points of links.
    fn on_links(&self, points: &[BodyPoint]) -> Vec<(LinkId, Point)> {
        let points = points.iter();
        points
            .map(|point| (self.bodies[point.body].link, point.at))
            .collect()
    }

    /// Angle of a body's first axis at an input, without jumps of whole turns, rad.
    #[must_use]
    pub fn angle(&self, body: usize, input: f64) -> MotionJet {
        let Some(mount) = self.bodies.get(body).and_then(|body| body.mount.as_ref()) else {
            return MotionJet::default();
        };
        let mut angle = self.angle(mount.carrier, input);
        angle.position += mount.angle;
        match mount.kind {
            JointKind::Turning => angle.plus(1.0, &mount.law.at(input)),
            _ => angle,
        }
    }

    /// Transmission angles of the dyads, in their order, at an input, rad; a right angle is best. See
    /// [`Linkage::transmission_angles`].
    #[must_use]
    pub fn transmission_angles(&self, input: f64) -> Vec<f64> {
        self.linkage.transmission_angles(input)
    }
}
