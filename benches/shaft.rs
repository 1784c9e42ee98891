//! Cost of a spiral shaft: its law, a whole cycle's tables, the solid against tolerance.

use std::hint::black_box;

use centrode_geometry::Tolerance;
use centrode_mechanism::shaft::{SpiralShaft, SpiralShaftDesign};
use centrode_mechanism::transmission::Transmission;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

/// Inputs over the whole way out and back.
const INPUTS: u32 = 10_000;

fn shaft() -> Option<SpiralShaft> {
    let design = SpiralShaftDesign {
        moved_distance: Some(2.05),
        ..SpiralShaftDesign::default()
    };
    SpiralShaft::resolve(&design).ok()
}

fn cycle(c: &mut Criterion) {
    let Some(shaft) = shaft() else { return };
    let step = shaft.cycle() / f64::from(INPUTS);
    c.bench_function("shaft/resolve", |b| b.iter(|| black_box(self::shaft())));
    c.bench_function("shaft/motion of 10,000 inputs", |b| {
        b.iter(|| {
            let at = |i| shaft.traverse().at(step * f64::from(i)).position;
            (0..INPUTS).map(at).sum::<f64>()
        })
    });
    c.bench_function("shaft/force at 10,000 inputs", |b| {
        b.iter(|| {
            let at = |i| shaft.force(step * f64::from(i), shaft.load()).torque;
            (0..INPUTS).map(at).sum::<f64>()
        })
    });
    c.bench_function("shaft/wall points of 10,000 inputs", |b| {
        b.iter(|| {
            let at = |i| shaft.groove().beside(step * f64::from(i), 5.0).y;
            (0..INPUTS).map(at).sum::<f64>()
        })
    });
    c.bench_function("shaft/crossings", |b| b.iter(|| shaft.groove().crossings()));
}

fn mesh(c: &mut Criterion) {
    let Some(shaft) = shaft() else { return };
    let mut group = c.benchmark_group("shaft/mesh");
    for exponent in [1, 2, 3] {
        let Ok(tolerance) = Tolerance::new(10_f64.powi(-exponent)) else {
            continue;
        };
        let name = format!("1e-{exponent} mm");
        group.bench_with_input(BenchmarkId::from_parameter(name), &tolerance, |b, &t| {
            b.iter(|| shaft.mesh(t));
        });
    }
    group.finish();
}

criterion_group!(benches, cycle, mesh);
criterion_main!(benches);
