//! Interference of teeth away from their contact, where a pitch curve is concave.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use centrode_geometry::{Point, Vector, checkpoint};

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
/// Chords within one circle that keeps them from being looked at one by one.
const GROUP: usize = 6;
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

/// Poses of both gears, evenly spaced along the pitch curves, found once for all the passages that share them.
#[derive(Debug)]
pub(crate) struct Poses<'a> {
    rolling: &'a Rolling,
    /// Arc length of pose 0, and of a step.
    origin: f64,
    step: f64,
    /// Number of the first pose kept.
    first: i64,
    kept: VecDeque<(Frame, Frame)>,
}

impl<'a> Poses<'a> {
    /// Poses about the arc length `middle` of a passage, and about all others half pitches from it.
    pub(crate) fn new(rolling: &'a Rolling, middle: f64, pitch: f64) -> Self {
        Self {
            rolling,
            origin: middle,
            step: pitch / f64::from(POSES),
            first: 0,
            kept: VecDeque::new(),
        }
    }

    /// The poses within a pitch and a half of an arc length.
    fn about(&mut self, middle: f64) -> Vec<(Frame, Frame)> {
        let count = 3 * i64::from(POSES) + 1;
        let from = ((middle - self.origin) / self.step).round() as i64 - count / 2;
        let end = self.first + self.kept.len() as i64;
        if from < self.first || from > end {
            self.kept.clear();
            self.first = from;
        }
        for number in self.first + self.kept.len() as i64..from + count {
            let arc = self.origin + self.step * number as f64;
            let t = self.rolling.parameter(arc);
            let pose = [Member::Driver, Member::Driven].map(|m| self.rolling.frame(m, t));
            self.kept.push_back((pose[0], pose[1]));
        }
        // The passages of a tooth come in order, those of the next begin three half pitches back at most.
        while from - self.first > count {
            self.kept.pop_front();
            self.first += 1;
        }
        let skipped = (from - self.first) as usize;
        self.kept
            .range(skipped..skipped + count as usize)
            .copied()
            .collect()
    }
}

/// A driver tooth and a driven tooth that pass near each other.
#[derive(Debug)]
pub(crate) struct ToothPassage<'a> {
    rolling: &'a Rolling,
    tool: &'a Tool,
    pitch: f64,
    poses: Vec<(Frame, Frame)>,
    /// The pose at which teeth penetrated last: others most often do there too.
    foul: Cell<usize>,
}

/// A tooth of which a share of the reaches is kept, with its shapes as far as they have been asked for.
struct Trimmed<'a> {
    candidate: &'a Candidate,
    whole: OnceCell<Rc<ToothChords>>,
    shapes: RefCell<Vec<(f64, Rc<ToothChords>)>>,
}

impl<'a> Trimmed<'a> {
    fn new(candidate: &'a Candidate) -> Self {
        Self {
            candidate,
            whole: OnceCell::new(),
            shapes: RefCell::default(),
        }
    }

    fn reaches(&self, share: f64) -> Reaches {
        self.candidate.reaches.map(|r| r * share)
    }

    fn shape(&self, passage: &ToothPassage<'_>, share: f64) -> Rc<ToothChords> {
        let new = || {
            let reaches = self.reaches(share);
            Rc::new(ToothChords::new(
                passage,
                &Candidate {
                    reaches,
                    ..*self.candidate
                },
            ))
        };
        if share == 1.0 {
            return self.whole.get_or_init(new).clone();
        }
        let mut shapes = self.shapes.borrow_mut();
        if let Some((_, known)) = shapes.iter().find(|(known, _)| *known == share) {
            return known.clone();
        }
        let shape = new();
        shapes.push((share, shape.clone()));
        shape
    }
}

impl<'a> ToothPassage<'a> {
    /// Sets up the passage of two teeth about the arc length `middle`, or nothing where both pitch curves are
    /// convex for a pitch and a half around: the rack's straight flank then keeps the teeth apart.
    pub(crate) fn about(
        poses: &mut Poses<'a>,
        tool: &'a Tool,
        middle: f64,
        pitch: f64,
    ) -> Option<Self> {
        let rolling = poses.rolling;
        let poses = poses.about(middle);
        let concave = poses
            .iter()
            .any(|(a, b)| a.curvature < 0.0 || b.curvature < 0.0);
        concave.then_some(Self {
            rolling,
            tool,
            pitch,
            poses,
            foul: Cell::new(0),
        })
    }

    /// Shortens one tooth or the other, whichever costs less, or both, until they penetrate nowhere.
    pub(crate) fn clear(&self, driver: &Candidate, driven: &Candidate) -> (Reaches, Reaches) {
        let (driver, driven) = (Trimmed::new(driver), Trimmed::new(driven));
        let penetrate = |[first, second]: [f64; 2]| {
            checkpoint();
            self.penetrate(&driver.shape(self, first), &driven.shape(self, second))
        };
        if !penetrate([1.0, 1.0]) {
            return (driver.candidate.reaches, driven.candidate.reaches);
        }
        let ways = [(true, false), (false, true), (true, true)];
        let settled = ways.map(|(first, second)| {
            let shares = |share: f64| [first, second].map(|cut| if cut { share } else { 1.0 });
            let share = longest(|share| penetrate(shares(share)));
            let foul = share == 0.0 && penetrate(shares(share));
            let (a, b) = (
                driver.reaches(shares(share)[0]),
                driven.reaches(shares(share)[1]),
            );
            let kept: f64 = a.iter().chain(&b).sum();
            (if foul { -1.0 } else { kept }, a, b)
        });
        let best = settled.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or(
            (driver.candidate.reaches, driven.candidate.reaches),
            |(_, a, b)| (a, b),
        )
    }

    fn penetrate(&self, one: &ToothChords, two: &ToothChords) -> bool {
        let deep = |points: &[Point], carried: &dyn Fn(&Point) -> Point, shape: &ToothChords| {
            points.iter().any(|p| {
                let there = carried(p);
                (there - shape.middle).norm_squared() < shape.radius * shape.radius
                    && shape
                        .depth(&there)
                        .is_some_and(|d| d > PENETRATION * self.pitch && d < 0.5 * self.pitch)
            })
        };
        let at = |number: usize| {
            let (a, b) = &self.poses[number];
            let forth = |p: &Point| carry(a, b, p);
            let back = |p: &Point| carry(b, a, p);
            let reach = one.radius + two.radius;
            if (forth(&one.middle) - two.middle).norm_squared() > reach * reach {
                return false;
            }
            deep(&one.places, &forth, two) || deep(&two.places, &back, one)
        };
        let last = self.foul.get();
        if at(last) {
            return true;
        }
        let found = (0..self.poses.len()).find(|&number| number != last && at(number));
        found.inspect(|&number| self.foul.set(number)).is_some()
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
struct ToothChords {
    places: Vec<Point>,
    /// Height of the curve above the middle of each chord, out of the material.
    bulges: Vec<f64>,
    /// Circles around groups of chords.
    groups: Vec<(Point, f64)>,
    /// Sign: +1 where the material lies to the left of the walk.
    material: f64,
    middle: Point,
    radius: f64,
    /// The chord that was nearest last: the points of a walk are near each other.
    last: Cell<usize>,
}

impl ToothChords {
    fn new(passage: &ToothPassage<'_>, candidate: &Candidate) -> Self {
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
        let groups = (0..places.len() - 1)
            .step_by(GROUP)
            .map(|from| group(&places[from..places.len().min(from + GROUP + 1)]))
            .collect();
        Self {
            places,
            bulges,
            groups,
            material,
            middle,
            radius,
            last: Cell::new(0),
        }
    }

    /// Depth of a point below the nearest chord; nothing where an end of the tooth is nearest.
    fn depth(&self, point: &Point) -> Option<f64> {
        let mut nearest = f64::INFINITY;
        let mut depth = None;
        let last = self.places.len() - 2;
        // No chord is nearest that is farther than a place.
        let within = (point - self.places[self.last.get()]).norm();
        let mut found = 0;
        for (number, (center, radius)) in self.groups.iter().enumerate() {
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

/// Circle around neighbouring places of a curve.
fn group(places: &[Point]) -> (Point, f64) {
    let center = nalgebra::center(&places[0], &places[places.len() - 1]);
    let away = places.iter().map(|p| (p - center).norm());
    (center, away.fold(0.0, f64::max))
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
