use centrode_gear::design::BodySpec;
use centrode_geometry::{Outline, Point};
use nalgebra::Isometry2;

/// Hole of a plate for a pin or a shaft.
#[derive(Clone, Debug, PartialEq)]
pub struct PinHole {
    /// Name of the point or joint.
    pub name: String,
    /// Position in the plate's axes, mm.
    pub at: Point,
    /// Diameter, keyway with its direction in the plate's axes, and tolerance classes; the bore is 0 for a point without a hole.
    pub hub: BodySpec,
}

impl PinHole {
    /// Contour of the hole in the plate's axes.
    #[must_use]
    pub fn outline(&self) -> Outline {
        let keyed = self.hub.keyway.and_then(|_| self.hub.bore_outline());
        match keyed {
            Some(keyed) => keyed.transformed(&Isometry2::translation(self.at.x, self.at.y)),
            None => Outline::circle(self.at, 0.5 * self.hub.bore),
        }
    }
}
