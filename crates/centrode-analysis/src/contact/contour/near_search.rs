//! Searches in the trees of discs around the parts of a contour: pairs near each other, and the deepest part in a circle.

use centrode_geometry::{BoundTree, Disc, Point, Run, Vector};

/// Maximum depth of a part's disc inside a circle, mm; zero if no part lies inside.
pub(in crate::contact) fn deepest(tree: &BoundTree<Disc>, center: &Point, radius: f64) -> f64 {
    let mut deepest = 0.0;
    let mut pending: Vec<Run<Disc>> = tree.root().into_iter().collect();
    while let Some(group) = pending.pop() {
        let inside = radius - (group.bound.center - center).norm();
        if group.single().is_some() {
            deepest = f64::max(deepest, inside - group.bound.radius);
        } else if inside + group.bound.radius > deepest {
            pending.extend(tree.halves(&group));
        }
    }
    deepest
}

/// Circle around a group of the driver's parts in the driven gear's axes.
#[derive(Clone, Copy, Debug)]
struct PosedCircle {
    center: Vector,
    /// Distance from the centre within which a part counts as near, mm.
    reach: f64,
}

/// Search for the parts of two contours that are near each other.
pub(super) struct NearSearch<'a, F, R> {
    pub(in crate::contact) driver: &'a BoundTree<Disc>,
    pub(in crate::contact) driven: &'a BoundTree<Disc>,
    /// Distance within which a part counts as near, mm, as a function of centre and radius of a driver's circle. For a circle
    /// inside another it does not exceed that of the outer one.
    pub(in crate::contact) reach: R,
    /// Maps a point of the driver to the driven gear's axes.
    pub(in crate::contact) point_to_driven: F,
}

impl<F: Fn(&Point) -> Point, R: Fn(&Point, f64) -> f64> NearSearch<'_, F, R> {
    /// Calls `found` with every pair of parts (driver, driven gear) whose circles are near each other, in the order of the driven
    /// gear's parts.
    pub(in crate::contact) fn pairs(&self, mut found: impl FnMut(usize, usize)) {
        if let (Some(a), Some(b)) = (self.driver.root(), self.driven.root()) {
            let mut groups = Vec::with_capacity(256);
            groups.push(self.posed(&a));
            self.pairs_with(&b, 0, &mut groups, &mut found);
        }
    }

    fn posed(&self, group: &Run<Disc>) -> Run<PosedCircle> {
        let Disc { center, radius } = group.bound;
        group.with_bound(PosedCircle {
            center: (self.point_to_driven)(&center).coords,
            reach: (self.reach)(&center, radius),
        })
    }

    /// Pairs of a group of the driven gear and the driver's groups from index `from` on.
    fn pairs_with(
        &self,
        b: &Run<Disc>,
        from: usize,
        groups: &mut Vec<Run<PosedCircle>>,
        found: &mut impl FnMut(usize, usize),
    ) {
        let start = groups.len();
        for k in from..start {
            let a = groups[k];
            self.split_near(&a, b, groups);
        }
        if groups.len() > start {
            if let Some(j) = b.single() {
                for a in &groups[start..] {
                    found(a.first(), j);
                }
            } else {
                for half in self.driven.halves(b) {
                    self.pairs_with(&half, start, groups, found);
                }
            }
        }
        groups.truncate(start);
    }

    /// Adds the parts of a driver's group that are near a group of the driven gear, in groups with no more parts than that
    /// one.
    fn split_near(&self, a: &Run<PosedCircle>, b: &Run<Disc>, out: &mut Vec<Run<PosedCircle>>) {
        let (circle, disc) = (&a.bound, &b.bound);
        if (circle.center - disc.center.coords).norm_squared()
            >= (disc.radius + circle.reach).powi(2)
        {
            return;
        }
        if a.count() == 1 || (b.count() > 1 && a.count() <= b.count()) {
            out.push(*a);
        } else {
            for half in self.driver.halves(a) {
                self.split_near(&self.posed(&half), b, out);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Circles around the sides of a closed polygon of `count` corners with teeth on it.
    fn ring(count: usize, radius: f64) -> Vec<Disc> {
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let r = radius + if k % 4 < 2 { 1.0 } else { -1.0 };
            Point::new(r * angle.cos(), r * angle.sin())
        };
        (0..count)
            .map(|k| {
                let (p, q) = (corner(k), corner((k + 1) % count));
                Disc {
                    center: nalgebra::center(&p, &q),
                    radius: 0.5 * (q - p).norm(),
                }
            })
            .collect()
    }

    #[test]
    fn the_pairs_of_two_trees_are_all_there_are_in_the_order_of_the_second() {
        for (first, second) in [(1, 7), (40, 61), (400, 128)] {
            let (a, b) = (ring(first, 20.0), ring(second, 31.0));
            for (x, near) in [(50.0, 0.3), (49.0, 3.0), (60.0, 1.0), (20.0, 0.1)] {
                let point_to_driven = |p: &Point| p + Vector::new(x, 0.4);
                let (one, other) = (
                    BoundTree::new(&a, Disc::around_discs),
                    BoundTree::new(&b, Disc::around_discs),
                );
                let search = NearSearch {
                    driver: &one,
                    driven: &other,
                    reach: |_: &Point, radius: f64| radius + near,
                    point_to_driven,
                };
                let mut found = Vec::new();
                search.pairs(|i, j| found.push((i, j)));
                let mut expected = Vec::new();
                for (j, Disc { center, radius }) in b.iter().enumerate() {
                    for (
                        i,
                        Disc {
                            center: mate,
                            radius: reach,
                        },
                    ) in a.iter().enumerate()
                    {
                        if (point_to_driven(mate) - center).norm() < radius + reach + near {
                            expected.push((i, j));
                        }
                    }
                }
                assert_eq!(found, expected, "{first} {second} {x} {near}");
                let inside = |d: &Disc| 28.0 - point_to_driven(&d.center).coords.norm() - d.radius;
                let deepest = a.iter().map(inside).fold(0.0, f64::max);
                let center = Point::new(-x, -0.4);
                assert!((super::deepest(&one, &center, 28.0) - deepest).abs() < 1e-12);
            }
        }
    }
}
