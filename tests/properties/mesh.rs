use centrode_analysis::{Contact, check};
use centrode_gear::{Gear, GearPair};
use centrode_geometry::{Extreme, Point, Tolerance};
use centrode_tests::sound_pair;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use proptest::prelude::{ProptestConfig, prop_assert, proptest};

/// Chord error of the polygons that another program intersects, in modules.
const CHORD: f64 = 1e-5;

fn polygon(gear: &Gear, module: f64, place: impl Fn(Point) -> Point) -> Vec<[f64; 2]> {
    let tolerance = Tolerance::new(CHORD * module).expect("positive");
    let points = gear.outline().flatten(tolerance);
    points.into_iter().map(|p| place(p).into()).collect()
}

fn turned(p: Point, angle: f64) -> Point {
    nalgebra::Rotation2::new(angle) * p
}

/// Overlapping area of the placed gears, by a polygon library that knows nothing of gears and shares nothing with the
/// crates: of all packages here only these tests depend on it.
fn penetration(pair: &GearPair, phi: f64, psi: f64) -> f64 {
    let a = pair.center_distance();
    let driver = polygon(pair.driver(), pair.module(), |p| turned(p, -phi));
    let driven = polygon(pair.driven(), pair.module(), |p| {
        turned(p, psi) + nalgebra::Vector2::new(a, 0.0)
    });
    let both = driver.overlay(&driven, OverlayRule::Intersect, FillRule::NonZero);
    let area = |ring: &Vec<[f64; 2]>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        0.5 * ring
            .iter()
            .zip(next)
            .map(|(p, q)| p[0] * q[1] - p[1] * q[0])
            .sum::<f64>()
    };
    both.iter().flatten().map(area).sum::<f64>().abs()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn meshed_gears_penetrate_nowhere_and_do_after_a_small_turn_either_way(
        design in sound_pair(),
        inputs in proptest::collection::vec(0.0..1.0_f64, 4),
    ) {
        let pair = GearPair::resolve(&design).expect("valid");
        let phis: Vec<f64> = inputs.iter().map(|x| x * pair.cycle()).collect();
        let contact = Contact::analyse_at(&pair, &phis);
        // Polygons stand inside convex arcs and outside concave ones by their chord error.
        let module = pair.module();
        let noise = 20.0 * module * CHORD * module;
        let small = 0.02 * module / pair.center_distance();
        for (i, &phi) in phis.iter().enumerate() {
            let law = pair.driven_angle(phi);
            let seated = penetration(&pair, phi, law);
            prop_assert!(seated < noise, "{seated:e} mm2 at {phi}");
            let play = contact.backlash[i];
            for turn in [play + small, -play - small] {
                let after = penetration(&pair, phi, law + turn);
                prop_assert!(after > 3.0 * noise, "{after:e} mm2 at {phi} turned by {turn}");
            }
        }
    }

    #[test]
    fn extremes_between_fine_samples_are_beaten_nowhere_and_attained_where_they_are_told(
        design in sound_pair(),
        inputs in proptest::collection::vec(0.0..1.0_f64, 400),
    ) {
        let pair = GearPair::resolve(&design).expect("valid");
        let extremes = Contact::sampled(&pair, 48).extremes(&pair);
        let phis: Vec<f64> = inputs.iter().map(|x| x * pair.cycle()).collect();
        let contact = Contact::analyse_at(&pair, &phis);
        let less = |list: &[f64]| -> Vec<f64> { list.iter().map(|v| -v).collect() };
        let negative = |e: Extreme| Extreme { value: -e.value, ..e };
        type Pick = fn(&Contact) -> &Vec<f64>;
        // Angles are told within 1e-12, lengths by the centre distance.
        let (angle, length) = (1e-12, 1e-12 * pair.center_distance());
        let cases: [(&str, Pick, [Option<Extreme>; 2], f64); 6] = [
            ("clearance", |c| &c.clearance, [Some(extremes.clearance), None], length),
            ("fillet clearance", |c| &c.fillet_clearance, [Some(extremes.fillet_clearance), None], length),
            ("sliding", |c| &c.sliding, [None, Some(extremes.sliding)], length),
            ("penetration", |c| &c.penetration, [None, Some(extremes.penetration)], length),
            ("backlash", |c| &c.backlash, extremes.backlash.map(Some), angle),
            ("normal backlash", |c| &c.normal_backlash, extremes.normal_backlash.map(Some), length),
        ];
        for (name, pick, [minimum, maximum], rounding) in cases {
            let samples = pick(&contact).clone();
            for (found, samples, sign) in [
                (minimum.map(negative), less(&samples), -1.0),
                (maximum, samples.clone(), 1.0),
            ] {
                let Some(found) = found else { continue };
                let most = samples.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let allowed = 1e-9 * found.value.abs() + rounding;
                prop_assert!(most <= found.value + allowed, "{name}: {most:e} beats {found:?}");
                let there = sign * pick(&Contact::analyse_at(&pair, &[found.input]))[0];
                prop_assert!((there - found.value).abs() <= allowed, "{name}: {there:e} at {found:?}");
            }
        }
    }

    #[test]
    fn a_sound_pair_drives_without_error(design in sound_pair()) {
        let pair = GearPair::resolve(&design).expect("valid");
        let report = check(&pair);
        prop_assert!(report.ok(), "{:?}", report.findings);
        prop_assert!(report.values["penetration_max"] < 1e-9 * pair.module());
        prop_assert!(report.values["pairs_in_contact_min"] >= 1.0);
        if pair.backlash() == 0.0 {
            prop_assert!(report.values["transmission_error_max"] < 1e-8);
        }
    }

    #[test]
    fn play_bounded_in_angle_stays_within_the_bound(design in sound_pair(), bound in 1e-4..5e-3_f64) {
        let mut design = design;
        design.teeth.backlash = 0.0;
        design.teeth.backlash_angle = Some(bound);
        let report = check(&GearPair::resolve(&design).expect("valid"));
        let maximum = report.values["backlash_max"];
        prop_assert!(maximum < bound * (1.0 + 2.0 * bound) && maximum > 0.99 * bound, "{maximum} of {bound}");
    }
}
