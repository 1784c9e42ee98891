use crate::figure::{FigureGroup, row};
use crate::unit::Unit::{Angle, Millimetre, MillimetrePerSecond, Radian, RadianPerSecond};

/// Figures of a three-arm mechanism, in the order in which they are shown.
#[rustfmt::skip]
pub const FIGURES: &[FigureGroup] = &[
    FigureGroup {
        heading: "Pitch curves of sun and intermediate gears",
        columns: &["sun", "intermediate"],
        rows: &[
            row("minimum radius", &["sun_radius_min", "intermediate_radius_min"], Millimetre),
            row("maximum radius", &["sun_radius_max", "intermediate_radius_max"], Millimetre),
            row("length", &["pitch_length"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Reach of the tip from the carrier's axis",
        columns: &[],
        rows: &[
            row("lowest", &["tip_lowest"], Millimetre),
            row("highest", &["tip_highest"], Millimetre),
            row("farthest towards the tray", &["tip_farthest"], Millimetre),
            row("radius swept by the gearbox", &["gearbox_radius"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Clearance of the arms",
        columns: &["minimum", "proven"],
        rows: &[
            row("between arms", &["arm_clearance", "arm_clearance_bound"], Millimetre),
            row("at a carrier turn of", &["arm_clearance_input"], Angle),
            row("from planted seedlings", &["arm_seedling_clearance", "arm_seedling_clearance_bound"], Millimetre),
            row("at a carrier turn of", &["arm_seedling_clearance_input"], Angle),
            row("from the tray", &["arm_tray_clearance", "arm_tray_clearance_bound"], Millimetre),
            row("at a carrier turn of", &["arm_tray_clearance_input"], Angle),
            row("from seedlings not yet picked", &["arm_unpicked_clearance", "arm_unpicked_clearance_bound"], Millimetre),
            row("at a carrier turn of", &["arm_unpicked_clearance_input"], Angle),
            row("of gears that do not mesh", &["", "gear_clearance"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Cam and push rod",
        columns: &[],
        rows: &[
            row("maximum pressure angle", &["cam_pressure_angle_max"], Angle),
            row("minimum radius of the cam", &["cam_radius_min"], Millimetre),
            row("stroke of the rod", &["push_rod_stroke"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Speed at the design's rate",
        columns: &[],
        rows: &[
            row("carrier", &["carrier_speed"], RadianPerSecond),
            row("tip at picking", &["picking_speed"], MillimetrePerSecond),
            row("tip speed with two arms", &["picking_speed_of_two_arms"], MillimetrePerSecond),
            row("tip at planting", &["planting_speed"], MillimetrePerSecond),
        ],
    },
    FigureGroup {
        heading: "Limits of the gear train",
        columns: &[],
        rows: &[
            row("maximum mesh phase error", &["mesh_phase_error_max"], Radian),
            row("planet reference angle phi_30", &["planet_reference"], Angle),
        ],
    },
];
