use std::sync::Arc;

use centrode_geometry::Point;

use super::assembly::{Linkage, Step};
use super::error::LinkageError;
use super::parts::{JointId, Line, LinkId};
use super::pose::BodyMotion;
use super::series::Series;
use crate::transmission::{MotionJet, Transmission, repeated, sorted};

impl Step {
    /// Whether it closes a loop.
    pub(super) fn is_dyad(&self) -> bool {
        matches!(
            self,
            Self::Rrr { .. }
                | Self::Rrp { .. }
                | Self::Rpr { .. }
                | Self::Prp { .. }
                | Self::Rpp { .. }
        )
    }
}

impl Linkage {
    /// Input after which the linkage repeats, rad.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Inputs in `[0, period)` where a derivative of a law may jump, ascending.
    #[must_use]
    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Adds a link that turns about a joint, its first axis at the law's angle (rad) to that of the joint's link.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`].
    pub fn turning(
        &mut self,
        pivot: JointId,
        law: Arc<dyn Transmission>,
    ) -> Result<LinkId, LinkageError> {
        let at = self.know_joint(pivot)?;
        self.follow(law.as_ref());
        let link = self.new_link();
        self.steps.push(Step::Turning { pivot: at, law });
        Ok(link)
    }

    /// Adds a link that slides along a line, its origin at the law's distance (mm) from the line's point, its first axis
    /// along the line.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn sliding(
        &mut self,
        line: Line,
        law: Arc<dyn Transmission>,
    ) -> Result<LinkId, LinkageError> {
        self.know_line(&line)?;
        self.follow(law.as_ref());
        let link = self.new_link();
        self.new_joint(link);
        self.steps.push(Step::Sliding { line, law });
        self.steps.push(Step::Point {
            link: link.0,
            local: Point::origin().coords,
        });
        Ok(link)
    }

    /// Adds a link fixed to another one: its origin at the line's point, its first axis along the line.
    ///
    /// # Errors
    /// [`LinkageError::Unknown`], [`LinkageError::NotFinite`].
    pub fn fixed(&mut self, line: Line) -> Result<LinkId, LinkageError> {
        self.know_line(&line)?;
        let link = self.new_link();
        self.steps.push(Step::Fixed { line });
        Ok(link)
    }

    /// A link's motion at an input.
    ///
    /// Not finite where the linkage does not close.
    ///
    /// # Panics
    /// Never for a link of the linkage.
    #[must_use]
    pub fn body(&self, link: LinkId, input: f64) -> BodyMotion {
        let (origin, axis) = self.series::<4>(input).frame(link);
        BodyMotion {
            origin: origin.jet(),
            angle: MotionJet::from_series(&axis.angle()),
        }
    }

    /// Position at an input, mm, of a link's point given in the link's axes, mm. Only the links on which it depends are computed.
    ///
    /// Not finite where the linkage does not close.
    ///
    /// # Panics
    /// Never for a link of the linkage.
    #[must_use]
    pub fn place(&self, link: LinkId, local: Point, input: f64) -> Point {
        let needed = self.needed(std::iter::empty(), std::iter::once(link.0));
        let mut series = Series::<1>::default();
        self.find(input, |part| needed.has(part), &mut series);
        let (origin, axis) = series.frame(link);
        origin.plus(axis.turned(local.coords)).value()
    }

    /// Notes where a law's derivatives jump.
    fn follow(&mut self, law: &dyn Transmission) {
        let of_law = repeated(law, self.period);
        let all = of_law.into_iter().chain(self.breaks.iter().copied());
        self.breaks = sorted(all, self.period);
    }
}
