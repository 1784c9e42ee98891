//! Base tangent length of circular gears: tooth thickness measured over several teeth.

use std::f64::consts::TAU;

use super::{GearPair, Member, Side};

/// Distance of two parallel planes that touch opposite flanks of a circular gear over several teeth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseTangent {
    /// Number of teeth between the planes, k.
    pub teeth: u32,
    /// Distance of the planes, mm.
    pub length: f64,
}

/// Reason why a gear has no base tangent length.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BaseTangentFault {
    /// The flanks are not involutes of one base circle.
    #[error(
        "the pitch curve is not a circle, so its flanks have no base circle: measure over pins"
    )]
    NotCircular,
    /// Undercut leaves no flank.
    #[error("undercut leaves no flank to measure")]
    NoFlank,
    /// The flanks are too short.
    #[error(
        "the flanks are too short for a base tangent over any number of teeth: measure over pins"
    )]
    NoCount,
}

impl GearPair {
    /// Base tangent length (Wildhaber span) of a circular gear over k teeth, mm: what a disc micrometer measures.
    ///
    /// `W_k = m cos(alpha) (pi (k - 1/2) + z inv(alpha) + 2 x tan(alpha)) - j / 2`, where alpha is the pressure angle of the tool
    /// and j the normal backlash of the pair. Backlash thins each tooth by `j / (2 cos(alpha))` on the reference circle, so by
    /// `j / 2` on the base circle. Both contacts are `sqrt(r_b^2 + W_k^2 / 4)` from the axis. Of all k with these on the flanks,
    /// the one whose contacts are nearest to the radius `m z / 2 + x m` is chosen.
    ///
    /// # Errors
    /// [`BaseTangentFault`] with the reason why the gear cannot be measured so.
    pub fn base_tangent(&self, member: Member) -> Result<BaseTangent, BaseTangentFault> {
        if !self.rolling().is_round() {
            return Err(BaseTangentFault::NotCircular);
        }
        let gear = self.gear(member);
        let flank = |side| self.flank_radii(member, 0, side);
        let (Some(leading), Some(trailing)) = (flank(Side::Leading), flank(Side::Trailing)) else {
            return Err(BaseTangentFault::NoFlank);
        };
        let (angle, radius) = (self.pressure_angle(), gear.pitch_length() / TAU);
        let base = radius * angle.cos();
        // Along the base circle: thickness of a tooth, and pitch.
        let tooth = &gear.teeth()[0];
        let width = tooth.trailing.crossing - tooth.leading.crossing;
        let thickness = angle.cos() * width + 2.0 * base * (angle.tan() - angle);
        let pitch = TAU * base / f64::from(gear.tooth_count());
        // Number of teeth of the length with contacts at a radius.
        let count = |contact: f64| {
            let length = 2.0 * (contact * contact - base * base).max(0.0).sqrt();
            1.0 + (length - thickness) / pitch
        };
        let fewest = count(leading[0].max(trailing[0])).ceil().max(1.0);
        let most = count(leading[1].min(trailing[1])).floor();
        if fewest > most {
            return Err(BaseTangentFault::NoCount);
        }
        let usual = 0.5 * self.reference_diameter(member) + self.teeth().profile_shift(member);
        let teeth = count(usual).round().clamp(fewest, most);
        Ok(BaseTangent {
            teeth: teeth as u32,
            length: thickness + (teeth - 1.0) * pitch,
        })
    }
}
