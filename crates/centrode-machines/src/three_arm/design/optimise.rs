use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ThreeArmDesign, ordered};
use crate::three_arm::Parameter;
use centrode_gear::pitch::PitchSpec;
use centrode_spec::rule::{broken, finite, not_negative};
use centrode_spec::{Rule, SpecError};

/// Variables of a search, their bounds, and the objective beyond the goals.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct OptimiseSpec {
    /// Objective among the designs that reach every goal.
    pub objective: Objective,
    /// Parameters that stay as they are; else the control points, carrier start, bend, and the arm's three sizes move, and
    /// the working points that are given.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hold: Vec<Parameter>,
    /// Minimum and maximum value of parameters, rad and mm (degrees in the file). The others move in either direction: radii of
    /// control points by 65 % of their mean, their angles by 15 degrees, sizes of the arm by 25 %, other angles by 40
    /// degrees.
    #[serde(with = "bounds", skip_serializing_if = "BTreeMap::is_empty")]
    #[schemars(with = "BTreeMap<Parameter, [f64; 2]>")]
    pub bounds: BTreeMap<Parameter, [f64; 2]>,
    /// Whether gears keep their tooth count; else they have as many teeth as leave the required module.
    pub hold_tooth_count: bool,
    /// Minimum depth of the tip's loop beyond the point of picking, into the tray, mm.
    pub picking_depth: f64,
    /// Minimum clearance of the arm's housing from the tray, mm.
    pub tray_clearance: f64,
}

/// Objective among the designs that reach every goal.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, JsonSchema, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Objective {
    /// Minimum change of the parameters: root mean square of their moves as shares of their bounds.
    #[default]
    MinimumChange,
    /// Minimum speed of the tip at picking.
    PickingSpeed,
    /// Maximum margin of the goal reached most narrowly.
    Margin,
}

/// Minimum radius of a control point in a search without bounds for it, as a share of the mean radius.
const MIN_RADIUS: f64 = 0.2;

impl OptimiseSpec {
    /// Whether all values of the table are defaults.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Checks that the ranges are in order, and that the design has the parameters.
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self, design: &ThreeArmDesign) -> Result<(), SpecError> {
        for (parameter, &range) in &self.bounds {
            let key = format!("bounds.{parameter}");
            ordered(&key, range)?;
            if parameter.of(design).is_none() {
                return broken(
                    &key,
                    Rule::Needed("in the design, so that a search can vary it"),
                );
            }
        }
        finite("picking_depth", self.picking_depth)?;
        not_negative("tray_clearance", self.tray_clearance)
    }
}

impl ThreeArmDesign {
    /// Variables of a search, with their minimum and maximum value (rad, mm).
    #[must_use]
    pub fn free_parameters(&self) -> Vec<(Parameter, [f64; 2])> {
        let radii: &[f64] = match &self.pitch {
            PitchSpec::Bspline(spline) => &spline.radius,
            _ => &[],
        };
        let points = radii.len().min(99) as u8;
        let mean = radii.iter().sum::<f64>() / radii.len() as f64;
        let points = (0..points).flat_map(|i| [Parameter::Radius(i), Parameter::Angle(i)]);
        let usual = points.chain([
            Parameter::CarrierStart,
            Parameter::Bend,
            Parameter::MountingAngle,
            Parameter::TipDistance,
            Parameter::PusherOffset,
            Parameter::Picking,
            Parameter::Planting,
        ]);
        let spec = &self.optimise;
        let requested = spec.bounds.keys().copied();
        let mut all: Vec<Parameter> = usual.chain(requested).collect();
        all.sort_unstable();
        all.dedup();
        all.retain(|parameter| !spec.hold.contains(parameter));
        let room = |parameter: Parameter| {
            let value = parameter.of(self)?;
            let about = match parameter {
                Parameter::Radius(_) => 0.65 * mean,
                Parameter::Angle(_) => 15.0_f64.to_radians(),
                Parameter::TipDistance | Parameter::PusherOffset => 0.25 * value.abs(),
                _ => 40.0_f64.to_radians(),
            };
            let low = match parameter {
                Parameter::Radius(_) => (value - about).max(MIN_RADIUS * mean),
                _ => value - about,
            };
            let given = spec.bounds.get(&parameter).copied();
            Some((parameter, given.unwrap_or([low, value + about])))
        };
        all.into_iter().filter_map(room).collect()
    }
}

/// Conversion of the bounds: angles are degrees in the file.
mod bounds {
    use std::collections::BTreeMap;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Parameter;
    use centrode_spec::degrees;

    type Bounds = BTreeMap<Parameter, [f64; 2]>;

    pub(super) fn serialize<S: Serializer>(bounds: &Bounds, s: S) -> Result<S::Ok, S::Error> {
        let written: Bounds = bounds
            .iter()
            .map(|(&parameter, &range)| match parameter.is_angle() {
                true => (parameter, range.map(degrees::written)),
                false => (parameter, range),
            })
            .collect();
        written.serialize(s)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(d: D) -> Result<Bounds, D::Error> {
        let mut bounds = Bounds::deserialize(d)?;
        for (parameter, range) in &mut bounds {
            if parameter.is_angle() {
                *range = range.map(f64::to_radians);
            }
        }
        Ok(bounds)
    }
}
