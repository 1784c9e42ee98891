use centrode_geometry::{Mesh, Outline, Point, Vector};
use centrode_mechanism::three_arm::ThreeArm;
use nalgebra::Isometry2;

/// Depth of the tray, in distances of its holes.
const TRAY_DEPTH: f64 = 2.0;
/// Thickness of what stands for the ground, mm.
const GROUND: f64 = 20.0;

/// The tray from the side: a plate behind the surface in which the tip picks.
pub(super) fn tray(mechanism: &ThreeArm) -> Outline {
    let spec = &mechanism.design().tray;
    // Arms enter against the sense of the carrier's turn at the bottom.
    let (sin, cos) = spec.inclination.sin_cos();
    let inward = Vector::new(-mechanism.train().direction().sign() * cos, sin);
    let tip = mechanism.tip(mechanism.picking(0), 0).position;
    let surface = spec.distance.unwrap_or(tip.coords.dot(&inward));
    let middle = tip + inward * (surface - tip.coords.dot(&inward));
    let half = 0.5 * f64::from(spec.rows) * spec.hole_spacing;
    let depth = TRAY_DEPTH * spec.hole_spacing;
    let corners = [[0.0, -half], [depth, -half], [depth, half], [0.0, half]];
    let turn = Isometry2::new(middle.coords, inward.y.atan2(inward.x));
    Outline::polygon(&corners.map(|[x, y]| turn * Point::new(x, y)))
}

/// The tray in space: as wide as its columns, the arms in the middle.
pub(super) fn tray_body(mechanism: &ThreeArm) -> Mesh {
    let spec = &mechanism.design().tray;
    let half = 0.5 * f64::from(spec.columns) * spec.hole_spacing;
    let level = mechanism.arm_level();
    let corners: Vec<Point> = tray(mechanism)
        .segments()
        .iter()
        .map(centrode_geometry::Segment::start)
        .collect();
    Mesh::prism(&corners, level - half, level + half)
}

/// The ground with the seedlings planted in it, in a frame that travels back under the machine: at the
/// first arm's planting the seedling nearest below stands where it has just been planted.
pub(super) fn ground_body(mechanism: &ThreeArm) -> Mesh {
    let design = mechanism.design();
    let level = mechanism.arm_level();
    let reach = 4.0 * mechanism.center_distance();
    let top = mechanism.ground();
    let slab = |min: Point, max: Point, z: [f64; 2]| {
        let corners = [min, Point::new(max.x, min.y), max, Point::new(min.x, max.y)];
        Mesh::prism(&corners, z[0], z[1])
    };
    let below = Point::new(-reach, top - GROUND);
    let mut bodies = vec![slab(
        below,
        Point::new(reach, top),
        [level - reach, level + reach],
    )];
    let spec = &design.seedling;
    if spec.width > 0.0 && spec.height > 0.0 && design.work.plant_spacing > 0.0 {
        // Planted are those which the machine has passed: it travels towards the tray.
        let forward = -mechanism.train().direction().sign();
        let planting = mechanism.planting(0);
        let at = mechanism.tip(planting, 0);
        let over = mechanism.over_ground(&at, planting).position;
        let half = Vector::new(0.5 * spec.width, 0.0);
        for behind in 0..=mechanism.arms() {
            let x = over.x - forward * f64::from(behind) * design.work.plant_spacing;
            let foot = Point::new(x, top);
            let head = foot + half + Vector::new(0.0, spec.height);
            let z = [level - half.x, level + half.x];
            bodies.push(slab(foot - half, head, z));
        }
    }
    Mesh::joined(&bodies)
}
