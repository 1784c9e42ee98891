//! From an edited design file to what the page draws: mechanism, picture, curves, checks, JSON.

use std::hint::black_box;
use std::path::PathBuf;

use centrode_analysis::check;
use centrode_export::gear_pair::{curves, picture};
use centrode_geometry::Tolerance;
use centrode_mechanism::design::DesignFile;
use centrode_mechanism::gear::GearPair;
use centrode_mechanism::mechanism::Mechanism;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

/// Designs from the lightest to the heaviest of those shipped.
const DESIGNS: [&str; 3] = [
    "elliptic-pair-2018",
    "lobed-pair-5-2",
    "transplanter-pair-2021",
];

fn read(name: &str) -> Vec<u8> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/designs");
    std::fs::read(folder.join(format!("{name}.toml"))).expect("checked in")
}

fn solved(text: &[u8]) -> GearPair {
    let file = DesignFile::read(text).expect("a design");
    match file.mechanism().expect("a mechanism") {
        Mechanism::GearPair(pair) => *pair,
        Mechanism::ThreeArm(_) => panic!("not a gear pair"),
    }
}

/// What the page draws, as JSON, at the tolerance at which it is drawn.
fn drawn(pair: &GearPair) -> String {
    let tolerance = Tolerance::new(2e-3 * pair.module()).expect("positive");
    serde_json::to_string(&(picture(pair, tolerance), curves(pair))).expect("JSON")
}

fn edit_to_picture(c: &mut Criterion) {
    let mut group = c.benchmark_group("page");
    group.sample_size(20);
    for name in DESIGNS {
        let text = read(name);
        group.bench_with_input(BenchmarkId::new("picture", name), &text, |b, text| {
            b.iter(|| drawn(&solved(black_box(text))));
        });
        group.bench_with_input(
            BenchmarkId::new("picture and checks", name),
            &text,
            |b, text| {
                b.iter(|| {
                    let pair = solved(black_box(text));
                    let report = serde_json::to_string(&check(&pair)).expect("JSON");
                    (drawn(&pair), report)
                });
            },
        );
        let pair = solved(&text);
        group.bench_with_input(BenchmarkId::new("drawing alone", name), &pair, |b, pair| {
            b.iter(|| drawn(black_box(pair)));
        });
    }
    group.finish();
}

criterion_group!(page, edit_to_picture);
criterion_main!(page);
