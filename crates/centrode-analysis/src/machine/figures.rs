use crate::figure::{FigureGroup, row};
use crate::unit::Unit::{
    Angle, Count, MetrePerSecondSquared, NewtonMillimetre, NewtonPerSquareMillimetre,
    TurnsPerMinute,
};

/// Figures of a composed machine, in the order in which they are shown.
#[rustfmt::skip]
pub(super) const FIGURES: &[FigureGroup] = &[FigureGroup {
    heading: "Machine",
    columns: &[],
    rows: &[
        row("bodies", &["body_count"], Count),
        row("dyads", &["dyad_count"], Count),
        row("speed of the input", &["input_rpm"], TurnsPerMinute),
        row("period", &["period"], Angle),
        row("minimum transmission angle", &["transmission_angle_min"], Angle),
        row("gravity", &["gravity"], MetrePerSecondSquared),
        row("minimum torque of the input", &["input_torque_min"], NewtonMillimetre),
        row("maximum torque of the input", &["input_torque_max"], NewtonMillimetre),
        row("mean torque of the input", &["input_torque_mean"], NewtonMillimetre),
        row("maximum stress of a shaft held at one end", &["overhung_stress_max"], NewtonPerSquareMillimetre),
        row("maximum pressure on a key", &["key_pressure_max"], NewtonPerSquareMillimetre),
    ],
}];
