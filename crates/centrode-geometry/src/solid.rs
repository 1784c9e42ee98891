use crate::{AreaMoments, MassProperties, Mesh, Opening, Outline, Point, Tolerance};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use thiserror::Error;

/// A straight extrusion: the region inside an outline and outside its holes, from `bottom` to `top`
/// along z; it may have an [`Opening`] through a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    outline: Outline,
    holes: Vec<Outline>,
    bottom: f64,
    top: f64,
    opening: Option<Opening>,
}

/// Error of contours that do not bound a solid.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SolidError {
    /// The top is not above the bottom.
    #[error("a solid must be higher than it begins: bottom {bottom} mm, top {top} mm")]
    NoHeight {
        /// Lower face, mm.
        bottom: f64,
        /// Upper face, mm.
        top: f64,
    },
    /// A point of a contour is not a finite number.
    #[error("contour {contour} (0 is the outer one) has a point that is not finite")]
    NotFinite {
        /// Index of the contour, the outer one first.
        contour: usize,
    },
    /// Contours flattened at the tolerance meet or cross themselves or one another.
    #[error("contours cross or touch near ({x}, {y}) mm at a tolerance of {tolerance} mm")]
    Crossing {
        /// X coordinate, mm.
        x: f64,
        /// Y coordinate, mm.
        y: f64,
        /// The flattening tolerance, mm.
        tolerance: f64,
    },
    /// A hole is not inside the outer contour, or lies in another hole.
    #[error("hole {hole} does not lie in the material")]
    HoleOutside {
        /// Index of the hole.
        hole: usize,
    },
    /// A section of a turned body is no cylinder or cone of 45°, or does not hold the slot.
    #[error(
        "section {section} of a turned body is no cylinder or cone of 45°, or does not hold its slot"
    )]
    Turned {
        /// Index of the section.
        section: usize,
    },
    /// An opening does not lie in a wall of the solid.
    #[error(
        "an opening from {from} to {to} mm does not go through a wall between the outline and a hole, from {bottom} to {top} mm"
    )]
    Opening {
        /// Its lower end, mm.
        from: f64,
        /// Its upper end, mm.
        to: f64,
        /// Lower face of the solid, mm.
        bottom: f64,
        /// Upper face, mm.
        top: f64,
    },
}

impl Solid {
    /// A solid between the heights `bottom` and `top`; contours may be walked either way.
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
        Self::counter_clockwise(forward(outline), holes, bottom, top)
    }

    /// A solid between the heights `bottom` and `top` of contours that are all counter-clockwise: [`new`](Self::new) without
    /// looking which way they are walked, which for teeth of many curves takes some tenths of a millisecond.
    ///
    /// # Errors
    /// [`SolidError::NoHeight`] unless `bottom < top`.
    pub fn counter_clockwise(
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
    /// [`SolidError::Opening`] unless it lies within the height, a side of the outline runs from its first outer
    /// corner to the second, and a side of a hole, counter-clockwise, from its first inner corner to the second.
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

    /// Area moments of the cross-section about the origin, beside an opening, exact to rounding.
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
            .opened()
            .map_or(0.0, |(region, [from, to])| region.area() * (to - from));
        self.section().area * (self.top - self.bottom) - opened
    }

    /// Section removed by the opening, and its lower and upper height.
    fn opened(&self) -> Option<(Outline, [f64; 2])> {
        let opening = self.opening.as_ref()?;
        Some((opening.region(self)?, opening.span))
    }

    /// Mass, center of mass and inertia of the exact solid at a uniform density in kg/m³.
    #[must_use]
    pub fn mass_properties(&self, density: f64) -> MassProperties {
        let whole = MassProperties::of_extrusion(&self.section(), self.bottom, self.top, density);
        let Some((region, [from, to])) = self.opened() else {
            return whole;
        };
        let missing = MassProperties::of_extrusion(&region.moments(), from, to, -density);
        MassProperties::together(&[whole, missing]).unwrap_or(whole)
    }

    /// Number of triangles of [`mesh`](Self::mesh) at a tolerance.
    #[must_use]
    pub fn mesh_faces(&self, tolerance: Tolerance) -> usize {
        let contours = std::iter::once(&self.outline).chain(&self.holes);
        let points: usize = contours.map(|c| c.flatten(tolerance).len()).sum();
        // A cap of n corners and h holes has n + 2 h - 2, the walls have 2 n; with an opening three times as many,
        // and about as many round it as it takes away.
        let walls = if self.opening.is_some() { 6 } else { 2 };
        ((2 + walls) * points + 4 * self.holes.len()).saturating_sub(4)
    }

    /// Closed triangle mesh with outward normals whose side walls follow the contours within the tolerance. Its
    /// vertices are shared: the bottom ones first, then the top ones in the same order, with those of an opening's
    /// ends between.
    ///
    /// # Errors
    /// [`SolidError`] where the flattened contours cross or touch, or a hole is not in the material.
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

/// Edges of closed polygons whose points are numbered through.
pub(crate) fn edges(contours: &[Vec<Point>]) -> Vec<[u32; 2]> {
    let mut out = Vec::new();
    let mut first = 0;
    for contour in contours {
        let n = contour.len() as u32;
        out.extend((0..n).map(|i| [first + i, first + (i + 1) % n]));
        first += n;
    }
    out
}

/// Counter-clockwise triangles of the region left of every contour, with the contours' own points.
///
/// A constrained Delaunay triangulation keeps every point and edge, also along a straight line, so the
/// caps meet the walls without gaps.
pub(crate) fn triangulate(
    contours: &[Vec<Point>],
    tolerance: Tolerance,
) -> Result<Vec<[u32; 3]>, SolidError> {
    let crossing = |p: &Point| SolidError::Crossing {
        x: p.x,
        y: p.y,
        tolerance: tolerance.mm(),
    };
    let points: Vec<Point> = contours.iter().flatten().copied().collect();
    if let Some(contour) = contours
        .iter()
        .position(|c| c.iter().any(|p| !(p.x.is_finite() && p.y.is_finite())))
    {
        return Err(SolidError::NotFinite { contour });
    }
    // The library refuses numbers it cannot square; next to any machine part they are zero.
    let snap = |x: f64| if x.abs() < 1e-100 { 0.0 } else { x };
    let vertices = points
        .iter()
        .map(|p| Point2::new(snap(p.x), snap(p.y)))
        .collect();
    let edges: Vec<[usize; 2]> = edges(contours)
        .into_iter()
        .map(|edge| edge.map(|v| v as usize))
        .collect();
    let mut conflict = None;
    let triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
        vertices,
        edges.clone(),
        |edge| conflict = conflict.or(Some(edge[0])),
    )
    .map_err(|_| SolidError::NotFinite { contour: 0 })?;
    if let Some(vertex) = conflict {
        return Err(crossing(&points[vertex]));
    }
    if triangulation.num_vertices() < points.len() {
        let twin = (0..points.len()).find(|&i| points[..i].contains(&points[i]));
        return Err(crossing(&points[twin.unwrap_or(0)]));
    }
    if triangulation.num_constraints() != edges.len() {
        // A contour runs through a point of another: some edge has been split there.
        let split = edges.iter().find(|[a, b]| {
            let handle = |i: &usize| spade::handles::FixedVertexHandle::from_index(*i);
            !triangulation.exists_constraint(handle(a), handle(b))
        });
        return Err(crossing(&points[split.map_or(0, |edge| edge[0])]));
    }
    // Every edge of a contour has the material on its left: the state of a face is that of its
    // neighbour, changed where the edge between them belongs to a contour.
    let mut inside = vec![None; triangulation.num_all_faces()];
    inside[triangulation.outer_face().fix().index()] = Some(false);
    let mut stack = vec![triangulation.outer_face().fix()];
    for edge in triangulation.convex_hull() {
        let face = edge.rev().face();
        let state = edge.is_constraint_edge();
        if inside[face.fix().index()].is_none() {
            inside[face.fix().index()] = Some(state);
            stack.push(face.fix());
        }
    }
    while let Some(face) = stack.pop() {
        let Some(face) = triangulation.face(face).as_inner() else {
            continue;
        };
        let state = inside[face.fix().index()] == Some(true);
        for edge in face.adjacent_edges() {
            let other = edge.rev().face().fix();
            if inside[other.index()].is_none() {
                inside[other.index()] = Some(state != edge.is_constraint_edge());
                stack.push(other);
            }
        }
    }
    let mut triangles = Vec::with_capacity(points.len());
    for face in triangulation.inner_faces() {
        if inside[face.fix().index()] == Some(true) {
            triangles.push(face.vertices().map(|v| v.fix().index() as u32));
        }
    }
    check_sides(contours, &triangles)?;
    Ok(triangles)
}

/// Checks that every contour edge bounds exactly one triangle, on its left.
fn check_sides(contours: &[Vec<Point>], triangles: &[[u32; 3]]) -> Result<(), SolidError> {
    let directed: std::collections::HashSet<[u32; 2]> = triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .collect();
    let mut first = 0;
    for (contour, points) in contours.iter().enumerate() {
        let edge = [first, first + 1];
        if !directed.contains(&edge) {
            return Err(SolidError::HoleOutside {
                hole: contour.saturating_sub(1),
            });
        }
        first += points.len() as u32;
    }
    Ok(())
}
