//! The face of a gear, and the section through its axis.

use super::part::{Extremes, SheetGear, degrees};
use crate::gear_pair::accuracy::tooth_runout;
use crate::{fit, grade};
use centrode_formats::{
    drawing::{Anchor, EntityShape},
    sheet::{
        Draft, Pen, Scale,
        geometrical::{Frame, NoteLine},
        lettering, number,
    },
};
use centrode_geometry::{Bounds, Outline, Point, Vector};
use centrode_spec::Projection;
use nalgebra::Isometry2;

/// Distance of the numbers of the spaces from the teeth, mm.
const RING: f64 = 3.4;
/// Height of the numbers of the spaces, mm.
const NUMBERS: f64 = 2.5;
/// Radius of a timing mark on a sheet, mm.
const MARK: f64 = 0.6;
/// Gap between two views, mm.
const APART: f64 = 16.0;

/// Face view and section C-C, aligned on the axis.
pub(super) fn views(
    part: &SheetGear<'_>,
    scale: Scale,
    letters: f64,
    projection: Projection,
) -> Draft {
    let mut draft = face(part, scale, letters);
    let whole = draft.bounds();
    let section = section(part, scale);
    let own = section.bounds();
    // The section is seen from above: below the face in first angle, above it in third.
    let y = match projection {
        Projection::FirstAngle => whole.min.y - APART - own.max.y,
        Projection::ThirdAngle => whole.max.y + APART - own.min.y,
    };
    draft.add(&section, Vector::new(0.0, y));
    draft
}

fn face(part: &SheetGear<'_>, scale: Scale, letters: f64) -> Draft {
    let k = scale.factor();
    let mut draft = Draft::lettered(letters).at_scale(k);
    draft.draw(Pen::Outline, EntityShape::Contour(part.outline.scaled(k)));
    draft.draw(Pen::Axis, EntityShape::Contour(part.pitch_curve.scaled(k)));
    if let Some(bore) = &part.bore {
        draft.draw(Pen::Outline, EntityShape::Contour(bore.scaled(k)));
    }
    let Bounds { min, max } = part.bounds();
    let (min, max) = (min * k, max * k);
    let p = Point::new;
    draft.line(Pen::Axis, p(min.x - 2.0, 0.0), p(max.x + 2.0, 0.0));
    draft.line(Pen::Axis, p(0.0, min.y - 2.0), p(0.0, max.y + 2.0));
    let ring = RING + NUMBERS + 2.0;
    let left = p(min.x - ring - 1.0, 0.0);
    let right = p(max.x + ring + 1.0, 0.0);
    cutting_plane(&mut draft, left, right);
    let margin = Vector::new(ring + 9.0, 0.0);
    let around = Bounds {
        min: p(min.x, min.y) - margin,
        max: p(max.x, max.y) + margin,
    };
    let mark = part.middle(0, 0.0);
    draft.draw(
        Pen::Outline,
        EntityShape::Circle {
            center: (mark.point - mark.normal * (2.0 * part.pair.module())) * k,
            radius: MARK,
        },
    );
    draft.call_out(around, [-9.0, 3.0], &notes(part, k));
    numbers(part, k, &mut draft);
    draft
}

/// The ends of the cutting plane, with arrows in the viewing direction.
fn cutting_plane(draft: &mut Draft, left: Point, right: Point) {
    for (at, out) in [(left, -1.0), (right, 1.0)] {
        let end = at + Vector::new(7.0 * out, 0.0);
        draft.line(Pen::Outline, at, end);
        let tip = end - Vector::new(1.0 * out, 7.0);
        draft.line(Pen::Dimension, tip + Vector::new(0.0, 7.0), tip);
        draft.arrow(tip, -Vector::y());
        let letter = tip + Vector::new(-3.2 * out, 1.2);
        draft.text(letter, 3.5, "C", Anchor::Middle);
    }
}

fn notes(part: &SheetGear<'_>, k: f64) -> Vec<(Point, Vec<NoteLine>)> {
    let mut notes = Vec::new();
    let radius = |p: Point, what: &str| {
        let size = format!("R{:.3} at {:.2}°", p.coords.norm(), degrees(p));
        (p * k, vec![size.into(), what.to_owned().into()])
    };
    for (kind, extremes) in [("tip", part.tips()), ("root", part.roots())] {
        let Some(Extremes { maximum, minimum }) = extremes else {
            continue;
        };
        if maximum.coords.norm() - minimum.coords.norm() < 5e-4 {
            let size = format!("Ø{:.3}", 2.0 * maximum.coords.norm());
            notes.push((
                maximum * k,
                vec![size.into(), format!("{kind} circle").into()],
            ));
        } else {
            let [high, low] = match kind {
                "tip" => ["highest tip", "lowest tip"],
                _ => ["highest root", "lowest root"],
            };
            notes.push(radius(maximum, high));
            notes.push(radius(minimum, low));
        }
    }
    let body = part.gear.body();
    if body.bore > 0.0 {
        let at = Vector::new(-0.6, 0.8) * (0.5 * body.bore * k);
        let words = if body.keyway.is_some() {
            vec!["detail D".to_owned().into()]
        } else {
            let size = fit::bore(body.bore, &body.bore_fit);
            vec![size.into(), Frame::datum('A').into()]
        };
        notes.push((Point::from(at), words));
    }
    let start = part.frame(0.0).point;
    let mate = format!("mate's axis at {:.3}", part.pair.center_distance());
    let mut words: Vec<NoteLine> = vec![
        format!("φ = 0, R{:.3}", start.coords.norm()).into(),
        mate.into(),
    ];
    let tooth = part.middle(0, 0.0);
    let name = format!("tooth 0, punched, at {:.3}°", degrees(tooth.point));
    if (tooth.point - start).norm() * k < 4.0 {
        words.insert(1, name.into());
    } else {
        notes.push((tooth.point * k, vec![name.into()]));
    }
    let runout = tooth_runout(part.pair, part.member).filter(|_| body.bore > 0.0);
    if let Some(width) = runout {
        words.push(grade::runout_within(width, "A").into());
        words.push("teeth, over pins".to_owned().into());
    }
    notes.push((start * k, words));
    notes
}

/// Minimum width on a sheet of teeth that are drawn behind a section, mm.
const SEEN: f64 = 0.7;

/// Possible positions of a number, mm outwards and along the pitch curve, the best first.
const PLACES: [(f64, f64); 9] = [
    (0.0, 0.0),
    (0.0, 1.5),
    (0.0, -1.5),
    (2.0, 0.0),
    (2.0, 2.5),
    (2.0, -2.5),
    (4.0, 0.0),
    (4.0, 3.0),
    (4.0, -3.0),
];

/// Numbers of the tooth spaces around the face, as many as there is room for.
fn numbers(part: &SheetGear<'_>, k: f64, draft: &mut Draft) {
    let count = part.gear.tooth_count();
    let step = part.pitch() * k;
    let every = [1_u32, 2, 5, 10, 20, 50, 100]
        .into_iter()
        .find(|&n| f64::from(n) * step >= 8.0)
        .unwrap_or(count);
    let height = part.pair.teeth().tool(part.member).addendum * k + RING;
    for space in (0..count).step_by(every as usize) {
        let words = space.to_string();
        let width = lettering::width(&words, NUMBERS);
        let frame = part.middle(space, 0.5);
        // A number that would touch a leader moves: first along the pitch curve, then outwards.
        for (out, along) in PLACES {
            let middle = frame.point * k
                + frame.normal * (height + 0.5 * NUMBERS + out)
                + frame.tangent * along;
            let at = middle - Vector::new(0.0, 0.5 * NUMBERS);
            let room = Vector::new(0.5 * width + 0.6, 0.5 * NUMBERS + 0.6);
            let own = Bounds {
                min: middle - room,
                max: middle + room,
            };
            if !draft.touches(own) {
                draft.text(at, NUMBERS, &words, Anchor::Middle);
                break;
            }
        }
    }
}

/// The section through the axis along x, seen from above, with the keyway if it lies in that plane. Teeth are not cut, ISO 2203.
fn section(part: &SheetGear<'_>, scale: Scale) -> Draft {
    let k = scale.factor();
    let body = part.gear.body();
    let width = body.width * k;
    let half = 0.5 * body.bore * k;
    let mut draft = Draft::default().at_scale(k);
    let [right_tip, right_root] = part.reach(0.0).map(|r| r * k);
    let [left_tip, left_root] = part.reach(std::f64::consts::PI).map(|r| -r * k);
    let p = Point::new;
    let rectangle = |from: f64, to: f64| Bounds {
        min: p(from, 0.0),
        max: p(to, width),
    };
    draft.rectangle(Pen::Outline, rectangle(left_tip, right_tip));
    // Teeth behind the plane that reach farther.
    let [left_behind, right_behind] = part.behind().map(|x| x * k);
    let (left_end, right_end) = (left_behind.min(left_tip), right_behind.max(right_tip));
    for (from, to) in [(left_end, left_tip), (right_tip, right_end)] {
        if to - from > SEEN {
            draft.rectangle(Pen::Outline, rectangle(from, to));
        }
    }
    let upright = |draft: &mut Draft, pen: Pen, x: f64, beyond: f64| {
        draft.line(pen, p(x, -beyond), p(x, width + beyond));
    };
    for root in [left_root, right_root] {
        upright(&mut draft, Pen::Outline, root, 0.0);
    }
    let start = part.frame(0.0).point.coords.norm() * k;
    let pitch = match part.toward_mate().x > 0.0 {
        true => start,
        false => -start,
    };
    upright(&mut draft, Pen::Axis, pitch, 2.0);
    upright(&mut draft, Pen::Axis, 0.0, 4.0);
    let mut solid = vec![rectangle(left_root, right_root)];
    if half > 0.0 {
        let (across, along) = body.keyway_angle.sin_cos();
        let cut = body.keyway.filter(|_| across.abs() < 1e-9);
        let edge = |way: f64| {
            let key = cut.filter(|_| way * along > 0.0);
            way * key.map_or(half, |key| half + key.depth * k)
        };
        let [left, right] = [-1.0, 1.0].map(edge);
        solid = vec![rectangle(left_root, left), rectangle(right, right_root)];
        upright(&mut draft, Pen::Outline, left, 0.0);
        upright(&mut draft, Pen::Outline, right, 0.0);
        if let Some(key) = cut {
            // Where the wall of the keyway leaves the bore.
            let wide = 0.5 * key.width * k;
            let foot = (half * half - wide * wide).max(0.0).sqrt();
            upright(&mut draft, Pen::Outline, foot.copysign(along), 0.0);
        }
    }
    for Bounds { min, max } in solid {
        if max.x > min.x {
            let corners = [min, p(max.x, min.y), max, p(min.x, max.y)];
            draft.hatch(&[Outline::polygon(&corners)], part.tolerance);
        }
    }
    let beside = p(right_end + 10.0, 0.0);
    let edges = [p(right_end, 0.0), p(right_end, width)];
    draft.dimension(edges, Vector::y(), beside, &number(body.width, 3));
    let face = part.tips().map(|tips| 2.0 * tips.maximum.coords.norm());
    let runout = face.filter(|_| half > 0.0);
    if let Some(frame) = runout.and_then(|face| grade::runout(face, "A")) {
        let tip = p(0.5 * (left_root - half), 0.0);
        draft.pointed_frame(tip, tip + Vector::new(4.0, -12.0), &frame, "both faces");
    }
    let title = p(0.0, width + 7.0);
    draft.text(title, 5.0, "C-C", Anchor::Middle);
    draft
}

/// Bore and keyway, enlarged, with their dimensions; `None` if the bore has no keyway.
pub(super) fn bore(part: &SheetGear<'_>) -> Option<Draft> {
    let body = part.gear.body();
    let key = body.keyway?;
    // The keyway is drawn as if along x: the notes state its position.
    let upright = Isometry2::rotation(-body.keyway_angle);
    let outline = &part.bore.as_ref()?.transformed(&upright);
    let scale = Scale::largest(body.bore + key.depth, 45.0);
    let k = scale.factor();
    let half = 0.5 * body.bore * k;
    let top = half + key.depth * k;
    let wide = 0.5 * key.width * k;
    let mut draft = Draft::default().at_scale(k);
    let p = Point::new;
    let rim = Outline::circle(Point::origin(), 1.25 * top);
    draft.hatch(&[rim.clone(), outline.scaled(k)], part.tolerance);
    draft.draw(Pen::Outline, EntityShape::Contour(outline.scaled(k)));
    draft.draw(Pen::Thin, EntityShape::Contour(rim));
    let reach = 1.25 * top + 3.0;
    draft.line(Pen::Axis, p(-reach, 0.0), p(reach, 0.0));
    draft.line(Pen::Axis, p(0.0, -reach), p(0.0, reach));
    let below = p(0.0, -reach - 6.0);
    let depth = fit::hub_depth(body.bore, key);
    draft.dimension([p(-half, 0.0), p(top, wide)], Vector::x(), below, &depth);
    let beside = p(reach + 5.0, 0.0);
    let width = fit::keyway(key.width, &body.keyway_fit);
    draft.dimension([p(top, -wide), p(top, wide)], Vector::y(), beside, &width);
    let tip = p(-0.5 * half, 0.75_f64.sqrt() * half);
    let elbow = p(-0.75 * reach, reach + 3.0);
    let size = fit::bore(body.bore, &body.bore_fit);
    let mut lines = vec![size.into(), Frame::datum('A').into()];
    let symmetry = grade::symmetry(key.width, "A").into_iter();
    lines.extend(symmetry.flat_map(|frame| [NoteLine::from("keyway".to_owned()), frame.into()]));
    draft.note(tip, elbow, &lines);
    let bounds = draft.bounds();
    let title = p(0.0, bounds.max.y + 5.0);
    let mut words = format!("D ({scale})");
    let turned = -body.keyway_angle.to_degrees();
    if turned != 0.0 {
        let way = if turned < 0.0 {
            "clockwise"
        } else {
            "counter-clockwise"
        };
        words = format!("{words}, turned {}° {way}", number(turned.abs(), 4));
    }
    draft.text(title, 5.0, &words, Anchor::Middle);
    Some(draft)
}
