//! Disc cams.

mod disc;
mod fork;
mod laws;
mod parts;

pub(crate) use disc::DiscCam;
pub(crate) use fork::Fork;
pub(crate) use laws::{Law, law, law_of_polynomial};
pub(crate) use parts::{
    Follower, Segment, dwell, return_, rise, swinging_flat, swinging_roller, transition,
    translating_flat, translating_roller,
};

use centrode_mechanism::cam::design::Turn;
use centrode_mechanism::transmission::MotionJet;
use pyo3::prelude::PyResult;

use crate::error::unknown_word;

const TURNS: [&str; 2] = ["counter-clockwise", "clockwise"];

fn turn(key: &str, word: &str) -> PyResult<Turn> {
    match word {
        "counter-clockwise" => Ok(Turn::CounterClockwise),
        "clockwise" => Ok(Turn::Clockwise),
        _ => Err(unknown_word(key, word, &TURNS)),
    }
}

fn word(turn: Turn) -> &'static str {
    match turn {
        Turn::CounterClockwise => TURNS[0],
        Turn::Clockwise => TURNS[1],
    }
}

fn row(jet: &MotionJet) -> [f64; 4] {
    [jet.position, jet.velocity, jet.acceleration, jet.jerk]
}
