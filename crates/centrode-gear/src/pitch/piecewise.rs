use centrode_geometry::{Curve, Jet, Point, Vector};

use super::plane::{Derivatives, Direction, ScalableCurve, polar_jet};

/// Highest degree of a pitch spline.
pub const HIGHEST_DEGREE: usize = 5;
const COEFFICIENTS: usize = HIGHEST_DEGREE + 1;

/// A polynomial in the distance from the start of its piece, constant first.
pub(crate) type Polynomial = [f64; COEFFICIENTS];

/// Value and derivatives of a polynomial.
pub(crate) fn evaluate(c: &Polynomial, u: f64) -> Derivatives {
    let (mut p, mut d, mut s, mut j) = (0.0, 0.0, 0.0, 0.0);
    for &k in c.iter().rev() {
        j = j * u + s;
        s = s * u + d;
        d = d * u + p;
        p = p * u + k;
    }
    [p, d, 2.0 * s, 6.0 * j]
}

/// The plane a spline is drawn in.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub(crate) enum Coordinates {
    /// Polar angle (rad) and radius (mm).
    Polar,
    /// x and y, mm.
    Cartesian,
}

/// A closed curve of polynomial pieces, each one parameter unit long.
#[derive(Debug)]
pub(crate) struct PiecewiseCurve {
    coordinates: Coordinates,
    pieces: Vec<[Polynomial; 2]>,
    scale: f64,
}

impl PiecewiseCurve {
    pub(crate) fn new(coordinates: Coordinates, pieces: Vec<[Polynomial; 2]>) -> Self {
        Self {
            coordinates,
            pieces,
            scale: 1.0,
        }
    }

    fn plane(&self, t: f64) -> [Derivatives; 2] {
        let count = self.pieces.len();
        let mut t = t.rem_euclid(count as f64);
        // The remainder of a tiny negative number rounds up to the period.
        if t >= count as f64 {
            t = 0.0;
        }
        let index = t as usize;
        let u = t - index as f64;
        self.pieces[index].each_ref().map(|c| evaluate(c, u))
    }
}

impl Curve for PiecewiseCurve {
    fn period(&self) -> f64 {
        self.pieces.len() as f64
    }

    fn breaks(&self) -> Vec<f64> {
        (0..self.pieces.len()).map(|i| i as f64).collect()
    }

    fn at(&self, t: f64) -> Jet {
        let [a, b] = self.plane(t);
        match self.coordinates {
            Coordinates::Polar => polar_jet(
                &Direction::from_angle(a[0]),
                [a[1], a[2], a[3]],
                &b.map(|d| d * self.scale),
            ),
            Coordinates::Cartesian => Jet {
                point: Point::new(a[0], b[0]) * self.scale,
                first: Vector::new(a[1], b[1]) * self.scale,
                second: Vector::new(a[2], b[2]) * self.scale,
                third: Vector::new(a[3], b[3]) * self.scale,
            },
        }
    }
}

impl ScalableCurve for PiecewiseCurve {
    fn rescale(&mut self, factor: f64) {
        self.scale *= factor;
    }

    fn side(&self, t: f64) -> f64 {
        match self.coordinates {
            Coordinates::Polar => self.plane(t)[1][0].signum(),
            Coordinates::Cartesian => 1.0,
        }
    }
}
