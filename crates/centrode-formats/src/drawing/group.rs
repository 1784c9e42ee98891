use super::Entity;
use centrode_geometry::{Bounds, Outline, Point, Vector};
use nalgebra::Isometry2;

/// Entities that are one object in programs that support it: a dimension, a hatched area.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Meaning of the group.
    pub object: Object,
    /// Entities that show the object where it is not supported.
    pub drawn: Vec<Entity>,
}

/// Object of a drawing program.
#[derive(Clone, Debug, PartialEq)]
pub enum Object {
    /// A distance with its value.
    Dimension(Dimension),
    /// An area filled with parallel lines.
    Hatch(Hatch),
}

/// A distance along a direction, with its words.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimension {
    /// Measured points, mm on paper.
    pub ends: [Point; 2],
    /// Direction measured along, of length one.
    pub along: Vector,
    /// A point of the dimension line.
    pub line: Point,
    /// Middle of the words.
    pub middle: Point,
    /// Words, unchanged.
    pub words: String,
    /// Height of the letters, mm.
    pub letters: f64,
    /// Millimetres on paper per millimetre of the part.
    pub scale: f64,
}

/// An area between closed contours, some of which may be holes, filled with parallel lines.
#[derive(Clone, Debug, PartialEq)]
pub struct Hatch {
    /// Its contours.
    pub contours: Vec<Outline>,
    /// A point of one of the lines.
    pub origin: Point,
    /// Direction of the lines, rad.
    pub angle: f64,
    /// Distance of the lines, mm.
    pub spacing: f64,
}

impl Dimension {
    /// Distance measured, mm of the part.
    #[must_use]
    pub fn measured(&self) -> f64 {
        let [a, b] = self.ends;
        (b - a).dot(&self.along).abs() / self.scale
    }
}

impl Group {
    /// The group moved, not turned.
    #[must_use]
    pub fn moved(&self, by: Vector) -> Self {
        let object = match &self.object {
            Object::Dimension(dimension) => Object::Dimension(Dimension {
                ends: dimension.ends.map(|end| end + by),
                line: dimension.line + by,
                middle: dimension.middle + by,
                ..dimension.clone()
            }),
            Object::Hatch(hatch) => {
                let place = Isometry2::translation(by.x, by.y);
                let contours = hatch.contours.iter().map(|c| c.transformed(&place));
                Object::Hatch(Hatch {
                    contours: contours.collect(),
                    origin: hatch.origin + by,
                    ..*hatch
                })
            }
        };
        Self {
            object,
            drawn: self.drawn.iter().map(|entity| entity.moved(by)).collect(),
        }
    }

    pub(super) fn bounds(&self) -> Bounds {
        let drawn = self.drawn.iter().map(|entity| entity.shape.bounds());
        drawn.fold(Bounds::EMPTY, Bounds::union)
    }
}
