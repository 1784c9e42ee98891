use super::{FORMATS, ShaftFilesError, files};
use crate::{
    Bundle,
    csv::{self, Column},
    gear_pair::{self, Format, Options},
};
use centrode_mechanism::gear::GearPair;
use centrode_mechanism::shaft::MovingBox;
use std::f64::consts::PI;

/// Step of the motion, rad: half a degree.
const STEP: f64 = PI / 360.0;

/// The files of a moving box in the formats asked for: those of its shaft, those of its elliptic gears with
/// `gears-` before their names, and the box's motion by the machine's input.
///
/// # Errors
/// [`ShaftFilesError`], for instance where the gears cannot be cut.
pub fn moving_box_files(
    machine: &MovingBox,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ShaftFilesError> {
    let mut bundle = files(machine.shaft(), formats, options)?;
    if formats.contains(&Format::Csv) {
        bundle.add("box-motion.csv", csv::write(&motion(machine))?)?;
    }
    let drive = machine.drive();
    let Some(design) = drive.and_then(|drive| machine.design().gear_pair(drive)) else {
        return Ok(bundle);
    };
    let pair = GearPair::resolve(&design).map_err(|e| ShaftFilesError::Gears(Box::new(e)))?;
    let formats: Vec<Format> = FORMATS
        .into_iter()
        .filter(|format| formats.contains(format))
        .collect();
    let gears = gear_pair::files(&pair, &formats, options)
        .map_err(|e| ShaftFilesError::GearFiles(Box::new(e)))?;
    for (name, bytes) in gears.files() {
        bundle.add(&format!("gears-{name}"), bytes.to_vec())?;
    }
    Ok(bundle)
}

/// Shaft and box over the whole cycle at the design's speed of the input.
fn motion(machine: &MovingBox) -> Vec<Column> {
    let load = machine.shaft().load();
    let omega = load.speed();
    let steps = machine.shaft().groove().steps(STEP);
    let over = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { steps.iter().map(|&t| f(t)).collect() };
    let at = |input: f64| machine.motion().at(input);
    let force = |input: f64| machine.force(input, load);
    vec![
        Column::numbers("input_angle_rad", steps.iter().copied()),
        Column::numbers("shaft_angle_rad", over(&|t| machine.shaft_turn(t).position)),
        Column::numbers("time_s", over(&|t| t / omega)),
        Column::numbers("position_mm", over(&|t| at(t).position)),
        Column::numbers("velocity_mm_per_s", over(&|t| omega * at(t).velocity)),
        Column::numbers(
            "acceleration_mm_per_s2",
            over(&|t| omega * omega * at(t).acceleration),
        ),
        Column::numbers("normal_force_N", over(&|t| force(t).normal)),
        Column::numbers("shaft_torque_Nmm", over(&|t| force(t).torque)),
    ]
}
