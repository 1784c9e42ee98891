//! The files of a feeder: its links as plates, a simulator model, its motion.

mod gears;
mod links;
mod picture;
mod plates;
mod sheets;

use crate::{
    Bundle, BundleError,
    csv::TableError,
    drawing::Drawing,
    dxf::{self, DxfError},
    gear_pair::{Format, Options},
    machine::MachineFilesError,
    pdf::{self, PdfError},
    sheet::SheetError,
    step::{self, StepError},
    stl, svg,
    threemf::{self, PackageError},
};
use centrode_geometry::{Solid, SolidError};
use centrode_mechanism::feeder::{Feeder, FeederError, Part, Plate};
pub use picture::{Teeth, curves, picture};
pub use plates::{assembly, plate};
pub use sheets::sheets;
use thiserror::Error;

/// Why a feeder's files could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FeederFilesError {
    /// A link cannot be cut from plate.
    #[error(transparent)]
    Feeder(#[from] FeederError),
    /// A plate is no solid.
    #[error("the {part} is no solid: {source}")]
    Solid {
        /// Which part.
        part: &'static str,
        /// Why.
        source: SolidError,
    },
    /// A drawing could not be written.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// The drawing sheets cannot be laid out.
    #[error("{subject} drawing: {source}")]
    Sheet {
        /// What the sheets are of.
        subject: &'static str,
        /// Why.
        source: SheetError,
    },
    /// The drawing sheets could not be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// A plate cannot be written as STEP.
    #[error("a plate cannot be written as STEP: {0}")]
    Step(#[from] StepError),
    /// A 3MF package could not be made.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Its motion or a simulator model could not be written.
    #[error(transparent)]
    Machine(#[from] MachineFilesError),
    /// The files do not go together.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

/// The files of a feeder in the formats asked for, not yet on disk.
///
/// Each link is a plate with holes for pins, the effector's with a slot, named after it; `assembly` is the six-bar
/// where it rests. Drawings and solids hold the incomplete gears, too: `gear-driver`, `gear-driven`, the cams
/// `gear-entry-cam` and `gear-exit-cam`, and `gears` in place. MJCF closes the loops of the linkage by equality constraints; URDF, which has no loops, leaves
/// them open and says so. Both bring the solids they show, in a folder `links`, and the motion of every joint.
///
/// # Errors
/// [`FeederFilesError`], for instance for an effector whose slot runs into its pivot.
pub fn files(
    feeder: &Feeder,
    formats: &[Format],
    options: &Options,
) -> Result<Bundle, FeederFilesError> {
    let wanted = |format: Format| formats.contains(&format);
    let plates: Vec<Plate> = Part::ALL
        .into_iter()
        .map(|part| feeder.plate(part))
        .collect::<Result<_, _>>()?;
    let mut bundle = Bundle::default();
    draw(feeder, &plates, &wanted, options, &mut bundle)?;
    if wanted(Format::Sheet) || wanted(Format::Pdf) {
        sheet_files(feeder, &plates, &wanted, options, &mut bundle)?;
    }
    solids(feeder, &plates, &wanted, options, &mut bundle)?;
    gear_files(feeder, &wanted, options, &mut bundle)?;
    let models = [Format::Urdf, Format::Mjcf].map(wanted);
    if wanted(Format::Csv) || models.contains(&true) {
        let machine = links::machine(feeder, &plates)?;
        crate::machine::add(&machine, models, options.tolerance, &mut bundle)?;
    }
    Ok(bundle)
}

fn draw(
    feeder: &Feeder,
    plates: &[Plate],
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), FeederFilesError> {
    if !wanted(Format::Dxf) && !wanted(Format::Svg) {
        return Ok(());
    }
    let mut drawings: Vec<_> = plates.iter().map(|p| (p.part.name(), plate(p))).collect();
    drawings.push(("assembly", assembly(feeder, plates)));
    for (name, drawing) in &drawings {
        draw_one(name, drawing, wanted, options, bundle)?;
    }
    Ok(())
}

fn draw_one(
    name: &str,
    drawing: &Drawing,
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), FeederFilesError> {
    if wanted(Format::Dxf) {
        let (version, curves) = (options.dxf_version, options.dxf_curves);
        let file = dxf::write(drawing, version, curves, options.tolerance)?;
        bundle.add(&format!("{name}.dxf"), file)?;
    }
    if wanted(Format::Svg) {
        let picture = svg::write(drawing, options.tolerance);
        bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
    }
    Ok(())
}

fn sheet_files(
    feeder: &Feeder,
    plates: &[Plate],
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), FeederFilesError> {
    for (name, sheets) in sheets(feeder, plates, &options.sheet)? {
        if wanted(Format::Sheet) {
            for (index, sheet) in sheets.iter().enumerate() {
                let page = match sheets.len() {
                    1 => format!("{name}-sheet"),
                    _ => format!("{name}-sheet-{}", index + 1),
                };
                let (version, curves) = (options.dxf_version, dxf::Curves::Arcs);
                let file = dxf::write(&sheet.drawing, version, curves, options.tolerance)?;
                bundle.add(&format!("{page}.dxf"), file)?;
                let picture = svg::sheet(sheet, options.tolerance);
                bundle.add(&format!("{page}.svg"), picture.into_bytes())?;
            }
        }
        if wanted(Format::Pdf) {
            let title = format!("{}: {name}", named(feeder));
            let file = pdf::write(&sheets, &title, options.tolerance)?;
            bundle.add(&format!("{name}.pdf"), file)?;
        }
    }
    Ok(())
}

fn solids(
    feeder: &Feeder,
    plates: &[Plate],
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), FeederFilesError> {
    for plate in plates {
        let part = plate.part.name();
        let no_solid = |source| FeederFilesError::Solid { part, source };
        let solid = plate.solid().map_err(no_solid)?;
        let title = format!("{}: {part}", named(feeder));
        solid_files(part, &title, &solid, wanted, options, bundle)?;
    }
    Ok(())
}

fn solid_files(
    part: &'static str,
    title: &str,
    solid: &Solid,
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), FeederFilesError> {
    if wanted(Format::Step) {
        bundle.add(&format!("{part}.step"), step::write(solid, part, title)?)?;
    }
    if !wanted(Format::Stl) && !wanted(Format::ThreeMf) {
        return Ok(());
    }
    let mesh = solid
        .mesh(options.tolerance)
        .map_err(|source| FeederFilesError::Solid { part, source })?;
    if wanted(Format::Stl) {
        bundle.add(&format!("{part}.stl"), stl::write(&mesh))?;
    }
    if wanted(Format::ThreeMf) {
        let file = threemf::write(&mesh, part, title)?;
        bundle.add(&format!("{part}.3mf"), file)?;
    }
    Ok(())
}

fn gear_files(
    feeder: &Feeder,
    wanted: &impl Fn(Format) -> bool,
    options: &Options,
    bundle: &mut Bundle,
) -> Result<(), FeederFilesError> {
    let made = [Format::Dxf, Format::Svg, Format::Stl, Format::ThreeMf];
    if !made.into_iter().any(wanted) {
        return Ok(());
    }
    let pair = feeder.gears()?;
    let parts = gears::parts(&pair, options.tolerance);
    let mut drawings: Vec<_> = parts.iter().map(|p| (p.name, p.drawing())).collect();
    drawings.push(("gears", gears::assembly(&pair, &parts)));
    for (name, drawing) in &drawings {
        draw_one(name, drawing, wanted, options, bundle)?;
    }
    // Contours of thousands of short lines are no exact solid.
    let meshed = |format: Format| format != Format::Step && wanted(format);
    for part in &parts {
        let title = format!("{}: {}", named(feeder), part.name);
        solid_files(part.name, &title, &part.solid()?, &meshed, options, bundle)?;
    }
    Ok(())
}

fn named(feeder: &Feeder) -> &str {
    match feeder.design().title.as_str() {
        "" => &feeder.design().name,
        title => title,
    }
}
