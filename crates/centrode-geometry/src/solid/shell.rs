use std::collections::HashMap;

/// Closed boundary of a body: faces on exact surfaces, joined along shared edges, as a CAD kernel holds it.
///
/// Surfaces of revolution are about the z axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shell {
    /// Corners, mm.
    pub vertices: Vec<[f64; 3]>,
    /// Edges between them, each between two faces.
    pub edges: Vec<ShellEdge>,
    /// The faces.
    pub faces: Vec<ShellFace>,
}

/// An edge from one vertex to another.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellEdge {
    /// Indices of its ends.
    pub ends: [usize; 2],
    /// Curve of the edge.
    pub curve: ShellCurve,
}

/// Curve of an edge.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellCurve {
    /// A straight line.
    Line,
    /// Counter-clockwise about the z axis, seen from above, at a constant height.
    Circle {
        /// Radius, mm.
        radius: f64,
    },
    /// A polynomial by its Bézier points, which begin and end at the ends.
    Bezier(Vec<[f64; 3]>),
}

/// Face of a shell: a part of a surface within bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellFace {
    /// Surface of the face.
    pub surface: ShellSurface,
    /// Its bounds, the outer one first: edges, and whether each is walked from its first end to its second.
    /// Seen from outside the body the face lies to the left.
    pub bounds: Vec<Vec<(usize, bool)>>,
}

/// Surface of a face.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellSurface {
    /// A plane through a point, its normal pointing out of the body.
    Plane {
        /// The point, mm.
        point: [f64; 3],
        /// The normal.
        normal: [f64; 3],
    },
    /// A cylinder, the body inside.
    Cylinder {
        /// Radius, mm.
        radius: f64,
    },
    /// A cone of 45 deg, the body inside.
    Cone {
        /// Height at which the radius holds, mm.
        height: f64,
        /// Radius there, mm.
        radius: f64,
        /// Whether the radius grows upwards.
        widens: bool,
    },
    /// Ruled surface between two Bézier curves of one degree: straight lines join the points of equal parameter.
    Ruled {
        /// Points of both curves, mm.
        points: [Vec<[f64; 3]>; 2],
        /// Whether the direction along the curves, crossed with that from the first to the second, points out
        /// of the body.
        outward: bool,
    },
}

impl Shell {
    /// Whether every edge bounds two faces, once each way: then the shell has no gap.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let mut uses: HashMap<(usize, bool), u32> = HashMap::new();
        for face in &self.faces {
            for bound in &face.bounds {
                for &side in bound {
                    *uses.entry(side).or_default() += 1;
                }
                let end = |&(edge, forward): &(usize, bool), last: bool| {
                    self.edges[edge].ends[usize::from(forward == last)]
                };
                let next = bound.iter().cycle().skip(1);
                if bound
                    .iter()
                    .zip(next)
                    .any(|(side, after)| end(side, true) != end(after, false))
                {
                    return false;
                }
            }
        }
        (0..self.edges.len()).all(|edge| {
            [true, false]
                .iter()
                .all(|&forward| uses.get(&(edge, forward)) == Some(&1))
        })
    }
}
