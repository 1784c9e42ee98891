use centrode_geometry::{Point, Segment, Vector, bracketed_minimum, bracketed_root, checkpoint};

use super::{
    pair::{Gear, GearPair, GearPairError},
    profile::Role,
    rolling::Member,
};

/// Measuring pins laid into every space of a gear, by which a workshop checks tooth thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct OverPins {
    /// Diameter of the pin, mm.
    pub diameter: f64,
    /// The pin in each space; space k lies after tooth k in the order the teeth mesh.
    pub pins: Vec<Result<Pin, PinFault>>,
}

/// A pin at rest in a tooth space, touching both flanks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// Center of the pin in the gear's own frame, mm.
    pub center: Point,
    /// Contact points on the flanks, clockwise side first.
    pub contacts: [Point; 2],
    /// Measure over the pin: from the gear's axis to the far side of the pin, `|center| + diameter / 2`, mm.
    pub radial: f64,
}

/// Reason why a space cannot be measured with this pin.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PinFault {
    /// The pin is too small: it goes down past the flanks.
    #[error("the pin is too small for this space: it rests on the fillet or the root")]
    TooSmall,
    /// The pin is too large: it rests on the tips, or above them on nothing.
    #[error("the pin is too large for this space: it stands on the tips of the teeth")]
    TooLarge,
    /// The gear is in the way before the pin touches both flanks.
    #[error("the pin does not get to the flanks of this space: another tooth is in its way")]
    Blocked,
    /// There is no space: a tooth beside it has been cut off or has no flank.
    #[error("a tooth beside this space has no flank")]
    NoFlank,
}

impl OverPins {
    /// Space whose pin lies most nearly opposite that of space `k`, and the measure over both pins,
    /// `|c_k - c_j| + diameter`, mm. `None` where either cannot be measured.
    #[must_use]
    pub fn across(&self, k: usize) -> Option<(usize, f64)> {
        let pin = self.pins.get(k)?.ok()?;
        let opposite = -pin.center.coords.normalize();
        let turned = |p: &Pin| p.center.coords.normalize().dot(&opposite);
        let others = self.pins.iter().enumerate();
        let (j, other) = others
            .filter_map(|(j, p)| p.ok().map(|p| (j, p)))
            .max_by(|a, b| turned(&a.1).total_cmp(&turned(&b.1)))?;
        (j != k).then(|| (j, self.distance(&pin, &other)))
    }

    /// Measure over the pins of two spaces, mm; `None` where either cannot be measured.
    #[must_use]
    pub fn over(&self, k: usize, j: usize) -> Option<f64> {
        let pin = |space: usize| self.pins.get(space)?.ok();
        Some(self.distance(&pin(k)?, &pin(j)?))
    }

    fn distance(&self, one: &Pin, other: &Pin) -> f64 {
        (other.center - one.center).norm() + self.diameter
    }
}

impl GearPair {
    /// Pins of a member's usual diameter in teeth of the greatest and the least thickness that the design allows: the
    /// teeth are cut anew with each. `None` where it tells no deviations.
    ///
    /// # Errors
    /// [`GearPairError`] where a deviation leaves too little of a tooth.
    pub fn pin_limits(&self, member: Member) -> Result<Option<[OverPins; 2]>, GearPairError> {
        let Some([upper, lower]) = self.design().teeth.thickness_deviations else {
            return Ok(None);
        };
        let diameter = self.pin_diameter(member);
        let over = |deviation: f64| {
            let pair = self.thinned(-deviation);
            pair.map(|pair| pair.gear(member).over_pins(diameter))
        };
        Ok(Some([over(upper)?, over(lower)?]))
    }

    /// Diameter of the measuring pin for a member, mm: as written in the design, or the pin that would
    /// touch a straight flank on the pitch curve, `space width / cos alpha`, rounded to a pin there is
    /// (steps of 0.25 mm from 1 mm on, of 0.05 mm below).
    #[must_use]
    pub fn pin_diameter(&self, member: Member) -> f64 {
        if let Some(written) = self.written_pin_diameter() {
            return written;
        }
        let gear = self.gear(member);
        let pitch = gear.pitch_length() / f64::from(gear.tooth_count());
        // Widths are those on the pitch curve; thinned and shifted teeth have their share in the crossings.
        let widths = gear
            .teeth()
            .iter()
            .map(|t| (t.trailing.crossing - t.leading.crossing).abs());
        let width = widths.sum::<f64>() / f64::from(gear.tooth_count());
        let ideal = (pitch - width) / self.teeth().tool.pressure_angle.cos();
        let step = if ideal < 1.0 { 0.05 } else { 0.25 };
        ((ideal / step).round() * step).max(step)
    }
}

impl Gear {
    /// A pin of this diameter (mm) laid into every space, solved on the finished outline to the float
    /// limit: its center lies half a diameter from both flanks.
    ///
    /// A space that cannot be measured says why in its place; a diameter that is not a positive number
    /// fits no space.
    #[must_use]
    pub fn over_pins(&self, diameter: f64) -> OverPins {
        let spaces = self.spaces();
        let pins = spaces.iter().map(|walls| match walls {
            Some(walls) if diameter.is_finite() && diameter > 0.0 => {
                walls.rest(0.5 * diameter).and_then(|pin| {
                    if self.is_clear(&pin, 0.5 * diameter) {
                        Ok(pin)
                    } else {
                        Err(PinFault::Blocked)
                    }
                })
            }
            Some(_) => Err(PinFault::TooSmall),
            None => Err(PinFault::NoFlank),
        });
        OverPins {
            diameter,
            pins: pins.collect(),
        }
    }

    /// Flanks on both sides of every space, in the order of the teeth.
    fn spaces(&self) -> Vec<Option<Walls<'_>>> {
        let teeth = self.tooth_count() as usize;
        let mut flanks: Vec<[Vec<&Segment>; 2]> = vec![Default::default(); teeth];
        let segments = self.outline().segments();
        let count = segments.len();
        for (k, sides) in flanks.iter_mut().enumerate() {
            checkpoint();
            // The segments of one tooth are contiguous, from the first that does not follow one of its own.
            let own = |i: usize| self.owners()[i % count] as usize == k;
            let Some(first) = (0..count).find(|&i| own(i) && !own(i + count - 1)) else {
                continue;
            };
            let run: Vec<usize> = (first..first + count)
                .take_while(|&i| own(i))
                .map(|i| i % count)
                .collect();
            let crest = crest(&run, segments, self.roles());
            for (place, &i) in run.iter().enumerate() {
                if self.roles()[i] == Role::Flank {
                    sides[usize::from(place >= crest)].push(&segments[i]);
                }
            }
        }
        (0..teeth)
            .map(|k| {
                let next = (k + 1) % teeth;
                // The contour runs counter-clockwise; the driven gear's teeth are numbered the other way.
                let (before, after) = match self.member() {
                    Member::Driver => (k, next),
                    Member::Driven => (next, k),
                };
                let down = flanks[before][1].clone();
                let up = flanks[after][0].clone();
                (!down.is_empty() && !up.is_empty()).then_some(Walls { down, up })
            })
            .collect()
    }

    /// Whether nothing of the gear reaches into the pin.
    fn is_clear(&self, pin: &Pin, radius: f64) -> bool {
        const SAMPLES: u32 = 8;
        let clear = radius * (1.0 - 1e-9);
        self.outline().segments().iter().all(|segment| {
            let distance = |u: f64| (segment.at(u).point - pin.center).norm();
            let reach = (segment.end() - segment.start()).norm();
            // Farther off than its own length and the pin: a segment bends less than that.
            if distance(0.0) > 2.0 * reach + radius {
                return true;
            }
            let step = 2.0 / f64::from(SAMPLES);
            (0..SAMPLES).all(|i| {
                let low = -1.0 + step * f64::from(i);
                bracketed_minimum(distance, low, low + step).1 >= clear
            })
        })
    }
}

/// Index in a tooth's run of segments at which its first flank ends: at the tip, or at the sharpest corner of a
/// pointed tooth.
fn crest(run: &[usize], segments: &[Segment], roles: &[Role]) -> usize {
    if let Some(tip) = run.iter().position(|&i| roles[i] == Role::Tip) {
        return tip;
    }
    let turn = |a: usize, b: usize| {
        let (before, after) = (segments[a].at(1.0).first, segments[b].at(-1.0).first);
        before.perp(&after).atan2(before.dot(&after))
    };
    let joints = run.windows(2).enumerate();
    joints
        .map(|(place, w)| (place + 1, turn(w[0], w[1])))
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0, |(place, _)| place)
}

/// The two flanks of a space, each walked counter-clockwise round the gear: one goes down, one up.
#[derive(Clone, Debug)]
struct Walls<'a> {
    down: Vec<&'a Segment>,
    up: Vec<&'a Segment>,
}

/// Points a segment at which signs are sampled.
const SAMPLES: u32 = 12;

impl Walls<'_> {
    /// The pin that touches both flanks, as far out as there is one.
    fn rest(&self, radius: f64) -> Result<Pin, PinFault> {
        // Along the descending flank, from its tip down: the pin that touches it there, and how far it
        // is then from the other flank.
        let ends = self.down.len() as f64;
        let pin = |t: f64| offset(&self.down, t, radius);
        let gap = |t: f64| distance(&self.up, pin(t).1).1 - radius;
        let count = SAMPLES * self.down.len() as u32;
        let at = |i: u32| ends * f64::from(i) / f64::from(count);
        let mut before = gap(0.0);
        if before < 0.0 {
            return Err(PinFault::TooLarge);
        }
        for i in 1..=count {
            let here = gap(at(i));
            if here <= 0.0 {
                let t = bracketed_root(gap, at(i - 1), at(i), before, here);
                let (touched, center) = pin(t);
                let (u, _) = distance(&self.up, center);
                return self.resting(center, touched, u, radius);
            }
            before = here;
        }
        Err(PinFault::TooSmall)
    }

    fn resting(&self, center: Point, touched: Point, u: f64, radius: f64) -> Result<Pin, PinFault> {
        let (other, jet) = along(&self.up, u);
        // At an end of the flank the pin rests on its corner, not on the flank.
        let slant = (center - other).dot(&jet) / (radius * jet.norm());
        if slant.abs() > 1e-6 {
            return Err(if u > 0.5 * self.up.len() as f64 {
                PinFault::TooLarge
            } else {
                PinFault::TooSmall
            });
        }
        Ok(Pin {
            center,
            contacts: [touched, other],
            radial: center.coords.norm() + radius,
        })
    }
}

/// Point and derivative of a chain of segments at `t`, the whole part of which counts segments.
fn along(chain: &[&Segment], t: f64) -> (Point, Vector) {
    let index = (t.max(0.0) as usize).min(chain.len() - 1);
    let jet = chain[index].at(2.0 * (t - index as f64) - 1.0);
    (jet.point, jet.first)
}

/// The point of a chain at `t`, and the point this far out of the material from it.
fn offset(chain: &[&Segment], t: f64, radius: f64) -> (Point, Point) {
    let (point, first) = along(chain, t);
    let outward = Vector::new(first.y, -first.x).normalize();
    (point, point + outward * radius)
}

/// Parameter and distance of a chain's nearest point.
fn distance(chain: &[&Segment], from: Point) -> (f64, f64) {
    let f = |t: f64| (along(chain, t).0 - from).norm();
    let count = SAMPLES * chain.len() as u32;
    let at = |i: u32| chain.len() as f64 * f64::from(i) / f64::from(count);
    let nearest = (0..=count).min_by(|&a, &b| f(at(a)).total_cmp(&f(at(b))));
    let i = nearest.unwrap_or(0);
    let (low, high) = (at(i.saturating_sub(1)), at((i + 1).min(count)));
    let (t, value) = bracketed_minimum(f, low, high);
    // A minimum at the very end of a chain is not inside any bracket.
    [(low, f(low)), (high, f(high))]
        .into_iter()
        .fold(
            (t, value),
            |best, end| if end.1 < best.1 { end } else { best },
        )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear::design::{GearPairDesign, TeethSpec};
    use crate::gear::pitch::{Circle, Ellipse, PitchSpec};

    fn circular(backlash: f64) -> GearPair {
        let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
            module: Some(2.0),
            tooth_count: Some(24),
            ..Circle::default()
        }));
        design.teeth = TeethSpec {
            backlash,
            ..TeethSpec::default()
        };
        GearPair::resolve(&design).expect("a sound pair")
    }

    /// Inverse involute function: the angle x with tan x - x = `value`.
    fn involute_angle(value: f64) -> f64 {
        let f = |x: f64| x.tan() - x - value;
        bracketed_root(f, 0.0, 1.2, f(0.0), f(1.2))
    }

    #[test]
    fn limits_are_the_textbook_measures_of_thicker_and_thinner_teeth() {
        let mut design = circular(0.05).design().clone();
        design.teeth.thickness_deviations = Some([-0.03, -0.06]);
        let pair = GearPair::resolve(&design).expect("a sound pair");
        let (z, m, alpha) = (24.0, 2.0, 20.0_f64.to_radians());
        let base = 0.5 * m * z * alpha.cos();
        for member in [Member::Driver, Member::Driven] {
            let limits = pair.pin_limits(member).expect("teeth").expect("told");
            for (over, thinner) in limits.iter().zip([0.03, 0.06]) {
                let space = 0.5 * std::f64::consts::PI * m + 0.05 / (2.0 * alpha.cos()) + thinner;
                let inv = alpha.tan() - alpha + over.diameter / (2.0 * base) - space / (m * z);
                let radial = base / involute_angle(inv).cos() + 0.5 * over.diameter;
                let pin = over.pins[5].expect("measurable");
                assert!(
                    (pin.radial - radial).abs() < 2e-9,
                    "{} {radial}",
                    pin.radial
                );
                assert!((over.over(5, 17).expect("both") - 2.0 * radial).abs() < 4e-9);
            }
        }
        assert_eq!(
            circular(0.05).pin_limits(Member::Driver).expect("teeth"),
            None
        );
        for wrong in [
            [0.01, -0.06],
            [-0.06, -0.03],
            [f64::NAN, -0.1],
            [-0.1, f64::INFINITY],
        ] {
            design.teeth.thickness_deviations = Some(wrong);
            let error = GearPair::resolve(&design).expect_err("not in order");
            assert!(
                error.to_string().contains("thickness_deviations"),
                "{error}"
            );
        }
    }

    #[test]
    fn a_circular_gear_has_the_textbook_measure() {
        // inv(alpha_M) = inv(alpha) + d / (z m cos alpha) - (space width on the pitch circle) ... :
        // the half angle of the space taken from the pin's own.
        for backlash in [0.0, 0.08] {
            let pair = circular(backlash);
            let (z, m, alpha) = (24.0, 2.0, 20.0_f64.to_radians());
            let d = 3.5;
            let base = 0.5 * m * z * alpha.cos();
            let thinned = backlash / (2.0 * alpha.cos());
            let space = 0.5 * std::f64::consts::PI * m + thinned;
            let inv = alpha.tan() - alpha + d / (2.0 * base) - space / (m * z);
            let radial = base / involute_angle(inv).cos() + 0.5 * d;
            for gear in [pair.driver(), pair.driven()] {
                let over = gear.over_pins(d);
                assert_eq!(over.pins.len(), 24);
                for (k, pin) in over.pins.iter().enumerate() {
                    let pin = pin.expect("measurable");
                    assert!(
                        (pin.radial - radial).abs() < 2e-9,
                        "{} {radial}",
                        pin.radial
                    );
                    let (j, across) = over.across(k).expect("opposite");
                    assert_eq!(j, (k + 12) % 24);
                    assert!((across - 2.0 * radial).abs() < 4e-9);
                }
            }
        }
    }

    #[test]
    fn the_pin_lies_between_its_own_two_teeth() {
        let pair = GearPair::resolve(&GearPairDesign::new(PitchSpec::Ellipse(Ellipse {
            eccentricity: 0.2679,
            module: Some(2.25),
            tooth_count: Some(23),
            ..Ellipse::default()
        })))
        .expect("a sound pair");
        for member in [Member::Driver, Member::Driven] {
            let gear = pair.gear(member);
            let d = pair.pin_diameter(member);
            assert_eq!(d, 3.75);
            let over = gear.over_pins(d);
            let pitch = gear.pitch_length() / 23.0;
            for (k, pin) in over.pins.iter().enumerate() {
                let pin = pin.expect("measurable");
                let tooth = &gear.teeth()[k];
                let middle = 0.5 * (tooth.leading.crossing + tooth.trailing.crossing) + 0.5 * pitch;
                let rolling = pair.rolling();
                let frame = rolling.frame(member, rolling.parameter(middle));
                let off = pin.center - frame.point;
                assert!(off.dot(&frame.tangent).abs() < 0.1 && off.dot(&frame.normal) > 0.0);
                for contact in pin.contacts {
                    assert!(((pin.center - contact).norm() - 0.5 * d).abs() < 1e-12);
                    let inside = contact + (contact - pin.center) * 1e-6;
                    assert!(gear.outline().contains(inside));
                }
            }
        }
    }

    #[test]
    fn a_pin_that_does_not_touch_the_flanks_says_why() {
        let gear = circular(0.0).driver().clone();
        let only = |d: f64| {
            let pins = gear.over_pins(d).pins;
            assert!(pins.windows(2).all(|w| w[0].is_err() && w[0] == w[1]));
            pins[0].expect_err("not measurable")
        };
        assert_eq!(only(0.5), PinFault::TooSmall);
        assert_eq!(only(9.0), PinFault::TooLarge);
        assert_eq!(only(f64::NAN), PinFault::TooSmall);
    }
}
