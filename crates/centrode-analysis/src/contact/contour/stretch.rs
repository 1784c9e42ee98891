//! Stretches of a contour in polar view from the driven axis: each has bounds of its distance from that axis.

use std::cell::OnceCell;

use centrode_geometry::{COMPUTED, Point, SegmentJet, SpanBounds, Vector};

use super::{
    outline::{GearOutline, OutlinePart},
    pose::Pose,
};

/// Minimum lever at which a stretch counts as monotone, as a share of the minimum lever of a contact. Meetings are ill-conditioned
/// close to an extreme of the distance, where the lever is zero.
const MIN_LEVER_SHARE: f64 = 0.25;

/// Newton step of a parameter (-1 to 1 on a part) at which the iteration ends. The remaining error is about the square
/// of the step, below rounding. A smaller one only costs more steps.
pub(in crate::contact) const SETTLED: f64 = 1e-8;

/// A part or an interval of it. Points are relative to the driven axis, in the driven gear's axes.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Stretch {
    pub(in crate::contact) part: usize,
    /// Parameters of the ends.
    pub(in crate::contact) u: [f64; 2],
    pub(in crate::contact) point: [Vector; 2],
    pub(in crate::contact) tangent: [Vector; 2],
    pub(in crate::contact) bounds: SpanBounds,
    /// Circle around the stretch.
    pub(in crate::contact) center: Vector,
    pub(in crate::contact) radius: f64,
    /// 1 if the distance from the axis grows all along, -1 if it falls; 0 if neither is proven.
    pub(in crate::contact) sense: f64,
    /// Range of the squared distance from the axis, mm2.
    pub(in crate::contact) squared: [f64; 2],
}

impl Stretch {
    fn new(
        part: usize,
        u: [f64; 2],
        point: [Vector; 2],
        tangent: [Vector; 2],
        bounds: SpanBounds,
    ) -> Self {
        let chord = point[1] - point[0];
        let center = 0.5 * (point[0] + point[1]);
        let radius = 0.5 * chord.norm() + bounds.sagitta;
        let distance = center.norm();
        let stretch = Self {
            part,
            u,
            point,
            tangent,
            bounds,
            center,
            radius,
            sense: 0.0,
            squared: [distance - radius, distance + radius].map(|d| d.max(0.0).powi(2)),
        };
        let SpanBounds { cos, sin, .. } = bounds;
        let away = center.dot(&chord);
        let slowest = away.abs() * cos - center.perp(&chord).abs() * sin;
        if slowest > radius * chord.norm() {
            stretch.with_sense(away.signum())
        } else {
            stretch
        }
    }

    /// The stretch with the proven sense of its distance from the axis: growing (1) or falling (-1).
    fn with_sense(self, sense: f64) -> Self {
        let [start, end] = self.point.map(|p| p.norm_squared());
        Self {
            sense,
            squared: [start.min(end), start.max(end)],
            ..self
        }
    }

    /// The stretch as a part of another: it is monotone if that one is.
    fn part_of(self, whole: &Self) -> Self {
        if self.sense == whole.sense || whole.sense == 0.0 {
            self
        } else {
            self.with_sense(whole.sense)
        }
    }

    /// Upper bound of the distance of the axis from the normals, mm.
    pub(in crate::contact) fn max_lever(&self) -> f64 {
        let chord = self.point[1] - self.point[0];
        let lever = self.center.dot(&chord).abs() / chord.norm();
        lever + self.center.norm() * self.bounds.sin + self.radius
    }

    pub(in crate::contact) fn is_whole(&self) -> bool {
        self.u == [-1.0, 1.0]
    }

    /// Estimate of the parameters at which two whole parts face each other, from parabolas over their chords.
    pub(in crate::contact) fn facing(&self, mate: &Self) -> (f64, f64) {
        let chords = [self, mate].map(|s| s.point[1] - s.point[0]);
        let [size, other] = chords.map(|c| c.norm());
        let along = chords[0] / size;
        let bend = |s: &Self, size: f64| {
            8.0 * (s.bounds.sagitta_range.0 + s.bounds.sagitta_range.1) / (size * size)
        };
        let (bend, mate_bend) = (bend(self, size), bend(mate, other));
        let apart = along.dot(&(mate.center - self.center));
        let slope = chords[1].perp(&along) / chords[1].dot(&along);
        let x = (mate_bend * apart - slope) / (bend + mate_bend);
        let start = |x: f64| if x.is_nan() { 0.0 } else { x.clamp(-0.9, 0.9) };
        (start(2.0 * x / size), start(2.0 * (apart - x) / other))
    }

    /// Whether a normal of at most `within` mm may lead from the stretch to a point.
    pub(in crate::contact) fn may_face(&self, point: &Vector, within: f64) -> bool {
        let chord = self.point[1] - self.point[0];
        let size = chord.norm();
        let along = (point - self.point[0]).dot(&chord) / size;
        // If tangents are oblique to the chord, the stretch may also face points beyond the ends of the chord.
        let off = self.bounds.sin * within + COMPUTED * size;
        !self.bounds.is_forward() || (-off <= along && along <= size + off) || along.is_nan()
    }

    /// Whether a point may be at most `outside` mm outside of the stretch, or at most `inside` mm inside, along a normal.
    pub(in crate::contact) fn may_be_within(
        &self,
        point: &Vector,
        outside: f64,
        inside: f64,
    ) -> bool {
        let chord = self.point[1] - self.point[0];
        let right = (point - self.point[0]).perp(&chord) / chord.norm();
        let (low, high) = self.bounds.sagitta_range;
        !self.bounds.is_forward()
            || right.is_nan()
            || (low - inside <= right && right <= high + outside)
    }

    /// Upper bound of the stretch's extent in a direction.
    pub(in crate::contact) fn extent(&self, direction: &Vector) -> f64 {
        let [start, end] = self.point;
        direction.dot(&start).max(direction.dot(&end))
            + self.bounds.overshoot(&(end - start), direction)
    }

    /// Stretch of a whole part, with the maps of points and vectors to the driven gear's axes.
    pub(in crate::contact) fn from_part(
        index: usize,
        part: &OutlinePart<'_>,
        point: impl Fn(&Point) -> Point,
        vector: impl Fn(&Vector) -> Vector,
    ) -> Self {
        let ends = part.span.ends.each_ref().map(|p| point(p).coords);
        let tangents = part.span.bounds.tangents.each_ref().map(vector);
        Self::new(index, [-1.0, 1.0], ends, tangents, part.span.bounds)
    }
}

/// A stretch and the smaller ones it is divided into on first use.
#[derive(Clone, Debug)]
pub(in crate::contact) struct DividedStretch {
    pub(in crate::contact) whole: Stretch,
    parts: OnceCell<Vec<DividedStretch>>,
}

impl DividedStretch {
    pub(in crate::contact) fn new(whole: Stretch) -> Self {
        Self {
            whole,
            parts: OnceCell::new(),
        }
    }

    /// The stretches it is divided into:
    ///
    /// 1. itself with its sense, if its exact levers prove that it is monotone;
    /// 2. none, if all its normals pass the axis within `min_lever` mm;
    /// 3. its halves otherwise.
    pub(in crate::contact) fn parts(&self, contour: &PosedContour<'_>, min_lever: f64) -> &[Self] {
        self.parts.get_or_init(|| {
            let whole = &self.whole;
            if whole.sense == 0.0 {
                let (low, high) = contour.levers(whole);
                if low.max(-high) > MIN_LEVER_SHARE * min_lever {
                    return vec![Self::new(whole.with_sense(low.signum()))];
                }
                if low.abs().max(high.abs()) < min_lever {
                    return Vec::new();
                }
            }
            contour.halves(whole).map(Self::new).into()
        })
    }
}

/// A point of a contour.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct ContourPoint {
    /// Parameter on its part.
    pub(in crate::contact) u: f64,
    /// Position relative to the driven axis, in the driven gear's axes.
    pub(in crate::contact) point: Vector,
    pub(in crate::contact) tangent: Vector,
}

/// Contour of one gear relative to the driven axis, in the driven gear's axes.
pub(in crate::contact) struct PosedContour<'a> {
    pub(in crate::contact) body: &'a GearOutline<'a>,
    /// Pose of the driven gear if this is the driver's contour.
    pub(in crate::contact) pose: Option<Pose>,
}

impl PosedContour<'_> {
    pub(in crate::contact) fn at(&self, part: usize, u: f64) -> SegmentJet {
        self.jet_to_driven(&self.body.parts[part].span.segment.at(u))
    }

    fn jet_to_driven(&self, jet: &SegmentJet) -> SegmentJet {
        match &self.pose {
            None => *jet,
            Some(pose) => SegmentJet {
                point: pose.point_to_driven(&jet.point),
                first: pose.vector_to_driven(&jet.first),
                second: pose.vector_to_driven(&jet.second),
            },
        }
    }

    /// Bounds of the distance of the axis from the normals, mm, positive where the distance from the axis grows.
    fn levers(&self, stretch: &Stretch) -> (f64, f64) {
        let axis = self.pose.map_or(Point::origin(), |pose| pose.axis);
        let segment = self.body.parts[stretch.part].span.segment;
        segment.lever_range(stretch.u, axis)
    }

    /// Point of a monotone stretch at a squared distance from the axis, to within a step that `MeetingPoints::angle` corrects.
    pub(in crate::contact) fn at_distance(&self, stretch: &Stretch, squared: f64) -> ContourPoint {
        let over = stretch.point.map(|p| p.norm_squared() - squared);
        for k in [0, 1] {
            if over[k] == 0.0 {
                return ContourPoint {
                    u: stretch.u[k],
                    point: stretch.point[k],
                    tangent: stretch.tangent[k],
                };
            }
        }
        let [mut low, mut high] = stretch.u;
        let mut u = low + (high - low) * over[0] / (over[0] - over[1]);
        loop {
            let jet = self.at(stretch.part, u);
            let point = jet.point.coords;
            let over = point.norm_squared() - squared;
            let step = -0.5 * over / point.dot(&jet.first);
            if step.abs() < SETTLED || high - low < SETTLED {
                return ContourPoint {
                    u,
                    point,
                    tangent: jet.first,
                };
            }
            if (over > 0.0) == (stretch.sense > 0.0) {
                high = u;
            } else {
                low = u;
            }
            u += step;
            if !(low < u && u < high) {
                u = 0.5 * (low + high);
            }
        }
    }

    /// Bounds of a stretch's curvature.
    pub(in crate::contact) fn curvature(&self, stretch: &Stretch) -> (f64, f64) {
        if stretch.is_whole() {
            self.body.curvature(stretch.part)
        } else {
            let segment = self.body.parts[stretch.part].span.segment;
            segment.curvature_range(stretch.u)
        }
    }

    /// The part of a stretch between two of its points, in either order.
    pub(in crate::contact) fn between(
        &self,
        stretch: &Stretch,
        mut ends: [ContourPoint; 2],
    ) -> Stretch {
        if ends[0].u > ends[1].u {
            ends.swap(0, 1);
        }
        let u = ends.map(|e| e.u);
        if u == stretch.u {
            return *stretch;
        }
        let bounds = SpanBounds::new(self.body.parts[stretch.part].span.segment, u);
        let [point, tangent] = [ends.map(|e| e.point), ends.map(|e| e.tangent)];
        Stretch::new(stretch.part, u, point, tangent, bounds).part_of(stretch)
    }

    /// The two halves of a stretch; those of a whole part are cached.
    pub(super) fn halves(&self, stretch: &Stretch) -> [Stretch; 2] {
        let [u0, u1] = stretch.u;
        let middle = 0.5 * (u0 + u1);
        let segment = self.body.parts[stretch.part].span.segment;
        let (jet, bounds) = if stretch.is_whole() {
            let halves = self.body.halves(stretch.part);
            (self.jet_to_driven(&halves.middle), halves.bounds)
        } else {
            let bounds = [[u0, middle], [middle, u1]].map(|u| SpanBounds::new(segment, u));
            (self.at(stretch.part, middle), bounds)
        };
        [0, 1].map(|k| {
            let (mut u, mut point, mut tangent) = (stretch.u, stretch.point, stretch.tangent);
            (u[1 - k], point[1 - k], tangent[1 - k]) = (middle, jet.point.coords, jet.first);
            Stretch::new(stretch.part, u, point, tangent, bounds[k]).part_of(stretch)
        })
    }
}
