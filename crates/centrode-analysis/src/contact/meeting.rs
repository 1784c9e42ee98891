use centrode_geometry::Vector;

/// Pair of points, one on either contour, at one distance from the driven axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub(super) u: f64,
    pub(super) v: f64,
    /// Point and tangent on the driver.
    pub(super) driver: (Vector, Vector),
    /// Point and tangent on the driven gear.
    pub(super) driven: (Vector, Vector),
}

impl Meeting {
    /// Turn of the driven gear that brings the points together, rad.
    pub(super) fn angle(&self) -> f64 {
        let ((a, first), (b, tangent)) = (self.driver, self.driven);
        let turned = b.perp(&a).atan2(b.dot(&a));
        // Remaining difference of the distances, along the contour whose distance changes faster: a tip stays about as far.
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

    /// Slope of the angle over the distance, driver's less driven gear's, but for a factor.
    pub(super) fn difference(&self) -> f64 {
        let ((a, first), (b, tangent)) = (self.driver, self.driven);
        // The distances of the two contours run opposite ways: the product of their rates is negative.
        b.perp(&tangent) * a.dot(&first) - a.perp(&first) * b.dot(&tangent)
    }
}
