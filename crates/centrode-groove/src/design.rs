use std::f64::consts::FRAC_PI_3;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{AmplitudeFor, Load, Mill, Reversal, ShaftBody, ShaftError, SliderSpec, SpeedLaw};
use centrode_spec::goals::check_search;
use centrode_spec::rule::{
    Rule, broken, count_in_range, design_name, finite, in_range, positive, single_line,
};
use centrode_spec::{DesignSpec, DrawingSpec, FigureGoalSpec, Named, SpecError, degrees};

/// A variable-speed spiral shaft as written: the same words in the file, in Rust and in Python.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpiralShaftDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    pub name: String,
    /// One line for drawings and reports.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Lead, mm per turn: the distance of neighbouring holes.
    pub lead: f64,
    /// Holes across the box.
    pub holes: u32,
    /// Radius of the shaft, mm.
    pub radius: f64,
    /// Distance the box must move in the window, mm; sets the amplitude of a sine law.
    pub moved_distance: Option<f64>,
    /// Shaft turn during which a seedling is picked, rad (degrees in the file).
    #[serde(rename = "window_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub window: f64,
    /// Shaft angle in the middle of the first picking, where the stroke out begins, rad (degrees in the file).
    #[serde(rename = "pick_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub pick: f64,
    /// Width of a pot, mm: the box may move by a sixth of it while a seedling is picked.
    pub pot_width: f64,
    /// Shift of the return groove next to the forward one, mm: brings the slow points off the crossings at the price
    /// of missing each hole by half of it.
    pub return_offset: f64,
    /// Speed along the shaft.
    pub law: SpeedLaw,
    /// Reversal of the slider at both ends.
    pub reversal: Reversal,
    /// The groove.
    pub groove: GrooveSpec,
    /// The slider.
    pub slider: SliderSpec,
    /// The body of the shaft.
    pub body: ShaftBody,
    /// Mill that cuts the groove.
    pub mill: Mill,
    /// Load that is moved, and its speed.
    pub load: Load,
    /// The drawing sheets.
    #[serde(skip_serializing_if = "DrawingSpec::is_default")]
    pub drawing: DrawingSpec,
    /// Goals by name.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub goals: Named<FigureGoalSpec>,
    /// Numbers that a search may move, by their keys in quotes, each with its minimum and maximum value.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub vary: Named<[f64; 2]>,
}

/// Size of the groove.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct GrooveSpec {
    /// Width along the normal on the shaft's surface, mm.
    pub width: f64,
    /// Depth, mm.
    pub depth: f64,
}

impl Default for GrooveSpec {
    fn default() -> Self {
        Self {
            width: 10.0,
            depth: 4.0,
        }
    }
}

impl Default for SpiralShaftDesign {
    fn default() -> Self {
        Self {
            name: "spiral-shaft".into(),
            title: String::new(),
            lead: 20.0,
            holes: 14,
            radius: 15.0,
            moved_distance: None,
            window: FRAC_PI_3,
            pick: 0.0,
            pot_width: 18.0,
            return_offset: 0.0,
            law: SpeedLaw::default(),
            reversal: Reversal::default(),
            groove: GrooveSpec::default(),
            slider: SliderSpec::default(),
            body: ShaftBody::default(),
            mill: Mill::default(),
            load: Load::default(),
            drawing: DrawingSpec::default(),
            goals: Named::new(),
            vary: Named::new(),
        }
    }
}

impl DesignSpec for SpiralShaftDesign {
    const FAMILY: &'static str = "spiral-shaft";
    const ABOUT: &'static str = "A variable-speed spiral shaft.";
    const TEMPLATE: &'static str = include_str!("../design/spiral_shaft.toml");
    const TABLES: &'static [&'static str] = &[
        "law", "reversal", "groove", "slider", "body", "mill", "load", "goals", "vary",
    ];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl SpiralShaftDesign {
    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        positive("lead", self.lead)?;
        count_in_range("holes", self.holes, 2, 1000)?;
        positive("radius", self.radius)?;
        in_range(
            "window_deg",
            self.window.to_degrees(),
            [1e-6, 360.0],
            " deg",
        )?;
        // A hundred turns in either direction: after many millions no digits are left for the angle within a turn.
        in_range("pick_deg", self.pick.to_degrees(), [-36e3, 36e3], " deg")?;
        positive("pot_width", self.pot_width)?;
        finite("return_offset", self.return_offset)?;
        positive("groove.width", self.groove.width)?;
        positive("groove.depth", self.groove.depth)?;
        let slider = self.slider.validate(self.groove.width, self.groove.depth);
        slider.map_err(|e| e.inside("slider"))?;
        let mill = self.mill.validate(self.groove.width);
        mill.map_err(|e| e.inside("mill"))?;
        self.load.validate().map_err(|e| e.inside("load"))?;
        self.drawing.validate().map_err(|e| e.inside("drawing"))?;
        check_search(&self.goals, &self.vary)?;
        match (self.moved_distance, &self.law) {
            (None, _) => Ok(()),
            (Some(_), SpeedLaw::Sine(sine)) if sine.amplitude == 0.0 => Ok(()),
            (Some(_), SpeedLaw::Sine(_)) => {
                broken("moved_distance", Rule::Excludes("law.amplitude"))
            }
            (Some(_), _) => broken("moved_distance", Rule::Excludes("a law other than sine")),
        }
    }

    /// Law with its amplitude solved for the required distance, if one is given.
    ///
    /// # Errors
    /// [`ShaftError`] where no amplitude gives it.
    pub fn solved_law(&self) -> Result<SpeedLaw, ShaftError> {
        let (Some(moved_distance), SpeedLaw::Sine(sine)) = (self.moved_distance, &self.law) else {
            return Ok(self.law.clone());
        };
        let amplitude = AmplitudeFor {
            moved_distance,
            window: self.window,
            lead: self.lead,
            harmonic: sine.harmonic,
        };
        let mut sine = sine.clone();
        sine.amplitude = amplitude.solve()?;
        Ok(SpeedLaw::Sine(sine))
    }
}
