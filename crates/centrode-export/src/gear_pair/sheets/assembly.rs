//! Both gears in place.

use super::part::Part;
use crate::{
    drawing::Shape,
    sheet::{Draft, Pen, Scale, number},
};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_mechanism::gear::Member;
use nalgebra::Isometry2;
use std::f64::consts::PI;

/// Both gears at phi = 0, the driver's axis in the origin.
pub(super) fn view(driver: &Part<'_>, driven: &Part<'_>, scale: Scale, letters: f64) -> Draft {
    let k = scale.factor();
    let pair = driver.pair;
    let a = pair.center_distance() * k;
    let mut draft = Draft::lettered(letters);
    let mut whole = Bounds::EMPTY;
    for (part, x) in [(driver, 0.0), (driven, a)] {
        let place = Isometry2::translation(x, 0.0);
        let mut contour = |pen: Pen, outline: &centrode_geometry::Outline| {
            let moved = outline.scaled(k).transformed(&place);
            draft.draw(pen, Shape::Contour(moved));
        };
        contour(Pen::Axis, &part.pitch_curve);
        contour(Pen::Outline, &part.outline);
        if let Some(bore) = &part.bore {
            contour(Pen::Outline, bore);
        }
        let Bounds { min, max } = part.bounds();
        let (low, high) = (min.y * k - 4.0, max.y * k + 4.0);
        draft.line(Pen::Axis, Point::new(x, low), Point::new(x, high));
        let axis = Vector::new(x, 0.0);
        whole = whole.with(min * k + axis).with(max * k + axis);
        // The driver turns clockwise as phi grows.
        let (from, to) = match part.member {
            Member::Driver => (0.75 * PI, 0.45 * PI),
            Member::Driven => (0.25 * PI, 0.55 * PI),
        };
        let room = part.reach(0.5 * PI)[1] * k;
        let inner = 0.5 * part.gear.body().bore * k;
        let radius = 0.5 * (room + inner);
        if radius > 4.0 {
            draft.turning_arrow(Point::new(x, 0.0), radius, from, to);
        }
    }
    let y = Vector::new(4.0, 0.0);
    draft.line(
        Pen::Axis,
        Point::new(whole.min.x, 0.0) - y,
        Point::new(whole.max.x, 0.0) + y,
    );
    let below = Point::new(0.0, whole.min.y - 14.0);
    let words = number(pair.center_distance(), 4);
    let axes = [(driver, 0.0), (driven, a)].map(|(part, x)| {
        let low = part.bounds().min.y * k - 4.0;
        Point::new(x, low)
    });
    draft.dimension(axes, Vector::x(), below, &words);
    let touch = driver.frame(0.0).point * k;
    let last = driven.gear.tooth_count() - 1;
    for (part, x, side, words) in [
        (
            driver,
            0.0,
            -1.0,
            ["driver tooth 0", &format!("in driven space {last}")],
        ),
        (driven, a, 1.0, ["driven tooth 0", "in driver space 0"]),
    ] {
        let frame = part.middle(0, 0.0);
        let height = 0.5 * pair.teeth().tool.addendum;
        let tip = (frame.point + frame.normal * height) * k + Vector::new(x, 0.0);
        // Words go on from the leader: it leans outwards, off its mate's, wherever the first tooth stands.
        let out = (side * touch.x).max(side * tip.x) * side;
        let elbow = Point::new(out + 6.0 * side, whole.max.y + 12.0);
        draft.leader(tip, elbow, &words.map(str::to_owned));
    }
    draft
}
