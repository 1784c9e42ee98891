//! Entities of a drawing, as each version writes them.

use super::pairs::{Handle, Pairs};
use super::tables::weight;
use super::{Curves, STYLE};
use crate::drawing::{Anchor, Drawing, Entity, EntityShape, Object, Text};
use centrode_geometry::{Arc, Point, Segment, Tolerance};

/// Writes the entities of a drawing, owned by the model space; each has the appearance of its layer. The newer version has the
/// width of the lines at each entity too: some programs ignore that of the layer.
pub(super) fn entities(writer: &mut Writer<'_>, drawing: &Drawing, space: Handle) {
    writer.file.section("ENTITIES");
    writer.owner = space;
    let mut dimensions = 0;
    for entity in &drawing.entities {
        let EntityShape::Group(group) = &entity.shape else {
            writer.entity(drawing, entity);
            continue;
        };
        if !writer.file.is_newer() {
            for drawn in &group.drawn {
                writer.entity(drawing, drawn);
            }
            continue;
        }
        writer.weight = drawing.layer_of(entity).map(|l| weight(l.line_width));
        match &group.object {
            Object::Dimension(dimension) => {
                writer.dimension(&entity.layer, dimension, dimensions, drawing);
                dimensions += 1;
            }
            Object::Hatch(hatch) => writer.hatch(&entity.layer, hatch),
        }
    }
    writer.file.word(0, "ENDSEC");
}

/// Writes entities one by one.
pub(super) struct Writer<'a> {
    pub(super) file: &'a mut Pairs,
    /// Space or block the entities belong to.
    pub(super) owner: Handle,
    /// Weight of the lines of the next entity.
    weight: Option<u32>,
    curves: Curves,
    pub(super) tolerance: Tolerance,
}

impl<'a> Writer<'a> {
    pub(super) fn new(file: &'a mut Pairs, curves: Curves, tolerance: Tolerance) -> Self {
        Self {
            file,
            owner: Handle::NONE,
            weight: None,
            curves,
            tolerance,
        }
    }
}

impl Writer<'_> {
    pub(super) fn begin(&mut self, kind: &str, layer: &str, class: &str) -> &mut Pairs {
        self.file.entry(kind, self.owner);
        self.file.class("AcDbEntity").word(8, layer);
        if let Some(weight) = self.weight.filter(|_| self.file.is_newer()) {
            self.file.whole(370, weight);
        }
        self.file.class(class)
    }

    /// Writes an entity that is no group.
    pub(super) fn entity(&mut self, drawing: &Drawing, entity: &Entity) {
        self.weight = drawing.layer_of(entity).map(|l| weight(l.line_width));
        self.shape(&entity.layer, &entity.shape);
    }

    fn shape(&mut self, layer: &str, shape: &EntityShape) {
        match shape {
            EntityShape::Contour(outline) => match (outline.as_circle(), self.curves) {
                (Some((center, radius)), _) => {
                    self.shape(layer, &EntityShape::Circle { center, radius });
                }
                (None, Curves::Arcs) => {
                    let arcs = outline.arcs(self.tolerance);
                    let bulges = arcs.segments().iter().map(|segment| match segment {
                        Segment::Arc(arc) => (arc.start, arc.bulge),
                        other => (other.start(), 0.0),
                    });
                    self.polyline(layer, true, bulges);
                }
                (None, Curves::Splines) => self.spline(layer, &outline.cubics(self.tolerance)),
                (None, Curves::Chords) => {
                    let corners = outline.flatten(self.tolerance);
                    self.polyline(layer, true, corners.into_iter().map(|p| (p, 0.0)));
                }
            },
            EntityShape::Polyline(points) => {
                self.polyline(layer, false, points.iter().map(|p| (*p, 0.0)));
            }
            EntityShape::Line(start, end) => {
                let line = self.begin("LINE", layer, "AcDbLine");
                line.point(10, start).point(11, end);
            }
            EntityShape::Circle { center, radius } => {
                let circle = self.begin("CIRCLE", layer, "AcDbCircle");
                circle.point(10, center).number(40, *radius);
            }
            EntityShape::Arc(arc) => {
                let [start, end] = angles(arc);
                let file = self.begin("ARC", layer, "AcDbCircle");
                file.point(10, &arc.center()).number(40, arc.radius());
                file.class("AcDbArc").number(50, start).number(51, end);
            }
            EntityShape::Triangle([a, b, c]) => {
                // A triangle is written with a fourth corner on the third.
                let solid = self.begin("SOLID", layer, "AcDbTrace");
                solid.point(10, a).point(11, b).point(12, c).point(13, c);
            }
            EntityShape::Mark(point) => {
                self.begin("POINT", layer, "AcDbPoint").point(10, point);
            }
            EntityShape::Text(text) => self.line_of_text(layer, text),
            // Its entities are written one by one.
            EntityShape::Group(_) => {}
        }
    }

    /// Writes a polyline: light in the newer version, heavy in R12.
    fn polyline(
        &mut self,
        layer: &str,
        closed: bool,
        vertices: impl ExactSizeIterator<Item = (Point, f64)>,
    ) {
        let closed = u32::from(closed);
        if self.file.is_newer() {
            let light = self.begin("LWPOLYLINE", layer, "AcDbPolyline");
            light.whole(90, vertices.len() as u32).whole(70, closed);
            for (point, bulge) in vertices {
                light.flat(10, &point);
                if bulge != 0.0 {
                    light.number(42, bulge);
                }
            }
            return;
        }
        let heavy = self.begin("POLYLINE", layer, "AcDb2dPolyline");
        heavy.whole(66, 1).point(10, &Point::origin());
        heavy.whole(70, closed);
        for (point, bulge) in vertices {
            let vertex = self.begin("VERTEX", layer, "AcDb2dVertex");
            vertex.point(10, &point);
            if bulge != 0.0 {
                vertex.number(42, bulge);
            }
        }
        self.file.word(0, "SEQEND").word(8, layer);
    }

    /// One cubic spline through Bézier pieces: every inner knot three times.
    fn spline(&mut self, layer: &str, cubics: &[[Point; 4]]) {
        const CLOSED_AND_PLANAR: u32 = 1 + 8;
        let count = cubics.len();
        let spline = self.begin("SPLINE", layer, "AcDbSpline");
        spline.whole(70, CLOSED_AND_PLANAR).whole(71, 3);
        spline
            .whole(72, 3 * count as u32 + 5)
            .whole(73, 3 * count as u32 + 1);
        spline.whole(74, 0).number(40, 0.0);
        for knot in 0..=count {
            for _ in 0..3 {
                spline.number(40, knot as f64);
            }
        }
        spline.number(40, count as f64);
        for cubic in cubics {
            for point in &cubic[..3] {
                spline.point(10, point);
            }
        }
        if let Some(last) = cubics.last() {
            spline.point(10, &last[3]);
        }
    }

    fn line_of_text(&mut self, layer: &str, text: &Text) {
        let (justification, [start, end]) = justification(text);
        let file = self.begin("TEXT", layer, "AcDbText");
        file.point(10, &start).number(40, text.height);
        file.line(1, &text.words);
        if text.rotation != 0.0 {
            file.number(50, text.rotation.to_degrees());
        }
        if text.width.is_some() {
            file.word(7, STYLE);
        }
        if justification != 0 {
            file.whole(72, justification).point(11, &end);
        }
        file.class("AcDbText");
    }
}

/// Start and end angle of an arc in degrees, counter-clockwise as DXF requires.
fn angles(arc: &Arc) -> [f64; 2] {
    let center = arc.center();
    let angle = |p: &Point| {
        (p.y - center.y)
            .atan2(p.x - center.x)
            .to_degrees()
            .rem_euclid(360.0)
    };
    let ends = if arc.bulge > 0.0 {
        [&arc.start, &arc.end]
    } else {
        [&arc.end, &arc.start]
    };
    ends.map(angle)
}

/// Justification of a text between its two points. A fitted text has the same length with any font of a program. Very short texts
/// are not fitted: a program would stretch a single letter.
fn justification(text: &Text) -> (u32, [Point; 2]) {
    match (text.width, text.anchor) {
        (Some(_), _) if text.words.chars().count() > 3 => (5, text.baseline()),
        (_, Anchor::Left) => (0, [text.at; 2]),
        (_, Anchor::Middle) => (1, [text.at; 2]),
        (_, Anchor::Right) => (2, [text.at; 2]),
    }
}
