//! DXF of 2010, through the dxf library.

use super::{
    Curves, DxfError, STYLE, STYLE_FONT, angles, bulges, color_index, description, justification,
    line_type_name,
};
use crate::drawing::{Drawing, Layer, LineType, Shape, Text};
use centrode_geometry::{Arc, Outline, Point, Tolerance};
use chrono::{Local, NaiveDate, TimeZone};
use dxf::{
    Drawing as File, LwPolylineVertex, Point as Position,
    entities::{self, EntityType},
    enums::{AcadVersion, DrawingUnits, HorizontalTextJustification, Units},
    tables,
};

/// Alpha 255 with the mark that it is a value of its own.
const OPAQUE: i32 = 0x0200_00FF;

pub(super) fn write(
    drawing: &Drawing,
    curves: Curves,
    tolerance: Tolerance,
) -> Result<Vec<u8>, DxfError> {
    let mut file = File::new();
    header(&mut file, drawing);
    for line_type in super::line_types(drawing, false) {
        file.add_line_type(pattern(line_type));
    }
    if super::has_fitted_text(drawing) {
        file.add_style(tables::Style {
            name: STYLE.to_owned(),
            primary_font_file_name: STYLE_FONT.to_owned(),
            ..Default::default()
        });
    }
    for layer in &drawing.layers {
        file.add_layer(table_layer(layer));
    }
    for entity in &drawing.entities {
        let mut entry = entities::Entity::new(entry(&entity.shape, curves, tolerance));
        entry.common.layer.clone_from(&entity.layer);
        if let Some(layer) = drawing.layer_of(entity) {
            entry.common.lineweight_enum_value = weight(layer.line_width);
        }
        entry.common.transparency = OPAQUE;
        file.add_entity(entry);
    }
    let mut bytes = Vec::new();
    file.save(&mut bytes)?;
    Ok(with_table_handles(&bytes))
}

/// Gives the tables the handles the library leaves out, after the last it has given.
fn with_table_handles(bytes: &[u8]) -> Vec<u8> {
    let text = String::from_utf8_lossy(bytes);
    let lines: Vec<&str> = text.lines().collect();
    let seed = lines
        .iter()
        .position(|line| *line == "$HANDSEED")
        .and_then(|at| {
            Some((
                at + 2,
                u64::from_str_radix(lines.get(at + 2)?.trim(), 16).ok()?,
            ))
        });
    let Some((seed_line, mut handle)) = seed else {
        return bytes.to_vec();
    };
    let tables = lines
        .windows(2)
        .filter(|pair| pair[0].trim() == "0" && pair[1] == "TABLE")
        .count();
    let next = handle + tables as u64;
    let mut out = String::with_capacity(text.len() + 16 * tables);
    let mut at = 0;
    while at < lines.len() {
        let line = if at == seed_line {
            format!("{next:X}")
        } else {
            lines[at].to_owned()
        };
        out.push_str(&line);
        out.push_str("\r\n");
        // 0 TABLE, 2 name: the handle belongs after the name.
        let head = at >= 3
            && lines[at - 3].trim() == "0"
            && lines[at - 2] == "TABLE"
            && lines[at - 1].trim() == "2";
        if head {
            if lines.get(at + 1).is_some_and(|code| code.trim() == "5") {
                at += 2;
            }
            out.push_str(&format!("  5\r\n{handle:X}\r\n"));
            handle += 1;
        }
        at += 1;
    }
    out.into_bytes()
}

fn header(file: &mut File, drawing: &Drawing) {
    file.header.version = AcadVersion::R2010;
    file.header.default_drawing_units = Units::Millimeters;
    file.header.drawing_units = DrawingUnits::Metric;
    file.header.line_type_scale = 1.0;
    let bounds = drawing.bounds();
    if bounds.diagonal().is_finite() {
        file.header.minimum_drawing_extents = position(&bounds.min);
        file.header.maximum_drawing_extents = position(&bounds.max);
        // Some programs take these for the paper; the library's are 12 x 9.
        file.header.minimum_drawing_limits = position(&bounds.min);
        file.header.maximum_drawing_limits = position(&bounds.max);
        file.header.paperspace_minimum_drawing_limits = position(&bounds.min);
        file.header.paperspace_maximum_drawing_limits = position(&bounds.max);
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
        name: line_type_name(line_type).to_owned(),
        description: description(line_type).to_owned(),
        element_count: lengths.len() as i32,
        total_pattern_length: lengths.iter().map(|d| d.abs()).sum(),
        dash_dot_space_lengths: lengths.to_vec(),
        complex_line_type_element_types: vec![0; lengths.len()],
        ..Default::default()
    }
}

fn table_layer(layer: &Layer) -> tables::Layer {
    tables::Layer {
        name: layer.name.clone(),
        color: dxf::Color::from_index(color_index(layer.color)),
        line_type_name: line_type_name(layer.line_type).to_owned(),
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
        vertices: bulges(arcs).map(|(p, bulge)| vertex(&p, bulge)).collect(),
        ..Default::default()
    };
    polyline.set_is_closed(true);
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

fn entry(shape: &Shape, curves: Curves, tolerance: Tolerance) -> EntityType {
    match shape {
        Shape::Contour(outline) => match curves {
            Curves::Arcs => EntityType::LwPolyline(light(&outline.arcs(tolerance))),
            Curves::Splines => EntityType::Spline(spline(&outline.cubics(tolerance))),
        },
        Shape::Polyline(points) => EntityType::LwPolyline(entities::LwPolyline {
            vertices: points.iter().map(|p| vertex(p, 0.0)).collect(),
            ..Default::default()
        }),
        Shape::Line(start, end) => {
            EntityType::Line(entities::Line::new(position(start), position(end)))
        }
        Shape::Circle { center, radius } => {
            EntityType::Circle(entities::Circle::new(position(center), *radius))
        }
        Shape::Arc(arc) => EntityType::Arc(circle_arc(arc)),
        Shape::Triangle([a, b, c]) => EntityType::Solid(entities::Solid::new(
            position(a),
            position(b),
            position(c),
            position(c),
        )),
        Shape::Mark(point) => EntityType::ModelPoint(entities::ModelPoint::new(position(point))),
        Shape::Text(text) => EntityType::Text(line_of_text(text)),
    }
}

fn circle_arc(arc: &Arc) -> entities::Arc {
    let [start, end] = angles(arc);
    entities::Arc::new(position(&arc.center()), arc.radius(), start, end)
}

fn line_of_text(text: &Text) -> entities::Text {
    let (justification, [start, end]) = justification(text);
    entities::Text {
        location: position(&start),
        second_alignment_point: position(&end),
        text_height: text.height,
        value: text.words.clone(),
        rotation: text.rotation.to_degrees(),
        text_style_name: match text.width {
            Some(_) => STYLE.to_owned(),
            None => entities::Text::default().text_style_name,
        },
        horizontal_text_justification: match justification {
            5 => HorizontalTextJustification::Fit,
            1 => HorizontalTextJustification::Center,
            2 => HorizontalTextJustification::Right,
            _ => HorizontalTextJustification::Left,
        },
        ..Default::default()
    }
}
