use centrode_kinematics::machine::{Fastening, FasteningError};

use crate::{Finding, Severity, Unit};

/// Finding if screws are requested for plates and none are found; `None` otherwise. `plates` names the plates in the message.
pub(crate) fn no_screws(
    part: &str,
    plates: &str,
    screws: Option<Result<Fastening, FasteningError>>,
    remedy: &'static str,
) -> Option<Finding> {
    let error = screws?.err()?;
    let (measured, required) = match &error {
        FasteningError::TooShort {
            between, minimum, ..
        } => (Some(*between), Some(2.0 * minimum)),
        _ => (None, None),
    };
    Some(
        Finding::new(
            "no-screws",
            Severity::Warning,
            format!("nothing holds {plates} together: {error}"),
        )
        .measured(measured, required, Unit::Millimetre)
        .remedy(remedy)
        .on(part),
    )
}
