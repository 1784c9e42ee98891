use crate::tool::Corner;

/// Fillet parameter w, with roll = depth of the rounding's centre x sinh w. The distance from the pitch point to that centre is
/// then an entire function of w. The fillet is far smoother in w than in the roll, which moves it slowly at the root and fast at
/// the flank.
pub(super) struct Swing {
    center: f64,
    span: f64,
    /// Whole roll over the depth of the rounding's centre.
    slope: f64,
}

impl Swing {
    pub(super) fn new(corner: &Corner, center: f64, end: f64) -> Self {
        let straight = (corner.depth - corner.radius).abs();
        let roll = (corner.end - corner.center).abs();
        Self {
            center,
            span: end - center,
            // A rounding with its centre on the pitch line has an infinite slope: any large finite slope works.
            slope: (roll / straight).min(1e3),
        }
    }

    pub(super) fn parameter(&self, w: f64) -> f64 {
        self.center + self.span * w.sinh() / self.slope
    }

    pub(super) fn own(&self, t: f64) -> f64 {
        ((t - self.center) / self.span * self.slope).asinh()
    }
}
