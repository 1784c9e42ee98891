//! Materials and tolerance classes of parts of which the design says nothing.

use centrode_kinematics::machine::Stock;

/// Material of what carries load.
pub const STEEL: Stock<'_> = Stock::new("steel", 7850.0);
/// Material of carrier and housings.
pub const LIGHT: Stock<'_> = Stock::new("aluminium alloy", 2700.0);
/// Material of the clamps.
pub const SPRING: Stock<'_> = Stock::new("spring steel", STEEL.density);
/// Tolerance classes, ISO 286, of pins that are pressed in, hole and pin, ISO 8734.
pub const PRESSED: [&str; 2] = ["H7", "m6"];
/// Of what slides in a slot or a square bore.
pub const SLIDING: [&str; 2] = ["H9", "e9"];
/// Of the rim of a roller, by which a cam moves it.
pub const RIM: &str = "h7";
/// Of the hole of a roller on a pin that is pressed into another part.
pub const ROLLING: &str = "E9";
/// Of that of a fork on such a pin.
pub const SWINGING: &str = "E8";
/// Of ball bearings: their outer ring pressed in a plate that holds it along the shaft, their inner ring, round which the load goes,
/// on the shaft.
pub const BEARING: [&str; 2] = ["N7", "k6"];
/// Tolerances of the rings of bearings themselves: class normal.
pub const RINGS: &str = "ISO 492";
