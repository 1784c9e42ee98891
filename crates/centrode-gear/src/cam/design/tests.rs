use super::{CamSpec, Follower, MotionSpec, SwingingRoller, Turn};

const FILE: &str = r#"
name = "drop"
base_radius = 25.0
rotation = "clockwise"

[follower]
kind = "swinging-roller"
roller_radius = 6.0
center_distance = 60.0
arm_length = 50.0
lifts = "clockwise"

[motion]
start_deg = 15.0

[[motion.segments]]
kind = "rise"
span_deg = 150.0
swing_deg = 12.0
law = { kind = "modified-sine" }

[[motion.segments]]
kind = "dwell"
span_deg = 100.0

[[motion.segments]]
kind = "return"
span_deg = 110.0
swing_deg = 12.0

[body]
bore = 12.0
"#;

fn read(text: &str) -> Result<CamSpec, toml::de::Error> {
    toml::from_str(text)
}

#[test]
fn a_file_reads_writes_and_reads_again() {
    let spec = read(FILE).expect("reads");
    spec.validate().expect("sound");
    assert_eq!(spec.motion.swings(), Some(true));
    assert!((spec.motion.segments[0].span() - 150.0_f64.to_radians()).abs() < 1e-15);
    let again = read(&toml::to_string(&spec).expect("writes")).expect("reads");
    assert_eq!(again, spec);
    let schema = schemars::schema_for!(CamSpec).to_value();
    assert!(schema.to_string().contains("modified-trapezoid"));
}

#[test]
fn what_breaks_a_rule_names_its_key() {
    for (from, to, key) in [
        ("\"drop\"", "\"../drop\"", "name"),
        ("base_radius = 25.0", "base_radius = 0.0", "base_radius"),
        ("radius = 6.0", "radius = -6.0", "follower.roller_radius"),
        (
            "arm_length = 50.0",
            "arm_length = nan",
            "follower.arm_length",
        ),
        (
            "span_deg = 100.0",
            "span_deg = 0.0",
            "motion.segments.1.span_deg",
        ),
        ("swing_deg = 12.0\nlaw", "law", "motion.segments.0.lift"),
        (
            "swing_deg = 12.0\nlaw",
            "lift = 3.0\nlaw",
            "motion.segments.0.lift",
        ),
        (
            "swing_deg = 12.0\nlaw",
            "swing_deg = 12.0\nlift = 3.0\nlaw",
            "motion.segments.0.swing_deg",
        ),
        (
            "swing_deg = 12.0\nlaw",
            "swing_deg = -12.0\nlaw",
            "motion.segments.0.swing_deg",
        ),
        (
            "{ kind = \"modified-sine\" }",
            "{ kind = \"polynomial\", end = [inf] }",
            "motion.segments.0.law.end",
        ),
        ("bore = 12.0", "bore = -1.0", "body.bore"),
    ] {
        assert!(FILE.contains(from), "{from}");
        let spec = read(&FILE.replacen(from, to, 1)).expect("reads");
        assert_eq!(spec.validate().expect_err(to).key, key);
    }
    for (from, to) in [
        ("lifts =", "lift ="),
        ("\"modified-sine\"", "\"modified-cosine\""),
        ("\"dwell\"", "\"rest\""),
        ("span_deg = 100.0", "span_deg = 100.0\nlift = 1.0"),
    ] {
        assert!(read(&FILE.replacen(from, to, 1)).is_err(), "{to}");
    }
}

#[test]
fn strokes_must_be_what_the_follower_makes() {
    let mut spec = read(FILE).expect("reads");
    spec.follower = Follower::TranslatingRoller(super::TranslatingRoller::default());
    assert_eq!(
        spec.validate().expect_err("angles on a slide").key,
        "motion"
    );
    let still = MotionSpec {
        start: 0.0,
        segments: vec![super::SegmentSpec::Dwell(super::Dwell {
            span: std::f64::consts::TAU,
        })],
    };
    let arm = SwingingRoller {
        roller_radius: 5.0,
        center_distance: 50.0,
        arm_length: 40.0,
        lifts: Turn::Clockwise,
    };
    CamSpec::new(20.0, Follower::SwingingRoller(arm), still)
        .validate()
        .expect("a cam may do nothing");
}
