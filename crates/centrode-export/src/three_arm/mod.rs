//! The files of a three-arm mechanism.

mod arrangement;
mod assembly;
mod links;
mod machine;
mod part;
mod picture;
mod plate;
mod surroundings;
mod turn;

use centrode_geometry::SolidError;
use centrode_mechanism::arm::ArmError;
use centrode_mechanism::gear::GearPairError;
use centrode_mechanism::three_arm::{PusherError, ThreeArm};
use thiserror::Error;

use crate::gear_pair::{self, Format, GearPairFilesError, Label, Options};
use crate::{
    Bundle, BundleError, cam, csv, csv::TableError, dxf, dxf::DxfError, machine::MachineFilesError,
    pdf, pdf::PdfError, sheet::Sheet, sheet::SheetError, step, step::StepError, stl, svg, threemf,
    threemf::PackageError,
};
use machine::Machine;
pub use part::{Part, UnknownPart};
pub use picture::{Teeth, curves, picture};

/// Why a three-arm mechanism's files could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ThreeArmFilesError {
    /// No teeth can be laid out or cut.
    #[error(transparent)]
    Gears(#[from] GearPairError),
    /// A gear's files could not be made.
    #[error(transparent)]
    GearFiles(#[from] GearPairFilesError),
    /// There is no such arm.
    #[error("arm.body: {0}")]
    Arm(#[from] ArmError),
    /// Its push rod cannot be moved.
    #[error("{key}: {0}", key = .0.key())]
    Pusher(#[from] PusherError),
    /// The carrier has no contour.
    #[error("gearbox: the axes of the gears enclose nothing")]
    Gearbox,
    /// The fork has no contour.
    #[error("fork: pivot, roller and slot enclose nothing")]
    Fork,
    /// The tolerance is so coarse that little would be left of a part.
    #[error(
        "a tolerance of {tolerance} mm is too coarse: at most a tenth of the module, {largest:.4} mm"
    )]
    Tolerance {
        /// The tolerance, mm.
        tolerance: f64,
        /// The coarsest one possible, mm.
        largest: f64,
    },
    /// A part is no solid.
    #[error("{part} is no solid: {source}")]
    Solid {
        /// The part.
        part: Part,
        /// Why.
        source: SolidError,
    },
    /// A part's sheets cannot be laid out.
    #[error("{part}: {source}")]
    Sheet {
        /// The part.
        part: Part,
        /// Why.
        source: SheetError,
    },
    /// A drawing could not be written.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// Sheets could not be written as PDF.
    #[error(transparent)]
    Pdf(#[from] PdfError),
    /// A part cannot be written as STEP.
    #[error("{part}: {source}")]
    Step {
        /// The part.
        part: Part,
        /// Why.
        source: StepError,
    },
    /// A 3MF package could not be made.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// A table could not be written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// Its motion or a simulator model could not be written.
    #[error(transparent)]
    Files(#[from] MachineFilesError),
    /// The files do not go together.
    #[error(transparent)]
    Bundle(#[from] BundleError),
}

/// The files of a mechanism's parts in the formats asked for, not yet on disk: each part once, however many
/// there are. URDF and MJCF are of the whole machine, with the STL files they show, the laws of motion and
/// a script that plays them.
///
/// # Errors
/// [`ThreeArmFilesError`] where a part does not exist or a format cannot hold it.
pub fn files(
    mechanism: &ThreeArm,
    formats: &[Format],
    options: &Options,
    parts: &[Part],
) -> Result<Bundle, ThreeArmFilesError> {
    let machine = Machine::new(mechanism)?;
    let largest = 0.1 * machine.pairs[0].module();
    if options.tolerance.mm() > largest {
        return Err(ThreeArmFilesError::Tolerance {
            tolerance: options.tolerance.mm(),
            largest,
        });
    }
    let writer = Writer {
        machine: &machine,
        formats,
        options,
    };
    let mut bundle = Bundle::default();
    for &part in parts {
        if let Some((pair, member)) = machine.gear(part) {
            let label = writer.label(part);
            gear_pair::add_part(pair, member, label, formats, options, &mut bundle)?;
        } else if part == Part::Assembly {
            writer.assembly(&mut bundle)?;
        } else {
            writer.plate(part, &mut bundle)?;
        }
    }
    writer.motion(&mut bundle)?;
    Ok(bundle)
}

struct Writer<'a> {
    machine: &'a Machine<'a>,
    formats: &'a [Format],
    options: &'a Options,
}

impl Writer<'_> {
    fn wants(&self, format: Format) -> bool {
        self.formats.contains(&format)
    }

    /// The design's title, or its name.
    fn design(&self) -> &str {
        let design = self.machine.mechanism.design();
        match design.title.as_str() {
            "" => &design.name,
            title => title,
        }
    }

    fn label(&self, part: Part) -> Label {
        Label {
            name: part.name(),
            title: part.title(),
            mate: match part {
                Part::Intermediate => "sun and planet",
                _ => Part::Intermediate.name(),
            },
            quantity: part.quantity(self.machine.mechanism.arms()),
        }
    }

    fn drawing(
        &self,
        name: &str,
        drawing: &crate::drawing::Drawing,
        bundle: &mut Bundle,
    ) -> Result<(), ThreeArmFilesError> {
        let tolerance = self.options.tolerance;
        if self.wants(Format::Dxf) {
            let (version, curves) = (self.options.dxf_version, self.options.dxf_curves);
            let bytes = dxf::write(drawing, version, curves, tolerance)?;
            bundle.add(&format!("{name}.dxf"), bytes)?;
        }
        if self.wants(Format::Svg) {
            let picture = svg::write(drawing, tolerance);
            bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
        }
        Ok(())
    }

    fn assembly(&self, bundle: &mut Bundle) -> Result<(), ThreeArmFilesError> {
        let (part, tolerance) = (Part::Assembly, self.options.tolerance);
        if self.wants(Format::Dxf) || self.wants(Format::Svg) {
            let drawing = assembly::drawing(self.machine, tolerance);
            self.drawing(part.name(), &drawing, bundle)?;
        }
        if self.wants(Format::Sheet) || self.wants(Format::Pdf) {
            let options = &self.options.sheet;
            let sheets = arrangement::sheets(self.machine, self.design(), options, tolerance)
                .map_err(|source| ThreeArmFilesError::Sheet { part, source })?;
            self.sheets(part, &sheets, bundle)?;
        }
        Ok(())
    }

    fn plate(&self, part: Part, bundle: &mut Bundle) -> Result<(), ThreeArmFilesError> {
        let Some(plate) = self.machine.plate_of(part) else {
            return Ok(());
        };
        let (name, tolerance) = (part.name(), self.options.tolerance);
        self.drawing(name, &plate.drawing(), bundle)?;
        if self.wants(Format::Sheet) || self.wants(Format::Pdf) {
            let spec = &self.machine.mechanism.design().drawing;
            let sheets = plate
                .sheets((spec, self.design()), &self.options.sheet, tolerance)
                .map_err(|source| ThreeArmFilesError::Sheet { part, source })?;
            self.sheets(part, &sheets, bundle)?;
        }
        let title = format!("{}: {name}", self.design());
        let no_solid = |source| ThreeArmFilesError::Solid { part, source };
        if self.wants(Format::Step) {
            let solid = plate.solid().map_err(no_solid)?;
            let bytes = step::write(&solid, name, &title)
                .map_err(|source| ThreeArmFilesError::Step { part, source })?;
            bundle.add(&format!("{name}.step"), bytes)?;
        }
        if self.wants(Format::Stl) || self.wants(Format::ThreeMf) {
            let mesh = plate.mesh(tolerance).map_err(no_solid)?;
            if self.wants(Format::Stl) {
                bundle.add(&format!("{name}.stl"), stl::write(&mesh))?;
            }
            if self.wants(Format::ThreeMf) {
                let bytes = threemf::write(&mesh, name, &title)?;
                bundle.add(&format!("{name}.3mf"), bytes)?;
            }
        }
        if part == Part::Cam && self.wants(Format::Csv) {
            let table = cam::columns(self.machine.pusher.cam(), cam::ROWS);
            bundle.add("cam.csv", csv::write(&table)?)?;
        }
        Ok(())
    }

    fn sheets(
        &self,
        part: Part,
        sheets: &[Sheet],
        bundle: &mut Bundle,
    ) -> Result<(), ThreeArmFilesError> {
        let tolerance = self.options.tolerance;
        if self.wants(Format::Sheet) {
            for (index, sheet) in sheets.iter().enumerate() {
                let name = match sheets.len() {
                    1 => format!("{part}-sheet"),
                    _ => format!("{part}-sheet-{}", index + 1),
                };
                let version = self.options.dxf_version;
                let dxf = dxf::write(&sheet.drawing, version, dxf::Curves::Arcs, tolerance)?;
                bundle.add(&format!("{name}.dxf"), dxf)?;
                let picture = svg::sheet(sheet, tolerance);
                bundle.add(&format!("{name}.svg"), picture.into_bytes())?;
            }
        }
        if self.wants(Format::Pdf) {
            let title = format!("{}: {part}", self.design());
            let bytes = pdf::write(sheets, &title, tolerance)?;
            bundle.add(&format!("{part}.pdf"), bytes)?;
        }
        Ok(())
    }

    /// Laws of motion and simulator models.
    fn motion(&self, bundle: &mut Bundle) -> Result<(), ThreeArmFilesError> {
        let models = [Format::Urdf, Format::Mjcf].map(|format| self.wants(format));
        if models.contains(&true) || self.wants(Format::Csv) {
            let machine = links::machine(self.machine)?;
            crate::machine::add(&machine, models, self.options.tolerance, bundle)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
