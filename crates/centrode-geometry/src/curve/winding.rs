use crate::{Point, curve::Span, numeric::WRITTEN};

/// Number of upward minus number of downward crossings of a part with the ray from `point` towards +x.
///
/// The sum over a closed chain is the winding number about the point.
pub(crate) fn winding(whole: &Span<'_>, point: Point) -> i32 {
    let side = |p: Point| i32::from(p.y > point.y);
    let mut count = 0;
    let mut stack = vec![(*whole, 0)];
    while let Some((part, depth)) = stack.pop() {
        crate::checkpoint();
        let (box_, [start, end]) = (part.bounding_box(), part.ends);
        if box_.min.y > point.y || box_.max.y <= point.y || box_.max.x < point.x {
            continue;
        }
        // For a part entirely to the right of the point, the ends determine the count.
        // The box of a part below rounding no longer shrinks with it.
        let below_rounding = depth >= 20 && (end - start).amax() <= WRITTEN * start.coords.amax();
        if box_.min.x > point.x || depth >= 50 || below_rounding {
            count += side(end) - side(start);
            continue;
        }
        stack.extend(part.halves().map(|half| (half, depth + 1)));
    }
    count
}
