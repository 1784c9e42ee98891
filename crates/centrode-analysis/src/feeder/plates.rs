use centrode_geometry::bracketed_minimum;
use centrode_mechanism::feeder::{Feeder, Part};

use crate::{Finding, Place, Report, Severity};

/// Looks over the motion for where the effector comes near the rocker's shaft.
const LOOKS: u32 = 1440;

/// Whether the links can be cut from plate, and run clear of the shaft that passes them.
pub(super) fn plates(feeder: &Feeder, report: &mut Report) {
    let cut = Part::ALL.map(|part| (part, feeder.plate(part)));
    for (part, plate) in cut {
        let Err(error) = plate else { continue };
        report.findings.push(Finding {
            rule: "no-plate",
            severity: Severity::Error,
            message: error.to_string(),
            measured: None,
            required: None,
            unit: "mm",
            remedy: None,
            place: Place {
                part: Some(part.name().into()),
                ..Place::default()
            },
        });
    }
    let motion = feeder.drive().motion_angle();
    let at = |i: u32| motion * f64::from(i) / f64::from(LOOKS);
    let room = |input: f64| feeder.shaft_clearance(input);
    let nearest = (1..LOOKS)
        .min_by(|&a, &b| room(at(a)).total_cmp(&room(at(b))))
        .unwrap_or(1);
    let (input, least) = bracketed_minimum(room, at(nearest - 1), at(nearest + 1));
    report.values.insert("shaft_clearance_min", least);
    if least < 0.0 {
        report.findings.push(Finding {
            rule: "effector-meets-shaft",
            severity: Severity::Error,
            message: format!(
                "the effector runs into the rocker's shaft, which passes it: {:.4} mm too near",
                -least
            ),
            measured: Some(least),
            required: Some(0.0),
            unit: "mm",
            remedy: Some(
                "narrower plates, a thinner pin, or the pivot farther from the rocker's shaft",
            ),
            place: Place {
                part: Some("effector".into()),
                input: Some(input),
                ..Place::default()
            },
        });
    }
}
