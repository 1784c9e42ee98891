//! How an object of Python holds its machine, and calls it.

use crate::array::{Course, Values};
use crate::design::named;
use crate::error::{Answer, Raised, finite, tolerance as within};
use crate::forces::{self, Names};
use crate::wait::wait;
use crate::{files, solid, sweep};
use centrode::family::{self, Depth, Family};
use centrode::sheet_data;
use centrode_export::linked::tabulated;
use centrode_export::{ExportError, Options};
use centrode_formats::{Bundle, Format};
use centrode_kinematics::machine::{FrameJet, LinkedMachine};
use pyo3::prelude::{Bound, PyAny, PyClassInitializer, PyDictMethods, PyResult, Python, pyclass};
use pyo3::types::PyDict;
use std::sync::{Arc, OnceLock};

/// A machine of any family; `load` returns an object of one of its subclasses.
///
/// Two machines are equal if their designs are equal.
///
/// >>> import centrode as ct
/// >>> machine = ct.Mechanism.from_toml(ct.template("feeder"))
/// >>> type(machine).__name__, machine.name
/// ('Feeder', 'feeder')
/// >>> machine.check().ok
/// True
#[pyclass(frozen, eq, subclass, module = "centrode")]
#[derive(Debug)]
pub(crate) struct Mechanism(
    pub(super) Arc<dyn family::Mechanism>,
    /// Its links and its table of motion, made when they are first requested.
    pub(super) OnceLock<Arc<LinkedMachine>>,
);

impl PartialEq for Mechanism {
    fn eq(&self, other: &Self) -> bool {
        self.0.design() == other.0.design()
    }
}

impl Mechanism {
    /// The machine as what a new object of a subclass begins with.
    pub(crate) fn start<M: family::Mechanism>(machine: &Arc<M>) -> PyClassInitializer<Self> {
        let machine = Arc::clone(machine) as Arc<dyn family::Mechanism>;
        Self(machine, OnceLock::new()).into()
    }

    pub(super) fn family(&self) -> Answer<&'static Family> {
        named(self.0.design().family().word)
    }

    /// Runs a long computation on the machine.
    pub(super) fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&dyn family::Mechanism) -> T + Send + 'static,
    ) -> PyResult<T> {
        let machine = Arc::clone(&self.0);
        wait(py, move || ask(machine.as_ref()))
    }

    pub(super) fn links(&self, py: Python<'_>) -> Answer<Arc<LinkedMachine>> {
        if let Some(known) = self.1.get() {
            return Ok(Arc::clone(known));
        }
        let made = self.ask(py, |machine| machine.machine().map(tabulated))??;
        Ok(Arc::clone(self.1.get_or_init(|| Arc::new(made))))
    }

    /// Forces at inputs and a speed, by names.
    pub(crate) fn forces_by<'py>(
        &self,
        py: Python<'py>,
        phi: Values,
        speed: Option<f64>,
        names: Names,
    ) -> Answer<Bound<'py, PyAny>> {
        let machine = self.links(py)?;
        let speed = finite("speed", speed.unwrap_or(machine.input.speed))?;
        forces::found(py, machine, (phi.finite()?, speed), names)
    }

    pub(super) fn bundle(
        &self,
        py: Python<'_>,
        formats: Option<files::Named>,
        parts: Option<Vec<String>>,
        tolerance: Option<f64>,
        written: [&str; 3],
        kerf: Option<f64>,
    ) -> Answer<Bundle> {
        let (formats, usual) = files::formats(formats, &Format::ALL)?;
        let tolerance = within(tolerance.unwrap_or(usual), self.0.accuracy())?;
        let mut options = files::options(tolerance, written, kerf)?;
        options.parts = files::parts(parts, self.family()?.parts)?;
        Ok(self.ask(py, move |machine| {
            if formats.contains(&Format::Sheet) || formats.contains(&Format::Pdf) {
                options.sheet.found = sheet_data(&machine.check());
            }
            machine.files(&formats, &options)
        })??)
    }

    /// Frames of the links at inputs, by name.
    pub(super) fn framed<'py>(&self, py: Python<'py>, phi: Values) -> Answer<Bound<'py, PyDict>> {
        let machine = self.links(py)?;
        let frames = PyDict::new(py);
        for (index, link) in machine.links.iter().enumerate() {
            let machine = Arc::clone(&machine);
            let frame = move |phi| -> [f64; 16] {
                let FrameJet([frame, ..]) = machine.link_frame(index, phi);
                std::array::from_fn(|i| frame[(i / 4, i % 4)])
            };
            let frames_of = Course::arrays(phi.clone(), &[4, 4], frame);
            frames.set_item(&link.name, frames_of)?;
        }
        Ok(frames)
    }

    /// Extrusions of parts, by name.
    pub(super) fn kept_solids<'py>(
        &self,
        py: Python<'py>,
        parts: Option<Vec<String>>,
        tolerance: f64,
    ) -> Answer<Bound<'py, PyDict>> {
        let shortest = within(tolerance, self.0.accuracy())?;
        let mut options = Options::new(shortest);
        options.parts = files::parts(parts, self.family()?.parts)?;
        options.keep_solids = true;
        let bundle = self.ask(py, move |machine| machine.files(&[Format::Step], &options))?;
        let bundle = bundle.map_err(|error| match error {
            ExportError::Tolerance { .. } => Raised::sentence("tolerance", error.to_string()),
            error => error.into(),
        })?;
        solid::solids(py, bundle, shortest)
    }

    /// Goals and figures at values of one number of the design, by name.
    pub(super) fn answers<'py>(
        &self,
        py: Python<'py>,
        parameter: &str,
        values: Vec<f64>,
        depth: Depth,
    ) -> Answer<Bound<'py, PyDict>> {
        let family = *self.family()?;
        if values.is_empty() {
            return Err(Raised::rule("values", "must be at least one number"));
        }
        for &value in &values {
            finite("values", value)?;
        }
        let key = self.0.design().key_of(parameter);
        let variants: Vec<Vec<f64>> = values.into_iter().map(|value| vec![value]).collect();
        let found = self.ask(py, move |machine| {
            family.sweep(machine.design(), &[&key], &variants, depth)
        })??;
        Ok(sweep::figures(py, &found)?)
    }
}
