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
