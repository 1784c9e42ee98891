//! Circular gears against the closed forms of ISO 21771, and one pair written in two ways.

use std::f64::consts::PI;

use centrode_gear::design::GearPairDesign;
use centrode_gear::{GearPair, Member, Side};
use centrode_spec::DesignSpec as _;

use crate::{Contact, ContactExtremes};

fn resolved(text: &str) -> GearPair {
    let design = GearPairDesign::from_toml(&format!("family = \"gear-pair\"\n{text}"));
    GearPair::resolve(&design.expect("a design")).expect("a pair")
}

/// Turns of driver and driven gear of these teeth, in lowest terms.
pub(crate) fn mean_ratio([z1, z2]: [u32; 2]) -> String {
    let divisor = (1..=z1.min(z2))
        .rev()
        .find(|d| z1 % d == 0 && z2 % d == 0)
        .unwrap_or(1);
    format!("[{}, {}]", z2 / divisor, z1 / divisor)
}

/// Circular gears: module, teeth, pressure angle in degrees, normal backlash.
pub(super) fn circular((module, [z1, z2], alpha, backlash): (f64, [u32; 2], f64, f64)) -> GearPair {
    // The roundings of both flanks of a steep tool leave less room.
    let tip = if alpha > 20.0 { 0.25 } else { 0.38 };
    resolved(&format!(
        "mean_ratio = {}\n[pitch]\nkind = \"circle\"\nmodule = {module}\ntooth_count = {z1}\n\
         [tool]\nkind = \"rack\"\npressure_angle_deg = {alpha}\ntip_radius_coefficient = {tip}\n[teeth]\nbacklash = {backlash}\n",
        mean_ratio([z1, z2])
    ))
}

fn extremes(pair: &GearPair) -> ContactExtremes {
    Contact::analyse(pair).extremes(pair)
}

/// Length of the path of contact before and after the pitch point: to the tip of one gear or the end of the other's flank at the root.
fn path(pair: &GearPair, alpha: f64) -> [f64; 2] {
    let ends = [Member::Driver, Member::Driven].map(|member| {
        let flank = pair.flank_radii(member, 0, Side::Leading).expect("a flank");
        let r = 0.5 * pair.module() * f64::from(pair.gear(member).tooth_count());
        let along = |radius: f64| (radius.powi(2) - (r * alpha.cos()).powi(2)).max(0.0).sqrt();
        [
            r * alpha.sin() - along(flank[0]),
            along(flank[1]) - r * alpha.sin(),
        ]
    });
    let [driver, driven] = ends;
    [driven[1].min(driver[0]), driver[1].min(driven[0])]
}

/// The 8:8 and 20:8, and neighbours that lose contact or just do not, with and without backlash.
const CIRCULAR: [(f64, [u32; 2], f64, f64); 14] = [
    (3.0, [8, 8], 20.0, 0.0),
    (3.0, [20, 8], 14.5, 0.0),
    (3.0, [8, 8], 20.0, 0.1),
    (3.0, [20, 8], 14.5, 0.3),
    (3.0, [8, 20], 14.5, 0.05),
    (2.0, [9, 9], 20.0, 0.0),
    (2.0, [8, 12], 20.0, 0.05),
    (1.0, [10, 10], 14.5, 0.02),
    (1.5, [12, 24], 14.5, 0.0),
    (2.0, [9, 27], 17.5, 0.1),
    (2.0, [30, 30], 20.0, 0.2),
    (2.0, [30, 30], 20.0, 0.0),
    (1.25, [25, 40], 20.0, 0.6),
    (4.0, [17, 51], 25.0, 0.15),
];

#[test]
fn contact_is_lost_and_counted_by_the_ends_of_the_flanks() {
    let mut lost = Vec::new();
    for case in CIRCULAR {
        let (module, _, alpha, _) = case;
        let alpha = f64::to_radians(alpha);
        let pair = circular(case);
        let ratio = path(&pair, alpha).iter().sum::<f64>() / (PI * module * alpha.cos());
        let found = extremes(&pair);
        let missing = (1.0 - ratio).max(0.0);
        assert!(
            (found.lost - missing).abs() < 1e-6,
            "{case:?}: {} {missing}",
            found.lost
        );
        assert!(
            (found.contact_ratio - ratio).abs() < 1e-6,
            "{case:?}: {} {ratio}",
            found.contact_ratio
        );
        let expected = [ratio.floor().max(1.0), ratio.ceil()];
        assert_eq!(
            found.contacts.map(|count| count.value),
            expected,
            "{case:?}"
        );
        lost.push(found.lost);
    }
    assert!((lost[0] - 0.481).abs() < 1e-3, "{}", lost[0]);
    assert!((lost[1] - 0.334).abs() < 1e-3, "{}", lost[1]);
}

#[test]
fn sliding_of_circular_gears_is_the_end_of_the_path_at_any_backlash() {
    for (module, z, alpha, own) in CIRCULAR.into_iter().skip(8) {
        for backlash in [own, 0.0, 0.01, 0.2, 0.37] {
            let case = (module, z, alpha, backlash * module);
            let pair = circular(case);
            let alpha = f64::to_radians(alpha);
            if path(&pair, alpha).iter().sum::<f64>() < PI * module * alpha.cos() {
                continue;
            }
            let farthest = path(&pair, alpha).into_iter().fold(0.0, f64::max);
            let expected = farthest * (1.0 + f64::from(z[0]) / f64::from(z[1]));
            let found = extremes(&pair).sliding.value;
            assert!(
                (found - expected).abs() < 1e-6 * expected,
                "{case:?}: {found} {expected}"
            );
        }
    }
    let named = circular((2.0, [30, 30], 20.0, 0.2));
    assert!((extremes(&named).sliding.value - 9.7628).abs() < 5e-5);
}

/// The maximum is at the end of a contact, between the samples.
#[test]
fn sliding_is_no_less_than_at_dense_samples() {
    for (e, backlash) in [
        (0.1, 0.05),
        (0.2, 0.3),
        (0.3, 0.1),
        (0.05, 0.5),
        (0.25, 0.0),
    ] {
        let pair = resolved(&format!(
            "[pitch]\nkind = \"ellipse\"\neccentricity = {e}\nmodule = 2\ntooth_count = 41\n[teeth]\nbacklash = {backlash}\n"
        ));
        let most = extremes(&pair).sliding;
        let pitch = pair.cycle() / 41.0;
        let inputs: Vec<f64> = (0..41 * 24)
            .map(|k| pitch * (f64::from(k) + 0.3) / 24.0)
            .collect();
        let dense = Contact::analyse_at(&pair, &inputs).sliding;
        let seen = dense.into_iter().fold(0.0, f64::max);
        // One step of 1/24 of a pitch loses up to 5 % of the path.
        assert!(
            most.value >= seen * (1.0 - 1e-9),
            "{e} {backlash}: {most:?} {seen}"
        );
        assert!(most.value < seen * 1.06, "{e} {backlash}: {most:?} {seen}");
    }
}

/// One curve by a kind with known symmetry, and by a formula without.
#[test]
fn one_pair_written_in_two_ways_has_one_contact_ratio() {
    for (lobes, e, z, ratio, teeth) in [
        (2, 0.15, 40, "[2, 1]", "backlash = 0.05"),
        (2, 0.15, 40, "[2, 1]", "backlash = 0.0"),
        (2, 0.15, 40, "[1, 1]", "backlash = 0.05"),
        (2, 0.1, 30, "[2, 1]", "backlash = 0.02"),
        (3, 0.08, 45, "[3, 1]", "backlash = 0.04"),
        (3, 0.06, 36, "[1, 1]", "backlash = 0.05"),
        (2, 0.2, 44, "[1, 1]", "backlash = 0.1"),
        (2, 0.05, 24, "[2, 1]", "backlash = 0.2"),
        (
            4,
            0.03,
            48,
            "[2, 1]",
            "backlash = 0.03\nthickness_split = 0.48",
        ),
        (2, 0.12, 26, "[1, 1]", "backlash = 0.05\nphase = 0.2"),
    ] {
        let kinds = [
            format!("kind = \"lobed-ellipse\"\nlobes = {lobes}\neccentricity = {e}"),
            format!("kind = \"polar\"\nexpression = \"1/(1 - {e}*cos({lobes}*phi))\""),
        ];
        let both = kinds.map(|kind| {
            resolved(&format!(
                "mean_ratio = {ratio}\n[pitch]\n{kind}\nmodule = 1\ntooth_count = {z}\n[teeth]\n{teeth}\n"
            ))
        });
        let [one, two] = both.each_ref().map(extremes);
        let off = (one.contact_ratio - two.contact_ratio).abs();
        assert!(
            off < 1e-6,
            "{lobes} {e} {z}: {} {}",
            one.contact_ratio,
            two.contact_ratio
        );
        assert!(
            (one.lost - two.lost).abs() < 1e-6,
            "{} {}",
            one.lost,
            two.lost
        );
        assert!(
            (one.sliding.value - two.sliding.value).abs() < 1e-5,
            "{:?} {:?}",
            one.sliding,
            two.sliding
        );
    }
}
