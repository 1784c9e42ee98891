//! Sliding speed of the teeth in contact.

use centrode_gear::{PitchContact, Role};
use centrode_geometry::{Point, Vector};

use super::{
    body::GearOutline,
    meshing::Meshing,
    places::{Kind, Place},
    seat::Seat,
    touch::{Pose, Stand},
};

/// The part itself where it is one of a flank, or the one before it: a corner is at the start of its part.
fn of_flank(body: &GearOutline<'_>, part: usize) -> Option<usize> {
    let count = body.parts.len();
    let mut parts = [part, (part + count - 1) % count].into_iter();
    parts.find(|&part| body.parts[part].role == Role::Flank)
}

impl Meshing<'_> {
    /// Maximum sliding speed per driver speed, mm/rad, with the driver pushing on (`sign` 1) or back (-1): of the flanks that touch as
    /// designed or, where none do, of the edges at the seat.
    ///
    /// Flanks that face each other at the law's angle, with half the backlash between them, are followed to where they touch.
    pub(super) fn sliding(
        &self,
        places: &[Place],
        point: &PitchContact,
        sign: f64,
        seat: &Seat,
    ) -> f64 {
        let a = self.pair.center_distance();
        let pose = Pose::at(self.pair, point, Stand::of(self.pair, sign));
        let near = self.unsure();
        let facing = places
            .iter()
            .filter(|p| p.kind == Kind::Flanks && sign * p.touch.lever > 0.0);
        let on_flanks = facing.filter_map(|place| {
            let (i, j) = place.parts;
            let parts = (of_flank(&self.driver, i)?, of_flank(&self.driven, j)?);
            let (_, touch) = self.along_flanks(parts, place.touch.at, &pose)?;
            let touches = touch.is_on_both() && touch.gap.abs() < near;
            touches.then(|| speed(touch.point, touch.normal, point.input, a))
        });
        let touches = seat.touches.iter();
        let on_edges = touches.map(|&(at, normal)| speed(at, normal, point.input, a));
        let fastest = on_flanks
            .reduce(f64::max)
            .or_else(|| on_edges.reduce(f64::max));
        fastest.map_or(0.0, |speed| speed.max(0.0))
    }
}

/// Sliding speed of the gears in a contact per speed of the driver, mm/rad, by the point on the driver and the normal there.
///
/// Along the normal the gears have no speed against each other, which gives the ratio: with the driven gear held at its seat within
/// the backlash, or by an edge, it is not quite that of the law.
fn speed(point: Point, normal: Vector, phi: f64, a: f64) -> f64 {
    let across = |v: Vector| Vector::new(-v.y, v.x);
    let axis = Vector::new(a * phi.cos(), a * phi.sin());
    let [of_axis, of_arm] = [axis, point.coords - axis].map(across);
    let relative = of_axis - of_arm * (of_axis.dot(&normal) / of_arm.dot(&normal));
    relative.perp(&normal).abs()
}
