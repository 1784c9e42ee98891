use std::collections::HashMap;

/// Closed boundary of a body: faces on exact surfaces that share edges, as in a CAD kernel.
///
/// Surfaces of revolution are about the z axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shell {
    /// Corners, mm.
    pub vertices: Vec<[f64; 3]>,
    /// Edges between the corners; each joins two faces.
    pub edges: Vec<ShellEdge>,
    /// The faces.
    pub faces: Vec<ShellFace>,
}

/// An edge from one vertex to another.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellEdge {
    /// Indices of its start and end vertex.
    pub ends: [usize; 2],
    /// Curve of the edge.
    pub curve: ShellCurve,
}

/// Curve of an edge.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellCurve {
    /// A straight line.
    Line,
    /// An arc about the z axis at a constant height, counter-clockwise seen from above.
    Circle {
        /// Radius, mm.
        radius: f64,
    },
    /// A polynomial curve by its Bézier points; the first and last are the ends of the edge.
    Bezier(Vec<[f64; 3]>),
}

/// An edge as part of a bound.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub struct ShellSide {
    /// Index of the edge.
    pub edge: usize,
    /// Whether the bound runs from the start of the edge to its end.
    pub forward: bool,
}

impl ShellSide {
    /// Reverses the direction of the edge.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self {
            forward: !self.forward,
            ..self
        }
    }
}

/// Face of a shell: a part of a surface within bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellFace {
    /// Surface of the face.
    pub surface: ShellSurface,
    /// Its closed bounds, the outer one first. Seen from outside the body, the face lies to their left.
    pub bounds: Vec<Vec<ShellSide>>,
}

/// Surface of a face.
#[derive(Clone, Debug, PartialEq)]
pub enum ShellSurface {
    /// A plane through a point; its normal points out of the body.
    Plane {
        /// The point, mm.
        point: [f64; 3],
        /// The normal.
        normal: [f64; 3],
    },
    /// A cylinder with the body inside.
    Cylinder {
        /// Radius, mm.
        radius: f64,
    },
    /// A cone of 45 deg with the body inside.
    Cone {
        /// Height at which it has this radius, mm.
        height: f64,
        /// Radius there, mm.
        radius: f64,
        /// Whether the radius increases upwards.
        widens: bool,
    },
    /// Ruled surface between two Bézier curves of one degree: straight lines join the points of equal parameter.
    Ruled {
        /// Points of both curves, mm.
        points: [Vec<[f64; 3]>; 2],
        /// Whether the cross product of the direction along the curves and that from the first to the second points out of
        /// the body.
        outward: bool,
    },
}

impl Shell {
    /// Whether every edge bounds two faces, once in each direction: then the shell has no gap.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let mut uses: HashMap<ShellSide, u32> = HashMap::new();
        for face in &self.faces {
            for bound in &face.bounds {
                for &side in bound {
                    *uses.entry(side).or_default() += 1;
                }
                let end = |&ShellSide { edge, forward }: &ShellSide, last: bool| {
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
                .all(|&forward| uses.get(&ShellSide { edge, forward }) == Some(&1))
        })
    }
}
