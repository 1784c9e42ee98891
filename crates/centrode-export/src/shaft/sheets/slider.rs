//! The slider seen along its pin, and a section through it.

use crate::fit;
use centrode_formats::{
    drawing::EntityShape,
    sheet::{Draft, Pen, Scale, number},
};
use centrode_geometry::{Bounds, Outline, Point, Tolerance, Vector};
use centrode_groove::SpiralShaft;
use centrode_spec::Projection;

/// Gap between two views, mm.
const APART: f64 = 16.0;

pub(super) fn views(
    shaft: &SpiralShaft,
    scale: Scale,
    letters: f64,
    projection: Projection,
) -> Draft {
    let k = scale.factor();
    let spec = shaft.slider();
    let width = spec.width(shaft.groove().width());
    let (long, wide, bore) = (
        0.5 * k * spec.length,
        0.5 * k * width,
        0.5 * k * spec.pin_diameter,
    );
    let p = Point::new;
    let mut draft = Draft::lettered(letters).at_scale(k);
    let outline = spec.outline(shaft.groove().width()).scaled(k);
    draft.draw(Pen::Outline, EntityShape::Contour(outline));
    draft.draw(
        Pen::Outline,
        EntityShape::Circle {
            center: Point::origin(),
            radius: bore,
        },
    );
    draft.line(Pen::Axis, p(-long - 3.0, 0.0), p(long + 3.0, 0.0));
    draft.line(Pen::Axis, p(0.0, -wide - 3.0), p(0.0, wide + 3.0));
    let above = p(0.0, wide + 9.0);
    draft.dimension(
        [p(-long, 0.0), p(long, 0.0)],
        Vector::x(),
        above,
        &number(spec.length, 3),
    );
    let beside = p(long + 9.0, 0.0);
    draft.dimension(
        [p(0.0, -wide), p(0.0, wide)],
        Vector::y(),
        beside,
        &fit::keyway(width, &spec.slider_fit),
    );
    let tip = p(-0.6 * bore, -0.8 * bore);
    let elbow = p(-long - 4.0, -wide - 7.0);
    draft.leader(tip, elbow, &[fit::bore(spec.pin_diameter, &spec.hole_fit)]);
    let tip = p(long - wide + 0.8 * wide, -0.6 * wide);
    let elbow = p(long + 4.0, -wide - 7.0);
    draft.leader(tip, elbow, &[format!("R{}", number(0.5 * width, 3))]);
    let section = section(shaft, k, letters);
    let (own, other) = (draft.bounds(), section.bounds());
    let y = match projection {
        Projection::FirstAngle => own.min.y - APART - other.max.y,
        Projection::ThirdAngle => own.max.y + APART - other.min.y,
    };
    draft.add(&section, Vector::new(0.0, y));
    draft
}

/// Section along the slider through its middle.
fn section(shaft: &SpiralShaft, k: f64, letters: f64) -> Draft {
    let spec = shaft.slider();
    let (long, high, bore) = (
        0.5 * k * spec.length,
        k * spec.reach,
        0.5 * k * spec.pin_diameter,
    );
    let p = Point::new;
    let mut draft = Draft::lettered(letters).at_scale(k);
    for side in [[-long, -bore], [bore, long]] {
        let (min, max) = (p(side[0], 0.0), p(side[1], high));
        let corners = [min, p(max.x, min.y), max, p(min.x, max.y)];
        // The sides are straight: any tolerance gives exact lines.
        if let Ok(fine) = Tolerance::new(1e-3) {
            draft.hatch(&[Outline::polygon(&corners)], fine);
        }
    }
    draft.rectangle(
        Pen::Outline,
        Bounds {
            min: p(-long, 0.0),
            max: p(long, high),
        },
    );
    for x in [-bore, bore] {
        draft.line(Pen::Outline, p(x, 0.0), p(x, high));
    }
    draft.line(Pen::Axis, p(0.0, -3.0), p(0.0, high + 3.0));
    let beside = p(long + 9.0, 0.0);
    draft.dimension(
        [p(long, 0.0), p(long, high)],
        Vector::y(),
        beside,
        &number(spec.reach, 3),
    );
    draft
}
