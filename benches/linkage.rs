//! Cost of linkages: one position with derivatives, a search for half a turn of swing.

use std::hint::black_box;
use std::ops::ControlFlow;

use centrode_analysis::six_bar::{PUBLISHED_BOUNDS, RequiredSwing};
use centrode_geometry::Point;
use centrode_kinematics::linkage::{Branch, FourBar, LinkId, Linkage, SixBar};
use centrode_optimise::{Method, Settings, minimise};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};

const PIVOT: Point = Point::new(100.0, 67.0);

fn six_bar() -> SixBar {
    let four_bar = FourBar::new(77.0, 147.0, 127.0, 105.0, Branch::Upper).expect("lengths");
    SixBar::new(four_bar, PIVOT, 200.0).expect("a six-bar")
}

fn composed() -> Linkage {
    let build = || {
        let mut linkage = Linkage::new();
        let a = linkage.point(LinkId::FRAME, Point::origin())?;
        let d = linkage.point(LinkId::FRAME, Point::new(105.0, 0.0))?;
        let f = linkage.point(LinkId::FRAME, PIVOT)?;
        let (_, b) = linkage.crank(a, 77.0, 0.0)?;
        let bars = linkage.rrr(b, d, (147.0, 127.0), Branch::Upper)?;
        let effector = linkage.rpr(bars.joint, f, 0.0, Branch::Upper)?;
        linkage.point(effector.link, Point::new(200.0, 0.0))?;
        Ok::<_, centrode_kinematics::linkage::LinkageError>(linkage)
    };
    build().expect("a linkage")
}

/// Every joint and the effector's angle, with velocity, acceleration and jerk.
fn positions(c: &mut Criterion) {
    let mut group = c.benchmark_group("linkage/position");
    let count = 1000;
    let inputs: Vec<f64> = (0..count).map(|i| f64::from(i) * 0.006_283).collect();
    group.throughput(Throughput::Elements(u64::from(count as u32)));
    let six_bar = six_bar();
    group.bench_function("six-bar, all joints to the jerk", |b| {
        b.iter(|| {
            for &phi in &inputs {
                black_box(six_bar.at(black_box(phi)));
            }
        });
    });
    group.bench_function("six-bar, all joints to the jerk, side by side", |b| {
        b.iter(|| six_bar.at_each(black_box(&inputs)));
    });
    group.bench_function("six-bar, joints alone", |b| {
        b.iter(|| {
            for &phi in &inputs {
                black_box(six_bar.joints(black_box(phi)));
            }
        });
    });
    group.bench_function("six-bar, joints alone, side by side", |b| {
        b.iter(|| six_bar.joints_each(black_box(&inputs)));
    });
    group.bench_function("six-bar, effector's angle to the jerk", |b| {
        b.iter(|| {
            for &phi in &inputs {
                black_box(six_bar.effector_angle(black_box(phi)));
            }
        });
    });
    group.bench_function("six-bar, effector's angle to the jerk, side by side", |b| {
        b.iter(|| six_bar.effector_angle_each(black_box(&inputs)));
    });
    let linkage = composed();
    group.bench_function("the same as a composition", |b| {
        b.iter(|| {
            for &phi in &inputs {
                black_box(linkage.at(black_box(phi)).expect("it turns"));
            }
        });
    });
    group.finish();
}

/// Lengths that swing the effector half a turn within a millionth of a degree.
fn search(c: &mut Criterion) {
    let problem = RequiredSwing {
        bounds: PUBLISHED_BOUNDS,
        pivot: PIVOT,
        branch: Branch::Upper,
        swing: std::f64::consts::PI,
        minimum_transmission_angle: None,
    };
    let mut group = c.benchmark_group("linkage/search");
    for (name, method) in Method::NAMES {
        let settings = Settings {
            method,
            evaluations: 100_000,
            target: Some(1e-6_f64.to_radians()),
            ..Settings::default()
        };
        // The same seed takes the same number of evaluations every time.
        let found = minimise(&problem, settings, &mut |_| ControlFlow::Continue(()));
        let (search, _) = found.expect("settings are sound");
        group.throughput(Throughput::Elements(search.evaluations()));
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| minimise(&problem, settings, &mut |_| ControlFlow::Continue(())));
        });
    }
    group.finish();
}

criterion_group!(benches, positions, search);
