//! DXF R12, which is simple enough to be written line by line; old controllers want nothing beside.

use super::{
    STYLE, STYLE_FONT, angles, bulges, color_index, description, justification, line_type_name,
};
use crate::drawing::{Drawing, LineType, Shape, Text};
use centrode_geometry::{Point, Tolerance};

pub(super) fn write(drawing: &Drawing, tolerance: Tolerance) -> Vec<u8> {
    let mut file = Pairs::default();
    header(&mut file, drawing);
    tables(&mut file, drawing);
    file.word(0, "SECTION").word(2, "ENTITIES");
    for entity in &drawing.entities {
        shape(&mut file, &entity.layer, &entity.shape, tolerance);
    }
    file.word(0, "ENDSEC").word(0, "EOF");
    file.text.into_bytes()
}

/// Group codes with their values.
#[derive(Default)]
struct Pairs {
    text: String,
}

impl Pairs {
    fn word(&mut self, code: u16, value: &str) -> &mut Self {
        self.text.push_str(&format!("{code:>3}\r\n{value}\r\n"));
        self
    }

    fn whole(&mut self, code: u16, value: u32) -> &mut Self {
        self.word(code, &format!("{value:>6}"))
    }

    /// A number to twelve places, as many as the newer version's writer keeps.
    fn number(&mut self, code: u16, value: f64) -> &mut Self {
        let text = format!("{:.12}", value + 0.0);
        let short = text.trim_end_matches('0');
        let dot = if short.ends_with('.') { "0" } else { "" };
        self.word(code, &format!("{short}{dot}"))
    }

    /// x at `code`, y and z ten and twenty after it.
    fn point(&mut self, code: u16, point: &Point) -> &mut Self {
        self.number(code, point.x)
            .number(code + 10, point.y)
            .number(code + 20, 0.0)
    }
}

fn header(file: &mut Pairs, drawing: &Drawing) {
    file.word(0, "SECTION").word(2, "HEADER");
    file.word(9, "$ACADVER").word(1, "AC1009");
    // Unknown to R12 itself, read by most programs since: millimetres.
    file.word(9, "$INSUNITS").whole(70, 4);
    file.word(9, "$MEASUREMENT").whole(70, 1);
    file.word(9, "$LTSCALE").number(40, 1.0);
    let bounds = drawing.bounds();
    if bounds.diagonal().is_finite() {
        file.word(9, "$EXTMIN").point(10, &bounds.min);
        file.word(9, "$EXTMAX").point(10, &bounds.max);
        // Some programs take these for the paper.
        let limits = [("$LIMMIN", bounds.min), ("$LIMMAX", bounds.max)];
        let paper = [("$PLIMMIN", bounds.min), ("$PLIMMAX", bounds.max)];
        for (name, point) in limits.into_iter().chain(paper) {
            file.word(9, name).number(10, point.x).number(20, point.y);
        }
    }
    file.word(0, "ENDSEC");
}

fn tables(file: &mut Pairs, drawing: &Drawing) {
    file.word(0, "SECTION").word(2, "TABLES");
    let line_types = super::line_types(drawing, true);
    file.word(0, "TABLE")
        .word(2, "LTYPE")
        .whole(70, line_types.len() as u32);
    for line_type in line_types {
        let pattern = line_type.pattern();
        file.word(0, "LTYPE")
            .word(2, line_type_name(line_type))
            .whole(70, 0);
        file.word(3, description(line_type))
            .whole(72, 65)
            .whole(73, pattern.len() as u32);
        file.number(40, pattern.iter().map(|d| d.abs()).sum());
        for &dash in pattern {
            file.number(49, dash);
        }
    }
    file.word(0, "ENDTAB");
    file.word(0, "TABLE")
        .word(2, "LAYER")
        .whole(70, drawing.layers.len() as u32 + 1);
    let mut layer = |name: &str, color: u8, line_type: LineType| {
        file.word(0, "LAYER")
            .word(2, name)
            .whole(70, 0)
            .whole(62, u32::from(color));
        file.word(6, line_type_name(line_type));
    };
    layer("0", 7, LineType::Continuous);
    for l in &drawing.layers {
        layer(&l.name, color_index(l.color), l.line_type);
    }
    file.word(0, "ENDTAB");
    let styles: &[(&str, &str)] = if super::has_fitted_text(drawing) {
        &[("STANDARD", "txt"), (STYLE, STYLE_FONT)]
    } else {
        &[("STANDARD", "txt")]
    };
    file.word(0, "TABLE")
        .word(2, "STYLE")
        .whole(70, styles.len() as u32);
    for (name, font) in styles {
        file.word(0, "STYLE")
            .word(2, name)
            .whole(70, 0)
            .number(40, 0.0)
            .number(41, 1.0);
        file.number(50, 0.0)
            .whole(71, 0)
            .number(42, 2.5)
            .word(3, font)
            .word(4, "");
    }
    file.word(0, "ENDTAB").word(0, "ENDSEC");
}

fn shape(file: &mut Pairs, layer: &str, shape: &Shape, tolerance: Tolerance) {
    match shape {
        Shape::Contour(outline) => {
            let arcs = outline.arcs(tolerance);
            polyline(file, layer, true, bulges(&arcs));
        }
        Shape::Polyline(points) => {
            polyline(file, layer, false, points.iter().map(|p| (*p, 0.0)));
        }
        Shape::Line(start, end) => {
            file.word(0, "LINE")
                .word(8, layer)
                .point(10, start)
                .point(11, end);
        }
        Shape::Circle { center, radius } => {
            file.word(0, "CIRCLE")
                .word(8, layer)
                .point(10, center)
                .number(40, *radius);
        }
        Shape::Arc(arc) => {
            let [start, end] = angles(arc);
            file.word(0, "ARC").word(8, layer).point(10, &arc.center());
            file.number(40, arc.radius())
                .number(50, start)
                .number(51, end);
        }
        Shape::Triangle([a, b, c]) => {
            // A fourth corner on the third: that is how a triangle is written.
            file.word(0, "SOLID")
                .word(8, layer)
                .point(10, a)
                .point(11, b);
            file.point(12, c).point(13, c);
        }
        Shape::Mark(point) => {
            file.word(0, "POINT").word(8, layer).point(10, point);
        }
        Shape::Text(text) => line_of_text(file, layer, text),
    }
}

fn polyline(
    file: &mut Pairs,
    layer: &str,
    closed: bool,
    vertices: impl Iterator<Item = (Point, f64)>,
) {
    file.word(0, "POLYLINE").word(8, layer).whole(66, 1);
    file.point(10, &Point::origin())
        .whole(70, u32::from(closed));
    for (point, bulge) in vertices {
        file.word(0, "VERTEX").word(8, layer).point(10, &point);
        if bulge != 0.0 {
            file.number(42, bulge);
        }
    }
    file.word(0, "SEQEND").word(8, layer);
}

fn line_of_text(file: &mut Pairs, layer: &str, text: &Text) {
    let (justification, [start, end]) = justification(text);
    file.word(0, "TEXT")
        .word(8, layer)
        .point(10, &start)
        .number(40, text.height);
    file.word(1, &ascii(&text.words));
    if text.rotation != 0.0 {
        file.number(50, text.rotation.to_degrees());
    }
    if text.width.is_some() {
        file.word(7, STYLE);
    }
    if justification != 0 {
        file.whole(72, justification).point(11, &end);
    }
}

/// R12 knows no letters beyond ASCII: others by their code, line ends as spaces.
fn ascii(words: &str) -> String {
    words
        .chars()
        .map(|c| match c {
            c if c.is_control() => " ".to_owned(),
            c if c.is_ascii() => c.to_string(),
            c => format!("\\U+{:04X}", u32::from(c)),
        })
        .collect()
}
