//! Interference of teeth away from their contact, where a pitch curve is concave.

use centrode_geometry::Point;

use super::{
    flank::{Flank, Side},
    rolling::{Frame, Member, Rolling},
    tool::Tool,
};

/// Poses a pitch at which two teeth are held against each other.
const POSES: u32 = 20;
/// Number of chords, each with its bulge, that approximate a flank, and a tip.
const FLANK_CHORDS: u32 = 24;
const TIP_CHORDS: u32 = 6;
/// Penetration that may be the approximation's own, as a share of the pitch.
const PENETRATION: f64 = 3e-5;
/// Safety factor on a limiting reach; covers what lies between sampled poses.
const KEPT: f64 = 0.95;

/// Roll lengths to the tip of the leading and the trailing flank of a tooth.
pub(crate) type Reaches = [f64; 2];

/// A tooth whose reaches are being settled.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) member: Member,
    /// Crossings of the leading and the trailing flank.
    pub(crate) crossings: [f64; 2],
    pub(crate) reaches: Reaches,
    /// Roll lengths down to which the mates need the flanks.
    pub(crate) depths: [f64; 2],
}

/// A driver tooth and a driven tooth that pass near each other.
#[derive(Debug)]
pub(crate) struct ToothPassage<'a> {
    rolling: &'a Rolling,
    tool: &'a Tool,
    pitch: f64,
    poses: Vec<(Frame, Frame)>,
}

impl<'a> ToothPassage<'a> {
    /// Sets up the passage of two teeth about the arc length `middle`, or nothing where both pitch curves are
    /// convex for a pitch and a half around: the rack's straight flank then keeps the teeth apart.
    pub(crate) fn about(
        rolling: &'a Rolling,
        tool: &'a Tool,
        middle: f64,
        pitch: f64,
    ) -> Option<Self> {
        let poses: Vec<(Frame, Frame)> = (0..=3 * POSES)
            .map(|i| {
                let arc = middle + pitch * (f64::from(i) / f64::from(POSES) - 1.5);
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
        concave.then_some(Self {
            rolling,
            tool,
            pitch,
            poses,
        })
    }

    /// Shortens one tooth or the other, whichever costs less, or both, until they penetrate nowhere.
    pub(crate) fn clear(&self, driver: &Candidate, driven: &Candidate) -> (Reaches, Reaches) {
        let cut = |candidate: &Candidate, share: f64| Candidate {
            reaches: candidate.reaches.map(|r| r * share),
            ..*candidate
        };
        if !self.penetrate(driver, driven) {
            return (driver.reaches, driven.reaches);
        }
        let ways = [(true, false), (false, true), (true, true)];
        let settled = ways.map(|(first, second)| {
            let pair = |share: f64| {
                (
                    if first { cut(driver, share) } else { *driver },
                    if second { cut(driven, share) } else { *driven },
                )
            };
            let share = longest(|share| {
                let (a, b) = pair(share);
                self.penetrate(&a, &b)
            });
            let (a, b) = pair(share);
            let foul = share == 0.0 && self.penetrate(&a, &b);
            let kept: f64 = a.reaches.iter().chain(&b.reaches).sum();
            (if foul { -1.0 } else { kept }, a.reaches, b.reaches)
        });
        let best = settled.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or((driver.reaches, driven.reaches), |(_, a, b)| (a, b))
    }

    fn penetrate(&self, driver: &Candidate, driven: &Candidate) -> bool {
        let (one, two) = (Shape::of(self, driver), Shape::of(self, driven));
        let deep = |points: &[Point], carried: &dyn Fn(&Point) -> Point, shape: &Shape| {
            points.iter().any(|p| {
                let there = carried(p);
                (there - shape.middle).norm() < shape.radius
                    && shape
                        .depth(&there)
                        .is_some_and(|d| d > PENETRATION * self.pitch && d < 0.5 * self.pitch)
            })
        };
        self.poses.iter().any(|(a, b)| {
            let forth = |p: &Point| carry(a, b, p);
            let back = |p: &Point| carry(b, a, p);
            if (forth(&one.middle) - two.middle).norm() > one.radius + two.radius {
                return false;
            }
            deep(&one.places, &forth, &two) || deep(&two.places, &back, &one)
        })
    }
}

/// Greatest share, found by bisection, at which nothing penetrates, less a margin; zero if none.
fn longest(penetrates: impl Fn(f64) -> bool) -> f64 {
    let (mut clear, mut foul) = (0.0, 1.0);
    for _ in 0..10 {
        let middle = 0.5 * (clear + foul);
        if penetrates(middle) {
            foul = middle;
        } else {
            clear = middle;
        }
    }
    KEPT * clear
}

/// The motion from one gear's frame to the other's at one pose: the rolling frames coincide, their
/// normals opposed.
fn carry(from: &Frame, to: &Frame, p: &Point) -> Point {
    let v = p - from.point;
    to.point + to.tangent * v.dot(&from.tangent) - to.normal * v.dot(&from.normal)
}

/// The working part of a tooth as chords: leading flank upwards, tip, trailing flank downwards.
struct Shape {
    places: Vec<Point>,
    /// Height of the curve above the middle of each chord, out of the material.
    bulges: Vec<f64>,
    /// Sign: +1 where the material lies to the left of the walk.
    material: f64,
    middle: Point,
    radius: f64,
}

impl Shape {
    fn of(passage: &ToothPassage<'_>, candidate: &Candidate) -> Self {
        let (rolling, tool) = (passage.rolling, passage.tool);
        let flank = |side: Side| Flank {
            rolling,
            member: candidate.member,
            tool,
            side,
            crossing: candidate.crossings[side as usize],
        };
        let (leading, trailing) = (flank(Side::Leading), flank(Side::Trailing));
        let top = |flank: &Flank<'_>| {
            let arc = flank.crossing - flank.side.sign() * candidate.reaches[flank.side as usize];
            flank.foot(rolling.parameter(arc))
        };
        let ((foot_a, high_a), (foot_b, high_b)) = (top(&leading), top(&trailing));
        // Along a flank, from its lowest needed place up.
        let along = |flank: &Flank<'_>, share: f64| {
            let (up, down) = (
                candidate.reaches[flank.side as usize],
                candidate.depths[flank.side as usize],
            );
            let roll = share * (up + down) - down;
            flank.point(rolling.parameter(flank.crossing - flank.side.sign() * roll))
        };
        let over = |share: f64| {
            let frame = leading.frame(foot_a + share * (foot_b - foot_a));
            frame.point + frame.normal * (high_a + share * (high_b - high_a))
        };
        let shares = |count: u32| (0..=count).map(move |i| f64::from(i) / f64::from(count));
        // The driver is walked counter-clockwise, the driven gear clockwise.
        let material = if candidate.member == Member::Driver {
            1.0
        } else {
            -1.0
        };
        let mut places: Vec<Point> = shares(FLANK_CHORDS).map(|x| along(&leading, x)).collect();
        let mut bulges = bulges(&places, material);
        for (count, part) in [
            (TIP_CHORDS, &over as &dyn Fn(f64) -> Point),
            (FLANK_CHORDS, &|x| along(&trailing, 1.0 - x)),
        ] {
            let more: Vec<Point> = shares(count).map(part).collect();
            bulges.extend(self::bulges(&more, material));
            places.extend(&more[1..]);
        }
        let middle = nalgebra::center(&along(&leading, 0.5), &along(&trailing, 0.5));
        let radius = places
            .iter()
            .map(|p| (p - middle).norm())
            .fold(0.0, f64::max);
        Self {
            places,
            bulges,
            material,
            middle,
            radius,
        }
    }

    /// Depth of a point below the nearest chord; nothing where an end of the tooth is nearest.
    fn depth(&self, point: &Point) -> Option<f64> {
        let mut nearest = f64::INFINITY;
        let mut depth = None;
        let last = self.places.len() - 2;
        for (k, pair) in self.places.windows(2).enumerate() {
            let chord = pair[1] - pair[0];
            let from = point - pair[0];
            let share = from.dot(&chord) / chord.norm_squared();
            if (k == 0 && share < 0.0) || (k == last && share > 1.0) {
                let end = if k == 0 { pair[0] } else { pair[1] };
                let distance = (point - end).norm_squared();
                if distance < nearest {
                    (nearest, depth) = (distance, None);
                }
                continue;
            }
            let distance = (from - chord * share.clamp(0.0, 1.0)).norm_squared();
            if distance < nearest {
                nearest = distance;
                let share = share.clamp(0.0, 1.0);
                let chordal = distance.sqrt() * chord.perp(&from).signum() * self.material;
                depth = Some(chordal + 4.0 * share * (1.0 - share) * self.bulges[k]);
            }
        }
        depth
    }
}

/// The bulge of every chord of a smooth part, by second differences.
fn bulges(places: &[Point], material: f64) -> Vec<f64> {
    let second = |k: usize| {
        let k = k.clamp(1, places.len() - 2);
        (places[k + 1] - places[k]) - (places[k] - places[k - 1])
    };
    let bulge = |k: usize| {
        let chord = places[k + 1] - places[k];
        let length = chord.norm();
        if length == 0.0 {
            return 0.0;
        }
        // A curve that turns towards the material bulges out of its chord.
        0.0625 * material * chord.perp(&(second(k) + second(k + 1))) / length
    };
    (0..places.len() - 1).map(bulge).collect()
}
