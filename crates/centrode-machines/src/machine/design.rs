//! A composed machine as the design file gives it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    Hardware, MachineBodySpec, MachineCamSpec, MachineCopiesSpec, MachineDyadSpec, MachineGearSpec,
    MachineGoalSpec, MachineLoadSpec, MachineLoopSpec, MachineObstacleSpec, MachinePlatesSpec,
    MachinePointsSpec,
};
use centrode_gear::design::GearPairDesign;
use centrode_spec::rule::{
    Rule, broken, count_in_range, design_name, finite, in_range, part_name, positive, single_line,
};
use centrode_spec::{DesignSpec, DrawingSpec, Named, SpecError, goals};

/// Name of the fixed body.
pub(super) const FRAME: &str = "frame";
/// Maximum number of turns of the input in a period.
const MAX_TURNS: u32 = 60;

/// Maximum number of bodies. A check of 400 bodies with plates takes 4 s in the development build; the time grows with their
/// number to the power of 1.5 to 2.
const MAX_BODIES: f64 = 400.0;

/// A planar machine composed of bodies that turn, slide or are tied by dyads.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct MachineDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// The shaft that drives it.
    #[serde(default)]
    pub input: MachineInputSpec,
    /// The body that is fixed.
    #[serde(default)]
    pub frame: MachinePointsSpec,
    /// Bodies by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub bodies: Named<MachineBodySpec>,
    /// Dyads by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub dyads: Named<MachineDyadSpec>,
    /// Gear pairs by name, each as in family gear-pair.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub pairs: Named<GearPairDesign>,
    /// Gears by name, each of a pair and on a body.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub gears: Named<MachineGearSpec>,
    /// Meshes by name, next to those that hold bodies.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub meshes: Named<MachineLoopSpec>,
    /// Disc cams by name, each on a body.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub cams: Named<MachineCamSpec>,
    /// Chains of bodies of which there are several, evenly spaced, by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub copies: Named<MachineCopiesSpec>,
    /// Plates, pins and shafts: `full` designs them, `none` does not; default `full` if `plates` or a body describes them,
    /// otherwise `none`.
    pub hardware: Option<Hardware>,
    /// The bodies as plates.
    #[serde(default)]
    pub plates: MachinePlatesSpec,
    /// The drawing sheets.
    #[serde(default, skip_serializing_if = "DrawingSpec::is_default")]
    pub drawing: DrawingSpec,
    /// Acceleration of free fall, m/s²: x and y; default: there is no weight.
    pub gravity: Option<[f64; 2]>,
    /// Loads by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub loads: Named<MachineLoadSpec>,
    /// Obstacles by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub obstacles: Named<MachineObstacleSpec>,
    /// Goals by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub goals: Named<MachineGoalSpec>,
    /// Numbers that a search may move, by their keys in quotes, each with its minimum and maximum value.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub vary: Named<[f64; 2]>,
}

/// The shaft that drives a composed machine.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineInputSpec {
    /// Speed, turns per minute.
    pub speed_rpm: f64,
    /// Turns after which the whole machine repeats.
    pub turns: u32,
}

fn default_name() -> String {
    "machine".into()
}

impl Default for MachineInputSpec {
    fn default() -> Self {
        Self {
            speed_rpm: 60.0,
            turns: 1,
        }
    }
}

impl DesignSpec for MachineDesign {
    const FAMILY: &'static str = "machine";
    const ABOUT: &'static str = "A planar machine composed of bodies, laws and dyads.";
    const TEMPLATE: &'static str = include_str!("../../design/machine.toml");
    const TABLES: &'static [&'static str] = &[
        "input",
        "frame",
        "bodies",
        "dyads",
        "pairs",
        "gears",
        "meshes",
        "cams",
        "copies",
        "plates",
        "drawing",
        "loads",
        "obstacles",
        "goals",
        "vary",
    ];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()?;
        if self.bodies.is_empty() && self.dyads.is_empty() {
            return broken(
                "bodies",
                Rule::Needed("with at least one body apart from the frame"),
            );
        }
        self.check_sizes()
    }
}

impl MachineDesign {
    /// Number of bodies apart from the frame: bodies with a table of their own, two per dyad, and all copies.
    fn body_count(&self) -> usize {
        let copies = self.copies.values();
        let copied = copies.map(|c| c.bodies.len() * c.count.saturating_sub(1) as usize);
        self.bodies.len() + 2 * self.dyads.len() + copied.sum::<usize>()
    }

    /// Sorts all parts by their names.
    pub(super) fn sort_parts(&mut self) {
        let bodies = self.bodies.values_mut();
        let of_bodies = bodies.map(|body| (&mut body.points, &mut body.corners));
        let of_frame = (&mut self.frame.points, &mut self.frame.corners);
        for (points, corners) in of_bodies.chain([of_frame]) {
            points.sort_unstable_keys();
            corners.sort_unstable_keys();
        }
        self.bodies.sort_unstable_keys();
        self.dyads.sort_unstable_keys();
        self.pairs.sort_unstable_keys();
        self.gears.sort_unstable_keys();
        self.meshes.sort_unstable_keys();
        self.cams.sort_unstable_keys();
        self.copies.sort_unstable_keys();
        self.loads.sort_unstable_keys();
        self.obstacles.sort_unstable_keys();
    }

    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        positive("input.speed_rpm", self.input.speed_rpm)?;
        count_in_range("input.turns", self.input.turns, 1, MAX_TURNS)?;
        let count = self.body_count() as f64;
        in_range("bodies", count, [0.0, MAX_BODIES], "")?;
        self.frame.validate().map_err(|e| e.inside(FRAME))?;
        let has_plates = self.hardware() != Hardware::None;
        for (name, body) in &self.bodies {
            let key = format!("bodies.{name}");
            part_name(&key, name)?;
            if name == FRAME {
                return broken(
                    &key,
                    Rule::Unused("as a body: write its keys in the table [frame]"),
                );
            }
            body.validate().map_err(|e| e.inside(&key))?;
            let mass = body.given_mass().validate(has_plates && body.has_plate());
            mass.map_err(|e| e.inside(&key))?;
        }
        for (name, dyad) in &self.dyads {
            let key = format!("dyads.{name}");
            part_name(&key, name)?;
            dyad.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, pair) in &self.pairs {
            let key = format!("pairs.{name}");
            part_name(&key, name)?;
            pair.validate().map_err(|e| e.inside(&key))?;
            for (table, is_empty) in [
                ("goals", pair.goals.is_empty()),
                ("vary", pair.vary.is_empty()),
            ] {
                if !is_empty {
                    let rule = Rule::Unused(
                        "inside a pair of a machine: goals name figures such as pair(drive).ratio_max",
                    );
                    return broken(&format!("{key}.{table}"), rule);
                }
            }
        }
        for (name, gear) in &self.gears {
            let key = format!("gears.{name}");
            part_name(&key, name)?;
            finite(&format!("{key}.mount_deg"), gear.mount)?;
        }
        for (name, cam) in &self.cams {
            let key = format!("cams.{name}");
            part_name(&key, name)?;
            cam.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, copies) in &self.copies {
            let key = format!("copies.{name}");
            part_name(&key, name)?;
            copies.validate().map_err(|e| e.inside(&key))?;
        }
        for x in self.gravity.iter().flatten() {
            finite("gravity", *x)?;
        }
        for (name, load) in &self.loads {
            let key = format!("loads.{name}");
            part_name(&key, name)?;
            load.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, obstacle) in &self.obstacles {
            let key = format!("obstacles.{name}");
            part_name(&key, name)?;
            obstacle.validate().map_err(|e| e.inside(&key))?;
        }
        for (name, goal) in &self.goals {
            let key = format!("goals.{name}");
            part_name(&key, name)?;
            goal.validate().map_err(|e| e.inside(&key))?;
        }
        let goals = self.goals.iter();
        goals::check_contradictions(
            "goals",
            goals.map(|(name, goal)| (&**name, goal.subject(), goal.range())),
        )?;
        goals::check_bounds(&self.vary)?;
        self.drawing.validate().map_err(|e| e.inside("drawing"))?;
        match self.hardware() {
            Hardware::None => Ok(()),
            Hardware::List | Hardware::Full => {
                self.plates.validate().map_err(|e| e.inside("plates"))
            }
        }
    }
}
