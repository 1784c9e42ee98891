//! Conversion of angles: degrees in the file, radians in the program.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Degrees that read back as the given radians, the round number where there is one.
pub(crate) fn written(radians: f64) -> f64 {
    let degrees = radians.to_degrees();
    let round = (degrees * 1e11).round() / 1e11;
    if round.to_radians() == radians {
        round
    } else {
        degrees
    }
}

/// Degrees without the last digits that the way through radians has cost: for messages and limits.
pub(crate) fn rounded(radians: f64) -> f64 {
    (radians.to_degrees() * 1e9).round() / 1e9
}

pub(crate) fn serialize<S: Serializer>(radians: &f64, s: S) -> Result<S::Ok, S::Error> {
    s.serialize_f64(written(*radians))
}

pub(crate) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<f64, D::Error> {
    f64::deserialize(d).map(f64::to_radians)
}

/// A list of angles, degrees in the file.
pub(crate) mod list {
    use super::{Deserialize, Deserializer, Serialize, Serializer, written};

    pub(crate) fn serialize<S: Serializer>(radians: &[f64], s: S) -> Result<S::Ok, S::Error> {
        let degrees: Vec<f64> = radians.iter().map(|&r| written(r)).collect();
        degrees.serialize(s)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Vec<f64>, D::Error> {
        let degrees = Vec::<f64>::deserialize(d)?;
        Ok(degrees.into_iter().map(f64::to_radians).collect())
    }
}

/// An angle that may be absent, degrees in the file.
pub(crate) mod option {
    use super::{Deserialize, Deserializer, Serialize, Serializer, written};

    #[allow(clippy::ref_option, reason = "the signature serde calls")]
    pub(crate) fn serialize<S: Serializer>(r: &Option<f64>, s: S) -> Result<S::Ok, S::Error> {
        r.map(written).serialize(s)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Option<f64>, D::Error> {
        Ok(Option::<f64>::deserialize(d)?.map(f64::to_radians))
    }
}

/// Both ends of a range of angles that may be absent, degrees in the file.
pub(crate) mod arc {
    use super::{Deserialize, Deserializer, Serialize, Serializer, written};

    #[allow(clippy::ref_option, reason = "the signature serde calls")]
    pub(crate) fn serialize<S: Serializer>(r: &Option<[f64; 2]>, s: S) -> Result<S::Ok, S::Error> {
        r.map(|ends| ends.map(written)).serialize(s)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        d: D,
    ) -> Result<Option<[f64; 2]>, D::Error> {
        let ends = Option::<[f64; 2]>::deserialize(d)?;
        Ok(ends.map(|ends| ends.map(f64::to_radians)))
    }
}

/// Both ends of a range of angles, degrees in the file.
pub(crate) mod range {
    use super::{Deserialize, Deserializer, Serialize, Serializer, written};

    pub(crate) fn serialize<S: Serializer>(radians: &[f64; 2], s: S) -> Result<S::Ok, S::Error> {
        radians.map(written).serialize(s)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<[f64; 2], D::Error> {
        Ok(<[f64; 2]>::deserialize(d)?.map(f64::to_radians))
    }
}
