//! Check that words on a sheet can be read: none may touch a line or other words.

use super::{Sheet, lettering};
use crate::drawing::{EntityShape, Text};
use centrode_geometry::{Bounds, Outline, Point, Segment, Tolerance, Vector};
use nalgebra::Rotation2;

/// Minimum distance between a leader and words, mm: a dimension's own line is 1.3 mm below its words.
const AIR: f64 = 1.5;

/// Words that touch something.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    /// The words.
    pub words: String,
    /// Touched object: other words, or the layer of a line.
    pub other: String,
    /// Position of the words, mm.
    pub at: Point,
}

/// Texts of a sheet that touch another text or a line, or leave the sheet, judged by the ink of their letters and the widths of
/// the lines.
#[must_use]
pub fn overlaps(sheet: &Sheet) -> Vec<Overlap> {
    let [width, height] = sheet.size.size();
    let mut texts: Vec<(&Text, Ink)> = Vec::new();
    let mut strokes: Vec<(&str, f64, [Point; 2])> = Vec::new();
    for entity in sheet.drawing.plain() {
        if let EntityShape::Text(text) = &entity.shape {
            texts.push((text, Ink::new(text)));
            continue;
        }
        let layer = sheet.drawing.layer_of(entity);
        let half = layer.map_or(0.0, |l| 0.5 * l.line_width);
        lines(&entity.shape, &mut |a, b| {
            strokes.push((&entity.layer, half, [a, b]));
        });
    }
    let mut found = Vec::new();
    let mut add = |text: &Text, other: &str| {
        found.push(Overlap {
            words: text.words.clone(),
            other: other.to_owned(),
            at: text.at,
        });
    };
    for (index, (text, ink)) in texts.iter().enumerate() {
        for (other, shape) in &texts[index + 1..] {
            if ink.meets(shape) {
                add(text, &other.words);
            }
        }
        for &(layer, half, line) in &strokes {
            if ink.is_met_by(line, half) {
                add(text, layer);
            }
        }
        let inside = |p: &Point| (0.0..width).contains(&p.x) && (0.0..height).contains(&p.y);
        if !ink.corners().iter().all(inside) {
            add(text, "edge of the sheet");
        }
    }
    found
}

/// Area that an entity covers: the ink of its words, and its lines.
#[derive(Clone, Debug)]
pub(super) struct Covered {
    inks: Vec<Ink>,
    lines: Vec<[Point; 2]>,
    /// Rectangle around the lines.
    around: Bounds,
}

impl Covered {
    pub(super) fn new<'a>(shapes: impl Iterator<Item = &'a EntityShape>) -> Self {
        let mut covered = Self {
            inks: Vec::new(),
            lines: Vec::new(),
            around: Bounds::EMPTY,
        };
        for shape in shapes {
            if let EntityShape::Text(text) = shape {
                covered.inks.push(Ink::new(text));
            } else {
                lines(shape, &mut |a, b| covered.lines.push([a, b]));
            }
        }
        covered.around = covered.lines.iter().flatten().copied().collect();
        covered
    }

    /// Whether the entity enters an axis-aligned rectangle.
    pub(super) fn enters(&self, rectangle: Bounds) -> bool {
        let ink = Ink {
            origin: Point::origin(),
            turn: Rotation2::identity(),
            bounds: rectangle,
            around: rectangle,
        };
        self.inks.iter().any(|own| ink.meets(own))
            || (near(&rectangle, &self.around, 0.0)
                && self.lines.iter().any(|line| ink.is_met_by(*line, 0.0)))
    }

    /// Whether a straight line of a thin pen runs through its words, or so near that it looks like their base line.
    pub(super) fn is_struck(&self, line: [Point; 2]) -> bool {
        self.inks.iter().any(|ink| ink.is_met_by(line, AIR))
    }
}

/// The rectangle of a text's ink, in the frame of its baseline.
#[derive(Clone, Debug)]
struct Ink {
    origin: Point,
    turn: Rotation2<f64>,
    bounds: Bounds,
    around: Bounds,
}

impl Ink {
    fn new(text: &Text) -> Self {
        let [origin, _] = text.baseline();
        let natural = lettering::width(&text.words, text.height);
        let squeeze = text.width.map_or(1.0, |width| width / natural);
        let mut bounds = lettering::ink(&text.words, text.height);
        bounds.min.x *= squeeze;
        bounds.max.x *= squeeze;
        let mut ink = Self {
            origin,
            turn: Rotation2::new(text.rotation),
            bounds,
            around: bounds,
        };
        ink.around = ink.corners().into_iter().collect();
        ink
    }

    fn corners(&self) -> [Point; 4] {
        let Bounds { min, max } = self.bounds;
        let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        corners.map(|p| self.origin + self.turn * p.coords)
    }

    /// Whether two rectangles overlap, by separating axes.
    fn meets(&self, other: &Self) -> bool {
        if !near(&self.around, &other.around, 0.0) {
            return false;
        }
        let (a, b) = (self.corners(), other.corners());
        let axes = [self.turn, other.turn]
            .into_iter()
            .flat_map(|turn| [turn * Vector::x(), turn * Vector::y()]);
        let range = |corners: &[Point; 4], axis: &Vector| {
            let along = corners.map(|p| p.coords.dot(axis));
            let low = along.into_iter().fold(f64::INFINITY, f64::min);
            (low, along.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        axes.into_iter().all(|axis| {
            let ((a_low, a_high), (b_low, b_high)) = (range(&a, &axis), range(&b, &axis));
            a_low < b_high && b_low < a_high
        })
    }

    /// Whether a line with this half width enters the rectangle.
    fn is_met_by(&self, [a, b]: [Point; 2], half: f64) -> bool {
        let line = Bounds::EMPTY.with(a).with(b);
        if !near(&self.around, &line, half) {
            return false;
        }
        let inside = self.turn.inverse();
        let (a, b) = (inside * (a - self.origin), inside * (b - self.origin));
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (low, high) = (self.bounds.min[axis] - half, self.bounds.max[axis] + half);
            let step = b[axis] - a[axis];
            if step == 0.0 {
                if a[axis] <= low || a[axis] >= high {
                    return false;
                }
                continue;
            }
            let ends = [(low - a[axis]) / step, (high - a[axis]) / step];
            from = from.max(ends[0].min(ends[1]));
            to = to.min(ends[0].max(ends[1]));
        }
        from < to
    }
}

fn near(a: &Bounds, b: &Bounds, margin: f64) -> bool {
    a.min.x < b.max.x + margin
        && b.min.x < a.max.x + margin
        && a.min.y < b.max.y + margin
        && b.min.y < a.max.y + margin
}

/// The shape as straight lines, within a fiftieth of a millimetre.
fn lines(shape: &EntityShape, add: &mut impl FnMut(Point, Point)) {
    let Ok(tolerance) = Tolerance::new(0.02) else {
        return;
    };
    let mut closed = |points: &[Point]| {
        let next = points.iter().cycle().skip(1);
        for (a, b) in points.iter().zip(next) {
            add(*a, *b);
        }
    };
    match shape {
        EntityShape::Contour(outline) => closed(&outline.flatten(tolerance)),
        EntityShape::Circle { center, radius } => {
            closed(&Outline::circle(*center, *radius).flatten(tolerance));
        }
        EntityShape::Triangle(corners) => closed(corners),
        EntityShape::Polyline(points) => points.windows(2).for_each(|w| add(w[0], w[1])),
        EntityShape::Line(a, b) => add(*a, *b),
        EntityShape::Arc(arc) => {
            let segment = Segment::Arc(*arc);
            let at = |i: u32| segment.at(-1.0 + f64::from(i) / 16.0).point;
            (0..32).for_each(|i| add(at(i), at(i + 1)));
        }
        EntityShape::Mark(point) => add(*point, *point),
        EntityShape::Text(_) | EntityShape::Group(_) => {}
    }
}
