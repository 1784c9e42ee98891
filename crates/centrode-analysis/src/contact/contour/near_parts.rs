use std::f64::consts::{PI, TAU};

use centrode_gear::GearPair;
use centrode_geometry::{Point, Vector};

use super::{
    near_search::NearSearch,
    outline::{GearOutline, OutlinePart},
    pose::Pose,
};
use crate::contact::SAMPLES_PER_PITCH;

/// Circle around a part.
#[derive(Clone, Copy, Debug)]
struct PartCircle {
    part: usize,
    center: Point,
    radius: f64,
}

impl PartCircle {
    fn around(part: usize, outline: &OutlinePart<'_>) -> Self {
        Self {
            part,
            center: outline.center,
            radius: outline.radius,
        }
    }
}

/// Cached pairs of parts that are near each other in a reference pose or in any pose within a tolerance of it.
#[derive(Debug, Default)]
pub(in crate::contact) struct PairCache {
    reference: Option<Reference>,
    /// Circles of the driver's parts, and of the driven gear's, that have a pair.
    drivers: Vec<PartCircle>,
    mates: Vec<PartCircle>,
    /// Pairs by index into `drivers` and `mates`, in the order of the driven gear's parts.
    pairs: Vec<(u32, u32)>,
    /// Index into `drivers` per part of the driver; valid only for parts that `drivers` contains.
    slots: Vec<u32>,
}

/// Pose for which the pairs were searched.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct Reference {
    pub(in crate::contact) pose: Pose,
    /// Pitch point in that pose, in the driver's axes.
    pub(in crate::contact) pitch_point: Point,
    /// Distance within which parts are near, mm.
    pub(in crate::contact) near: f64,
}

/// Tolerance of poses about the reference pose of a cache.
#[derive(Clone, Copy, Debug)]
pub(in crate::contact) struct PoseTolerance {
    /// Rotation of the gears relative to each other, rad.
    turn: f64,
    /// Motion of the pitch point per rotation, mm/rad.
    drift: f64,
}

impl PoseTolerance {
    /// Tolerance that about doubles the search distance `near`. It is zero if the cache would serve fewer than two samples.
    pub(in crate::contact) fn new(pair: &GearPair, near: f64) -> Self {
        let (teeth, drift) = (f64::from(pair.driver().tooth_count()), PI * pair.module());
        let (n1, n2) = pair.mean_ratio();
        let share = f64::from(n1) / f64::from(n1 + n2);
        // Circles with the mean radii are less than `near` apart up to sqrt(2 near radius) on either side of the pitch point.
        let radius = pair.center_distance() * share * (1.0 - share);
        let turn = near / ((2.0 * near * radius).sqrt() + drift);
        let sample = TAU / (teeth * share * f64::from(SAMPLES_PER_PITCH));
        Self {
            turn: if turn < 2.0 * sample { 0.0 } else { turn },
            drift,
        }
    }
}

#[cfg(test)]
impl PoseTolerance {
    /// No tolerance: the pairs are searched in every pose.
    pub(in crate::contact) fn none() -> Self {
        Self {
            turn: 0.0,
            drift: 0.0,
        }
    }
}

impl PairCache {
    /// Whether the cache has all parts within a distance of each other in a pose.
    pub(in crate::contact) fn holds(
        &self,
        pose: &Pose,
        near: f64,
        tolerance: PoseTolerance,
    ) -> bool {
        self.reference.as_ref().is_some_and(|reference| {
            let (point, from) = (&reference.pitch_point, &reference.pose);
            let moved = (pose.point_to_driven(point) - from.point_to_driven(point)).norm();
            near <= reference.near
                && from.turn_between(pose) <= tolerance.turn
                && moved <= tolerance.turn * tolerance.drift
        })
    }

    /// Fills the cache with all parts that are near each other in a pose, or in any pose within the tolerance of it.
    ///
    /// Within the tolerance a point of the driver moves, in the driven gear's axes, by no more than the pitch point does plus the
    /// rotation times its distance from the pitch point.
    pub(in crate::contact) fn fill(
        &mut self,
        [driver, driven]: [&GearOutline<'_>; 2],
        reference: Reference,
        tolerance: PoseTolerance,
    ) {
        let PoseTolerance { turn, drift } = tolerance;
        let Reference {
            pose,
            pitch_point,
            near,
        } = reference;
        let search = NearSearch {
            driver: &driver.tree,
            driven: &driven.tree,
            reach: |center: &Point, radius: f64| {
                radius + near + turn * ((center - pitch_point).norm() + radius + drift)
            },
            point_to_driven: |p: &Point| pose.point_to_driven(p),
        };
        self.reference = Some(reference);
        self.drivers.clear();
        self.mates.clear();
        self.pairs.clear();
        self.slots.resize(driver.parts.len(), 0);
        search.pairs(|i, j| {
            let slot = self.slots[i];
            let is_known = self.drivers.get(slot as usize).is_some_and(|c| c.part == i);
            if !is_known {
                self.slots[i] = self.drivers.len() as u32;
                self.drivers.push(PartCircle::around(i, &driver.parts[i]));
            }
            if self.mates.last().is_none_or(|mate| mate.part != j) {
                self.mates.push(PartCircle::around(j, &driven.parts[j]));
            }
            self.pairs
                .push((self.slots[i], self.mates.len() as u32 - 1));
        });
    }

    /// Calls `found` with every pair whose circles are within a distance of each other in a pose: index in the cache and part of the
    /// driver, part of the driven gear. The order is that of the driven gear's parts.
    pub(in crate::contact) fn pairs(
        &self,
        pose: &Pose,
        near: f64,
        mut found: impl FnMut(usize, usize, usize),
    ) {
        let posed = |circle: &PartCircle| {
            (
                pose.point_to_driven(&circle.center).coords,
                circle.radius + near,
            )
        };
        let drivers: Vec<(Vector, f64)> = self.drivers.iter().map(posed).collect();
        for &(k, m) in &self.pairs {
            let (center, reach) = drivers[k as usize];
            let mate = &self.mates[m as usize];
            if (center - mate.center.coords).norm_squared() < (mate.radius + reach).powi(2) {
                found(k as usize, self.drivers[k as usize].part, mate.part);
            }
        }
    }

    /// Number of the driver's parts in the cache.
    pub(in crate::contact) fn drivers(&self) -> usize {
        self.drivers.len()
    }
}
