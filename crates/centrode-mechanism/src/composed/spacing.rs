//! Rings in the gaps between parts on pins and shafts.

use centrode_geometry::{Outline, Point, Tolerance};
use nalgebra::Rotation2;

use super::Composed;
use super::shafts::ROUNDING;
use crate::machine::Spacer;

/// Steps of the cycle at which what passes a ring is looked at.
const STEPS: u32 = 360;
/// Distance from their contours within which the corners of what passes are, mm.
const FINE: f64 = 1e-2;

/// A plate, gear, cam or roller that may pass a ring: its body, its corners there and its heights.
struct Passing {
    body: usize,
    corners: Vec<Point>,
    outline: Outline,
}

impl Composed {
    /// Rings in the gaps between parts, given by their faces (mm), on an axis at a place of a body, with the height of
    /// the lower face of each. None in a gap that another part reaches into, or where one passes closer than the plates' gap.
    pub(super) fn spacers(
        &self,
        own: (usize, Point),
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
            if gap[1] - gap[0] <= ROUNDING {
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

    /// Whether all parts keep farther from an axis than a radius and the plates' gap, mm, between two heights.
    pub(super) fn is_clear(&self, own: (usize, Point), radius: f64, gap: [f64; 2]) -> bool {
        let passing = self.passing(gap);
        if passing.is_empty() {
            return true;
        }
        let step = self.period() / f64::from(STEPS);
        let inputs: Vec<f64> = (0..=STEPS).map(|k| f64::from(k) * step).collect();
        let least = radius + self.design.plates.gap;
        passing.iter().all(|part| {
            let mut before: Option<(Point, f64)> = None;
            inputs.iter().all(|&input| {
                let at = self.seen_from(part.body, own, input);
                let near = part.distance(at);
                // Between two steps it comes nearer by no more than half the way.
                let way = before.map_or(0.0, |(last, _)| (at - last).norm());
                let nearest = before.map_or(near, |(_, last)| last.min(near)) - 0.5 * way;
                before = Some((at, near));
                nearest > least
            })
        })
    }

    /// Place of a point of a body in the axes of another, mm.
    #[must_use]
    pub fn seen_from(&self, body: usize, (own, at): (usize, Point), input: f64) -> Point {
        let at = self.place(own, at, input);
        let origin = self.place(body, Point::origin(), input);
        let turn = Rotation2::new(-self.angle(body, input).position);
        Point::from(turn * (at - origin))
    }

    /// Plates, gears, cams and rollers that reach between two heights.
    fn passing(&self, [low, high]: [f64; 2]) -> Vec<Passing> {
        let between =
            |bottom: f64, thick: f64| bottom < high - ROUNDING && bottom + thick > low + ROUNDING;
        let bodies = (0..self.bodies.len())
            .filter(|&body| between(self.bottom(body), self.thickness(body)))
            .filter_map(|body| Some((body, self.contours(body)?.0)));
        let round = |body: &str, at: Point, outline: &Outline| {
            let reach = outline.farthest(Point::origin());
            Some((self.body_named(body)?, Outline::circle(at, reach)))
        };
        let gears = self.gears.iter().filter_map(|gear| {
            let width = gear.gear().body().width;
            let is_there = between(self.gear_bottom(gear), width);
            is_there.then(|| round(&gear.body_name, gear.at, gear.gear().outline()))?
        });
        let cams = self.cams.iter().filter_map(|cam| {
            let is_there = between(self.cam_bottom(cam), cam.part.body().width);
            is_there.then(|| round(&cam.body_name, cam.at, cam.part.profile().outline()))?
        });
        let rollers = self.rollers().into_iter();
        let rollers = rollers.filter(|(.., (roller, low))| between(*low, roller.length));
        let rollers =
            rollers.map(|(body, at, (roller, _))| (body, Outline::circle(at, 0.5 * roller.outer)));
        let all = bodies.chain(gears).chain(cams).chain(rollers);
        all.filter_map(|(body, outline)| {
            let corners = outline.flatten(Tolerance::new(FINE).ok()?);
            Some(Passing {
                body,
                corners,
                outline,
            })
        })
        .collect()
    }
}

impl Passing {
    /// Distance of a place in the body's axes from the part, mm; zero inside.
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
