//! Cost of a spiral shaft: its law, a whole cycle's tables, the solid against tolerance.

use std::hint::black_box;

use centrode_formats::{step, stl};
use centrode_geometry::Tolerance;
use centrode_groove::{SpiralShaft, SpiralShaftDesign};
use centrode_kinematics::transmission::Transmission;
use criterion::{BenchmarkId, Criterion, criterion_group};

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
    c.bench_function("shaft/law, force and walls of 10,000 inputs", |b| {
        b.iter(|| {
            let at = |i: u32| {
                let theta = step * f64::from(i);
                let groove = shaft.groove();
                let walls = groove.beside(theta, 5.0).y + groove.beside(theta, -5.0).y;
                shaft.traverse().at(theta).position
                    + shaft.force(theta, shaft.load()).torque
                    + walls
            };
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
    let Ok(tolerance) = Tolerance::new(1e-2) else {
        return;
    };
    // What cutting one plain helical groove takes a CAD kernel 0.94 s for.
    c.bench_function("shaft/solid and STL at 0.01 mm", |b| {
        b.iter(|| shaft.mesh(tolerance).map(|mesh| stl::write(&mesh)));
    });
    c.bench_function("shaft/exact boundary and STEP", |b| {
        b.iter(|| {
            let shell = shaft.shell();
            shell.map(|shell| step::write_shell(&shell, "shaft", "shaft"))
        });
    });
}

criterion_group!(benches, cycle, mesh);
