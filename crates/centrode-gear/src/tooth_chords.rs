//! Teeth as chords, to compute the depth of points below their contour.

use std::cell::Cell;

use centrode_geometry::{Disc, Point, Vector};

use super::{
    flank::{Flank, Side},
    rolling::{Member, Rolling},
    tool::Tool,
    tooth_passage::Candidate,
};

/// Number of chords, each with its bulge, that approximate a flank. Fewer make the penetration of two teeth less exact,
/// more take longer.
const FLANK_CHORDS: u32 = 24;
/// Number of chords that approximate a tip.
const TIP_CHORDS: u32 = 6;
/// Number of chords within one circle, so that distant chords are skipped together. It only affects the time.
const GROUP: usize = 6;
/// The working part of a tooth as chords: leading flank upwards, tip, trailing flank downwards.
pub(super) struct ToothChords {
    places: Vec<Point>,
    /// Height of the curve above the middle of each chord, out of the material.
    bulges: Vec<f64>,
    /// Circles around groups of chords.
    groups: Vec<Disc>,
    /// Sign: +1 where the material lies to the left of the direction of travel.
    material: f64,
    supports: Option<Supports>,
    pub(super) middle: Point,
    pub(super) radius: f64,
    /// The chord that was nearest in the last call: successive points are near each other.
    last: Cell<usize>,
}

/// Multiple of the distance of a tooth's ends and corners from its middle within which all of the tooth lies. A smaller
/// one can cut off a convex flank, a larger one skips fewer teeth.
const ROUND: f64 = 1.25;

/// A circle around the working part of a tooth.
pub(super) fn circle(rolling: &Rolling, tools: &[Tool; 2], candidate: &Candidate) -> Disc {
    let [leading, trailing] = [Side::Leading, Side::Trailing].map(|side| {
        let flank = candidate.flank(rolling, tools, side);
        [0.0, 0.5, 1.0].map(|share| candidate.along(&flank, share))
    });
    let center = nalgebra::center(&leading[1], &trailing[1]);
    let away = leading.iter().chain(&trailing).map(|p| (p - center).norm());
    let radius = ROUND * away.fold(0.0, f64::max);
    Disc { center, radius }
}

impl Candidate {
    fn flank<'a>(&self, rolling: &'a Rolling, tools: &'a [Tool; 2], side: Side) -> Flank<'a> {
        Flank {
            rolling,
            member: self.member,
            tool: &tools[self.member as usize],
            side,
            crossing: self.crossings[side as usize],
        }
    }

    /// Point along a flank, from its lowest needed point (share 0) up to its tip.
    fn along(&self, flank: &Flank<'_>, share: f64) -> Point {
        let side = flank.side as usize;
        let (up, down) = (self.reaches[side], self.depths[side]);
        let roll = share * (up + down) - down;
        flank.point(
            flank
                .rolling
                .parameter(flank.crossing - flank.side.sign() * roll),
        )
    }
}

impl ToothChords {
    pub(super) fn new(rolling: &Rolling, tools: &[Tool; 2], candidate: &Candidate) -> Self {
        let [leading, trailing] =
            [Side::Leading, Side::Trailing].map(|side| candidate.flank(rolling, tools, side));
        let top = |flank: &Flank<'_>| {
            let arc = flank.crossing - flank.side.sign() * candidate.reaches[flank.side as usize];
            flank.foot(rolling.parameter(arc))
        };
        let ((foot_a, high_a), (foot_b, high_b)) = (top(&leading), top(&trailing));
        let along = |flank: &Flank<'_>, share: f64| candidate.along(flank, share);
        let over = |share: f64| {
            let frame = leading.frame(foot_a + share * (foot_b - foot_a));
            frame.point + frame.normal * (high_a + share * (high_b - high_a))
        };
        let shares = |count: u32| (0..=count).map(move |i| f64::from(i) / f64::from(count));
        // The contour of a driver tooth is traversed counter-clockwise, that of a driven tooth clockwise.
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
        let supports = Supports::new(&places, &bulges, material);
        let middle = nalgebra::center(&along(&leading, 0.5), &along(&trailing, 0.5));
        let radius = places
            .iter()
            .map(|p| (p - middle).norm())
            .fold(0.0, f64::max);
        let groups = (0..places.len() - 1)
            .step_by(GROUP)
            .map(|from| group(&places[from..places.len().min(from + GROUP + 1)]))
            .collect();
        Self {
            places,
            bulges,
            groups,
            material,
            supports,
            middle,
            radius,
            last: Cell::new(0),
        }
    }

    /// Corners of the tip.
    pub(super) fn corners(&self) -> [Point; 2] {
        let first = FLANK_CHORDS as usize;
        [self.places[first], self.places[first + TIP_CHORDS as usize]]
    }

    /// Runs of neighbouring points, with the circle around each run; every point is in one run.
    pub(super) fn runs(&self) -> impl Iterator<Item = (&Point, f64, &[Point])> {
        let last = self.groups.len() - 1;
        let runs = self.groups.iter().enumerate();
        runs.map(move |(number, Disc { center, radius })| {
            let from = number * GROUP;
            let to = if number == last {
                self.places.len()
            } else {
                from + GROUP
            };
            (center, *radius, &self.places[from..to])
        })
    }

    /// Whether no point within a circle has a depth below the tooth.
    pub(super) fn is_beyond(&self, center: &Point, radius: f64) -> bool {
        let apart = self.radius + radius;
        (center - self.middle).norm_squared() >= apart * apart || self.is_past(center, radius)
    }

    /// Whether a circle lies beyond a support line, and nearer to the last nearest chord than to a corner of the tip. At a sharp
    /// corner the depth is measured from the line of the first chord, and a point outside the tooth may be on its inner side.
    fn is_past(&self, center: &Point, radius: f64) -> bool {
        let supports = self.supports.as_ref();
        if !supports.is_some_and(|supports| supports.are_past(center, radius)) {
            return false;
        }
        let last = self.places.len() - 1;
        let corners = [FLANK_CHORDS as usize, last - FLANK_CHORDS as usize];
        let away = |place: usize| (center - self.places[place]).norm();
        let near = away(self.last.get()) + 2.0 * radius;
        corners.iter().all(|&corner| away(corner) > near)
    }

    /// Depth of a point below the nearest chord; `None` if an end of the tooth is nearest.
    pub(super) fn depth(&self, point: &Point) -> Option<f64> {
        let mut nearest = f64::INFINITY;
        let mut depth = None;
        let last = self.places.len() - 2;
        // The nearest chord is at most as far away as any point of the contour.
        let within = (point - self.places[self.last.get()]).norm();
        let mut found = 0;
        for (number, Disc { center, radius }) in self.groups.iter().enumerate() {
            let reach = (within + radius) * (1.0 + 1e-9);
            if (point - center).norm_squared() > reach * reach {
                continue;
            }
            let first = number * GROUP;
            for k in first..=last.min(first + GROUP - 1) {
                let pair = &self.places[k..=k + 1];
                let chord: Vector = pair[1] - pair[0];
                let from = point - pair[0];
                let share = from.dot(&chord) / chord.norm_squared();
                if (k == 0 && share < 0.0) || (k == last && share > 1.0) {
                    let end = if k == 0 { pair[0] } else { pair[1] };
                    let distance = (point - end).norm_squared();
                    if distance < nearest {
                        (nearest, depth, found) = (distance, None, k);
                    }
                    continue;
                }
                let share = share.clamp(0.0, 1.0);
                let distance = (from - chord * share).norm_squared();
                if distance < nearest {
                    (nearest, found) = (distance, k);
                    let chordal = distance.sqrt() * chord.perp(&from).signum() * self.material;
                    depth = Some(chordal + 4.0 * share * (1.0 - share) * self.bulges[k]);
                }
            }
        }
        self.last.set(found);
        depth
    }
}

/// Lines that a tooth does not cross, along its flanks and along its tip; they hold above its lowest points.
///
/// There the tooth is a polygon, closed by the line between its ends. A point beyond a line is outside the polygon and on the
/// outer side of its nearest chord.
struct Supports {
    /// Outward normals, and how far the tooth reaches along each.
    lines: [(Vector, f64); 3],
    /// Direction towards the tip, and the height of the ends.
    base: (Vector, f64),
}

impl Supports {
    /// The lines of a tooth; `None` if it reaches below its ends, or its flanks cross.
    fn new(places: &[Point], bulges: &[f64], material: f64) -> Option<Self> {
        let last = places.len() - 1;
        let ends = [0, FLANK_CHORDS as usize, last - FLANK_CHORDS as usize, last];
        let outward = |from: usize, to: usize| {
            let chord = places[to] - places[from];
            Vector::new(chord.y, -chord.x) * (material / chord.norm())
        };
        let reach = |normal: Vector| {
            let along = places.iter().map(|p| normal.dot(&p.coords));
            along.fold(f64::NEG_INFINITY, f64::max)
        };
        let up = outward(0, last);
        let height = up.dot(&places[0].coords).max(up.dot(&places[last].coords));
        let rounding = 1e-9 * (places[last] - places[0]).norm();
        let is_polygon =
            reach(-up) <= rounding - height && outward(ends[1], ends[2]).dot(&up) > 0.0;
        let most = bulges.iter().copied().fold(0.0, f64::max);
        is_polygon.then(|| Self {
            lines: [0, 1, 2].map(|k| {
                let normal = outward(ends[k], ends[k + 1]);
                (normal, reach(normal) + most)
            }),
            base: (up, height),
        })
    }

    /// Whether a whole circle lies above the ends and beyond one of the lines.
    fn are_past(&self, center: &Point, radius: f64) -> bool {
        let along = |normal: &Vector| normal.dot(&center.coords);
        let past = |(normal, reach): &(Vector, f64)| along(normal) > reach + radius;
        along(&self.base.0) > self.base.1 + radius && self.lines.iter().any(past)
    }
}

/// Circle around neighbouring points of a curve.
fn group(places: &[Point]) -> Disc {
    let center = nalgebra::center(&places[0], &places[places.len() - 1]);
    let away = places.iter().map(|p| (p - center).norm());
    let radius = away.fold(0.0, f64::max);
    Disc { center, radius }
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
