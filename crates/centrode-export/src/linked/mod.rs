//! The files of a machine: parts list, general arrangement, table of motion, simulator models, and scripts that play
//! the models.

mod arrangement;
mod bodies;
mod cuts;
mod file;
mod model;
mod motion;
mod motion_file;
mod parts;
mod picture;
mod rim;
mod spatial;
mod still;
mod whole;

use crate::{ExportError, Package};
pub(crate) use arrangement::NAME as ARRANGEMENT;
pub use arrangement::arrangement;
use centrode_formats::{Format, csv, mjcf, step, threemf, urdf};
use centrode_kinematics::machine::LinkedMachine;
pub use file::{MachineFileError, plain, read, schema, write};
pub use motion_file::{
    ClosureWords, ColumnWords, InputWords, Interpolation, JointWords, LinearWords, MeshWords,
    MotionFile, PointWords,
};
pub use parts::parts_list;
pub use picture::picture;
pub use spatial::spatial;

#[cfg(test)]
pub(crate) use {model::simulated, motion::lines};

/// File name of the simulator models, without extension.
const MODEL: &str = "machine";

/// Adds the table of motion with its description, the parts list and, if requested, URDF and MJCF with the STL files they show
/// and scripts that play the motion.
pub(crate) fn add(machine: &LinkedMachine, package: &mut Package<'_>) -> Result<(), ExportError> {
    let tolerance = package.tolerance();
    let no_solid = |source| ExportError::no_solid("link")(source);
    // The table uses the exact laws: laws in pieces give every digit of a position, but fewer digits of its derivatives.
    let pieces = file::in_pieces(machine);
    let lines = motion::lines(&pieces);
    let exact = motion::with_rates(machine.clone(), &lines);
    let machine = motion::with_rates(pieces, &lines);
    let (steps, off) = motion::steps(&machine, tolerance);
    let table = csv::write(&motion::columns(&exact, steps))?;
    package.file(motion::TABLE, table)?;
    let about = motion::description(&machine, &lines, steps, off);
    let mut json = serde_json::to_string_pretty(&about)?;
    json.push('\n');
    package.file("motion.json", json.into_bytes())?;
    if package.wants(&[Format::Csv]) && !exact.parts.is_empty() {
        package.file("parts.csv", csv::write(&parts::columns(&exact))?)?;
    }
    let [urdf, mjcf] = [Format::Urdf, Format::Mjcf].map(|format| package.wants(&[format]));
    if !urdf && !mjcf {
        return Ok(());
    }
    let simulated = model::simulated(&machine, &lines, tolerance).map_err(no_solid)?;
    for (name, mesh) in simulated.meshes {
        package.shown(&name, || Ok(mesh))?;
    }
    if urdf {
        package.file(&format!("{MODEL}.urdf"), urdf::write(&simulated.model)?)?;
        for body in simulated.model.links.iter().flat_map(|l| &l.collision) {
            // Links that are equal have the same bodies.
            let name = urdf::collision_file(&body.name);
            package.shown(&name, || Ok(body.mesh.clone()))?;
        }
        package.file("play_pybullet.py", script(include_str!("play_pybullet.py")))?;
    }
    if mjcf {
        let model = mjcf::write_closed(&simulated.model, &simulated.closures)?;
        package.file(&format!("{MODEL}.xml"), model)?;
        package.file("play_mujoco.py", script(include_str!("play_mujoco.py")))?;
    }
    Ok(())
}

/// Adds the whole assembled machine, one or several bodies per link.
pub(crate) fn add_whole(
    machine: &LinkedMachine,
    package: &mut Package<'_>,
) -> Result<(), ExportError> {
    if package.wants(&[Format::ThreeMf]) {
        let whole = whole::Whole::new(machine, package.tolerance());
        let whole = whole.map_err(ExportError::no_solid("link"))?;
        let objects = whole.objects();
        if !objects.is_empty() {
            let bytes = threemf::write_assembly(&objects, machine.heading())?;
            package.file(&format!("{ARRANGEMENT}.3mf"), bytes)?;
        }
    }
    if package.wants(&[Format::Step]) {
        let components = whole::components(machine);
        if !components.is_empty() {
            let bytes = step::write_assembly(&components, ARRANGEMENT, machine.heading());
            let bytes = bytes.map_err(|source| ExportError::Step {
                part: ARRANGEMENT.into(),
                source,
            })?;
            package.file(&format!("{ARRANGEMENT}.step"), bytes)?;
        }
    }
    Ok(())
}

/// The machine with every column of its table of motion: those of the machine, and a rate for each joint that does not move
/// evenly and has no such column.
#[must_use]
pub fn tabulated(machine: LinkedMachine) -> LinkedMachine {
    let lines = motion::lines(&file::in_pieces(&machine));
    motion::with_rates(machine, &lines)
}

/// The JSON schema of `motion.json`.
#[must_use]
pub fn motion_schema() -> serde_json::Value {
    schemars::schema_for!(MotionFile).to_value()
}

/// Class that reads the table of motion; both scripts contain it.
const LAW: &str = include_str!("law.py");

/// A script with the class instead of its import, so that one file is enough to run it.
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
