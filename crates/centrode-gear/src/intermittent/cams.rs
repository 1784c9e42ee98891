use std::f64::consts::{PI, TAU};

use centrode_geometry::{Outline, Point, Tolerance, Vector};

use super::pair::IntermittentPair;
use super::radial::Radial;
use super::{IntermittentPairError, Pins};
use crate::Member;
use centrode_kinematics::transmission::Transmission;

/// Corners of a polygon around a pin, circumscribed.
fn pin(center: Point, radius: f64) -> Vec<Point> {
    let radius = radius / (PI / f64::from(PIN_CORNERS)).cos();
    let corner = |i: u32| {
        let angle = TAU * f64::from(i) / f64::from(PIN_CORNERS);
        center + Vector::new(angle.cos(), angle.sin()) * radius
    };
    (0..PIN_CORNERS).map(corner).collect()
}

/// Cam next to the driver's teeth, and the pins by which the cam guides the driven gear while the gear starts or stops.
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    /// The cam in the driver's axes. Its clearance from a pin of nominal size is the same along the whole path: that which the
    /// backlash leaves at rest.
    pub outline: Outline,
    /// The pins in the driven gear's axes, one for each stop.
    pub pins: Vec<Point>,
    /// Radius of a pin, mm.
    pub pin_radius: f64,
}

/// Number of corners of the polygon around a pin. Fewer cut the cam deeper than necessary, because the polygon is
/// circumscribed; more take longer.
const PIN_CORNERS: u32 = 96;

impl IntermittentPair {
    /// Cuts the cams of entry and exit, one on each side of the teeth: on one side the pins of one cam would collide with the
    /// other cam.
    ///
    /// A pin has at least the clearance, along the normal of its path, that the backlash (rad) leaves at rest.
    pub(super) fn cut_cams(
        &self,
        pins: &Pins,
        backlash: f64,
        accuracy: Tolerance,
    ) -> Result<Vec<Cam>, IntermittentPairError> {
        let radius = 0.5 * pins.diameter.unwrap_or(2.5 * self.pair().module());
        let pitch = self.pair().rolling().pitch_length(Member::Driven) / TAU;
        let circle = 0.5 * pins.circle.unwrap_or(1.5 * pitch);
        let nearest = self.center_distance() - circle - radius;
        let hub = 0.5 * self.pair().driver().body().bore;
        if nearest <= hub {
            return Err(IntermittentPairError::PinMeetsHub { nearest, hub });
        }
        // The backlash of a pin at rest, along its line from the driver's axis: square to the cam.
        let at_rest =
            (self.center_distance() - circle * pins.angle.cos()).hypot(circle * pins.angle.sin());
        let clearance = backlash * circle * self.center_distance() * pins.angle.sin() / at_rest;
        let (entry, motion) = (self.law().entry, self.law().motion_angle());
        // Entry pins lie below the line of centres, where the driver's surface comes from; exit pins above.
        let ends = [(1.0, entry), (-1.0, motion - entry)];
        let cam = |(side, handed_over): (f64, f64)| {
            let places: Vec<Point> = (0..self.stops())
                .map(|stop| {
                    let turned = self.law().driven * f64::from(stop);
                    let direction = PI + side * pins.angle - turned;
                    Point::new(direction.cos(), direction.sin()) * circle
                })
                .collect();
            let bodies = |radius: f64| -> Vec<Vec<Point>> {
                places.iter().map(|&at| pin(at, radius)).collect()
            };
            // The cam reaches as far as its pin when the teeth take over.
            let at = self.mate(handed_over, self.law().at(handed_over).position) * places[0];
            let mut blank = Radial::unbounded();
            blank.limit(at.coords.norm());
            let turned = self.swept(blank, &bodies(radius), backlash, true);
            // Where a pin crosses the line of centres, a turn of the driven gear moves it along its path. There a wider pin gives
            // the clearance.
            let cam = self.swept(turned, &bodies(radius + clearance), 0.0, true);
            Cam {
                outline: Outline::polygon(&cam.polygon(accuracy)),
                pins: places,
                pin_radius: radius,
            }
        };
        Ok(ends.map(cam).into())
    }
}
