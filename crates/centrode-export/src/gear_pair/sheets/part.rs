use super::Label;
use centrode_gear::design::BodySpec;
use centrode_gear::{Frame, Gear, GearPair, Member, Role};
use centrode_geometry::{
    Bounds, Extreme, Outline, Point, Tolerance, Vector, bracketed_root, minimum,
};
use centrode_spec::DrawingSpec;
use nalgebra::Rotation2;
use std::f64::consts::TAU;

/// A gear with the data for its sheets, in mm at full size.
pub(super) struct SheetGear<'a> {
    pub(super) pair: &'a GearPair,
    pub(super) gear: &'a Gear,
    pub(super) member: Member,
    /// The toothed contour in lines and arcs.
    pub(super) outline: Outline,
    pub(super) pitch_curve: Outline,
    pub(super) bore: Option<Outline>,
    pub(super) tolerance: Tolerance,
    /// Names in a larger machine; `None` for a pair alone.
    pub(super) label: Option<Label<'a>>,
    /// Name that its files begin with.
    pub(super) file: String,
    /// The outermost point of each tooth.
    tips: Vec<Point>,
    /// The innermost point of each space.
    roots: Vec<Point>,
}

/// How far driver and driven gear are equal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Likeness {
    Teeth,
    AllButMark,
    All,
}

/// How far the two gears of a pair are equal; `None` if their teeth differ.
pub(super) fn likeness(pair: &GearPair) -> Option<Likeness> {
    if !pair.congruent() {
        return None;
    }
    let teeth = pair.driver().tooth_count() as usize;
    let [driver, driven] = [Member::Driver, Member::Driven].map(|member| -> Vec<Point> {
        let tooth = |k: usize| middle(pair, member, k as f64).point;
        (0..teeth).map(tooth).collect()
    });
    let angle = |p: Point| p.y.atan2(p.x);
    let near = 1e-6 * pair.module();
    // Rotations that bring the driver onto the driven gear; their teeth are numbered in opposite senses.
    let turns = (0..teeth).filter_map(|first| {
        let turn = angle(driven[0]) - angle(driver[first]);
        let turned = Rotation2::new(turn);
        let fits = (0..teeth).all(|k| {
            let mine = turned * driver[(first + teeth - k) % teeth];
            (mine - driven[k]).norm() < near
        });
        fits.then_some((turn, first == 0))
    });
    let (body, other) = (pair.driver().body(), pair.driven().body());
    let own = |angle| BodySpec {
        keyway_angle: angle,
        ..other.clone()
    };
    let keyed = body.keyway.is_some();
    let level = |(turn, marked): (f64, bool)| {
        let off = body.keyway_angle + turn - other.keyway_angle;
        let placed = !keyed || (0.5 * off).sin().abs() < 1e-9;
        match placed && own(body.keyway_angle) == *body {
            true if marked => Likeness::All,
            true => Likeness::AllButMark,
            false => Likeness::Teeth,
        }
    };
    turns.map(level).max().or(Some(Likeness::Teeth))
}

/// The tips, or the roots, with the maximum and the minimum radius.
pub(super) struct Extremes {
    pub(super) maximum: Point,
    pub(super) minimum: Point,
}

/// Frame of the pitch curve, `pitches` pitches after the middle of a gear's first tooth.
pub(in crate::gear_pair) fn middle(pair: &GearPair, member: Member, pitches: f64) -> Frame {
    let (gear, rolling) = (pair.gear(member), pair.rolling());
    let own = match member {
        Member::Driver => 0.0,
        Member::Driven => 0.5,
    };
    let pitch = gear.pitch_length() / f64::from(gear.tooth_count());
    rolling.frame(
        member,
        rolling.parameter((pitches + pair.phase() + own) * pitch),
    )
}

impl<'a> SheetGear<'a> {
    pub(super) fn new(pair: &'a GearPair, member: Member, tolerance: Tolerance) -> Self {
        let gear = pair.gear(member);
        let mut tips: Vec<Option<(f64, Point)>> = vec![None; gear.tooth_count() as usize];
        let mut roots: Vec<Option<(f64, Point)>> = Vec::new();
        let is_root = |role: &Role| matches!(role, Role::Root | Role::Fillet);
        let parts = gear.outline().segments().iter().zip(gear.roles());
        let mut before = gear.roles().last().is_some_and(is_root);
        let is_open = before && gear.roles().first().is_some_and(is_root);
        // A space begins where a tooth ends; the contour may begin within a space.
        roots.extend(is_open.then_some(None));
        for ((segment, role), &owner) in parts.zip(gear.owners()) {
            let space = is_root(role);
            if space && !before {
                roots.push(None);
            }
            before = space;
            let (found, sign) = match roots.last_mut() {
                Some(found) if space => (found, 1.0),
                _ => (&mut tips[owner as usize], -1.0),
            };
            let radius = |u: f64| sign * segment.at(u).point.coords.norm();
            let Extreme { input, value } = minimum(radius, &[-1.0, 1.0]);
            if found.is_none_or(|(best, _)| value < best) {
                *found = Some((value, segment.at(input).point));
            }
        }
        if let (true, Some(Some(last))) = (is_open && roots.len() > 1, roots.last().copied()) {
            let first = roots[0].filter(|first| first.0 <= last.0);
            roots[0] = first.or(Some(last));
            roots.pop();
        }
        let points = |list: Vec<Option<(f64, Point)>>| -> Vec<Point> {
            list.into_iter().flatten().map(|(_, p)| p).collect()
        };
        Self {
            pair,
            gear,
            member,
            outline: gear.outline().arcs(tolerance),
            pitch_curve: gear.pitch_curve().arcs(tolerance),
            bore: gear.bore(),
            tolerance,
            label: None,
            file: member.name().to_owned(),
            tips: points(tips),
            roots: points(roots),
        }
    }

    /// Name of its files.
    pub(super) fn name(&self) -> &'a str {
        self.label.map_or(self.member.name(), |label| label.name)
    }

    /// Words for the title block.
    pub(super) fn drawing(&self) -> &DrawingSpec {
        let label = self.label.map(|label| label.drawing);
        label.unwrap_or_else(|| self.pair.drawing())
    }

    pub(super) fn tips(&self) -> Option<Extremes> {
        extremes(&self.tips)
    }

    pub(super) fn roots(&self) -> Option<Extremes> {
        extremes(&self.roots)
    }

    /// Radii of the tip and of the root that are nearest to a polar angle.
    pub(super) fn reach(&self, angle: f64) -> [f64; 2] {
        let off = |p: &Point| (p.y.atan2(p.x) - angle + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
        let nearest = |points: &[Point]| {
            let found = points
                .iter()
                .min_by(|a, b| off(a).abs().total_cmp(&off(b).abs()));
            found.map_or(0.0, |p| p.coords.norm())
        };
        [nearest(&self.tips), nearest(&self.roots)]
    }

    /// Minimum and maximum x of the tips and roots below the x axis: a section along this axis, seen from above, shows them
    /// behind the cut.
    pub(super) fn behind(&self) -> [f64; 2] {
        let corners = self.tips.iter().chain(&self.roots).filter(|p| p.y <= 0.0);
        corners.fold([0.0, 0.0], |[minimum, most], p| {
            [p.x.min(minimum), p.x.max(most)]
        })
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.outline.bounds().with(Point::origin())
    }

    /// Distance of the contour from the pitch curve along its normal, outwards for `side` 1 and inwards for -1; the smallest
    /// distance if the normal meets the contour more than once.
    pub(super) fn height(&self, frame: &Frame, side: f64) -> Option<f64> {
        let joined = 1e-9 * self.pair.module();
        let heights = self.gear.outline().segments().iter().filter_map(|segment| {
            let from = |u: f64| segment.at(u).point - frame.point;
            let past = |u: f64| from(u).dot(&frame.tangent);
            let ends = [-1.0, 1.0].map(past);
            let at = match ends {
                [a, _] if a.abs() < joined => -1.0,
                [a, b] if a * b > 0.0 => return None,
                [a, b] => bracketed_root(past, -1.0, 1.0, a, b),
            };
            let height = side * from(at).dot(&frame.normal);
            (height > 0.0).then_some(height)
        });
        heights.min_by(f64::total_cmp)
    }

    /// Distance of the teeth along the pitch curve.
    pub(super) fn pitch(&self) -> f64 {
        self.gear.pitch_length() / f64::from(self.gear.tooth_count())
    }

    /// The pitch curve's frame in the middle of a tooth, or `half` pitches after it.
    pub(super) fn middle(&self, tooth: u32, half: f64) -> Frame {
        middle(self.pair, self.member, f64::from(tooth) + half)
    }

    pub(super) fn frame(&self, arc: f64) -> Frame {
        let rolling = self.pair.rolling();
        rolling.frame(self.member, rolling.parameter(arc))
    }

    /// Direction towards the mate's axis at phi = 0.
    pub(super) fn toward_mate(&self) -> Vector {
        match self.member {
            Member::Driver => Vector::x(),
            Member::Driven => -Vector::x(),
        }
    }

    /// Sense in which the teeth are numbered.
    pub(super) fn sense(&self) -> &'static str {
        match self.member {
            Member::Driver => "counter-clockwise",
            Member::Driven => "clockwise",
        }
    }
}

fn extremes(points: &[Point]) -> Option<Extremes> {
    let by = |a: &&Point, b: &&Point| a.coords.norm().total_cmp(&b.coords.norm());
    Some(Extremes {
        maximum: *points.iter().max_by(by)?,
        minimum: *points.iter().min_by(by)?,
    })
}

/// Polar angle of a point in degrees, 0 to below 360.
pub(super) fn degrees(p: Point) -> f64 {
    let angle = p.y.atan2(p.x).to_degrees().rem_euclid(360.0);
    // An angle that would be written as 360.00 becomes 0.
    if angle > 359.995 { 0.0 } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_gear::design::GearPairDesign;
    use centrode_gear::pitch::{Circle, Ellipse, PitchSpec};
    use centrode_kinematics::machine::Keyway;
    use std::f64::consts::PI;

    fn pair(pitch: PitchSpec, driven: impl Fn(&mut BodySpec)) -> GearPair {
        let mut design = GearPairDesign::new(pitch);
        design.driver.bore = 12.0;
        design.driver.keyway = Some(Keyway {
            width: 4.0,
            depth: 1.8,
        });
        design.driven = design.driver.clone();
        driven(&mut design.driven);
        GearPair::resolve(&design).expect("a sound pair")
    }

    fn elliptic() -> PitchSpec {
        PitchSpec::Ellipse(Ellipse {
            eccentricity: 0.2679,
            module: Some(2.25),
            tooth_count: Some(23),
            ..Ellipse::default()
        })
    }

    fn circular() -> PitchSpec {
        PitchSpec::Circle(Circle {
            module: Some(2.0),
            tooth_count: Some(20),
            ..Circle::default()
        })
    }

    #[test]
    fn gears_are_one_part_only_where_bore_and_keyway_lie_alike() {
        // The long side of an ellipse points from the driver's focus to its mate and from the driven gear's away from it.
        let same = pair(elliptic(), |_| {});
        assert_eq!(likeness(&same), Some(Likeness::AllButMark));
        let turned = pair(elliptic(), |driven| driven.keyway_angle = PI);
        assert_eq!(likeness(&turned), Some(Likeness::Teeth));
        let wider = pair(elliptic(), |driven| driven.bore = 14.0);
        assert_eq!(likeness(&wider), Some(Likeness::Teeth));
        let bored = pair(elliptic(), |driven| driven.keyway = None);
        assert_eq!(likeness(&bored), Some(Likeness::Teeth));
        // A circle of twenty teeth turned by any of them is itself; the driven one has its first tooth next to its keyway.
        let round = pair(circular(), |_| {});
        let step = PI / 20.0;
        assert_eq!(likeness(&round), Some(Likeness::Teeth));
        let beside = pair(circular(), |driven| driven.keyway_angle = step);
        assert!(likeness(&beside) >= Some(Likeness::AllButMark));
    }

    #[test]
    fn heights_of_teeth_are_those_of_the_tool() {
        for pitch in [elliptic(), circular()] {
            let pair = pair(pitch, |_| {});
            for member in [Member::Driver, Member::Driven] {
                let part = SheetGear::new(&pair, member, Tolerance::new(1e-3).expect("positive"));
                for tooth in 0..pair.gear(member).tooth_count() {
                    let crest = part.height(&part.middle(tooth, 0.0), 1.0);
                    let root = part.height(&part.middle(tooth, 0.5), -1.0);
                    let [crest, root] = [crest, root].map(|height| height.unwrap_or(0.0));
                    assert!((crest - pair.module()).abs() < 1e-6, "{crest}");
                    assert!((root - 1.25 * pair.module()).abs() < 1e-6, "{root}");
                }
            }
        }
    }

    #[test]
    fn every_space_has_its_own_innermost_point() {
        let pair = pair(elliptic(), |_| {});
        for member in [Member::Driver, Member::Driven] {
            let part = SheetGear::new(&pair, member, Tolerance::new(1e-3).expect("positive"));
            let spaces: Vec<f64> = (0..23)
                .map(|space| {
                    let frame = part.middle(space, 0.5);
                    let depth = part.height(&frame, -1.0).expect("a space");
                    (frame.point - frame.normal * depth).coords.norm()
                })
                .collect();
            assert_eq!((part.roots.len(), part.tips.len()), (23, 23));
            // Near the middle of each the radius is hardly greater than at its innermost point.
            let mut found: Vec<f64> = part.roots.iter().map(|p| p.coords.norm()).collect();
            let mut stated = spaces;
            found.sort_by(f64::total_cmp);
            stated.sort_by(f64::total_cmp);
            for (found, stated) in found.iter().zip(&stated) {
                assert!((-1e-9..0.1).contains(&(stated - found)), "{found} {stated}");
            }
        }
    }
}
