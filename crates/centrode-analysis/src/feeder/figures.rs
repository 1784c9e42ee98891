use crate::figure::{FigureGroup, row};
use crate::unit::Unit::{
    Angle, Count, Millimetre, MillimetrePerSecond, NewtonMillimetre, NewtonPerSquareMillimetre,
    Number, PerMinute, RadianPerSecond, RadianPerSecondSquared, Second, TurnsPerMinute,
};

/// Figures of a feeder, in the order in which they are shown.
#[rustfmt::skip]
pub const FIGURES: &[FigureGroup] = &[
    FigureGroup {
        heading: "Strokes of the effector",
        columns: &["feed", "return", "rest"],
        rows: &[
            row("time", &["feed_time", "return_time", "dwell_time"], Second),
            row("maximum speed of the tip", &["tip_speed_feed_max", "tip_speed_return_max"], MillimetrePerSecond),
            row("maximum tip speed at the ends", &["tip_speed_ends_max"], MillimetrePerSecond),
            row("feed time over return time", &["quick_return"], Number),
        ],
    },
    FigureGroup {
        heading: "Crank-rocker",
        columns: &["minimum", "maximum"],
        rows: &[
            row("angle of coupler and rocker", &["coupler_rocker_angle_min", "coupler_rocker_angle_max"], Angle),
            row("angle of the effector", &["effector_angle_min", "effector_angle_max"], Angle),
            row("swing with tolerances", &["swing_made_min", "swing_made_max"], Angle),
            row("swing of the rocker", &["", "rocker_swing"], Angle),
            row("dead centres, folded, stretched", &["dead_center_folded", "dead_center_stretched"], Angle),
            row("slider folded: x, y", &["slider_folded_x", "slider_folded_y"], Millimetre),
            row("slider stretched: x, y", &["slider_stretched_x", "slider_stretched_y"], Millimetre),
            row("distance of slider from pivot", &["slider_distance_min"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Swing of the effector",
        columns: &[],
        rows: &[
            row("swing", &["swing"], Angle),
            row("standard deviation, tolerances", &["swing_made_deviation"], Angle),
            row("maximum error, first order", &["swing_first_order_max"], Angle),
            row("minimum transmission angle", &["transmission_angle_min"], Angle),
            row("maximum angle within bounds", &["attainable_transmission_angle"], Angle),
            row("required widening of bounds", &["minimum_widening"], Number),
            row("distance of pivot from chord", &["pivot_from_chord"], Millimetre),
            row("clearance of effector and shaft", &["shaft_clearance_min"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Drive of the crank",
        columns: &["driven", "at rest"],
        rows: &[
            row("driver angle", &["motion_angle", "dwell_angle"], Angle),
            row("backlash of the crank", &["gear_play_moving_max", "gear_play_resting_max"], Angle),
            row("ratio", &["arc_ratio"], Number),
            row("crank", &["crank_rpm_driven"], TurnsPerMinute),
            row("driver", &["driver_rpm"], TurnsPerMinute),
            row("feed rate, cuttings", &["feed_rate"], PerMinute),
            row("crank turns per cycle", &["crank_turns_a_cycle"], Number),
            row("crank angle of the feed", &["feed_crank_angle"], Angle),
            row("crank angle, feed over return", &["crank_quick_return"], Number),
            row("maximum torque of the crank", &["crank_torque_moving_max", "crank_torque_still_max"], NewtonMillimetre),
            row("pressure on the crank's key", &["crank_key_pressure_max", "crank_key_pressure_still_max"], NewtonPerSquareMillimetre),
            row("pressure on the keys of the gears", &["gear_driven_key_pressure_max", "gear_driver_key_pressure_max"], NewtonPerSquareMillimetre),
            row("jump of the crank's speed", &["crank_speed_jump"], RadianPerSecond),
            row("maximum crank acceleration", &["crank_acceleration_max"], RadianPerSecondSquared),
            row("teeth of the driver", &["gear_teeth"], Count),
            row("centre distance", &["gear_center_distance"], Millimetre),
            row("radius of the locking arc", &["gear_lock_radius"], Millimetre),
            row("penetration", &["gear_penetration_max"], Millimetre),
            row("clearance of cams, largest pins", &["gear_pin_clearance_min"], Millimetre),
        ],
    },
];
