//! SVG pictures.

use crate::{
    drawing::{Anchor, Color, Drawing, EntityShape, LineType, Text},
    sheet::{Sheet, lettering},
    xml::escaped,
};
use centrode_geometry::{Arc, Outline, Point, Segment, Tolerance, Vector};
use std::{collections::BTreeSet, fmt::Write};

/// Writes a drawing as an SVG picture, one user unit per millimetre, with lines and true arcs.
///
/// Curved contours become arcs within the tolerance. Numbers are rounded to a millionth of a millimetre.
#[must_use]
pub fn write(drawing: &Drawing, tolerance: Tolerance) -> String {
    let mut bounds = drawing.bounds();
    if !bounds.diagonal().is_finite() {
        bounds = centrode_geometry::Bounds::EMPTY
            .with(Point::origin())
            .with(Point::new(1.0, 1.0));
    }
    let margin = Vector::repeat(0.04 * bounds.diagonal().max(1.0));
    let (low, high) = (bounds.min - margin, bounds.max + margin);
    let (width, height) = (number(high.x - low.x), number(high.y - low.y));
    let mut out = String::new();
    // y points up in a drawing and down in a picture: every y is negated.
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"{} {} {width} {height}\">",
        number(low.x),
        number(-high.y),
    );
    layers(&mut out, drawing, tolerance, false);
    out.push_str("</svg>\n");
    out
}

/// Writes a drawing sheet as an SVG picture of its size. Words are drawn with the outlines of the sheet's own font, so that every
/// viewer shows the same; each line is a group with its words as a label.
#[must_use]
pub fn sheet(sheet: &Sheet, tolerance: Tolerance) -> String {
    let [width, height] = sheet.size.size().map(number);
    let mut out = String::new();
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
         width=\"{width}mm\" height=\"{height}mm\" viewBox=\"0 -{height} {width} {height}\">\n\
         <rect x=\"0\" y=\"-{height}\" width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>",
    );
    let mut glyphs = BTreeSet::new();
    for entity in sheet.drawing.plain() {
        if let EntityShape::Text(text) = &entity.shape {
            let inked = lettering::letters(&text.words).filter(|l| l.is_inked());
            glyphs.extend(inked.map(|l| l.glyph));
        }
    }
    out.push_str("<defs>\n");
    for glyph in glyphs {
        let path = lettering::path(glyph);
        let _ = writeln!(out, "<path id=\"g{glyph}\" d=\"{path}\"/>");
    }
    out.push_str("</defs>\n");
    layers(&mut out, &sheet.drawing, tolerance, true);
    out.push_str("</svg>\n");
    out
}

/// A line of words as glyphs placed one by one.
fn outlined_words(out: &mut String, text: &Text, color: Color) {
    let natural = lettering::width(&text.words, text.height);
    let squeeze = text.width.map_or(1.0, |width| width / natural);
    let unit = lettering::em(text.height) / lettering::UNITS;
    let [start, _] = text.baseline();
    let _ = write!(
        out,
        "<g aria-label=\"{}\" fill=\"{}\" stroke=\"none\" transform=\"translate({} {})",
        escaped(&text.words),
        paint(color),
        number(start.x),
        number(-start.y),
    );
    if text.rotation != 0.0 {
        let _ = write!(out, " rotate({})", number(-text.rotation.to_degrees()));
    }
    let _ = write!(out, " scale({:.9} {unit:.9})\">", unit * squeeze);
    let mut x = 0.0;
    for letter in lettering::letters(&text.words) {
        if letter.is_inked() {
            let (glyph, x) = (letter.glyph, number(x));
            let _ = write!(out, "<use xlink:href=\"#g{glyph}\" x=\"{x}\"/>");
        }
        x += lettering::UNITS * letter.advance;
    }
    out.push_str("</g>\n");
}

fn layers(out: &mut String, drawing: &Drawing, tolerance: Tolerance, outlined: bool) {
    for layer in &drawing.layers {
        let dashes = match layer.line_type {
            LineType::Continuous => String::new(),
            _ => {
                // Round caps turn a very short dash into a dot; not every viewer draws a dash of length zero.
                let dashes: Vec<String> = layer
                    .line_type
                    .pattern()
                    .iter()
                    .map(|d| number(d.abs().max(0.01)))
                    .collect();
                format!(" stroke-dasharray=\"{}\"", dashes.join(" "))
            }
        };
        let _ = writeln!(
            out,
            "<g id=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" \
             stroke-linecap=\"round\"{dashes}>",
            escaped(&layer.name),
            paint(layer.color),
            number(layer.line_width),
        );
        for entity in drawing.plain().filter(|e| e.layer == layer.name) {
            if let (true, EntityShape::Text(text)) = (outlined, &entity.shape) {
                outlined_words(out, text, layer.color);
                continue;
            }
            shape(out, &entity.shape, layer.color, layer.line_width, tolerance);
        }
        out.push_str("</g>\n");
    }
}

fn shape(
    out: &mut String,
    shape: &EntityShape,
    color: Color,
    line_width: f64,
    tolerance: Tolerance,
) {
    let _ = match shape {
        EntityShape::Contour(outline) => {
            writeln!(out, "<path d=\"{}\"/>", contour(&outline.arcs(tolerance)))
        }
        EntityShape::Polyline(points) => {
            let points: Vec<String> = points.iter().map(pair).collect();
            writeln!(out, "<polyline points=\"{}\"/>", points.join(" "))
        }
        EntityShape::Line(start, end) => {
            writeln!(out, "<path d=\"M{} L{}\"/>", pair(start), pair(end))
        }
        EntityShape::Circle { center, radius } => writeln!(
            out,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\"/>",
            number(center.x),
            number(-center.y),
            number(*radius),
        ),
        EntityShape::Arc(arc) => writeln!(
            out,
            "<path d=\"M{} {}\"/>",
            pair(&arc.start),
            arc_command(arc)
        ),
        EntityShape::Mark(point) => {
            let reach = 6.0 * line_width;
            let (x, y) = (Vector::new(reach, 0.0), Vector::new(0.0, reach));
            writeln!(
                out,
                "<path d=\"M{} L{} M{} L{}\"/>",
                pair(&(point - x)),
                pair(&(point + x)),
                pair(&(point - y)),
                pair(&(point + y)),
            )
        }
        EntityShape::Triangle(corners) => writeln!(
            out,
            "<path d=\"M{} L{} L{} Z\" fill=\"{}\" stroke=\"none\"/>",
            pair(&corners[0]),
            pair(&corners[1]),
            pair(&corners[2]),
            paint(color),
        ),
        EntityShape::Text(text) => words(out, text, color),
        // Its entities are written one by one.
        EntityShape::Group(_) => Ok(()),
    };
}

fn contour(arcs: &Outline) -> String {
    let Some(first) = arcs.segments().first() else {
        return String::new();
    };
    let mut d = format!("M{}", pair(&first.start()));
    for segment in arcs.segments() {
        match segment {
            Segment::Arc(arc) => {
                let _ = write!(d, " {}", arc_command(arc));
            }
            _ => {
                let _ = write!(d, " L{}", pair(&segment.end()));
            }
        }
    }
    d.push_str(" Z");
    d
}

fn arc_command(arc: &Arc) -> String {
    let radius = number(arc.radius());
    let large = u8::from(arc.bulge.abs() > 1.0);
    let sweep = u8::from(arc.bulge < 0.0);
    format!("A{radius} {radius} 0 {large} {sweep} {}", pair(&arc.end))
}

fn words(out: &mut String, text: &Text, color: Color) -> std::fmt::Result {
    let anchor = match text.anchor {
        Anchor::Left => "start",
        Anchor::Middle => "middle",
        Anchor::Right => "end",
    };
    // Capitals are about 0.7 of a font's size.
    writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"{anchor}\" \
         fill=\"{}\" stroke=\"none\">{}</text>",
        number(text.at.x),
        number(-text.at.y),
        number(text.height / 0.7),
        paint(color),
        escaped(&text.words),
    )
}

fn pair(point: &Point) -> String {
    format!("{},{}", number(point.x), number(-point.y))
}

/// A number to a millionth, without trailing zeros.
fn number(x: f64) -> String {
    let text = format!("{x:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".to_owned()
    } else {
        text.to_owned()
    }
}

fn paint(color: Color) -> &'static str {
    match color {
        Color::Foreground => "#1a1a1a",
        Color::Red => "#c62828",
        Color::Green => "#2e7d32",
        Color::Cyan => "#00838f",
        Color::Blue => "#1565c0",
        Color::Magenta => "#ad1457",
        Color::Gray => "#8a8a8a",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_appear_upright_in_millimetres() {
        let mut drawing = Drawing::default().layer("CUT", Color::Red, LineType::Center, 0.25);
        drawing.draw(
            "CUT",
            EntityShape::Contour(Outline::circle(Point::new(0.0, 5.0), 2.0)),
        );
        drawing.draw(
            "CUT",
            EntityShape::Line(Point::origin(), Point::new(10.0, 1.0 / 3.0)),
        );
        drawing.draw(
            "CUT",
            EntityShape::Text(Text::new(
                Point::new(1.0, 9.0),
                3.5,
                "a < b & c",
                Anchor::Left,
            )),
        );
        let svg = write(&drawing, Tolerance::new(1e-3).expect("positive"));
        assert!(
            svg.contains("M2,-5 A2 2 0 0 0 -2,-5 A2 2 0 0 0 2,-5 Z"),
            "{svg}"
        );
        assert!(svg.contains("M0,0 L10,-0.333333"));
        assert!(svg.contains("a &lt; b &amp; c"));
        assert!(svg.contains("stroke-dasharray=\"4 1 0.01 1\""));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        let empty = write(&Drawing::default(), Tolerance::new(1.0).expect("positive"));
        assert!(!empty.contains("inf") && !empty.contains("NaN"));
    }
}
