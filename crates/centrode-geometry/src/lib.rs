//! Plane curves, closed outlines, solids and meshes for machine parts.
//!
//! The crate has exact plane curves, outlines made of them, approximations of the outlines, and bodies bounded by
//! outlines.
//! There are five modules: `numeric`, `curve`, `region`, `approximation`, `solid`. Each uses only those before it.
//! This crate may know no gear, cam or machine, and reads and writes no files.
//! A [`Tolerance`] is the maximum distance between a curve and its approximation. There is no other absolute epsilon.
//! Lengths are millimetres, angles radians, counter-clockwise positive.

mod approximation;
mod curve;
mod numeric;
mod region;
mod solid;
#[cfg(test)]
mod test_shapes;

pub use approximation::{CutterPath, Sample, UncutCorner};
pub use curve::{
    Arc, BezierFit, Bounds, CrossingError, Curve, FittedSpan, Jet, PolySegment, Segment,
    SegmentJet, SegmentRange, Span, SpanBounds,
};
pub use numeric::{
    Antiderivative, BadTolerance, CHEBYSHEV_TERMS, COMPUTED, Cancel, Cancelled, Extreme, Recent,
    SampledPiece, Scope, Tolerance, WRITTEN, bracketed_minimum, bracketed_minimum_below,
    bracketed_newton, bracketed_root, chebyshev_roots, chebyshev_series, checkpoint, extremes,
    gauss_legendre, maxima, maximum, maximum_of_each, maximum_of_samples, minimum, parallel_map,
    piece_ends, rounding, run_both, stay_on_one_thread,
};
pub use region::{
    AreaMoments, BoundTree, ConvexPieces, Crossing, Disc, LoopError, OpenOutline, Outline, Run,
    ShortSide, convex_hull, convex_pieces, without_loops,
};
pub use solid::{
    MassProperties, Mesh, Opening, Shell, ShellBuilder, ShellCurve, ShellEdge, ShellFace,
    ShellSide, ShellSurface, Solid, SolidError, Turned, TurnedEnd, TurnedSection, TurnedSlot,
    VolumeMoments,
};

/// A point of the plane, mm.
pub type Point = nalgebra::Point2<f64>;
/// A displacement or direction in the plane.
pub type Vector = nalgebra::Vector2<f64>;
