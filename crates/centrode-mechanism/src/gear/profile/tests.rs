use super::{ProfileError, Role};
use crate::gear::{Gear, GearPair, GearPairError};

/// A pair of the keys of its pitch curve, its tool and its teeth.
fn pair(pitch: &str, tool: &str, teeth: &str) -> Result<GearPair, GearPairError> {
    let text = format!("pitch = {{ {pitch} }}\ntool = {{ {tool} }}\nteeth = {{ {teeth} }}");
    GearPair::resolve(&toml::from_str(&text).expect("a design"))
}

fn assert_simple(gear: &Gear) {
    let outline = gear.outline();
    assert_eq!(outline.crossing(), None);
    assert!(outline.is_counter_clockwise());
}

#[test]
fn teeth_cut_off_together_with_the_curve_between_them_leave_a_simple_contour() {
    let eight = pair(
        r#"kind = "transmission", expression = "phi - 0.007440490699025695*sin(2*phi)", module = 3.887609922405928, tooth_count = 8"#,
        r#"kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 0.7385940745691889, dedendum_coefficient = 0.8890741274899601, tip_radius_coefficient = 0.026824051742530733, profile_shift_coefficient = -0.4011362433975023"#,
        r#"phase = 0.0, backlash = 0.011162874276975314, thickness_split = 0.47098877471668577"#,
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
fn curves_of_a_tooth_that_do_not_meet_are_an_error_that_tells_how_far_they_are_apart() {
    let refused = pair(
        r#"kind = "polar", radius = [24.650148120189883, 14.553127807982031, 23.876894143362563, 14.141476665570298, 14.11264329406592, 13.044958529047, 22.578617672823565, 18.839472039011653, 13.37086621952813, 13.262343858517378, 18.979657058502585], interpolation = "cubic", module = 3.586448941441285, tooth_count = 16"#,
        r#"kind = "rack", pressure_angle_deg = 14.5, addendum_coefficient = 1.299642696708099, dedendum_coefficient = 1.4971226983382036, tip_radius_coefficient = 0.1307553187945724"#,
        r#"phase = 0.0, thickness_split = 0.5227733477368081"#,
    );
    let Err(GearPairError::Profile(ProfileError::Gap { roles, gap, .. })) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(roles, [Role::Flank, Role::Tip]);
    assert!(gap > 1.0);
}
