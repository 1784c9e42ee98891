//! Bodies turned about the z axis: cylinders and cones of 45°, with a slot along the axis.
//!
//! Reading order: this file (sections, slot, volume), [`round_end`] (half-round ends of a slot), [`ring`] and
//! [`boundary`] (exact faces), [`mesh`].

mod boundary;
mod mesh;
mod ring;
mod round_end;

use crate::COMPUTED;
use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use crate::{
    Vector,
    numeric::{Tolerance, gauss_legendre},
    region::AreaMoments,
    solid::{Mesh, Shell, ShellBuilder, SolidError, VolumeMoments},
};
pub use boundary::TurnedEnd;
use round_end::Part;

/// Body turned about the z axis: a stack of cylinders and cones of 45°, some of them with a slot at the side of +x.
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
    /// Radii at its lower and upper end, mm.
    pub radii: [f64; 2],
    /// Whether the slot runs through it.
    pub slotted: bool,
}

/// Slot of a turned body, with a plane floor and walls parallel to the xz plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TurnedSlot {
    /// Distance between the walls, mm.
    pub width: f64,
    /// Distance of the floor from the axis, mm.
    pub floor: f64,
    /// Whether it ends half round, as milled, where the cylinder continues without slot; otherwise its end is a plane.
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

    /// The section with the slot.
    #[must_use]
    pub fn slotted(self) -> Self {
        Self {
            slotted: true,
            ..self
        }
    }

    fn minimum_radius(&self) -> f64 {
        self.radii[0].min(self.radii[1])
    }
}

impl Turned {
    /// A body whose first section begins at the height `bottom`, mm.
    ///
    /// # Errors
    /// [`SolidError::Turned`] with the first section that is neither a cylinder nor a cone of 45°, or is too small for its slot.
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
        let wrong = (0..body.sections.len()).find(|&index| !body.is_valid(index));
        let none = body.sections.is_empty() || !bottom.is_finite();
        match wrong.or(none.then_some(0)) {
            Some(section) => Err(SolidError::Turned { section }),
            None => Ok(body),
        }
    }

    fn is_valid(&self, index: usize) -> bool {
        let section = self.sections[index];
        let [low, high] = section.radii;
        let sized = section.length > 0.0 && section.minimum_radius() > 0.0;
        let finite = section.length.is_finite() && low.is_finite() && high.is_finite();
        let cone = ((high - low).abs() - section.length).abs() <= COMPUTED * section.length;
        if !sized || !finite || (low != high && !cone) {
            return false;
        }
        let Some(slot) = self.slot else {
            return !section.slotted;
        };
        if !(slot.width > 0.0 && slot.floor > 0.0) {
            return false;
        }
        let fits = |radius: f64| self.edge_distance(radius).is_some();
        if section.slotted {
            return section.radii.into_iter().all(fits);
        }
        // Next to the slot, a circle lies entirely below its floor or contains its edges.
        let neighbours = [index.checked_sub(1), Some(index + 1)];
        let mut slotted = neighbours.into_iter().flatten();
        let next_to_slot = slotted.any(|other| self.sections.get(other).is_some_and(|s| s.slotted));
        let clear = |radius: f64| radius < slot.floor || fits(radius);
        !next_to_slot || section.radii.into_iter().all(clear)
    }

    /// Distance along x of the slot's edges on a circle, mm; `None` if its floor is not inside the circle.
    fn edge_distance(&self, radius: f64) -> Option<f64> {
        let slot = self.slot?;
        let squared = radius * radius - 0.25 * slot.width * slot.width;
        let edge = squared.max(0.0).sqrt();
        (edge > slot.floor).then_some(edge)
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
            .map(
                |Part {
                     section,
                     slot_from_below,
                 }| {
                    let [low, high] = section.radii;
                    let round = PI * section.length * (low * low + low * high + high * high) / 3.0;
                    let Some(slot) = self
                        .slot
                        .filter(|_| section.slotted || slot_from_below.is_some())
                    else {
                        return round;
                    };
                    let mut cut = 0.0;
                    if slot_from_below.is_some() {
                        slot.along_end(|_, weight, slot| cut += weight * slot.area(low));
                        return round - cut;
                    }
                    gauss_legendre(0.0, 1.0, |x, weight| {
                        cut += weight * slot.area(low + (high - low) * x);
                    });
                    round - section.length * cut
                },
            )
            .sum()
    }

    /// Volume with its first and second moments about the origin, exact to rounding.
    #[must_use]
    pub fn moments(&self) -> VolumeMoments {
        let mut sum = VolumeMoments::default();
        let mut bottom = self.bottom;
        for Part {
            section,
            slot_from_below,
        } in self.parts()
        {
            let [low, high] = section.radii;
            if let (Some(slot), Some(from_below)) = (self.slot, slot_from_below) {
                slot.along_end(|along, weight, slot| {
                    let z = match from_below {
                        true => bottom + along,
                        false => bottom + section.length - along,
                    };
                    let cut = slot.moments(low).times(-weight);
                    let (area, first) = (cut.area, cut.first.x);
                    sum.volume += area;
                    sum.first += Vector3::new(first, 0.0, area * z);
                    let [xz, zz] = [first * z, area * z * z];
                    sum.second += Matrix3::new(cut.xx, 0.0, xz, 0.0, cut.yy, 0.0, xz, 0.0, zz);
                });
            }
            let slot = self.slot.filter(|_| section.slotted);
            gauss_legendre(0.0, 1.0, |x, weight| {
                let (radius, z) = (low + (high - low) * x, bottom + section.length * x);
                let disc = PI * radius * radius;
                let quarter = 0.25 * disc * radius * radius;
                let round = AreaMoments {
                    area: disc,
                    xx: quarter,
                    yy: quarter,
                    ..AreaMoments::default()
                };
                let slice = slot.map_or(round, |slot| round.without(slot.moments(radius)));
                let (area, first) = (slice.area, slice.first.x);
                let high = weight * section.length;
                sum.volume += area * high;
                sum.first += Vector3::new(first, 0.0, area * z) * high;
                let [xz, zz] = [first * z, area * z * z];
                sum.second +=
                    Matrix3::new(slice.xx, 0.0, xz, 0.0, slice.yy, 0.0, xz, 0.0, zz) * high;
            });
            bottom += section.length;
        }
        sum
    }

    /// Its exact boundary. Edges where the slot cuts a cone are polynomials within 1e-9 of their radius.
    #[must_use]
    pub fn shell(&self) -> Shell {
        let mut builder = ShellBuilder::default();
        self.add_faces(&mut builder, [TurnedEnd::Flat, TurnedEnd::Flat]);
        builder.finish()
    }

    /// Closed triangle mesh within a tolerance, with outward normals.
    ///
    /// # Errors
    /// [`SolidError`] if a face has no triangles at this tolerance.
    pub fn mesh(&self, tolerance: Tolerance) -> Result<Mesh, SolidError> {
        mesh::mesh(self, tolerance)
    }
}

impl TurnedSlot {
    /// Area that the slot removes from a disc, mm².
    fn area(self, radius: f64) -> f64 {
        let half = 0.5 * self.width;
        let edge = (radius * radius - half * half).max(0.0).sqrt();
        let above = half * edge + radius * radius * (half / radius).min(1.0).asin();
        above - self.width * self.floor
    }

    /// Moments of the area that the slot removes from a disc.
    fn moments(self, radius: f64) -> AreaMoments {
        let (half, floor) = (0.5 * self.width, self.floor);
        let [mut first, mut xx, mut yy] = [0.0; 3];
        gauss_legendre(0.0, half, |y, weight| {
            let edge = (radius * radius - y * y).max(0.0).sqrt();
            // Both halves of the slot.
            first += weight * (edge.powi(2) - floor.powi(2));
            xx += weight * (edge.powi(3) - floor.powi(3)) * 2.0 / 3.0;
            yy += weight * (edge - floor) * 2.0 * y * y;
        });
        AreaMoments {
            area: self.area(radius),
            first: Vector::new(first, 0.0),
            xx,
            xy: 0.0,
            yy,
        }
    }
}

#[cfg(test)]
mod tests;
