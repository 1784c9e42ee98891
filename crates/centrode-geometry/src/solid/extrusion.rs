use super::triangulation::{edges, triangulate};
use crate::{
    numeric::Tolerance,
    region::{AreaMoments, Outline},
    solid::{MassProperties, Mesh, Opening, SolidError},
};

/// A straight extrusion along z: the region inside an outline and outside its holes, from `bottom` to `top`.
///
/// It may have an [`Opening`] through a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    outline: Outline,
    holes: Vec<Outline>,
    bottom: f64,
    top: f64,
    opening: Option<Opening>,
}

impl Solid {
    /// A solid between the heights `bottom` and `top`, mm. Contours may have either sense.
    ///
    /// # Errors
    /// [`SolidError::NoHeight`] unless `bottom < top`.
    pub fn new(
        outline: Outline,
        holes: Vec<Outline>,
        bottom: f64,
        top: f64,
    ) -> Result<Self, SolidError> {
        let forward = |o: Outline| {
            if o.is_counter_clockwise() {
                o
            } else {
                o.reversed()
            }
        };
        let holes = holes.into_iter().map(forward).collect();
        Self::from_counter_clockwise(forward(outline), holes, bottom, top)
    }

    /// A solid between the heights `bottom` and `top`, mm, of counter-clockwise contours.
    ///
    /// Like [`new`](Self::new), without the test of their sense, which takes some tenths of a millisecond for many curves.
    ///
    /// # Errors
    /// [`SolidError::NoHeight`] unless `bottom < top`.
    pub fn from_counter_clockwise(
        outline: Outline,
        holes: Vec<Outline>,
        bottom: f64,
        top: f64,
    ) -> Result<Self, SolidError> {
        if !(bottom < top && bottom.is_finite() && top.is_finite()) {
            return Err(SolidError::NoHeight { bottom, top });
        }
        Ok(Self {
            outline,
            holes,
            bottom,
            top,
            opening: None,
        })
    }

    /// Cuts an opening through the wall between the outline and a hole.
    ///
    /// # Errors
    /// [`SolidError::Opening`] unless all of these hold:
    /// - the opening lies within the height of the solid;
    /// - a segment of the outline runs from its first outer corner to the second;
    /// - a segment of a hole, counter-clockwise, runs from its first inner corner to the second.
    pub fn with_opening(mut self, opening: Opening) -> Result<Self, SolidError> {
        let [from, to] = opening.span;
        let (bottom, top) = (self.bottom, self.top);
        if !(bottom < from && from < to && to < top) || opening.region(&self).is_none() {
            return Err(SolidError::Opening {
                from,
                to,
                bottom,
                top,
            });
        }
        self.opening = Some(opening);
        Ok(self)
    }

    /// The opening through a wall, if it has one.
    #[must_use]
    pub fn opening(&self) -> Option<&Opening> {
        self.opening.as_ref()
    }

    /// Outer contour, counter-clockwise.
    #[must_use]
    pub fn outline(&self) -> &Outline {
        &self.outline
    }

    /// Contours of the holes, counter-clockwise.
    #[must_use]
    pub fn holes(&self) -> &[Outline] {
        &self.holes
    }

    /// Height of the lower face, mm.
    #[must_use]
    pub fn bottom(&self) -> f64 {
        self.bottom
    }

    /// Height of the upper face, mm.
    #[must_use]
    pub fn top(&self) -> f64 {
        self.top
    }

    /// Area moments about the origin of the cross-section without the opening, exact to rounding.
    #[must_use]
    pub fn section(&self) -> AreaMoments {
        self.holes.iter().fold(self.outline.moments(), |sum, hole| {
            sum.without(hole.moments())
        })
    }

    /// Volume, mm³, exact to rounding.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let opened = self
            .opening_region()
            .map_or(0.0, |(region, [from, to])| region.area() * (to - from));
        self.section().area * (self.top - self.bottom) - opened
    }

    /// Cross-section of the opening, and its lower and upper height, mm.
    fn opening_region(&self) -> Option<(Outline, [f64; 2])> {
        let opening = self.opening.as_ref()?;
        Some((opening.region(self)?, opening.span))
    }

    /// Mass, center of mass and inertia of the exact solid at a uniform density in kg/m³.
    #[must_use]
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let whole = MassProperties::of_extrusion(&self.section(), self.bottom, self.top, density);
        let Some((region, [from, to])) = self.opening_region() else {
            return whole;
        };
        let missing = MassProperties::of_extrusion(&region.moments(), from, to, -density);
        MassProperties::combined(&[whole, missing]).unwrap_or(whole)
    }

    /// Number of triangles of [`mesh`](Self::mesh) at a tolerance.
    #[must_use]
    pub fn mesh_face_count(&self, tolerance: Tolerance) -> usize {
        let contours = std::iter::once(&self.outline).chain(&self.holes);
        let points: usize = contours.map(|c| c.flatten(tolerance).len()).sum();
        // A cap with n corners and h holes has n + 2 h - 2 triangles, the walls have 2 n. With an opening the walls have three
        // times as many; the triangles around the opening about equal those it removes.
        let walls = if self.opening.is_some() { 6 } else { 2 };
        ((2 + walls) * points + 4 * self.holes.len()).saturating_sub(4)
    }

    /// Closed triangle mesh with outward normals; its side walls follow the contours within the tolerance.
    ///
    /// Triangles share vertices: first those of the bottom, then those at the ends of an opening, then those of the top, all
    /// in the same order.
    ///
    /// # Errors
    /// [`SolidError`] if the flattened contours cross or touch, or a hole is not in the material.
    pub fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, SolidError> {
        let mut contours = vec![self.outline.flatten(tolerance)];
        for hole in &self.holes {
            let mut points = hole.flatten(tolerance);
            points.reverse();
            contours.push(points);
        }
        if let Some(opening) = &self.opening {
            return opening.mesh(self, contours, tolerance);
        }
        let cap = triangulate(&contours, tolerance)?;
        let count: usize = contours.iter().map(Vec::len).sum();
        let n = count as u32;
        let mut vertices = Vec::with_capacity(2 * count);
        for z in [self.bottom, self.top] {
            vertices.extend(contours.iter().flatten().map(|p| [p.x, p.y, z]));
        }
        let mut faces = Vec::with_capacity(2 * (cap.len() + count));
        faces.extend(cap.iter().map(|&[a, b, c]| [a, c, b]));
        faces.extend(cap.iter().map(|face| face.map(|v| v + n)));
        for [a, b] in edges(&contours) {
            faces.push([a, b, b + n]);
            faces.push([a, b + n, a + n]);
        }
        Ok(Mesh { vertices, faces })
    }
}
