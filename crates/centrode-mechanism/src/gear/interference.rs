//! Mating flanks that run into each other away from their contact, where a pitch curve is concave.

use centrode_geometry::{Point, Spline, Tolerance};

use super::{
    fitted::Fitting,
    flank::{Flank, Side},
    rolling::{Frame, Member},
};

/// Poses a pitch at which two mating flanks are held against each other.
const POSES: u32 = 20;
/// Places on each flank that are held against the other.
const PLACES: u32 = 14;
/// Overlap that is rounding and chords, not interference, as a share of the pitch.
const OVERLAP: f64 = 1e-6;
/// Share of a limiting reach that is kept, so that what passes between places stays clear too.
const KEPT: f64 = 0.97;

/// Two mating flanks, the driver's and the driven gear's, about their common crossing.
pub(crate) struct Mates<'a> {
    driver: Flank<'a>,
    driven: Flank<'a>,
    pitch: f64,
    /// Where each gear stands at every pose.
    poses: Vec<(Frame, Frame)>,
}

impl<'a> Mates<'a> {
    /// The pair of flanks, or nothing where both pitch curves are convex for a pitch and a half around:
    /// the rack's straight flank then keeps them apart.
    pub(crate) fn near(
        fitting: &Fitting<'a>,
        side: Side,
        crossings: (f64, f64),
        pitch: f64,
    ) -> Option<Self> {
        let (rolling, tool) = (fitting.rolling, fitting.tool);
        let flank = |member, side, crossing| Flank {
            rolling,
            member,
            tool,
            side,
            crossing,
        };
        let count = 3 * POSES;
        let poses: Vec<(Frame, Frame)> = (0..=count)
            .map(|i| {
                let arc = crossings.0 + pitch * (f64::from(i) / f64::from(POSES) - 1.5);
                let t = rolling.parameter(arc);
                (
                    rolling.frame(Member::Driver, t),
                    rolling.frame(Member::Driven, t),
                )
            })
            .collect();
        let concave = poses
            .iter()
            .any(|(a, b)| a.curvature < 0.0 || b.curvature < 0.0);
        concave.then(|| Self {
            driver: flank(Member::Driver, side, crossings.0),
            driven: flank(Member::Driven, side.other(), crossings.1),
            pitch,
            poses,
        })
    }

    /// Shortens the two reaches until the flanks overlap at no pose.
    pub(crate) fn clear(&self, reaches: (f64, f64)) -> (f64, f64) {
        // Above the driver's pitch curve lies the driver's addendum and the driven gear's dedendum.
        let driver = self.longest(reaches.0, 1.0);
        let driven = self.longest(reaches.1, -1.0);
        (driver, driven)
    }

    fn longest(&self, reach: f64, up: f64) -> f64 {
        if !self.overlap(reach, up) {
            return reach;
        }
        let (mut clear, mut foul) = (0.0, reach);
        for _ in 0..12 {
            let middle = 0.5 * (clear + foul);
            if self.overlap(middle, up) {
                foul = middle;
            } else {
                clear = middle;
            }
        }
        KEPT * clear
    }

    /// Whether the parts of both flanks on one side of their crossing, out to `reach`, overlap anywhere.
    fn overlap(&self, reach: f64, up: f64) -> bool {
        let way = -self.driver.side.sign() * up;
        let rolling = self.driver.rolling;
        let place = |flank: &Flank<'_>, share: f64| {
            flank.point(rolling.parameter(flank.crossing + way * reach * share))
        };
        let Ok(tolerance) = Tolerance::new(1e-8 * self.pitch) else {
            return false;
        };
        let curves =
            |flank: &Flank<'_>| Spline::fit(|share| place(flank, share), 0.0, 1.0, tolerance);
        let places = |flank: &Flank<'_>| -> Vec<Point> {
            (0..=PLACES)
                .map(|i| place(flank, f64::from(i) / f64::from(PLACES)))
                .collect()
        };
        let (curves_1, curves_2) = (curves(&self.driver), curves(&self.driven));
        let (places_1, places_2) = (places(&self.driver), places(&self.driven));
        let (material_1, material_2) = (
            material(&self.driver, &curves_1),
            material(&self.driven, &curves_2),
        );
        self.poses.iter().any(|pose| {
            let carry = Carry::of(pose);
            let deep = |points: &[Point], curves: &[Spline], material: f64, forth: bool| {
                points.iter().any(|p| {
                    let there = if forth { carry.forth(p) } else { carry.back(p) };
                    depth(&there, curves, material)
                        .is_some_and(|d| d > OVERLAP * self.pitch && d < 0.5 * self.pitch)
                })
            };
            deep(&places_1, &curves_2, material_2, true)
                || deep(&places_2, &curves_1, material_1, false)
        })
    }
}

/// The motion from the driver's frame to the driven gear's at one pose: the rolling frames coincide, their
/// normals opposed.
struct Carry<'a> {
    driver: &'a Frame,
    driven: &'a Frame,
}

impl<'a> Carry<'a> {
    fn of((driver, driven): &'a (Frame, Frame)) -> Self {
        Self { driver, driven }
    }

    fn forth(&self, p: &Point) -> Point {
        Self::between(self.driver, self.driven, p)
    }

    fn back(&self, p: &Point) -> Point {
        Self::between(self.driven, self.driver, p)
    }

    fn between(from: &Frame, to: &Frame, p: &Point) -> Point {
        let v = p - from.point;
        to.point + to.tangent * v.dot(&from.tangent) - to.normal * v.dot(&from.normal)
    }
}

/// How deep a point lies behind a flank, where the flank's own normal passes through it.
fn depth(point: &Point, curves: &[Spline], material: f64) -> Option<f64> {
    let mut nearest: Option<(f64, f64)> = None;
    for curve in curves {
        let chord = curve.end() - curve.start();
        let mut u = (2.0 * (point - curve.start()).dot(&chord) / chord.norm_squared() - 1.0)
            .clamp(-1.0, 1.0);
        for _ in 0..6 {
            let jet = curve.at(u);
            let apart = jet.point - point;
            let step =
                -apart.dot(&jet.first) / (jet.first.norm_squared() + apart.dot(&jet.second)).abs();
            if step.is_nan() {
                break;
            }
            u += step.clamp(-0.5, 0.5);
            if step.abs() < 1e-6 || u.abs() > 1.5 {
                break;
            }
        }
        if u.abs() > 1.0 + 1e-6 {
            continue;
        }
        let jet = curve.at(u);
        let apart = point - jet.point;
        let side = jet.first.perp(&apart).signum() * material;
        let found = (apart.norm(), side);
        if nearest.is_none_or(|(d, _)| found.0 < d) {
            nearest = Some(found);
        }
    }
    nearest.map(|(distance, side)| distance * side)
}

/// Which side of a walked flank its material is on: +1 left, -1 right.
fn material(flank: &Flank<'_>, curves: &[Spline]) -> f64 {
    let frame = flank.frame(flank.rolling.parameter(flank.crossing));
    let inward = frame.tangent * -flank.side.sign();
    curves
        .first()
        .map_or(0.0, |curve| curve.at(-1.0).first.perp(&inward).signum())
}
