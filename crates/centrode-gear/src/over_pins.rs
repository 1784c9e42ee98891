mod space;

use centrode_geometry::{Point, bracketed_minimum};

use super::{
    pair::{Gear, GearPair},
    rolling::Member,
};

/// Measuring pins laid into every space of a gear, by which a workshop checks tooth thickness.
#[derive(Clone, Debug, PartialEq)]
pub struct OverPins {
    /// Diameter of the pin, mm.
    pub diameter: f64,
    /// The pin in each space; space k lies after tooth k in the order the teeth mesh.
    pub pins: Vec<Result<Pin, PinFault>>,
}

/// A pin at rest in a tooth space, touching both flanks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// Center of the pin in the gear's own frame, mm.
    pub center: Point,
    /// Contact points on the flanks, clockwise side first.
    pub contacts: [Point; 2],
    /// Measure over the pin: from the gear's axis to the far side of the pin, `|center| + diameter / 2`, mm.
    pub radial: f64,
}

/// Reason why a space cannot be measured with this pin.
#[derive(Clone, Copy, Debug, Eq, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PinFault {
    /// The pin is too small: it goes down past the flanks.
    #[error("the pin is too small for this space: it rests on the fillet or the root")]
    TooSmall,
    /// The pin is too large: it rests on the tips, or touches no flank above them.
    #[error("the pin is too large for this space: it rests on the tips of the teeth")]
    TooLarge,
    /// Another part of the gear blocks the pin before it touches both flanks.
    #[error("the pin cannot reach the flanks of this space: another part of the gear blocks it")]
    Blocked,
    /// There is no space: a tooth next to it has been cut off or has no flank.
    #[error("a tooth next to this space has no flank")]
    NoFlank,
}

impl OverPins {
    /// Space whose pin lies most nearly opposite that of space `k`, and the measure over both pins,
    /// `|c_k - c_j| + diameter`, mm. `None` where either cannot be measured.
    #[must_use]
    pub fn across(&self, k: usize) -> Option<(usize, f64)> {
        let pin = self.pins.get(k)?.ok()?;
        let opposite = -pin.center.coords.normalize();
        let turned = |p: &Pin| p.center.coords.normalize().dot(&opposite);
        let others = self.pins.iter().enumerate();
        let (j, other) = others
            .filter_map(|(j, p)| p.ok().map(|p| (j, p)))
            .max_by(|a, b| turned(&a.1).total_cmp(&turned(&b.1)))?;
        (j != k).then(|| (j, self.distance(&pin, &other)))
    }

    /// Measure over the pins of two spaces, mm; `None` where either cannot be measured.
    #[must_use]
    pub fn over(&self, k: usize, j: usize) -> Option<f64> {
        let pin = |space: usize| self.pins.get(space)?.ok();
        Some(self.distance(&pin(k)?, &pin(j)?))
    }

    fn distance(&self, one: &Pin, other: &Pin) -> f64 {
        (other.center - one.center).norm() + self.diameter
    }
}

impl GearPair {
    /// Pins of a member's usual diameter in teeth of the maximum and the minimum thickness that [`PlannedPair::thickness_deviations`](crate::PlannedPair::thickness_deviations)
    /// allow. `None` if the pair has no thickness deviations.
    ///
    /// A deviation E along the pitch curve moves each flank by `E cos(alpha) / 2` along its normal, because the flanks of an
    /// involute tool are equidistant.
    #[must_use]
    pub fn pin_limits(&self, member: Member) -> Option<[OverPins; 2]> {
        let limits = self.thickness_deviations(member)?.limits;
        let (gear, diameter) = (self.gear(member), self.pin_diameter(member));
        let normal = 0.5 * self.pressure_angle().cos();
        Some(limits.map(|deviation| gear.pins_next_to(diameter, normal * deviation)))
    }

    /// Diameter of the measuring pin for a member, mm: as written in the design, or the pin that would touch a straight flank on
    /// the pitch curve, `space width / cos alpha`, rounded to an available pin (steps of 0.25 mm from 1 mm on, of 0.05 mm below).
    #[must_use]
    pub fn pin_diameter(&self, member: Member) -> f64 {
        if let Some(written) = self.written_pin_diameter() {
            return written;
        }
        let gear = self.gear(member);
        let pitch = gear.pitch_length() / f64::from(gear.tooth_count());
        // Widths on the pitch curve: the crossings already include backlash and profile shift.
        let widths = gear
            .teeth()
            .iter()
            .map(|t| (t.trailing.crossing - t.leading.crossing).abs());
        let width = widths.sum::<f64>() / f64::from(gear.tooth_count());
        let ideal = (pitch - width) / self.pressure_angle().cos();
        let step = if ideal < 1.0 { 0.05 } else { 0.25 };
        ((ideal / step).round() * step).max(step)
    }
}

impl Gear {
    /// A pin of this diameter (mm) laid into every space, solved on the finished outline to the float
    /// limit: its center lies half a diameter from both flanks.
    ///
    /// A space that cannot be measured has the reason instead; a diameter that is not a positive number
    /// fits no space.
    #[must_use]
    pub fn over_pins(&self, diameter: f64) -> OverPins {
        self.pins_next_to(diameter, 0.0)
    }

    /// Pins of a diameter between flanks that are moved along their normals into the spaces, mm.
    fn pins_next_to(&self, diameter: f64, moved: f64) -> OverPins {
        let radius = 0.5 * diameter;
        let far = radius + moved;
        let pins = self.spaces().into_iter().map(|walls| {
            let walls = walls.ok_or(PinFault::NoFlank)?;
            if !(diameter.is_finite() && diameter > 0.0 && far > 0.0) {
                return Err(PinFault::TooSmall);
            }
            let pin = walls.rest(far)?;
            if !self.is_clear(&pin, far.min(radius)) {
                return Err(PinFault::Blocked);
            }
            let contact = |flank: Point| flank + (pin.center - flank) * (moved / far);
            Ok(Pin {
                contacts: pin.contacts.map(contact),
                radial: pin.radial - moved,
                ..pin
            })
        });
        OverPins {
            diameter,
            pins: pins.collect(),
        }
    }

    /// Whether no part of the gear reaches into the pin.
    fn is_clear(&self, pin: &Pin, radius: f64) -> bool {
        /// Number of intervals of a segment in each of which its distance from the pin has at most one minimum. Fewer
        /// can miss a minimum, more take longer.
        const SAMPLES: u32 = 8;
        let clear = radius * (1.0 - 1e-9);
        self.outline().segments().iter().all(|segment| {
            let distance = |u: f64| (segment.at(u).point - pin.center).norm();
            let reach = (segment.end() - segment.start()).norm();
            // Farther away than twice its chord plus the pin's radius: a segment bends less than that.
            if distance(0.0) > 2.0 * reach + radius {
                return true;
            }
            let step = 2.0 / f64::from(SAMPLES);
            (0..SAMPLES).all(|i| {
                let low = -1.0 + step * f64::from(i);
                bracketed_minimum(distance, low, low + step).1 >= clear
            })
        })
    }
}

#[cfg(test)]
mod tests;
