//! Rings in the gaps between parts on pins and shafts.

use centrode_geometry::{COMPUTED, Outline, Point, Tolerance, Vector};

use crate::machine::{BodyPoint, Machine};
use centrode_kinematics::machine::Spacer;

/// Steps of the cycle at which the parts that pass a ring are sampled.
const STEPS: u32 = 360;
/// Accuracy of the corners that represent the contour of a passing part, mm.
const FINE: f64 = 1e-2;

/// A plate, gear, cam or roller that may pass a ring: its body, its heights, and its corners in the body's axes.
#[derive(Clone, Debug)]
pub(in crate::machine) struct Passing {
    pub(in crate::machine) body: usize,
    span: [f64; 2],
    pub(in crate::machine) corners: Vec<Point>,
    outline: Outline,
    /// Distance of the part's farthest point from the origin of the body, mm.
    reach: f64,
}

/// Parts that may pass a ring, and the motion of all bodies.
#[derive(Clone, Debug)]
pub(in crate::machine) struct Passage {
    pub(in crate::machine) parts: Vec<Passing>,
    pub(in crate::machine) frames: Frames,
}

/// Positions of all bodies at several inputs.
#[derive(Clone, Debug)]
pub struct Frames {
    /// Two points per body, its origin and the point 1 mm along its x axis, mm: all bodies at the first input, then at the next.
    places: Vec<[f64; 2]>,
    bodies: usize,
}

impl Frames {
    /// Path of a point of a body in the axes of another, mm: one point per input.
    ///
    /// # Panics
    /// If a body is not one of the machine's.
    pub fn path(&self, body: usize, point: BodyPoint) -> impl Iterator<Item = Point> + Clone {
        let frame = |places: &[[f64; 2]], body: usize| {
            let [origin, unit] = [2 * body, 2 * body + 1].map(|k| Point::from(places[k]));
            (origin, unit - origin)
        };
        self.places.chunks(2 * self.bodies).map(move |places| {
            let (origin, axis) = frame(places, point.body);
            let at = origin + axis * point.at.x + Vector::new(-axis.y, axis.x) * point.at.y;
            let (origin, axis) = frame(places, body);
            let at = at - origin;
            Point::new(axis.dot(&at), axis.perp(&at))
        })
    }
}

impl Machine {
    /// Positions of all bodies at several inputs, rad.
    #[must_use]
    pub fn frames(&self, inputs: &[f64]) -> Frames {
        let bodies = self.bodies.len();
        let ends = [Point::origin(), Point::new(1.0, 0.0)];
        let points: Vec<BodyPoint> = (0..bodies)
            .flat_map(|body| ends.map(|at| BodyPoint { body, at }))
            .collect();
        Frames {
            places: self.places_each(&points, inputs),
            bodies,
        }
    }

    /// Rings in the gaps between parts, given by their faces (mm), on an axis at a position of a body, with the height of the
    /// lower face of each. A gap has no ring if another part reaches into it, or passes closer than the plates' gap.
    pub(in crate::machine) fn spacers(
        &self,
        own: BodyPoint,
        diameter: f64,
        on_it: &[[f64; 2]],
    ) -> Vec<(Spacer, f64)> {
        let mut spans = on_it.to_vec();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut top = f64::INFINITY;
        let mut found = Vec::new();
        for [low, high] in spans {
            let gap = [top, low];
            top = if top.is_finite() { top.max(high) } else { high };
            if gap[1] - gap[0] <= COMPUTED {
                continue;
            }
            let rings = Spacer::filling(diameter, gap[1] - gap[0]);
            let outer = rings.first().map_or(0.0, |ring| ring.outer);
            if rings.is_empty() || !self.is_clear(own, 0.5 * outer, gap) {
                continue;
            }
            let mut at = gap[0];
            for ring in rings {
                found.push((ring, at));
                at += ring.length;
            }
        }
        found
    }

    /// Whether all parts between two heights are farther from an axis than a radius plus the plates' gap, mm.
    pub(super) fn is_clear(&self, own: BodyPoint, radius: f64, gap: [f64; 2]) -> bool {
        let passage = self.passage();
        let frame = self.frame_plates().map(|frame| &frame.lower);
        let required = radius + self.design.plates.gap;
        let reaches_into =
            |part: &&Passing| part.span[0] < gap[1] - COMPUTED && part.span[1] > gap[0] + COMPUTED;
        let parts = passage.parts.iter().chain(frame);
        parts.filter(reaches_into).all(|part| {
            let path = passage.frames.path(part.body, own);
            // Between two steps the distance can be smaller than at both by at most half the movement of the axis.
            let keeps_away = |distance: &dyn Fn(Point) -> f64| {
                let mut before: Option<(Point, f64)> = None;
                path.clone().all(|at| {
                    let near = distance(at);
                    let step = before.map_or(0.0, |(last, _)| (at - last).norm());
                    let nearest = before.map_or(near, |(_, last)| last.min(near)) - 0.5 * step;
                    before = Some((at, near));
                    nearest > required
                })
            };
            keeps_away(&|at| at.coords.norm() - part.reach) || keeps_away(&|at| part.distance(at))
        })
    }

    /// Whether the plate of a body is nearer to an axis than a radius, mm, at a step of the cycle, regardless of their heights.
    pub(super) fn meets(&self, own: BodyPoint, radius: f64, body: usize) -> bool {
        let passage = self.passage();
        // A body's plate comes before its gears.
        let plate = passage.parts.iter().find(|part| part.body == body);
        plate.is_some_and(|part| {
            let mut path = passage.frames.path(body, own);
            path.any(|at| {
                at.coords.norm() < part.reach + radius && part.distance(at) + FINE < radius
            })
        })
    }

    /// Parts that may pass a ring, without the two plates of the frame, and the motion of all bodies.
    pub(in crate::machine) fn passage(&self) -> &Passage {
        self.passage.get_or_init(|| {
            let step = self.period() / f64::from(STEPS);
            let inputs: Vec<f64> = (0..=STEPS).map(|k| f64::from(k) * step).collect();
            Passage {
                parts: self.passing(),
                frames: self.frames(&inputs),
            }
        })
    }

    /// Plates, gears, cams and rollers.
    fn passing(&self) -> Vec<Passing> {
        let round = |body: &str, at: Point, outline: &Outline| {
            let reach = outline.maximum_distance(Point::origin());
            Some((self.body_named(body)?, Outline::circle(at, reach)))
        };
        let first = usize::from(self.has_frame_plates());
        let plates = (first..self.bodies.len()).filter_map(|body| {
            let span = (self.bottom(body), self.thickness(body));
            Some((span, (body, self.contours(body)?.0)))
        });
        let gears = self.gears.iter().filter_map(|gear| {
            let span = (self.gear_bottom(gear), gear.gear().body().width);
            Some((
                span,
                round(&gear.body_name, gear.at, gear.gear().outline())?,
            ))
        });
        let cams = self.cams.iter().filter_map(|cam| {
            let span = (self.cam_bottom(cam), cam.part.body().width);
            Some((
                span,
                round(&cam.body_name, cam.at, cam.part.profile().outline())?,
            ))
        });
        let rollers = self.rollers().into_iter().map(|(point, (roller, low))| {
            let outline = Outline::circle(point.at, 0.5 * roller.outer);
            ((low, roller.length), (point.body, outline))
        });
        let all = plates.chain(gears).chain(cams).chain(rollers);
        all.filter_map(|((low, thick), (body, outline))| {
            Passing::new(body, [low, low + thick], outline)
        })
        .collect()
    }
}

impl Passing {
    /// A part of a body with a contour between two heights, mm.
    pub(in crate::machine) fn new(body: usize, span: [f64; 2], outline: Outline) -> Option<Self> {
        Some(Self {
            body,
            span,
            corners: outline.flatten(Tolerance::new(FINE).ok()?),
            reach: outline.maximum_distance(Point::origin()),
            outline,
        })
    }

    /// Distance of a position in the body's axes from the part, mm; zero inside.
    fn distance(&self, at: Point) -> f64 {
        if self.outline.contains(at) {
            return 0.0;
        }
        let next = self.corners.iter().cycle().skip(1);
        let sides = self.corners.iter().zip(next).map(|(a, b)| {
            let side = b - a;
            let square = side.norm_squared();
            let share = if square > 0.0 {
                (at - a).dot(&side) / square
            } else {
                0.0
            };
            (a + side * share.clamp(0.0, 1.0) - at).norm()
        });
        sides.fold(f64::INFINITY, f64::min) - FINE
    }
}
