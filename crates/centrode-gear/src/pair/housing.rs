use std::f64::consts::PI;

use centrode_geometry::{Arc, Outline, Point, Segment};

use super::GearPair;
use crate::rolling::Member;

/// Housing around both gears of a flow meter or pump.
#[derive(Clone, Debug, PartialEq)]
pub struct Housing {
    /// Radii of the chamber around the driver and around the driven gear, mm.
    pub radii: [f64; 2],
    /// Contour of the chamber, mm: the union of two circles, the driver's axis at the origin.
    pub chamber: Outline,
    /// Outer contour, mm.
    pub outline: Outline,
    /// Thickness of the plate, mm: the wider gear with a gap on either side.
    pub thickness: f64,
}

impl GearPair {
    /// Housing with the gap and the wall of the design; `None` if the design has no gap.
    #[must_use]
    pub fn housing(&self) -> Option<Housing> {
        let spec = self.design().housing;
        let gap = spec.gap?;
        let gears = Member::ALL.map(|member| self.gear(member));
        let radii = gears.map(|gear| gear.radii().1 + gap);
        let around = |radii: [f64; 2]| union_of_circles(radii, self.center_distance());
        Some(Housing {
            radii,
            chamber: around(radii),
            outline: around(radii.map(|radius| radius + spec.wall)),
            thickness: gears
                .map(|gear| gear.body().width)
                .into_iter()
                .fold(0.0, f64::max)
                + 2.0 * gap,
        })
    }

    /// Volume that the pair displaces in a sealed chamber per turn of the driver, mm³.
    ///
    /// A pressure in the chamber acts on each gear between its tip and its contact with the mate. If this contact is at the pitch
    /// point, the work of one cycle gives `w (n1 (pi R1² - A1) + n2 (pi R2² - A2)) / n1`. `w` is the smaller face width, `R` a
    /// maximum tip radius, `A` the area inside a pitch curve, `n` a number of turns per cycle.
    ///
    /// Limits of validity: leakage is not included. The motion of the contact along the line of action takes off about
    /// `pi w pb² / 12` per turn of each gear, with the base pitch `pb`.
    #[must_use]
    pub fn displacement(&self) -> f64 {
        let (driver_turns, driven_turns) = self.mean_ratio();
        let turns = [driver_turns, driven_turns].map(f64::from);
        let gears = Member::ALL.map(|member| self.gear(member));
        let width = gears
            .map(|gear| gear.body().width)
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        let areas = gears.map(|gear| PI * gear.radii().1.powi(2) - gear.pitch_curve().area().abs());
        width * (turns[0] * areas[0] + turns[1] * areas[1]) / turns[0]
    }
}

/// Outline of the union of two circles that overlap, the first at the origin, the second at (`distance`, 0).
fn union_of_circles([first, second]: [f64; 2], distance: f64) -> Outline {
    let x = 0.5 * (distance + (first - second) * (first + second) / distance);
    let y = (first * first - x * x).max(0.0).sqrt();
    let [low, high] = [Point::new(x, -y), Point::new(x, y)];
    let arc = |start: Point, end: Point, sweep: f64| {
        let bulge = (0.25 * sweep).tan();
        Segment::Arc(Arc { start, end, bulge })
    };
    // In halves, so that no arc is longer than half a turn.
    let left = Point::new(-first, 0.0);
    let right = Point::new(distance + second, 0.0);
    let [one, two] = [PI - y.atan2(x), PI - y.atan2(distance - x)];
    let arcs = vec![
        arc(high, left, one),
        arc(left, low, one),
        arc(low, right, two),
        arc(right, high, two),
    ];
    Outline::new(arcs).unwrap_or_else(|_| Outline::circle(Point::origin(), first))
}
