use super::{Format, GearPairFilesError, Options, Subject, sheets};
use crate::{Bundle, dxf, pdf, sheet::Sheet, svg};
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::GearPair;

/// The drawing sheets of one subject, ready to be written in any of their formats.
#[derive(Clone, Debug)]
pub struct SheetSet {
    name: &'static str,
    title: String,
    sheets: Vec<Sheet>,
    tolerance: Tolerance,
}

impl SheetSet {
    /// Lays out the sheets of a subject, whichever subjects the options name.
    ///
    /// # Errors
    /// [`GearPairFilesError::Sheet`] if the size asked for is too small.
    pub fn new(
        pair: &GearPair,
        subject: Subject,
        options: &Options,
    ) -> Result<Self, GearPairFilesError> {
        let sheets = sheets(pair, subject, &options.sheet, options.tolerance)
            .map_err(|source| GearPairFilesError::Sheet { subject, source })?;
        let named = match pair.title() {
            "" => pair.name(),
            title => title,
        };
        let label = options.sheet.label;
        let name = label.map_or(subject.name(), |label| label.name);
        Ok(Self {
            name,
            title: format!("{named}: {name}"),
            sheets,
            tolerance: options.tolerance,
        })
    }

    /// The sheets in order.
    #[must_use]
    pub fn sheets(&self) -> &[Sheet] {
        &self.sheets
    }

    /// One DXF file a sheet.
    ///
    /// # Errors
    /// [`GearPairFilesError::Dxf`] if the library refuses.
    pub fn dxf(&self, version: dxf::Version) -> Result<Vec<Vec<u8>>, GearPairFilesError> {
        let write = |sheet: &Sheet| {
            let curves = dxf::Curves::Arcs;
            Ok(dxf::write(&sheet.drawing, version, curves, self.tolerance)?)
        };
        self.sheets.iter().map(write).collect()
    }

    /// One SVG picture a sheet.
    #[must_use]
    pub fn svg(&self) -> Vec<String> {
        let write = |sheet: &Sheet| svg::sheet(sheet, self.tolerance);
        self.sheets.iter().map(write).collect()
    }

    /// One PDF with a page a sheet.
    ///
    /// # Errors
    /// [`GearPairFilesError::Pdf`] if the library refuses.
    pub fn pdf(&self) -> Result<Vec<u8>, GearPairFilesError> {
        Ok(pdf::write(&self.sheets, &self.title, self.tolerance)?)
    }

    /// The name of a sheet's file without its ending: "driver-sheet", or "driver-sheet-2" of several.
    #[must_use]
    pub fn file_name(&self, index: usize) -> String {
        match self.sheets.len() {
            1 => format!("{}-sheet", self.name),
            _ => format!("{}-sheet-{}", self.name, index + 1),
        }
    }

    pub(super) fn add(
        &self,
        wanted: &impl Fn(Format) -> bool,
        options: &Options,
        bundle: &mut Bundle,
    ) -> Result<(), GearPairFilesError> {
        if wanted(Format::Sheet) {
            let written = self.dxf(options.dxf_version)?;
            for (index, (dxf, svg)) in written.into_iter().zip(self.svg()).enumerate() {
                let name = self.file_name(index);
                bundle.add(&format!("{name}.dxf"), dxf)?;
                bundle.add(&format!("{name}.svg"), svg.into_bytes())?;
            }
        }
        if wanted(Format::Pdf) {
            bundle.add(&format!("{}.pdf", self.name), self.pdf()?)?;
        }
        Ok(())
    }
}
