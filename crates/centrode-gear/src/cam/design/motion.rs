use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::cam::law::LawSpec;
use centrode_spec::rule::{Rule, broken, finite, in_range, positive};
use centrode_spec::{SpecError, degrees};

/// Motion of a follower in one turn of the cam: segments one after the other.
///
/// Zero is the lowest level at which a segment begins: the follower is then on the base circle.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MotionSpec {
    /// Cam angle at which the first segment begins, rad (degrees in the file).
    #[serde(rename = "start_deg", with = "degrees", default)]
    #[schemars(with = "f64")]
    pub start: f64,
    /// The segments; their spans add up to a whole turn.
    #[serde(default)]
    pub segments: Vec<SegmentSpec>,
}

/// One part of a follower's motion, by the key `kind`.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum SegmentSpec {
    /// Away from the cam's axis.
    Rise(Travel),
    /// No motion.
    Dwell(Dwell),
    /// Towards the cam's axis.
    Return(Travel),
    /// Transition from one velocity and acceleration to another.
    Transition(Transition),
}

/// A rise or return by a motion law.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Travel {
    /// Cam angle it takes, rad (degrees in the file).
    #[serde(rename = "span_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub span: f64,
    /// Stroke of a sliding follower, mm, greater than 0 for a return too.
    pub lift: Option<f64>,
    /// Stroke of a swinging follower, rad (degrees in the file).
    #[serde(rename = "swing_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub swing: Option<f64>,
    /// Motion law over the span.
    pub law: LawSpec,
}

/// A rest.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Dwell {
    /// Cam angle it takes, rad (degrees in the file).
    #[serde(rename = "span_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub span: f64,
}

/// The polynomial of fifth degree between given velocities and accelerations.
///
/// Derivatives are mm/rad and mm/rad^2 of cam angle, for a swinging follower rad/rad and rad/rad^2.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Transition {
    /// Cam angle it takes, rad (degrees in the file).
    #[serde(rename = "span_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub span: f64,
    /// Change of a sliding follower's position, mm; may be zero or negative.
    pub lift: Option<f64>,
    /// Change of a swinging follower's angle, rad (degrees in the file).
    #[serde(rename = "swing_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub swing: Option<f64>,
    /// Velocity at the start.
    pub start_velocity: f64,
    /// Acceleration at the start.
    pub start_acceleration: f64,
    /// Velocity at the end.
    pub end_velocity: f64,
    /// Acceleration at the end.
    pub end_acceleration: f64,
}

impl SegmentSpec {
    /// Cam angle it takes, rad.
    #[must_use]
    pub fn span(&self) -> f64 {
        match self {
            Self::Rise(travel) | Self::Return(travel) => travel.span,
            Self::Dwell(dwell) => dwell.span,
            Self::Transition(transition) => transition.span,
        }
    }

    /// Change of position, mm or rad.
    #[must_use]
    pub fn change(&self) -> f64 {
        match self {
            Self::Rise(travel) => travel.stroke(),
            Self::Dwell(_) => 0.0,
            Self::Return(travel) => -travel.stroke(),
            Self::Transition(transition) => transition.lift.or(transition.swing).unwrap_or(0.0),
        }
    }

    /// Lift and swing as written; `None` for a dwell.
    fn strokes(&self) -> Option<(Option<f64>, Option<f64>)> {
        match self {
            Self::Rise(travel) | Self::Return(travel) => Some((travel.lift, travel.swing)),
            Self::Dwell(_) => None,
            Self::Transition(transition) => Some((transition.lift, transition.swing)),
        }
    }

    fn validate(&self) -> Result<(), SpecError> {
        let degrees = degrees::rounded(self.span());
        positive("span_deg", degrees)?;
        in_range("span_deg", degrees, [0.0, 360.0], " deg")?;
        match self.strokes() {
            None => return Ok(()),
            Some((Some(_), Some(_))) => return broken("swing_deg", Rule::Excludes("lift")),
            Some((None, None)) => return broken("lift", Rule::NeedsOneOf("lift and swing_deg")),
            Some(_) => {}
        }
        match self {
            Self::Rise(travel) | Self::Return(travel) => {
                positive(travel.stroke_key(), travel.stroke())?;
                travel.law.validate().map_err(|e| e.inside("law"))
            }
            Self::Transition(transition) => {
                for (key, value) in [
                    ("lift", self.change()),
                    ("start_velocity", transition.start_velocity),
                    ("start_acceleration", transition.start_acceleration),
                    ("end_velocity", transition.end_velocity),
                    ("end_acceleration", transition.end_acceleration),
                ] {
                    finite(key, value)?;
                }
                Ok(())
            }
            Self::Dwell(_) => Ok(()),
        }
    }
}

impl Travel {
    fn stroke(&self) -> f64 {
        self.lift.or(self.swing).unwrap_or(0.0)
    }

    fn stroke_key(&self) -> &'static str {
        if self.lift.is_some() {
            "lift"
        } else {
            "swing_deg"
        }
    }
}

impl MotionSpec {
    /// Checks the ranges, and that strokes are all lengths or all angles.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault, `segments.2.span_deg` for the third segment.
    pub fn validate(&self) -> Result<(), SpecError> {
        finite("start_deg", self.start)?;
        in_range(
            "segments",
            self.segments.len() as f64,
            [1.0, 360.0],
            " segments",
        )?;
        let swings = self.swings();
        for (index, segment) in self.segments.iter().enumerate() {
            let here = |error: SpecError| error.inside(&format!("segments.{index}"));
            segment.validate().map_err(here)?;
            match segment.strokes() {
                Some((Some(_), _)) if swings == Some(true) => {
                    return broken("lift", Rule::Excludes("swing_deg")).map_err(here);
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Whether the strokes are angles, of a swinging follower; `None` if there is no stroke.
    #[must_use]
    pub fn swings(&self) -> Option<bool> {
        let strokes = self.segments.iter().filter_map(SegmentSpec::strokes);
        strokes
            .map(|(_, swing)| swing.is_some())
            .reduce(|a, b| a || b)
    }
}
