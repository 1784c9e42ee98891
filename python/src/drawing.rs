use centrode_mechanism::design as spec;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::{Bound, PyDictMethods, PyResult, Python, pyclass, pymethods};
use pyo3::types::{PyDict, PyTuple};

use crate::error::of_spec;

/// Entries of the title block of the drawing sheets, and their layout.
///
/// An entry left out stays empty on the sheet.
///
/// Args:
///     number: Drawing number; the part's name is added to it.
///     revision: Revision.
///     date: Date of issue, as it is to be printed.
///     owner: Legal owner.
///     drawn_by: Who has drawn it.
///     approved_by: Who has approved it.
///     sheet: "A4" to "A0"; the smallest that takes the part if left out.
///     projection: "first-angle" or "third-angle".
///     general_tolerance: General tolerances.
///     edges: State of the edges.
///     surface: Texture of the surfaces that nothing else is said of, ISO 21920.
///
/// >>> import centrode as ct
/// >>> ct.DrawingSpec(number="7-204", sheet="A3").projection
/// 'first-angle'
#[pyclass(frozen, eq, module = "centrode")]
#[derive(Debug, PartialEq)]
pub(crate) struct DrawingSpec(pub(crate) spec::DrawingSpec);

/// The size of that name.
pub(crate) fn size(name: &str) -> PyResult<spec::SheetSize> {
    let found = spec::SheetSize::ALL.into_iter().find(|s| s.name() == name);
    found.ok_or_else(|| {
        PyValueError::new_err(format!("sheet must be A4, A3, A2, A1 or A0, not {name:?}"))
    })
}

/// The projection of that name.
pub(crate) fn projection(name: &str) -> PyResult<spec::Projection> {
    let all = [spec::Projection::FirstAngle, spec::Projection::ThirdAngle];
    let found = all.into_iter().find(|p| p.name() == name);
    found.ok_or_else(|| {
        PyValueError::new_err(format!(
            "projection must be first-angle or third-angle, not {name:?}"
        ))
    })
}

#[pymethods]
impl DrawingSpec {
    #[new]
    #[pyo3(signature = (*, number="", revision="", date="", owner="", drawn_by="", approved_by="", sheet=None, projection="first-angle", general_tolerance=None, edges=None, surface=None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn new(
        number: &str,
        revision: &str,
        date: &str,
        owner: &str,
        drawn_by: &str,
        approved_by: &str,
        sheet: Option<&str>,
        projection: &str,
        general_tolerance: Option<String>,
        edges: Option<String>,
        surface: Option<String>,
    ) -> PyResult<Self> {
        let usual = spec::DrawingSpec::default();
        let drawing = spec::DrawingSpec {
            number: number.into(),
            revision: revision.into(),
            date: date.into(),
            owner: owner.into(),
            drawn_by: drawn_by.into(),
            approved_by: approved_by.into(),
            sheet: sheet.map(size).transpose()?,
            projection: self::projection(projection)?,
            general_tolerance: general_tolerance.unwrap_or(usual.general_tolerance),
            edges: edges.unwrap_or(usual.edges),
            surface: surface.unwrap_or(usual.surface),
        };
        drawing.validate().map_err(|e| of_spec(&e))?;
        Ok(Self(drawing))
    }

    /// Drawing number.
    #[getter]
    fn number(&self) -> &str {
        &self.0.number
    }

    /// Revision.
    #[getter]
    fn revision(&self) -> &str {
        &self.0.revision
    }

    /// Date of issue.
    #[getter]
    fn date(&self) -> &str {
        &self.0.date
    }

    /// Legal owner.
    #[getter]
    fn owner(&self) -> &str {
        &self.0.owner
    }

    /// Who has drawn it.
    #[getter]
    fn drawn_by(&self) -> &str {
        &self.0.drawn_by
    }

    /// Who has approved it.
    #[getter]
    fn approved_by(&self) -> &str {
        &self.0.approved_by
    }

    /// Size of the sheets; None for the smallest that takes the part.
    #[getter]
    fn sheet(&self) -> Option<&'static str> {
        self.0.sheet.map(spec::SheetSize::name)
    }

    /// "first-angle" or "third-angle".
    #[getter]
    fn projection(&self) -> &'static str {
        self.0.projection.name()
    }

    /// General tolerances.
    #[getter]
    fn general_tolerance(&self) -> &str {
        &self.0.general_tolerance
    }

    /// State of the edges.
    #[getter]
    fn edges(&self) -> &str {
        &self.0.edges
    }

    /// Texture of the surfaces that nothing else is said of.
    #[getter]
    fn surface(&self) -> &str {
        &self.0.surface
    }

    fn __repr__(&self) -> String {
        let words: Vec<String> = self
            .words()
            .into_iter()
            .map(|(key, word)| format!("{key}={word:?}"))
            .collect();
        format!("DrawingSpec({})", words.join(", "))
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        for (key, word) in self.words() {
            keywords.set_item(key, word)?;
        }
        Ok((PyTuple::empty(py), keywords))
    }
}

impl DrawingSpec {
    /// The keywords that make this one.
    fn words(&self) -> Vec<(&'static str, &str)> {
        let spec = &self.0;
        let mut words = vec![
            ("number", spec.number.as_str()),
            ("revision", &spec.revision),
            ("date", &spec.date),
            ("owner", &spec.owner),
            ("drawn_by", &spec.drawn_by),
            ("approved_by", &spec.approved_by),
        ];
        words.extend(spec.sheet.map(|sheet| ("sheet", sheet.name())));
        words.extend([
            ("projection", spec.projection.name()),
            ("general_tolerance", spec.general_tolerance.as_str()),
            ("edges", &spec.edges),
            ("surface", &spec.surface),
        ]);
        words
    }
}
