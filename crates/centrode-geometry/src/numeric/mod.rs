//! Numerical methods without geometry: roots, extremes, quadrature, series, tolerances, and two helpers for long
//! computations.
//!
//! Reading order:
//!
//! 1. [`tolerance`] and [`precision`] (comparison of values).
//! 2. [`roots`] and [`extreme`] (minima and maxima over an interval).
//! 3. [`quadrature`], [`chebyshev`] and [`antiderivative`].
//! 4. [`cancel`]: stop a computation, run jobs on two threads.
//! 5. [`recent`]: cache of results.
//!
//! Uses no other module.

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
