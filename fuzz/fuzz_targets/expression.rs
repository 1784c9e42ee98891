//! Any formula is a pitch curve or an error: no panic, no hang.
#![no_main]

use centrode_gear::pitch::{PitchSpec, Polar, Transmission};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let radius = PitchSpec::Polar(Polar {
        expression: Some(text.into()),
        ..Polar::default()
    });
    let law = PitchSpec::Transmission(Transmission {
        expression: Some(text.into()),
        center_distance: Some(50.0),
        ..Transmission::default()
    });
    let _ = (radius.resolve(), law.resolve());
});
