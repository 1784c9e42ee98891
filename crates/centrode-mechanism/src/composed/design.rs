//! A composed machine as written.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    ComposedDyadSpec, ComposedGearSpec, ComposedGoalSpec, ComposedLawSpec, ComposedLoopSpec,
    ComposedMeshSpec,
};
use crate::degrees;
use crate::design::DesignSpec;
use crate::gear::design::rule::{
    Rule, broken, count_in_range, file_name, finite, in_range, not_negative, positive, single_line,
};
use crate::gear::design::{GearPairDesign, SpecError};

/// Name of the body that stands still.
pub(super) const FRAME: &str = "frame";
/// Most turns of the input in a period.
const MOST_TURNS: u32 = 60;

/// A planar machine composed of bodies that turn, slide or are tied by dyads.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ComposedDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// The shaft that drives it.
    #[serde(default)]
    pub input: ComposedInputSpec,
    /// The body that stands still.
    #[serde(default)]
    pub frame: ComposedPointsSpec,
    /// Bodies by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub bodies: BTreeMap<String, ComposedBodySpec>,
    /// Dyads by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub dyads: BTreeMap<String, ComposedDyadSpec>,
    /// Gear pairs by name, each as in family gear-pair.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub pairs: BTreeMap<String, GearPairDesign>,
    /// Gears by name, each of a pair and on a body.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub gears: BTreeMap<String, ComposedGearSpec>,
    /// Meshes by name, beside those that hold bodies.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub meshes: BTreeMap<String, ComposedLoopSpec>,
    /// The bodies as plates.
    #[serde(default)]
    pub plates: ComposedPlatesSpec,
    /// Goals by name.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub goals: BTreeMap<String, ComposedGoalSpec>,
    /// Numbers that a search may move, by their keys in quotes, each with its least and greatest value.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub vary: BTreeMap<String, [f64; 2]>,
}

/// The shaft that drives a composed machine.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ComposedInputSpec {
    /// Speed, turns a minute.
    pub speed_rpm: f64,
    /// Turns after which the whole machine repeats.
    pub turns: u32,
}

/// Points of a body by name.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ComposedPointsSpec {
    /// Points by name: x and y in the body's axes, mm.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub points: BTreeMap<String, [f64; 2]>,
    /// Points by name, each the third corner of a triangle.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub corners: BTreeMap<String, CornerSpec>,
}

/// A point of a body by its distances from two others.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct CornerSpec {
    /// The two points of the body from which it is measured.
    pub from: [String; 2],
    /// Distances from them, mm.
    pub lengths: [f64; 2],
    /// Side of the way from the first to the second on which it lies, left or right.
    pub side: Side,
}

/// Choice between the two ways in which lengths go together.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// To the left of the way from the first point to the second.
    Left,
    /// To the right of it.
    Right,
    /// Forward along the line.
    Forward,
    /// Backward along the line.
    Backward,
}

/// A body of a composed machine: turning on a pin, sliding along a line, fixed to another body or made by a dyad.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ComposedBodySpec {
    /// Point of another body on which it turns, or from which it slides: `frame.O`; with a mesh, the body that carries it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// Direction in which it slides, in the axes of the body that carries it, rad (degrees in the file); left out, it turns.
    #[serde(
        rename = "slides_deg",
        with = "degrees::option",
        skip_serializing_if = "Option::is_none"
    )]
    #[schemars(with = "Option<f64>")]
    pub slides: Option<f64>,
    /// Body, or point of a body, to which it is fixed: its origin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fixed_to: Option<String>,
    /// Turn of its axes against those of the body it is fixed to, rad (degrees in the file).
    #[serde(
        rename = "turned_deg",
        with = "degrees::option",
        skip_serializing_if = "Option::is_none"
    )]
    #[schemars(with = "Option<f64>")]
    pub turned: Option<f64>,
    /// Place of its plate along the shafts, counted from the one next to the frame; left out, plates stack in order.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer: Option<u32>,
    /// Motion of a body that turns or slides.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<ComposedLawSpec>,
    /// Mesh that turns it on its carrier, and places it there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh: Option<ComposedMeshSpec>,
    /// Points by name: x and y in the body's axes, mm.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub points: BTreeMap<String, [f64; 2]>,
    /// Points by name, each the third corner of a triangle.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub corners: BTreeMap<String, CornerSpec>,
}

/// The bodies as plates drawn round their points.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ComposedPlatesSpec {
    /// Thickness of a plate, mm.
    pub thickness: f64,
    /// Distance of neighbouring plates, mm.
    pub gap: f64,
    /// Width of a plate, mm: it ends in half circles about its points.
    pub width: f64,
    /// Diameter of the pins, mm.
    pub pin_diameter: f64,
    /// Density, kg/m^3.
    pub density: f64,
}

fn default_name() -> String {
    "machine".into()
}

impl Default for ComposedInputSpec {
    fn default() -> Self {
        Self {
            speed_rpm: 60.0,
            turns: 1,
        }
    }
}

impl Default for ComposedPlatesSpec {
    fn default() -> Self {
        Self {
            thickness: 5.0,
            gap: 1.0,
            width: 8.0,
            pin_diameter: 3.0,
            density: 7850.0,
        }
    }
}

impl Side {
    /// Whether it is a side of a way rather than a sense along a line.
    #[must_use]
    pub fn is_across(self) -> bool {
        matches!(self, Self::Left | Self::Right)
    }

    /// +1 to the left and forward, -1 to the right and backward.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Left | Self::Forward => 1.0,
            Self::Right | Self::Backward => -1.0,
        }
    }
}

impl CornerSpec {
    fn validate(&self) -> Result<(), SpecError> {
        for length in self.lengths {
            positive("lengths", length)?;
        }
        if !self.side.is_across() {
            return broken("side", Rule::Needed("as left or right"));
        }
        Ok(())
    }
}

impl ComposedPointsSpec {
    fn validate(&self) -> Result<(), SpecError> {
        points(&self.points, &self.corners)
    }
}

/// Checks the names and numbers of a body's points.
fn points(
    points: &BTreeMap<String, [f64; 2]>,
    corners: &BTreeMap<String, CornerSpec>,
) -> Result<(), SpecError> {
    for (name, at) in points {
        let key = format!("points.{name}");
        file_name(&key, name)?;
        for coordinate in at {
            finite(&key, *coordinate)?;
        }
    }
    for (name, corner) in corners {
        let key = format!("corners.{name}");
        file_name(&key, name)?;
        if points.contains_key(name) {
            return broken(&key, Rule::Excludes("a point of the same name"));
        }
        corner.validate().map_err(|e| e.inside(&key))?;
    }
    Ok(())
}

impl ComposedBodySpec {
    fn validate(&self) -> Result<(), SpecError> {
        if self.on.is_some() && self.fixed_to.is_some() {
            return broken("fixed_to", Rule::Excludes("on"));
        }
        if let Some(mesh) = &self.mesh {
            finite("mesh.direction_deg", mesh.direction)?;
            let beside = [
                ("law", self.law.is_some()),
                ("slides_deg", self.slides.is_some()),
            ];
            if let Some((key, _)) = beside.into_iter().find(|(_, given)| *given) {
                return broken(key, Rule::Excludes("mesh"));
            }
        }
        if self.on.is_some() && self.law.is_none() && self.mesh.is_none() {
            return broken(
                "law",
                Rule::Needed("for a body that turns or slides, or a mesh"),
            );
        }
        if self.on.is_none() && self.mesh.is_some() {
            return broken("on", Rule::Needed("for a body that a mesh turns"));
        }
        if self.on.is_none() && self.law.is_some() {
            return broken("on", Rule::Needed("for a body with a law"));
        }
        if self.on.is_none() && self.slides.is_some() {
            return broken("on", Rule::Needed("for a body that slides"));
        }
        if self.fixed_to.is_none() && self.turned.is_some() {
            return broken(
                "turned_deg",
                Rule::Unused("but for a body that is fixed_to another"),
            );
        }
        for (key, angle) in [("slides_deg", self.slides), ("turned_deg", self.turned)] {
            finite(key, angle.unwrap_or(0.0))?;
        }
        if let Some(layer) = self.layer {
            count_in_range("layer", layer, 0, 1000)?;
        }
        if let Some(law) = &self.law {
            let slides = self.slides.is_some();
            law.validate(slides).map_err(|e| e.inside("law"))?;
        }
        points(&self.points, &self.corners)
    }
}

impl ComposedPlatesSpec {
    fn validate(&self) -> Result<(), SpecError> {
        for (key, value) in [
            ("thickness", self.thickness),
            ("width", self.width),
            ("density", self.density),
        ] {
            positive(key, value)?;
        }
        not_negative("gap", self.gap)?;
        let most = 0.9 * self.width;
        in_range("pin_diameter", self.pin_diameter, [0.0, most], " mm")
    }
}

impl DesignSpec for ComposedDesign {
    const FAMILY: &'static str = "machine";
    const ABOUT: &'static str = "A planar machine composed of bodies, laws and dyads.";
    const TEMPLATE: &'static str = include_str!("../../design/machine.toml");
    const TABLES: &'static [&'static str] = &[
        "input", "frame", "bodies", "dyads", "pairs", "gears", "meshes", "plates", "goals", "vary",
    ];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl ComposedDesign {
    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        file_name("name", &self.name)?;
        single_line("title", &self.title)?;
        positive("input.speed_rpm", self.input.speed_rpm)?;
        count_in_range("input.turns", self.input.turns, 1, MOST_TURNS)?;
        self.frame.validate().map_err(|e| e.inside(FRAME))?;
        for (name, body) in &self.bodies {
            let key = format!("bodies.{name}");
            file_name(&key, name)?;
            if name == FRAME {
                return broken(
                    &key,
                    Rule::Excludes("the frame, which has a table of its own"),
                );
            }
            body.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, dyad) in &self.dyads {
            let key = format!("dyads.{name}");
            file_name(&key, name)?;
            dyad.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, pair) in &self.pairs {
            let key = format!("pairs.{name}");
            file_name(&key, name)?;
            pair.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, gear) in &self.gears {
            let key = format!("gears.{name}");
            file_name(&key, name)?;
            finite(&format!("{key}.mount_deg"), gear.mount)?;
        }
        for (name, goal) in &self.goals {
            let key = format!("goals.{name}");
            file_name(&key, name)?;
            goal.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, [low, high]) in &self.vary {
            let key = format!("vary.{name}");
            finite(&key, *low)?;
            finite(&key, *high)?;
            if low >= high {
                return broken(&key, Rule::NotInOrder(*low, *high));
            }
        }
        self.plates.validate().map_err(|e| e.inside("plates"))
    }
}
