use super::*;
use crate::forces::Forces;
use centrode_kinematics::linkage::Branch;
use centrode_machines::feeder::{FeederDesign, FeederPart, LinkageSpec};

fn feeder([crank, coupler, rocker, frame]: [f64; 4], pivot: [f64; 2]) -> Feeder {
    let design = FeederDesign::new(LinkageSpec {
        crank,
        coupler,
        rocker,
        frame,
        branch: Branch::Upper,
        pivot,
        effector_length: 200.0,
    });
    Feeder::resolve(&design).expect("resolves")
}

fn rules(report: &Report) -> Vec<&'static str> {
    report.findings.iter().map(|f| f.rule).collect()
}

#[test]
fn the_published_bounds_contradict_the_published_transmission_angle() {
    let feeder = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05]);
    let report = check_feeder(&feeder);
    assert_eq!(rules(&report), ["transmission-angle", "pivot-on-chord"]);
    let message = &report.findings[0].message;
    for part in ["8.2243 deg", "missed by 31.7757 deg", "12.312", "22.443 %"] {
        assert!(message.contains(part), "{part}: {message}");
    }
    let value = |name: &str| report.values[name];
    assert!((value("rocker_swing").to_degrees() - 116.235_306).abs() < 5e-7);
    assert!((value("coupler_rocker_angle_max").to_degrees() - 82.9016).abs() < 5e-5);
    assert!((value("crank_quick_return") - 2.4015).abs() < 5e-5);
    assert!(value("tip_speed_ends_max") < 1e-9);
    assert!(value("quick_return") > 1.0);
    assert!((value("feed_rate") - 55.5556).abs() < 5e-5);
    // The times are those of the whole cycle.
    let cycle = value("feed_time") + value("return_time") + value("dwell_time");
    assert!((cycle - 60.0 / feeder.cycles_per_minute()).abs() < 1e-12);
}

#[test]
fn each_goal_that_is_missed_is_found() {
    let lengths = [77.0, 147.0, 127.0, 105.0];
    let mut design = feeder(lengths, [106.83, 67.05]).design().clone();
    design.goals.transmission_angle = 5_f64.to_radians();
    let found = |change: &dyn Fn(&mut FeederDesign)| {
        let mut design = design.clone();
        change(&mut design);
        rules(&check_feeder(&Feeder::resolve(&design).expect("resolves")))
    };
    assert_eq!(found(&|_| ()), ["pivot-on-chord"]);
    let beside = found(&|d| d.linkage.pivot[1] = 50.0);
    assert_eq!(beside, ["swing", "swing-spread"]);
    assert!(found(&|d| d.bounds.crank = [78.0, 81.0]).contains(&"crank-bounds"));
    assert!(found(&|d| d.drive.slots = 4).contains(&"feed-rate"));
    assert!(found(&|d| d.goals.pushing_time = 1.06).contains(&"dwell"));
    assert!(found(&|d| d.goals.quick_return = 2.5).contains(&"quick-return"));
    assert!(found(&|d| d.making.length_tolerance = 0.5).contains(&"swing-spread"));
    let within = found(&|d| d.goals.transmission_angle = 9_f64.to_radians());
    assert!(within.contains(&"transmission-angle"));
}

#[test]
fn bounds_that_allow_the_angle_need_no_widening() {
    let mut design = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05])
        .design()
        .clone();
    design.goals.transmission_angle = 12_f64.to_radians();
    let found = Attainable::search(&design).expect("found");
    assert_eq!(found.widening, None);
    assert!((found.transmission_angle.to_degrees() - 12.312).abs() < 5e-4);
    let report = check_feeder(&Feeder::resolve(&design).expect("resolves"));
    assert!(
        report.findings[0]
            .message
            .contains("the maximum found within the bounds is 12.31")
    );
}

/// Power of crank and intermittent gear is the growth of the links' energy, and the force of the tip's mass in F is its weight.
#[test]
fn the_crank_moves_the_masses_of_the_plates() {
    let feeder = feeder([59.718, 105.477, 98.497, 129.79], [84.118, 63.61]);
    let [empty, full] =
        [0.0, 2.0].map(|carried| FeederForces::new(&feeder, carried).expect("plates"));
    let at = |forces: &FeederForces, input, moving| forces.at(input, moving).expect("it turns");
    let step = 1e-4;
    let power = |forces: &Forces, turned: f64| {
        // The intermittent gear, out of balance, turns clockwise as fast as the input.
        FeederForces::torque(forces) * turned - forces.joints[FeederPart::ALL.len() - 1].drive
    };
    for i in 1..40 {
        let input = 0.1 * f64::from(i);
        let turned = feeder.crank(input);
        // At rest, the torque is the slope of the height of all masses: nothing but weight.
        for system in [&empty, &full] {
            let energy = |x: f64| at(system, x, false).potential_energy;
            let slope = (energy(input + step) - energy(input - step)) / (2.0 * step);
            let power_still = power(&at(system, input, false), turned.velocity);
            assert!((power_still - slope).abs() < 1e-5 * (1.0 + slope.abs()));
            let whole = |x: f64| {
                let forces = at(system, x, true);
                forces.potential_energy + forces.kinetic_energy
            };
            let slope = (whole(input + step) - whole(input - step)) / (2.0 * step);
            let power_moving = power(&at(system, input, true), turned.velocity);
            assert!((power_moving - slope).abs() < 1e-4 * (1.0 + slope.abs()));
        }
        let raised = feeder.tip(input).y;
        let more =
            at(&full, input, false).potential_energy - at(&empty, input, false).potential_energy;
        assert!((more - 2.0 * 9.80665 * raised).abs() < 1e-9 * (1.0 + more.abs()));
    }
    assert!(FeederForces::new(&feeder, -1.0).is_err());
    let report = check_feeder(&feeder);
    let still = FeederForces::torque(&at(&empty, 0.0, false)).abs();
    assert!(report.values["crank_torque_still_max"] >= still);
    assert!(
        report
            .tables
            .iter()
            .any(|table| table.name == "joint_forces" && table.rows.len() == 7)
    );
}

/// Maximum torque and joint forces at so many inputs of a cycle and on both sides of every break.
fn maximum_seen(feeder: &Feeder, moving: bool) -> [f64; 8] {
    const COUNT: u32 = 14_400;
    let system = FeederForces::analyse(feeder).expect("plates");
    let even = (0..COUNT).map(|i| TAU * f64::from(i) / f64::from(COUNT));
    let breaks = feeder.breaks();
    let beside = breaks.iter().flat_map(|&b| [b.next_down(), b]);
    let mut maximum = [0.0_f64; 8];
    for input in even.chain(beside.filter(|&b| b >= 0.0)) {
        let forces = system.at(input, moving).expect("it turns");
        let joints = FeederForces::joints(&forces).map(|force| force.norm());
        let sizes = std::iter::once(FeederForces::torque(&forces).abs()).chain(joints);
        for (maximum, size) in maximum.iter_mut().zip(sizes) {
            *maximum = maximum.max(size);
        }
    }
    maximum
}

#[test]
fn no_torque_or_joint_force_is_above_the_greatest_stated() {
    let feeder = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05]);
    let report = check_strokes(&feeder);
    let table = report.tables.iter().find(|t| t.name == "joint_forces");
    let rows = &table.expect("a table").rows;
    let torques = ["crank_torque_still_max", "crank_torque_moving_max"];
    for (column, moving) in [false, true].into_iter().enumerate() {
        let joints = rows.iter().map(|(_, row)| row[column]);
        let stated = std::iter::once(report.values[torques[column]]).chain(joints);
        for (k, (stated, seen)) in stated.zip(maximum_seen(&feeder, moving)).enumerate() {
            // Even samples miss a smooth peak by about a millionth.
            let near = stated >= seen && stated <= seen * (1.0 + 1e-5);
            assert!(near, "{k}, moving {moving}: {stated} {seen}");
        }
    }
}

/// The force on the sides of the key is the torque over half the shaft: a heavier load presses it beyond what steel bears.
#[test]
fn a_key_that_is_pressed_too_hard_is_found() {
    let light = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05]);
    assert!(!rules(&check_strokes(&light)).contains(&"key-pressure"));
    let report = |carried: f64, material: &str| {
        let mut design = light.design().clone();
        design.drive.carried_mass = carried;
        design.plates.material = material.into();
        check_strokes(&Feeder::resolve(&design).expect("resolves"))
    };
    let found = |report: &Report| -> Vec<Finding> {
        let all = report.findings.iter();
        all.filter(|f| f.rule == "key-pressure").cloned().collect()
    };
    let loaded = report(60.0, "steel");
    let values = &loaded.values;
    let torque = values["crank_torque_moving_max"].max(values["crank_torque_still_max"]);
    let all = found(&loaded);
    let stated: Vec<_> = all.iter().filter_map(|f| f.place.part.as_deref()).collect();
    assert_eq!(stated, ["crank", "gear-driven", "gear-driver"], "{torque}");
    // The other shaft carries the torque of the input.
    let heavy = Feeder::resolve(&{
        let mut design = light.design().clone();
        design.drive.carried_mass = 60.0;
        design
    });
    let system = FeederForces::analyse(&heavy.expect("resolves")).expect("forces");
    let seen = (0..20_000).flat_map(|i| {
        let input = std::f64::consts::TAU * f64::from(i) / 20_000.0;
        [false, true].map(|moving| system.at(input, moving).expect("forces").input_torque.abs())
    });
    let pressure = seen.fold(0.0, f64::max) / 8.0 / (2.0 * 9.0);
    let stated = values["gear_driver_key_pressure_max"];
    assert!(
        stated >= pressure * (1.0 - 1e-9) && stated < pressure * 1.001,
        "{stated} {pressure}"
    );
    assert!(stated > 0.9 * 235.0);
    // On a shaft of 16 mm: 2 mm of the crank's key, 8 mm long, and of the gear's, 14 mm less its round ends.
    for (part, bears) in [("crank", 8.0), ("gear-driven", 9.0)] {
        let here = all.iter().find(|f| f.place.part.as_deref() == Some(part));
        let finding = here.expect(part);
        let pressure = torque / 8.0 / (2.0 * bears);
        assert!((finding.measured.expect("a pressure") - pressure).abs() < 1e-6 * pressure);
        assert!((finding.required.expect("a pressure") - 0.9 * 235.0).abs() < 1e-9);
        assert!(finding.remedy.is_some() && finding.place.input.is_some());
    }
    // The shaft is the weaker side of a crank of better steel; of other materials the design tells no strength.
    assert_eq!(found(&report(60.0, "S355")).len(), 3);
    let parts: Vec<_> = found(&report(60.0, "aluminium alloy"))
        .into_iter()
        .filter_map(|f| f.place.part)
        .collect();
    assert_eq!(parts, ["gear-driven", "gear-driver"]);
}

/// The upper limit of a pin m6 up to 6 and 10 mm is 12 and 15 um (ISO 286-1); at rest the backlash leaves it
/// `(b/2 r_b) c a sin(w)/l`, with its circle's radius c, the centre distance a and its distance l from the driver's axis.
#[test]
fn a_pin_at_its_upper_limit_must_clear_its_cam() {
    // Backlash, diameter of the pins, their angle, and the upper deviation, um.
    for (backlash, diameter, angle, upper) in [
        (0.1, None, 45.0, 15.0),
        (0.1, Some(6.0), 45.0, 12.0),
        (0.0, None, 45.0, 15.0),
        (0.01, None, 45.0, 15.0),
        (0.02, Some(6.0), 45.0, 12.0),
        (0.03, None, 30.0, 15.0),
        (0.05, Some(10.0), 50.0, 15.0),
        (0.1, None, 8.0, 15.0),
        (0.015, Some(6.0), 60.0, 12.0),
        (0.025, Some(8.0), 55.0, 15.0),
    ] {
        let mut design = feeder([77.0, 147.0, 127.0, 105.0], [106.83, 67.05])
            .design()
            .clone();
        design.gears.backlash = backlash;
        design.gears.pin_diameter = diameter;
        design.gears.pin_angle = f64::to_radians(angle);
        let mut report = Report::default();
        gears::gears(&Feeder::resolve(&design).expect("resolves"), &mut report);
        let (base, circle, a) = (45.0 * f64::cos(f64::to_radians(20.0)), 33.75, 105.0);
        let (sin, cos) = f64::to_radians(angle).sin_cos();
        let at_rest = f64::hypot(a - circle * cos, circle * sin);
        let clearance = 0.5 * backlash / base * circle * a * sin / at_rest - 5e-4 * upper;
        let found = report.values["gear_pin_clearance_min"];
        assert!(
            (found - clearance).abs() < 1e-3,
            "{backlash} {angle}: {found} {clearance}"
        );
        let finding = report
            .findings
            .iter()
            .find(|f| f.rule == "cam-pin-clearance");
        assert_eq!(finding.is_some(), found < 0.0, "{backlash} {angle}");
        assert!(finding.is_none_or(|f| f.measured == Some(found) && f.place.input.is_some()));
    }
}
