use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use centrode_geometry::piece_ends;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EllipticDrive, Load, Schedule, ShaftError, SpiralShaft, SpiralShaftDesign};
use centrode_gear::design::{BodySpec, GearPairDesign, GearSpec, SHIFTS, TeethSpec, ToolSpec};
use centrode_gear::pitch::{Ellipse, PitchSpec};
use centrode_kinematics::machine::{GuideForce, Keyway};
use centrode_kinematics::transmission::{MotionJet, Transmission};
use centrode_spec::goals::check_search;
use centrode_spec::rule::{
    Rule, broken, count_in_range, design_name, in_range, is_zero, positive, single_line,
};
use centrode_spec::{DesignSpec, FigureGoalSpec, Named, SpecError};

/// Number of equal parts of a turn in each of which a stroke has few extremes.
const PARTS: u32 = 16;

/// Scheme by which the box is slowed down while a seedling is picked.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// The shaft's groove.
    #[default]
    Shaft,
    /// Pair of elliptic gears that drives a plain shaft.
    EllipticGear,
    /// Pair of elliptic gears that drives a variable shaft.
    Both,
}

/// Pair of elliptic gears that drives the shaft, ratio 1.
///
/// Of `eccentricity`, `speed_ratio` and `moved_distance` exactly one is given.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct EllipticGears {
    /// Eccentricity of the pitch ellipses.
    pub eccentricity: Option<f64>,
    /// Maximum speed of the shaft over its minimum.
    pub speed_ratio: Option<f64>,
    /// Distance a plain shaft must move the box in the window, mm.
    pub moved_distance: Option<f64>,
    /// Module, mm.
    pub module: f64,
    /// Teeth of each gear.
    pub tooth_count: u32,
    /// The tool that cuts both gears.
    pub tool: ToolSpec,
    /// Profile shift coefficient of the driver; the driven gear has the opposite one.
    #[serde(skip_serializing_if = "is_zero")]
    pub shift: f64,
    /// Teeth of both gears.
    pub teeth: TeethSpec,
    /// Body of both gears; without a bore of its own, with that and the keyway of the shaft's journal.
    pub body: BodySpec,
}

impl Default for EllipticGears {
    fn default() -> Self {
        Self {
            eccentricity: None,
            speed_ratio: None,
            moved_distance: None,
            module: 2.25,
            tooth_count: 23,
            tool: ToolSpec::default(),
            shift: 0.0,
            teeth: TeethSpec::default(),
            body: BodySpec::default(),
        }
    }
}

impl EllipticGears {
    /// Checks the ranges, and that the eccentricity is given once.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        if let Some(k) = self.eccentricity {
            in_range("eccentricity", k, [0.0, 0.95], "")?;
        }
        if let Some(ratio) = self.speed_ratio {
            in_range("speed_ratio", ratio, [1.0, 100.0], "")?;
        }
        if let Some(moved) = self.moved_distance {
            positive("moved_distance", moved)?;
        }
        let given = [
            ("eccentricity", self.eccentricity),
            ("speed_ratio", self.speed_ratio),
            ("moved_distance", self.moved_distance),
        ];
        let mut given = given.iter().filter(|(_, value)| value.is_some());
        match (given.next(), given.next()) {
            (Some((first, _)), Some((key, _))) => return broken(key, Rule::Excludes(first)),
            (None, _) => {
                let rule = Rule::NeedsOneOf("eccentricity, speed_ratio and moved_distance");
                return broken("eccentricity", rule);
            }
            _ => {}
        }
        positive("module", self.module)?;
        count_in_range("tooth_count", self.tooth_count, 3, 10_000)?;
        self.tool.validate().map_err(|e| e.inside("tool"))?;
        in_range("shift", self.shift, SHIFTS, "")?;
        self.teeth.validate().map_err(|e| e.inside("teeth"))?;
        self.body.validate().map_err(|e| e.inside("body"))
    }

    /// Drive of the shaft, slowest at `pick` (rad).
    fn drive(&self, shaft: &SpiralShaftDesign) -> Result<EllipticDrive, ShaftError> {
        let drive = match (self.eccentricity, self.speed_ratio, self.moved_distance) {
            (Some(eccentricity), ..) => EllipticDrive {
                eccentricity,
                phase: 0.0,
            },
            (_, Some(ratio), _) => EllipticDrive::for_speed_ratio(ratio)?,
            (.., moved) => {
                let moved = moved.unwrap_or_default();
                EllipticDrive::for_moved_distance(moved, shaft.window, shaft.lead)?
            }
        };
        Ok(EllipticDrive {
            phase: shaft.pick,
            ..drive
        })
    }
}

/// A seedling box moved at a variable speed, as written.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MovingBoxDesign {
    /// Short name, used for file names: letters, digits, `-` and `_`.
    pub name: String,
    /// One line for drawings and reports.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Scheme that slows the box down.
    pub scheme: Scheme,
    /// The elliptic gears, for the schemes that have them.
    pub gears: Option<EllipticGears>,
    /// The shaft.
    pub shaft: SpiralShaftDesign,
    /// Goals by name.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub goals: Named<FigureGoalSpec>,
    /// Numbers that a search may move, by their keys in quotes, each with its minimum and maximum value.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub vary: Named<[f64; 2]>,
}

impl Default for MovingBoxDesign {
    fn default() -> Self {
        Self {
            name: "moving-box".into(),
            title: String::new(),
            scheme: Scheme::default(),
            gears: None,
            shaft: SpiralShaftDesign::default(),
            goals: Named::new(),
            vary: Named::new(),
        }
    }
}

impl DesignSpec for MovingBoxDesign {
    const FAMILY: &'static str = "moving-box";
    const ABOUT: &'static str = "A seedling box moved at a variable speed.";
    const TEMPLATE: &'static str = include_str!("../design/moving_box.toml");
    const TABLES: &'static [&'static str] = &["gears", "shaft", "goals", "vary"];

    fn words(&self) -> [&str; 2] {
        [&self.name, &self.title]
    }

    fn rules(&self) -> Result<(), SpecError> {
        self.validate()
    }
}

impl MovingBoxDesign {
    /// Checks the rules that need no geometry.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self) -> Result<(), SpecError> {
        design_name(&self.name)?;
        single_line("title", &self.title)?;
        match (self.scheme, &self.gears) {
            (Scheme::Shaft, Some(_)) => {
                return broken("gears", Rule::Excludes("scheme = \"shaft\""));
            }
            (Scheme::EllipticGear | Scheme::Both, None) => {
                return broken("gears", Rule::Needed("for this scheme"));
            }
            (_, Some(gears)) => gears.validate().map_err(|e| e.inside("gears"))?,
            _ => {}
        }
        self.shaft.validate().map_err(|e| e.inside("shaft"))?;
        let of_shaft = [
            ("shaft.goals", self.shaft.goals.is_empty()),
            ("shaft.vary", self.shaft.vary.is_empty()),
        ];
        if let Some((key, _)) = of_shaft.into_iter().find(|(_, is_empty)| !is_empty) {
            return broken(
                key,
                Rule::Unused("inside the shaft of a moving box: write it without \"shaft.\""),
            );
        }
        check_search(&self.goals, &self.vary)
    }

    /// The gear pair of the scheme, the driver's far apex on the line of centres at the slow point.
    ///
    /// The driven gear sits on the shaft's near journal. Unless their body has a bore, both gears have the journal's diameter as
    /// bore, and the hub's keyway for the journal's key. The driven gear's keyway is where that key is when the shaft turns
    /// slowest at the drive's phase: half a turn and the phase behind the gear's x axis.
    #[must_use]
    pub fn gear_pair(&self, drive: &EllipticDrive) -> Option<GearPairDesign> {
        let gears = self.gears.as_ref()?;
        let mut pair = GearPairDesign::new(PitchSpec::Ellipse(Ellipse {
            eccentricity: drive.eccentricity,
            module: Some(gears.module),
            tooth_count: Some(gears.tooth_count),
            ..Ellipse::default()
        }));
        pair.name = format!("{}-gears", self.name);
        pair.tool = gears.tool.clone();
        pair.teeth = gears.teeth.clone();
        let mut body = gears.body.clone();
        if body.bore == 0.0 {
            body.bore = self.shaft.body.journal_diameter;
            body.keyway = body.keyway.or(self.shaft.body.keyway.map(Keyway::of_hub));
        }
        pair.driver = GearSpec {
            shift: Some(gears.shift),
            body: body.clone(),
            ..GearSpec::default()
        };
        pair.driven.shift = Some(0.0 - gears.shift);
        pair.driven.body = BodySpec {
            keyway_angle: PI - (TAU - body.keyway_angle + drive.phase).rem_euclid(TAU),
            ..body
        };
        pair.drawing = self.shaft.drawing.clone();
        Some(pair)
    }
}

/// A moving box: the shaft, its drive, and the box's motion as a function of the machine's input.
#[derive(Clone, Debug)]
pub struct MovingBox {
    design: MovingBoxDesign,
    shaft: SpiralShaft,
    drive: Option<EllipticDrive>,
    motion: Arc<dyn Transmission>,
}

impl MovingBox {
    /// Resolves a design.
    ///
    /// # Errors
    /// [`ShaftError`] naming the violated rule and its numbers; its key is that inside `shaft` or `gears`.
    pub fn resolve(design: &MovingBoxDesign) -> Result<Self, ShaftError> {
        design.validate()?;
        let shaft = SpiralShaft::resolve(&design.shaft).map_err(|e| e.inside("shaft"))?;
        let law = shaft.law();
        let steady = law.fastest().value - law.slowest().value <= 1e-12 * law.mean_speed();
        if design.scheme == Scheme::EllipticGear && !steady {
            let rule = Rule::Excludes("scheme = \"elliptic-gear\", whose shaft is plain");
            broken("shaft.law", rule)?;
        }
        let drive = match &design.gears {
            Some(gears) => {
                let drive = gears.drive(&design.shaft);
                Some(drive.map_err(|e| e.inside("gears"))?)
            }
            None => None,
        };
        let traverse = Arc::new(shaft.traverse().clone());
        let motion: Arc<dyn Transmission> = match drive {
            Some(drive) => Arc::new(Driven { drive, traverse }),
            None => traverse,
        };
        Ok(Self {
            design: design.clone(),
            shaft,
            drive,
            motion,
        })
    }

    /// The design as written.
    #[must_use]
    pub fn design(&self) -> &MovingBoxDesign {
        &self.design
    }

    /// The shaft.
    #[must_use]
    pub fn shaft(&self) -> &SpiralShaft {
        &self.shaft
    }

    /// The turn of the shaft by the gears; `None` if the box has no gears.
    #[must_use]
    pub fn drive(&self) -> Option<&EllipticDrive> {
        self.drive.as_ref()
    }

    /// Turn of the shaft at an input, rad.
    #[must_use]
    pub fn shaft_turn(&self, input: f64) -> MotionJet {
        match &self.drive {
            Some(drive) => drive.at(input),
            None => MotionJet::uniform(input, 1.0),
        }
    }

    /// Motion of the box by the machine's input, mm and rad.
    #[must_use]
    pub fn motion(&self) -> &Arc<dyn Transmission> {
        &self.motion
    }

    /// Distance the box moves in the window around the first picking, mm, in full stroke.
    #[must_use]
    pub fn moved_in_window(&self) -> f64 {
        let design = self.shaft.design();
        let (middle, half) = (design.pick, 0.5 * design.window);
        let turn = |input: f64| self.shaft_turn(input).position;
        self.shaft
            .law()
            .moved(turn(middle - half), turn(middle + half))
    }

    /// Hole picked at each pick, by the machine's input.
    #[must_use]
    pub fn schedule(&self) -> Schedule {
        let design = self.shaft.design();
        let turn = |input: f64| self.shaft_turn(input).position;
        Schedule::driven(self.shaft.traverse(), design.pick, design.window, turn)
    }

    /// Motion of a stroke, as if it had no end, by the machine's input.
    #[must_use]
    pub fn stroke_at(&self, input: f64) -> MotionJet {
        let turn = self.shaft_turn(input);
        self.shaft.law().at(turn.position).after(&turn)
    }

    /// Inputs of one turn of a stroke, from the pick on, between which its motion is smooth and short.
    #[must_use]
    pub fn stroke_pieces(&self) -> Vec<f64> {
        // The gears turn the shaft by the input at the pick.
        let pick = self.shaft.design().pick;
        let mut ends = self.shaft.law().pieces(pick);
        if let Some(drive) = &self.drive {
            ends = ends.iter().map(|&theta| drive.input_at(theta)).collect();
        }
        piece_ends(pick, pick + TAU, PARTS, &ends)
    }

    /// Forces on the slider at an input, with a load whose speed is that of the input.
    #[must_use]
    pub fn force(&self, input: f64, load: &Load) -> GuideForce {
        let turn = self.shaft_turn(input);
        let groove = self.shaft.groove();
        load.force(
            self.motion.at(input),
            groove.lead_angle(turn.position),
            groove.radius(),
        )
    }
}

/// Traverse driven by gears.
#[derive(Debug)]
struct Driven {
    drive: EllipticDrive,
    traverse: Arc<super::Traverse>,
}

impl Transmission for Driven {
    fn at(&self, input: f64) -> MotionJet {
        let turn = self.drive.at(input);
        self.traverse.at(turn.position).after(&turn)
    }

    fn period(&self) -> f64 {
        self.traverse.period()
    }

    fn breaks(&self) -> Vec<f64> {
        let turns = self.traverse.turns();
        let mut breaks: Vec<f64> = self
            .traverse
            .breaks()
            .into_iter()
            .map(|theta| {
                self.drive
                    .input_at(theta)
                    .rem_euclid(TAU * f64::from(turns))
            })
            .collect();
        breaks.sort_by(f64::total_cmp);
        breaks
    }
}
