use crate::contact::contour::ContourPoint;

/// Two points, one on each contour, at the same distance from the driven axis: they meet when the driven gear turns.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeetingPoints {
    pub(super) driver: ContourPoint,
    pub(super) driven: ContourPoint,
}

impl MeetingPoints {
    /// Rotation of the driven gear that brings the points together, rad.
    pub(super) fn angle(&self) -> f64 {
        let (a, first) = (self.driver.point, self.driver.tangent);
        let (b, tangent) = (self.driven.point, self.driven.tangent);
        let turned = b.perp(&a).atan2(b.dot(&a));
        // The remaining difference of the distances is corrected along the contour whose distance changes faster: along a tip it
        // hardly changes.
        let apart = 0.5 * (a.norm_squared() - b.norm_squared());
        let (rate, mate) = (a.dot(&first), b.dot(&tangent));
        let rest = if rate.abs() * tangent.norm() > mate.abs() * first.norm() {
            a.perp(&first) / a.norm_squared() * (apart / rate)
        } else {
            b.perp(&tangent) / b.norm_squared() * (apart / mate)
        };
        if rest.is_finite() {
            turned - rest
        } else {
            turned
        }
    }

    /// Slope of the polar angle over the distance, driver's minus driven gear's, times a positive factor.
    pub(super) fn slope_difference(&self) -> f64 {
        let (a, first) = (self.driver.point, self.driver.tangent);
        let (b, tangent) = (self.driven.point, self.driven.tangent);
        // The distances change in opposite senses: the product of their rates is negative.
        b.perp(&tangent) * a.dot(&first) - a.perp(&first) * b.dot(&tangent)
    }
}
