use std::f64::consts::TAU;
use std::sync::Arc;

use super::*;
use crate::transmission::{FromFn, MotionJet};

/// 0.4 sin(t + 0.3) + k t, with its derivatives.
fn wavy(k: f64) -> Arc<dyn Transmission> {
    Arc::new(FromFn::new(TAU, k * TAU, vec![1.0], move |t: f64| {
        let (sin, cos) = (t + 0.3).sin_cos();
        MotionJet {
            position: 0.4 * sin + k * t,
            velocity: 0.4 * cos + k,
            acceleration: -0.4 * sin,
            jerk: -0.4 * cos,
        }
    }))
}

fn link(name: &str) -> Link {
    Link::new(name)
}

/// An arm on a turning carrier with a rod that slides askew in it.
fn machine() -> LinkedMachine {
    let mut machine = LinkedMachine::default();
    let links = ["base", "carrier", "arm", "rod"].map(|name| machine.link(link(name)));
    machine.joint(
        Joint::turning(links[1], links[2], wavy(-2.0))
            .at([30.0, 5.0, 2.0])
            .turned([0.1, -0.2, 0.7]),
    );
    let axis = [0.6, 0.0, 0.8];
    machine.joint(Joint::sliding(links[2], links[3], axis, [-1.0, 1.0], wavy(0.0)).at([7.0; 3]));
    machine.joint(Joint::turning(links[0], links[1], wavy(1.0)));
    machine.points.push(LinkPoint {
        name: "tip".into(),
        link: links[3],
        at: [12.0, -3.0, 1.0],
    });
    machine
}

#[test]
fn a_points_derivatives_are_those_of_its_place() {
    let machine = machine();
    let h = 1e-3;
    for i in 0..40 {
        let t = 0.37 * f64::from(i) + 0.01;
        let at = |k: i32| machine.point(0, t + f64::from(k) * h);
        let jet = at(0);
        // Central differences of the next lower derivative, to fourth order.
        let slope = |of: fn(&PointJet) -> nalgebra::Vector3<f64>| {
            let [a, b, c, d] = [-2, -1, 1, 2].map(|k| of(&at(k)));
            (a - d + (c - b) * 8.0) / (12.0 * h)
        };
        let pairs = [
            (slope(|p| p.position.coords), jet.velocity),
            (slope(|p| p.velocity), jet.acceleration),
            (slope(|p| p.acceleration), jet.jerk),
        ];
        for (found, exact) in pairs {
            assert!(
                (found - exact).norm() < 1e-7 * (1.0 + exact.norm()),
                "{found} {exact}"
            );
        }
    }
}

#[test]
fn one_links_frame_is_that_of_the_whole_pose() {
    let machine = machine();
    for input in [0.0, 2.5, -7.0] {
        let pose = machine.pose(input);
        for (index, frame) in pose.iter().enumerate() {
            assert_eq!(*frame, machine.link_frame(index, input));
        }
    }
}

#[test]
fn pieces_are_a_law_within_rounding() {
    for law in [wavy(3.0), wavy(0.0)] {
        let pieces = Piecewise::fit(law.as_ref());
        assert!(pieces.is_sound());
        for i in -50..=50 {
            let t = 0.31 * f64::from(i);
            let (found, exact) = (pieces.at(t), law.at(t));
            let off = (found.position - exact.position).abs();
            assert!(off < 4e-15 * (1.0 + exact.position.abs()), "{t}: {off}");
            assert!((found.velocity - exact.velocity).abs() < 1e-11);
            assert!((found.acceleration - exact.acceleration).abs() < 1e-8);
        }
        assert_eq!(pieces.advance(), law.advance());
    }
}

#[test]
fn a_break_off_the_start_by_rounding_leaves_no_sliver() {
    let law = FromFn::new(TAU, 0.0, vec![1e-16, 2.0, 2.0 + 1e-15], |t: f64| {
        MotionJet::at_rest(t.sin())
    });
    let pieces = Piecewise::fit(&law);
    for at in [0.0, 1e-16, 2.0, 2.0 + 5e-16] {
        assert!((pieces.at(at).velocity - at.cos()).abs() < 1e-9, "{at}");
    }
}

#[test]
fn a_straight_line_with_rounding_is_one_piece() {
    let line = FromFn::new(TAU, 40.0 * TAU, vec![], |t: f64| {
        MotionJet::at_rest(40.0 * t * (1.0 + 1e-16 * (1e6 * t).sin()))
    });
    assert_eq!(Piecewise::fit(&line).pieces.len(), 1);
}

#[test]
fn noise_in_a_law_ends_its_halving() {
    let noisy = FromFn::new(TAU, 0.0, vec![], |t: f64| {
        MotionJet::at_rest(t.sin() + 1e-12 * (1e7 * t).sin())
    });
    let pieces = Piecewise::fit(&noisy);
    assert!(pieces.pieces.len() < 1000, "{}", pieces.pieces.len());
    assert!((pieces.at(1.0).position - 1.0_f64.sin()).abs() < 1e-10);
}

#[test]
fn a_law_that_jumps_is_cut_where_it_jumps() {
    let step = FromFn::new(TAU, 0.0, vec![], |t: f64| {
        MotionJet::at_rest(if t.rem_euclid(TAU) < 2.0 { 1.0 } else { 5.0 })
    });
    let pieces = Piecewise::fit(&step);
    assert!(pieces.is_sound());
    assert!((pieces.at(1.999).position - 1.0).abs() < 1e-12);
    assert!((pieces.at(2.001).position - 5.0).abs() < 1e-12);
}

fn guide(radius: f64, friction: f64) -> Guide {
    Guide {
        joint: 1,
        radius,
        friction,
    }
}

fn mesh(angle: f64) -> GearMesh {
    GearMesh::new([1, 2], 0, angle)
}

#[test]
fn what_does_not_hang_together_is_refused_by_name() {
    let sound = || LinkedMachine {
        input: Input {
            period: TAU,
            speed: 1.0,
            ..Input::default()
        },
        ..machine()
    };
    assert_eq!(sound().validate(), Ok(()));
    let refused = |change: fn(&mut LinkedMachine)| {
        let mut machine = sound();
        change(&mut machine);
        machine.validate().expect_err("refused").to_string()
    };
    type Change = fn(&mut LinkedMachine);
    let cases: [(Change, &str); 12] = [
        (
            |m| m.points[0].link = 9,
            "point \"tip\" refers to link 9, but the number of such items is 4",
        ),
        (
            |m| m.joints[0].parent = 2,
            "\"arm\" must be connected to the first link by exactly one chain of joints, not by 0",
        ),
        (
            |m| m.joints[1].child = 1,
            "exactly one chain of joints, not by 2",
        ),
        (
            |m| m.input.period = f64::NAN,
            "the period of the input must not be NaN",
        ),
        (
            |m| m.joints[0].turn[1] = f64::INFINITY,
            "a number of the joint of \"arm\" must not be inf",
        ),
        (|m| m.gravity[1] = f64::NAN, "gravity must not be NaN"),
        (
            |m| {
                let at = [0.0; 3];
                m.loads.push(Load::Mass {
                    link: 2,
                    at,
                    mass: -1.0,
                });
            },
            "the mass of a load must not be -1",
        ),
        (
            |m| {
                let effort = Quantity::joint(7);
                m.loads.push(Load::Joint { joint: 0, effort });
            },
            "a load refers to joint 7, but the number of such items is 3",
        ),
        (
            |m| m.meshes.push(mesh(2.0)),
            "the pressure angle of a mesh must not be 2",
        ),
        (
            |m| m.guides.push(guide(f64::NAN, 0.1)),
            "the radius of a guide must not be NaN",
        ),
        (
            |m| m.guides.push(guide(5.0, -0.1)),
            "the friction of a guide must not be -0.1",
        ),
        (
            |m| {
                m.closures.push(Closure {
                    links: [1, 2],
                    at: [0.0; 3],
                    joints: [0, 5],
                });
            },
            "a closure refers to joint 5, but the number of such items is 3",
        ),
    ];
    for (change, expected) in cases {
        let message = refused(change);
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn masses_of_parts_add_up_by_their_links_and_scenery_weighs_nothing() {
    let mut machine = machine();
    let mass = |mass| MassProperties {
        mass,
        center: nalgebra::Point3::new(1.0, 2.0, 3.0),
        inertia: nalgebra::Matrix3::identity(),
    };
    for (link, kilograms) in [(0, 50.0), (1, 2.0), (2, 0.75)] {
        machine.links[link].mass = Some(mass(kilograms));
    }
    assert_eq!(machine.mass_properties(0.3), None);
    let listed: [(&str, Vec<usize>, Option<f64>); 3] = [
        ("plate", vec![1, 1], Some(1.0)),
        ("arm", vec![2], Some(0.75)),
        ("pin", vec![1, 2], None),
    ];
    for (name, links, mass) in listed {
        machine.part(Part {
            name: name.into(),
            links,
            mass,
            ..Part::default()
        });
    }
    assert_eq!(machine.parts.iter().map(Part::quantity).sum::<usize>(), 5);
    assert_eq!(
        [0, 1, 2].map(|link| machine.mass_of_pieces(link)),
        [0.0, 2.0, 0.75]
    );
    let found = machine.mass_properties(0.3).expect("two bodies");
    let center = |link: usize| {
        machine
            .link_frame(link, 0.3)
            .point([1.0, 2.0, 3.0])
            .position
    };
    let want = (center(1).coords * 2.0 + center(2).coords * 0.75) / 2.75;
    assert!((found.mass - 2.75).abs() < 1e-12);
    assert!((found.center.coords - want).norm() < 1e-9);
}

#[test]
fn parts_and_arrangement_name_only_what_is_there() {
    let sound = || {
        let mut machine = machine();
        machine.input = Input {
            name: "carrier".into(),
            period: TAU,
            speed: 1.0,
        };
        machine.part(Part {
            name: "plate".into(),
            links: vec![1],
            ..Part::default()
        });
        machine
    };
    assert_eq!(sound().validate(), Ok(()));
    let stated = |change: &dyn Fn(&mut LinkedMachine)| {
        let mut machine = sound();
        change(&mut machine);
        machine.validate().expect_err("unsound").to_string()
    };
    let place = Place {
        figure: 3,
        at: [0.0; 2],
    };
    assert_eq!(
        stated(&|machine| machine.parts[0].links.push(9)),
        "part \"plate\" refers to link 9, but the number of such items is 4"
    );
    assert_eq!(
        stated(&|machine| machine.parts[0].place = Some(place)),
        "part \"plate\" refers to figure 3, but the number of such items is 0"
    );
    assert_eq!(
        stated(&|machine| machine.parts[0].mass = Some(-1.0)),
        "the mass of the part \"plate\" must not be -1"
    );
    let dimension = Dimension {
        ends: [place; 2],
        along: Axis::X,
    };
    assert_eq!(
        stated(&|machine| machine.arrangement.dimensions.push(dimension)),
        "the arrangement refers to figure 3, but the number of such items is 0"
    );
    assert_eq!(
        stated(&|machine| machine.arrangement.columns.push(1)),
        "the arrangement refers to column 1, but the number of such items is 0"
    );
}

#[test]
fn keys_are_in_the_middle_of_hubs_and_dowels_are_flush_with_the_upper_end() {
    let hub = Keyway {
        width: 5.0,
        depth: 2.3,
    };
    let stock = Stock::new("steel", 7850.0);
    let bar = Bar::new(Fit::new("", 16.0, ["H7", "h6"]), [-3.0, 40.0]).ring(-3.0, false, 9.0);
    let bar = bar.key(Key::fitting(hub, 15.0), [2.0, 17.0]);
    let made = bar.turned("shaft", "Shaft", stock, "");
    let middle = |seated: &SeatedKey| bar.bottom() + seated.at + 0.5 * seated.key.length;
    assert!(bar.bottom() < -3.0, "a land beyond the ring");
    assert!(
        made.keys
            .iter()
            .all(|key| (middle(key) - 9.5).abs() < 1e-12)
    );
    assert_eq!((made.keys.len(), made.standard), (1, None));
    let pin = |short: f64| {
        let bar = Bar::dowel(Fit::new("", 8.0, ["H7", "m6"]), [1.0, 34.0], short);
        let made = bar.turned("pin", "Pin", stock, "").bought_as("pressed in");
        (bar.bottom(), made.standard, made.role)
    };
    let bought = Some("Pin ISO 8734 - 8 x 32 - A".to_owned());
    assert_eq!(pin(f64::INFINITY), (2.0, bought, "pressed in".into()));
    assert_eq!(pin(0.5), (1.0, None, String::new()));
}
