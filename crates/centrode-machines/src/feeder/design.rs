//! A feeder as the design file gives it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Dimension, DimensionSearchSpec, GearsSpec, PlatesSpec};
use centrode_kinematics::linkage::Branch;
use centrode_spec::goals::check_goals;
use centrode_spec::rule::{
    Rule, broken, count_in_range, design_name, finite, in_range, not_negative, positive,
    single_line,
};
use centrode_spec::{DesignSpec, DrawingSpec, FigureGoalSpec, Named, SpecError, degrees};

/// A feeder: a picking six-bar driven through an intermittent gear by a chain from a motor.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct FeederDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    #[serde(default = "default_name")]
    pub name: String,
    /// One line for drawings and reports.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// The six-bar.
    pub linkage: LinkageSpec,
    /// Ranges of the lengths.
    #[serde(default)]
    pub bounds: BoundsSpec,
    /// Goals of a good feeder.
    #[serde(default)]
    pub goals: FeederGoals,
    /// Goals for other figures of the check, by name.
    #[serde(default, skip_serializing_if = "Named::is_empty")]
    pub figure_goals: Named<FigureGoalSpec>,
    /// Motor, chain and receiving slots.
    #[serde(default)]
    pub drive: DriveSpec,
    /// The intermittent gear and its mate on the crank's shaft.
    #[serde(default)]
    pub gears: GearsSpec,
    /// The links as plates.
    #[serde(default)]
    pub plates: PlatesSpec,
    /// Accuracy with which the links are made.
    #[serde(default)]
    pub making: MakingSpec,
    /// Variables of a search.
    #[serde(default, skip_serializing_if = "DimensionSearchSpec::is_default")]
    pub optimise: DimensionSearchSpec,
    /// The drawing sheets.
    #[serde(default, skip_serializing_if = "DrawingSpec::is_default")]
    pub drawing: DrawingSpec,
}

/// The six-bar: a crank-rocker and an effector on a pivot of its own, moved by a slider at their common joint.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct LinkageSpec {
    /// Crank AB, mm; A is the origin.
    pub crank: f64,
    /// Coupler BC, mm.
    pub coupler: f64,
    /// Rocker CD, mm.
    pub rocker: f64,
    /// Frame AD, mm; D lies on the x axis.
    pub frame: f64,
    /// Assembly branch of the linkage: upper has C to the left of the way from B to D.
    #[serde(default)]
    pub branch: Branch,
    /// The effector's pivot F: x and y, mm.
    pub pivot: [f64; 2],
    /// Effector from F to its tip E, mm.
    pub effector_length: f64,
}

/// Minimum and maximum length of each link, mm; the defaults are those of the 2022 machine, its (18).
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct BoundsSpec {
    /// Crank.
    pub crank: [f64; 2],
    /// Coupler.
    pub coupler: [f64; 2],
    /// Rocker.
    pub rocker: [f64; 2],
    /// Frame.
    pub frame: [f64; 2],
}

/// Goals of a good feeder; the defaults are those of the 2022 machine.
///
/// Source: Ye et al. 2022, DOI 10.6041/j.issn.1000-1298.2022.05.010, (14) to (18) and section 5.2. The time
/// the pusher needs is not published.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct FeederGoals {
    /// Angle the effector is to swing, rad (degrees in the file).
    #[serde(rename = "swing_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub swing: f64,
    /// Maximum deviation of the swing from the required one, rad (degrees in the file).
    #[serde(rename = "swing_tolerance_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub swing_tolerance: f64,
    /// Minimum transmission angle between coupler and rocker, rad (degrees in the file).
    #[serde(rename = "transmission_angle_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub transmission_angle: f64,
    /// Minimum quick return: time of the feed stroke over that of the return.
    pub quick_return: f64,
    /// Cuttings per minute.
    pub feed_rate: f64,
    /// Time for which the effector must rest while it is filled, s.
    pub pushing_time: f64,
}

/// Motor, chain and receiving slots.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct DriveSpec {
    /// Speed of the motor, turns per minute.
    pub motor_rpm: f64,
    /// Turns of the motor for one of the intermittent gear.
    pub chain_ratio: f64,
    /// Cuttings the effector takes in one cycle.
    pub slots: u32,
    /// Mass the effector carries at its tip, kg.
    pub carried_mass: f64,
}

/// Accuracy with which the links are made: each dimension is uniformly distributed within plus or minus this.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MakingSpec {
    /// Tolerance of the four lengths, mm.
    pub length_tolerance: f64,
    /// Tolerance of both coordinates of the effector's pivot, mm.
    pub pivot_tolerance: f64,
}

fn default_name() -> String {
    "feeder".into()
}

impl Default for BoundsSpec {
    fn default() -> Self {
        Self {
            crank: [77.0, 81.0],
            coupler: [136.0, 147.0],
            rocker: [127.0, 138.0],
            frame: [100.0, 106.0],
        }
    }
}

impl Default for FeederGoals {
    fn default() -> Self {
        Self {
            swing: 180_f64.to_radians(),
            swing_tolerance: 0.5_f64.to_radians(),
            transmission_angle: 40_f64.to_radians(),
            quick_return: 1.0,
            feed_rate: 55.0,
            pushing_time: 1.0,
        }
    }
}

impl Default for DriveSpec {
    fn default() -> Self {
        Self {
            motor_rpm: 30.0,
            chain_ratio: 2.7,
            slots: 5,
            carried_mass: 0.0,
        }
    }
}

impl Default for MakingSpec {
    fn default() -> Self {
        Self {
            length_tolerance: 0.05,
            pivot_tolerance: 0.05,
        }
    }
}

impl BoundsSpec {
    /// Bounds of crank, coupler, rocker and frame, by name.
    #[must_use]
    pub fn named(&self) -> [(&'static str, [f64; 2]); 4] {
        [
            ("crank", self.crank),
            ("coupler", self.coupler),
            ("rocker", self.rocker),
            ("frame", self.frame),
        ]
    }

    fn validate(&self) -> Result<(), SpecError> {
        for (key, [minimum, maximum]) in self.named() {
            positive(key, minimum)?;
            finite(key, maximum)?;
            if minimum >= maximum {
                return broken(key, Rule::NotInOrder(minimum, maximum));
            }
        }
        Ok(())
    }
}

impl FeederGoals {
    fn validate(&self) -> Result<(), SpecError> {
        let degrees = |key, radians: f64, most: f64| {
            in_range(key, degrees::rounded(radians), [0.0, most], " deg")
        };
        positive("swing_deg", self.swing)?;
        degrees("swing_deg", self.swing, 360.0)?;
        positive("swing_tolerance_deg", self.swing_tolerance)?;
        degrees("swing_tolerance_deg", self.swing_tolerance, 180.0)?;
        degrees("transmission_angle_deg", self.transmission_angle, 90.0)?;
        not_negative("quick_return", self.quick_return)?;
        not_negative("feed_rate", self.feed_rate)?;
        not_negative("pushing_time", self.pushing_time)
    }
}

impl DesignSpec for FeederDesign {
    const FAMILY: &'static str = "feeder";
    const ABOUT: &'static str = "A willow-cutting feeder.";
    const TEMPLATE: &'static str = include_str!("../../design/feeder.toml");
    const TABLES: &'static [&'static str] = &[
        "linkage",
        "bounds",
        "goals",
        "figure_goals",
        "drive",
        "gears",
        "plates",
        "making",
        "optimise",
        "drawing",
    ];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()
    }

    fn key_of(word: &str) -> Option<String> {
        word.parse().ok().map(|d: Dimension| d.key().to_owned())
    }
}

impl FeederDesign {
    /// A feeder with this six-bar; every other value is the default.
    #[must_use]
    pub fn new(linkage: LinkageSpec) -> Self {
        Self {
            name: default_name(),
            title: String::new(),
            linkage,
            bounds: BoundsSpec::default(),
            goals: FeederGoals::default(),
            figure_goals: Named::new(),
            drive: DriveSpec::default(),
            gears: GearsSpec::default(),
            plates: PlatesSpec::default(),
            making: MakingSpec::default(),
            optimise: DimensionSearchSpec::default(),
            drawing: DrawingSpec::default(),
        }
    }

    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        let LinkageSpec {
            crank,
            coupler,
            rocker,
            frame,
            pivot: [x, y],
            effector_length,
            ..
        } = self.linkage;
        for (key, length) in [
            ("linkage.crank", crank),
            ("linkage.coupler", coupler),
            ("linkage.rocker", rocker),
            ("linkage.frame", frame),
            ("linkage.effector_length", effector_length),
        ] {
            positive(key, length)?;
        }
        finite("linkage.pivot", x)?;
        finite("linkage.pivot", y)?;
        self.bounds.validate().map_err(|e| e.inside("bounds"))?;
        self.goals.validate().map_err(|e| e.inside("goals"))?;
        check_goals("figure_goals", &self.figure_goals)?;
        positive("drive.motor_rpm", self.drive.motor_rpm)?;
        positive("drive.chain_ratio", self.drive.chain_ratio)?;
        count_in_range("drive.slots", self.drive.slots, 1, 1000)?;
        not_negative("drive.carried_mass", self.drive.carried_mass)?;
        self.gears.validate().map_err(|e| e.inside("gears"))?;
        self.plates.validate().map_err(|e| e.inside("plates"))?;
        // The plates must have material around the holes for the shafts.
        let bore = self.gears.bore;
        let beyond = 2.0 * self.gears.body().bore_reach() - bore;
        let widest = (0.9 * self.plates.width - beyond).max(0.0);
        in_range("gears.bore", bore, [0.0, widest], " mm")?;
        not_negative("making.length_tolerance", self.making.length_tolerance)?;
        not_negative("making.pivot_tolerance", self.making.pivot_tolerance)?;
        self.optimise.validate().map_err(|e| e.inside("optimise"))?;
        self.drawing.validate().map_err(|e| e.inside("drawing"))
    }
}
