use super::super::design::Direction;
use super::super::tests::published;
use super::*;
use crate::three_arm::ThreeArm;
use proptest::prelude::*;

fn agree(design: &ThreeArmDesign, sweep: &mut Sweep, tolerance: f64) {
    let exact = ThreeArm::resolve(design).expect("a mechanism");
    let (a, b) = (exact.figures(), sweep.figures(design).expect("a mechanism"));
    let size = exact.gearbox_radius() + design.arm.tip_distance;
    let near = |a: f64, b: f64, size: f64| {
        assert!((a - b).abs() <= tolerance * size, "{a} {b}\n{design:?}");
    };
    near(exact.center_distance(), sweep.center_distance(), size);
    // Working points found on a flat crest are right to the root of rounding: so are the angles there.
    let found = design.work.picking.is_none() || design.work.planting.is_none();
    let angle = if found { 3e4 } else { 1.0 };
    near(a.pick_angle, b.pick_angle, angle);
    near(a.push_angle, b.push_angle, angle);
    near(a.angle_difference, b.angle_difference, 2.0 * angle);
    near(a.gearbox_clearance, b.gearbox_clearance, size);
    near(a.trajectory_height, b.trajectory_height, size);
    match (a.module, b.module) {
        (Some(a), Some(b)) => near(a, b, size / 37.0),
        (a, b) => assert_eq!(a, b),
    }
    for (i, [x, y]) in sweep.tips().enumerate() {
        let input = TAU * i as f64 / sweep.tips().len() as f64;
        let tip = exact.tip(input, 0).position;
        near(tip.x, x, size);
        near(tip.y, y, size);
    }
}

#[test]
fn the_published_set_agrees_with_the_exact_mechanism() {
    for degree in 2..=5 {
        let mut design = published();
        if let PitchSpec::Bspline(spline) = &mut design.pitch {
            spline.degree = degree;
        }
        let mut sweep = Sweep::like(&design, 360).expect("of the kind");
        agree(&design, &mut sweep, 1e-9);
        design.work.picking = None;
        design.work.planting = None;
        agree(&design, &mut sweep, 1e-9);
        design.tray.distance = Some(240.0);
        agree(&design, &mut sweep, 1e-9);
        design.direction = Direction::CounterClockwise;
        design.tray.distance = None;
        agree(&design, &mut sweep, 1e-9);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn designs_around_it_agree_too(
        radii in proptest::collection::vec(0.6..1.5_f64, 12),
        turns in proptest::collection::vec(-6.0..6.0_f64, 12),
        bend in -120.0..120.0_f64,
        start in 0.0..360.0_f64,
        length in 80.0..220.0_f64,
        mounting in -90.0..90.0_f64,
        reference in proptest::option::of(-180.0..180.0_f64),
    ) {
        let mut design = published();
        if let PitchSpec::Bspline(spline) = &mut design.pitch {
            spline.radius.iter_mut().zip(&radii).for_each(|(r, k)| *r *= k);
            spline.angle.iter_mut().zip(&turns).for_each(|(a, d)| *a += d.to_radians());
        }
        design.bend = bend.to_radians();
        design.carrier_start = start.to_radians();
        design.arm.tip_distance = length;
        design.arm.mounting_angle = mounting.to_radians();
        design.planet_reference = reference.map(f64::to_radians);
        let mut sweep = Sweep::like(&design, 360).expect("of the kind");
        // Radii that differ tenfold bring the poles of the ratio close.
        agree(&design, &mut sweep, 1e-7);
    }
}

#[test]
fn what_is_no_mechanism_is_refused() {
    let good = published();
    let mut sweep = Sweep::like(&good, 360).expect("of the kind");
    let with = |change: &dyn Fn(&mut Bspline)| {
        let mut design = good.clone();
        if let PitchSpec::Bspline(spline) = &mut design.pitch {
            change(spline);
        }
        design
    };
    for (design, error) in [
        (with(&|s| s.radius[3] = -200.0), SweepError::NotAroundAxis),
        (with(&|s| s.angle.swap(2, 9)), SweepError::NotAroundAxis),
        (with(&|s| s.radius[3] = f64::NAN), SweepError::NotAroundAxis),
        (
            with(&|s| s.radius.truncate(9)),
            SweepError::Points {
                required: 12,
                found: 9,
            },
        ),
        (with(&|s| s.degree = 3), SweepError::Kind),
        (with(&|s| s.interpolate = true), SweepError::Kind),
    ] {
        assert_eq!(sweep.figures(&design), Err(error));
    }
    let mut design = good.clone();
    design.work.picking = None;
    design.tray.distance = Some(900.0);
    assert_eq!(sweep.figures(&design), Err(SweepError::TrayOutOfReach));
    design.tray.distance = Some(-900.0);
    assert_eq!(sweep.figures(&design), Err(SweepError::TrayOutOfReach));
    // A design that failed before leaves no trace.
    agree(&good, &mut sweep, 1e-9);
}

/// Change of the control points of a pitch curve.
type Change<'a> = &'a dyn Fn(&mut Bspline);

/// A variant whose numbers a design file may not have has no figures either.
#[test]
fn control_points_are_refused_like_those_of_a_file() {
    let good = published();
    let mut sweep = Sweep::like(&good, 360).expect("of the kind");
    let degrees = f64::to_radians;
    let cases: [(&str, Change<'_>, bool); 14] = [
        ("r1 = 0", &|s| s.radius[0] = 0.0, false),
        ("r1 = -5", &|s| s.radius[0] = -5.0, false),
        ("r1 = -1e-9", &|s| s.radius[0] = -1e-9, false),
        ("r8 = -0.0", &|s| s.radius[7] = -0.0, false),
        ("r8 = -2", &|s| s.radius[7] = -2.0, false),
        ("theta2 = theta1", &|s| s.angle[1] = s.angle[0], false),
        ("theta2 = 19", &|s| s.angle[1] = degrees(19.0), false),
        ("theta5 = 104.9", &|s| s.angle[4] = degrees(104.9), false),
        ("theta12 = 381", &|s| s.angle[11] = degrees(381.0), false),
        ("r1 = 1e-6", &|s| s.radius[0] = 1e-6, true),
        ("r1 = 5", &|s| s.radius[0] = 5.0, true),
        ("r8 = 11", &|s| s.radius[7] = 11.0, true),
        ("theta2 = 44", &|s| s.angle[1] = degrees(44.0), true),
        ("theta12 = 350", &|s| s.angle[11] = degrees(350.0), true),
    ];
    for (words, change, sound) in cases {
        let mut design = good.clone();
        if let PitchSpec::Bspline(spline) = &mut design.pitch {
            change(spline);
        }
        assert_eq!(sweep.figures(&design).is_ok(), sound, "{words}");
        assert_eq!(ThreeArm::resolve(&design).is_ok(), sound, "{words}");
    }
}

#[test]
fn a_sharp_crest_beside_a_flat_one_is_found() {
    let mut design = published();
    if let PitchSpec::Bspline(spline) = &mut design.pitch {
        spline.radius = vec![
            15.44, 19.19, 38.77, 59.95, 53.01, 40.84, 12.95, 8.63, 27.71, 77.39, 56.96, 23.23,
        ];
        let degrees = [
            15.17, 45.87, 76.77, 102.93, 135.67, 161.28, 200.68, 220.04, 254.13, 289.54, 314.04,
            344.42,
        ];
        spline.angle = degrees.map(f64::to_radians).to_vec();
    }
    design.carrier_start = 328.87_f64.to_radians();
    design.bend = -58.81_f64.to_radians();
    design.arm.mounting_angle = 52.76_f64.to_radians();
    design.arm.tip_distance = 135.13;
    let mut sweep = Sweep::like(&design, 360).expect("of the kind");
    agree(&design, &mut sweep, 1e-7);
}

/// A sweep that other designs went through before gives every digit of a new one.
#[test]
fn the_figures_of_a_design_do_not_depend_on_the_design_before() {
    let designs: Vec<ThreeArmDesign> = (0..24)
        .map(|i| {
            let x = f64::from(i);
            let mut design = published();
            if let PitchSpec::Bspline(spline) = &mut design.pitch {
                for (k, radius) in (0..).zip(&mut spline.radius) {
                    *radius *= 1.0 + 0.2 * (1.7 * x + f64::from(k)).sin();
                }
            }
            design.bend += (0.3 * x).sin();
            design.carrier_start += 0.2 * x;
            design
        })
        .collect();
    for inputs in [32, 120, 360] {
        let fresh = |design: &ThreeArmDesign| {
            let mut sweep = Sweep::like(design, inputs).expect("of the kind");
            let figures = sweep.figures(design);
            (
                figures,
                sweep.tips().collect::<Vec<_>>(),
                sweep.curvatures(),
            )
        };
        let mut used = Sweep::like(&designs[0], inputs).expect("of the kind");
        for (i, design) in designs.iter().chain(designs.iter().rev()).enumerate() {
            let figures = used.figures(design);
            let again = (figures, used.tips().collect::<Vec<_>>(), used.curvatures());
            assert_eq!(again, fresh(design), "{inputs} {i}");
        }
    }
}
