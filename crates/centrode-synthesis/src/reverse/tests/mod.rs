mod axes;
mod machines;
mod paths;
mod random;
mod splits;
mod timing;

use std::sync::Arc;

use centrode_geometry::{Curve, Jet, Point, Vector};

use super::RequiredPath;
use centrode_kinematics::machine::Keyway;
use centrode_kinematics::transmission::MotionJet;
use centrode_machines::machine::{Hold, Machine};
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::DesignSpec as _;

const PUBLISHED: &str = include_str!("../../../../../tests/designs/three-arm-2021.toml");

/// A path drawn by hand, mm.
const DRAWN: [[f64; 2]; 13] = [
    [0.0, 0.0],
    [60.0, 70.0],
    [150.0, 150.0],
    [230.0, 215.0],
    [262.0, 262.0],
    [235.0, 300.0],
    [170.0, 330.0],
    [100.0, 330.0],
    [40.0, 300.0],
    [-5.0, 250.0],
    [-30.0, 190.0],
    [-38.0, 130.0],
    [-30.0, 60.0],
];

fn points(list: &[[f64; 2]]) -> Vec<Point> {
    list.iter().map(|&p| p.into()).collect()
}

fn drawn() -> RequiredPath {
    RequiredPath::through(&points(&DRAWN)).expect("a path")
}

fn published() -> ThreeArm {
    let design = ThreeArmDesign::from_toml(PUBLISHED).expect("a design");
    ThreeArm::resolve(&design).expect("a mechanism")
}

/// Path of the tip of a three-arm mechanism by the carrier's turn.
#[derive(Debug)]
struct TipPath(ThreeArm);

impl Curve for TipPath {
    fn period(&self) -> f64 {
        std::f64::consts::TAU
    }

    fn breaks(&self) -> Vec<f64> {
        self.0.train().breaks()
    }

    fn at(&self, t: f64) -> Jet {
        let jet = self.0.train().at(t);
        let spec = &self.0.design().arm;
        let distance = self.0.center_distance();
        let leg = MotionJet {
            position: jet.carrier.position + self.0.train().bend(),
            ..jet.carrier
        };
        let arm = MotionJet {
            position: jet.arm.position + spec.mounting_angle,
            ..jet.arm
        };
        let bars = [
            (distance, jet.carrier),
            (distance, leg),
            (spec.tip_distance, arm),
        ];
        let mut sum = [Vector::zeros(); 4];
        for (length, angle) in bars {
            for (sum, part) in sum.iter_mut().zip(bar(length, &angle)) {
                *sum += part;
            }
        }
        let [point, first, second, third] = sum;
        Jet {
            point: point.into(),
            first,
            second,
            third,
        }
    }
}

/// A bar by its angle, with three derivatives.
fn bar(length: f64, angle: &MotionJet) -> [Vector; 4] {
    let along = Vector::new(angle.position.cos(), angle.position.sin()) * length;
    let across = Vector::new(-along.y, along.x);
    let (v, a, j) = (angle.velocity, angle.acceleration, angle.jerk);
    [
        along,
        across * v,
        across * a - along * (v * v),
        across * (j - v * v * v) - along * (3.0 * v * a),
    ]
}

fn published_path() -> RequiredPath {
    RequiredPath::new(Arc::new(TipPath(published())))
}

/// Every gear of a machine has the keyway of the standard for its bore, and turns with its shaft by a key.
fn assert_keyed(composed: &Machine) {
    assert!(!composed.gears().is_empty());
    for gear in composed.gears() {
        let body = gear.gear().body();
        assert_eq!(body.keyway, Keyway::of_bore(body.bore));
        // The standard begins above a bore of 6 mm.
        if body.keyway.is_none() {
            assert!(body.bore <= 6.0, "{}: {}", gear.name, body.bore);
            continue;
        }
        let mut parts = composed.shafts().iter().flat_map(|shaft| &shaft.parts);
        let held = parts.find(|part| !part.is_plate && part.name == gear.name);
        let held = held.map(|part| part.hold);
        assert!(
            matches!(held, Some(Hold::Keyed(_))),
            "{}: {held:?}",
            gear.name
        );
    }
}
