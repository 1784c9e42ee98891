//! Cost of resolving a pitch curve: proof that it goes round, and scaling to a module.

use centrode_gear::pitch::{Bspline, Ellipse, LobedEllipse, PitchSpec};
use criterion::{Criterion, criterion_group};

fn specs() -> [(&'static str, PitchSpec); 3] {
    let ellipse = Ellipse {
        eccentricity: 0.267_949_192_431_122_7,
        module: Some(2.25),
        tooth_count: Some(23),
        ..Ellipse::default()
    };
    let lobed = LobedEllipse {
        lobes: 3,
        eccentricity: 0.1,
        module: Some(2.0),
        tooth_count: Some(60),
        ..LobedEllipse::default()
    };
    let transplanter = Bspline {
        degree: 2,
        radius: vec![
            21.0, 28.0, 50.0, 49.0, 58.0, 47.0, 18.0, 12.0, 28.0, 60.0, 48.0, 24.0,
        ],
        angle: [
            20.0, 45.0, 76.0, 105.0, 132.0, 165.0, 195.0, 225.0, 255.0, 285.0, 316.0, 345.0_f64,
        ]
        .map(f64::to_radians)
        .to_vec(),
        ..Bspline::default()
    };
    [
        ("ellipse", PitchSpec::Ellipse(ellipse)),
        ("lobed-ellipse", PitchSpec::LobedEllipse(lobed)),
        ("transplanter", PitchSpec::Bspline(transplanter)),
    ]
}

fn resolve(c: &mut Criterion) {
    let mut group = c.benchmark_group("pitch/resolve");
    for (name, spec) in specs() {
        group.bench_function(name, |b| b.iter(|| spec.resolve()));
    }
    group.finish();
}

criterion_group!(benches, resolve);
