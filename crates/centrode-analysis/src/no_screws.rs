use centrode_kinematics::machine::{Fastening, FasteningError};

use crate::{Finding, Place, Severity, Unit};

/// Finding of plates, by the part and in words, for which screws are asked and none are found; none where they are.
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
    Some(Finding {
        rule: "no-screws",
        severity: Severity::Warning,
        message: format!("nothing holds {plates} together: {error}"),
        measured,
        required,
        unit: Unit::Millimetre,
        remedy: Some(remedy),
        place: Place {
            part: Some(part.into()),
            ..Place::default()
        },
    })
}
