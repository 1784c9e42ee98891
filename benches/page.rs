//! From an edited design file to what the page draws: mechanism, picture, curves, checks, JSON.

use std::hint::black_box;
use std::path::PathBuf;
use std::sync::Arc;

use centrode::FAMILIES;
use centrode::family::Mechanism;
use criterion::{BenchmarkId, Criterion, criterion_group};

/// Designs from the lightest to the heaviest of those shipped.
const DESIGNS: [&str; 4] = [
    "elliptic-pair-2018",
    "lobed-pair-5-2",
    "transplanter-pair-2021",
    "three-arm-2021",
];

fn read(name: &str) -> Vec<u8> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/designs");
    std::fs::read(folder.join(format!("{name}.toml"))).expect("checked in")
}

fn solved(text: &[u8]) -> Arc<dyn Mechanism> {
    let file = FAMILIES.read(text).expect("a design");
    file.mechanism().expect("a mechanism")
}

/// What the page draws at once, as JSON, at the tolerance at which it is drawn.
fn drawn(mechanism: &dyn Mechanism) -> String {
    serde_json::to_string(&(mechanism.picture(), mechanism.curves())).expect("JSON")
}

fn edit_to_picture(c: &mut Criterion) {
    let mut group = c.benchmark_group("page");
    group.sample_size(20);
    for name in DESIGNS {
        let text = read(name);
        group.bench_with_input(BenchmarkId::new("picture", name), &text, |b, text| {
            b.iter(|| drawn(solved(black_box(text)).as_ref()));
        });
        let both = BenchmarkId::new("picture and checks", name);
        group.bench_with_input(both, &text, |b, text| {
            b.iter(|| {
                let mechanism = solved(black_box(text));
                let report = serde_json::to_string(&mechanism.check()).expect("JSON");
                (drawn(mechanism.as_ref()), report)
            });
        });
        let mechanism = solved(&text);
        group.bench_with_input(BenchmarkId::new("drawing", name), &mechanism, |b, m| {
            b.iter(|| drawn(black_box(m.as_ref())));
        });
    }
    group.finish();
}

criterion_group!(benches, edit_to_picture);
