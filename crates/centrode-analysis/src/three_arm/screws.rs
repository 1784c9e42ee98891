use centrode_machines::three_arm::{Pusher, ThreeArm};

use crate::Report;
use crate::no_screws::no_screws;

/// Reports carrier plates and covers of the arms for which no screws are found.
pub(super) fn check_screws(mechanism: &ThreeArm, pusher: &Pusher, report: &mut Report) {
    let Ok(arm) = mechanism.arm_body() else {
        return;
    };
    let plates = [
        (
            "carrier",
            "the plates of the carrier",
            mechanism.carrier_screws(&arm),
            "a larger gearbox.housing_offset, thicker plates (gearbox.wall), or a smaller gearbox.screw",
        ),
        (
            "housing",
            "the covers of the arms",
            mechanism.cover_screws(pusher, &arm),
            "a larger housing.drum_radius or housing.tube_radius, thicker covers (housing.wall), or a smaller housing.screw",
        ),
    ];
    for (part, plates, screws, remedy) in plates {
        let found = no_screws(part, plates, screws, remedy);
        report.findings.extend(found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Finding;
    use centrode_machines::three_arm::design::ThreeArmDesign;
    use centrode_spec::DesignSpec as _;

    fn found(change: impl Fn(&mut ThreeArmDesign)) -> Vec<Finding> {
        let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
        change(&mut design);
        let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
        let mut report = Report::default();
        let pusher = mechanism.pusher().expect("a cam");
        check_screws(&mechanism, &pusher, &mut report);
        report.findings
    }

    #[test]
    fn plates_that_nothing_holds_are_told_with_the_reason() {
        assert_eq!(found(|_| {}), []);
        assert_eq!(found(|design| design.gearbox.screw = Some(0.0)), []);
        // Twelve millimetres beyond the edge are none.
        let narrow = found(|design| {
            design.gearbox.housing_offset = 0.0;
            design.gearbox.screw = Some(8.0);
        });
        assert_eq!(narrow.len(), 1, "{narrow:?}");
        assert_eq!(narrow[0].place.part.as_deref(), Some("carrier"));
        assert!(narrow[0].message.contains("M8"), "{}", narrow[0].message);
        // Threads in light alloy need one and a half diameters.
        let thick = found(|design| {
            let mut body = design.arm.usual().body;
            body.housing.screw = Some(12.0);
            design.arm.body = Some(body);
        });
        assert_eq!(thick.len(), 1, "{thick:?}");
        assert_eq!(
            (thick[0].required, thick[0].measured),
            (Some(36.0), Some(30.0))
        );
        assert!(thick[0].remedy.is_some());
    }
}
