use centrode_gear::{GearPair, PitchContact};
use centrode_geometry::Point;

use crate::contact::contour::Pose;

/// Maximum motion of the driven gear within its backlash, modules of path at a radius equal to the centre distance.
/// Beyond it the position of the law is used. A smaller limit would ignore a large backlash; a larger one accepts
/// rotations of gears whose normal passes close to the axis.
const MAX_TURN: f64 = 4.0;

/// Position of the driven gear within its backlash.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum BacklashPosition {
    /// At the law's angle, with half the backlash on either side.
    AtLaw,
    /// Pushed on (1) or back (-1), to the first order of the backlash.
    Pushed(f64),
}

impl BacklashPosition {
    /// The position in which flanks touch as designed, with the driver pushing forward (`sign` 1) or back (-1).
    pub(super) fn of(pair: &GearPair, sign: f64) -> Self {
        if pair.backlash() > 0.0 {
            Self::Pushed(sign)
        } else {
            Self::AtLaw
        }
    }

    /// The pose in this position at a contact of the pitch curves.
    pub(super) fn pose(self, pair: &GearPair, point: &PitchContact) -> Pose {
        let axis = Point::from(point.direction * pair.center_distance());
        Pose::about(axis, point.input + self.angle(pair, point))
    }

    /// Driven angle, rad.
    pub(super) fn angle(self, pair: &GearPair, point: &PitchContact) -> f64 {
        let law = point.driven_angle;
        match self {
            Self::AtLaw => law,
            Self::Pushed(sign) => {
                let turn = 0.5 * pair.backlash() / lever(pair, point, sign);
                // If the law's normal passes close to the axis, no rotation takes up the backlash.
                let is_turn =
                    turn >= 0.0 && turn * pair.center_distance() < MAX_TURN * pair.module();
                if is_turn { law - sign * turn } else { law }
            }
        }
    }
}

/// Distance of the driven axis from the line of action of the law, r2 cos(alpha -+ mu), with the driver pushing forward
/// (`sign` 1) or back (-1), mm.
pub(super) fn lever(pair: &GearPair, point: &PitchContact, sign: f64) -> f64 {
    let (sin, cos) = pair.pressure_angle().sin_cos();
    let (along, across) = point.inclination;
    point.radii[1] * (cos * along + sign * sin * across)
}
