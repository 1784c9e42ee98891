//! Cost of proving three arms clear of one another over a whole cycle.

use std::f64::consts::TAU;
use std::hint::black_box;

use centrode_analysis::interference::{
    Body, Motion, Moving, PoseJet, Tabulated, clearance, minimum_clearance,
};
use centrode_analysis::{ArmClearance, between_arms};
use centrode_gear::pitch::{Bspline, PitchSpec};
use centrode_geometry::{Outline, Point, Tolerance, Vector};
use centrode_machines::arm::{ArmBody, ArmBodySpec};
use centrode_machines::three_arm::ThreeArm;
use centrode_machines::three_arm::design::{ArmSpec, ThreeArmDesign};
use criterion::{BenchmarkId, Criterion, criterion_group};

fn tolerance(mm: f64) -> Tolerance {
    Tolerance::new(mm).expect("positive")
}

/// A bent arm with a thin clamp 145 mm from its axis, as a polygon of as many corners as required.
fn arm(corners: u32) -> Body {
    let shape = [
        [-34.0, 0.0],
        [-25.0, -60.0],
        [-10.0, -79.0],
        [60.0, -79.0],
        [70.0, -70.0],
        [129.6, -67.0],
        [129.6, -63.0],
        [70.0, -60.0],
        [34.0, 5.0],
        [20.0, 28.0],
        [-15.0, 30.0],
    ]
    .map(Point::from);
    let side = |i: usize| (shape[i], shape[(i + 1) % shape.len()]);
    let length: f64 = (0..shape.len())
        .map(|i| (side(i).1 - side(i).0).norm())
        .sum();
    let mut points = Vec::new();
    let (mut i, mut walked) = (0, 0.0);
    for k in 0..corners {
        let along = length * f64::from(k) / f64::from(corners);
        while along > walked + (side(i).1 - side(i).0).norm() {
            walked += (side(i).1 - side(i).0).norm();
            i += 1;
        }
        let (a, b) = side(i);
        let share = (along - walked) / (b - a).norm();
        // A little bulge, so that no edges are in line.
        let out = Vector::new(b.y - a.y, a.x - b.x) * (0.02 * share * (1.0 - share));
        points.push(a + (b - a) * share + out);
    }
    Body::new(&[Outline::polygon(&points)], tolerance(1e-3)).expect("a body")
}

/// The arms' turning seen from the carrier: once round in a turn, unevenly, a third of a turn apart.
fn motions(carrier: f64) -> [Tabulated; 3] {
    [0.0, 1.0, 2.0].map(|k| {
        let phase = TAU * k / 3.0;
        let (sin, cos) = phase.sin_cos();
        Tabulated::new([0.0, TAU], 720, |input| {
            let t = input - phase;
            PoseJet {
                position: Point::new(carrier * cos, -carrier * sin),
                angle: 0.6 - phase + t + 0.7 * t.sin() + 0.3 * (2.0 * t).cos(),
                velocity: Vector::zeros(),
                turning: 1.0 + 0.7 * t.cos() - 0.6 * (2.0 * t).sin(),
            }
        })
        .expect("smooth")
    })
}

const PAIRS: [[usize; 2]; 3] = [[0, 1], [1, 2], [2, 0]];

fn arms(c: &mut Criterion) {
    let mut group = c.benchmark_group("interference/three arms");
    for (what, carrier) in [("clear", 200.0), ("overlapping", 147.0)] {
        let motions = motions(carrier);
        for corners in [40, 156, 600] {
            let arm = arm(corners);
            let bodies = motions.each_ref().map(|motion| Moving {
                body: &arm,
                motion: motion as &dyn Motion,
            });
            for mm in [1e-2, 1e-3] {
                let name = format!("{what}, {corners} corners, within {mm} mm");
                let cycle = [0.0, TAU];
                let one = || clearance(&bodies[0], &bodies[1], cycle, tolerance(mm));
                let found = one().expect("finite");
                assert_eq!(found.minimum > 0.0, what == "clear", "{found:?}");
                group.bench_function(BenchmarkId::new("three pairs", &name), |b| {
                    b.iter(|| {
                        let mm = tolerance(mm);
                        minimum_clearance(black_box(&bodies), &PAIRS, cycle, mm)
                    });
                });
                group.bench_function(BenchmarkId::new("one pair tells all", &name), |b| {
                    b.iter(one);
                });
            }
        }
    }
    group.bench_function("tabulate three motions", |b| b.iter(|| motions(200.0)));
    group.bench_function("body of 156 corners", |b| b.iter(|| self::arm(156)));
    group.finish();
}

/// The published mechanism with the arm of default sizes: arms against arms, from pitch curve to proof.
fn published(c: &mut Criterion) {
    let radius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24];
    let angle = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345];
    let pitch = PitchSpec::Bspline(Bspline {
        degree: 2,
        radius: radius.map(f64::from).to_vec(),
        angle: angle.map(|deg| f64::from(deg).to_radians()).to_vec(),
        ..Bspline::default()
    });
    let arm = ArmSpec::new(-29_f64.to_radians(), 145.0, 65.0);
    let design = ThreeArmDesign::new(pitch, 86_f64.to_radians(), -53_f64.to_radians(), arm);
    let machine = ThreeArm::resolve(&design).expect("a mechanism");
    let body = ArmBody::new(&ArmBodySpec::default(), 145.0, 65.0, 60.0).expect("an arm");
    let mut group = c.benchmark_group("interference/published");
    group.bench_function("resolve", |b| {
        b.iter(|| ThreeArm::resolve(black_box(&design)))
    });
    group.bench_function("arms", |b| {
        b.iter(|| between_arms(black_box(&machine), &body, tolerance(1e-2)));
    });
    group.bench_function("arms, tray, seedlings", |b| {
        b.iter(|| ArmClearance::analyse(black_box(&machine), &body, tolerance(1e-2)));
    });
    group.finish();
}

criterion_group!(benches, arms, published);
