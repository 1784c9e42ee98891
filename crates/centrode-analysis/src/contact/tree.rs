//! Circles around runs of neighbouring parts of a contour, halved down to the single parts: they tell what of a contour
//! may be near something without looking at all of it.

use centrode_geometry::{Bounds, Point, Vector};

/// Run of neighbouring parts with a circle around them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) center: Point,
    pub(super) radius: f64,
    /// First part.
    first: u32,
    /// Number of parts.
    count: u32,
    /// Index in the tree.
    at: u32,
}

impl Run {
    /// The part, where the run is no more than one.
    pub(super) fn single(&self) -> Option<usize> {
        (self.count == 1).then_some(self.first())
    }

    pub(super) fn first(&self) -> usize {
        self.first as usize
    }

    pub(super) fn last(&self) -> usize {
        (self.first + self.count - 1) as usize
    }
}

/// All runs of a contour; each is followed by those of its first half, then by those of its second.
#[derive(Debug)]
pub(super) struct Tree {
    runs: Vec<Run>,
}

impl Tree {
    /// Tree over the circles around the parts, in the contour's order.
    pub(super) fn new(circles: &[(Point, f64)]) -> Self {
        let mut tree = Self {
            runs: Vec::with_capacity(2 * circles.len()),
        };
        if !circles.is_empty() {
            tree.grow(circles, 0);
        }
        tree
    }

    fn grow(&mut self, circles: &[(Point, f64)], first: usize) {
        let (center, radius) = around(circles);
        self.runs.push(Run {
            center,
            radius,
            first: first as u32,
            count: circles.len() as u32,
            at: self.runs.len() as u32,
        });
        if circles.len() > 1 {
            let middle = half(circles.len() as u32) as usize;
            self.grow(&circles[..middle], first);
            self.grow(&circles[middle..], first + middle);
        }
    }

    /// The run of all parts.
    pub(super) fn root(&self) -> Option<Run> {
        self.runs.first().copied()
    }

    /// Both halves of a run of more than one part.
    pub(super) fn halves(&self, run: &Run) -> [Run; 2] {
        [run.at + 1, run.at + 2 * half(run.count)].map(|at| self.runs[at as usize])
    }

    /// Whether a part is found that passes both tests, looked for only in runs that pass the first.
    pub(super) fn any(
        &self,
        may: &impl Fn(&Run) -> bool,
        passes: &mut impl FnMut(usize) -> bool,
    ) -> bool {
        self.root()
            .is_some_and(|run| self.any_in(&run, may, passes))
    }

    fn any_in(
        &self,
        run: &Run,
        may: &impl Fn(&Run) -> bool,
        passes: &mut impl FnMut(usize) -> bool,
    ) -> bool {
        may(run)
            && match run.single() {
                Some(part) => passes(part),
                None => {
                    let [one, other] = self.halves(run);
                    self.any_in(&one, may, passes) || self.any_in(&other, may, passes)
                }
            }
    }

    /// Every part found in runs that pass a test.
    pub(super) fn each(&self, may: &impl Fn(&Run) -> bool, mut found: impl FnMut(usize)) {
        self.any(may, &mut |part| {
            found(part);
            false
        });
    }

    /// Depth to which the circle around some part lies within a circle; zero where none does.
    pub(super) fn deepest(&self, center: &Point, radius: f64) -> f64 {
        let mut deepest = 0.0;
        if let Some(root) = self.root() {
            self.deepest_in(&root, center, radius, &mut deepest);
        }
        deepest
    }

    fn deepest_in(&self, run: &Run, center: &Point, radius: f64, deepest: &mut f64) {
        let inside = radius - (run.center - center).norm();
        if run.single().is_some() {
            *deepest = deepest.max(inside - run.radius);
        } else if inside + run.radius > *deepest {
            for half in self.halves(run) {
                self.deepest_in(&half, center, radius, deepest);
            }
        }
    }
}

fn half(count: u32) -> u32 {
    count.div_ceil(2)
}

/// Circle around circles, about the middle of their centres' box.
fn around(circles: &[(Point, f64)]) -> (Point, f64) {
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

/// Run of the driver with its circle in the driven gear's axes.
#[derive(Clone, Copy, Debug)]
struct Posed {
    center: Vector,
    /// Radius, and the distance within which something is near.
    reach: f64,
    first: u32,
    count: u32,
    at: u32,
}

/// Search for the parts of two contours that are near each other.
pub(super) struct Near<'a, F, R> {
    pub(super) driver: &'a Tree,
    pub(super) driven: &'a Tree,
    /// Distance from the centre of a driver's circle, by its radius, within which something is near; no circle within another
    /// reaches beyond the outer one.
    pub(super) reach: R,
    /// Point of the driver in the driven gear's axes.
    pub(super) place: F,
}

impl<F: Fn(&Point) -> Point, R: Fn(&Point, f64) -> f64> Near<'_, F, R> {
    /// Every pair of parts, of driver and driven gear, whose circles are near each other, in the order of the driven
    /// gear's parts.
    pub(super) fn pairs(&self, mut found: impl FnMut(usize, usize)) {
        if let (Some(a), Some(b)) = (self.driver.root(), self.driven.root()) {
            let mut runs = Vec::with_capacity(256);
            runs.push(self.posed(&a));
            self.meet(&b, 0, &mut runs, &mut found);
        }
    }

    fn posed(&self, run: &Run) -> Posed {
        Posed {
            center: (self.place)(&run.center).coords,
            reach: (self.reach)(&run.center, run.radius),
            first: run.first,
            count: run.count,
            at: run.at,
        }
    }

    /// Pairs of a run of the driven gear and the driver's runs from `from` on.
    fn meet(
        &self,
        b: &Run,
        from: usize,
        runs: &mut Vec<Posed>,
        found: &mut impl FnMut(usize, usize),
    ) {
        let start = runs.len();
        for k in from..start {
            let a = runs[k];
            self.sift(&a, b, runs);
        }
        if runs.len() > start {
            if let Some(j) = b.single() {
                for a in &runs[start..] {
                    found(a.first as usize, j);
                }
            } else {
                for half in self.driven.halves(b) {
                    self.meet(&half, start, runs, found);
                }
            }
        }
        runs.truncate(start);
    }

    /// Adds what of a driver's run is near a run of the driven gear, in runs no longer than that one.
    fn sift(&self, a: &Posed, b: &Run, out: &mut Vec<Posed>) {
        if (a.center - b.center.coords).norm_squared() >= (b.radius + a.reach).powi(2) {
            return;
        }
        if a.count == 1 || (b.count > 1 && a.count <= b.count) {
            out.push(*a);
        } else {
            for at in [a.at + 1, a.at + 2 * half(a.count)] {
                self.sift(&self.posed(&self.driver.runs[at as usize]), b, out);
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
                let place = |p: &Point| p + Vector::new(x, 0.4);
                let (one, other) = (Tree::new(&a), Tree::new(&b));
                let search = Near {
                    driver: &one,
                    driven: &other,
                    reach: |_: &Point, radius: f64| radius + near,
                    place,
                };
                let mut found = Vec::new();
                search.pairs(|i, j| found.push((i, j)));
                let mut expected = Vec::new();
                for (j, (center, radius)) in b.iter().enumerate() {
                    for (i, (mate, reach)) in a.iter().enumerate() {
                        if (place(mate) - center).norm() < radius + reach + near {
                            expected.push((i, j));
                        }
                    }
                }
                assert_eq!(found, expected, "{first} {second} {x} {near}");
                let inside = |(c, r): &(Point, f64)| 28.0 - place(c).coords.norm() - r;
                let deepest = a.iter().map(inside).fold(0.0, f64::max);
                let center = Point::new(-x, -0.4);
                assert!((one.deepest(&center, 28.0) - deepest).abs() < 1e-12);
            }
        }
    }
}
