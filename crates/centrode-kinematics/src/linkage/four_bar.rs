use std::f64::consts::{PI, TAU};

use centrode_geometry::{Jet, Point, WRITTEN};

use super::dyad::{Branch, Closed, Length, rrr};
use super::point_series::PointSeries;
use crate::formula::{Number, Taylor};
use crate::transmission::{MotionJet, Transmission};

/// Kind of four-bar, after Grashof (1883), named from the input crank.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
#[non_exhaustive]
pub enum Grashof {
    /// The crank turns, the rocker swings.
    CrankRocker,
    /// Crank and rocker both turn.
    DoubleCrank,
    /// The rocker turns, the crank swings.
    RockerCrank,
    /// The coupler turns relative to crank and rocker, which both swing.
    DoubleRocker,
    /// No link turns.
    TripleRocker,
    /// The shortest and longest link together are as long as the two others: the links can lie in one line, and both branches
    /// meet there.
    ChangePoint,
}

impl Grashof {
    /// Whether the crank turns fully and the branches never meet.
    #[must_use]
    pub fn crank_turns(self) -> bool {
        matches!(self, Self::CrankRocker | Self::DoubleCrank)
    }

    /// Name for reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::CrankRocker => "crank-rocker",
            Self::DoubleCrank => "double crank",
            Self::RockerCrank => "rocker-crank",
            Self::DoubleRocker => "double rocker",
            Self::TripleRocker => "triple rocker",
            Self::ChangePoint => "change point",
        }
    }
}

/// Reason why there is no such four-bar, or no such position of it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FourBarError {
    /// A length that is not above zero.
    #[error("{name} is {value} mm; it must be finite and above zero")]
    Length {
        /// Name of the length.
        name: &'static str,
        /// Length as given, mm.
        value: f64,
    },
    /// Coupler and rocker do not reach each other.
    #[error(
        "coupler and rocker cannot meet at the crank angle {input} rad; the crank stops at {limit} rad from the frame line"
    )]
    DoesNotClose {
        /// Crank angle, rad.
        input: f64,
        /// The limit of the crank, from 0 to pi either side of the frame line, rad.
        limit: f64,
    },
    /// The rod of a slider-crank does not reach the slider's line.
    #[error(
        "the rod does not reach the slider's line at the crank angle {input} rad; the crank stops at {limit} rad"
    )]
    RodTooShort {
        /// Crank angle, rad.
        input: f64,
        /// Crank angle at which the rod is perpendicular to the slider's line, rad; NaN if the rod reaches it at no angle.
        limit: f64,
    },
    /// Coupler and rocker lie in one line, but the crank can go on.
    #[error(
        "coupler and rocker lie in one line at the crank angle {input} rad, a change point: both branches meet there"
    )]
    ChangePoint {
        /// Crank angle, rad.
        input: f64,
    },
}

/// The positions at which crank and coupler lie in one line: the rocker's ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadCenters {
    /// Crank angle with crank and coupler stretched out, in [0, 2 pi), rad.
    pub stretched: f64,
    /// Crank angle with the crank folded onto the coupler, in [0, 2 pi), rad.
    pub folded: f64,
    /// The coupler's joint with the rocker, stretched out.
    pub stretched_at: Point,
    /// The coupler's joint with the rocker, folded.
    pub folded_at: Point,
}

/// A four-bar: the crank turns about A in the origin, the rocker about D at (`frame`, 0).
///
/// B is the joint of crank and coupler, C that of coupler and rocker. The upper branch has C to the left of the line from B to D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FourBar {
    crank: f64,
    coupler: f64,
    rocker: f64,
    frame: f64,
    branch: Branch,
}

impl FourBar {
    /// Makes a four-bar of these lengths, mm.
    ///
    /// # Errors
    /// [`FourBarError::Length`].
    pub fn new(
        crank: f64,
        coupler: f64,
        rocker: f64,
        frame: f64,
        branch: Branch,
    ) -> Result<Self, FourBarError> {
        let names = ["crank", "coupler", "rocker", "frame"];
        for (name, value) in names.into_iter().zip([crank, coupler, rocker, frame]) {
            if !(value.is_finite() && value > 0.0) {
                return Err(FourBarError::Length { name, value });
            }
        }
        Ok(Self {
            crank,
            coupler,
            rocker,
            frame,
            branch,
        })
    }

    /// Crank, coupler, rocker and frame, mm.
    #[must_use]
    pub fn lengths(&self) -> [f64; 4] {
        [self.crank, self.coupler, self.rocker, self.frame]
    }

    /// Assembly branch.
    #[must_use]
    pub fn branch(&self) -> Branch {
        self.branch
    }

    /// Grashof type: the shortest link turns relative to all others if shortest + longest < the other two together.
    #[must_use]
    pub fn grashof(&self) -> Grashof {
        let lengths = self.lengths();
        let shortest = lengths.into_iter().fold(f64::INFINITY, f64::min);
        let room = self.grashof_margin();
        let longest = lengths.into_iter().fold(0.0, f64::max);
        if room.abs() <= WRITTEN * longest {
            Grashof::ChangePoint
        } else if room < 0.0 {
            Grashof::TripleRocker
        } else if self.frame == shortest {
            Grashof::DoubleCrank
        } else if self.crank == shortest {
            Grashof::CrankRocker
        } else if self.rocker == shortest {
            Grashof::RockerCrank
        } else {
            Grashof::DoubleRocker
        }
    }

    /// Grashof margin: the two middle lengths less the shortest and the longest, mm, above zero where a link turns.
    #[must_use]
    pub fn grashof_margin(&self) -> f64 {
        let mut sorted = self.lengths();
        sorted.sort_by(f64::total_cmp);
        (sorted[1] - sorted[0]) - (sorted[3] - sorted[2])
    }

    /// Cosine of the crank angle at which the diagonal BD is `diagonal` long.
    fn cosine(&self, diagonal: f64) -> f64 {
        let (a, d) = (self.crank, self.frame);
        (a * a + d * d - diagonal * diagonal) / (2.0 * a * d)
    }

    /// The crank angles in [0, pi] between which the linkage closes, on either side of the frame line; `None` if it closes
    /// nowhere, (0, pi) for a crank that turns.
    ///
    /// The limits are where coupler and rocker lie in one line: cos phi = (crank² + frame² - d²) /
    /// (2 crank frame) with d = coupler + rocker or |coupler - rocker|.
    #[must_use]
    pub fn crank_limits(&self) -> Option<(f64, f64)> {
        let near = self.cosine((self.coupler - self.rocker).abs());
        let far = self.cosine(self.coupler + self.rocker);
        (near >= -1.0 && far <= 1.0).then(|| (near.min(1.0).acos(), far.max(-1.0).acos()))
    }

    /// Crank angles, 0 and pi, at which coupler and rocker lie in one line while the crank can go on; empty for most lengths.
    #[must_use]
    pub fn change_points(&self) -> Vec<f64> {
        let [a, b, c, d] = self.lengths();
        // The shortest diagonal folds them, the longest one stretches them.
        let ends = [
            (0.0, (d - a).abs() - (b - c).abs()),
            (PI, (d + a) - (b + c)),
        ];
        let rounding = WRITTEN * (a + d).max(b + c);
        let found = ends.into_iter().filter(|(_, room)| room.abs() <= rounding);
        found.map(|(input, _)| input).collect()
    }

    fn limit(&self, input: f64) -> FourBarError {
        let (low, high) = self.crank_limits().unwrap_or((f64::NAN, f64::NAN));
        let off = super::cycle::wrapped(input).abs();
        let limit = if (off - low).abs() < (off - high).abs() {
            low
        } else {
            high
        };
        // An angle at the frame line is known to the square root of rounding.
        let mut flat = self.change_points().into_iter();
        match flat.find(|point| (point - limit).abs() <= WRITTEN.sqrt()) {
            Some(input) => FourBarError::ChangePoint { input },
            None => FourBarError::DoesNotClose { input, limit },
        }
    }

    /// B, C and their motion, per radian of crank angle.
    ///
    /// # Errors
    /// [`FourBarError::DoesNotClose`].
    pub fn joints(&self, input: f64) -> Result<[Jet; 2], FourBarError> {
        let (b, c) = joints(
            self.lengths(),
            self.branch,
            PointSeries::<4>::turning(input),
        );
        if c.room > 0.0 {
            Ok([b.jet(), c.at.jet()])
        } else {
            Err(self.limit(input))
        }
    }

    /// The rocker's angle, from the direction A to D to the direction D to C, without jumps.
    ///
    /// # Errors
    /// [`FourBarError::DoesNotClose`].
    pub fn rocker_angle(&self, input: f64) -> Result<MotionJet, FourBarError> {
        let (_, c) = joints(
            self.lengths(),
            self.branch,
            PointSeries::<4>::turning(input),
        );
        if c.room > 0.0 {
            let d = PointSeries::fixed(Point::new(self.frame, 0.0));
            let mut jet = MotionJet::from_series(&c.at.minus(d).angle());
            jet.position = self.unwrapped_rocker(input);
            Ok(jet)
        } else {
            Err(self.limit(input))
        }
    }

    /// The coupler's angle, from the direction A to D to the direction B to C, without jumps.
    ///
    /// # Errors
    /// [`FourBarError::DoesNotClose`].
    pub fn coupler_angle(&self, input: f64) -> Result<MotionJet, FourBarError> {
        let (b, c) = joints(
            self.lengths(),
            self.branch,
            PointSeries::<4>::turning(input),
        );
        if c.room > 0.0 {
            let mut jet = MotionJet::from_series(&c.at.minus(b).angle());
            // The angle at C stays within (0, pi), so this angle has no jumps either.
            jet.position =
                self.unwrapped_rocker(input) - self.branch.sign() * self.transmission_angle(input);
            Ok(jet)
        } else {
            Err(self.limit(input))
        }
    }

    /// The rocker's angle without jumps: the direction D to B, unwrapped in closed form, less or plus
    /// the angle at D in the triangle BDC, which stays within (0, pi).
    pub(super) fn unwrapped_rocker(&self, input: f64) -> f64 {
        let (sin, cos) = input.sin_cos();
        let [a, b, c, d] = self.lengths();
        let to_b = if a < d {
            PI + (-a * sin).atan2(d - a * cos)
        } else {
            input + (d * sin).atan2(a - d * cos)
        };
        let s = a * a + d * d - 2.0 * a * d * cos;
        let cosine = (s + c * c - b * b) / (2.0 * s.sqrt() * c);
        to_b - self.branch.sign() * cosine.clamp(-1.0, 1.0).acos()
    }

    /// The angle at C between coupler and rocker, in (0, pi), rad: cos mu = (coupler² + rocker² - BD²) /
    /// (2 coupler rocker). It transmits force best at a right angle. NaN where the four-bar does not close.
    #[must_use]
    pub fn transmission_angle(&self, input: f64) -> f64 {
        let (a, d) = (self.crank, self.frame);
        let s = a * a + d * d - 2.0 * a * d * input.cos();
        self.angle_at_c(s)
    }

    fn angle_at_c(&self, squared_diagonal: f64) -> f64 {
        let (b, c) = (self.coupler, self.rocker);
        ((b * b + c * c - squared_diagonal) / (2.0 * b * c)).acos()
    }

    /// The minimum angle between the lines of coupler and rocker over the turn of the crank, rad; 0 where
    /// the crank cannot turn.
    #[must_use]
    pub fn minimum_transmission_angle(&self) -> f64 {
        if !self.grashof().crank_turns() {
            return 0.0;
        }
        let near = self.angle_at_c((self.frame - self.crank).powi(2));
        let far = self.angle_at_c((self.frame + self.crank).powi(2));
        near.min(PI - far).min(far).min(PI - near)
    }

    /// Dead centres, where crank and coupler lie in one line; `None` unless it is a crank-rocker.
    #[must_use]
    pub fn dead_centers(&self) -> Option<DeadCenters> {
        if self.grashof() != Grashof::CrankRocker {
            return None;
        }
        let sign = self.branch.sign();
        let at = |reach: f64| {
            let (c, d) = (self.rocker, self.frame);
            let cosine = (reach * reach + d * d - c * c) / (2.0 * reach * d);
            let angle = sign * cosine.clamp(-1.0, 1.0).acos();
            (angle, Point::new(reach * angle.cos(), reach * angle.sin()))
        };
        let (stretched, stretched_at) = at(self.coupler + self.crank);
        let reach = self.coupler - self.crank;
        let (to_folded, folded_at) = at(reach);
        Some(DeadCenters {
            stretched: stretched.rem_euclid(TAU),
            folded: (to_folded + PI).rem_euclid(TAU),
            stretched_at,
            folded_at,
        })
    }

    /// Angle between the rocker's ends, rad; `None` unless it is a crank-rocker.
    #[must_use]
    pub fn rocker_swing(&self) -> Option<f64> {
        let dead = self.dead_centers()?;
        let ends = [dead.stretched, dead.folded].map(|phi| self.unwrapped_rocker(phi));
        Some((ends[0] - ends[1]).abs())
    }

    /// Crank angle of the slower stroke of the rocker, rad; `None` unless it is a crank-rocker.
    #[must_use]
    pub fn slow_stroke(&self) -> Option<f64> {
        let dead = self.dead_centers()?;
        let one = (dead.folded - dead.stretched).rem_euclid(TAU);
        Some(one.max(TAU - one))
    }

    /// Time of the slower stroke divided by that of the quicker one; `None` unless it is a crank-rocker.
    #[must_use]
    pub fn quick_return(&self) -> Option<f64> {
        self.slow_stroke().map(|slow| slow / (TAU - slow))
    }

    /// The rocker's angle as a function of the crank angle.
    ///
    /// # Errors
    /// [`FourBarError::DoesNotClose`] if the crank cannot turn; [`FourBarError::ChangePoint`] if it passes a change point.
    pub fn transmission(&self) -> Result<impl Transmission + use<>, FourBarError> {
        if !self.grashof().crank_turns() {
            let flat = self.change_points().first().copied();
            let (low, high) = self.crank_limits().unwrap_or_default();
            let past = if low > 0.0 { 0.0 } else { high };
            return Err(self.limit(flat.unwrap_or(past)));
        }
        let four_bar = *self;
        let advance = if self.grashof() == Grashof::DoubleCrank {
            TAU
        } else {
            0.0
        };
        let at = move |input: f64| four_bar.rocker_angle(input).unwrap_or_default();
        Ok(crate::transmission::FromFn::new(
            TAU,
            advance,
            Vec::new(),
            at,
        ))
    }
}

/// B and C of a four-bar whose lengths may be series, for the crank's unit vector.
#[inline(always)]
pub(super) fn joints<const N: usize, T: Number, L: Length<N, T>>(
    [a, b, c, d]: [L; 4],
    branch: Branch,
    crank: PointSeries<N, T>,
) -> (PointSeries<N, T>, Closed<N, T>) {
    let at_b = PointSeries {
        x: a.times(crank.x),
        y: a.times(crank.y),
    };
    let at_d = PointSeries {
        x: d.series(),
        y: Taylor::constant(T::from(0.0)),
    };
    (at_b, rrr(at_b, at_d, (b, c), branch))
}
