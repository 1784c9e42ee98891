use super::design::{ArmSpec, Direction, Unpicked};
use super::*;
use centrode_gear::pitch::{Bspline, Circle, PitchSpec};
use centrode_geometry::{Point, Vector};
use centrode_kinematics::transmission::Transmission as _;

pub(super) fn published() -> ThreeArmDesign {
    let pitch = PitchSpec::Bspline(Bspline {
        degree: 2,
        radius: [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]
            .map(f64::from)
            .into(),
        angle: [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345]
            .map(|d| f64::from(d).to_radians())
            .into(),
        ..Bspline::default()
    });
    let arm = ArmSpec::new((-29.0_f64).to_radians(), 145.0, 65.0);
    let bend = (-53.0_f64).to_radians();
    let mut design = ThreeArmDesign::new(pitch, 86.0_f64.to_radians(), bend, arm);
    design.tooth_count = Some(37);
    design.work.picking = Some(20.0_f64.to_radians());
    design.work.planting = Some(191.0_f64.to_radians());
    design
}

fn resolved(design: &ThreeArmDesign) -> ThreeArm {
    ThreeArm::resolve(design).expect("a mechanism")
}

/// With circular gears the intermediate turns twice as fast as the carrier and the planet not at all.
#[test]
fn circular_gears_move_the_arm_in_a_circle_without_turning_it() {
    let mut design = published();
    design.pitch = PitchSpec::Circle(Circle {
        radius: Some(40.0),
        ..Circle::default()
    });
    let mechanism = resolved(&design);
    assert!((mechanism.center_distance() - 80.0).abs() < 1e-12);
    // The intermediate turns by |bend| over the first |bend| of carrier turn.
    assert!((mechanism.train().planet_reference() - 53.0_f64.to_radians()).abs() < 1e-13);
    let radius = 160.0 * (0.5 * design.bend).cos();
    // phi_3 = phi_0 + gamma_0 - phi_30, always.
    let zero = (86.0 - 53.0 - 53.0_f64).to_radians();
    let tip = Vector::new(
        (zero + design.arm.mounting_angle).cos(),
        (zero + design.arm.mounting_angle).sin(),
    );
    for i in 0..30 {
        let theta = 0.3 * f64::from(i);
        let to_planet = design.carrier_start - theta + 0.5 * design.bend;
        let center = Point::new(radius * to_planet.cos(), radius * to_planet.sin());
        let motion = mechanism.tip(theta, 0);
        assert!((motion.position - center - tip * 145.0).norm() < 1e-11);
        assert!((motion.velocity.norm() - radius).abs() < 1e-11);
        assert!((motion.acceleration + center.coords).norm() < 1e-10);
        let intermediate = mechanism.link(ThreeArmLink::Intermediate(0), theta).angle;
        assert!((intermediate.velocity + 2.0).abs() < 1e-12);
    }
    assert!((mechanism.trajectory().height() - 2.0 * radius).abs() < 1e-11);
}

#[test]
fn the_published_set_has_its_figures() {
    let mechanism = resolved(&published());
    let figures = mechanism.figures();
    assert!((mechanism.center_distance() - 82.046_340).abs() < 5e-7);
    assert!((mechanism.train().planet_reference().to_degrees() - 43.514_276).abs() < 5e-7);
    assert!((figures.pick_angle.to_degrees() - 0.616_147).abs() < 5e-7);
    assert!((figures.push_angle.to_degrees() - 51.707_230).abs() < 5e-7);
    assert!((figures.angle_difference.to_degrees() - 52.323_378).abs() < 5e-7);
    assert!((figures.trajectory_height - 370.8206).abs() < 5e-5);
    for (deg, x, y) in [
        (20.0_f64, 243.621_054, 29.807_056),
        (191.0, -68.003_038, -251.993_759),
    ] {
        let tip = mechanism.tip(deg.to_radians(), 0).position;
        assert!((tip - Point::new(x, y)).norm() < 2e-6, "{tip}");
    }
    // Table 1.
    let degrees = |f: &dyn Fn(u32) -> f64| [0, 1, 2].map(|arm| f(arm).to_degrees().round());
    assert_eq!(degrees(&|arm| mechanism.picking(arm)), [20.0, 140.0, 260.0]);
    assert_eq!(
        degrees(&|arm| mechanism.planting(arm)),
        [191.0, 311.0, 71.0]
    );
}

#[test]
fn derivatives_are_those_of_the_motion() {
    let mechanism = resolved(&published());
    let step = 1e-5;
    for link in [
        ThreeArmLink::Sun,
        ThreeArmLink::Carrier,
        ThreeArmLink::Intermediate(1),
        ThreeArmLink::Planet(2),
        ThreeArmLink::Arm(0),
    ] {
        for i in 0..60 {
            let theta = 0.1037 * f64::from(i) + 0.01;
            // A difference across a break of the spline sees two different third derivatives.
            let near = |b: &f64| {
                (0..3).any(|arm| {
                    let own = theta - TAU * f64::from(arm) / 3.0 - b;
                    (own - TAU * (own / TAU).round()).abs() < 3.0 * step
                })
            };
            if mechanism.train().breaks().iter().any(near) {
                continue;
            }
            let at = |theta: f64| mechanism.link(link, theta).point(Point::new(30.0, -110.0));
            let (low, here, high) = (at(theta - step), at(theta), at(theta + step));
            let velocity = (high.position - low.position) / (2.0 * step);
            let acceleration = (high.velocity - low.velocity) / (2.0 * step);
            let size = 1e3 + here.acceleration.norm();
            assert!(
                (velocity - here.velocity).norm() < 1e-7 * size,
                "{link:?} {theta}"
            );
            assert!(
                (acceleration - here.acceleration).norm() < 1e-7 * size,
                "{link:?} {theta}"
            );
        }
    }
}

#[test]
fn gears_in_mesh_touch_at_their_pitch_curves_and_roll() {
    let mechanism = resolved(&published());
    let rolling = mechanism.rolling();
    let a = mechanism.center_distance();
    for i in 0..50 {
        let theta = 0.17 * f64::from(i);
        let arm = i as u32 % 3;
        let [sun, middle, planet] = [
            ThreeArmLink::Sun,
            ThreeArmLink::Intermediate(arm),
            ThreeArmLink::Planet(arm),
        ]
        .map(|l| mechanism.link(l, theta));
        for (driver, driven) in [(sun, middle), (planet, middle)] {
            let line = driven.origin.position - driver.origin.position;
            assert!((line.norm() - a).abs() < 1e-11);
            let along = line.y.atan2(line.x);
            let r = rolling.radius(along - driver.angle.position);
            let touch = driver.origin.position + line * (r / a);
            let local = |of: &LinkMotion| {
                let (sin, cos) = of.angle.position.sin_cos();
                let d = touch - of.origin.position;
                Point::new(cos * d.x + sin * d.y, cos * d.y - sin * d.x)
            };
            // No slip: both bodies move in the same manner where their pitch curves touch.
            let slip =
                driver.point(local(&driver)).velocity - driven.point(local(&driven)).velocity;
            assert!(slip.norm() < 1e-9, "{theta}: {slip}");
            // The driven gear's own pitch curve passes there too.
            let t = rolling.parameter_at_angle(along - driver.angle.position);
            let mate = rolling.frame(centrode_gear::Member::Driven, t).point;
            assert!((mate - local(&driven)).norm() < 1e-9, "{theta}");
        }
    }
}

#[test]
fn every_arm_does_what_the_first_does_later() {
    for arms in 1..=6 {
        let mut design = published();
        design.arms = arms;
        let mechanism = resolved(&design);
        for i in 0..40 {
            let theta = 0.37 * f64::from(i) - 3.0;
            for arm in 0..arms {
                let late = TAU * f64::from(arm) / f64::from(arms);
                let (other, first) = (mechanism.tip(theta, arm), mechanism.tip(theta - late, 0));
                assert!((other.position - first.position).norm() < 1e-12 * 400.0);
                let again = mechanism.tip(theta + TAU, arm);
                assert!((again.position - other.position).norm() < 1e-11);
                let turned = mechanism.clamp(theta + TAU, arm).position;
                assert!((turned - mechanism.clamp(theta, arm).position).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn a_mirrored_machine_does_the_mirrored_motion() {
    let mut design = published();
    design.work.picking = None;
    design.work.planting = None;
    let one = resolved(&design);
    let mut mirrored = design.clone();
    mirrored.direction = Direction::CounterClockwise;
    mirrored.carrier_start = PI - design.carrier_start;
    mirrored.bend = -design.bend;
    mirrored.arm.mounting_angle = -design.arm.mounting_angle;
    mirrored.arm.pusher_offset = -design.arm.pusher_offset;
    if let PitchSpec::Bspline(pitch) = &mut mirrored.pitch {
        pitch.radius.reverse();
        pitch.angle.reverse();
        pitch.angle.iter_mut().for_each(|a| *a = TAU - *a);
    }
    let other = resolved(&mirrored);
    for i in 0..40 {
        let theta = 0.2 * f64::from(i);
        let (p, q) = (one.tip(theta, 1).position, other.tip(theta, 1).position);
        assert!((Point::new(-p.x, p.y) - q).norm() < 1e-10, "{p} {q}");
        let ground = |m: &ThreeArm| m.over_ground(&m.tip(theta, 1), theta).position.x;
        assert!((ground(&one) + ground(&other)).abs() < 1e-10);
    }
    let (a, b) = (one.figures(), other.figures());
    assert!((a.pick_angle - b.pick_angle).abs() < 1e-6);
    assert!((a.push_angle - b.push_angle).abs() < 1e-6);
    assert!((a.gearbox_clearance - b.gearbox_clearance).abs() < 1e-10);
    let [a, b] = [&one, &other].map(ThreeArm::seedling_clearance);
    assert!((a.value - b.value).abs() < 1e-6 && a.seedling == b.seedling);
}

#[test]
fn working_points_are_where_their_rules_say() {
    let mut design = published();
    design.work.picking = None;
    design.work.planting = None;
    let mechanism = resolved(&design);
    let path = mechanism.trajectory();
    assert_eq!(path.picking_rule, PickingRule::Farthest);
    assert!(mechanism.tip(path.picking, 0).velocity.x.abs() < 1e-9);
    assert!(mechanism.tip(path.planting, 0).velocity.y.abs() < 1e-9);
    for i in 0..2000 {
        let tip = mechanism.tip(TAU * f64::from(i) / 2000.0, 0).position;
        assert!(tip.y > path.lowest.reach - 1e-9 && tip.y < path.highest.reach + 1e-9);
        assert!(tip.x < path.farthest.reach + 1e-9);
    }
    // The published picking input is where the tip enters a vertical tray at that tip.
    design.tray.distance = Some(243.621_054);
    let mechanism = resolved(&design);
    assert_eq!(mechanism.trajectory().picking_rule, PickingRule::EntersTray);
    assert!((mechanism.picking(0).to_degrees() - 20.0).abs() < 1e-5);
    design.tray.distance = Some(400.0);
    let error = ThreeArm::resolve(&design).expect_err("out of reach");
    assert_eq!(error.key(), "tray.distance");
}

#[test]
fn a_scaled_design_is_a_scaled_machine() {
    let design = published();
    let mut larger = design.clone();
    let k = 2.5;
    if let PitchSpec::Bspline(pitch) = &mut larger.pitch {
        pitch.radius.iter_mut().for_each(|r| *r *= k);
    }
    for length in [
        &mut larger.arm.tip_distance,
        &mut larger.arm.pusher_offset,
        &mut larger.arm.clamp_length,
        &mut larger.gearbox.housing_offset,
        &mut larger.work.plant_spacing,
        &mut larger.work.planting_depth,
        &mut larger.seedling.height,
        &mut larger.seedling.width,
    ] {
        *length *= k;
    }
    let (one, other) = (resolved(&design), resolved(&larger));
    let (a, b) = (one.figures(), other.figures());
    assert!((b.trajectory_height / a.trajectory_height - k).abs() < 1e-11);
    assert!((b.gearbox_clearance / a.gearbox_clearance - k).abs() < 1e-10);
    assert!((a.pick_angle - b.pick_angle).abs() < 1e-11);
    assert!((a.push_angle - b.push_angle).abs() < 1e-11);
    let modules = a.module.zip(b.module).expect("tooth counts");
    assert!((modules.1 / modules.0 - k).abs() < 1e-11);
    let [a, b] = [&one, &other].map(|m| m.seedling_clearance().value);
    assert!((b / a - k).abs() < 1e-6, "{a} {b}");
}

/// Straight from the model: every low point of the clamp against every stem.
#[test]
fn seedlings_are_as_near_as_brute_force_finds_them() {
    for (spacing, height) in [
        (140.0, 60.0),
        (60.0, 60.0),
        (140.0, 150.0),
        (300.0, 30.0),
        (0.0, 40.0),
    ] {
        let mut design = published();
        design.work.plant_spacing = spacing;
        design.seedling.height = height;
        let mechanism = resolved(&design);
        let release = mechanism.planting(0);
        let over = |input: f64| {
            mechanism
                .over_ground(&mechanism.tip(input, 0), input)
                .position
        };
        let stem = over(release).x;
        let top = mechanism.ground() + height;
        let mut minimum = f64::INFINITY;
        for i in -3600..3600 {
            let input = release + PI * f64::from(i) / 3600.0;
            let direction = mechanism.clamp(input, 0).position;
            let tip = over(input);
            for j in 0..=400 {
                let back = 60.0 * f64::from(j) / 400.0;
                let point = tip - Vector::new(direction.cos(), direction.sin()) * back;
                if point.y > top {
                    continue;
                }
                if i >= 0 {
                    minimum = minimum.min(stem + 2.0 - point.x);
                }
                minimum = minimum.min(point.x - (stem - spacing + 2.0));
            }
        }
        let found = mechanism.seedling_clearance();
        assert!(
            found.value <= minimum + 1e-9,
            "{spacing} {height}: {found:?} {minimum}"
        );
        assert!(
            minimum - found.value < 0.5,
            "{spacing} {height}: {found:?} {minimum}"
        );
    }
}

#[test]
fn the_arm_on_the_carrier_is_a_transmission_of_one_turn() {
    let mechanism = resolved(&published());
    let law = mechanism.train().arm_on_carrier();
    assert!((law.at(TAU).position - law.at(0.0).position - law.advance()).abs() < 1e-12);
    assert!((law.advance() - TAU).abs() < 1e-15);
    let breaks = law.breaks();
    assert!(breaks.len() >= 12 && breaks.is_sorted());
    for &b in &breaks {
        let (before, after) = (law.at(b - 1e-9), law.at(b + 1e-9));
        // The velocity runs on through a break of a quadratic spline, whose own curvature jumps.
        assert!((before.velocity - after.velocity).abs() < 1e-6);
    }
}

#[test]
fn unpicked_rows_stand_above_the_picked_one_whichever_way_the_tray_leans() {
    for (direction, inclination) in [
        (Direction::Clockwise, 0.0),
        (Direction::Clockwise, 0.4),
        (Direction::CounterClockwise, -0.3),
    ] {
        let mut design = published();
        design.direction = direction;
        design.tray.inclination = inclination;
        design.tray.rows = 7;
        for (unpicked, above, below) in [
            (Unpicked::Above, 3, 0),
            (Unpicked::Below, 0, 3),
            (Unpicked::Both, 3, 3),
            (Unpicked::None, 0, 0),
        ] {
            design.tray.unpicked = unpicked;
            let machine = resolved(&design);
            let tray = machine.tray_body();
            let picked = machine.tip(machine.picking(0), 0).position;
            let inward = machine.tray_direction();
            let off = tray.place * Point::origin() - picked;
            assert!(off.norm() < 1e-9, "{off:?}");
            assert!((tray.place * Vector::x() - inward).norm() < 1e-12);
            let middles = tray.stems.iter().map(|stem| {
                let bounds = stem.bounds();
                let root = Point::new(bounds.max.x, 0.5 * (bounds.min.y + bounds.max.y));
                assert!((bounds.min.x + 60.0).abs() < 1e-12 && bounds.max.x == 0.0);
                tray.place * root - picked
            });
            let (mut high, mut low) = (0, 0);
            for middle in middles {
                assert!(middle.dot(&inward).abs() < 1e-9);
                let rows = middle.norm() / 20.0;
                assert!((rows - rows.round()).abs() < 1e-9 && rows > 0.5);
                if middle.y > 0.0 { high += 1 } else { low += 1 }
            }
            assert_eq!((high, low), (above, below), "{unpicked:?}");
        }
    }
}

#[test]
fn seedlings_stay_where_they_were_planted() {
    let mut design = published();
    for direction in [Direction::Clockwise, Direction::CounterClockwise] {
        design.direction = direction;
        let machine = resolved(&design);
        let travel = -machine.train().sign() * machine.advance();
        for arm in 0..3 {
            let release = machine.planting(arm);
            let tip = machine.tip(release, arm).position;
            // Just planted, and a little later, when it is one among those before.
            let newest = machine.planted(release + 1e-9, 1)[0];
            assert!((newest.x - tip.x).abs() < 1e-6 && newest.y == machine.ground());
            let later = 0.4 * TAU;
            let found = machine.planted(release + later, 5);
            let expected = tip.x - travel * later;
            assert!(found.iter().any(|foot| (foot.x - expected).abs() < 1e-6));
            let apart = found.windows(2).map(|pair| (pair[0].x - pair[1].x).abs());
            assert!(apart.into_iter().all(|d| (d - 140.0).abs() < 1e-9));
        }
    }
    design.seedling.width = 0.0;
    assert_eq!(resolved(&design).stem(), None);
}

/// Three spacers, each a third of a turn from the last, and arms that stand further from the gearbox by a head of the covers' screws.
#[test]
fn screws_are_as_many_and_as_large_as_the_plates_take() {
    let mut design = published();
    let mechanism = resolved(&design);
    let arm = mechanism.arm_body().expect("an arm");
    let pusher = mechanism.pusher().expect("a pusher");
    let carrier = mechanism
        .carrier_screws(&arm)
        .expect("asked")
        .expect("room");
    assert_eq!(carrier.screw.name(), "Screw ISO 4762 - M6 x 12");
    assert_eq!(carrier.at.len(), 3);
    for pair in carrier.at.windows(2) {
        let turned = nalgebra::Rotation2::new(std::f64::consts::TAU / 3.0) * pair[0];
        assert!((turned - pair[1]).norm() < 1e-9);
    }
    let covers = mechanism
        .cover_screws(&pusher, &arm)
        .expect("asked")
        .expect("room");
    assert_eq!((covers.screw.diameter, covers.at.len()), (3.0, 4));
    let with = mechanism.arm_level();
    let mut body = mechanism.arm_sizes();
    body.housing.screw = Some(0.0);
    design.arm.body = Some(body);
    design.gearbox.screw = Some(0.0);
    let without = resolved(&design);
    assert_eq!(without.arm_level(), with - 3.0);
    assert_eq!(without.carrier_screws(&arm), None);
    assert_eq!(without.cover_screws(&pusher, &arm), None);
    design.gearbox.screw = Some(5.5);
    let error = ThreeArm::resolve(&design)
        .expect_err("no such screw")
        .to_string();
    assert!(
        error.contains("gearbox.screw must be 0 or the size of a screw"),
        "{error}"
    );
}
