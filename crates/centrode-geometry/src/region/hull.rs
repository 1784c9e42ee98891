use std::f64::consts::{FRAC_PI_2, TAU};

use crate::{
    Point, Vector,
    curve::{Arc, Segment},
    region::Outline,
};

impl Outline {
    /// Convex hull of circles, like a belt around them: arcs joined by common tangents. A circle is its center and radius, mm.
    ///
    /// It is exact and counter-clockwise; a circle of radius zero is a corner. `None` if it encloses nothing, a number is not
    /// finite or a radius is negative. Cost: number of arcs times number of circles.
    #[must_use]
    pub fn hull(circles: &[(Point, f64)]) -> Option<Self> {
        let is_valid = |(center, radius): &(Point, f64)| {
            center.x.is_finite() && center.y.is_finite() && radius.is_finite() && *radius >= 0.0
        };
        if !circles.iter().all(is_valid) {
            return None;
        }
        let arcs = hull_arcs(circles)?;
        let point_at = |circle: usize, normal: f64| {
            let (center, radius) = circles[circle];
            center + Vector::new(normal.cos(), normal.sin()) * radius
        };
        if arcs.len() == 1 {
            let (center, radius) = circles[arcs[0].circle];
            return (radius > 0.0).then(|| Self::circle(center, radius));
        }
        let mut segments = Vec::new();
        let mut from = point_at(arcs[arcs.len() - 1].circle, arcs[arcs.len() - 1].to);
        for arc in &arcs {
            let start = point_at(arc.circle, arc.from);
            if start != from {
                segments.push(Segment::Line(from, start));
            }
            let end = point_at(arc.circle, arc.to);
            if end != start {
                segments.push(Segment::Arc(Arc {
                    start,
                    end,
                    bulge: (0.25 * (arc.to - arc.from)).tan(),
                }));
            }
            from = end;
        }
        // Points on a line enclose no more than rounding.
        let encloses = |hull: &Self| hull.area() > 1e-13 * hull.length().powi(2);
        Self::new(segments).ok().filter(encloses)
    }
}

/// Arc of the hull on one circle, from one direction of the outward normal to another, rad.
struct HullArc {
    circle: usize,
    from: f64,
    to: f64,
}

/// Arcs of the hull, counter-clockwise from the lowest circle.
fn hull_arcs(circles: &[(Point, f64)]) -> Option<Vec<HullArc>> {
    let lowest = |i: &usize| circles[*i].0.y - circles[*i].1;
    let order = |i: &usize, j: &usize| {
        let by_height = lowest(i).total_cmp(&lowest(j));
        // Of equally low circles take the rightmost: the downward normal of the hull ends there.
        by_height.then(circles[*j].0.x.total_cmp(&circles[*i].0.x))
    };
    let first = (0..circles.len()).min_by(order)?;
    let start = -FRAC_PI_2;
    let (mut circle, mut normal) = (first, start);
    let mut arcs: Vec<HullArc> = Vec::new();
    // Two circles have at most two common tangents that keep both on one side.
    for _ in 0..=2 * circles.len() {
        let next = (0..circles.len())
            .filter_map(|other| Some((other, turn(circles, circle, other, normal)?)))
            .min_by(|(_, a), (_, b)| a.total_cmp(b));
        let end = next.map_or(f64::INFINITY, |(_, turn)| normal + turn);
        if end >= start + TAU {
            let last = HullArc {
                circle,
                from: normal,
                to: start + TAU,
            };
            // The first arc began in its middle.
            match arcs.first_mut() {
                Some(whole) if whole.circle == circle => whole.from = last.from - TAU,
                _ => arcs.push(last),
            }
            return Some(arcs);
        }
        arcs.push(HullArc {
            circle,
            from: normal,
            to: end,
        });
        (circle, normal) = (next?.0, end);
    }
    None
}

/// Angle, rad, by which the normal turns on one circle until the tangent touches another; `None` if it never does.
fn turn(circles: &[(Point, f64)], circle: usize, other: usize, normal: f64) -> Option<f64> {
    let ((from, radius), (to, other_radius)) = (circles[circle], circles[other]);
    let (offset, shrink) = (to - from, radius - other_radius);
    let distance = offset.norm();
    if distance <= shrink.abs() {
        return None;
    }
    let leaves = offset.y.atan2(offset.x) - (shrink / distance).acos();
    let turn = (leaves - normal).rem_euclid(TAU);
    // Because of rounding, a tangent just passed may appear to be a whole turn ahead.
    Some(if turn > TAU - 1e-9 { 0.0 } else { turn })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn belts_have_their_closed_forms_of_length_and_area() {
        // Equal pulleys; a belt on unequal ones; a triangle of points; one circle in another.
        let two = [(Point::new(1.0, 2.0), 3.0), (Point::new(9.0, 8.0), 3.0)];
        let hull = Outline::hull(&two).expect("a hull");
        assert!((hull.length() - (20.0 + 6.0 * PI)).abs() < 1e-12);
        assert!((hull.area() - (60.0 + 9.0 * PI)).abs() < 1e-11);
        let unequal = [(Point::origin(), 5.0), (Point::new(0.0, -13.0), 1.0)];
        let hull = Outline::hull(&unequal).expect("a hull");
        let (straight, tangent_angle) = ((169.0_f64 - 16.0).sqrt(), (4.0_f64 / 13.0).asin());
        let length = 2.0 * straight + 5.0 * (PI + 2.0 * tangent_angle) + (PI - 2.0 * tangent_angle);
        assert!((hull.length() - length).abs() < 1e-12, "{}", hull.length());
        let corners = [[0.0, 0.0], [4.0, 0.0], [1.0, 0.5], [0.0, 3.0]];
        let points = corners.map(|p| (Point::from(p), 0.0));
        let hull = Outline::hull(&points).expect("a hull");
        assert!((hull.area() - 6.0).abs() < 1e-14 && hull.segments().len() == 3);
        let nested = [(Point::origin(), 5.0), (Point::new(1.0, 0.0), 2.0)];
        let hull = Outline::hull(&nested).expect("a hull");
        assert!((hull.length() - 10.0 * PI).abs() < 1e-12);
    }

    #[test]
    fn a_hull_reaches_as_far_as_its_circles_in_every_direction() {
        let mut seed = 7_u64;
        let mut chance = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for count in (1..9).cycle().take(400) {
            let circles: Vec<_> = (0..count)
                .map(|_| {
                    let center = Point::new(100.0 * chance(), 100.0 * chance());
                    (center, (40.0 * chance() - 10.0).max(0.0))
                })
                .collect();
            if count < 3 && circles.iter().all(|c| c.1 == 0.0) {
                assert!(Outline::hull(&circles).is_none());
                continue;
            }
            let hull = Outline::hull(&circles).expect("a hull");
            assert!(hull.is_counter_clockwise() && hull.crossing().is_none());
            for i in 0..60 {
                let direction = f64::from(i) * 0.1047;
                let turned = nalgebra::Isometry2::rotation(-direction);
                let reach = circles
                    .iter()
                    .map(|(c, r)| (turned * c).x + r)
                    .fold(f64::NEG_INFINITY, f64::max);
                let ours = hull.transformed(&turned).bounds().max.x;
                assert!((ours - reach).abs() < 1e-10, "{circles:?} {direction}");
            }
        }
    }

    #[test]
    fn nothing_has_no_hull() {
        assert!(Outline::hull(&[]).is_none());
        assert!(Outline::hull(&[(Point::origin(), 0.0)]).is_none());
        assert!(Outline::hull(&[(Point::origin(), -1.0)]).is_none());
        assert!(Outline::hull(&[(Point::new(f64::NAN, 0.0), 1.0)]).is_none());
        let line = [0.0, 1.0, 5.0].map(|x| (Point::new(x, x), 0.0));
        assert!(Outline::hull(&line).is_none());
    }
}
