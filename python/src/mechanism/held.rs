//! How an object of Python holds its machine, and asks it.

use std::sync::{Arc, OnceLock};

use centrode::family::{self, Family};
use centrode::meshing;
use centrode_export::machine::tabulated;
use centrode_export::{Bundle, Format};
use centrode_mechanism::machine::Machine;
use pyo3::prelude::{Bound, PyAny, PyClassInitializer, PyResult, Python};

use super::Mechanism;
use crate::array::Values;
use crate::design::named;
use crate::error::{Answer, finite, tolerance as within};
use crate::files;
use crate::forces::{self, Names};
use crate::wait::wait;

impl Mechanism {
    /// The machine as what a new object of a subclass begins with.
    pub(crate) fn start<M: family::Mechanism>(machine: &Arc<M>) -> PyClassInitializer<Self> {
        let machine = Arc::clone(machine) as Arc<dyn family::Mechanism>;
        Self(machine, OnceLock::new()).into()
    }

    pub(super) fn family(&self) -> Answer<&'static Family> {
        named(self.0.design().family().word)
    }

    /// Asks the machine something that may take long.
    pub(super) fn ask<T: Send + 'static>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&dyn family::Mechanism) -> T + Send + 'static,
    ) -> PyResult<T> {
        let machine = Arc::clone(&self.0);
        wait(py, move || ask(machine.as_ref()))
    }

    pub(super) fn links(&self, py: Python<'_>) -> Answer<Arc<Machine>> {
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
        formats: Option<Vec<String>>,
        parts: Option<Vec<String>>,
        tolerance: f64,
        [dxf_version, dxf_curves]: [&str; 2],
    ) -> Answer<Bundle> {
        let tolerance = within(tolerance, self.0.accuracy())?;
        let formats = files::formats(formats, &Format::ALL)?;
        let mut options = files::options(tolerance, dxf_version, dxf_curves)?;
        options.parts = files::parts(parts, self.family()?.parts)?;
        Ok(self.ask(py, move |machine| {
            if formats.contains(&Format::Sheet) || formats.contains(&Format::Pdf) {
                options.sheet.meshing = meshing(&machine.check());
            }
            machine.files(&formats, &options)
        })??)
    }
}
