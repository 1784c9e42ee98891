use std::f64::consts::TAU;
use std::sync::Arc;

use centrode_geometry::Point;
use proptest::prelude::Strategy;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::TipPath;
use crate::reverse::{RequiredPath, Split, SplitKind, TwoBar};
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_spec::{Design as _, DesignSpec as _};

/// Machines tried where no other number is requested by `PROPTEST_CASES`.
const MACHINES: u32 = 4;

/// A mechanism of one arm, one pair twice: pitch curve, bend, bars and sense of any kind.
fn machine() -> impl Strategy<Value = ThreeArm> {
    let shares = proptest::collection::vec(0.0..1.0_f64, 12 + 5);
    (shares, 2..4_u32).prop_filter_map("no mechanism, or near a fraction", |(shares, degree)| {
        let radius: Vec<f64> = shares[..12]
            .iter()
            .map(|s| 40.0 * (0.9 * (s - 0.5)).exp())
            .collect();
        let [bend, mount, tip, sense, wild] = shares[12..] else {
            return None;
        };
        let bend = 80.0 * (2.0 * bend - 1.0);
        let turns = (bend + 180.0) / 360.0;
        let is_near = |q: u32| {
            let q = f64::from(q);
            (turns * q - (turns * q).round()).abs() / q < 1e-3
        };
        if (1..12).any(is_near) {
            return None;
        }
        let radius: Vec<String> = radius
            .iter()
            .map(|r| (40.0 + (r - 40.0) * (0.3 + 0.7 * wild)).to_string())
            .collect();
        let angles: Vec<String> = (0..12).map(|k| (30 * k).to_string()).collect();
        let direction = if sense < 0.5 {
            "clockwise"
        } else {
            "counter-clockwise"
        };
        let text = format!(
            "family = \"three-arm\"\ndirection = \"{direction}\"\nbend_deg = {bend}\ntooth_count = 37\n\
             pitch = {{ kind = \"bspline\", plane = \"polar\", degree = {degree}, radius = [{}], angle_deg = [{}] }}\ncarrier_start_deg = 30\nwork = {{ picking_deg = 20, planting_deg = 191 }}\n\
             arm = {{ mounting_angle_deg = {}, tip_distance = {}, pusher_offset = 20 }}\n",
            radius.join(", "),
            angles.join(", "),
            360.0 * mount,
            60.0 + 160.0 * tip,
        );
        let design = ThreeArmDesign::from_toml(&text).ok()?;
        ThreeArm::resolve(&design).ok()
    })
}

/// Bars and pitch curve from the path alone, held against those that made it.
fn come_back(machine: &ThreeArm) -> Result<[f64; 3], String> {
    let path = RequiredPath::new(Arc::new(TipPath(machine.clone())));
    let design = machine.design();
    let chain = TwoBar::new(&path, Point::origin(), Some(design.direction))
        .map_err(|fault| fault.to_string())?;
    let bend = machine.train().bend();
    let leg = machine.center_distance();
    let carrier = 2.0 * leg * (0.5 * bend).cos();
    let bars = (chain.carrier() - carrier)
        .abs()
        .max((chain.arm() - design.arm.tip_distance).abs());
    let split = Split::new(&chain, SplitKind::OnePair, bend).map_err(|error| error.to_string())?;
    let rolling = machine.rolling();
    let shift = machine.train().carrier_start() + 0.5 * bend;
    let radius = |ratio: f64| leg * ratio / (1.0 + ratio);
    let h = 1e-3;
    let mut worst = 0.0_f64;
    let mut law = 0.0_f64;
    let start = split.first(0.0) - rolling.driven_angle(-shift);
    for i in 0..500 {
        let psi = TAU * f64::from(i) / 500.0;
        let slope = |f: &dyn Fn(f64) -> f64| {
            // Differences of fourth order.
            (8.0 * (f(psi + h) - f(psi - h)) - (f(psi + 2.0 * h) - f(psi - 2.0 * h))) / (12.0 * h)
        };
        let known = |psi: f64| rolling.driven_angle(psi - shift);
        let found = |psi: f64| split.first(psi);
        law = law.max((found(psi) - known(psi) - start).abs());
        let [one, other] = [slope(&known), slope(&found)].map(radius);
        worst = worst.max((one - other).abs() / one);
    }
    Ok([bars, law, worst])
}

#[test]
fn random_machines_come_back_from_their_paths() {
    let cases = std::env::var("PROPTEST_CASES").ok();
    let cases = cases.and_then(|n| n.parse().ok()).unwrap_or(MACHINES);
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut failed = Vec::new();
    for case in 0..cases {
        let machine = machine()
            .new_tree(&mut runner)
            .expect("a mechanism")
            .current();
        let stated = match come_back(&machine) {
            Ok([bars, law, radius]) => {
                let stated = format!("bars {bars:.1e} mm, law {law:.1e} rad, radius {radius:.1e}");
                if bars < 1e-9 && radius < 1e-5 {
                    continue;
                }
                stated
            }
            Err(error) => error,
        };
        let design = machine.design().to_toml().expect("a file");
        failed.push(format!("{case}: {stated}\n{design}"));
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
