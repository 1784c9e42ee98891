use centrode_geometry::{Point, SegmentJet, Vector};

/// The pose of the driven gear in the driver's axes.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Pose {
    /// The driven axis.
    pub(in crate::contact) axis: Point,
    sin: f64,
    cos: f64,
}

impl Pose {
    /// Pose by driver angle `phi` and driven angle `psi`, rad, and centre distance `a`, mm.
    pub(in crate::contact) fn new(phi: f64, psi: f64, a: f64) -> Self {
        Self::about(Point::new(a * phi.cos(), a * phi.sin()), phi + psi)
    }

    /// Pose by the driven axis and the sum of driver angle and driven angle, rad.
    pub(in crate::contact) fn about(axis: Point, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { axis, sin, cos }
    }

    /// Rotation of the gears relative to each other between two poses, as the chord 2 sin(rotation / 2).
    pub(super) fn turn_between(&self, other: &Self) -> f64 {
        (self.sin - other.sin).hypot(self.cos - other.cos)
    }

    /// A vector of the driven gear in the driver's axes.
    pub(in crate::contact) fn vector_to_driver(&self, v: &Vector) -> Vector {
        Vector::new(
            self.cos * v.x - self.sin * v.y,
            self.sin * v.x + self.cos * v.y,
        )
    }

    /// A vector of the driver in the driven gear's axes.
    pub(in crate::contact) fn vector_to_driven(&self, v: &Vector) -> Vector {
        Vector::new(
            self.cos * v.x + self.sin * v.y,
            self.cos * v.y - self.sin * v.x,
        )
    }

    /// A point of the driven gear in the driver's axes.
    pub(in crate::contact) fn point_to_driver(&self, p: &Point) -> Point {
        self.axis + self.vector_to_driver(&p.coords)
    }

    /// A point of the driver in the driven gear's axes.
    pub(in crate::contact) fn point_to_driven(&self, p: &Point) -> Point {
        let v = p - self.axis;
        Point::new(
            self.cos * v.x + self.sin * v.y,
            self.cos * v.y - self.sin * v.x,
        )
    }

    /// A point of the driven gear with its derivatives in the driver's axes.
    pub(in crate::contact) fn jet_to_driver(&self, jet: &SegmentJet) -> SegmentJet {
        SegmentJet {
            point: self.point_to_driver(&jet.point),
            first: self.vector_to_driver(&jet.first),
            second: self.vector_to_driver(&jet.second),
        }
    }
}
