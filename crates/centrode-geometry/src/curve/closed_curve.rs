use crate::{Point, Vector};

/// A point of a curve and its derivatives with respect to the curve's parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// Position, mm.
    pub point: Point,
    /// First derivative.
    pub first: Vector,
    /// Second derivative.
    pub second: Vector,
    /// Third derivative.
    pub third: Vector,
}

impl Jet {
    /// Signed curvature (1/mm), positive where the curve turns counter-clockwise.
    #[must_use]
    pub fn curvature(&self) -> f64 {
        self.first.perp(&self.second) / self.first.norm().powi(3)
    }
}

/// A closed plane curve: the common interface of all exact curves.
///
/// The parameter runs over `[0, period)` and is periodic outside it. Between two neighbouring
/// [`breaks`](Self::breaks) the curve is analytic; at a break the jet is the limit from the right
/// (the limit from the left is the jet at `t.next_down()`).
pub trait Curve: std::fmt::Debug + Send + Sync {
    /// Length of one turn in parameter units.
    fn period(&self) -> f64;

    /// Parameters in `[0, period)` where a derivative may jump, ascending.
    ///
    /// A curve with narrow features adds parameters near them, so that no search steps over a feature. Default: empty.
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Position and derivatives at any real `t`.
    fn at(&self, t: f64) -> Jet;
}
