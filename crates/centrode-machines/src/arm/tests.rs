use super::*;
use centrode_geometry::{Outline, Point, Segment, Tolerance};

fn published(spec: &ArmBodySpec) -> Result<ArmBody, ArmError> {
    ArmBody::new(spec, 145.0, 65.0, 60.0)
}

/// Whether every point of one outline lies in another or within rounding of it.
fn within(inner: &Outline, outer: &Outline) -> bool {
    let large = Tolerance::new(1e-3).expect("positive");
    let centroid = inner.centroid();
    inner.flatten(large).iter().all(|p| {
        let shrunk = centroid + (p - centroid) * (1.0 - 1e-9);
        outer.contains(shrunk)
    })
}

#[test]
fn the_arm_is_one_simple_contour_of_lines_and_arcs_that_ends_at_the_tip() {
    let arm = published(&ArmBodySpec::default()).expect("an arm");
    let outline = arm.outline();
    assert!(outline.is_counter_clockwise() && outline.crossing().is_none());
    let smooth = |s: &Segment| matches!(s, Segment::Poly(_));
    assert!(!outline.segments().iter().any(smooth));
    let tip = arm.tip();
    assert!((tip.coords.norm() - 145.0).abs() < 1e-12 && tip.y == -65.0);
    // The clamp's direction is that of the tip turned by asin(H/S) = 26.63 deg.
    let turn = -tip.y.atan2(tip.x);
    assert!((turn.to_degrees() - 26.634).abs() < 1e-3);
    let bounds = outline.bounds();
    assert!((bounds.max.x - tip.x).abs() < 1e-12);
    assert!((bounds.max.y - 32.0).abs() < 1e-12 && (bounds.min.y + 78.0).abs() < 1e-12);
    // Drum, tube, both belts and the clamp: an area between that of the housing and of housing and flake.
    let area = |name: &str| {
        let part = arm.parts().iter().find(|p| p.name == name);
        part.expect("a part").outline.area()
    };
    let whole = outline.area();
    assert!(whole > area("housing") && whole < area("housing") + area("flake-left"));
}

#[test]
fn every_part_lies_in_the_arm() {
    for (distance, offset, clamp) in [
        (145.0, 65.0, 60.0),
        (145.0, -65.0, 60.0),
        (170.0, 50.0, 70.0),
    ] {
        let arm = ArmBody::new(&ArmBodySpec::default(), distance, offset, clamp).expect("an arm");
        assert_eq!(arm.parts().len(), 8);
        for part in arm.parts() {
            assert!(part.outline.is_counter_clockwise(), "{}", part.name);
            assert!(part.outline.crossing().is_none(), "{}", part.name);
            assert!(part.span[0] < part.span[1], "{}", part.name);
            assert!(
                within(&part.outline, arm.outline()),
                "{} {offset}",
                part.name
            );
        }
    }
}

#[test]
fn an_arm_on_the_other_side_is_the_mirror_image() {
    let spec = ArmBodySpec::default();
    let here = published(&spec).expect("an arm");
    let there = ArmBody::new(&spec, 145.0, -65.0, 60.0).expect("an arm");
    assert!((there.tip() - Point::new(here.tip().x, 65.0)).norm() < 1e-12);
    assert!((there.outline().area() - here.outline().area()).abs() < 1e-9);
    let (a, b) = (here.outline().centroid(), there.outline().centroid());
    assert!((a.x - b.x).abs() < 1e-11 && (a.y + b.y).abs() < 1e-11);
}

#[test]
fn a_scaled_arm_is_the_arm_scaled() {
    let spec = ArmBodySpec::default();
    let arm = published(&spec).expect("an arm");
    for k in [1e-3, 7.0, 1e4] {
        let large = ArmBody::new(&spec.scaled(k), 145.0 * k, 65.0 * k, 60.0 * k).expect("an arm");
        let pairs = large
            .outline()
            .segments()
            .iter()
            .zip(arm.outline().segments());
        assert_eq!(
            large.outline().segments().len(),
            arm.outline().segments().len()
        );
        for (a, b) in pairs {
            assert!((a.start() - b.start() * k).norm() < 1e-11 * 145.0 * k);
        }
    }
}

#[test]
fn an_arm_that_cannot_be_is_refused_by_name() {
    let with = |change: fn(&mut ArmBodySpec)| {
        let mut spec = ArmBodySpec::default();
        change(&mut spec);
        published(&spec).expect_err("no arm")
    };
    let key = |error: ArmError| match error {
        ArmError::Spec(error) => error.key,
        other => panic!("{other}"),
    };
    assert_eq!(
        key(with(|s| s.housing.drum_radius = 0.0)),
        "housing.drum_radius"
    );
    assert_eq!(
        key(with(|s| s.clamp.tip_height = f64::NAN)),
        "clamp.tip_height"
    );
    assert_eq!(key(with(|s| s.push_rod.stroke = -1.0)), "push_rod.stroke");
    assert!(matches!(
        with(|s| s.clamp.root_height = 20.0),
        ArmError::ClampTooHigh { .. }
    ));
    assert!(matches!(
        with(|s| s.push_rod.diameter = 13.0),
        ArmError::TooLarge { .. }
    ));
    assert!(matches!(
        with(|s| s.spring.length = 90.0),
        ArmError::TooLarge { .. }
    ));
    let spec = ArmBodySpec::default();
    let zero = ArmBody::new(&spec, 0.0, 0.0, 60.0).expect_err("no arm");
    assert_eq!(key(zero), "tip_distance");
    let beyond = ArmBody::new(&spec, 145.0, 150.0, 60.0).expect_err("no arm");
    assert_eq!(key(beyond), "pusher_offset");
    let long = ArmBody::new(&spec, 145.0, 65.0, 140.0).expect_err("no arm");
    assert!(matches!(long, ArmError::NoTube { .. }));
    let short = ArmBody::new(&spec, 145.0, 65.0, 2.0).expect_err("no arm");
    assert!(matches!(short, ArmError::ClampTooShort { .. }), "{short}");
}

#[test]
fn random_arms_are_simple_or_refused() {
    let mut seed = 3_u64;
    let mut size = |minimum: f64, maximum: f64| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        minimum + (maximum - minimum) * (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut made, mut refused) = (0, 0);
    for _ in 0..2000 {
        let mut spec = ArmBodySpec::default();
        spec.housing.drum_radius = size(5.0, 90.0);
        spec.housing.tube_radius = size(8.0, 30.0);
        spec.housing.tube_back = size(0.0, 60.0);
        spec.clamp.root_height = size(5.0, 40.0);
        spec.clamp.tip_height = size(5.6, 20.0);
        spec.housing.bore = 4.0;
        match ArmBody::new(
            &spec,
            size(50.0, 300.0),
            size(-150.0, 150.0),
            size(5.0, 150.0),
        ) {
            Ok(arm) => {
                made += 1;
                assert!(arm.outline().crossing().is_none() && arm.outline().is_counter_clockwise());
            }
            Err(_) => refused += 1,
        }
    }
    assert!(made > 200 && refused > 200, "{made} {refused}");
}
