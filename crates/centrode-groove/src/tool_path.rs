use centrode_geometry::{Point, Tolerance};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Groove, Wall};
use centrode_kinematics::transmission::Transmission;
use centrode_spec::SpecError;
use centrode_spec::rule::{Rule, broken, positive};

/// The end mill that cuts the groove, its axis square to the shaft's.
#[derive(Clone, Debug, Deserialize, JsonSchema, PartialEq, Serialize)]
#[serde(default, deny_unknown_fields)]
pub struct Mill {
    /// Diameter, mm; default: the groove's width. A thinner one goes once along each wall.
    pub diameter: Option<f64>,
    /// Depth of one pass, mm.
    pub depth_step: f64,
    /// Feed along the groove at the shaft's surface, mm/min.
    pub feed: f64,
}

impl Default for Mill {
    fn default() -> Self {
        Self {
            diameter: None,
            depth_step: 1.0,
            feed: 150.0,
        }
    }
}

impl Mill {
    /// Checks the ranges, for a groove of this width (mm).
    ///
    /// # Errors
    /// [`SpecError`] with the key at fault.
    pub fn validate(&self, width: f64) -> Result<(), SpecError> {
        positive("depth_step", self.depth_step)?;
        positive("feed", self.feed)?;
        let Some(diameter) = self.diameter else {
            return Ok(());
        };
        positive("diameter", diameter)?;
        // Two passes must meet in the middle.
        if diameter > width || 2.0 * diameter < width {
            let rule = Rule::OutOfRange {
                value: diameter,
                minimum: 0.5 * width,
                maximum: width,
                unit: " mm",
            };
            return broken("diameter", rule);
        }
        Ok(())
    }

    /// Depths of the passes below the surface, mm, the last the groove's; equal steps.
    #[must_use]
    pub fn depths(&self, groove: &Groove) -> Vec<f64> {
        let count = (groove.depth() / self.depth_step).ceil().clamp(1.0, 1000.0);
        (1..=count as u32)
            .map(|i| groove.depth() * f64::from(i) / count)
            .collect()
    }

    /// Closed paths of the mill's axis on the development, mm: one along the middle, or one next to each wall. Each ends at its
    /// start, but whole turns farther round.
    ///
    /// Between two points the axes of the machine move in proportion, and the path is within the tolerance of the exact one.
    #[must_use]
    pub fn ways(&self, groove: &Groove, tolerance: Tolerance) -> Vec<Vec<Point>> {
        let beside = 0.5 * (groove.width() - self.diameter.unwrap_or(groove.width()));
        let sides = if beside > 0.0 {
            vec![beside, -beside]
        } else {
            vec![0.0]
        };
        sides
            .into_iter()
            .map(|side| groove.way(side, tolerance))
            .collect()
    }
}

impl Groove {
    /// The line at a constant distance next to the centre line over the whole cycle, as points on the
    /// development within the tolerance, mm.
    #[must_use]
    pub fn way(&self, beside: f64, tolerance: Tolerance) -> Vec<Point> {
        let mut points = vec![self.beside(0.0, beside)];
        for pair in self.ends().windows(2) {
            // A chord of the length l deviates from a curve of the curvature k by k l^2 / 8.
            let looks = (0..=8).map(|i| pair[0] + (pair[1] - pair[0]) * f64::from(i) / 8.0);
            let bend = looks
                .map(|theta| {
                    let k = self.curvature(theta);
                    (k / (1.0 - k * beside)).abs()
                })
                .fold(0.0, f64::max);
            let length = (self.beside(pair[1], beside) - self.beside(pair[0], beside)).norm();
            // A margin for the curvature between the samples.
            let steps = (length * (1.1 * bend / (8.0 * tolerance.mm())).sqrt()).ceil();
            let steps = steps.clamp(1.0, 1e5) as u32;
            points.extend((1..=steps).map(|i| {
                let share = f64::from(i) / f64::from(steps);
                self.beside(pair[0] + (pair[1] - pair[0]) * share, beside)
            }));
        }
        points
    }

    /// Path along a wall over the whole cycle, like [`way`](Self::way).
    #[must_use]
    pub fn wall_way(&self, wall: Wall, tolerance: Tolerance) -> Vec<Point> {
        self.way(0.5 * self.width() * wall.sign(), tolerance)
    }

    /// Shaft angles of a table over the whole cycle in equal steps of about `step` (rad), both ends
    /// included.
    #[must_use]
    pub fn steps(&self, step: f64) -> Vec<f64> {
        let period = self.traverse().period();
        let count = (period / step).round().clamp(1.0, 1e6) as u32;
        (0..=count)
            .map(|i| period * f64::from(i) / f64::from(count))
            .collect()
    }
}
