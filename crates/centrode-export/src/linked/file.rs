use std::sync::Arc;

use centrode_geometry::{SolidError, Tolerance};
use centrode_kinematics::machine::{Form, LinkedMachine, LinkedMachineError, Load, Quantity, Seat};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::model::meshed;

/// Mark of the plain file.
const FORMAT: &str = "centrode-machine";
/// Version of the plain file that is written and read.
const VERSION: u32 = 1;

/// A machine as a plain file: everything resolved, laws in pieces, lengths in mm, angles in rad.
#[derive(Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
struct MachineFile {
    /// `centrode-machine`.
    format: String,
    /// Version of this description: 1.
    version: u32,
    /// The machine.
    machine: LinkedMachine,
}

/// Why a plain file of a machine cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MachineFileError {
    /// The file is no JSON, or does not have this structure.
    #[error("not the plain file of a machine: {0}")]
    Shape(#[from] serde_json::Error),
    /// The file has another format or version.
    #[error("a file of format {format:?} and version {version}, not {FORMAT:?} and {VERSION}")]
    Other {
        /// Its format.
        format: String,
        /// Its version.
        version: u32,
    },
    /// The machine is not connected.
    #[error(transparent)]
    LinkedMachine(#[from] LinkedMachineError),
}

/// The machine in plain numbers: laws in pieces, equal within rounding. Bodies that are neither extruded nor turned become meshes
/// that simulators accept, within the tolerance if their limit of triangles permits it.
///
/// # Errors
/// [`SolidError`] where a tolerance leaves no solid.
pub fn plain(machine: &LinkedMachine, tolerance: Tolerance) -> Result<LinkedMachine, SolidError> {
    let mut plain = in_pieces(machine);
    for shape in &mut plain.shapes {
        if let Form::Body(_) = shape.form {
            let (mesh, off) = meshed(&shape.form, tolerance)?;
            shape.form = Form::Mesh(mesh, off);
        }
    }
    Ok(plain)
}

/// The machine with its laws in pieces.
pub(super) fn in_pieces(machine: &LinkedMachine) -> LinkedMachine {
    let mut plain = machine.clone();
    for joint in &mut plain.joints {
        joint.law = Arc::new(joint.law.pieces());
    }
    let pitches = plain.meshes.iter_mut().flat_map(|mesh| &mut mesh.pitch);
    for pitch in pitches {
        pitch.driven = Arc::new(pitch.driven.pieces());
    }
    let columns = plain.columns.iter_mut().map(|column| &mut column.quantity);
    let own = plain
        .figures
        .iter_mut()
        .flat_map(|figure| match &mut figure.seat {
            Seat::Free(by) => by.iter_mut(),
            Seat::Link(_) => [].iter_mut(),
        });
    let loads = plain.loads.iter_mut().flat_map(Load::sizes_mut);
    for quantity in columns.chain(own).chain(loads) {
        if let Quantity::Law(law) = quantity {
            *law = Arc::new(law.pieces());
        }
    }
    plain
}

/// A machine in plain numbers as JSON; reads back as the same machine.
///
/// # Errors
/// [`serde_json::Error`] for a machine that is not in [`plain`] numbers.
pub fn write(machine: &LinkedMachine) -> serde_json::Result<Vec<u8>> {
    let mut bytes = serde_json::to_vec(&MachineFile {
        format: FORMAT.into(),
        version: VERSION,
        machine: machine.clone(),
    })?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Reads the plain file of a machine.
///
/// # Errors
/// [`MachineFileError`] if the file has another format or version, or the machine is not connected.
pub fn read(bytes: &[u8]) -> Result<LinkedMachine, MachineFileError> {
    let MachineFile {
        format,
        version,
        machine,
    } = serde_json::from_slice(bytes)?;
    if format != FORMAT || version != VERSION {
        return Err(MachineFileError::Other { format, version });
    }
    machine.validate()?;
    Ok(machine)
}

/// The JSON schema of the plain file of a machine.
#[must_use]
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(MachineFile).to_value()
}
