//! Both gears in place.

use super::part::{Part, number};
use crate::{
    drawing::Shape,
    sheet::{Draft, Pen, Scale},
};
use centrode_geometry::{Bounds, Point, Vector};
use centrode_mechanism::gear::Member;
use nalgebra::Isometry2;
use std::f64::consts::PI;

/// Both gears at phi = 0, the driver's axis in the origin.
pub(super) fn view(driver: &Part<'_>, driven: &Part<'_>, scale: Scale) -> Draft {
    let k = scale.factor();
    let pair = driver.pair;
    let a = pair.center_distance() * k;
    let mut draft = Draft::default();
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
    let tooth =
        |part: &Part<'_>, x: f64, n: u32| part.middle(n, 0.0).point * k + Vector::new(x, 0.0);
    let last = driven.gear.tooth_count() - 1;
    let notes = [
        (
            touch,
            vec![
                format!(
                    "pitch point at φ = 0, {:.4} from the driver's axis",
                    touch.x / k
                ),
                format!("ratio there {:.5}", pair.ratio(0.0)),
            ],
        ),
        (
            tooth(driver, 0.0, 0),
            vec![
                "driver tooth 0".to_owned(),
                format!("runs in driven space {last}"),
            ],
        ),
        (
            tooth(driven, a, 0),
            vec![
                "driven tooth 0".to_owned(),
                "runs in driver space 0".to_owned(),
            ],
        ),
    ];
    // Notes stand above: the gears take the sides.
    let top = whole.max.y + 8.0;
    let mut order: Vec<_> = notes.into_iter().collect();
    order.sort_by(|p, q| p.0.y.total_cmp(&q.0.y));
    let x = whole.max.x + 8.0;
    let mut y = f64::NEG_INFINITY;
    for (tip, words) in order {
        y = f64::max(tip.y, y + 13.0);
        draft.leader(tip, Point::new(x, y.min(top + 30.0)), &words);
    }
    draft
}
