//! Connections of links next to the tree of joints.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::plain;
use crate::transmission::Transmission;

/// A pin through two links next to the tree of joints.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Closure {
    /// Indices of the two links.
    pub links: [usize; 2],
    /// Place of the pin in the frame of the first, mm.
    pub at: [f64; 3],
    /// Indices of the two joints of the loop that the pin moves: nothing else drives them.
    pub joints: [usize; 2],
}

/// Two links that touch by their teeth.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GearMesh {
    /// Indices of the driving and the driven link.
    pub links: [usize; 2],
    /// Index of the joint that the teeth move.
    pub joint: usize,
    /// Number of the copy of a chain it belongs to.
    pub copy: usize,
    /// Angle of a flank's normal through the pitch point against the pitch curves, rad; `None` if the flanks have no
    /// common one.
    pub pressure_angle: Option<f64>,
    /// Places of the axes of the two gears in the frames of their links, mm. Default: the origins of the frames.
    #[serde(default, skip_serializing_if = "at_origins")]
    pub axes: [[f64; 3]; 2],
    /// The pitch curves. Default: they are computed from the relative motion of the gears, which must not be at rest
    /// then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pitch: Option<PitchCurves>,
}

impl GearMesh {
    /// Driving and driven link on the origins of their frames, the joint that the teeth move, and the pressure angle, rad.
    #[must_use]
    pub fn new(links: [usize; 2], joint: usize, pressure_angle: f64) -> Self {
        Self {
            links,
            joint,
            copy: 0,
            pressure_angle: Some(pressure_angle),
            axes: Default::default(),
            pitch: None,
        }
    }
}

/// Whether two points are the origins of their frames.
fn at_origins(places: &[[f64; 3]; 2]) -> bool {
    *places == [[0.0; 3]; 2]
}

/// Pitch curves of two gears that roll on each other outside.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct PitchCurves {
    /// Angle of the driven gear by the polar angle of the pitch point on the driver, rad: its rate is the ratio of their radii.
    #[serde(with = "plain::laws")]
    #[schemars(with = "plain::laws::File")]
    pub driven: Arc<dyn Transmission>,
    /// Direction of the driver's polar angle zero in the axes of the driving link, rad.
    pub zero: f64,
}

impl PitchCurves {
    /// Radius of the driver's pitch curve in a direction given in the axes of the driving link, mm, and its derivative by that
    /// direction, mm/rad, for a distance of the axes (mm).
    ///
    /// With i the ratio of the radii and a the distance of the axes, r = a i / (1 + i).
    #[must_use]
    pub fn radius(&self, direction: f64, distance: f64) -> [f64; 2] {
        let jet = self.driven.at(direction - self.zero);
        let whole = 1.0 + jet.velocity;
        [
            distance * jet.velocity / whole,
            distance * jet.acceleration / (whole * whole),
        ]
    }
}

/// A roller or pin of one link on a curve of another: cam and follower, pin and slot.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Indices of the link with the curve and of the link with the roller.
    pub links: [usize; 2],
    /// Index of the joint that the contact moves.
    pub joint: usize,
    /// Axis of the roller in the frame of the second link, mm.
    pub at: [f64; 3],
    /// Direction of the force in the frame of the first link, for a straight slot. `None` for a curved one: there the
    /// force is perpendicular to the path of the roller along it.
    pub normal: Option<[f64; 3]>,
    /// The line along which the force acts, where it is known whether the links move or rest: of a cam and its follower.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<ContactLine>,
}

/// Line along which the force of a contact acts, in the axes of its second link, by the input.
#[derive(Clone, Debug, Deserialize, JsonSchema, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ContactLine {
    /// Direction, rad.
    #[serde(with = "plain::laws")]
    #[schemars(with = "plain::laws::File")]
    pub angle: Arc<dyn Transmission>,
    /// Moment of a unit force along it about the link's origin, mm.
    #[serde(with = "plain::laws")]
    #[schemars(with = "plain::laws::File")]
    pub arm: Arc<dyn Transmission>,
}

impl ContactLine {
    /// Point of the line nearest to the link's origin, mm, and the unit vector along it, at an input.
    #[must_use]
    pub fn at(&self, input: f64) -> [[f64; 3]; 2] {
        let arm = self.arm.at(input).position;
        let (sin, cos) = self.angle.at(input).position.sin_cos();
        [[arm * sin, -arm * cos, 0.0], [cos, sin, 0.0]]
    }
}

/// A groove of a turning link that moves a joint led by that link's.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Guide {
    /// Index of the joint that it moves.
    pub joint: usize,
    /// Distance of the groove from the axis of the leading joint, mm.
    pub radius: f64,
    /// Coefficient of friction in the groove.
    pub friction: f64,
}

/// Forces of a groove on the part that it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GuideForce {
    /// Push along the path, N; negative where the groove holds back.
    pub push: f64,
    /// Normal force of the wall, N, never negative.
    pub normal: f64,
    /// Force round the axis, N: positive where it resists the turning link.
    pub transverse: f64,
    /// Torque on the turning link, N mm: positive where it drives.
    pub torque: f64,
    /// Whether the wall behind pushes; else the one in front holds back.
    pub driving: bool,
}

impl GuideForce {
    /// Forces of a groove of a lead angle (rad) and radius (mm) that gives a push (N) along the path, by equilibrium of the
    /// wall's normal force and its friction.
    ///
    /// With the lead angle `a`, the angle of friction `f` and the push `P`: `F_n = P cos f / cos(a + f)`, across the path
    /// `P tan(a + f)`. Where `P` is negative the other wall holds back, and the sum becomes a difference. The formulas hold below
    /// the angle of jamming: `a + f` less than a right angle.
    #[must_use]
    pub fn new(push: f64, lead_angle: f64, radius: f64, friction: f64) -> Self {
        let (lead, friction) = (lead_angle.abs(), friction.atan());
        let driving = push >= 0.0;
        let angle = if driving {
            lead + friction
        } else {
            lead - friction
        };
        let transverse = push * angle.tan();
        Self {
            push,
            normal: push.abs() * friction.cos() / angle.cos(),
            transverse,
            torque: transverse * radius,
            driving,
        }
    }
}
