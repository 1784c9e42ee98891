use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::{Antiderivative, Curve, Jet, Point, Vector, bracketed_root, pieces};

/// Even parts of a turn in each of which a pitch curve has few extremes.
const PIECES: u32 = 8;

/// Gear of a pair.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub enum Member {
    /// The gear that is turned; centred at the origin.
    Driver,
    /// The gear that is driven; centred at (a, 0).
    Driven,
}

impl Member {
    /// The other gear of the pair.
    #[must_use]
    pub fn mate(self) -> Self {
        match self {
            Self::Driver => Self::Driven,
            Self::Driven => Self::Driver,
        }
    }

    /// The name used in files and reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Driver => "driver",
            Self::Driven => "driven",
        }
    }
}

/// Moving frame at a point of a rolling pitch curve, in which both tools and mates are seen.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// The point, in the gear's own body frame, mm.
    pub point: Point,
    /// Unit tangent in the direction of growing arc length.
    pub tangent: Vector,
    /// Unit normal, out of the material.
    pub normal: Vector,
    /// Curvature (1/mm), positive where the gear is convex.
    pub curvature: f64,
    /// Arc length from the start of the cycle, mm; the same on both curves, which roll without slip.
    pub arc: f64,
    /// Arc length per curve parameter.
    pub speed: f64,
}

/// Two pitch curves rolling on each other about fixed centres.
///
/// The driver's polar angle phi runs against its rotation: at phi the driver has turned by -phi and
/// the driven gear, centred at (a, 0), by +phi2, with d phi2/d phi = r/(a - r). Both body frames are
/// parallel to the world's at phi = 0.
///
/// Source: Litvin's centrode relations; the closure is derived again for a mean ratio n1:n2 (turns of
/// driver to turns of driven), which asks one driver turn to give 2 pi n2/n1.
#[derive(Clone, Debug)]
pub struct Rolling {
    curve: Arc<dyn Curve>,
    /// Parameter at phi = 0.
    start: f64,
    /// Parameter at phi = pi.
    half: f64,
    /// The curve's breaks in `[start, start + period)`.
    jumps: Vec<f64>,
    arc: Antiderivative,
    driven: Antiderivative,
    center_distance: f64,
    mean_ratio: (u32, u32),
    least: Extreme,
    greatest: Extreme,
}

/// Share of the period within which two parameters are the same but for rounding.
const SAME: f64 = 1e-12;

/// A pitch radius that is the least or the greatest, and the parameter it is at.
#[derive(Clone, Copy, Debug)]
struct Extreme {
    at: f64,
    radius: f64,
}

/// Reason why two pitch curves cannot roll on each other.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RollingError {
    /// The pitch curve does not wind once around the shaft.
    #[error(
        "the pitch curve turns by {turned} rad about the shaft in one round; it must turn by 2 pi, always forward"
    )]
    NotAroundAxis {
        /// Polar angle swept in one round, rad.
        turned: f64,
    },
    /// The mean ratio has no closed driven curve.
    #[error("mean ratio {}:{} needs a driver that repeats {} times a turn, but its radius differs by {difference:e} mm between repeats", ratio.0, ratio.1, ratio.1)]
    NotPeriodic {
        /// Turns of driver : turns of driven.
        ratio: (u32, u32),
        /// Greatest difference found, mm.
        difference: f64,
    },
    /// A mean ratio with a zero or absurd number in it.
    #[error("mean ratio {}:{} must be two counts from 1 to {}", ratio.0, ratio.1, Rolling::GREATEST_TURNS)]
    MeanRatio {
        /// Turns of driver : turns of driven.
        ratio: (u32, u32),
    },
    /// No centre distance closes the driven curve.
    #[error(
        "no centre distance closes the driven curve: at {center_distance} mm one driver turn gives {turned} rad of {wanted}"
    )]
    NoClosure {
        /// The last centre distance tried, mm.
        center_distance: f64,
        /// Driven angle of one driver turn, rad.
        turned: f64,
        /// Angle it should be, rad.
        wanted: f64,
    },
}

impl Rolling {
    /// Greatest number in a mean ratio.
    pub const GREATEST_TURNS: u32 = 50;

    /// Finds the centre distance at which `curve` drives a closed conjugate curve at `mean_ratio`
    /// (turns of driver : turns of driven).
    ///
    /// # Errors
    /// [`RollingError`] when no such curve exists.
    pub fn of(curve: Arc<dyn Curve>, mean_ratio: (u32, u32)) -> Result<Self, RollingError> {
        let ratio = reduced(mean_ratio)?;
        let period = curve.period();
        let (start, half) = axis_crossings(&*curve, period)?;
        let breaks = curve.breaks();
        // A curve drawn from angle zero on has a break there: rounding must not part the two, nor the break
        // from itself a turn on.
        let on = breaks.iter().find(|&&b| (b - start).abs() <= SAME * period);
        let start = on.copied().unwrap_or(start);
        let mut jumps: Vec<f64> = breaks
            .into_iter()
            .map(|b| if b < start { b + period } else { b })
            .collect();
        jumps.sort_by(f64::total_cmp);
        let mut breaks = vec![start];
        breaks.extend(jumps.iter().copied().filter(|&b| b > start));
        breaks.push(start + period);

        let arc = Antiderivative::of(|t| curve.at(t).first.norm(), &breaks);
        let nodes: Vec<(f64, f64)> = arc
            .nodes()
            .map(|(t, weight)| {
                let jet = curve.at(t);
                (
                    jet.point.coords.norm(),
                    weight * jet.point.coords.perp(&jet.first),
                )
            })
            .collect();
        let (least, greatest) = extremes(&*curve, &arc);
        let wanted = TAU * f64::from(ratio.1) / f64::from(ratio.0);
        let mut a = closure(&nodes, greatest.radius, wanted);
        let mut driven = driven_angle(&*curve, &breaks, a);
        for _ in 0..4 {
            let missing = driven.total() - wanted;
            if missing.abs() <= 1e-15 * wanted {
                break;
            }
            let slope: f64 = nodes
                .iter()
                .map(|&(r, w)| -w / (r * (a - r) * (a - r)))
                .sum();
            let better = a - missing / slope;
            if better <= greatest.radius || better == a {
                break;
            }
            let retry = driven_angle(&*curve, &breaks, better);
            if (retry.total() - wanted).abs() >= missing.abs() {
                break;
            }
            (a, driven) = (better, retry);
        }
        if (driven.total() - wanted).abs().is_nan()
            || (driven.total() - wanted).abs() > 1e-12 * wanted
        {
            return Err(RollingError::NoClosure {
                center_distance: a,
                turned: driven.total(),
                wanted,
            });
        }
        let rolling = Self {
            curve,
            start,
            half,
            jumps,
            arc,
            driven,
            center_distance: a,
            mean_ratio: ratio,
            least,
            greatest,
        };
        rolling.check_repeats()?;
        Ok(rolling)
    }

    /// Checks that a driver repeats n2 times a turn, without which the driven curve would not close after its own turn.
    fn check_repeats(&self) -> Result<(), RollingError> {
        let repeats = self.mean_ratio.1;
        if repeats == 1 {
            return Ok(());
        }
        let mut difference = 0.0_f64;
        for i in 0..256 {
            let phi = TAU * f64::from(i) / 256.0;
            let r = self.radius(phi);
            let again = self.radius(phi + TAU / f64::from(repeats));
            difference = difference.max((again - r).abs());
        }
        if difference > 1e-9 * self.greatest.radius {
            return Err(RollingError::NotPeriodic {
                ratio: self.mean_ratio,
                difference,
            });
        }
        Ok(())
    }

    /// The driver's pitch curve.
    #[must_use]
    pub fn curve(&self) -> &Arc<dyn Curve> {
        &self.curve
    }

    /// Distance between the shafts, mm.
    #[must_use]
    pub fn center_distance(&self) -> f64 {
        self.center_distance
    }

    /// Turns of driver : turns of driven, in lowest terms.
    #[must_use]
    pub fn mean_ratio(&self) -> (u32, u32) {
        self.mean_ratio
    }

    /// Length of the pitch curve of a member, mm.
    #[must_use]
    pub fn pitch_length(&self, member: Member) -> f64 {
        match member {
            Member::Driver => self.arc.total(),
            Member::Driven => {
                self.arc.total() * f64::from(self.mean_ratio.0) / f64::from(self.mean_ratio.1)
            }
        }
    }

    /// Least and greatest radius of the pitch curve of a member, mm.
    #[must_use]
    pub fn radii(&self, member: Member) -> (f64, f64) {
        match member {
            Member::Driver => (self.least.radius, self.greatest.radius),
            Member::Driven => (
                self.center_distance - self.greatest.radius,
                self.center_distance - self.least.radius,
            ),
        }
    }

    /// Arc lengths at the least and the greatest driver radius, the first of each.
    pub(crate) fn extreme_arcs(&self) -> (f64, f64) {
        (
            self.arc_length(self.least.at),
            self.arc_length(self.greatest.at),
        )
    }

    /// The sharpest corner of the pitch curve: change of direction and polar angle, rad.
    pub(crate) fn corner(&self) -> Option<(f64, f64)> {
        let turn = |&b: &f64| {
            let (before, after) = (self.curve.at(b.next_down()).first, self.curve.at(b).first);
            (before.perp(&after).atan2(before.dot(&after)), self.angle(b))
        };
        let sharpest = self
            .jumps
            .iter()
            .map(turn)
            .max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        // Far above the rounding of a direction, far below any drawn corner.
        (sharpest.0.abs() > 1e-7).then_some(sharpest)
    }

    /// Closure error of the cycle, rad: driven angle of one driver turn less 2 pi n2/n1.
    #[must_use]
    pub fn closure_error(&self) -> f64 {
        self.driven.total() - TAU * f64::from(self.mean_ratio.1) / f64::from(self.mean_ratio.0)
    }

    /// Curve parameter at an arc length from the start of the cycle; any real arc length.
    #[must_use]
    pub fn parameter(&self, arc: f64) -> f64 {
        let turns = (arc / self.arc.total()).floor();
        let rest = (arc - turns * self.arc.total()).clamp(0.0, self.arc.total());
        self.arc.inverse(rest) + turns * self.curve.period()
    }

    /// Curve parameter at a driver polar angle; any real angle.
    #[must_use]
    pub fn parameter_at_angle(&self, phi: f64) -> f64 {
        let period = self.curve.period();
        let turns = (phi / TAU).floor();
        let wanted = phi - turns * TAU;
        let angle = |t: f64| self.polar_angle(t, &self.curve.at(t)) - wanted;
        let (low, high) = (self.start, self.start + period);
        let (f_low, f_high) = (-wanted, TAU - wanted);
        bracketed_root(angle, low, high, f_low, f_high) + turns * period
    }

    /// Curve parameter at a driven angle; any real angle.
    #[must_use]
    pub fn parameter_at_driven_angle(&self, phi2: f64) -> f64 {
        let total = self.driven.total();
        let turns = (phi2 / total).floor();
        let rest = (phi2 - turns * total).clamp(0.0, total);
        self.driven.inverse(rest) + turns * self.curve.period()
    }

    /// Driver polar angle at a parameter.
    #[must_use]
    pub fn angle(&self, t: f64) -> f64 {
        let (inside, turns) = self.wrapped(t);
        self.polar_angle(inside, &self.curve.at(inside)) + turns * TAU
    }

    /// Arc length at a parameter.
    #[must_use]
    pub fn arc_length(&self, t: f64) -> f64 {
        let (inside, turns) = self.wrapped(t);
        self.arc.at(inside) + turns * self.arc.total()
    }

    /// Driven angle phi2 at a parameter.
    #[must_use]
    pub fn driven_angle_at(&self, t: f64) -> f64 {
        let (inside, turns) = self.wrapped(t);
        self.driven.at(inside) + turns * self.driven.total()
    }

    /// Driven angle at a driver angle: the pair's transmission function, any real angle.
    #[must_use]
    pub fn driven_angle(&self, phi: f64) -> f64 {
        self.driven_angle_at(self.parameter_at_angle(phi))
    }

    /// Radius of the driver's pitch curve at its polar angle, mm.
    #[must_use]
    pub fn radius(&self, phi: f64) -> f64 {
        self.curve
            .at(self.parameter_at_angle(phi))
            .point
            .coords
            .norm()
    }

    /// Driven turn per driver turn at a driver angle: r/(a - r).
    #[must_use]
    pub fn ratio(&self, phi: f64) -> f64 {
        let r = self.radius(phi);
        r / (self.center_distance - r)
    }

    /// Change of the ratio per radian of driver angle.
    #[must_use]
    pub fn ratio_slope(&self, phi: f64) -> f64 {
        let jet = self.curve.at(self.parameter_at_angle(phi));
        let r = jet.point.coords.norm();
        let turn = jet.point.coords.perp(&jet.first) / (r * r);
        let slope = jet.point.coords.dot(&jet.first) / r / turn;
        let rest = self.center_distance - r;
        self.center_distance * slope / (rest * rest)
    }

    /// The rolling frame of a member at a curve parameter, in that member's body frame.
    #[must_use]
    pub fn frame(&self, member: Member, t: f64) -> Frame {
        let (inside, turns) = self.wrapped(t);
        let jet = self.curve.at(inside);
        let speed = jet.first.norm();
        let tangent = jet.first / speed;
        let arc = self.arc.at(inside) + turns * self.arc.total();
        let normal = Vector::new(tangent.y, -tangent.x);
        let curvature = jet.curvature();
        if member == Member::Driver {
            return Frame {
                point: jet.point,
                tangent,
                normal,
                curvature,
                arc,
                speed,
            };
        }
        let r = jet.point.coords.norm();
        let rest = self.center_distance - r;
        let phi2 = self.driven.at(inside) + turns * self.driven.total();
        let (sin2, cos2) = phi2.sin_cos();
        // World directions: the driver is turned back by its polar angle, whose cosine is x/r.
        let (cos1, sin1) = (jet.point.x / r, jet.point.y / r);
        let world = Vector::new(
            cos1 * tangent.x + sin1 * tangent.y,
            -sin1 * tangent.x + cos1 * tangent.y,
        );
        let tangent2 = Vector::new(
            cos2 * world.x + sin2 * world.y,
            -sin2 * world.x + cos2 * world.y,
        );
        // d phi/ds = sin(radius, tangent)/r, which is also -N's share along the centre line.
        let turn = world.y / r;
        let turn2 = world.y / rest;
        Frame {
            point: Point::new(-rest * cos2, rest * sin2),
            tangent: tangent2,
            normal: Vector::new(-tangent2.y, tangent2.x),
            curvature: turn + turn2 - curvature,
            arc,
            speed,
        }
    }

    /// Breaks strictly between two parameters, in the order walked.
    pub(crate) fn breaks_between(&self, from: f64, to: f64) -> Vec<f64> {
        if self.jumps.is_empty() {
            return Vec::new();
        }
        let period = self.curve.period();
        let (low, high) = (from.min(to), from.max(to));
        let turn = |t: f64| ((t - self.start) / period).floor() as i64;
        let mut out: Vec<f64> = (turn(low)..=turn(high))
            .flat_map(|turn| self.jumps.iter().map(move |b| b + turn as f64 * period))
            .filter(|&b| b > low && b < high)
            .collect();
        if to < from {
            out.reverse();
        }
        out
    }

    /// Parameters of one turn of the driver's pitch curve between which both curves are smooth and short.
    pub(crate) fn pieces(&self) -> Vec<f64> {
        let (start, end) = (self.start, self.start + self.curve.period());
        pieces(start, end, PIECES, &self.breaks_between(start, end))
    }

    /// Breaks in `[from, to)`.
    pub(crate) fn jumps_in(&self, from: f64, to: f64) -> Vec<f64> {
        let mut out = self.breaks_between(from, to);
        if self.is_jump(from) {
            out.insert(0, from);
        }
        out
    }

    /// Whether the pitch curve has a break at exactly this parameter.
    pub(crate) fn is_jump(&self, t: f64) -> bool {
        if self.jumps.is_empty() {
            return false;
        }
        let (inside, _) = self.wrapped(t);
        self.jumps.contains(&inside)
    }

    fn wrapped(&self, t: f64) -> (f64, f64) {
        let period = self.curve.period();
        if t >= self.start && t <= self.start + period {
            return (t, 0.0);
        }
        let turns = ((t - self.start) / period).floor();
        (
            (t - turns * period).clamp(self.start, self.start + period),
            turns,
        )
    }

    /// Polar angle in the turn the parameter lies in, whatever the rounding at its ends.
    fn polar_angle(&self, t: f64, jet: &Jet) -> f64 {
        let angle = jet.point.y.atan2(jet.point.x);
        let middle = if t <= self.half { 0.5 * PI } else { 1.5 * PI };
        angle + TAU * ((middle - angle) / TAU).round()
    }
}

fn reduced(ratio: (u32, u32)) -> Result<(u32, u32), RollingError> {
    let (mut a, mut b) = ratio;
    while b != 0 {
        (a, b) = (b, a % b);
    }
    let fair = |n: u32| (1..=Rolling::GREATEST_TURNS).contains(&n);
    if a == 0 || !fair(ratio.0 / a) || !fair(ratio.1 / a) {
        return Err(RollingError::MeanRatio { ratio });
    }
    Ok((ratio.0 / a, ratio.1 / a))
}

/// Parameters at polar angle 0 and pi.
fn axis_crossings(curve: &dyn Curve, period: f64) -> Result<(f64, f64), RollingError> {
    const SAMPLES: usize = 128;
    let t = |i: usize| period * i as f64 / SAMPLES as f64;
    let mut points: Vec<Point> = (0..SAMPLES).map(|i| curve.at(t(i)).point).collect();
    // The end of the turn is its start, to the last digit.
    points.push(points[0]);
    let mut turned = 0.0;
    let (mut start, mut half) = (None, None);
    for i in 0..SAMPLES {
        let (p, q) = (points[i], points[i + 1]);
        turned += p.coords.perp(&q.coords).atan2(p.coords.dot(&q.coords));
        let crossing = || bracketed_root(|t| curve.at(t).point.y, t(i), t(i + 1), p.y, q.y);
        if p.y < 0.0 && q.y >= 0.0 {
            start = Some(crossing());
        }
        if p.y >= 0.0 && q.y < 0.0 {
            half = Some(crossing());
        }
    }
    match (start, half) {
        (Some(start), Some(half)) if (turned - TAU).abs() < 1e-6 => {
            // A start at the very end of the turn is one at its start.
            let start = if period - start <= SAME * period {
                0.0
            } else {
                start
            };
            let half = if half < start { half + period } else { half };
            Ok((start, half))
        }
        _ => Err(RollingError::NotAroundAxis { turned }),
    }
}

/// Least and greatest radius, sharpened from the samples of the arc-length panels.
fn extremes(curve: &dyn Curve, arc: &Antiderivative) -> (Extreme, Extreme) {
    let slope = |t: f64| {
        let jet = curve.at(t);
        jet.point.coords.dot(&jet.first)
    };
    let mut samples: Vec<f64> = arc.nodes().map(|(t, _)| t).collect();
    samples.sort_by(f64::total_cmp);
    let mut least = Extreme {
        at: 0.0,
        radius: f64::INFINITY,
    };
    let mut greatest = Extreme {
        at: 0.0,
        radius: 0.0,
    };
    let mut take = |at: f64| {
        let radius = curve.at(at).point.coords.norm();
        if radius < least.radius {
            least = Extreme { at, radius };
        }
        if radius > greatest.radius {
            greatest = Extreme { at, radius };
        }
    };
    let count = samples.len();
    for i in 0..count {
        let a = samples[i];
        let b = if i + 1 < count {
            samples[i + 1]
        } else {
            samples[0] + curve.period()
        };
        let (fa, fb) = (slope(a), slope(b));
        if (fa > 0.0) != (fb > 0.0) {
            take(bracketed_root(slope, a, b, fa, fb));
        }
        take(a);
    }
    (least, greatest)
}

/// Newton's method kept above the greatest radius, where the driven angle falls from infinity to zero.
fn closure(nodes: &[(f64, f64)], greatest: f64, wanted: f64) -> f64 {
    let turned = |a: f64| -> (f64, f64) {
        let (mut sum, mut slope) = (0.0, 0.0);
        for &(r, w) in nodes {
            let part = w / (r * (a - r));
            sum += part;
            slope -= part / (a - r);
        }
        (sum, slope)
    };
    let mut low = greatest;
    let mut high = f64::INFINITY;
    // A circle of the greatest radius would need this distance; the answer is below it.
    let mut a = greatest * (1.0 + TAU / wanted);
    for _ in 0..100 {
        let (sum, slope) = turned(a);
        if sum > wanted {
            low = low.max(a);
        } else {
            high = high.min(a);
        }
        let mut next = a - (sum - wanted) / slope;
        if !(next > low && next < high) {
            next = if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * a
            };
        }
        let done = (next - a).abs() <= 2.0 * f64::EPSILON * a;
        a = next;
        if done {
            break;
        }
    }
    a
}

fn driven_angle(curve: &dyn Curve, breaks: &[f64], a: f64) -> Antiderivative {
    Antiderivative::of(
        |t| {
            let jet = curve.at(t);
            let r = jet.point.coords.norm();
            jet.point.coords.perp(&jet.first) / (r * (a - r))
        },
        breaks,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear::pitch::{Bspline, PitchSpec};

    #[test]
    fn a_knot_where_the_cycle_starts_is_its_start_whatever_the_rounding() {
        for degree in 2..=5 {
            for count in 6..30 {
                let step = TAU / f64::from(count);
                let spline = Bspline {
                    degree,
                    interpolate: true,
                    radius: (0..count).map(|i| 30.0 + f64::from(i * i % 7)).collect(),
                    angle: (0..count).map(|i| step * f64::from(i)).collect(),
                    ..Bspline::default()
                };
                let curve = PitchSpec::Bspline(spline).resolve().expect("a curve").curve;
                let rolling = Rolling::of(curve, (1, 1)).expect("rolls");
                let (start, end) = (rolling.start, rolling.start + f64::from(count));
                let frame = rolling.frame(Member::Driven, end);
                assert!((frame.arc / rolling.arc.total() - 1.0).abs() < 1e-15);
                assert!(frame.point.coords.norm().is_finite());
                // Between knots there is a whole span, or where the cycle starts inside one, two parts of it.
                let inside = rolling.breaks_between(start, end);
                let spans = inside.windows(2).map(|w| w[1] - w[0]);
                assert!(spans.clone().all(|s| (s - 1.0).abs() < 1e-9), "{inside:?}");
                let knot = degree % 2 == 1;
                assert_eq!(
                    inside.len(),
                    count as usize - usize::from(knot),
                    "{degree} {count}"
                );
            }
        }
    }
}
