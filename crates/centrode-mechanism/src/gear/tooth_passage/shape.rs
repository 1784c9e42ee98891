use std::cell::Cell;

use centrode_geometry::{Point, Vector};

use super::super::{
    flank::{Flank, Side},
    rolling::Member,
};
use super::{Candidate, ToothPassage};

/// Number of chords, each with its bulge, that approximate a flank, and a tip.
const FLANK_CHORDS: u32 = 24;
const TIP_CHORDS: u32 = 6;
/// Chords within one circle that keeps them from being looked at one by one.
const GROUP: usize = 6;

/// The working part of a tooth as chords: leading flank upwards, tip, trailing flank downwards.
pub(super) struct Shape {
    pub(super) places: Vec<Point>,
    /// Height of the curve above the middle of each chord, out of the material.
    bulges: Vec<f64>,
    /// Circles around groups of chords.
    groups: Vec<(Point, f64)>,
    /// Sign: +1 where the material lies to the left of the walk.
    material: f64,
    pub(super) middle: Point,
    pub(super) radius: f64,
    /// The chord that was nearest last: the points of a walk are near each other.
    last: Cell<usize>,
}

impl Shape {
    pub(super) fn of(passage: &ToothPassage<'_>, candidate: &Candidate) -> Self {
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
    pub(super) fn depth(&self, point: &Point) -> Option<f64> {
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
