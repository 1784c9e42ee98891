//! Cost of a three-arm mechanism: resolved exactly, and swept over as an optimiser does.

use std::hint::black_box;

use centrode_mechanism::design::Design;
use centrode_mechanism::gear::pitch::PitchSpec;
use centrode_mechanism::three_arm::design::ThreeArmDesign;
use centrode_mechanism::three_arm::{Sweep, ThreeArm};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn template() -> ThreeArmDesign {
    let text = Design::template("three-arm").expect("a family");
    let Ok(Design::ThreeArm(design)) = Design::from_toml(text) else {
        unreachable!("the template is a three-arm mechanism")
    };
    *design
}

/// A hundred designs around the published one, so that no answer can be remembered.
fn designs() -> Vec<ThreeArmDesign> {
    (0..100)
        .map(|i| {
            let mut design = template();
            if let PitchSpec::Bspline(spline) = &mut design.pitch {
                for (k, radius) in spline.radius.iter_mut().enumerate() {
                    *radius *= 1.0 + 0.02 * (f64::from(i) * 0.7 + k as f64).sin();
                }
            }
            design
        })
        .collect()
}

/// Centre distance, both stages, path and goals 2 to 4 and 6 to 8 of one machine, against the number of inputs.
fn sweep(c: &mut Criterion) {
    let mut group = c.benchmark_group("three-arm/sweep");
    let designs = designs();
    for inputs in [90, 180, 360, 720] {
        let mut sweep = Sweep::like(&designs[0], inputs).expect("of the kind");
        group.throughput(Throughput::Elements(designs.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(inputs), |b| {
            b.iter(|| {
                for design in &designs {
                    black_box(sweep.figures(black_box(design)).expect("a mechanism"));
                }
            });
        });
    }
    group.finish();
}

fn resolve(c: &mut Criterion) {
    let design = template();
    c.bench_function("three-arm/resolve", |b| {
        b.iter(|| ThreeArm::resolve(black_box(&design)).expect("a mechanism"));
    });
}

fn tip(c: &mut Criterion) {
    let mechanism = ThreeArm::resolve(&template()).expect("a mechanism");
    let mut input = 0.0;
    c.bench_function("three-arm/tip", |b| {
        b.iter(|| {
            input += 0.1;
            mechanism.tip(black_box(input), 0)
        });
    });
}

criterion_group!(benches, sweep, resolve, tip);
criterion_main!(benches);
