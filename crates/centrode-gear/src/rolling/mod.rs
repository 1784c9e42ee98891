mod error;
mod knots;
mod overlap;
mod pitch_contact;
mod resolve;

use std::f64::consts::{PI, TAU};
use std::sync::{Arc, OnceLock};

use centrode_geometry::{Antiderivative, Curve, Jet, Point, Vector, piece_ends};

pub use error::RollingError;
pub use pitch_contact::{CurvatureRange, PitchContact};

use super::pitch::{SampledLaw, Symmetry};

/// Number of equal parts of a turn in each of which a pitch curve has few extremes. Fewer can miss extremes, more take
/// longer.
const PIECES: u32 = 8;

/// Gear of a pair.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub enum Member {
    /// The gear that is turned; centred at the origin.
    Driver,
    /// The gear that is driven; centred at (a, 0).
    Driven,
}

centrode_spec::words!(Member {
    Driver = "driver",
    Driven = "driven",
});

impl Member {
    /// The other gear of the pair.
    #[must_use]
    pub fn mate(self) -> Self {
        match self {
            Self::Driver => Self::Driven,
            Self::Driven => Self::Driver,
        }
    }
}

/// Moving frame at a point of a rolling pitch curve, in which tools and mates are described.
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
/// driver to turns of driven), which requires one driver turn to give 2 pi n2/n1.
#[derive(Clone, Debug)]
pub struct Rolling {
    curve: Arc<dyn Curve>,
    /// Parameter at phi = 0.
    start: f64,
    /// Parameter at phi = pi.
    half: f64,
    /// The curve's breaks in `[start, start + period)`.
    jumps: Vec<f64>,
    /// Parameters of one turn with the polar angle at each: between two the curve is smooth and turns little.
    knots: Vec<[f64; 2]>,
    arc: Antiderivative,
    driven: Antiderivative,
    center_distance: f64,
    mean_ratio: (u32, u32),
    minimum: Extreme,
    maximum: Extreme,
    /// Number of waves of the radius per turn.
    swings: usize,
    symmetry: Symmetry,
    sampled: SampledLaw,
    /// Ranges of both curvatures, found when first needed.
    ranges: OnceLock<[CurvatureRange; 2]>,
}

/// Share of the period below which two parameters differ by rounding only.
const SAME: f64 = 1e-12;

/// A pitch radius that is the minimum or the maximum, and its parameter.
#[derive(Clone, Copy, Debug)]
struct Extreme {
    at: f64,
    radius: f64,
}

impl Rolling {
    /// Maximum number in a mean ratio.
    pub const MAX_TURNS: u32 = 50;

    /// Pitch curves whose driver is known to have a symmetry about its own angle zero.
    pub(crate) fn with_symmetry(self, symmetry: Symmetry) -> Self {
        Self { symmetry, ..self }
    }

    /// Pitch curves whose driver follows samples.
    pub(crate) fn with_samples(self, sampled: SampledLaw) -> Self {
        Self { sampled, ..self }
    }

    /// Facts about the samples that the driver's pitch curve follows.
    ///
    /// Corners are in order of the polar angle. A corner is where the polynomials through five samples before and after it meet at
    /// different slopes. At least 16 samples are needed, five of them between two corners; corners below 4e-3 rad are not
    /// reported.
    #[must_use]
    pub fn sampled(&self) -> &SampledLaw {
        &self.sampled
    }

    /// Symmetry of the driver's pitch curve, as far as it is known.
    pub(crate) fn symmetry(&self) -> Symmetry {
        self.symmetry
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

    /// Minimum and maximum radius of the pitch curve of a member, mm.
    #[must_use]
    pub fn radii(&self, member: Member) -> (f64, f64) {
        match member {
            Member::Driver => (self.minimum.radius, self.maximum.radius),
            Member::Driven => (
                self.center_distance - self.maximum.radius,
                self.center_distance - self.minimum.radius,
            ),
        }
    }

    /// Number of waves of the driver's radius per turn that exceed rounding. Waves on a radius that rises or falls throughout
    /// count, too. An ellipse about its focus has one wave.
    #[must_use]
    pub fn swings(&self) -> usize {
        self.swings
    }

    /// Whether the pitch curves have more than two waves per tooth of a driver with `teeth` teeth. Every wave has a peak of its
    /// own, so such teeth are sampled at few inputs.
    #[must_use]
    pub fn oscillates_per_tooth(&self, teeth: u32) -> bool {
        self.swings > 2 * teeth as usize
    }

    /// Minimum radius of curvature of both pitch curves, mm, among the nodes of the arc length's pieces.
    pub(crate) fn sharpest(&self) -> f64 {
        let nodes = self.arc.nodes().flat_map(|(t, _)| self.curvatures(t));
        1.0 / nodes.map(f64::abs).fold(0.0, f64::max)
    }

    /// Arc lengths at the minimum and the maximum driver radius, the first of each.
    pub(crate) fn extreme_arcs(&self) -> (f64, f64) {
        (
            self.arc_length(self.minimum.at),
            self.arc_length(self.maximum.at),
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

    /// Breaks strictly between two parameters, in order from the first to the second.
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
        piece_ends(start, end, PIECES, &self.breaks_between(start, end))
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

    /// Parameter reduced to the first turn, and the number of whole turns removed.
    pub(crate) fn wrapped(&self, t: f64) -> (f64, f64) {
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

    /// Polar angle within the turn of the parameter, whatever the rounding at the ends of the turn.
    pub(crate) fn polar_angle(&self, t: f64, jet: &Jet) -> f64 {
        let angle = jet.point.y.atan2(jet.point.x);
        let middle = if t <= self.half { 0.5 * PI } else { 1.5 * PI };
        angle + TAU * ((middle - angle) / TAU).round()
    }
}

#[cfg(test)]
mod tests;
