//! Any text is a design or an error: no panic, no hang.
#![no_main]

use centrode_gear::design::GearPairDesign;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(design) = toml::from_str::<GearPairDesign>(text) {
        let _ = design.validate();
        let _ = design.pitch.resolve();
    }
});
