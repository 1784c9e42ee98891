//! Interference of teeth away from their contact, where a pitch curve is concave.

use std::cell::{OnceCell, RefCell};
use std::collections::VecDeque;
use std::rc::Rc;

use centrode_geometry::{Disc, Point, checkpoint, parallel_map};

use super::{
    rolling::{Frame, Member, Rolling},
    tool::Tool,
    tooth_chords::ToothChords,
};

/// Number of poses per pitch at which two teeth are compared. Fewer can miss contact between poses, more take longer.
const POSES: u32 = 20;
/// Number of pitches, half of them on either side of the middle of a passage, within which teeth are compared. On pitch curves
/// that are concave in turn, teeth can still touch some pitches before they mesh.
const PITCHES: u32 = 16;
/// Maximum path of a corner in its mate's axes, pitches, from one pose to the next if teeth are trimmed. A longer path
/// misses contact between poses, a shorter one takes longer.
const WAY: f64 = 0.02;
/// Penetration, as a share of the pitch, that may be an error of the approximation by chords. A smaller one trims sound
/// teeth, a larger one leaves teeth that interfere.
const PENETRATION: f64 = 3e-5;
/// Safety factor on a limiting reach: covers penetration between sampled poses. At 1 teeth could still touch; a smaller
/// factor trims more than necessary.
const CACHED: f64 = 0.95;
/// Minimum reduction of a limiting reach, as a share of the whole reach. A larger one trims more than necessary.
const SPARE: f64 = 0.02;

/// Number of equal parts of a tooth's reach in which trimming is counted. Fewer trim in coarse steps, more take longer.
const PARTS: u32 = 1024;

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

/// Poses of both gears, evenly spaced along the pitch curves, computed once for all the passages that share them.
#[derive(Debug)]
pub(crate) struct Poses<'a> {
    rolling: &'a Rolling,
    /// Arc length of pose 0, and of a step.
    origin: f64,
    step: f64,
    /// Number of the first stored pose.
    first: i64,
    kept: VecDeque<[Frame; 2]>,
}

impl<'a> Poses<'a> {
    /// Poses about the arc length `middle` of a passage, and about all arc lengths a multiple of half a pitch from it.
    pub(crate) fn new(rolling: &'a Rolling, middle: f64, pitch: f64) -> Self {
        Self {
            rolling,
            origin: middle,
            step: pitch / f64::from(POSES),
            first: 0,
            kept: VecDeque::new(),
        }
    }

    /// Number of poses about a passage.
    const COUNT: i64 = (PITCHES * POSES) as i64 + 1;

    /// Number of the first pose about an arc length.
    fn from(&self, middle: f64) -> i64 {
        ((middle - self.origin) / self.step).round() as i64 - Self::COUNT / 2
    }

    /// Computes the poses about all arc lengths between two, and reuses those that are stored.
    pub(crate) fn find(&mut self, [first, last]: [f64; 2]) {
        let (from, to) = (self.from(first), self.from(last) + Self::COUNT);
        let end = self.first + self.kept.len() as i64;
        if from < self.first || from > end {
            self.kept.clear();
            self.first = from;
        }
        let missing: Vec<i64> = (self.first + self.kept.len() as i64..to).collect();
        let pose = |number: &i64| pose_at(self.rolling, self.origin + self.step * *number as f64);
        let found = parallel_map(&missing, pose);
        self.kept.extend(found);
    }

    /// The poses within eight pitches of an arc length.
    fn about(&mut self, middle: f64) -> impl Iterator<Item = &[Frame; 2]> + Clone {
        let (from, count) = (self.from(middle), Self::COUNT);
        self.find([middle; 2]);
        // The passages of a tooth come in order; those of the next tooth begin at most seven half pitches before.
        while from - self.first > count {
            self.kept.pop_front();
            self.first += 1;
        }
        let skipped = (from - self.first) as usize;
        self.kept.range(skipped..skipped + count as usize)
    }
}

/// A driver tooth and a driven tooth that pass near each other.
#[derive(Debug)]
pub(crate) struct ToothPassage<'a> {
    rolling: &'a Rolling,
    tools: &'a [Tool; 2],
    pitch: f64,
    /// Poses at which the teeth may meet.
    near: Vec<[Frame; 2]>,
}

/// A tooth trimmed to a share of its reaches, with the shapes computed so far.
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
                passage.rolling,
                passage.tools,
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
    /// Sets up the passage of two teeth about the arc length `middle`, each within a circle. `None` if both pitch curves are
    /// convex for eight pitches around, because the rack's straight flank then keeps the teeth apart, or if the circles do not
    /// meet.
    pub(crate) fn about(
        poses: &mut Poses<'a>,
        tools: &'a [Tool; 2],
        middle: f64,
        pitch: f64,
        [one, two]: [&Disc; 2],
    ) -> Option<Self> {
        let rolling = poses.rolling;
        let poses = poses.about(middle);
        let concave = |[a, b]: &[Frame; 2]| a.curvature < 0.0 || b.curvature < 0.0;
        if !poses.clone().any(concave) {
            return None;
        }
        let reach = (one.radius + two.radius).powi(2);
        let meets =
            |[a, b]: &&[Frame; 2]| (carry(a, b, &one.center) - two.center).norm_squared() < reach;
        let near: Vec<_> = poses.filter(meets).copied().collect();
        (!near.is_empty()).then_some(Self {
            rolling,
            tools,
            pitch,
            near,
        })
    }

    /// Whether two teeth penetrate each other at any pose.
    pub(crate) fn is_foul(&self, teeth: &[Candidate; 2]) -> bool {
        checkpoint();
        let shape = |candidate| Rc::new(ToothChords::new(self.rolling, self.tools, candidate));
        let teeth = teeth.each_ref().map(shape);
        let mut poses = self.near.iter();
        poses.any(|pose| penetrate(pose, &teeth, self.pitch))
    }

    /// Shortens one tooth or the other, whichever loses less reach, or both, until they do not penetrate.
    pub(crate) fn clear(&self, teeth: &[Candidate; 2]) -> [Reaches; 2] {
        let [driver, driven] = teeth.each_ref().map(Trimmed::new);
        let shapes = |[first, second]: [f64; 2]| {
            checkpoint();
            [driver.shape(self, first), driven.shape(self, second)]
        };
        let whole = shapes([1.0, 1.0]);
        // A shorter tooth lies within a longer one: if the whole teeth are clear, all shorter ones are.
        let foul = self.foul(&whole);
        if foul.is_empty() {
            return [driver.candidate.reaches, driven.candidate.reaches];
        }
        let mut best = (f64::NEG_INFINITY, [1.0, 1.0]);
        for cut in [[true, false], [false, true], [true, true]] {
            let shares = |share: f64| cut.map(|cut| if cut { share } else { 1.0 });
            let left = |[first, second]: [f64; 2]| [driver.reaches(first), driven.reaches(second)];
            let kept = |part: u32| -> f64 { left(shares(margined(part))).iter().flatten().sum() };
            // Options worse than a known one are not searched.
            let minimum = first_part(|part| kept(part) >= best.0);
            if minimum == PARTS {
                continue;
            }
            let clear = |pose: &[Frame; 2], part: u32| {
                let shapes = shapes(shares(share(part)));
                !penetrate(pose, &shapes, self.pitch)
            };
            let Some(part) = clear_part(&foul, minimum, clear) else {
                continue;
            };
            let nothing = share(part) < SPARE;
            let worth = if nothing { -1.0 } else { kept(part) };
            if worth >= best.0 {
                best = (worth, shares(margined(part)));
            }
        }
        let [first, second] = best.1;
        [driver.reaches(first), driven.reaches(second)]
    }

    /// Poses at which two teeth penetrate each other, and further poses between these and their neighbours where corners move far
    /// from one to the next.
    fn foul(&self, teeth: &[Rc<ToothChords>; 2]) -> Vec<[Frame; 2]> {
        let near = &self.near;
        let is_foul: Vec<bool> = (near.iter())
            .map(|pose| penetrate(pose, teeth, self.pitch))
            .collect();
        let mut foul = Vec::new();
        for (k, pose) in near.iter().enumerate() {
            if is_foul[k] {
                foul.push(*pose);
            }
            let Some(next) = near.get(k + 1) else {
                continue;
            };
            let follows = next[0].arc - pose[0].arc < 1.5 * self.pitch / f64::from(POSES);
            if !(follows && (is_foul[k] || is_foul[k + 1])) {
                continue;
            }
            let [one, two] = teeth;
            let way = |tooth: &ToothChords, at: &dyn Fn(&[Frame; 2], &Point) -> Point| {
                let ways = tooth
                    .corners()
                    .map(|p| (at(next, &p) - at(pose, &p)).norm());
                ways[0].max(ways[1])
            };
            let longest =
                way(one, &|[a, b], p| carry(a, b, p)).max(way(two, &|[a, b], p| carry(b, a, p)));
            let steps = (longest / (WAY * self.pitch)).ceil();
            let (from, to) = (pose[0].arc, next[0].arc);
            let between = (1..steps as u32)
                .map(|i| pose_at(self.rolling, from + (to - from) * f64::from(i) / steps));
            foul.extend(between);
        }
        foul
    }
}

/// Rolling frames of both gears at an arc length.
fn pose_at(rolling: &Rolling, arc: f64) -> [Frame; 2] {
    let t = rolling.parameter(arc);
    let frame = |member| rolling.frame(member, t);
    [frame(Member::Driver), frame(Member::Driven)]
}

/// Whether two teeth penetrate each other at a pose.
fn penetrate([a, b]: &[Frame; 2], teeth: &[Rc<ToothChords>; 2], pitch: f64) -> bool {
    let [one, two] = teeth;
    let reach = one.radius + two.radius;
    if (carry(a, b, &one.middle) - two.middle).norm_squared() > reach * reach {
        return false;
    }
    is_deep(one, carried(a, b), two, pitch) || is_deep(two, carried(b, a), one, pitch)
}

/// Whether a point of a tooth, moved into the frame of its mate, lies deep in the mate.
fn is_deep(
    tooth: &ToothChords,
    carried: impl Fn(&Point) -> Point,
    mate: &ToothChords,
    pitch: f64,
) -> bool {
    let is_deep = |p: &Point| {
        let there = carried(p);
        !mate.is_beyond(&there, 0.0)
            && mate
                .depth(&there)
                .is_some_and(|d| d > PENETRATION * pitch && d < 0.5 * pitch)
    };
    let mut near = tooth.runs().filter(|(center, radius, _)| {
        // Rounding may put a point outside its circle.
        !mate.is_beyond(&carried(center), radius * (1.0 + 1e-9))
    });
    near.any(|(_, _, places)| places.iter().any(is_deep))
}

/// Share of the reach of a number of parts.
fn share(part: u32) -> f64 {
    f64::from(part) / f64::from(PARTS)
}

/// Share of the reach that is used if nothing penetrates at a number of parts.
fn margined(part: u32) -> f64 {
    let share = share(part);
    (CACHED * share).min(share - SPARE).max(0.0)
}

/// Minimum number of parts for which a condition holds, by bisection; it must hold for all larger numbers, too.
fn first_part(holds: impl Fn(u32) -> bool) -> u32 {
    let (mut from, mut to) = (0, PARTS);
    while from < to {
        let middle = u32::midpoint(from, to);
        if holds(middle) {
            to = middle;
        } else {
            from = middle + 1;
        }
    }
    from
}

/// Maximum number of parts that is clear at all poses; `None` if it is below `minimum`. If a number is clear, all smaller ones
/// are.
fn clear_part<P>(poses: &[P], minimum: u32, clear: impl Fn(&P, u32) -> bool) -> Option<u32> {
    let mut part = PARTS;
    for number in scattered(poses.len()) {
        let clear = |part| clear(&poses[number], part);
        if !clear(part) {
            part = first_part(|less| less > 0 && (less >= part || !clear(less))) - 1;
        }
        if part < minimum {
            return None;
        }
    }
    Some(part)
}

/// All numbers below a count, the first ones far apart: a limit found at these holds mostly for those between, too.
fn scattered(count: usize) -> impl Iterator<Item = usize> {
    let bits = count.next_power_of_two().trailing_zeros();
    let mirrored = move |i: usize| {
        i.reverse_bits()
            .checked_shr(usize::BITS - bits)
            .unwrap_or(0)
    };
    (0..1_usize << bits)
        .map(mirrored)
        .filter(move |&i| i < count)
}

/// Moves a point from one gear's frame to the other's at one pose: the rolling frames coincide, their
/// normals opposed.
fn carry(from: &Frame, to: &Frame, p: &Point) -> Point {
    let v = p - from.point;
    to.point + to.tangent * v.dot(&from.tangent) - to.normal * v.dot(&from.normal)
}

/// Motion of [`carry`] for many points.
fn carried(from: &Frame, to: &Frame) -> impl Fn(&Point) -> Point {
    let turn = to.tangent * from.tangent.transpose() - to.normal * from.normal.transpose();
    let shift = to.point - turn * from.point;
    move |p| turn * p + shift
}
