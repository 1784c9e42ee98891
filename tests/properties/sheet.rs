use centrode::FAMILIES;
use centrode_export::SheetOptions;
use centrode_export::gear_pair::{Subject, sheets};
use centrode_formats::sheet::overlaps;
use centrode_gear::GearPair;
use centrode_gear::design::GearPairDesign;
use centrode_geometry::Tolerance;
use centrode_kinematics::machine::Keyway;
use centrode_spec::{DesignSpec as _, Projection, SheetSize};
use centrode_tests::sound_pair;
use proptest::prelude::{ProptestConfig, any, prop_assert, proptest};
use std::fs;
use std::path::Path;

const PROJECTIONS: [Projection; 2] = [Projection::FirstAngle, Projection::ThirdAngle];

/// Words on a pair's sheets that touch anything, by subject and page; or why there is no sheet.
fn unreadable(pair: &GearPair, sheet: SheetOptions) -> Vec<String> {
    let tolerance = Tolerance::new(1e-3 * pair.module()).expect("positive");
    let mut found = Vec::new();
    for subject in Subject::ALL {
        match sheets(pair, subject, &sheet, tolerance) {
            Ok(pages) => {
                for (page, sheet) in pages.iter().enumerate() {
                    let faults = overlaps(sheet);
                    let stated = faults.iter().map(|f| format!("{subject:?} {page}: {f:?}"));
                    found.extend(stated);
                }
            }
            Err(error) => found.push(error.to_string()),
        }
    }
    found
}

#[test]
fn words_touch_nothing_on_the_sheets_of_every_design_at_every_size() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let mut count = 0;
    for entry in fs::read_dir(folder).expect("the designs") {
        let path = entry.expect("an entry").path();
        let file = FAMILIES
            .read(&fs::read(&path).expect("readable"))
            .expect("a design");
        // Folders hold designs of other families too.
        let Some(pair) = file
            .mechanism()
            .expect("a mechanism")
            .downcast::<GearPair>()
        else {
            continue;
        };
        let sizes = SheetSize::ALL.map(Some).into_iter().chain([None]);
        for (index, size) in sizes.enumerate() {
            let sheet = SheetOptions {
                size,
                projection: Some(PROJECTIONS[index % 2]),
                ..SheetOptions::default()
            };
            let found = unreadable(&pair, sheet);
            assert!(found.is_empty(), "{} {size:?}: {found:#?}", path.display());
            count += 1;
        }
    }
    assert!(count >= 6 * 7, "only {count} sets of sheets");
}

#[test]
fn the_first_teeth_are_told_apart_wherever_they_stand() {
    let text = "family = \"gear-pair\"\n[pitch]\nkind = \"bspline\"\ndegree = 3\ninterpolate = false\n\
                radius = [23.918768, 20.727547, 10, 10, 10, 10]\nmodule = 0.5\ntooth_count = 32\n\
                angle_deg = [49.907301453, 107.014602905, 164.121904358, 238.585397095, 295.692698547, 352.800000000]\n\
                [teeth]\nphase = 0.9865918629\nthickness_split = 0.44\n\
                [tool]\nkind = \"rack\"\ntip_radius_coefficient = 0.25\n[driver]\nbore = 2\nwidth = 5\n[driven]\nbore = 2\nwidth = 5\n";
    let design = GearPairDesign::from_toml(text).expect("a design");
    let pair = GearPair::resolve(&design).expect("a pair");
    let sheet = SheetOptions {
        projection: Some(PROJECTIONS[0]),
        ..SheetOptions::default()
    };
    let found = unreadable(&pair, sheet);
    assert!(found.is_empty(), "{found:#?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn words_touch_nothing_on_the_sheets_of_random_designs(
        mut design in sound_pair(),
        bore in 0.1..0.9_f64,
        keyed in any::<bool>(),
        width in 0.3..3.0_f64,
        third in any::<bool>(),
    ) {
        let plain = GearPair::resolve(&design).expect("valid");
        for (gear, body) in [(plain.driver(), &mut design.driver), (plain.driven(), &mut design.driven)] {
            body.bore = 1.2 * bore * gear.radii().0;
            body.width = width * gear.radii().0;
            body.keyway = keyed.then_some(Keyway {
                width: 0.3 * body.bore,
                depth: 0.15 * body.bore,
            });
        }
        let pair = GearPair::resolve(&design).expect("still valid");
        let sheet = SheetOptions {
            projection: Some(PROJECTIONS[usize::from(third)]),
            ..SheetOptions::default()
        };
        let found = unreadable(&pair, sheet);
        prop_assert!(found.is_empty(), "{found:#?}");
    }
}
