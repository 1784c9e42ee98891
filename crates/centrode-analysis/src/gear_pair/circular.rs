//! Remedies for circular gears: a single change of the design, tried and checked.

use std::borrow::Cow;

use centrode_gear::GearPair;
use centrode_gear::design::{Addendum, GearPairDesign, ToolSpec};
use centrode_gear::pitch::{Circle, PitchSpec};

use super::{checked, remedy::is_of_teeth};
use crate::{Contact, Report, Severity};

/// Relative difference of the radii of a pitch curve up to which it is a circle: rounding. For circles the remedies are
/// shifts and other pressure angles.
const ROUND: f64 = 1e-12;

/// Minimum contact ratio of a changed pair that counts as a remedy: with less, gears are sensitive to errors of the centre
/// distance.
const CONTACT_RATIO: f64 = 1.1;

/// Values of a key, each with the text that names the change: key, value and a common ending.
macro_rules! values {
    ($key:literal, $end:literal: $($value:literal)*) => {
        [$(($value, concat!($key, " = ", $value, $end))),*]
    };
}

/// Profile shifts of the driver that are tried, the smallest first. The driven gear has its shift from the design or, by
/// default, the opposite shift.
#[rustfmt::skip]
const SHIFTS: [(f64, &str); 16] = values!("driver.shift", "":
    0.1 -0.1 0.2 -0.2 0.3 -0.3 0.4 -0.4 0.5 -0.5 0.6 -0.6 0.7 -0.7 0.8 -0.8);

/// Equal profile shifts of both gears that are tried: the centre distance follows.
#[rustfmt::skip]
const BOTH: [(f64, &str); 8] = values!("driver.shift = driven.shift", ", with the resulting centre distance":
    0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8);

/// Pressure angles of usual tools, in degrees.
const ANGLES: [(f64, &str); 6] =
    values!("tool.pressure_angle_deg", "": 17.5 20.0 22.5 25.0 28.0 30.0);

/// Sets the remedy of the findings about teeth and mesh of circular gears: the first change of the design with which the check
/// finds only notes, or no remedy if there is no such change.
///
/// The changes tried are, in this order: opposite profile shifts, a larger pressure angle, equal profile shifts, fitted
/// addenda, and more teeth of a smaller module.
pub(super) fn name_remedy(pair: &GearPair, report: &mut Report) {
    let (low, high) = pair.rolling().radii(pair.driver().member());
    let of_teeth = report
        .findings
        .iter()
        .any(|finding| is_of_teeth(finding.rule));
    if high - low > ROUND * high || !of_teeth {
        return;
    }
    let found = remedy(pair);
    let of_teeth = report.findings.iter_mut();
    for finding in of_teeth.filter(|finding| is_of_teeth(finding.rule)) {
        finding.remedy = found.map(Cow::Borrowed);
    }
}

/// The first change of circular gears that helps.
fn remedy(pair: &GearPair) -> Option<&'static str> {
    let mut written = pair.settled_design();
    let teeth = pair.driver().tooth_count();
    written.pitch = PitchSpec::Circle(Circle {
        module: Some(pair.module()),
        tooth_count: Some(teeth),
        ..Circle::default()
    });
    let with = |change: &dyn Fn(&mut GearPairDesign)| {
        let mut design = written.clone();
        change(&mut design);
        design
    };
    let shifted = SHIFTS.map(|(x, words)| (with(&|design| design.driver.shift = Some(x)), words));
    // If the design gives a centre distance, these pairs are not possible.
    let both = BOTH.map(|(x, words)| {
        let equal = |design: &mut GearPairDesign| {
            (design.driver.shift, design.driven.shift) = (Some(x), Some(x));
        };
        (with(&equal), words)
    });
    let own = pair.teeth().pressure_angle();
    let steeper = ANGLES.map(|(angle, words)| (angle.to_radians(), words));
    let steeper = steeper.into_iter().filter(|(angle, _)| *angle > own);
    let with_angle = |alpha: f64| {
        with(&|design| match &mut design.tool {
            ToolSpec::Rack(rack) => rack.pressure_angle = alpha,
            ToolSpec::Shaper(shaper) => shaper.pressure_angle = alpha,
            _ => {}
        })
    };
    let steeper = steeper.map(|(alpha, words)| (with_angle(alpha), words));
    let fitted = with(&|design| design.teeth.addendum = Addendum::Fitted);
    let fitted = [(fitted, "teeth.addendum = \"fitted\"")];
    // Full teeth of a rack are undercut below 2 / sin^2(alpha).
    let full = 2.0 / own.sin().powi(2);
    let fewest = f64::from(teeth.min(pair.driven().tooth_count()));
    let step = pair.mean_ratio().1;
    let more = (f64::from(teeth) * full / fewest / f64::from(step)).ceil() as u32 * step;
    let more = (more > teeth).then(|| {
        (
            written.with_tooth_count(more),
            "more teeth of a smaller module",
        )
    });
    let all = shifted.into_iter().chain(steeper).chain(both);
    let mut all = all.chain(fitted).chain(more);
    all.find(|(design, _)| helps(design))
        .map(|(_, words)| words)
}

/// Whether the check of a design's gears finds only notes, and the contact ratio is large enough.
fn helps(design: &GearPairDesign) -> bool {
    GearPair::resolve(design).is_ok_and(|pair| {
        let contact = Contact::analyse(&pair);
        let report = checked(&pair, &contact, None);
        let ratio = report.values.get("contact_ratio_mean");
        report
            .findings
            .iter()
            .all(|finding| finding.severity == Severity::Note)
            && ratio.is_some_and(|ratio| *ratio >= CONTACT_RATIO)
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use centrode_spec::DesignSpec as _;

    use super::*;
    use crate::check;
    use crate::contact::tests::closed_forms::mean_ratio;

    /// Circular gears by teeth, pressure angle in degrees and further lines of the tool and teeth.
    fn gears([z1, z2]: [u32; 2], alpha: f64, shifts: [f64; 2], teeth: &str) -> GearPair {
        let text = format!(
            "family = \"gear-pair\"\nmean_ratio = {}\n[pitch]\nkind = \"circle\"\nmodule = 3\ntooth_count = {z1}\n\
             [tool]\nkind = \"rack\"\npressure_angle_deg = {alpha}\n[teeth]\n{teeth}\n",
            mean_ratio([z1, z2])
        );
        let mut design = GearPairDesign::from_toml(&text).expect("a design");
        if shifts != [0.0; 2] {
            (design.driver.shift, design.driven.shift) = (Some(shifts[0]), Some(shifts[1]));
        }
        GearPair::resolve(&design).expect("a pair")
    }

    #[test]
    fn a_remedy_of_circular_gears_makes_gears_that_run() {
        let mut named = Vec::new();
        for (z, alpha, teeth) in [
            ([8, 8], 20.0, "backlash = 0"),
            ([20, 8], 14.5, "backlash = 0"),
            ([8, 8], 14.5, "backlash = 0"),
            ([8, 40], 20.0, "backlash = 0.1"),
            ([12, 60], 20.0, "backlash = 0.05"),
            ([60, 12], 20.0, "backlash = 0.05"),
            ([10, 10], 14.5, "backlash = 0.2"),
            ([13, 13], 20.0, "backlash = 0"),
            ([9, 27], 17.5, "backlash = 0"),
            ([15, 45], 14.5, "backlash = 0.1"),
            ([20, 20], 14.5, "backlash = 0.05"),
            ([6, 6], 20.0, "backlash = 0"),
        ] {
            let report = check(&gears(z, alpha, [0.0; 2], teeth));
            let of_teeth = report
                .findings
                .iter()
                .filter(|f| f.severity > Severity::Note);
            let remedies: Vec<_> = of_teeth.map(|finding| finding.remedy.clone()).collect();
            assert!(!remedies.is_empty(), "{z:?}");
            assert!(
                remedies.iter().all(|remedy| *remedy == remedies[0]),
                "{remedies:?}"
            );
            named.push(remedies[0].clone());
            let Some(remedy) = remedies[0].as_deref() else {
                continue;
            };
            assert!(!remedy.contains("pitch curve"), "{remedy}");
            let value = |key: &str| {
                Some(
                    remedy
                        .strip_prefix(key)?
                        .strip_prefix(" = ")?
                        .parse::<f64>()
                        .expect("a number"),
                )
            };
            let shifts = match remedy.strip_prefix("driver.shift = driven.shift = ") {
                Some(rest) => {
                    let x = rest.split(',').next().expect("a number");
                    [x.parse().expect("a number"); 2]
                }
                None => {
                    let x = value("driver.shift").unwrap_or(0.0);
                    [x, -x]
                }
            };
            let angle = value("tool.pressure_angle_deg").unwrap_or(alpha);
            if shifts[0] == 0.0 && angle == alpha {
                continue;
            }
            // Both gears by closed forms, without the check: flanks from the undercut's end to the tip, and the land at the tip.
            let pair = gears(z, angle, shifts, teeth);
            let angle = angle.to_radians();
            let inv = |a: f64| a.tan() - a;
            let operating = pair.pressure_angle();
            let [sum, count] = [shifts[0] + shifts[1], f64::from(z[0] + z[1])];
            let grown = 2.0 * angle.tan() * sum / count;
            assert!((inv(operating) - inv(angle) - grown).abs() < 1e-12, "{z:?}");
            let scale = angle.cos() / operating.cos();
            let lower = sum - 0.5 * count * (scale - 1.0);
            let ends = [0, 1].map(|i| {
                let (z, x) = (z[i], shifts[i]);
                let r = 1.5 * f64::from(z);
                // Undercut begins below x = 1 - z sin^2(alpha) / 2. By a little it is below 0.005 mm, a note.
                assert!(
                    x >= 1.0 - 0.5 * f64::from(z) * angle.sin().powi(2) - 0.05,
                    "{i} {z} {x}"
                );
                let (tip, base) = (r + 3.0 * (1.0 + x - lower), r * angle.cos());
                let half = (0.5 * PI + 2.0 * x * angle.tan()) / f64::from(z) + inv(angle)
                    - inv((base / tip).acos());
                // Backlash takes up to 0.2 mm of the thickness.
                assert!(2.0 * half * tip > 0.6 - 0.25, "{i} {z} {x}: {half}");
                (tip * tip - base * base).sqrt() - scale * r * operating.sin()
            });
            let ratio = ends.iter().sum::<f64>() / (3.0 * PI * angle.cos());
            assert!(ratio > 1.1, "{z:?} {remedy}: {ratio}");
        }
        // The shift that 8 teeth need makes them pointed, and so does every angle of a usual tool: they need smaller teeth.
        let more = "more teeth of a smaller module";
        assert!(
            named[..3]
                .iter()
                .all(|named| named.as_deref() == Some(more))
        );
        let is_named = |key: &str| named.iter().flatten().any(|remedy| remedy.contains(key));
        assert!(
            is_named("driver.shift = 0")
                && is_named("driven.shift = 0")
                && is_named("pressure_angle"),
            "{named:?}"
        );
    }

    #[test]
    fn other_gears_keep_their_usual_remedies() {
        let text = "family = \"gear-pair\"\n[pitch]\nkind = \"ellipse\"\neccentricity = 0.6\nmodule = 2\ntooth_count = 21\n";
        let design = GearPairDesign::from_toml(text).expect("a design");
        let report = check(&GearPair::resolve(&design).expect("a pair"));
        let undercut = report
            .findings
            .iter()
            .find(|finding| finding.rule == "undercut");
        assert!(undercut.is_some_and(|finding| finding.remedy.is_some()));
    }
}
