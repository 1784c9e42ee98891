//! From an edited design file to what the page draws: mechanism, picture, curves, checks, JSON.

use std::hint::black_box;
use std::path::PathBuf;

use centrode_analysis::check_mechanism;
use centrode_export::three_arm::Teeth;
use centrode_export::{gear_pair, three_arm};
use centrode_geometry::Tolerance;
use centrode_mechanism::design::DesignFile;
use centrode_mechanism::mechanism::Mechanism;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};

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

fn solved(text: &[u8]) -> Mechanism {
    let file = DesignFile::read(text).expect("a design");
    file.mechanism().expect("a mechanism")
}

/// What the page draws at once, as JSON, at the tolerance at which it is drawn.
fn drawn(mechanism: &Mechanism) -> String {
    let tolerance = |mm: f64| Tolerance::new(mm).expect("positive");
    let (picture, curves) = match mechanism {
        Mechanism::GearPair(pair) => (
            gear_pair::picture(pair, tolerance(2e-3 * pair.module())),
            gear_pair::curves(pair),
        ),
        Mechanism::ThreeArm(arms) => {
            let tolerance = tolerance(1e-4 * arms.center_distance());
            let picture = three_arm::picture(arms, Teeth::Plain, tolerance);
            (picture, three_arm::curves(arms))
        }
        Mechanism::SpiralShaft(_) | Mechanism::MovingBox(_) | Mechanism::Feeder(_) => {
            unreachable!("not among DESIGNS")
        }
    };
    serde_json::to_string(&(picture, curves)).expect("JSON")
}

fn edit_to_picture(c: &mut Criterion) {
    let mut group = c.benchmark_group("page");
    group.sample_size(20);
    for name in DESIGNS {
        let text = read(name);
        group.bench_with_input(BenchmarkId::new("picture", name), &text, |b, text| {
            b.iter(|| drawn(&solved(black_box(text))));
        });
        let both = BenchmarkId::new("picture and checks", name);
        group.bench_with_input(both, &text, |b, text| {
            b.iter(|| {
                let mechanism = solved(black_box(text));
                let report = serde_json::to_string(&check_mechanism(&mechanism)).expect("JSON");
                (drawn(&mechanism), report)
            });
        });
        let mechanism = solved(&text);
        group.bench_with_input(BenchmarkId::new("drawing", name), &mechanism, |b, m| {
            b.iter(|| drawn(black_box(m)));
        });
    }
    group.finish();
}

criterion_group!(page, edit_to_picture);
criterion_main!(page);
