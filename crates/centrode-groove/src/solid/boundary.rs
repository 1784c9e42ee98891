//! The boundary of the grooved shaft on exact surfaces.

use std::f64::consts::PI;

use centrode_geometry::{BezierFit, Shell, ShellBuilder, ShellSide, ShellSurface};

use super::plan::{Level, Plan};
use super::surface::Surface;
use super::{ShaftBody, ends};
use crate::{Groove, Wall};

/// Numbers of equally spaced lines that are tried until the surfaces meet every edge.
const LINES: [u32; 4] = [8, 16, 32, MAX_LINES];
/// Maximum number of equally spaced lines.
pub(super) const MAX_LINES: u32 = 64;
/// Distance within which an edge must be met, mm: below the resolution of CAD kernels.
const MET: f64 = 1e-7;

/// Builds the whole boundary; `None` if smooth pieces cannot meet the edges.
pub(super) fn shell(groove: &Groove, body: &ShaftBody, thick: [f64; 2]) -> Option<Shell> {
    let fit = BezierFit::default();
    LINES.iter().find_map(|&count| {
        let floor = Level {
            half: 0.5 * groove.width(),
            radius: groove.radius() - groove.depth(),
        };
        let plan = Plan::smooth(groove, floor, count);
        let mut boundary = ShellBuilder::default();
        grooved(&mut boundary, &fit, &plan, groove.radius(), thick)?;
        ends::close(&mut boundary, body, groove.radius(), thick, &plan.lines)?;
        Some(boundary.finish()).filter(Shell::is_closed)
    })
}

/// Adds the grooved length: land, floor and walls. `None` where a piece misses its edge.
fn grooved(
    boundary: &mut ShellBuilder,
    fit: &BezierFit,
    plan: &Plan<'_>,
    radius: f64,
    thick: [f64; 2],
) -> Option<()> {
    let mut surface = Surface::new(plan, radius, thick);
    surface.find();
    let floor = plan.levels[0].radius;
    let count = plan.lines.len();
    let on = |line: usize, land: bool| surface.heights_on(line % count, land);
    let strips = surface.tops_by_line();
    for (line, tops) in strips.iter().enumerate() {
        let start = plan.lines[line];
        let end = plan.lines.get(line + 1).copied().unwrap_or(2.0 * PI);
        let angles = [start, plan.lines[(line + 1) % count]];
        // Both edges of every wall, from this line to the next.
        let mut walls = Vec::new();
        for &(edge, heights) in tops {
            let at = |phi: f64| plan.height(edge, phi);
            let top = fitted(fit, radius, [start, end], angles, heights, &at)?;
            let foot = fitted(fit, floor, [start, end], angles, heights, &at)?;
            let raised = plan.edge(edge).wall == Wall::Left;
            let sides = [boundary.bezier(top.clone()), boundary.bezier(foot.clone())];
            wall(boundary, [foot, top], sides, raised);
            walls.push((heights, sides));
        }
        for k in 0..=walls.len() {
            // Land first, then alternately floor and land.
            let land = k % 2 == 0;
            let r = if land { radius } else { floor };
            let mut ring = |side: usize, z: f64| {
                let (sin, cos) = angles[side].sin_cos();
                boundary.vertex([r * cos, r * sin, z])
            };
            let low = k.checked_sub(1).map_or([thick[0]; 2], |k| walls[k].0);
            let high = walls.get(k).map_or([thick[1]; 2], |w| w.0);
            let [left, right] = [0, 1].map(|side| {
                let within = |z: &f64| *z > low[side] && *z < high[side];
                let between: Vec<f64> = on(line + side, land).into_iter().filter(within).collect();
                let all = [low[side]].into_iter().chain(between).chain([high[side]]);
                all.map(|z| ring(side, z)).collect::<Vec<usize>>()
            });
            let of = |sides: [ShellSide; 2]| sides[usize::from(!land)];
            let bottom = match k.checked_sub(1) {
                Some(k) => of(walls[k].1),
                None => boundary.arc(left[0], right[0], r),
            };
            let above = match walls.get(k) {
                Some(wall) => of(wall.1),
                None => boundary.arc(left[left.len() - 1], right[right.len() - 1], r),
            };
            let mut bound = vec![bottom];
            bound.extend(boundary.lines(&right));
            bound.push(above.reversed());
            let down: Vec<usize> = left.into_iter().rev().collect();
            bound.extend(boundary.lines(&down));
            boundary.face(ShellSurface::Cylinder { radius: r }, vec![bound]);
        }
    }
    Some(())
}

/// Adds one wall: straight from the foot outwards. `raised` where the land is above it.
fn wall(
    boundary: &mut ShellBuilder,
    points: [Vec<[f64; 3]>; 2],
    [top, foot]: [ShellSide; 2],
    raised: bool,
) {
    let last = points[0].len() - 1;
    let [feet, tops] = [0, 1].map(|k| [points[k][0], points[k][last]].map(|p| boundary.vertex(p)));
    let out = [0, 1].map(|side| boundary.line(feet[side], tops[side]));
    let bound = if raised {
        vec![foot, out[1], top.reversed(), out[0].reversed()]
    } else {
        vec![out[0], top, out[1].reversed(), foot.reversed()]
    };
    // The cross product of the direction round the shaft and the outward direction points down.
    let surface = ShellSurface::Ruled {
        points,
        outward: raised,
    };
    boundary.face(surface, vec![bound]);
}

/// The edge at a radius between two angles; its ends are at the angles and heights given, which differ from the curve's by
/// rounding. `None` if the fitted edge misses the curve.
fn fitted(
    fit: &BezierFit,
    radius: f64,
    [start, end]: [f64; 2],
    angles: [f64; 2],
    heights: [f64; 2],
    at: &dyn Fn(f64) -> f64,
) -> Option<Vec<[f64; 3]>> {
    let place = |x: f64| {
        let phi = start + (end - start) * x;
        [radius * phi.cos(), radius * phi.sin(), at(phi)]
    };
    let mut points = fit.through(&place);
    let last = points.len() - 1;
    for (side, i) in [0, last].into_iter().enumerate() {
        let (sin, cos) = angles[side].sin_cos();
        points[i] = [radius * cos, radius * sin, heights[side]];
    }
    let met = fit.nodes().windows(2).all(|pair| {
        let x = 0.5 * (pair[0] + pair[1]);
        let (found, exact) = (BezierFit::at(&points, x), place(x));
        (0..3).all(|axis| (found[axis] - exact[axis]).abs() <= MET)
    });
    met.then_some(points)
}
