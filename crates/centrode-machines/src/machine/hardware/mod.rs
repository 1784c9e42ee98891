//! Hardware around gears and cams: which parts the program designs.

pub(super) mod axis_list;
pub(super) mod frame;
pub(super) mod layers;
pub(super) mod pieces;
pub(super) mod pins;
pub(super) mod plates;
pub(super) mod shaft_parts;
pub(super) mod shafts;
pub(super) mod sizes;
pub(super) mod slots;
pub(super) mod spacing;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::machine::{MachineBodySpec, MachineDesign, MachinePlatesSpec};

/// Extent of the design around gears and cams.
#[derive(Clone, Copy, Debug, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Hardware {
    /// Nothing: bodies are kinematic, without plates, pins and shafts. Gears and cams are made.
    None,
    /// Plates and levers, gears and cams. What joins them is listed axis by axis; it and the frame come from the customer.
    List,
    /// Plates, gears and cams, the frame, and the pins, shafts and rings that join them.
    Full,
}

impl MachineDesign {
    /// Extent of plates, pins and shafts: as given. By default it is a list if the design describes plates or needs their masses,
    /// otherwise none.
    #[must_use]
    pub fn hardware(&self) -> Hardware {
        let mut bodies = self.bodies.values();
        let default = || {
            let weighs = self.gravity.is_some()
                || bodies.any(|body| body.mass_kg.is_some() && body.inertia_kg_mm2.is_none());
            match self.describes_plates() || weighs {
                true => Hardware::List,
                false => Hardware::None,
            }
        };
        self.hardware.unwrap_or_else(default)
    }

    /// Whether the design describes plates or pins: `plates` differs from the default, or a body has a layer, an outline, a
    /// circle or a size.
    fn describes_plates(&self) -> bool {
        let describes = |body: &MachineBodySpec| {
            body.layer.is_some()
                || !body.outline.is_empty()
                || body.corner_radius.is_some()
                || body.circle.is_some()
                || body.width.is_some()
                || body.thickness.is_some()
        };
        let is_drawn = self.frame.drawn().is_given() || self.frame.thickness.is_some();
        is_drawn
            || self.plates != MachinePlatesSpec::default()
            || self.bodies.values().any(describes)
    }
}
