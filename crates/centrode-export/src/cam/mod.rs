//! The files of a disc cam.

mod sheet;
mod solid;
mod table;

use crate::{
    Bundle, BundleError,
    csv::{self, TableError},
    drawing::Drawing,
    dxf::{self, DxfError},
    gear_pair::{Format, Options},
    step::{self, StepError},
    stl, svg,
    threemf::{self, PackageError},
};
use centrode_geometry::{SolidError, Tolerance};
use centrode_mechanism::cam::{Cam, CamError};
use sheet::Contours;
pub use solid::{mesh, solid};
pub use table::columns;
use thiserror::Error;

/// The formats a cam can be written as, in the order files are written.
pub const FORMATS: [Format; 6] = [
    Format::Dxf,
    Format::Svg,
    Format::Step,
    Format::Stl,
    Format::ThreeMf,
    Format::Csv,
];

/// Rows of the profile table: every half degree.
pub(crate) const ROWS: u32 = 720;

/// Why a cam's files could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CamFilesError {
    /// A format a part alone cannot be written as.
    #[error("a cam alone is no machine: it cannot be written as {0}")]
    NoModel(Format),
    /// The roller's path could not be drawn.
    #[error(transparent)]
    Cam(#[from] CamError),
    /// The cam is no solid at this tolerance.
    #[error("the cam is no solid: {0}")]
    Solid(#[from] SolidError),
    /// The drawing could not be written.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// The cam cannot be written as STEP.
    #[error("the cam cannot be written as STEP: {0}")]
    Step(#[from] StepError),
    /// A 3MF package could not be made.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// The table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The files do not go together.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

/// The files of a cam in the formats asked for, named after it, not yet on disk.
///
/// # Errors
/// [`CamFilesError`], for instance for a format of machines or a tolerance so coarse that the contours cross.
pub fn files(cam: &Cam, formats: &[Format], options: &Options) -> Result<Bundle, CamFilesError> {
    let (name, tolerance) = (cam.name(), options.tolerance);
    let title = if cam.title().is_empty() {
        name
    } else {
        cam.title()
    };
    let mut bundle = Bundle::default();
    for &format in formats {
        match format {
            Format::Dxf => {
                let exact = Contours::new(cam, tolerance)?;
                let contours = match options.dxf_curves {
                    dxf::Curves::Arcs => exact.with_arcs(tolerance),
                    dxf::Curves::Splines => exact,
                };
                for (name, drawing) in sheets(cam, &contours) {
                    let (version, curves) = (options.dxf_version, options.dxf_curves);
                    let bytes = dxf::write(&drawing, version, curves, tolerance)?;
                    bundle.add(&format!("{name}.dxf"), bytes)?;
                }
            }
            Format::Svg => {
                let contours = Contours::new(cam, tolerance)?.with_arcs(tolerance);
                for (name, drawing) in sheets(cam, &contours) {
                    let picture = svg::write(&drawing, tolerance);
                    bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
                }
            }
            Format::Step => {
                let bytes = step::write(&solid(cam)?, name, title)?;
                bundle.add(&format!("{name}.step"), bytes)?;
            }
            Format::Stl => {
                let bytes = stl::write(&mesh(cam, tolerance)?);
                bundle.add(&format!("{name}.stl"), bytes)?;
            }
            Format::ThreeMf => {
                let bytes = threemf::write(&mesh(cam, tolerance)?, name, title)?;
                bundle.add(&format!("{name}.3mf"), bytes)?;
            }
            Format::Csv => {
                bundle.add(&format!("{name}.csv"), csv::write(&columns(cam, ROWS))?)?;
            }
            other => return Err(CamFilesError::NoModel(other)),
        }
    }
    Ok(bundle)
}

fn sheets(cam: &Cam, contours: &Contours) -> [(String, Drawing); 2] {
    [
        (cam.name().to_owned(), sheet::cam(contours)),
        (
            format!("{}-assembly", cam.name()),
            sheet::assembly(cam, contours),
        ),
    ]
}

/// The drawing of a cam, with exact contours.
///
/// # Errors
/// [`CamError::Open`] where the roller's path is not made of numbers.
pub fn drawing(cam: &Cam, tolerance: Tolerance) -> Result<Drawing, CamError> {
    Ok(sheet::cam(&Contours::new(cam, tolerance)?))
}

/// The drawing of a cam with its follower at the input zero, with exact contours.
///
/// # Errors
/// [`CamError::Open`] where the roller's path is not made of numbers.
pub fn assembly_drawing(cam: &Cam, tolerance: Tolerance) -> Result<Drawing, CamError> {
    Ok(sheet::assembly(cam, &Contours::new(cam, tolerance)?))
}

#[cfg(test)]
mod tests;
