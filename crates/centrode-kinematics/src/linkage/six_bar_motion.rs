use centrode_geometry::{Jet, Point};

use super::four_bar::joints;
use super::point_series::PointSeries;
use super::six_bar::SixBar;
use crate::formula::{LANES, Lanes, Number, Taylor, groups};
use crate::transmission::MotionJet;

/// Positions and motion of a six-bar at one crank angle, per radian of crank angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SixBarPosition {
    /// Joint of crank and coupler.
    pub b: Jet,
    /// Joint of coupler and rocker, and the slider.
    pub c: Jet,
    /// Tip of the effector.
    pub e: Jet,
    /// Angle of the effector, without jumps.
    pub effector: MotionJet,
}

/// Moving quantities at one input or at several side by side.
struct Moving<T> {
    b: PointSeries<4, T>,
    c: PointSeries<4, T>,
    e: PointSeries<4, T>,
    effector: Taylor<4, T>,
}

impl<T: Number> Moving<T> {
    #[inline(always)]
    fn position(&self, lane: usize) -> SixBarPosition {
        SixBarPosition {
            b: self.b.jet_of(lane),
            c: self.c.jet_of(lane),
            e: self.e.jet_of(lane),
            effector: MotionJet::of_lane(&self.effector, lane),
        }
    }
}

/// Results at each of many inputs, computed side by side.
#[inline(always)]
fn each<R>(inputs: &[f64], at: impl Fn(Lanes) -> [R; LANES]) -> Vec<R> {
    let answers: Vec<[R; LANES]> = groups(inputs).map(at).collect();
    let mut answers = answers.into_flattened();
    answers.truncate(inputs.len());
    answers
}

impl SixBar {
    /// The crank's joint and the slider.
    #[inline(always)]
    fn joint_series<const N: usize, T: Number>(&self, input: T) -> [PointSeries<N, T>; 2] {
        let (lengths, branch) = (self.four_bar().lengths(), self.four_bar().branch());
        let (b, c) = joints(lengths, branch, PointSeries::turning(input));
        [b, c.at]
    }

    /// Vector from the effector's pivot to the slider.
    #[inline(always)]
    fn way<const N: usize, T: Number>(&self, slider: PointSeries<N, T>) -> PointSeries<N, T> {
        slider.minus(PointSeries::fixed(self.pivot()))
    }

    /// The tip of the effector along a unit vector.
    #[inline(always)]
    fn tip<const N: usize, T: Number>(&self, unit: PointSeries<N, T>) -> PointSeries<N, T> {
        let way = unit.times(self.effector_length());
        PointSeries::fixed(self.pivot()).plus(way)
    }

    #[inline(always)]
    fn moving<T: Number>(&self, input: T) -> Moving<T> {
        let [b, c] = self.joint_series(input);
        let way = self.way(c);
        let direction = way.angle();
        let e = self.tip(way.unit_along(direction));
        let effector = self.laps.unwrapped(direction);
        Moving { b, c, e, effector }
    }

    /// Every joint at a crank angle.
    #[must_use]
    pub fn at(&self, input: f64) -> SixBarPosition {
        self.moving(input).position(0)
    }

    /// Every joint at each of many crank angles: equal to [`at`](Self::at) but for a few units in the last digit,
    /// computed side by side in half its time.
    #[must_use]
    pub fn at_each(&self, inputs: &[f64]) -> Vec<SixBarPosition> {
        each(inputs, |input| {
            let moving = self.moving(input);
            std::array::from_fn(|lane| moving.position(lane))
        })
    }

    /// B, C and E at one input or at several side by side.
    #[inline(always)]
    fn places<T: Number>(&self, input: T) -> [PointSeries<1, T>; 3] {
        let [b, c] = self.joint_series(input);
        [b, c, self.tip(self.way(c).unit_now())]
    }

    /// B, C and E at a crank angle, without derivatives.
    #[must_use]
    pub fn joints(&self, input: f64) -> [Point; 3] {
        self.places(input).map(PointSeries::value)
    }

    /// B, C and E at each of many crank angles, without derivatives, computed like [`at_each`](Self::at_each).
    #[must_use]
    pub fn joints_each(&self, inputs: &[f64]) -> Vec<[Point; 3]> {
        each(inputs, |input| {
            let [b, c, e] = self.places(input);
            let at = |lane| [b.value_of(lane), c.value_of(lane), e.value_of(lane)];
            std::array::from_fn(at)
        })
    }

    #[inline(always)]
    fn effector<const N: usize, T: Number>(&self, input: T) -> Taylor<N, T> {
        let [_, c] = self.joint_series(input);
        self.laps.unwrapped(self.way(c).angle())
    }

    /// The effector's angle and its derivatives by the crank angle, without jumps.
    #[must_use]
    pub fn effector_angle(&self, input: f64) -> MotionJet {
        MotionJet::from_series(&self.effector::<4, f64>(input))
    }

    /// Angle of the effector at each of many crank angles, computed like [`at_each`](Self::at_each).
    #[must_use]
    pub fn effector_angle_each(&self, inputs: &[f64]) -> Vec<MotionJet> {
        each(inputs, |input| {
            let effector = self.effector::<4, Lanes>(input);
            std::array::from_fn(|lane| MotionJet::of_lane(&effector, lane))
        })
    }

    /// Angle of the effector at each of many crank angles, without jumps and without derivatives, computed like
    /// [`at_each`](Self::at_each).
    #[must_use]
    pub fn effector_place_each(&self, inputs: &[f64]) -> Vec<f64> {
        each(inputs, |input| {
            let [angle] = self.effector::<1, Lanes>(input).0;
            std::array::from_fn(|lane| angle.lane(lane))
        })
    }

    /// Distance of the slider from the effector's pivot, and its derivatives by the crank angle.
    #[must_use]
    pub fn slider_distance(&self, input: f64) -> MotionJet {
        let [_, c] = self.joint_series::<4, f64>(input);
        let way = self.way(c);
        MotionJet::from_series(&way.dot(way).sqrt())
    }
}
