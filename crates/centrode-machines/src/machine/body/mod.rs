//! Bodies as written in the design file.

pub(super) mod contour;
pub(super) mod corner;
pub(super) mod given_mass;
pub(super) mod points;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::body::contour::Drawn;
use crate::machine::body::corner::points;
use crate::machine::body::given_mass::GivenMass;
use crate::machine::hardware::plates::LAYERS;
use crate::machine::{
    CornerSpec, MachineCircleSpec, MachineCornerSpec, MachineLawSpec, MachineMeshSpec,
};
use centrode_spec::Named;
use centrode_spec::rule::{Rule, broken, finite, in_range, positive};
use centrode_spec::{SpecError, degrees};

/// A body of a composed machine: turning on a pin, sliding along a line, fixed to another body or made by a dyad.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct MachineBodySpec {
    /// Point of another body on which it turns, or from which it slides: `frame.O`; with a mesh, the body that carries it.
    pub on: Option<String>,
    /// Direction in which it slides, in the axes of the body that carries it, rad (degrees in the file); by default it turns.
    #[serde(rename = "slides_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub slides: Option<f64>,
    /// Body, or point of a body, to which it is fixed: its origin.
    pub fixed_to: Option<String>,
    /// Turn of its axes against those of the body it is fixed to, rad (degrees in the file).
    #[serde(rename = "turned_deg", with = "degrees")]
    #[schemars(with = "Option<f64>")]
    pub turned: Option<f64>,
    /// Position of its plate along the shafts, counted from the one next to the frame, which is in layer -1: below it are the
    /// gears; default: plates stack in order.
    pub layer: Option<i32>,
    /// Whether it is drawn as a plate; by default it is.
    pub plate: Option<bool>,
    /// Corners of its plate in order, in the body's axes, mm; default: the plate is drawn round its points.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<MachineCornerSpec>,
    /// Radius to which the corners of its outline are rounded, mm.
    pub corner_radius: Option<f64>,
    /// Circle that its plate is.
    pub circle: Option<MachineCircleSpec>,
    /// Width of its plate round its points, mm; default: that of all plates.
    pub width: Option<f64>,
    /// Thickness of its plate, mm; default: that of all plates.
    pub thickness: Option<f64>,
    /// Mass without its gears, kg; default: that of its plate.
    pub mass_kg: Option<f64>,
    /// Centre of mass of a given mass: x and y in the body's axes, mm; default: that of its plate, or the origin.
    pub center: Option<[f64; 2]>,
    /// Moment of inertia of a given mass about its centre, kg mm²; default: that of the plate at the given mass.
    pub inertia_kg_mm2: Option<f64>,
    /// Motion of a body that turns or slides.
    pub law: Option<MachineLawSpec>,
    /// Mesh that turns it on its carrier, and places it there.
    pub mesh: Option<MachineMeshSpec>,
    /// Points by name: x and y in the body's axes, mm.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub points: Named<[f64; 2]>,
    /// Points by name, each the third corner of a triangle.
    #[serde(skip_serializing_if = "Named::is_empty")]
    pub corners: Named<CornerSpec>,
}

impl MachineBodySpec {
    pub(in crate::machine) fn validate(&self) -> Result<(), SpecError> {
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
                Rule::Needed("for a body that turns or slides without a mesh"),
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
                Rule::Unused("except for a body that is fixed_to another"),
            );
        }
        for (key, angle) in [("slides_deg", self.slides), ("turned_deg", self.turned)] {
            finite(key, angle.unwrap_or(0.0))?;
        }
        if let Some(layer) = self.layer {
            in_range("layer", layer.into(), LAYERS, "")?;
        }
        if let Some(law) = &self.law {
            let slides = self.slides.is_some();
            law.validate(slides).map_err(|e| e.inside("law"))?;
        }
        self.as_drawn()?;
        points(&self.points, &self.corners)
    }

    /// Checks the plate and the mass of the body.
    fn as_drawn(&self) -> Result<(), SpecError> {
        let drawn = self.drawn();
        drawn.validate()?;
        if !self.has_plate() {
            let keys = [
                ("outline", !self.outline.is_empty()),
                ("circle", self.circle.is_some()),
                ("width", self.width.is_some()),
                ("thickness", self.thickness.is_some()),
                ("layer", self.layer.is_some()),
            ];
            if let Some((key, _)) = keys.into_iter().find(|(_, given)| *given) {
                return broken(key, Rule::Unused("for a body without a plate"));
            }
        }
        if self.width.is_some() && drawn.is_given() {
            return broken("width", Rule::Unused("except for a plate round points"));
        }
        for (key, value) in [("width", self.width), ("thickness", self.thickness)] {
            positive(key, value.unwrap_or(1.0))?;
        }
        Ok(())
    }

    /// Whether the body has a plate.
    pub(in crate::machine) fn has_plate(&self) -> bool {
        self.plate != Some(false)
    }

    pub(in crate::machine) fn drawn(&self) -> Drawn<'_> {
        Drawn {
            outline: &self.outline,
            corner_radius: self.corner_radius,
            circle: self.circle.as_ref(),
        }
    }

    pub(in crate::machine) fn given_mass(&self) -> GivenMass {
        GivenMass {
            mass: self.mass_kg,
            center: self.center,
            inertia: self.inertia_kg_mm2,
        }
    }
}
