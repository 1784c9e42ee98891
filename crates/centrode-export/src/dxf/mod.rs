//! DXF files for cutting machines and drawing programs.

mod r12;
mod r2010;

use crate::drawing::{Anchor, Drawing, LineType, Shape, Text};
use centrode_geometry::{Arc, Outline, Point, Segment, Tolerance};
use thiserror::Error;

/// Which DXF is written.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Version {
    /// Release 2010: lightweight polylines.
    #[default]
    R2010,
    /// Release 12: heavy polylines, for old controllers. Knows no splines.
    R12,
}

/// How a curved contour is written.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Curves {
    /// One closed polyline of lines and arcs, joined without a kink where the contour is smooth.
    #[default]
    Arcs,
    /// One closed cubic spline.
    Splines,
}

/// Why a drawing could not be written as DXF.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DxfError {
    /// R12 has no spline entity.
    #[error("DXF R12 has no splines: choose arcs, or version R2010")]
    SplinesInR12,
    /// An entity lies on a layer the drawing does not list.
    #[error("no layer is named {name:?}")]
    Layer {
        /// The missing name.
        name: String,
    },
    /// The DXF library refused.
    #[error("cannot write DXF: {0}")]
    Library(#[from] dxf::DxfError),
}

/// A drawing as DXF text in millimetres (`$INSUNITS` 4), each contour one closed entity within the
/// tolerance. The same drawing always gives the same bytes: dates and identifiers are fixed.
///
/// # Errors
/// [`DxfError`] for splines in R12 or an entity without a layer.
pub fn write(
    drawing: &Drawing,
    version: Version,
    curves: Curves,
    tolerance: Tolerance,
) -> Result<Vec<u8>, DxfError> {
    if let Some(entity) = drawing
        .entities
        .iter()
        .find(|e| drawing.layer_of(e).is_none())
    {
        return Err(DxfError::Layer {
            name: entity.layer.clone(),
        });
    }
    match (version, curves) {
        (Version::R12, Curves::Splines) => Err(DxfError::SplinesInR12),
        (Version::R12, Curves::Arcs) => Ok(r12::write(drawing, tolerance)),
        (Version::R2010, _) => r2010::write(drawing, curves, tolerance),
    }
}

/// Points of a contour of lines and arcs, each with the bulge of what follows it.
fn bulges(arcs: &Outline) -> impl Iterator<Item = (Point, f64)> {
    arcs.segments().iter().map(|segment| match segment {
        Segment::Arc(arc) => (arc.start, arc.bulge),
        other => (other.start(), 0.0),
    })
}

/// Start and end angle in degrees of an arc run through counter-clockwise, as DXF has them.
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

/// Text style of fitted texts: the ISO 3098 shapes that drawing programs bring along.
const STYLE: &str = "ISO3098";
const STYLE_FONT: &str = "isocp.shx";

/// How a text stands between its two points. A fitted text has the same length whatever font a program
/// has at hand; of very short ones a program would stretch a single letter.
fn justification(text: &Text) -> (u32, [Point; 2]) {
    match (text.width, text.anchor) {
        (Some(_), _) if text.words.chars().count() > 3 => (5, text.baseline()),
        (_, Anchor::Left) => (0, [text.at; 2]),
        (_, Anchor::Middle) => (1, [text.at; 2]),
        (_, Anchor::Right) => (2, [text.at; 2]),
    }
}

/// The line types a file lists: those every program knows, and what else the drawing has.
fn line_types(drawing: &Drawing, continuous: bool) -> Vec<LineType> {
    let used = |line_type| drawing.layers.iter().any(|l| l.line_type == line_type);
    LineType::ALL
        .into_iter()
        .filter(|&line_type| match line_type {
            LineType::Continuous => continuous,
            LineType::Center | LineType::Hidden => true,
            LineType::Phantom => used(line_type),
        })
        .collect()
}

fn has_fitted_text(drawing: &Drawing) -> bool {
    let mut shapes = drawing.entities.iter().map(|entity| &entity.shape);
    shapes.any(|shape| matches!(shape, Shape::Text(text) if text.width.is_some()))
}

fn line_type_name(line_type: LineType) -> &'static str {
    match line_type {
        LineType::Continuous => "CONTINUOUS",
        LineType::Center => "CENTER",
        LineType::Hidden => "HIDDEN",
        LineType::Phantom => "PHANTOM",
    }
}

fn description(line_type: LineType) -> &'static str {
    match line_type {
        LineType::Continuous => "Solid line",
        LineType::Center => "Center ____ . ____ . ____",
        LineType::Hidden => "Hidden __ __ __ __ __",
        LineType::Phantom => "Phantom ____ . . ____ . . ____",
    }
}

/// The color's number in the index every drawing program has.
fn color_index(color: crate::drawing::Color) -> u8 {
    use crate::drawing::Color;
    match color {
        Color::Red => 1,
        Color::Green => 3,
        Color::Cyan => 4,
        Color::Blue => 5,
        Color::Magenta => 6,
        Color::Foreground => 7,
        Color::Gray => 8,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Color;
    use dxf::{Drawing as File, entities::EntityType, enums::Units};

    fn sample() -> Drawing {
        let p = Point::new;
        let mut drawing = Drawing::default()
            .layer("PROFILE", Color::Foreground, LineType::Continuous, 0.35)
            .layer("AXES", Color::Red, LineType::Center, 0.18);
        drawing.draw(
            "PROFILE",
            Shape::Contour(Outline::circle(p(1.0, 2.0), 10.0)),
        );
        drawing.draw(
            "PROFILE",
            Shape::Polyline(vec![p(0.0, 0.0), p(1.0, 5.0), p(4.0, 4.0)]),
        );
        drawing.draw("AXES", Shape::Line(p(-12.0, 0.0), p(12.0, 0.0)));
        drawing.draw(
            "AXES",
            Shape::Circle {
                center: p(0.0, 0.0),
                radius: 3.0,
            },
        );
        let arc = Arc {
            start: p(5.0, 0.0),
            end: p(0.0, 5.0),
            bulge: -0.4,
        };
        drawing.draw("AXES", Shape::Arc(arc));
        drawing.draw("AXES", Shape::Mark(p(0.0, 0.0)));
        drawing.draw(
            "AXES",
            Shape::Text(Text::new(p(0.0, -15.0), 3.5, "z = 23", Anchor::Middle)),
        );
        drawing
    }

    fn tolerance() -> Tolerance {
        Tolerance::new(1e-3).expect("positive")
    }

    #[test]
    fn a_contour_reads_back_as_one_closed_polyline() {
        let bytes = write(&sample(), Version::R2010, Curves::Arcs, tolerance()).expect("written");
        let file = File::load(&mut bytes.as_slice()).expect("readable");
        assert_eq!(file.header.default_drawing_units, Units::Millimeters);
        let mut contours = 0;
        for entity in file.entities() {
            if let EntityType::LwPolyline(polyline) = &entity.specific
                && polyline.is_closed()
            {
                contours += 1;
                assert_eq!(entity.common.layer, "PROFILE");
                assert_eq!(polyline.vertices.len(), 2);
                assert!(
                    polyline
                        .vertices
                        .iter()
                        .all(|v| (v.bulge - 1.0).abs() < 1e-12)
                );
            }
        }
        assert_eq!((contours, file.entities().count()), (1, 7));
    }

    #[test]
    fn the_same_drawing_gives_the_same_bytes() {
        let every = || {
            [
                (Version::R2010, Curves::Arcs),
                (Version::R2010, Curves::Splines),
                (Version::R12, Curves::Arcs),
            ]
            .map(|(version, curves)| {
                write(&sample(), version, curves, tolerance()).expect("written")
            })
        };
        let first = every();
        std::thread::sleep(std::time::Duration::from_millis(1100));
        assert!(first == every());
    }

    #[test]
    fn what_the_format_has_not_is_refused() {
        assert!(matches!(
            write(&sample(), Version::R12, Curves::Splines, tolerance()),
            Err(DxfError::SplinesInR12)
        ));
        let mut drawing = sample();
        drawing.draw("NOWHERE", Shape::Mark(Point::origin()));
        assert!(matches!(
            write(&drawing, Version::R2010, Curves::Arcs, tolerance()),
            Err(DxfError::Layer { .. })
        ));
    }
}
