//! Minimisation of a function of several numbers under constraints: genetic algorithm, differential evolution, CMA-ES.
//!
//! A [`Problem`] gives bounds and evaluates a point. A [`Search`] improves a population generation by generation.
//!
//! Random numbers depend only on the seed and the number of the generation. All points of a generation are drawn before
//! any of them is evaluated. So a seed gives equal results on any number of cores, and a stored search continues as if
//! it had not stopped.
//!
//! The crate knows no gear and no machine.

mod cma_es;
mod differential_evolution;
mod genetic;
mod problem;
mod random;
mod search;
#[cfg(test)]
mod tests;

pub use problem::{Candidate, Evaluation, Problem};
pub use random::Random;
pub use search::{Ended, Method, Progress, Search, SearchError, Settings, minimise};
