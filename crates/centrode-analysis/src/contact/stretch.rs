//! Stretches of a contour about the driven axis, in the driven gear's axes.

use std::cell::OnceCell;

use centrode_geometry::{Point, SegmentJet, Vector};

use super::{
    body::{GearOutline, OutlinePart},
    span::{self, Span},
    touch::Pose,
};

/// Rounding of a place along a stretch, as a share of its length.
const ROUNDING: f64 = 1e-9;

/// Share of the lever of an idle contact that the levers of what is found to be monotone have at least.
const SURE: f64 = 0.25;

/// Newton step of the parameter at which iteration stops.
pub(super) const SETTLED: f64 = 1e-8;

/// A stretch of a part, its points taken about the driven axis and in the driven gear's axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) part: usize,
    pub(super) u: [f64; 2],
    pub(super) point: [Vector; 2],
    pub(super) tangent: [Vector; 2],
    pub(super) span: Span,
    /// Circle around the stretch.
    pub(super) center: Vector,
    pub(super) radius: f64,
    /// Whether the distance from the axis grows (1) or falls (-1) all along; 0 where that is not proven.
    pub(super) sense: f64,
    /// Range of the squared distance.
    pub(super) squared: [f64; 2],
}

impl Stretch {
    fn new(part: usize, u: [f64; 2], point: [Vector; 2], tangent: [Vector; 2], span: Span) -> Self {
        let chord = point[1] - point[0];
        let center = 0.5 * (point[0] + point[1]);
        let radius = 0.5 * chord.norm() + span.sagitta;
        let distance = center.norm();
        let stretch = Self {
            part,
            u,
            point,
            tangent,
            span,
            center,
            radius,
            sense: 0.0,
            squared: [distance - radius, distance + radius].map(|d| d.max(0.0).powi(2)),
        };
        let (cos, sin) = span.lean;
        let away = center.dot(&chord);
        let least = away.abs() * cos - center.perp(&chord).abs() * sin;
        if least > radius * chord.norm() {
            stretch.leading(away.signum())
        } else {
            stretch
        }
    }

    /// The stretch, of which it is known that its distance from the axis grows (1) or falls (-1) all along.
    fn leading(self, sense: f64) -> Self {
        let [start, end] = self.point.map(|p| p.norm_squared());
        Self {
            sense,
            squared: [start.min(end), start.max(end)],
            ..self
        }
    }

    /// The stretch, which is monotone where that of which it is a part is.
    fn part_of(self, whole: &Self) -> Self {
        if self.sense == whole.sense || whole.sense == 0.0 {
            self
        } else {
            self.leading(whole.sense)
        }
    }

    /// Bound of the distance of the axis from the normals, mm.
    pub(super) fn greatest_lever(&self) -> f64 {
        let chord = self.point[1] - self.point[0];
        let lever = self.center.dot(&chord).abs() / chord.norm();
        lever + self.center.norm() * self.span.lean.1 + self.radius
    }

    pub(super) fn is_whole(&self) -> bool {
        self.u == [-1.0, 1.0]
    }

    /// Guess of the parameters at which two whole parts face each other: those of parabolas over their chords.
    pub(super) fn facing(&self, mate: &Self) -> (f64, f64) {
        let chords = [self, mate].map(|s| s.point[1] - s.point[0]);
        let [size, other] = chords.map(|c| c.norm());
        let along = chords[0] / size;
        let bend = |s: &Self, size: f64| 8.0 * (s.span.bulge.0 + s.span.bulge.1) / (size * size);
        let (bend, mate_bend) = (bend(self, size), bend(mate, other));
        let apart = along.dot(&(mate.center - self.center));
        let slope = chords[1].perp(&along) / chords[1].dot(&along);
        let x = (mate_bend * apart - slope) / (bend + mate_bend);
        let start = |x: f64| if x.is_nan() { 0.0 } else { x.clamp(-0.9, 0.9) };
        (start(2.0 * x / size), start(2.0 * (apart - x) / other))
    }

    /// Whether a normal may lead from the stretch to a point no farther off than this.
    pub(super) fn may_face(&self, point: &Vector, within: f64) -> bool {
        let chord = self.point[1] - self.point[0];
        let size = chord.norm();
        let along = (point - self.point[0]).dot(&chord) / size;
        // Where a tangent may be square to the chord, points beyond its ends may be faced, too.
        let (_, sin) = self.span.lean;
        let off = sin * within + ROUNDING * size;
        !self.span.slopes.1.is_finite() || (-off <= along && along <= size + off) || along.is_nan()
    }

    /// Whether a point may be no farther outside of the stretch than this, or inside than that, along a normal.
    pub(super) fn may_be_within(&self, point: &Vector, outside: f64, inside: f64) -> bool {
        let chord = self.point[1] - self.point[0];
        let right = (point - self.point[0]).perp(&chord) / chord.norm();
        let (low, high) = self.span.bulge;
        !self.span.slopes.1.is_finite()
            || right.is_nan()
            || (low - inside <= right && right <= high + outside)
    }

    /// Upper bound of the stretch's extent in a direction.
    pub(super) fn farthest(&self, direction: &Vector) -> f64 {
        let [start, end] = self.point;
        direction.dot(&start).max(direction.dot(&end)) + self.span.beyond(&(end - start), direction)
    }

    /// Stretch of a whole part, by the map of points and vectors to the driven gear's axes.
    pub(super) fn from_part(
        index: usize,
        part: &OutlinePart<'_>,
        point: impl Fn(&Point) -> Point,
        vector: impl Fn(&Vector) -> Vector,
    ) -> Self {
        let ends = part.ends.each_ref().map(|p| point(p).coords);
        let tangents = part.span.tangents.each_ref().map(vector);
        Self::new(index, [-1.0, 1.0], ends, tangents, part.span)
    }
}

/// A stretch and what it is divided into, found when first needed.
#[derive(Clone, Debug)]
pub(super) struct Divided {
    pub(super) whole: Stretch,
    parts: OnceCell<Vec<Divided>>,
}

impl Divided {
    pub(super) fn new(whole: Stretch) -> Self {
        Self {
            whole,
            parts: OnceCell::new(),
        }
    }

    /// Parts it is divided into, on its contour: nothing where all its normals pass the axis nearer than `idle`, itself where it
    /// is found to be monotone only now, and else its halves.
    pub(super) fn parts(&self, contour: &Contour<'_>, idle: f64) -> &[Self] {
        self.parts.get_or_init(|| {
            let whole = &self.whole;
            if whole.sense == 0.0 {
                let (low, high) = contour.levers(whole);
                // Up to an extreme of the distance meetings are ill defined: what is monotone keeps off it.
                if low.max(-high) > SURE * idle {
                    return vec![Self::new(whole.leading(low.signum()))];
                }
                if low.abs().max(high.abs()) < idle {
                    return Vec::new();
                }
            }
            contour.halves(whole).map(Self::new).into()
        })
    }
}

/// Contour of one gear about the driven axis, in the driven gear's axes.
pub(super) struct Contour<'a> {
    pub(super) body: &'a GearOutline<'a>,
    /// Pose of the driven gear, for the driver's contour.
    pub(super) pose: Option<Pose>,
}

impl Contour<'_> {
    pub(super) fn at(&self, part: usize, u: f64) -> SegmentJet {
        self.placed(&self.body.parts[part].segment.at(u))
    }

    fn placed(&self, jet: &SegmentJet) -> SegmentJet {
        match &self.pose {
            None => *jet,
            Some(pose) => SegmentJet {
                point: pose.back(&jet.point),
                first: pose.turn_back(&jet.first),
                second: pose.turn_back(&jet.second),
            },
        }
    }

    /// Bounds of the distance of the axis from the normals, positive where the stretch leads away.
    fn levers(&self, stretch: &Stretch) -> (f64, f64) {
        let [u0, u1] = stretch.u;
        let axis = self.pose.map_or(Point::origin(), |pose| pose.axis);
        span::levers(self.body.parts[stretch.part].segment, u0, u1, axis)
    }

    /// Parameter at which a stretch comes to a squared distance, to within a step that `Meeting::angle` corrects.
    pub(super) fn reach(&self, stretch: &Stretch, squared: f64) -> (f64, (Vector, Vector)) {
        let over = stretch.point.map(|p| p.norm_squared() - squared);
        for k in [0, 1] {
            if over[k] == 0.0 {
                return (stretch.u[k], (stretch.point[k], stretch.tangent[k]));
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
                return (u, (point, jet.first));
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
    pub(super) fn curvature(&self, stretch: &Stretch) -> (f64, f64) {
        let [u0, u1] = stretch.u;
        if stretch.is_whole() {
            self.body.curvature(stretch.part)
        } else {
            span::curvature(self.body.parts[stretch.part].segment, u0, u1)
        }
    }

    /// The stretch between two places, in either order.
    pub(super) fn cut(&self, stretch: &Stretch, mut ends: [(f64, (Vector, Vector)); 2]) -> Stretch {
        if ends[0].0 > ends[1].0 {
            ends.swap(0, 1);
        }
        let u = ends.map(|e| e.0);
        if u == stretch.u {
            return *stretch;
        }
        let span = Span::new(self.body.parts[stretch.part].segment, u[0], u[1]);
        let [point, tangent] = [ends.map(|e| e.1.0), ends.map(|e| e.1.1)];
        Stretch::new(stretch.part, u, point, tangent, span).part_of(stretch)
    }

    /// The two halves of a stretch; those of a whole part are kept.
    pub(super) fn halves(&self, stretch: &Stretch) -> [Stretch; 2] {
        let [u0, u1] = stretch.u;
        let middle = 0.5 * (u0 + u1);
        let segment = self.body.parts[stretch.part].segment;
        let (jet, spans) = if stretch.is_whole() {
            let halves = self.body.halves(stretch.part);
            (self.placed(&halves.middle), halves.spans)
        } else {
            let spans = [(u0, middle), (middle, u1)].map(|(u0, u1)| Span::new(segment, u0, u1));
            (self.at(stretch.part, middle), spans)
        };
        [0, 1].map(|k| {
            let (mut u, mut point, mut tangent) = (stretch.u, stretch.point, stretch.tangent);
            (u[1 - k], point[1 - k], tangent[1 - k]) = (middle, jet.point.coords, jet.first);
            Stretch::new(stretch.part, u, point, tangent, spans[k]).part_of(stretch)
        })
    }
}
