use std::f64::consts::TAU;

use centrode_geometry::{Point, Vector};

use super::{KeyPose, KeyPoses, PoseError};

/// Pose of a known machine, whose planet turns by `psi + 0.3 sin psi`.
fn known(psi: f64) -> KeyPose {
    let bar = |length: f64, angle: f64| Vector::new(angle.cos(), angle.sin()) * length;
    let alpha = 0.4 - 0.3 * psi.sin();
    let point = Point::new(30.0, -20.0) + bar(70.0, psi) + bar(160.0, alpha);
    let direction = alpha + 0.25;
    KeyPose { point, direction }
}

fn at(shares: &[f64]) -> Vec<KeyPose> {
    shares.iter().map(|s| known(TAU * s)).collect()
}

fn assert_met(poses: &[KeyPose], found: &KeyPoses) {
    let chain = &found.chain;
    // Independent of what was found: the path by brute force, its nearest position to each pose, and the arm there.
    let period = chain.path().period();
    for (i, pose) in poses.iter().enumerate() {
        let tip = |t: f64| {
            let jet = chain.at(t);
            let [carrier, arm] = [jet.carrier[0], jet.elbow[0]];
            let off = (chain.tip(carrier, arm) - pose.point).norm();
            (off, carrier + arm + found.clamp - pose.direction)
        };
        let steps = 200_000;
        let all = (0..steps).map(|k| tip(period * f64::from(k) / f64::from(steps)));
        let (off, turned) = all.min_by(|a, b| a.0.total_cmp(&b.0)).expect("places");
        assert!(off < 0.1, "pose {i}: {off} mm");
        let turned = (turned - TAU * (turned / TAU).round()).to_degrees().abs();
        assert!(turned < 0.1, "pose {i}: {turned} deg");
        assert!(found.misses[i][0] <= off + 1e-9);
        assert!(found.misses[i][1].to_degrees() < 0.1);
    }
}

#[test]
fn poses_of_a_known_machine_are_met_again() {
    for shares in [
        &[0.0, 0.3, 0.55][..],
        &[0.05, 0.3, 0.55, 0.8],
        &[0.05, 0.25, 0.45, 0.62, 0.85],
        &[0.0, 0.17, 0.3, 0.5, 0.7, 0.85],
        &[0.0, 0.12, 0.3, 0.42, 0.6, 0.71, 0.9],
    ] {
        let poses = at(shares);
        let found = KeyPoses::new(&poses).expect("a machine");
        assert_met(&poses, &found);
        assert!(found.possible > 0);
        // More than five poses leave the machine itself alone.
        if shares.len() > 5 {
            assert!((found.chain.carrier() - 70.0).abs() < 1e-4);
            assert!((found.chain.arm() - 160.0).abs() < 1e-4);
        }
    }
}

#[test]
fn one_pair_twice_brings_the_arm_through_the_poses_at_any_bend() {
    let poses = at(&[0.05, 0.25, 0.45, 0.62, 0.85]);
    let found = KeyPoses::new(&poses).expect("a machine");
    let [carrier, arm] = found.start;
    for (bend, bias) in [(0.7_f64, 0.0), (-0.9, 0.0), (1.4, 0.03)] {
        let law = found.one_pair(bend, &[bias, -bias]).expect("a law");
        // Independent of what was found: the train forwards, by bisection of the law.
        let met = |psi: f64| {
            let required = law.at(psi) - bend - std::f64::consts::PI;
            let (mut low, mut high) = (required - 3.0, required + 3.0);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if law.at(middle) < required {
                    low = middle
                } else {
                    high = middle
                }
            }
            low
        };
        for (pose, [turn, _]) in poses.iter().zip(&found.turns) {
            let psi = found.chain.sense() * turn;
            let turned = arm + psi - (met(psi) - met(0.0));
            let tip = found.chain.tip(carrier + psi, turned - (carrier + psi));
            assert!(
                (tip - pose.point).norm() < 1e-6,
                "{bend}: {tip} {}",
                pose.point
            );
            let off = turned + found.clamp - pose.direction;
            assert!(
                (off - TAU * (off / TAU).round()).abs() < 1e-9,
                "{bend}: {off}"
            );
        }
    }
}

#[test]
fn six_poses_of_no_machine_are_refused_with_how_near_the_nearest_comes() {
    let mut poses = at(&[0.0, 0.17, 0.3, 0.5, 0.7, 0.85]);
    poses[2].point.x += 40.0;
    poses[4].point.y -= 30.0;
    match KeyPoses::new(&poses) {
        Err(PoseError::NoCircle { count: 6, miss }) => assert!(miss > 0.1 && miss < 50.0),
        other => panic!("{other:?}"),
    }
}

#[test]
fn too_few_poses_and_ones_at_one_place_are_refused() {
    let two = KeyPoses::new(&at(&[0.0, 0.5]));
    assert!(matches!(two, Err(PoseError::Count { count: 2 })));
    let one = KeyPoses::new(&[known(0.0); 3]);
    assert!(matches!(one, Err(PoseError::OnePlace)));
    let mut poses = at(&[0.0, 0.3, 0.55]);
    poses[1].direction = f64::NAN;
    assert!(matches!(KeyPoses::new(&poses), Err(PoseError::Path(_))));
}

#[test]
fn a_file_gives_the_poses_and_a_line_without_a_direction_is_named() {
    let lines = at(&[0.0, 0.3, 0.55]);
    let lines = lines.iter().map(|pose| {
        let (p, degrees) = (pose.point, pose.direction.to_degrees());
        format!("{},{},{degrees}\n", p.x, p.y)
    });
    let text = format!("x,y,direction_deg\n{}", lines.collect::<String>());
    assert_eq!(KeyPose::from_csv(text.as_bytes()).map(|p| p.len()), Ok(3));
    let error = KeyPose::from_csv(b"x,y,direction_deg\n0,0,5\n1,1\n").expect_err("short");
    assert!(
        error.to_string().starts_with("line 3 has 2 values"),
        "{error}"
    );
}
