//! Bosses on the wall around a hole.

use std::f64::consts::PI;

use centrode_geometry::{Arc, Outline, Point, Segment, bracketed_root};

/// A hole without the discs of a radius, mm, about points near its contour: bosses on the wall around it. `None` if a disc does
/// not cut the contour exactly twice.
#[must_use]
pub fn with_bosses(hole: &Outline, at: &[Point], radius: f64) -> Option<Outline> {
    at.iter().try_fold(hole.clone(), |hole, &middle| {
        let hole = if hole.is_counter_clockwise() {
            hole
        } else {
            Outline::new(
                hole.segments()
                    .iter()
                    .rev()
                    .map(Segment::reversed)
                    .collect(),
            )
            .ok()?
        };
        boss(&hole, middle, radius)
    })
}

/// The part of a segment from a parameter on, to exactly its end.
fn rest(segment: &Segment, from: f64) -> Segment {
    match segment.part(from, 1.0) {
        Segment::Line(start, _) => Segment::Line(start, segment.end()),
        Segment::Arc(arc) => Segment::Arc(Arc {
            end: segment.end(),
            ..arc
        }),
        poly @ Segment::Poly(_) => poly,
    }
}

/// Intervals of a segment at whose ends its distance from a circle is sampled.
const SAMPLES: usize = 64;

fn boss(hole: &Outline, middle: Point, radius: f64) -> Option<Outline> {
    let segments = hole.segments();
    let off = |segment: &Segment, u: f64| (segment.at(u).point - middle).norm() - radius;
    let (mut enters, mut leaves) = (Vec::new(), Vec::new());
    for (index, segment) in segments.iter().enumerate() {
        let at = |i: usize| 2.0 * i as f64 / SAMPLES as f64 - 1.0;
        for i in 0..SAMPLES {
            let [u, v] = [at(i), at(i + 1)];
            let [a, b] = [u, v].map(|u| off(segment, u));
            if (a > 0.0) == (b > 0.0) {
                continue;
            }
            let root = bracketed_root(|u| off(segment, u), u, v, a, b);
            if a > 0.0 { &mut enters } else { &mut leaves }.push((index, root));
        }
    }
    let ([(last, end)], [(first, start)]) = (&enters[..], &leaves[..]) else {
        return None;
    };
    // From the point where the contour leaves the disc to the point where it enters it again, and back round the disc, whose
    // inside is material.
    let mut kept = Vec::new();
    if first == last && start < end {
        kept.push(segments[*first].part(*start, *end));
    } else {
        kept.push(rest(&segments[*first], *start));
        let n = segments.len();
        let between = (1..n).map(|k| (first + k) % n);
        kept.extend(between.take_while(|k| k != last).map(|k| segments[k]));
        kept.push(segments[*last].part(-1.0, *end));
    }
    let from = kept.last()?.end();
    let to = kept.first()?.start();
    let way = |p: Point| (p.y - middle.y).atan2(p.x - middle.x);
    let sweep = -(way(from) - way(to)).rem_euclid(2.0 * PI);
    kept.push(Segment::Arc(Arc {
        start: from,
        end: to,
        bulge: (0.25 * sweep).tan(),
    }));
    Outline::new(kept).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f64) -> Outline {
        let p = Point::new;
        Outline::polygon(&[p(0.0, 0.0), p(side, 0.0), p(side, side), p(0.0, side)])
    }

    #[test]
    fn a_boss_takes_from_the_hole_what_of_its_disc_is_within() {
        let hole = square(40.0);
        let area = |at: Point| with_bosses(&hole, &[at], 3.0).map(|hole| hole.area());
        let half = 0.5 * PI * 9.0;
        let left = area(Point::new(20.0, 0.0)).expect("a hole");
        assert!((1600.0 - left - half).abs() < 1e-9);
        // In a corner a quarter of the disc lies within.
        let left = area(Point::new(0.0, 40.0)).expect("a hole");
        assert!((1600.0 - left - 0.5 * half).abs() < 1e-9);
        assert_eq!(area(Point::new(20.0, 20.0)), None);
        let places = [Point::new(20.0, 0.0), Point::new(40.0, 20.0)];
        let both = with_bosses(&hole, &places, 3.0).expect("a hole");
        assert!((1600.0 - both.area() - 2.0 * half).abs() < 1e-9);
        assert_eq!(both.segments().len(), 8);
    }
}
