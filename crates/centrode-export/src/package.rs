mod solids;

use std::cell::Cell;

use centrode_formats::{
    Bundle, Format,
    csv::{self, Column},
    drawing::Drawing,
    dxf::{self, Curves},
    pdf,
    sheet::Sheet,
    svg,
};
use centrode_geometry::{Tolerance, UncutCorner};
use centrode_kinematics::machine::LinkedMachine;

use crate::{
    ExportError, Options, cutting,
    linked::{self, ARRANGEMENT},
};

/// Formats of drawing sheets.
const SHEETS: [Format; 2] = [Format::Sheet, Format::Pdf];

/// Finest tolerance, relative to the size of a machine: contours of a gear then have some ten thousand pieces.
const FINEST: f64 = 1e-9;

/// The title of a design, or its name where it has none.
pub(crate) fn title_or_name<'a>(title: &'a str, name: &'a str) -> &'a str {
    if title.is_empty() { name } else { title }
}

/// Everything one export writes: a family offers drawings, sheets, solids, tables and models by name, each as a
/// function that is called only where a format and a requested part need it.
#[derive(Debug)]
pub struct Package<'a> {
    /// Kind of machine, with its article.
    machine: &'static str,
    /// The design's title, or its name.
    design: &'a str,
    /// Prefix of the names of parts and files.
    prefix: &'static str,
    formats: Vec<Format>,
    options: &'a Options,
    bundle: Bundle,
    /// Names of the parts offered.
    known: Vec<String>,
    /// Sheets of every part that has a PDF.
    book: Vec<(String, Vec<Sheet>)>,
    /// Width of the cut for which cutting files are made, mm.
    kerf: f64,
    /// Corners of each part that the cut does not reach.
    uncut: Vec<(String, Vec<UncutCorner>)>,
}

/// Name of the PDF of all sheets.
const BOOK: &str = "sheets.pdf";

/// Name of the text about the cut.
const CUTTING: &str = "cutting.txt";

/// Accuracy of the path of a cut, as a share of the tolerance: its error then changes none of the tolerance's digits.
const PATH: f64 = 1e-4;

impl<'a> Package<'a> {
    /// A package without files of a kind of machine (with its article) and the design's name and title.
    #[must_use]
    pub fn new(
        machine: &'static str,
        name: &'a str,
        title: &'a str,
        formats: &[Format],
        options: &'a Options,
    ) -> Self {
        Self {
            machine,
            design: title_or_name(title, name),
            prefix: "",
            formats: formats.to_vec(),
            options,
            bundle: Bundle::default(),
            known: Vec::new(),
            book: Vec::new(),
            kerf: options.kerf.unwrap_or(0.0),
            uncut: Vec::new(),
        }
    }

    /// Sets the width of the cut of the design, mm, used if the options have none.
    #[must_use]
    pub(crate) fn kerf(mut self, kerf: f64) -> Self {
        self.kerf = self.options.kerf.unwrap_or(kerf);
        self
    }

    /// How files are written.
    pub(crate) fn options(&self) -> &'a Options {
        self.options
    }

    /// The design's title, or its name.
    pub(crate) fn design(&self) -> &'a str {
        self.design
    }

    /// Maximum distance of every arc, point sequence and mesh from the exact curve.
    pub(crate) fn tolerance(&self) -> Tolerance {
        self.options.tolerance
    }

    /// Whether any of these formats is requested.
    pub(crate) fn wants(&self, formats: &[Format]) -> bool {
        formats.iter().any(|format| self.formats.contains(format))
    }

    /// Name that the files of a part begin with.
    pub(crate) fn name_of(&self, part: &str) -> String {
        format!("{}{part}", self.prefix)
    }

    /// Title of a part: the design and the part.
    pub(crate) fn titled(&self, part: &str) -> String {
        format!("{}: {part}", self.design)
    }

    /// Registers a part; returns whether it is requested in one of these formats.
    fn takes(&mut self, part: &str, formats: &[Format]) -> bool {
        let part = self.name_of(part);
        let required = self.options.wants(&part) && self.wants(formats);
        if !self.known.contains(&part) {
            self.known.push(part);
        }
        required
    }

    /// Adds a file.
    pub(crate) fn file(&mut self, name: &str, bytes: Vec<u8>) -> Result<(), ExportError> {
        Ok(self.bundle.add(&self.name_of(name), bytes)?)
    }

    /// Refuses a tolerance of more than a tenth of a size of the machine, mm.
    pub(crate) fn finer_than(&self, size: f64, of: &'static str) -> Result<(), ExportError> {
        let (tolerance, largest) = (self.tolerance().mm(), 0.1 * size);
        if tolerance > largest {
            return Err(ExportError::Tolerance {
                tolerance,
                largest,
                of,
            });
        }
        Ok(())
    }

    /// Refuses a tolerance of less than a billionth of a size of the machine, mm, unless only STEP is requested, whose curves are
    /// exact.
    pub(crate) fn coarser_than(&self, size: f64, of: &'static str) -> Result<(), ExportError> {
        let (tolerance, minimum) = (self.tolerance().mm(), FINEST * size);
        let is_exact = self.formats.iter().all(|format| *format == Format::Step);
        if tolerance < minimum && !is_exact {
            return Err(ExportError::FineTolerance {
                tolerance,
                minimum,
                of,
            });
        }
        Ok(())
    }

    /// Offers the drawing of a part, made for the kind of curves it is written with.
    ///
    /// # Errors
    /// [`ExportError`] where it cannot be made or written.
    pub fn drawing(
        &mut self,
        part: &str,
        make: impl Fn(Curves) -> Result<Drawing, ExportError>,
    ) -> Result<(), ExportError> {
        if !self.takes(part, &[Format::Dxf, Format::Svg]) {
            return Ok(());
        }
        let Options {
            tolerance,
            dxf_version,
            dxf_curves,
            ..
        } = *self.options;
        let mut drawn = None;
        if self.wants(&[Format::Dxf]) {
            let drawing = make(dxf_curves)?;
            let bytes = dxf::write(&drawing, dxf_version, dxf_curves, tolerance)?;
            self.file(&format!("{part}.dxf"), bytes)?;
            drawn = Some(drawing).filter(|_| dxf_curves == Curves::Arcs);
        }
        if self.wants(&[Format::Svg]) {
            let drawing = drawn.map_or_else(|| make(Curves::Arcs), Ok)?;
            let picture = svg::write(&drawing, tolerance);
            self.file(&format!("{part}.svg"), picture.into_bytes())?;
        }
        Ok(())
    }

    /// Offers the cutting file of a part: its drawing with the layers that the options name, its contours moved for the width of
    /// the cut.
    ///
    /// # Errors
    /// [`ExportError`] where it cannot be made or written.
    pub fn cutting(
        &mut self,
        part: &str,
        make: impl Fn(Curves) -> Result<Drawing, ExportError>,
    ) -> Result<(), ExportError> {
        self.contour(part, self.kerf, make)
    }

    /// Offers the contour of a part for a lathe, as a cutting file of a cut without width.
    pub(crate) fn turning(
        &mut self,
        part: &str,
        make: impl Fn(Curves) -> Result<Drawing, ExportError>,
    ) -> Result<(), ExportError> {
        self.contour(part, 0.0, make)
    }

    fn contour(
        &mut self,
        part: &str,
        kerf: f64,
        make: impl Fn(Curves) -> Result<Drawing, ExportError>,
    ) -> Result<(), ExportError> {
        let (layers, tolerance) = (self.options.layers, self.tolerance());
        let uncut = Cell::new(None);
        self.drawing(part, |curves| {
            let mut drawing = cutting::file(make(curves)?, layers);
            if kerf > 0.0 {
                let found = cutting::along_the_cut(&mut drawing, kerf, tolerance.scaled(PATH));
                let named = |(contour, source)| ExportError::Kerf {
                    part: part.to_owned(),
                    contour,
                    kerf,
                    source,
                };
                uncut.set(Some(found.map_err(named)?));
            }
            Ok(drawing)
        })?;
        let name = self.name_of(part);
        self.uncut.extend(uncut.take().map(|found| (name, found)));
        Ok(())
    }

    /// Offers the drawing sheets of a part.
    ///
    /// # Errors
    /// [`ExportError`] where they cannot be laid out or written.
    pub fn sheets(
        &mut self,
        part: &str,
        make: impl FnOnce() -> Result<Vec<Sheet>, ExportError>,
    ) -> Result<(), ExportError> {
        if !self.takes(part, &SHEETS) {
            return Ok(());
        }
        let (sheets, tolerance) = (make()?, self.tolerance());
        if self.wants(&[Format::Sheet]) {
            for (index, sheet) in sheets.iter().enumerate() {
                let name = match sheets.len() {
                    1 => format!("{part}-sheet"),
                    _ => format!("{part}-sheet-{}", index + 1),
                };
                let version = self.options.dxf_version;
                let bytes = dxf::write(&sheet.drawing, version, Curves::Arcs, tolerance)?;
                self.file(&format!("{name}.dxf"), bytes)?;
                let picture = svg::sheet(sheet, tolerance);
                self.file(&format!("{name}.svg"), picture.into_bytes())?;
            }
        }
        if self.wants(&[Format::Pdf]) {
            let bytes = pdf::write(&sheets, &self.titled(part), tolerance)?;
            self.file(&format!("{part}.pdf"), bytes)?;
            self.book.push((self.name_of(part), sheets));
        }
        Ok(())
    }

    /// Offers a table of a part under a name of its own.
    ///
    /// # Errors
    /// [`ExportError`] where it cannot be made or written.
    pub fn table(
        &mut self,
        part: &str,
        name: &str,
        columns: impl FnOnce() -> Vec<Column>,
    ) -> Result<(), ExportError> {
        self.columns(part, name, &[Format::Csv], columns)
    }

    /// Offers a table of points that the sheets of a part refer to: it is also written with those sheets.
    pub(crate) fn points(
        &mut self,
        part: &str,
        name: &str,
        columns: impl FnOnce() -> Vec<Column>,
    ) -> Result<(), ExportError> {
        let [sheet, pdf] = SHEETS;
        self.columns(part, name, &[Format::Csv, sheet, pdf], columns)
    }

    fn columns(
        &mut self,
        part: &str,
        name: &str,
        formats: &[Format],
        columns: impl FnOnce() -> Vec<Column>,
    ) -> Result<(), ExportError> {
        if !self.takes(part, formats) {
            return Ok(());
        }
        self.file(&format!("{name}.csv"), csv::write(&columns())?)
    }

    /// Offers a text that goes with the tables of a part.
    pub(crate) fn text(
        &mut self,
        part: &str,
        file: &str,
        make: impl FnOnce() -> String,
    ) -> Result<(), ExportError> {
        if !self.takes(part, &[Format::Csv]) {
            return Ok(());
        }
        self.file(file, make().into_bytes())
    }

    /// Offers the machine: its general arrangement, parts list, table of motion, simulator models with the meshes they show,
    /// scripts that play them.
    ///
    /// # Errors
    /// [`ExportError`] where it cannot be made or written.
    pub fn machine(
        &mut self,
        make: impl FnOnce() -> Result<LinkedMachine, ExportError>,
    ) -> Result<(), ExportError> {
        // The models of a larger machine contain the smaller machine within it.
        let own = self.prefix.is_empty();
        let models = own && self.wants(&[Format::Csv, Format::Urdf, Format::Mjcf]);
        let sheets = self.takes(ARRANGEMENT, &SHEETS);
        let alone = own && !self.options.keep_solids;
        let whole = alone && self.takes(ARRANGEMENT, &[Format::ThreeMf, Format::Step]);
        if !sheets && !models && !whole {
            return Ok(());
        }
        let mut made = make()?;
        for part in made.parts.iter_mut().filter(|part| !part.file.is_empty()) {
            part.file.insert_str(0, self.prefix);
        }
        self.arrangement(&made)?;
        if whole {
            linked::add_whole(&made, self)?;
        }
        if models {
            linked::add(&made, self)?;
        }
        Ok(())
    }

    /// Offers the general arrangement of a machine, unless it has no figures.
    pub(crate) fn arrangement(&mut self, machine: &LinkedMachine) -> Result<(), ExportError> {
        if machine.figures.is_empty() {
            return Ok(());
        }
        let (sheet, tolerance) = (self.options.sheet.clone(), self.tolerance());
        self.sheets(ARRANGEMENT, || {
            linked::arrangement(machine, &sheet, tolerance)
                .map_err(ExportError::no_sheet(ARRANGEMENT))
        })
    }

    /// Adds the files of a smaller machine within this one, without simulator models, with a prefix to their names.
    pub(crate) fn within(
        &mut self,
        prefix: &'static str,
        name: &str,
        title: &str,
        fill: impl FnOnce(&mut Package<'_>) -> Result<(), ExportError>,
    ) -> Result<(), ExportError> {
        let mut inner = Package::new(self.machine, name, title, &self.formats, self.options);
        inner.prefix = prefix;
        inner.kerf = self.kerf;
        inner
            .formats
            .retain(|format| !matches!(format, Format::Urdf | Format::Mjcf));
        fill(&mut inner)?;
        inner.known.retain(|part| !self.known.contains(part));
        self.known.append(&mut inner.known);
        self.book.append(&mut inner.book);
        self.uncut.append(&mut inner.uncut);
        Ok(self.bundle.append(inner.bundle)?)
    }

    /// Adds the PDF of all sheets, the general arrangement first, if there are several parts.
    fn bind(&mut self) -> Result<(), ExportError> {
        let mut book = std::mem::take(&mut self.book);
        if book.len() < 2 {
            return Ok(());
        }
        book.sort_by_key(|(part, _)| part != ARRANGEMENT);
        let parts: Vec<(&str, &[Sheet])> = book
            .iter()
            .map(|(part, sheets)| (&**part, &**sheets))
            .collect();
        let bytes = pdf::book(&parts, self.design, self.tolerance())?;
        self.file(BOOK, bytes)
    }

    /// The files, not yet on disk.
    ///
    /// # Errors
    /// [`ExportError::UnknownPart`] where a requested part was never offered; [`ExportError::Pdf`] where the sheets of all parts
    /// cannot be written.
    pub fn finish(mut self) -> Result<Bundle, ExportError> {
        self.bind()?;
        self.bundle.has_note(CUTTING);
        if !self.uncut.is_empty() {
            let notes = cutting::notes(self.kerf, &self.uncut);
            self.file(CUTTING, notes.into_bytes())?;
        }
        let required = self.options.parts.iter().flatten();
        match required.into_iter().find(|part| !self.known.contains(part)) {
            None => Ok(self.bundle),
            Some(part) => Err(ExportError::UnknownPart {
                machine: self.machine,
                part: part.clone(),
                known: self.known,
            }),
        }
    }
}
