use std::f64::consts::{PI, TAU};

use centrode_gear::GearPair;
use centrode_geometry::{Point, Vector};

use super::{
    SAMPLES_PER_PITCH,
    body::{GearOutline, OutlinePart},
    touch::Pose,
    tree::Near,
};

/// Circle around a part.
#[derive(Clone, Copy, Debug)]
struct Circle {
    part: usize,
    center: Point,
    radius: f64,
}

impl Circle {
    fn around((part, outline): (usize, &OutlinePart<'_>)) -> Self {
        Self {
            part,
            center: outline.center,
            radius: outline.radius,
        }
    }
}

/// Pairs of parts near each other in one pose, and in every pose that differs so little from it that no others come near.
#[derive(Debug, Default)]
pub(super) struct Window {
    from: Option<(Pose, f64)>,
    /// Pitch point of that pose, in the driver's axes.
    about: Point,
    drivers: Vec<Circle>,
    mates: Vec<Circle>,
    /// Indices into both, in the order of the driven gear's parts.
    pairs: Vec<(u32, u32)>,
    /// Places of the driver's parts in the window, for those that are in it.
    slots: Vec<u32>,
}

/// How far poses may differ from that of a window.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowance {
    /// Turn of the gears to each other, rad.
    turn: f64,
    /// Distance, mm: the pitch point may move by so much times the turn.
    drift: f64,
}

impl Allowance {
    /// Until parts near each other are looked for anew: so much that it adds about as much to the distance in which they are looked
    /// for as that is, and nothing where this is less than two samples.
    pub(super) fn new(pair: &GearPair, near: f64) -> Self {
        let (teeth, drift) = (f64::from(pair.driver().tooth_count()), PI * pair.module());
        let (n1, n2) = pair.mean_ratio();
        let share = f64::from(n1) / f64::from(n1 + n2);
        // Gears of the mean radii are nearer than that over so much of their circumference.
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
impl Allowance {
    /// Nothing is allowed: what is near is looked for in every pose.
    pub(super) fn none() -> Self {
        Self {
            turn: 0.0,
            drift: 0.0,
        }
    }
}

impl Window {
    /// Whether all that is as near as this in a pose is in the window.
    pub(super) fn holds(&self, pose: &Pose, near: f64, allowance: Allowance) -> bool {
        self.from.as_ref().is_some_and(|(from, within)| {
            let moved = (pose.back(&self.about) - from.back(&self.about)).norm();
            near <= *within
                && from.turn_between(pose) <= allowance.turn
                && moved <= allowance.turn * allowance.drift
        })
    }

    /// Fills the window with what is near in a pose, or may be as near in one that differs by no more than what is allowed.
    ///
    /// A point of the driver then moves, in the driven gear's axes, by no more than the pitch point does and the turn times its
    /// distance from there.
    pub(super) fn fill(
        &mut self,
        [driver, driven]: [&GearOutline<'_>; 2],
        pose: &Pose,
        (about, near): (Point, f64),
        allowance: Allowance,
    ) {
        let Allowance { turn, drift } = allowance;
        let search = Near {
            driver: &driver.tree,
            driven: &driven.tree,
            reach: |center: &Point, radius: f64| {
                radius + near + turn * ((center - about).norm() + radius + drift)
            },
            place: |p: &Point| pose.back(p),
        };
        (self.from, self.about) = (Some((*pose, near)), about);
        self.drivers.clear();
        self.mates.clear();
        self.pairs.clear();
        self.slots.resize(driver.parts.len(), 0);
        search.pairs(|i, j| {
            let slot = self.slots[i];
            let is_known = self.drivers.get(slot as usize).is_some_and(|c| c.part == i);
            if !is_known {
                self.slots[i] = self.drivers.len() as u32;
                self.drivers.push(Circle::around((i, &driver.parts[i])));
            }
            if self.mates.last().is_none_or(|mate| mate.part != j) {
                self.mates.push(Circle::around((j, &driven.parts[j])));
            }
            self.pairs
                .push((self.slots[i], self.mates.len() as u32 - 1));
        });
    }

    /// Every pair of parts, of driver and driven gear, whose circles are as near each other in a pose, in the order of the driven
    /// gear's parts, with the driver's place in the window.
    pub(super) fn pairs(&self, pose: &Pose, near: f64, mut found: impl FnMut(usize, usize, usize)) {
        let posed = |circle: &Circle| (pose.back(&circle.center).coords, circle.radius + near);
        let drivers: Vec<(Vector, f64)> = self.drivers.iter().map(posed).collect();
        for &(k, m) in &self.pairs {
            let (center, reach) = drivers[k as usize];
            let mate = &self.mates[m as usize];
            if (center - mate.center.coords).norm_squared() < (mate.radius + reach).powi(2) {
                found(k as usize, self.drivers[k as usize].part, mate.part);
            }
        }
    }

    /// Number of the driver's parts in it.
    pub(super) fn drivers(&self) -> usize {
        self.drivers.len()
    }
}
