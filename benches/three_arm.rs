//! Cost of a three-arm mechanism: resolved exactly, and swept over as an optimiser does.

use std::hint::black_box;

use centrode_analysis::{check_machine, check_three_arm};
use centrode_gear::pitch::PitchSpec;
use centrode_machines::machine::{Machine, MachineDesign};
use centrode_machines::three_arm::design::ThreeArmDesign;
use centrode_machines::three_arm::{Sweep, ThreeArm};
use centrode_optimise::Problem;
use centrode_spec::DesignSpec as _;
use centrode_synthesis::optimise::three_arm::ThreeArmProblem;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};

fn template() -> ThreeArmDesign {
    ThreeArmDesign::from_toml(ThreeArmDesign::TEMPLATE).expect("a good design")
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

/// One evaluation of the search: at points by chance within the bounds, which are mostly left after the figures, and at
/// a design that reaches all goals, of which every tooth is followed.
fn evaluate(c: &mut Criterion) {
    let mut group = c.benchmark_group("three-arm/evaluate");
    let problem = ThreeArmProblem::new(&template()).expect("of the kind");
    let bounds = problem.bounds();
    let points: Vec<Vec<f64>> = (0..64)
        .map(|i| {
            let share = |k: usize| ((i * 31 + k * 17) as f64 * 0.618_033_988_749_895).fract();
            let at = |(k, &(low, high)): (usize, &(f64, f64))| low + (high - low) * share(k);
            bounds.iter().enumerate().map(at).collect()
        })
        .collect();
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("by chance", |b| {
        b.iter(|| {
            for point in &points {
                black_box(problem.evaluate(black_box(point)));
            }
        });
    });
    let text = include_str!("../tests/designs/three-arm-all-goals.toml");
    let good = ThreeArmDesign::from_toml(text).expect("a three-arm mechanism");
    let problem = ThreeArmProblem::new(&good).expect("of the kind");
    let start = problem.start().expect("a start");
    group.throughput(Throughput::Elements(1));
    group.sample_size(10);
    group.bench_function("all goals", |b| {
        b.iter(|| problem.evaluate(black_box(&start)))
    });
    group.finish();
}

/// The published machine resolved and checked, by its family and composed of bodies, meshes and cams; with another backlash each
/// time, so that no teeth can be remembered.
fn check(c: &mut Criterion) {
    let mut group = c.benchmark_group("three-arm/check");
    group.sample_size(10);
    let own = include_str!("../tests/designs/three-arm-2021.toml");
    let own = ThreeArmDesign::from_toml(own).expect("a good design");
    let composed = include_str!("../tests/designs/composed-three-arm.toml");
    let composed = MachineDesign::from_toml(composed).expect("a good design");
    let mut backlash = 0.05;
    let mut another = || {
        backlash += 1e-9;
        backlash
    };
    group.bench_function("own family", |b| {
        b.iter(|| {
            let mut design = own.clone();
            design.teeth.backlash = another();
            check_three_arm(&ThreeArm::resolve(&design).expect("a mechanism"))
        });
    });
    group.bench_function("composed", |b| {
        b.iter(|| {
            let mut design = composed.clone();
            for pair in design.pairs.values_mut() {
                pair.teeth.backlash = another();
            }
            check_machine(&Machine::resolve(&design).expect("a machine"))
        });
    });
    group.finish();
}

/// Machines of bodies that turn on pins of the frame of their own: the time per body must hardly grow with their number.
fn bodies(c: &mut Criterion) {
    let mut group = c.benchmark_group("machine/bodies");
    group.sample_size(10);
    for count in [50_u32, 100, 200, 400] {
        let mut text = "family = \"machine\"\nhardware = \"full\"\n[frame.points]\n".to_owned();
        for i in 0..count {
            text += &format!("P{i} = [{}, {}]\n", i % 20 * 100, i / 20 * 100);
        }
        for i in 0..count {
            text += &format!("[bodies.b{i}]\non = \"frame.P{i}\"\npoints = {{ T = [20, 0] }}\n");
            text += "law = { expression = \"phi\" }\n";
        }
        let design = MachineDesign::from_toml(&text).expect("a good design");
        group.throughput(Throughput::Elements(count.into()));
        group.bench_function(count.to_string(), |b| {
            b.iter(|| check_machine(&Machine::resolve(&design).expect("a machine")));
        });
    }
    group.finish();
}

criterion_group!(benches, sweep, resolve, tip, evaluate, check, bodies);
