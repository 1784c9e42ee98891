//! Random machines: bodies and dyads of every kind, named so that no order in the file is that of building.

use std::f64::consts::TAU;

use centrode_geometry::Point;

use super::super::{
    BodyPoint, DyadKind, Machine, MachineBodySpec, MachineDesign, MachineDyadSpec, MachineLawSpec,
    Side,
};
use centrode_kinematics::machine::LinkedMachine;

/// Small repeatable random numbers (Numerical Recipes' ranqd1).
pub(super) struct Random(pub(super) u32);

impl Random {
    fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.0 >> 8
    }

    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.next()) / f64::from(1 << 24)
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        self.next() as usize % count
    }

    /// A name that is independent of the order of naming.
    pub(super) fn name(&mut self, number: usize) -> String {
        let letter = char::from(b'a' + (self.next() % 26) as u8);
        format!("{letter}{number}")
    }
}

/// Maximum and minimum of a distance over the cycle.
fn spread(of: impl Fn(f64) -> f64) -> [f64; 2] {
    let all = (0..120).map(|i| of(TAU * f64::from(i) / 120.0));
    all.fold([f64::INFINITY, 0.0], |[low, high], d| {
        [low.min(d), high.max(d)]
    })
}

fn law(random: &mut Random, slides: bool) -> MachineLawSpec {
    let [a, b] = [0; 2].map(|_| random.within(-1.0, 1.0));
    let waves = format!("{a:.3}*sin(phi) + {b:.3}*cos(2*phi)");
    match (slides, random.below(3)) {
        (true, _) => MachineLawSpec {
            start: Some(10.0 * a),
            expression: Some(format!("8*({waves})")),
            ..MachineLawSpec::default()
        },
        (false, 0) => MachineLawSpec {
            start_angle: Some(a),
            expression: Some(waves),
            ..MachineLawSpec::default()
        },
        (false, _) => MachineLawSpec {
            start_angle: Some(3.0 * a),
            ratio: Some([1.0, -1.0, 2.0][random.below(3)]),
            ..MachineLawSpec::default()
        },
    }
}

/// A dyad between two points, or from a point to a line, with lengths that let it close by what its ends do.
fn dyad(random: &mut Random, machine: &Machine, bodies: [String; 2]) -> MachineDyadSpec {
    let points: Vec<(String, BodyPoint)> = machine.points().collect();
    let [p, q] = [0; 2].map(|_| points[random.below(points.len())].clone());
    let place =
        |(_, point): &(String, BodyPoint), input| machine.place(point.body, point.at, input);
    let [near, far] = spread(|input| (place(&p, input) - place(&q, input)).norm());
    let angle = random.within(-3.0, 3.0);
    let kinds = [
        DyadKind::TwoBars,
        DyadKind::BarAndSlider,
        DyadKind::GuideThroughBlock,
        DyadKind::TwoSliders,
        DyadKind::Yoke,
    ];
    let kind = kinds[random.below(kinds.len())];
    let up = random.below(2) == 0;
    let mut spec = MachineDyadSpec {
        kind,
        bodies,
        from: Some(p.0.clone()),
        to: None,
        joint: Some("j".into()),
        lengths: Vec::new(),
        side: Some(if up { Side::Forward } else { Side::Backward }),
        line: None,
        direction: None,
        second_line: None,
        second_direction: None,
        offset: None,
        slot: None,
    };
    match kind {
        DyadKind::TwoBars => {
            let sum = 1.15 * far + 5.0;
            let difference = random.within(-0.8, 0.8) * near;
            spec.lengths = vec![0.5 * (sum + difference), 0.5 * (sum - difference)];
            spec.to = Some(q.0);
            spec.side = Some(if up { Side::Left } else { Side::Right });
        }
        DyadKind::BarAndSlider => {
            spec.lengths = vec![1.15 * far + 5.0];
            (spec.line, spec.direction) = (Some(q.0), Some(angle));
        }
        DyadKind::GuideThroughBlock => {
            spec.joint = None;
            spec.to = Some(q.0);
            spec.offset = Some(random.within(-0.8, 0.8) * near);
        }
        DyadKind::TwoSliders => {
            (spec.from, spec.side) = (None, None);
            (spec.line, spec.direction) = (Some(p.0), Some(angle));
            (spec.second_line, spec.second_direction) = (Some(q.0), Some(angle + 1.3));
        }
        DyadKind::Yoke => {
            spec.side = None;
            (spec.line, spec.direction) = (Some(q.0), Some(angle));
            spec.slot = Some(random.within(0.6, 2.5));
        }
    }
    spec
}

/// A random machine of some elements, each added where it lets the machine close.
fn machine(seed: u32) -> Machine {
    let mut random = Random(seed.wrapping_mul(747_796_405).wrapping_add(1));
    let mut design = MachineDesign {
        name: "random".into(),
        ..MachineDesign::default()
    };
    for name in ["P", "Q", "R"] {
        let at = [0; 2].map(|_| random.within(-60.0, 60.0));
        design.frame.points.insert(name.into(), at);
    }
    let mut found = Machine::resolve(&design).expect("a frame");
    let required = 3 + random.below(5);
    for number in 0..40 {
        if found.bodies().len() > required {
            break;
        }
        let mut more = design.clone();
        let (one, other) = (random.name(2 * number), random.name(2 * number + 1));
        let points: Vec<(String, BodyPoint)> = found.points().collect();
        let on = points[random.below(points.len())].0.clone();
        let tip = [0; 2].map(|_| random.within(-30.0, 30.0));
        let mut body = MachineBodySpec::default();
        body.points.insert("t".into(), tip);
        match random.below(6) {
            0 | 1 => {
                (body.on, body.law) = (Some(on), Some(law(&mut random, false)));
                more.bodies.insert(one, body);
            }
            2 => {
                body.slides = Some(random.within(-3.0, 3.0));
                (body.on, body.law) = (Some(on), Some(law(&mut random, true)));
                more.bodies.insert(one, body);
            }
            3 => {
                (body.fixed_to, body.turned) = (Some(on), Some(random.within(-3.0, 3.0)));
                more.bodies.insert(one, body);
            }
            _ => {
                let made = dyad(&mut random, &found, [one.clone(), other]);
                more.bodies.insert(one, body);
                more.dyads.insert(random.name(number), made);
            }
        }
        if let Ok(larger) = Machine::resolve(&more) {
            // A dyad that hardly holds has derivatives that no difference resolves.
            let holds = |i: u32| {
                let angles = larger.transmission_angles(TAU * f64::from(i) / 240.0);
                angles.into_iter().fold(1.0, f64::min)
            };
            if (0..240).all(|i| holds(i) > 0.2) {
                (design, found) = (more, larger);
            }
        }
    }
    found
}

/// Holds the tree of joints against the linkage: every point of every body with its derivatives, and every loop.
pub(super) fn agrees(composed: &Machine, machine: &LinkedMachine) {
    for i in 0..7 {
        let input = 1.31 * f64::from(i) - 2.0;
        let frames = machine.pose(input);
        for (body, frame) in frames.iter().enumerate() {
            let at = Point::new(11.0, -7.0);
            let one = composed.point(body, at, input);
            let other = frame.point([at.x, at.y, 0.0]);
            let pairs = [
                (one.point.coords, other.position.coords.xy()),
                (one.first, other.velocity.xy()),
                (one.second, other.acceleration.xy()),
                (one.third, other.jerk.xy()),
            ];
            for (order, (one, other)) in pairs.into_iter().enumerate() {
                let off = (one - other).norm();
                let size = 100.0 * 30.0_f64.powi(order as i32) + one.norm();
                assert!(
                    off < 1e-10 * size,
                    "body {body} order {order}: {off} of {size}"
                );
            }
        }
        for closure in &machine.closures {
            let [a, b] = closure.links;
            let at = frames[a].point(closure.at).position;
            // The pin keeps its position in the other link.
            let there = |input: f64| {
                let frames = machine.pose(input);
                let place = frames[a].point(closure.at).position;
                let inverse = frames[b].0[0].try_inverse().expect("a rigid motion");
                inverse.transform_point(&place)
            };
            let off = (there(input) - there(input + 1.0)).norm();
            assert!(
                off < 1e-10 * (100.0 + at.coords.norm()),
                "pin of {a} and {b}: {off}"
            );
        }
    }
}

#[test]
fn derivatives_of_random_machines_are_those_of_their_places() {
    let step = 1e-3;
    let mut dyads = [0; 5];
    for seed in 0..300 {
        let made = machine(seed);
        for dyad in made.dyads() {
            dyads[dyad.kind as usize] += 1;
        }
        for (name, BodyPoint { body, at }) in made.points() {
            let input = 0.7 + 0.01 * f64::from(seed);
            let here = made.point(body, at, input);
            let at = |k: f64| {
                let jet = made.point(body, at, input + k * step);
                [jet.point.coords, jet.first, jet.second]
            };
            // Richardson's rule on central differences: an error of fourth order.
            let (low, high, lower, higher) = (at(-1.0), at(1.0), at(-2.0), at(2.0));
            for (order, exact) in [here.first, here.second, here.third]
                .into_iter()
                .enumerate()
            {
                let near = (high[order] - low[order]) / (2.0 * step);
                let wide = (higher[order] - lower[order]) / (4.0 * step);
                let slope = (near * 4.0 - wide) / 3.0;
                let off = (slope - exact).norm();
                let size = exact.norm() + 100.0 * 5.0_f64.powi(order as i32);
                assert!(
                    off < 1e-6 * size,
                    "{seed} {name} order {order}: {off} of {size}"
                );
            }
        }
    }
    assert!(dyads.iter().all(|&count| count > 30), "{dyads:?}");
}

#[test]
fn joints_of_random_machines_hang_together_as_their_linkages_do() {
    for seed in 0..100 {
        let made = machine(seed);
        let machine = made.machine().expect("plates");
        assert_eq!(machine.validate(), Ok(()));
        agrees(&made, &machine);
    }
}

#[test]
fn points_of_random_machines_side_by_side_are_those_at_single_inputs() {
    for seed in 1..=100 {
        let composed = machine(seed);
        let points: Vec<_> = composed.points().map(|(_, point)| point).collect();
        let inputs: Vec<f64> = (0..7).map(|i| 0.9 * f64::from(i) - 1.0).collect();
        let together = composed.places_each(&points, &inputs);
        assert_eq!(together.len(), points.len() * inputs.len());
        let mut found = together.iter();
        for &input in &inputs {
            for (point, &BodyPoint { body, at }) in points.iter().enumerate() {
                let alone = composed.place(body, at, input);
                let beside = Point::from(*found.next().expect("a place"));
                let size = 1.0 + alone.coords.norm();
                assert!(
                    (beside - alone).norm() < 1e-10 * size,
                    "{seed}: {beside} {alone}"
                );
                // One point alone takes only the bodies on which it depends.
                let [single] = composed.places_each(&points[point..=point], &[input])[..] else {
                    panic!("one place");
                };
                assert_eq!(Point::from(single), beside, "{seed}");
            }
        }
    }
}
