use std::cell::RefCell;

use super::overlap::Covered;
use super::{Pen, lettering};
use crate::drawing::{Anchor, Entity, EntityShape, Group, Object, Text};
use centrode_geometry::{Bounds, Outline, Point, Vector};

/// Length of an arrow head, mm.
pub(super) const ARROW: f64 = 3.0;

/// Minimum length of a squeezed line of text, relative to its natural length.
const SQUEEZE: f64 = 0.7;

/// Piece of a sheet in millimetres on paper; its origin is arbitrary until it is placed.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    entities: Vec<Entity>,
    known: Known,
    /// Height of the letters of dimensions and notes, mm.
    pub(super) letters: f64,
    /// Millimetres on paper per millimetre of the part.
    pub(super) scale: f64,
}

/// Areas covered by the first entities, computed when they are first needed.
#[derive(Clone, Debug, Default)]
struct Known(RefCell<Vec<Covered>>);

impl PartialEq for Known {
    /// Always true: the areas follow from the entities.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Default for Draft {
    /// Empty draft with letters of 3.5 mm.
    fn default() -> Self {
        Self::lettered(3.5)
    }
}

impl Draft {
    /// Empty draft with letters of this height for dimensions and notes, mm.
    #[must_use]
    pub fn lettered(letters: f64) -> Self {
        Self {
            entities: Vec::new(),
            known: Known::default(),
            letters,
            scale: 1.0,
        }
    }

    /// The draft with a scale, millimetres on paper per millimetre of the part.
    #[must_use]
    pub fn at_scale(self, scale: f64) -> Self {
        Self { scale, ..self }
    }

    /// Height of the letters of dimensions and notes, mm.
    pub fn lettering(&self) -> f64 {
        self.letters
    }

    /// Draws a shape.
    pub fn draw(&mut self, pen: Pen, shape: EntityShape) {
        self.entities.push(Entity {
            layer: pen.layer().to_owned(),
            shape,
        });
    }

    /// Draws a straight line.
    pub fn line(&mut self, pen: Pen, start: Point, end: Point) {
        self.draw(pen, EntityShape::Line(start, end));
    }

    /// Draws the four sides of a rectangle.
    pub fn rectangle(&mut self, pen: Pen, Bounds { min, max }: Bounds) {
        let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        self.draw(pen, EntityShape::Contour(Outline::polygon(&corners)));
    }

    /// Draws an arrow head with its tip at a point.
    pub fn arrow(&mut self, tip: Point, direction: Vector) {
        let back = -direction.normalize() * ARROW;
        let side = Vector::new(-back.y, back.x) * 0.16;
        let corners = [tip, tip + back + side, tip + back - side];
        self.draw(Pen::Dimension, EntityShape::Triangle(corners));
    }

    /// Writes a level line of words.
    pub fn text(&mut self, at: Point, height: f64, words: &str, anchor: Anchor) {
        self.turned_text(at, height, words, anchor, 0.0);
    }

    /// Writes a line of words along a direction, rad.
    pub fn turned_text(
        &mut self,
        at: Point,
        height: f64,
        words: &str,
        anchor: Anchor,
        rotation: f64,
    ) {
        if words.trim().is_empty() {
            return;
        }
        let text = Text {
            rotation,
            width: Some(lettering::width(words, height)),
            ..Text::new(at, height, words, anchor)
        };
        self.draw(Pen::Text, EntityShape::Text(text));
    }

    /// Writes words no longer than `room`, mm: with the first height that fits, otherwise squeezed, and if necessary cut short
    /// with dots.
    pub fn text_within(
        &mut self,
        at: Point,
        heights: &[f64],
        words: &str,
        anchor: Anchor,
        room: f64,
    ) {
        let fitting = heights
            .iter()
            .find(|&&h| lettering::width(words, h) <= room);
        let Some(&height) = fitting.or(heights.last()) else {
            return;
        };
        let mut words = words.to_owned();
        while lettering::width(&words, height) * SQUEEZE > room && !words.is_empty() {
            words = words.trim_end_matches('…').to_owned();
            words.pop();
            words.push('…');
            if words == "…" {
                break;
            }
        }
        if words.trim().is_empty() {
            return;
        }
        let text = Text {
            width: Some(lettering::width(&words, height).min(room)),
            ..Text::new(at, height, words, anchor)
        };
        self.draw(Pen::Text, EntityShape::Text(text));
    }

    /// Adds all of another draft, moved.
    pub fn add(&mut self, other: &Self, by: Vector) {
        self.entities
            .extend(other.entities.iter().map(|e| e.moved(by)));
    }

    /// Whether a line or words enter a rectangle.
    #[must_use]
    pub fn touches(&self, rectangle: Bounds) -> bool {
        self.any(|covered| covered.enters(rectangle))
    }

    /// Whether a straight line runs through words.
    pub fn strikes(&self, line: [Point; 2]) -> bool {
        self.any(|covered| covered.is_struck(line))
    }

    /// Whether the area that any entity covers meets a condition.
    fn any(&self, is: impl Fn(&Covered) -> bool) -> bool {
        let mut known = self.known.0.borrow_mut();
        let new = &self.entities[known.len()..];
        known.extend(new.iter().map(|entity| {
            let plain = entity.plain();
            Covered::new(plain.map(|plain| &plain.shape))
        }));
        known.iter().any(is)
    }

    /// Number of entities.
    pub(super) fn count(&self) -> usize {
        self.entities.len()
    }

    /// Makes one object of all entities from an index on, on the layer of a pen.
    pub(super) fn gather(&mut self, from: usize, pen: Pen, object: Object) {
        let drawn = self.entities.split_off(from);
        self.known.0.get_mut().truncate(from);
        if !drawn.is_empty() {
            self.draw(pen, EntityShape::Group(Group { object, drawn }));
        }
    }

    /// A rectangle around everything.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        let shapes = self.entities.iter().map(|entity| entity.shape.bounds());
        shapes.fold(Bounds::EMPTY, Bounds::union)
    }

    /// The shapes, on the layers of their pens.
    #[must_use]
    pub fn into_entities(self) -> Vec<Entity> {
        self.entities
    }
}
