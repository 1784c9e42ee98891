//! Forces of a machine as arrays by the names of its parts.

use std::sync::Arc;

use centrode_analysis::forces::{Balance, Forces};
use centrode_kinematics::machine::{GuideForce, JointKind, LinkedMachine};
use pyo3::prelude::{Bound, PyAny, PyResult, Python};
use pyo3::types::{PyDict, PyDictMethods};

use crate::array::{Course, Values};
use crate::error::Answer;
use crate::record;
use crate::wait::wait;

/// Forces at all inputs, and the inputs.
struct Found {
    inputs: Values,
    all: Arc<Vec<Forces>>,
    /// Components of a force: 2 in a plane.
    components: usize,
}

impl Found {
    /// A number of each state.
    fn number(&self, of: impl Fn(&Forces) -> f64 + Send + 'static) -> Course {
        let all = Arc::clone(&self.all);
        Course::together(self.inputs.clone(), &[], move |_| {
            Ok(all.iter().map(of).collect())
        })
    }

    /// A force of each state.
    fn force(&self, of: impl Fn(&Forces) -> [f64; 3] + Send + 'static) -> Course {
        let (all, components) = (Arc::clone(&self.all), self.components);
        Course::together(self.inputs.clone(), &[components], move |_| {
            let rows = all.iter().map(of);
            Ok(rows
                .flat_map(|row| row.into_iter().take(components))
                .collect())
        })
    }
}

/// Names of the joints and meshes of a machine, by their numbers.
#[derive(Clone, Copy)]
pub(crate) struct Names {
    joint: fn(&LinkedMachine, usize) -> String,
    mesh: fn(&LinkedMachine, usize) -> String,
}

impl Names {
    /// Joints by their own names, meshes by both links.
    pub(crate) const OF_LINKS: Self = Self {
        joint: |machine, joint| machine.joint_name(joint),
        mesh: |machine, mesh| pair(machine, machine.meshes[mesh].links),
    };

    /// Joints by the bodies that they carry, meshes by those that they move.
    pub(crate) const OF_BODIES: Self = Self {
        joint: carried,
        mesh: |machine, mesh| carried(machine, machine.meshes[mesh].joint),
    };
}

fn carried(machine: &LinkedMachine, joint: usize) -> String {
    machine.links[machine.joints[joint].child].name.clone()
}

fn pair(machine: &LinkedMachine, links: [usize; 2]) -> String {
    let names = links.map(|link| machine.links[link].name.as_str());
    names.join("-")
}

/// The record of the forces at inputs and a speed, rad/s.
pub(crate) fn found(
    py: Python<'_>,
    machine: Arc<LinkedMachine>,
    (inputs, speed): (Values, f64),
    names: Names,
) -> Answer<Bound<'_, PyAny>> {
    let balance = Balance::new(Arc::clone(&machine))?;
    let components = if balance.is_planar() { 2 } else { 3 };
    let given = inputs.clone().into_flat();
    let all = wait(py, move || {
        let all = given.iter().map(|&input| balance.at(input, speed));
        all.collect::<Result<Vec<_>, _>>()
    })??;
    let found = Found {
        inputs,
        all: Arc::new(all),
        components,
    };
    Ok(named(py, &machine, &found, names)?)
}

/// The parts of the record, each by its name.
fn named<'py>(
    py: Python<'py>,
    machine: &LinkedMachine,
    found: &Found,
    names: Names,
) -> PyResult<Bound<'py, PyAny>> {
    let [drives, joints, closures] = [(); 3].map(|()| PyDict::new(py));
    let [meshes, contacts, guides] = [(); 3].map(|()| PyDict::new(py));
    let mut undetermined = Vec::new();
    for (index, about) in machine.joints.iter().enumerate() {
        let name = (names.joint)(machine, index);
        if about.kind != JointKind::Fixed {
            drives.set_item(&name, found.number(move |f| f.joints[index].drive))?;
        }
        // What is determined at one input is at all.
        let mut all = found.all.iter().map(|f| f.joints[index].reaction);
        if all.any(|reaction| reaction.is_none()) {
            undetermined.push(name);
            continue;
        }
        let force = move |f: &Forces| {
            f.joints[index]
                .reaction
                .map_or([0.0; 3], |r| r.force.into())
        };
        joints.set_item(&name, found.force(force))?;
    }
    for (index, closure) in machine.closures.iter().enumerate() {
        let force = found.force(move |forces| forces.closures[index].into());
        closures.set_item(pair(machine, closure.links), force)?;
    }
    for (index, contact) in machine.contacts.iter().enumerate() {
        let force = found.force(move |forces| forces.contacts[index].into());
        contacts.set_item(pair(machine, contact.links), force)?;
    }
    for (index, mesh) in machine.meshes.iter().enumerate() {
        let name = (names.mesh)(machine, index);
        if mesh.pressure_angle.is_none() {
            undetermined.push(name);
            continue;
        }
        let size = move |forces: &Forces| forces.meshes[index].normal.unwrap_or(f64::NAN);
        meshes.set_item(name, found.number(size))?;
    }
    for (index, guide) in machine.guides.iter().enumerate() {
        let part =
            |part: fn(&GuideForce) -> f64| found.number(move |forces| part(&forces.guides[index]));
        let parts = [
            part(|f| f.normal),
            part(|f| f.transverse),
            part(|f| f.torque),
            part(|f| f.push),
        ];
        let name = (names.joint)(machine, guide.joint);
        guides.set_item(name, record::slider_force(py, parts)?)?;
    }
    let input = found.number(|forces| forces.input_torque);
    let whole = [drives, joints, closures, contacts, meshes, guides];
    record::forces(py, input, whole, undetermined)
}
