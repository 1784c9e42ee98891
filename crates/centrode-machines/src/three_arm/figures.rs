use std::f64::consts::{PI, TAU};

use centrode_geometry::Vector;

use super::ThreeArm;
use centrode_gear::Member;

/// Figures that the goals of a mechanism limit; angles in rad, lengths in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Elevation of the clamp above the horizontal at picking, seen from the machine towards the tray.
    pub pick_angle: f64,
    /// Depression of the clamp below the horizontal at planting.
    pub push_angle: f64,
    /// Turn of the clamp from picking to planting: the sum of both.
    pub angle_difference: f64,
    /// Clearance of the turning gearbox above the ground.
    pub gearbox_clearance: f64,
    /// Height of the tip's path in the machine's frame.
    pub trajectory_height: f64,
    /// Length of the pitch curve, divided by pi and the tooth count, mm; `None` if there is no tooth count.
    pub module: Option<f64>,
}

impl ThreeArm {
    /// Elevation of an arm's clamp above the horizontal, seen from the machine towards the tray, in (-pi, pi], rad.
    #[must_use]
    pub fn clamp_elevation(&self, input: f64, arm: u32) -> f64 {
        self.chain(arm, input).clamp_elevation()
    }

    /// Height of the ground in the machine's frame, mm. The lowest point of the tip is below it by the planting depth.
    #[must_use]
    pub fn ground(&self) -> f64 {
        self.trajectory().lowest.reach + self.design().work.planting_depth
    }

    /// Direction in which arms enter the tray.
    #[must_use]
    pub fn tray_direction(&self) -> Vector {
        let (sin, cos) = self.design().tray.inclination.sin_cos();
        Vector::new(-self.train().sign() * cos, sin)
    }

    /// Depth of the tip's loop beyond the point of picking, mm, in the direction in which arms enter the tray.
    #[must_use]
    pub fn picking_depth(&self) -> f64 {
        let picked = self.tip(self.picking(0), 0).position.coords;
        self.trajectory().farthest.reach - picked.dot(&self.tray_direction())
    }

    /// Radius of the circle that the gearbox sweeps around the carrier's axis, mm.
    ///
    /// Around every axis the housing is larger than the largest pitch radius by its offset.
    #[must_use]
    pub fn gearbox_radius(&self) -> f64 {
        let (_, sun) = self.rolling().radii(Member::Driver);
        let (_, intermediate) = self.rolling().radii(Member::Driven);
        let design = self.design();
        swept_radius(self.center_distance(), design.bend, sun, intermediate)
            + design.gearbox.housing_offset
    }

    /// Figures that the goals limit.
    #[must_use]
    pub fn figures(&self) -> Figures {
        let pick_angle = self.clamp_elevation(self.picking(0), 0);
        let push_angle = -self.clamp_elevation(self.planting(0), 0);
        Figures {
            pick_angle,
            push_angle,
            angle_difference: pick_angle + push_angle,
            gearbox_clearance: -self.gearbox_radius() - self.ground(),
            trajectory_height: self.trajectory().height(),
            module: self.module(),
        }
    }
}

/// Elevation of a direction above the horizontal, seen in the direction of -`sign` x.
pub(super) fn elevation(direction: f64, sign: f64) -> f64 {
    let seen = if sign > 0.0 {
        PI - direction
    } else {
        direction
    };
    seen - TAU * ((seen - PI) / TAU).ceil()
}

/// Radius swept by the gears about the carrier's axis, mm. Each gear counts as a circle of its maximum radius; the planet has the
/// radius of the sun.
pub(super) fn swept_radius(a: f64, bend: f64, sun: f64, intermediate: f64) -> f64 {
    // The planet's axis is 2 a cos(bend/2) from the sun's.
    let planet = 2.0 * a * (0.5 * bend).cos() + sun;
    sun.max(a + intermediate).max(planet)
}
