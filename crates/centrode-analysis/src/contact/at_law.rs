//! Clearances with the driven gear at the law's angle, which needs no seat.

use centrode_gear::PitchContact;
use centrode_geometry::checkpoint;

use super::{
    meshing::Meshing,
    places::{ROUNDED, gaps},
    touch::{Pose, Stand},
};

impl Meshing<'_> {
    /// Clearances of tips from roots and from fillets with the driven gear at the law's angle, without seats; `None` if the gears
    /// penetrate each other there.
    pub(super) fn gaps_at_law(&mut self, point: &PitchContact) -> Option<[f64; 2]> {
        checkpoint();
        let pose = Pose::at(self.pair, point, Stand::Law);
        let mut candidates = self.candidates(&pose);
        let places = self.places(&mut candidates, &pose);
        let rounded = -ROUNDED * self.module;
        let is_free = candidates.clash <= 0.0 && places.iter().all(|p| p.touch.gap >= rounded);
        is_free.then(|| gaps(&places, candidates.clash))
    }
}
