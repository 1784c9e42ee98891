//! Approximations of outlines, each within a tolerance: polygons, arcs, cubics and offsets.
//!
//! Reading order:
//!
//! 1. Polygons: [`steps`] (longest chords within a tolerance), [`untangle`] and [`flatten`].
//! 2. Arcs: [`smooth_run`] (an outline between its corners), [`biarc`], [`arc_plan`], [`arc_chains`] and [`arcs`];
//!    [`polygon_arcs`] for the arcs of a polygon.
//! 3. [`cubics`] and [`offset`], which do not depend on the others; [`cutter_path`] cuts the loops off an offset.
//!
//! Uses `numeric`, `curve` and `region`.

mod arc_chains;
mod arc_plan;
mod arcs;
mod biarc;
mod cubics;
mod cutter_path;
mod flatten;
mod offset;
mod polygon_arcs;
mod smooth_run;
mod steps;
mod untangle;

pub use cutter_path::{CutterPath, UncutCorner};
pub use flatten::Sample;
