use std::path::{Path, PathBuf};

use centrode::meshing;
use centrode_analysis::check;
use centrode_export::gear_pair::{Subject, sheets, subject_files};
use centrode_export::{Bundle, ExportError, Format, Options, Package, SheetOptions};
use centrode_geometry::Tolerance;
use centrode_mechanism::gear::{GearPair, Member};
use pyo3::prelude::{Bound, PyResult, Python, pyclass, pyfunction, pymethods};
use pyo3::types::{PyBytes, PyTuple};

use crate::bundle::written_file;
use crate::drawing::{projection, size};
use crate::error::unknown_word;
use crate::made::{Reduced, by};
use crate::record::Keywords;

/// The drawing sheets of a gear, or of both in place, as `Gear.sheet` and `GearPair.sheet` lay them out.
///
/// >>> import centrode as ct
/// >>> sheets = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver.sheet(size="A3")
/// >>> sheets.size, len(sheets) == len(sheets.svg)
/// ('A3', True)
/// >>> sheets.pdf[:5]
/// b'%PDF-'
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Sheets {
    size: String,
    dxf: Vec<Vec<u8>>,
    svg: Vec<Vec<u8>>,
    pdf: Vec<u8>,
}

/// The cutting drawing of a gear: profile and bore, and lines of reference.
///
/// >>> import centrode as ct
/// >>> drawing = ct.GearPair(ct.pitch.circle(module=2, tooth_count=20)).driver.drawing()
/// >>> b"LWPOLYLINE" in drawing.dxf
/// True
#[pyclass(frozen, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Drawing {
    dxf: Vec<u8>,
    svg: Vec<u8>,
}

impl Sheets {
    /// Lays out and writes the sheets of a subject; the contact analysis is made for their tables.
    pub(crate) fn make(
        pair: &GearPair,
        subject: Subject,
        sheet: SheetOptions,
        tolerance: Tolerance,
    ) -> Result<Self, ExportError> {
        let sheet = SheetOptions {
            meshing: meshing(&check(pair)),
            ..sheet
        };
        let pages = sheets(pair, subject, &sheet, tolerance)?;
        let size = pages.first().map_or("", |page| page.size.name()).into();
        let (named, options) = ([pair.name(), pair.title()], Options::new(tolerance));
        let formats = [Format::Sheet, Format::Pdf];
        let mut package = Package::new("a gear pair", named, &formats, &options);
        package.sheets(subject.name(), || Ok(pages))?;
        let [dxf, svg, pdf] = by_ending(package.finish()?, ["dxf", "svg", "pdf"]);
        Ok(Self {
            size,
            dxf,
            svg,
            pdf: pdf.concat(),
        })
    }
}

impl Drawing {
    pub(crate) fn make(
        pair: &GearPair,
        member: Member,
        tolerance: Tolerance,
    ) -> Result<Self, ExportError> {
        let (formats, options) = ([Format::Dxf, Format::Svg], Options::new(tolerance));
        let files = subject_files(pair, member.into(), &formats, &options)?;
        let [dxf, svg] = by_ending(files, ["dxf", "svg"]);
        Ok(Self {
            dxf: dxf.concat(),
            svg: svg.concat(),
        })
    }
}

/// Contents of the files with each ending.
fn by_ending<const N: usize>(files: Bundle, endings: [&str; N]) -> [Vec<Vec<u8>>; N] {
    let mut found = [(); N].map(|()| Vec::new());
    for (name, bytes) in files.into_files() {
        let ending = endings.iter().position(|ending| name.ends_with(ending));
        if let Some(index) = ending {
            found[index].push(bytes);
        }
    }
    found
}

/// Size and projection by their names.
pub(crate) fn layout(
    size_name: Option<&str>,
    projection_name: Option<&str>,
) -> PyResult<SheetOptions> {
    Ok(SheetOptions {
        size: size_name.map(size).transpose()?,
        projection: projection_name.map(projection).transpose()?,
        ..SheetOptions::default()
    })
}

/// The ending of a path, one of those known.
fn ending<'a>(path: &Path, known: &[&'a str]) -> PyResult<&'a str> {
    let found = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let same = known.iter().find(|k| k.eq_ignore_ascii_case(found));
    same.copied()
        .ok_or_else(|| unknown_word("path", found, known))
}

/// Writes files, each whole or not at all.
fn write(py: Python<'_>, files: Vec<(PathBuf, Vec<u8>)>) -> PyResult<Vec<PathBuf>> {
    let mut written = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        written.push(written_file(py, path, bytes)?);
    }
    Ok(written)
}

#[pymethods]
impl Sheets {
    /// Size of the sheets: "A4" to "A0".
    #[getter]
    fn size(&self) -> &str {
        &self.size
    }

    /// A DXF file a sheet, R2010, in paper millimetres.
    #[getter]
    fn dxf<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.dxf.iter().map(|bytes| PyBytes::new(py, bytes)))
    }

    /// An SVG picture a sheet.
    #[getter]
    fn svg<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, self.svg.iter().map(|bytes| PyBytes::new(py, bytes)))
    }

    /// One PDF, a page a sheet.
    #[getter]
    fn pdf<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.pdf)
    }

    /// Writes the sheets in the format the path ends in, .pdf, .dxf or .svg; gives the paths.
    ///
    /// Several sheets make one PDF, but a file each of the others: name-1.dxf, name-2.dxf.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<Vec<PathBuf>> {
        let pages = match ending(&path, &["pdf", "dxf", "svg"])? {
            "pdf" => vec![self.pdf.clone()],
            "dxf" => self.dxf.clone(),
            _ => self.svg.clone(),
        };
        let several = pages.len() > 1;
        let named = pages.into_iter().enumerate().map(|(index, bytes)| {
            let mut target = path.clone();
            if let (true, Some(stem)) = (several, path.file_stem()) {
                let ending = path.extension().unwrap_or_default().to_string_lossy();
                let stem = stem.to_string_lossy();
                target.set_file_name(format!("{stem}-{}.{ending}", index + 1));
            }
            (target, bytes)
        });
        write(py, named.collect())
    }

    fn __len__(&self) -> usize {
        self.dxf.len()
    }

    fn __repr__(&self) -> String {
        format!("Sheets({} of {})", self.__len__(), self.size())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let keywords = Keywords::new(py)
            .with("size", &self.size)?
            .with("dxf", self.dxf(py)?)?
            .with("svg", self.svg(py)?)?
            .with("pdf", self.pdf(py))?;
        by("_sheets", keywords)
    }
}

#[pymethods]
impl Drawing {
    /// DXF R2010: closed contours of lines and arcs.
    #[getter]
    fn dxf<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.dxf)
    }

    /// SVG picture of the drawing.
    #[getter]
    fn svg<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.svg)
    }

    /// Writes the drawing in the format the path ends in, .dxf or .svg; gives the path.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<PathBuf> {
        let bytes = match ending(&path, &["dxf", "svg"])? {
            "dxf" => self.dxf.clone(),
            _ => self.svg.clone(),
        };
        write(py, vec![(path.clone(), bytes)])?;
        Ok(path)
    }

    fn __repr__(&self) -> String {
        format!("Drawing({} bytes of DXF)", self.dxf.len())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        let keywords = Keywords::new(py)
            .with("dxf", self.dxf(py))?
            .with("svg", self.svg(py))?;
        by("_drawing", keywords)
    }
}

/// Sheets of their files: how they are unpickled.
#[pyfunction]
pub(crate) fn _sheets(size: String, dxf: Vec<Vec<u8>>, svg: Vec<Vec<u8>>, pdf: Vec<u8>) -> Sheets {
    Sheets {
        size,
        dxf,
        svg,
        pdf,
    }
}

/// A drawing of its files: how it is unpickled.
#[pyfunction]
pub(crate) fn _drawing(dxf: Vec<u8>, svg: Vec<u8>) -> Drawing {
    Drawing { dxf, svg }
}
