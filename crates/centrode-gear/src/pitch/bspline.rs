use centrode_geometry::Curve;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::in_range;
use super::piecewise::{HIGHEST_DEGREE, PiecewiseCurve, Polynomial};
use super::points::{Lists, Plane, Points};
use super::size::{OwnSize, Size};
use super::{Draft, PitchError, SampledLaw, sampled};
use centrode_spec::degrees;

/// A closed uniform B-spline, from control points or through given points.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bspline {
    /// The plane the points are drawn in: "polar" (`angle_deg`, radius) or "cartesian" (x, y).
    pub plane: Plane,
    /// Degree, 1 to 5.
    pub degree: u32,
    /// Whether the curve passes through the points (at equal parameter steps); else they are control points.
    pub interpolate: bool,
    /// Radii, mm (plane "polar").
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schemars(extend("x-symbol" = "r_i"))]
    pub radius: Vec<f64>,
    /// Polar angles, rad (degrees in the file), increasing within one turn (plane "polar").
    #[serde(
        rename = "angle_deg",
        with = "degrees",
        skip_serializing_if = "Vec::is_empty"
    )]
    #[schemars(with = "Vec<f64>")]
    pub angle: Vec<f64>,
    /// x, mm, counter-clockwise round the shaft axis (plane "cartesian").
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub x: Vec<f64>,
    /// y, mm (plane "cartesian").
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub y: Vec<f64>,
    /// Module, mm, with `tooth_count`: scales the curve.
    pub module: Option<f64>,
    /// Diametral pitch, 1/in, instead of the module: 25.4 mm over the module.
    pub diametral_pitch: Option<f64>,
    /// Number of teeth; alone, the module follows from the size of the curve.
    pub tooth_count: Option<u32>,
}

impl Default for Bspline {
    fn default() -> Self {
        Self {
            plane: Plane::Polar,
            degree: 3,
            interpolate: false,
            radius: Vec::new(),
            angle: Vec::new(),
            x: Vec::new(),
            y: Vec::new(),
            module: None,
            diametral_pitch: None,
            tooth_count: None,
        }
    }
}

impl Bspline {
    /// Checks the points by the rules of a design file.
    ///
    /// # Errors
    /// [`PitchError`] with the key.
    pub fn check(&self) -> Result<(), PitchError> {
        self.lists().check(self.fewest())
    }

    fn lists(&self) -> Lists<'_> {
        Lists {
            plane: self.plane,
            radius: &self.radius,
            angle: &self.angle,
            x: &self.x,
            y: &self.y,
        }
    }

    /// Minimum number of points.
    fn fewest(&self) -> usize {
        (self.degree as usize + 1).max(3)
    }

    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let degree = in_range("degree", self.degree, 1, HIGHEST_DEGREE as u32)? as usize;
        let lists = self.lists();
        let points = lists.points(self.fewest())?;
        // Control points define no corners, and a spline of degree 1 has corners at its points.
        let corners = match self.interpolate && degree > 1 {
            true => sampled::of_radii(&points.polar()),
            false => Vec::new(),
        };
        let (points, [before, after]) = if self.interpolate {
            let controls = points
                .periodic()
                .map(|values| controls_through(&values, degree));
            (points.with_periodic(controls), ["through", "points"])
        } else {
            (points, ["with", "control points"])
        };
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::Written,
        );
        let plane = match self.plane {
            Plane::Polar => "the polar plane (angle, radius)",
            Plane::Cartesian => "x, y",
        };
        let definition = format!(
            "closed uniform B-spline of degree {degree} {before} {} {after} in {plane}",
            points.len()
        );
        let curve = PiecewiseCurve::new(points.coordinates, pieces(&points, degree));
        let sampled = SampledLaw {
            corners,
            ..SampledLaw::default()
        };
        Ok(Draft::new(lists.key(), curve, size, definition)?.with_samples(sampled))
    }
}

/// Closed uniform spline through points of the x, y plane, over their index.
pub fn closed_spline(points: Vec<[f64; 2]>, degree: usize) -> impl Curve + use<> {
    let points = Points::cartesian(points);
    let controls = points.periodic();
    let controls = controls.map(|values| controls_through(&values, degree));
    let points = points.with_periodic(controls);
    PiecewiseCurve::new(points.coordinates, pieces(&points, degree))
}

/// Polynomials on the unit interval that weight the `degree + 1` active control points.
pub fn basis(degree: usize) -> Vec<Polynomial> {
    let mut basis = vec![[0.0; HIGHEST_DEGREE + 1]];
    basis[0][0] = 1.0;
    for p in 1..=degree {
        let mut next = vec![[0.0; HIGHEST_DEGREE + 1]; p + 1];
        for (j, out) in next.iter_mut().enumerate() {
            // (u + p - j)/p b_(j-1) + (j + 1 - u)/p b_j, on integer knots.
            let terms = [
                (j.checked_sub(1), (p - j) as f64, 1.0),
                (Some(j).filter(|&j| j < p), (j + 1) as f64, -1.0),
            ];
            for (index, constant, slope) in terms {
                let Some(index) = index else { continue };
                for (power, c) in basis[index].iter().enumerate().take(p) {
                    out[power] += constant * c / p as f64;
                    out[power + 1] += slope * c / p as f64;
                }
            }
        }
        basis = next;
    }
    basis
}

/// The polynomial pieces; control point `i` has its largest weight at `t = i` (odd degree) or `i + 1/2` (even).
fn pieces(points: &Points, degree: usize) -> Vec<[Polynomial; 2]> {
    let basis = basis(degree);
    let before = (degree / 2) as isize;
    (0..points.len() as isize)
        .map(|i| {
            let mut piece = [[0.0; HIGHEST_DEGREE + 1]; 2];
            for (j, weight) in basis.iter().enumerate() {
                let point = points.at(i - before + j as isize);
                for (c, value) in piece.iter_mut().zip(point) {
                    for (c, w) in c.iter_mut().zip(weight) {
                        *c += w * value;
                    }
                }
            }
            piece
        })
        .collect()
}

/// Periodic control values whose spline has the given values where the control points have their largest weights.
///
/// The matrix is a positive definite circulant with few distinct eigenvalues near its ends:
/// conjugate gradients reach rounding in some tens of steps.
pub(crate) fn controls_through(values: &[f64], degree: usize) -> Vec<f64> {
    let n = values.len();
    let at = if degree % 2 == 1 { 0.0 } else { 0.5 };
    let weights: Vec<f64> = basis(degree)
        .iter()
        .map(|c| c.iter().rev().fold(0.0, |sum, k| sum * at + k))
        .collect();
    let half = degree / 2;
    let times = |c: &[f64]| -> Vec<f64> {
        let term = |i: usize, j: usize| (i + (half + 1) * n + j - half) % n;
        (0..n)
            .map(|i| {
                weights
                    .iter()
                    .enumerate()
                    .map(|(j, w)| w * c[term(i, j)])
                    .sum()
            })
            .collect()
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut x = values.to_vec();
    // The second pass starts from the true residual and removes the rounding errors of the first.
    for _ in 0..2 {
        let product = times(&x);
        let mut residual: Vec<f64> = values.iter().zip(&product).map(|(v, p)| v - p).collect();
        let mut direction = residual.clone();
        let mut square = dot(&residual, &residual);
        let goal = square * 1e-32;
        for _ in 0..200 {
            if square <= goal {
                break;
            }
            let along = times(&direction);
            let step = square / dot(&direction, &along);
            for i in 0..n {
                x[i] += step * direction[i];
                residual[i] -= step * along[i];
            }
            let next = dot(&residual, &residual);
            for i in 0..n {
                direction[i] = residual[i] + next / square * direction[i];
            }
            square = next;
        }
    }
    x
}
