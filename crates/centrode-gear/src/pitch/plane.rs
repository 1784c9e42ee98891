use centrode_geometry::{Curve, Jet, Point, Vector};

use super::Symmetry;

/// A value and its first three derivatives.
pub(crate) type Derivatives = [f64; 4];

/// A polar angle with its sine and cosine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Direction {
    pub(crate) angle: f64,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Direction {
    pub(crate) fn from_angle(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { angle, sin, cos }
    }

    /// Sine and cosine of the angle times a whole number.
    pub(crate) fn times(&self, n: f64) -> (f64, f64) {
        if n == 1.0 {
            (self.sin, self.cos)
        } else {
            (n * self.angle).sin_cos()
        }
    }
}

/// Jet of a curve given in polar coordinates: direction with the derivatives of its
/// angle, and radius, as functions of the parameter.
///
/// With `z = r e^(i theta)` the derivatives are `w_k e^(i theta)` where `w_0 = r` and
/// `w_(k+1) = w_k' + i theta' w_k`.
pub(crate) fn polar_jet(direction: &Direction, turn: [f64; 3], radius: &Derivatives) -> Jet {
    let [t1, t2, t3] = turn;
    let [r, r1, r2, r3] = *radius;
    let (a, b) = (r1, r * t1);
    let (a1, b1) = (r2, r1 * t1 + r * t2);
    let (a2, b2) = (r3, r2 * t1 + 2.0 * r1 * t2 + r * t3);
    let (c, d) = (a1 - t1 * b, b1 + t1 * a);
    let (c1, d1) = (a2 - t2 * b - t1 * b1, b2 + t2 * a + t1 * a1);
    let (e, f) = (c1 - t1 * d, d1 + t1 * c);
    let Direction { sin, cos, .. } = *direction;
    let turned = |x: f64, y: f64| Vector::new(x * cos - y * sin, x * sin + y * cos);
    Jet {
        point: Point::new(r * cos, r * sin),
        first: turned(a, b),
        second: turned(c, d),
        third: turned(e, f),
    }
}

/// A closed curve whose size can still be changed.
pub(crate) trait ScalableCurve: Curve {
    /// Multiplies every length of the curve by `factor`.
    fn rescale(&mut self, factor: f64);

    /// The sign of the radius of a curve that is given by its radius; 1 otherwise.
    fn side(&self, _t: f64) -> f64 {
        1.0
    }

    /// Whether the curve winds once round the axis by its own form, so that no proof is needed.
    fn goes_round_by_form(&self) -> bool {
        false
    }

    /// Symmetry of the curve about its axis, as far as its form shows.
    fn symmetry(&self) -> Symmetry {
        Symmetry::NONE
    }
}

/// A radius as a function of the polar angle, with period one turn.
pub(crate) trait RadiusLaw: std::fmt::Debug + Send + Sync {
    /// Radius and its derivatives in a direction.
    fn radius(&self, phi: &Direction) -> Derivatives;

    /// Whether the radius is above zero by the law's own form, for all parameters that pass its checks.
    fn is_positive_by_form(&self) -> bool {
        false
    }

    /// Symmetry of the law, as far as its form shows.
    fn symmetry(&self) -> Symmetry {
        Symmetry::NONE
    }

    /// Angles in `[0, 2 pi)` where a derivative may jump, and angles that divide a law with narrow features, ascending.
    fn breaks(&self) -> Vec<f64> {
        Vec::new()
    }
}

/// The curve of a radius law; its parameter is the polar angle.
#[derive(Debug)]
pub(crate) struct PolarCurve<L> {
    law: L,
    scale: f64,
}

impl<L: RadiusLaw> PolarCurve<L> {
    pub(crate) fn new(law: L) -> Self {
        Self { law, scale: 1.0 }
    }
}

impl<L: RadiusLaw> Curve for PolarCurve<L> {
    fn period(&self) -> f64 {
        std::f64::consts::TAU
    }

    fn breaks(&self) -> Vec<f64> {
        self.law.breaks()
    }

    fn at(&self, t: f64) -> Jet {
        let direction = Direction::from_angle(t);
        let radius = self.law.radius(&direction).map(|d| d * self.scale);
        polar_jet(&direction, [1.0, 0.0, 0.0], &radius)
    }
}

impl<L: RadiusLaw> ScalableCurve for PolarCurve<L> {
    fn rescale(&mut self, factor: f64) {
        self.scale *= factor;
    }

    fn side(&self, t: f64) -> f64 {
        self.law.radius(&Direction::from_angle(t))[0].signum()
    }

    fn goes_round_by_form(&self) -> bool {
        self.law.is_positive_by_form()
    }

    fn symmetry(&self) -> Symmetry {
        self.law.symmetry()
    }
}
