use std::f64::consts::TAU;

use super::SweepError;
use centrode_gear::pitch::{Bspline, HIGHEST_DEGREE, spline_basis};

/// Polar angle and radius as piecewise polynomials of one parameter; each piece has the length 1.
#[derive(Clone, Debug)]
pub(super) struct SplinePair {
    degree: usize,
    /// Weights of the active control points, as polynomials; constant first.
    basis: Vec<Polynomial>,
    /// Coefficients of each piece: angle, radius.
    pieces: Vec<[Polynomial; 2]>,
}

/// Coefficients of a polynomial in powers, constant first.
pub(super) type Polynomial = [f64; HIGHEST_DEGREE + 1];

impl SplinePair {
    pub(super) fn new(spline: &Bspline) -> Result<Self, SweepError> {
        let degree = spline.degree as usize;
        let found = spline.radius.len();
        let required = (degree + 1).max(3);
        if found < required || !(1..=HIGHEST_DEGREE).contains(&degree) {
            return Err(SweepError::Points { required, found });
        }
        Ok(Self {
            degree,
            basis: spline_basis(degree),
            pieces: vec![[[0.0; HIGHEST_DEGREE + 1]; 2]; found],
        })
    }

    /// Sets the control points, from a spline of the same degree.
    pub(super) fn load(&mut self, spline: &Bspline) -> Result<(), SweepError> {
        let count = self.pieces.len();
        for found in [spline.radius.len(), spline.angle.len()] {
            if found != count {
                return Err(SweepError::Points {
                    required: count,
                    found,
                });
            }
        }
        if spline.degree as usize != self.degree {
            return Err(SweepError::Kind);
        }
        // Piece i depends most on control point i.
        let before = self.degree / 2;
        for (i, [angle, radius]) in self.pieces.iter_mut().enumerate() {
            *angle = [0.0; HIGHEST_DEGREE + 1];
            *radius = [0.0; HIGHEST_DEGREE + 1];
            for (j, weights) in self.basis.iter().enumerate() {
                let index = i + j + count - before;
                let (index, turns) = if index >= 2 * count {
                    (index - 2 * count, 1.0)
                } else if index >= count {
                    (index - count, 0.0)
                } else {
                    (index, -1.0)
                };
                let (a, r) = (spline.angle[index] + turns * TAU, spline.radius[index]);
                for ((a_k, r_k), weight) in angle.iter_mut().zip(radius.iter_mut()).zip(weights) {
                    *a_k += weight * a;
                    *r_k += weight * r;
                }
            }
        }
        Ok(())
    }

    pub(super) fn count(&self) -> usize {
        self.pieces.len()
    }

    pub(super) fn degree(&self) -> usize {
        self.degree
    }

    /// Angle and radius of a piece in powers of s, where `middle + half s` is the position on the piece.
    #[inline]
    pub(super) fn part(&self, piece: usize, middle: f64, half: f64) -> [Polynomial; 2] {
        if self.degree <= 2 {
            part::<2>(&self.pieces[piece], middle, half)
        } else {
            part::<HIGHEST_DEGREE>(&self.pieces[piece], middle, half)
        }
    }
}

/// Two polynomials in powers of s, where `middle + half s` is the position on the piece.
fn part<const DEGREE: usize>(pair: &[Polynomial; 2], middle: f64, half: f64) -> [Polynomial; 2] {
    pair.map(|mut c| {
        // Taylor shift to the middle, then scaling.
        for low in 0..DEGREE {
            for k in (low..DEGREE).rev() {
                c[k] += middle * c[k + 1];
            }
        }
        let mut scale = half;
        for k in &mut c[1..=DEGREE] {
            *k *= scale;
            scale *= half;
        }
        c
    })
}
