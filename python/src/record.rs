//! Results of many parts, handed over as the records of the Python part of the package.

use std::collections::BTreeMap;

use centrode_analysis::interference::Clearance;
use centrode_analysis::{Contact, Finding, Goal, PairRemedy, Report, Severity, Table};
use centrode_gear::{OverPins, Pin, Tooth, ToothSide};
use centrode_kinematics::linkage;
use centrode_kinematics::machine::{LinkedMachine, Part};
use centrode_optimise::{Ended, Progress};
use centrode_spec::Design;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::{Bound, IntoPyObject, Py, PyAny, PyAnyMethods, PyResult, Python};
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict, PyDictMethods, PyTuple, PyType};

use crate::array::Course;
use crate::search::Found;
use crate::word::Word;

/// A Python class, looked up once.
pub(crate) struct Class {
    module: &'static str,
    name: &'static str,
    class: PyOnceLock<Py<PyType>>,
}

impl Class {
    pub(crate) const fn new(module: &'static str, name: &'static str) -> Self {
        let class = PyOnceLock::new();
        Self {
            module,
            name,
            class,
        }
    }

    pub(crate) fn make<'py>(&self, keywords: &Bound<'py, PyDict>) -> PyResult<Bound<'py, PyAny>> {
        let py = keywords.py();
        let class = self.class.import(py, self.module, self.name)?;
        class.call((), Some(keywords))
    }
}

/// A record of a class of the package: fields that a value has by the same names, then the others.
macro_rules! record {
    ($py:expr, $module:literal $class:literal, $of:expr => [$($same:ident),*] $($field:ident: $value:expr,)*) => {{
        static CLASS: $crate::record::Class = $crate::record::Class::new($module, $class);
        let keywords = $crate::record::Keywords::new($py);
        $(let keywords = keywords.with(stringify!($same), $of.$same)?;)*
        $(let keywords = keywords.with(stringify!($field), $value)?;)*
        CLASS.make(&keywords.0)
    }};
}
pub(crate) use record;

/// A list of results as a Python tuple.
pub(crate) fn tuple<'py>(
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
    let [normal, transverse, torque, push] = parts;
    record!(py, "centrode._slider_force" "SliderForce", () => []
        normal: normal,
        transverse: transverse,
        torque: torque,
        push: push,
    )
}

/// Forces of a machine: the torque of its input, and by names drives, joints, closures, contacts, meshes and guides.
pub(crate) fn forces<'py>(
    py: Python<'py>,
    input: Course,
    parts: [Bound<'py, PyDict>; 6],
    undetermined: Vec<String>,
) -> PyResult<Bound<'py, PyAny>> {
    let [drives, joints, closures, contacts, meshes, guides] = parts;
    record!(py, "centrode._forces" "Forces", () => []
        input: input,
        drives: drives,
        joints: joints,
        closures: closures,
        contacts: contacts,
        meshes: meshes,
        guides: guides,
        undetermined: PyTuple::new(py, undetermined)?,
    )
}

/// A remedy of a pair with the pair that it makes.
pub(crate) fn remedy<'py>(
    py: Python<'py>,
    remedy: &PairRemedy,
    pair: &Py<PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    record!(py, "centrode._remedy" "PairRemedy", remedy => [minimum_tooth_count]
        addendum: remedy.addendum.word(),
        fit: PyTuple::new(py, remedy.fit.iter().map(|fit| fit.word()))?,
        pair: pair,
    )
}

/// Clearance of two arms.
pub(crate) fn clearance<'py>(py: Python<'py>, found: &Clearance) -> PyResult<Bound<'py, PyAny>> {
    record!(py, "centrode._clearance" "Clearance", found => [minimum, lower_bound, input]
        arms: PyTuple::new(py, found.pair)?,
    )
}

/// A report on a design.
pub(crate) fn report<'py>(
    py: Python<'py>,
    report: &Report,
    design: &dyn Design,
) -> PyResult<Bound<'py, PyAny>> {
    let units = report.units().into_iter();
    let units = units.map(|(key, unit)| (key, unit.symbol()));
    record!(py, "centrode._report" "Report", report => []
        ok: report.ok(),
        findings: tuple(py, report.findings.iter().map(|f| finding(py, f)))?,
        values: report.values.clone(),
        units: units.collect::<BTreeMap<_, _>>(),
        given: report.given(design),
        goals: goals(py, &report.goals)?,
        tables: tuple(py, report.tables.iter().map(|t| table(py, t)))?,
    )
}

/// Findings.
pub(crate) fn findings<'py>(
    py: Python<'py>,
    findings: &[Finding],
) -> PyResult<Bound<'py, PyTuple>> {
    tuple(py, findings.iter().map(|f| finding(py, f)))
}

/// Result of a search.
pub(crate) fn optimised<'py>(
    py: Python<'py>,
    mechanism: Bound<'py, PyAny>,
    found: &Found,
) -> PyResult<Bound<'py, PyAny>> {
    let progress =
        |at: &Progress| (at.evaluations, at.violation, at.objective).into_bound_py_any(py);
    let steps: Vec<String> = found.steps.iter().map(ToString::to_string).collect();
    let ended = match found.ended {
        Ended::Target => "target",
        Ended::Evaluations => "evaluations",
        Ended::Stopped => "stopped",
        Ended::Stuck => "stuck",
    };
    record!(py, "centrode._optimised" "Optimised", found => []
        mechanism: mechanism,
        goals: goals(py, &found.goals)?,
        steps: PyTuple::new(py, steps)?,
        evaluations: found.progress.map_or(0, |p| p.evaluations),
        ended: ended,
        history: tuple(py, found.history.iter().map(progress))?,
        remark: found.remark.as_deref(),
    )
}

/// The goals of a mechanism.
pub(crate) fn goals<'py>(py: Python<'py>, goals: &[Goal]) -> PyResult<Bound<'py, PyTuple>> {
    let one = |goal: &Goal| {
        record!(py, "centrode._goal" "Goal", goal => [number, paper, value, scale, margin, progress]
            name: &*goal.name,
            title: &*goal.title,
            unit: goal.unit.symbol(),
            required: PyTuple::new(py, goal.required)?,
            met: goal.met(),
        )
    };
    tuple(py, goals.iter().map(one))
}

/// The parts of a machine.
pub(crate) fn parts<'py>(
    py: Python<'py>,
    machine: &LinkedMachine,
) -> PyResult<Bound<'py, PyTuple>> {
    let one = |part: &Part| {
        let links = part.links.iter().map(|&link| &machine.links[link].name);
        record!(py, "centrode._part" "Part", () => []
            name: &part.name,
            quantity: part.quantity(),
            links: PyTuple::new(py, links.collect::<Vec<_>>())?,
            material: &part.material,
            mass: part.mass,
            file: &part.file,
            remark: &part.remark,
        )
    };
    tuple(py, machine.parts.iter().map(one))
}

fn table<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyAny>> {
    let rows = PyDict::new(py);
    for (name, figures) in &table.rows {
        rows.set_item(name, PyTuple::new(py, figures)?)?;
    }
    record!(py, "centrode._report" "Table", table => [name, title]
        unit: table.unit.symbol(),
        columns: PyTuple::new(py, &table.columns)?,
        rows: rows,
    )
}

fn finding<'py>(py: Python<'py>, finding: &Finding) -> PyResult<Bound<'py, PyAny>> {
    let severity = match finding.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let flanks = finding.place.flanks.iter();
    let flanks = flanks
        .map(|flank| record!(py, "centrode._report" "FlankPlace", flank => [tooth, side, radius]));
    let place = record!(py, "centrode._report" "Place", finding.place => [input]
        part: finding.place.part.as_deref(),
        teeth: PyTuple::new(py, &finding.place.teeth)?,
        flanks: tuple(py, flanks)?,
    )?;
    record!(py, "centrode._report" "Finding", finding => [rule, measured, required]
        remedy: finding.remedy.as_deref(),
        unit: finding.unit.symbol(),
        severity: severity,
        message: finding.message.as_str(),
        place: place,
    )
}

/// A contact analysis.
pub(crate) fn contact(py: Python<'_>, contact: Contact) -> PyResult<Bound<'_, PyAny>> {
    let array = |values: Vec<f64>| values.into_pyarray(py);
    record!(py, "centrode._contact" "Contact", contact => []
        contacts: contact.contacts.into_pyarray(py),
        input: array(contact.input),
        law: array(contact.law),
        driven_angle: array(contact.driven_angle),
        reverse_driven_angle: array(contact.reverse_driven_angle),
        transmission_error: array(contact.transmission_error),
        reverse_transmission_error: array(contact.reverse_transmission_error),
        backlash: array(contact.backlash),
        normal_backlash: array(contact.normal_backlash),
        penetration: array(contact.penetration),
        clearance: array(contact.clearance),
        fillet_clearance: array(contact.fillet_clearance),
        sliding: array(contact.sliding),
    )
}

/// Pins in the spaces of a gear.
pub(crate) fn over_pins<'py>(py: Python<'py>, over: &OverPins) -> PyResult<Bound<'py, PyAny>> {
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
    let across = across
        .iter()
        .map(|a| a.map_or(f64::NAN, |(_, measure)| measure));
    record!(py, "centrode._over_pins" "OverPins", over => [diameter]
        center: center.into_pyarray(py).reshape([rows, 2])?,
        contacts: contacts.into_pyarray(py).reshape([rows, 2, 2])?,
        radial: radial.into_pyarray(py),
        partner: partner.collect::<Vec<i64>>().into_pyarray(py),
        across: across.collect::<Vec<f64>>().into_pyarray(py),
        faults: PyTuple::new(py, faults.collect::<Vec<_>>())?,
    )
}

/// The teeth of a gear, in order.
pub(crate) fn teeth<'py>(py: Python<'py>, teeth: &[Tooth]) -> PyResult<Bound<'py, PyTuple>> {
    let one = |(number, tooth): (usize, &Tooth)| {
        record!(py, "centrode._tooth" "Tooth", tooth => [tip_width, cut_through]
            number: number,
            leading: side(py, &tooth.leading)?,
            trailing: side(py, &tooth.trailing)?,
        )
    };
    tuple(py, teeth.iter().enumerate().map(one))
}

fn side<'py>(py: Python<'py>, side: &ToothSide) -> PyResult<Bound<'py, PyAny>> {
    record!(
        py, "centrode._tooth" "ToothSide",
        side => [crossing, tip_height, tip_shortening, form_depth, active_depth, undercut, active, fillet_radius]
    )
}

/// Drawing sheets of a size: their files in DXF, SVG and PDF.
pub(crate) fn sheets<'py>(
    py: Python<'py>,
    size: &str,
    [dxf, svg, pdf]: &[Vec<Vec<u8>>; 3],
) -> PyResult<Bound<'py, PyAny>> {
    let files = |all: &[Vec<u8>]| PyTuple::new(py, all.iter().map(|file| PyBytes::new(py, file)));
    record!(py, "centrode._sheet" "Sheets", () => []
        size: size,
        dxf: files(dxf)?,
        svg: files(svg)?,
        pdf: PyBytes::new(py, &pdf.concat()),
    )
}

/// A cutting drawing: its files in DXF and SVG.
pub(crate) fn drawing<'py>(
    py: Python<'py>,
    [dxf, svg]: &[Vec<Vec<u8>>; 2],
) -> PyResult<Bound<'py, PyAny>> {
    record!(py, "centrode._sheet" "Drawing", () => []
        dxf: PyBytes::new(py, &dxf.concat()),
        svg: PyBytes::new(py, &svg.concat()),
    )
}

/// Dead centres of a six-bar.
pub(crate) fn dead_centers<'py>(
    py: Python<'py>,
    dead: &linkage::DeadCenters,
) -> PyResult<Bound<'py, PyAny>> {
    record!(py, "centrode._six_bar" "DeadCenters", dead => [stretched, folded]
        stretched_at: (dead.stretched_at.x, dead.stretched_at.y),
        folded_at: (dead.folded_at.x, dead.folded_at.y),
    )
}
