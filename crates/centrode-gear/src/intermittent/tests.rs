use std::f64::consts::TAU;

use super::{IntermittentPair, IntermittentPairError, IntermittentPairSpec};
use crate::design::GearPairDesign;
use crate::pitch::{Circle, PitchSpec};
use centrode_kinematics::transmission::Transmission;

/// Teeth round driver and driven gear, if complete, in lowest terms of their ratio.
fn circles(driver: u32, mean_ratio: [u32; 2]) -> GearPairDesign {
    let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
        module: Some(3.0),
        tooth_count: Some(driver),
        ..Circle::default()
    }));
    design.mean_ratio = mean_ratio;
    design.driver.bore = 20.0;
    design.driven.bore = 20.0;
    design
}

fn forty_to_thirty(entry: f64) -> IntermittentPairSpec {
    IntermittentPairSpec::new(circles(40, [3, 4]), 30, entry)
}

#[test]
fn one_driven_turn_a_driver_turn_and_then_rest() {
    for entry in [0.0, 0.35] {
        let pair = IntermittentPair::resolve(&forty_to_thirty(entry)).expect("a pair");
        assert!((pair.center_distance() - 105.0).abs() < 1e-9);
        assert!((pair.lock_radius() - 60.0).abs() < 1e-9);
        let law = pair.law();
        assert!((law.motion_angle() - 0.75 * TAU - entry).abs() < 1e-9);
        assert!((law.advance() - TAU).abs() < 1e-9);
        assert!((law.at(TAU).position - TAU).abs() < 1e-9);
        assert_eq!(law.at(law.motion_angle() + 0.1).velocity, 0.0);
        // Fewer than the thirty pitches driven: the locking arc replaces some.
        assert!((24..=30).contains(&pair.teeth()), "{}", pair.teeth());
        assert_eq!(pair.cams().len(), if entry > 0.0 { 2 } else { 0 });
        assert_eq!(pair.shock() == 0.0, entry > 0.0);
        assert!(pair.driver().is_counter_clockwise() && pair.driver().crossing().is_none());
        assert!(pair.driven().is_counter_clockwise() && pair.driven().crossing().is_none());
    }
}

#[test]
fn what_is_no_intermittent_pair_is_refused() {
    let refused = |change: &dyn Fn(&mut IntermittentPairSpec)| {
        let mut spec = forty_to_thirty(0.0);
        change(&mut spec);
        IntermittentPair::resolve(&spec).expect_err("refused")
    };
    assert_eq!(refused(&|s| s.teeth = 0).key(), "teeth");
    let equal = refused(&|s| s.pair = circles(30, [1, 1]));
    assert!(matches!(
        equal,
        IntermittentPairError::NoDwell { kept: 30, .. }
    ));
    // The whole turn goes to entry and exit: a dwell of nothing.
    assert!(matches!(
        refused(&|s| s.entry = 0.26 * TAU),
        IntermittentPairError::NoDwell { .. }
    ));
    assert!(matches!(
        refused(&|s| s.teeth = 20),
        IntermittentPairError::Stops { kept: 20, .. }
    ));
    assert!(matches!(
        refused(&|s| s.lock_radius = Some(50.0)),
        IntermittentPairError::LockTooSmall { .. }
    ));
    assert!(matches!(
        refused(&|s| s.lock_radius = Some(100.0)),
        IntermittentPairError::LockOverlaps { .. }
    ));
    assert_eq!(
        refused(&|s| s.lock_clearance = -1.0).key(),
        "lock_clearance"
    );
    assert_eq!(refused(&|s| s.entry = f64::NAN).key(), "entry_deg");
}
