use super::*;
use centrode_gear::pitch::{Limacon, PitchSpec};
use centrode_machines::three_arm::GearMesh;
use centrode_machines::three_arm::design::{Direction, ThreeArmDesign};
use centrode_spec::DesignSpec as _;

/// Gentle gears with full teeth, three chains as published.
fn gentle(change: impl Fn(&mut ThreeArmDesign)) -> (ThreeArm, GearPair) {
    let mut design = ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("sound");
    design.pitch = PitchSpec::Limacon(Limacon {
        mean_radius: 45.0,
        amplitude: 7.0,
        lobes: 1,
        module: None,
        diametral_pitch: None,
        tooth_count: None,
    });
    design.tooth_count = Some(36);
    design.teeth = centrode_gear::design::TeethSpec {
        backlash: 0.05,
        ..Default::default()
    };
    design.work.picking = None;
    design.work.planting = None;
    change(&mut design);
    let mechanism = ThreeArm::resolve(&design).expect("a mechanism");
    let pair = mechanism.pair().expect("teeth");
    (mechanism, pair)
}

/// Both gears of every mesh placed by the links: contact keeps the law, and nothing penetrates.
#[test]
fn all_six_meshes_carry_their_law_over_a_whole_cycle() {
    let (mechanism, pair) = gentle(|_| {});
    for mesh in mechanism.meshes() {
        let poses: Vec<[f64; 2]> = (0..73)
            .map(|i| {
                let pose = mechanism.mesh_pose(mesh, TAU * f64::from(i) / 73.0);
                let law = pair.driven_angle(pose.driver);
                let turns = TAU * ((pose.driven - law) / TAU).round();
                [pose.driver, pose.driven - turns]
            })
            .collect();
        let contact = Contact::posed(&pair, &poses);
        let worst = |list: &[f64]| list.iter().map(|e| e.abs()).fold(0.0, f64::max);
        assert!(worst(&contact.transmission_error) < 1e-6, "{mesh:?}");
        assert!(
            worst(&contact.reverse_transmission_error) < 1e-6,
            "{mesh:?}"
        );
        assert!(worst(&contact.penetration) < 1e-9 && contact.contacts.iter().all(|&n| n > 0));
    }
}

/// Poses with the intermediate gear turned by half a pitch are seen not to mesh.
#[test]
fn a_mesh_half_a_pitch_off_is_seen() {
    let (mechanism, pair) = gentle(|_| {});
    let pose = mechanism.mesh_pose(GearMesh::Planet(1), 0.4);
    let half_pitch = 0.5 * TAU / 36.0;
    let contact = Contact::posed(&pair, &[[pose.driver, pose.driven + half_pitch]]);
    let off = contact.transmission_error[0].abs();
    assert!(off > 0.1 * half_pitch, "{off}");
}

fn toothed(change: impl Fn(&mut ThreeArmDesign)) -> (ThreeArm, TrainTeeth) {
    let (mechanism, pair) = gentle(change);
    (mechanism, TrainTeeth::run(pair))
}

/// A fault at a polar angle of the sun is reported at the carrier turn at which it is met there.
#[test]
fn a_finding_of_the_teeth_is_told_at_the_carriers_turn() {
    for direction in [Direction::Clockwise, Direction::CounterClockwise] {
        let (mechanism, mut teeth) = toothed(|d| d.direction = direction);
        let at = teeth.contact.input.len() / 5;
        teeth.contact.penetration[at] = 0.5;
        teeth.checked = check_contact(&teeth.pair, &teeth.contact);
        let mut report = Report::default();
        check_gear_train(&mechanism, &teeth, &mut report);
        let found = report.findings.iter().find(|f| f.rule == "interference");
        let input = found.and_then(|f| f.place.input).expect("an input");
        let met = mechanism.mesh_pose(GearMesh::Sun(0), input).driver;
        let off = (met - teeth.contact.input[at]).rem_euclid(TAU);
        assert!(off.min(TAU - off) < 1e-9, "{direction:?}: {off}");
    }
}

#[test]
fn the_check_tells_phases_contact_and_clearance() {
    let (mechanism, teeth) = toothed(|_| {});
    let mut report = Report::default();
    check_gear_train(&mechanism, &teeth, &mut report);
    assert!(report.findings.is_empty(), "{:?}", report.findings);
    assert!(report.values["mesh_phase_error_max"] < 1e-11);
    assert!(report.values["transmission_error_max"] < 1e-6);
    assert!(report.values["pairs_in_contact_min"] >= 1.0);
    assert!(report.values["gear_clearance"] > 10.0);
}

#[test]
fn gears_of_neighbouring_chains_that_collide_are_told() {
    // Six intermediate gears around one sun: their axes are as far apart as those in mesh.
    let (mechanism, teeth) = toothed(|d| d.arms = 6);
    let mut report = Report::default();
    check_gear_train(&mechanism, &teeth, &mut report);
    let found = report.findings.iter().find(|f| f.rule == "gears-collide");
    let found = found.expect("they penetrate");
    assert!(
        found.message.contains("intermediate gear"),
        "{}",
        found.message
    );
    assert!(found.measured.expect("measured") <= 0.0);
    assert!(!report.ok());
}
