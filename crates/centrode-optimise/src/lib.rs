//! The minimum of a function of numbers under constraints: genetic algorithm, differential evolution, CMA-ES.
//!
//! A [`Problem`] gives bounds and evaluates a point; a [`Search`] improves a population generation by generation. Randomness
//! comes from the seed and the number of the generation alone, and the points of a generation are drawn before any of them is
//! evaluated: the same seed gives the same result on any number of cores, and a stored search continues as if it had never
//! stopped. It knows no gear and no machine.

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
