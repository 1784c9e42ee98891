//! Python face of centrode: moves values across, no arithmetic.

use pyo3::prelude::pymodule;

mod array;
mod error;
mod gear_pair;
mod pitch;
mod tool;

/// Native part of the `centrode` package.
#[pymodule]
mod _centrode {
    use pyo3::prelude::{Bound, PyModule, PyModuleMethods, PyResult};

    #[pymodule_export]
    use crate::error::{DesignError, Error, GearPairError, PitchError};
    #[pymodule_export]
    use crate::gear_pair::{Gear, GearPair};
    #[pymodule_export]
    use crate::pitch::{
        Pitch, bezier, bspline, circle, eccentric_circle, ellipse, from_ratio, from_transmission,
        limacon, lobed_ellipse, polar,
    };
    #[pymodule_export]
    use crate::tool::{Rack, Shaper};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
