use centrode_geometry::{Mesh, Outline, Point, Segment, Vector};
use centrode_machines::three_arm::ThreeArm;

/// Thickness of the body that represents the ground, mm.
const GROUND: f64 = 20.0;

/// The tray in space with the seedlings still in it: the arms pick from its middle column.
pub(super) fn tray_body(mechanism: &ThreeArm) -> Mesh {
    let design = mechanism.design();
    let (columns, spacing) = (design.tray.columns, design.tray.hole_spacing);
    let level = mechanism.arm_level();
    let tray = mechanism.tray_body();
    let column = |k: u32| level + (f64::from(k) - f64::from(columns / 2)) * spacing;
    let (rear, front) = (column(0) - 0.5 * spacing, column(columns) - 0.5 * spacing);
    let prism = |outline: &Outline, from: f64, to: f64| {
        let placed = tray.placed(outline);
        let corners: Vec<Point> = placed.segments().iter().map(Segment::start).collect();
        Mesh::prism(&corners, from, to)
    };
    let half = 0.5 * design.seedling.width;
    let mut bodies = vec![prism(&tray.plate, rear, front)];
    for stem in &tray.stems {
        bodies.extend((0..columns).map(|k| prism(stem, column(k) - half, column(k) + half)));
    }
    Mesh::joined(&bodies)
}

/// The ground with the seedlings planted in it, in a frame that moves back under the machine: when the first arm plants, the
/// nearest seedling is at the position where it is planted.
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
        // The planted seedlings are behind the machine, which moves towards the tray.
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
