//! The files of a gear pair.

mod accuracy;
mod arrangement;
mod contacts;
mod curves;
mod drawn;
mod links;
mod outline;
mod pins;
mod sheet;
mod sheets;
mod solid;

use crate::plate::{Hole, Plate};
use crate::{ExportError, Options, Package};
pub(crate) use accuracy::{flank_tolerances, tooth_runout};
pub use arrangement::contact_data;
pub(crate) use arrangement::{by_thickness, half_backlash, list, list_keys, list_pair, of_both};
use centrode_formats::sheet::number;
use centrode_formats::{Bundle, Format};
use centrode_gear::design::BodySpec;
use centrode_gear::{GearPair, GearPairError, Member};
pub use contacts::contacts;
pub(crate) use contacts::{Flanks, PITCH_SAMPLES, ROUNDING, paths, track};
pub use curves::curves;
use drawn::Drawn;
pub use links::{drawn, machine};
pub(crate) use links::{embody, lines, lines_within};
pub(crate) use sheets::{Label, measured, over_pins};
pub use sheets::{Subject, sheets};
pub use solid::{mesh, solid};

impl From<GearPairError> for ExportError {
    fn from(error: GearPairError) -> Self {
        Self::missing(error)
    }
}

/// The files of a pair in the requested formats, not yet on disk. URDF and MJCF come with the STL files they name (URDF also with
/// a folder of collision meshes), the law of motion and a script that plays it.
///
/// # Errors
/// [`ExportError`], for instance if the tolerance is too coarse for the bore to clear the teeth.
pub fn files(
    pair: &GearPair,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let mut package = package(pair, formats, options);
    fill(&mut package, pair)?;
    package.finish()
}

/// The files of one gear, or of both assembled, in the requested formats and at any tolerance: drawing and sheets, and for one
/// gear also its solid and tables.
///
/// # Errors
/// [`ExportError`] where the gear is no solid, or the requested sheet size is too small.
pub fn subject_files(
    pair: &GearPair,
    subject: Subject,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, ExportError> {
    let mut package = package(pair, formats, options);
    let drawn = Drawn::new(pair, options.tolerance);
    add(&mut package, &drawn, subject, None)?;
    if subject == Subject::Assembly {
        package.arrangement(&links::drawn(pair))?;
    }
    package.finish()
}

fn package<'a>(pair: &'a GearPair, formats: &[Format], options: &'a Options) -> Package<'a> {
    let package = Package::new("a gear pair", pair.name(), pair.title(), formats, options);
    package.kerf(pair.design().cut.kerf)
}

/// Offers all files of a pair.
pub(crate) fn fill(package: &mut Package<'_>, pair: &GearPair) -> Result<(), ExportError> {
    let tolerance = package.tolerance();
    package.finer_than(pair.module(), "module")?;
    let drawn = Drawn::new(pair, tolerance);
    for subject in Subject::ALL {
        add(package, &drawn, subject, None)?;
    }
    add_housing(package, pair)?;
    package.machine(|| machine(pair))
}

/// Offers the housing of a flow meter or pump, if the design has one.
fn add_housing(package: &mut Package<'_>, pair: &GearPair) -> Result<(), ExportError> {
    let Some(housing) = pair.housing() else {
        return Ok(());
    };
    let body = BodySpec {
        width: housing.thickness,
        ..BodySpec::default()
    };
    let mut plate = Plate::of_body("housing", "Housing", housing.outline, None, &body);
    plate.holes.push(Hole::from(housing.chamber));
    plate.notes.push(format!(
        "The chamber is {} mm from the tips of both gears; ports, covers and bearings are the customer's.",
        number(pair.design().housing.gap.unwrap_or(0.0), 3)
    ));
    plate.add(package, pair.drawing())
}

/// Offers one gear as a part of a larger machine, under its label.
pub(crate) fn add_gear(
    package: &mut Package<'_>,
    pair: &GearPair,
    member: Member,
    label: Label<'_>,
) -> Result<(), ExportError> {
    let drawn = Drawn::new(pair, package.tolerance());
    add(package, &drawn, member.into(), Some(label))
}

fn add(
    package: &mut Package<'_>,
    drawn: &Drawn<'_>,
    subject: Subject,
    label: Option<Label<'_>>,
) -> Result<(), ExportError> {
    let (pair, tolerance, sheet) = (
        drawn.pair,
        package.tolerance(),
        package.options().sheet.clone(),
    );
    package.coarser_than(pair.center_distance(), "centre distance")?;
    let name = label.map_or(subject.name(), |label| label.name);
    let Some(member) = subject.member() else {
        return package.drawing(name, |curves| Ok(drawn.assembly(curves)));
    };
    package.cutting(name, |curves| {
        Ok(sheet::gear(drawn.contours(member, curves)))
    })?;
    let file = package.name_of(name);
    package.sheets(name, || {
        sheets::labelled(pair, subject, label, &file, &sheet, tolerance)
    })?;
    let title = match label {
        None => package.titled(&format!("{name} gear")),
        Some(_) => package.titled(name),
    };
    package.solid(name, &title, || solid(pair, member))?;
    package.points(name, name, || {
        outline::columns(pair.gear(member), tolerance)
    })?;
    let limits = pair.pin_limits(member);
    package.table(name, &format!("{name}-pins"), || {
        pins::columns(pair, member, limits.as_ref())
    })
}

#[cfg(test)]
mod tests;
