use super::triangulation::{edges, triangulate};
use crate::{
    Point,
    curve::Segment,
    numeric::Tolerance,
    region::Outline,
    solid::{Mesh, Solid, SolidError},
};

/// An opening through the wall between the outline of a [`Solid`] and one of its holes, between two heights.
///
/// Its sides, floor and ceiling are plane; floor and ceiling are square to the extrusion.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Its corners on the outline: the ends of one segment, in counter-clockwise order.
    pub outer: [Point; 2],
    /// Its corners on the hole: the ends of one segment, in counter-clockwise order.
    pub inner: [Point; 2],
    /// Lower and upper end, mm.
    pub span: [f64; 2],
}

impl Opening {
    /// Segments of the outline and of the hole that the opening interrupts.
    #[must_use]
    pub fn segments(&self, solid: &Solid) -> Option<[Segment; 2]> {
        let between = |contour: &Outline, [start, end]: [Point; 2]| {
            let mut segments = contour.segments().iter();
            segments
                .find(|s| s.start() == start && s.end() == end)
                .copied()
        };
        let outer = between(solid.outline(), self.outer)?;
        let inner = solid
            .holes()
            .iter()
            .find_map(|hole| between(hole, self.inner))?;
        Some([outer, inner])
    }

    /// Cross-section of the opening, counter-clockwise.
    pub(crate) fn region(&self, solid: &Solid) -> Option<Outline> {
        let [outer, inner] = self.segments(solid)?;
        let sides = vec![
            outer,
            Segment::Line(outer.end(), inner.end()),
            inner.reversed(),
            Segment::Line(inner.start(), outer.start()),
        ];
        Outline::new(sides)
            .ok()
            .filter(Outline::is_counter_clockwise)
    }

    /// Mesh of the solid over its flattened contours, which have the material on their left.
    ///
    /// Every point of the contours has a vertex at four heights, those of the solid and of the opening: so the walls meet the
    /// corners of the opening.
    pub(crate) fn mesh(
        &self,
        solid: &Solid,
        contours: Vec<Vec<Point>>,
        tolerance: Tolerance,
    ) -> Result<Mesh, SolidError> {
        let missing = || SolidError::Opening {
            from: self.span[0],
            to: self.span[1],
            bottom: solid.bottom(),
            top: solid.top(),
        };
        let cap = triangulate(&contours, tolerance)?;
        // Here the contours of holes run clockwise.
        let [b0, b1] = self.inner;
        let (outer, inner) = (
            Stretch::new(&contours, self.outer).ok_or_else(missing)?,
            Stretch::new(&contours, [b1, b0]).ok_or_else(missing)?,
        );
        let points: Vec<Point> = contours.iter().flatten().copied().collect();
        let n = points.len() as u32;
        let heights = [solid.bottom(), self.span[0], self.span[1], solid.top()];
        let vertices = heights
            .iter()
            .flat_map(|&z| points.iter().map(move |p| [p.x, p.y, z]))
            .collect();
        let mut faces: Vec<[u32; 3]> = cap.iter().map(|&[a, b, c]| [a, c, b]).collect();
        faces.extend(cap.iter().map(|face| face.map(|v| v + 3 * n)));
        // Floor and ceiling.
        let rim: Vec<u32> = outer
            .indices
            .iter()
            .chain(&inner.indices)
            .copied()
            .collect();
        let corners = rim.iter().map(|&v| points[v as usize]).collect();
        for [a, b, c] in triangulate(&[corners], tolerance)? {
            let [a, b, c] = [a, b, c].map(|v| rim[v as usize]);
            faces.push([a, b, c].map(|v| v + n));
            faces.push([a, c, b].map(|v| v + 2 * n));
        }
        let mut wall = |layer: u32, [a, b]: [u32; 2]| {
            let [a, b] = [a, b].map(|v| v + layer * n);
            faces.push([a, b, b + n]);
            faces.push([a, b + n, a + n]);
        };
        for edge in edges(&contours) {
            wall(0, edge);
            wall(2, edge);
            if !outer.has(edge) && !inner.has(edge) {
                wall(1, edge);
            }
        }
        wall(1, [outer.first(), inner.last()]);
        wall(1, [inner.first(), outer.last()]);
        Ok(Mesh { vertices, faces })
    }
}

/// Point indices along a contour from one corner to another.
struct Stretch {
    indices: Vec<u32>,
}

impl Stretch {
    fn new(contours: &[Vec<Point>], [from, to]: [Point; 2]) -> Option<Self> {
        let mut first = 0;
        for contour in contours {
            let at = |p: Point| contour.iter().position(|q| *q == p);
            if let (Some(start), Some(end)) = (at(from), at(to)) {
                let count = contour.len();
                let steps = (end + count - start) % count;
                let number = |k: usize| (first + (start + k) % count) as u32;
                return Some(Self {
                    indices: (0..=steps).map(number).collect(),
                });
            }
            first += contour.len();
        }
        None
    }

    fn has(&self, edge: [u32; 2]) -> bool {
        self.indices.windows(2).any(|pair| *pair == edge)
    }

    fn first(&self) -> u32 {
        self.indices[0]
    }

    fn last(&self) -> u32 {
        self.indices[self.indices.len() - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{curve::Arc, solid::VolumeMoments};
    use nalgebra::Vector3;

    /// Tube with an opening of a half width, its contours split at the opening's corners.
    fn tube(half: f64, span: [f64; 2]) -> (Solid, Opening) {
        let ring = |radius: f64| {
            let angle = (half / radius).asin();
            let at = |angle: f64| Point::new(radius * angle.cos(), radius * angle.sin());
            let (low, high, back) = (at(-angle), at(angle), Point::new(-radius, 0.0));
            let arc = |start, end, turn: f64| {
                let bulge = (0.25 * turn).tan();
                Segment::Arc(Arc { start, end, bulge })
            };
            let rest = std::f64::consts::PI - angle;
            let sides = vec![
                arc(low, high, 2.0 * angle),
                arc(high, back, rest),
                arc(back, low, rest),
            ];
            (Outline::new(sides).expect("closed"), [low, high])
        };
        let ((outline, outer), (hole, inner)) = (ring(13.0), ring(10.0));
        let solid = Solid::new(outline, vec![hole], -15.0, 15.0).expect("has height");
        (solid, Opening { outer, inner, span })
    }

    /// Moments of the body inside a mesh: the four-point rule, exact to second moments, in each face's tetrahedron
    /// over the origin.
    fn moments(mesh: &Mesh) -> VolumeMoments {
        let (own, other) = (0.585_410_196_624_969, 0.138_196_601_125_011);
        let mut moments = VolumeMoments::default();
        for face in &mesh.faces {
            let [a, b, c] = mesh.triangle(face).map(Vector3::from);
            let volume = a.dot(&b.cross(&c)) / 6.0;
            for corner in [Vector3::zeros(), a, b, c] {
                moments.add((a + b + c) * other + corner * (own - other), 0.25 * volume);
            }
        }
        moments
    }

    #[test]
    fn a_tube_with_an_opening_is_closed_and_lighter_by_what_the_opening_takes() {
        let (whole, opening) = tube(2.75, [-2.0, 3.0]);
        let opened = whole
            .clone()
            .with_opening(opening)
            .expect("through the wall");
        let tolerance = Tolerance::new(1e-4).expect("positive");
        let mesh = opened.mesh(tolerance).expect("apart");
        assert!(mesh.is_watertight());
        assert!((mesh.volume() / opened.volume() - 1.0).abs() < 1e-4);
        // Between two circles within |y| <= h: the integral of both chords.
        let half = |r: f64| 2.75 * (r * r - 2.75 * 2.75).sqrt() + r * r * (2.75 / r).asin();
        let expected = (half(13.0) - half(10.0)) * 5.0;
        assert!((whole.volume() - opened.volume() - expected).abs() < 1e-9);
        let (exact, found) = (
            opened.mass_properties(2700.0),
            moments(&mesh).mass_properties(2700.0),
        );
        assert!((exact.center - found.center).norm() < 1e-3, "{exact:?}");
        assert!((exact.inertia - found.inertia).norm() < 1e-4 * exact.inertia.norm());
        assert!(exact.center.x < -0.01);
        let faces = mesh.faces.len().abs_diff(opened.mesh_face_count(tolerance));
        assert!(faces * 10 < mesh.faces.len(), "{faces}");
    }

    #[test]
    fn an_opening_outside_the_wall_is_refused() {
        for span in [[-16.0, 3.0], [3.0, 3.0], [0.0, 15.0]] {
            let (whole, opening) = tube(2.75, span);
            assert!(matches!(
                whole.with_opening(opening),
                Err(SolidError::Opening { .. })
            ));
        }
        let (whole, _) = tube(2.75, [0.0, 1.0]);
        let (_, elsewhere) = tube(2.0, [0.0, 1.0]);
        assert!(whole.with_opening(elsewhere).is_err());
    }
}
