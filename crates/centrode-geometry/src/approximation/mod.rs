//! Outlines as other curves, each within a tolerance: polygons, arcs, cubics and offsets.
//!
//! Reading order: [`steps`] (longest chords within a tolerance), [`untangle`] and [`flatten`] give polygons; [`smooth_run`]
//! (an outline between its corners), [`biarc`], [`arc_plan`], [`arc_chains`] and [`arcs`] give arcs, [`polygon_arcs`] the arcs of
//! a polygon; [`cubics`] and [`offset`] do not depend on these. Uses `numeric`, `curve` and `region`.

mod arc_chains;
mod arc_plan;
mod arcs;
mod biarc;
mod cubics;
mod flatten;
mod offset;
mod polygon_arcs;
mod smooth_run;
mod steps;
mod untangle;

pub use flatten::Sample;
