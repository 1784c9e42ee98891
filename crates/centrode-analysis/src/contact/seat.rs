use centrode_geometry::{Point, Vector};

use super::{
    hit::Hit,
    proof::{Feature, Meeting},
};

/// Seat of the driven gear pushed to one side.
pub(super) struct Seat {
    pub(super) angle: f64,
    /// Distance of the driven axis from the common normal, mm.
    pub(super) lever: f64,
    pub(super) contacts: u32,
    /// Points on the driver and its outward normals there, one a pair of teeth.
    pub(super) touches: Vec<(Point, Vector)>,
    /// Driven angle from which the contacts were found, rad.
    pub(super) start: f64,
    pub(super) hits: Vec<Hit>,
}

impl Seat {
    /// Features that meet in its contacts.
    pub(super) fn features(&self) -> Vec<(Feature, Meeting)> {
        self.hits
            .iter()
            .flat_map(|hit| hit.features(self.start))
            .collect()
    }
}
