//! Published figures, recomputed to 25 digits by the oracle.

mod all_goals;
mod composed_trains;
mod data;
mod feeder;
mod machine;
mod pitch;
mod shaft;
mod shifted;
mod strong_laws;
mod teeth;
mod three_arm;
