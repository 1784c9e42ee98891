use super::*;

#[test]
fn teeth_push_along_the_normal_of_the_pressure_angle() {
    for load in [800.0, -800.0] {
        let forces = Balance::new(gears(load)).expect("a machine").at(0.4, 1.0);
        let forces = forces.expect("it turns");
        let mesh = forces.meshes[0];
        let alpha = 20_f64.to_radians();
        let normal = 800.0 / (40.0 * alpha.cos());
        near(mesh.normal.expect("known"), normal * -load.signum(), 1e-12);
        // The load turns the wheel's left side down, and the pinion holds it up; teeth push gears apart in either case.
        let sign = load.signum();
        let force = Vector3::new(normal * alpha.sin(), normal * alpha.cos() * sign, 0.0);
        assert!((mesh.force - force).norm() < 1e-10, "{}", mesh.force);
        assert!((mesh.at - Vector3::new(20.0, 0.0, 0.0)).norm() < 1e-12);
        assert!((reaction(&forces, 0) - force).norm() < 1e-10);
        assert!((reaction(&forces, 1) + force).norm() < 1e-10);
        near(forces.input_torque, 0.5 * load, 1e-12);
    }
    let mut vague = gears(800.0);
    vague.meshes[0].pressure_angle = None;
    let forces = Balance::new(vague).expect("a machine").at(0.4, 1.0);
    let forces = forces.expect("it turns");
    near(forces.input_torque, 400.0, 1e-12);
    assert_eq!(forces.meshes[0].normal, None);
    assert!(forces.joints.iter().all(|joint| joint.reaction.is_none()));
}

/// Two ellipses that roll on each other about a focus of each: the normal of a flank is known from their ray.
#[test]
fn teeth_of_an_elliptic_pair_push_square_to_its_pitch_curves() {
    let (k, a) = (0.3_f64, 50.0);
    let ratio = move |t: f64| (1.0 - k * k) / (1.0 + k * k - 2.0 * k * t.cos());
    let mut pair = machine(&["frame", "driver", "driven"]);
    pair.joint(Joint::turning(0, 1, turning(-1.0)));
    let driven = law(move |t| MotionJet {
        position: 2.0 * ((1.0 + k) / (1.0 - k) * (0.5 * t).tan()).atan(),
        velocity: ratio(t),
        acceleration: -ratio(t) * 2.0 * k * t.sin() / (1.0 + k * k - 2.0 * k * t.cos()),
        jerk: 0.0,
    });
    pair.joint(Joint::turning(0, 2, driven).at([2.0 * a, 0.0, 0.0]));
    let alpha = 20_f64.to_radians();
    pair.meshes.push(GearMesh::new([1, 2], 1, alpha));
    pair.loads.push(torque(2, -500.0));
    let balance = Balance::new(pair).expect("a machine");
    for i in 1..30 {
        let t = 0.1 * f64::from(i);
        // r = a (1 - k^2) / (1 - k cos t), the driver's radius towards its mate.
        let r = a * (1.0 - k * k) / (1.0 - k * t.cos());
        let slope = -r * k * t.sin() / (1.0 - k * t.cos());
        let forces = balance.at(t, 0.0).expect("it turns");
        let mesh = forces.meshes[0];
        assert!(
            (mesh.at - Vector3::new(r, 0.0, 0.0)).norm() < 1e-9,
            "{}",
            mesh.at
        );
        // The radius grows against the driver's turn: seen from outside the curve passes by (slope, r).
        let tangent = Vector3::new(slope, r, 0.0).normalize();
        let outward = Vector3::new(r, -slope, 0.0).normalize();
        let push = outward * alpha.sin() - tangent * alpha.cos();
        let along = mesh.force.normalize();
        assert!((along - push).norm() < 1e-9, "{t}: {along} {push}");
        near(
            (mesh.at - Vector3::new(2.0 * a, 0.0, 0.0))
                .cross(&mesh.force)
                .z,
            500.0,
            1e-10,
        );
        near(forces.input_torque, 500.0 * ratio(t), 1e-9);
    }
}

#[test]
fn teeth_of_gears_that_rest_hold_their_load_along_the_normal_of_their_pitch_curves() {
    // An ellipse on its mate about a focus of each, turned in and out by a law that is fixed at zero.
    let (k, a) = (0.3_f64, 50.0);
    let driven = move |t: f64| {
        let below = 1.0 + k * k - 2.0 * k * t.cos();
        MotionJet {
            position: 2.0 * ((1.0 + k) / (1.0 - k) * (0.5 * t).tan()).atan(),
            velocity: (1.0 - k * k) / below,
            acceleration: -(1.0 - k * k) * 2.0 * k * t.sin() / (below * below),
            jerk: 0.0,
        }
    };
    let (start, mount) = (0.8_f64, 0.25);
    let swing = move |x: f64| MotionJet {
        position: start + 0.5 * x.sin().powi(2),
        velocity: 0.5 * (2.0 * x).sin(),
        acceleration: (2.0 * x).cos(),
        jerk: -2.0 * (2.0 * x).sin(),
    };
    let mut pair = machine(&["frame", "driver", "driven"]);
    let turned = move |x| {
        let mut jet = MotionJet::default().plus(-1.0, &swing(x));
        jet.position -= mount;
        jet
    };
    pair.joint(Joint::turning(0, 1, law(turned)));
    let follows = law(move |x| driven(swing(x).position).after(&swing(x)));
    pair.joint(Joint::turning(0, 2, follows).at([2.0 * a, 0.0, 0.0]));
    let alpha = 20_f64.to_radians();
    pair.meshes.push(GearMesh {
        links: [1, 2],
        joint: 1,
        copy: 0,
        pressure_angle: Some(alpha),
        axes: Default::default(),
        pitch: Some(PitchCurves {
            driven: law(driven),
            zero: mount,
        }),
    });
    pair.loads.push(torque(2, -500.0));
    let balance = Balance::new(pair).expect("a machine");
    for x in [0.0, 1e-7, 1e-3, 0.4] {
        let t = swing(x).position;
        let r = a * (1.0 - k * k) / (1.0 - k * t.cos());
        let slope = -r * k * t.sin() / (1.0 - k * t.cos());
        let tangent = Vector3::new(slope, r, 0.0).normalize();
        let outward = Vector3::new(r, -slope, 0.0).normalize();
        let forces = balance.at(x, 0.0).expect("held");
        let mesh = forces.meshes[0];
        assert!((mesh.at - Vector3::new(r, 0.0, 0.0)).norm() < 1e-12);
        let push = outward * alpha.sin() - tangent * alpha.cos();
        assert!((mesh.force.normalize() - push).norm() < 1e-12, "{x}");
        let arm = mesh.at - Vector3::new(2.0 * a, 0.0, 0.0);
        near(arm.cross(&mesh.force).z, 500.0, 1e-12);
    }
}
