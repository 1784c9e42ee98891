//! What is written of a three-arm mechanism.

mod picture;

pub use picture::{Teeth, curves, picture};
