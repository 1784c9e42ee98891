use crate::design::GearPairDesign;
use crate::{Gear, GearPair, GearPairError, ProfileError, Role};
use centrode_geometry::{Outline, Tolerance};
use centrode_spec::DesignSpec;

/// A pair of the keys of its file, but for its family.
fn read(keys: &str) -> Result<GearPair, GearPairError> {
    let text = format!("family = \"gear-pair\"\n{keys}");
    GearPair::resolve(&GearPairDesign::from_toml(&text).expect("a design"))
}

/// A pair of the keys of its pitch curve, its tool and its teeth.
fn pair(pitch: &str, tool: &str, teeth: &str) -> Result<GearPair, GearPairError> {
    read(&format!(
        "pitch = {{ {pitch} }}\ntool = {{ {tool} }}\nteeth = {{ {teeth} }}"
    ))
}

fn assert_simple(gear: &Gear) {
    let outline = gear.outline();
    assert_eq!(outline.crossing(), None);
    assert!(outline.is_counter_clockwise());
}

/// Polygons within a millionth of the module of the contours of a design.
fn assert_simple_polygons(text: &str) {
    let pair = read(text).expect("a pair");
    let tolerance = Tolerance::new(1e-6 * pair.module()).expect("positive");
    for gear in [pair.driver(), pair.driven()] {
        let polygon = Outline::polygon(&gear.outline().flatten(tolerance));
        assert_eq!(polygon.crossing(), None, "{text}");
    }
}

#[test]
fn teeth_cut_off_together_with_the_curve_between_them_leave_a_simple_contour() {
    let eight = pair(
        r#"kind = "transmission", expression = "phi - 0.007440490699025695*sin(2*phi)", module = 3.887609922405928, tooth_count = 8"#,
        r#"kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 0.7385940745691889, dedendum_coefficient = 0.8890741274899601, tip_radius_coefficient = 0.026824051742530733"#,
        r#"phase = 0.0, backlash = 0.011162874276975314, thickness_split = 0.47098877471668577 }
driver = { shift = -0.4011362433975023"#,
    );
    let lobed = pair(
        r#"kind = "limacon", mean_radius = 10, amplitude = 1.2407, lobes = 3, module = 2, tooth_count = 8"#,
        r#"kind = "rack", pressure_angle_deg = 14.5"#,
        "",
    );
    for pair in [eight, lobed] {
        let pair = pair.expect("a pair");
        assert_simple(pair.driver());
        assert_simple(pair.driven());
    }
}

#[test]
fn spaces_without_a_land_are_joined_by_a_step_where_their_sides_are_unlike_in_depth() {
    let pair = pair(
        r#"kind = "ellipse", eccentricity = 0.021709128065897497, module = 3.3283890509233798, tooth_count = 48"#,
        r#"kind = "shaper", pressure_angle_deg = 12.727193574516296, addendum_coefficient = 1.0, dedendum_coefficient = 1.1636206741320099, tip_radius_coefficient = 0.006008345051381836, tooth_count = 26"#,
        r#"addendum = "fitted", phase = -0.4214240927006554, backlash = 0.2552718457160034, thickness_split = 0.46446687115083557"#,
    )
    .expect("a pair");
    for gear in [pair.driver(), pair.driven()] {
        assert_simple(gear);
    }
}

#[test]
fn tips_of_few_teeth_are_as_high_as_written() {
    let mut cut = 0;
    for teeth in 5..=12 {
        for pressure_angle in [12.0, 14.5, 15.475, 17.0, 20.0, 25.0, 28.0] {
            for addendum in [0.6, 0.96, 1.0, 1.3] {
                let pair = pair(
                    &format!(r#"kind = "circle", module = 2.0, tooth_count = {teeth}"#),
                    &format!(
                        r#"kind = "rack", pressure_angle_deg = {pressure_angle}, addendum_coefficient = {addendum}, dedendum_coefficient = {}, tip_radius_coefficient = 0.0"#,
                        addendum + 0.1
                    ),
                    r#"addendum = "full""#,
                );
                let Ok(pair) = pair else { continue };
                cut += 1;
                let tip = f64::from(teeth) + 2.0 * addendum;
                for gear in [pair.driver(), pair.driven()] {
                    let most = gear.radii().1;
                    assert!(
                        most < tip + 1e-9,
                        "{teeth} {pressure_angle} {addendum}: {most}"
                    );
                    let is_pointed = gear.teeth().iter().all(|tooth| tooth.tip_width < 1e-9);
                    assert!(
                        is_pointed || most > tip - 1e-9,
                        "{teeth} {pressure_angle}: {most}"
                    );
                }
            }
        }
    }
    // The tools of the others come to a point.
    assert!(cut > 150, "{cut}");
}

#[test]
fn no_tooth_is_higher_than_written_where_a_flank_turns_back_for_a_short_way() {
    for (curve, angle, addendum, phase, ratio) in [
        (
            "1 + 0.0601254*cos(4*phi) - 0.0169521*sin(8*phi)\", module = 2, tooth_count = 12",
            14.5,
            0.6,
            -0.95,
            "[2, 1]",
        ),
        (
            "1 + 0.21982334*cos(3*phi) + 0.07510884*sin(6*phi)\", module = 2, tooth_count = 8",
            14.5,
            1.0,
            -0.525,
            "[2, 1]",
        ),
        (
            "1 + 0.2206520448010779*cos(3*phi) + 0.0951802892428884*sin(6*phi)\", module = 2, tooth_count = 10",
            12.0,
            1.0,
            0.453_089_665_956_862_2,
            "[1, 1]",
        ),
    ] {
        let pair = read(&format!(
            "mean_ratio = {ratio}\npitch = {{ kind = \"polar\", expression = \"{curve} }}\n\
             tool = {{ kind = \"rack\", pressure_angle_deg = {angle}, addendum_coefficient = {addendum}, \
             dedendum_coefficient = {}, tip_radius_coefficient = 0.0 }}\nteeth = {{ phase = {phase} }}",
            addendum + 0.1
        ))
        .expect("a pair");
        for gear in [pair.driver(), pair.driven()] {
            let required = addendum * pair.module();
            for side in gear.teeth().iter().flat_map(|t| [&t.leading, &t.trailing]) {
                assert!(
                    side.tip_height <= required + 1e-9,
                    "{curve}: {}",
                    side.tip_height
                );
                assert!((side.tip_height + side.tip_shortening - required).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn beside_a_sharp_bend_inwards_tips_stand_over_the_nearest_place_of_the_pitch_curve() {
    let pair = pair(
        r#"kind = "polar", radius = [24.650148120189883, 14.553127807982031, 23.876894143362563, 14.141476665570298, 14.11264329406592, 13.044958529047, 22.578617672823565, 18.839472039011653, 13.37086621952813, 13.262343858517378, 18.979657058502585], interpolation = "cubic", module = 3.586448941441285, tooth_count = 16"#,
        r#"kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.299642696708099, dedendum_coefficient = 1.4971226983382036, tip_radius_coefficient = 0.1307553187945724"#,
        r#"phase = 0.0, thickness_split = 0.5227733477368081"#,
    )
    .expect("a pair");
    let tolerance = Tolerance::new(1e-6 * pair.module()).expect("positive");
    for gear in [pair.driver(), pair.driven()] {
        let polygon = Outline::polygon(&gear.outline().flatten(tolerance));
        assert_eq!(polygon.crossing(), None);
        for tooth in gear.teeth() {
            for side in [&tooth.leading, &tooth.trailing] {
                assert!(side.tip_height < 1.2997 * pair.module());
            }
        }
    }
}

#[test]
fn beside_a_fillet_that_turns_back_on_a_flank_polygons_are_simple_as_well() {
    let designs = [
        r#"pitch = { kind = "conjugate", mean_ratio = [2, 1], of = { kind = "polar", radius = [16.204074209877625, 18.410182935740618, 23.006863390637776, 22.44553833489443, 18.500563381395608, 20.291105283835506, 15.824259389968617, 23.733546601166925], interpolation = "cubic", module = 1.0, tooth_count = 30 }, module = 0.40592829698028243, tooth_count = 20 }
tool = { kind = "shaper", pressure_angle_deg = 14.5, addendum_coefficient = 1.0, dedendum_coefficient = 1.2452970025697345, tip_radius_coefficient = 0.1, tooth_count = 47 }
teeth = { addendum = "full", phase = 0.0, backlash = 0.0005302039452196339, thickness_split = 0.5 }
mean_ratio = [3, 2]"#,
        r#"pitch = { kind = "limacon", mean_radius = 11.464272485154506, amplitude = 5.427599326296165, lobes = 3, module = 1.4495713166655166, tooth_count = 17 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.0931257613348864, dedendum_coefficient = 1.2731576830173261, tip_radius_coefficient = 0.044688608498994524 }
teeth = { addendum = "full", phase = 0.8910724170569531, backlash = 0.017122803281009537, thickness_split = 0.5 }
mean_ratio = [1, 1]"#,
        r#"pitch = { kind = "bspline", degree = 2, interpolate = true, plane = "cartesian", x = [14.146584351790983, 5.7764486257441945, -8.503963566814901, -5.5318101040442285, -8.468457751498697, 0.364594428761588, 10.727238004592655], y = [0.0, 9.84221054006795, 12.297123474925444, 0.6261627065845893, -5.667057253782819, -8.13920587781676, -10.305332178840173], module = 2.3799755085859657, tooth_count = 30 }
tool = { kind = "rack", pressure_angle_deg = 24.731871578490697, addendum_coefficient = 1.0, dedendum_coefficient = 1.1378232386593823, tip_radius_coefficient = 0.0 }
teeth = { addendum = "fitted", phase = 0.6739446713784432, backlash = 0.0, thickness_split = 0.5149278607925007 }
mean_ratio = [1, 1]"#,
        r#"pitch = { kind = "bspline", degree = 2, interpolate = true, plane = "cartesian", x = [26.500086840688333, 22.465324512710634, 22.944813106110608, 2.893686021086901, -13.30134649719823, -33.11122604911964, -24.128785550795243, -18.067999808959566, -23.3395425324427, 0.1533885145053859, 24.286034746538764, 34.034410354652806], y = [0.0, 10.790359500843826, 30.919621172339834, 19.957403289408752, 39.25512725889489, 24.48892778702733, 1.2146713975737475, -7.816957903277181, -32.82674000496724, -19.524495608353458, -39.01041105662692, -16.502056543672495], module = 3.2450123457915625, tooth_count = 25 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.0, dedendum_coefficient = 1.1802014500658795, tip_radius_coefficient = 0.19725345285417856 }
teeth = { addendum = "full", phase = 0.0, backlash = 0.0, thickness_split = 0.4952373828249531 }
mean_ratio = [2, 1]"#,
        r#"pitch = { kind = "bspline", degree = 2, interpolate = true, plane = "polar", radius = [10.714043655181552, 11.500798621878506, 9.427715716196301, 18.82316131519598, 7.473955153963506, 19.12368843425135, 8.182472524040717, 15.976350249097026, 19.705841825584965], angle_deg = [0.0, 47.386500382969906, 82.06955252698783, 115.28203152907987, 158.22880310578012, 194.37754557373353, 227.02389410395762, 269.21742249703976, 314.2026129344321], module = 3.8207490848458763, tooth_count = 38 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.0912509077094859, dedendum_coefficient = 1.362313639469925, tip_radius_coefficient = 0.12093737448407488 }
driver = { shift = -0.4904069324358544 }
teeth = { addendum = "full", phase = 0.0, backlash = 0.26645351715930593, thickness_split = 0.5031343221525656 }
mean_ratio = [1, 1]"#,
        r#"pitch = { kind = "bspline", degree = 3, interpolate = true, plane = "polar", radius = [26.792767098544466, 39.16871093527554, 39.21056614767088, 34.52782826255997, 42.54621488549807, 25.459779202693156, 43.12579744885687, 31.38835624662809, 24.530231080610097, 44.50790414971723, 29.085781116104798, 38.18960921600835, 29.764543156922777], angle_deg = [0.0, 27.69230769230769, 55.38461538461538, 83.07692307692308, 110.76923076923076, 138.46153846153848, 166.15384615384616, 193.84615384615384, 221.53846153846152, 249.23076923076923, 276.92307692307696, 304.6153846153846, 332.3076923076923], module = 2.6325862430946194, tooth_count = 16 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.0, dedendum_coefficient = 1.1972611387317844, tip_radius_coefficient = 0.03297777809096545 }
teeth = { addendum = "full", phase = 0.0, backlash = 0.0, thickness_split = 0.5 }
mean_ratio = [1, 1]"#,
    ];
    designs.into_iter().for_each(assert_simple_polygons);
}

#[test]
fn lands_narrower_than_their_parameters_have_digits_for_and_tips_over_each_other_leave_a_simple_contour()
 {
    let designs = [
        r#"pitch = { kind = "conjugate", mean_ratio = [2, 1], of = { kind = "eccentric-circle", eccentricity = 0.3689172946804461, module = 1.0, tooth_count = 30 }, module = 3.0562125155855173, tooth_count = 48 }
tool = { kind = "rack", pressure_angle_deg = 27.324824106674, addendum_coefficient = 1.216879753674706, dedendum_coefficient = 1.474972552011973, tip_radius_coefficient = 0.0 }
driver = { shift = 0.007757012258982177 }
teeth = { addendum = "fitted", phase = -0.4886353449380616, backlash = 0.0, thickness_split = 0.5 }
mean_ratio = [1, 1]"#,
        r#"pitch = { kind = "conjugate", mean_ratio = [2, 1], of = { kind = "limacon", mean_radius = 19.837400987091502, amplitude = 11.116799973951625, lobes = 4, module = 1.0, tooth_count = 30 }, module = 1.7498220730779859, tooth_count = 54 }
tool = { kind = "rack", pressure_angle_deg = 20.0, addendum_coefficient = 1.2575908901710229, dedendum_coefficient = 1.5458927264896059, tip_radius_coefficient = 0.1805235953968268 }
driver = { shift = 0.16832051502228607 }
teeth = { addendum = "full", phase = -0.8315767390565034, backlash = 0.04068361107933593, thickness_split = 0.48393694566041434 }
mean_ratio = [3, 1]"#,
    ];
    designs.into_iter().for_each(assert_simple_polygons);
}

#[test]
fn a_flank_that_turns_back_within_rounding_of_its_fillet_leaves_a_simple_contour() {
    let designs = [
        r#"pitch = { kind = "bspline", degree = 2, interpolate = false, plane = "cartesian", x = [26.122387498597618, 20.107057666098044, 8.240726751916169, -7.958295670376018, -18.511520280784733, -25.604142337168746, -21.311669544175324, -9.410013652336968, 5.84149930296789, 20.06158841688901], y = [0.0, 14.367088039711676, 21.378908472789487, 21.229353479220823, 13.470613780986177, 1.1750212719381203, -14.096775456975505, -25.767336033164604, -21.968228840602027, -16.67230274544473], module = 3.3183366646282457, tooth_count = 51 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.2421659506382985, dedendum_coefficient = 1.5101144675684879, tip_radius_coefficient = 0.0 }
driver = { shift = -0.30475256382877347 }
teeth = { addendum = "full", phase = -0.46011470299729473, backlash = 0.2839530567510447, thickness_split = 0.49709617971249137 }
mean_ratio = [1, 1]"#,
        r#"pitch = { kind = "ellipse", eccentricity = 0.4584263668193459, module = 1.3884481289339332, tooth_count = 26 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 0.8701527138279792, dedendum_coefficient = 1.01634361303425, tip_radius_coefficient = 0.17090511361553734 }
teeth = { addendum = "full", phase = -0.2857413704224736, backlash = 0.0, thickness_split = 0.4814649328961767 }
mean_ratio = [2, 1]"#,
        r#"pitch = { kind = "polar", expression = "1 + 0.14502241217744302*cos(5*phi) - 0.012244836335580378*sin(phi)", module = 3.184903230701943, tooth_count = 60 }
tool = { kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.0, dedendum_coefficient = 1.2139761926156627, tip_radius_coefficient = 0.1 }
teeth = { addendum = "fitted", phase = -0.9958157188534333, backlash = 0.0, thickness_split = 0.5 }
mean_ratio = [2, 1]"#,
    ];
    designs.into_iter().for_each(assert_simple_polygons);
}

#[test]
fn tips_stand_over_their_own_tooth_and_not_once_more_round_a_small_gear() {
    let text = |amplitude: f64| {
        format!(
            r#"pitch = {{ kind = "limacon", mean_radius = 25.35913982516481, amplitude = {amplitude}, lobes = 4, module = 0.7291877141555998, tooth_count = 10 }}
tool = {{ kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.0, dedendum_coefficient = 1.1269599827850645, tip_radius_coefficient = 0.19402206952829182 }}
driver = {{ shift = -0.3567265487281023 }}
teeth = {{ addendum = "full", phase = -0.35802832874925206, backlash = 0.0, thickness_split = 0.5 }}
mean_ratio = [1, 2]"#
        )
    };
    assert_simple_polygons(&text(13.0));
    // With more of a wave the roots go past the axis, and the contours are as simple.
    let refused = read(&text(15.068077987954187));
    let Err(GearPairError::Profile(ProfileError::AxisOutside { .. })) = refused else {
        panic!("{refused:?}");
    };
}

#[test]
fn curves_of_a_tooth_that_do_not_meet_are_no_profile_and_told_with_their_distance() {
    let refused = pair(
        r#"kind = "limacon", mean_radius = 20.0, amplitude = 19.15606738324485, lobes = 8, module = 2.0, tooth_count = 7"#,
        r#"kind = "shaper", pressure_angle_deg = 16.444633513321094, addendum_coefficient = 1.0, dedendum_coefficient = 1.100397840421288, tip_radius_coefficient = 0.17400953167551528, tooth_count = 49"#,
        r#"addendum = "full", phase = -0.033812248531348565, backlash = 0.2551198660399243, thickness_split = 0.5 }
driver = { shift = -0.318335702221644"#,
    );
    let Err(GearPairError::Profile(ProfileError::Gap { roles, gap, .. })) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(roles, [Role::Flank, Role::Tip]);
    assert!(gap > 1e-6, "{gap}");
}

#[test]
fn a_contour_that_leaves_its_axis_outside_is_refused() {
    let read = |eccentricity: f64| {
        pair(
            &format!(
                "kind = \"eccentric-circle\", eccentricity = {eccentricity}, module = 0.5, tooth_count = 11"
            ),
            "kind = \"rack\"",
            "addendum = \"fitted\", backlash = 0.00929, thickness_split = 0.52",
        )
    };
    let refused = read(0.796);
    let Err(error) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(error.key(), "tooth_count");
    let GearPairError::Profile(ProfileError::AxisOutside { away, .. }) = error else {
        panic!("{error}");
    };
    // A root goes 0.625 mm below a pitch radius of about 0.56 mm.
    assert!(away > 0.01 && away < 0.1, "{away}");
    let sound = read(0.7).expect("a pair");
    assert!(
        sound
            .driver()
            .outline()
            .contains(centrode_geometry::Point::origin())
    );
}
