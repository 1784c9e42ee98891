//! Results of many parts, handed over as the records of the Python part of the package.

use centrode_analysis::interference::Clearance;
use centrode_analysis::optimise::{Ended, Progress};
use centrode_analysis::{Contact, Finding, Goal, Report, Severity, Table};
use centrode_mechanism::gear::{OverPins, Pin, Tooth, ToothSide};
use centrode_mechanism::linkage;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{Bound, IntoPyObject, Py, PyAny, PyAnyMethods, PyResult, Python};
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict, PyDictMethods, PyTuple, PyType};

use crate::array::Course;
use crate::search::Found;

/// A Python class, looked up once.
struct Class {
    module: &'static str,
    name: &'static str,
    class: PyOnceLock<Py<PyType>>,
}

impl Class {
    const fn new(module: &'static str, name: &'static str) -> Self {
        let class = PyOnceLock::new();
        Self {
            module,
            name,
            class,
        }
    }

    fn make<'py>(&self, keywords: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
        let py = keywords.py();
        let class = self.class.import(py, self.module, self.name)?;
        class.call((), Some(keywords))
    }
}

/// A list of results as a Python tuple.
fn tuple<'py>(
    py: Python<'py>,
    items: impl Iterator<Item = PyResult<Bound<'py, PyAny>>>,
) -> PyResult<Bound<'py, PyTuple>> {
    PyTuple::new(py, items.collect::<PyResult<Vec<_>>>()?)
}

/// Named values as the keywords of a class.
pub(crate) struct Keywords<'py>(pub(crate) Bound<'py, PyDict>);

impl<'py> Keywords<'py> {
    pub(crate) fn new(py: Python<'py>) -> Self {
        Self(PyDict::new(py))
    }

    pub(crate) fn with(self, name: &str, value: impl IntoPyObject<'py>) -> PyResult<Self> {
        self.0.set_item(name, value)?;
        Ok(self)
    }

    /// The call that they belong to, as it is written.
    pub(crate) fn call(&self, name: &str) -> PyResult<String> {
        let mut given = Vec::with_capacity(self.0.len());
        for (key, value) in &self.0 {
            given.push(format!("{key}={}", value.repr()?));
        }
        Ok(format!("{name}({})", given.join(", ")))
    }
}

/// Forces on a slider: normal, transverse, torque and push.
pub(crate) fn slider_force<'py>(
    py: Python<'py>,
    parts: [Course; 4],
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._slider_force", "SliderForce");
    let [normal, transverse, torque, push] = parts;
    let keywords = Keywords::new(py)
        .with("normal", normal)?
        .with("transverse", transverse)?
        .with("torque", torque)?
        .with("push", push)?;
    CLASS.make(&keywords.0)
}

/// How close two arms come.
pub(crate) fn clearance<'py>(py: Python<'py>, found: &Clearance) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._clearance", "Clearance");
    let keywords = Keywords::new(py)
        .with("least", found.least)?
        .with("lower_bound", found.lower_bound)?
        .with("input", found.input)?
        .with("arms", PyTuple::new(py, found.pair)?)?;
    CLASS.make(&keywords.0)
}

/// A report.
pub(crate) fn report<'py>(py: Python<'py>, report: &Report) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._report", "Report");
    let findings = tuple(py, report.findings.iter().map(|f| finding(py, f)))?;
    let keywords = Keywords::new(py)
        .with("ok", report.ok())?
        .with("findings", findings)?
        .with("values", report.values.clone())?
        .with("goals", goals(py, &report.goals)?)?
        .with(
            "tables",
            tuple(py, report.tables.iter().map(|t| table(py, t)))?,
        )?;
    CLASS.make(&keywords.0)
}

/// What a search has come to.
pub(crate) fn optimised<'py>(
    py: Python<'py>,
    mechanism: Bound<'py, PyAny>,
    found: &Found,
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._optimised", "Optimised");
    let progress =
        |at: &Progress| (at.evaluations, at.violation, at.objective).into_bound_py_any(py);
    let steps: Vec<String> = found.steps.iter().map(ToString::to_string).collect();
    let ended = match found.ended {
        Ended::Target => "target",
        Ended::Evaluations => "evaluations",
        Ended::Stopped => "stopped",
        Ended::Stuck => "stuck",
    };
    let keywords = Keywords::new(py)
        .with("mechanism", mechanism)?
        .with("goals", goals(py, &found.goals)?)?
        .with("steps", PyTuple::new(py, steps)?)?
        .with("evaluations", found.progress.map_or(0, |p| p.evaluations))?
        .with("ended", ended)?
        .with("history", tuple(py, found.history.iter().map(progress))?)?
        .with("remark", found.remark.as_deref())?;
    CLASS.make(&keywords.0)
}

/// The goals of a mechanism.
pub(crate) fn goals<'py>(py: Python<'py>, goals: &[Goal]) -> PyResult<Bound<'py, PyTuple>> {
    static CLASS: Class = Class::new("centrode._goal", "Goal");
    let one = |goal: &Goal| {
        let keywords = Keywords::new(py)
            .with("number", goal.number)?
            .with("name", goal.name)?
            .with("title", goal.title)?
            .with("value", goal.value)?
            .with("wanted", PyTuple::new(py, goal.wanted)?)?
            .with("unit", goal.unit)?
            .with("scale", goal.scale)?
            .with("margin", goal.margin)?
            .with("progress", goal.progress)?
            .with("met", goal.met())?;
        CLASS.make(&keywords.0)
    };
    tuple(py, goals.iter().map(one))
}

fn table<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._report", "Table");
    let rows = PyDict::new(py);
    for (name, figures) in &table.rows {
        rows.set_item(name, PyTuple::new(py, figures)?)?;
    }
    let keywords = Keywords::new(py)
        .with("name", table.name)?
        .with("title", table.title)?
        .with("unit", table.unit)?
        .with("columns", PyTuple::new(py, &table.columns)?)?
        .with("rows", rows)?;
    CLASS.make(&keywords.0)
}

fn finding<'py>(py: Python<'py>, finding: &Finding) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._report", "Finding");
    static PLACE: Class = Class::new("centrode._report", "Place");
    let severity = match finding.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let place = Keywords::new(py)
        .with("part", finding.place.part.as_deref())?
        .with("teeth", PyTuple::new(py, &finding.place.teeth)?)?
        .with("input", finding.place.input)?;
    let keywords = Keywords::new(py)
        .with("rule", finding.rule)?
        .with("severity", severity)?
        .with("message", finding.message.as_str())?
        .with("measured", finding.measured)?
        .with("required", finding.required)?
        .with("unit", finding.unit)?
        .with("remedy", finding.remedy)?
        .with("place", PLACE.make(&place.0)?)?;
    CLASS.make(&keywords.0)
}

/// A contact analysis.
pub(crate) fn contact(py: Python<'_>, contact: Contact) -> PyResult<Bound<'_, PyAny>> {
    static CLASS: Class = Class::new("centrode._contact", "Contact");
    let mut keywords = Keywords::new(py).with("contacts", contact.contacts.into_pyarray(py))?;
    for (name, values) in [
        ("input", contact.input),
        ("law", contact.law),
        ("driven_angle", contact.driven_angle),
        ("reverse_driven_angle", contact.reverse_driven_angle),
        ("transmission_error", contact.transmission_error),
        (
            "reverse_transmission_error",
            contact.reverse_transmission_error,
        ),
        ("backlash", contact.backlash),
        ("normal_backlash", contact.normal_backlash),
        ("overlap", contact.overlap),
        ("clearance", contact.clearance),
        ("fillet_clearance", contact.fillet_clearance),
        ("sliding", contact.sliding),
    ] {
        keywords = keywords.with(name, values.into_pyarray(py))?;
    }
    CLASS.make(&keywords.0)
}

/// Pins in the spaces of a gear.
pub(crate) fn over_pins<'py>(py: Python<'py>, over: &OverPins) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._over_pins", "OverPins");
    let rows = over.pins.len();
    let coordinates = |of: &dyn Fn(&Pin) -> Vec<f64>, width: usize| -> Vec<f64> {
        let unknown = || vec![f64::NAN; width];
        let each = over
            .pins
            .iter()
            .map(|p| p.as_ref().map_or_else(|_| unknown(), of));
        each.flatten().collect()
    };
    let center = coordinates(&|p| p.center.coords.as_slice().to_vec(), 2);
    let contacts = coordinates(&|p| p.contacts.iter().flat_map(|c| [c.x, c.y]).collect(), 4);
    let radial = coordinates(&|p| vec![p.radial], 1);
    let across: Vec<Option<(usize, f64)>> = (0..rows).map(|k| over.across(k)).collect();
    let partner = across.iter().map(|a| a.map_or(-1, |(j, _)| j as i64));
    let faults = over
        .pins
        .iter()
        .map(|p| p.err().map(|fault| fault.to_string()));
    let keywords = Keywords::new(py)
        .with("diameter", over.diameter)?
        .with("center", center.into_pyarray(py).reshape([rows, 2])?)?
        .with("contacts", contacts.into_pyarray(py).reshape([rows, 2, 2])?)?
        .with("radial", radial.into_pyarray(py))?
        .with("partner", partner.collect::<Vec<i64>>().into_pyarray(py))?
        .with(
            "across",
            across
                .iter()
                .map(|a| a.map_or(f64::NAN, |(_, measure)| measure))
                .collect::<Vec<f64>>()
                .into_pyarray(py),
        )?
        .with("faults", PyTuple::new(py, faults.collect::<Vec<_>>())?)?;
    CLASS.make(&keywords.0)
}

/// The teeth of a gear, in order.
pub(crate) fn teeth<'py>(py: Python<'py>, teeth: &[Tooth]) -> PyResult<Bound<'py, PyTuple>> {
    static CLASS: Class = Class::new("centrode._tooth", "Tooth");
    let one = |(number, tooth): (usize, &Tooth)| {
        let keywords = Keywords::new(py)
            .with("number", number)?
            .with("leading", side(py, &tooth.leading)?)?
            .with("trailing", side(py, &tooth.trailing)?)?
            .with("tip_width", tooth.tip_width)?
            .with("severed", tooth.severed)?;
        CLASS.make(&keywords.0)
    };
    tuple(py, teeth.iter().enumerate().map(one))
}

fn side<'py>(py: Python<'py>, side: &ToothSide) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._tooth", "ToothSide");
    let keywords = Keywords::new(py)
        .with("crossing", side.crossing)?
        .with("tip_height", side.tip_height)?
        .with("shortened", side.shortened)?
        .with("form_depth", side.form_depth)?
        .with("needed", side.needed)?
        .with("undercut", side.undercut)?
        .with("active", side.active)?
        .with("fillet_radius", side.fillet_radius)?;
    CLASS.make(&keywords.0)
}

/// Drawing sheets of a size: their files in DXF, SVG and PDF.
pub(crate) fn sheets<'py>(
    py: Python<'py>,
    size: &str,
    [dxf, svg, pdf]: &[Vec<Vec<u8>>; 3],
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._sheet", "Sheets");
    let files = |all: &[Vec<u8>]| PyTuple::new(py, all.iter().map(|file| PyBytes::new(py, file)));
    let keywords = Keywords::new(py)
        .with("size", size)?
        .with("dxf", files(dxf)?)?
        .with("svg", files(svg)?)?
        .with("pdf", PyBytes::new(py, &pdf.concat()))?;
    CLASS.make(&keywords.0)
}

/// A cutting drawing: its files in DXF and SVG.
pub(crate) fn drawing<'py>(
    py: Python<'py>,
    [dxf, svg]: &[Vec<Vec<u8>>; 2],
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._sheet", "Drawing");
    let keywords = Keywords::new(py)
        .with("dxf", PyBytes::new(py, &dxf.concat()))?
        .with("svg", PyBytes::new(py, &svg.concat()))?;
    CLASS.make(&keywords.0)
}

/// Dead centres of a six-bar.
pub(crate) fn dead_centers<'py>(
    py: Python<'py>,
    dead: &linkage::DeadCenters,
) -> PyResult<Bound<'py, PyAny>> {
    static CLASS: Class = Class::new("centrode._six_bar", "DeadCenters");
    let keywords = Keywords::new(py)
        .with("stretched", dead.stretched)?
        .with("folded", dead.folded)?
        .with("stretched_at", (dead.stretched_at.x, dead.stretched_at.y))?
        .with("folded_at", (dead.folded_at.x, dead.folded_at.y))?;
    CLASS.make(&keywords.0)
}
