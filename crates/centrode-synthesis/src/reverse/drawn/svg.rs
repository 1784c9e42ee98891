//! The one closed path of an SVG file.

use std::str::FromStr as _;

use kurbo::{Affine, Arc, BezPath, PathSeg, Point, Shape as _, SvgArc};
use roxmltree::{Document, Node, ParsingOptions};
use svgtypes::{Length, LengthUnit, PathParser, PathSegment, Transform, ViewBox};

use super::DrawingError;
use crate::reverse::path::FARTHEST;

/// Most pieces of a path, and most nodes of a file.
const MAX_PIECES: usize = 10_000;
const MAX_NODES: u32 = 1_000_000;
/// Most attributes of an element. The reader compares each with all before it: 100,000 take 15 s, 1000 some milliseconds.
const MAX_ATTRIBUTES: usize = 1000;
/// Maximum distance of cubics from an arc, as a share of its radius.
const ARC: f64 = 1e-10;
/// Maximum relative difference of the scales by height and width; maximum gap of a closed path, as a share of the drawing's size.
const LOOSE: f64 = 1e-3;
const CLOSED: f64 = 1e-6;
/// Maximum number of characters of data that a message quotes.
const TOLD: usize = 40;

/// Pieces of the path, mm, y up from the lower edge.
pub(super) fn closed_path(text: &str) -> Result<Vec<PathSeg>, DrawingError> {
    let options = ParsingOptions {
        // Inkscape writes a document type.
        allow_dtd: true,
        nodes_limit: MAX_NODES,
        ..ParsingOptions::default()
    };
    few_attributes(text)?;
    let document = Document::parse_with_options(text, options);
    let document = document.map_err(|error| DrawingError::Xml {
        why: error.to_string(),
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let root = root.tag_name().name().to_owned();
        return Err(DrawingError::NotSvg { root });
    }
    let page = page(root)?;
    followed(root)?;
    let is_path = |node: &Node<'_, '_>| node.tag_name().name() == "path" && is_shown(*node);
    let paths: Vec<Node<'_, '_>> = root.descendants().filter(is_path).collect();
    let [path] = &paths[..] else {
        let count = paths.len();
        return Err(DrawingError::Paths { count });
    };
    let mut placed = page;
    let outer: Vec<Node<'_, '_>> = path.ancestors().collect();
    for node in outer.iter().rev() {
        if let Some(data) = node.attribute("transform") {
            let read = Transform::from_str(data);
            let t = read.map_err(|error| refused("transform", data, &error))?;
            placed *= Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]);
        }
    }
    let data = path.attribute("d").unwrap_or_default();
    let drawn = placed * line(data)?;
    let count = drawn.elements().len();
    if count > MAX_PIECES {
        let limit = MAX_PIECES;
        return Err(DrawingError::TooMany { count, limit });
    }
    let segments: Vec<PathSeg> = drawn.segments().filter(|s| !is_point(s)).collect();
    closed(segments, &drawn)
}

/// Refuses elements with more than [`MAX_ATTRIBUTES`], before the file is read as XML.
fn few_attributes(text: &str) -> Result<(), DrawingError> {
    // No attribute holds a raw `<`, and every one has a quote after its `=`.
    let attributes = |element: &str| {
        let values = element.split('=').skip(1);
        values
            .filter(|rest| rest.trim_start().starts_with(['"', '\'']))
            .count()
    };
    match text.split('<').map(attributes).max() {
        Some(count) if count > MAX_ATTRIBUTES => Err(DrawingError::Xml {
            why: format!("an element has {count} attributes; at most {MAX_ATTRIBUTES} are read"),
        }),
        _ => Ok(()),
    }
}

/// The pieces, if the path ends where it begins.
fn closed(mut segments: Vec<PathSeg>, drawn: &BezPath) -> Result<Vec<PathSeg>, DrawingError> {
    use kurbo::ParamCurve as _;
    for end in segments
        .iter()
        .flat_map(|s| [s.to_cubic().p1, s.to_cubic().p2, s.end()])
    {
        let (x, y) = (end.x, end.y);
        if !(x.abs() <= FARTHEST && y.abs() <= FARTHEST) {
            let limit = FARTHEST;
            return Err(DrawingError::TooFar { x, y, limit });
        }
    }
    let (Some(first), Some(last)) = (segments.first(), segments.last()) else {
        return Err(DrawingError::Empty);
    };
    let (from, to) = (first.start(), last.end());
    let bounds = drawn.bounding_box();
    let gap = (to - from).hypot();
    if gap > CLOSED * bounds.width().max(bounds.height()) {
        let [from, to] = [from, to].map(|p| [p.x, p.y]);
        return Err(DrawingError::Open { from, to });
    }
    if gap > 0.0 {
        segments.push(PathSeg::Line(kurbo::Line::new(to, from)));
    }
    Ok(segments)
}

fn is_point(segment: &PathSeg) -> bool {
    let cubic = segment.to_cubic();
    [cubic.p1, cubic.p2, cubic.p3]
        .iter()
        .all(|p| *p == cubic.p0)
}

/// Whether a node is drawn at its position, and neither only defined nor hidden.
fn is_shown(node: Node<'_, '_>) -> bool {
    let defined = ["defs", "clipPath", "marker", "mask", "pattern", "symbol"];
    !node.ancestors().any(|outer| {
        let display = outer.attribute("display").or(style(outer, "display"));
        defined.contains(&outer.tag_name().name()) || display == Some("none")
    })
}

/// Value of a key in a node's style.
fn style<'a>(node: Node<'a, '_>, key: &str) -> Option<&'a str> {
    let mut entries = node.attribute("style")?.split(';');
    entries.find_map(|entry| {
        let (name, value) = entry.split_once(':')?;
        (name.trim() == key).then_some(value.trim())
    })
}

/// Refuses features that position shown elements and are not supported.
fn followed(root: Node<'_, '_>) -> Result<(), DrawingError> {
    let shown = root.descendants().filter(|node| is_shown(*node));
    for node in shown {
        let name = node.tag_name().name();
        let (what, remedy) = if name == "use" {
            ("<use>", "change it to a separate path (\"unlink clone\")")
        } else if name == "svg" && node != root {
            ("<svg> within <svg>", "ungroup the inner drawing")
        } else if style(node, "transform").is_some_and(|value| value != "none") {
            ("a transform in a style", "write it as transform=\"...\"")
        } else {
            continue;
        };
        return Err(DrawingError::NotFollowed { what, remedy });
    }
    Ok(())
}

/// From units of the drawing, y down, to mm, y up.
fn page(root: Node<'_, '_>) -> Result<Affine, DrawingError> {
    let wrong = |why: String| DrawingError::Size { why };
    let key = |name: &str| {
        let value = root.attribute(name);
        value.ok_or_else(|| wrong(format!("it has no {name}")))
    };
    let stated = key("viewBox")?;
    let view = ViewBox::from_str(stated);
    let view = view.map_err(|error| wrong(format!("viewBox is {:?}, {error}", cut(stated))))?;
    let length = |name: &str| {
        let stated = key(name)?;
        let wrong = || wrong(format!("{name} is {:?}", cut(stated)));
        let length = Length::from_str(stated).map_err(|_| wrong())?;
        let unit = match length.unit {
            LengthUnit::Mm => 1.0,
            LengthUnit::Cm => 10.0,
            LengthUnit::In => 25.4,
            LengthUnit::Pt => 25.4 / 72.0,
            LengthUnit::Pc => 25.4 / 6.0,
            LengthUnit::Px => 25.4 / 96.0,
            LengthUnit::None | LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => {
                return Err(wrong());
            }
        };
        Ok(length.number * unit)
    };
    let scale = length("width")? / view.w;
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(wrong(
            "width divided by the width of viewBox is not a valid scale".into(),
        ));
    }
    if root.has_attribute("height") {
        let other = length("height")? / view.h;
        let agrees = (other / scale - 1.0).abs() <= LOOSE;
        if !agrees {
            return Err(wrong(format!(
                "one unit is {scale} mm by width, but {other} mm by height"
            )));
        }
    }
    Ok(Affine::new([
        scale,
        0.0,
        0.0,
        -scale,
        -scale * view.x,
        scale * (view.y + view.h),
    ]))
}

/// The curve of a path's data, in the units of the path.
fn line(data: &str) -> Result<BezPath, DrawingError> {
    let mut path = BezPath::new();
    let mut lines = 0;
    // End of the last piece, start of the line, and the handle from which a smooth piece continues.
    let (mut at, mut start) = (Point::ZERO, Point::ZERO);
    let (mut cubic, mut quadratic) = (None, None);
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|error| refused("d", data, &error))?;
        let origin = if segment.is_abs() { Point::ZERO } else { at };
        let place = |x: f64, y: f64| origin + kurbo::Vec2::new(x, y);
        let beyond = |handle: Option<Point>| handle.map_or(at, |h| at + (at - h));
        let (last_cubic, last_quadratic) = (cubic.take(), quadratic.take());
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                lines += 1;
                at = place(x, y);
                start = at;
                path.move_to(at);
            }
            PathSegment::LineTo { x, y, .. } => {
                at = place(x, y);
                path.line_to(at);
            }
            PathSegment::HorizontalLineTo { x, .. } => {
                at.x = origin.x + x;
                path.line_to(at);
            }
            PathSegment::VerticalLineTo { y, .. } => {
                at.y = origin.y + y;
                path.line_to(at);
            }
            PathSegment::CurveTo {
                x1,
                y1,
                x2,
                y2,
                x,
                y,
                ..
            } => {
                let (one, two) = (place(x1, y1), place(x2, y2));
                at = place(x, y);
                cubic = Some(two);
                path.curve_to(one, two, at);
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                let (one, two) = (beyond(last_cubic), place(x2, y2));
                at = place(x, y);
                cubic = Some(two);
                path.curve_to(one, two, at);
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                let handle = place(x1, y1);
                at = place(x, y);
                quadratic = Some(handle);
                path.quad_to(handle, at);
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let handle = beyond(last_quadratic);
                at = place(x, y);
                quadratic = Some(handle);
                path.quad_to(handle, at);
            }
            PathSegment::EllipticalArc {
                rx,
                ry,
                x_axis_rotation,
                large_arc,
                sweep,
                x,
                y,
                ..
            } => {
                let from = at;
                at = place(x, y);
                let arc = Arc::from_svg_arc(&SvgArc {
                    from,
                    to: at,
                    radii: kurbo::Vec2::new(rx, ry),
                    x_rotation: x_axis_rotation.to_radians(),
                    large_arc,
                    sweep,
                });
                match arc {
                    Some(arc) => path.extend(arc.append_iter(ARC * arc.radii.hypot())),
                    None => path.line_to(at),
                }
            }
            PathSegment::ClosePath { .. } => {
                at = start;
                path.close_path();
            }
        }
        if path.elements().len() > MAX_PIECES {
            let (count, limit) = (path.elements().len(), MAX_PIECES);
            return Err(DrawingError::TooMany { count, limit });
        }
    }
    if lines > 1 {
        return Err(DrawingError::Several { count: lines });
    }
    Ok(path)
}

fn refused(key: &'static str, data: &str, why: &svgtypes::Error) -> DrawingError {
    DrawingError::Data {
        key,
        data: cut(data),
        why: why.to_string(),
    }
}

fn cut(data: &str) -> String {
    data.chars().take(TOLD).collect()
}
