//! Boundary of a shell, face by face.

use super::{
    StepError,
    part21::{Data, Id, List, Real},
};
use centrode_geometry::{Shell, ShellCurve, ShellEdge, ShellSurface};

/// Writes a closed shell and returns its `MANIFOLD_SOLID_BREP`.
pub(super) fn manifold(data: &mut Data, name: &str, shell: &Shell) -> Result<Id, StepError> {
    if let Some(vertex) = shell
        .vertices
        .iter()
        .position(|v| v.iter().any(|x| !x.is_finite()))
    {
        return Err(StepError::NotFiniteVertex { vertex });
    }
    if !shell.is_closed() {
        return Err(StepError::Open);
    }
    let mut shape = ShellWriter { data, shell };
    let vertices: Vec<[Id; 2]> = shell
        .vertices
        .iter()
        .map(|&at| {
            let point = shape.point(at);
            let vertex = shape.data.add(format_args!("VERTEX_POINT('',{point})"));
            [point, vertex]
        })
        .collect();
    let edges: Vec<Id> = shell
        .edges
        .iter()
        .map(|edge| {
            let curve = shape.curve(edge, vertices[edge.ends[0]][0]);
            let [from, to] = edge.ends.map(|end| vertices[end][1]);
            shape
                .data
                .add(format_args!("EDGE_CURVE('',{from},{to},{curve},.T.)"))
        })
        .collect();
    let mut faces = Vec::new();
    for face in &shell.faces {
        let (surface, same) = shape.surface(&face.surface);
        let mut bounds = Vec::new();
        for (index, bound) in face.bounds.iter().enumerate() {
            let sides: Vec<Id> = bound
                .iter()
                .map(|side| {
                    let (edge, way) = (edges[side.edge], logical(side.forward));
                    shape
                        .data
                        .add(format_args!("ORIENTED_EDGE('',*,*,{edge},{way})"))
                })
                .collect();
            let ring = shape
                .data
                .add(format_args!("EDGE_LOOP('',{})", List(&sides)));
            let kind = if index == 0 {
                "FACE_OUTER_BOUND"
            } else {
                "FACE_BOUND"
            };
            bounds.push(shape.data.add(format_args!("{kind}('',{ring},.T.)")));
        }
        let same = logical(same);
        faces.push(shape.data.add(format_args!(
            "ADVANCED_FACE('',{},{surface},{same})",
            List(&bounds)
        )));
    }
    let closed = data.add(format_args!("CLOSED_SHELL('',{})", List(&faces)));
    Ok(data.add(format_args!("MANIFOLD_SOLID_BREP({name},{closed})")))
}

struct ShellWriter<'a> {
    data: &'a mut Data,
    shell: &'a Shell,
}

impl ShellWriter<'_> {
    fn point(&mut self, at: [f64; 3]) -> Id {
        self.data
            .add(format_args!("CARTESIAN_POINT('',{})", List(&at.map(Real))))
    }

    fn direction(&mut self, along: [f64; 3]) -> Id {
        self.data
            .add(format_args!("DIRECTION('',{})", List(&along.map(Real))))
    }

    /// A frame: origin, z axis and x axis.
    fn frame(&mut self, origin: [f64; 3], axis: [f64; 3], reference: [f64; 3]) -> Id {
        let origin = self.point(origin);
        let [axis, reference] = [axis, reference].map(|d| self.direction(d));
        self.data.add(format_args!(
            "AXIS2_PLACEMENT_3D('',{origin},{axis},{reference})"
        ))
    }

    fn curve(&mut self, edge: &ShellEdge, start: Id) -> Id {
        let [from, to] = edge.ends.map(|end| self.shell.vertices[end]);
        match &edge.curve {
            ShellCurve::Line => {
                let along = [0, 1, 2].map(|i| to[i] - from[i]);
                let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
                let direction = self.direction(along.map(|x| x / length));
                let vector = self
                    .data
                    .add(format_args!("VECTOR('',{direction},{})", Real(1.0)));
                self.data.add(format_args!("LINE('',{start},{vector})"))
            }
            ShellCurve::Circle { radius } => {
                let frame = self.frame([0.0, 0.0, from[2]], UP, [1.0, 0.0, 0.0]);
                let radius = Real(*radius);
                self.data.add(format_args!("CIRCLE('',{frame},{radius})"))
            }
            ShellCurve::Bezier(points) => {
                let order = points.len();
                let poles: Vec<Id> = points.iter().map(|&p| self.point(p)).collect();
                self.data.add(format_args!(
                    "B_SPLINE_CURVE_WITH_KNOTS('',{},{},.UNSPECIFIED.,.F.,.F.,({order},{order}),(0.0,1.0),.BEZIER_KNOTS.)",
                    order - 1,
                    List(&poles)
                ))
            }
        }
    }

    /// Writes a surface; returns also whether its own normal points out of the body.
    fn surface(&mut self, surface: &ShellSurface) -> (Id, bool) {
        match surface {
            ShellSurface::Plane { point, normal } => {
                let reference = if normal[0].abs() < 0.5 {
                    [1.0, 0.0, 0.0]
                } else {
                    [0.0, 1.0, 0.0]
                };
                let frame = self.frame(*point, *normal, reference);
                (self.data.add(format_args!("PLANE('',{frame})")), true)
            }
            ShellSurface::Cylinder { radius } => {
                let frame = self.frame([0.0; 3], UP, [1.0, 0.0, 0.0]);
                let radius = Real(*radius);
                let cylinder = self
                    .data
                    .add(format_args!("CYLINDRICAL_SURFACE('',{frame},{radius})"));
                (cylinder, true)
            }
            ShellSurface::Cone {
                height,
                radius,
                widens,
            } => {
                let axis = if *widens { UP } else { [0.0, 0.0, -1.0] };
                let frame = self.frame([0.0, 0.0, *height], axis, [1.0, 0.0, 0.0]);
                let (radius, half) = (Real(*radius), Real(std::f64::consts::FRAC_PI_4));
                let cone = self
                    .data
                    .add(format_args!("CONICAL_SURFACE('',{frame},{radius},{half})"));
                (cone, true)
            }
            ShellSurface::Ruled { points, outward } => {
                let order = points[0].len();
                let poles: Vec<String> = (0..order)
                    .map(|i| {
                        let pair = [0, 1].map(|k| self.point(points[k][i]));
                        List(&pair).to_string()
                    })
                    .collect();
                let surface = self.data.add(format_args!(
                    "B_SPLINE_SURFACE_WITH_KNOTS('',{},1,{},.UNSPECIFIED.,.F.,.F.,.F.,({order},{order}),(2,2),(0.0,1.0),(0.0,1.0),.BEZIER_KNOTS.)",
                    order - 1,
                    List(&poles)
                ));
                (surface, *outward)
            }
        }
    }
}

/// Direction of the axis.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn logical(truth: bool) -> &'static str {
    if truth { ".T." } else { ".F." }
}
