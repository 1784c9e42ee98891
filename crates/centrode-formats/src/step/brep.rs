//! Boundary of a straight extrusion: two flat caps and one wall per side of its contours.

use super::{
    StepError, contour, opened,
    part21::{Data, Id, List, Real},
};
use centrode_geometry::{Point, PolySegment, Segment, Solid, Vector};

/// Shortest side of a contour, mm: ten times the accuracy stated in the file, below which a kernel treats two points as one.
const SHORTEST: f64 = 1e-6;

/// Writes the closed boundary of a solid and returns its `MANIFOLD_SOLID_BREP`.
pub(super) fn manifold(data: &mut Data, name: &str, solid: &Solid) -> Result<Id, StepError> {
    // The material lies to the left of every contour, so outside is to the right of each side.
    let contours = contour::contours(solid, SHORTEST)?;
    if let Some(opening) = solid.opening() {
        return opened::manifold(data, name, solid, opening, &contours);
    }
    let mut shape = ExtrusionWriter::new(data, solid.bottom(), solid.top());
    let mut faces = Vec::new();
    let (mut below, mut above) = (Vec::new(), Vec::new());
    for (index, sides) in contours.iter().enumerate() {
        let ring = shape.ring(sides);
        faces.extend(shape.walls(sides, &ring));
        let kind = if index == 0 {
            "FACE_OUTER_BOUND"
        } else {
            "FACE_BOUND"
        };
        let backward: Vec<Id> = ring.iter().rev().map(|side| side.bottom).collect();
        let forward: Vec<Id> = ring.iter().map(|side| side.top).collect();
        below.push(shape.bound(kind, &backward, false));
        above.push(shape.bound(kind, &forward, true));
    }
    faces.push(shape.cap(solid.bottom(), -1.0, &below));
    faces.push(shape.cap(solid.top(), 1.0, &above));
    let shell = data.add(format_args!("CLOSED_SHELL('',{})", List(&faces)));
    Ok(data.add(format_args!("MANIFOLD_SOLID_BREP({name},{shell})")))
}

/// Edges of one wall: its lower and upper one, and the axial one at its start.
#[derive(Clone, Copy, Debug)]
struct Side {
    bottom: Id,
    top: Id,
    upright: Id,
}

#[derive(Debug)]
pub(super) struct ExtrusionWriter<'a> {
    pub(super) data: &'a mut Data,
    bottom: f64,
    top: f64,
    /// Direction of the extrusion.
    pub(super) up: Id,
}

impl<'a> ExtrusionWriter<'a> {
    pub(super) fn new(data: &'a mut Data, bottom: f64, top: f64) -> Self {
        let up = data.add("DIRECTION('',(0.0,0.0,1.0))");
        Self {
            data,
            bottom,
            top,
            up,
        }
    }

    fn point(&mut self, p: Point, z: f64) -> Id {
        let at = [Real(p.x), Real(p.y), Real(z)];
        self.data
            .add(format_args!("CARTESIAN_POINT('',{})", List(&at)))
    }

    fn direction(&mut self, v: Vector, z: f64) -> Id {
        let along = [Real(v.x), Real(v.y), Real(z)];
        self.data
            .add(format_args!("DIRECTION('',{})", List(&along)))
    }

    /// An infinite straight line.
    pub(super) fn line(&mut self, from: Id, direction: Id) -> Id {
        let vector = self
            .data
            .add(format_args!("VECTOR('',{direction},{})", Real(1.0)));
        self.data.add(format_args!("LINE('',{from},{vector})"))
    }

    /// A frame: origin, z axis and x axis.
    fn frame(&mut self, origin: Id, axis: Id, reference: Id) -> Id {
        self.data.add(format_args!(
            "AXIS2_PLACEMENT_3D('',{origin},{axis},{reference})"
        ))
    }

    pub(super) fn edge(&mut self, from: Id, to: Id, curve: Id) -> Id {
        self.data
            .add(format_args!("EDGE_CURVE('',{from},{to},{curve},.T.)"))
    }

    /// Writes the edges along and between both copies of a contour.
    fn ring(&mut self, sides: &[Segment]) -> Vec<Side> {
        let levels = [self.bottom, self.top];
        let corners: Vec<[(Id, Id); 2]> = sides
            .iter()
            .map(|side| levels.map(|z| self.corner(side.start(), z)))
            .collect();
        let count = corners.len();
        (0..count)
            .map(|i| {
                let (here, next) = (corners[i], corners[(i + 1) % count]);
                let [bottom, top] = [0, 1].map(|level| {
                    let curve = self.curve(&sides[i], here[level].0, levels[level]);
                    self.edge(here[level].1, next[level].1, curve)
                });
                let upright = self.line(here[0].0, self.up);
                let upright = self.edge(here[0].1, here[1].1, upright);
                Side {
                    bottom,
                    top,
                    upright,
                }
            })
            .collect()
    }

    /// A point and the vertex at it.
    pub(super) fn corner(&mut self, p: Point, z: f64) -> (Id, Id) {
        let point = self.point(p, z);
        let vertex = self.data.add(format_args!("VERTEX_POINT('',{point})"));
        (point, vertex)
    }

    /// Writes the curve of a side at a height, in the direction of the side.
    pub(super) fn curve(&mut self, side: &Segment, start: Id, z: f64) -> Id {
        match side {
            Segment::Line(from, to) => {
                let along = self.direction((to - from).normalize(), 0.0);
                self.line(start, along)
            }
            Segment::Arc(arc) => {
                let center = self.point(arc.center(), z);
                let turn = self.direction(Vector::zeros(), arc.bulge.signum());
                let reference = self.direction((arc.start - arc.center()).normalize(), 0.0);
                let frame = self.frame(center, turn, reference);
                let radius = Real(arc.radius());
                self.data.add(format_args!("CIRCLE('',{frame},{radius})"))
            }
            Segment::Poly(poly) => {
                let poles: Vec<Id> = poles(poly)
                    .into_iter()
                    .map(|pole| self.point(pole, z))
                    .collect();
                let degree = poles.len() - 1;
                let order = poles.len();
                self.data.add(format_args!(
                    "B_SPLINE_CURVE_WITH_KNOTS('',{degree},{},.UNSPECIFIED.,.F.,.F.,({order},{order}),(0.0,1.0),.BEZIER_KNOTS.)",
                    List(&poles)
                ))
            }
        }
    }

    /// Writes the walls over the sides of a contour; their edges run counter-clockwise as seen from outside.
    fn walls(&mut self, sides: &[Segment], ring: &[Side]) -> Vec<Id> {
        let next = ring.iter().cycle().skip(1);
        sides
            .iter()
            .zip(ring.iter().zip(next))
            .map(|(side, (edges, after))| {
                let (surface, outward) = self.surface(side);
                let around = [
                    (edges.bottom, true),
                    (after.upright, true),
                    (edges.top, false),
                    (edges.upright, false),
                ]
                .map(|(edge, forward)| self.oriented(edge, forward));
                let bound = self.closed("FACE_OUTER_BOUND", &around);
                self.face(&[bound], surface, outward)
            })
            .collect()
    }

    /// Writes the surface over a side; returns also whether its normal points outward.
    pub(super) fn surface(&mut self, side: &Segment) -> (Id, bool) {
        let (bottom, up) = (self.bottom, self.up);
        let start = self.point(side.start(), bottom);
        match side {
            Segment::Line(from, to) => {
                let along = (to - from).normalize();
                let outward = self.direction(Vector::new(along.y, -along.x), 0.0);
                let along = self.direction(along, 0.0);
                let frame = self.frame(start, outward, along);
                (self.data.add(format_args!("PLANE('',{frame})")), true)
            }
            Segment::Arc(arc) => {
                let center = self.point(arc.center(), bottom);
                let reference = self.direction((arc.start - arc.center()).normalize(), 0.0);
                let frame = self.frame(center, up, reference);
                let radius = Real(arc.radius());
                let cylinder = self
                    .data
                    .add(format_args!("CYLINDRICAL_SURFACE('',{frame},{radius})"));
                (cylinder, arc.bulge > 0.0)
            }
            Segment::Poly(_) => {
                let curve = self.curve(side, start, bottom);
                let height = Real(self.top - bottom);
                let sweep = self.data.add(format_args!("VECTOR('',{up},{height})"));
                let surface = self.data.add(format_args!(
                    "SURFACE_OF_LINEAR_EXTRUSION('',{curve},{sweep})"
                ));
                (surface, true)
            }
        }
    }

    pub(super) fn oriented(&mut self, edge: Id, forward: bool) -> Id {
        let forward = logical(forward);
        self.data
            .add(format_args!("ORIENTED_EDGE('',*,*,{edge},{forward})"))
    }

    /// A boundary of a face from oriented edges in order.
    pub(super) fn closed(&mut self, kind: &str, edges: &[Id]) -> Id {
        let ring = self.data.add(format_args!("EDGE_LOOP('',{})", List(edges)));
        self.data.add(format_args!("{kind}('',{ring},.T.)"))
    }

    /// A boundary of a face from edges that are all used in the same direction.
    fn bound(&mut self, kind: &str, edges: &[Id], forward: bool) -> Id {
        let edges: Vec<Id> = edges
            .iter()
            .map(|edge| self.oriented(*edge, forward))
            .collect();
        self.closed(kind, &edges)
    }

    /// A flat end whose outward normal is along z times `way`.
    pub(super) fn cap(&mut self, z: f64, way: f64, bounds: &[Id]) -> Id {
        let origin = self.point(Point::origin(), z);
        let normal = self.direction(Vector::zeros(), way);
        let reference = self.direction(Vector::x(), 0.0);
        let frame = self.frame(origin, normal, reference);
        let plane = self.data.add(format_args!("PLANE('',{frame})"));
        self.face(bounds, plane, true)
    }

    pub(super) fn face(&mut self, bounds: &[Id], surface: Id, outward: bool) -> Id {
        self.data.add(format_args!(
            "ADVANCED_FACE('',{},{surface},{})",
            List(bounds),
            logical(outward)
        ))
    }
}

fn logical(truth: bool) -> &'static str {
    if truth { ".T." } else { ".F." }
}

/// Bézier control points of a polynomial segment, which represent the curve exactly.
///
/// Control point `j` is the polar form at `j` ones and `n - j` minus ones; there a power `k` becomes the
/// elementary symmetric function of order `k` over its number of terms, at most 1, so no digits are lost.
#[must_use]
pub fn poles(poly: &PolySegment) -> Vec<Point> {
    let coefficients = poly.coefficients();
    let degree = coefficients.len() - 1;
    let mut poles: Vec<Point> = (0..=degree)
        .map(|ones| {
            let mut symmetric = vec![1.0];
            for index in 0..degree {
                let root = if index < ones { 1.0 } else { -1.0 };
                symmetric.push(0.0);
                for k in (1..symmetric.len()).rev() {
                    symmetric[k] += root * symmetric[k - 1];
                }
            }
            let mut terms = 1.0;
            let mut pole = Vector::zeros();
            for (k, (c, sum)) in coefficients.iter().zip(symmetric).enumerate() {
                pole += c * (sum / terms);
                terms *= (degree - k) as f64 / (k + 1) as f64;
            }
            Point::from(pole)
        })
        .collect();
    poles[0] = poly.start();
    poles[degree] = poly.end();
    poles
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_geometry::Tolerance;

    #[test]
    fn control_points_give_the_same_curve() {
        let wave = |t: f64| Point::new(20.0 * t.cos(), 9.0 * (1.3 * t).sin() + t);
        let tolerance = Tolerance::new(1e-9).expect("positive");
        for poly in PolySegment::fit(wave, -1.0, 2.0, tolerance) {
            let poles = poles(&poly);
            assert_eq!(poles[0], poly.start());
            for i in 0..=40 {
                let t = f64::from(i) / 40.0;
                // De Casteljau.
                let mut row = poles.clone();
                while row.len() > 1 {
                    row = row.windows(2).map(|w| w[0] + (w[1] - w[0]) * t).collect();
                }
                let exact = poly.at(2.0 * t - 1.0).point;
                assert!((row[0] - exact).norm() < 2e-14 * 20.0, "{t}");
            }
        }
    }
}
