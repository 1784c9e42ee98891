//! DXF files for cutting machines and drawing programs.

use crate::drawing::{Anchor, Color, Drawing, Layer, LineType, Shape, Text};
use centrode_geometry::{Arc, Outline, Point, Segment, Tolerance};
use chrono::{Local, NaiveDate, TimeZone};
use dxf::{
    Drawing as File, LwPolylineVertex, Point as Position,
    entities::{self, EntityType},
    enums::{AcadVersion, HorizontalTextJustification, Units},
    tables,
};
use thiserror::Error;

/// Which DXF is written.
#[derive(Clone, Copy, Debug, Default, Eq, PartialEq)]
pub enum Version {
    /// AutoCAD 2010: lightweight polylines.
    #[default]
    R2010,
    /// AutoCAD R12: heavy polylines, for old controllers. Knows no splines.
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
    if version == Version::R12 && curves == Curves::Splines {
        return Err(DxfError::SplinesInR12);
    }
    let mut file = File::new();
    header(&mut file, drawing, version);
    for line_type in [LineType::Center, LineType::Hidden] {
        file.add_line_type(pattern(line_type));
    }
    for layer in &drawing.layers {
        file.add_layer(table_layer(layer));
    }
    for entity in &drawing.entities {
        let layer = drawing.layer_of(entity).ok_or_else(|| DxfError::Layer {
            name: entity.layer.clone(),
        })?;
        let shape = match (&entity.shape, version, curves) {
            (Shape::Contour(outline), Version::R12, _) => {
                let polyline = heavy(&mut file, &outline.arcs(tolerance));
                EntityType::Polyline(polyline)
            }
            (Shape::Contour(outline), _, Curves::Arcs) => {
                EntityType::LwPolyline(light(&outline.arcs(tolerance)))
            }
            (Shape::Contour(outline), _, Curves::Splines) => {
                EntityType::Spline(spline(&outline.cubics(tolerance)))
            }
            (Shape::Polyline(points), Version::R12, _) => {
                EntityType::Polyline(heavy_open(&mut file, points))
            }
            (Shape::Polyline(points), _, _) => EntityType::LwPolyline(entities::LwPolyline {
                vertices: points.iter().map(|p| vertex(p, 0.0)).collect(),
                ..Default::default()
            }),
            (other, _, _) => simple(other),
        };
        let mut entry = entities::Entity::new(shape);
        entry.common.layer.clone_from(&layer.name);
        // Hundredths of a millimetre.
        entry.common.lineweight_enum_value = weight(layer.line_width);
        file.add_entity(entry);
    }
    let mut bytes = Vec::new();
    file.save(&mut bytes)?;
    Ok(bytes)
}

fn header(file: &mut File, drawing: &Drawing, version: Version) {
    file.header.version = match version {
        Version::R2010 => AcadVersion::R2010,
        Version::R12 => AcadVersion::R12,
    };
    file.header.default_drawing_units = Units::Millimeters;
    file.header.line_type_scale = 1.0;
    let bounds = drawing.bounds();
    if bounds.diagonal().is_finite() {
        file.header.minimum_drawing_extents = position(&bounds.min);
        file.header.maximum_drawing_extents = position(&bounds.max);
    }
    // The library stamps the time and random identifiers; a file must not change from run to run.
    let noon = NaiveDate::from_ymd_opt(2000, 1, 1).and_then(|d| d.and_hms_opt(12, 0, 0));
    if let Some(date) = noon.and_then(|noon| Local.from_local_datetime(&noon).earliest()) {
        file.header.creation_date = date;
        file.header.update_date = date;
    }
    if let Some(date) = noon.map(|noon| noon.and_utc()) {
        file.header.creation_date_universal = date;
        file.header.update_date_universal = date;
    }
    file.header.fingerprint_guid = uuid::Uuid::nil();
    file.header.version_guid = uuid::Uuid::nil();
}

fn pattern(line_type: LineType) -> tables::LineType {
    let lengths = line_type.pattern();
    tables::LineType {
        name: name(line_type).to_owned(),
        description: match line_type {
            LineType::Center => "Center ____ . ____ . ____",
            LineType::Hidden => "Hidden __ __ __ __ __",
            LineType::Continuous => "Solid line",
        }
        .to_owned(),
        element_count: lengths.len() as i32,
        total_pattern_length: lengths.iter().map(|d| d.abs()).sum(),
        dash_dot_space_lengths: lengths.to_vec(),
        complex_line_type_element_types: vec![0; lengths.len()],
        ..Default::default()
    }
}

fn name(line_type: LineType) -> &'static str {
    match line_type {
        LineType::Continuous => "CONTINUOUS",
        LineType::Center => "CENTER",
        LineType::Hidden => "HIDDEN",
    }
}

fn table_layer(layer: &Layer) -> tables::Layer {
    tables::Layer {
        name: layer.name.clone(),
        color: dxf::Color::from_index(match layer.color {
            Color::Red => 1,
            Color::Green => 3,
            Color::Cyan => 4,
            Color::Blue => 5,
            Color::Magenta => 6,
            Color::Foreground => 7,
            Color::Gray => 8,
        }),
        line_type_name: name(layer.line_type).to_owned(),
        is_layer_plotted: true,
        is_layer_on: true,
        ..Default::default()
    }
}

/// The line weight nearest to a width, among those the format has, in hundredths of a millimetre.
fn weight(width: f64) -> i16 {
    const WEIGHTS: [i16; 24] = [
        0, 5, 9, 13, 15, 18, 20, 25, 30, 35, 40, 50, 53, 60, 70, 80, 90, 100, 106, 120, 140, 158,
        200, 211,
    ];
    let wanted = 100.0 * width;
    let mut best = WEIGHTS[0];
    for candidate in WEIGHTS {
        if (f64::from(candidate) - wanted).abs() < (f64::from(best) - wanted).abs() {
            best = candidate;
        }
    }
    best
}

fn position(point: &Point) -> Position {
    Position::new(point.x, point.y, 0.0)
}

fn bulge(segment: &Segment) -> f64 {
    match segment {
        Segment::Arc(arc) => arc.bulge,
        _ => 0.0,
    }
}

fn vertex(point: &Point, bulge: f64) -> LwPolylineVertex {
    LwPolylineVertex {
        x: point.x,
        y: point.y,
        bulge,
        ..Default::default()
    }
}

fn light(arcs: &Outline) -> entities::LwPolyline {
    let mut polyline = entities::LwPolyline {
        vertices: arcs
            .segments()
            .iter()
            .map(|s| vertex(&s.start(), bulge(s)))
            .collect(),
        ..Default::default()
    };
    polyline.set_is_closed(true);
    polyline
}

fn heavy(file: &mut File, arcs: &Outline) -> entities::Polyline {
    let mut polyline = entities::Polyline::default();
    polyline.set_is_closed(true);
    for segment in arcs.segments() {
        let vertex = entities::Vertex {
            location: position(&segment.start()),
            bulge: bulge(segment),
            ..Default::default()
        };
        polyline.add_vertex(file, vertex);
    }
    polyline
}

fn heavy_open(file: &mut File, points: &[Point]) -> entities::Polyline {
    let mut polyline = entities::Polyline::default();
    for point in points {
        polyline.add_vertex(file, entities::Vertex::new(position(point)));
    }
    polyline
}

/// One cubic spline through Bézier pieces: every inner knot three times.
fn spline(cubics: &[[Point; 4]]) -> entities::Spline {
    let count = cubics.len();
    let mut control_points = Vec::with_capacity(3 * count + 1);
    let mut knots = vec![0.0];
    for (k, cubic) in cubics.iter().enumerate() {
        control_points.extend(cubic[..3].iter().map(position));
        knots.extend([k as f64; 3]);
    }
    control_points.extend(cubics.last().map(|cubic| position(&cubic[3])));
    knots.extend([count as f64; 4]);
    let mut spline = entities::Spline {
        degree_of_curve: 3,
        knot_values: knots,
        control_points,
        ..Default::default()
    };
    spline.set_is_closed(true);
    spline.set_is_planar(true);
    spline
}

fn simple(shape: &Shape) -> EntityType {
    match shape {
        Shape::Line(start, end) => {
            EntityType::Line(entities::Line::new(position(start), position(end)))
        }
        Shape::Circle { center, radius } => {
            EntityType::Circle(entities::Circle::new(position(center), *radius))
        }
        Shape::Arc(arc) => EntityType::Arc(circle_arc(arc)),
        Shape::Mark(point) => EntityType::ModelPoint(entities::ModelPoint::new(position(point))),
        Shape::Text(text) => EntityType::Text(line_of_text(text)),
        // Contours and polylines are written by their caller, which knows the version.
        Shape::Contour(_) | Shape::Polyline(_) => EntityType::LwPolyline(Default::default()),
    }
}

/// DXF arcs run counter-clockwise, from angle to angle in degrees.
fn circle_arc(arc: &Arc) -> entities::Arc {
    let center = arc.center();
    let angle = |p: &Point| {
        (p.y - center.y)
            .atan2(p.x - center.x)
            .to_degrees()
            .rem_euclid(360.0)
    };
    let (start, end) = if arc.bulge > 0.0 {
        (&arc.start, &arc.end)
    } else {
        (&arc.end, &arc.start)
    };
    entities::Arc::new(position(&center), arc.radius(), angle(start), angle(end))
}

fn line_of_text(text: &Text) -> entities::Text {
    entities::Text {
        location: position(&text.at),
        second_alignment_point: position(&text.at),
        text_height: text.height,
        value: text.words.clone(),
        horizontal_text_justification: match text.anchor {
            Anchor::Left => HorizontalTextJustification::Left,
            Anchor::Middle => HorizontalTextJustification::Center,
            Anchor::Right => HorizontalTextJustification::Right,
        },
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
            Shape::Text(Text {
                at: p(0.0, -15.0),
                height: 3.5,
                words: "z = 23".into(),
                anchor: Anchor::Middle,
            }),
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
        for (version, curves) in [
            (Version::R2010, Curves::Arcs),
            (Version::R2010, Curves::Splines),
            (Version::R12, Curves::Arcs),
        ] {
            let first = write(&sample(), version, curves, tolerance()).expect("written");
            std::thread::sleep(std::time::Duration::from_millis(1100));
            let second = write(&sample(), version, curves, tolerance()).expect("written");
            assert!(first == second, "{version:?} {curves:?}");
        }
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
