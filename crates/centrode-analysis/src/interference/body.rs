use centrode_geometry::{BoundTree, Bounds, Disc, Outline, Point, Run, Tolerance, Vector};

use super::parry::Boundary;

/// Shape of a rigid body of the plane, in its own frame.
///
/// Outlines are flattened to closed polygons; the material is what lies inside an odd number of them, so a body may be
/// concave, have holes, or be several pieces that move as one. A tree of circles around the edges skips parts that are far
/// away.
#[derive(Clone, Debug)]
pub struct Body {
    edges: Vec<[Point; 2]>,
    corners: Vec<Point>,
    /// Indices of the edges, neighbours next to each other.
    order: Vec<u32>,
    /// Discs around the edges in that order.
    tree: BoundTree<Disc>,
    flattening: f64,
    boundary: Boundary,
}

/// Relative rounding of a circle's radius and centre. The circle is enlarged by it, so that no crossing is missed.
const ROUNDING: f64 = 1e-14;

/// Reason why outlines make no body.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// No outline has a segment.
    #[error("a body needs at least one outline with a segment")]
    Empty,
    /// A point of an outline is not finite, or its square is not.
    #[error(
        "outline {outline} has a point that is not finite, or whose coordinates are too large to be squared"
    )]
    NotFinite {
        /// Index of the outline.
        outline: usize,
    },
}

impl Body {
    /// Makes the body inside `outlines`, each replaced by a polygon within the tolerance.
    ///
    /// Outlines must not cross one another or themselves. Choose the frame's origin at the body's centre of
    /// rotation: bounds of its movement are then the tightest.
    ///
    /// # Errors
    /// [`BodyError::Empty`] without a segment, [`BodyError::NotFinite`] for points at infinity or NaN.
    pub fn new(outlines: &[Outline], tolerance: Tolerance) -> Result<Self, BodyError> {
        let (mut edges, mut corners) = (Vec::new(), Vec::new());
        let mut straight = true;
        for (index, outline) in outlines.iter().enumerate() {
            // Lengths are computed from squares.
            let finite = |p: Point| p.coords.norm_squared().is_finite();
            let segments = outline.segments();
            let ends = segments.iter().all(|s| {
                let middle = s.at(0.0).point;
                finite(s.start()) && finite(middle) && finite(s.end())
            });
            if !ends {
                return Err(BodyError::NotFinite { outline: index });
            }
            straight &= segments
                .iter()
                .all(|s| matches!(s, centrode_geometry::Segment::Line(..)));
            let points = outline.flatten(tolerance);
            corners.extend(points.first());
            let next = points.iter().cycle().skip(1);
            edges.extend(points.iter().zip(next).map(|(a, b)| [*a, *b]));
        }
        if edges.is_empty() {
            return Err(BodyError::Empty);
        }
        let mut order: Vec<u32> = (0..).take(edges.len()).collect();
        sort(&edges, &mut order);
        let ends = |run: &[u32]| Disc::around(run.iter().flat_map(|&e| edges[e as usize]));
        Ok(Self {
            tree: BoundTree::new(&order, ends),
            boundary: Boundary::new(&edges),
            flattening: if straight { 0.0 } else { tolerance.mm() },
            order,
            edges,
            corners,
        })
    }

    /// Number of corners of the polygons that replace the outlines.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.edges.len()
    }

    /// Maximum distance between the outlines and the polygons that replace them, mm.
    #[must_use]
    pub fn flattening(&self) -> f64 {
        self.flattening
    }

    /// Maximum distance of any point of the body from its frame's origin, mm, or a little more.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let disc = |whole: Run<Disc>| whole.bound.center.coords.norm() + whole.bound.radius;
        self.tree.root().map_or(0.0, disc)
    }

    pub(super) fn edge(&self, index: u32) -> &[Point; 2] {
        &self.edges[index as usize]
    }

    pub(super) fn tree(&self) -> &BoundTree<Disc> {
        &self.tree
    }

    /// Index of the edge of a run of the tree, if it is the only one.
    pub(super) fn single(&self, run: &Run<Disc>) -> Option<u32> {
        run.single().map(|place| self.order[place])
    }

    /// One corner of every outline.
    pub(super) fn corners(&self) -> impl Iterator<Item = Point> + '_ {
        self.corners.iter().copied()
    }

    pub(super) fn boundary(&self) -> &Boundary {
        &self.boundary
    }

    /// Whether a point of the body's frame lies in the material: a ray from it along x crosses an odd number of edges.
    pub(super) fn contains(&self, p: Point) -> bool {
        let whole = self.tree.root();
        whole.is_some_and(|run| self.crossings(&run, p) % 2 == 1)
    }

    /// Edges of a run that a ray from a point along x crosses.
    fn crossings(&self, run: &Run<Disc>, p: Point) -> usize {
        let Disc { center, radius } = run.bound;
        // A margin for the rounding of the circle.
        let reach = radius + ROUNDING * (radius + center.x.abs() + center.y.abs());
        if (p.y - center.y).abs() > reach || p.x > center.x + reach {
            return 0;
        }
        if let Some(e) = self.single(run) {
            let [a, b] = self.edge(e);
            let crosses =
                (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
            usize::from(crosses)
        } else {
            let halves = self.tree.halves(run);
            halves.iter().map(|half| self.crossings(half, p)).sum()
        }
    }
}

/// Orders the edges so that near edges follow each other: halves them along the longer axis, and sorts each half likewise.
fn sort(edges: &[[Point; 2]], order: &mut [u32]) {
    if order.len() < 2 {
        return;
    }
    let bounds: Bounds = order.iter().flat_map(|&e| edges[e as usize]).collect();
    let extent: Vector = bounds.max - bounds.min;
    let axis = usize::from(extent.y > extent.x);
    let middle = order.len() / 2;
    let place = |e: u32| edges[e as usize].iter().map(|p| p[axis]).sum::<f64>();
    order.select_nth_unstable_by(middle, |&a, &b| place(a).total_cmp(&place(b)));
    let (first, second) = order.split_at_mut(middle);
    sort(edges, first);
    sort(edges, second);
}
