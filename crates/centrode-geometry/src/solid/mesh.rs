use crate::Point;

/// A triangle mesh. Each face lists its vertices counter-clockwise, seen from outside.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners, mm.
    pub vertices: Vec<[f64; 3]>,
    /// Indices of the three vertices of each triangle.
    pub faces: Vec<[u32; 3]>,
}

impl Mesh {
    /// The prism between two heights over a convex section with counter-clockwise corners.
    ///
    /// The bottom vertices come first, then the top ones in the same order.
    #[must_use]
    pub fn prism(section: &[Point], bottom: f64, top: f64) -> Self {
        let n = section.len() as u32;
        let at = |z: f64| section.iter().map(move |p| [p.x, p.y, z]);
        let caps = (2..n).flat_map(|k| [[0, k, k - 1], [n, n + k - 1, n + k]]);
        let walls = (0..n).flat_map(|a| {
            let b = (a + 1) % n;
            [[a, b, b + n], [a, b + n, a + n]]
        });
        Self {
            vertices: at(bottom).chain(at(top)).collect(),
            faces: caps.chain(walls).collect(),
        }
    }

    /// Joins several bodies into one mesh. They may touch or overlap; each stays closed.
    #[must_use]
    pub fn joined<'a>(bodies: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut whole = Self::default();
        for body in bodies {
            let first = whole.vertices.len() as u32;
            whole.vertices.extend_from_slice(&body.vertices);
            let faces = body.faces.iter();
            whole
                .faces
                .extend(faces.map(|face| face.map(|v| v + first)));
        }
        whole
    }

    /// Corners of one triangle, mm.
    #[must_use]
    pub fn triangle(&self, face: &[u32; 3]) -> [[f64; 3]; 3] {
        face.map(|vertex| self.vertices[vertex as usize])
    }

    /// Enclosed volume, mm³, by the divergence theorem; positive if the normals point outward.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let mut six = 0.0;
        for face in &self.faces {
            let [a, b, c] = self.triangle(face);
            six += a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
        six / 6.0
    }

    /// Whether every edge is shared by exactly two triangles that run along it in opposite directions.
    #[must_use]
    pub fn is_watertight(&self) -> bool {
        let mut edges: Vec<[u32; 2]> = self
            .faces
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .collect();
        edges.sort_unstable();
        edges.windows(2).all(|pair| pair[0] != pair[1])
            && edges
                .iter()
                .all(|&[a, b]| a != b && edges.binary_search(&[b, a]).is_ok())
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        Point,
        numeric::Tolerance,
        region::Outline,
        solid::{Mesh, Solid, SolidError},
        test_shapes::{rosette, tooth_ring},
    };

    fn tolerance(mm: f64) -> Tolerance {
        Tolerance::new(mm).expect("positive")
    }

    #[test]
    fn a_prism_is_closed_and_has_its_volume() {
        let section = [
            Point::new(0.0, 0.0),
            Point::new(3.0, 0.0),
            Point::new(4.0, 2.0),
            Point::new(1.0, 2.0),
        ];
        let prism = Mesh::prism(&section, -1.0, 2.0);
        assert!(prism.is_watertight());
        assert_eq!(prism.volume(), 18.0);
    }

    fn keyed_bore(radius: f64) -> Outline {
        // A bore with a keyway, its straight sides cut into collinear points.
        let mut points: Vec<Point> = (0..40)
            .map(|i| {
                let a = 0.3 + f64::from(i) / 39.0 * (std::f64::consts::TAU - 0.6);
                Point::new(radius * a.cos(), radius * a.sin())
            })
            .collect();
        let (low, high) = (points[39], points[0]);
        for i in 0..5 {
            points.push(Point::new(low.x + 0.5 * f64::from(i + 1), low.y));
        }
        for i in (0..5).rev() {
            points.push(Point::new(high.x + 0.5 * f64::from(i + 1), high.y));
        }
        Outline::polygon(&points)
    }

    #[test]
    fn a_toothed_ring_with_a_keyed_bore_is_watertight_at_every_tolerance() {
        let outline = tooth_ring(23, 2.25, tolerance(1e-9));
        for hole in [keyed_bore(6.0), keyed_bore(6.0).reversed()] {
            let solid = Solid::new(outline.clone(), vec![hole], -2.0, 8.0).expect("has height");
            for tol in [0.1, 1e-2, 1e-3, 1e-4] {
                let mesh = solid.mesh(tolerance(tol)).expect("contours apart");
                assert!(mesh.is_watertight());
                let n = mesh.vertices.len() / 2;
                assert_eq!(mesh.faces.len(), 4 * n);
                assert_eq!(mesh.faces.len(), solid.mesh_face_count(tolerance(tol)));
                let difference = (mesh.volume() - solid.volume()).abs();
                assert!(
                    difference < tol * 10.0 * (outline.length() + 60.0),
                    "{difference}"
                );
                assert_eq!(mesh, solid.mesh(tolerance(tol)).expect("the same again"));
            }
        }
    }

    #[test]
    fn a_mesh_with_a_face_missing_or_turned_is_not_watertight() {
        let outline = rosette(20.0, 2.0, 5, tolerance(1e-6));
        let solid = Solid::new(outline.reversed(), vec![], 0.0, 5.0).expect("has height");
        let mesh = solid.mesh(tolerance(1e-2)).expect("simple");
        assert!(mesh.is_watertight() && mesh.volume() > 0.0);
        let mut open = mesh.clone();
        open.faces.pop();
        assert!(!open.is_watertight());
        let mut turned = mesh;
        turned.faces[3].reverse();
        assert!(!turned.is_watertight());
    }

    #[test]
    fn holes_that_cut_the_outline_or_lie_outside_are_refused() {
        let outline = rosette(20.0, 2.0, 5, tolerance(1e-6));
        let with = |hole: Outline| {
            Solid::new(outline.clone(), vec![hole], 0.0, 5.0)
                .expect("has height")
                .mesh(tolerance(1e-2))
        };
        let circle = |x, r| Outline::circle(Point::new(x, 0.0), r);
        assert!(with(circle(0.0, 5.0)).is_ok());
        assert!(matches!(
            with(circle(0.0, 20.0)),
            Err(SolidError::Crossing { .. })
        ));
        assert!(matches!(
            with(circle(50.0, 5.0)),
            Err(SolidError::HoleOutside { hole: 0 })
        ));
        let p = Point::new;
        let eight = Outline::polygon(&[p(0.0, 0.0), p(4.0, 4.0), p(4.0, 0.0), p(0.0, 5.0)]);
        let solid = Solid::new(eight, vec![], 0.0, 1.0).expect("has height");
        assert!(matches!(
            solid.mesh(tolerance(1e-2)),
            Err(SolidError::Crossing { .. })
        ));
        assert!(matches!(
            Solid::new(outline, vec![], 5.0, 5.0),
            Err(SolidError::NoHeight { .. })
        ));
    }
}
