//! Drawings: shapes on layers.

use centrode_geometry::{Arc, Bounds, Outline, Point};

/// Lines, arcs, contours and texts on named layers, in millimetres: what every drawing format is
/// written from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The layers, in the order a program should list them.
    pub layers: Vec<Layer>,
    /// The entities, in drawing order.
    pub entities: Vec<Entity>,
}

/// A named layer; its entities look as it says.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// Name, upper-case letters and digits by habit.
    pub name: String,
    /// Color.
    pub color: Color,
    /// Pattern of the lines.
    pub line_type: LineType,
    /// Width of the lines, mm.
    pub line_width: f64,
}

/// One of the colors every drawing program numbers alike.
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
    /// Drawn through.
    Continuous,
    /// Long dash, dot: axes and reference curves.
    Center,
    /// Short dashes: hidden edges and limits.
    Hidden,
}

impl LineType {
    /// Dashes (positive) and gaps (negative), mm; a dot is a dash of no length.
    #[must_use]
    pub fn pattern(self) -> &'static [f64] {
        match self {
            Self::Continuous => &[],
            Self::Center => &[4.0, -1.0, 0.0, -1.0],
            Self::Hidden => &[2.0, -1.0],
        }
    }
}

/// A shape on a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Entity {
    /// Name of its layer.
    pub layer: String,
    /// What is drawn.
    pub shape: Shape,
}

/// What can be drawn.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
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
    /// A point mark.
    Mark(Point),
    /// One line of text.
    Text(Text),
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
        });
        self
    }

    /// Adds a shape on the layer of that name.
    pub fn draw(&mut self, layer: &str, shape: Shape) {
        self.entities.push(Entity {
            layer: layer.to_owned(),
            shape,
        });
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

impl Shape {
    fn bounds(&self) -> Bounds {
        let of = |points: &[Point]| points.iter().fold(Bounds::EMPTY, |b, p| b.with(*p));
        match self {
            Self::Contour(outline) => outline.bounds(),
            Self::Polyline(points) => of(points),
            Self::Line(start, end) => of(&[*start, *end]),
            Self::Circle { center, radius } => Outline::circle(*center, *radius).bounds(),
            Self::Arc(arc) => {
                // The full circle for arcs of more than a half turn, chord and middle below.
                let middle = centrode_geometry::Segment::Arc(*arc).at(0.0).point;
                if arc.bulge.abs() > 1.0 {
                    Outline::circle(arc.center(), arc.radius()).bounds()
                } else {
                    of(&[arc.start, middle, arc.end])
                }
            }
            Self::Mark(point) => of(&[*point]),
            Self::Text(text) => {
                let width = 0.75 * text.height * text.words.chars().count() as f64;
                let left = match text.anchor {
                    Anchor::Left => 0.0,
                    Anchor::Middle => 0.5,
                    Anchor::Right => 1.0,
                };
                let corner = Point::new(text.at.x - left * width, text.at.y - 0.3 * text.height);
                of(&[
                    corner,
                    Point::new(corner.x + width, text.at.y + text.height),
                ])
            }
        }
    }
}
