//! Teeth of gear pairs in a machine: findings and goals are those of the pairs themselves.

use super::*;
use centrode_gear::GearPair;
use centrode_gear::design::GearPairDesign;

/// A shaft and a crank geared to it by teeth too few for their law.
const WEAK: &str = r#"
family = "machine"
[frame.points]
O = [0, 0]
[bodies.shaft]
on = "frame.O"
law = { ratio = 1 }
[bodies.crank]
on = "frame"
mesh = { gear = "wheel", with = "pinion", direction_deg = 30 }
[pairs.drive]
pitch = { kind = "ratio", expression = "1 + 0.45*cos(2*phi)", module = 2, tooth_count = 20 }
driver = { width = 10, bore = 6 }
driven = { width = 10, bore = 6 }
[gears.pinion]
pair = "drive"
role = "driver"
on = "shaft"
[gears.wheel]
pair = "drive"
role = "driven"
on = "crank"
[goals.carrying]
figure = "pair(drive).contact_ratio_mean"
over = "minimum"
minimum = 1.4
[goals.true]
figure = "pair(drive).transmission_error_max"
at_deg = 0
maximum = 1e-9
"#;

#[test]
fn teeth_that_do_not_carry_are_told_with_their_pair_and_goals_may_name_their_figures() {
    let made = composed(WEAK);
    let drive = &made.design().pairs["drive"];
    let pair = GearPair::resolve(&GearPairDesign::clone(drive)).expect("a pair");
    let own = crate::check(&pair);
    let report = check_machine(&made);
    let stated = |rule: &str| {
        let found = report.findings.iter().find(|finding| finding.rule == rule);
        found.map(|finding| finding.message.clone())
    };
    assert!(
        own.findings
            .iter()
            .any(|finding| finding.rule == "undercut")
    );
    for finding in &own.findings {
        let message = stated(finding.rule).expect("told");
        assert!(message.starts_with("pair drive: "), "{message}");
    }
    let figures = ["contact_ratio_mean", "transmission_error_max"];
    assert_eq!(report.goals.len(), 2);
    for (goal, figure) in report.goals.iter().zip(figures) {
        assert_eq!(goal.value, Some(own.values[figure]), "{figure}");
    }
    assert_eq!(report.goals[1].unit, Unit::Radian);
    assert_eq!(report.goals[1].met(), Some(false));
    let carrying = [
        own.values["pairs_in_contact_min"],
        own.values["contact_ratio_mean"],
    ];
    assert_eq!(table(&report, "contact-ratios").rows[0].1, carrying);
}

#[test]
fn pairs_and_figures_of_pairs_that_are_not_there_are_told() {
    for (words, stated) in [
        (
            "pair(gear).contact_ratio_mean",
            "no gears use a pair gear; pairs in use are drive",
        ),
        (
            "pair(drive).beauty",
            "a pair has no figure beauty; known are backlash_max",
        ),
    ] {
        let text = WEAK.replace("pair(drive).contact_ratio_mean", words);
        let design = MachineDesign::from_toml(&text).expect("a design");
        let error = Machine::resolve(&design).expect_err(words);
        assert!(error.to_string().contains(stated), "{error}");
        assert_eq!(error.key(), "goals.carrying.figure");
    }
}
