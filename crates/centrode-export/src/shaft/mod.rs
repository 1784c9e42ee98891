//! The files of a spiral shaft.

mod gcode;
mod moving_box;
mod sheet;
mod tables;

use crate::{
    Bundle, BundleError,
    csv::{self, TableError},
    dxf::{self, DxfError},
    gear_pair::{Format, GearPairFilesError, Options},
    step::{self, StepError},
    stl, svg,
    threemf::{self, PackageError},
};
use centrode_geometry::SolidError;
use centrode_mechanism::gear::GearPairError;
use centrode_mechanism::shaft::{ShaftError, SpiralShaft};
pub use gcode::program;
pub use moving_box::moving_box_files;
pub use sheet::{developed, side_view, slider};
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
    /// The slider cannot be written as STEP.
    #[error("the slider cannot be written as STEP: {0}")]
    Step(#[from] StepError),
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

/// The formats a spiral shaft and a moving box can be written as.
pub const FORMATS: [Format; 6] = [
    Format::Dxf,
    Format::Svg,
    Format::Stl,
    Format::Step,
    Format::ThreeMf,
    Format::Csv,
];

/// The files of a spiral shaft in the formats asked for, those of [`FORMATS`] alone, not yet on disk.
///
/// DXF and SVG hold the developed groove, the side view and the slider; STL and 3MF the shaft and the
/// slider; STEP the slider, whose faces are exact; CSV the lead table, motion and forces, the schedule and
/// the way of the mill, with it as a program for a machine with a rotary axis.
///
/// # Errors
/// [`ShaftFilesError`], for instance for a tolerance near the groove's depth.
pub fn files(
    shaft: &SpiralShaft,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ShaftFilesError> {
    let largest = 0.1 * shaft.groove().depth();
    if options.tolerance.mm() > largest {
        return Err(ShaftFilesError::Tolerance {
            tolerance: options.tolerance.mm(),
            largest,
        });
    }
    let mut bundle = Bundle::default();
    draw(shaft, formats, options, &mut bundle)?;
    solids(shaft, formats, options, &mut bundle)?;
    if formats.contains(&Format::Csv) {
        let mut table = |name: &str, columns: &[csv::Column]| -> Result<(), ShaftFilesError> {
            Ok(bundle.add(name, csv::write(columns)?)?)
        };
        table("lead-table.csv", &tables::lead(shaft))?;
        table("motion.csv", &tables::motion(shaft))?;
        table("schedule.csv", &tables::schedule(shaft))?;
        table(
            "tool-path.csv",
            &tables::tool_path(shaft, options.tolerance),
        )?;
        bundle.add("groove.ngc", program(shaft, options.tolerance).into_bytes())?;
    }
    Ok(bundle)
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
    shaft: &SpiralShaft,
    formats: &[Format],
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), ShaftFilesError> {
    let wanted = |format: Format| formats.contains(&format);
    let named = match shaft.title() {
        "" => shaft.name(),
        title => title,
    };
    let block = shaft.slider_solid()?;
    if wanted(Format::Step) {
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
