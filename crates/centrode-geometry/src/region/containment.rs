use crate::{
    Point,
    curve::{Span, winding},
    region::Outline,
};

impl Outline {
    /// Whether a point lies inside, by the parity of the crossings with a ray to the right.
    ///
    /// Exact up to rounding for a point that is not on the contour. For a point on the contour either answer is possible.
    #[must_use]
    pub fn contains(&self, point: Point) -> bool {
        let turns = self
            .segments()
            .iter()
            .map(|segment| winding(&Span::whole(segment), point));
        turns.sum::<i32>() % 2 != 0
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Point, Vector,
        numeric::Tolerance,
        region::Outline,
        test_shapes::{rosette, tooth_ring},
    };

    #[test]
    fn points_slightly_inside_and_outside_are_distinguished() {
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
