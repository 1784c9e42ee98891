//! Cost of one variant of a sweep: a gear pair with another number, to the depth of its motion and of its teeth.

use std::hint::black_box;

use centrode::FAMILIES;
use centrode::family::Depth;
use criterion::{BenchmarkId, Criterion, criterion_group};

/// Pitch curve, the key that is swept, and its value.
const CURVES: [(&str, &str, f64, &str); 5] = [
    (
        "ellipse",
        "pitch.eccentricity",
        0.31,
        "kind = \"ellipse\"\neccentricity = 0.3\nmodule = 2\ntooth_count = 31",
    ),
    (
        "limacon",
        "pitch.amplitude",
        9.0,
        "kind = \"limacon\"\nmean_radius = 30\namplitude = 8\ntooth_count = 31",
    ),
    (
        "polar",
        "pitch.module",
        2.1,
        "kind = \"polar\"\nexpression = \"1 + 0.2*cos(phi) + 0.05*sin(2*phi)\"\nmodule = 2\ntooth_count = 31",
    ),
    (
        "B-spline, cubic",
        "pitch.radius[0]",
        41.0,
        "kind = \"bspline\"\ndegree = 3\nradius = [40, 42, 45, 50, 55, 50, 45, 42]\nangle_deg = [0, 45, 90, 135, 180, 225, 270, 315]\ntooth_count = 37",
    ),
    (
        "B-spline, concave",
        "pitch.radius[0]",
        22.0,
        "kind = \"bspline\"\ndegree = 2\nradius = [21, 28, 50, 49, 58, 47, 18, 12, 28, 60, 48, 24]\nangle_deg = [20, 45, 76, 105, 132, 165, 195, 225, 255, 285, 316, 345]\ntooth_count = 37",
    ),
];

fn variants(c: &mut Criterion) {
    let mut group = c.benchmark_group("sweep");
    group.sample_size(20);
    for (curve, key, value, pitch) in CURVES {
        let text = format!("family = \"gear-pair\"\n[pitch]\n{pitch}\n");
        let file = FAMILIES.read(text.as_bytes()).expect("a design");
        let numbered = file.design().numbered(&[key]).expect("a number");
        for depth in [Depth::Motion, Depth::Made] {
            group.bench_function(BenchmarkId::new(depth.name(), curve), |b| {
                b.iter(|| {
                    let design = numbered.with(black_box(&[value])).expect("a design");
                    file.family().report(&*design, depth).expect("a report")
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, variants);
