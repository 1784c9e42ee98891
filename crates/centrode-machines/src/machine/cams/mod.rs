//! Disc cams as written in the design file.

pub(super) mod camming;
pub(super) mod cutting;
pub(super) mod seating;
pub(super) mod touching;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::hardware::plates::LAYERS;
use centrode_gear::cam::design::{
    Follower, MotionSpec, SwingingFlat, SwingingRoller, TranslatingFlat, TranslatingRoller, Turn,
};
use centrode_gear::design::BodySpec;
use centrode_spec::rule::{Rule, broken, finite, in_range, positive};
use centrode_spec::{SpecError, degrees};

/// A disc cam on a body, which others follow.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineCamSpec {
    /// Point of a body on which its axis is, `frame.O`; or the body alone for its origin.
    pub on: String,
    /// Body, or point of a body, that is fixed on the body of `on`: the axis of the cam is there, `arm` for a cam about
    /// the pin of an arm. Default: the axis is at `on`.
    pub about: Option<String>,
    /// Angle at which it is mounted, of its own axes against the body's, rad (degrees in the file): where its motion begins,
    /// its x axis points along the slide of its follower, or to the follower's pin.
    #[serde(default, rename = "mount_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub mount: f64,
    /// Radius of the base circle, mm.
    pub base_radius: f64,
    /// Sense in which it turns, seen from the follower; default: as its body turns, or counter-clockwise for one that comes
    /// back.
    pub rotation: Option<Turn>,
    /// Follower that rides on it.
    pub follower: MachineFollowerSpec,
    /// Motion of the follower by the turn of the cam against the body that carries the follower.
    pub motion: Option<MotionSpec>,
    /// Body that moves already, by its own law or by others, to whose motion the cam is cut: instead of `motion`.
    pub cut_to: Option<String>,
    /// Position along the shafts, counted in plates from the one next to the frame; default: cams lie one below the other
    /// behind the gears.
    pub layer: Option<i32>,
    /// Width, bore and material.
    #[serde(default)]
    pub body: BodySpec,
}

/// Follower of a cam on a body, by the key `kind`. The bodies define where it is mounted.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum MachineFollowerSpec {
    /// A roller, or a point, at the origin of a body that slides.
    TranslatingRoller(MachineSlidingRoller),
    /// A flat face at the origin of a body that slides, square to its slide.
    TranslatingFlat(TranslatingFlat),
    /// A roller, or a point, on the x axis of a body that turns.
    SwingingRoller(MachineSwingingRoller),
    /// A flat face along the x axis of a body that turns.
    SwingingFlat(MachineSwingingFlat),
}

/// A roller on a body that slides.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineSlidingRoller {
    /// Radius of the roller, mm; 0 for a point.
    pub roller_radius: f64,
    /// Distance of the slide from the cam's axis, mm, positive to the left of its direction; default: taken from the positions of the bodies.
    pub offset: Option<f64>,
}

/// A roller on a body that turns.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineSwingingRoller {
    /// Radius of the roller, mm; 0 for a point.
    pub roller_radius: f64,
    /// Distance of the body's pin from the cam's axis, mm; default: taken from the positions of the bodies.
    pub center_distance: Option<f64>,
    /// Distance of the roller's centre from the body's pin, mm.
    pub arm_length: f64,
    /// Sense in which the body turns when the cam lifts it.
    #[serde(default)]
    pub lifts: Turn,
}

/// A flat face on a body that turns.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineSwingingFlat {
    /// Distance of the body's pin from the cam's axis, mm; default: taken from the positions of the bodies.
    pub center_distance: Option<f64>,
    /// Distance of the face before the pin, towards the cam, mm; may be negative.
    #[serde(default)]
    pub face_offset: f64,
    /// Sense in which the body turns when the cam lifts it.
    #[serde(default)]
    pub lifts: Turn,
}

impl MachineFollowerSpec {
    /// Whether the following body turns.
    pub(in crate::machine) fn swings(&self) -> bool {
        matches!(self, Self::SwingingRoller(_) | Self::SwingingFlat(_))
    }

    /// Sense of motion of the body when the cam lifts it: 1 along its slide, or counter-clockwise.
    pub(in crate::machine) fn sense(&self) -> f64 {
        match self {
            Self::SwingingRoller(MachineSwingingRoller { lifts, .. })
            | Self::SwingingFlat(MachineSwingingFlat { lifts, .. }) => lifts.sign(),
            _ => 1.0,
        }
    }

    /// Distance of the roller's centre from the body's origin, along the body's first axis, mm, for a body whose law starts at
    /// zero; `None` for a flat face.
    pub(in crate::machine) fn arm(&self) -> Option<f64> {
        match self {
            Self::TranslatingRoller(_) => Some(0.0),
            Self::SwingingRoller(follower) => Some(follower.arm_length),
            _ => None,
        }
    }

    /// Key and value, mm, of the distance in the design with which the positions of the bodies must agree.
    pub(in crate::machine) fn written(&self) -> (&'static str, Option<f64>) {
        match self {
            Self::TranslatingRoller(follower) => ("offset", follower.offset),
            Self::TranslatingFlat(_) => ("offset", None),
            Self::SwingingRoller(follower) => ("center_distance", follower.center_distance),
            Self::SwingingFlat(follower) => ("center_distance", follower.center_distance),
        }
    }

    /// The follower whose slide or pin is at a distance, mm, from the cam's axis.
    pub(in crate::machine) fn at(&self, distance: f64) -> Follower {
        match self {
            Self::TranslatingRoller(follower) => Follower::TranslatingRoller(TranslatingRoller {
                roller_radius: follower.roller_radius,
                offset: distance,
            }),
            Self::TranslatingFlat(follower) => Follower::TranslatingFlat(*follower),
            Self::SwingingRoller(follower) => Follower::SwingingRoller(SwingingRoller {
                roller_radius: follower.roller_radius,
                center_distance: distance,
                arm_length: follower.arm_length,
                lifts: follower.lifts,
            }),
            Self::SwingingFlat(follower) => Follower::SwingingFlat(SwingingFlat {
                center_distance: distance,
                face_offset: follower.face_offset,
                lifts: follower.lifts,
            }),
        }
    }
}

impl MachineCamSpec {
    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
        finite("mount_deg", self.mount)?;
        positive("base_radius", self.base_radius)?;
        if let Some(layer) = self.layer {
            in_range("layer", layer.into(), LAYERS, "")?;
        }
        let (_, written) = self.follower.written();
        let follower = self.follower.at(written.unwrap_or(1.0));
        follower.validate().map_err(|e| e.inside("follower"))?;
        self.body.validate().map_err(|e| e.inside("body"))?;
        let motion = match (&self.motion, &self.cut_to) {
            (Some(motion), None) => motion,
            (None, Some(_)) => return Ok(()),
            (Some(_), Some(_)) => return broken("cut_to", Rule::Excludes("motion")),
            (None, None) => return broken("motion", Rule::NeedsOneOf("motion and cut_to")),
        };
        motion.validate().map_err(|e| e.inside("motion"))?;
        match (self.follower.swings(), motion.swings()) {
            (true, Some(false)) => broken("motion", Rule::Stroke("swing_deg")),
            (false, Some(true)) => broken("motion", Rule::Stroke("lift")),
            _ => Ok(()),
        }
    }
}
