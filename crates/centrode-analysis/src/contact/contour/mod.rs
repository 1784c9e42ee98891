//! The outline of a gear as pieces, with bounds that show quickly which pieces of two gears can touch.
//!
//! Read it in this order:
//!
//! 1. `circle_tree`: circles around groups of neighbouring parts, and the search for near parts of two gears.
//! 2. `outline`: the parts of one gear with their bounds, corners and circles.
//! 3. `pose`: position of the driven gear relative to the driver.
//! 4. `near_parts`: cached pairs of parts that are near each other in similar poses.
//! 5. `stretch`: an interval of a part in polar view from the driven axis, and its halves.

mod circle_tree;
mod near_parts;
mod outline;
mod pose;
mod stretch;

pub(super) use circle_tree::PartGroup;
pub(super) use near_parts::{PairCache, PoseTolerance, Reference};
pub(super) use outline::{Corner, GearOutline, NormalCone, OutlinePart};
pub(super) use pose::Pose;
pub(super) use stretch::{ContourPoint, DividedStretch, PosedContour, SETTLED, Stretch};
