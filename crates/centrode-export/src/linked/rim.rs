use centrode_geometry::{Point, Segment, convex_hull};
use centrode_kinematics::machine::{LinePath, LineRole, Sketch};

/// Maximum number of points of a rim: the error of straight lines between them is too small to see.
const MOST: usize = 64;

/// Points on the convex hull of the material in a sketch, counter-clockwise.
pub(super) fn rim(sketch: &Sketch) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    for line in &sketch.lines {
        if !matches!(
            line.role,
            LineRole::Body | LineRole::Bar | LineRole::Clamp | LineRole::Pitch
        ) {
            continue;
        }
        match &line.path {
            LinePath::Contour(outline) => points.extend(outline.segments().iter().flat_map(places)),
            LinePath::Chain(corners) => points.extend(corners.iter().copied().map(Point::from)),
            LinePath::Trace(_) => {}
        }
    }
    let corners = convex_hull(&points);
    let step = corners.len().div_ceil(MOST).max(1);
    corners.iter().step_by(step).map(|&i| points[i]).collect()
}

/// Points along a segment, from its start, without its end.
fn places(segment: &Segment) -> impl Iterator<Item = Point> {
    let count: u32 = match segment {
        Segment::Line(..) => 1,
        Segment::Arc(_) => 16,
        Segment::Poly(_) => 2,
    };
    (0..count).map(move |i| {
        segment
            .at(2.0 * f64::from(i) / f64::from(count) - 1.0)
            .point
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::Outline;
    use centrode_kinematics::machine::Line;

    #[test]
    fn a_rim_is_convex_and_leaves_nothing_outside() {
        let corners = [
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 3.0],
            [2.0, 1.0],
            [0.0, 3.0],
            [1.0, 0.0],
        ];
        let outline = Outline::polygon(&corners.map(Point::from));
        let bar = [Point::new(1.0, 1.0), Point::new(6.0, 1.0)];
        let sketch = Sketch {
            name: "plate with a bar".into(),
            lines: vec![
                Line::contour(LineRole::Body, &outline),
                Line::chain(LineRole::Bar, &bar),
                Line::chain(LineRole::Ground, &[Point::new(-9.0, -9.0)]),
            ],
        };
        let want = [[0.0, 0.0], [4.0, 0.0], [6.0, 1.0], [4.0, 3.0], [0.0, 3.0]];
        assert_eq!(rim(&sketch), want.map(Point::from));
    }
}
