//! Materials and tolerance classes of parts for which the design gives none.

use centrode_kinematics::machine::Stock;

/// Material of parts that carry load.
pub const STEEL: Stock<'_> = Stock::new("steel", 7850.0);
/// Material of carrier and housings.
pub const LIGHT: Stock<'_> = Stock::new("aluminium alloy", 2700.0);
/// Material of the clamps.
pub const SPRING: Stock<'_> = Stock::new("spring steel", STEEL.density);
/// Tolerance classes, ISO 286, of the hole and of a pin that is pressed into it, ISO 8734.
pub const PRESSED: [&str; 2] = ["H7", "m6"];
/// Tolerance classes of a slot or a square bore, and of the part that slides in it.
pub const SLIDING: [&str; 2] = ["H9", "e9"];
/// Tolerance class of the rim of a roller, on which a cam acts.
pub const RIM: &str = "h7";
/// Tolerance class of the hole of a roller on a pin that is pressed into another part.
pub const ROLLING: &str = "E9";
/// Tolerance class of the hole of a fork on such a pin.
pub const SWINGING: &str = "E8";
/// Tolerance classes of the seats of ball bearings. The outer ring is pressed into a plate that holds it along the shaft. The
/// inner ring, on the shaft, turns relative to the load.
pub const BEARING: [&str; 2] = ["N7", "k6"];
/// Tolerances of the bearing rings themselves: class normal.
pub const RINGS: &str = "ISO 492";
