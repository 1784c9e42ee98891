use centrode_mechanism::gear::design::Keyway;

use super::*;

const HUB: Keyway = Keyway {
    width: 5.0,
    depth: 2.3,
};

fn lengths(part: &Turned) -> Vec<(f64, f64, bool)> {
    let step = |step: &Step| {
        (
            step.diameter,
            (1e6 * step.length).round() / 1e6,
            step.is_keyed,
        )
    };
    part.steps.iter().map(step).collect()
}

#[test]
fn a_pin_is_held_by_rings_where_there_is_room_for_them() {
    let pin = |room: [f64; 2]| {
        let bar = Bar::new(10.0, "f7", [0.0, 18.0]).held(room);
        bar.part(["pin", "Pin"], ("steel", 7850.0))
    };
    // DIN 471 for 10 mm: groove 9.6 mm in diameter and 1.1 mm wide, a land of 0.6 mm beyond.
    let both = pin([2.0, 2.0]);
    let land = (10.0, 0.6, false);
    let groove = (9.6, 1.1, false);
    let plain = (10.0, 18.0, false);
    assert_eq!(lengths(&both), [land, groove, plain, groove, land]);
    assert_eq!(both.chamfer, 0.3);
    assert_eq!(lengths(&pin([1.0, 2.0])), [plain, groove, land]);
    assert_eq!(lengths(&pin([0.0, 0.0])), [plain]);
}

#[test]
fn a_keyway_of_a_shaft_goes_through_the_grooves_in_it() {
    let bar = Bar::new(16.0, "h6", [0.0, 60.0]).ring(0.0, false, 9.0);
    let bar = bar.ring(15.0, true, 2.0).keyed(Some(HUB), [-9.0, 20.0]);
    let shaft = bar.part(["shaft", "Shaft"], ("steel", 7850.0));
    let steps = [
        (16.0, 1.2, true),
        (15.2, 1.1, true),
        (16.0, 15.0, true),
        (15.2, 1.1, true),
        (16.0, 3.9, true),
        (16.0, 40.0, false),
    ];
    assert_eq!(lengths(&shaft), steps);
    // DIN 6885-1: 3 mm deep in a shaft of 12 to 17 mm.
    assert!((shaft.keyway.expect("a keyway").depth - 3.0).abs() < 1e-12);
    let body = shaft.solid().expect("a body");
    assert!(body.shell().is_closed());
    let round = std::f64::consts::PI * 64.0 * 62.3;
    assert!(body.volume() < round && body.volume() > 0.95 * round);
}

#[test]
fn a_silhouette_has_the_area_of_its_steps() {
    let bar = Bar::new(10.0, "f7", [0.0, 18.0]).held([2.0, 2.0]);
    let pin = bar.part(["pin", "Pin"], ("steel", 7850.0));
    let steps: f64 = pin
        .steps
        .iter()
        .map(|step| step.diameter * step.length)
        .sum();
    let area = pin.silhouette().area();
    assert!((area - steps + 2.0 * pin.chamfer * pin.chamfer).abs() < 1e-9);
}
