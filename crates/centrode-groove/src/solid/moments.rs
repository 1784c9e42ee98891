//! Volume and moments of the grooved shaft: integrals over its exact surfaces.

use std::f64::consts::{FRAC_PI_2, TAU};

use centrode_geometry::{Antiderivative, VolumeMoments};
use nalgebra::Vector3;

use super::plan::{Level, Plan};
use super::{ShaftBody, ends};
use crate::Groove;

/// Nodes and weights of the Gauss rule on `[-1, 1]` that is exact up to degree 5: along the radius and the axis the
/// moments are polynomials below that.
const RULE: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];
/// Number of parts of the fillet for the integral: down the fillet the groove's width and section change smoothly.
const FILLET: u32 = 4;
/// Number of equally spaced lines round the shaft between which the walls are integrated: the first and the maximum.
const LINES: [u32; 2] = [8, 512];
/// Maximum relative change of the volume when the number of lines is doubled.
const SAME: f64 = 1e-13;

/// Nodes and weights on an interval cut into `parts`.
fn nodes([low, high]: [f64; 2], parts: u32) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * (high - low) / f64::from(parts);
    (0..parts).flat_map(move |part| {
        let middle = low + half * f64::from(2 * part + 1);
        RULE.map(|(node, weight)| (middle + half * node, half * weight))
    })
}

/// Moments of the shaft: the blank with its keyway, minus the groove. A body that has been validated has a blank.
pub(super) fn moments(groove: &Groove, body: &ShaftBody, thick: [f64; 2]) -> VolumeMoments {
    let blank = ends::blank(body, groove.radius(), thick);
    let mut sum = blank.map_or_else(VolumeMoments::default, |blank| blank.moments());
    grooved(&mut sum, groove, body.fillet);
    sum
}

/// Subtracts the groove: its radial walls, and below them the fillet down to the floor.
fn grooved(sum: &mut VolumeMoments, groove: &Groove, fillet: f64) {
    let (half, floor) = (0.5 * groove.width(), groove.radius() - groove.depth());
    let foot = floor + fillet;
    let whole: Vec<(f64, f64)> = nodes([foot, groove.radius()], 1).collect();
    let open = |lines: u32| opened(groove, half, &whole, lines);
    let (mut lines, mut before) = (LINES[0], open(LINES[0]));
    let walls = loop {
        lines *= 2;
        let now = open(lines);
        if (now.volume - before.volume).abs() <= SAME * now.volume || lines >= LINES[1] {
            break now;
        }
        before = now;
    };
    sum.subtract(&walls);
    if fillet == 0.0 {
        return;
    }
    for (angle, turned) in nodes([0.0, FRAC_PI_2], FILLET) {
        let level = Level::new(half, floor, fillet, angle);
        let height = fillet * angle.cos() * turned;
        sum.subtract(&opened(
            groove,
            level.half,
            &[(level.radius, height)],
            lines / 2,
        ));
    }
}

/// Moments of the region the groove opens at some radii, given with their weights, where it is `half` wide to each side.
fn opened(groove: &Groove, half: f64, radii: &[(f64, f64)], even: u32) -> VolumeMoments {
    let level = Level {
        half,
        radius: groove.radius(),
    };
    let plan = Plan::smooth(groove, level, even);
    let mut lines = plan.lines.clone();
    lines.push(TAU);
    let mut sum = VolumeMoments::default();
    // Sixteen nodes between two lines: a constant needs no more panels.
    for (angle, turned) in Antiderivative::new(|_| 1.0, &lines).nodes() {
        let heights = plan.heights_at(angle);
        for [low, high] in plan.open(0, |edge| heights[edge]) {
            for (z, along) in nodes([heights[low], heights[high]], 1) {
                for &(radius, out) in radii {
                    sum.add(at(radius, angle, z), turned * along * out * radius);
                }
            }
        }
    }
    sum
}

/// A point at a radius and angle.
fn at(radius: f64, angle: f64, z: f64) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector3::new(radius * cos, radius * sin, z)
}
