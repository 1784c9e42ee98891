//! Cost of a gear pair: cutting the teeth, proving the mesh, fitting the files.

use std::hint::black_box;

use centrode_analysis::{Contact, check, check_contact};
use centrode_gear::GearPair;
use centrode_gear::design::{Addendum, GearPairDesign};
use centrode_gear::pitch::{Bspline, Circle, EccentricCircle, Ellipse, PitchSpec};
use centrode_geometry::Tolerance;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};

fn elliptic(tooth_count: u32) -> GearPairDesign {
    GearPairDesign::new(PitchSpec::Ellipse(Ellipse {
        eccentricity: 0.267_949_192_431_122_7,
        module: Some(2.25),
        tooth_count: Some(tooth_count),
        ..Ellipse::default()
    }))
}

fn transplanter() -> GearPairDesign {
    let radius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24];
    let angle = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345];
    let mut design = GearPairDesign::new(PitchSpec::Bspline(Bspline {
        degree: 2,
        radius: radius.map(f64::from).to_vec(),
        angle: angle.map(|deg| f64::from(deg).to_radians()).to_vec(),
        ..Bspline::default()
    }));
    design.tooth_count = Some(37);
    design
}

/// The 2018 pair as the peers are timed on it: generated, proved.
fn whole(c: &mut Criterion) {
    let design = elliptic(23);
    let resolve = |design: &GearPairDesign| GearPair::resolve(design).expect("a pair");
    let mut group = c.benchmark_group("pair/2018");
    group.bench_function("generate", |b| b.iter(|| resolve(black_box(&design))));
    let pair = resolve(&design);
    group.bench_function("prove", |b| b.iter(|| Contact::analyse(black_box(&pair))));
    group.bench_function("generate and prove", |b| {
        b.iter(|| Contact::analyse(&resolve(black_box(&design))));
    });
    let contact = Contact::analyse(&pair);
    group.bench_function("findings and limits", |b| {
        b.iter(|| check_contact(black_box(&pair), &contact));
    });
    group.bench_function("all", |b| {
        b.iter(|| check(&resolve(black_box(&design))));
    });
    group.finish();

    let mut group = c.benchmark_group("pair/2021");
    let full = transplanter();
    let mut fitted = transplanter();
    fitted.teeth.addendum = Addendum::Fitted;
    group.sample_size(20);
    group.bench_function("full addenda", |b| b.iter(|| resolve(black_box(&full))));
    group.bench_function("fitted addenda", |b| b.iter(|| resolve(black_box(&fitted))));
    group.finish();
}

/// Circle of 3:2, and a circle of half its radius off its centre.
fn circular(tooth_count: u32) -> GearPairDesign {
    let mut design = GearPairDesign::new(PitchSpec::Circle(Circle {
        module: Some(2.0),
        tooth_count: Some(tooth_count),
        ..Circle::default()
    }));
    design.mean_ratio = [3, 2];
    design
}

fn eccentric(tooth_count: u32) -> GearPairDesign {
    GearPairDesign::new(PitchSpec::EccentricCircle(EccentricCircle {
        eccentricity: 0.5,
        module: Some(2.0),
        tooth_count: Some(tooth_count),
        ..EccentricCircle::default()
    }))
}

/// A design by its driver's tooth count.
type Make = fn(u32) -> GearPairDesign;

fn against_tooth_count(c: &mut Criterion) {
    let mut group = c.benchmark_group("pair/tooth count");
    // Seventeen teeth are undercut: contact is looked for at twelve times as many inputs.
    let kinds: [(&str, Make, &[u32]); 3] = [
        ("ellipse", elliptic, &[17, 23, 30, 100, 300, 1000, 3000]),
        ("circle 3:2", circular, &[30, 100, 300, 1000, 3000]),
        ("eccentric circle", eccentric, &[30, 100, 300, 1000, 3000]),
    ];
    for (kind, make, sizes) in kinds {
        for &z in sizes {
            let design = make(z);
            group.throughput(Throughput::Elements(u64::from(2 * z)));
            group.sample_size(if z < 1000 { 50 } else { 10 });
            let generate = BenchmarkId::new(format!("{kind}/generate"), z);
            group.bench_with_input(generate, &design, |b, design| {
                b.iter(|| GearPair::resolve(design).expect("a pair"));
            });
            let pair = GearPair::resolve(&design).expect("a pair");
            let prove = BenchmarkId::new(format!("{kind}/prove"), z);
            group.bench_with_input(prove, &pair, |b, pair| b.iter(|| Contact::analyse(pair)));
        }
    }
    group.finish();
}

fn against_tolerance(c: &mut Criterion) {
    let pair = GearPair::resolve(&elliptic(23)).expect("a pair");
    let outline = pair.driver().outline();
    let mut group = c.benchmark_group("pair/tolerance");
    group.sample_size(20);
    for exponent in [1, 2, 3, 4] {
        let tolerance = Tolerance::new(10_f64.powi(-exponent)).expect("positive");
        let id = |what| BenchmarkId::new(what, format!("1e-{exponent}"));
        group.bench_function(id("arcs"), |b| b.iter(|| outline.arcs(tolerance)));
        group.bench_function(id("points"), |b| b.iter(|| outline.flatten(tolerance)));
    }
    group.finish();
}

criterion_group!(benches, whole, against_tooth_count, against_tolerance);
