//! Sections of the shaft: its journal with the keyway, and the groove.

use crate::sheet::{fit, geometrical::Frame, number};
use crate::{
    drawing::{Anchor, Shape},
    sheet::{Draft, Pen, Scale},
};
use centrode_geometry::{Arc, Outline, Point, Segment, Tolerance, Vector};
use centrode_mechanism::gear::design::Keyway;
use centrode_mechanism::shaft::SpiralShaft;
use std::f64::consts::PI;

/// Longest side of a section on paper, mm.
const ROOM: f64 = 45.0;

/// Section A-A across the near journal, seen towards the near end: what faces the viewer of the side view lies to
/// the left.
pub(super) fn journal(shaft: &SpiralShaft, tolerance: Tolerance) -> Draft {
    let body = shaft.body();
    let scale = Scale::largest(body.journal_diameter, ROOM);
    let k = scale.factor();
    let radius = 0.5 * k * body.journal_diameter;
    let mut draft = Draft::default().at_scale(k);
    let p = Point::new;
    let whole = Outline::circle(Point::origin(), radius);
    let contour = match body.keyway {
        None => whole,
        Some(key) => slotted(radius, key, k).unwrap_or(whole),
    };
    draft.hatch(std::slice::from_ref(&contour), tolerance);
    draft.draw(Pen::Outline, Shape::Contour(contour));
    let reach = radius + 3.0;
    draft.line(Pen::Axis, p(-reach, 0.0), p(reach, 0.0));
    draft.line(Pen::Axis, p(0.0, -reach), p(0.0, reach));
    if let Some(key) = body.keyway {
        let (half, foot) = (0.5 * k * key.width, radius - k * key.depth);
        let below = p(0.0, -reach - 6.0);
        let rest = fit::shaft_depth(body.journal_diameter, key);
        draft.dimension([p(-foot, -half), p(radius, 0.0)], Vector::x(), below, &rest);
        let edge = (radius * radius - half * half).max(0.0).sqrt();
        let beside = p(-reach - 5.0, 0.0);
        let width = fit::keyway(key.width, &body.keyway_fit);
        draft.dimension(
            [p(-edge, -half), p(-edge, half)],
            Vector::y(),
            beside,
            &width,
        );
    }
    let tip = p(0.6 * radius, 0.8 * radius);
    let elbow = p(0.8 * reach, reach + 3.0);
    draft.leader(
        tip,
        elbow,
        &[
            fit::bore(body.journal_diameter, &body.journal_fit),
            Frame::datum('A').line(),
            "both journals".to_owned(),
        ],
    );
    title(&mut draft, &format!("A-A ({scale})"));
    draft
}

/// A circle with a slot on the x axis, open to the left; `None` where the slot is wider than the circle.
fn slotted(radius: f64, key: Keyway, k: f64) -> Option<Outline> {
    let (half, foot) = (0.5 * k * key.width, radius - k * key.depth);
    let edge = (half / radius).asin();
    let p = Point::new;
    let x = radius * edge.cos();
    let segments = vec![
        Segment::Arc(Arc {
            start: p(-x, -half),
            end: p(radius, 0.0),
            bulge: (0.25 * (PI - edge)).tan(),
        }),
        Segment::Arc(Arc {
            start: p(radius, 0.0),
            end: p(-x, half),
            bulge: (0.25 * (PI - edge)).tan(),
        }),
        Segment::Line(p(-x, half), p(-foot, half)),
        Segment::Line(p(-foot, half), p(-foot, -half)),
        Segment::Line(p(-foot, -half), p(-x, -half)),
    ];
    Outline::new(segments).ok()
}

/// Section B across the groove, enlarged.
pub(super) fn groove(shaft: &SpiralShaft, tolerance: Tolerance) -> Draft {
    let (groove, fillet) = (shaft.groove(), shaft.body().fillet);
    let scale = Scale::largest(2.0 * groove.width(), 1.4 * ROOM);
    let k = scale.factor();
    let (half, depth, f) = (0.5 * k * groove.width(), k * groove.depth(), k * fillet);
    let (wide, deep) = (2.0 * half, 1.8 * depth);
    let p = Point::new;
    let around = [
        p(-half, 0.0),
        p(-wide, 0.0),
        p(-wide, -deep),
        p(wide, -deep),
        p(wide, 0.0),
        p(half, 0.0),
        p(half, f - depth),
    ];
    let mut segments: Vec<Segment> = around
        .windows(2)
        .map(|pair| Segment::Line(pair[0], pair[1]))
        .collect();
    let inner = half - f;
    let floor = Segment::Line(p(inner, -depth), p(-inner, -depth));
    let wall = Segment::Line(p(-half, f - depth), p(-half, 0.0));
    if f > 0.0 {
        let round = |start: Point, end: Point| {
            let bulge = -(0.125 * PI).tan();
            Segment::Arc(Arc { start, end, bulge })
        };
        segments.extend([
            round(p(half, f - depth), p(inner, -depth)),
            floor,
            round(p(-inner, -depth), p(-half, f - depth)),
            wall,
        ]);
    } else {
        segments.extend([floor, wall]);
    }
    let mut draft = Draft::default().at_scale(k);
    if let Ok(contour) = Outline::new(segments) {
        draft.hatch(std::slice::from_ref(&contour), tolerance);
        for segment in &contour.segments()[3..] {
            edge(&mut draft, Pen::Outline, segment);
        }
        edge(&mut draft, Pen::Outline, &contour.segments()[0]);
        for segment in &contour.segments()[1..3] {
            edge(&mut draft, Pen::Thin, segment);
        }
    }
    draft.line(Pen::Axis, p(0.0, -deep - 2.0), p(0.0, 4.0));
    let width = fit::keyway(groove.width(), &shaft.slider().groove_fit);
    draft.dimension(
        [p(-half, 0.0), p(half, 0.0)],
        Vector::x(),
        p(0.0, 8.0),
        &width,
    );
    let words = number(groove.depth(), 3);
    let beside = p(wide + 8.0, 0.0);
    draft.dimension(
        [p(inner, -depth), p(wide, 0.0)],
        Vector::y(),
        beside,
        &words,
    );
    if f > 0.0 {
        let tip = p(
            -half + (1.0 - 0.5_f64.sqrt()) * f,
            -depth + (1.0 - 0.5_f64.sqrt()) * f,
        );
        let elbow = p(-wide - 4.0, 8.0);
        draft.leader(tip, elbow, &[format!("R{}", number(fillet, 3))]);
    }
    title(&mut draft, &format!("groove, across ({scale})"));
    draft
}

fn edge(draft: &mut Draft, pen: Pen, segment: &Segment) {
    match segment {
        Segment::Line(a, b) => draft.line(pen, *a, *b),
        Segment::Arc(arc) => draft.draw(pen, Shape::Arc(*arc)),
        Segment::Poly(_) => {}
    }
}

fn title(draft: &mut Draft, words: &str) {
    let bounds = draft.bounds();
    let at = Point::new(0.5 * (bounds.min.x + bounds.max.x), bounds.max.y + 5.0);
    draft.text(at, 5.0, words, Anchor::Middle);
}
