use crate::region::AreaMoments;
use nalgebra::{Isometry3, Matrix3, Point3, Vector3};

/// Mass, center of mass and inertia of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass, kg.
    pub mass: f64,
    /// Center of mass, mm.
    pub center: Point3<f64>,
    /// Inertia tensor about the center of mass, kg mm².
    pub inertia: Matrix3<f64>,
}

impl MassProperties {
    /// Extrusion of a cross-section with the given moments between two heights, mm, at a density in kg/m³.
    #[must_use]
    pub fn of_extrusion(section: &AreaMoments, bottom: f64, top: f64, density: f64) -> Self {
        let height = top - bottom;
        let center = section.centroid();
        // 1 kg/m³ = 1e-9 kg/mm³.
        let areal = density * 1e-9 * height;
        let mass = areal * section.area;
        let xx = areal * section.xx - mass * center.x * center.x;
        let yy = areal * section.yy - mass * center.y * center.y;
        let xy = areal * section.xy - mass * center.x * center.y;
        let zz = mass * height * height / 12.0;
        Self {
            mass,
            center: Point3::new(center.x, center.y, 0.5 * (bottom + top)),
            inertia: Matrix3::new(yy + zz, -xy, 0.0, -xy, xx + zz, 0.0, 0.0, 0.0, xx + yy),
        }
    }

    /// The body after a rigid motion.
    #[must_use]
    pub fn placed(&self, motion: &Isometry3<f64>) -> Self {
        let turn = motion.rotation.to_rotation_matrix();
        Self {
            mass: self.mass,
            center: motion * self.center,
            inertia: turn.matrix() * self.inertia * turn.matrix().transpose(),
        }
    }

    /// Several bodies fixed to each other, combined by the parallel axis theorem; `None` if they have no mass.
    #[must_use]
    pub fn combined(bodies: &[Self]) -> Option<Self> {
        let mass: f64 = bodies.iter().map(|b| b.mass).sum();
        if mass.is_nan() || mass <= 0.0 {
            return None;
        }
        let moment = bodies.iter().map(|b| b.center.coords * b.mass);
        let center = Point3::from(moment.sum::<Vector3<f64>>() / mass);
        let inertia = bodies.iter().map(|b| {
            let arm = b.center - center;
            let moved = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
            b.inertia + moved * b.mass
        });
        Some(Self {
            mass,
            center,
            inertia: inertia.sum(),
        })
    }
}

/// Volume and first and second moments of a body about the origin.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VolumeMoments {
    /// `∫ dV`, mm³.
    pub volume: f64,
    /// `∫ p dV`, mm⁴.
    pub first: Vector3<f64>,
    /// `∫ p pᵀ dV`, mm⁵.
    pub second: Matrix3<f64>,
}

impl VolumeMoments {
    /// Adds a point, mm, with its volume, mm³: the node of a quadrature rule with its weight.
    pub fn add(&mut self, point: Vector3<f64>, volume: f64) {
        self.volume += volume;
        self.first += point * volume;
        self.second += point * point.transpose() * volume;
    }

    /// Subtracts the moments of a body.
    pub fn subtract(&mut self, other: &Self) {
        self.volume -= other.volume;
        self.first -= other.first;
        self.second -= other.second;
    }

    /// Mass, center of mass and inertia at a density in kg/m³.
    #[must_use]
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let center = self.first / self.volume;
        // 1 kg/m³ = 1e-9 kg/mm³.
        let about = (self.second - center * self.first.transpose()) * (density * 1e-9);
        MassProperties {
            mass: self.volume * density * 1e-9,
            center: Point3::from(center),
            inertia: Matrix3::identity() * about.trace() - about,
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Point, Vector, numeric::Tolerance, region::Outline, solid::Solid, test_shapes::rosette,
    };
    use nalgebra::{Isometry2, Isometry3, Rotation3, Vector3};

    #[test]
    fn a_steel_tube_has_the_closed_forms() {
        let center = Point::new(3.0, -4.0);
        let (outer, inner, height) = (20.0_f64, 8.0_f64, 12.0);
        let solid = Solid::new(
            Outline::circle(center, outer),
            vec![Outline::circle(center, inner).reversed()],
            -2.0,
            10.0,
        )
        .expect("has height");
        let m = solid.mass_properties(7850.0);
        let area = std::f64::consts::PI * (outer * outer - inner * inner);
        let mass = 7850e-9 * area * height;
        assert!((m.mass - mass).abs() < 1e-12);
        assert!((m.center - nalgebra::Point3::new(3.0, -4.0, 4.0)).norm() < 1e-12);
        let polar = 0.5 * mass * (outer * outer + inner * inner);
        let across = 0.5 * polar + mass * height * height / 12.0;
        let exact = nalgebra::Matrix3::from_diagonal(&Vector3::new(across, across, polar));
        assert!((m.inertia - exact).norm() < 1e-10);
    }

    #[test]
    fn a_block_is_its_two_halves_together() {
        let block = |from: f64, to: f64| {
            let corners = [[from, 1.0], [to, 1.0], [to, 5.0], [from, 5.0]];
            let corners = corners.map(|[x, y]| Point::new(x, y));
            let solid = Solid::new(Outline::polygon(&corners), vec![], 2.0, 9.0);
            solid.expect("has height").mass_properties(1200.0)
        };
        let whole = block(-3.0, 11.0);
        let halves = [block(-3.0, 2.0), block(2.0, 11.0)];
        let sum = crate::MassProperties::combined(&halves).expect("has mass");
        assert!((sum.mass - whole.mass).abs() < 1e-15);
        assert!((sum.center - whole.center).norm() < 1e-12);
        assert!((sum.inertia - whole.inertia).norm() < 1e-12 * whole.inertia.norm());
        assert_eq!(crate::MassProperties::combined(&[]), None);
    }

    #[test]
    fn the_nodes_of_a_quadrature_rule_have_the_mass_of_their_block() {
        let corners = [[-3.0, 1.0], [2.0, 1.0], [2.0, 5.0], [-3.0, 5.0]].map(Point::from);
        let solid = Solid::new(Outline::polygon(&corners), vec![], -3.0, 5.0).expect("has height");
        let exact = solid.mass_properties(2700.0);
        // Two Gauss points along each edge.
        let nodes = |low: f64, high: f64| {
            let off = 0.5 * (high - low) / 3.0_f64.sqrt();
            [-1.0, 1.0].map(|side| 0.5 * (low + high) + side * off)
        };
        let mut moments = crate::VolumeMoments::default();
        for x in nodes(-3.0, 2.0) {
            for y in nodes(1.0, 5.0) {
                for z in nodes(-3.0, 5.0) {
                    moments.add(Vector3::new(x, y, z), 5.0 * 4.0 * 8.0 / 8.0);
                }
            }
        }
        let found = moments.mass_properties(2700.0);
        assert!((found.mass - exact.mass).abs() < 1e-12 * exact.mass);
        assert!((found.center - exact.center).norm() < 1e-12);
        assert!((found.inertia - exact.inertia).norm() < 1e-12 * exact.inertia.norm());
    }

    #[test]
    fn the_inertia_turns_with_the_body() {
        let outline = rosette(20.0, 3.0, 1, Tolerance::new(1e-9).expect("positive"))
            .transformed(&Isometry2::translation(1.0, 2.0));
        let angle = 0.7;
        let turned = outline.transformed(&Isometry2::new(Vector::new(9.0, -1.0), angle));
        let of = |o: Outline| {
            Solid::new(o, vec![], 0.0, 7.0)
                .expect("has height")
                .mass_properties(1000.0)
        };
        let (a, b) = (of(outline), of(turned));
        let r = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let carried = r.matrix() * a.inertia * r.matrix().transpose();
        assert!((carried - b.inertia).norm() < 1e-10 * b.inertia.norm());
        assert!(carried[(0, 1)].abs() > 1e-6 * carried.norm());
    }

    #[test]
    fn a_body_moved_in_its_plane_and_up_is_the_extrusion_of_the_moved_contour() {
        let motion = Isometry2::new(Vector::new(5.0, -2.0), 0.7);
        let body = |motion: &Isometry2<f64>, bottom: f64| {
            let tolerance = Tolerance::new(1e-3).expect("positive");
            let outline = rosette(9.0, 2.0, 5, tolerance).transformed(motion);
            let solid = Solid::new(outline, Vec::new(), bottom, bottom + 4.0);
            solid.expect("has height").mass_properties(2700.0)
        };
        let want = body(&motion, 3.0);
        let axis = Vector3::z() * 0.7;
        let motion = Isometry3::new(Vector3::new(5.0, -2.0, 3.0), axis);
        let found = body(&Isometry2::identity(), 0.0).placed(&motion);
        assert!((found.mass - want.mass).abs() < 1e-12);
        assert!((found.center - want.center).norm() < 1e-9);
        assert!((found.inertia - want.inertia).norm() < 1e-9 * want.inertia.norm());
    }
}
