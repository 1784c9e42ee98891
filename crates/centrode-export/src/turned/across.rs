//! Section across a shaft, and the plane that it is cut in.

use std::f64::consts::PI;

use centrode_formats::drawing::{Anchor, EntityShape};
use centrode_formats::sheet::geometrical::NoteLine;
use centrode_formats::sheet::{Draft, Pen, Scale};
use centrode_geometry::{Arc, Bounds, Outline, Point, Segment, Tolerance, Vector};
use centrode_kinematics::machine::Keyway;

use crate::{fit, grade};

/// Longest side of a section on paper, mm.
const ROOM: f64 = 45.0;

/// Section across a shaft with its keyway, seen towards the left end: the keyway, which faces the viewer in the side view, is on
/// the left. If the shaft has a datum A, the keyway has a symmetry tolerance to it.
pub(crate) fn across(
    diameter: f64,
    keyway: Option<Keyway>,
    class: &str,
    has_datum: bool,
    letter: char,
    words: &[NoteLine],
    tolerance: Tolerance,
) -> Draft {
    let scale = Scale::largest(diameter, ROOM);
    let k = scale.factor();
    let radius = 0.5 * k * diameter;
    let mut draft = Draft::default().at_scale(k);
    let p = Point::new;
    let whole = Outline::circle(Point::origin(), radius);
    let contour = match keyway {
        None => whole,
        Some(key) => slotted(radius, key, k).unwrap_or(whole),
    };
    draft.hatch(std::slice::from_ref(&contour), tolerance);
    draft.draw(Pen::Outline, EntityShape::Contour(contour));
    let reach = radius + 3.0;
    draft.line(Pen::Axis, p(-reach, 0.0), p(reach, 0.0));
    draft.line(Pen::Axis, p(0.0, -reach), p(0.0, reach));
    if let Some(key) = keyway {
        let (half, foot) = (0.5 * k * key.width, radius - k * key.depth);
        let below = p(0.0, -reach - 6.0);
        let rest = fit::shaft_depth(diameter, key);
        draft.dimension([p(-foot, -half), p(radius, 0.0)], Vector::x(), below, &rest);
        let edge = (radius * radius - half * half).max(0.0).sqrt();
        let beside = p(-reach - 5.0, 0.0);
        let width = fit::keyway(key.width, class);
        draft.dimension(
            [p(-edge, -half), p(-edge, half)],
            Vector::y(),
            beside,
            &width,
        );
    }
    let tip = p(0.6 * radius, 0.8 * radius);
    let elbow = p(0.8 * reach, reach + 3.0);
    let width = keyway.map_or(0.0, |key| key.width);
    let symmetry = grade::symmetry(width, "A").filter(|_| has_datum);
    let symmetry = symmetry.map(|frame| [NoteLine::from("keyway".to_owned()), frame.into()]);
    let lines: Vec<NoteLine> = words
        .iter()
        .cloned()
        .chain(symmetry.into_iter().flatten())
        .collect();
    draft.note(tip, elbow, &lines);
    let bounds = draft.bounds();
    let at = p(0.5 * (bounds.min.x + bounds.max.x), bounds.max.y + 5.0);
    draft.text(
        at,
        5.0,
        &format!("{letter}-{letter} ({scale})"),
        Anchor::Middle,
    );
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

/// Height of the letters of a cutting plane, and the distance of their middle from the tip of the arrow, mm.
const LETTER: f64 = 3.5;
const BEFORE: f64 = 3.2;
/// Length of the arrows of a cutting plane, and of the lines at its ends, mm.
const ARROW: f64 = 7.0;
const OUT: f64 = 6.0;

/// Positions of a section along its keyway, as fractions of the keyway's length, in the order tried.
const PLANES: [f64; 7] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];

/// The ends of the plane of a section across a shaft, seen towards the left end: in the middle of a keyway or near it, where its
/// letters touch nothing.
pub(crate) fn cutting_plane(draft: &mut Draft, [from, to]: [f64; 2], height: f64, letter: char) {
    let places = PLANES.map(|share| from + share * (to - from));
    let free = places.into_iter().find(|x| {
        let mut letters = plane_letters(*x, height).into_iter();
        letters.all(|at| !draft.touches(at))
    });
    let x = free.unwrap_or(places[0]);
    for side in [-1.0, 1.0] {
        let inner = Point::new(x, side * height);
        let outer = Point::new(x, side * (height + OUT));
        draft.line(Pen::Outline, inner, outer);
        let tip = outer - Vector::new(ARROW, 0.0);
        draft.line(Pen::Dimension, outer, tip);
        draft.arrow(tip, -Vector::x());
        let at = tip - Vector::new(BEFORE, 0.5 * LETTER);
        draft.text(at, LETTER, &letter.to_string(), Anchor::Middle);
    }
}

/// Bounds of the letters of a cutting plane, with a margin.
fn plane_letters(x: f64, height: f64) -> [Bounds; 2] {
    [-1.0, 1.0].map(|side| {
        let middle = Point::new(x - ARROW - BEFORE, side * (height + OUT));
        let half = Vector::new(0.45, 0.65) * LETTER;
        [middle - half, middle + half].into_iter().collect()
    })
}
