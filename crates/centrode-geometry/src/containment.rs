use crate::{Outline, Point, Segment};

impl Outline {
    /// Whether a point lies inside, by the parity of crossings with a ray to the right.
    ///
    /// Exact up to rounding for points not on the contour itself; a point on it may get either answer.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        let turns = self
            .segments()
            .iter()
            .map(|segment| winding(segment, point));
        turns.sum::<i32>() % 2 != 0
    }
}

/// How often a segment crosses the ray from `point` towards +x upwards, less how often downwards: over a closed chain, the
/// winding number about the point.
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
        // Whatever happens in a part wholly to the right, its ends tell the count.
        // The box of a part that is all rounding no longer shrinks with it.
        let all_rounding = depth >= 20 && (end - start).amax() <= 1e-12 * start.coords.amax();
        if box_.min.x > point.x || depth >= 50 || all_rounding {
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

#[cfg(test)]
mod tests {
    use crate::{
        Outline, Point, Tolerance, Vector,
        shapes::{rosette, tooth_ring},
    };

    #[test]
    fn points_a_hair_inside_and_outside_are_told_apart() {
        let fine = Tolerance::new(1e-11).expect("positive");
        for outline in [
            rosette(20.0, 3.0, 5, fine),
            tooth_ring(17, 3.0, fine).arcs(Tolerance::new(1e-3).expect("positive")),
            Outline::circle(Point::new(1.0, 2.0), 7.0),
        ] {
            for outline in [outline.clone(), outline.reversed()] {
                let side = if outline.is_counter_clockwise() {
                    1.0
                } else {
                    -1.0
                };
                for segment in outline.segments().iter().step_by(5) {
                    let jet = segment.at(0.13);
                    let outward = Vector::new(jet.first.y, -jet.first.x).normalize() * side;
                    assert!(outline.contains(jet.point - outward * 1e-9));
                    assert!(!outline.contains(jet.point + outward * 1e-9));
                }
            }
        }
        assert!(!Outline::circle(Point::origin(), 1.0).contains(Point::new(-5.0, 0.0)));
        assert!(!Outline::circle(Point::origin(), 1.0).contains(Point::new(f64::NAN, 0.0)));
    }
}
