//! Single curves: segments of three kinds, bounds on them, and where two of them cross.
//!
//! Reading order: [`closed_curve`] (the trait of an exact curve), [`poly_segment`] (its polynomial fit), [`segment`] (line, arc
//! or polynomial), [`bounds`] (a rectangle), [`span`] (a part with proven bounds), [`piece`] (bounds of its arc length),
//! [`crossings`], [`winding`]; [`bezier_fit`] is the fit of curves in space.
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
