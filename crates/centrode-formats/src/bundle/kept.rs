//! Solids that a bundle holds as they are, not written in any format.

use super::Bundle;
use centrode_geometry::Solid;

impl Bundle {
    /// Keeps a part as it is.
    pub fn keep(&mut self, part: &str, solid: Solid) {
        self.solids.push((part.to_owned(), solid));
    }

    /// Parts kept as they are, by name, in order.
    #[must_use]
    pub fn into_solids(self) -> Vec<(String, Solid)> {
        self.solids
    }
}
