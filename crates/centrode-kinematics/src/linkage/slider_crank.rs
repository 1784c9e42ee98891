use std::f64::consts::PI;

use centrode_geometry::Point;

use super::dyad::{Branch, rrp};
use super::four_bar::FourBarError;
use super::point_series::PointSeries;
use crate::transmission::MotionJet;

/// A slider-crank: the crank turns about the origin, the slider runs along the line y = `offset`.
///
/// The upper branch has the slider at the far end, x = a cos phi + sqrt(b² - (e - a sin phi)²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliderCrank {
    crank: f64,
    rod: f64,
    offset: f64,
    branch: Branch,
}

impl SliderCrank {
    /// Makes a slider-crank of these lengths, mm.
    ///
    /// # Errors
    /// [`FourBarError::Length`].
    pub fn new(crank: f64, rod: f64, offset: f64, branch: Branch) -> Result<Self, FourBarError> {
        for (name, value) in [("crank", crank), ("rod", rod)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(FourBarError::Length { name, value });
            }
        }
        if !offset.is_finite() {
            let (name, value) = ("offset", offset);
            return Err(FourBarError::Length { name, value });
        }
        Ok(Self {
            crank,
            rod,
            offset,
            branch,
        })
    }

    /// Position of the slider along its line, mm, with derivatives per radian of crank angle.
    ///
    /// # Errors
    /// [`FourBarError::RodTooShort`] with the crank angle at which the rod is perpendicular to the line.
    pub fn slider(&self, input: f64) -> Result<MotionJet, FourBarError> {
        let b = PointSeries::<4>::turning(input).times(self.crank);
        let line = PointSeries::fixed(Point::new(0.0, self.offset));
        let along = PointSeries::fixed(Point::new(1.0, 0.0));
        let closed = rrp(b, self.rod, line, along, self.branch);
        if closed.room > 0.0 {
            return Ok(MotionJet::from_series(&closed.at.x));
        }
        let side = (self.crank * input.sin() - self.offset).signum();
        let limit = ((self.offset + side * self.rod) / self.crank).asin();
        let limit = if input.cos() < 0.0 { PI - limit } else { limit };
        Err(FourBarError::RodTooShort { input, limit })
    }

    /// Stroke of the slider, mm: sqrt((b + a)² - e²) - sqrt((b - a)² - e²); `None` if the crank cannot turn.
    #[must_use]
    pub fn stroke(&self) -> Option<f64> {
        let (a, b, e) = (self.crank, self.rod, self.offset);
        (b - a > e.abs())
            .then(|| ((b + a).powi(2) - e * e).sqrt() - ((b - a).powi(2) - e * e).sqrt())
    }
}
