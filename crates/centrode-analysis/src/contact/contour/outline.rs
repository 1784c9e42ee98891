use std::cell::OnceCell;

use centrode_gear::{Gear, Role};
use centrode_geometry::{
    BoundTree, Disc, Outline, Point, Run, Segment, SegmentJet, Span, SpanBounds, Vector,
};

/// Change of direction at a joint above which it is a corner, rad. The rounding of a fitted joint is far below it, a tip edge far
/// above.
const CORNER: f64 = 1e-4;

/// Cone of the outward normals of a part: the middle direction and a half-angle below 90 degrees, or all directions.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct NormalCone {
    pub(in crate::contact) direction: Vector,
    sin: f64,
    /// Cosine of the half-angle; zero if the cone has all directions.
    cos: f64,
}

impl NormalCone {
    /// The cone between two directions of tangents.
    fn between(from: Vector, to: Vector) -> Self {
        let [from, to] = [from, to].map(|t| Vector::new(t.y, -t.x).normalize());
        let direction = (from + to).normalize();
        Self {
            direction,
            sin: direction.perp(&to).abs(),
            cos: direction.dot(&to).max(1e-9),
        }
    }

    fn all() -> Self {
        Self {
            direction: Vector::x(),
            sin: 1.0,
            cos: 0.0,
        }
    }

    /// The cone with another middle direction, after a rotation of its gear.
    pub(in crate::contact) fn turned(&self, direction: Vector) -> Self {
        Self { direction, ..*self }
    }

    /// Whether any direction of one cone is opposite to any direction of the other.
    pub(in crate::contact) fn opposes(&self, other: &Self) -> bool {
        self.cos == 0.0
            || other.cos == 0.0
            || self.direction.dot(&other.direction) <= self.sin * other.sin - self.cos * other.cos
    }

    /// Sine of the half-angle.
    pub(in crate::contact) fn sin(&self) -> f64 {
        self.sin
    }

    /// Maximum ratio of a length along a direction of the cone to its component along the middle direction, at most 2.5.
    pub(in crate::contact) fn slant(&self) -> f64 {
        1.0 / self.cos.max(0.4)
    }
}

/// Smooth part of an outline with bounds that show quickly whether it can touch another.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct OutlinePart<'a> {
    /// The whole segment.
    pub(in crate::contact) span: Span<'a>,
    pub(in crate::contact) role: Role,
    pub(in crate::contact) tooth: u32,
    /// The corner at its start.
    pub(in crate::contact) corner: Option<Corner>,
    /// Circle around the part.
    pub(in crate::contact) center: Point,
    pub(in crate::contact) radius: f64,
    pub(in crate::contact) normals: NormalCone,
}

impl OutlinePart<'_> {
    fn disc(&self) -> Disc {
        Disc {
            center: self.center,
            radius: self.radius,
        }
    }
}

/// Number of crossings of a part of a segment with the ray from a point towards +x; only its parity is correct.
///
/// The curve and its chord form a loop. A point farther from the chord than the curve's sagitta lies outside the loop: the
/// numbers of crossings of the ray with curve and chord have equal parity. Other parts are halved, which divides the sagitta
/// by four.
fn curve_crossings(span: &Span<'_>, point: Point) -> usize {
    let ([u0, u1], [start, end]) = (span.u, span.ends);
    let away = span.min_distance(&point);
    // A point on the contour itself may count as inside or outside.
    if away > 0.0 || u1 - u0 < 1e-9 || away.is_nan() {
        let side = |p: &Point| p.y > point.y;
        let share = (point.y - start.y) / (end.y - start.y);
        let crosses = side(&start) != side(&end);
        return usize::from(crosses && start.x + share * (end.x - start.x) > point.x);
    }
    let halves = span.halves();
    halves.iter().map(|half| curve_crossings(half, point)).sum()
}

/// A corner of an outline: an edge of the gear.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Corner {
    pub(in crate::contact) point: Point,
    /// Whether it is the end of a flank.
    pub(in crate::contact) on_flank: bool,
    pub(in crate::contact) normals: NormalCone,
}

/// The middle of a part and bounds of its halves.
#[derive(Clone, Debug)]
pub(super) struct Halves {
    pub(in crate::contact) middle: SegmentJet,
    pub(super) bounds: [SpanBounds; 2],
}

/// Outline of a finished gear with bounds for the contact analysis.
#[derive(Debug)]
pub(in crate::contact) struct GearOutline<'a> {
    pub(in crate::contact) parts: Vec<OutlinePart<'a>>,
    /// Circles around groups of parts.
    pub(in crate::contact) tree: BoundTree<Disc>,
    /// Bounds of the parts' curvatures, computed when first needed.
    curvatures: Vec<OnceCell<(f64, f64)>>,
    /// Halves of the parts, computed when first needed.
    halves: Vec<OnceCell<Halves>>,
    /// Points just inside the starts of the parts, computed when first needed; `None` if the body is thinner there.
    inner_point: Vec<OnceCell<Option<Point>>>,
    /// Radius of the solid core: no part of the outline is nearer to the axis, mm.
    pub(in crate::contact) core: f64,
    /// Maximum distance from the axis, mm.
    max_radius: f64,
    /// Maximum distance of the outline from the axis per sector of directions, mm.
    sector_radii: Vec<f64>,
    /// Maximum `near` for which `is_near` can use the sector radii, mm.
    margin: f64,
}

/// Minimum number of sectors of an outline. Fewer sectors make the test coarse, more take longer to fill.
const MIN_SECTORS: usize = 72;

/// Parts per sector of an outline with many parts. More parts per sector make the test coarse, fewer take longer to
/// fill.
const PARTS_PER_SECTOR: usize = 8;

impl<'a> GearOutline<'a> {
    /// Outlines of two gears whose near parts are searched within `near` mm.
    pub(in crate::contact) fn pair(driver: &'a Gear, driven: &'a Gear, near: f64) -> [Self; 2] {
        let parts = [parts(driver), parts(driven)];
        let largest =
            |parts: &[OutlinePart<'_>]| parts.iter().map(|p| p.radius).fold(0.0, f64::max);
        let margin = [&parts[1], &parts[0]].map(|other| largest(other) + near);
        let [driver, driven] = parts;
        [Self::new(driver, margin[0]), Self::new(driven, margin[1])]
    }

    /// Whether a point lies in the body, from the parity of crossings with a ray to the right.
    pub(in crate::contact) fn contains(&self, point: Point) -> bool {
        let crossings = self.tree.root().map(|group| self.crossings(&group, point));
        crossings.is_some_and(|count| count % 2 == 1)
    }

    /// Number of crossings of a group of parts with the ray from a point to the right; only its parity is correct.
    fn crossings(&self, group: &Run<Disc>, point: Point) -> usize {
        let Disc { center, radius } = group.bound;
        if (center.y - point.y).abs() > radius || center.x + radius < point.x {
            0
        } else if center.x - radius > point.x {
            // The group lies to the right: its ends determine the parity.
            let ends = [
                self.parts[group.first()].span.ends[0],
                self.parts[group.last()].span.ends[1],
            ];
            let [start, end] = ends.map(|p| p.y > point.y);
            usize::from(start != end)
        } else if let Some(part) = group.single().map(|part| &self.parts[part]) {
            curve_crossings(&part.span, point)
        } else {
            let halves = self.tree.halves(group);
            halves.iter().map(|half| self.crossings(half, point)).sum()
        }
    }

    pub(in crate::contact) fn new(parts: Vec<OutlinePart<'a>>, margin: f64) -> Self {
        let max_radius = parts
            .iter()
            .map(|p| p.center.coords.norm() + p.radius)
            .fold(0.0, f64::max);
        Self {
            curvatures: vec![OnceCell::new(); parts.len()],
            halves: vec![OnceCell::new(); parts.len()],
            inner_point: vec![OnceCell::new(); parts.len()],
            tree: BoundTree::new(
                &parts.iter().map(OutlinePart::disc).collect::<Vec<_>>(),
                Disc::around_discs,
            ),
            core: parts
                .iter()
                .map(|part| part.span.min_distance(&Point::origin()))
                .fold(f64::INFINITY, f64::min),
            sector_radii: sector_radii(&parts, margin),
            parts,
            max_radius,
            margin,
        }
    }

    /// Whether the body can be within `near` mm of a point, from its maximum radius in that direction.
    pub(in crate::contact) fn is_near(&self, point: &Vector, near: f64) -> bool {
        let squared = point.norm_squared();
        let within = |max_radius: f64| squared < (max_radius + near).powi(2);
        within(self.max_radius)
            && (near > self.margin
                || within(self.sector_radii[sector(point, self.sector_radii.len())]))
    }

    /// A part of a flank and its neighbours on the same flank.
    pub(in crate::contact) fn along_flank(&self, part: usize) -> Vec<usize> {
        let count = self.parts.len();
        let here = &self.parts[part];
        [0, count - 1, 1]
            .map(|step| (part + step) % count)
            .into_iter()
            .filter(|&k| self.parts[k].role == here.role && self.parts[k].tooth == here.tooth)
            .collect()
    }

    /// Bounds of a part's curvature, 1/mm.
    pub(in crate::contact) fn curvature(&self, part: usize) -> (f64, f64) {
        let bounds = || self.parts[part].span.segment.curvature_range([-1.0, 1.0]);
        *self.curvatures[part].get_or_init(bounds)
    }

    /// Point at a small depth below the start of a part; `None` if the body is thinner there. The depth must be the same at every call.
    pub(in crate::contact) fn inner_point(&self, part: usize, depth: f64) -> Option<Point> {
        *self.inner_point[part].get_or_init(|| {
            let start = &self.parts[part];
            let along = start.span.bounds.tangents[0].normalize();
            let point = start.span.ends[0] + Vector::new(-along.y, along.x) * depth;
            self.contains(point).then_some(point)
        })
    }

    /// Middle of a part and bounds of its halves.
    pub(super) fn halves(&self, part: usize) -> &Halves {
        self.halves[part].get_or_init(|| {
            let segment = self.parts[part].span.segment;
            Halves {
                middle: segment.at(0.0),
                bounds: [[-1.0, 0.0], [0.0, 1.0]].map(|u| SpanBounds::new(segment, u)),
            }
        })
    }
}

/// Sector of a direction, from its position on the perimeter of a square.
fn sector(direction: &Vector, count: usize) -> usize {
    let share = direction.y / (direction.x.abs() + direction.y.abs());
    let round = if direction.x < 0.0 {
        2.0 - share
    } else {
        (4.0 + share) % 4.0
    };
    ((0.25 * round * count as f64) as usize).min(count - 1)
}

/// Maximum distance of the parts from the axis per sector, with a margin around each part, mm.
fn sector_radii(parts: &[OutlinePart<'_>], margin: f64) -> Vec<f64> {
    let all = MIN_SECTORS.max(parts.len() / PARTS_PER_SECTOR);
    let mut out = vec![0.0_f64; all];
    for part in parts {
        let away = part.center.coords.norm();
        let far = away + part.radius;
        let sin = (part.radius + margin) / away;
        // A part within the margin of the axis is in every sector.
        if sin.is_nan() || sin >= 1.0 {
            out.iter_mut().for_each(|r| *r = r.max(far));
            continue;
        }
        let cos = (1.0 - sin * sin).sqrt();
        let across = Vector::new(-part.center.y, part.center.x);
        let [first, last] =
            [-sin, sin].map(|sin| sector(&(part.center.coords * cos + across * sin), all));
        let count = (last + all - first) % all;
        for k in first..=first + count {
            out[k % all] = out[k % all].max(far);
        }
    }
    out
}

fn parts(gear: &Gear) -> Vec<OutlinePart<'_>> {
    let outline: &Outline = gear.outline();
    let mut parts: Vec<OutlinePart<'_>> = outline
        .segments()
        .iter()
        .zip(gear.roles().iter().zip(gear.owners()))
        .map(|(segment, (&role, &tooth))| part(segment, role, tooth))
        .collect();
    let count = parts.len();
    for i in 0..count {
        let before = parts[(i + count - 1) % count];
        parts[i].corner = corner(&before, &parts[i]);
    }
    parts
}

/// Corner between two parts, if there is one.
///
/// A re-entrant corner does not count: the parts next to it touch first.
fn corner(before: &OutlinePart<'_>, after: &OutlinePart<'_>) -> Option<Corner> {
    let (end, start) = (
        before.span.bounds.tangents[1],
        after.span.bounds.tangents[0],
    );
    let (turn, along) = (end.perp(&start), end.dot(&start));
    (turn > CORNER * along && turn > 0.0).then(|| Corner {
        point: after.span.ends[0],
        on_flank: before.role == Role::Flank || after.role == Role::Flank,
        normals: NormalCone::between(end, start),
    })
}

fn part(segment: &Segment, role: Role, tooth: u32) -> OutlinePart<'_> {
    let span = Span::whole(segment);
    let [start, end] = span.ends;
    let chord = end - start;
    let (low, high) = span.bounds.slopes;
    let normals = if high - low < f64::INFINITY {
        let across = Vector::new(-chord.y, chord.x);
        NormalCone::between(chord + across * low, chord + across * high)
    } else {
        NormalCone::all()
    };
    OutlinePart {
        role,
        tooth,
        corner: None,
        center: nalgebra::center(&start, &end),
        radius: 0.5 * chord.norm() + span.bounds.sagitta,
        normals,
        span,
    }
}
