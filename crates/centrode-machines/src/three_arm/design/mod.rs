//! A three-arm transplanting mechanism as written in the design file.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Parameter;
use centrode_gear::design::{BodySpec, GearPairDesign, GearSpec, SHIFTS, TeethSpec, ToolSpec};
use centrode_gear::pitch::PitchSpec;
use centrode_spec::goals::check_goals;
use centrode_spec::rule::{
    broken, count_in_range, design_name, finite, in_range, is_zero, positive, single_line,
};
use centrode_spec::{DesignSpec, DrawingSpec, FigureGoalSpec, Named, Rule, SpecError, degrees};

mod arm;
mod goals;
mod optimise;
mod pusher;
mod work;

pub use arm::{ArmSpec, GearboxSpec};
pub use goals::GoalsSpec;
pub use optimise::{Objective, OptimiseSpec};
pub use pusher::{ForkSpec, PusherCamSpec};
pub use work::{SeedlingSpec, TraySpec, Unpicked, WorkSpec};

/// A planetary transplanting mechanism: a fixed sun, a carrier at constant speed, and evenly spaced arms, each
/// on the planet of its own bent chain of three non-circular gears.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct ThreeArmDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Number of arms, 1 to 6.
    #[serde(default = "default_arms")]
    pub arms: u32,
    /// Sense in which the carrier turns.
    #[serde(default)]
    pub direction: Direction,
    /// Direction of the first intermediate gear's axis from the sun's at the start, rad (degrees in the file).
    #[serde(rename = "carrier_start_deg", with = "degrees")]
    #[schemars(with = "f64", extend("x-symbol" = "phi_0"))]
    pub carrier_start: f64,
    /// Bend of each chain: from the direction sun to intermediate to the direction intermediate to planet, rad
    /// (degrees in the file).
    #[serde(rename = "bend_deg", with = "degrees")]
    #[schemars(with = "f64", extend("x-symbol" = "gamma_0"))]
    pub bend: f64,
    /// Angle from the planet's zero to the chain's second leg at the start, rad (degrees in the file); default:
    /// the intermediate's turn over the first |bend| of carrier turn.
    #[serde(default, rename = "planet_reference_deg", with = "degrees")]
    #[schemars(with = "Option<f64>", extend("x-symbol" = "phi_30"))]
    pub planet_reference: Option<f64>,
    /// Teeth of every gear; default: there are no teeth to check.
    pub tooth_count: Option<u32>,
    /// Centre distance of each mesh, mm; by default it follows from the pitch curve.
    #[schemars(extend("x-symbol" = "a"))]
    pub center_distance: Option<f64>,
    /// Pitch curve of the sun, which starts in the direction of `carrier_start_deg`; the planets are equal.
    pub pitch: PitchSpec,
    /// The tool that cuts every gear.
    #[serde(default)]
    pub tool: ToolSpec,
    /// Profile shift coefficient of sun and planets; the intermediate gears have the opposite one.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(extend("x-symbol" = "x"))]
    pub shift: f64,
    /// Teeth of every gear.
    #[serde(default)]
    pub teeth: TeethSpec,
    /// The arms.
    pub arm: ArmSpec,
    /// The cams on the carrier that move the push rods; default: the usual one in proportion to
    /// the usual arm.
    pub cam: Option<PusherCamSpec>,
    /// The forks between cams and push rods; default: the usual one in proportion to the usual arm.
    pub fork: Option<ForkSpec>,
    /// The gearbox around the gears.
    #[serde(default)]
    pub gearbox: GearboxSpec,
    /// Picking, planting and feed.
    #[serde(default)]
    pub work: WorkSpec,
    /// The tray the seedlings are picked from.
    #[serde(default)]
    pub tray: TraySpec,
    /// The seedlings.
    #[serde(default)]
    pub seedling: SeedlingSpec,
    /// Goals of a good mechanism.
    #[serde(default)]
    pub goals: GoalsSpec,
    /// Goals for other figures of the check, by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub figure_goals: Named<FigureGoalSpec>,
    /// Variables and objective of a search.
    #[serde(default, skip_serializing_if = "OptimiseSpec::is_default")]
    pub optimise: OptimiseSpec,
    /// Body of the sun.
    #[serde(default)]
    pub sun: BodySpec,
    /// Body of the intermediate gears.
    #[serde(default)]
    pub intermediate: BodySpec,
    /// Body of the planets.
    #[serde(default)]
    pub planet: BodySpec,
    /// The drawing sheets.
    #[serde(default, skip_serializing_if = "DrawingSpec::is_default")]
    pub drawing: DrawingSpec,
}

/// Sense in which a shaft turns, seen from the side the drawing shows.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Clockwise.
    #[default]
    Clockwise,
    /// Counter-clockwise.
    CounterClockwise,
}

impl Direction {
    /// Sign: 1 counter-clockwise, -1 clockwise.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Clockwise => -1.0,
            Self::CounterClockwise => 1.0,
        }
    }
}

fn default_name() -> String {
    "three-arm".into()
}

fn default_arms() -> u32 {
    3
}

impl DesignSpec for ThreeArmDesign {
    const FAMILY: &'static str = "three-arm";
    const ABOUT: &'static str = "A three-arm transplanting mechanism.";
    const TEMPLATE: &'static str = include_str!("../../../design/three_arm.toml");
    const TABLES: &'static [&'static str] = &[
        "pitch",
        "tool",
        "teeth",
        "arm",
        "cam",
        "fork",
        "gearbox",
        "work",
        "tray",
        "seedling",
        "goals",
        "figure_goals",
        "optimise",
        "sun",
        "intermediate",
        "planet",
        "drawing",
    ];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()
    }

    fn key_of(word: &str) -> Option<String> {
        word.parse().ok().map(Parameter::key)
    }
}

impl ThreeArmDesign {
    /// Maximum number of arms of one carrier.
    pub const MAX_ARMS: u32 = 6;

    /// Makes a mechanism with the given sun, chain and arm; every other value is the default.
    #[must_use]
    pub fn new(pitch: PitchSpec, carrier_start: f64, bend: f64, arm: ArmSpec) -> Self {
        Self {
            name: default_name(),
            title: String::new(),
            arms: default_arms(),
            direction: Direction::default(),
            carrier_start,
            bend,
            planet_reference: None,
            tooth_count: None,
            center_distance: None,
            pitch,
            tool: ToolSpec::default(),
            shift: 0.0,
            teeth: TeethSpec::default(),
            arm,
            cam: None,
            fork: None,
            gearbox: GearboxSpec::default(),
            work: WorkSpec::default(),
            tray: TraySpec::default(),
            seedling: SeedlingSpec::default(),
            goals: GoalsSpec::default(),
            figure_goals: Named::new(),
            optimise: OptimiseSpec::default(),
            sun: BodySpec::default(),
            intermediate: BodySpec::default(),
            planet: BodySpec::default(),
            drawing: DrawingSpec::default(),
        }
    }

    /// Tooth count of every gear, from the mechanism or from its pitch curve.
    #[must_use]
    pub fn gear_tooth_count(&self) -> Option<u32> {
        self.tooth_count.or(self.pitch.tooth_count())
    }

    /// The gear pair of sun and intermediate gear. Planet and intermediate gear are the same pair, with the planet as its driver.
    #[must_use]
    pub fn pair(&self) -> GearPairDesign {
        GearPairDesign {
            name: self.name.clone(),
            title: self.title.clone(),
            tooth_count: self.tooth_count,
            center_distance: self.center_distance,
            tool: self.tool.clone(),
            teeth: self.teeth.clone(),
            driver: GearSpec {
                shift: Some(self.shift),
                body: self.sun.clone(),
                ..GearSpec::default()
            },
            driven: GearSpec {
                shift: Some(0.0 - self.shift),
                body: self.intermediate.clone(),
                ..GearSpec::default()
            },
            drawing: self.drawing.clone(),
            ..GearPairDesign::new(self.pitch.clone())
        }
    }

    /// Checks the rules that need no geometry: ranges, and keys that contradict each other.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault and the violated rule. The rules of the pitch curve are those of
    /// [`PitchSpec::resolve`].
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        count_in_range("arms", self.arms, 1, Self::MAX_ARMS)?;
        angle("carrier_start_deg", self.carrier_start)?;
        // A chain that is folded back puts the planet on the sun's axis.
        let bend = degrees::rounded(self.bend);
        in_range("bend_deg", bend, [-175.0, 175.0], " deg")?;
        if let Some(reference) = self.planet_reference {
            angle("planet_reference_deg", reference)?;
        }
        if let Some(z) = self.tooth_count {
            count_in_range("tooth_count", z, 3, 10_000)?;
            if let Some(of_pitch) = self.pitch.tooth_count()
                && z != of_pitch
            {
                return broken("tooth_count", Rule::ToothCountTwice(z, of_pitch));
            }
        }
        if let Some(a) = self.center_distance {
            positive("center_distance", a)?;
        }
        self.tool.validate().map_err(|e| e.inside("tool"))?;
        in_range("shift", self.shift, SHIFTS, "")?;
        self.teeth.validate().map_err(|e| e.inside("teeth"))?;
        if !self.teeth.fit.is_empty() {
            let rule = Rule::Unused(
                "here: fit two meshing gears of the train as a gear pair, and write the result into the design",
            );
            return broken("fit", rule).map_err(|e: SpecError| e.inside("teeth"));
        }
        self.arm.validate().map_err(|e| e.inside("arm"))?;
        if let Some(cam) = &self.cam {
            cam.validate().map_err(|e| e.inside("cam"))?;
        }
        if let Some(fork) = &self.fork {
            fork.validate().map_err(|e| e.inside("fork"))?;
        }
        self.gearbox.validate().map_err(|e| e.inside("gearbox"))?;
        self.work.validate().map_err(|e| e.inside("work"))?;
        self.tray.validate().map_err(|e| e.inside("tray"))?;
        self.seedling.validate().map_err(|e| e.inside("seedling"))?;
        self.goals.validate().map_err(|e| e.inside("goals"))?;
        check_goals("figure_goals", &self.figure_goals)?;
        let optimise = self.optimise.validate(self);
        optimise.map_err(|e| e.inside("optimise"))?;
        self.sun.validate().map_err(|e| e.inside("sun"))?;
        let intermediate = self.intermediate.validate();
        intermediate.map_err(|e| e.inside("intermediate"))?;
        self.planet.validate().map_err(|e| e.inside("planet"))?;
        self.drawing.validate().map_err(|e| e.inside("drawing"))
    }
}

/// Checks that an angle is within one turn in either direction.
fn angle(key: &str, radians: f64) -> Result<(), SpecError> {
    finite(key, radians)?;
    in_range(key, degrees::rounded(radians), [-360.0, 360.0], " deg")
}

/// Checks that the ends of a range are in order.
fn ordered(key: &str, [minimum, maximum]: [f64; 2]) -> Result<(), SpecError> {
    finite(key, minimum)?;
    finite(key, maximum)?;
    if minimum < maximum {
        Ok(())
    } else {
        broken(key, Rule::NotInOrder(minimum, maximum))
    }
}
