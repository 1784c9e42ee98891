//! Check of the cams and forks that move the push rods of transplanting arms.

use std::f64::consts::PI;

use centrode_machines::three_arm::{Pusher, PusherError};

use crate::cam::CheckedCam;
use crate::{Finding, Report, Severity};

/// Maximum pressure angle, rad, of a swinging follower during the rise. VDI 2142 part 2.
const PRESSURE_ANGLE: f64 = PI / 4.0;

/// Checks cam and fork. On the return the spring moves the follower, whatever the pressure angle.
pub(super) fn check_pusher(pusher: &Result<Pusher, PusherError>, report: &mut Report) {
    let pusher = match pusher {
        Ok(pusher) => pusher,
        Err(error) => {
            let message = format!("nothing moves the push rods: {}: {error}", error.key());
            // Without a pusher there is no machine, and no file of it.
            report
                .findings
                .push(Finding::new("pusher", Severity::Error, message).on("cam"));
            return;
        }
    };
    let limits = pusher.cam().disc().limits();
    let values = &mut report.values;
    values.insert("cam_pressure_angle_max", limits.rise_pressure_angle.value);
    values.insert("cam_radius_min", limits.minimum_radius.value);
    values.insert("cam_concave_radius_min", limits.largest_wheel.value);
    values.insert("push_rod_stroke", pusher.stroke());
    let checked = CheckedCam {
        part: "cam",
        pressure_angle: PRESSURE_ANGLE,
        undercut: "the cam is undercut: the rod cannot follow its motion there".into(),
        pushes: [
            "the pressure angle of the cam reaches".into(),
            "while it draws the rod back".into(),
        ],
        remedies: [
            "a longer cam.closing_deg or cam.release_deg, a larger cam.base_radius, or a smaller roller",
            "a longer cam.closing_deg or a larger cam.base_radius",
        ],
        input: &Some,
    };
    checked.report(&limits, report);
}

#[cfg(test)]
mod tests {
    use super::*;
    use centrode_machines::three_arm::ThreeArm;
    use centrode_machines::three_arm::design::{PusherCamSpec, ThreeArmDesign};
    use centrode_spec::DesignSpec as _;

    fn checked(change: impl Fn(&mut ThreeArmDesign)) -> Report {
        let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
        change(&mut design);
        let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
        let mut report = Report::default();
        check_pusher(&mechanism.pusher(), &mut report);
        report
    }

    #[test]
    fn the_usual_cam_is_sound_and_a_hasty_one_is_told() {
        let usual = checked(|_| {});
        assert!(usual.findings.is_empty(), "{:?}", usual.findings);
        assert!(usual.values["cam_radius_min"] > 1.5);
        let hasty = checked(|d| {
            d.cam = Some(PusherCamSpec {
                closing: 0.1,
                release: 0.1,
                ..PusherCamSpec::default()
            });
        });
        let rules: Vec<&str> = hasty.findings.iter().map(|f| f.rule).collect();
        assert!(rules.contains(&"cam-undercut"), "{rules:?}");
        let pressure = |report: &Report| report.values["cam_pressure_angle_max"];
        assert!(pressure(&hasty) > 1.3 * pressure(&usual));
        let steep = pressure(&hasty) > PRESSURE_ANGLE;
        assert_eq!(rules.contains(&"cam-pressure-angle"), steep);
        let none = checked(|d| d.arm.pusher_offset = 0.0);
        assert_eq!(none.findings[0].rule, "pusher");
    }
}
