//! The files of a spiral shaft.

mod drawings;
mod gcode;
mod links;
mod machine;
mod picture;
mod sheets;
mod tables;

use crate::{
    Bundle, BundleError,
    csv::{self, TableError},
    dxf::{self, DxfError},
    gear_pair::{self, Format, GearPairFilesError, Options},
    machine::MachineFilesError,
    pdf::PdfError,
    sheet::SheetError,
    step::{self, StepError},
    stl, svg,
    threemf::{self, PackageError},
};
use centrode_geometry::SolidError;
use centrode_mechanism::gear::GearPairError;
use centrode_mechanism::shaft::{MovingBox, ShaftError, SpiralShaft};
pub use drawings::{developed, side_view, slider};
pub use gcode::program;
use machine::Machine;
pub use picture::{box_curves, box_picture, shaft_curves, shaft_picture};
pub use sheets::{shaft_sheets, slider_sheets};
use thiserror::Error;

/// Why a spiral shaft's files could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ShaftFilesError {
    /// The tolerance is so coarse that no groove would be left.
    #[error(
        "a tolerance of {tolerance} mm is too coarse: at most a tenth of the groove's depth, {largest:.4} mm"
    )]
    Tolerance {
        /// The tolerance, mm.
        tolerance: f64,
        /// The coarsest one possible, mm.
        largest: f64,
    },
    /// Body and groove make no solid.
    #[error(transparent)]
    Shaft(#[from] ShaftError),
    /// The slider is no solid.
    #[error("the slider is no solid: {0}")]
    Solid(#[from] SolidError),
    /// A drawing could not be written.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// Shaft or slider cannot be written as STEP.
    #[error("cannot be written as STEP: {0}")]
    Step(#[from] StepError),
    /// The drawing sheets cannot be laid out.
    #[error(transparent)]
    Sheet(#[from] SheetError),
    /// The drawing sheets could not be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// Its motion or a simulator model could not be written.
    #[error(transparent)]
    Machine(#[from] MachineFilesError),
    /// A 3MF package could not be made.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The elliptic gears do not exist.
    #[error(transparent)]
    Gears(Box<GearPairError>),
    /// The files of the elliptic gears could not be made.
    #[error(transparent)]
    GearFiles(Box<GearPairFilesError>),
    /// The files do not go together.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

/// The files of a spiral shaft in the formats asked for, not yet on disk.
///
/// DXF and SVG hold the developed groove, the side view and the slider; the sheets shaft and slider with
/// dimensions; STL, STEP and 3MF shaft and slider; CSV the lead table, motion and forces, the schedule and the
/// way of the mill, with it as a program for a machine with a rotary axis; URDF and MJCF the model of shaft,
/// box and slider with the law of motion, and a script that plays it.
///
/// # Errors
/// [`ShaftFilesError`], for instance for a tolerance near the groove's depth.
pub fn files(
    shaft: &SpiralShaft,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ShaftFilesError> {
    all(&Machine::of_shaft(shaft), formats, options)
}

/// The files of a moving box in the formats asked for: those of its shaft with the motion by the machine's
/// input, and those of its elliptic gears with `gears-` before their names.
///
/// # Errors
/// [`ShaftFilesError`], for instance where the gears cannot be cut.
pub fn moving_box_files(
    machine: &MovingBox,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ShaftFilesError> {
    all(&Machine::of_box(machine)?, formats, options)
}

fn all(
    machine: &Machine<'_>,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ShaftFilesError> {
    let shaft = machine.shaft;
    let largest = 0.1 * shaft.groove().depth();
    if options.tolerance.mm() > largest {
        return Err(ShaftFilesError::Tolerance {
            tolerance: options.tolerance.mm(),
            largest,
        });
    }
    let wanted = |format: Format| formats.contains(&format);
    let mut bundle = Bundle::default();
    draw(shaft, formats, options, &mut bundle)?;
    sheets::add(shaft, formats, options, &mut bundle)?;
    solids(machine, formats, options, &mut bundle)?;
    if wanted(Format::Csv) {
        let mut table = |name: &str, columns: &[csv::Column]| -> Result<(), ShaftFilesError> {
            Ok(bundle.add(name, csv::write(columns)?)?)
        };
        table("lead-table.csv", &tables::lead(shaft))?;
        table("schedule.csv", &tables::schedule(&machine.schedule))?;
        table(
            "tool-path.csv",
            &tables::tool_path(shaft, options.tolerance),
        )?;
        bundle.add("groove.ngc", program(shaft, options.tolerance).into_bytes())?;
    }
    gears(machine, formats, options, &mut bundle)?;
    let models = [Format::Urdf, Format::Mjcf].map(wanted);
    if wanted(Format::Csv) || models.contains(&true) {
        let machine = links::machine(machine)?;
        crate::machine::add(&machine, models, options.tolerance, &mut bundle)?;
    }
    Ok(bundle)
}

/// Adds the files of the elliptic gears, if there are any.
fn gears(
    machine: &Machine<'_>,
    formats: &[Format],
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), ShaftFilesError> {
    let Some(gears) = &machine.gears else {
        return Ok(());
    };
    let models = [Format::Urdf, Format::Mjcf];
    let mut parts: Vec<Format> = formats.to_vec();
    parts.retain(|format| !models.contains(format));
    let failed = |e| ShaftFilesError::GearFiles(Box::new(e));
    let files = gear_pair::files(&gears.pair, &parts, options).map_err(failed)?;
    for (name, bytes) in files.files() {
        bundle.add(&format!("{}{name}", links::GEARS), bytes.to_vec())?;
    }
    Ok(())
}

fn draw(
    shaft: &SpiralShaft,
    formats: &[Format],
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), ShaftFilesError> {
    let wanted = |format: Format| formats.contains(&format);
    if !wanted(Format::Dxf) && !wanted(Format::Svg) {
        return Ok(());
    }
    let tolerance = options.tolerance;
    let sheets = [
        ("groove", developed(shaft, tolerance)?),
        ("shaft", side_view(shaft, tolerance)?),
        ("slider", slider(shaft)),
    ];
    for (name, drawing) in &sheets {
        if wanted(Format::Dxf) {
            let (version, curves) = (options.dxf_version, options.dxf_curves);
            let file = dxf::write(drawing, version, curves, tolerance)?;
            bundle.add(&format!("{name}.dxf"), file)?;
        }
        if wanted(Format::Svg) {
            let picture = svg::write(drawing, tolerance);
            bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
        }
    }
    Ok(())
}

fn solids(
    machine: &Machine<'_>,
    formats: &[Format],
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), ShaftFilesError> {
    let wanted = |format: Format| formats.contains(&format);
    let (shaft, named) = (machine.shaft, machine.named());
    let block = shaft.slider_solid()?;
    if wanted(Format::Step) {
        let file = step::write_shell(&shaft.shell()?, "shaft", &format!("{named}: shaft"))?;
        bundle.add("shaft.step", file)?;
        let file = step::write(&block, "slider", &format!("{named}: slider"))?;
        bundle.add("slider.step", file)?;
    }
    if !wanted(Format::Stl) && !wanted(Format::ThreeMf) {
        return Ok(());
    }
    let meshes = [
        ("shaft", shaft.mesh(options.tolerance)?),
        ("slider", block.mesh(options.tolerance)?),
    ];
    for (name, mesh) in &meshes {
        if wanted(Format::Stl) {
            bundle.add(&format!("{name}.stl"), stl::write(mesh))?;
        }
        if wanted(Format::ThreeMf) {
            let file = threemf::write(mesh, name, &format!("{named}: {name}"))?;
            bundle.add(&format!("{name}.3mf"), file)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
