//! Plane curves, closed outlines, solids and meshes for machine parts.
//!
//! No gear word in this crate: it knows curves, not their purpose. Lengths are millimetres,
//! angles radians, counter-clockwise positive.

mod antiderivative;
mod arc_chains;
mod arc_plan;
mod arcs;
mod bezier_fit;
mod biarc;
mod bounds;
mod cancel;
mod chain;
mod chebyshev;
mod chords;
mod containment;
mod convex;
mod crossing;
mod crossings;
mod cubics;
mod curve;
mod extreme;
mod flatten;
mod hull;
mod loops;
mod mass;
mod mesh;
mod moments;
mod offset;
mod opening;
mod outline;
mod piece;
mod placement;
mod poly_segment;
mod quadrature;
mod recent;
mod roots;
mod rounded;
#[cfg(test)]
mod shapes;
mod shell;
mod shell_builder;
mod smooth_run;
mod solid;
mod tolerance;
mod turned;
mod untangle;

pub use antiderivative::Antiderivative;
pub use bezier_fit::BezierFit;
pub use bounds::Bounds;
pub use cancel::{Cancel, Cancelled, Scope, checkpoint, shared_out, stay_on_one_thread, together};
pub use chebyshev::{CHEBYSHEV_TERMS, chebyshev_roots, chebyshev_series};
pub use convex::{ConvexPieces, convex_hull, convex_pieces};
pub use crossing::Crossing;
pub use crossings::{Unresolved, crossings, self_crossings};
pub use curve::{Curve, Jet};
pub use extreme::{
    Extreme, SampledPiece, extremes, greatest, greatest_each, greatest_of, greatest_sampled, least,
    pieces, rounding,
};
pub use flatten::Sample;
pub use loops::{Kept, LoopError, without_loops};
pub use mass::{MassProperties, VolumeMoments};
pub use mesh::Mesh;
pub use moments::AreaMoments;
pub use opening::Opening;
pub use outline::{Arc, OpenOutline, Outline, Segment};
pub use poly_segment::{PolySegment, SegmentJet};
pub use quadrature::gauss_legendre;
pub use recent::Recent;
pub use roots::{bracketed_minimum, bracketed_minimum_below, bracketed_newton, bracketed_root};
pub use rounded::ShortSide;
pub use shell::{Shell, ShellCurve, ShellEdge, ShellFace, ShellSurface};
pub use shell_builder::{ShellBuilder, ShellSide};
pub use solid::{Solid, SolidError};
pub use tolerance::{BadTolerance, Tolerance};
pub use turned::{Turned, TurnedEnd, TurnedSection, TurnedSlot};

/// A point of the plane, mm.
pub type Point = nalgebra::Point2<f64>;
/// A displacement or direction in the plane.
pub type Vector = nalgebra::Vector2<f64>;
