use std::error::Error;

use centrode_export::BundleError;
use centrode_export::cam::CamFilesError;
use centrode_export::gear_pair::GearPairFilesError;
use centrode_export::three_arm::ThreeArmFilesError;
use centrode_geometry::{SolidError, Tolerance};
use centrode_mechanism::cam;
use centrode_mechanism::design::{self, DesignFault};
use centrode_mechanism::gear::design::SpecError;
use centrode_mechanism::gear::{self, pitch};
use centrode_mechanism::linkage::{FourBarError, SixBarError};
use centrode_mechanism::shaft::ShaftError;
use centrode_mechanism::three_arm::{PusherError, ThreeArmError};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::{PyErr, PyResult, Python};

use crate::design::Class;

/// The exceptions, as the Python part of the package defines them.
mod class {
    pyo3::import_exception!(centrode._error, DesignError);
    pyo3::import_exception!(centrode._error, PitchError);
    pyo3::import_exception!(centrode._error, GearPairError);
    pyo3::import_exception!(centrode._error, CamError);
    pyo3::import_exception!(centrode._error, LinkageError);
    pyo3::import_exception!(centrode._error, MechanismError);
    pyo3::import_exception!(centrode._error, ExportError);
}

/// A design that breaks a rule at a key.
pub(crate) fn design_error(key: &str, rule: &str) -> PyErr {
    class::DesignError::new_err((format!("{key} {rule}"), key.to_owned()))
}

/// A word that is none of those allowed.
pub(crate) fn unknown_word(key: &str, word: &str, known: &[&str]) -> PyErr {
    let known = known.join(", ");
    design_error(key, &format!("must be one of {known}, not {word:?}"))
}

/// The exception of a value that breaks a rule of its own.
pub(crate) fn of_spec(error: &SpecError) -> PyErr {
    class::DesignError::new_err((error.to_string(), error.key.clone()))
}

/// The exception of a pitch curve's error.
pub(crate) fn of_pitch(error: &pitch::PitchError) -> PyErr {
    class::PitchError::new_err((error.to_string(), format!("pitch.{}", error.key())))
}

/// The exception of a gear pair's error: the innermost rule broken.
pub(crate) fn of_pair(error: &gear::GearPairError) -> PyErr {
    match error {
        gear::GearPairError::Spec(error) => of_spec(error),
        gear::GearPairError::Pitch(error) => of_pitch(error),
        _ => class::GearPairError::new_err((error.to_string(), error.key())),
    }
}

/// The exception of a design file's error, with its place.
pub(crate) fn of_design(error: &design::DesignError) -> PyErr {
    let arguments = (
        error.to_string(),
        error.key.clone(),
        error.line,
        error.column,
    );
    match &error.fault {
        DesignFault::Mechanism(e) if e.is::<pitch::PitchError>() => {
            class::PitchError::new_err(arguments)
        }
        DesignFault::Mechanism(e) if e.is::<gear::GearPairError>() => {
            class::GearPairError::new_err(arguments)
        }
        DesignFault::Mechanism(_) => class::MechanismError::new_err(arguments),
        _ => class::DesignError::new_err(arguments),
    }
}

/// The exception of a cam's error: the innermost rule broken.
pub(crate) fn of_cam(error: &cam::CamError) -> PyErr {
    match error {
        cam::CamError::Spec(error) => of_spec(error),
        _ => class::CamError::new_err((error.to_string(), error.key())),
    }
}

/// The exception of a cam's files that cannot be made.
pub(crate) fn of_cam_files(error: &CamFilesError) -> PyErr {
    class::ExportError::new_err(error.to_string())
}

/// The exception of a spiral shaft's error.
pub(crate) fn of_shaft(error: &ShaftError) -> PyErr {
    class::DesignError::new_err((error.to_string(), error.key()))
}

/// The exception of a mechanism's files that cannot be made.
pub(crate) fn of_mechanism_files(error: &dyn Error) -> PyErr {
    class::ExportError::new_err(error.to_string())
}

/// The exception of a three-arm mechanism's files that cannot be made.
pub(crate) fn of_three_arm_files(error: &ThreeArmFilesError) -> PyErr {
    class::ExportError::new_err(error.to_string())
}

/// A number, if it is finite.
pub(crate) fn finite(key: &str, value: f64) -> PyResult<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(design_error(
        key,
        &format!("must be a finite number, not {value}"),
    ))
}

/// A length, if it is finite and greater than zero.
pub(crate) fn positive(key: &str, value: f64) -> PyResult<f64> {
    if finite(key, value)? > 0.0 {
        return Ok(value);
    }
    Err(design_error(
        key,
        &format!("must be greater than 0, not {value}"),
    ))
}

/// A tolerance for what is exact at every one.
pub(crate) fn plain_tolerance(mm: f64) -> PyResult<Tolerance> {
    let finest = 1e-9;
    if mm < finest {
        let message = format!("tolerance must be at least {finest:e} mm, not {mm:e}");
        return Err(class::DesignError::new_err((message, "tolerance")));
    }
    Tolerance::new(mm).map_err(|e| class::DesignError::new_err((e.to_string(), "tolerance")))
}

/// The exception of files that cannot be made.
pub(crate) fn of_files(error: &GearPairFilesError) -> PyErr {
    class::ExportError::new_err(error.to_string())
}

/// The exception of files that cannot be written; its cause is the system's own.
pub(crate) fn of_bundle(py: Python<'_>, error: &BundleError) -> PyErr {
    let exception = class::ExportError::new_err(error.to_string());
    let system = error
        .source()
        .and_then(|e| e.downcast_ref::<std::io::Error>());
    if let Some(reason) = system {
        // Python picks the class, such as PermissionError, by the number.
        let cause = PyOSError::new_err((reason.raw_os_error(), reason.to_string()));
        exception.set_cause(py, Some(cause));
    }
    exception
}

/// A tolerance, if it is a positive length and no finer than a pair's outlines are exact.
pub(crate) fn tolerance(mm: f64, pair: &gear::GearPair) -> PyResult<Tolerance> {
    let refused = |message: String| class::DesignError::new_err((message, "tolerance"));
    let tolerance = Tolerance::new(mm).map_err(|e| refused(e.to_string()))?;
    let accuracy = pair.accuracy();
    if mm < accuracy {
        let message = format!(
            "tolerance must be at least {accuracy:e} mm, as exact as the outline is, not {mm:e}"
        );
        return Err(refused(message));
    }
    Ok(tolerance)
}

/// A family that only the command line knows.
pub(crate) fn not_in_python(family: &str) -> PyErr {
    let message = format!("{family:?} has no class here: use the command line on it");
    class::DesignError::new_err((message, "family"))
}

/// A design of another family where one of this is wanted.
pub(crate) fn not_of_family<C: Class>() -> PyErr {
    let family = C::family().design.word;
    class::DesignError::new_err((format!("family must be {family:?}"), "family"))
}

/// The exception of a three-arm mechanism's error: the innermost rule broken.
pub(crate) fn of_three_arm(error: &ThreeArmError) -> PyErr {
    match error {
        ThreeArmError::Gears(error) => of_pair(error),
        _ => class::MechanismError::new_err((error.to_string(), error.key())),
    }
}

/// The exception of a push rod that cannot be moved.
pub(crate) fn of_pusher(error: &PusherError) -> PyErr {
    class::MechanismError::new_err((error.to_string(), error.key()))
}

/// The exception of links that are no plates, or have no balance.
pub(crate) fn of_plates(error: &impl Error) -> PyErr {
    class::MechanismError::new_err((error.to_string(), "plates"))
}

/// The exception of an arm that is no body.
pub(crate) fn of_arm(error: &impl Error) -> PyErr {
    class::MechanismError::new_err((error.to_string(), "arm.body"))
}

/// The exception of a search that cannot be made.
pub(crate) fn no_search(reason: &str) -> PyErr {
    class::MechanismError::new_err((reason.to_owned(), "optimise"))
}

/// The exception of a gear that is no solid.
pub(crate) fn of_solid(error: &SolidError) -> PyErr {
    match error {
        SolidError::NoHeight { .. } => class::DesignError::new_err((error.to_string(), "width")),
        _ => class::ExportError::new_err(error.to_string()),
    }
}

/// The exception of lengths that make no four-bar.
pub(crate) fn of_four_bar(error: &FourBarError) -> PyErr {
    match error {
        FourBarError::Length { name, .. } => {
            class::DesignError::new_err((error.to_string(), *name))
        }
        _ => class::LinkageError::new_err(error.to_string()),
    }
}

/// The exception of a six-bar that cannot turn.
pub(crate) fn of_six_bar(error: &SixBarError) -> PyErr {
    match error {
        SixBarError::Value { .. } => class::DesignError::new_err(error.to_string()),
        SixBarError::PivotOnPath { .. } => {
            class::LinkageError::new_err((error.to_string(), "pivot"))
        }
        _ => class::LinkageError::new_err(error.to_string()),
    }
}
