//! The files of a disc cam.

mod plate;
mod sheet;
mod solid;
mod table;

use crate::{ExportError, Options, Package};
use centrode_formats::drawing::Drawing;
use centrode_formats::dxf::Curves;
use centrode_formats::{Bundle, Format};
use centrode_gear::cam::{Cam, CamError};
use centrode_geometry::Tolerance;
pub(crate) use plate::plate;
use sheet::Contours;
pub use solid::{mesh, solid};
pub use table::columns;

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

impl From<CamError> for ExportError {
    fn from(error: CamError) -> Self {
        Self::missing(error)
    }
}

/// The files of a cam in the requested formats, named after it, not yet on disk.
///
/// # Errors
/// [`ExportError`], for instance for a format of machines or a tolerance so coarse that the contours cross.
pub fn files(cam: &Cam, formats: &[Format], options: &Options) -> Result<Bundle, ExportError> {
    if let Some(format) = formats.iter().find(|format| !FORMATS.contains(format)) {
        return Err(ExportError::NoModel(*format));
    }
    let mut package = Package::new("a cam", cam.name(), cam.title(), formats, options);
    let title = package.design().to_owned();
    add(&mut package, cam, &title, options.tolerance)?;
    package.finish()
}

/// Adds the drawings, the solid and the profile of a cam to the files of a machine, named after the cam.
pub(crate) fn add(
    package: &mut Package<'_>,
    cam: &Cam,
    title: &str,
    tolerance: Tolerance,
) -> Result<(), ExportError> {
    let name = cam.name();
    let contours = |curves| {
        let exact = Contours::new(cam, tolerance)?;
        Ok::<_, CamError>(match curves {
            Curves::Arcs => exact.with_arcs(tolerance),
            Curves::Splines | Curves::Chords => exact,
        })
    };
    package.cutting(name, |curves| Ok(sheet::cam(&contours(curves)?)))?;
    package.drawing(&format!("{name}-assembly"), |curves| {
        Ok(sheet::assembly(cam, &contours(curves)?))
    })?;
    package.solid(name, title, || {
        solid(cam).map_err(ExportError::no_solid("cam"))
    })?;
    package.points(name, name, || columns(cam, ROWS))
}

/// The drawing of a cam, with exact contours.
///
/// # Errors
/// [`CamError::Open`] if the roller's path does not close, because a coordinate is not finite.
pub fn drawing(cam: &Cam, tolerance: Tolerance) -> Result<Drawing, CamError> {
    Ok(sheet::cam(&Contours::new(cam, tolerance)?))
}

#[cfg(test)]
mod tests;
