mod boundary;
mod mesh;
mod ring;
mod round_end;

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use crate::{
    numeric::{Tolerance, gauss_legendre},
    solid::{Mesh, Shell, ShellBuilder, SolidError, VolumeMoments},
};
pub use boundary::TurnedEnd;
use round_end::Part;

/// Share of a length by which a cone may be off 45°: rounding.
const ROUNDING: f64 = 1e-9;

/// Body turned about the z axis: cylinders and cones of 45° one on the other, some of them with a slot along the x axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Turned {
    bottom: f64,
    sections: Vec<TurnedSection>,
    slot: Option<TurnedSlot>,
}

/// A cylinder or cone of a turned body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedSection {
    /// Length along the axis, mm.
    pub length: f64,
    /// Radius at its lower and its upper end, mm.
    pub radii: [f64; 2],
    /// Whether the slot goes through it.
    pub slotted: bool,
}

/// Slot of a turned body, with parallel walls beside the x axis and a plane floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedSlot {
    /// Distance of the walls, mm.
    pub width: f64,
    /// Distance of the floor from the axis, mm.
    pub foot: f64,
    /// Whether it ends half round, as an end mill leaves it, where a cylinder goes on without it; else its end is a plane.
    pub rounded: bool,
}

impl TurnedSection {
    /// A cylinder without the slot.
    #[must_use]
    pub fn cylinder(length: f64, radius: f64) -> Self {
        Self {
            length,
            radii: [radius; 2],
            slotted: false,
        }
    }

    /// The section with the slot through it.
    #[must_use]
    pub fn slotted(self) -> Self {
        Self {
            slotted: true,
            ..self
        }
    }

    fn least(&self) -> f64 {
        self.radii[0].min(self.radii[1])
    }
}

impl Turned {
    /// A body whose sections begin at a height, mm.
    ///
    /// # Errors
    /// [`SolidError::Turned`] with the first section that is no cylinder or cone of 45°, or that does not hold its slot.
    pub fn new(
        bottom: f64,
        sections: Vec<TurnedSection>,
        slot: Option<TurnedSlot>,
    ) -> Result<Self, SolidError> {
        let body = Self {
            bottom,
            sections,
            slot,
        };
        let wrong = (0..body.sections.len()).find(|&index| !body.is_sound(index));
        let none = body.sections.is_empty() || !bottom.is_finite();
        match wrong.or(none.then_some(0)) {
            Some(section) => Err(SolidError::Turned { section }),
            None => Ok(body),
        }
    }

    fn is_sound(&self, index: usize) -> bool {
        let section = self.sections[index];
        let [low, high] = section.radii;
        let sized = section.length > 0.0 && section.least() > 0.0;
        let finite = section.length.is_finite() && low.is_finite() && high.is_finite();
        let cone = ((high - low).abs() - section.length).abs() <= ROUNDING * section.length;
        if !sized || !finite || (low != high && !cone) {
            return false;
        }
        let Some(slot) = self.slot else {
            return !section.slotted;
        };
        if !(slot.width > 0.0 && slot.foot > 0.0) {
            return false;
        }
        let held = |radius: f64| self.edge(radius).is_some();
        if section.slotted {
            return section.radii.into_iter().all(held);
        }
        // Beside the slot a circle lies within its floor or holds it whole.
        let beside = [index.checked_sub(1), Some(index + 1)];
        let mut slotted = beside.into_iter().flatten();
        let beside_slot = slotted.any(|other| self.sections.get(other).is_some_and(|s| s.slotted));
        let clear = |radius: f64| radius < slot.foot || held(radius);
        !beside_slot || section.radii.into_iter().all(clear)
    }

    /// Distance along x of the slot's edges on a circle; none where the floor does not lie within it.
    fn edge(&self, radius: f64) -> Option<f64> {
        let slot = self.slot?;
        let squared = radius * radius - 0.25 * slot.width * slot.width;
        let edge = squared.max(0.0).sqrt();
        (edge > slot.foot).then_some(edge)
    }

    /// Heights of the ends of all sections, mm.
    #[must_use]
    pub fn levels(&self) -> Vec<f64> {
        let mut levels = vec![self.bottom];
        for section in &self.sections {
            levels.push(levels[levels.len() - 1] + section.length);
        }
        levels
    }

    /// Its sections.
    #[must_use]
    pub fn sections(&self) -> &[TurnedSection] {
        &self.sections
    }

    /// Volume, mm³, exact to rounding.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.parts()
            .iter()
            .map(|Part { section, end }| {
                let [low, high] = section.radii;
                let round = PI * section.length * (low * low + low * high + high * high) / 3.0;
                let Some(slot) = self.slot.filter(|_| section.slotted || end.is_some()) else {
                    return round;
                };
                let mut cut = 0.0;
                if end.is_some() {
                    slot.along_end(|_, weight, slot| cut += weight * slot.area(low));
                    return round - cut;
                }
                gauss_legendre(0.0, 1.0, |x, weight| {
                    cut += weight * slot.area(low + (high - low) * x);
                });
                round - section.length * cut
            })
            .sum()
    }

    /// Volume with its first and second moments about the origin, exact to rounding.
    #[must_use]
    pub fn moments(&self) -> VolumeMoments {
        let mut sum = VolumeMoments::default();
        let mut bottom = self.bottom;
        for Part { section, end } in self.parts() {
            let [low, high] = section.radii;
            if let (Some(slot), Some(from_below)) = (self.slot, end) {
                slot.along_end(|along, weight, slot| {
                    let z = match from_below {
                        true => bottom + along,
                        false => bottom + section.length - along,
                    };
                    let [area, first, xx, yy] = slot.moments(low).map(|cut| -weight * cut);
                    sum.volume += area;
                    sum.first += Vector3::new(first, 0.0, area * z);
                    let [xz, zz] = [first * z, area * z * z];
                    sum.second += Matrix3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz);
                });
            }
            let slot = self.slot.filter(|_| section.slotted);
            gauss_legendre(0.0, 1.0, |x, weight| {
                let (radius, z) = (low + (high - low) * x, bottom + section.length * x);
                let disc = PI * radius * radius;
                let quarter = 0.25 * disc * radius * radius;
                let cut = slot.map_or([0.0; 4], |slot| slot.moments(radius));
                let [area, first, xx, yy] = [disc, 0.0, quarter, quarter];
                let [area, first] = [area - cut[0], first - cut[1]];
                let [xx, yy] = [xx - cut[2], yy - cut[3]];
                let high = weight * section.length;
                sum.volume += area * high;
                sum.first += Vector3::new(first, 0.0, area * z) * high;
                let [xz, zz] = [first * z, area * z * z];
                sum.second += Matrix3::new(xx, 0.0, xz, 0.0, yy, 0.0, xz, 0.0, zz) * high;
            });
            bottom += section.length;
        }
        sum
    }

    /// Its boundary on exact surfaces; edges where the slot cuts a cone are polynomials within 1e-9 of their radius.
    #[must_use]
    pub fn shell(&self) -> Shell {
        let mut builder = ShellBuilder::default();
        self.close(&mut builder, [TurnedEnd::Flat, TurnedEnd::Flat]);
        builder.finish()
    }

    /// Closed triangle mesh within a tolerance, with outward normals.
    ///
    /// # Errors
    /// [`SolidError`] where the tolerance leaves no triangles.
    pub fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, SolidError> {
        mesh::mesh(self, tolerance)
    }
}

impl TurnedSlot {
    /// Area that the slot takes of a disc, mm².
    fn area(self, radius: f64) -> f64 {
        let half = 0.5 * self.width;
        let edge = (radius * radius - half * half).max(0.0).sqrt();
        let above = half * edge + radius * radius * (half / radius).min(1.0).asin();
        above - self.width * self.foot
    }

    /// Area that the slot takes of a disc, and the moments `∫ x dA`, `∫ x² dA`, `∫ y² dA` of it.
    fn moments(self, radius: f64) -> [f64; 4] {
        let (half, foot) = (0.5 * self.width, self.foot);
        let [mut first, mut xx, mut yy] = [0.0; 3];
        gauss_legendre(0.0, half, |y, weight| {
            let edge = (radius * radius - y * y).max(0.0).sqrt();
            // Both halves of the slot.
            first += weight * (edge.powi(2) - foot.powi(2));
            xx += weight * (edge.powi(3) - foot.powi(3)) * 2.0 / 3.0;
            yy += weight * (edge - foot) * 2.0 * y * y;
        });
        [self.area(radius), first, xx, yy]
    }
}

#[cfg(test)]
mod tests;
