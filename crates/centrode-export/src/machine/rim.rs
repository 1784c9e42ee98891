use centrode_geometry::{Point, Segment};
use centrode_mechanism::machine::{LinePath, LineRole, Sketch};

/// Most places of a rim: what lies beyond the straight lines between them is seen by no eye.
const MOST: usize = 64;

/// Places on the convex hull of what is material in a sketch, counter-clockwise.
pub(super) fn rim(sketch: &Sketch) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    for line in &sketch.lines {
        if !matches!(line.role, LineRole::Body | LineRole::Bar | LineRole::Clamp) {
            continue;
        }
        match &line.path {
            LinePath::Contour(outline) => points.extend(outline.segments().iter().flat_map(places)),
            LinePath::Chain(corners) => points.extend(corners.iter().copied().map(Point::from)),
            LinePath::Trace(_) => {}
        }
    }
    let hull = hull(points);
    let step = hull.len().div_ceil(MOST).max(1);
    hull.into_iter().step_by(step).collect()
}

/// Places of a segment from its start on.
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

/// The convex hull of some points, counter-clockwise: Andrew's monotone chain.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut lower = chain(points.iter());
    let mut upper = chain(points.iter().rev());
    // Each begins where the other one ends.
    lower.pop();
    upper.pop();
    lower.append(&mut upper);
    lower
}

/// The points that leave all others on their left, of points in order.
fn chain<'a>(points: impl Iterator<Item = &'a Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    for point in points {
        while let [.., from, middle] = kept[..] {
            if (middle - from).perp(&(point - from)) > 0.0 {
                break;
            }
            kept.pop();
        }
        kept.push(*point);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::Outline;
    use centrode_mechanism::machine::Line;

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
