use crate::figure::{FigureGroup, row};
use crate::unit::Unit::{Angle, Count, Millimetre, Number, PerMillimetre, Pitch, Radian};

/// Figures of a gear pair, in the order in which they are shown.
#[rustfmt::skip]
pub const FIGURES: &[FigureGroup] = &[
    FigureGroup {
        heading: "Pitch curves",
        columns: &["driver", "driven"],
        rows: &[
            row("teeth", &["driver_tooth_count", "driven_tooth_count"], Count),
            row("length", &["driver_pitch_length", "driven_pitch_length"], Millimetre),
            row("minimum radius", &["driver_radius_min", "driven_radius_min"], Millimetre),
            row("maximum radius", &["driver_radius_max", "driven_radius_max"], Millimetre),
            row("minimum curvature", &["driver_curvature_min", "driven_curvature_min"], PerMillimetre),
            row("maximum curvature", &["driver_curvature_max", "driven_curvature_max"], PerMillimetre),
        ],
    },
    FigureGroup {
        heading: "Teeth",
        columns: &["driver", "driven"],
        rows: &[
            row("tip radius, maximum", &["driver_tip_radius_max", "driven_tip_radius_max"], Millimetre),
            row("root radius, minimum", &["driver_root_radius_min", "driven_root_radius_min"], Millimetre),
            row("profile shift coefficient", &["driver_shift", "driven_shift"], Number),
            row("tip width, minimum", &["driver_tip_width_min", "driven_tip_width_min"], Millimetre),
            row("base tangent length", &["driver_base_tangent", "driven_base_tangent"], Millimetre),
            row("teeth of the base tangent length", &["driver_base_tangent_teeth", "driven_base_tangent_teeth"], Count),
            row("fillet radius, minimum", &["driver_fillet_radius_min", "driven_fillet_radius_min"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Mesh, over the whole cycle",
        columns: &["minimum", "maximum"],
        rows: &[
            row("ratio, driven to driver", &["ratio_min", "ratio_max"], Number),
            row("tooth pairs in contact", &["pairs_in_contact_min", "pairs_in_contact_max"], Count),
            row("contact ratio, mean", &["contact_ratio_mean"], Number),
            row("backlash of the driven gear", &["backlash_min", "backlash_max"], Angle),
            row("backlash, normal", &["normal_backlash_min", "normal_backlash_max"], Millimetre),
            row("transmission error", &["", "transmission_error_max"], Radian),
            row("penetration", &["", "penetration_max"], Millimetre),
            row("pressure angle", &["", "pressure_angle_max"], Angle),
            row("sliding per driver radian", &["", "sliding_max"], Millimetre),
            row("clearance, tip to root", &["clearance_min"], Millimetre),
            row("clearance, tip to fillet", &["fillet_clearance_min"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "After cutting",
        columns: &["minimum", "maximum"],
        rows: &[
            row("backlash, normal", &["cut_backlash_min", "cut_backlash_max"], Millimetre),
            row("clearance, tip to root", &["cut_clearance_min"], Millimetre),
            row("clearance, tip to fillet", &["cut_fillet_clearance_min"], Millimetre),
        ],
    },
    FigureGroup {
        heading: "Housing",
        columns: &["driver", "driven"],
        rows: &[
            row("radius of the chamber", &["driver_chamber_radius", "driven_chamber_radius"], Millimetre),
            row("volume per turn of the driver, cm³", &["volume_per_turn"], Number),
        ],
    },
    FigureGroup {
        heading: "Limits and settings",
        columns: &[],
        rows: &[
            row("centre distance", &["center_distance"], Millimetre),
            row("module", &["module"], Millimetre),
            row("maximum grinding wheel radius", &["cam_concave_radius_min"], Millimetre),
            row("largest module for the tool's flanks", &["largest_module"], Millimetre),
            row("largest addendum, no undercut", &["largest_addendum"], Millimetre),
            row("phase of the first tooth", &["phase"], Pitch),
            row("driver's share of the pitch", &["thickness_split"], Number),
            row("tip shortening coefficient", &["tip_shortening"], Number),
            row("pressure angle of the tool", &["tool_pressure_angle"], Angle),
            row("closure error", &["closure_error"], Radian),
        ],
    },
];
