//! The files of a machine: its table of motion, simulator models, and scripts that play them.

mod bodies;
mod file;
mod model;
mod motion;

use centrode_geometry::{SolidError, Tolerance};
use centrode_mechanism::machine::Machine;
#[cfg(test)]
pub(crate) use model::simulated;
use thiserror::Error;

use crate::csv::{self, TableError};
use crate::mjcf::{self, MjcfError};
use crate::urdf::{self, UrdfError};
use crate::{Bundle, BundleError, stl};
pub use file::{MachineFileError, plain, read, schema, write};
pub use motion::{
    ClosureWords, ColumnWords, InputWords, Interpolation, JointWords, LinearWords, MeshWords,
    MotionFile, PointWords,
};

/// Name of the simulator models, without its end.
const MODEL: &str = "machine";

/// Why a machine's files could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum MachineFilesError {
    /// A link is no solid.
    #[error("a link is no solid: {0}")]
    Solid(#[from] SolidError),
    /// The table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The URDF could not be written.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// The MJCF could not be written.
    #[error(transparent)]
    Mjcf(#[from] MjcfError),
    /// The description of the table could not be written.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// The files do not go together.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

/// Adds the table of motion with its description and, as asked for, URDF and MJCF with the STL files they show and scripts
/// that play them.
///
/// # Errors
/// [`MachineFilesError`], for instance where a tolerance leaves no solid.
pub fn add(
    machine: &Machine,
    [urdf, mjcf]: [bool; 2],
    tolerance: Tolerance,
    bundle: &mut Bundle,
) -> Result<(), MachineFilesError> {
    let machine = motion::with_rates(&plain(machine, tolerance)?);
    let (steps, off) = motion::steps(&machine, tolerance);
    bundle.add(
        motion::TABLE,
        csv::write(&motion::columns(&machine, steps))?,
    )?;
    let about = motion::description(&machine, steps, off);
    let mut json = serde_json::to_string_pretty(&about)?;
    json.push('\n');
    bundle.add("motion.json", json.into_bytes())?;
    if !urdf && !mjcf {
        return Ok(());
    }
    let simulated = model::simulated(&machine, tolerance)?;
    for (name, mesh) in &simulated.meshes {
        // A part's own may be there already.
        if !bundle.files().any(|(known, _)| known == name) {
            bundle.add(name, stl::write(mesh))?;
        }
    }
    if urdf {
        bundle.add(&format!("{MODEL}.urdf"), urdf::write(&simulated.model)?)?;
        for body in simulated.model.links.iter().flat_map(|l| &l.collision) {
            let name = urdf::collision_file(&body.name);
            // Links that are alike have the same bodies.
            if !bundle.files().any(|(known, _)| known == name) {
                bundle.add(&name, stl::write(&body.mesh))?;
            }
        }
        bundle.add("play_pybullet.py", script(include_str!("play_pybullet.py")))?;
    }
    if mjcf {
        let model = mjcf::write_closed(&simulated.model, &simulated.closures)?;
        bundle.add(&format!("{MODEL}.xml"), model)?;
        bundle.add("play_mujoco.py", script(include_str!("play_mujoco.py")))?;
    }
    Ok(())
}

/// The JSON schema of `motion.json`.
#[must_use]
pub fn motion_schema() -> serde_json::Value {
    schemars::schema_for!(MotionFile).to_value()
}

/// Reads the table of motion; both scripts hold it.
const LAW: &str = include_str!("law.py");

/// A script with the class in the place of its import, so that one file is enough to run it.
fn script(script: &str) -> Vec<u8> {
    const IMPORT: &str = "# isort: split\nfrom law import Law\n";
    let class = LAW.find("class ").map_or("", |at| &LAW[at..]);
    script.replace(IMPORT, &format!("\n{class}\n")).into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_need_no_other_file() {
        for name in [
            include_str!("play_mujoco.py"),
            include_str!("play_pybullet.py"),
        ] {
            let script = String::from_utf8(script(name)).expect("text");
            assert_eq!(script.matches("class Law:").count(), 1);
            assert!(!script.contains("from law") && script.contains("def __call__"));
        }
    }
}
