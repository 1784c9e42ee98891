use crate::{
    Vector,
    curve::{NODES, Segment},
};

/// A part of one segment with proven bounds on its length and curvature.
///
/// With the arc length `s` as parameter, `|x''| = |κ|`. So a curve of length `L` with curvature at most `K` deviates from its
/// chord by at most `L² K / 8`. A tangent jump `δ` inside it adds at most `L δ / 4`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Index of the segment.
    pub(crate) segment: usize,
    /// Parameter of the start.
    pub(crate) u0: f64,
    /// Parameter of the end.
    pub(crate) u1: f64,
    /// Upper bound on the length, mm.
    pub(crate) length: f64,
    /// Upper bound on the curvature, 1/mm; infinite if the speed may vanish.
    pub(crate) curvature: f64,
    /// Upper bound on the speed, mm per unit of the parameter.
    speed: f64,
    /// Curvature in the middle, 1/mm.
    pub(crate) middle_curvature: f64,
}

/// Bounds of a segment's part.
struct PartBounds {
    /// Upper bound on the speed, mm per unit of the parameter.
    speed: f64,
    /// Upper bound on the curvature, 1/mm.
    curvature: f64,
    /// Curvature in the middle, 1/mm.
    middle_curvature: f64,
}

impl Piece {
    /// The part of `segment` between two parameters.
    pub(crate) fn new(segment: &Segment, index: usize, u0: f64, u1: f64) -> Self {
        let bounds = match segment {
            Segment::Line(start, end) => PartBounds {
                speed: 0.5 * (end - start).norm(),
                curvature: 0.0,
                middle_curvature: 0.0,
            },
            Segment::Arc(arc) => {
                let jet = segment.at(0.0);
                let speed = jet.first.norm();
                let curvature = 0.5 * arc.sweep().abs() / speed;
                PartBounds {
                    speed,
                    curvature,
                    middle_curvature: curvature,
                }
            }
            Segment::Poly(poly) => {
                if u0 == -1.0 && u1 == 1.0 {
                    poly_bounds(poly.coefficients(), 1.0)
                } else {
                    let half = 0.5 * (u1 - u0);
                    let mut c = [Vector::zeros(); NODES];
                    c.copy_from_slice(poly.coefficients());
                    shift(&mut c, 0.5 * (u0 + u1));
                    poly_bounds(&c, half)
                }
            }
        };
        Self {
            segment: index,
            u0,
            u1,
            length: bounds.speed * (u1 - u0),
            curvature: bounds.curvature,
            speed: bounds.speed,
            middle_curvature: bounds.middle_curvature,
        }
    }

    /// Upper bound on the distance, mm, between a point of the piece and the point of its chord at the same fraction of the
    /// length.
    pub(crate) fn sagitta(&self) -> f64 {
        // No curve deviates from its chord by more than half its length.
        (self.length * self.length * self.curvature / 8.0).min(0.5 * self.length)
    }

    /// The two halves.
    pub(crate) fn halves(&self, segment: &Segment) -> [Self; 2] {
        let middle = 0.5 * (self.u0 + self.u1);
        [
            Self::new(segment, self.segment, self.u0, middle),
            Self::new(segment, self.segment, middle, self.u1),
        ]
    }

    /// Upper bound on the length, mm, of the part after `u`.
    pub(crate) fn after(&self, u: f64) -> f64 {
        self.speed * (self.u1 - u)
    }
}

/// Moves the origin of the parameter to `middle`.
fn shift(c: &mut [Vector; NODES], middle: f64) {
    for low in 0..NODES - 1 {
        for k in (low..NODES - 1).rev() {
            let above = c[k + 1];
            c[k] += above * middle;
        }
    }
}

/// Bounds of a polynomial over `[-half, half]`.
fn poly_bounds(c: &[Vector], half: f64) -> PartBounds {
    // velocity = c1 + 2 c2 v + rest, acceleration = 2 c2 + more.
    let (velocity, ramp) = (c[1], 2.0 * c[2] * half);
    let (mut rest, mut more) = (0.0, 0.0);
    let mut power = half;
    for (k, c) in c.iter().enumerate().skip(3) {
        let (size, k) = (c.norm(), k as f64);
        more += k * (k - 1.0) * size * power;
        power *= half;
        rest += k * size * power;
    }
    let at_ends = [(velocity - ramp).norm(), (velocity + ramp).norm()];
    let max_speed = at_ends[0].max(at_ends[1]) + rest;
    let along = (-velocity.dot(&ramp) / ramp.norm_squared()).clamp(-1.0, 1.0);
    let min_linear = if along.is_finite() {
        (velocity + ramp * along).norm()
    } else {
        velocity.norm()
    };
    let min_speed = min_linear - rest;
    let acceleration = 2.0 * c[2].norm() + more;
    let cross = 2.0 * velocity.perp(&c[2]).abs() + max_speed * more + rest * acceleration;
    let curvature = if min_speed > 0.0 {
        cross.min(max_speed * acceleration) / min_speed.powi(3)
    } else {
        f64::INFINITY
    };
    PartBounds {
        speed: max_speed,
        curvature,
        middle_curvature: 2.0 * velocity.perp(&c[2]).abs() / velocity.norm().powi(3),
    }
}
