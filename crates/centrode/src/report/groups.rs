use super::unit::Unit;

/// Row of the table: its title, its figures, their unit.
pub(super) struct Row(
    pub(super) &'static str,
    pub(super) &'static [&'static str],
    pub(super) Unit,
);

/// Group of the table: its heading, the columns, the rows.
pub(super) struct Group(
    pub(super) &'static str,
    pub(super) &'static [&'static str],
    pub(super) &'static [Row],
);

pub(super) const GROUPS: [Group; 16] = [
    Group(
        "Pitch curves",
        &["driver", "driven"],
        &[
            Row(
                "teeth",
                &["driver_tooth_count", "driven_tooth_count"],
                Unit::Count,
            ),
            Row(
                "length",
                &["driver_pitch_length", "driven_pitch_length"],
                Unit::Millimetre,
            ),
            Row(
                "least radius",
                &["driver_radius_min", "driven_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "greatest radius",
                &["driver_radius_max", "driven_radius_max"],
                Unit::Millimetre,
            ),
            Row(
                "least curvature",
                &["driver_curvature_min", "driven_curvature_min"],
                Unit::PerMillimetre,
            ),
            Row(
                "greatest curvature",
                &["driver_curvature_max", "driven_curvature_max"],
                Unit::PerMillimetre,
            ),
        ],
    ),
    Group(
        "Teeth",
        &["driver", "driven"],
        &[
            Row(
                "tip radius, greatest",
                &["driver_tip_radius_max", "driven_tip_radius_max"],
                Unit::Millimetre,
            ),
            Row(
                "root radius, least",
                &["driver_root_radius_min", "driven_root_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "tip width, least",
                &["driver_tip_width_min", "driven_tip_width_min"],
                Unit::Millimetre,
            ),
            Row(
                "fillet radius, least",
                &["driver_fillet_radius_min", "driven_fillet_radius_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Mesh, over the whole cycle",
        &["least", "greatest"],
        &[
            Row(
                "ratio, driven to driver",
                &["ratio_min", "ratio_max"],
                Unit::Number,
            ),
            Row(
                "contacts at once",
                &["contact_ratio_min", "contact_ratio_max"],
                Unit::Count,
            ),
            Row("contact ratio, mean", &["contact_ratio_mean"], Unit::Number),
            Row(
                "backlash of the driven gear",
                &["backlash_min", "backlash_max"],
                Unit::Degree,
            ),
            Row(
                "backlash, normal",
                &["normal_backlash_min", "normal_backlash_max"],
                Unit::Millimetre,
            ),
            Row(
                "transmission error",
                &["", "transmission_error_max"],
                Unit::Radian,
            ),
            Row("overlap", &["", "overlap_max"], Unit::Millimetre),
            Row("pressure angle", &["", "pressure_angle_max"], Unit::Degree),
            Row(
                "sliding a rad of the driver",
                &["", "sliding_max"],
                Unit::Millimetre,
            ),
            Row(
                "clearance, tip to root",
                &["clearance_min"],
                Unit::Millimetre,
            ),
            Row(
                "clearance, tip to fillet",
                &["fillet_clearance_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Pitch curves of sun and intermediate gears",
        &["sun", "intermediate"],
        &[
            Row(
                "least radius",
                &["sun_radius_min", "intermediate_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "greatest radius",
                &["sun_radius_max", "intermediate_radius_max"],
                Unit::Millimetre,
            ),
            Row("length", &["pitch_length"], Unit::Millimetre),
        ],
    ),
    Group(
        "Reach of the tip from the carrier's axis",
        &[],
        &[
            Row("lowest", &["tip_lowest"], Unit::Millimetre),
            Row("highest", &["tip_highest"], Unit::Millimetre),
            Row(
                "farthest towards the tray",
                &["tip_farthest"],
                Unit::Millimetre,
            ),
            Row(
                "radius swept by the gearbox",
                &["gearbox_radius"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Clearance of the arms",
        &["least", "proven"],
        &[
            Row(
                "from one another",
                &["arm_clearance", "arm_clearance_bound"],
                Unit::Millimetre,
            ),
            Row(
                "at a carrier turn of",
                &["arm_clearance_input"],
                Unit::Degree,
            ),
            Row(
                "from planted seedlings",
                &["arm_seedling_clearance", "arm_seedling_clearance_bound"],
                Unit::Millimetre,
            ),
            Row(
                "at a carrier turn of",
                &["arm_seedling_clearance_input"],
                Unit::Degree,
            ),
            Row(
                "from the tray",
                &["arm_tray_clearance", "arm_tray_clearance_bound"],
                Unit::Millimetre,
            ),
            Row(
                "at a carrier turn of",
                &["arm_tray_clearance_input"],
                Unit::Degree,
            ),
            Row(
                "from seedlings not yet picked",
                &["arm_unpicked_clearance", "arm_unpicked_clearance_bound"],
                Unit::Millimetre,
            ),
            Row(
                "at a carrier turn of",
                &["arm_unpicked_clearance_input"],
                Unit::Degree,
            ),
            Row(
                "of gears that do not mesh",
                &["", "gear_clearance"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Cam and push rod",
        &[],
        &[
            Row(
                "greatest pressure angle",
                &["cam_pressure_angle_max"],
                Unit::Degree,
            ),
            Row(
                "least radius of the cam",
                &["cam_radius_min"],
                Unit::Millimetre,
            ),
            Row(
                "largest wheel to grind it",
                &["cam_hollow_radius_min"],
                Unit::Millimetre,
            ),
            Row("stroke of the rod", &["push_rod_stroke"], Unit::Millimetre),
        ],
    ),
    Group(
        "Speed at the design's rate",
        &[],
        &[
            Row("carrier", &["carrier_speed"], Unit::RadianPerSecond),
            Row(
                "tip at picking",
                &["picking_speed"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "the same with two arms",
                &["picking_speed_of_two_arms"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "tip at planting",
                &["planting_speed"],
                Unit::MillimetrePerSecond,
            ),
        ],
    ),
    Group(
        "Limits and settings",
        &[],
        &[
            Row("centre distance", &["center_distance"], Unit::Millimetre),
            Row("module", &["module"], Unit::Millimetre),
            Row(
                "largest module, no undercut",
                &["largest_module"],
                Unit::Millimetre,
            ),
            Row(
                "largest addendum, no undercut",
                &["largest_addendum"],
                Unit::Millimetre,
            ),
            Row("phase of the first tooth", &["phase"], Unit::Pitch),
            Row(
                "teeth off their mates",
                &["mesh_phase_error_max"],
                Unit::Radian,
            ),
            Row("planet's zero, behind", &["planet_reference"], Unit::Degree),
            Row("closure error", &["closure_error"], Unit::Radian),
        ],
    ),
    Group(
        "Box and groove",
        &[],
        &[
            Row("moves while picking", &["moved_distance"], Unit::Millimetre),
            Row(
                "limit, a sixth of the pot",
                &["moved_distance_limit"],
                Unit::Millimetre,
            ),
            Row(
                "with a plain shaft",
                &["moved_distance_plain"],
                Unit::Millimetre,
            ),
            Row(
                "the most of any pick",
                &["moved_distance_of_cycle_max"],
                Unit::Millimetre,
            ),
            Row("lead", &["lead"], Unit::Millimetre),
            Row("amplitude", &["amplitude"], Unit::Millimetre),
            Row(
                "least speed over the mean",
                &["speed_ratio_min"],
                Unit::Number,
            ),
            Row(
                "greatest speed over the mean",
                &["speed_ratio_max"],
                Unit::Number,
            ),
            Row(
                "least speed a rad of the shaft",
                &["speed_min"],
                Unit::Millimetre,
            ),
            Row(
                "greatest speed a rad of the shaft",
                &["speed_max"],
                Unit::Millimetre,
            ),
            Row(
                "greatest braking a rad squared",
                &["deceleration_max"],
                Unit::Millimetre,
            ),
            Row(
                "greatest braking, m/s^2",
                &["deceleration_max_m_s2"],
                Unit::Number,
            ),
            Row(
                "run out at the far end",
                &["overshoot_far"],
                Unit::Millimetre,
            ),
            Row(
                "run out at the near end",
                &["overshoot_near"],
                Unit::Millimetre,
            ),
            Row("turns out and back", &["cycle_turns"], Unit::Count),
            Row(
                "worst miss of a hole",
                &["misplacement_max"],
                Unit::Millimetre,
            ),
            Row("least lead angle", &["lead_angle_min"], Unit::Degree),
            Row("greatest lead angle", &["lead_angle_max"], Unit::Degree),
            Row("tightest bend", &["bend_radius_min"], Unit::Millimetre),
            Row("crossings", &["crossing_count"], Unit::Count),
            Row(
                "of them passed while picking",
                &["crossings_while_picking"],
                Unit::Count,
            ),
            Row(
                "shortest gap at a crossing",
                &["crossing_gap_min"],
                Unit::Millimetre,
            ),
            Row(
                "longest gap at a crossing",
                &["crossing_gap_max"],
                Unit::Millimetre,
            ),
            Row(
                "slider in the groove, if flat",
                &["slider_guided_length"],
                Unit::Millimetre,
            ),
            Row(
                "slider that turns on its pin",
                &["slider_length_free_on_pin"],
                Unit::Millimetre,
            ),
            Row(
                "walls off the slider's sides",
                &["wall_deviation_max"],
                Unit::Millimetre,
            ),
            Row(
                "clearance the slider needs",
                &["slider_clearance_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Forces on the slider",
        &[],
        &[
            Row("least on the strokes", &["normal_force_min"], Unit::Newton),
            Row(
                "greatest on the strokes",
                &["normal_force_max"],
                Unit::Newton,
            ),
            Row("while picking", &["normal_force_picking"], Unit::Newton),
            Row(
                "greatest in a reversal",
                &["normal_force_reversal_max"],
                Unit::Newton,
            ),
            Row("least torque", &["torque_min"], Unit::NewtonMillimetre),
            Row("greatest torque", &["torque_max"], Unit::NewtonMillimetre),
            Row("speed", &["speed_rpm"], Unit::TurnsPerMinute),
            Row(
                "stays on one wall up to",
                &["contact_limit_rpm"],
                Unit::TurnsPerMinute,
            ),
            Row(
                "the same, reversals too",
                &["contact_limit_cycle_rpm"],
                Unit::TurnsPerMinute,
            ),
            Row("jams at a lead angle of", &["jamming_angle"], Unit::Degree),
        ],
    ),
    Group(
        "Strokes of the effector",
        &["feed", "return", "rest"],
        &[
            Row(
                "time",
                &["feed_time", "return_time", "dwell_time"],
                Unit::Second,
            ),
            Row(
                "greatest speed of the tip",
                &["tip_speed_feed_max", "tip_speed_return_max"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "tip at the ends",
                &["tip_speed_ends_max"],
                Unit::MillimetrePerSecond,
            ),
            Row(
                "feed time over return time",
                &["quick_return"],
                Unit::Number,
            ),
        ],
    ),
    Group(
        "Crank-rocker",
        &["least", "greatest"],
        &[
            Row(
                "angle of coupler and rocker",
                &["coupler_rocker_angle_min", "coupler_rocker_angle_max"],
                Unit::Degree,
            ),
            Row(
                "angle of the effector",
                &["effector_angle_min", "effector_angle_max"],
                Unit::Degree,
            ),
            Row(
                "swing, as made",
                &["swing_made_min", "swing_made_max"],
                Unit::Degree,
            ),
            Row("swing of the rocker", &["", "rocker_swing"], Unit::Degree),
            Row(
                "dead centres, folded, stretched",
                &["dead_center_folded", "dead_center_stretched"],
                Unit::Degree,
            ),
            Row(
                "slider folded: x, y",
                &["slider_folded_x", "slider_folded_y"],
                Unit::Millimetre,
            ),
            Row(
                "slider stretched: x, y",
                &["slider_stretched_x", "slider_stretched_y"],
                Unit::Millimetre,
            ),
            Row(
                "slider from the pivot",
                &["slider_distance_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Swing of the effector",
        &[],
        &[
            Row("swing", &["swing"], Unit::Degree),
            Row(
                "its standard deviation, as made",
                &["swing_made_deviation"],
                Unit::Degree,
            ),
            Row(
                "most off, to first order",
                &["swing_first_order_max"],
                Unit::Degree,
            ),
            Row(
                "least transmission angle",
                &["transmission_angle_min"],
                Unit::Degree,
            ),
            Row(
                "the best within the bounds",
                &["attainable_transmission_angle"],
                Unit::Degree,
            ),
            Row(
                "bounds to widen by, as a share",
                &["least_widening"],
                Unit::Number,
            ),
            Row(
                "pivot from the chord",
                &["pivot_from_chord"],
                Unit::Millimetre,
            ),
            Row(
                "links from the shafts",
                &["shaft_clearance_min"],
                Unit::Millimetre,
            ),
        ],
    ),
    Group(
        "Drive of the crank",
        &["driven", "at rest"],
        &[
            Row(
                "driver turns",
                &["motion_angle", "dwell_angle"],
                Unit::Degree,
            ),
            Row(
                "crank free by",
                &["gear_play_moving_max", "gear_play_resting_max"],
                Unit::Degree,
            ),
            Row("ratio", &["arc_ratio"], Unit::Number),
            Row("crank", &["crank_rpm_driven"], Unit::TurnsPerMinute),
            Row("driver", &["driver_rpm"], Unit::TurnsPerMinute),
            Row("cuttings a minute", &["feed_rate"], Unit::Number),
            Row(
                "crank turns a cycle",
                &["crank_turns_a_cycle"],
                Unit::Number,
            ),
            Row(
                "crank turns for the feed",
                &["feed_crank_angle"],
                Unit::Degree,
            ),
            Row(
                "the same over the return",
                &["crank_quick_return"],
                Unit::Number,
            ),
            Row(
                "torque of the crank, at most",
                &["crank_torque_moving_max", "crank_torque_still_max"],
                Unit::NewtonMillimetre,
            ),
            Row(
                "jump of the crank's speed",
                &["crank_speed_jump"],
                Unit::RadianPerSecond,
            ),
            Row(
                "crank's acceleration, rad/s^2",
                &["crank_acceleration_max"],
                Unit::Number,
            ),
            Row("teeth left on the driver", &["gear_teeth"], Unit::Count),
            Row(
                "centre distance",
                &["gear_center_distance"],
                Unit::Millimetre,
            ),
            Row(
                "radius of the locking arc",
                &["gear_lock_radius"],
                Unit::Millimetre,
            ),
            Row("overlap", &["gear_overlap_max"], Unit::Millimetre),
        ],
    ),
    Group(
        "Box by the turn of the gears",
        &[],
        &[
            Row(
                "moves while picking",
                &["box_moved_distance"],
                Unit::Millimetre,
            ),
            Row(
                "shaft's speed over its mean",
                &["shaft_speed_ratio_min", "shaft_speed_ratio_max"],
                Unit::Number,
            ),
            Row("eccentricity", &["gear_eccentricity"], Unit::Number),
            Row(
                "least speed over the mean",
                &["box_speed_ratio_min"],
                Unit::Number,
            ),
            Row(
                "greatest speed over the mean",
                &["box_speed_ratio_max"],
                Unit::Number,
            ),
            Row(
                "greatest acceleration a rad squared",
                &["box_acceleration_max"],
                Unit::Millimetre,
            ),
            Row(
                "greatest acceleration, m/s^2",
                &["box_acceleration_max_m_s2"],
                Unit::Number,
            ),
            Row(
                "least normal force",
                &["box_normal_force_min"],
                Unit::Newton,
            ),
            Row(
                "greatest normal force",
                &["box_normal_force_max"],
                Unit::Newton,
            ),
            Row(
                "stays on one wall up to",
                &["box_contact_limit_rpm"],
                Unit::TurnsPerMinute,
            ),
        ],
    ),
];
