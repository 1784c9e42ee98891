//! Drawings: shapes on layers.

mod group;

use centrode_geometry::{Arc, Bounds, Outline, Point, Vector};
pub use group::{Dimension, Group, Hatch, Object};
use nalgebra::Isometry2;

/// Lines, arcs, contours and texts on named layers, in millimetres: the input for every drawing format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The layers, in the order a program should list them.
    pub layers: Vec<Layer>,
    /// The entities, in drawing order.
    pub entities: Vec<Entity>,
}

/// A named layer; it determines the appearance of its entities.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Name, by convention of upper-case letters and digits.
    pub name: String,
    /// Color.
    pub color: Color,
    /// Pattern of the lines.
    pub line_type: LineType,
    /// Width of the lines, mm.
    pub line_width: f64,
    /// Whether the layer is plotted or cut; one that is not is for reference.
    pub plots: bool,
}

/// One of the colors with the same number in every drawing program.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Color {
    /// Black on paper, white on a dark screen.
    Foreground,
    /// Red.
    Red,
    /// Green.
    Green,
    /// Cyan.
    Cyan,
    /// Blue.
    Blue,
    /// Magenta.
    Magenta,
    /// Grey.
    Gray,
}

/// Pattern of a line.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum LineType {
    /// Solid line.
    Continuous,
    /// Long dash, dot: axes and reference curves.
    Center,
    /// Short dashes: hidden edges and limits.
    Hidden,
    /// Long dash, two dots: outlines of adjacent parts.
    Phantom,
}

impl LineType {
    /// All patterns.
    pub const ALL: [Self; 4] = [Self::Continuous, Self::Center, Self::Hidden, Self::Phantom];

    /// Dashes (positive) and gaps (negative), mm; a dot is a dash of no length.
    #[must_use]
    pub fn pattern(self) -> &'static [f64] {
        match self {
            Self::Continuous => &[],
            Self::Center => &[4.0, -1.0, 0.0, -1.0],
            Self::Hidden => &[2.0, -1.0],
            Self::Phantom => &[5.0, -1.0, 0.0, -1.0, 0.0, -1.0],
        }
    }
}

/// A shape on a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// Name of its layer.
    pub layer: String,
    /// Shape drawn.
    pub shape: EntityShape,
}

/// Shape of an entity.
#[derive(Clone, Debug, PartialEq)]
pub enum EntityShape {
    /// A closed contour.
    Contour(Outline),
    /// An open polyline.
    Polyline(Vec<Point>),
    /// A straight line.
    Line(Point, Point),
    /// A full circle.
    Circle {
        /// Its center.
        center: Point,
        /// Its radius, mm.
        radius: f64,
    },
    /// A circular arc.
    Arc(Arc),
    /// A filled triangle: the head of an arrow.
    Triangle([Point; 3]),
    /// A point mark.
    Mark(Point),
    /// One line of text.
    Text(Text),
    /// Entities that form one object, on the layer of this entity.
    Group(Group),
}

impl Entity {
    /// The entity moved, not turned.
    #[must_use]
    pub fn moved(&self, by: Vector) -> Self {
        Self {
            layer: self.layer.clone(),
            shape: self.shape.moved(by),
        }
    }

    /// Entities that are drawn for this one: itself, or all of its group.
    pub fn plain(&self) -> impl Iterator<Item = &Self> {
        let (own, drawn) = match &self.shape {
            EntityShape::Group(group) => (None, &group.drawn[..]),
            _ => (Some(self), &[][..]),
        };
        own.into_iter().chain(drawn)
    }
}

/// One line of text.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The anchor point.
    pub at: Point,
    /// Height of a capital letter, mm.
    pub height: f64,
    /// The words.
    pub words: String,
    /// Where the anchor lies on the text's baseline.
    pub anchor: Anchor,
    /// Direction of the baseline, rad.
    pub rotation: f64,
    /// Length of the baseline, mm, to which a reader with another font must fit the words; `None` if any length is good.
    pub width: Option<f64>,
}

impl Text {
    /// A horizontal line of text without a set length.
    #[must_use]
    pub fn new(at: Point, height: f64, words: impl Into<String>, anchor: Anchor) -> Self {
        Self {
            at,
            height,
            words: words.into(),
            anchor,
            rotation: 0.0,
            width: None,
        }
    }

    /// Length of the baseline: as set, or estimated.
    fn length(&self) -> f64 {
        self.width
            .unwrap_or(0.75 * self.height * self.words.chars().count() as f64)
    }

    /// Both ends of the baseline.
    #[must_use]
    pub fn baseline(&self) -> [Point; 2] {
        let along = Vector::new(self.rotation.cos(), self.rotation.sin()) * self.length();
        let before = match self.anchor {
            Anchor::Left => 0.0,
            Anchor::Middle => 0.5,
            Anchor::Right => 1.0,
        };
        let start = self.at - along * before;
        [start, start + along]
    }
}

/// Where a text's anchor lies on its baseline.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Anchor {
    /// At its left end.
    Left,
    /// In its middle.
    Middle,
    /// At its right end.
    Right,
}

impl Drawing {
    /// Adds a layer.
    #[must_use]
    pub fn layer(mut self, name: &str, color: Color, line_type: LineType, line_width: f64) -> Self {
        self.layers.push(Layer {
            name: name.to_owned(),
            color,
            line_type,
            line_width,
            plots: true,
        });
        self
    }

    /// Adds a shape on the layer of that name.
    pub fn draw(&mut self, layer: &str, shape: EntityShape) {
        self.entities.push(Entity {
            layer: layer.to_owned(),
            shape,
        });
    }

    /// Removes every layer that is not among these, and its entities.
    pub fn keep(&mut self, layers: &[&str]) {
        self.layers.retain(|layer| layers.contains(&&*layer.name));
        self.entities
            .retain(|entity| layers.contains(&&*entity.layer));
    }

    /// All entities in drawing order, each group replaced by its drawn entities.
    pub fn plain(&self) -> impl Iterator<Item = &Entity> {
        self.entities.iter().flat_map(Entity::plain)
    }

    /// The layer an entity lies on, `None` if the drawing lists none of that name.
    #[must_use]
    pub fn layer_of(&self, entity: &Entity) -> Option<&Layer> {
        self.layers.iter().find(|layer| layer.name == entity.layer)
    }

    /// A rectangle around everything drawn, texts by their estimated width.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        self.entities
            .iter()
            .fold(Bounds::EMPTY, |b, entity| b.union(entity.shape.bounds()))
    }
}

impl EntityShape {
    /// The shape moved, not turned.
    #[must_use]
    pub fn moved(&self, by: Vector) -> Self {
        match self {
            Self::Contour(outline) => {
                Self::Contour(outline.transformed(&Isometry2::translation(by.x, by.y)))
            }
            Self::Polyline(points) => Self::Polyline(points.iter().map(|p| p + by).collect()),
            Self::Line(start, end) => Self::Line(start + by, end + by),
            Self::Circle { center, radius } => Self::Circle {
                center: center + by,
                radius: *radius,
            },
            Self::Arc(arc) => Self::Arc(Arc {
                start: arc.start + by,
                end: arc.end + by,
                bulge: arc.bulge,
            }),
            Self::Triangle(corners) => Self::Triangle(corners.map(|p| p + by)),
            Self::Mark(point) => Self::Mark(point + by),
            Self::Text(text) => Self::Text(Text {
                at: text.at + by,
                ..text.clone()
            }),
            Self::Group(group) => Self::Group(group.moved(by)),
        }
    }

    /// A rectangle around the shape, a text by its set or estimated width.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let of = |points: &[Point]| points.iter().copied().collect();
        match self {
            Self::Contour(outline) => outline.bounds(),
            Self::Polyline(points) => of(points),
            Self::Line(start, end) => of(&[*start, *end]),
            Self::Circle { center, radius } => Outline::circle(*center, *radius).bounds(),
            Self::Arc(arc) => {
                // For arcs over half a turn the full circle, otherwise chord and middle.
                let middle = centrode_geometry::Segment::Arc(*arc).at(0.0).point;
                if arc.bulge.abs() > 1.0 {
                    Outline::circle(arc.center(), arc.radius()).bounds()
                } else {
                    of(&[arc.start, middle, arc.end])
                }
            }
            Self::Mark(point) => of(&[*point]),
            Self::Triangle(corners) => of(corners),
            Self::Text(text) => {
                let [start, end] = text.baseline();
                let up = Vector::new(-text.rotation.sin(), text.rotation.cos()) * text.height;
                of(&[start - up * 0.3, end - up * 0.3, start + up, end + up])
            }
            Self::Group(group) => group.bounds(),
        }
    }
}
