use centrode_kinematics::machine::Bearing;
use centrode_machines::three_arm::ThreeArm;

use crate::{Finding, Report, Severity, Unit};

/// Reports shafts for which bearings are requested, but no bearing is narrow enough for the carrier's plates.
pub(super) fn check_bearings(mechanism: &ThreeArm, report: &mut Report) {
    let design = mechanism.design();
    let wall = design.gearbox.wall;
    if !design.gearbox.bearings {
        return;
    }
    for (part, body) in [
        ("sun", &design.sun),
        ("intermediate", &design.intermediate),
        ("planet", &design.planet),
    ] {
        let bore = body.bore;
        if bore == 0.0 || mechanism.bearing(bore).is_some() {
            continue;
        }
        let narrowest = Bearing::narrowest(bore).map(|bearing| bearing.width);
        let why = match narrowest {
            Some(width) => format!(
                "the narrowest bearing is {width} mm wide, but the plates of the carrier are {wall} mm thick"
            ),
            None => format!("no bearing of series 618, 60 and 62 has a bore of {bore} mm"),
        };
        Finding::new(
            "no-bearing",
            Severity::Warning,
            format!("the {bore} mm shaft of the {part} runs in the plates without bearings: {why}"),
        )
        .measured(wall, narrowest, Unit::Millimetre)
        .remedy("thicker plates (wall), or a bore of 5 to 10, 12, 15, 17, 20, 25, 30, 35 or 40 mm")
        .on(part)
        .add_to(report);
    }
}
