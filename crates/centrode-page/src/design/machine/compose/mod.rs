//! Composing a machine: parts that are added where the picture was clicked, renamed, copied and deleted, in the text.

mod adding;
mod cams;
mod copying;
mod deleting;
mod dyads;
mod gears;
mod goals;
mod list;
mod naming;
mod references;
mod renaming;
mod scene;
#[cfg(test)]
mod tests;
mod writing;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value as Json};

use crate::design::edit::Edit;
pub(in crate::design) use list::Composition;
use scene::Scene;

/// Text of a machine without any part: composing starts from it.
pub const EMPTY_MACHINE: &str = "family = \"machine\"\nname = \"machine\"\n";

/// A position in the picture, in the axes of the frame, mm.
type Place = [f64; 2];

/// A pin of a new part.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(untagged)]
pub enum Pin {
    /// A point of the design: `crank.A`.
    Point(String),
    /// A new point of a body at a position in the picture.
    New {
        /// Body.
        body: String,
        /// Position in the picture, mm.
        at: Place,
    },
}

/// One gesture on the page: what is added or changed. Numbers that are `None` are measured at the position `at`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(tag = "part", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Gesture {
    /// A point on a body.
    Point {
        /// Body.
        on: String,
        /// Position in the picture, mm.
        at: Option<Place>,
        /// Coordinates in the axes of the body, mm.
        #[serde(default)]
        x: Option<f64>,
        /// See `x`.
        #[serde(default)]
        y: Option<f64>,
    },
    /// A point of a body at given distances from two of its points.
    Corner {
        /// First point; one body has both.
        from: String,
        /// Second point.
        to: String,
        /// Position in the picture, mm.
        at: Option<Place>,
        /// Distances, mm.
        #[serde(default)]
        lengths: [Option<f64>; 2],
        /// `left` or `right` of the line from the first point to the second.
        #[serde(default)]
        side: Option<String>,
    },
    /// A body that turns on a pin, with a point at its end.
    Body {
        /// Pin.
        on: Pin,
        /// Position of the end in the picture, mm.
        at: Option<Place>,
        /// Distance of the end from the pin, mm.
        #[serde(default)]
        length: Option<f64>,
        /// Direction of the end in the picture at the input shown, deg.
        #[serde(default)]
        angle_deg: Option<f64>,
        /// Turns per turn of the input; 0: it is fixed.
        #[serde(default)]
        ratio: Option<f64>,
    },
    /// Two bars from two pins to a joint.
    Bars {
        /// Pin of the first bar.
        from: Pin,
        /// Pin of the second bar.
        to: Pin,
        /// Position of the joint in the picture, mm.
        at: Option<Place>,
        /// Lengths of the bars, mm.
        #[serde(default)]
        lengths: [Option<f64>; 2],
        /// `left` or `right` of the line from the first pin to the second.
        #[serde(default)]
        side: Option<String>,
    },
    /// A bar from a pin to a block on a line.
    Slider {
        /// Pin of the bar.
        from: Pin,
        /// Point through which the line passes.
        line: Pin,
        /// Position of the block in the picture, mm: the line passes through it.
        at: Option<Place>,
        /// Length of the bar, mm.
        #[serde(default)]
        length: Option<f64>,
        /// Direction of the line in the picture at the input shown, deg.
        #[serde(default)]
        angle_deg: Option<f64>,
        /// `forward` or `backward` along the line.
        #[serde(default)]
        side: Option<String>,
    },
    /// Two gears: one on a body that turns, the other on a new body next to it.
    Gears {
        /// Body that drives.
        on: String,
        /// Position of the second axis in the picture, mm.
        at: Option<Place>,
        /// Pitch curve: `circle` or `ellipse`.
        curve: String,
        /// Numerical eccentricity of an ellipse, from 0 to 1; default 0.3.
        #[serde(default)]
        eccentricity: Option<f64>,
        /// Module, mm; by default it fits the distance.
        #[serde(default)]
        module: Option<f64>,
        /// Number of teeth of the driver; by default it fits the distance.
        #[serde(default)]
        teeth: Option<f64>,
        /// Direction of the second axis in the picture, deg.
        #[serde(default)]
        angle_deg: Option<f64>,
    },
    /// A disc cam on a body that turns, and a lever with a roller.
    Cam {
        /// Body that carries the cam.
        on: String,
        /// Pin of the lever.
        to: Pin,
        /// Position of the roller in the picture, mm.
        at: Option<Place>,
        /// Distance of the roller from the pin of the lever, mm.
        #[serde(default)]
        length: Option<f64>,
        /// Radius of the base circle, mm.
        #[serde(default)]
        radius: Option<f64>,
        /// Angle by which the lever swings, deg.
        #[serde(default)]
        swing_deg: Option<f64>,
    },
    /// A goal for a figure.
    Goal {
        /// Figure in words: `rod.A.x`.
        figure: String,
        /// Extreme that counts: `minimum`, `maximum` or `span`.
        over: String,
        /// Whether the number is the upper limit, not the lower one.
        #[serde(default)]
        below: bool,
        /// Limit, in the unit of the figure; default: the figure of the machine as it is.
        #[serde(default)]
        limit: Option<f64>,
    },
    /// The other solution of a dyad, at the input shown.
    Other {
        /// Key of the dyad: `dyads.knee`.
        key: String,
    },
    /// Removes a part.
    Delete {
        /// Key of the part.
        key: String,
        /// Whether all parts that depend on it are removed, too.
        #[serde(default)]
        all: bool,
    },
    /// Gives a part another name.
    Rename {
        /// Key of the part.
        key: String,
        /// New name.
        to: String,
    },
    /// Adds a copy of a part.
    Copy {
        /// Key of the part.
        key: String,
    },
}

/// Result of a gesture.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Composed {
    /// Text of the design with the part; empty if the gesture only shows something.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub text: String,
    /// Key of the new or changed part.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub key: String,
    /// Numbers of the part as they were measured, by the name of their field on the page.
    pub numbers: Map<String, Json>,
    /// Lines of the part in the picture at the input shown, mm.
    pub lines: Vec<[Place; 2]>,
    /// The other solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other: Option<Other>,
}

/// The other solution of a dyad.
#[derive(Clone, Debug, Serialize)]
pub struct Other {
    /// Its lines in the picture at the input shown, mm.
    pub lines: Vec<[Place; 2]>,
    /// Edit that chooses it.
    pub edits: Vec<Edit>,
}

/// Reason why a gesture changes nothing.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Refusal {
    /// The reason, with numbers.
    pub refused: String,
    /// Nearest numbers with which the part closes, by the name of their field on the page.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<Map<String, Json>>,
    /// Keys of the parts that depend on the part.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub dependents: Vec<String>,
}

impl Refusal {
    fn because(reason: impl Into<String>) -> Self {
        Self {
            refused: reason.into(),
            ..Self::default()
        }
    }
}

/// Makes a gesture on the text of a machine, with the picture at an input, rad. Comments and all other parts stay.
///
/// # Errors
/// The reason if there is no such machine.
pub fn composed(text: &str, input: f64, gesture: &Gesture) -> Result<Composed, Box<Refusal>> {
    let scene = Scene::new(text, input)?;
    match gesture {
        Gesture::Point { on, at, x, y } => adding::point(scene, on, *at, [*x, *y]),
        Gesture::Corner {
            from,
            to,
            at,
            lengths,
            side,
        } => adding::corner(scene, [from, to], *at, *lengths, side.as_deref()),
        Gesture::Body {
            on,
            at,
            length,
            angle_deg,
            ratio,
        } => adding::body(scene, on, *at, [*length, *angle_deg], *ratio),
        Gesture::Bars {
            from,
            to,
            at,
            lengths,
            side,
        } => dyads::bars(scene, [from, to], *at, *lengths, side.as_deref()),
        Gesture::Slider {
            from,
            line,
            at,
            length,
            angle_deg,
            side,
        } => dyads::slider(
            scene,
            [from, line],
            *at,
            [*length, *angle_deg],
            side.as_deref(),
        ),
        Gesture::Gears {
            on,
            at,
            curve,
            eccentricity,
            module,
            teeth,
            angle_deg,
        } => {
            let curve = gears::Curve::new(curve, *eccentricity)?;
            gears::gears(scene, on, *at, &curve, [*module, *teeth, *angle_deg])
        }
        Gesture::Cam {
            on,
            to,
            at,
            length,
            radius,
            swing_deg,
        } => cams::cam(scene, on, to, *at, [*length, *radius, *swing_deg]),
        Gesture::Goal {
            figure,
            over,
            below,
            limit,
        } => goals::goal(scene, figure, over, *below, *limit),
        Gesture::Other { key } => dyads::other(&scene, key),
        Gesture::Delete { key, all } => deleting::deleted(scene, key, *all),
        Gesture::Rename { key, to } => renaming::renamed(scene, key, to),
        Gesture::Copy { key } => copying::copied(scene, key),
    }
}
