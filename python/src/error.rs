use centrode_mechanism::gear::pitch;
use pyo3::{PyErr, create_exception, exceptions::PyException};

create_exception!(
    centrode,
    Error,
    PyException,
    "There is no mechanism: base of every error of this package."
);
create_exception!(
    centrode,
    DesignError,
    Error,
    "A design that breaks a rule; the message names the key."
);
create_exception!(
    centrode,
    PitchError,
    DesignError,
    "A pitch curve that cannot exist."
);

/// The Python exception of a pitch curve's error.
pub(crate) fn of_pitch(error: &pitch::PitchError) -> PyErr {
    PitchError::new_err(error.to_string())
}
