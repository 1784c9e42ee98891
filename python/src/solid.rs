//! Exact edges of straight extrusions, and links with their bodies, handed over as records.

use centrode::family::FINEST;
use centrode_export::ExportError;
use centrode_formats::Bundle;
use centrode_formats::step::{StepError, contours, poles, write_shell};
use centrode_geometry::{Opening, Segment, Solid, Tolerance};
use centrode_kinematics::machine::{Form, Joint, JointKind, LinkedMachine, Mounted, Shape};
use pyo3::prelude::{Bound, PyAny, PyDictMethods, PyResult, Python};
use pyo3::types::{PyBytes, PyDict, PyTuple};

use crate::array::{Rows, mesh};
use crate::error::{Answer, Raised};
use crate::record::{record, tuple};

/// An extrusion with its sides.
pub(crate) struct Sides {
    solid: Solid,
    contours: Vec<Vec<Segment>>,
}

impl Sides {
    /// Sides of an extrusion, those shorter than the tolerance closed up.
    pub(crate) fn new(part: &str, solid: Solid, shortest: Tolerance) -> Answer<Self> {
        let found = contours(&solid, shortest);
        let exact = || Tolerance::new(FINEST).is_ok_and(|finest| contours(&solid, finest).is_ok());
        if found.is_err() && exact() {
            let sentence = format!(
                "with a tolerance of {:e} mm, {part} has no sides left: use a smaller tolerance",
                shortest.mm()
            );
            return Err(Raised::sentence("tolerance", sentence));
        }
        let contours = found.map_err(|source: StepError| ExportError::Step {
            part: part.to_owned(),
            source,
        })?;
        Ok(Self { solid, contours })
    }

    /// The record of them.
    pub(crate) fn record<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let solid = &self.solid;
        let contour = |sides: &Vec<Segment>| -> PyResult<Bound<'py, PyAny>> {
            Ok(tuple(py, sides.iter().map(|side| edge(py, side)))?.into_any())
        };
        let opening = solid.opening().map(|opening| opened(py, opening));
        record!(py, "centrode._solid" "Solid", () => []
            contours: tuple(py, self.contours.iter().map(contour))?,
            bottom: solid.bottom(),
            top: solid.top(),
            opening: opening.transpose()?,
            volume: solid.volume(),
        )
    }
}

fn opened<'py>(py: Python<'py>, opening: &Opening) -> PyResult<Bound<'py, PyAny>> {
    let ([a, b], [c, d]) = (opening.outer, opening.inner);
    record!(py, "centrode._solid" "Opening", () => []
        corners: Rows::new(&[a, b, d, c]),
        span: (opening.span[0], opening.span[1]),
    )
}

fn edge<'py>(py: Python<'py>, side: &Segment) -> PyResult<Bound<'py, PyAny>> {
    let ends = [side.start(), side.end()];
    let (kind, points, arc) = match side {
        Segment::Line(..) => ("line", ends.to_vec(), None),
        Segment::Poly(poly) => ("spline", poles(poly), None),
        Segment::Arc(arc) => ("arc", ends.to_vec(), Some(arc)),
    };
    record!(py, "centrode._solid" "Edge", () => []
        kind: kind,
        points: Rows::new(&points),
        center: arc.map(|arc| (arc.center().x, arc.center().y)),
        sweep: arc.map_or(0.0, |arc| arc.sweep()),
    )
}

/// Extrusions of a bundle, by name.
pub(crate) fn solids<'py>(
    py: Python<'py>,
    bundle: Bundle,
    shortest: Tolerance,
) -> Answer<Bound<'py, PyDict>> {
    let named = PyDict::new(py);
    for (name, solid) in bundle.into_solids() {
        let sides = Sides::new(&name, solid, shortest)?;
        named.set_item(name, sides.record(py)?)?;
    }
    Ok(named)
}

/// Links of a machine, those that carry others before these, with their bodies unless there is no shortest side.
pub(crate) fn links<'py>(
    py: Python<'py>,
    machine: &LinkedMachine,
    shortest: Option<Tolerance>,
) -> Answer<Bound<'py, PyTuple>> {
    let mut found = Vec::with_capacity(machine.links.len());
    for (index, joint) in in_order(machine) {
        found.push(link(py, machine, (index, joint), shortest)?);
    }
    Ok(PyTuple::new(py, found)?)
}

/// Indices of links with those of the joints that carry them, parents first.
fn in_order(machine: &LinkedMachine) -> Vec<(usize, Option<usize>)> {
    let carried = |link: usize| machine.joints.iter().position(|j| j.child == link);
    let mut order: Vec<(usize, Option<usize>)> = Vec::new();
    let mut open: Vec<usize> = (0..machine.links.len()).collect();
    loop {
        let before = order.len();
        open.retain(|&link| {
            let joint = carried(link);
            let parent = joint.map(|joint| machine.joints[joint].parent);
            let ready = parent.is_none_or(|parent| order.iter().any(|&(known, _)| known == parent));
            if ready {
                order.push((link, joint));
            }
            !ready
        });
        if order.len() == before {
            return order;
        }
    }
}

fn link<'py>(
    py: Python<'py>,
    machine: &LinkedMachine,
    (index, joint): (usize, Option<usize>),
    shortest: Option<Tolerance>,
) -> Answer<Bound<'py, PyAny>> {
    let link = &machine.links[index];
    let shape = link.shape.and_then(|shape| machine.shapes.get(shape));
    let mut solids = Vec::new();
    let mut triangles = None;
    match shortest.zip(shape.map(|shape| &shape.form)) {
        Some((shortest, Form::Solids(all))) => {
            for solid in all {
                let sides = Sides::new(&link.name, solid.clone(), shortest)?;
                solids.push(sides.record(py)?);
            }
        }
        Some((_, Form::Mesh(made, _))) => triangles = Some(mesh(made.clone())),
        Some((_, Form::Turned(_) | Form::Body(_))) | None => {}
    }
    let carrying = joint.map(|joint| joined(py, machine, joint)).transpose()?;
    let mut upon = Vec::new();
    for body in shortest.iter().flat_map(|_| &link.mounted) {
        let shape = machine.shapes.get(body.shape);
        upon.extend(
            shape
                .zip(shortest)
                .map(|(shape, shortest)| mounted(py, body, shape, shortest))
                .transpose()?,
        );
    }
    let made = record!(py, "centrode._link" "Link", () => []
        name: &link.name,
        joint: carrying,
        part: shape.map_or("", |shape| &shape.part),
        solids: PyTuple::new(py, solids)?,
        mesh: triangles,
        mounted: PyTuple::new(py, upon)?,
    );
    Ok(made?)
}

/// A shaft or pin as its STEP file, a ring or key as its extrusion, with its position.
fn mounted<'py>(
    py: Python<'py>,
    body: &Mounted,
    shape: &Shape,
    shortest: Tolerance,
) -> Answer<Bound<'py, PyAny>> {
    let name = shape.short_name();
    let mut solids = Vec::new();
    let mut step = None;
    match &shape.form {
        Form::Solids(all) => {
            for solid in all {
                solids.push(Sides::new(name, solid.clone(), shortest)?.record(py)?);
            }
        }
        Form::Turned(part) => {
            let solid = part.solid().map_err(|source| ExportError::Solid {
                part: name.to_owned(),
                source,
            })?;
            let written = write_shell(&solid.shell(), name, name);
            let written = written.map_err(|source| ExportError::Step {
                part: name.to_owned(),
                source,
            })?;
            step = Some(PyBytes::new(py, &written));
        }
        Form::Mesh(..) | Form::Body(_) => {}
    }
    let frame = body.place().to_homogeneous();
    let rows = [0, 1, 2, 3].map(|i| [0, 1, 2, 3].map(|j| frame[(i, j)]));
    let made = record!(py, "centrode._link" "Mounted", () => []
        name: name,
        frame: Rows(rows.into()),
        solids: PyTuple::new(py, solids)?,
        step: step,
    );
    Ok(made?)
}

fn joined<'py>(
    py: Python<'py>,
    machine: &LinkedMachine,
    index: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let joint: &Joint = &machine.joints[index];
    let (kind, range) = match joint.kind {
        JointKind::Fixed => ("fixed", None),
        JointKind::Turning => ("turning", None),
        JointKind::Sliding(range) => ("sliding", Some((range[0], range[1]))),
    };
    let [origin, turn, axis] = [joint.origin, joint.turn, joint.axis];
    record!(py, "centrode._link" "Joint", () => []
        name: machine.joint_name(index),
        kind: kind,
        parent: &machine.links[joint.parent].name,
        origin: (origin[0], origin[1], origin[2]),
        turn: (turn[0], turn[1], turn[2]),
        axis: (axis[0], axis[1], axis[2]),
        range: range,
    )
}
