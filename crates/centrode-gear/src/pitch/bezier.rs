use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::error::in_range;
use super::piecewise::{HIGHEST_DEGREE, PiecewiseCurve, Polynomial};
use super::points::{Lists, Plane, Points};
use super::size::{OwnSize, Size};
use super::{Draft, PitchError};
use centrode_spec::degrees;

/// A closed chain of Bezier arcs.
///
/// Every arc starts where the one before it ends, so `n` arcs of degree `d` have `n d` control
/// points: of each arc all but the last, which is the first of the next.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bezier {
    /// The plane the points are drawn in: "polar" (`angle_deg`, radius) or "cartesian" (x, y).
    pub plane: Plane,
    /// Degree of every arc, 1 to 5.
    pub degree: u32,
    /// Radii, mm (plane "polar").
    #[serde(skip_serializing_if = "Vec::is_empty")]
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

impl Default for Bezier {
    fn default() -> Self {
        Self {
            plane: Plane::Polar,
            degree: 3,
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

impl Bezier {
    pub(crate) fn draft(&self) -> Result<Draft, PitchError> {
        let degree = in_range("degree", self.degree, 1, HIGHEST_DEGREE as u32)?;
        let lists = Lists {
            plane: self.plane,
            radius: &self.radius,
            angle: &self.angle,
            x: &self.x,
            y: &self.y,
        };
        let points = lists.points(3)?;
        let count = points.len();
        if !count.is_multiple_of(degree as usize) {
            let key = lists.key();
            return Err(PitchError::ArcsIncomplete { key, count, degree });
        }
        let size = Size::new(
            self.module,
            self.diametral_pitch,
            self.tooth_count,
            OwnSize::Written,
        );
        let definition = format!(
            "closed chain of {} Bezier arcs of degree {degree}",
            count / degree as usize
        );
        let curve = PiecewiseCurve::new(points.coordinates, pieces(&points, degree as usize));
        Draft::new(lists.key(), curve, size, definition)
    }
}

fn pieces(points: &Points, degree: usize) -> Vec<[Polynomial; 2]> {
    (0..points.len() / degree)
        .map(|arc| {
            let mut controls = [[0.0; HIGHEST_DEGREE + 1]; 2];
            for j in 0..=degree {
                let point = points.at((arc * degree + j) as isize);
                for (c, value) in controls.iter_mut().zip(point) {
                    c[j] = value;
                }
            }
            controls.map(|c| monomial(c, degree))
        })
        .collect()
}

/// Power coefficients from control values: binomials times forward differences.
fn monomial(mut control: Polynomial, degree: usize) -> Polynomial {
    let mut out = [0.0; HIGHEST_DEGREE + 1];
    let mut binomial = 1.0;
    for (k, c) in out.iter_mut().enumerate().take(degree + 1) {
        *c = binomial * control[0];
        binomial *= (degree - k) as f64 / (k + 1) as f64;
        for j in 0..degree - k {
            control[j] = control[j + 1] - control[j];
        }
    }
    out
}
