//! Sections of the shaft: its journal with the keyway, and the groove.

use super::SECTION;
use crate::fit;
use crate::turned::across;
use centrode_formats::sheet::geometrical::{Frame, NoteLine};
use centrode_formats::sheet::number;
use centrode_formats::{
    drawing::{Anchor, EntityShape},
    sheet::{Draft, Pen, Scale},
};
use centrode_geometry::{Arc, Outline, Point, Segment, Tolerance, Vector};
use centrode_groove::SpiralShaft;
use std::f64::consts::PI;

/// Longest side of a section on paper, mm.
const ROOM: f64 = 45.0;

/// Section across the near journal, seen towards the near end: the side that faces the viewer in the side view is on the left.
pub(super) fn journal(shaft: &SpiralShaft, tolerance: Tolerance) -> Draft {
    let body = shaft.body();
    let words = [
        NoteLine::from(fit::bore(body.journal_diameter, &body.journal_fit)),
        Frame::datum('A').into(),
        "both journals".to_owned().into(),
    ];
    let (size, key, class) = (body.journal_diameter, body.keyway, &body.keyway_fit);
    across(size, key, class, true, SECTION, &words, tolerance)
}

/// Section across the groove, enlarged.
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
        Segment::Arc(arc) => draft.draw(pen, EntityShape::Arc(*arc)),
        Segment::Poly(_) => {}
    }
}

fn title(draft: &mut Draft, words: &str) {
    let bounds = draft.bounds();
    let at = Point::new(0.5 * (bounds.min.x + bounds.max.x), bounds.max.y + 5.0);
    draft.text(at, 5.0, words, Anchor::Middle);
}
