use crate::{
    Point,
    curve::{Arc, Segment},
    region::Outline,
};

/// Side of a polygon too short for the roundings of its two corners.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the side that starts at corner {side} is {length:.6} mm long, but the roundings of its corners need {taken:.6} mm"
)]
pub struct ShortSide {
    /// Index of the corner at which the side begins.
    pub side: usize,
    /// Its length, mm.
    pub length: f64,
    /// Length that the roundings of its two corners need, mm.
    pub taken: f64,
}

impl Outline {
    /// Polygon with every corner, convex or concave, rounded by an arc of `radius`, mm, tangent to both sides.
    ///
    /// On each side of its corner an arc takes the radius times the tangent of half the turn: nothing in a straight line.
    ///
    /// # Errors
    /// [`ShortSide`] if a side is too short for the arcs at its ends, as is always so at a corner that turns back.
    pub fn rounded_polygon(points: &[Point], radius: f64) -> Result<Self, ShortSide> {
        let count = points.len();
        let turn = |i: usize| {
            let before = points[i] - points[(i + count - 1) % count];
            let after = points[(i + 1) % count] - points[i];
            before.perp(&after).atan2(before.dot(&after))
        };
        let turns: Vec<f64> = (0..count).map(turn).collect();
        let taken = |i: usize| radius * (0.5 * turns[i]).tan().abs();
        let mut segments = Vec::new();
        let mut corners = Vec::new();
        for i in 0..count {
            let next = (i + 1) % count;
            let (side, both) = (points[next] - points[i], taken(i) + taken(next));
            let length = side.norm();
            if both > length || both.is_nan() {
                return Err(ShortSide {
                    side: i,
                    length,
                    taken: both,
                });
            }
            corners.push((
                points[i] + side * (taken(i) / length),
                points[next] - side * (taken(next) / length),
            ));
        }
        for (i, &(start, end)) in corners.iter().enumerate() {
            let before = corners[(i + count - 1) % count].1;
            if before != start {
                segments.push(Segment::Arc(Arc {
                    start: before,
                    end: start,
                    bulge: (0.25 * turns[i]).tan(),
                }));
            }
            if start != end {
                segments.push(Segment::Line(start, end));
            }
        }
        Ok(Self::from_closed(segments))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_rounded_rectangle_and_a_rounded_angle_have_their_areas_and_lengths() {
        let rectangle = [[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]].map(Point::from);
        for radius in [0.0, 3.0, 10.0] {
            let rounded = Outline::rounded_polygon(&rectangle, radius).expect("room");
            let closed = Outline::new(rounded.segments().to_vec()).expect("closed");
            let missing = (4.0 - PI) * radius * radius;
            assert!((closed.area() - 600.0 + missing).abs() < 1e-12);
            assert!((closed.length() - 100.0 + (8.0 - 2.0 * PI) * radius).abs() < 1e-12);
            assert!(closed.crossing().is_none());
        }
        // An angle: five corners turn out, one in; each takes or gives the same.
        let angle = [
            [0.0, 0.0],
            [30.0, 0.0],
            [30.0, 10.0],
            [10.0, 10.0],
            [10.0, 40.0],
            [0.0, 40.0],
        ];
        let rounded = Outline::rounded_polygon(&angle.map(Point::from), 2.0).expect("room");
        let closed = Outline::new(rounded.segments().to_vec()).expect("closed");
        assert!((closed.area() - 600.0 + 4.0 * (4.0 - PI)).abs() < 1e-12);
    }

    #[test]
    fn a_side_too_short_for_its_roundings_is_an_error() {
        let rectangle = [[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]].map(Point::from);
        let short = Outline::rounded_polygon(&rectangle, 10.1).expect_err("no room");
        assert_eq!(short.side, 1);
        assert!((short.length - 20.0).abs() < 1e-12 && (short.taken - 20.2).abs() < 1e-12);
        let spike = [[0.0, 0.0], [30.0, 0.0], [10.0, 0.0]].map(Point::from);
        assert!(Outline::rounded_polygon(&spike, 1.0).is_err());
    }
}
