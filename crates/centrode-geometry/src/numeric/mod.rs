//! Numbers without geometry: roots, extremes, quadrature, series and tolerances, and the two helpers of every long computation.
//!
//! Reading order: [`tolerance`], [`precision`] (when two values are equal), [`roots`], [`extreme`] (minima and maxima over an
//! interval), [`quadrature`], [`chebyshev`], [`antiderivative`]; then [`cancel`] (stop a computation, run jobs on two threads)
//! and [`recent`] (cache results). Uses no other module.

mod antiderivative;
mod cancel;
mod chebyshev;
mod extreme;
mod precision;
mod quadrature;
mod recent;
mod roots;
mod tolerance;

pub use antiderivative::Antiderivative;
pub use cancel::{
    Cancel, Cancelled, Scope, checkpoint, parallel_map, run_both, stay_on_one_thread,
};
pub use chebyshev::{CHEBYSHEV_TERMS, chebyshev_roots, chebyshev_series};
pub use extreme::{
    Extreme, SampledPiece, extremes, maxima, maximum, maximum_of_each, maximum_of_samples, minimum,
    piece_ends,
};
pub use precision::{COMPUTED, WRITTEN, rounding};
pub(crate) use precision::{ITERATED, POSITION};
pub(crate) use quadrature::GAUSS_NODES;
pub use quadrature::gauss_legendre;
pub use recent::Recent;
pub use roots::{bracketed_minimum, bracketed_minimum_below, bracketed_newton, bracketed_root};
pub use tolerance::{BadTolerance, Tolerance};
