//! Volume and moments of the grooved shaft: integrals over its exact surfaces.

use std::f64::consts::{FRAC_PI_2, TAU};

use centrode_geometry::{Antiderivative, VolumeMoments};
use nalgebra::Vector3;

use super::ShaftBody;
use super::plan::{Level, Plan};
use crate::shaft::Groove;

/// Nodes and weights of the Gauss rule on `[-1, 1]` that is exact up to degree 5: along the radius and the axis the
/// moments are polynomials below that.
const RULE: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];
/// Parts of the keyway's width and of its chamfer, on each of which the rule is exact to rounding.
const PARTS: u32 = 32;
/// Parts of the fillet, down which the groove's width and the section it opens change smoothly.
const FILLET: u32 = 4;
/// Even lines round the shaft between which the walls are integrated: those tried first, and the most.
const LINES: [u32; 2] = [8, 512];
/// Share by which the volume may change with twice the lines.
const SAME: f64 = 1e-13;

/// Nodes and weights on an interval cut into `parts`.
fn nodes([low, high]: [f64; 2], parts: u32) -> impl Iterator<Item = (f64, f64)> {
    let half = 0.5 * (high - low) / f64::from(parts);
    (0..parts).flat_map(move |part| {
        let middle = low + half * f64::from(2 * part + 1);
        RULE.map(|(node, weight)| (middle + half * node, half * weight))
    })
}

/// Moments of the shaft: the blank, less the groove and the keyway.
pub(super) fn moments(groove: &Groove, body: &ShaftBody, thick: [f64; 2]) -> VolumeMoments {
    let mut sum = VolumeMoments::default();
    let (r, j, c) = (groove.radius(), 0.5 * body.journal_diameter, body.chamfer);
    revolved(&mut sum, thick, [r, r]);
    for (end, way) in thick.into_iter().zip([-1.0, 1.0]) {
        let shoulder = end + way * c;
        let edge = shoulder + way * (body.journal_length - c);
        revolved(&mut sum, [end, shoulder], [r, r - c]);
        revolved(&mut sum, [shoulder, edge], [j, j]);
        revolved(&mut sum, [edge, edge + way * c], [j, j - c]);
        if let (Some(keyway), true) = (body.keyway, way < 0.0) {
            let tip = edge + way * c;
            let half = body.keyway_rounding();
            let inner = tip - way * (body.keyway_length - half);
            let (foot, width) = (j - keyway.depth, keyway.width);
            let straight = |ends: [f64; 2], radii: [f64; 2]| {
                let length = (ends[1] - ends[0]).abs();
                let parts = if radii[0] == radii[1] { 1 } else { PARTS };
                nodes([0.0, 1.0], parts).map(move |(share, along)| {
                    let [z, radius] = [ends, radii].map(|[a, b]| a + (b - a) * share);
                    Cut {
                        z,
                        length: length * along,
                        radius,
                        width,
                    }
                })
            };
            // Beyond the walls by the sine of an angle, where it is as wide as by its cosine.
            let round = nodes([0.0, FRAC_PI_2], PARTS).map(|(angle, turned)| {
                let (sin, cos) = angle.sin_cos();
                Cut {
                    z: inner - way * half * sin,
                    length: half * cos * turned,
                    radius: j,
                    width: width * cos,
                }
            });
            slot(&mut sum, foot, straight([inner, edge], [j, j]));
            slot(&mut sum, foot, straight([edge, tip], [j, j - c]));
            slot(&mut sum, foot, round);
        }
    }
    grooved(&mut sum, groove, body.fillet);
    sum
}

/// Adds a cylinder or cone about the axis between two heights, given its radius at both.
fn revolved(sum: &mut VolumeMoments, ends: [f64; 2], radii: [f64; 2]) {
    let length = (ends[1] - ends[0]).abs();
    for (share, along) in nodes([0.0, 1.0], 1) {
        let z = ends[0] + (ends[1] - ends[0]) * share;
        let edge = radii[0] + (radii[1] - radii[0]) * share;
        for (radius, out) in nodes([0.0, edge], 1) {
            // Moments up to the second are those of three even angles and more.
            for i in 0..4 {
                let volume = length * along * out * radius * FRAC_PI_2;
                sum.add(at(radius, FRAC_PI_2 * f64::from(i), z), volume);
            }
        }
    }
}

/// A thin slice of a keyway across the axis.
struct Cut {
    /// Height, and length along the axis, mm.
    z: f64,
    length: f64,
    /// Radius of the surface that it is cut into, mm.
    radius: f64,
    /// Distance of its walls, mm.
    width: f64,
}

/// Subtracts a keyway along x, its floor so far from the axis, slice by slice.
fn slot(sum: &mut VolumeMoments, foot: f64, cuts: impl Iterator<Item = Cut>) {
    for cut in cuts {
        let edge = (0.5 * cut.width / cut.radius).asin();
        for (angle, turned) in nodes([-edge, edge], PARTS) {
            let (sin, cos) = angle.sin_cos();
            for (x, out) in nodes([foot, cut.radius * cos], 1) {
                let across = turned * cut.radius * cos;
                sum.add(
                    Vector3::new(x, cut.radius * sin, cut.z),
                    -cut.length * across * out,
                );
            }
        }
    }
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
