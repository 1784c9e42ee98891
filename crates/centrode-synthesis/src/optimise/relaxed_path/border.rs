use centrode_geometry::{Bounds, Point};

use centrode_analysis::{Finding, Severity, Unit};

/// Distance from a side of the box below which an axis counts as on it, as a share of the box's diagonal: a search ends about so
/// near to a bound.
const NEAR: f64 = 1e-3;

/// The finding on an axis at the border of the box in which it was searched: outside the box there may be a better axis.
#[must_use]
pub fn axis_at_border(axis: Point, room: &Bounds) -> Option<Finding> {
    let near = NEAR * room.diagonal();
    let sides = [
        ("x", axis.x, room.min.x),
        ("x", axis.x, room.max.x),
        ("y", axis.y, room.min.y),
        ("y", axis.y, room.max.y),
    ];
    let met = sides.into_iter();
    let met = met.filter(|(_, at, side)| (at - side).abs() <= near);
    let met: Vec<_> = met.collect();
    let &(_, at, side) = met.first()?;
    let ends = met.iter();
    let ends =
        ends.map(|(name, _, side)| format!("{name} ends at {}", Unit::Millimetre.with_unit(*side)));
    let ends: Vec<String> = ends.collect();
    let message = format!(
        "the axis found, ({:.4}, {:.4}) mm, is at the border of the searched box, where {}: there may be a better axis outside",
        axis.x,
        axis.y,
        ends.join(" and ")
    );
    Some(
        Finding::new("axis-at-border", Severity::Note, message)
            .measured(at, side, Unit::Millimetre)
            .remedy("a larger axis_box, or a given axis")
            .on("carrier"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_at_a_side_is_told_with_that_side_and_one_inside_is_not() {
        let room = [Point::new(-10.0, 0.0), Point::new(90.0, 50.0)];
        let room: Bounds = room.into_iter().collect();
        assert_eq!(axis_at_border(Point::new(40.0, 20.0), &room), None);
        assert_eq!(axis_at_border(Point::new(-9.5, 20.0), &room), None);
        for (axis, words) in [
            (Point::new(-10.0, 20.0), "where x ends at -10"),
            (Point::new(89.95, 20.0), "where x ends at 90"),
            (Point::new(40.0, 0.01), "where y ends at 0"),
            (Point::new(40.0, 50.0), "where y ends at 50"),
            (
                Point::new(90.0, 50.0),
                "where x ends at 90.0000 mm and y ends at 50",
            ),
        ] {
            let found = axis_at_border(axis, &room).expect("a finding");
            assert!(found.message.contains(words), "{}", found.message);
        }
    }
}
