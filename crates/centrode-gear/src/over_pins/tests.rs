use centrode_geometry::bracketed_root;

use super::*;
use crate::design::{GearPairDesign, TeethSpec};
use crate::pitch::{Circle, Ellipse, PitchSpec};

fn circular(backlash: f64) -> GearPair {
    let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
        module: Some(2.0),
        tooth_count: Some(24),
        ..Circle::default()
    }));
    design.teeth = TeethSpec {
        backlash,
        ..TeethSpec::default()
    };
    GearPair::resolve(&design).expect("a sound pair")
}

/// Inverse involute function: the angle x with tan x - x = `value`.
fn involute_angle(value: f64) -> f64 {
    let f = |x: f64| x.tan() - x - value;
    bracketed_root(f, 0.0, 1.2, f(0.0), f(1.2))
}

#[test]
fn limits_are_the_textbook_measures_of_thicker_and_thinner_teeth() {
    let mut design = circular(0.05).design().clone();
    let (z, m, alpha) = (24.0, 2.0, 20.0_f64.to_radians());
    let base = 0.5 * m * z * alpha.cos();
    // The last are thicker than nominal by more than the backlash.
    for deviations in [[-0.03, -0.06], [0.02, -0.01], [0.2, 0.1]] {
        design.teeth.thickness_deviations = Some(deviations);
        let pair = GearPair::resolve(&design).expect("a sound pair");
        for (minimum, deviation) in pair.backlash_limits(0.05).iter().zip(deviations) {
            assert!((minimum - (0.05 - 2.0 * deviation * alpha.cos())).abs() < 1e-12);
        }
        for member in [Member::Driver, Member::Driven] {
            let limits = pair.pin_limits(member).expect("stated");
            for (over, deviation) in limits.iter().zip(deviations) {
                let space = 0.5 * std::f64::consts::PI * m + 0.05 / (2.0 * alpha.cos()) - deviation;
                let inv = alpha.tan() - alpha + over.diameter / (2.0 * base) - space / (m * z);
                let radial = base / involute_angle(inv).cos() + 0.5 * over.diameter;
                let pin = over.pins[5].expect("measurable");
                assert!(
                    (pin.radial - radial).abs() < 2e-9,
                    "{} {radial}",
                    pin.radial
                );
                assert!((over.over(5, 17).expect("both") - 2.0 * radial).abs() < 4e-9);
                for contact in pin.contacts {
                    let gap = (contact - pin.center).norm() - 0.5 * over.diameter;
                    assert!(gap.abs() < 1e-12);
                }
            }
        }
    }
    design.teeth.thickness_deviations = None;
    let usual = GearPair::resolve(&design).expect("a sound pair");
    let stated = usual.thickness_deviations(Member::Driver).expect("told");
    // Class 8, 48 mm.
    assert_eq!((stated.limits, stated.series), ([0.0, -0.05], Some(26)));
    let [high, low] = usual.pin_limits(Member::Driver).expect("stated");
    assert_eq!(high, usual.driver().over_pins(high.diameter));
    assert_same_as_cut(&usual, &low, 0.05);
    for (accuracy, series) in [
        (" 6 ", Some(24)),
        ("12", Some(30)),
        ("2", None),
        ("AGMA 8", None),
    ] {
        let mut design = design.clone();
        design.driver.accuracy = accuracy.into();
        let pair = GearPair::resolve(&design).expect("a sound pair");
        let stated = pair.thickness_deviations(Member::Driver);
        assert_eq!(
            stated.and_then(|stated| stated.series),
            series,
            "{accuracy}"
        );
        assert_eq!(stated.is_some(), series.is_some());
        assert_eq!(pair.pin_limits(Member::Driver).is_some(), series.is_some());
    }
    for wrong in [
        [1.01, -0.06],
        [0.01, -1.01],
        [-0.06, -0.03],
        [f64::NAN, -0.1],
        [-0.1, f64::INFINITY],
    ] {
        design.teeth.thickness_deviations = Some(wrong);
        let error = GearPair::resolve(&design).expect_err("not in order");
        assert!(
            error.to_string().contains("thickness_deviations"),
            "{error}"
        );
    }
}

/// Checks that pins are at the positions they have in teeth that are cut thinner by a length, mm.
fn assert_same_as_cut(pair: &GearPair, over: &OverPins, by: f64) {
    let cut = pair.thinned(by).expect("teeth");
    let cut = cut.driver().over_pins(over.diameter);
    for (one, other) in over.pins.iter().zip(&cut.pins) {
        let (one, other) = (one.expect("measurable"), other.expect("measurable"));
        assert!((one.center - other.center).norm() < 1e-8);
        assert!((one.radial - other.radial).abs() < 1e-8);
    }
}

#[test]
fn limits_of_other_gears_are_those_of_teeth_cut_anew() {
    for words in [
        "[pitch]\nkind = \"ellipse\"\neccentricity = 0.2679\nmodule = 2.25\ntooth_count = 23",
        "[pitch]\nkind = \"ellipse\"\neccentricity = 0.2\nmodule = 2\ntooth_count = 31\n[tool]\nkind = \"shaper\"\ntooth_count = 12",
        "[pitch]\nkind = \"circle\"\nmodule = 3\ntooth_count = 13\n[driver]\nshift = 0.6\n[driven]\nshift = 0.36",
    ] {
        let words =
            format!("{words}\n[teeth]\nbacklash = 0.1\nthickness_deviations = [0.04, -0.1]\n");
        let pair = GearPair::resolve(&toml::from_str(&words).expect("a design")).expect("a pair");
        let limits = pair.pin_limits(Member::Driver).expect("stated");
        for (over, deviation) in limits.iter().zip([0.04, -0.1]) {
            assert_same_as_cut(&pair, over, -deviation);
        }
    }
}

#[test]
fn a_circular_gear_has_the_textbook_measure() {
    // inv(alpha_M) = inv(alpha) + d / (z m cos alpha) - (space width on the pitch circle) ... :
    // the half angle of the space taken from the pin's own.
    for backlash in [0.0, 0.08] {
        let pair = circular(backlash);
        let (z, m, alpha) = (24.0, 2.0, 20.0_f64.to_radians());
        let d = 3.5;
        let base = 0.5 * m * z * alpha.cos();
        let thinned = backlash / (2.0 * alpha.cos());
        let space = 0.5 * std::f64::consts::PI * m + thinned;
        let inv = alpha.tan() - alpha + d / (2.0 * base) - space / (m * z);
        let radial = base / involute_angle(inv).cos() + 0.5 * d;
        for gear in [pair.driver(), pair.driven()] {
            let over = gear.over_pins(d);
            assert_eq!(over.pins.len(), 24);
            for (k, pin) in over.pins.iter().enumerate() {
                let pin = pin.expect("measurable");
                assert!(
                    (pin.radial - radial).abs() < 2e-9,
                    "{} {radial}",
                    pin.radial
                );
                let (j, across) = over.across(k).expect("opposite");
                assert_eq!(j, (k + 12) % 24);
                assert!((across - 2.0 * radial).abs() < 4e-9);
            }
        }
    }
}

#[test]
fn the_pin_lies_between_its_own_two_teeth() {
    let pair = GearPair::resolve(&GearPairDesign::new(PitchSpec::Ellipse(Ellipse {
        eccentricity: 0.2679,
        module: Some(2.25),
        tooth_count: Some(23),
        ..Ellipse::default()
    })))
    .expect("a sound pair");
    for member in [Member::Driver, Member::Driven] {
        let gear = pair.gear(member);
        let d = pair.pin_diameter(member);
        assert_eq!(d, 3.75);
        let over = gear.over_pins(d);
        let pitch = gear.pitch_length() / 23.0;
        for (k, pin) in over.pins.iter().enumerate() {
            let pin = pin.expect("measurable");
            let tooth = &gear.teeth()[k];
            let middle = 0.5 * (tooth.leading.crossing + tooth.trailing.crossing) + 0.5 * pitch;
            let rolling = pair.rolling();
            let frame = rolling.frame(member, rolling.parameter(middle));
            let off = pin.center - frame.point;
            assert!(off.dot(&frame.tangent).abs() < 0.1 && off.dot(&frame.normal) > 0.0);
            for contact in pin.contacts {
                assert!(((pin.center - contact).norm() - 0.5 * d).abs() < 1e-12);
                let inside = contact + (contact - pin.center) * 1e-6;
                assert!(gear.outline().contains(inside));
            }
        }
    }
}

#[test]
fn a_pin_that_does_not_touch_the_flanks_says_why() {
    let gear = circular(0.0).driver().clone();
    let only = |d: f64| {
        let pins = gear.over_pins(d).pins;
        assert!(pins.windows(2).all(|w| w[0].is_err() && w[0] == w[1]));
        pins[0].expect_err("not measurable")
    };
    assert_eq!(only(0.5), PinFault::TooSmall);
    assert_eq!(only(9.0), PinFault::TooLarge);
    assert_eq!(only(f64::NAN), PinFault::TooSmall);
}
