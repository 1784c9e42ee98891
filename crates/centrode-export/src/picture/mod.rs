//! Moving picture of a mechanism, with the curves of its cycle.
//!
//! A [`Picture`] has the data for drawing: outlines as lines and arcs, and the pose of every link along the cycle. The
//! browser computes nothing. The local program and the self-contained report show it by the same assets.

mod curves;
mod path;
mod scene;

pub use curves::CurveList;
pub use path::Path;
pub(crate) use path::{Rounding, short};

use std::borrow::Cow;

use serde::Serialize;

/// A machine drawn to scale, and how it moves.
///
/// In JSON each link has the index of a shape, so that parts that look the same are written and drawn once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Picture {
    /// The moving parts, the rearmost first.
    pub links: Vec<PictureLink>,
    /// The cycle.
    pub motion: Motion,
    /// Points that can be dragged with the mouse.
    pub handles: Vec<Handle>,
    /// Named positions.
    pub marks: Vec<Mark>,
    /// Positions at which gears touch, mesh by mesh.
    pub contacts: Vec<Contacts>,
    /// Minimum x, minimum y, maximum x, maximum y of everything over the whole cycle, mm.
    pub extent: [f64; 4],
}

/// A rigid part.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureLink {
    /// Name, as in findings.
    pub name: String,
    /// Its lines, in its own frame.
    pub paths: Vec<Path>,
}

/// A named position.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mark {
    /// Its name.
    pub name: String,
    /// Index of the link it moves with.
    pub link: usize,
    /// x and y in the link's frame, mm.
    pub at: [f64; 2],
}

/// Positions at which the flanks of two gears touch, in the axes of the picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Contacts {
    /// The gears, in words.
    pub mesh: String,
    /// The pitch point: the line of action passes through it.
    pub pitch_point: Track,
    /// Paths of contact, one for each time that two flanks meet in a cycle; empty before teeth are cut.
    pub paths: Vec<Track>,
}

/// Position that moves with the input.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Track {
    /// Inputs, rad, ascending; there is no such position before the first and after the last.
    pub input: Vec<f64>,
    /// x and y, mm, at every input.
    pub at: Vec<[f64; 2]>,
}

impl Track {
    /// A track of inputs and positions.
    #[must_use]
    pub fn from_samples(samples: impl IntoIterator<Item = (f64, [f64; 2])>) -> Self {
        let (input, at) = samples.into_iter().unzip();
        Self { input, at }
    }
}

/// Poses of every link along one cycle of the input.
///
/// Between samples a pose is interpolated linearly, angle and position.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Motion {
    /// Name of the input: the turning link.
    pub input_name: String,
    /// Input angles, rad, ascending, over one whole cycle.
    pub input: Vec<f64>,
    /// For every link: x, y (mm) and angle (rad) at every input, one after the other; only these three numbers for a fixed link.
    pub poses: Vec<Vec<f64>>,
}

/// A point of the picture that represents numbers of the design.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Handle {
    /// Description for users of screen readers.
    pub name: String,
    /// Index of the link it moves with.
    pub link: usize,
    /// How the two numbers place it.
    pub plane: HandlePlane,
    /// Keys of the design: x and y, or radius and polar angle in degrees; empty if the point cannot be changed.
    pub keys: [String; 2],
    /// The two numbers as written.
    pub values: [f64; 2],
    /// Millimetres of the picture for one unit of the numbers, lengths or degrees.
    pub scale: f64,
    /// Where both numbers would be zero, mm in the link's frame.
    pub origin: [f64; 2],
    /// Whether a line joins it to the handles before and after.
    pub chained: bool,
}

/// How the two numbers of a [`Handle`] place it.
#[derive(Clone, Copy, Debug, Eq, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum HandlePlane {
    /// x and y.
    Cartesian,
    /// Radius and polar angle, deg.
    Polar,
}

/// A figure along the cycle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curve {
    /// The chart it belongs to; curves of one chart share unit and axis.
    pub chart: Cow<'static, str>,
    /// Name within the chart; empty where it is alone.
    pub name: &'static str,
    /// Unit as shown; empty for a plain number.
    pub unit: &'static str,
    /// Whether it counts: whole numbers, each up to the next input.
    pub count: bool,
    /// Input angles, rad, ascending.
    #[serde(serialize_with = "path::drawn")]
    pub input: Vec<f64>,
    /// The figure at every input, in `unit`; values that are not finite are no part of the curve.
    #[serde(serialize_with = "path::drawn")]
    pub value: Vec<f64>,
}

impl Curve {
    /// A figure of a chart at ascending inputs.
    #[must_use]
    pub fn new([chart, name, unit]: [&'static str; 3], input: &[f64], value: Vec<f64>) -> Self {
        Self {
            chart: chart.into(),
            name,
            unit,
            count: false,
            input: input.to_vec(),
            value,
        }
    }
}
