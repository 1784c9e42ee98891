//! Solids that a bundle contains as solids, not written in any format.

use super::Bundle;
use centrode_geometry::Solid;

impl Bundle {
    /// Adds a part as a solid.
    pub fn keep(&mut self, part: &str, solid: Solid) {
        self.solids.push((part.to_owned(), solid));
    }

    /// Parts added as solids, with their names, in order.
    #[must_use]
    pub fn into_solids(self) -> Vec<(String, Solid)> {
        self.solids
    }
}
