use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_spec::SpecError;
use centrode_spec::rule::{finite, not_negative, positive};

/// Sense of rotation.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Turn {
    /// Counter-clockwise, the positive sense.
    #[default]
    CounterClockwise,
    /// Clockwise, the negative sense.
    Clockwise,
}

impl Turn {
    /// Sign: 1 counter-clockwise, -1 clockwise.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::CounterClockwise => 1.0,
            Self::Clockwise => -1.0,
        }
    }

    /// Opposite sense.
    #[must_use]
    pub fn opposite(self) -> Self {
        match self {
            Self::CounterClockwise => Self::Clockwise,
            Self::Clockwise => Self::CounterClockwise,
        }
    }
}

/// Follower of a cam and its guidance, by the key `kind`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Follower {
    /// A roller, or a point, on a slide.
    TranslatingRoller(TranslatingRoller),
    /// A flat face square to its slide.
    TranslatingFlat(TranslatingFlat),
    /// A roller, or a point, on a swinging arm.
    SwingingRoller(SwingingRoller),
    /// A flat face on a swinging arm.
    SwingingFlat(SwingingFlat),
}

/// A roller on a slide.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TranslatingRoller {
    /// Radius of the roller, mm; 0 for a point.
    pub roller_radius: f64,
    /// Distance of the slide from the cam's axis, mm: positive to the left of the outward direction.
    #[serde(default)]
    pub offset: f64,
}

/// A flat face square to its slide.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct TranslatingFlat {}

/// A roller on a swinging arm.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SwingingRoller {
    /// Radius of the roller, mm; 0 for a point.
    pub roller_radius: f64,
    /// Distance of the arm's pivot from the cam's axis, mm.
    pub center_distance: f64,
    /// Distance of the roller's centre from the pivot, mm.
    pub arm_length: f64,
    /// Sense in which the arm turns when the cam lifts it.
    #[serde(default)]
    pub lifts: Turn,
}

/// A flat face on a swinging arm.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct SwingingFlat {
    /// Distance of the arm's pivot from the cam's axis, mm.
    pub center_distance: f64,
    /// Distance of the face before the pivot, towards the cam, mm; may be negative.
    #[serde(default)]
    pub face_offset: f64,
    /// Sense in which the arm turns when the cam lifts it.
    #[serde(default)]
    pub lifts: Turn,
}

impl Follower {
    /// Distance of the follower's line of travel or pivot from the cam's axis, mm.
    #[must_use]
    pub fn axis_distance(&self) -> f64 {
        match self {
            Self::TranslatingRoller(follower) => follower.offset,
            Self::TranslatingFlat(_) => 0.0,
            Self::SwingingRoller(follower) => follower.center_distance,
            Self::SwingingFlat(follower) => follower.center_distance,
        }
    }

    /// Whether the follower's motion is an angle.
    #[must_use]
    pub fn swings(&self) -> bool {
        matches!(self, Self::SwingingRoller(_) | Self::SwingingFlat(_))
    }

    /// Radius of the roller, mm; `None` for a flat face.
    #[must_use]
    pub fn roller_radius(&self) -> Option<f64> {
        match self {
            Self::TranslatingRoller(follower) => Some(follower.roller_radius),
            Self::SwingingRoller(follower) => Some(follower.roller_radius),
            Self::TranslatingFlat(_) | Self::SwingingFlat(_) => None,
        }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        if let Some(radius) = self.roller_radius() {
            not_negative("roller_radius", radius)?;
        }
        match self {
            Self::TranslatingRoller(follower) => finite("offset", follower.offset),
            Self::TranslatingFlat(_) => Ok(()),
            Self::SwingingRoller(follower) => {
                positive("center_distance", follower.center_distance)?;
                positive("arm_length", follower.arm_length)
            }
            Self::SwingingFlat(follower) => {
                positive("center_distance", follower.center_distance)?;
                finite("face_offset", follower.face_offset)
            }
        }
    }
}
