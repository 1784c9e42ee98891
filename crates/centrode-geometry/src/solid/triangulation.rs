use crate::{Point, numeric::Tolerance, solid::SolidError};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Edges of closed polygons as pairs of point indices; the points of all polygons are counted together.
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

/// Counter-clockwise triangles of the region to the left of every contour; their corners are the points of the contours.
///
/// A constrained Delaunay triangulation contains every point and edge, also along a straight line. So caps meet walls without
/// gaps.
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
    // The library refuses numbers too small to square; compared with any machine part they are zero.
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
        // A contour runs through a point of another: the library has split an edge there.
        let split = edges.iter().find(|[a, b]| {
            let handle = |i: &usize| spade::handles::FixedVertexHandle::from_index(*i);
            !triangulation.exists_constraint(handle(a), handle(b))
        });
        return Err(crossing(&points[split.map_or(0, |edge| edge[0])]));
    }
    // A face is inside or outside like its neighbour; this changes at an edge of a contour.
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
