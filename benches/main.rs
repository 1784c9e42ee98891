//! Every benchmark, in one program: `cargo bench -p centrode-benches -- three-arm` runs those whose name has the word.

use criterion::criterion_main;

mod cam;
mod geometry;
mod interference;
mod linkage;
mod page;
mod pair;
mod pitch;
mod reverse;
mod shaft;
mod sweep;
mod three_arm;

criterion_main!(
    cam::benches,
    geometry::benches,
    interference::benches,
    linkage::benches,
    page::benches,
    pair::benches,
    pitch::benches,
    reverse::benches,
    shaft::benches,
    sweep::benches,
    three_arm::benches,
);
