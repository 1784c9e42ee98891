use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use centrode_kinematics::machine::screw_size;
use centrode_spec::SpecError;
use centrode_spec::rule::{not_negative, positive, single_line};

/// The parts of an arm, around its planet's axis and along its pusher's axis.
///
/// The arm's frame: the planet's axis is the origin, x points along the pusher's axis the way the clamp
/// points. A point behind another is at a smaller x.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
#[schemars(extend("x-detail" = true))]
pub struct ArmBodySpec {
    /// Housing that encloses cam, fork and spring.
    pub housing: HousingSpec,
    /// Clamp that holds the seedling.
    pub clamp: ClampSpec,
    /// Push rod that opens the clamp and pushes the seedling out.
    pub push_rod: PushRodSpec,
    /// Spring that throws the push rod out.
    pub spring: SpringSpec,
}

/// The housing: a belt around a drum on the planet's axis and a tube on the pusher's axis.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct HousingSpec {
    /// Outer radius of the drum, mm: room for cam and fork.
    pub drum_radius: f64,
    /// Outer radius of the tube, mm: room for spring and rod.
    pub tube_radius: f64,
    /// Distance of the centre of the tube's rounded rear end behind the planet's axis, mm.
    pub tube_back: f64,
    /// Width along the planet's axis, mm.
    pub width: f64,
    /// Thickness of walls and covers, mm.
    pub wall: f64,
    /// Diameter of the bore for the planet's shaft, mm; 0 for none.
    pub bore: f64,
    /// Diameter of the hole in the rear cover for the sleeve that carries the cam, mm; 0 for none.
    pub sleeve_bore: f64,
    /// Nominal diameter of the screws of the covers, ISO 4762, mm: 3 for M3, 0 for none; default: the largest no thicker than a
    /// cover that finds room.
    pub screw: Option<f64>,
    /// Heat treatment of housing and covers, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
}

impl Default for HousingSpec {
    fn default() -> Self {
        Self {
            drum_radius: 32.0,
            tube_radius: 13.0,
            tube_back: 10.0,
            width: 36.0,
            wall: 3.0,
            bore: 12.0,
            sleeve_bore: 17.0,
            screw: None,
            heat_treatment: String::new(),
        }
    }
}

/// The clamp: two thin spring flakes, one behind the other as seen along the planet's axis.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClampSpec {
    /// Height of a flake where it leaves the housing, mm.
    pub root_height: f64,
    /// Height of a flake at its tip, mm.
    pub tip_height: f64,
    /// Thickness of a flake, mm.
    pub thickness: f64,
    /// Distance between the flakes when open, mm.
    pub opening: f64,
    /// Heat treatment of the flakes, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
}

impl Default for ClampSpec {
    fn default() -> Self {
        Self {
            root_height: 12.0,
            tip_height: 6.0,
            thickness: 1.5,
            opening: 14.0,
            heat_treatment: String::new(),
        }
    }
}

/// The push rod with the pusher on its end.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct PushRodSpec {
    /// Diameter of the rod, mm.
    pub diameter: f64,
    /// Distance by which the rod is drawn back when it holds no seedling out, mm.
    pub stroke: f64,
    /// Height of the pusher on its end, mm.
    pub pusher_height: f64,
    /// Length of the pusher along the rod, mm.
    pub pusher_length: f64,
    /// Heat treatment of the rod, for the drawing; empty if there is none.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub heat_treatment: String,
}

impl Default for PushRodSpec {
    fn default() -> Self {
        Self {
            diameter: 5.0,
            stroke: 25.0,
            pusher_height: 5.5,
            pusher_length: 3.0,
            heat_treatment: String::new(),
        }
    }
}

/// The coil spring around the rod in the housing's tube.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpringSpec {
    /// Outer diameter of the coil, mm.
    pub outer_diameter: f64,
    /// Diameter of the wire, mm.
    pub wire_diameter: f64,
    /// Length with the rod thrown out, mm.
    pub length: f64,
    /// Force with the rod thrown out, N.
    pub preload: f64,
    /// Stiffness, N/mm.
    pub rate: f64,
}

impl Default for SpringSpec {
    fn default() -> Self {
        Self {
            outer_diameter: 14.0,
            wire_diameter: 1.6,
            length: 45.0,
            preload: 20.0,
            rate: 1.2,
        }
    }
}

impl ArmBodySpec {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault. Whether the parts fit one another is checked by
    /// [`ArmBody::new`](super::ArmBody::new).
    pub fn validate(&self) -> Result<(), SpecError> {
        for (key, size) in [
            ("housing.drum_radius", self.housing.drum_radius),
            ("housing.tube_radius", self.housing.tube_radius),
            ("housing.width", self.housing.width),
            ("housing.wall", self.housing.wall),
            ("clamp.root_height", self.clamp.root_height),
            ("clamp.tip_height", self.clamp.tip_height),
            ("clamp.thickness", self.clamp.thickness),
            ("push_rod.diameter", self.push_rod.diameter),
            ("push_rod.pusher_height", self.push_rod.pusher_height),
            ("push_rod.pusher_length", self.push_rod.pusher_length),
            ("spring.outer_diameter", self.spring.outer_diameter),
            ("spring.wire_diameter", self.spring.wire_diameter),
            ("spring.length", self.spring.length),
        ] {
            positive(key, size)?;
        }
        for (key, size) in [
            ("housing.tube_back", self.housing.tube_back),
            ("housing.bore", self.housing.bore),
            ("housing.sleeve_bore", self.housing.sleeve_bore),
            ("clamp.opening", self.clamp.opening),
            ("push_rod.stroke", self.push_rod.stroke),
            ("spring.preload", self.spring.preload),
            ("spring.rate", self.spring.rate),
        ] {
            not_negative(key, size)?;
        }
        for (key, word) in [
            ("housing.heat_treatment", &self.housing.heat_treatment),
            ("clamp.heat_treatment", &self.clamp.heat_treatment),
            ("push_rod.heat_treatment", &self.push_rod.heat_treatment),
        ] {
            single_line(key, word)?;
        }
        screw_size("housing.screw", self.housing.screw)
    }

    /// Width and height of the bore for the push rod in the housing's front, mm: equal to the rod, which slides in it.
    #[must_use]
    pub fn rod_bore(&self) -> f64 {
        self.push_rod.diameter
    }

    /// Position of the push rod's rear end along the pusher's axis with the rod thrown out, mm. Drawn back, the rod ends
    /// just inside the tube's rounded rear wall.
    pub(crate) fn rod_end(&self) -> f64 {
        let housing = &self.housing;
        self.push_rod.stroke - housing.tube_back - 0.9 * (housing.tube_radius - housing.wall)
    }

    /// The arm with all sizes and forces multiplied by `k`; the stiffness of the spring is unchanged.
    #[must_use]
    pub fn scaled(&self, k: f64) -> Self {
        Self {
            housing: HousingSpec {
                drum_radius: k * self.housing.drum_radius,
                tube_radius: k * self.housing.tube_radius,
                tube_back: k * self.housing.tube_back,
                width: k * self.housing.width,
                wall: k * self.housing.wall,
                bore: k * self.housing.bore,
                sleeve_bore: k * self.housing.sleeve_bore,
                ..self.housing.clone()
            },
            clamp: ClampSpec {
                root_height: k * self.clamp.root_height,
                tip_height: k * self.clamp.tip_height,
                thickness: k * self.clamp.thickness,
                opening: k * self.clamp.opening,
                ..self.clamp.clone()
            },
            push_rod: PushRodSpec {
                diameter: k * self.push_rod.diameter,
                stroke: k * self.push_rod.stroke,
                pusher_height: k * self.push_rod.pusher_height,
                pusher_length: k * self.push_rod.pusher_length,
                ..self.push_rod.clone()
            },
            spring: SpringSpec {
                outer_diameter: k * self.spring.outer_diameter,
                wire_diameter: k * self.spring.wire_diameter,
                length: k * self.spring.length,
                preload: k * self.spring.preload,
                rate: self.spring.rate,
            },
        }
    }
}
