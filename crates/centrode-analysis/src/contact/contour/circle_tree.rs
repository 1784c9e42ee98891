//! Circles around groups of neighbouring parts of a contour, halved down to the single parts. They show which parts can be near
//! something without a test of every part.

use centrode_geometry::{Bounds, Point, Vector};

/// Group of neighbouring parts with a circle around them.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct PartGroup {
    pub(in crate::contact) center: Point,
    pub(in crate::contact) radius: f64,
    /// First part.
    first: u32,
    /// Number of parts.
    count: u32,
    /// Index in the tree.
    at: u32,
}

impl PartGroup {
    /// The part, if the group has one part only.
    pub(super) fn single(&self) -> Option<usize> {
        (self.count == 1).then_some(self.first())
    }

    pub(in crate::contact) fn first(&self) -> usize {
        self.first as usize
    }

    pub(in crate::contact) fn last(&self) -> usize {
        (self.first + self.count - 1) as usize
    }
}

/// All groups of a contour. Each is followed by those of its first half, then by those of its second half.
#[derive(Debug)]
pub(in crate::contact) struct CircleTree {
    groups: Vec<PartGroup>,
}

impl CircleTree {
    /// Tree over the circles around the parts, in the contour's order.
    pub(in crate::contact) fn new(circles: &[(Point, f64)]) -> Self {
        let mut tree = Self {
            groups: Vec::with_capacity(2 * circles.len()),
        };
        if !circles.is_empty() {
            tree.add_group(circles, 0);
        }
        tree
    }

    fn add_group(&mut self, circles: &[(Point, f64)], first: usize) {
        let (center, radius) = enclosing_circle(circles);
        self.groups.push(PartGroup {
            center,
            radius,
            first: first as u32,
            count: circles.len() as u32,
            at: self.groups.len() as u32,
        });
        if circles.len() > 1 {
            let middle = half(circles.len() as u32) as usize;
            self.add_group(&circles[..middle], first);
            self.add_group(&circles[middle..], first + middle);
        }
    }

    /// The group of all parts.
    pub(in crate::contact) fn root(&self) -> Option<PartGroup> {
        self.groups.first().copied()
    }

    /// Both halves of a group of more than one part.
    pub(super) fn halves(&self, group: &PartGroup) -> [PartGroup; 2] {
        [group.at + 1, group.at + 2 * half(group.count)].map(|at| self.groups[at as usize])
    }

    /// Whether any part passes both tests: `may` for all groups that contain it, then `passes`.
    pub(in crate::contact) fn any(
        &self,
        may: &impl Fn(&PartGroup) -> bool,
        passes: &mut impl FnMut(usize) -> bool,
    ) -> bool {
        self.root()
            .is_some_and(|group| self.any_in(&group, may, passes))
    }

    fn any_in(
        &self,
        group: &PartGroup,
        may: &impl Fn(&PartGroup) -> bool,
        passes: &mut impl FnMut(usize) -> bool,
    ) -> bool {
        may(group)
            && match group.single() {
                Some(part) => passes(part),
                None => {
                    let [one, other] = self.halves(group);
                    self.any_in(&one, may, passes) || self.any_in(&other, may, passes)
                }
            }
    }

    /// Calls `found` with every part whose groups all pass a test.
    pub(in crate::contact) fn each(
        &self,
        may: &impl Fn(&PartGroup) -> bool,
        mut found: impl FnMut(usize),
    ) {
        self.any(may, &mut |part| {
            found(part);
            false
        });
    }

    /// Maximum depth of a part's circle inside a given circle, mm; zero if no part lies inside.
    pub(in crate::contact) fn deepest(&self, center: &Point, radius: f64) -> f64 {
        let mut deepest = 0.0;
        if let Some(root) = self.root() {
            self.deepest_in(&root, center, radius, &mut deepest);
        }
        deepest
    }

    fn deepest_in(&self, group: &PartGroup, center: &Point, radius: f64, deepest: &mut f64) {
        let inside = radius - (group.center - center).norm();
        if group.single().is_some() {
            *deepest = deepest.max(inside - group.radius);
        } else if inside + group.radius > *deepest {
            for half in self.halves(group) {
                self.deepest_in(&half, center, radius, deepest);
            }
        }
    }
}

fn half(count: u32) -> u32 {
    count.div_ceil(2)
}

/// Circle around circles. Its centre is the centre of the bounding box of their centres.
fn enclosing_circle(circles: &[(Point, f64)]) -> (Point, f64) {
    if let [one] = circles {
        return *one;
    }
    let center = circles.iter().map(|c| c.0).collect::<Bounds>().center();
    let reach = circles.iter().map(|(c, r)| (c - center).norm() + r);
    (
        center,
        reach.fold(0.0, f64::max) * (1.0 + 4.0 * f64::EPSILON),
    )
}

/// Group of the driver's parts with its circle in the driven gear's axes.
#[derive(Clone, Copy, Debug)]
struct PosedGroup {
    center: Vector,
    /// Distance from the centre within which a part counts as near, mm.
    reach: f64,
    first: u32,
    count: u32,
    at: u32,
}

/// Search for the parts of two contours that are near each other.
pub(super) struct NearSearch<'a, F, R> {
    pub(in crate::contact) driver: &'a CircleTree,
    pub(in crate::contact) driven: &'a CircleTree,
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

    fn posed(&self, group: &PartGroup) -> PosedGroup {
        PosedGroup {
            center: (self.point_to_driven)(&group.center).coords,
            reach: (self.reach)(&group.center, group.radius),
            first: group.first,
            count: group.count,
            at: group.at,
        }
    }

    /// Pairs of a group of the driven gear and the driver's groups from index `from` on.
    fn pairs_with(
        &self,
        b: &PartGroup,
        from: usize,
        groups: &mut Vec<PosedGroup>,
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
                    found(a.first as usize, j);
                }
            } else {
                for half in self.driven.halves(b) {
                    self.pairs_with(&half, start, groups, found);
                }
            }
        }
        groups.truncate(start);
    }

    /// Adds the parts of a driver's group that are near a group of the driven gear, in groups no longer than that one.
    fn split_near(&self, a: &PosedGroup, b: &PartGroup, out: &mut Vec<PosedGroup>) {
        if (a.center - b.center.coords).norm_squared() >= (b.radius + a.reach).powi(2) {
            return;
        }
        if a.count == 1 || (b.count > 1 && a.count <= b.count) {
            out.push(*a);
        } else {
            for at in [a.at + 1, a.at + 2 * half(a.count)] {
                self.split_near(&self.posed(&self.driver.groups[at as usize]), b, out);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Circles around the sides of a closed polygon of `count` corners with teeth on it.
    fn ring(count: usize, radius: f64) -> Vec<(Point, f64)> {
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            let r = radius + if k % 4 < 2 { 1.0 } else { -1.0 };
            Point::new(r * angle.cos(), r * angle.sin())
        };
        (0..count)
            .map(|k| {
                let (p, q) = (corner(k), corner((k + 1) % count));
                (nalgebra::center(&p, &q), 0.5 * (q - p).norm())
            })
            .collect()
    }

    #[test]
    fn the_pairs_of_two_trees_are_all_there_are_in_the_order_of_the_second() {
        for (first, second) in [(1, 7), (40, 61), (400, 128)] {
            let (a, b) = (ring(first, 20.0), ring(second, 31.0));
            for (x, near) in [(50.0, 0.3), (49.0, 3.0), (60.0, 1.0), (20.0, 0.1)] {
                let point_to_driven = |p: &Point| p + Vector::new(x, 0.4);
                let (one, other) = (CircleTree::new(&a), CircleTree::new(&b));
                let search = NearSearch {
                    driver: &one,
                    driven: &other,
                    reach: |_: &Point, radius: f64| radius + near,
                    point_to_driven,
                };
                let mut found = Vec::new();
                search.pairs(|i, j| found.push((i, j)));
                let mut expected = Vec::new();
                for (j, (center, radius)) in b.iter().enumerate() {
                    for (i, (mate, reach)) in a.iter().enumerate() {
                        if (point_to_driven(mate) - center).norm() < radius + reach + near {
                            expected.push((i, j));
                        }
                    }
                }
                assert_eq!(found, expected, "{first} {second} {x} {near}");
                let inside = |(c, r): &(Point, f64)| 28.0 - point_to_driven(c).coords.norm() - r;
                let deepest = a.iter().map(inside).fold(0.0, f64::max);
                let center = Point::new(-x, -0.4);
                assert!((one.deepest(&center, 28.0) - deepest).abs() < 1e-12);
            }
        }
    }
}
