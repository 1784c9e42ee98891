use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Dimension, FeederDesign};
use centrode_spec::rule::{Rule, broken, count_in_range, not_negative, positive};
use centrode_spec::{SpecError, degrees};

/// Variables of a search for better dimensions, their resolution, and the end of the search.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct DimensionSearchSpec {
    /// Dimensions that stay as they are; the other lengths move within `bounds`.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub hold: Vec<Dimension>,
    /// Whether the pivot is a variable too. Any lengths reach the required swing for some pivot, so its displacement
    /// must be penalised.
    pub free_pivot: bool,
    /// Deviation of the swing that a millimetre of the pivot's displacement counts as, rad (degrees in the file).
    #[serde(rename = "pivot_weight_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub pivot_weight: f64,
    /// Maximum displacement of a free pivot along x and along y, either way, mm.
    pub pivot_room: f64,
    /// Decimals of the dimensions found, mm: 9 for a swing to a millionth of a degree, 2 for a drawing.
    pub decimals: u32,
    /// Deviation of the swing at which a search ends, rad (degrees in the file).
    #[serde(rename = "accuracy_deg", with = "degrees")]
    #[schemars(with = "f64")]
    pub accuracy: f64,
}

impl Default for DimensionSearchSpec {
    fn default() -> Self {
        Self {
            hold: Vec::new(),
            free_pivot: false,
            pivot_weight: 0.0,
            pivot_room: 20.0,
            decimals: 9,
            accuracy: 1e-6_f64.to_radians(),
        }
    }
}

impl DimensionSearchSpec {
    /// Whether all values of the table are defaults.
    pub(super) fn is_default(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn validate(&self) -> Result<(), SpecError> {
        not_negative("pivot_weight_deg", self.pivot_weight)?;
        if self.free_pivot && self.pivot_weight <= 0.0 {
            let why = "above zero if the pivot is free: for lengths of any size some pivot gives the required swing, 180 deg everywhere on the chord between the slider's dead centres, so the swing alone does not determine the lengths";
            return broken("pivot_weight_deg", Rule::Needed(why));
        }
        positive("pivot_room", self.pivot_room)?;
        count_in_range("decimals", self.decimals, 0, 12)?;
        positive("accuracy_deg", self.accuracy)
    }
}

impl FeederDesign {
    /// Variables of a search, with their minimum and maximum value, mm.
    #[must_use]
    pub fn free_dimensions(&self) -> Vec<(Dimension, [f64; 2])> {
        let spec = &self.optimise;
        let bounds = |dimension: Dimension| match dimension {
            Dimension::Crank => self.bounds.crank,
            Dimension::Coupler => self.bounds.coupler,
            Dimension::Rocker => self.bounds.rocker,
            Dimension::Frame => self.bounds.frame,
            Dimension::PivotX | Dimension::PivotY => {
                let at = dimension.of(&self.linkage);
                [at - spec.pivot_room, at + spec.pivot_room]
            }
        };
        let moves = |dimension: &Dimension| {
            !spec.hold.contains(dimension) && (spec.free_pivot || !dimension.is_of_pivot())
        };
        let free = Dimension::ALL.into_iter().filter(moves);
        free.map(|dimension| (dimension, bounds(dimension)))
            .collect()
    }
}
