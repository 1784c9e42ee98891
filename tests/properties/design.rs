use centrode_gear::design::GearPairDesign;
use centrode_spec::{Design, DesignSpec};
use centrode_tests::{near_design, pitch};
use proptest::prelude::{ProptestConfig, prop_assert, prop_assert_eq, proptest};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_text_is_a_design_or_an_error(text in near_design()) {
        if let Ok(design) = toml::from_str::<GearPairDesign>(&text) {
            // Reaching the end is the point: neither call may panic or hang.
            let _ = (design.validate(), design.pitch.resolve());
        }
    }
}

proptest! {
    #[test]
    fn a_design_written_and_read_is_the_same_design(pitch in pitch()) {
        let design = GearPairDesign::new(pitch);
        let text = design.to_toml().expect("a valid design can be written");
        let mut read = GearPairDesign::from_toml(&text).expect("what was written reads");
        prop_assert!(read.validate().is_ok());
        // Angles pass through degrees: the curve is the same but for the last digit.
        let curve = |d: &GearPairDesign| d.pitch.resolve().expect("valid").curve;
        let (one, other) = (curve(&design), curve(&read));
        for i in 0..100 {
            let t = one.period() * f64::from(i) / 100.0;
            let (a, b) = (one.at(t).point, other.at(t).point);
            prop_assert!((a - b).norm() <= 1e-13 * a.coords.norm());
        }
        read.pitch = design.pitch.clone();
        prop_assert_eq!(read, design);
    }
}
