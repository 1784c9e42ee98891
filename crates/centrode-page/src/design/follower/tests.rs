use super::super::edit::{Edit, edited};
use super::*;

/// A cam with a lever, and one with a slide past its axis.
const LEVER: &str = r#"
    family = "machine"
    name = "lever"
    [input]
    speed_rpm = 60
    [frame.points]
    O = [0, 0]
    P = [60, 0]
    [bodies.shaft]
    on = "frame.O"
    law = { ratio = 1 }
    [bodies.lever]
    on = "frame.P"
    law = { follows = "disc" }
    [cams.disc]
    on = "shaft"
    base_radius = 30
    follower = { kind = "swinging-roller", roller_radius = 6, arm_length = 45 }
    [[cams.disc.motion.segments]]
    kind = "rise"
    span_deg = 120
    swing_deg = 10
    law = { kind = "cycloidal" }
    [[cams.disc.motion.segments]]
    kind = "return"
    span_deg = 120
    swing_deg = 10
    law = { kind = "cycloidal" }
    [[cams.disc.motion.segments]]
    kind = "dwell"
    span_deg = 120
"#;

const SLIDE: &str = r#"
    family = "machine"
    name = "slide"
    [input]
    speed_rpm = 60
    [frame.points]
    O = [0, 0]
    [bodies.shaft]
    on = "frame.O"
    law = { ratio = 1 }
    [bodies.rod]
    on = "frame.O"
    slides_deg = 90
    law = { follows = "disc" }
    [cams.disc]
    on = "shaft"
    base_radius = 30
    follower = { kind = "translating-roller", roller_radius = 6 }
    motion = { segments = [
        { kind = "rise", span_deg = 120, lift = 6, law = { kind = "cycloidal" } },
        { kind = "return", span_deg = 120, lift = 6, law = { kind = "cycloidal" } },
        { kind = "dwell", span_deg = 120 },
    ] }
"#;

const KINDS: [&str; 4] = [
    "translating-roller",
    "translating-flat",
    "swinging-roller",
    "swinging-flat",
];

fn changed(text: &str, kind: &str) -> String {
    edited(text, &[Edit::word("cams.disc.follower.kind", kind)]).expect("edited")
}

#[test]
fn every_kind_of_follower_becomes_every_other_and_stays_a_mechanism() {
    for text in [LEVER, SLIDE] {
        mechanism(text).expect("a mechanism");
        for first in KINDS {
            let one = changed(text, first);
            let found = mechanism(&one);
            assert!(found.is_ok(), "{first}: {found:?}\n{one}");
            for then in KINDS {
                let two = changed(&one, then);
                let found = mechanism(&two);
                assert!(found.is_ok(), "{first} {then}: {found:?}\n{two}");
                assert!(two.contains(&format!("{then:?}")), "{two}");
            }
        }
    }
}

#[test]
fn what_both_kinds_know_stays() {
    let flat = changed(LEVER, "swinging-flat");
    assert!(
        flat.contains("base_radius = 30") && !flat.contains("roller_radius"),
        "{flat}"
    );
    let slide: toml::Table = changed(LEVER, "translating-roller").parse().expect("TOML");
    let cam = &slide["cams"]["disc"];
    assert_eq!(cam["follower"]["roller_radius"].as_integer(), Some(6));
    // Ten degrees of an arm of 45 mm.
    let lift = cam["motion"]["segments"][0]["lift"].as_float();
    assert_eq!(lift, Some(7.854));
}
