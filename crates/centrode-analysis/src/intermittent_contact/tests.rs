use super::*;
use centrode_gear::design::GearPairDesign;
use centrode_gear::pitch::{Circle, PitchSpec, Polar};
use centrode_gear::{IntermittentPairSpec, Member};

use centrode_optimise::Random;

fn spec(driver: u32, mean_ratio: [u32; 2], teeth: u32, entry: f64) -> IntermittentPairSpec {
    let mut pair = GearPairDesign::new(PitchSpec::Circle(Circle {
        module: Some(3.0),
        tooth_count: Some(driver),
        ..Circle::default()
    }));
    pair.mean_ratio = mean_ratio;
    (pair.driver.bore, pair.driven.bore) = (16.0, 16.0);
    IntermittentPairSpec::new(pair, teeth, entry)
}

fn contact(spec: &IntermittentPairSpec) -> (IntermittentPair, IntermittentContact) {
    let pair = IntermittentPair::resolve(spec).expect("a pair");
    let tolerance = Tolerance::new(1e-4).expect("positive");
    let contact = IntermittentContact::analyse(&pair, 240, tolerance);
    (pair, contact)
}

/// Angular backlash of a tooth on the driven gear, rad.
fn backlash(pair: &IntermittentPair) -> f64 {
    let length = pair.pair().rolling().pitch_length(Member::Driven);
    0.05 / (length / TAU * 20_f64.to_radians().cos())
}

/// Guards that nothing penetrates, and that the driven gear is held all the way, moving or not.
fn held(spec: &IntermittentPairSpec) {
    let (pair, contact) = contact(spec);
    assert!(
        contact.deepest.value < 1e-3,
        "{spec:?}: {:?}",
        contact.deepest
    );
    let most = 1.1 * backlash(&pair);
    for loose in contact.free {
        assert!(loose.value < most, "{spec:?}: {loose:?}, {most} allowed");
    }
}

#[test]
fn a_pair_with_cams_is_held_all_the_way() {
    let spec = spec(40, [3, 4], 30, 20_f64.to_radians());
    held(&spec);
    let (pair, contact) = contact(&spec);
    let minimum = contact.ahead.iter().chain(&contact.back).copied();
    let minimum = minimum.fold(f64::INFINITY, f64::min);
    assert!(minimum > 0.95 * backlash(&pair), "{minimum}");
}

#[test]
fn random_pairs_are_held_too() {
    let mut random = Random::new(3, 0);
    for (stops, ratios) in [(1, [[3, 4], [2, 3]]), (2, [[1, 1], [4, 5]])] {
        let mean_ratio = ratios[usize::from(random.between(0.0, 1.0) > 0.5)];
        let [n1, n2] = mean_ratio;
        let driver = n2 * (random.between(28.0, 44.0) as u32 / n2) * 2;
        let driven = driver * n1 / n2;
        let entry = random.between(0.2, 0.4);
        held(&spec(driver, mean_ratio, driven / stops, entry));
    }
}

#[test]
fn a_pair_of_waves_is_held_too() {
    let mut spec = spec(40, [3, 4], 30, 0.35);
    spec.pair.pitch = PitchSpec::Polar(Polar {
        expression: Some("1 + 0.03*cos(4*phi)".into()),
        module: Some(3.0),
        tooth_count: Some(40),
        ..Polar::default()
    });
    held(&spec);
}

#[test]
fn without_cams_the_lock_holds_and_the_start_is_a_shock() {
    let (pair, contact) = contact(&spec(40, [3, 4], 30, 0.0));
    assert!(contact.deepest.value < 1e-3, "{:?}", contact.deepest);
    assert!((pair.shock() - 4.0 / 3.0).abs() < 1e-9 && pair.cams().is_empty());
    let locked = pair.locked_backlash();
    let motion = pair.law().motion_angle();
    let ends = 0.25 * (TAU - motion);
    // Where the locking arc's ends come to the notch they hold less well; cams do it better.
    for (i, &input) in contact.input.iter().enumerate() {
        let loose = contact.ahead[i].max(contact.back[i]);
        if input > motion + ends && input < TAU - ends {
            assert!(
                (loose / locked - 1.0).abs() < 0.02,
                "{loose} of {locked} while locked at {input}"
            );
        }
        assert!(input < motion || loose < 0.02, "{loose} at {input}");
    }
}

#[test]
fn a_gear_turned_too_far_penetrates() {
    let (pair, contact) = contact(&spec(40, [3, 4], 30, 0.35));
    let tolerance = Tolerance::new(1e-4).expect("positive");
    let [driver, driven] = [pair.driver(), pair.driven()].map(|o| Wheel::star(o, tolerance));
    let input = contact.input[200];
    for (off, free) in [(0.0, true), (0.01, false), (-0.01, false)] {
        let turned = pair.law().at(input).position + off;
        let placed = Isometry2::new(Vector::new(pair.center_distance(), 0.0), turned);
        let place = placed.inverse() * Isometry2::rotation(-input);
        let mut room = Room::default();
        room.narrow(&driver, &place, &driven);
        assert_eq!(room.penetration == 0.0, free, "{off}");
    }
}

/// Pairs of a module and backlash, with a diameter and an angle of the pins: driver, mean ratio, teeth, entry (deg).
/// Pitches of the driver, mean ratio, teeth, angle of entry in degrees.
type Pitches = (u32, [u32; 2], u32, f64);
/// Module, backlash, diameter and angle of a pin, in mm and degrees.
type Pins = (f64, f64, f64, f64);

fn with_pins(
    (driver, mean_ratio, teeth, entry): Pitches,
    (module, backlash, diameter, angle): Pins,
) -> IntermittentPairSpec {
    let mut spec = spec(driver, mean_ratio, teeth, entry.to_radians());
    if let PitchSpec::Circle(circle) = &mut spec.pair.pitch {
        circle.module = Some(module);
    }
    (spec.pair.driver.bore, spec.pair.driven.bore) = (4.0 * module, 4.0 * module);
    (spec.backlash, spec.pins.diameter, spec.pins.angle) =
        (backlash, Some(diameter), angle.to_radians());
    spec
}

/// Distance of the pins' path from the cams at even inputs, by the angles of the law alone: the minimum, and that of the line from
/// the driver's axis at rest by hand.
fn slots(spec: &IntermittentPairSpec, pair: &IntermittentPair) -> (f64, f64) {
    const COUNT: u32 = 9000;
    let a = pair.center_distance();
    let mut minimum = f64::INFINITY;
    for cam in pair.cams() {
        let corners = cam.outline.flatten(Tolerance::new(1e-5).expect("positive"));
        let reach = corners.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
        for (pin, i) in cam
            .pins
            .iter()
            .flat_map(|pin| (0..COUNT).map(move |i| (pin, i)))
        {
            let input = TAU * f64::from(i) / f64::from(COUNT);
            let (sin, cos) = pair.law().at(input).position.sin_cos();
            let (x, y) = (a + pin.x * cos - pin.y * sin, pin.x * sin + pin.y * cos);
            let (sin, cos) = input.sin_cos();
            let (x, y) = (x * cos - y * sin, x * sin + y * cos);
            if x.hypot(y) > reach + 2.0 * cam.pin_radius {
                continue;
            }
            for (k, p) in corners.iter().enumerate() {
                let q = corners[(k + 1) % corners.len()];
                let (dx, dy) = (q.x - p.x, q.y - p.y);
                let t = ((x - p.x) * dx + (y - p.y) * dy) / (dx * dx + dy * dy);
                let t = t.clamp(0.0, 1.0);
                minimum = minimum.min((x - p.x - t * dx).hypot(y - p.y - t * dy) - cam.pin_radius);
            }
        }
    }
    let base = backlash_radius(spec, pair);
    let (circle, angle) = (0.75 * base / 20_f64.to_radians().cos(), spec.pins.angle);
    let (x, y) = (a - circle * angle.cos(), circle * angle.sin());
    // The path of a pin as the driven gear turns by the backlash, along its line from the driver's axis.
    let turned = 0.5 * spec.backlash / base;
    let (way_x, way_y) = (turned * circle * angle.sin(), turned * circle * angle.cos());
    (minimum, (way_x * x + way_y * y) / x.hypot(y))
}

/// Base radius of the driven gear by its teeth.
fn backlash_radius(spec: &IntermittentPairSpec, pair: &IntermittentPair) -> f64 {
    let teeth = f64::from(pair.pair().driven().tooth_count());
    let PitchSpec::Circle(circle) = &spec.pair.pitch else {
        panic!("round gears");
    };
    0.5 * circle.module.expect("a module") * teeth * 20_f64.to_radians().cos()
}

/// Pitches and pins of pairs with cams; the suite looks at the first three.
const PINS: [(Pitches, Pins); 11] = [
    ((40, [3, 4], 30, 20.0), (3.0, 0.1, 7.0, 45.0)),
    ((40, [3, 4], 30, 20.0), (3.0, 0.1, 7.5, 45.0)),
    ((40, [3, 4], 30, 25.0), (2.0, 0.05, 5.0, 45.0)),
    ((36, [2, 3], 24, 20.0), (4.0, 0.15, 10.0, 40.0)),
    ((48, [3, 4], 36, 15.0), (2.5, 0.08, 6.0, 50.0)),
    ((30, [4, 5], 24, 18.0), (3.0, 0.1, 8.0, 45.0)),
    ((40, [1, 1], 20, 20.0), (3.0, 0.1, 7.0, 35.0)),
    ((32, [3, 4], 24, 12.0), (5.0, 0.2, 12.0, 45.0)),
    ((44, [3, 4], 33, 22.0), (1.5, 0.06, 4.0, 42.0)),
    ((40, [4, 5], 32, 20.0), (3.0, 0.02, 7.0, 45.0)),
    ((40, [3, 4], 30, 30.0), (3.0, 0.1, 6.0, 55.0)),
];

/// Where a pin crosses the line of centres a slot widened by turning alone had no clearance at all.
#[test]
fn pins_clear_their_slots_along_the_normal_all_the_way() {
    pins_clear_their_slots(&PINS[..3]);
}

#[test]
#[ignore = "a campaign"]
fn pins_of_more_pairs_clear_their_slots() {
    pins_clear_their_slots(&PINS[3..]);
}

fn pins_clear_their_slots(pairs: &[(Pitches, Pins)]) {
    for &(pitches, pins) in pairs {
        let spec = with_pins(pitches, pins);
        let (pair, contact) = contact(&spec);
        let (minimum, stated) = slots(&spec, &pair);
        let near = 3e-4 * pins.0;
        assert!(
            minimum > stated - near,
            "{pitches:?} {pins:?}: {minimum}, {stated}"
        );
        let found = contact.pin_clearance.expect("cams").value;
        // Followed between the samples: at most what they have, and hardly less.
        assert!(
            found < minimum + 1e-5 && found > minimum - near,
            "{pitches:?} {pins:?}: {found} {minimum}"
        );
        assert!(contact.deepest.value < 1e-3);
        for loose in contact.free {
            let most = 1.1 * 0.5 * spec.backlash / backlash_radius(&spec, &pair);
            // What the polygons of cam and pin are off.
            let most = most + (3e-4 * pins.0 + 6e-4 * pins.2) / backlash_radius(&spec, &pair);
            assert!(
                loose.value < most,
                "{pitches:?} {pins:?}: {loose:?}, {most}"
            );
        }
    }
}

/// Free angle of the driven gear by halving: a corner of one gear in the other, by the crossings of a ray, is a clash.
fn free_by_halving(pair: &IntermittentPair, input: f64, sense: f64) -> f64 {
    let fine = Tolerance::new(1e-4).expect("positive");
    let a = pair.center_distance();
    let driver: Vec<[f64; 2]> = pair
        .driver()
        .flatten(fine)
        .iter()
        .map(|p| [p.x, p.y])
        .collect();
    let driven: Vec<[f64; 2]> = pair
        .driven()
        .flatten(fine)
        .iter()
        .map(|p| [p.x, p.y])
        .collect();
    let reach = |polygon: &[[f64; 2]]| polygon.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
    let reaches = [reach(&driver), reach(&driven)];
    let turn = |[x, y]: [f64; 2], angle: f64| {
        let (sin, cos) = angle.sin_cos();
        [x * cos - y * sin, x * sin + y * cos]
    };
    let inside = |polygon: &[[f64; 2]], [x, y]: [f64; 2]| {
        let mut odd = false;
        for (k, p) in polygon.iter().enumerate() {
            let q = polygon[(k + 1) % polygon.len()];
            if (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]) {
                odd = !odd;
            }
        }
        odd
    };
    let clash = |off: f64| {
        let turned = pair.law().at(input).position + sense * off;
        let of_driven = driven.iter().map(|&p| {
            let [x, y] = turn(p, turned);
            turn([x + a, y], input)
        });
        let of_driver = driver.iter().map(|&p| {
            let [x, y] = turn(p, -input);
            turn([x - a, y], -turned)
        });
        let near = |[x, y]: &[f64; 2], reach: f64| x.hypot(*y) < reach;
        of_driven
            .filter(|p| near(p, reaches[0]))
            .any(|p| inside(&driver, p))
            || of_driver
                .filter(|p| near(p, reaches[1]))
                .any(|p| inside(&driven, p))
    };
    // The first clash in steps, then halved.
    let mut low = 0.0;
    while !clash(low + 4e-3) && low < 0.1 {
        low += 4e-3;
    }
    let mut high = low + 4e-3;
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        *(if clash(middle) { &mut high } else { &mut low }) = middle;
    }
    low
}

/// Pitches, module, lock clearance, and the figures of an earlier study: moving and resting.
type Locked = ((u32, [u32; 2], u32), f64, f64, [Option<f64>; 2]);

/// Pairs without cams; the suite looks at the first three.
const LOCKED: [Locked; 11] = [
    ((50, [1, 2], 25), 2.0, 0.05, [Some(0.01907), None]),
    ((40, [3, 4], 30), 3.0, 0.05, [Some(0.01125), None]),
    ((40, [3, 4], 30), 2.0, 0.05, [None; 2]),
    ((50, [1, 2], 25), 3.0, 0.03, [None; 2]),
    ((48, [1, 2], 24), 2.0, 0.05, [None; 2]),
    ((36, [2, 3], 24), 2.5, 0.08, [None; 2]),
    ((45, [3, 5], 27), 2.0, 0.02, [None; 2]),
    ((30, [4, 5], 24), 4.0, 0.05, [None; 2]),
    ((40, [4, 5], 32), 3.0, 0.1, [None; 2]),
    ((40, [1, 1], 20), 3.0, 0.05, [None; 2]),
    ((44, [3, 4], 33), 1.5, 0.04, [None; 2]),
];

#[test]
fn the_free_angle_without_cams_is_the_maximum_of_the_whole_turn() {
    free_angles(&LOCKED[..3]);
}

#[test]
#[ignore = "a campaign"]
fn the_free_angle_of_more_pairs_is_the_maximum_of_the_whole_turn() {
    free_angles(&LOCKED[3..]);
}

fn free_angles(pairs: &[Locked]) {
    for &((driver, mean_ratio, teeth), module, lock, known) in pairs {
        let mut spec = with_pins((driver, mean_ratio, teeth, 0.0), (module, 0.1, 1.0, 45.0));
        spec.lock_clearance = lock;
        let pair = IntermittentPair::resolve(&spec).expect("a pair");
        let tolerance = Tolerance::new(1e-4).expect("positive");
        let contact = IntermittentContact::analyse(&pair, 240, tolerance);
        let motion = pair.law().motion_angle();
        let case = format!("{driver} {mean_ratio:?} {teeth} {module} {lock}");
        let halved = |input| [-1.0, 1.0].map(|sense| free_by_halving(&pair, input, sense));
        let most = |input| halved(input).into_iter().fold(0.0, f64::max);
        let near = 4e-5 * module;
        for (found, known) in contact.free.iter().zip(known) {
            let there = most(found.input);
            assert!(
                (found.value - there).abs() < near,
                "{case}: {found:?}, {there}"
            );
            assert!(
                known.is_none_or(|known: f64| (known - found.value).abs() < 1e-4),
                "{case}: {found:?}"
            );
        }
        let ends = [
            (0.0, 0),
            (motion.next_down(), 0),
            (motion, 1),
            (TAU.next_down(), 1),
        ];
        let between = (1..3).map(|i| {
            let share = f64::from(i) / 3.0;
            if i % 2 == 0 {
                (motion * share, 0)
            } else {
                (motion + (TAU - motion) * share, 1)
            }
        });
        for (input, column) in ends.into_iter().chain(between) {
            let there = most(input);
            let found: Extreme = contact.free[column];
            assert!(
                there < found.value + near,
                "{case}: {there} at {input}, {found:?}"
            );
        }
    }
}
