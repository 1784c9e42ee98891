//! Drawing sheets and cutting drawings of gears.

use crate::error::{Answer, tolerance as within};
use crate::record;
use crate::wait::wait;
use crate::word::Word;
use centrode::sheet_data;
use centrode_analysis::check;
use centrode_export::gear_pair::{Subject, sheets, subject_files};
use centrode_export::{ExportError, Options, Package, SheetOptions};
use centrode_formats::{Bundle, Format};
use centrode_gear::{GearPair, Member};
use centrode_geometry::Tolerance;
use pyo3::prelude::{Bound, PyAny, Python};
use std::sync::Arc;

/// The sheets of a subject; the contact analysis is made for their tables.
pub(crate) fn sheet<'py>(
    py: Python<'py>,
    pair: &Arc<GearPair>,
    subject: Subject,
    [size, projection]: [Option<&str>; 2],
    tolerance: f64,
) -> Answer<Bound<'py, PyAny>> {
    let tolerance = within(tolerance, pair.accuracy())?;
    let layout = SheetOptions {
        size: size.map(|size| Word::of("sheet", size)).transpose()?,
        projection: projection
            .map(|word| Word::of("projection", word))
            .transpose()?,
        ..SheetOptions::default()
    };
    let pair = Arc::clone(pair);
    let (size, files) = wait(py, move || laid_out(&pair, subject, layout, tolerance))??;
    let files = by_ending(files, ["dxf", "svg", "pdf"]);
    Ok(record::sheets(py, &size, &files)?)
}

/// Size and files of the sheets of a subject.
fn laid_out(
    pair: &GearPair,
    subject: Subject,
    layout: SheetOptions,
    tolerance: Tolerance,
) -> Result<(String, Bundle), ExportError> {
    let layout = SheetOptions {
        found: sheet_data(&check(pair)),
        ..layout
    };
    let pages = sheets(pair, subject, &layout, tolerance)?;
    let size = pages.first().map_or("", |page| page.size.name()).into();
    let options = Options::new(tolerance);
    let (name, title) = (pair.name(), pair.title());
    let formats = [Format::Sheet, Format::Pdf];
    let mut package = Package::new("a gear pair", name, title, &formats, &options);
    package.sheets(subject.name(), || Ok(pages))?;
    Ok((size, package.finish()?))
}

/// The cutting drawing of a gear.
pub(crate) fn drawing<'py>(
    py: Python<'py>,
    pair: &Arc<GearPair>,
    member: Member,
    tolerance: f64,
) -> Answer<Bound<'py, PyAny>> {
    let options = Options::new(within(tolerance, pair.accuracy())?);
    let (pair, formats) = (Arc::clone(pair), [Format::Dxf, Format::Svg]);
    let files = wait(py, move || {
        subject_files(&pair, member.into(), &formats, &options)
    })??;
    Ok(record::drawing(py, &by_ending(files, ["dxf", "svg"]))?)
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
