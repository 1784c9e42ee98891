use crate::cutting::{self, CENTER, HOLE, PROFILE};
use centrode_formats::drawing::{Anchor, Color, Drawing, EntityShape, LineType, Text};
use centrode_geometry::{Arc, Outline, Point, Tolerance};
use centrode_groove::{ShaftError, ShaftSolid, SpiralShaft};
use std::f64::consts::TAU;

/// Height of lettering, mm.
const LETTER: f64 = 3.5;

fn label(drawing: &mut Drawing, at: Point, height: f64, words: String, anchor: Anchor) {
    let text = Text::new(at, height, words, anchor);
    drawing.draw("TEXT", EntityShape::Text(text));
}

/// A rectangle as a contour.
fn rectangle(low: Point, high: Point) -> EntityShape {
    let p = Point::new;
    EntityShape::Contour(Outline::polygon(&[
        low,
        p(high.x, low.y),
        high,
        p(low.x, high.y),
    ]))
}

/// The developed surface of the shaft, to be wrapped around it: along x the arc `R phi`, along y the axis.
///
/// Layers: BLANK the edge, WALL the upper edges of the existing walls, CENTER the centre line,
/// PICK the positions of the slider while a seedling is picked, TEXT. Polylines are within the tolerance.
///
/// # Errors
/// [`ShaftError`] if body and groove do not fit each other.
pub fn developed(shaft: &SpiralShaft, tolerance: Tolerance) -> Result<Drawing, ShaftError> {
    let groove = shaft.groove();
    let around = TAU * groove.radius();
    let [low, high] = ShaftSolid::new(groove, shaft.body())?.ends();
    let mut drawing = Drawing::default()
        .layer("BLANK", Color::Foreground, LineType::Continuous, 0.35)
        .layer("WALL", Color::Foreground, LineType::Continuous, 0.5)
        .layer("CENTER", Color::Red, LineType::Center, 0.18)
        .layer("PICK", Color::Blue, LineType::Continuous, 0.25)
        .layer("TEXT", Color::Foreground, LineType::Continuous, 0.25);
    drawing.draw(
        "BLANK",
        rectangle(Point::new(0.0, low), Point::new(around, high)),
    );
    for edge in shaft.wall_edges(tolerance)? {
        drawing.draw("WALL", EntityShape::Polyline(edge));
    }
    for line in wrapped(&groove.way(0.0, tolerance), around) {
        drawing.draw("CENTER", EntityShape::Polyline(line));
    }
    for pick in shaft.schedule().picks {
        // A whole turn within rounding counts as zero.
        let x = (groove.radius() * pick.theta + 1e-9).rem_euclid(around) - 1e-9;
        drawing.draw("PICK", EntityShape::Mark(Point::new(x, pick.position)));
        let circle = EntityShape::Circle {
            center: Point::new(x, pick.position),
            radius: 0.1 * groove.width(),
        };
        drawing.draw("PICK", circle);
    }
    let words = [
        format!(
            "developed groove of {}: R {} mm, lead {} mm",
            shaft.design().name,
            groove.radius(),
            shaft.law().lead()
        ),
        format!(
            "width {} mm, depth {} mm, {} turns out and back, {} crossings",
            groove.width(),
            groove.depth(),
            groove.traverse().turns(),
            groove.crossings().len()
        ),
        format!("{around:.4} mm round the shaft = 360 deg"),
    ];
    for (i, words) in (1_u32..).zip(words) {
        let at = Point::new(0.0, low - 1.8 * LETTER * f64::from(i));
        label(&mut drawing, at, LETTER, words, Anchor::Left);
    }
    Ok(drawing)
}

/// A path on the unrolled development cut into pieces of one turn each.
fn wrapped(way: &[Point], around: f64) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    for pair in way.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let turn = (from.x / around + 1e-12).floor();
            let seam = (turn + 1.0) * around;
            let crosses = to.x > seam + 1e-9;
            let end = if crosses {
                from + (to - from) * ((seam - from.x) / (to.x - from.x))
            } else {
                to
            };
            let local = |p: Point| Point::new((p.x - turn * around).clamp(0.0, around), p.y);
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&local(from)) => piece.push(local(end)),
                _ => pieces.push(vec![local(from), local(end)]),
            }
            if !crosses {
                break;
            }
            from = end;
        }
    }
    pieces
}

/// The shaft from the side, its axis along x, the angle zero towards the viewer: the outline cut through the
/// axis, the walls' upper edges on the near side, the keyway, and the main dimensions in words.
///
/// # Errors
/// [`ShaftError`] if body and groove do not fit each other.
pub fn side_view(shaft: &SpiralShaft, tolerance: Tolerance) -> Result<Drawing, ShaftError> {
    let (groove, body) = (shaft.groove(), shaft.body());
    let solid = ShaftSolid::new(groove, body)?;
    let ([low, high], [start, end]) = (solid.ends(), solid.whole());
    let (r, j, c) = (groove.radius(), 0.5 * body.journal_diameter, body.chamfer);
    let mut drawing = Drawing::default()
        .layer("PROFILE", Color::Foreground, LineType::Continuous, 0.5)
        .layer("EDGE", Color::Foreground, LineType::Continuous, 0.25)
        .layer("AXES", Color::Red, LineType::Center, 0.18)
        .layer("TEXT", Color::Foreground, LineType::Continuous, 0.25);
    let p = Point::new;
    let edges = shaft.wall_edges(tolerance)?;
    let floor = r - groove.depth();
    // The shoulders' chamfers lie outside the grooved length.
    let half = |angle: f64| {
        let mut half = vec![
            p(start, j - c),
            p(start + c, j),
            p(low - c, j),
            p(low - c, r - c),
            p(low, r),
        ];
        // The contour goes into the groove and out of it alternately.
        let mut before = r;
        for z in passed(&edges, r * angle) {
            let after = if before == r { floor } else { r };
            half.extend([p(z, before), p(z, after)]);
            before = after;
        }
        half.extend([
            p(high, r),
            p(high + c, r - c),
            p(high + c, j),
            p(end - c, j),
            p(end, j - c),
        ]);
        half
    };
    // Seen from the angle zero with the axis to the right, a quarter turn lies below.
    let lower = half(0.25 * TAU);
    let mut contour: Vec<Point> = lower.iter().map(|q| p(q.x, -q.y)).collect();
    contour.extend(half(0.75 * TAU).into_iter().rev());
    contour.dedup();
    drawing.draw("PROFILE", EntityShape::Contour(Outline::polygon(&contour)));
    for at in [low, high].into_iter().chain([start + c, end - c]) {
        let height = if at == low || at == high { r } else { j };
        drawing.draw("EDGE", EntityShape::Line(p(at, -height), p(at, height)));
    }
    for edge in edges {
        // Only the near half of the shaft is drawn, with the angle zero towards the viewer.
        let mut near: Vec<Point> = Vec::new();
        for q in edge {
            let (sin, cos) = (q.x / r).sin_cos();
            if cos >= 0.0 {
                near.push(p(q.y, -r * sin));
            } else if !near.is_empty() {
                drawing.draw("EDGE", EntityShape::Polyline(std::mem::take(&mut near)));
            }
        }
        if near.len() > 1 {
            drawing.draw("EDGE", EntityShape::Polyline(near));
        }
    }
    if let Some(keyway) = body.keyway {
        let (from, to) = (start, start + body.keyway_length);
        let half = 0.5 * keyway.width;
        let straight = to - body.keyway_rounding();
        for y in [-half, half] {
            drawing.draw("EDGE", EntityShape::Line(p(from, y), p(straight, y)));
        }
        let [start, end] = [-half, half].map(|y| p(straight, y));
        drawing.draw("EDGE", EntityShape::Line(p(from, -half), p(from, half)));
        drawing.draw(
            "EDGE",
            match straight < to {
                true => EntityShape::Arc(Arc {
                    start,
                    end,
                    bulge: 1.0,
                }),
                false => EntityShape::Line(start, end),
            },
        );
    }
    drawing.draw(
        "AXES",
        EntityShape::Line(p(start - 5.0, 0.0), p(end + 5.0, 0.0)),
    );
    let words = [
        format!(
            "{}: diameter {} mm, journals {} mm, length {:.3} mm, {}",
            shaft.design().name,
            2.0 * r,
            body.journal_diameter,
            end - start,
            body.material
        ),
        format!(
            "groove {} x {} mm, lead {} mm, {} turns out and back; see the lead table and the development",
            groove.width(),
            groove.depth(),
            shaft.law().lead(),
            groove.traverse().turns()
        ),
        format!(
            "slider positions {:.4} to {:.4} mm; outline: section through the groove at 90 and 270 deg; groove angle 0 faces the viewer",
            groove.traverse().reach().0,
            groove.traverse().reach().1
        ),
    ];
    for (i, words) in (1_u32..).zip(words) {
        let at = p(start, -r - 2.0 - 1.8 * LETTER * f64::from(i));
        label(&mut drawing, at, LETTER, words, Anchor::Left);
    }
    Ok(drawing)
}

/// Axial positions of the walls at the arc `x` around the shaft, ascending.
fn passed(edges: &[Vec<Point>], x: f64) -> Vec<f64> {
    let segments = edges.iter().flat_map(|edge| edge.windows(2));
    let mut places: Vec<f64> = segments
        .filter(|pair| pair[0].x <= x && x < pair[1].x)
        .map(|pair| {
            let share = (x - pair[0].x) / (pair[1].x - pair[0].x);
            pair[0].y + share * (pair[1].y - pair[0].y)
        })
        .collect();
    places.sort_by(f64::total_cmp);
    places
}

/// The slider seen along its pin.
#[must_use]
pub fn slider(shaft: &SpiralShaft) -> Drawing {
    let slider = shaft.slider();
    let mut drawing =
        cutting::drawing().layer("TEXT", Color::Foreground, LineType::Continuous, 0.25);
    let width = slider.width(shaft.groove().width());
    drawing.draw(
        PROFILE,
        EntityShape::Contour(slider.outline(shaft.groove().width())),
    );
    drawing.draw(
        HOLE,
        EntityShape::Circle {
            center: Point::origin(),
            radius: 0.5 * slider.pin_diameter,
        },
    );
    let (x, y) = (0.5 * slider.length + 3.0, 0.5 * width + 3.0);
    let p = Point::new;
    drawing.draw(CENTER, EntityShape::Line(p(-x, 0.0), p(x, 0.0)));
    drawing.draw(CENTER, EntityShape::Line(p(0.0, -y), p(0.0, y)));
    let words = format!(
        "slider {} x {width:.3} x {} mm, bore {} mm",
        slider.length, slider.reach, slider.pin_diameter
    );
    label(&mut drawing, p(-x, -y - 5.0), LETTER, words, Anchor::Left);
    drawing
}
