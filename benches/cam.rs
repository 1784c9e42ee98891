//! Cost of a disc cam: joining its motion, fitting its profile at a tolerance, looking for its limits.

use std::hint::black_box;

use centrode_gear::cam::DiscCam;
use centrode_gear::cam::design::{
    CamSpec, Dwell, Follower, MotionSpec, SegmentSpec, SwingingRoller, TranslatingFlat,
    TranslatingRoller, Travel, Turn,
};
use centrode_gear::cam::law::LawSpec;
use centrode_geometry::Tolerance;
use criterion::{BenchmarkId, Criterion, criterion_group};

fn motion(stroke: f64, swings: bool) -> MotionSpec {
    let travel = |degrees: f64, law: LawSpec| Travel {
        span: degrees.to_radians(),
        lift: (!swings).then_some(stroke),
        swing: swings.then_some(stroke),
        law,
    };
    let dwell = |degrees: f64| {
        SegmentSpec::Dwell(Dwell {
            span: degrees.to_radians(),
        })
    };
    MotionSpec {
        start: 0.3,
        segments: vec![
            SegmentSpec::Rise(travel(140.0, LawSpec::ModifiedSine)),
            dwell(60.0),
            SegmentSpec::Return(travel(60.0, LawSpec::Polynomial4567)),
            dwell(100.0),
        ],
    }
}

fn cams() -> [(&'static str, DiscCam); 3] {
    let slide = TranslatingRoller {
        roller_radius: 7.0,
        offset: 4.0,
    };
    let arm = SwingingRoller {
        roller_radius: 6.0,
        center_distance: 70.0,
        arm_length: 60.0,
        lifts: Turn::CounterClockwise,
    };
    [
        ("slide", Follower::TranslatingRoller(slide), 9.0, 40.0),
        ("arm", Follower::SwingingRoller(arm), 0.15, 40.0),
        (
            "flat",
            Follower::TranslatingFlat(TranslatingFlat {}),
            5.0,
            60.0,
        ),
    ]
    .map(|(name, follower, stroke, base)| {
        let motion = motion(stroke, follower.swings());
        let spec = CamSpec::new(base, follower, motion);
        (name, DiscCam::resolve(&spec).expect("a sound cam"))
    })
}

fn bench(c: &mut Criterion) {
    let cams = cams();
    let mut group = c.benchmark_group("cam/contact");
    for (name, cam) in &cams {
        group.bench_function(*name, |b| b.iter(|| cam.contact(black_box(1.3))));
    }
    group.finish();
    let mut group = c.benchmark_group("cam/profile");
    for (name, cam) in &cams {
        for exponent in [4, 7, 10] {
            let tolerance = Tolerance::new(10_f64.powi(-exponent)).expect("positive");
            let id = BenchmarkId::new(*name, format!("1e-{exponent}"));
            group.bench_function(id, |b| b.iter(|| cam.profile(tolerance)));
        }
    }
    group.finish();
    let mut group = c.benchmark_group("cam/limits");
    for (name, cam) in &cams {
        group.bench_function(*name, |b| b.iter(|| cam.limits()));
    }
    group.finish();
    let mut group = c.benchmark_group("cam/least-base-radius");
    group.sample_size(10);
    let (name, cam) = &cams[0];
    group.bench_function(*name, |b| {
        b.iter(|| cam.minimum_base_radius(black_box(0.4), std::f64::consts::FRAC_PI_2));
    });
    group.finish();
}

criterion_group!(benches, bench);
