//! Angles: degrees in the file, radians in the program. Mark such a field with `#[serde(with = "degrees")]`.

use serde::de::DeserializeOwned;
use serde::{Deserializer, Serialize, Serializer};

/// Degrees that convert back to exactly these radians: a round number if there is one.
#[must_use]
pub fn written(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let round = (degrees * 1e11).round() / 1e11;
    if round.to_radians() == radians {
        round
    } else {
        degrees
    }
}

/// Degrees without the last digits, which the conversion to radians and back has changed: for messages and limits.
#[must_use]
pub fn rounded(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}

/// One angle, or several in a list or an option.
pub trait Angles: DeserializeOwned + Serialize {
    /// Converts each angle.
    #[must_use]
    fn converted(&self, convert: fn(f64) -> f64) -> Self;
}

impl Angles for f64 {
    fn converted(&self, convert: fn(f64) -> f64) -> Self {
        convert(*self)
    }
}

impl Angles for [f64; 2] {
    fn converted(&self, convert: fn(f64) -> f64) -> Self {
        self.map(convert)
    }
}

impl Angles for Vec<f64> {
    fn converted(&self, convert: fn(f64) -> f64) -> Self {
        self.iter().map(|&angle| convert(angle)).collect()
    }
}

impl<A: Angles> Angles for Option<A> {
    fn converted(&self, convert: fn(f64) -> f64) -> Self {
        self.as_ref().map(|angles| angles.converted(convert))
    }
}

/// Writes radians as degrees.
///
/// # Errors
/// Those of the serializer.
pub fn serialize<A: Angles, S: Serializer>(radians: &A, serializer: S) -> Result<S::Ok, S::Error> {
    radians.converted(written).serialize(serializer)
}

/// Reads degrees as radians.
///
/// # Errors
/// Those of the deserializer.
pub fn deserialize<'de, A: Angles, D: Deserializer<'de>>(deserializer: D) -> Result<A, D::Error> {
    A::deserialize(deserializer).map(|degrees| degrees.converted(f64::to_radians))
}
