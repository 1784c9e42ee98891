use super::*;

#[test]
fn a_lone_crank_needs_inertia_times_acceleration() {
    let mut lone = machine(&["frame", "crank"]);
    let speeding = law(|t: f64| MotionJet {
        position: t,
        velocity: 3.0,
        acceleration: 11.0,
        jerk: 0.0,
    });
    lone.joint(Joint::turning(0, 1, speeding).at([7.0, 5.0, 0.0]));
    lone.links[1].mass = Some(mass(2.0, [30.0, 0.0], 1000.0));
    let gravity = Vector3::new(0.0, -9810.0, 0.0);
    lone.gravity = gravity.into();
    let forces = Balance::new(lone).expect("masses").at(0.8, 1.0);
    let forces = forces.expect("it turns");
    let inertia = 1000.0 + 2.0 * 900.0;
    let weight = 2.0 * 9.81 * 30.0 * 0.8_f64.cos();
    let torque = inertia * 11.0 / 1000.0 + weight;
    near(forces.joints[0].drive, torque, 1e-12);
    near(forces.input_torque, 3.0 * torque, 1e-12);
    // The pin carries weight and centripetal force.
    let (sin, cos) = 0.8_f64.sin_cos();
    let towards = -Vector3::new(cos, sin, 0.0) * 30.0 * 9.0;
    let along = Vector3::new(-sin, cos, 0.0) * 30.0 * 11.0;
    let force = (towards + along - gravity) * 2.0 / 1000.0;
    assert!((reaction(&forces, 0) - force).norm() < 1e-12);
}

/// Rod force, wall force and torque of a massless slider-crank with a heavy piston, from the triangle of forces.
#[test]
fn joint_forces_of_a_slider_crank_are_those_of_the_closed_form() {
    let (r, l, m, omega) = (30.0, 100.0, 0.8, 40.0);
    let mut crank = slider_crank(m);
    crank.loads.push(Load::Force {
        link: 3,
        at: [0.0; 3],
        force: [number(-150.0), number(0.0), number(0.0)],
        axes: Axes::World,
    });
    let balance = Balance::new(crank).expect("a machine");
    for i in 0..24 {
        let t = 0.26 * f64::from(i);
        let (sin, cos) = t.sin_cos();
        let root = (l * l - r * r * sin * sin).sqrt();
        // x = r cos t + root, differentiated twice.
        let first = -r * r * sin * cos / root;
        let bend = -r * cos - (r * r * (cos * cos - sin * sin) + first * first) / root;
        let push = m * bend * omega * omega / 1e3 + 150.0;
        let tan = r * sin / root;
        let forces = balance.at(t, omega).expect("it turns");
        let pin = forces.closures[0];
        assert!((pin - Vector3::new(push, -push * tan, 0.0)).norm() < 1e-9 * (1.0 + push.abs()));
        near(reaction(&forces, 2).y, push * tan, 1e-10);
        for joint in [0, 1] {
            assert!((reaction(&forces, joint) - pin).norm() < 1e-9 * (1.0 + push.abs()));
        }
        near(forces.input_torque, -push * r * (sin + cos * tan), 1e-10);
        near(forces.joints[0].drive, forces.input_torque, 1e-14);
    }
}

/// A four-bar without masses, a torque on its rocker: the coupler passes a force along itself alone.
#[test]
fn joint_forces_of_a_four_bar_are_those_of_the_closed_form() {
    let [a, b, c, d] = [40.0, 110.0, 80.0, 100.0];
    let (linkage, [crank, coupler, rocker]) = four_bar([a, b, c, d]);
    let angle = |bar: Bar, less: Option<Bar>| angle(&linkage, bar, less);
    let mut found = machine(&["frame", "crank", "coupler", "rocker"]);
    found.joint(Joint::turning(0, 1, turning(1.0)));
    found.joint(Joint::turning(1, 2, angle(coupler, Some(crank))).at([a, 0.0, 0.0]));
    found.joint(Joint::turning(0, 3, angle(rocker, None)).at([d, 0.0, 0.0]));
    found.closures.push(Closure {
        links: [2, 3],
        at: [b, 0.0, 0.0],
        joints: [1, 2],
    });
    found.loads.push(torque(3, -900.0));
    let balance = Balance::new(found).expect("a machine");
    for i in 0..20 {
        let phi = 0.3 * f64::from(i);
        let tip = nalgebra::Vector2::new(a * phi.cos(), a * phi.sin());
        // The joint of coupler and rocker, where two circles meet above the line between their centres.
        let base = nalgebra::Vector2::new(d, 0.0) - tip;
        let length = base.norm();
        let along = (b * b - c * c + length * length) / (2.0 * length);
        let square = (b * b - along * along).sqrt();
        let (x, y) = (base.x / length, base.y / length);
        let joint = tip + nalgebra::Vector2::new(x * along - y * square, y * along + x * square);
        let bar = (joint - tip) / b;
        let arm = joint - nalgebra::Vector2::new(d, 0.0);
        let size = 900.0 / arm.perp(&bar);
        let forces = balance.at(phi, 0.0).expect("it turns");
        let force = Vector3::new(size * bar.x, size * bar.y, 0.0);
        let off = 1e-9 * (1.0 + size.abs());
        assert!((forces.closures[0] - force).norm() < off);
        assert!((reaction(&forces, 1) - force).norm() < off);
        assert!((reaction(&forces, 2) + force).norm() < off);
        near(forces.input_torque, tip.perp(&(bar * size)), 1e-10);
    }
}

/// A roller on an eccentric disc: the force passes through the disc's middle.
#[test]
fn a_cam_pushes_its_roller_square_to_its_curve() {
    let (e, arm, center, reach) = (15.0, 70.0, 90.0, 60.0);
    // Middle of the disc to the roller, a bar of constant length: the follower moves as the rocker of a four-bar.
    let (pose, [_, _, rocker]) = four_bar([e, reach, arm, center]);
    let swing = angle(&pose, rocker, None);
    let mut found = machine(&["frame", "cam", "follower"]);
    found.joint(Joint::turning(0, 1, turning(1.0)));
    found.joint(Joint::turning(0, 2, swing).at([center, 0.0, 0.0]));
    found.contacts.push(Contact {
        links: [1, 2],
        joint: 1,
        at: [arm, 0.0, 0.0],
        normal: None,
        line: None,
    });
    found.loads.push(torque(2, 700.0));
    let balance = Balance::new(found).expect("a machine");
    for i in 0..20 {
        let phi = 0.31 * f64::from(i);
        let body = pose.at(phi).expect("it turns").body(rocker);
        let (sin, cos) = body.angle.position.sin_cos();
        let roller = Vector3::new(center + arm * cos, arm * sin, 0.0);
        let middle = Vector3::new(e * phi.cos(), e * phi.sin(), 0.0);
        let normal = (roller - middle).normalize();
        let lever = (roller - Vector3::new(center, 0.0, 0.0)).cross(&normal).z;
        let force = normal * (-700.0 / lever);
        let forces = balance.at(phi, 0.0).expect("it turns");
        assert!((forces.contacts[0] - force).norm() < 1e-9 * force.norm());
        near(forces.input_torque, middle.cross(&force).z, 1e-10);
        near(forces.input_torque, -700.0 * body.angle.velocity, 1e-10);
    }
}
