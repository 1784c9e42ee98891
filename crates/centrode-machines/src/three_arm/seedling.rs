use std::f64::consts::TAU;

use centrode_geometry::{Extreme, Outline, Point, minimum, piece_ends};

use super::ThreeArm;

/// Minimum clearance of an arm's clamp from planted seedlings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeedlingClearance {
    /// Minimum clearance, mm; if negative, the distance by which a stem is pushed.
    pub value: f64,
    /// Carrier turn of the planting arm at which the clearance is smallest, rad.
    pub input: f64,
    /// Nearest seedling at this input: 0 is the one just planted, 1 the one before it in the row.
    pub seedling: u32,
}

/// Number of parts of a turn; in each the clearance has few extremes.
const PARTS: u32 = 15;

impl ThreeArm {
    /// Minimum clearance of an arm's clamp from the seedling that it has planted and the one before it, over a whole cycle.
    ///
    /// Model: over ground, each arm leaves a vertical stem at the position of its tip at planting, with the width and height of
    /// the design, one every `plant_spacing`. The clamp is the line back from the tip along the pusher's axis. From the release
    /// on it must stay behind the far side of the stem just planted; its open flakes may draw back past the stem. At all
    /// times it must stay in front of the stem before. Only the part of the clamp below the top of the stems counts; the
    /// thickness of the clamp and the parts above do not.
    ///
    /// Infinite if the clamp is never below the top of the stems.
    #[must_use]
    pub fn seedling_clearance(&self) -> SeedlingClearance {
        let release = self.planting(0);
        let half_turn = 0.5 * TAU;
        let from = |start: f64| piece_ends(start, release + half_turn, PARTS, &[]);
        let planted = self.over_ground(&self.tip(release, 0), release).position;
        let own = minimum(|input| self.behind(input, planted), &from(release));
        let front = |input| self.in_front(input, planted);
        let before = minimum(front, &from(release - half_turn));
        let (seedling, Extreme { input, value }) = if before.value < own.value {
            (1, before)
        } else {
            (0, own)
        };
        SeedlingClearance {
            value,
            input: input.rem_euclid(TAU),
            seedling,
        }
    }

    /// Feet of the seedlings planted last, the newest first, in the machine's frame at an input, mm.
    #[must_use]
    pub fn planted(&self, input: f64, count: u32) -> Vec<Point> {
        let apart = TAU / f64::from(self.arms());
        let release = self.planting(0);
        let first = self.over_ground(&self.tip(release, 0), release).position.x;
        let travel = -self.train().sign() * self.advance();
        let newest = ((input - release) / apart).floor();
        let place = |before: u32| {
            let ahead = (newest - f64::from(before)) * apart - input;
            Point::new(first + travel * ahead, self.ground())
        };
        (0..count).map(place).collect()
    }

    /// The stem of a planted seedling, from its foot; `None` if the design gives it no width or height.
    #[must_use]
    pub fn stem(&self) -> Option<Outline> {
        let spec = &self.design().seedling;
        let (half, top) = (0.5 * spec.width, spec.height);
        let corners = [[-half, 0.0], [half, 0.0], [half, top], [-half, top]];
        (half > 0.0 && top > 0.0).then(|| Outline::polygon(&corners.map(Point::from)))
    }

    /// Ends of the part of the clamp below the top of the stems, as distances from the stem in the direction of travel, mm;
    /// `None` if the whole clamp is above.
    fn low_part(&self, input: f64, planted: Point) -> Option<[f64; 2]> {
        let forward = -self.train().sign();
        let design = self.design();
        let arm = self.chain(0, input);
        let tip = self.over_ground(&arm.tip(), input).position;
        let (sin, cos) = arm.clamp().position.sin_cos();
        let length = design.arm.clamp_length;
        let top = self.ground() + design.seedling.height;
        let place = |back: f64| forward * (tip.x - back * cos - planted.x);
        let height = |back: f64| tip.y - back * sin;
        let (at_tip, at_end) = (height(0.0), height(length));
        if at_tip > top && at_end > top {
            return None;
        }
        let crossing = (at_tip - top) / sin;
        let from = if at_tip > top { crossing } else { 0.0 };
        let to = if at_end > top { crossing } else { length };
        Some([place(from), place(to)])
    }

    fn behind(&self, input: f64, planted: Point) -> f64 {
        let half = 0.5 * self.design().seedling.width;
        self.low_part(input, planted)
            .map_or(f64::INFINITY, |[a, b]| half - a.max(b))
    }

    fn in_front(&self, input: f64, planted: Point) -> f64 {
        let half = 0.5 * self.design().seedling.width;
        let spacing = self.design().work.plant_spacing;
        self.low_part(input, planted)
            .map_or(f64::INFINITY, |[a, b]| a.min(b) + spacing - half)
    }
}
