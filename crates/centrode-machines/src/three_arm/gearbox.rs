use centrode_geometry::{Outline, Point};
use nalgebra::Rotation2;

use super::{ThreeArm, ThreeArmLink};
use centrode_gear::Member;
use centrode_kinematics::machine::{Bearing, Fastening};

/// Body of the carrier: a plate on each side of the gears, with a hole at every axis.
#[derive(Clone, Debug)]
pub struct GearboxBody {
    /// Contour, counter-clockwise, in the carrier's frame.
    pub outline: Outline,
    /// Holes for sun, intermediate gears and planets, as wide as their bores or the bearings on their shafts.
    pub holes: Vec<Outline>,
    /// Spans of the plates along the sun's axis, mm, from the rear faces of the gears: the rear one, then
    /// the front one.
    pub spans: [[f64; 2]; 2],
}

impl ThreeArm {
    /// Position of a link's axis in the carrier's frame, mm; it is fixed there.
    #[must_use]
    pub fn on_carrier(&self, link: ThreeArmLink) -> Point {
        let carrier = self.link(ThreeArmLink::Carrier, 0.0).angle.position;
        Rotation2::new(-carrier) * self.link(link, 0.0).origin.position
    }

    /// Circles around all axes in the carrier's frame, with the largest pitch radius plus an offset, mm.
    pub(super) fn around_gears(&self, offset: f64) -> Vec<(Point, f64)> {
        let radius = |member| self.rolling().radii(member).1 + offset;
        let (sun, intermediate) = (radius(Member::Driver), radius(Member::Driven));
        let chains = (0..self.arms()).flat_map(|k| {
            let middle = self.on_carrier(ThreeArmLink::Intermediate(k));
            let outer = self.on_carrier(ThreeArmLink::Planet(k));
            [(middle, intermediate), (outer, sun)]
        });
        std::iter::once((Point::origin(), sun))
            .chain(chains)
            .collect()
    }

    /// The carrier's plates: a belt around circles about every axis, with the largest pitch radius plus the housing's offset;
    /// `None` if the circles have no belt.
    #[must_use]
    pub fn gearbox(&self) -> Option<GearboxBody> {
        let design = self.design();
        let around = self.around_gears(design.gearbox.housing_offset);
        let mut holes = vec![(Point::origin(), design.sun.bore)];
        for k in 0..self.arms() {
            let middle = self.on_carrier(ThreeArmLink::Intermediate(k));
            let outer = self.on_carrier(ThreeArmLink::Planet(k));
            holes.extend([
                (middle, design.intermediate.bore),
                (outer, design.planet.bore),
            ]);
        }
        let bodies = [&design.sun, &design.intermediate, &design.planet];
        let width = bodies.iter().map(|b| b.width).fold(0.0, f64::max);
        let (clearance, wall) = (design.gearbox.clearance, design.gearbox.wall);
        let front = width + clearance;
        Some(GearboxBody {
            outline: Outline::hull(&around)?,
            holes: holes
                .into_iter()
                .filter(|(_, bore)| *bore > 0.0)
                .map(|(center, bore)| {
                    let bearing = self.bearing(bore);
                    Outline::circle(center, 0.5 * bearing.map_or(bore, |bearing| bearing.outer))
                })
                .collect(),
            spans: [[-clearance - wall, -clearance], [front, front + wall]],
        })
    }

    /// Bearing in the carrier's plates on a shaft of a diameter, mm; `None` if the design has no bearings, or if no bearing is as
    /// narrow as the plates are thick.
    #[must_use]
    pub fn bearing(&self, bore: f64) -> Option<Bearing> {
        let gearbox = &self.design().gearbox;
        Bearing::for_bore(bore, gearbox.wall).filter(|_| gearbox.bearings)
    }

    /// Distance of the middle of the arms' housings from the rear faces of the gears, mm. Between them are the gearbox's front
    /// plate, a clearance equal to that of the gears, and the heads of the covers' screws.
    #[must_use]
    pub fn arm_level(&self) -> f64 {
        let design = self.design();
        let bodies = [&design.sun, &design.intermediate, &design.planet];
        let width = bodies.iter().map(|b| b.width).fold(0.0, f64::max);
        let (gearbox, housing) = (&design.gearbox, self.arm_sizes().housing);
        let heads = Fastening::highest_head(housing.screw, housing.wall);
        width + 2.0 * gearbox.clearance + gearbox.wall + heads + 0.5 * housing.width
    }
}
