//! Cost of finding a machine from the path of its tip: a map of axes, and one axis with its bars, law and split.

use std::hint::black_box;

use centrode_geometry::Point;
use centrode_synthesis::reverse::{AxisMap, AxisRange, RequiredPath, Split, SplitKind, TwoBar};
use criterion::{Criterion, criterion_group};

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
/// Bend of the carrier, degrees, away from small fractions of a turn.
const BEND: f64 = 40.3;

fn path() -> RequiredPath {
    let points: Vec<Point> = DRAWN.iter().map(|&p| p.into()).collect();
    RequiredPath::through(&points).expect("a path")
}

fn map(c: &mut Criterion) {
    let path = path();
    let range = AxisRange {
        count: [100, 100],
        ..AxisRange::about(&path)
    };
    let mut group = c.benchmark_group("reverse/map");
    group.sample_size(10);
    group.bench_function("100x100", |b| b.iter(|| AxisMap::new(&path, range)));
    group.finish();
}

fn one_axis(c: &mut Criterion) {
    let path = path();
    let axis = Point::new(260.0, 160.0);
    let mut group = c.benchmark_group("reverse/one-axis");
    group.bench_function("bars", |b| {
        b.iter(|| TwoBar::new(&path, black_box(axis), None));
    });
    let chain = TwoBar::new(&path, axis, None).expect("a chain");
    group.bench_function("law", |b| b.iter(|| chain.law()));
    group.bench_function("least-radius", |b| {
        b.iter(|| chain.minimum_radius(BEND.to_radians()));
    });
    group.sample_size(10);
    for (name, kind) in SplitKind::NAMES {
        let made = || {
            let chain = TwoBar::new(&path, axis, None).expect("a chain");
            let law = chain.law();
            (law, Split::new(&chain, kind, BEND.to_radians()))
        };
        group.bench_function(name, |b| b.iter(made));
    }
    group.finish();
}

criterion_group!(benches, map, one_axis);
