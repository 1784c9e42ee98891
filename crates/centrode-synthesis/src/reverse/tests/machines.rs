use std::f64::consts::TAU;

use centrode_geometry::Point;

use super::{assert_keyed, drawn};
use crate::reverse::{ReversedMachine, ReversedMachineError, Split, SplitKind, TwoBar};
use centrode_machines::machine::Machine;

/// The composed machine shares no code with the way its laws were found.
#[test]
fn the_machine_composed_of_the_design_follows_the_path() {
    let path = drawn();
    let chain = TwoBar::new(&path, Point::new(260.0, 160.0), None).expect("a chain");
    for (kind, bend) in [(SplitKind::Powers, 40.0_f64), (SplitKind::Powers, -75.0)] {
        let split = Split::new(&chain, kind, bend.to_radians()).expect("a split");
        let made = ReversedMachine::new(&chain, &split, 3, None).expect("a machine");
        assert!(made.tip_error.value < 3.2e-5, "{:?}", made.tip_error);
        let composed = Machine::resolve(&made.design).expect("a machine");
        let arm = composed.body_named("arm").expect("an arm");
        let link = composed.bodies()[arm].link;
        assert_keyed(&composed);
        let mut worst = 0.0_f64;
        let by_carrier = chain.by_carrier().expect("a law");
        let start = chain.at(0.0).carrier[0];
        for i in 0..360 {
            let input = TAU * f64::from(i) / 360.0;
            let tip = composed
                .linkage()
                .place(link, Point::new(chain.arm(), 0.0), input);
            let direction = start + chain.direction().sign() * input;
            let t = centrode_kinematics::transmission::Transmission::at(&by_carrier, direction)
                .position;
            worst = worst.max((tip - path.at(t).point).norm());
        }
        assert!(worst < 1e-4, "{worst:e}");
    }
}

#[test]
fn a_number_of_arms_or_steps_out_of_range_is_refused() {
    let chain = TwoBar::new(&drawn(), Point::new(260.0, 160.0), None).expect("a chain");
    let split = Split::new(&chain, SplitKind::Powers, 0.7).expect("a split");
    for steps in [0, 11, u32::MAX] {
        let error = ReversedMachine::new(&chain, &split, 1, Some(steps)).expect_err("no machine");
        assert!(matches!(error, ReversedMachineError::Steps { .. }));
    }
    for arms in [0, 13] {
        let error = ReversedMachine::new(&chain, &split, arms, None).expect_err("no machine");
        assert!(matches!(error, ReversedMachineError::Arms { .. }));
    }
}
