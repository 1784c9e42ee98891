use centrode::family::NotProved;
use centrode_analysis::forces::ForcesError;
use centrode_analysis::interference::LinkClearanceError;
use centrode_analysis::{ArmClearanceError, FeederForcesError, NoSoundTeeth};
use centrode_export::ExportError;
use centrode_formats::BundleError;
use centrode_gear::cam::CamError;
use centrode_gear::pitch::PitchError;
use centrode_gear::{BaseTangentFault, GearPairError};
use centrode_geometry::{BadTolerance, SolidError, Tolerance};
use centrode_groove::ShaftError;
use centrode_kinematics::linkage::{FourBarError, SixBarError};
use centrode_machines::arm::ArmError;
use centrode_machines::three_arm::PusherError;
use centrode_optimise::SearchError;
use centrode_spec::{DesignError, DesignFault, MechanismError, SpecError, shortened};
use centrode_synthesis::optimise::feeder::NotWidened;
use centrode_synthesis::optimise::{EasingError, NotSearched};
use centrode_synthesis::reverse::{
    AxisFault, GearDriveError, NotPosed, PathError, PoseError, ReversedMachineError, SplitError,
};
use pyo3::exceptions::PyOSError;
use pyo3::prelude::{PyErr, Python};
use std::error::Error;

/// The exceptions, as the Python part of the package defines them.
pub(crate) mod class {
    pyo3::import_exception!(centrode._error, DesignError);
    pyo3::import_exception!(centrode._error, PitchError);
    pyo3::import_exception!(centrode._error, GearPairError);
    pyo3::import_exception!(centrode._error, CamError);
    pyo3::import_exception!(centrode._error, LinkageError);
    pyo3::import_exception!(centrode._error, MechanismError);
    pyo3::import_exception!(centrode._error, ExportError);
    pyo3::import_exception!(centrode._error, InternalError);
}

/// An exception to raise: whatever goes wrong in the crates becomes one.
#[derive(Debug)]
pub(crate) struct Raised(PyErr);

/// Answer to a call from Python, or the exception it raises.
pub(crate) type Answer<T> = Result<T, Raised>;

impl From<Raised> for PyErr {
    fn from(Raised(exception): Raised) -> Self {
        exception
    }
}

impl From<PyErr> for Raised {
    fn from(exception: PyErr) -> Self {
        Self(exception)
    }
}

/// Exceptions of errors: for each case the class, and the key of the design that is to blame, empty for none.
macro_rules! raised {
    ($($error:ty { $($case:pat => $class:ident($key:expr),)* })*) => {
        $(impl From<$error> for Raised {
            fn from(error: $error) -> Self {
                let message = shortened(&error.to_string());
                Self(match error {
                    $($case => class::$class::new_err((message, String::from($key))),)*
                })
            }
        })*
    };
}

raised! {
    SpecError { error => DesignError(error.key), }
    NotProved { NotProved::Teeth(error) => GearPairError(error.key()), NotProved::Pair { .. } => GearPairError(""), _ => MechanismError(""), }
    BadTolerance { _ => DesignError("tolerance"), }
    PitchError { error => PitchError(format!("pitch.{}", error.key())), }
    PusherError { error => MechanismError(error.key()), }
    ArmError { _ => MechanismError("arm.body"), }
    ArmClearanceError { _ => MechanismError("arm.body"), }
    FeederForcesError { _ => MechanismError("plates"), }
    ForcesError { _ => MechanismError(""), }
    LinkClearanceError { _ => MechanismError("plates"), }
    BaseTangentFault { _ => MechanismError(""), }
    NotSearched { _ => MechanismError("optimise"), }
    NotWidened { _ => MechanismError("optimise"), }
    SearchError { _ => MechanismError("optimise"), }
    PathError { _ => DesignError("path"), }
    EasingError {
        EasingError::Path(_) => DesignError("path"),
        EasingError::Axis(_) | EasingError::NoAxis { .. } | EasingError::NoReturn { .. } => MechanismError("axis"),
        EasingError::TooFew { .. } => DesignError("path"),
        EasingError::Module { .. } => DesignError("module"),
        EasingError::Wish(error) => DesignError(format!("wishes.{}", error.key)),
        _ => DesignError("band"),
    }
    PoseError {
        PoseError::Path(_) | PoseError::Count { .. } | PoseError::OnePlace => DesignError("poses"),
        _ => MechanismError("poses"),
    }
    AxisFault { _ => MechanismError("axis"), }
    SplitError { _ => MechanismError("split"), }
    NotPosed { _ => MechanismError("poses"), }
    NoSoundTeeth { _ => MechanismError("pairs"), }
    ReversedMachineError {
        ReversedMachineError::Arms { .. } => DesignError("arms"),
        ReversedMachineError::Steps { .. } => DesignError("steps"),
        _ => MechanismError("split"),
    }
    GearDriveError {
        GearDriveError::Distance { .. } => DesignError("center_distance"),
        GearDriveError::Direction { .. } => DesignError("direction_deg"),
        GearDriveError::NoCrank { .. } => DesignError("body"),
        _ => MechanismError("goals"),
    }
    CamError {
        CamError::Spec(error) => DesignError(error.key),
        error => CamError(error.key()),
    }
    FourBarError {
        FourBarError::Length { name, .. } => DesignError(name),
        _ => LinkageError(""),
    }
    SixBarError {
        SixBarError::Value { .. } => DesignError(""),
        SixBarError::PivotOnPath { .. } => LinkageError("pivot"),
        _ => LinkageError(""),
    }
}

/// Errors whose rule at fault is named by their mechanism's.
macro_rules! of_mechanism {
    ($($error:ty),*) => {
        $(impl From<$error> for Raised {
            fn from(error: $error) -> Self {
                MechanismError::from(error).into()
            }
        })*
    };
}

of_mechanism!(GearPairError, ShaftError);

impl From<MechanismError> for Raised {
    fn from(MechanismError { key, fault }: MechanismError) -> Self {
        let message = match &fault {
            DesignFault::Value(rule) => format!("{key} {rule}"),
            fault => fault.to_string(),
        };
        Self::of_fault(&fault, (message, key, None, None))
    }
}

impl From<DesignError> for Raised {
    fn from(error: DesignError) -> Self {
        let message = error.to_string();
        let place = (Some(error.line), Some(error.column));
        Self::of_fault(&error.fault, (message, error.key, place.0, place.1))
    }
}

impl From<SolidError> for Raised {
    fn from(error: SolidError) -> Self {
        let message = error.to_string();
        Self(match error {
            SolidError::NoHeight { .. } => class::DesignError::new_err((message, "width")),
            _ => class::ExportError::new_err(message),
        })
    }
}

impl From<ExportError> for Raised {
    fn from(error: ExportError) -> Self {
        Self(class::ExportError::new_err(error.to_string()))
    }
}

impl From<BundleError> for Raised {
    fn from(error: BundleError) -> Self {
        let exception = class::ExportError::new_err(error.to_string());
        let system = error.source();
        if let Some(reason) = system.and_then(|e| e.downcast_ref::<std::io::Error>()) {
            // Python picks the class, such as PermissionError, by the number.
            let cause = PyOSError::new_err((reason.raw_os_error(), reason.to_string()));
            Python::attach(|py| exception.set_cause(py, Some(cause)));
        }
        Self(exception)
    }
}

/// Message, key, line and column: the arguments of a design's exceptions.
type Arguments = (String, String, Option<usize>, Option<usize>);

impl Raised {
    /// The exception of a design that cannot be, by what of it cannot.
    fn of_fault(fault: &DesignFault, arguments: Arguments) -> Self {
        Self(match fault {
            DesignFault::Mechanism(e) if e.is::<PitchError>() => {
                class::PitchError::new_err(arguments)
            }
            DesignFault::Mechanism(e) if e.is::<GearPairError>() => {
                class::GearPairError::new_err(arguments)
            }
            DesignFault::Mechanism(_) => class::MechanismError::new_err(arguments),
            _ => class::DesignError::new_err(arguments),
        })
    }

    /// The exception of a value that breaks a rule at a key.
    pub(crate) fn rule(key: &str, rule: &str) -> Self {
        Self::sentence(key, format!("{key} {rule}"))
    }

    /// The exception of a key, in a sentence that names it or need not.
    pub(crate) fn sentence(key: &str, sentence: String) -> Self {
        Self(class::DesignError::new_err((sentence, key.to_owned())))
    }

    /// The exception of a word that is none of those allowed.
    pub(crate) fn word(key: &str, word: &str, known: &[&str]) -> Self {
        let known = known.join(", ");
        Self::rule(key, &format!("must be one of {known}, not {word:?}"))
    }

    /// The exception of a value with which there is no mechanism, in a sentence.
    pub(crate) fn no_mechanism(key: &str, sentence: String) -> Self {
        Self(class::MechanismError::new_err((sentence, key.to_owned())))
    }

    /// The exception of a search that has come to nothing.
    pub(crate) fn no_search(reason: &str) -> Self {
        let arguments = (reason.to_owned(), "optimise");
        Self(class::MechanismError::new_err(arguments))
    }
}

/// A number, if it is finite.
pub(crate) fn finite(key: &str, value: f64) -> Answer<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    let rule = format!("must be a finite number, not {value}");
    Err(Raised::rule(key, &rule))
}

/// A length, if it is finite and greater than zero.
pub(crate) fn positive(key: &str, value: f64) -> Answer<f64> {
    if finite(key, value)? > 0.0 {
        return Ok(value);
    }
    let rule = format!("must be greater than 0, not {value}");
    Err(Raised::rule(key, &rule))
}

/// A tolerance of what is exact at every one that has a meaning.
pub(crate) fn plain_tolerance(mm: f64) -> Answer<Tolerance> {
    tolerance(mm, centrode::family::FINEST)
}

/// A tolerance, if it is a length and no finer than what it is of, mm.
pub(crate) fn tolerance(mm: f64, finest: f64) -> Answer<Tolerance> {
    let tolerance = Tolerance::new(mm)?;
    if mm < finest {
        let sentence = format!("tolerance must be at least {finest:e} mm, not {mm:e}");
        return Err(Raised::sentence("tolerance", sentence));
    }
    Ok(tolerance)
}
