use centrode_formats::csv::Column;
use centrode_geometry::Tolerance;
use centrode_groove::{Schedule, SpiralShaft};
use centrode_kinematics::transmission::Transmission;
use std::f64::consts::PI;

/// Step of the lead table, rad: 1 deg.
const LEAD_STEP: f64 = PI / 180.0;

/// Position, speed and lead angle every degree over the whole cycle.
pub(super) fn lead(shaft: &SpiralShaft) -> Vec<Column> {
    let groove = shaft.groove();
    let steps = groove.steps(LEAD_STEP);
    let over = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { steps.iter().map(|&t| f(t)).collect() };
    let at = |theta: f64| groove.traverse().at(theta);
    vec![
        Column::numbers("shaft_angle_deg", over(&f64::to_degrees)),
        Column::numbers("position_mm", over(&|t| at(t).position)),
        Column::numbers("speed_mm_per_turn", over(&|t| 2.0 * PI * at(t).velocity)),
        Column::numbers(
            "lead_angle_deg",
            over(&|t| groove.lead_angle(t).to_degrees()),
        ),
        Column::numbers("developed_curvature_per_mm", over(&|t| groove.curvature(t))),
    ]
}

/// The schedule: the hole that is picked at each turn.
pub(super) fn schedule(schedule: &Schedule) -> Vec<Column> {
    let picks = &schedule.picks;
    let over = |f: &dyn Fn(usize) -> f64| -> Vec<f64> { (0..picks.len()).map(f).collect() };
    vec![
        Column::numbers("turn", over(&|i| f64::from(picks[i].turn))),
        Column::numbers("shaft_angle_deg", over(&|i| picks[i].theta.to_degrees())),
        Column::words("way", picks.iter().map(|p| p.way.name().to_owned())),
        Column::numbers("hole", over(&|i| f64::from(picks[i].hole))),
        Column::numbers("position_mm", over(&|i| picks[i].position)),
        Column::numbers("misplacement_mm", over(&|i| picks[i].misplacement)),
        Column::numbers("moved_while_picking_mm", over(&|i| picks[i].swept)),
    ]
}

/// The path of the mill: angle of the shaft in its chuck, position along it, depth below the surface.
pub(super) fn tool_path(shaft: &SpiralShaft, tolerance: Tolerance) -> Vec<Column> {
    let groove = shaft.groove();
    let mill = &shaft.design().mill;
    let (mut pass, mut angle, mut along, mut depth) = (vec![], vec![], vec![], vec![]);
    let mut number = 0.0;
    for below in mill.depths(groove) {
        for way in mill.ways(groove, tolerance) {
            for point in way {
                pass.push(number);
                angle.push((point.x / groove.radius()).to_degrees());
                along.push(point.y);
                depth.push(below);
            }
            number += 1.0;
        }
    }
    vec![
        Column::numbers("pass", pass),
        Column::numbers("a_deg", angle),
        Column::numbers("x_mm", along),
        Column::numbers("depth_mm", depth),
    ]
}
