//! Python face of centrode: moves values across, no arithmetic.

use pyo3::prelude::pymodule;

mod error;
mod pitch;

/// Native part of the `centrode` package.
#[pymodule]
mod _centrode {
    use pyo3::prelude::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_export]
    use crate::error::{DesignError, Error, PitchError};
    #[pymodule_export]
    use crate::pitch::{Pitch, bezier, bspline, circle, eccentric_circle, ellipse, lobed_ellipse};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
