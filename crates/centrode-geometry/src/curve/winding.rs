use crate::{Point, curve::Segment};

/// Number of upward minus number of downward crossings of a segment with the ray from `point` towards +x.
///
/// The sum over a closed chain is the winding number about the point.
pub(crate) fn winding(segment: &Segment, point: Point) -> i32 {
    let side = |y: f64| y > point.y;
    let mut count = 0;
    let mut stack = vec![(-1.0, 1.0, segment.start(), segment.end(), 0)];
    while let Some((u0, u1, start, end, depth)) = stack.pop() {
        crate::checkpoint();
        let box_ = segment.enclosure(u0, u1);
        if box_.min.y > point.y || box_.max.y <= point.y || box_.max.x < point.x {
            continue;
        }
        // For a part entirely to the right of the point, the ends determine the count.
        // The box of a part below rounding no longer shrinks with it.
        let below_rounding = depth >= 20 && (end - start).amax() <= 1e-12 * start.coords.amax();
        if box_.min.x > point.x || depth >= 50 || below_rounding {
            count += i32::from(side(end.y)) - i32::from(side(start.y));
            continue;
        }
        let middle = 0.5 * (u0 + u1);
        let between = segment.at(middle).point;
        stack.push((u0, middle, start, between, depth + 1));
        stack.push((middle, u1, between, end, depth + 1));
    }
    count
}
