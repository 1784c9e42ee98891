use centrode_geometry::{Outline, Point};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LinkedMachine, Quantity, plain};

/// Meaning of a line of the picture, which settles how it looks.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum LineRole {
    /// Contour of material.
    Body,
    /// Contour of a hole in it.
    Hole,
    /// A pitch curve.
    Pitch,
    /// The path of a point.
    Trace,
    /// Where a point may lie.
    Locus,
    /// The path of a point as it stays behind on the ground.
    OverGround,
    /// A bar seen as its centre line.
    Bar,
    /// The centre line of a clamp.
    Clamp,
    /// Part of a body that lies next to it, in another plane.
    Adjacent,
    /// A moving link where it does its work.
    Pose,
    /// The ground.
    Ground,
    /// An edge of the window in which a seedling is picked.
    Window,
}

/// A line of the picture.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Its meaning.
    pub role: LineRole,
    /// Its path.
    pub path: LinePath,
}

/// The path of a line.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum LinePath {
    /// A closed contour.
    Contour(
        #[serde(with = "plain::contours")]
        #[schemars(with = "plain::contours::File")]
        Outline,
    ),
    /// An open chain of straight lines through these places, mm.
    Chain(Vec<[f64; 2]>),
    /// The way of a point over one period, as seen from the figure; index of the point.
    Trace(usize),
}

/// Lines that are drawn together.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Sketch {
    /// Name, by which it is found again.
    pub name: String,
    /// The lines, in the order drawn.
    pub lines: Vec<Line>,
}

/// A sketch in its place in the picture.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Name, as in findings.
    pub name: String,
    /// Index of the sketch.
    pub sketch: usize,
    /// Carrier of its motion.
    pub seat: Seat,
    /// Place (x and y, mm) and turn (rad) of the sketch on its seat.
    pub at: [f64; 3],
}

/// Carrier of a figure's motion.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Seat {
    /// A link, seen along the z axis of the first one; its index.
    Link(usize),
    /// Nothing: x and y (mm) and turn (rad) of its own by the input, for what is not drawn where it is in space, like the
    /// development of a shaft, and for scenery that comes and goes by jumps.
    Free(Box<[Quantity; 3]>),
}

/// A place of the picture worth a name.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Mark {
    /// Its name.
    pub name: String,
    /// Index of the figure it moves with.
    pub figure: usize,
    /// x and y in the figure's sketch, mm.
    pub at: [f64; 2],
}

impl Line {
    /// A closed contour.
    #[must_use]
    pub fn contour(role: LineRole, outline: &Outline) -> Self {
        let path = LinePath::Contour(outline.clone());
        Self { role, path }
    }

    /// An open chain of straight lines.
    #[must_use]
    pub fn chain(role: LineRole, corners: &[Point]) -> Self {
        let path = LinePath::Chain(corners.iter().map(|p| [p.x, p.y]).collect());
        Self { role, path }
    }

    /// The path of a point over one period, as seen from the figure.
    #[must_use]
    pub fn trace(role: LineRole, point: usize) -> Self {
        let path = LinePath::Trace(point);
        Self { role, path }
    }
}

impl LinkedMachine {
    /// Adds a sketch, or finds the one of that name; its index.
    pub fn sketch(&mut self, name: &str, lines: Vec<Line>) -> usize {
        let known = self.sketches.iter().position(|s| s.name == name);
        known.unwrap_or_else(|| {
            let name = name.into();
            self.sketches.push(Sketch { name, lines });
            self.sketches.len() - 1
        })
    }

    /// Draws a sketch on a link, in front of all that is drawn already.
    pub fn draw(&mut self, name: &str, link: usize, sketch: usize) {
        let seat = Seat::Link(link);
        self.draw_at(name, seat, [0.0; 3], sketch);
    }

    /// Draws a sketch at a position (x and y, mm) and turn (rad) of its seat, in front of all that is drawn already.
    pub fn draw_at(&mut self, name: &str, seat: Seat, at: [f64; 3], sketch: usize) {
        let name = name.into();
        self.figures.push(Figure {
            name,
            sketch,
            seat,
            at,
        });
    }
}
