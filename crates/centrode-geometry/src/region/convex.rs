use crate::{Point, Vector, numeric::Tolerance};

/// Convex pieces that cover a region. Each is the hull of a part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvexPieces {
    /// Corners of the pieces, each counter-clockwise.
    pub pieces: Vec<Vec<Point>>,
    /// Maximum distance by which a piece exceeds the region, mm.
    pub excess: f64,
}

/// Cuts the region inside a simple counter-clockwise polygon into convex pieces that cover it.
///
/// The pieces exceed the region by at most the tolerance. A part with a deeper concavity is split at its deepest vertex,
/// along the chord to the second contact point of the maximum inscribed circle that touches there. Halving a smooth concavity
/// quarters its depth, so the number of pieces is about the root of depth over tolerance. If no such cut exists, as in a
/// polygon that crosses itself, the piece is the hull of the part and [`ConvexPieces::excess`] reports the difference. Each
/// cut costs the square of the number of corners.
///
/// Parts with less area than the square of the tolerance are omitted.
#[must_use]
pub fn convex_pieces(polygon: &[Point], tolerance: Tolerance) -> ConvexPieces {
    let mut found = ConvexPieces {
        pieces: Vec::new(),
        excess: 0.0,
    };
    let mut parts = vec![without_repeats(polygon)];
    while let Some(part) = parts.pop() {
        crate::checkpoint();
        if area(&part) <= tolerance.mm() * tolerance.mm() {
            continue;
        }
        let corners = convex_hull(&part);
        let concavity = deepest(&part, &corners);
        let cut = concavity
            .as_ref()
            .filter(|concavity| concavity.depth > tolerance.mm())
            .and_then(|Concavity { corner, .. }| {
                cut_end(&part, *corner).map(|end| split(&part, *corner, end))
            });
        if let Some([one, other]) = cut {
            parts.extend([other, one]);
        } else {
            found.excess = concavity.map_or(found.excess, |c| c.depth.max(found.excess));
            found
                .pieces
                .push(corners.iter().map(|&i| part[i]).collect());
        }
    }
    found
}

/// The polygon without repeated corners.
fn without_repeats(polygon: &[Point]) -> Vec<Point> {
    let mut points = polygon.to_vec();
    points.dedup();
    if points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}

/// Signed area of a polygon by the shoelace formula.
fn area(polygon: &[Point]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    let start = polygon.first().copied().unwrap_or(Point::origin());
    0.5 * polygon
        .iter()
        .zip(next)
        .map(|(a, b)| (a - start).perp(&(b - start)))
        .sum::<f64>()
}

/// Indices of the corners of the convex hull of points, by Andrew's monotone chain.
///
/// They run counter-clockwise from the lowest index, for a simple polygon in the order of the polygon. Points on an edge of the
/// hull are not corners; of equal points only one is a corner.
#[must_use]
pub fn convex_hull(polygon: &[Point]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..polygon.len()).collect();
    order.sort_by(|&i, &j| {
        let (a, b) = (polygon[i], polygon[j]);
        a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
    });
    let chain = |order: &mut dyn Iterator<Item = usize>| {
        let mut chain: Vec<usize> = Vec::new();
        for i in order {
            while let [.., a, b] = chain[..] {
                let (a, b) = (polygon[a], polygon[b]);
                if (b - a).perp(&(polygon[i] - a)) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(i);
        }
        // The other chain begins where this one ends.
        chain.pop();
        chain
    };
    let mut corners = chain(&mut order.iter().copied());
    corners.extend(chain(&mut order.iter().rev().copied()));
    // A simple polygon meets the corners of its hull in its own order.
    if let Some(first) = (0..corners.len()).min_by_key(|&k| corners[k]) {
        corners.rotate_left(first);
    }
    corners
}

/// Deepest corner of a polygon below its hull.
struct Concavity {
    /// Index of the corner.
    corner: usize,
    /// Its distance from the hull, mm.
    depth: f64,
}

/// The deepest corner of a polygon below its hull.
fn deepest(polygon: &[Point], corners: &[usize]) -> Option<Concavity> {
    let n = polygon.len();
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .flat_map(|(&i, &j)| {
            let (a, b) = (polygon[i], polygon[j]);
            let along = (b - a).normalize();
            let count = (j + n - i) % n;
            (1..count).map(move |k| {
                let corner = (i + k) % n;
                Concavity {
                    corner,
                    depth: along.perp(&(polygon[corner] - a)),
                }
            })
        })
        .max_by(|a, b| a.depth.total_cmp(&b.depth))
}

/// Index of the corner at the other end of a cut from the deepest vertex of a concavity: the second contact point of
/// the maximum inscribed circle that touches at that vertex.
fn cut_end(polygon: &[Point], bottom: usize) -> Option<usize> {
    let n = polygon.len();
    let at = polygon[bottom];
    let (before, after) = (polygon[(bottom + n - 1) % n], polygon[(bottom + 1) % n]);
    let along = (after - at).normalize() + (at - before).normalize();
    let inwards = Vector::new(-along.y, along.x);
    let mut ends: Vec<(f64, usize)> = (2..n - 1)
        .map(|k| (bottom + k) % n)
        .filter_map(|k| {
            let to = polygon[k] - at;
            let ahead = inwards.dot(&to);
            (ahead > 0.0).then(|| (to.norm_squared() / ahead, k))
        })
        .collect();
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    ends.into_iter()
        .map(|(_, end)| end)
        .find(|&end| is_free(polygon, bottom, end))
}

/// Whether the straight line between two corners meets no edge except those that end there.
fn is_free(polygon: &[Point], from: usize, to: usize) -> bool {
    crate::checkpoint();
    let n = polygon.len();
    let (a, b) = (polygon[from], polygon[to]);
    (0..n).all(|i| {
        let j = (i + 1) % n;
        if [i, j].iter().any(|k| *k == from || *k == to) {
            return true;
        }
        let (c, d) = (polygon[i], polygon[j]);
        let apart = |a: Point, b: Point, c: Point, d: Point| {
            (b - a).perp(&(c - a)) * (b - a).perp(&(d - a)) > 0.0
        };
        apart(a, b, c, d) || apart(c, d, a, b)
    })
}

/// The two parts of a polygon on either side of a cut between two corners.
fn split(polygon: &[Point], from: usize, to: usize) -> [Vec<Point>; 2] {
    let n = polygon.len();
    let walk = |from: usize, to: usize| {
        let count = (to + n - from) % n;
        (0..=count).map(|k| polygon[(from + k) % n]).collect()
    };
    [walk(from, to), walk(to, from)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    fn is_convex(piece: &[Point]) -> bool {
        let n = piece.len();
        (0..n).all(|i| {
            let (a, b, c) = (piece[i], piece[(i + 1) % n], piece[(i + 2) % n]);
            (b - a).perp(&(c - b)) > 0.0
        })
    }

    /// A post between two concave sides of the radius 10, `waist` wide where it is thinnest and 8 high.
    fn post(waist: f64) -> Vec<Point> {
        let angle = (0.4_f64).asin();
        let side = |k: u32| angle * (f64::from(k) / 50.0 - 1.0);
        let right = (0..=100).map(|k| {
            let (sin, cos) = side(k).sin_cos();
            Point::new(0.5 * waist + 10.0 - 10.0 * cos, 10.0 * sin)
        });
        let left = (0..=100).map(|k| {
            let (sin, cos) = side(k).sin_cos();
            Point::new(-0.5 * waist - 10.0 + 10.0 * cos, -10.0 * sin)
        });
        right.chain(left).collect()
    }

    #[test]
    fn what_is_convex_stays_in_one_piece() {
        let ring: Vec<Point> = (0..40)
            .map(|k| TAU * f64::from(k) / 40.0)
            .map(|t| Point::new(3.0 * t.cos(), t.sin()))
            .collect();
        let whole = convex_pieces(&ring, tolerance(1e-6));
        assert_eq!(whole.pieces.len(), 1);
        assert_eq!(whole.pieces[0].len(), 40);
        assert!(whole.excess < 1e-15);
    }

    #[test]
    fn pieces_are_convex_cover_the_region_and_exceed_it_by_no_more_than_the_tolerance() {
        let post = post(1.0);
        let exact = area(&post);
        for (mm, most) in [(1.0, 1), (0.3, 2), (0.1, 4), (0.01, 16), (0.001, 64)] {
            let cut = convex_pieces(&post, tolerance(mm));
            assert!(cut.pieces.iter().all(|piece| is_convex(piece)), "{mm}");
            assert!(cut.excess <= mm, "{mm}: {}", cut.excess);
            assert!(cut.pieces.len() <= most, "{mm}: {}", cut.pieces.len());
            // Cuts share their line: the surplus over the region is a strip of
            // at most two thirds of the excess along each side.
            let sum: f64 = cut.pieces.iter().map(|piece| area(piece)).sum();
            assert!(sum >= exact - 1e-9, "{mm}: {sum} < {exact}");
            assert!(
                sum - exact <= 0.67 * cut.excess * 18.0 + 1e-9,
                "{mm}: {sum}"
            );
        }
    }

    #[test]
    fn a_corner_that_is_not_smooth_is_cut_across_too() {
        // An L: one cut from its inner corner.
        let p = Point::new;
        let angle = [
            p(0.0, 0.0),
            p(3.0, 0.0),
            p(3.0, 1.0),
            p(1.0, 1.0),
            p(1.0, 3.0),
            p(0.0, 3.0),
        ];
        let cut = convex_pieces(&angle, tolerance(1e-3));
        assert_eq!(cut.pieces.len(), 2);
        let sum: f64 = cut.pieces.iter().map(|piece| area(piece)).sum();
        assert!((sum - 5.0).abs() < 1e-12 && cut.excess < 1e-12);
    }

    #[test]
    fn a_star_of_many_concavities_comes_apart() {
        let star: Vec<Point> = (0..14)
            .map(|k| (PI * f64::from(k) / 7.0, if k % 2 == 0 { 5.0 } else { 2.0 }))
            .map(|(t, r)| Point::new(r * t.cos(), r * t.sin()))
            .collect();
        let cut = convex_pieces(&star, tolerance(1e-6));
        let sum: f64 = cut.pieces.iter().map(|piece| area(piece)).sum();
        assert!((sum - area(&star)).abs() < 1e-12, "{sum}");
        assert!(cut.excess < 1e-12);
        assert!((3..=15).contains(&cut.pieces.len()), "{}", cut.pieces.len());
    }

    #[test]
    fn a_polygon_that_cannot_be_cut_reports_its_excess_and_an_empty_one_has_no_pieces() {
        for nothing in [
            &[][..],
            &[Point::origin()],
            &[Point::origin(), Point::new(1.0, 0.0)],
        ] {
            let cut = convex_pieces(nothing, tolerance(1e-3));
            assert!(cut.pieces.is_empty() && cut.excess == 0.0);
        }
        let p = Point::new;
        // Crossing itself: whatever comes out is convex and bounded.
        let bow = [p(0.0, 0.0), p(4.0, 0.0), p(1.0, 2.0), p(3.0, 2.0)];
        let cut = convex_pieces(&bow, tolerance(1e-3));
        assert!(cut.pieces.iter().all(|piece| is_convex(piece)));
    }
}
