use std::cell::OnceCell;

use centrode_gear::{Gear, Role};
use centrode_geometry::{Outline, Point, Segment, SegmentJet, Vector};

use super::{
    span::{self, Span},
    tree::{Run, Tree},
};

/// Change of direction at a joint above which it is a corner, rad: far above the rounding of a fitted
/// joint, far below a tip edge.
const CORNER: f64 = 1e-4;

/// Cone of the outward normals of a part: the middle direction and how far the others turn from it, less than a right
/// angle; or all directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) direction: Vector,
    sin: f64,
    /// Cosine of the half-angle; nothing where the cone holds all directions.
    cos: f64,
}

impl Cone {
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

    /// Cone with its body turned.
    pub(super) fn turned(&self, direction: Vector) -> Self {
        Self { direction, ..*self }
    }

    /// Whether some direction of one opposes some direction of the other.
    pub(super) fn opposes(&self, other: &Self) -> bool {
        self.cos == 0.0
            || other.cos == 0.0
            || self.direction.dot(&other.direction) <= self.sin * other.sin - self.cos * other.cos
    }

    /// Sine of the half-angle.
    pub(super) fn sin(&self) -> f64 {
        self.sin
    }

    /// Greatest ratio of a length along a direction of the cone to that along the middle.
    pub(super) fn slant(&self) -> f64 {
        1.0 / self.cos.max(0.4)
    }
}

/// Smooth part of an outline with bounds that tell quickly whether it can touch another.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutlinePart<'a> {
    pub(super) segment: &'a Segment,
    pub(super) role: Role,
    pub(super) owner: u32,
    /// The corner at its start.
    pub(super) corner: Option<Corner>,
    /// Circle around it.
    pub(super) center: Point,
    pub(super) radius: f64,
    pub(super) normals: Cone,
    pub(super) ends: [Point; 2],
    pub(super) span: Span,
}

/// Crossings of a stretch of a segment with the ray from a point towards +x, to their parity.
///
/// Stretch and chord form a loop. A point farther from the chord than the stretch is anywhere lies outside of it, and the
/// ray crosses both or neither, to parity. Other stretches are halved, which quarters their bulge.
fn stretch_crossings(
    segment: &Segment,
    (u0, u1): (f64, f64),
    (start, end): (Point, Point),
    span: &Span,
    point: Point,
) -> usize {
    let side = |p: &Point| p.y > point.y;
    let (chord, from) = (end - start, point - start);
    let share = (from.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
    let off = (from - chord * share).norm();
    let middle = 0.5 * (u0 + u1);
    // A point on the contour itself may get either answer.
    if off > span.sagitta || u1 - u0 < 1e-9 || off.is_nan() {
        let share = (point.y - start.y) / (end.y - start.y);
        let crosses = side(&start) != side(&end);
        return usize::from(crosses && start.x + share * chord.x > point.x);
    }
    let between = segment.at(middle).point;
    [
        ((u0, middle), (start, between)),
        ((middle, u1), (between, end)),
    ]
    .into_iter()
    .map(|(u, ends)| stretch_crossings(segment, u, ends, &Span::new(segment, u.0, u.1), point))
    .sum()
}

/// A corner of an outline: an edge of the gear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) point: Point,
    /// Whether a flank ends here.
    pub(super) on_flank: bool,
    pub(super) normals: Cone,
}

/// The middle of a part and bounds of its halves.
#[derive(Clone, Debug)]
pub(super) struct Halves {
    pub(super) middle: SegmentJet,
    pub(super) spans: [Span; 2],
}

/// Finished gear as the contact analysis knows it: by its outline alone.
#[derive(Debug)]
pub(super) struct GearOutline<'a> {
    pub(super) parts: Vec<OutlinePart<'a>>,
    /// Circles around runs of them.
    pub(super) tree: Tree,
    /// Bounds of the parts' curvatures, computed when first needed.
    curvatures: Vec<OnceCell<(f64, f64)>>,
    /// Halves of the parts, computed when first needed.
    halves: Vec<OnceCell<Halves>>,
    /// Points just inside the starts of the parts, computed when first needed; none where the body is thinner there.
    inner: Vec<OnceCell<Option<Point>>>,
    /// Radius of the core: the distance from the axis within which there is nothing but the body.
    pub(super) core: f64,
    /// Greatest distance from the axis.
    reach: f64,
    /// Greatest distance from the axis of the outline near a direction, sector by sector of the body's own plane.
    sectors: Vec<f64>,
    /// Distance, mm, within which it counts as near.
    grown: f64,
}

/// Least number of sectors in which a body's reach is kept, and of parts to a sector of a body that has more.
const SECTORS: usize = 72;
const PARTS: usize = 8;

impl<'a> GearOutline<'a> {
    /// Bodies of two gears that are searched for each other within so many mm.
    pub(super) fn pair(driver: &'a Gear, driven: &'a Gear, near: f64) -> [Self; 2] {
        let parts = [parts(driver), parts(driven)];
        let largest =
            |parts: &[OutlinePart<'_>]| parts.iter().map(|p| p.radius).fold(0.0, f64::max);
        let grown = [&parts[1], &parts[0]].map(|other| largest(other) + near);
        let [driver, driven] = parts;
        [Self::new(driver, grown[0]), Self::new(driven, grown[1])]
    }

    /// Whether a point lies in the body, by the parity of crossings with a ray to the right.
    pub(super) fn contains(&self, point: Point) -> bool {
        let crossings = self.tree.root().map(|run| self.crossings(&run, point));
        crossings.is_some_and(|count| count % 2 == 1)
    }

    /// Crossings of a run of parts with the ray from a point to the right, to their parity.
    fn crossings(&self, run: &Run, point: Point) -> usize {
        let (center, radius) = (run.center, run.radius);
        if (center.y - point.y).abs() > radius || center.x + radius < point.x {
            0
        } else if center.x - radius > point.x {
            // Whatever happens in a run wholly to the right, its ends determine the parity.
            let ends = [
                self.parts[run.first()].ends[0],
                self.parts[run.last()].ends[1],
            ];
            let [start, end] = ends.map(|p| p.y > point.y);
            usize::from(start != end)
        } else if let Some(part) = run.single().map(|part| &self.parts[part]) {
            let [start, end] = part.ends;
            stretch_crossings(part.segment, (-1.0, 1.0), (start, end), &part.span, point)
        } else {
            let halves = self.tree.halves(run);
            halves.iter().map(|half| self.crossings(half, point)).sum()
        }
    }

    pub(super) fn new(parts: Vec<OutlinePart<'a>>, grown: f64) -> Self {
        let reach = parts
            .iter()
            .map(|p| p.center.coords.norm() + p.radius)
            .fold(0.0, f64::max);
        Self {
            curvatures: vec![OnceCell::new(); parts.len()],
            halves: vec![OnceCell::new(); parts.len()],
            inner: vec![OnceCell::new(); parts.len()],
            tree: Tree::new(
                &parts
                    .iter()
                    .map(|p| (p.center, p.radius))
                    .collect::<Vec<_>>(),
            ),
            core: parts
                .iter()
                .map(|part| part.clear_of(&Point::origin()))
                .fold(f64::INFINITY, f64::min),
            sectors: sectors(&parts, grown),
            parts,
            reach,
            grown,
        }
    }

    /// Whether the body can be within so many mm of a point, by its reach in that direction.
    pub(super) fn is_near(&self, point: &Vector, near: f64) -> bool {
        let squared = point.norm_squared();
        let within = |reach: f64| squared < (reach + near).powi(2);
        within(self.reach)
            && (near > self.grown || within(self.sectors[sector(point, self.sectors.len())]))
    }

    /// Part of a flank and its neighbours on the same flank.
    pub(super) fn along_flank(&self, part: usize) -> Vec<usize> {
        let count = self.parts.len();
        let here = &self.parts[part];
        [0, count - 1, 1]
            .map(|step| (part + step) % count)
            .into_iter()
            .filter(|&k| self.parts[k].role == here.role && self.parts[k].owner == here.owner)
            .collect()
    }

    /// Bounds of a part's curvature, 1/mm.
    pub(super) fn curvature(&self, part: usize) -> (f64, f64) {
        let bounds = || span::curvature(self.parts[part].segment, -1.0, 1.0);
        *self.curvatures[part].get_or_init(bounds)
    }

    /// Point at a small depth, the same at every call, below the start of a part; `None` where the body is not so thick.
    pub(super) fn inner(&self, part: usize, depth: f64) -> Option<Point> {
        *self.inner[part].get_or_init(|| {
            let start = &self.parts[part];
            let along = start.span.tangents[0].normalize();
            let point = start.ends[0] + Vector::new(-along.y, along.x) * depth;
            self.contains(point).then_some(point)
        })
    }

    /// Middle of a part and bounds of its halves.
    pub(super) fn halves(&self, part: usize) -> &Halves {
        self.halves[part].get_or_init(|| {
            let segment = self.parts[part].segment;
            Halves {
                middle: segment.at(0.0),
                spans: [(-1.0, 0.0), (0.0, 1.0)].map(|(u0, u1)| Span::new(segment, u0, u1)),
            }
        })
    }
}

impl OutlinePart<'_> {
    /// Bound of its distance from a point.
    pub(super) fn clear_of(&self, point: &Point) -> f64 {
        let [start, end] = self.ends;
        let (chord, from) = (end - start, point - start);
        let along = (from.dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
        (from - chord * along).norm() - self.span.sagitta
    }
}

/// Sector of a direction, by its share of the perimeter of a square.
fn sector(direction: &Vector, count: usize) -> usize {
    let share = direction.y / (direction.x.abs() + direction.y.abs());
    let round = if direction.x < 0.0 {
        2.0 - share
    } else {
        (4.0 + share) % 4.0
    };
    ((0.25 * round * count as f64) as usize).min(count - 1)
}

/// Reach by sector of the parts, grown by a distance.
fn sectors(parts: &[OutlinePart<'_>], grown: f64) -> Vec<f64> {
    let all = SECTORS.max(parts.len() / PARTS);
    let mut out = vec![0.0_f64; all];
    for part in parts {
        let away = part.center.coords.norm();
        let far = away + part.radius;
        let sin = (part.radius + grown) / away;
        // A part around the axis itself, or reaching it, is in every sector.
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
        .map(|(segment, (&role, &owner))| part(segment, role, owner))
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
/// A re-entrant corner can touch nothing that its neighbours do not touch first.
fn corner(before: &OutlinePart<'_>, after: &OutlinePart<'_>) -> Option<Corner> {
    let (end, start) = (before.span.tangents[1], after.span.tangents[0]);
    let (turn, along) = (end.perp(&start), end.dot(&start));
    (turn > CORNER * along && turn > 0.0).then(|| Corner {
        point: after.ends[0],
        on_flank: before.role == Role::Flank || after.role == Role::Flank,
        normals: Cone::between(end, start),
    })
}

fn part(segment: &Segment, role: Role, owner: u32) -> OutlinePart<'_> {
    let span = Span::new(segment, -1.0, 1.0);
    let ends = [segment.start(), segment.end()];
    let chord = ends[1] - ends[0];
    let (low, high) = span.slopes;
    let normals = if high - low < f64::INFINITY {
        let across = Vector::new(-chord.y, chord.x);
        Cone::between(chord + across * low, chord + across * high)
    } else {
        Cone::all()
    };
    OutlinePart {
        segment,
        role,
        owner,
        corner: None,
        center: nalgebra::center(&ends[0], &ends[1]),
        radius: 0.5 * chord.norm() + span.sagitta,
        normals,
        ends,
        span,
    }
}
