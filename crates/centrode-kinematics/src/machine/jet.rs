use nalgebra::{Matrix4, Point3, Vector3};

use crate::transmission::MotionJet;

/// Pose of a frame in the first link's, with its first three derivatives by the input.
///
/// The matrices are homogeneous: the derivatives' last rows are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameJet(pub [Matrix4<f64>; 4]);

/// A point in the first link's frame, mm, with its first three derivatives by the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointJet {
    /// Position, mm.
    pub position: Point3<f64>,
    /// First derivative, mm/rad.
    pub velocity: Vector3<f64>,
    /// Second derivative, mm/rad^2.
    pub acceleration: Vector3<f64>,
    /// Third derivative, mm/rad^3.
    pub jerk: Vector3<f64>,
}

impl FrameJet {
    /// The frame of the first link.
    #[must_use]
    pub fn identity() -> Self {
        Self::still(Matrix4::identity())
    }

    /// A frame that does not move.
    #[must_use]
    pub fn still(frame: Matrix4<f64>) -> Self {
        let zero = Matrix4::zeros();
        Self([frame, zero, zero, zero])
    }

    /// Pose of a frame whose pose in this one is `inner`: the product rule to third order.
    #[must_use]
    pub fn then(&self, inner: &Self) -> Self {
        let ([a, a1, a2, a3], [b, b1, b2, b3]) = (&self.0, &inner.0);
        Self([
            a * b,
            a1 * b + a * b1,
            a2 * b + (a1 * b1) * 2.0 + a * b2,
            a3 * b + (a2 * b1 + a1 * b2) * 3.0 + a * b3,
        ])
    }

    /// A turn about a unit vector through the origin: with S the cross product by it and R the rotation,
    /// R' = q' S R, R'' = (q'' S + q'^2 S^2) R, R''' = (q''' S + 3 q' q'' S^2 + q'^3 S^3) R.
    #[must_use]
    pub fn turn(axis: Vector3<f64>, by: &MotionJet) -> Self {
        let s = axis.cross_matrix();
        let (sin, cos) = by.position.sin_cos();
        // Rodrigues' formula.
        let rotation = nalgebra::Matrix3::identity() + s * sin + s * s * (1.0 - cos);
        let (v, a, j) = (by.velocity, by.acceleration, by.jerk);
        let (s2, s3) = (s * s, s * s * s);
        let rates = [
            s * v,
            s * a + s2 * (v * v),
            s * j + s2 * (3.0 * v * a) + s3 * (v * v * v),
        ];
        let mut out = [Matrix4::zeros(); 4];
        out[0] = rotation.to_homogeneous();
        for (frame, rate) in out[1..].iter_mut().zip(rates) {
            frame
                .fixed_view_mut::<3, 3>(0, 0)
                .copy_from(&(rate * rotation));
        }
        Self(out)
    }

    /// A slide along a unit vector.
    #[must_use]
    pub fn slide(axis: Vector3<f64>, by: &MotionJet) -> Self {
        let mut out = [Matrix4::zeros(); 4];
        out[0] = Matrix4::identity();
        let ways = [by.position, by.velocity, by.acceleration, by.jerk];
        for (frame, way) in out.iter_mut().zip(ways) {
            frame.fixed_view_mut::<3, 1>(0, 3).copy_from(&(axis * way));
        }
        Self(out)
    }

    /// The motion of a point of the frame, given in this frame in mm.
    #[must_use]
    pub fn point(&self, at: [f64; 3]) -> PointJet {
        let at = Vector3::from(at).push(1.0);
        let [position, velocity, acceleration, jerk] = self.0.map(|m| (m * at).xyz());
        PointJet {
            position: position.into(),
            velocity,
            acceleration,
            jerk,
        }
    }
}
