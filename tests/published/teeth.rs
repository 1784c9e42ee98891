use std::f64::consts::TAU;

use centrode_gear::GearPair;
use centrode_gear::design::{GearPairDesign, Phase};
use centrode_gear::pitch::{Circle, Ellipse, PitchSpec};
use centrode_geometry::{Outline, Point, Segment};
use proptest::prelude::{ProptestConfig, prop_assert, proptest};

use crate::data::{CircularGear, EllipticPair, cases};

/// How far an outline may be from the exact profile, mm.
const EXACT: f64 = 1e-9;

fn pair(pitch: PitchSpec) -> GearPair {
    let mut design = GearPairDesign::new(pitch);
    design.teeth.phase = Phase::Tooth;
    GearPair::resolve(&design).expect("the pair exists")
}

fn elliptic(case: &EllipticPair) -> GearPair {
    pair(PitchSpec::Ellipse(Ellipse {
        eccentricity: case.eccentricity,
        module: Some(case.module),
        tooth_count: Some(case.tooth_count),
        ..Ellipse::default()
    }))
}

fn circular(case: &CircularGear) -> GearPair {
    pair(PitchSpec::Circle(Circle {
        module: Some(case.module),
        tooth_count: Some(case.tooth_count),
        ..Circle::default()
    }))
}

/// Distance from a point to a segment: the nearest of seventeen samples, then Newton.
fn distance_to_segment(segment: &Segment, point: Point) -> f64 {
    let away = |u: f64| (segment.at(u).point - point).norm();
    let samples = (0..=16).map(|i| -1.0 + 0.125 * f64::from(i));
    let mut u = samples
        .min_by(|a, b| away(*a).total_cmp(&away(*b)))
        .unwrap_or(0.0);
    let mut minimum = away(u);
    for _ in 0..12 {
        let jet = segment.at(u);
        let gap = jet.point - point;
        let rate = jet.first.norm_squared() + gap.dot(&jet.second);
        u = (u - gap.dot(&jet.first) / rate).clamp(-1.0, 1.0);
        minimum = minimum.min(away(u));
    }
    minimum
}

fn distance(outline: &Outline, point: Point) -> f64 {
    let segments = outline.segments().iter();
    segments
        .map(|s| distance_to_segment(s, point))
        .fold(f64::INFINITY, f64::min)
}

/// Area inside an outline, by Gauss-Legendre quadrature of half the cross product.
fn area(outline: &Outline) -> f64 {
    const NODES: [(f64, f64); 5] = [
        (0.148_874_338_981_631_2, 0.295_524_224_714_752_87),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982_05),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
    ];
    let half = |segment: &Segment, u: f64| {
        let jet = segment.at(u);
        0.5 * jet.point.coords.perp(&jet.first)
    };
    let of = |s: &Segment| -> f64 {
        NODES
            .iter()
            .map(|&(u, w)| w * (half(s, u) + half(s, -u)))
            .sum()
    };
    outline.segments().iter().map(of).sum()
}

fn polar(radius: f64, angle: f64) -> Point {
    Point::new(radius * angle.cos(), radius * angle.sin())
}

#[test]
fn circular_gears_are_the_exact_involute_and_trochoid() {
    for case in cases::<CircularGear>("circular_gears") {
        let pair = circular(&case);
        let outline = pair.driver().outline();
        let (z, mut worst) = (case.tooth_count, 0.0_f64);
        for [radius, angle] in case.flank.iter().chain(&case.fillet) {
            for (tooth, side) in [(0, 1.0), (0, -1.0), (1, 1.0), (z / 2, -1.0), (z - 1, 1.0)] {
                let turned = TAU * f64::from(tooth) / f64::from(z) + side * angle;
                worst = worst.max(distance(outline, polar(*radius, turned)));
            }
        }
        assert!(worst < EXACT, "z = {z}: {worst:e} mm");
        let (minimum, maximum) = pair.driver().radii();
        assert!((minimum - case.root_radius).abs() < EXACT);
        assert!((maximum - case.tip_radius).abs() < EXACT);
        let area = area(outline);
        assert!(
            (area - case.area).abs() < 1e-9 * case.area,
            "z = {z}: {area}"
        );
    }
}

#[test]
fn circular_gears_are_undercut_exactly_where_the_oracle_says() {
    for case in cases::<CircularGear>("circular_gears") {
        let pair = circular(&case);
        for tooth in pair.driver().teeth() {
            for side in [&tooth.leading, &tooth.trailing] {
                assert_eq!(
                    side.undercut > 0.0,
                    case.undercut,
                    "z = {}",
                    case.tooth_count
                );
            }
        }
    }
}

#[test]
fn elliptic_gears_have_the_exact_flanks_and_fillets() {
    for case in cases::<EllipticPair>("elliptic_pair") {
        let pair = elliptic(&case);
        let (driver, driven) = (pair.driver().outline(), pair.driven().outline());
        assert!(
            (pair.center_distance() - case.center_distance).abs() < 1e-12 * case.center_distance
        );
        for row in &case.flank {
            let [.., x, y, other_x, other_y] = *row;
            let off = distance(driver, Point::new(x, y));
            assert!(off < EXACT, "driver {row:?}: {off:e} mm");
            let off = distance(driven, Point::new(other_x, other_y));
            assert!(off < EXACT, "driven {row:?}: {off:e} mm");
        }
        for row in &case.fillet {
            let off = distance(driver, Point::new(row[3], row[4]));
            assert!(off < EXACT, "fillet {row:?}: {off:e} mm");
        }
        for [phi, driven] in case.driven_angle {
            assert!((pair.driven_angle(phi) - driven).abs() < 1e-12);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4))]

    #[test]
    fn a_point_moved_off_the_profile_is_seen(offset in 2e-9..1e-3_f64) {
        // The comparison above can fail: a profile wrong by more than its bound does not pass.
        for case in cases::<CircularGear>("circular_gears") {
            let pair = circular(&case);
            let [radius, angle] = case.flank[6];
            let off = distance(pair.driver().outline(), polar(radius, angle + offset / radius));
            prop_assert!(off > 0.4 * offset);
        }
    }
}

#[test]
fn the_2018_ellipse_bears_modules_up_to_2_8616_and_none_above() {
    let pair_at = |tooth_count: u32, pitches: f64| {
        let mut design = GearPairDesign::new(PitchSpec::Ellipse(Ellipse {
            eccentricity: 1.0 / (2.0 + 3.0_f64.sqrt()),
            semi_major_axis: Some(26.354_610_379),
            ..Ellipse::default()
        }));
        design.tooth_count = Some(tooth_count);
        design.teeth.phase = Phase::Pitches(pitches);
        GearPair::resolve(&design).expect("the pair exists")
    };
    let pair = pair_at(23, 0.0);
    let limits = pair.limits();
    // 24.46243 sin^2 20 deg, for a straight flank exactly one module deep.
    assert!((pair.largest_addendum() - 2.861_561).abs() < 1e-6);
    assert!((limits.largest_module - 2.8616).abs() < 1e-4);
    let undercut = |tooth_count: u32| {
        (0..40).any(|i| {
            let pair = pair_at(tooth_count, f64::from(i) / 40.0);
            let sides = pair
                .driver()
                .teeth()
                .iter()
                .flat_map(|t| [t.leading, t.trailing]);
            sides.map(|s| s.undercut).fold(0.0, f64::max) > 0.0
        })
    };
    // Nineteen teeth have the module 2.7237, eighteen 2.8750.
    assert!(!undercut(23) && !undercut(19));
    assert!(undercut(18));
}
