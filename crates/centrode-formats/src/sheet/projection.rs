use super::{Draft, Pen};
use crate::drawing::EntityShape;
use centrode_geometry::{Outline, Point};
use centrode_spec::Projection;

/// Draws the symbol of the projection method, ISO 5456-2: a truncated cone from the side and from its small
/// end. In first angle the view from the left is on the right.
pub(super) fn symbol(draft: &mut Draft, center: Point, height: f64, projection: Projection) {
    // The cone of the standard: diameters 1 and 2, length 2, in units of half the height.
    let unit = 0.5 * height;
    let (round, cone) = match projection {
        Projection::FirstAngle => (1.6 * unit, -1.4 * unit),
        Projection::ThirdAngle => (-1.6 * unit, 1.4 * unit),
    };
    let p = |x: f64, y: f64| Point::new(center.x + x, center.y + y);
    for radius in [unit, 0.5 * unit] {
        let circle = EntityShape::Circle {
            center: p(round, 0.0),
            radius,
        };
        draft.draw(Pen::Outline, circle);
    }
    // The small end points away from the circles in first angle, towards them in third.
    let small = cone - unit;
    let large = cone + unit;
    let outline = [
        p(small, -0.5 * unit),
        p(large, -unit),
        p(large, unit),
        p(small, 0.5 * unit),
    ];
    draft.draw(
        Pen::Outline,
        EntityShape::Contour(Outline::polygon(&outline)),
    );
    let reach = 1.3 * unit;
    draft.line(Pen::Axis, p(round - reach, 0.0), p(round + reach, 0.0));
    draft.line(Pen::Axis, p(round, -reach), p(round, reach));
    draft.line(
        Pen::Axis,
        p(small - 0.3 * unit, 0.0),
        p(large + 0.3 * unit, 0.0),
    );
}
