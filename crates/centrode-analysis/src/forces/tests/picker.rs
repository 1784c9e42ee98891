use super::*;

/// The picking six-bar with a slider on its rocker, posed by the closed forms of its dyads, with masses in odd places.
fn picker() -> LinkedMachine {
    let build = || {
        let mut linkage = Linkage::new();
        let a = linkage.point(Bar::FRAME, Point::origin())?;
        let d = linkage.point(Bar::FRAME, Point::new(105.0, 0.0))?;
        let f = linkage.point(Bar::FRAME, Point::new(100.0, 67.0))?;
        let (crank, b) = linkage.crank(a, 77.0, 0.3)?;
        let bars = linkage.rrr(b, d, (147.0, 127.0), Branch::Upper)?;
        let effector = linkage.rpr(bars.joint, f, 0.0, Branch::Upper)?;
        let point = linkage.point(bars.second, Point::new(60.0, 10.0))?;
        let line = Line {
            link: Bar::FRAME,
            through: Point::new(0.0, -60.0),
            angle: 0.2,
        };
        let slider = linkage.rrp(point, 260.0, line, Branch::Upper)?;
        let turns = [crank, bars.first, bars.second, effector.link, slider.link];
        Ok::<_, LinkageError>((linkage, turns, [bars.joint, slider.joint]))
    };
    let (linkage, turns, pins) = build().expect("a linkage");
    let linkage = Arc::new(linkage);
    let angle = |bar: Bar, less: Option<Bar>| angle(&linkage, bar, less);
    let slide = |pin: usize, along: fn(&Jet) -> MotionJet| {
        let (linkage, pin) = (linkage.clone(), pins[pin]);
        law(move |phi| along(&linkage.at(phi).expect("it turns").joint(pin)))
    };
    // Distance from the effector's pivot: s s' = w . w', s'^2 + s s'' = w'^2 + w . w''.
    let from_pivot = |at: &Jet| {
        let way = at.point - Point::new(100.0, 67.0);
        let position = way.norm();
        let velocity = way.dot(&at.first) / position;
        let bend = at.first.norm_squared() + way.dot(&at.second) - velocity * velocity;
        MotionJet {
            position,
            velocity,
            acceleration: bend / position,
            jerk: 0.0,
        }
    };
    let on_line = |at: &Jet| {
        let along = nalgebra::Vector2::new(0.2_f64.cos(), 0.2_f64.sin());
        MotionJet {
            position: along.dot(&(at.point - Point::new(0.0, -60.0))),
            velocity: along.dot(&at.first),
            acceleration: along.dot(&at.second),
            jerk: 0.0,
        }
    };
    let [crank, first, second, effector, rod] = turns;
    let (x, range) = ([1.0, 0.0, 0.0], [-1e3, 1e3]);
    let mut found = machine(&[
        "frame", "crank", "first", "second", "effector", "block", "rod", "shoe",
    ]);
    let joints = [
        Joint::turning(0, 1, angle(crank, None)),
        Joint::turning(1, 2, angle(first, Some(crank))).at([77.0, 0.0, 0.0]),
        Joint::turning(0, 3, angle(second, None)).at([105.0, 0.0, 0.0]),
        Joint::turning(0, 4, angle(effector, None)).at([100.0, 67.0, 0.0]),
        Joint::sliding(4, 5, x, range, slide(0, from_pivot)),
        Joint::turning(3, 6, angle(rod, Some(second))).at([60.0, 10.0, 0.0]),
        Joint::sliding(0, 7, x, range, slide(1, on_line))
            .at([0.0, -60.0, 0.0])
            .turned([0.0, 0.0, 0.2]),
    ];
    found.joints.extend(joints);
    let closure = |links, at: f64, joints| Closure {
        links,
        at: [at, 0.0, 0.0],
        joints,
    };
    found.closures.push(closure([2, 3], 147.0, [1, 2]));
    // The effector's block is pinned to the first bar.
    found.closures.push(closure([5, 2], 0.0, [3, 4]));
    found.closures.push(closure([6, 7], 260.0, [5, 6]));
    for (k, link) in found.links.iter_mut().skip(1).enumerate() {
        let k = k as f64;
        let at = [20.0 + 5.0 * k, 3.0 - k];
        link.mass = Some(mass(0.2 + 0.1 * k, at, 400.0 + 50.0 * k));
    }
    found.gravity = [0.0, -9810.0, 0.0];
    found
}

/// Turn of a frame and its first two derivatives.
fn turns(frame: &FrameJet) -> [Matrix3<f64>; 3] {
    [0, 1, 2].map(|k| frame.0[k].fixed_view::<3, 3>(0, 0).into_owned())
}

/// Torque of the input by virtual work from the frames of the links and their derivatives.
fn by_work(machine: &LinkedMachine, input: f64, speed: f64) -> f64 {
    let pose = machine.pose(input);
    let mut work = 0.0;
    let square = speed * speed;
    for (link, frame) in machine.links.iter().zip(&pose) {
        let Some(body) = &link.mass else { continue };
        let center = frame.point(body.center.coords.into());
        let [turn, first, second] = turns(frame);
        let force = (center.acceleration * square - Vector3::from(machine.gravity)) * body.mass;
        work += force.dot(&center.velocity) / 1e3;
        // The body as points: the second moments J give inertia forces R'' J, on ways R'.
        let second_moments = Matrix3::identity() * (0.5 * body.inertia.trace()) - body.inertia;
        work += square * (second * second_moments).dot(&first) / 1e3;
        assert!((turn.transpose() * turn - Matrix3::identity()).amax() < 1e-12);
    }
    for load in &machine.loads {
        let vector =
            |of: &[Quantity; 3]| Vector3::from([0, 1, 2].map(|k| machine.value(&of[k], input)));
        match load {
            Load::Force {
                link,
                at,
                force,
                axes,
            } => {
                let [turn, ..] = turns(&pose[*link]);
                let force = match axes {
                    Axes::World => vector(force),
                    Axes::Link => turn * vector(force),
                };
                work -= force.dot(&pose[*link].point(*at).velocity);
            }
            Load::Torque { link, torque, .. } => {
                let [turn, first, _] = turns(&pose[*link]);
                let spin = first * turn.transpose();
                work -= vector(torque).dot(&Vector3::new(spin.m32, spin.m13, spin.m21));
            }
            Load::Mass { link, at, mass } => {
                let at = pose[*link].point(*at);
                let force = at.acceleration * square - Vector3::from(machine.gravity);
                work += mass * force.dot(&at.velocity) / 1e3;
            }
            Load::Joint { joint, effort } => {
                work -=
                    machine.value(effort, input) * machine.joints[*joint].law.at(input).velocity;
            }
        }
    }
    work
}

#[test]
fn the_torque_feeds_the_energy_and_is_that_of_virtual_work() {
    let machine = picker();
    for closure in &machine.closures {
        for phi in [0.3, 2.0, 5.0] {
            let pose = machine.pose(phi);
            let [one, other] = closure.links;
            let at = pose[one].point(closure.at).position;
            let back = pose[other].0[0].try_inverse().expect("a frame") * at.to_homogeneous();
            let later = machine.pose(phi + 0.1);
            let there = later[other].0[0] * back;
            let here = later[one].point(closure.at).position;
            assert!((there.xyz() - here.coords).norm() < 1e-9, "{closure:?}");
        }
    }
    let balance = Balance::new(machine.clone()).expect("a machine");
    let energy = |phi: f64| {
        let forces = balance.at(phi, 9.0).expect("it turns");
        forces.kinetic_energy + forces.potential_energy
    };
    let count = 720;
    let mut work = 0.0;
    for i in 0..count {
        let phi = TAU * f64::from(i) / f64::from(count);
        let forces = balance.at(phi, 9.0).expect("it turns");
        let torque = forces.input_torque;
        let h = 1e-3;
        let slope = (8.0 * (energy(phi + h) - energy(phi - h))
            - (energy(phi + 2.0 * h) - energy(phi - 2.0 * h)))
            / (12.0 * h);
        near(torque, slope, 1e-6);
        near(torque, by_work(&machine, phi, 9.0), 1e-10);
        work += torque;
        // Nothing drives what a loop moves.
        for joint in 1..machine.joints.len() {
            assert_eq!(forces.joints[joint].drive, 0.0);
            assert!(!balance.is_driven(joint));
        }
    }
    // Over a turn nothing is gained; a periodic mean converges as its Fourier series.
    assert!(work.abs() / f64::from(count) < 1e-9, "{work}");
}

/// Newton's and Euler's laws of each link, summed over all that acts on it.
#[test]
fn every_link_of_the_picker_is_in_balance() {
    let machine = picker();
    let balance = Balance::new(machine.clone()).expect("a machine");
    let phi = 1.1;
    let forces = balance.at(phi, 9.0).expect("it turns");
    let pose = machine.pose(phi);
    for (index, link) in machine.links.iter().enumerate().skip(1) {
        let body = link.mass.as_ref().expect("a mass");
        let center = pose[index].point(body.center.coords.into());
        let gravity = Vector3::from(machine.gravity);
        let mut force = (center.acceleration * 81.0 - gravity) * (body.mass / 1e3);
        let mut moment = center.position.coords.cross(&force);
        let [turn, first, second] = turns(&pose[index]);
        let spin = first * turn.transpose();
        let up = second * turn.transpose() - spin * spin;
        moment.z += body.inertia.m33 * up.m21 * 81.0 / 1e3;
        let mut take = |sign: f64, at: Vector3<f64>, by: Vector3<f64>, free: f64| {
            force -= by * sign;
            moment -= (at.cross(&by) + Vector3::z() * free) * sign;
        };
        for (joint, about) in machine.joints.iter().enumerate() {
            let sign = f64::from(i8::from(about.child == index) - i8::from(about.parent == index));
            let origin = pose[about.child].point([0.0; 3]).position.coords;
            let found = &forces.joints[joint];
            let reaction = found.reaction.expect("determined");
            take(
                sign,
                origin,
                reaction.force,
                reaction.moment.z + found.drive,
            );
        }
        for (closure, &by) in machine.closures.iter().zip(&forces.closures) {
            let at = pose[closure.links[0]].point(closure.at).position.coords;
            let [one, other] = closure.links.map(|link| f64::from(u8::from(link == index)));
            take(other - one, at, by, 0.0);
        }
        assert!(force.xy().norm() < 1e-9, "{}: {force}", link.name);
        assert!(moment.z.abs() < 1e-7, "{}: {moment}", link.name);
    }
}

#[test]
fn a_still_linkage_passes_loads_by_its_ratios() {
    let mut loaded = picker();
    for link in &mut loaded.links {
        link.mass = None;
    }
    let slope = Quantity::Input(2.0);
    let three = |x: f64, y: f64| [number(x), number(y), number(4.0)];
    loaded.loads = vec![
        Load::Force {
            link: 4,
            at: [200.0, -20.0, 3.0],
            force: [number(3.0), number(-7.0), slope],
            axes: Axes::World,
        },
        Load::Force {
            link: 6,
            at: [50.0, 9.0, 0.0],
            force: three(-2.0, 5.0),
            axes: Axes::Link,
        },
        Load::Torque {
            link: 4,
            torque: [number(1.0), number(2.0), number(45.0)],
            axes: Axes::World,
        },
        Load::Joint {
            joint: 6,
            effort: Quantity::rate(6, 0, -0.3),
        },
        Load::Mass {
            link: 5,
            at: [4.0, 5.0, 6.0],
            mass: 0.7,
        },
    ];
    let balance = Balance::new(loaded.clone()).expect("a machine");
    for phi in [0.1, 1.0, PI, 4.0, 5.5] {
        for speed in [0.0, 5.0] {
            let torque = balance.at(phi, speed).expect("it turns").input_torque;
            near(torque, by_work(&loaded, phi, speed), 1e-10);
        }
        let still = balance.at(phi, 0.0).expect("it turns");
        assert_eq!(still.kinetic_energy, 0.0);
    }
}
