use crate::model::Convex;
use centrode_geometry::{Point, Tolerance, Vector};
use centrode_mechanism::gear::{Gear, Role};
use std::collections::BTreeMap;

/// A tooth to touch with.
pub(super) struct ToothBody {
    pub(super) body: Convex,
    /// How deep the tooth's contour lies inside the body, mm: more than nothing where a flank is hollow.
    pub(super) hollow: f64,
}

/// The teeth of a gear as convex bodies, each the hull of a tooth's flanks and tip over the gear's width.
///
/// Fillets and roots are left out: a convex body would bridge their hollow, where the mate's tips run.
pub(super) fn all(gear: &Gear, tolerance: Tolerance) -> Vec<ToothBody> {
    let samples = gear.outline().samples(tolerance);
    let mut teeth: BTreeMap<u32, Vec<Point>> = BTreeMap::new();
    for (i, sample) in samples.iter().enumerate() {
        let (role, owner) = (
            gear.roles().get(sample.segment),
            gear.owners().get(sample.segment),
        );
        if let (Some(Role::Flank | Role::Tip), Some(&tooth)) = (role, owner) {
            // The next sample ends this piece of the flank, whatever begins there.
            let end = &samples[(i + 1) % samples.len()];
            teeth
                .entry(tooth)
                .or_default()
                .extend([sample.point, end.point]);
        }
    }
    let width = gear.body().width;
    let sections = teeth.into_iter().filter_map(|(tooth, points)| {
        let section = hull(points.clone());
        (section.len() >= 3).then(|| (tooth, depth(&section, &points), section))
    });
    sections
        .map(|(tooth, hollow, section)| ToothBody {
            body: Convex {
                name: format!("{}_tooth_{tooth}", gear.member().name()),
                vertices: [0.0, width]
                    .into_iter()
                    .flat_map(|z| section.iter().map(move |p| [p.x, p.y, z]))
                    .collect(),
            },
            hollow,
        })
        .collect()
}

/// How far the innermost of some points lies inside a convex polygon.
fn depth(corners: &[Point], points: &[Point]) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edges: Vec<(Point, Vector)> = corners
        .iter()
        .zip(next)
        .map(|(&a, &b)| (a, (b - a).normalize()))
        .collect();
    let inside = |p: &Point| {
        edges
            .iter()
            .map(|(a, along)| along.perp(&(p - a)))
            .fold(f64::INFINITY, f64::min)
    };
    points.iter().map(inside).fold(0.0, f64::max)
}

/// Corners of the convex hull, counter-clockwise, by the monotone chain.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for &p in points {
            while let [.., a, b] = chain[..] {
                if (b - a).perp(&(p - b)) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(p);
        }
        // The other chain begins where this one ends.
        chain.pop();
        chain
    };
    let mut corners = chain(&mut points.iter());
    corners.extend(chain(&mut points.iter().rev()));
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hull_keeps_the_corners_only() {
        let p = Point::new;
        let square = [p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)];
        let inside = [p(1.0, 1.0), p(1.0, 0.0), p(2.0, 2.0), p(0.5, 1.5)];
        assert_eq!(hull([inside, square].concat()), square);
    }

    #[test]
    fn depth_is_that_of_the_innermost_point() {
        let p = Point::new;
        let square = [p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0)];
        assert!((depth(&square, &[p(0.0, 1.0), p(3.5, 2.0)]) - 0.5).abs() < 1e-15);
        assert!(depth(&square, &square).abs() < 1e-15);
    }
}
