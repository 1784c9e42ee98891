use centrode_mechanism::gear::{self, pitch};
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

create_exception!(
    centrode,
    GearPairError,
    DesignError,
    "A gear pair that cannot exist: curves that do not roll, teeth that leave no contour."
);

/// The Python exception of a gear pair's error: the innermost rule broken.
pub(crate) fn of_pair(error: &gear::GearPairError) -> PyErr {
    match error {
        gear::GearPairError::Spec(_) => DesignError::new_err(error.to_string()),
        gear::GearPairError::Pitch(error) => of_pitch(error),
        _ => GearPairError::new_err(format!("{}: {error}", error.key())),
    }
}

/// The Python exception of a pitch curve's error.
pub(crate) fn of_pitch(error: &pitch::PitchError) -> PyErr {
    PitchError::new_err(error.to_string())
}
