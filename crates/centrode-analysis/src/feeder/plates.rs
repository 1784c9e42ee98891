use centrode_geometry::{Extreme, minimum};
use centrode_machines::feeder::{Feeder, FeederPart};

use crate::{Finding, Report, Severity, Unit};

/// Checks that the links can be cut from plate, and that the effector clears the rocker's shaft.
pub(super) fn plates(feeder: &Feeder, report: &mut Report) {
    let cut = FeederPart::ALL.map(|part| (part, feeder.plate(part)));
    for (part, plate) in cut {
        let Err(error) = plate else { continue };
        report.findings.push(
            Finding::new("no-plate", Severity::Error, error.to_string())
                .measured(None, None, Unit::Millimetre)
                .on(part.name()),
        );
    }
    let room = |input: f64| feeder.shaft_clearance(input);
    let Extreme { input, value } = minimum(room, &feeder.pieces());
    report.values.insert("shaft_clearance_min", value);
    if value < 0.0 {
        report.findings.push(
            Finding::new(
                "effector-meets-shaft",
                Severity::Error,
                format!(
                    "the effector collides with the rocker's shaft: they overlap by {:.4} mm",
                    -value
                ),
            )
            .measured(value, 0.0, Unit::Millimetre)
            .remedy("narrower plates, a thinner pin, or the pivot farther from the rocker's shaft")
            .on("effector")
            .at(input),
        );
    }
}
