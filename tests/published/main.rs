//! Published figures, recomputed to 25 digits by the oracle.

mod data;
mod pitch;
mod teeth;
