//! Teeth that are images of others, by the symmetry of the pitch curves.

use std::f64::consts::{PI, TAU};

use nalgebra::UnitComplex;

use super::{
    pair::GearPair,
    pitch::{Symmetry, gcd},
    profile::{FlankPlan, ToothPlan, Top},
    rolling::{Member, Rolling},
    teeth::{Counts, Layout},
};

/// Share of the pitch by which the plans of two teeth that are images of each other may differ: far below the accuracy of
/// contours.
const SAME: f64 = 1e-12;

/// Rounding of an arc length, as a share of it.
const ROUNDING: f64 = 1e-15;

/// Symmetry of one gear: which positions, its teeth or the spaces after them, are images of others.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pattern {
    count: u32,
    /// Pitches after which the gear is as before; a divisor of the count.
    period: u32,
    /// Position `k` is mirrored to position `mirror - k`.
    mirror: Option<i64>,
    /// Sense in which positions follow each other: 1 counter-clockwise.
    sense: f64,
}

/// Image of a position: mirrored first about the axis through both shafts, then turned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Image {
    /// Number of the original position.
    pub(crate) of: u32,
    pub(crate) mirrored: bool,
    /// Number of pitches by which the image is turned.
    pub(crate) pitches: i64,
    /// Turn, counter-clockwise.
    pub(crate) turn: UnitComplex<f64>,
}

impl Pattern {
    /// Number of equal parts of a turn after which the gear is as before.
    pub(crate) fn repeats(&self) -> u32 {
        self.count / self.period
    }

    /// A position as the image of another; `None` for an original position.
    pub(crate) fn image(&self, place: u32) -> Option<Image> {
        let period = i64::from(self.period);
        let first = i64::from(place) % period;
        let other = self
            .mirror
            .map(|mirror| (mirror - first).rem_euclid(period));
        let (of, mirrored) = match other {
            Some(other) if other < first => (other, true),
            _ => (first, false),
        };
        let before = match (mirrored, self.mirror) {
            (true, Some(mirror)) => mirror - of,
            _ => of,
        };
        let pitches = i64::from(place) - before;
        let turn = self.sense * TAU * pitches as f64 / f64::from(self.count);
        (of != i64::from(place)).then(|| Image {
            of: of as u32,
            mirrored,
            pitches,
            turn: UnitComplex::new(turn),
        })
    }

    /// The first teeth; all others are images of these by a turn.
    pub(crate) fn first<'a>(&self, teeth: &'a mut [ToothPlan]) -> &'a mut [ToothPlan] {
        &mut teeth[..self.period as usize]
    }

    /// Counter-clockwise turn that moves one of the first positions to a position.
    pub(crate) fn turn(&self, place: usize) -> UnitComplex<f64> {
        let pitches = (place - place % self.period as usize) as f64;
        UnitComplex::new(self.sense * TAU * pitches / f64::from(self.count))
    }

    /// Copies the plans of the first teeth to all teeth that are images of them.
    pub(crate) fn repeat(&self, teeth: &mut [ToothPlan], pitch: f64) {
        for k in self.period..self.count {
            let of = k % self.period;
            let image = Image {
                of,
                mirrored: false,
                pitches: i64::from(k - of),
                turn: self.turn(k as usize),
            };
            teeth[k as usize] = teeth[of as usize].image(&image, pitch);
        }
    }

    /// Pattern of the spaces after teeth of this pattern.
    pub(crate) fn of_spaces(self) -> Self {
        Self {
            mirror: self.mirror.map(|mirror| mirror - 1),
            ..self
        }
    }

    /// Whether the plan of every image agrees with that of its original.
    fn holds(&self, teeth: &[ToothPlan], pitch: f64) -> bool {
        (0u32..).zip(teeth).all(|(k, tooth)| {
            self.image(k).is_none_or(|image| {
                let there = teeth[image.of as usize].image(&image, pitch);
                tooth.leading.is_like(&there.leading, SAME * pitch)
                    && tooth.trailing.is_like(&there.trailing, SAME * pitch)
            })
        })
    }
}

impl ToothPlan {
    /// Plan of a tooth that is an image of this one.
    fn image(&self, image: &Image, pitch: f64) -> Self {
        let moved = |flank: FlankPlan| FlankPlan {
            crossing: image.arc(flank.crossing, pitch),
            ..flank
        };
        match image.mirrored {
            true => Self {
                leading: moved(self.trailing),
                trailing: moved(self.leading),
            },
            false => Self {
                leading: moved(self.leading),
                trailing: moved(self.trailing),
            },
        }
    }
}

impl Image {
    /// Arc length of a point's image.
    pub(crate) fn arc(&self, arc: f64, pitch: f64) -> f64 {
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        sign * arc + self.pitches as f64 * pitch
    }
}

/// Relation of the driven gear to a driver of the same form: it is the driver, turned.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mating {
    /// The driven tooth `k` is the driver's tooth `last - k`.
    last: i64,
    count: i64,
    /// Sum of the arc lengths of a point on the driver and of the same point on the driven gear.
    arcs: f64,
    length: f64,
    /// Counter-clockwise turn of the driver that makes it the driven gear.
    pub(crate) turn: f64,
}

impl Mating {
    /// `None` unless the pitch curve is its own mate and both gears have the same teeth.
    pub(crate) fn new(rolling: &Rolling, plan: &Layout) -> Option<Self> {
        let symmetry = rolling.symmetry();
        if !symmetry.mates_itself || rolling.mean_ratio() != (1, 1) {
            return None;
        }
        let length = rolling.pitch_length(Member::Driver);
        let pitch = length / plan.driver.len() as f64;
        // A circle is its own mate at any position.
        let arcs = match symmetry.folds {
            0 => (2.0 * plan.phase + 0.5) * pitch,
            _ => 0.5 * length,
        };
        let last = arcs / pitch - 2.0 * plan.phase - 0.5;
        let found = Self {
            last: last.round() as i64,
            count: plan.driver.len() as i64,
            arcs,
            length,
            turn: PI - rolling.angle(rolling.parameter(arcs)),
        };
        let holds = (last - last.round()).abs() < SAME * length
            && (0u32..).zip(&plan.driven).all(|(k, tooth)| {
                let (other, turns) = found.other(k);
                let there = &plan.driver[other as usize];
                let moved = |flank: FlankPlan| FlankPlan {
                    crossing: found.arc(flank.crossing, turns),
                    ..flank
                };
                tooth.leading.is_like(&moved(there.trailing), SAME * length)
                    && tooth.trailing.is_like(&moved(there.leading), SAME * length)
            });
        holds.then_some(found)
    }

    /// Tooth of the other gear that is identical to a tooth of one gear, and the number of whole turns between them.
    pub(crate) fn other(&self, tooth: u32) -> (u32, i64) {
        let index = self.last - i64::from(tooth);
        let (turns, place) = (index.div_euclid(self.count), index.rem_euclid(self.count));
        (place as u32, turns)
    }

    /// Arc length, on the other gear, of the point that has the arc length `arc` on one gear, minus `turns` whole turns.
    pub(crate) fn arc(&self, arc: f64, turns: i64) -> f64 {
        self.arcs - arc - turns as f64 * self.length
    }
}

impl FlankPlan {
    fn is_like(&self, other: &Self, within: f64) -> bool {
        // At a large arc length the rounding of a position exceeds `within`.
        let within = within.max(ROUNDING * self.crossing.abs());
        let top = match (self.top, other.top) {
            (Top::Height(a), Top::Height(b)) | (Top::Reach(a), Top::Reach(b)) => a - b,
            _ => f64::INFINITY,
        };
        let [one, two] = [&self.corner, &other.corner];
        [
            top,
            self.crossing - other.crossing,
            self.active_depth - other.active_depth,
            one.depth - two.depth,
            one.radius - two.radius,
            one.center - two.center,
            one.end - two.end,
        ]
        .iter()
        .all(|off| off.abs() <= within)
    }
}

/// Symmetry of a pair of gears with their teeth.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patterns {
    pub(crate) driver: Pattern,
    pub(crate) driven: Pattern,
}

impl Patterns {
    /// The maximum symmetry that pitch curves and teeth have in common.
    pub(crate) fn new(symmetry: Symmetry, counts: &Counts, plan: &Layout, pitch: f64) -> Self {
        let folds = gcd(symmetry.folds, counts.driver);
        let twice = 2.0 * plan.phase;
        let mirror = (symmetry.mirrored && twice == twice.round()).then_some(-twice as i64);
        let patterns = |periods: [u32; 2], mirror: Option<i64>| Self {
            driver: Pattern {
                count: counts.driver,
                period: periods[0],
                mirror,
                sense: 1.0,
            },
            // A driven tooth is half a pitch behind; the gear turns in the opposite direction.
            driven: Pattern {
                count: counts.driven,
                period: periods[1],
                mirror: mirror.map(|mirror| mirror - 1),
                sense: -1.0,
            },
        };
        let repeating = |folds: u32| {
            let period = counts.driver / folds;
            let driven = match counts.driven.is_multiple_of(period) {
                true => period,
                false => counts.driven,
            };
            [period, driven]
        };
        let ways = [
            patterns(repeating(folds), mirror),
            patterns(repeating(folds), None),
            patterns(repeating(1), mirror),
        ];
        let holds = |found: &Self| {
            found.driver.holds(&plan.driver, pitch) && found.driven.holds(&plan.driven, pitch)
        };
        ways.into_iter()
            .find(holds)
            .unwrap_or(patterns([counts.driver, counts.driven], None))
    }

    /// Pattern of a member.
    pub(crate) fn of(&self, member: Member) -> Pattern {
        match member {
            Member::Driver => self.driver,
            Member::Driven => self.driven,
        }
    }

    /// Number of driver pitches after which the law and both gears repeat.
    pub(crate) fn period(&self) -> u32 {
        let [one, two] = [self.driver.period, self.driven.period];
        one / gcd(one, two) * two
    }

    /// Whether the pair turned backwards is its mirror image.
    pub(crate) fn is_mirrored(&self) -> bool {
        self.driver.mirror.is_some()
    }
}

impl GearPair {
    /// Number of driver pitches after which both gears and the law are as before: the whole cycle, unless the form of the pitch
    /// curve shows that it repeats and the teeth repeat with it.
    #[must_use]
    pub fn period(&self) -> u32 {
        self.patterns.period()
    }

    /// Whether the pair turned backwards from the driver angle 0 is the mirror image of the pair turned forwards, as far as the
    /// form of the pitch curve shows.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.patterns.is_mirrored()
    }
}

#[cfg(test)]
mod tests {
    use crate::design::GearPairDesign;
    use crate::{GearPair, Member};
    use centrode_spec::DesignSpec as _;

    fn pair(pitch: &str, teeth: &str, ratio: &str) -> GearPair {
        let text = format!(
            "family = \"gear-pair\"\nmean_ratio = {ratio}\n[pitch]\n{pitch}\n[teeth]\n{teeth}"
        );
        let design = GearPairDesign::from_toml(&text).expect("a design");
        GearPair::resolve(&design).expect("a pair")
    }

    #[test]
    fn teeth_that_are_images_are_those_that_would_be_cut() {
        // The formula gives the same curve, but without a known symmetry; twelve teeth are undercut.
        let curves = [
            (
                "kind = \"limacon\"\nmean_radius = 30\namplitude = 2\nlobes = 4",
                "30 + 2*cos(4*phi)",
            ),
            (
                "kind = \"limacon\"\nmean_radius = 30\namplitude = 5",
                "30 + 5*cos(phi)",
            ),
            ("kind = \"circle\"\nradius = 30", "30"),
            (
                "kind = \"ellipse\"\neccentricity = 0.2\nsemi_major_axis = 30",
                "30*0.96/(1 - 0.2*cos(phi))",
            ),
            (
                "kind = \"polar\"\nmean = 30\nsin = [0, 2.0]",
                "30 + 2*sin(2*phi)",
            ),
        ];
        for (kind, formula) in curves {
            for (count, ratio) in [(32, "[1, 1]"), (32, "[2, 1]"), (12, "[1, 1]")] {
                for teeth in [
                    "phase = 0.0",
                    "phase = 0.5\nthickness_split = 0.47",
                    "phase = 0.13",
                    "addendum = \"fitted\"",
                ] {
                    let known = pair(&format!("{kind}\ntooth_count = {count}"), teeth, ratio);
                    let text = format!(
                        "kind = \"polar\"\nexpression = \"{formula}\"\ntooth_count = {count}"
                    );
                    let cut = pair(&text, teeth, ratio);
                    for member in [Member::Driver, Member::Driven] {
                        let (one, two) = (known.gear(member), cut.gear(member));
                        let context = format!("{kind} {count} {teeth} {ratio}");
                        assert_eq!(one.roles(), two.roles(), "{context}");
                        assert_eq!(one.owners(), two.owners(), "{context}");
                        let areas = [one, two].map(|gear| gear.outline().area());
                        assert!((areas[0] - areas[1]).abs() < 1e-6, "{context}: {areas:?}");
                        let lengths = [one, two].map(|gear| gear.outline().length());
                        assert!(
                            (lengths[0] - lengths[1]).abs() < 1e-4,
                            "{context}: {lengths:?}"
                        );
                        let both = [one, two].map(|gear| gear.outline().segments());
                        for (a, b) in both[0].iter().zip(both[1]) {
                            // As a copy of the mate it is parted elsewhere, and a root between unequal depths, which goes from one
                            // to the other as the driver turns, is another curve.
                            for u in [-1.0, -0.4, 0.3, 1.0] {
                                let off = (a.at(u).point - b.at(u).point).norm();
                                assert!(off < 1e-8 || known.congruent(), "{context}: {off}");
                            }
                        }
                        for (a, b) in one.teeth().iter().zip(two.teeth()) {
                            for (a, b) in [(a.leading, b.leading), (a.trailing, b.trailing)] {
                                assert!((a.crossing - b.crossing).abs() < 1e-10, "{context}");
                                assert!((a.undercut - b.undercut).abs() < 1e-6, "{context}");
                                assert!((a.tip_height - b.tip_height).abs() < 1e-9, "{context}");
                                let ends = a.active.zip(b.active);
                                assert_eq!(ends.is_some(), a.active.is_some(), "{context}");
                                for (a, b) in
                                    ends.into_iter().flat_map(|(a, b)| [(a.0, b.0), (a.1, b.1)])
                                {
                                    assert!((a - b).abs() < 1e-6, "{context}: {a} {b}");
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn fitted_teeth_repeat_with_the_law_in_every_turn_of_the_driver() {
        let curve = "kind = \"bspline\"\nplane = \"polar\"\ndegree = 2\ntooth_count = 37\n\
                     radius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]\n\
                     angle_deg = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345]";
        for teeth in ["", "addendum = \"fitted\"\nbacklash = 0.05"] {
            let found = pair(curve, teeth, "[3, 1]");
            assert_eq!(found.period(), 37, "{teeth}");
            let driven = found.gear(Member::Driven).teeth();
            for (k, tooth) in driven.iter().enumerate() {
                let first = driven[k % 37];
                for (one, other) in [
                    (tooth.leading, first.leading),
                    (tooth.trailing, first.trailing),
                ] {
                    assert!((one.tip_height - other.tip_height).abs() < 1e-9, "{k}");
                }
            }
        }
    }
}
