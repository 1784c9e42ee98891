//! The design of a gear pair, with the same keys in the file, in Rust and in Python.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::pitch::PitchSpec;
use super::rolling::Member;
use centrode_spec::goals::check_search;
use centrode_spec::{CutSpec, DesignSpec, DrawingSpec, FigureGoalSpec, Named, degrees};

mod body;
mod gear;
mod housing;
mod teeth;
mod tool;

pub use body::BodySpec;
pub use gear::{GearSpec, SHIFTS};
pub use housing::HousingSpec;
pub use teeth::{Addendum, Fit, Phase, TeethSpec, TipShortening};
pub use tool::{Rack, Shaper, ToolSpec};

use centrode_spec::rule::{
    Rule, SpecError, broken, count_in_range, design_name, positive, single_line,
};

/// A non-circular gear pair.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct GearPairDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Turns of the driver and of the driven gear in one whole cycle, in lowest terms: `[2, 1]` gives
    /// the driver two turns to one of the driven gear.
    #[serde(default = "default_mean_ratio")]
    pub mean_ratio: [u32; 2],
    /// Teeth of the driver, for a pitch curve with a size of its own: the module follows.
    pub tooth_count: Option<u32>,
    /// Centre distance, mm. Default: it follows from pitch curve, mean ratio and profile shifts. Circular gears with one shift
    /// given get the other shift from it.
    pub center_distance: Option<f64>,
    /// Pitch curve of the driver.
    pub pitch: PitchSpec,
    /// The tool that cuts both gears, unless a gear has its own.
    #[serde(default)]
    pub tool: ToolSpec,
    /// Teeth of both gears.
    #[serde(default)]
    pub teeth: TeethSpec,
    /// Shift and heights of the driver's teeth, and its body.
    #[serde(default)]
    pub driver: GearSpec,
    /// Shift and heights of the driven gear's teeth, and its body.
    #[serde(default)]
    pub driven: GearSpec,
    /// Housing of a flow meter or pump.
    #[serde(default, skip_serializing_if = "HousingSpec::is_default")]
    pub housing: HousingSpec,
    /// How the gears are cut from a plate.
    #[serde(default, skip_serializing_if = "CutSpec::is_default")]
    pub cut: CutSpec,
    /// The drawing sheets.
    #[serde(default, skip_serializing_if = "DrawingSpec::is_default")]
    pub drawing: DrawingSpec,
    /// Goals by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub goals: Named<FigureGoalSpec>,
    /// Numbers that a search may move, by their keys in quotes, each with its minimum and maximum value.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub vary: Named<[f64; 2]>,
}

fn default_name() -> String {
    "gear-pair".into()
}

fn default_mean_ratio() -> [u32; 2] {
    [1, 1]
}

/// Largest number of turns in a mean ratio.
const MAX_TURNS: u32 = 60;

impl DesignSpec for GearPairDesign {
    const FAMILY: &'static str = "gear-pair";
    const ABOUT: &'static str = "A non-circular gear pair.";
    const TEMPLATE: &'static str = include_str!("../../design/gear_pair.toml");
    const TABLES: &'static [&'static str] = &[
        "pitch", "tool", "teeth", "driver", "driven", "housing", "cut", "drawing", "goals", "vary",
    ];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl GearPairDesign {
    /// A pair with the given driver pitch curve and every other value at its default.
    #[must_use]
    pub fn new(pitch: PitchSpec) -> Self {
        Self {
            name: default_name(),
            title: String::new(),
            mean_ratio: default_mean_ratio(),
            tooth_count: None,
            center_distance: None,
            pitch,
            tool: ToolSpec::default(),
            teeth: TeethSpec::default(),
            driver: GearSpec::default(),
            driven: GearSpec::default(),
            housing: HousingSpec::default(),
            cut: CutSpec::default(),
            drawing: DrawingSpec::default(),
            goals: Named::new(),
            vary: Named::new(),
        }
    }

    /// Checks the rules that need no geometry: ranges, and keys that contradict each other.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault and the rule it breaks. The pitch curve's own rules are
    /// those of [`PitchSpec::resolve`].
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        let [n1, n2] = self.mean_ratio;
        count_in_range("mean_ratio", n1, 1, MAX_TURNS)?;
        count_in_range("mean_ratio", n2, 1, MAX_TURNS)?;
        let divisor = greatest_common_divisor(n1, n2);
        if divisor > 1 {
            let rule = Rule::LowestTerms([n1, n2], [n1 / divisor, n2 / divisor]);
            return broken("mean_ratio", rule);
        }
        if let Some(z) = self.tooth_count {
            count_in_range("tooth_count", z, 3, 10_000)?;
        }
        if let (Some(z), Some(of_pitch)) = (self.tooth_count, self.pitch.tooth_count())
            && z != of_pitch
        {
            return broken("tooth_count", Rule::ToothCountTwice(z, of_pitch));
        }
        if let Some(z) = self.driver_tooth_count()
            && !(u64::from(z) * u64::from(n1)).is_multiple_of(n2.into())
        {
            let key = if self.tooth_count.is_some() {
                "tooth_count"
            } else {
                "pitch.tooth_count"
            };
            return broken(key, Rule::DrivenTeeth(z, [n1, n2]));
        }
        if let Some(a) = self.center_distance {
            positive("center_distance", a)?;
        }
        self.tool.validate().map_err(|e| e.inside("tool"))?;
        self.teeth.validate().map_err(|e| e.inside("teeth"))?;
        self.driver.validate().map_err(|e| e.inside("driver"))?;
        self.driven.validate().map_err(|e| e.inside("driven"))?;
        for (member, gear) in [("driver", &self.driver), ("driven", &self.driven)] {
            let Some(own) = &gear.tool else { continue };
            let [own, tool] = [own, &self.tool].map(|t| degrees::rounded(t.pressure_angle()));
            if own != tool {
                let key = format!("{member}.tool.pressure_angle_deg");
                return broken(&key, Rule::PressureAngles { own, tool });
            }
        }
        self.housing.validate().map_err(|e| e.inside("housing"))?;
        self.cut.validate().map_err(|e| e.inside("cut"))?;
        self.drawing.validate().map_err(|e| e.inside("drawing"))?;
        check_search(&self.goals, &self.vary)
    }

    /// Tool that cuts a gear of the pair.
    #[must_use]
    pub fn tool_of(&self, member: Member) -> &ToolSpec {
        let gear = match member {
            Member::Driver => &self.driver,
            Member::Driven => &self.driven,
        };
        gear.tool.as_ref().unwrap_or(&self.tool)
    }

    /// Gives all tools another pressure angle, rad.
    pub(crate) fn set_pressure_angle(&mut self, angle: f64) {
        let own = [&mut self.driver.tool, &mut self.driven.tool];
        for tool in own.into_iter().flatten().chain([&mut self.tool]) {
            *tool.pressure_angle_mut() = angle;
        }
    }

    /// Whether the teeth are fitted: any parameter in `fit` implies it.
    pub(crate) fn is_fitted(&self) -> bool {
        self.teeth.addendum == Addendum::Fitted || !self.teeth.fit.is_empty()
    }

    /// Profile shift coefficients of driver and driven gear; a missing one is opposite to its mate's, which does not change the
    /// centre distance.
    pub(crate) fn shifts(&self) -> [f64; 2] {
        let [driver, driven] = [self.driver.shift, self.driven.shift];
        let of = |own: Option<f64>, mate: Option<f64>| own.or(mate.map(|x| 0.0 - x)).unwrap_or(0.0);
        [of(driver, driven), of(driven, driver)]
    }

    /// Teeth of the driver, from the pair or from its pitch curve.
    #[must_use]
    pub fn driver_tooth_count(&self) -> Option<u32> {
        self.tooth_count.or(self.pitch.tooth_count())
    }

    /// The design with another number of teeth on the driver, on pitch curves of the same size: the module changes.
    #[must_use]
    pub fn with_tooth_count(&self, teeth: u32) -> Self {
        let mut changed = self.clone();
        changed.pitch.set_tooth_count(teeth);
        changed.tooth_count = self.tooth_count.map(|_| teeth);
        changed
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 {
        a
    } else {
        greatest_common_divisor(b, a % b)
    }
}
