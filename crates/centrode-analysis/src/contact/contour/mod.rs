//! The outline of a gear as pieces, with bounds that show quickly which pieces of two gears can touch.
//!
//! Reading order:
//!
//! 1. `near_search`: the search for near parts of two gears, by discs around groups of neighbouring parts.
//! 2. `outline`: the parts of one gear with their bounds, corners and circles.
//! 3. `pose`: position of the driven gear relative to the driver.
//! 4. `near_parts`: cached pairs of parts that are near each other in similar poses.
//! 5. `stretch`: an interval of a part in polar coordinates about the driven axis, and its halves.

mod near_parts;
mod near_search;
mod outline;
mod pose;
mod stretch;

pub(super) use near_parts::{PairCache, PoseTolerance, Reference};
pub(super) use near_search::deepest;
pub(super) use outline::{Corner, GearOutline, NormalCone, OutlinePart};
pub(super) use pose::Pose;
pub(super) use stretch::{ContourPoint, DividedStretch, PosedContour, SETTLED, Stretch};
