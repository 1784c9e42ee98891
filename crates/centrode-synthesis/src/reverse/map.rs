use centrode_geometry::{Point, checkpoint};

use super::sharpness::leg;
use super::{AxisFault, RequiredPath, TwoBar};

/// Share of the path's box by which a search for axes goes beyond it on every side.
const MARGIN: f64 = 0.25;
/// Axes along each side of the grid of a search.
const GRID: u32 = 33;
/// Halvings of the grid's step around the best axis, and number of axes tried on each side of it each time.
const HALVINGS: u32 = 24;
const BESIDE: i32 = 2;

/// Grid of positions tried as the carrier's axis; the limits of x and y belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisRange {
    /// Minimum and maximum x, mm.
    pub x: [f64; 2],
    /// Minimum and maximum y, mm.
    pub y: [f64; 2],
    /// Number of axes along x and along y.
    pub count: [u32; 2],
}

/// Possible axes of a carrier over a grid.
#[derive(Clone, Debug)]
pub struct AxisMap {
    range: AxisRange,
    /// Row by row, x first.
    found: Vec<Result<PossibleAxis, AxisFault>>,
}

/// Figures of the chain of a possible axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PossibleAxis {
    /// Length of the carrier, mm.
    pub carrier: f64,
    /// Length of the arm, mm.
    pub arm: f64,
    /// Minimum and maximum ratio of the total law.
    pub ratios: [f64; 2],
    /// Minimum distance of the tip from the carrier's axis, mm.
    pub shaft_distance: f64,
    /// Maximum curvature of the four pitch curves of the split by powers, as a multiple of one over the centre distance.
    ///
    /// Averaged over a 180th of a turn, as in the gears that are written: mostly within 5 % of their value, up to 40 % below it
    /// if the law has a narrow peak. Of a path with more than 64 pieces at most 64 are sampled, evenly spread.
    pub sharpness: f64,
}

impl PossibleAxis {
    /// Maximum |ln| of the ratio: zero for even motion.
    #[must_use]
    pub fn unevenness(&self) -> f64 {
        self.ratios[1].ln().max(-self.ratios[0].ln())
    }

    /// Minimum radius of curvature of the four pitch curves of the split by powers where they are convex, mm; `bend` is the angle
    /// from the carrier's first leg to its second, rad.
    #[must_use]
    pub fn minimum_radius(&self, bend: f64) -> f64 {
        leg(self.carrier, bend) / self.sharpness
    }
}

impl From<&TwoBar> for PossibleAxis {
    fn from(chain: &TwoBar) -> Self {
        Self {
            carrier: chain.carrier(),
            arm: chain.arm(),
            ratios: chain.ratios().map(|ratio| ratio.value),
            shaft_distance: chain.shaft_distance(),
            sharpness: chain.sharpness_sampled(),
        }
    }
}

impl AxisRange {
    /// Grid over the path's box and a quarter of its size round it.
    #[must_use]
    pub fn about(path: &RequiredPath) -> Self {
        let bounds = path.bounds();
        let size = (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y);
        let margin = MARGIN * size;
        Self {
            x: [bounds.min.x - margin, bounds.max.x + margin],
            y: [bounds.min.y - margin, bounds.max.y + margin],
            count: [GRID; 2],
        }
    }

    /// Grid over the box of two corners, mm.
    #[must_use]
    pub fn between([[x, y], [u, v]]: [[f64; 2]; 2]) -> Self {
        Self {
            x: [x.min(u), x.max(u)],
            y: [y.min(v), y.max(v)],
            count: [GRID; 2],
        }
    }

    /// Axis by its number along x and along y.
    #[must_use]
    pub fn axis(&self, i: u32, j: u32) -> Point {
        let place = |[from, to]: [f64; 2], count: u32, i: u32| {
            let steps = f64::from(count.saturating_sub(1).max(1));
            from + (to - from) * f64::from(i) / steps
        };
        Point::new(
            place(self.x, self.count[0], i),
            place(self.y, self.count[1], j),
        )
    }

    fn holds(&self, at: Point) -> bool {
        let is_in = |[from, to]: [f64; 2], x: f64| (from.min(to)..=from.max(to)).contains(&x);
        is_in(self.x, at.x) && is_in(self.y, at.y)
    }

    fn step(&self) -> [f64; 2] {
        let [a, b] = [self.axis(0, 0), self.axis(1, 1)];
        [b.x - a.x, b.y - a.y]
    }
}

impl AxisMap {
    /// Tries every axis of a grid; if the sense of the carrier is free, the gentler one is used.
    #[must_use]
    pub fn new(path: &RequiredPath, range: AxisRange) -> Self {
        let [columns, rows] = range.count;
        let one = |n: u64| {
            checkpoint();
            let (i, j) = (n % u64::from(columns), n / u64::from(columns));
            let axis = range.axis(i as u32, j as u32);
            TwoBar::new(path, axis, None).map(|chain| PossibleAxis::from(&chain))
        };
        let found = (0..u64::from(columns) * u64::from(rows)).map(one).collect();
        Self { range, found }
    }

    /// The grid.
    #[must_use]
    pub fn range(&self) -> &AxisRange {
        &self.range
    }

    /// Axes row by row from the minimum y, each row from the minimum x: figures, or the reason why there is no machine.
    pub fn found(&self) -> &[Result<PossibleAxis, AxisFault>] {
        &self.found
    }

    /// Number of possible axes.
    #[must_use]
    pub fn possible(&self) -> usize {
        self.found.iter().filter(|found| found.is_ok()).count()
    }

    /// The axis of the grid whose gears have the minimum curvature: the one with the maximum
    /// [`minimum_radius`](PossibleAxis::minimum_radius); `None` if no axis is possible.
    #[must_use]
    pub fn bluntest(&self, bend: f64) -> Option<Point> {
        self.minimum(|axis| -axis.minimum_radius(bend))
    }

    /// The possible axis of the grid with the minimum value of a measure.
    fn minimum(&self, measure: impl Fn(&PossibleAxis) -> f64) -> Option<Point> {
        let possible = self.found.iter().enumerate();
        let possible = possible.filter_map(|(n, found)| Some((n, measure(found.as_ref().ok()?))));
        let (n, _) = possible.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let columns = self.range.count[0] as usize;
        Some(self.range.axis((n % columns) as u32, (n / columns) as u32))
    }

    /// The gentlest axis: that of the smallest maximum |ln| of the ratio, refined from the best of the grid by finer and finer
    /// grids around it, within the bounds of the grid; `None` if no axis of the grid is possible.
    #[must_use]
    pub fn mildest(&self, path: &RequiredPath) -> Option<TwoBar> {
        let axis = self.minimum(PossibleAxis::unevenness)?;
        let mut best = TwoBar::new(path, axis, None).ok()?;
        let mut step = self.range.step();
        for _ in 0..HALVINGS {
            step = step.map(|step| 0.5 * step);
            let middle = best.axis();
            for i in -BESIDE..=BESIDE {
                for j in -BESIDE..=BESIDE {
                    checkpoint();
                    let x = middle.x + f64::from(i) * step[0];
                    let axis = Point::new(x, middle.y + f64::from(j) * step[1]);
                    if !self.range.holds(axis) {
                        continue;
                    }
                    let Ok(chain) = TwoBar::new(path, axis, None) else {
                        continue;
                    };
                    if chain.unevenness() < best.unevenness() {
                        best = chain;
                    }
                }
            }
        }
        Some(best)
    }
}
