use super::machine::Machine;
use crate::csv::Column;
use std::f64::consts::PI;

/// Name of the table.
pub(super) const TABLE: &str = "motion.csv";

/// Step of the motion, rad: one degree of the input.
const STEP: f64 = PI / 180.0;

/// Shaft, box and forces over the whole cycle at the design's speed of the input.
pub(super) fn columns(machine: &Machine<'_>) -> Vec<Column> {
    let steps = machine.shaft.groove().steps(STEP);
    let omega = machine.shaft.load().speed();
    let over = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { steps.iter().map(|&t| f(t)).collect() };
    let at = |input: f64| machine.motion(input);
    let force = |input: f64| machine.force(input);
    vec![
        Column::numbers("input_angle_rad", steps.iter().copied()),
        Column::numbers("time_s", over(&|t| t / omega)),
        Column::numbers("shaft_angle_rad", over(&|t| machine.turn(t).position)),
        Column::numbers(
            "shaft_speed_rad_per_s",
            over(&|t| omega * machine.turn(t).velocity),
        ),
        Column::numbers("position_mm", over(&|t| at(t).position)),
        Column::numbers("velocity_mm_per_s", over(&|t| omega * at(t).velocity)),
        Column::numbers(
            "acceleration_mm_per_s2",
            over(&|t| omega * omega * at(t).acceleration),
        ),
        Column::numbers(
            "jerk_mm_per_s3",
            over(&|t| omega * omega * omega * at(t).jerk),
        ),
        Column::numbers("lead_angle_rad", over(&|t| machine.swivel(t).position)),
        Column::numbers(
            "lead_angle_speed_rad_per_s",
            over(&|t| omega * machine.swivel(t).velocity),
        ),
        Column::numbers("push_N", over(&|t| force(t).push)),
        Column::numbers("normal_force_N", over(&|t| force(t).normal)),
        Column::numbers("transverse_force_N", over(&|t| force(t).transverse)),
        Column::numbers("shaft_torque_Nmm", over(&|t| force(t).torque)),
        Column::numbers(
            "input_torque_Nmm",
            over(&|t| force(t).torque * machine.turn(t).velocity),
        ),
    ]
}

/// Where a joint of the model stands as the law begins, rad or mm: its zero; nothing for one that stands still.
pub(super) fn start(machine: &Machine<'_>, joint: &str) -> f64 {
    match joint {
        "shaft_joint" => -machine.turn(0.0).position,
        "box_joint" => machine.motion(0.0).position,
        "slider_joint" => machine.swivel(0.0).position,
        "driver_joint" => machine
            .gears
            .as_ref()
            .map_or(0.0, |gears| gears.turns(0.0)[0]),
        _ => 0.0,
    }
}

/// What the table means, as JSON for programs: joints, how to read between rows and beyond them.
pub(super) fn sidecar(machine: &Machine<'_>) -> Vec<u8> {
    let shaft = machine.shaft;
    let load = shaft.load();
    let joint = |link: &str, column: &str, speed: &str, factor: f64| {
        let name = format!("{link}_joint");
        let zero = start(machine, &name);
        // In metres and radians, as the model counts.
        let offset = if link == "box" { -1e-3 * zero } else { -zero } + 0.0;
        format!(
            r#"    {{"name": "{name}", "column": "{column}", "speed": "{speed}", "factor": {factor:?}, "offset": {offset:?}}}"#
        )
    };
    let lead_speed = "lead_angle_speed_rad_per_s";
    let mut joints = vec![
        joint("shaft", "shaft_angle_rad", "shaft_speed_rad_per_s", -1.0),
        joint("box", "position_mm", "velocity_mm_per_s", 1e-3),
        joint("slider", "lead_angle_rad", lead_speed, 1.0),
    ];
    if machine.gears.is_some() {
        joints.push(format!(
            r#"    {{"name": "driver_joint", "column": "input_angle_rad", "speed": {speed:?}, "factor": 1.0, "offset": 0.0}}"#,
            speed = load.speed(),
        ));
    }
    format!(
        r#"{{
  "table": "{TABLE}",
  "rows": {rows},
  "travel": "input_angle_rad",
  "speed_rad_per_s": {speed:?},
  "moved_mass_kg": {mass:?},
  "rail_force_N": {rail:?},
  "joints": [
{joints}
  ],
  "interpolation": {{"kind": "cubic Hermite", "slopes": "the speed columns, over time_s"}},
  "continuation": {{"kind": "cyclic", "input_angle_rad": {period:?}, "shaft_angle_rad": {period:?}, "time_s": {time:?}}}
}}
"#,
        rows = shaft.groove().steps(STEP).len(),
        speed = load.speed(),
        mass = load.mass,
        rail = load.mass * centrode_mechanism::shaft::GRAVITY * load.rail_friction,
        joints = joints.join(",\n"),
        period = shaft.cycle(),
        time = shaft.cycle() / load.speed(),
    )
    .into_bytes()
}
