use centrode_gear::GearPair;
use centrode_gear::design::GearPairDesign;
use centrode_spec::DesignSpec as _;

use super::check;

fn pair(expression: &str, module: f64, teeth: u32, backlash: f64) -> GearPair {
    let text = format!(
        "family = \"gear-pair\"\n[pitch]\nkind = \"ratio\"\nexpression = \"{expression}\"\nmodule = {module}\ntooth_count = {teeth}\n\
         [teeth]\nbacklash = {backlash}\n"
    );
    let design = GearPairDesign::from_toml(&text).expect("a design");
    GearPair::resolve(&design).expect("a pair")
}

/// A finding of a depth is one figure of the report, and the finding names which.
#[test]
fn every_depth_has_one_name() {
    let mut found = [0; 2];
    for (expression, module, teeth, backlash) in [
        ("1+0.373*cos(2*phi)", 2.0, 19, 0.02),
        ("1+0.373*cos(2*phi)", 2.0, 19, 0.0),
        ("1+0.373*cos(2*phi)", 1.0, 19, 0.01),
        ("1+0.373*cos(2*phi)", 2.0, 23, 0.1),
        ("1+0.3*cos(2*phi)", 2.0, 19, 0.02),
        ("1+0.2*cos(2*phi)", 2.0, 19, 0.0),
        ("1+0.45*cos(phi)", 2.0, 20, 0.05),
        ("1+0.25*cos(3*phi)", 1.5, 24, 0.0),
        ("1+0.4*cos(2*phi)", 2.0, 30, 0.03),
        ("1+0.1*cos(phi)", 2.0, 40, 0.05),
        ("1+0.33*sin(2*phi)", 3.0, 21, 0.0),
    ] {
        let pair = pair(expression, module, teeth, backlash);
        let report = check(&pair);
        let tips = report.values["clearance_min"].min(report.values["fillet_clearance_min"]);
        let depths = [
            ("interference", report.values["penetration_max"]),
            ("tip-interference", -tips),
        ];
        for (k, (rule, depth)) in depths.into_iter().enumerate() {
            let mut of_rule = report
                .findings
                .iter()
                .filter(|finding| finding.rule == rule);
            let measured = of_rule.next().and_then(|finding| finding.measured);
            let expected = (depth > 1e-6 * module).then_some(depth);
            assert_eq!(measured, expected, "{expression} {backlash}: {rule}");
            assert!(of_rule.next().is_none());
            found[k] += usize::from(expected.is_some());
        }
        // An angle is in degrees, whatever its size.
        let messages = report
            .findings
            .iter()
            .map(|finding| finding.message.as_str());
        assert!(
            messages.clone().all(|message| !message.contains(" rad")),
            "{:?}",
            messages.collect::<Vec<_>>()
        );
    }
    assert!(found.iter().all(|&count| count > 2), "{found:?}");
}

/// The corners of the samples are findings, each with its angle and place.
#[test]
fn corners_of_sampled_pitch_curves_are_findings() {
    // A radius of two arcs of ellipses that meet at 0 and 180 degrees: slopes of ln r by closed form.
    for (e, count) in [
        (0.05_f64, 72),
        (0.08, 72),
        (0.1, 96),
        (0.12, 120),
        (0.15, 180),
        (0.2, 240),
        (0.1, 360),
        (0.03, 360),
        (0.06, 100),
        (0.15, 500),
    ] {
        let radius = |phi: f64| match phi.sin() >= 0.0 {
            true => 1.0 / (1.0 - e * (phi - 0.5).cos()),
            false => 1.0 / (1.0 - e * (phi + 0.5).cos()),
        };
        let radii: Vec<f64> = (0..count)
            .map(|k| radius(std::f64::consts::TAU * f64::from(k) / f64::from(count)))
            .collect();
        let text = format!(
            "family = \"gear-pair\"\n[pitch]\nkind = \"polar\"\nradius = {radii:?}\nmodule = 2\ntooth_count = 40\n[teeth]\nbacklash = 0.05\n"
        );
        let design = GearPairDesign::from_toml(&text).expect("a design");
        let report = check(&GearPair::resolve(&design).expect("a pair"));
        let corners: Vec<_> = report
            .findings
            .iter()
            .filter(|f| f.rule == "pitch-curve-corner")
            .collect();
        // Mirrored about the axis, the radius has the opposite slope behind it.
        let turn = |at: f64| {
            let slope = -e * (at - 0.5).sin() / (1.0 - e * (at - 0.5).cos());
            2.0 * slope.atan().abs()
        };
        assert_eq!(corners.len(), 2, "{e} {count}: {corners:?}");
        for (finding, at) in corners.iter().zip([0.0, std::f64::consts::PI]) {
            let input = finding.place.input.expect("a place");
            let off = (input - at + 1.0).rem_euclid(std::f64::consts::TAU) - 1.0;
            assert!(off.abs() < 0.05 / f64::from(count), "{e} {count}: {off}");
            let measured = finding.measured.expect("an angle");
            assert!(
                (measured - turn(at)).abs() < 0.02 * turn(at),
                "{e} {count}: {measured} {}",
                turn(at)
            );
            assert!(finding.message.contains(" deg") && finding.remedy.is_some());
        }
    }
}

/// The maximum deviation of thickness that leaves backlash is j / (2 cos(alpha)): 0.0266 mm for 0.05 mm.
#[test]
fn teeth_thicker_than_the_backlash_are_found() {
    for (upper, overlap) in [
        (0.0266, None),
        (0.03, Some(0.06 * 20_f64.to_radians().cos() - 0.05)),
    ] {
        let mut design = pair("1+0.2*cos(phi)", 2.0, 30, 0.05).design().clone();
        design.teeth.thickness_deviations = Some([upper, -0.02]);
        let report = check(&GearPair::resolve(&design).expect("a pair"));
        let found = report
            .findings
            .iter()
            .find(|f| f.rule == "negative-backlash");
        assert_eq!(found.is_some(), overlap.is_some(), "{upper}");
        if let (Some(found), Some(overlap)) = (found, overlap) {
            assert!((found.measured.expect("a length") + overlap).abs() < 1e-12);
            assert!(
                found.message.contains("at least 0.0564 mm"),
                "{}",
                found.message
            );
        }
    }
}
