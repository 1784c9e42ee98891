use crate::csv::Column;
use centrode_mechanism::feeder::{Feeder, JointPositions};
use std::f64::consts::TAU;

/// Rows of one cycle: every eighth of a degree.
const STEPS: u32 = 2880;

fn inputs() -> impl Iterator<Item = f64> {
    (0..=STEPS).map(|i| TAU * f64::from(i) / f64::from(STEPS))
}

/// Every joint over one cycle, and the tip of the effector.
pub(super) fn columns(feeder: &Feeder) -> Vec<Column> {
    let speed = feeder.speed();
    let reach = feeder.six_bar().effector_length();
    let over = |f: &dyn Fn(f64) -> f64| -> Vec<f64> { inputs().map(f).collect() };
    let joint = |name: &str, f: &dyn Fn(JointPositions) -> f64| {
        Column::numbers(name, over(&|input| f(feeder.joint_positions(input))))
    };
    vec![
        Column::numbers("input_angle_rad", inputs()),
        Column::numbers("time_s", over(&|input| input / speed)),
        joint("crank_joint_rad", &|j| j.crank),
        joint("coupler_joint_rad", &|j| j.coupler),
        joint("rocker_joint_rad", &|j| j.rocker),
        joint("effector_joint_rad", &|j| j.effector),
        joint("slider_joint_mm", &|j| j.slider),
        Column::numbers("tip_x_mm", over(&|input| feeder.tip(input).x)),
        Column::numbers("tip_y_mm", over(&|input| feeder.tip(input).y)),
        Column::numbers(
            "tip_speed_mm_per_s",
            over(&|input| (feeder.effector(input).velocity * speed * reach).abs()),
        ),
    ]
}

/// What `motion.csv` means, as JSON for programs.
pub(super) fn sidecar(feeder: &Feeder) -> Vec<u8> {
    format!(
        r#"{{
  "table": "motion.csv",
  "columns": [
    {{"name": "input_angle_rad", "unit": "rad", "meaning": "angle the incomplete gear has turned by since the effector left its place of rest"}},
    {{"name": "time_s", "unit": "s", "meaning": "time at the design's speed"}},
    {{"name": "crank_joint_rad", "unit": "rad", "meaning": "crank against the frame, counter-clockwise since it rested"}},
    {{"name": "coupler_joint_rad", "unit": "rad", "meaning": "coupler against the crank"}},
    {{"name": "rocker_joint_rad", "unit": "rad", "meaning": "rocker against the frame"}},
    {{"name": "effector_joint_rad", "unit": "rad", "meaning": "effector against the frame"}},
    {{"name": "slider_joint_mm", "unit": "mm", "meaning": "slider along the effector, outwards"}},
    {{"name": "tip_x_mm", "unit": "mm", "meaning": "tip E of the effector, from the crank's shaft"}},
    {{"name": "tip_y_mm", "unit": "mm", "meaning": "tip E of the effector, from the crank's shaft"}},
    {{"name": "tip_speed_mm_per_s", "unit": "mm/s", "meaning": "speed of the tip at the design's speed"}}
  ],
  "rows": {rows},
  "joints": [
    {{"name": "crank_joint", "column": "crank_joint_rad", "factor": 1.0}},
    {{"name": "coupler_joint", "column": "coupler_joint_rad", "factor": 1.0}},
    {{"name": "rocker_joint", "column": "rocker_joint_rad", "factor": 1.0}},
    {{"name": "effector_joint", "column": "effector_joint_rad", "factor": 1.0}},
    {{"name": "slider_joint", "column": "slider_joint_mm", "factor": 0.001}}
  ],
  "zero": {{"crank_angle_rad": {start:?}, "meaning": "every joint is zero where the effector rests"}},
  "continuation": {{"kind": "cyclic", "input_angle_rad": {TAU:?}, "crank_joint_rad": {TAU:?}}},
  "speed_rad_per_s": {speed:?}
}}
"#,
        rows = STEPS + 1,
        start = feeder.start(),
        speed = feeder.speed(),
    )
    .into_bytes()
}
