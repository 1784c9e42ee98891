//! Figures of the gear pairs of a composed machine.

use std::sync::Arc;

use crate::machine::{Machine, MachineError, MachineFigure};
use centrode_gear::GearPair;

/// Figures of a pair that goals can name, by their keys in the pair's check.
pub const PAIR_FIGURES: [&str; 26] = [
    "backlash_max",
    "backlash_min",
    "center_distance",
    "clearance_min",
    "contact_ratio_mean",
    "driven_curvature_max",
    "driven_curvature_min",
    "driven_fillet_radius_min",
    "driven_radius_max",
    "driven_radius_min",
    "driven_tip_width_min",
    "driver_curvature_max",
    "driver_curvature_min",
    "driver_fillet_radius_min",
    "driver_radius_max",
    "driver_radius_min",
    "driver_tip_width_min",
    "fillet_clearance_min",
    "largest_module",
    "module",
    "pairs_in_contact_max",
    "pairs_in_contact_min",
    "penetration_max",
    "pressure_angle_max",
    "sliding_max",
    "transmission_error_max",
];

impl Machine {
    /// Pairs of the machine's gears, each once.
    #[must_use]
    pub fn pairs(&self) -> Vec<&Arc<GearPair>> {
        let mut pairs: Vec<&Arc<GearPair>> = Vec::new();
        for gear in self.gears() {
            if !pairs.iter().any(|pair| pair.name() == gear.pair.name()) {
                pairs.push(&gear.pair);
            }
        }
        pairs
    }

    /// A figure of a pair, `pair(name).figure`; `None` if the words have another form.
    pub(in crate::machine) fn figure_of_pair(
        &self,
        key: &str,
        words: &str,
    ) -> Option<Result<MachineFigure, MachineError>> {
        let (name, word) = words.strip_prefix("pair(")?.split_once(").")?;
        let refused = |why: String| MachineError::refused(key, why);
        let pairs = self.pairs();
        let name = name.trim();
        let Some(pair) = pairs.iter().position(|pair| pair.name() == name) else {
            let known: Vec<&str> = pairs.iter().map(|pair| pair.name()).collect();
            return Some(Err(refused(format!(
                "no gears use a pair {name}; pairs in use are {}",
                known.join(", ")
            ))));
        };
        let found = PAIR_FIGURES.iter().find(|figure| **figure == word);
        Some(match found {
            Some(&figure) => Ok(MachineFigure::OfPair { pair, figure }),
            None => Err(refused(format!(
                "a pair has no figure {word}; known are {}",
                PAIR_FIGURES.join(", ")
            ))),
        })
    }
}
