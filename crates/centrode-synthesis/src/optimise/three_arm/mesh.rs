use centrode_gear::GearPair;
use centrode_gear::design::{Addendum, GearPairDesign, TeethSpec};
use centrode_machines::three_arm::design::ThreeArmDesign;

use super::evaluation::constraint;
use centrode_analysis::{Goal, SLIGHT_TRANSMISSION_ERROR, Severity, Unit, check};

/// Excess of the transmission error at which its goal has half its progress, rad.
const ERROR: f64 = 1e-3;

/// Goals of number zero for a mechanism's full teeth in mesh, over a whole cycle: the flanks transmit the motion, and there is no
/// finding against the teeth. `None` if no teeth can be cut.
///
/// A planet is the same part as the sun, and planet and intermediate gear are the pair of sun and intermediate gear: one pair
/// represents all six meshes.
pub(super) fn mesh(design: &ThreeArmDesign) -> Option<[Goal; 2]> {
    let pair = design.pair();
    let full = GearPairDesign {
        teeth: TeethSpec {
            addendum: Addendum::Full,
            ..pair.teeth.clone()
        },
        ..pair
    };
    let pair = GearPair::resolve(&full).ok()?;
    let report = check(&pair);
    let error = report.values.get("transmission_error_max").copied();
    let worse = report
        .findings
        .iter()
        .filter(|f| f.severity >= Severity::Warning);
    // Lost contact and the jumps that follow count as transmission error; the pressure angle depends on the pitch curve.
    let other = ["contact-lost", "seat-jump", "pressure-angle"];
    let against = worse.filter(|f| !other.contains(&f.rule)).count();
    Some([
        constraint(
            "transmission-error",
            "full teeth: transmission error",
            Unit::Angle,
        )
        .maximum(SLIGHT_TRANSMISSION_ERROR, ERROR)
        .with(error.filter(|error| error.is_finite()).unwrap_or(1.0)),
        constraint(
            "tooth-findings",
            "full teeth: number of findings",
            Unit::Count,
        )
        .maximum(0.0, 10.0)
        .with(against as f64),
    ])
}
