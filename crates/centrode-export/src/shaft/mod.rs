//! The files of a spiral shaft.

mod arrangement;
mod curves;
mod drawings;
mod figures;
mod gcode;
mod links;
mod machine;
mod sheets;
mod tables;

use crate::{ExportError, Options, Package, gear_pair, turned};
use centrode_formats::{Bundle, Format};
use centrode_geometry::Solid;
use centrode_groove::{MovingBox, ShaftError, SpiralShaft};
use centrode_kinematics::machine::LinkedMachine;
pub use curves::{box_curves, shaft_curves};
pub use drawings::{developed, side_view, slider};
pub use gcode::program;
use machine::Parts;
pub use sheets::{shaft_sheets, slider_sheets};

impl From<ShaftError> for ExportError {
    fn from(error: ShaftError) -> Self {
        Self::missing(error)
    }
}

/// The files of a spiral shaft in the requested formats, not yet on disk.
///
/// DXF and SVG contain the developed groove, the side view and the slider; the sheets show shaft and slider with dimensions; STL,
/// STEP and 3MF contain shaft and slider. CSV contains the lead table, motion and forces, the schedule and the path of the mill,
/// also as a program for a machine with a rotary axis. URDF and MJCF contain the model of shaft, box and slider with the law of
/// motion, and a script that plays it.
///
/// # Errors
/// [`ExportError`], for instance for a tolerance near the groove's depth.
pub fn files(
    shaft: &SpiralShaft,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    all("a spiral shaft", &Parts::of_shaft(shaft), formats, options)
}

/// The files of a moving box in the requested formats: those of its shaft with the motion by the machine's
/// input, and those of its elliptic gears with `gears-` before their names.
///
/// # Errors
/// [`ExportError`], for instance where the gears cannot be cut.
pub fn moving_box_files(
    machine: &MovingBox,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    all("a moving box", &Parts::of_box(machine)?, formats, options)
}

/// Shaft, box and slider as links and joints.
///
/// # Errors
/// [`ExportError`] where body and groove make no solid.
pub fn machine(shaft: &SpiralShaft) -> Result<LinkedMachine, ExportError> {
    links::machine(&Parts::of_shaft(shaft))
}

/// Gears, shaft, box and slider as links and joints.
///
/// # Errors
/// [`ExportError`], for instance where the gears cannot be cut.
pub fn moving_box_machine(machine: &MovingBox) -> Result<LinkedMachine, ExportError> {
    links::machine(&Parts::of_box(machine)?)
}

/// Shaft, box and slider with their motion and their drawn lines, without bodies.
///
/// # Errors
/// [`ExportError`] where body and groove make no solid.
pub fn drawn(shaft: &SpiralShaft) -> Result<LinkedMachine, ExportError> {
    links::drawn(&Parts::of_shaft(shaft))
}

/// Gears, shaft, box and slider with their motion and their drawn lines, without bodies.
///
/// # Errors
/// [`ExportError`] where body and groove make no solid, or the elliptic gears no pair.
pub fn moving_box_drawn(machine: &MovingBox) -> Result<LinkedMachine, ExportError> {
    links::drawn(&Parts::of_box(machine)?)
}

fn slider_solid(shaft: &SpiralShaft) -> Result<Solid, ExportError> {
    let solid = shaft.slider_solid();
    solid.map_err(ExportError::no_solid("slider"))
}

fn all(
    kind: &'static str,
    machine: &Parts<'_>,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let (shaft, tolerance) = (machine.shaft, options.tolerance);
    let mut package = Package::new(kind, machine.name, machine.title, formats, options);
    package.finer_than(shaft.groove().depth(), "groove's depth")?;
    package.drawing("groove", |_| Ok(developed(shaft, tolerance)?))?;
    package.drawing("shaft", |_| Ok(side_view(shaft, tolerance)?))?;
    package.cutting("slider", |_| Ok(slider(shaft)))?;
    // Title blocks and pages show the title of the shaft's own design.
    let design = shaft.design();
    package.within("", &design.name, &design.title, |package| {
        package.sheets("shaft", || shaft_sheets(shaft, options))?;
        package.sheets("slider", || slider_sheets(shaft, options))?;
        turned::add(&[shaft.pin(links::BOX)], package, shaft.drawing())
    })?;
    package.shell("shaft", || Ok(shaft.shell()?))?;
    let title = package.titled("shaft");
    package.mesh("shaft", &title, |tolerance| Ok(shaft.mesh(tolerance)?))?;
    let title = package.titled("slider");
    package.solid("slider", &title, || slider_solid(shaft))?;
    package.points("shaft", "lead-table", || tables::lead(shaft))?;
    package.table("shaft", "schedule", || tables::schedule(&machine.schedule))?;
    package.table("groove", "tool-path", || {
        tables::tool_path(shaft, tolerance)
    })?;
    package.text("groove", "groove.ngc", || program(shaft, tolerance))?;
    if let Some(gears) = &machine.gears {
        let (pair, prefix) = (&gears.pair, links::GEARS);
        package.within(prefix, pair.name(), pair.title(), |gears| {
            gear_pair::fill(gears, pair)
        })?;
    }
    package.machine(|| links::machine(machine))?;
    package.finish()
}

#[cfg(test)]
mod tests;
