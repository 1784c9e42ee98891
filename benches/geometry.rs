//! Cost of the numbers underneath: integrals, and curve segments against tolerance.

use std::f64::consts::TAU;
use std::hint::black_box;

use centrode_geometry::{Antiderivative, Point, PolySegment, Tolerance};
use criterion::{BenchmarkId, Criterion, criterion_group};

/// Focal ellipse of the 2018 pair, mm.
fn ellipse(phi: f64) -> Point {
    let (sin, cos) = phi.sin_cos();
    let r = 24.462_434_487_142_04 / (1.0 - 0.267_949_192_431_122_7 * cos);
    Point::new(r * cos, r * sin)
}

fn primitive(c: &mut Criterion) {
    let ratio = |phi: f64| {
        let r = ellipse(phi).coords.norm();
        r / (52.709_220_759_512_11 - r)
    };
    c.bench_function("primitive/of", |b| {
        b.iter(|| Antiderivative::new(ratio, black_box(&[0.0, TAU])))
    });
    let turn = Antiderivative::new(ratio, &[0.0, TAU]);
    c.bench_function("primitive/at", |b| b.iter(|| turn.at(black_box(2.345))));
}

fn fit(c: &mut Criterion) {
    let mut group = c.benchmark_group("spline/fit");
    for exponent in [2, 4, 6, 8, 10, 12] {
        let Ok(tolerance) = Tolerance::new(10_f64.powi(-exponent)) else {
            continue;
        };
        group.bench_with_input(
            BenchmarkId::from_parameter(format!("1e-{exponent}")),
            &tolerance,
            |b, &tolerance| b.iter(|| PolySegment::fit(ellipse, 0.0, TAU, tolerance)),
        );
    }
    group.finish();
}

criterion_group!(benches, primitive, fit);
