//! Single curves: three kinds of segments, bounds of them, and their crossings.
//!
//! Reading order:
//!
//! 1. [`closed_curve`]: the trait of an exact curve.
//! 2. [`poly_segment`]: its polynomial fit.
//! 3. [`segment`]: line, arc or polynomial.
//! 4. [`bounds`]: a rectangle.
//! 5. [`span`]: a part with proven bounds.
//! 6. [`piece`]: bounds of its arc length.
//! 7. [`crossings`] and [`winding`].
//! 8. [`bezier_fit`]: fit of curves in space.
//!
//! Uses `numeric`.

mod bezier_fit;
mod bounds;
mod closed_curve;
mod crossings;
mod piece;
mod poly_segment;
mod segment;
mod span;
mod winding;

pub use bezier_fit::BezierFit;
pub use bounds::Bounds;
pub use closed_curve::{Curve, Jet};
pub use crossings::CrossingError;
pub(crate) use crossings::{Meetings, Resolution, meetings, self_meetings};
pub(crate) use piece::Piece;
pub(crate) use poly_segment::NODES;
pub use poly_segment::{FittedSpan, PolySegment, SegmentJet};
pub use segment::{Arc, Segment, SegmentRange};
pub use span::{Span, SpanBounds};
pub(crate) use winding::winding;
