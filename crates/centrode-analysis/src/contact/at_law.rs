//! Gears that stand at the law's angle: what needs no seat.

use centrode_geometry::{Point, Vector, checkpoint};
use centrode_mechanism::gear::PitchContact;

use super::{
    meshing::Meshing,
    places::{Place, ROUNDED, gaps},
    touch::{Pose, Stand, Touch},
};

/// Figures of gears that stand at the law's angle.
pub(super) struct AtLaw {
    /// Greatest sliding speed, by the driver's, of flanks that face each other as designed and push on; none where none do.
    pub(super) sliding: Option<f64>,
    /// Clearances of tips from roots and from fillets; none where the gears penetrate each other.
    pub(super) gaps: Option<[f64; 2]>,
}

impl Meshing<'_> {
    /// Greatest sliding speed, by the driver's, of flanks that face each other as designed at the law's angle; none where none do.
    pub(super) fn fastest(&self, places: &[Place], point: &PitchContact, sign: f64) -> Option<f64> {
        let facing = self.designed(places, sign).map(|place| place.touch);
        let facing = facing.filter(Touch::is_on_both);
        let (phi, a) = (point.input, self.pair.center_distance());
        let speeds = facing.map(|t| sliding(t.point, t.normal, phi, a, point.ratio()));
        speeds.reduce(f64::max)
    }

    /// Figures that hold at the law's angle alone, without seats.
    pub(super) fn at_law(&mut self, point: &PitchContact) -> AtLaw {
        checkpoint();
        let pose = Pose::at(self.pair, point, Stand::Law);
        let mut candidates = self.candidates(&pose);
        let places = self.places(&mut candidates, &pose);
        let rounded = -ROUNDED * self.module;
        let is_free = candidates.clash <= 0.0 && places.iter().all(|p| p.touch.gap >= rounded);
        AtLaw {
            sliding: self.fastest(&places, point, 1.0),
            gaps: is_free.then(|| gaps(&places, candidates.clash)),
        }
    }
}

/// Sliding speed of the gears in a contact per speed of the driver, mm/rad.
pub(super) fn sliding(point: Point, normal: Vector, phi: f64, a: f64, ratio: f64) -> f64 {
    let axis = Vector::new(a * phi.cos(), a * phi.sin());
    let arm = point.coords - axis;
    let across = |v: Vector| Vector::new(-v.y, v.x);
    let speed = across(axis) + across(arm) * (1.0 + ratio);
    speed.perp(&normal).abs()
}
